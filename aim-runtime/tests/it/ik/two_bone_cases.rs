//! Test cases of ozz-animation's two-bone solver, under the same names.

use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::ik::{Hinge, Limb, TwoBone, TwoBoneOutcome, TwoBoneStatus};

use crate::common::exact::*;
use crate::common::{DEG, parents};

/// Limb of one unit up, then one unit along x: bent by 90° in the xy plane.
const BENT: Limb = Limb { root: Vec3::ZERO, middle: Vec3::Y, tip: Vec3::new(1.0, 1.0, 0.0) };

fn under(parent: &Affine3A, limb: &Limb) -> Limb {
    let [root, middle, tip] = [limb.root, limb.middle, limb.tip].map(|point| parent.transform_point3(point));
    Limb { root, middle, tip }
}

/// Returns middle joint and tip by forward kinematics, after checking that both rotations are valid.
fn posed(limb: &Limb, outcome: &TwoBoneOutcome) -> [Point; 2] {
    assert!(is_sound(outcome.upper) && is_sound(outcome.lower));
    let [root, middle, tip] = [limb.root, limb.middle, limb.tip].map(exact);
    let new_middle = plus(root, turned(outcome.upper, minus(middle, root)));
    [new_middle, plus(new_middle, turned(outcome.lower, minus(tip, middle)))]
}

/// Solves, asserts that the target is reached by forward kinematics, and returns the middle joint's position.
fn reached(solver: &TwoBone, limb: &Limb, target: Vec3) -> Point {
    let outcome = solver.solve(limb, target);
    assert_eq!(outcome.status, TwoBoneStatus::Reached, "{limb:?} to {target}");
    let [middle, tip] = posed(limb, &outcome);
    let largest = [limb.root, target].iter().fold(limb.length(), |a, v| a.max(v.abs().max_element()));
    assert!(length(minus(tip, exact(target))) < 1e-5 * f64::from(largest), "{tip:?} instead of {target}");
    middle
}

fn is_near(a: Point, b: Vec3) -> bool {
    length(minus(a, exact(b))) < 1e-4
}

#[test]
fn job_validity() {
    let nothing = Limb { root: Vec3::ZERO, middle: Vec3::ZERO, tip: Vec3::ZERO };
    let far = Vec3::splat(f32::INFINITY);
    let unusable = [
        (nothing, Vec3::X),
        (Limb { root: Vec3::NAN, ..BENT }, Vec3::X),
        (Limb { middle: Vec3::NAN, ..BENT }, Vec3::X),
        (Limb { tip: Vec3::NAN, ..BENT }, Vec3::X),
        (Limb { tip: far, ..BENT }, Vec3::X),
        (BENT, Vec3::NAN),
        (BENT, far),
    ];
    for (limb, target) in unusable {
        let outcome = TwoBone::new().solve(&limb, target);
        assert_eq!(outcome.status, TwoBoneStatus::Degenerate, "{limb:?} {target}");
        assert_eq!((outcome.upper, outcome.lower), (Quat::IDENTITY, Quat::IDENTITY));
    }
    // A hinge without an axis still leaves a working solver.
    let hinge = Hinge { axis: Vec3::ZERO, least_rad: 0.0, most_rad: 3.0 };
    reached(&TwoBone::new().with_hinge(hinge), &BENT, Vec3::new(1.0, 0.5, 0.2));
}

#[test]
fn start_joint_correction() {
    for (name, parent, _) in parents() {
        for degrees in [0.0, 90.0, 270.0] {
            let limb = under(&(parent * Affine3A::from_rotation_z(degrees * DEG)), &BENT);
            for target in [
                Vec3::new(1.0, 1.0, 0.0),
                Vec3::new(0.0, 1.0, 1.0),
                Vec3::new(-1.0, 1.0, 0.0),
                Vec3::new(1.0, 0.0, 0.2),
            ] {
                let target = parent.transform_point3(target);
                let [upper, lower] = [limb.middle - limb.root, limb.tip - limb.middle].map(Vec3::length);
                let distance = target.distance(limb.root);
                // Non-uniform scale puts some targets out of reach.
                if distance > (upper - lower).abs() && distance < upper + lower {
                    reached(&TwoBone::new(), &limb, target);
                } else {
                    assert_ne!(TwoBone::new().solve(&limb, target).status, TwoBoneStatus::Reached, "{name}");
                }
            }
        }
    }
}

#[test]
fn pole() {
    for (parent_name, parent, is_similar) in parents() {
        let limb = under(&parent, &BENT);
        let poles = [
            (Vec3::Y, Vec3::new(1.0, 1.0, 0.0), Vec3::Y),
            (Vec3::Z, Vec3::new(1.0, 0.0, 1.0), Vec3::Z),
            (Vec3::NEG_Z, Vec3::new(1.0, 0.0, -1.0), Vec3::NEG_Z),
            (Vec3::X, Vec3::new(1.0, -1.0, 0.0), Vec3::X),
            (Vec3::NEG_X, Vec3::new(-1.0, -1.0, 0.0), Vec3::NEG_X),
        ];
        for (pole, target, middle) in poles {
            let [pole, target, middle] = [pole, target, middle].map(|point| parent.transform_point3(point));
            if is_similar {
                let found = reached(&TwoBone::new().with_pole(pole), &limb, target);
                assert!(is_near(found, middle), "{parent_name}: {found:?} instead of {middle}");
            }
        }
    }
}

#[test]
fn zero_scale() {
    let limb = under(&Affine3A::from_scale(Vec3::ZERO), &BENT);
    let outcome = TwoBone::new().solve(&limb, Vec3::X);
    assert_eq!((outcome.status, outcome.upper), (TwoBoneStatus::Degenerate, Quat::IDENTITY));
}

