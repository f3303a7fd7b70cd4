//! Closed-form two-bone solver, checked by forward kinematics in f64.

use crate::common::Rng;
use crate::common::exact::*;
use aim_runtime::glam::{Quat, Vec3};
use aim_runtime::ik::{Hinge, Limb, TwoBone, TwoBoneOutcome, TwoBoneStatus};

/// Returns the joints of a limb with its bones rotated, after checking the outcome against them.
fn posed(limb: &Limb, target: Vec3, outcome: &TwoBoneOutcome) -> [Point; 3] {
    for turn in [outcome.upper, outcome.lower] {
        assert!(turn.is_finite() && (turn.length() - 1.0).abs() < 1e-6, "{turn}");
    }
    let [root, middle, tip] = [limb.root, limb.middle, limb.tip].map(exact);
    let new_middle = plus(root, turned(outcome.upper, minus(middle, root)));
    let new_tip = plus(new_middle, turned(outcome.lower, minus(tip, middle)));
    let size = length(minus(middle, root)) + length(minus(tip, middle));
    let largest = [root, middle, tip, exact(target)].concat().iter().fold(size, |most, x| x.abs().max(most));
    let rounding = 1e-6 * largest;
    for (reported, is) in [(outcome.limb.middle, new_middle), (outcome.limb.tip, new_tip)] {
        assert!(length(minus(exact(reported), is)) <= rounding, "{reported} is said, {is:?} is so");
    }
    let error = length(minus(new_tip, exact(target)));
    assert!((f64::from(outcome.error) - error).abs() <= rounding);
    if outcome.status == TwoBoneStatus::Reached {
        assert!(error <= 1e-5 * size + rounding, "{error} of {size}");
    }
    [root, new_middle, new_tip]
}

fn any_limb(rng: &mut Rng) -> Limb {
    let root = rng.direction() * rng.between(0.0, 1.0);
    let middle = root + rng.direction() * rng.between(0.05, 1.0);
    Limb { root, middle, tip: middle + rng.direction() * rng.between(0.05, 1.0) }
}

fn bones(limb: &Limb) -> [f32; 2] {
    [limb.root.distance(limb.middle), limb.middle.distance(limb.tip)]
}

/// Returns a random target between folded and straight.
fn within_reach(rng: &mut Rng, limb: &Limb) -> Vec3 {
    let [upper, lower] = bones(limb);
    let (near, far) = ((upper - lower).abs(), upper + lower);
    limb.root + rng.direction() * (near + (far - near) * rng.between(1e-6, 1.0 - 1e-6))
}

#[test]
fn a_million_reachable_targets_are_reached() {
    let mut rng = Rng(1);
    let mut worst = 0.0_f64;
    for _ in 0..1_000_000 {
        let limb = any_limb(&mut rng);
        let target = within_reach(&mut rng, &limb);
        let solver = if rng.below(2) == 0 { TwoBone::new() } else { TwoBone::new().with_pole(rng.direction() * 2.0) };
        let outcome = solver.solve(&limb, target);
        assert_eq!(outcome.status, TwoBoneStatus::Reached, "{limb:?} {target}");
        let [_, _, tip] = posed(&limb, target, &outcome);
        worst = worst.max(length(minus(tip, exact(target))) / f64::from(limb.length()));
    }
    println!("worst error {worst:.1e} of the limb");
    assert!(worst <= 1e-5, "{worst:e}");
}

#[test]
fn the_middle_joint_lies_on_the_side_of_the_pole() {
    let mut rng = Rng(2);
    for _ in 0..20_000 {
        let limb = any_limb(&mut rng);
        let (target, pole) = (within_reach(&mut rng, &limb), rng.direction() * 3.0);
        let outcome = TwoBone::new().with_pole(pole).solve(&limb, target);
        let [root, middle, tip] = posed(&limb, target, &outcome);
        let way = minus(tip, root);
        let (side, wanted) = (cross(way, minus(middle, root)), cross(way, minus(exact(pole), root)));
        if length(side) > 1e-2 * length(way) && length(wanted) > 1e-2 * length(way) {
            assert!(dot(side, wanted) > (1.0 - 1e-4) * length(side) * length(wanted), "{limb:?} {target} {pole}");
        }
    }
}

