//! Planted feet of a leg made in code, judged by forward kinematics in f64.

use aim_animation::glam::{DAffine3, DVec3, Quat, Vec3};
use aim_animation::{Bone, Figure, Ground, LimbError, Plant, PoseError, Skeleton, Stance, Transform};

use crate::common::exact;

const DT: f32 = 1.0 / 60.0;
/// The ball of the foot.
const BALL: Vec3 = Vec3::new(0.1, 0.0, 0.1);

/// A pelvis and a leg that is bent a little.
fn skeleton() -> Skeleton {
    let at = |x, y, z| Transform::from_translation(Vec3::new(x, y, z));
    Skeleton::new([
        Bone::new("pelvis", None).with_rest(at(0.0, 0.9, 0.0)),
        Bone::new("hip", Some(0)).with_rest(at(0.1, -0.02, 0.0)),
        Bone::new("knee", Some(1)).with_rest(at(0.0, -0.4, 0.08)),
        Bone::new("ankle", Some(2)).with_rest(at(0.0, -0.4, -0.08)),
    ])
    .unwrap()
}

fn foot() -> Plant {
    Plant::new(&skeleton(), [1, 2, 3], BALL).unwrap().with_events("down", "up")
}

fn stance() -> Stance {
    Stance::new(&skeleton(), 0, [foot()]).unwrap()
}

/// Each bone in the world.
fn world(figure: &Figure) -> Vec<DAffine3> {
    let mut model: Vec<DAffine3> = Vec::new();
    for (local, parent) in figure.local().iter().zip(figure.skeleton().parents()) {
        model.push(parent.map_or(exact(local), |parent| model[parent] * exact(local)));
    }
    model.iter().map(|bone| exact(&figure.place) * *bone).collect()
}

/// The ball in the world, by its place in the ankle's space at rest.
fn ball(figure: &Figure) -> DVec3 {
    let in_ankle = BALL.as_dvec3() - DVec3::new(0.1, 0.08, 0.0);
    world(figure)[3].transform_point3(in_ankle)
}

fn level(at: Vec3) -> Ground {
    Ground::new(at.with_y(0.0), Vec3::Y)
}

/// The largest second difference, a second squared.
fn acceleration(ways: &[DVec3]) -> f64 {
    let second = |w: &[DVec3]| (w[2] - 2.0 * w[1] + w[0]).length() / f64::from(DT * DT);
    ways.windows(3).map(second).fold(0.0, f64::max)
}

#[test]
fn a_foot_in_the_air_keeps_its_height_over_the_ground() {
    let (mut stance, mut figure) = (stance(), Figure::new(skeleton()));
    for (x, z) in [(0.0, 0.0), (0.3, 1.0), (-2.0, 5.0)] {
        let slope = |at: Vec3| Ground::new(at.with_y(0.2 * at.x + 0.1 * at.z), Vec3::new(-0.2, 1.0, -0.1));
        figure.place.translation = slope(Vec3::new(x, 7.0, z)).point;
        let mut lift = |figure: &mut Figure, _: f32| {
            figure.turn(2, Quat::from_rotation_x(0.6));
            Ok(())
        };
        stance.feet_mut()[0].reset();
        figure.run(DT, &mut [&mut lift]).unwrap();
        let animated = ball(&figure);
        figure.run(DT, &mut [&mut lift, &mut stance.on(slope)]).unwrap();
        let found = ball(&figure);
        let height = animated.y - f64::from(figure.place.translation.y);
        let ground = 0.2 * found.x + 0.1 * found.z;
        assert!((found.y - ground - height).abs() < 1e-5, "{} over the ground, not {height}", found.y - ground);
        assert!((found - animated).with_y(0.0).length() < 1e-5, "it does not go aside");
    }
}