#[test]
fn soften() {
    let at = |soften: f32, distance: f32| {
        let outcome = TwoBone::new().with_softening(soften).solve(&BENT, Vec3::X * distance);
        let [_, tip] = posed(&BENT, &outcome);
        (outcome.status, length(tip))
    };
    // Reachable, without softening and before softening begins.
    assert_eq!(at(1.0, 1.9).0, TwoBoneStatus::Reached);
    assert_eq!(at(0.5, 0.9).0, TwoBoneStatus::Reached);
    // Softened, with two settings.
    for soften in [0.5, 0.2] {
        let (status, distance) = at(soften, 1.5);
        assert_eq!(status, TwoBoneStatus::Partial);
        assert!(distance < 1.5 && distance > 2.0 * f64::from(soften));
    }
    // Too far; exactly at full extent; beyond with softening; slightly too far.
    assert_eq!(at(1.0, 3.0).0, TwoBoneStatus::TooFar);
    assert_eq!(at(1.0, 2.0).0, TwoBoneStatus::Reached);
    assert!(at(0.5, 3.0).1 < 2.0 && at(0.5, 3.0).0 == TwoBoneStatus::TooFar);
    assert!((at(1.0, 2.001).1 - 2.0).abs() < 1e-4);
}

#[test]
fn twist() {
    let target = Vec3::new(1.0, 1.0, 0.0);
    for (degrees, middle) in [(0.0, Vec3::Y), (180.0, Vec3::X), (360.0, Vec3::Y)] {
        let solver = TwoBone::new().with_pole(Vec3::Y).with_twist(degrees * DEG);
        assert!(is_near(reached(&solver, &BENT, target), middle), "{degrees}");
    }
    let quarter = reached(&TwoBone::new().with_pole(Vec3::Y).with_twist(90.0 * DEG), &BENT, target);
    assert!(is_near(quarter, Vec3::new(0.5, 0.5, core::f32::consts::FRAC_1_SQRT_2)), "{quarter:?}");
}

#[test]
fn weight() {
    let target = Vec3::new(0.0, 1.0, 1.0);
    let tip = |weight: f32| posed(&BENT, &TwoBone::new().with_weight(weight).solve(&BENT, target))[1];
    for weight in [1.0, 1.1] {
        assert!(is_near(tip(weight), target), "{weight}");
    }
    for weight in [0.0, -0.1] {
        assert!(is_near(tip(weight), BENT.tip), "{weight}");
    }
    let half = tip(0.5);
    assert!(length(minus(half, exact(target))) < 1.0 && length(minus(half, exact(BENT.tip))) < 1.0);
    assert_eq!(TwoBone::new().with_weight(0.5).solve(&BENT, target).status, TwoBoneStatus::Partial);
}

#[test]
fn pole_target_alignment() {
    // The pole exactly on the line to the target, and a thousandth beside it, also at full extent.
    for pole in [Vec3::X, Vec3::new(1.0, 0.001, 0.0), Vec3::new(-1.0, 0.001, 0.0)] {
        reached(&TwoBone::new().with_pole(pole), &BENT, Vec3::X * 1.2);
        reached(&TwoBone::new().with_pole(pole), &BENT, Vec3::X * 2.0);
    }
    let beside = reached(&TwoBone::new().with_pole(Vec3::new(1.0, 0.001, 0.0)), &BENT, Vec3::X * 1.2);
    assert!(is_near(beside, Vec3::new(0.6, 0.8, 0.0)), "{beside:?}");
}

#[test]
fn mid_axis() {
    let target = Vec3::new(1.0, 0.5, 0.0);
    for axis in [Vec3::Z, Vec3::NEG_Z] {
        let hinge = Hinge { axis, least_rad: 0.0, most_rad: 3.0 };
        reached(&TwoBone::new().with_hinge(hinge), &BENT, target);
        // Collinear joints define no plane: the hinge determines the direction of the bend.
        let straight = Limb { tip: Vec3::Y * 2.0, ..BENT };
        let middle = reached(&TwoBone::new().with_hinge(hinge), &straight, Vec3::Y);
        assert!(middle[0] * f64::from(axis.z) > 0.5, "{middle:?}");
    }
    reached(&TwoBone::new(), &Limb { tip: Vec3::Y * 2.0, ..BENT }, target);
}

#[test]
fn aligned_joints_and_target() {
    let straight = Limb { root: Vec3::ZERO, middle: Vec3::X, tip: Vec3::X * 2.0 };
    reached(&TwoBone::new(), &straight, Vec3::X);
    reached(&TwoBone::new(), &straight, Vec3::X * 2.0);
    let far = TwoBone::new().solve(&straight, Vec3::X * 3.0);
    assert_eq!(far.status, TwoBoneStatus::TooFar);
    assert!(is_near(posed(&straight, &far)[1], Vec3::X * 2.0));
}

#[test]
fn zero_length_start_target() {
    let outcome = TwoBone::new().solve(&BENT, BENT.root);
    let [_, tip] = posed(&BENT, &outcome);
    // Bones of equal length can fold completely.
    assert!(outcome.status == TwoBoneStatus::Reached && is_near(tip, BENT.root), "{outcome:?}");
}

#[test]
fn zero_length_bone_chain() {
    for limb in [
        Limb { middle: BENT.root, ..BENT },
        Limb { tip: BENT.middle, ..BENT },
        Limb { root: Vec3::ONE, middle: Vec3::ONE, tip: Vec3::ONE },
    ] {
        posed(&limb, &TwoBone::new().solve(&limb, Vec3::new(0.5, 0.1, 0.2)));
    }
}
