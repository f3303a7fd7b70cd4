use aim_runtime::Axes;
use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim_runtime::ik::{Beyond, LookAt, LookAtOutcome, LookAtStatus, Path};

use crate::common::exact::*;
use crate::common::{DEG, Rng, THUG, WORLD, bone, parents, triples};

const DT: f32 = 1.0 / 60.0;
const LIMITS: [[f32; 2]; 2] = [[-1.2, 1.0], [-0.7, 0.6]];

fn limited() -> LookAt {
    let [heading, pitch] = LIMITS;
    LookAt::new(THUG, THUG).with_heading(heading[0], heading[1]).with_pitch(pitch[0], pitch[1]).with_speed(3.0)
}

fn turn(head: &mut Affine3A, outcome: &LookAtOutcome) {
    assert!(is_sound(outcome.turn));
    head.matrix3 = Mat3A::from_quat(outcome.turn) * head.matrix3;
}

/// Returns heading, pitch and roll of a head on its neck, radians, by the definitions: of its forward along the neck's
/// axes, and of its up about forward, relative to the neck's up.
fn angles(axes: &Axes, neck: &Affine3A, head: &Affine3A) -> Point {
    let stands = |bone: &Affine3A, axis: [f32; 3]| {
        let v = exact(bone.transform_vector3(axis.into()));
        v.map(|c| c / length(v))
    };
    let [ahead, up, left] = [axes.forward, axes.up, axes.left].map(|axis| stands(neck, axis));
    let (forward, head_up) = (stands(head, axes.forward), stands(head, axes.up));
    let pitch = dot(forward, up).asin();
    let heading = dot(forward, left).atan2(dot(forward, ahead));
    let (side, level) = (cross(up, forward), cross(head_up, forward));
    [heading, pitch, angle(side, level)]
}

/// Lying, hanging, upside down or mirrored: the gaze is the same, and the head is upright on its neck.
#[test]
fn upright_on_its_neck_however_the_neck_lies() {
    let mut rng = Rng(1);
    for (name, parent, is_similar) in parents() {
        for _ in 0..3000 {
            let stance = Quat::from_axis_angle(rng.direction(), rng.between(-3.1, 3.1));
            let upright = Affine3A::from_quat(stance) * bone(&THUG, Quat::IDENTITY, rng.direction());
            let neck = parent * upright;
            let target = neck.transform_point3(rng.direction() * rng.between(0.2, 5.0));
            let mut head = neck;
            let outcome = LookAt::new(THUG, THUG).solve(&neck, &head, target, DT);
            assert_eq!(outcome.status, LookAtStatus::Reached, "{name}");
            turn(&mut head, &outcome);
            if !is_similar {
                continue;
            }
            let [_, pitch, roll] = angles(&THUG, &neck, &head);
            let forward = exact(head.transform_vector3(THUG.forward.into()));
            assert!(angle(forward, exact(target - Vec3::from(head.translation))) < 1e-5, "{name}");
            if pitch.abs() < 1.4 {
                assert!(roll < 1e-5, "{name}: rolled by {roll:e} at a pitch of {pitch}");
            }
        }
    }
}

/// Limits and speed hold and no roll is added in any frame, for targets that jump anywhere.
#[test]
fn limits_and_rate_hold_and_no_roll_is_induced() {
    let mut rng = Rng(2);
    let [mut fastest, mut rolled, mut furthest] = [0.0_f64; 3];
    for _ in 0..200 {
        let neck = Affine3A::from_quat(Quat::from_axis_angle(rng.direction(), rng.between(-3.0, 3.0)));
        let (look, mut head, mut target) = (limited(), neck, Vec3::ZERO);
        for frame in 0..240 {
            if frame % 60 == 0 {
                target = rng.direction() * 2.0;
            }
            let outcome = look.solve(&neck, &head, target, DT);
            turn(&mut head, &outcome);
            fastest = fastest.max(angle_of(outcome.turn) / f64::from(DT));
            let [heading, pitch, roll] = angles(&THUG, &neck, &head);
            rolled = rolled.max(roll);
            for (angle, [lo, hi]) in [heading, pitch].into_iter().zip(LIMITS) {
                furthest = furthest.max((f64::from(lo) - angle).max(angle - f64::from(hi)));
            }
            if frame % 60 == 59 {
                assert_ne!(outcome.status, LookAtStatus::Turning, "there after a second: {outcome:?}");
            }
        }
    }
    println!("fastest {fastest} rad/s, roll {rolled:.1e} rad, beyond the limits {furthest:.1e} rad");
    assert!(fastest < 3.0 * (1.0 + 1e-5) && rolled < 1e-5 && furthest < 1e-5);
}