#[test]
fn the_sole_turns_to_the_ground_as_far_as_it_may() {
    for (rise, most) in [(0.2_f32, 0.6), (0.5, 0.3)] {
        let ground = |at: Vec3| Ground::new(at.with_y(rise * at.z), Vec3::new(0.0, 3.0, -3.0 * rise));
        let mut foot = foot();
        foot.most_tilt_rad = most;
        let mut stance = Stance::new(&skeleton(), 0, [foot]).unwrap();
        let mut figure = Figure::new(skeleton());
        stance.on_event("down");
        for _ in 0..30 {
            figure.run(DT, &mut [&mut stance.on(ground)]).unwrap();
        }
        let sole = world(&figure)[3].transform_vector3(DVec3::Y);
        let tilt = f64::from(rise).atan().min(f64::from(most));
        assert!(sole.distance(DVec3::new(0.0, tilt.cos(), -tilt.sin())) < 1e-4, "{sole}, not {tilt} rad");
        let anchor = stance.feet()[0].anchor().unwrap().as_dvec3();
        assert!(ball(&figure).distance(anchor) < 1e-5 && (anchor.y - f64::from(rise) * anchor.z).abs() < 1e-6);
    }
}

#[test]
fn a_planted_foot_stays_while_its_place_slides_and_turns() {
    let (mut stance, mut figure) = (stance(), Figure::new(skeleton()));
    stance.on_event("down");
    let (mut ways, mut headings) = (Vec::new(), Vec::new());
    for frame in 0..40_u8 {
        let frame = f32::from(frame);
        figure.place = Transform::new(Vec3::Z * 0.004 * frame, Quat::from_rotation_y(0.01 * frame));
        figure.run(DT, &mut [&mut stance.on(level)]).unwrap();
        if stance.feet()[0].is_planted() {
            ways.push(ball(&figure));
            let ahead = world(&figure)[3].transform_vector3(DVec3::Z);
            headings.push(ahead.x.atan2(ahead.z));
        }
    }
    assert!(ways.len() > 25, "{} frames at rest", ways.len());
    assert!(ways.iter().all(|at| at.distance(ways[0]) < 1e-5), "{ways:?}");
    assert!(headings.iter().all(|heading| (heading - headings[0]).abs() < 1e-4), "{headings:?}");
    assert!(stance.feet()[0].contact(&figure).unwrap().as_dvec3().distance(ball(&figure)) < 1e-5);
}

#[test]
fn planting_and_releasing_does_not_jump() {
    let (mut stance, mut figure) = (stance(), Figure::new(skeleton()));
    let (mut shown, mut animated) = (Vec::new(), Vec::new());
    for frame in 0..150_u8 {
        // Sliding at 0.6 m/s; planted, released, and planted again while it still leaves.
        match frame {
            20 | 48 => stance.on_event("down"),
            45 | 70 => stance.on_event("up"),
            _ => stance.on_event("other"),
        }
        figure.place.translation.z = 0.01 * f32::from(frame);
        figure.run(DT, &mut []).unwrap();
        animated.push(ball(&figure));
        figure.run(DT, &mut [&mut stance.on(level)]).unwrap();
        shown.push(ball(&figure));
    }
    for frame in [19, 149] {
        assert!(shown[frame].distance(animated[frame]) < 1e-5, "as animated again");
    }
    // It stops within 0.15 s, and catches up with what went on for 0.25 s: 5.8 · way / time², and what the speed takes.
    let bound = 5.8 * 0.3 / (0.15 * 0.15) + 6.0 * 0.6 / 0.15;
    let found = acceleration(&shown);
    assert!(found < bound, "{found} m/s² of {bound}");
    // It comes to rest without going back.
    assert!(shown[20..32].windows(2).all(|w| w[1].z >= w[0].z - 1e-6), "{:?}", &shown[20..32]);
}

