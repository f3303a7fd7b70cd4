use aim_runtime::glam::{Quat, Vec3};
use aim_runtime::ik::{Ccd, CcdJoint, CcdLimit, CcdOutcome, CcdStatus};

use crate::common::Rng;
use crate::common::exact::*;

/// Returns the tip's position with the joints rotated, by the definitions, and checks the outcome against it.
fn posed(joints: &[CcdJoint], tip: Vec3, target: Vec3, outcome: &CcdOutcome) -> Point {
    let mut at = exact(joints[0].position);
    let mut size = 0.0;
    for (index, joint) in joints.iter().enumerate() {
        assert!(is_sound(joint.turn) && is_sound(joint.added()));
        let end = joints.get(index + 1).map_or(tip, |next| next.position);
        let bone = minus(exact(end), exact(joint.position));
        at = plus(at, turned(joint.turn, bone));
        size += length(bone);
    }
    assert!(length(minus(at, exact(outcome.tip))) < 1e-5 * size);
    let error = length(minus(at, exact(target)));
    assert!((f64::from(outcome.error) - error).abs() < 1e-5 * size);
    at
}

/// Returns the largest violation of a limit, radians, from each joint's rotation relative to the one before it.
fn beyond_limits(joints: &[CcdJoint]) -> f64 {
    let mut worst = 0.0_f64;
    let mut before = Quat::IDENTITY;
    for joint in joints {
        let added = before.conjugate() * joint.turn;
        before = joint.turn;
        match joint.limit {
            CcdLimit::Free => {}
            CcdLimit::Ball { most_rad } => worst = worst.max(angle_of(added) - f64::from(most_rad)),
            CcdLimit::Hinge { axis, least_rad, most_rad } => {
                let [x, y, z, w] = added.to_array().map(f64::from);
                let axis = exact(axis).map(|c| c / length(exact(axis)));
                let along = dot([x, y, z], axis);
                // The rotation must be about the hinge's axis alone.
                worst = worst.max(length(cross([x, y, z], axis)));
                let angle = 2.0 * (along * w.signum()).atan2(w.abs());
                worst = worst.max(f64::from(least_rad) - angle).max(angle - f64::from(most_rad));
            }
        }
    }
    worst
}

fn any_chain(rng: &mut Rng, limited: bool) -> (Vec<CcdJoint>, Vec3) {
    let mut at = rng.direction();
    let joints = (0..2 + rng.below(5)).map(|_| {
        let limit = match rng.below(3) {
            _ if !limited => CcdLimit::Free,
            0 => CcdLimit::Ball { most_rad: rng.between(0.0, 2.0) },
            1 => {
                let least_rad = rng.between(-1.5, 0.5);
                CcdLimit::Hinge { axis: rng.direction() * 2.0, least_rad, most_rad: least_rad + rng.between(0.0, 2.0) }
            }
            _ => CcdLimit::Free,
        };
        let joint = CcdJoint::new(at).with_limit(limit);
        at += rng.direction() * rng.between(0.1, 1.0);
        joint
    });
    let joints = joints.collect();
    (joints, at)
}

fn bones(joints: &[CcdJoint], tip: Vec3) -> Vec<f32> {
    let ends = joints.iter().skip(1).map(|joint| joint.position).chain([tip]);
    joints.iter().zip(ends).map(|(joint, end)| joint.position.distance(end)).collect()
}

/// Without limits, nearly every reachable target is met; the others still converge, slowly.
#[test]
fn reachable_targets_are_reached() {
    for (iterations, share) in [(50, 0.84), (200, 0.96)] {
        let mut rng = Rng(1);
        let (mut met, mut passes) = (0, 0);
        for _ in 0..5000 {
            let (mut joints, tip) = any_chain(&mut rng, false);
            let bones = bones(&joints, tip);
            let (longest, sum) = (bones.iter().fold(0.0, |a: f32, &b| a.max(b)), bones.iter().sum::<f32>());
            let near = (2.0 * longest - sum).max(0.0);
            let target = joints[0].position + rng.direction() * (near + (sum - near) * rng.between(0.05, 0.95));
            let outcome = Ccd::new().with_iterations(iterations).solve(&mut joints, tip, target);
            let at = posed(&joints, tip, target, &outcome);
            let is_met = outcome.status == CcdStatus::Reached;
            assert!(is_met || outcome.status == CcdStatus::IterationLimit, "{outcome:?}");
            // Up to rounding errors.
            let of_tolerance = (length(minus(at, exact(target))) - 2e-6) / (1e-4 * f64::from(sum));
            assert!(if is_met { of_tolerance <= 1.0 } else { of_tolerance > 0.9 }, "{outcome:?}");
            (met, passes) = (met + u32::from(is_met), passes + outcome.iterations);
        }
        println!("{met} of 5000 met in {iterations} iterations at most, {} on average", f64::from(passes) / 5000.0);
        assert!(f64::from(met) > share * 5000.0);
    }
}