/// Each angle moves to its goal at its own speed, like three independent ramps.
#[test]
fn each_angle_at_its_own_speed() {
    let mut rng = Rng(6);
    let mut off = 0.0_f64;
    for _ in 0..500 {
        let neck = Affine3A::from_quat(Quat::from_axis_angle(rng.direction(), rng.between(-3.0, 3.0)));
        let speeds = [rng.between(0.3, 4.0), rng.between(0.3, 4.0), rng.between(0.3, 4.0)];
        let look = limited().with_speed(f32::INFINITY).with_angle_speeds(speeds[0], speeds[1], speeds[2]);
        // Forward is +y. Heading turns it towards +z, about +x; pitch towards +x, about −z.
        let start = [rng.between(-1.1, 0.9), rng.between(-0.6, 0.5), rng.between(-0.5, 0.5)];
        let [heading, pitch, roll] = start;
        let leaning = Quat::from_rotation_z(-pitch) * Quat::from_rotation_y(roll);
        let mut head = neck * Affine3A::from_quat(Quat::from_rotation_x(heading) * leaning);
        let aimed = [rng.between(-1.1, 0.9), rng.between(-0.6, 0.5), 0.0];
        let way = Quat::from_rotation_x(aimed[0]) * Quat::from_rotation_z(-aimed[1]) * Vec3::Y;
        let target = neck.transform_point3(way * 2.0);
        let (mut stands, goal) = (start.map(f64::from), aimed.map(f64::from));
        for frame in 0..200 {
            let outcome = look.solve(&neck, &head, target, DT);
            turn(&mut head, &outcome);
            for ((angle, goal), speed) in stands.iter_mut().zip(goal).zip(speeds) {
                let step = f64::from(speed * DT);
                *angle += (goal - *angle).clamp(-step, step);
            }
            let found = angles(&THUG, &neck, &head);
            for (angle, expected) in found.into_iter().zip([stands[0], stands[1], stands[2].abs()]) {
                off = off.max((angle - expected).abs());
                assert!((angle - expected).abs() < 5e-5, "frame {frame}: {found:?} instead of {stands:?}");
            }
        }
    }
    println!("off the ramps by at most {off:.1e} rad");
    // The total rotation is limited in addition to the angles.
    let quick = limited().with_angle_speeds(f32::INFINITY, 2.0, f32::INFINITY);
    let [neck, target] = [Affine3A::IDENTITY, Affine3A::from_translation(Vec3::new(0.6, 1.0, 0.9))];
    let outcome = quick.solve(&neck, &neck, target.translation.into(), DT);
    assert!((angle_of(outcome.turn) - f64::from(3.0 * DT)).abs() < 1e-5);
}

/// The shortest path runs at full speed; it may add roll and exceed limits, so it is not the default.
#[test]
fn the_shortest_path_runs_at_constant_speed() {
    let mut rng = Rng(3);
    let mut rolled = 0.0_f64;
    for _ in 0..500 {
        let neck = Affine3A::from_quat(Quat::from_axis_angle(rng.direction(), rng.between(-3.0, 3.0)));
        let look = limited().with_path(Path::Slerp);
        let mut head = neck;
        for _ in 0..2 {
            let local = Vec3::new(rng.between(-0.5, 0.5), 1.0, rng.between(-1.0, 1.0));
            let target = neck.transform_point3(local * 2.0);
            let whole = angle_of(look.with_speed(f32::INFINITY).solve(&neck, &head, target, DT).turn);
            let (mut gone, mut frames) = (0.0, 0);
            loop {
                let outcome = look.solve(&neck, &head, target, DT);
                turn(&mut head, &outcome);
                let step = angle_of(outcome.turn);
                assert!(step < f64::from(3.0 * DT) * (1.0 + 1e-5));
                (gone, frames) = (gone + step, frames + 1);
                rolled = rolled.max(angles(&THUG, &neck, &head)[2]);
                if outcome.status == LookAtStatus::Reached || frames == 100 {
                    break;
                }
            }
            // A single rotation about one axis, at full speed except in the last frame.
            assert!((gone - whole).abs() < 1e-4, "{gone} of {whole}");
            assert!(f64::from(frames) <= (whole / f64::from(3.0 * DT)).ceil() + 1.0);
        }
    }
    println!("slerp rolls by up to {rolled:.2} rad on the way");
    assert!(rolled > 1e-2);
}

