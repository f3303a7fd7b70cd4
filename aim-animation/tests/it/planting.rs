//! Foot planting on a leg built in code, checked by forward kinematics in f64.

use aim_animation::glam::{DAffine3, DMat3, DVec3, Quat, Vec3};
use aim_animation::{Bone, Figure, Ground, LimbError, Plant, PoseError, Skeleton, Stance, Transform};

use crate::common::exact;

const DT: f32 = 1.0 / 60.0;
/// Ball of the foot in the rest pose, in model space.
const BALL: Vec3 = Vec3::new(0.1, 0.0, 0.1);

/// A pelvis and a slightly bent leg.
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

/// Returns each bone's transform in world space.
fn world(figure: &Figure) -> Vec<DAffine3> {
    let mut model: Vec<DAffine3> = Vec::new();
    for (local, parent) in figure.local().iter().zip(figure.skeleton().parents()) {
        model.push(parent.map_or(exact(local), |parent| model[parent] * exact(local)));
    }
    model.iter().map(|bone| exact(&figure.place) * *bone).collect()
}

/// Returns the position of the ball of the foot in world space, from its position relative to the ankle at rest.
fn ball(figure: &Figure) -> DVec3 {
    let in_ankle = BALL.as_dvec3() - DVec3::new(0.1, 0.08, 0.0);
    world(figure)[3].transform_point3(in_ankle)
}

fn level(at: Vec3) -> Ground {
    Ground::new(at.with_y(0.0), Vec3::Y)
}

/// Returns the largest acceleration along a path with one point per frame, by second differences.
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
        // Slides at 0.6 m/s; is planted, released, and planted again while still fading out.
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
    // The foot stops within 0.15 s and catches up with the 0.25 s it missed: 5.8 · distance / time², plus a term for
    // the speed.
    let bound = 5.8 * 0.3 / (0.15 * 0.15) + 6.0 * 0.6 / 0.15;
    let found = acceleration(&shown);
    assert!(found < bound, "{found} m/s² of {bound}");
    // It comes to rest without moving backwards.
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
        // The leg is 0.816 long; at rest the hip is 0.8 above the ankle.
        let needed = 0.8 + f64::from(depth) - 0.998 * 2.0 * (0.4_f64 * 0.4 + 0.08 * 0.08).sqrt();
        assert!(dropped >= needed && dropped < needed.max(0.0) + 0.012, "{dropped} for {needed}");
    }
}

/// Over the edge of a stair 0.15 m high, a foot in the air rises within its fade time.
fn assert_climbs(stair: impl Fn(Vec3) -> Ground) {
    let (mut stance, mut figure) = (stance(), Figure::new(skeleton()));
    let mut ways = Vec::new();
    for frame in 0..80_u8 {
        figure.place.translation.z = 0.01 * f32::from(frame);
        figure.run(DT, &mut [&mut stance.on(&stair)]).unwrap();
        ways.push(ball(&figure));
    }
    assert!((ways[79].y - 0.15).abs() < 1e-5, "on the stair in the end");
    let found = acceleration(&ways);
    assert!(found < 1.5 * 5.8 * 0.15 / (0.15 * 0.15), "{found} m/s², where a jump takes {}", 0.15 / (DT * DT));
}

#[test]
fn the_edge_of_a_stair_is_faded_in() {
    assert_climbs(|at| Ground::new(at.with_y(if at.z > 0.5 { 0.15 } else { 0.0 }), Vec3::Y));
}