#[test]
fn limits_hold() {
    let mut rng = Rng(2);
    let mut worst = 0.0_f64;
    let mut statuses = [0; 3];
    for _ in 0..20_000 {
        let (mut joints, tip) = any_chain(&mut rng, true);
        let target = joints[0].position + rng.direction() * rng.between(0.0, 4.0);
        let iterations = 1 + u32::try_from(rng.below(60)).unwrap();
        let outcome = Ccd::new().with_iterations(iterations).solve(&mut joints, tip, target);
        posed(&joints, tip, target, &outcome);
        worst = worst.max(beyond_limits(&joints));
        assert!(outcome.iterations <= iterations);
        match outcome.status {
            CcdStatus::Reached => statuses[0] += 1,
            CcdStatus::IterationLimit => {
                assert_eq!(outcome.iterations, iterations);
                statuses[1] += 1;
            }
            _ => statuses[2] += 1,
        }
    }
    println!("beyond limits {worst:.1e}; reached, out of iterations, stuck: {statuses:?}");
    assert!(worst < 1e-5);
    assert!(statuses.iter().all(|&count| count > 100), "{statuses:?}");
}

/// The tip never ends further from the target than in the animation.
#[test]
fn the_tip_never_ends_further_away() {
    let mut rng = Rng(3);
    for _ in 0..5000 {
        let (mut joints, tip) = any_chain(&mut rng, false);
        let target = joints[0].position + rng.direction() * rng.between(0.0, 6.0);
        let outcome = Ccd::new().solve(&mut joints, tip, target);
        assert!(outcome.error <= tip.distance(target) * (1.0 + 1e-5) + 1e-6, "{outcome:?}");
    }
}

/// A straight chain with its target on its own line, where no single joint sees a way to get nearer.
#[test]
fn a_straight_chain_bends() {
    for count in [2_u8, 3, 5] {
        let mut joints: Vec<_> = (0..count).map(|i| CcdJoint::new(Vec3::X * f32::from(i))).collect();
        let (tip, target) = (Vec3::X * f32::from(count), Vec3::X * (0.6 * f32::from(count)));
        let outcome = Ccd::new().with_iterations(200).solve(&mut joints, tip, target);
        assert_eq!(outcome.status, CcdStatus::Reached, "{count}: {outcome:?}");
        let far = Ccd::new().solve(&mut joints, tip, tip * 2.0);
        assert_eq!((far.status, far.tip), (CcdStatus::Stuck, tip), "stretched already");
    }
}