/// Without other settings, the limb's plane follows the shortest rotation. A target at the tip moves nothing.
#[test]
fn the_plane_of_the_animation_is_kept() {
    let mut rng = Rng(3);
    for _ in 0..20_000 {
        let limb = any_limb(&mut rng);
        let stays = TwoBone::new().solve(&limb, limb.tip);
        let [_, middle, _] = posed(&limb, limb.tip, &stays);
        if limb.root.distance(limb.tip) > 0.05 * limb.length() {
            assert!(length(minus(middle, exact(limb.middle))) < 2e-3 * f64::from(limb.length()), "{limb:?}");
        }
    }
}

/// Small steps of the target are small steps of the limb, also while the target circles around the root.
#[test]
fn small_steps_of_the_target_move_the_limb_little() {
    let limb = Limb { root: Vec3::ZERO, middle: Vec3::new(0.0, -0.45, 0.05), tip: Vec3::new(0.0, -0.85, 0.0) };
    let mut before: Option<Limb> = None;
    for step in 0_u16..2000 {
        let angle = f32::from(step) * 0.0015 - 1.5;
        let distance = 0.5 + 0.3 * (3.0 * angle).sin();
        let target = Vec3::new(angle.sin(), -angle.cos(), 0.2) * distance;
        let outcome = TwoBone::new().solve(&limb, target);
        if let Some(before) = before {
            assert!(before.middle.distance(outcome.limb.middle) < 0.02, "step {step}");
        }
        before = Some(outcome.limb);
    }
}

#[test]
fn no_knee_bends_backwards() {
    let mut rng = Rng(4);
    for _ in 0..20_000 {
        let (limb, least) = (any_limb(&mut rng), rng.between(0.0, 0.5));
        let hinge = Hinge { axis: rng.direction(), least_rad: least, most_rad: least + rng.between(0.1, 2.0) };
        let target = limb.root + rng.direction() * rng.between(0.0, 2.0);
        let outcome = TwoBone::new().with_hinge(hinge).solve(&limb, target);
        let [root, middle, tip] = posed(&limb, target, &outcome);
        // The axis is fixed to the upper bone. Orthogonalised against the limb, as in the solver.
        let along = minus(exact(limb.tip), exact(limb.root));
        let axis = exact(hinge.axis);
        let axis = minus(axis, along.map(|c| c * dot(axis, along) / dot(along, along)));
        let axis = turned(outcome.upper, axis.map(|c| c / length(axis)));
        let flat = |bone: Point| minus(bone, axis.map(|c| c * dot(bone, axis)));
        let (upper, lower) = (flat(minus(middle, root)), flat(minus(tip, middle)));
        if length(upper).min(length(lower)) < 1e-2 {
            continue;
        }
        let flexion = dot(axis, cross(upper, lower)).atan2(dot(upper, lower));
        let (least, most) = (f64::from(hinge.least_rad), f64::from(hinge.most_rad));
        assert!(flexion > least - 2e-3 && flexion < most + 2e-3, "{flexion} of {least}..{most}: {outcome:?}");
    }
}

#[test]
fn softening_slows_the_approach_to_full_extension() {
    let limb = Limb { root: Vec3::ZERO, middle: Vec3::new(0.5, 0.1, 0.0), tip: Vec3::new(1.0, 0.0, 0.0) };
    let solver = TwoBone::new().with_softening(0.9);
    let reach = |at: f32| solver.solve(&limb, Vec3::X * at * limb.length());
    assert_eq!(reach(0.89).status, TwoBoneStatus::Reached);
    let mut before = 0.0;
    for step in 0_u16..400 {
        let at = 0.8 + 0.005 * f32::from(step);
        let outcome = reach(at);
        let distance = outcome.limb.tip.length() / limb.length();
        // The tip moves on at no more than the target's speed, and never fully straightens the limb.
        assert!(distance > before && distance < 1.0, "{at}: {distance}");
        assert!(step == 0 || distance - before < 0.0051, "{at}: {distance}");
        assert_ne!(outcome.status == TwoBoneStatus::Reached, at > 0.901, "{at}: {outcome:?}");
        before = distance;
    }
}