#[test]
fn invalid_feet_and_pelvises_are_refused() {
    let skeleton = skeleton();
    assert_eq!(Plant::new(&skeleton, [3, 2], BALL).unwrap_err(), LimbError::Bone(1));
    assert_eq!(Plant::new(&skeleton, [1, 2, 3], Vec3::NAN).unwrap_err(), LimbError::Length);
    assert_eq!(Stance::new(&skeleton, 2, [foot()]).unwrap_err(), LimbError::Pelvis { foot: 0 });
    assert_eq!(Stance::new(&skeleton, 9, []).unwrap_err(), LimbError::Pelvis { foot: 0 });
    let mut other = Figure::new(Skeleton::new([Bone::new("one", None)]).unwrap());
    let mut stance = stance();
    assert_eq!(other.run(DT, &mut [&mut stance.on(level)]), Err(PoseError::Length { bones: 4, found: 1 }));
    // Non-finite ground is treated as level ground.
    let mut figure = Figure::new(skeleton);
    stance.on_event("down");
    figure.run(DT, &mut [&mut stance.on(|_| Ground::new(Vec3::NAN, Vec3::NAN))]).unwrap();
    assert!(ball(&figure).is_finite());
}

/// Normals as ray casts return them at risers and on undersides.
const STEEP: [[f32; 2]; 6] = [[0.34, -0.94], [0.1, -1.0], [0.01, -1.0], [1e-4, -1.0], [0.001, 1.0], [-0.2, 1.0]];

#[test]
fn one_steep_normal_does_not_move_a_foot_off_flat_ground() {
    for [ny, nz] in STEEP {
        let (mut stance, mut figure) = (stance(), Figure::new(skeleton()));
        for frame in 0..90_u8 {
            figure.place.translation.z = 0.02 * f32::from(frame);
            let normal = if frame == 60 { Vec3::new(0.0, ny, nz) } else { Vec3::Y };
            figure.run(DT, &mut [&mut stance.on(|at| Ground::new(at.with_y(0.0), normal))]).unwrap();
            let found = ball(&figure) - figure.place.translation.as_dvec3();
            let away = found.distance(BALL.as_dvec3());
            assert!(away < 1e-5, "({ny}, {nz}), frame {frame}: {away} m away");
            let tilt = world(&figure)[3].transform_vector3(DVec3::Y).angle_between(DVec3::Y);
            assert!(tilt < 0.05, "({ny}, {nz}), frame {frame}: tilted by {tilt} rad");
            assert!(stance.drop() < 0.011, "({ny}, {nz}), frame {frame}: the pelvis is lowered by {} m", stance.drop());
        }
    }
}

#[test]
fn the_normal_of_a_riser_does_not_matter_at_the_edge_of_a_stair() {
    for [ny, nz] in STEEP {
        println!("({ny}, {nz})");
        // Just before the edge, the ray hits the riser.
        assert_climbs(|at| {
            let normal = if (0.495..0.505).contains(&at.z) { Vec3::new(0.0, ny, nz) } else { Vec3::Y };
            Ground::new(at.with_y(if at.z > 0.505 { 0.15 } else { 0.0 }), normal)
        });
    }
}

#[test]
fn a_crease_of_the_ground_is_faded_in() {
    let (mut stance, mut figure) = (stance(), Figure::new(skeleton()));
    let ramp = |at: Vec3| {
        Ground::new(at.with_y((0.3 * (at.z - 0.5)).max(0.0)), Vec3::Y - Vec3::Z * if at.z > 0.5 { 0.3 } else { 0.0 })
    };
    let mut soles = Vec::new();
    for frame in 0..80_u8 {
        figure.place.translation = ramp(Vec3::Z * (0.01 * f32::from(frame))).point;
        figure.run(DT, &mut [&mut stance.on(ramp)]).unwrap();
        soles.push(world(&figure)[3].transform_vector3(DVec3::Y));
    }
    let tilt = 0.3_f64.atan();
    assert!(soles[79].distance(DVec3::new(0.0, tilt.cos(), -tilt.sin())) < 1e-4, "{}", soles[79]);
    let found = acceleration(&soles);
    assert!(
        found < 1.1 * 5.8 * tilt / (0.15 * 0.15),
        "{found} rad/s², where a jump takes {}",
        tilt / f64::from(DT * DT)
    );
}