/// In a straight chain, fully stiff joints are not bent, and nearly stiff ones only a little.
#[test]
fn stiff_joints_are_not_bent_out_of_the_straight() {
    let hinge = |least_rad, most_rad| CcdLimit::Hinge { axis: Vec3::Z, least_rad, most_rad };
    for limit in [CcdLimit::Free, hinge(-2.5, 2.5), hinge(-2.5, 0.0)] {
        let others = if limit == CcdLimit::Free { limit } else { hinge(-2.5, 2.5) };
        let chain = |count: u8, stiffness: f32| -> Vec<_> {
            let joint = |at: u8| CcdJoint::new(Vec3::X * f32::from(at)).with_limit(others);
            (0..count).map(|at| joint(at).with_stiffness(stiffness)).collect()
        };
        let mut joints = chain(2, 1.0);
        joints[1].limit = limit;
        let (tip, target) = (Vec3::X * 2.0, Vec3::X * 1.5);
        let outcome = Ccd::new().solve(&mut joints, tip, target);
        assert_eq!((outcome.status, outcome.tip, outcome.error), (CcdStatus::Stuck, tip, 0.5));
        assert!(joints.iter().all(|joint| joint.turn == Quat::IDENTITY), "{joints:?}");
        for stiff in [0, 1] {
            let mut joints = chain(3, 0.0);
            joints[stiff] = joints[stiff].with_limit(limit).with_stiffness(0.99);
            let (tip, target) = (Vec3::X * 3.0, Vec3::X * 2.2);
            let outcome = Ccd::new().with_iterations(200).solve(&mut joints, tip, target);
            assert_eq!(outcome.status, CcdStatus::Reached, "{limit:?}: {outcome:?}");
            let turned = angle_of(joints[stiff].added());
            assert!(turned < 0.03, "{limit:?}: {turned}");
        }
        let mut joints = chain(2, 0.0);
        joints[1].limit = limit;
        let outcome = Ccd::new().with_iterations(200).solve(&mut joints, tip, target);
        assert_eq!(outcome.status, CcdStatus::Reached, "{limit:?}: {outcome:?}");
    }
}

/// A trial bend that does not bring the tip nearer is undone.
#[test]
fn a_useless_bend_is_undone() {
    let (tip, target) = (Vec3::X * 2.0, Vec3::X * 1.5);
    let mut joints = [CcdJoint::new(Vec3::ZERO), CcdJoint::new(Vec3::X).with_stiffness(1.0)];
    for iterations in [1, 2, 50] {
        let outcome = Ccd::new().with_iterations(iterations).solve(&mut joints, tip, target);
        posed(&joints, tip, target, &outcome);
        assert!(outcome.error <= 0.5 && outcome.status != CcdStatus::Reached, "{outcome:?}");
        let [x, y, z] = outcome.tip.to_array();
        assert!((x - 2.0).abs() < 1e-6 && y.abs() < 1e-6 && z.abs() < 1e-6, "{outcome:?}");
    }
    let mut rng = Rng(11);
    for _ in 0..20_000 {
        let count = 1 + rng.below(4);
        let line = rng.direction();
        let (mut joints, mut end) = (Vec::new(), 0.0);
        for _ in 0..count {
            let limit = match rng.below(3) {
                0 => CcdLimit::Free,
                1 => CcdLimit::Ball { most_rad: rng.between(0.0, 0.2) },
                _ => CcdLimit::Hinge {
                    axis: rng.direction(),
                    least_rad: -rng.between(0.0, 0.2),
                    most_rad: rng.between(0.0, 0.2),
                },
            };
            let stiffness = [0.0, rng.between(0.0, 1.0), 1.0][rng.below(3)];
            joints.push(CcdJoint::new(line * end).with_limit(limit).with_stiffness(stiffness));
            end += rng.between(0.2, 1.0);
        }
        let (tip, target) = (line * end, line * (end * rng.between(0.1, 0.999)));
        let iterations = 1 + u32::try_from(rng.below(60)).unwrap();
        let outcome = Ccd::new().with_iterations(iterations).solve(&mut joints, tip, target);
        posed(&joints, tip, target, &outcome);
        assert!(beyond_limits(&joints) < 1e-5);
        assert!(outcome.error <= tip.distance(target) + 1e-5, "{outcome:?}, {} of {joints:?}", tip.distance(target));
        assert!(joints.iter().all(|joint| joint.stiffness < 1.0 || angle_of(joint.added()) < 1e-6), "{joints:?}");
    }
}

/// If a chain's length exceeds the range of f32, no rotations can be found.
#[test]
fn a_chain_of_infinite_length_is_degenerate() {
    let mut joints = [CcdJoint::new(Vec3::ZERO), CcdJoint::new(Vec3::X * 3e38)];
    let outcome = Ccd::new().solve(&mut joints, Vec3::ZERO, Vec3::Y);
    assert_eq!((outcome.status, outcome.tip, outcome.error), (CcdStatus::Degenerate, Vec3::ZERO, 1.0));
    assert!(joints.iter().all(|joint| joint.turn == Quat::IDENTITY));
}

