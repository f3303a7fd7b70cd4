//! Cases missing from other solvers' tests, in which these solvers fail.

use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::{Pose, Settings, Status};

use super::*;

/// Twist and weight together, for which another solver takes the long way round in a quarter of the cases. Half the
/// weight is half the arc, upright or not, and a correction is never larger than the whole rotation.
#[test]
fn twist_times_weight() {
    let mut rng = Rng(41);
    for case in 0..2000 {
        let mut rig = NumericRig::ball(THUG);
        let solver = [Solver::Exact, Solver::Natural][case % 2];
        rig.infos[0] = rig.infos[0].with_upright(rng.between(0.0, 1.0));
        let pose = [bone(&THUG, rng.turn(0.6), Vec3::ZERO)];
        let target = rng.direction() * 3.0;
        let weight = rng.between(0.05, 1.0);
        let settings = Settings::default().with_weight(weight).with_solver(solver);
        let posed = Pose::new(pose.to_vec()).with_up(Vec3::Y);
        let outcome = rig.snap_with(&posed, target, &settings);
        let [animated, now] = [animated64(&rig, &pose, 0), seen64(&rig, &pose, 0)];
        let whole = angle_to64(animated, target);
        assert!(sound(&rig), "case {case}");
        // The poles are out of reach.
        if outcome.status == Status::Reached {
            let part = angle_to64(now, target);
            assert!((part - (1.0 - f64::from(weight)) * whole).abs() < 2e-3, "case {case}: {part} of {whole}");
        }
    }
}

/// Near targets are still aimed at. Another solver ignores targets nearer than 10 cm, even for a rig in centimetres.
#[test]
fn near_targets() {
    for (world, parent, similar) in worlds() {
        // Far from the origin, f32 resolves nothing finer.
        if world.starts_with("translated") {
            continue;
        }
        for near in [0.1, 1e-2, 1e-3, 1e-4] {
            let pose = moved(&parent, &alone());
            let target = parent.transform_point3(Vec3::new(-near, 0.0, -near));
            for (rig, outcome, case) in solve_by_every_solver(&NumericRig::ball(THUG), &pose, target, &world) {
                assert_eq!(outcome.status, Status::Reached, "{case}, {near}");
                let heading = rig.joints[0].heading();
                assert!(!similar || (heading - 45.0 * DEG).abs() < 2e-3, "{case}, {near}: {heading}");
            }
        }
        // A whole chain, with a target right in front of the eye.
        let rig = person();
        let pose = moved(&parent, &upright(&rig));
        let eye = upright(&rig)[0].translation;
        for near in [0.1, 1e-2, 5e-3] {
            let target = Vec3::from(eye) + Quat::from_rotation_y(0.2) * WORLD[0] * near;
            assert_reached(&rig, &pose, parent.transform_point3(target), &format!("{world}, {near}"));
        }
    }
}

/// Each number of a call replaced by each awkward value, one at a time.
#[test]
fn awkward_numbers() {
    const AWKWARD: [f32; 12] = [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        1e20,
        -1e20,
        1e-20,
        -1e-20,
        1e-42,
        -1e-42,
        f32::MAX,
        f32::MIN_POSITIVE,
        -0.0,
    ];
    let good = Vec3::new(-1.0, 1.8, -2.0);
    for solver in SOLVERS {
        for awkward in AWKWARD {
            // Twelve numbers of each of three joints, three of the target, then dt, weight, attention and tolerance.
            for which in 0..3 * 12 + 3 + 4 {
                let mut rig = person();
                let mut settings = Settings::default().with_solver(solver);
                let (mut target, mut dt, mut pose) = (good, DT, upright(&rig));
                rig.aim_with(&Pose::new(pose.clone()), good, DT, &settings);
                let before = rig.joints.clone();
                match which {
                    0..36 => {
                        let mut numbers = pose[which / 12].to_cols_array();
                        numbers[which % 12] = awkward;
                        pose[which / 12] = Affine3A::from_cols_array(&numbers);
                    }
                    36..39 => target[which - 36] = awkward,
                    39 => dt = awkward,
                    40 => settings.weight = awkward,
                    41 => settings.attention = awkward,
                    _ => settings.tolerance = awkward,
                }
                let outcome = rig.aim_with(&Pose::new(pose.clone()), target, dt, &settings);
                let case = format!("{solver:?}, {awkward} as {which}: {outcome:?}");
                assert_within_limits(&rig, &before, if dt > 0.0 { dt.min(0.1) } else { 0.0 }, &case);
                assert!(
                    (-1.0..=1.0).contains(&outcome.aim)
                        && (0.0..=core::f32::consts::PI + 1e-6).contains(&outcome.remaining),
                    "{case}"
                );
                if which < 39 && !awkward.is_finite() {
                    assert_eq!((outcome.status, &rig.joints), (Status::Degenerate, &before), "{case}");
                }
                // Afterwards valid input works as usual.
                let settings = Settings::default().with_solver(solver);
                let pose = upright(&rig);
                let outcome = aim_for(&mut rig, &pose, good, 3.0, &settings);
                assert_eq!(outcome.status, Status::Reached, "{case}");
            }
        }
    }
}

/// Weighted corrections are unit; in another solver they are off by 3e-4.
#[test]
fn weighted_corrections_are_unit() {
    let mut rng = Rng(43);
    for solver in SOLVERS {
        let mut rig = person();
        for step in 0..=512_u16 {
            let settings = Settings::default().with_solver(solver).with_weight(f32::from(step) / 512.0);
            let posed = Pose::new(animated(&rig, &mut rng, 0.3));
            rig.snap_with(&posed, Vec3::new(0.0, 1.6, 0.0) + rng.direction() * 2.0, &settings);
            assert!(sound(&rig), "{solver:?}, {step}");
        }
    }
}