#[test]
fn a_normal_that_points_downward_is_ignored() {
    for normal in [Vec3::NEG_Y, Vec3::new(1e-3, -1.0, 0.0), Vec3::new(-1.0, -0.01, 2.0), Vec3::X, Vec3::ZERO, Vec3::NAN]
    {
        let (mut stance, mut figure) = (stance(), Figure::new(skeleton()));
        for is_down in [false, true] {
            stance.on_event(if is_down { "down" } else { "up" });
            figure.run(DT, &mut [&mut stance.on(|at| Ground::new(at.with_y(0.0), normal))]).unwrap();
            let sole = world(&figure)[3].transform_vector3(DVec3::Y);
            assert!(sole.distance(DVec3::Y) < 1e-6, "{normal}: {sole}");
        }
    }
}

#[test]
fn a_foot_that_is_out_of_reach_does_not_count_as_planted() {
    for speed in [0.2_f32, 0.5, 1.4, 5.0] {
        let (mut stance, mut figure) = (stance(), Figure::new(skeleton()));
        stance.on_event("down");
        let mut ways = Vec::new();
        let (mut still, mut last_planted) = (0, 0);
        for frame in 0..300_u16 {
            figure.place.translation.z += if frame < 30 { 0.0 } else { speed * DT };
            figure.run(DT, &mut [&mut stance.on(level)]).unwrap();
            let (foot, found) = (&stance.feet()[0], ball(&figure));
            if foot.is_planted() {
                let slip = found.distance(BALL.as_dvec3());
                assert!(slip < 1e-4, "{speed} m/s: it slips by {slip} m while it is planted");
                assert!((slip - f64::from(foot.slip(&figure))).abs() < 1e-5, "{} is told", foot.slip(&figure));
                (still, last_planted) = (still + 1, frame);
            }
            ways.push(found);
        }
        assert!(still > 20 && last_planted < 299, "{speed} m/s: planted in {still} frames");
        let left = usize::from(last_planted);
        assert!(ways[left + 1].distance(BALL.as_dvec3()) > 1e-4, "it is planted for as long as it reaches");
        // The stretched leg drags the foot on at no more than the pelvis' speed; after that there is no further jump.
        let kink = acceleration(&ways[left - 1..left + 2]);
        assert!(kink < f64::from(1.05 * speed / DT), "{speed} m/s: {kink} m/s²");
        let found = acceleration(&ways[left..]);
        let ahead = f64::from(speed * DT) * f64::from(last_planted - 28);
        let bound = 5.8 * ahead / (0.15 * 0.15) + 6.0 * f64::from(speed) / 0.15;
        assert!(found < bound, "{speed} m/s: {found} m/s² of {bound}");
    }
}

#[test]
fn a_leg_of_many_joints_stands_for_as_long_as_it_reaches() {
    // From the size of a mouse to a giant's, with the figure placed far from the origin.
    for scale in [0.02_f32, 1.0, 30.0] {
        let at = |x, y, z| Transform::from_translation(Vec3::new(x, y, z) * scale);
        let skeleton = Skeleton::new([
            Bone::new("pelvis", None).with_rest(at(0.0, 0.9, 0.0)),
            Bone::new("hip", Some(0)).with_rest(at(0.1, -0.02, 0.0)),
            Bone::new("knee", Some(1)).with_rest(at(0.0, -0.3, 0.1)),
            Bone::new("hock", Some(2)).with_rest(at(0.0, -0.3, -0.15)),
            Bone::new("ankle", Some(3)).with_rest(at(0.0, -0.2, 0.05)),
        ])
        .unwrap();
        let foot = Plant::new(&skeleton, [1, 2, 3, 4], BALL * scale).unwrap();
        let mut stance = Stance::new(&skeleton, 0, [foot]).unwrap();
        let mut figure = Figure::new(skeleton);
        figure.place.translation.x = 100.0 * scale;
        stance.feet_mut()[0].plant();
        let (mut released, mut most) = (None, 0.0_f32);
        for frame in 0..200_u8 {
            figure.place.translation.z = 0.005 * scale * f32::from(frame);
            figure.run(DT, &mut [&mut stance.on(level)]).unwrap();
            most = most.max(stance.feet()[0].slip(&figure) / scale);
            released = released.or(stance.feet()[0].anchor().is_none().then_some(f32::from(frame) * 0.005));
        }
        // The leg is 0.86 long; its hip sinks to 0.67.
        assert!(released.is_some_and(|way| (0.5..0.66).contains(&way)), "of size {scale}: {released:?}");
        assert!(most < 0.0086, "of size {scale}: {most}");
    }
}