#[test]
fn the_status_names_the_limit() {
    let chain = || {
        let elbow = CcdLimit::Hinge { axis: Vec3::Z, least_rad: 0.0, most_rad: 1.0 };
        [
            CcdJoint::new(Vec3::ZERO).with_limit(CcdLimit::Ball { most_rad: 0.5 }),
            CcdJoint::new(Vec3::new(1.0, -0.1, 0.0)).with_limit(elbow),
        ]
    };
    let tip = Vec3::new(2.0, 0.0, 0.0);
    let mut joints = chain();
    let outcome = Ccd::new().solve(&mut joints, tip, Vec3::new(1.7, 0.6, 0.0));
    assert_eq!(outcome.status, CcdStatus::Reached);
    assert!(outcome.at_limit.is_empty());
    let mut joints = chain();
    let outcome = Ccd::new().solve(&mut joints, tip, Vec3::new(-2.0, 0.5, 0.0));
    assert_eq!(outcome.status, CcdStatus::Stuck);
    assert_eq!(outcome.at_limit.iter().collect::<Vec<_>>(), [0, 1]);
    let mut joints = chain();
    let outcome = Ccd::new().with_iterations(1).with_tolerance(0.0).solve(&mut joints, tip, Vec3::new(1.7, 0.6, 0.0));
    assert_eq!((outcome.status, outcome.iterations), (CcdStatus::IterationLimit, 1));
    let nothing = Ccd::new().solve(&mut [], tip, tip);
    assert_eq!(nothing.status, CcdStatus::Degenerate);
    let mut point = [CcdJoint::new(tip), CcdJoint::new(tip)];
    assert_eq!(Ccd::new().solve(&mut point, tip, Vec3::ZERO).status, CcdStatus::Degenerate);
}

/// A chain in centimetres behaves like one in metres.
#[test]
fn results_do_not_depend_on_the_scale() {
    let mut rng = Rng(4);
    for _ in 0..300 {
        let (mut joints, tip) = any_chain(&mut rng, true);
        let target = joints[0].position + rng.direction();
        let outcome = Ccd::new().solve(&mut joints, tip, target);
        // Scaled by a power of two, the result has the same bits.
        let mut large = joints.clone();
        large.iter_mut().for_each(|joint| joint.position *= 128.0);
        let other = Ccd::new().solve(&mut large, tip * 128.0, target * 128.0);
        assert_eq!((outcome.status, outcome.iterations), (other.status, other.iterations));
        assert!(joints.iter().zip(&large).all(|(a, b)| a.turn == b.turn));
    }
}

#[test]
fn random_bits_are_harmless() {
    let mut rng = Rng(5);
    for _ in 0..50_000 {
        let n: [f32; 30] = numbers(&mut rng);
        let v = |at: usize| Vec3::from_slice(&n[at..]);
        let limits = [
            CcdLimit::Hinge { axis: v(0), least_rad: n[3], most_rad: n[4] },
            CcdLimit::Ball { most_rad: n[5] },
            CcdLimit::Free,
        ];
        let mut joints: Vec<_> = (0..3).map(|i| CcdJoint::new(v(6 + 3 * i)).with_limit(limits[rng.below(3)])).collect();
        let ccd = Ccd::new().with_tolerance(n[21]).with_iterations(10);
        let outcome = ccd.solve(&mut joints, v(15), v(18));
        for joint in &joints {
            assert!(is_sound(joint.turn), "{joints:?} {outcome:?}");
        }
        let is_finite = outcome.error.is_finite() && outcome.tip.is_finite();
        assert!(
            is_finite || outcome.status == CcdStatus::Degenerate || n.iter().any(|x| x.abs() > 1e37),
            "{outcome:?}"
        );
    }
}

/// Returns a nearly straight leg below a leaning pelvis: hip, knee, ankle.
fn leg(bend: f32) -> ([CcdJoint; 3], Vec3) {
    let knee = CcdLimit::Hinge { axis: Vec3::X, least_rad: -bend, most_rad: 2.4 };
    let joints = [
        CcdJoint::new(Vec3::new(0.0, 1.0, 0.0)).with_limit(CcdLimit::Ball { most_rad: 0.3 }).with_stiffness(0.9),
        CcdJoint::new(Vec3::new(0.1, 0.9, 0.0)).with_limit(CcdLimit::Ball { most_rad: 1.6 }),
        CcdJoint::new(Vec3::new(0.1, 0.5, 0.4 * bend)).with_limit(knee),
    ];
    (joints, Vec3::new(0.1, 0.1, 0.0))
}

