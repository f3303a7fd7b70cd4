use aim::animation::{AimChain, Corrections, GizmoKind, GizmoLine, Gizmos, Transform};
use aim::glam::{Affine3A, DVec3, Quat, Vec3};
use aim::{AimRig, DynAim, Outcome, Rig, Settings, Solver};
use aim_animation_tests::Hero;

use crate::glue::{Character, model, parents};

const LENGTH: f32 = 0.3;
/// Up, forward and left axes of every bone.
const AXES: [DVec3; 3] = [DVec3::X, DVec3::Y, DVec3::Z];

struct Drawn {
    outcome: Outcome,
    corrections: Vec<Quat>,
    lines: Vec<GizmoLine>,
}

/// Aims a character at a target in its armature's space, and returns the character with the lines drawn for it.
fn drawn(armature: Transform, place: Affine3A, target: Vec3) -> (Character, Drawn) {
    let mut character = Character::new(armature, 0.3);
    let right = character.bone("right_eye");
    let chain =
        AimChain::named(&character.skeleton, Hero::RIG).unwrap().with_other_eye(right).unwrap().with_up(Vec3::Y);
    let (mut frame, mut aim) = (chain.frame(), DynAim::new(Hero::RIG));
    frame.place = place;
    chain.gather(&mut frame, &mut character.local, &mut character.model).unwrap();
    let target = (place * character.model[0]).transform_point3(target);
    let outcome = aim.snap(&frame.pose(), target, &Settings::default().with_solver(Solver::Exact));
    let corrections = Corrections::from(&aim);
    chain.apply(&frame, corrections, &mut character.local, &mut character.model).unwrap();
    let description = Hero::RIG.description();
    let gizmos =
        Gizmos { chain: &chain, frame: &frame, description: &description, corrections, model: &character.model };
    let lines = gizmos.gazes(2.0).chain(gizmos.axes(0.1)).chain(gizmos.ranges(LENGTH)).collect();
    let corrections = corrections.joints.to_vec();
    (character, Drawn { outcome, corrections, lines })
}

fn wide(v: Vec3) -> DVec3 {
    v.as_dvec3()
}

/// Compared with forward kinematics in f64: gazes and axes are those of the bones, and each point of a rim is where the
/// joint's forward direction points at an end of its range.
#[test]
fn lines_are_where_the_bones_and_their_limits_are() {
    let placed = Affine3A::from_scale_rotation_translation(Vec3::splat(1.5), Quat::from_rotation_y(2.0), Vec3::NEG_X);
    for place in [Affine3A::IDENTITY, placed] {
        for (name, armature) in parents() {
            if name == "uneven" {
                continue;
            }
            let (character, Drawn { corrections, lines, .. }) = drawn(armature, place, Vec3::new(0.7, 1.9, 2.0));
            let in_model = model(&character.skeleton, &character.local);
            let world = |bone: &str| {
                let place = aim::glam::DAffine3::from_cols_array(&place.to_cols_array().map(f64::from));
                place * in_model[character.bone(bone)]
            };
            let bones = ["left_eye", "neck", "spine"].map(world);
            let count = |wanted: fn(&GizmoKind) -> bool| lines.iter().filter(|line| wanted(&line.kind)).count();
            assert_eq!(count(|kind| matches!(kind, GizmoKind::Gaze | GizmoKind::OtherGaze)), 2);
            assert_eq!(count(|kind| matches!(kind, GizmoKind::Axis { .. })), 9);
            assert_eq!(count(|kind| matches!(kind, GizmoKind::Rim { .. })), 3 * 64);
            assert_eq!(count(|kind| matches!(kind, GizmoKind::Edge { .. })), 3 * 4);
            let mut ends = [[0; 4]; 3];
            for line in &lines {
                let (at, direction, long) = match line.kind {
                    GizmoKind::Gaze => (bones[0], bones[0].transform_vector3(DVec3::Y), 2.0),
                    GizmoKind::OtherGaze => {
                        let eye = world("right_eye");
                        (eye, eye.transform_vector3(DVec3::Y), 2.0)
                    }
                    GizmoKind::Axis { joint, axis } => (bones[joint], bones[joint].transform_vector3(AXES[axis]), 0.1),
                    GizmoKind::Rim { joint } | GizmoKind::Edge { joint } => {
                        let at = bones[joint];
                        let way = wide(line.to) - at.translation;
                        assert!((way.length() - f64::from(LENGTH)).abs() < 1e-5, "{name} {line:?}");
                        // The upright neck has a test of its own below.
                        if joint != 1 {
                            let touched = on_the_limits(&at, corrections[joint], way, joint);
                            let rim = u32::from(matches!(line.kind, GizmoKind::Rim { .. }));
                            ends[joint].iter_mut().zip(touched).for_each(|(end, is)| *end += rim * u32::from(is));
                        }
                        continue;
                    }
                    kind => panic!("{kind:?} is new"),
                };
                let to = at.translation + direction.normalize() * long;
                assert!(wide(line.from).distance(at.translation) < 1e-5, "{name} {line:?}");
                assert!(wide(line.to).distance(to) < 2e-5, "{name} {line:?} instead of {to}");
            }
            // The rim is closed, without a gap.
            for joint in 0..3 {
                let is_rim = |line: &&GizmoLine| line.kind == GizmoKind::Rim { joint };
                let rim: Vec<_> = lines.iter().filter(is_rim).collect();
                for (one, next) in rim.iter().zip(rim.iter().cycle().skip(1)) {
                    assert!(one.to.distance(next.from) < 1e-5, "{name} {one:?} {next:?}");
                }
            }
            // Each end accounts for a quarter of the rim; the corners belong to two ends.
            assert!(
                [0, 2].iter().all(|joint| ends[*joint].iter().all(|end| (16..=18).contains(end))),
                "{name} {ends:?}"
            );
        }
    }
}