#[test]
fn a_sole_on_a_slope_stays_as_it_is_while_the_figure_turns() {
    let up = Vec3::new(0.3, 1.0, 0.0);
    let slope = |at: Vec3| Ground::new(at.with_y(-0.3 * at.x), up);
    let mut stance = Stance::new(&skeleton(), 0, [foot().with_fade(0.5)]).unwrap();
    let mut figure = Figure::new(skeleton());
    stance.on_event("down");
    let mut frames = Vec::new();
    for frame in 0..200_u8 {
        let turn = frame.saturating_sub(30).min(90);
        figure.place.rotation = Quat::from_rotation_y(f32::from(turn).to_radians());
        if frame == 130 {
            stance.on_event("up");
        }
        figure.run(DT, &mut [&mut stance.on(slope)]).unwrap();
        frames.push(DMat3::from_cols_array(&world(&figure)[3].matrix3.to_cols_array()));
    }
    for (frame, sole) in frames[..130].iter().enumerate() {
        let off = sole.y_axis.angle_between(up.as_dvec3());
        let turned = sole.z_axis.angle_between(frames[0].z_axis).max(sole.x_axis.angle_between(frames[0].x_axis));
        assert!(off < 1e-3 && turned < 1e-3, "frame {frame}: {off} rad off the normal, turned by {turned} rad");
    }
    // Still tilted with the slope, and turned with the figure.
    let last = frames[199].x_axis.dot(DVec3::Z);
    assert!(frames[199].y_axis.angle_between(up.as_dvec3()) < 1e-3 && last < -0.9, "{last}");
    // 90 degrees within half a second: tangential plus centripetal acceleration.
    for axis in [0, 1, 2] {
        let ways: Vec<DVec3> = frames.iter().map(|sole| sole.col(axis)).collect();
        let found = acceleration(&ways);
        let (rad, s) = (core::f64::consts::FRAC_PI_2, 0.5);
        let bound = rad * 5.8 / (s * s) + (1.9 * rad / s) * (1.9 * rad / s);
        assert!(found < bound, "axis {axis}: {found} rad/s² of {bound}");
    }
}

#[test]
fn a_frame_without_time_does_not_stop_a_foot() {
    // At 1 m/s: largest change of speed per frame, with and without a frame of zero or invalid duration at touch-down
    // and lift-off.
    let changes = [None, Some(0.0_f32), Some(1e-40), Some(-1.0), Some(f32::NAN)].map(|pause| {
        let (mut stance, mut figure) = (stance(), Figure::new(skeleton()));
        let mut ways = Vec::new();
        for frame in 0..60_u8 {
            figure.place.translation.z = f32::from(frame) * DT;
            figure.run(DT, &mut [&mut stance.on(level)]).unwrap();
            ways.push(ball(&figure));
            if frame == 30 || frame == 38 {
                stance.on_event(if frame == 30 { "down" } else { "up" });
                if let Some(dt) = pause {
                    figure.run(dt, &mut [&mut stance.on(level)]).unwrap();
                    assert!(ball(&figure).distance(ways[usize::from(frame)]) < 1e-6, "nothing moves within {dt} s");
                }
            }
        }
        acceleration(&ways) * f64::from(DT)
    });
    for change in changes {
        assert!((change - changes[0]).abs() < 1e-3, "{changes:?} m/s in a frame");
    }
}