#[test]
fn targets_beyond_the_limits_are_clamped_or_refused() {
    let neck = Affine3A::IDENTITY;
    // In front; far to the left; behind.
    for (local, beyond) in [(Vec3::new(0.0, 1.0, 0.5), false), (Vec3::Z, true), (Vec3::new(0.1, -1.0, 0.2), true)] {
        let mut head = neck;
        let refused = limited().with_beyond(Beyond::Refuse).solve(&neck, &head, local, DT);
        assert_eq!(refused.status == LookAtStatus::Refused, beyond);
        assert_eq!(refused.turn == Quat::IDENTITY, beyond);
        let clamped = limited().with_speed(f32::INFINITY).solve(&neck, &head, local, DT);
        turn(&mut head, &clamped);
        assert_eq!(clamped.status == LookAtStatus::AtLimit, beyond);
        if beyond {
            assert!((angles(&THUG, &neck, &head)[0] - f64::from(LIMITS[0][1])).abs() < 1e-5, "at the left limit");
        }
        let left = angle(exact(head.transform_vector3(THUG.forward.into())), exact(local));
        assert!((left - f64::from(clamped.remaining_rad)).abs() < 1e-5, "the status is so");
    }
}

/// A head that the animation left rolled and beyond its limits returns, no faster than allowed.
#[test]
fn a_head_beyond_its_limits_returns() {
    let mut rng = Rng(4);
    for _ in 0..300 {
        let neck = Affine3A::IDENTITY;
        let mut head = Affine3A::from_quat(Quat::from_axis_angle(rng.direction(), rng.between(-3.1, 3.1)));
        let target = Vec3::new(0.1, 1.0, 0.3);
        let mut outcome = limited().solve(&neck, &head, target, DT);
        for _ in 0..400 {
            assert!(angle_of(outcome.turn) < f64::from(3.0 * DT) * (1.0 + 1e-5));
            turn(&mut head, &outcome);
            outcome = limited().solve(&neck, &head, target, DT);
        }
        assert_eq!(outcome.status, LookAtStatus::Reached);
        assert!(angles(&THUG, &neck, &head)[2] < 1e-5);
    }
}

/// Positive heading turns left and positive pitch turns up, in every convention of bones, including mirrored ones.
#[test]
fn positive_angles_turn_left_and_up() {
    for (axes, _) in triples() {
        let neck = bone(&axes, Quat::IDENTITY, Vec3::ZERO);
        let look = LookAt::new(axes, axes).with_heading(-10.0 * DEG, 70.0 * DEG).with_pitch(-10.0 * DEG, 50.0 * DEG);
        let [front, up, left] = WORLD;
        for (towards, reached) in [(front + left, true), (front - left, false), (front + up, true), (front - up, false)]
        {
            let outcome = look.solve(&neck, &neck, towards, DT);
            assert_eq!(outcome.status == LookAtStatus::Reached, reached, "{axes:?}");
        }
    }
}

#[test]
fn nothing_moves_without_time_or_target() {
    let (neck, target) = (Affine3A::IDENTITY, Vec3::new(0.3, 1.0, 0.5));
    for dt in [0.0, -1.0, f32::NAN] {
        assert_eq!(limited().solve(&neck, &neck, target, dt).turn, Quat::IDENTITY);
    }
    for speed in [0.0, -1.0, f32::NAN] {
        let each = limited().with_angle_speeds(speed, speed, speed);
        for still in [limited().with_speed(speed), each] {
            assert_eq!(still.solve(&neck, &neck, target, DT).turn, Quat::IDENTITY);
        }
    }
    let hitch = limited().solve(&neck, &neck, Vec3::Z, 5.0);
    assert!((angle_of(hitch.turn) - 0.3).abs() < 1e-5, "a long frame counts as 0.1 s");
    for target in [Vec3::ZERO, Vec3::NAN, Vec3::splat(f32::INFINITY)] {
        assert_eq!(limited().solve(&neck, &neck, target, DT).status, LookAtStatus::Degenerate);
    }
}

#[test]
fn random_bits_are_harmless() {
    let mut rng = Rng(5);
    for _ in 0..100_000 {
        let n: [f32; 40] = numbers(&mut rng);
        let v = |at: usize| Vec3::from_slice(&n[at..]);
        let bone = |at: usize| Affine3A::from_cols(v(at).into(), v(at + 3).into(), v(at + 6).into(), v(at + 9).into());
        let (neck, head) = if rng.below(2) == 0 { (bone(0), bone(12)) } else { (Affine3A::IDENTITY, bone(12)) };
        let mut look = LookAt::new(THUG, THUG).with_speed(n[39]);
        if rng.below(3) == 0 {
            look.head = Axes { up: v(27).into(), forward: v(30).into(), left: v(33).into() };
        }
        if rng.below(2) == 0 {
            look = look.with_heading(n[35], n[36]).with_pitch(n[37], n[38]);
        }
        if rng.below(3) == 0 {
            look = look.with_angle_speeds(n[37], n[38], n[39]);
        }
        if rng.below(2) == 0 {
            look = look.with_path(Path::Slerp).with_beyond(Beyond::Refuse);
        }
        let outcome = look.solve(&neck, &head, v(24), [DT, n[34]][rng.below(2)]);
        assert!(is_sound(outcome.turn) && outcome.remaining_rad.is_finite(), "{look:?} {outcome:?}");
    }
}