/// Checks that heading and pitch of a direction from a bone, before its own correction, are at an end of a declared
/// range. Returns at which: the low and the high end of heading, then of pitch.
fn on_the_limits(at: &aim::glam::DAffine3, own: Quat, way: DVec3, joint: usize) -> [bool; 4] {
    let local = own.as_dquat().normalize() * at.matrix3.inverse().mul_vec3(way).normalize();
    let [up, ahead, left] = [local.x, local.y, local.z];
    let angles = [left.atan2(ahead), up.asin()];
    let info = Hero::RIG.description().joints()[joint];
    let ends = [info.heading, info.pitch].map(|range| range.unwrap().map(f64::from));
    let off = |k: usize| (angles[k] - ends[k][0]).abs().min((angles[k] - ends[k][1]).abs());
    let beyond = |k: usize| (ends[k][0] - angles[k]).max(angles[k] - ends[k][1]);
    assert!(off(0).min(off(1)) < 1e-5, "joint {joint}: {angles:?} is at no end of {ends:?}");
    assert!(beyond(0).max(beyond(1)) < 1e-5, "joint {joint}: {angles:?} is beyond {ends:?}");
    [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(k, end)| (angles[k] - ends[k][end]).abs() < 1e-5)
}

/// A joint that a solver has turned to its limit points at the rim, level headings included.
#[test]
fn joints_at_their_limits_are_on_the_rim() {
    for target in
        [Vec3::new(2.0, 2.4, -3.0), Vec3::new(-2.0, 1.0, -2.5), Vec3::new(1.0, 5.0, -1.0), Vec3::new(0.4, -4.0, 0.3)]
    {
        let leaning = Transform::from_rotation(Quat::from_rotation_x(0.5));
        let (character, Drawn { outcome, lines, .. }) = drawn(leaning, Affine3A::IDENTITY, target);
        assert!(outcome.at_limit.contains(1), "{target}: {outcome:?}");
        let neck = model(&character.skeleton, &character.local)[character.bone("neck")];
        let ahead = neck.translation + neck.transform_vector3(DVec3::Y).normalize() * f64::from(LENGTH);
        let rim = lines.iter().filter(|line| line.kind == GizmoKind::Rim { joint: 1 });
        let away = rim.map(|line| {
            let (from, way) = (wide(line.from), wide(line.to - line.from));
            let part = ((ahead - from).dot(way) / way.length_squared().max(1e-12)).clamp(0.0, 1.0);
            (from + way * part).distance(ahead)
        });
        // The distance of a chord of at most 7.5° from its arc.
        let away = away.fold(f64::INFINITY, f64::min);
        assert!(away < f64::from(LENGTH) * 2.2e-3, "{target}: the neck looks {away} beside its rim");
    }
}