#[test]
fn the_ground_is_queried_only_at_finite_points() {
    for dt in [1e-40, 1e-38, 1e-30, f32::MIN_POSITIVE, 0.0, f32::INFINITY] {
        for step in [0.0, 0.02, 1e5] {
            let (mut stance, mut figure) = (stance(), Figure::new(skeleton()));
            for frame in 0..10_u8 {
                figure.place.translation.z += step;
                if frame == 3 {
                    stance.on_event("down");
                }
                let ground = |at: Vec3| {
                    assert!(at.is_finite(), "{dt} s, {step} m: asked at {at}");
                    level(at)
                };
                figure.run(dt, &mut [&mut stance.on(ground)]).unwrap();
                let anchor = stance.feet()[0].anchor();
                assert!(anchor.is_none_or(Vec3::is_finite), "{dt} s, {step} m: planted at {anchor:?}");
                assert!(ball(&figure).is_finite(), "{dt} s, {step} m");
            }
        }
    }
}

#[test]
fn an_edge_within_the_time_of_another_keeps_place_and_speed() {
    const FADE_S: f64 = 0.5;
    let edges = [(20, 0.1), (35, 0.12), (45, -0.07), (52, 0.05), (70, -0.2)];
    let floor = |frame: i32| edges.iter().filter(|(at, _)| *at <= frame).map(|(_, rise)| rise).sum::<f32>();
    let mut stance = Stance::new(&skeleton(), 0, [foot().with_fade(0.5)]).unwrap();
    let mut figure = Figure::new(skeleton());
    stance.most_drop = 0.4;
    // What remains of an offset with this value and velocity after `s` seconds: a quintic that ends at rest at 0.
    let left = |[value, velocity]: [f64; 2], s: f64| {
        let u = (s / FADE_S).min(1.0);
        let of_value = 1.0 - 10.0 * u.powi(3) + 15.0 * u.powi(4) - 6.0 * u.powi(5);
        value * of_value + velocity * FADE_S * (u - 6.0 * u.powi(3) + 8.0 * u.powi(4) - 3.0 * u.powi(5))
    };
    let (mut from, mut elapsed) = ([0.0; 2], 0.0);
    for frame in 0..110_i32 {
        // The figure's placement follows the ground, which is a lift.
        figure.place.translation.y = floor(frame);
        figure.run(DT, &mut [&mut stance.on(|at: Vec3| Ground::new(at.with_y(floor(frame)), Vec3::Y))]).unwrap();
        elapsed += f64::from(DT);
        if let Some((_, rise)) = edges.iter().find(|(at, _)| *at == frame) {
            let rate = (left(from, elapsed + 1e-5) - left(from, elapsed - 1e-5)) / 2e-5;
            (from, elapsed) = ([left(from, elapsed) - f64::from(*rise), rate], 0.0);
        }
        let wanted = f64::from(floor(frame)) + left(from, elapsed);
        assert!((ball(&figure).y - wanted).abs() < 1e-5, "frame {frame}: {} m, not {wanted} m", ball(&figure).y);
    }
}

/// Returns a foot and its figure with fades of 0.3 s.
fn slowly() -> (Stance, Figure) {
    (Stance::new(&skeleton(), 0, [foot().with_fade(0.3)]).unwrap(), Figure::new(skeleton()))
}

/// A planted foot runs out by 0.4 · speed · fade time over the ground, and stands on the ground found there.
#[test]
fn a_foot_comes_to_rest_where_its_movement_runs_out() {
    let slope = |at: Vec3| Ground::new(at.with_y(0.15 * at.z - 0.1 * at.x), Vec3::new(0.1, 1.0, -0.15));
    let (mut stance, mut figure) = slowly();
    let mut ways = Vec::new();
    for frame in 0..=20_u8 {
        figure.place.translation = slope(Vec3::new(0.3, 0.0, 0.6) * DT * f32::from(frame)).point;
        if frame == 20 {
            stance.feet_mut()[0].plant();
        }
        figure.run(DT, &mut [&mut stance.on(slope)]).unwrap();
        ways.push(ball(&figure));
    }
    let speed = (ways[19] - ways[18]) / f64::from(DT);
    let expected = ways[19] + speed * (f64::from(DT) + 0.4 * 0.3);
    let anchor = stance.feet()[0].anchor().unwrap().as_dvec3();
    assert!((anchor - expected).with_y(0.0).length() < 1e-5, "{anchor} {expected}");
    assert!((anchor.y - 0.15 * anchor.z + 0.1 * anchor.x).abs() < 1e-6, "{anchor}");
    // Once released, it returns to the animation without a jump in speed: at most 5.8 · distance / time² + 6 · speed /
    // time.
    for frame in 21..=90_u8 {
        if frame == 45 {
            stance.feet_mut()[0].release();
        }
        figure.place.translation = slope(Vec3::new(0.3, 0.0, 0.6) * DT * f32::from(frame)).point;
        figure.run(DT, &mut [&mut stance.on(slope)]).unwrap();
        ways.push(ball(&figure));
    }
    assert!(stance.feet()[0].anchor().is_none());
    let (way, found) = (0.68 * 0.3, acceleration(&ways));
    assert!(found < 5.8 * way / 0.09 + 6.0 * 0.68 / 0.3, "{found} m/s²");
}

