//! Compares compiled kernels with the oracle and with the interpreter.

use aim_codegen::RigSpec;
use aim_codegen::objective::{CHAIN_RESIDUAL_JACOBIAN, CHAIN_VALUE_GRADIENT, FirstLink};

use crate::kinematics::{Case, Link};
use crate::oracle::{assert_close, doubled, expected_chain, expected_joint, flat, single};
use crate::requested::RequestedKernels;

/// Outputs of a rig's compiled kernels for one case. They are gathered in generic code and judged outside of it, since
/// a test with many rigs compiles many copies of the generic part.
#[derive(Debug)]
pub struct Outputs {
    gradient: Vec<f64>,
    jacobian: Vec<f64>,
    gradient_f32: Vec<f32>,
    jacobian_f32: Vec<f32>,
    joints: Vec<[f64; 3]>,
}

impl Outputs {
    /// Returns the outputs of `rig` for each of `cases`.
    pub fn of<R: RequestedKernels>(rig: &R, cases: &[Case]) -> Vec<Self> {
        cases.iter().map(|case| Self::of_case(rig, case)).collect()
    }

    fn of_case<R: RequestedKernels>(rig: &R, case: &Case) -> Self {
        let description = rig.description();
        let infos = description.joints();
        let angles =
            infos.iter().map(|i| usize::from(i.pitch.is_some()) + usize::from(i.heading.is_some())).sum::<usize>();
        let inputs = Inputs::of(case);
        let mut out = Self {
            gradient: vec![0.0; 1 + angles],
            jacobian: vec![0.0; 2 + 2 * angles],
            gradient_f32: vec![0.0; 1 + angles],
            jacobian_f32: vec![0.0; 2 + 2 * angles],
            joints: Vec::new(),
        };
        let Inputs { links, sin_cos, links_f32, target_f32, sin_cos_f32 } = &inputs;
        R::value_gradient(links, &case.target, sin_cos, &mut out.gradient);
        R::residual_with_jacobian(links, &case.target, sin_cos, &mut out.jacobian);
        R::value_gradient(links_f32, target_f32, sin_cos_f32, &mut out.gradient_f32);
        R::residual_with_jacobian(links_f32, target_f32, sin_cos_f32, &mut out.jacobian_f32);
        out.joints = (0..infos.len()).map(|i| R::joint_gradient(i, &links[i], &case.target, &sin_cos[i])).collect();
        out
    }
}

struct Inputs {
    links: Vec<[f64; 12]>,
    sin_cos: Vec<[f64; 4]>,
    links_f32: Vec<[f32; 12]>,
    target_f32: [f32; 3],
    sin_cos_f32: Vec<[f32; 4]>,
}

impl Inputs {
    fn of(case: &Case) -> Self {
        let links: Vec<[f64; 12]> = case.links.iter().map(Link::numbers).collect();
        let sin_cos = case.sin_cos();
        Self {
            links_f32: links.iter().map(array).collect(),
            target_f32: array(&case.target),
            sin_cos_f32: sin_cos.iter().map(array).collect(),
            links,
            sin_cos,
        }
    }
}

fn array<const N: usize>(numbers: &[f64; N]) -> [f32; N] {
    single(numbers).try_into().expect("as many numbers come out as go in")
}

/// Compares the outputs of `spec`'s compiled kernels with the oracle, and with the interpreter bit for bit.
///
/// # Panics
/// Panics if they differ.
pub fn compare(spec: &RigSpec, cases: &[Case], outputs: &[Outputs]) {
    let name = &spec.name;
    let [gradient_program, jacobian_program] = [&CHAIN_VALUE_GRADIENT, &CHAIN_RESIDUAL_JACOBIAN]
        .map(|objective| objective.kernels(spec, FirstLink::Given).remove(0).program);
    assert_eq!(cases.len(), outputs.len(), "{name}");
    for (case, out) in cases.iter().zip(outputs) {
        let (gradient, jacobian) = expected_chain(spec, case);
        assert_close(&out.gradient, &gradient, 1e-9, &format!("{name}, f64 gradient"));
        assert_close(&out.jacobian, &jacobian, 1e-8, &format!("{name}, f64 Jacobian"));
        assert_close(&doubled(&out.gradient_f32), &gradient, 2e-5, &format!("{name}, f32 gradient"));
        assert_close(&doubled(&out.jacobian_f32), &jacobian, 2e-4, &format!("{name}, f32 Jacobian"));
        for (joint, found) in out.joints.iter().enumerate() {
            if let Some(expected) = expected_joint(spec, case, joint) {
                assert_close(found, &expected, 1e-9, &format!("{name}, joint {joint}"));
            }
        }

        let (flat, flat_f32) = (flat(case), single(&flat(case)));
        let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        let bits_f32 = |numbers: &[f32]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        let chain = [
            (&gradient_program, &out.gradient, &out.gradient_f32),
            (&jacobian_program, &out.jacobian, &out.jacobian_f32),
        ];
        for (program, found, found_f32) in chain {
            let (mut interpreted, mut interpreted_f32) = (vec![0.0; found.len()], vec![0.0; found.len()]);
            program.run(&flat, &mut interpreted);
            program.run(&flat_f32, &mut interpreted_f32);
            assert_eq!(bits(found), bits(&interpreted), "{name}: compiled and interpreted f64");
            assert_eq!(bits_f32(found_f32), bits_f32(&interpreted_f32), "{name}: compiled and interpreted f32");
        }
    }
}