/// A nearly straight leg steps up: in one iteration with the two-bone step, in over thirty on average without it.
#[test]
fn a_leg_goes_up_a_step_by_two_bones() {
    let (mut with, mut without) = (0, 0);
    for step in [0.05, 0.12, 0.2, 0.3] {
        for bend in [0.0, 0.01, 0.05] {
            let target = Vec3::new(0.1, 0.1 + step, 0.15);
            let (mut joints, tip) = leg(bend);
            let plain = Ccd::new().solve(&mut joints, tip, target);
            posed(&joints, tip, target, &plain);
            joints[1] = joints[1].with_two_bones();
            let stepped = Ccd::new().solve(&mut joints, tip, target);
            posed(&joints, tip, target, &stepped);
            assert!(beyond_limits(&joints) < 1e-5);
            assert_eq!(stepped.status, CcdStatus::Reached, "{step} {bend}");
            assert_eq!(stepped.iterations, 1, "{stepped:?}");
            (with, without) = (with + stepped.iterations, without + plain.iterations);
        }
    }
    println!("{with} iterations by two bones, {without} without, of 12 steps");
    assert!(with * 30 < without);
}

/// With the two-bone step, a free chain of two bones always takes one iteration.
#[test]
fn two_bones_alone_take_one_iteration() {
    let mut rng = Rng(8);
    for _ in 0..5000 {
        let root = rng.direction();
        let middle = root + rng.direction() * rng.between(0.2, 1.0);
        let tip = middle + rng.direction() * rng.between(0.2, 1.0);
        let [upper, lower] = [middle.distance(root), tip.distance(middle)];
        let near = (upper - lower).abs();
        let target = root + rng.direction() * (near + (upper + lower - near) * rng.between(0.02, 0.98));
        let mut joints = [CcdJoint::new(root).with_two_bones(), CcdJoint::new(middle)];
        let outcome = Ccd::new().solve(&mut joints, tip, target);
        posed(&joints, tip, target, &outcome);
        assert_eq!((outcome.status, outcome.iterations), (CcdStatus::Reached, 1), "{outcome:?}");
    }
}

/// Limits hold and no call ends farther away, for any stiffness and with two-bone steps at any joint.
#[test]
fn limits_hold_with_stiffness_and_two_bones() {
    let mut rng = Rng(9);
    for _ in 0..20_000 {
        let (mut joints, tip) = any_chain(&mut rng, true);
        for joint in &mut joints {
            joint.stiffness = [0.0, rng.between(0.0, 1.0), 1.0, f32::NAN][rng.below(4)];
            joint.is_two_bone = rng.below(3) == 0;
        }
        let target = joints[0].position + rng.direction() * rng.between(0.0, 4.0);
        let outcome = Ccd::new().solve(&mut joints, tip, target);
        posed(&joints, tip, target, &outcome);
        assert!(beyond_limits(&joints) < 1e-5, "{joints:?}");
    }
}

/// Stiff joints leave the movement to others: the elbow bends before the shoulder turns.
#[test]
fn stiff_joints_move_later() {
    let mut rng = Rng(10);
    let mut less = 0;
    for _ in 0..500 {
        let (joints, tip) = any_chain(&mut rng, false);
        let target = tip + rng.direction() * 0.3;
        let shoulder = |stiffness: f32| {
            let mut joints = joints.clone();
            joints[0].stiffness = stiffness;
            let outcome = Ccd::new().with_iterations(400).solve(&mut joints, tip, target);
            (outcome.status == CcdStatus::Reached).then(|| angle_of(joints[0].turn))
        };
        let (Some(loose), Some(stiff)) = (shoulder(0.0), shoulder(0.9)) else { continue };
        less += u32::from(stiff <= loose + 1e-4);
        if let Some(fixed) = shoulder(1.0) {
            assert!(fixed < 1e-6, "{fixed}");
        }
    }
    println!("{less} of 500 move the shoulder less");
    assert!(less > 350);
}