/// A fast fall is stopped by the ground; a slow one continues at its speed at first.
#[test]
fn a_foot_that_falls_comes_down_on_the_ground() {
    for fall in [2.0_f32, 0.1] {
        let (mut stance, mut figure) = slowly();
        let mut heights = Vec::new();
        for frame in 0..60_u8 {
            let height = (0.06 + fall * DT * (10.0 - f32::from(frame))).max(0.0);
            let mut lift = |figure: &mut Figure, _: f32| {
                figure.shift(1, Vec3::Y * height);
                Ok(())
            };
            if frame == 11 {
                stance.feet_mut()[0].plant();
            }
            figure.run(DT, &mut [&mut lift, &mut stance.on(level)]).unwrap();
            heights.push(ball(&figure).y);
        }
        assert!(heights.iter().all(|height| *height > -1e-5), "{fall}: {heights:?}");
        assert!(heights[40].abs() < 1e-5, "{fall}: it is down");
        let speeds: Vec<f64> = heights.windows(2).map(|w| (w[1] - w[0]) / f64::from(DT)).collect();
        // The fall is limited to height / (0.4 · fade time), here about 0.5 m/s: a fall at 0.1 m/s is not slowed down.
        assert!(fall > 1.0 || (speeds[11] - speeds[10]).abs() < 0.04, "{speeds:?}");
    }
}

/// A foot planted while its figure turns comes to rest in orientation, too, without a jump.
#[test]
fn a_foot_that_turns_comes_to_rest_without_a_jump() {
    let (mut stance, mut figure) = slowly();
    let mut headings = Vec::new();
    for frame in 0..60_u8 {
        if frame == 20 {
            stance.feet_mut()[0].plant();
        }
        figure.place.rotation = Quat::from_rotation_y(2.0 * DT * f32::from(frame.min(40)));
        figure.run(DT, &mut [&mut stance.on(level)]).unwrap();
        let ahead = world(&figure)[3].transform_vector3(DVec3::Z);
        headings.push(ahead.x.atan2(ahead.z));
    }
    let second = headings[..38].windows(3).map(|w| (w[2] - 2.0 * w[1] + w[0]).abs() / f64::from(DT * DT));
    let found = second.fold(0.0, f64::max);
    assert!(found < 6.0 * 2.0 / 0.3 + 5.0, "{found} rad/s²");
}

/// Moving along a slope, a foot in the air follows the ground immediately.
#[test]
fn a_foot_in_the_air_follows_a_slope_at_once() {
    for rise in [0.3_f32, -0.3] {
        let slope = |at: Vec3| Ground::new(at.with_y(2.0 + rise * at.z), Vec3::new(0.0, 1.0, -rise));
        let (mut stance, mut figure) = slowly();
        for frame in 0..20_u8 {
            figure.place.translation = slope(Vec3::Z * (3.0 * DT * f32::from(frame))).point;
            figure.run(DT, &mut [&mut stance.on(slope)]).unwrap();
            let at = ball(&figure);
            assert!((at.y - 2.0 - f64::from(rise) * at.z).abs() < 1e-5, "{frame}: {at}");
        }
    }
}
