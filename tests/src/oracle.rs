//! Expected results of the derived functions, by central differences of independent forward kinematics.

use aim_codegen::RigSpec;

use crate::kinematics::{Case, Link};
use crate::random::Random;

/// Returns random poses of `spec` whose target is neither at the effector nor behind it, where the residual is steep.
pub fn cases(spec: &RigSpec, seed: u64, count: usize) -> Vec<Case> {
    let mut random = Random::new(seed);
    let mut cases = Vec::new();
    while cases.len() < count {
        let links =
            spec.joints.iter().map(|_| Link { rows: random.rotation(), translation: random.vector(0.5) }).collect();
        let angles = spec.joints.iter().map(|joint| {
            [joint.pitch, joint.heading].map(|range| if range.is_some() { random.within(1.5) } else { 0.0 })
        });
        let angles = angles.collect();
        let case = Case { links, angles, target: random.vector(3.0) };
        let (distance, angle) = case.view(spec);
        if distance > 0.5 && angle < 2.0 {
            cases.push(case);
        }
    }
    cases
}

/// Returns the angles that `spec` declares, pitch before heading, joint by joint: the joint, and 0 or 1.
fn declared(spec: &RigSpec) -> Vec<(usize, usize)> {
    let joints = spec.joints.iter().enumerate();
    joints
        .flat_map(|(i, joint)| [(joint.pitch.is_some(), (i, 0)), (joint.heading.is_some(), (i, 1))])
        .filter_map(|(declared, angle)| declared.then_some(angle))
        .collect()
}

/// Returns the chain's outputs, by central differences: aim and gradient, then residual and Jacobian.
pub fn expected_chain(spec: &RigSpec, case: &Case) -> (Vec<f64>, Vec<f64>) {
    let aim = |c: &Case| [c.aim(spec)];
    let residual = |c: &Case| c.residual(spec);
    let mut gradient = vec![case.aim(spec)];
    let mut jacobian = case.residual(spec).to_vec();
    let columns: Vec<[f64; 2]> =
        declared(spec).into_iter().map(|(joint, which)| case.difference(joint, which, residual)).collect();
    gradient.extend(declared(spec).into_iter().map(|(joint, which)| case.difference(joint, which, aim)[0]));
    for row in 0..2 {
        jacobian.extend(columns.iter().map(|column| column[row]));
    }
    (gradient, jacobian)
}

/// Returns the rig reduced to one joint; that joint's link leads from the effector.
fn joint_alone(spec: &RigSpec, case: &Case, joint: usize) -> (RigSpec, Case) {
    let mut alone = spec.clone();
    alone.joints = vec![spec.joints[joint].clone()];
    let case = Case { links: vec![case.links[joint]], target: case.target, angles: vec![case.angles[joint]] };
    (alone, case)
}

/// Returns a joint's aim, ∂aim/∂pitch, ∂aim/∂heading; `None` if its target is too close to compare.
pub fn expected_joint(spec: &RigSpec, case: &Case, joint: usize) -> Option<[f64; 3]> {
    let (alone, case) = joint_alone(spec, case, joint);
    if case.view(&alone).0 < 0.5 {
        return None;
    }
    let mut expected = [case.aim(&alone), 0.0, 0.0];
    for (_, which) in declared(&alone) {
        expected[1 + which] = case.difference(0, which, |c| [c.aim(&alone)])[0];
    }
    Some(expected)
}

/// # Panics
/// Panics if a number differs from the expected one by more than `tolerance`, relative to the larger of 1 and the
/// expected magnitude.
pub fn assert_close(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
        let scale = expected.abs().max(1.0);
        assert!((found - expected).abs() <= tolerance * scale, "{what}, output {i}: {found}, expected {expected}");
    }
}

/// Converts the numbers to single precision.
#[expect(clippy::cast_possible_truncation, reason = "the kernels run in f32 too")]
pub fn single(numbers: &[f64]) -> Vec<f32> {
    numbers.iter().map(|&x| x as f32).collect()
}

/// Converts the numbers to double precision.
pub fn doubled(numbers: &[f32]) -> Vec<f64> {
    numbers.iter().map(|&x| x.into()).collect()
}

/// Returns the inputs of the chain's functions as one array, in the order of the interpreter.
pub fn flat(case: &Case) -> Vec<f64> {
    let mut flat: Vec<f64> = case.links.iter().flat_map(Link::numbers).collect();
    flat.extend(case.target);
    flat.extend(case.sin_cos().into_iter().flatten());
    flat
}