#[test]
fn stretched_folded_and_weighted() {
    let limb = Limb { root: Vec3::ZERO, middle: Vec3::new(0.5, 0.1, 0.0), tip: Vec3::new(0.8, 0.0, 0.0) };
    let far = TwoBone::new().solve(&limb, Vec3::Y * 3.0);
    let [root, _, tip] = posed(&limb, Vec3::Y * 3.0, &far);
    assert_eq!(far.status, TwoBoneStatus::TooFar);
    assert!(length(minus(tip, [0.0, f64::from(limb.length()), 0.0])) < 1e-5, "{tip:?}");
    let near = TwoBone::new().solve(&limb, Vec3::Y * 0.01);
    assert_eq!(near.status, TwoBoneStatus::TooNear);
    let [upper, lower] = bones(&limb);
    let [_, _, tip] = posed(&limb, Vec3::Y * 0.01, &near);
    assert!((length(minus(tip, root)) - f64::from(upper - lower)).abs() < 1e-5, "{tip:?}");
    let target = Vec3::new(0.3, 0.4, 0.2);
    for (weight, is) in [(0.0, 0.0), (-0.1, 0.0), (0.5, 0.5), (1.0, 1.0), (1.1, 1.0), (f32::NAN, 0.0)] {
        let outcome = TwoBone::new().with_weight(weight).solve(&limb, target);
        posed(&limb, target, &outcome);
        let full = TwoBone::new().solve(&limb, target);
        let part = outcome.upper.angle_between(Quat::IDENTITY) / full.upper.angle_between(Quat::IDENTITY);
        assert!((part - is).abs() < 1e-3, "{weight}: {part}");
    }
}

/// For inputs of any bits, rotations are finite and unit and the status is right.
#[test]
fn random_bits_are_harmless() {
    let odd = [f32::NAN, f32::INFINITY, -f32::INFINITY, 1e20, -1e20, 1e-20, 1e-40, 3e38, 0.0, 1.0];
    let mut rng = Rng(5);
    for round in 0..200_000 {
        let mut numbers: [f32; 15] = core::array::from_fn(|_| rng.between(-1.0, 1.0));
        for _ in 0..1 + rng.below(4) {
            numbers[rng.below(15)] = odd[rng.below(odd.len())];
        }
        if round % 3 == 0 {
            numbers = core::array::from_fn(|_| odd[rng.below(odd.len())]);
        }
        let [root, middle, tip, target, pole] = [0, 3, 6, 9, 12].map(|at| Vec3::from_slice(&numbers[at..]));
        let limb = Limb { root, middle, tip };
        let hinge = Hinge { axis: pole, least_rad: numbers[0], most_rad: numbers[4] };
        for solver in [
            TwoBone::new(),
            TwoBone::new().with_pole(pole),
            TwoBone::new().with_hinge(hinge).with_softening(numbers[1]).with_twist(numbers[2]).with_weight(numbers[3]),
        ] {
            let outcome = solver.solve(&limb, target);
            for turn in [outcome.upper, outcome.lower] {
                assert!(turn.is_finite() && (turn.length() - 1.0).abs() < 1e-6, "{limb:?} {target} {outcome:?}");
            }
            if outcome.status == TwoBoneStatus::Reached {
                assert!(outcome.error <= 1.1e-5 * limb.length(), "{limb:?} {target} {outcome:?}");
            }
        }
    }
}

#[test]
fn bones_without_length_are_handled() {
    let point = Vec3::new(0.1, 0.2, 0.3);
    let none = TwoBone::new().solve(&Limb { root: point, middle: point, tip: point }, Vec3::X);
    assert_eq!((none.status, none.upper, none.lower), (TwoBoneStatus::Degenerate, Quat::IDENTITY, Quat::IDENTITY));
    // One bone is left, which can at least point at the target.
    let one = Limb { root: point, middle: point, tip: point + Vec3::X };
    let outcome = TwoBone::new().solve(&one, point + Vec3::Y);
    posed(&one, point + Vec3::Y, &outcome);
    assert_eq!(outcome.status, TwoBoneStatus::Reached);
    let outcome = TwoBone::new().solve(&one, point);
    posed(&one, point, &outcome);
    assert_eq!(outcome.status, TwoBoneStatus::TooNear);
}