#[test]
fn a_foot_that_is_too_far_away_is_released_without_a_jump() {
    let (mut stance, mut figure) = (stance(), Figure::new(skeleton()));
    stance.most_drop = 0.05;
    stance.on_event("down");
    let mut ways = Vec::new();
    let mut released = None;
    for frame in 0..120_u8 {
        figure.place.translation.z = 0.012 * f32::from(frame);
        figure.run(DT, &mut [&mut stance.on(level)]).unwrap();
        released = released.or((stance.feet()[0].anchor().is_none()).then_some(frame));
        ways.push(ball(&figure));
    }
    assert!(released.is_some_and(|frame| frame > 20), "{released:?}");
    let last = figure.place.translation.as_dvec3() + BALL.as_dvec3();
    assert!(ways[119].distance(last) < 1e-5, "as animated again");
    let found = acceleration(&ways);
    assert!(found < 150.0, "{found} m/s²");
    let steps = ways.windows(2).map(|w| w[1].distance(w[0])).fold(0.0, f64::max);
    assert!(steps < 0.09, "no more than {steps} m a frame");
}

#[test]
fn the_pelvis_is_lowered_for_the_foot_that_is_lowest() {
    let (mut stance, mut figure) = (stance(), Figure::new(skeleton()));
    for depth in [0.0_f32, 0.05, 0.12] {
        let hole = |at: Vec3| Ground::new(at.with_y(-depth), Vec3::Y);
        stance.feet_mut()[0].reset();
        figure.run(DT, &mut [&mut stance.on(hole)]).unwrap();
        let bones = world(&figure);
        assert!((ball(&figure).y + f64::from(depth)).abs() < 1e-5, "the foot reaches the ground");
        let dropped = 0.9 - bones[0].translation.y;
        assert!((dropped - f64::from(stance.drop())).abs() < 1e-6);
        // The leg is 0.816 long; at rest its hip is 0.8 over the ankle.
        let needed = 0.8 + f64::from(depth) - 0.998 * 2.0 * (0.4_f64 * 0.4 + 0.08 * 0.08).sqrt();
        assert!(dropped >= needed && dropped < needed.max(0.0) + 0.012, "{dropped} for {needed}");
    }
}

#[test]
fn the_edge_of_a_stair_is_taken_in_time() {
    let (mut stance, mut figure) = (stance(), Figure::new(skeleton()));
    let stair = |at: Vec3| Ground::new(at.with_y(if at.z > 0.5 { 0.15 } else { 0.0 }), Vec3::Y);
    let mut ways = Vec::new();
    for frame in 0..80_u8 {
        figure.place.translation.z = 0.01 * f32::from(frame);
        figure.run(DT, &mut [&mut stance.on(stair)]).unwrap();
        ways.push(ball(&figure));
    }
    assert!((ways[79].y - 0.15).abs() < 1e-5, "on the stair in the end");
    let found = acceleration(&ways);
    assert!(found < 1.5 * 5.8 * 0.15 / (0.15 * 0.15), "{found} m/s², where a jump takes {}", 0.15 / (DT * DT));
}

#[test]
fn what_cannot_stand_is_refused() {
    let skeleton = skeleton();
    assert_eq!(Plant::new(&skeleton, [3, 2], BALL).unwrap_err(), LimbError::Bone(1));
    assert_eq!(Plant::new(&skeleton, [1, 2, 3], Vec3::NAN).unwrap_err(), LimbError::Length);
    assert_eq!(Stance::new(&skeleton, 2, [foot()]).unwrap_err(), LimbError::Pelvis { foot: 0 });
    assert_eq!(Stance::new(&skeleton, 9, []).unwrap_err(), LimbError::Pelvis { foot: 0 });
    let mut other = Figure::new(Skeleton::new([Bone::new("one", None)]).unwrap());
    let mut stance = stance();
    assert_eq!(other.run(DT, &mut [&mut stance.on(level)]), Err(PoseError::Length { bones: 4, found: 1 }));
    // Ground that is nowhere is as good as level ground.
    let mut figure = Figure::new(skeleton);
    stance.on_event("down");
    figure.run(DT, &mut [&mut stance.on(|_| Ground::new(Vec3::NAN, Vec3::NAN))]).unwrap();
    assert!(ball(&figure).is_finite());
}
