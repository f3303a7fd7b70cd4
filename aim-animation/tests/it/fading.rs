//! Limbs fade in and out without jumps in position or velocity, for every solver and however the fade is interrupted.

use aim_animation::glam::{DQuat, DVec3, Quat, Vec3};
use aim_animation::{Bone, Figure, LimbLayer, Skeleton, TipTarget, Transform};
use aim_runtime::ik::{CcdLimit, Hinge, TwoBone};

use crate::common::{Rng, angle_between};
use crate::layers::{LEFT, assert_consistent, body, model};

/// Returns a chain of bones with their origins at these points, unrotated.
fn chain(places: &[Vec3]) -> Skeleton {
    let bones = places.iter().enumerate().map(|(bone, &place)| {
        let at = bone.checked_sub(1).map_or(place, |before| place - places[before]);
        Bone::new(format!("{bone}"), bone.checked_sub(1)).with_rest(Transform::from_translation(at))
    });
    Skeleton::new(bones).unwrap()
}

/// Limbs whose fade is prone to jump, and their targets: two-bone limbs with their own solver, longer limbs, and limbs
/// at the ends of their reach.
fn limbs_to_fade() -> Vec<(&'static str, Skeleton, LimbLayer, TipTarget)> {
    let joints = [Vec3::ZERO, Vec3::new(0.3, 0.0, -0.05), Vec3::new(0.6, 0.0, 0.0)];
    let bent = chain(&joints.map(|joint| joint + Vec3::new(0.05, 0.1, -0.1)));
    let straight = chain(&[0.0, 0.25, 0.5, 0.75, 1.0].map(|x| Vec3::X * x));
    let arm = |two_bone| LimbLayer::new(&bent, [0, 1, 2]).unwrap().with_two_bone(two_bone);
    let long = |limb: &[usize]| LimbLayer::new(&straight, limb).unwrap();
    let knee = Hinge { axis: Vec3::Y, least_rad: 0.8, most_rad: 2.0 };
    let finger = CcdLimit::Hinge { axis: Vec3::Z, least_rad: 0.5, most_rad: 1.0 };
    let (near, beside) = (TipTarget::model(Vec3::new(0.4, 0.2, 0.0)), TipTarget::model(Vec3::new(0.6, 0.3, 0.2)));
    let far = TipTarget::model(Vec3::new(0.5, 2.0, 0.1));
    let plain = TwoBone::new();
    let bent = |name, two_bone, target| (name, bent.clone(), arm(two_bone), target);
    let straight = |name, limb, target| (name, straight.clone(), limb, target);
    vec![
        bent("pole", plain.with_pole(Vec3::new(0.3, 1.0, 0.0)), near),
        bent("twist", plain.with_twist(0.7), near),
        bent("soft", plain.with_softening(0.6), near),
        bent("hinge", plain.with_hinge(knee), near),
        bent("half", plain.with_weight(0.5), near),
        bent("far by pole", plain.with_pole(Vec3::Z), far.with_rotation(Quat::from_rotation_x(1.0))),
        straight("limit", long(&[0, 1, 2, 3, 4]).with_limit(2, finger), beside),
        straight("straight", long(&[0, 1, 2, 3, 4]), TipTarget::model(Vec3::X * 0.6)),
        straight("one bone", long(&[1, 4]), beside),
        bent("plain", plain, near.with_rotation(Quat::from_rotation_x(1.0))),
        bent("plain, far", plain, far),
        straight("plain, straight", long(&[0, 2, 4]), TipTarget::model(Vec3::new(0.7, 0.1, 0.0))),
    ]
}

/// For every solver, a weight turns each joint by that fraction of the way from its animated to its solved rotation.
/// The cases named "plain" move the tip along a straight line instead.
#[test]
fn a_weight_turns_each_joint_by_its_part() {
    for (name, skeleton, limb, target) in limbs_to_fade() {
        let mut limb = limb.with_target(target);
        let mut posed = |weight| {
            limb.weight = weight;
            let mut figure = Figure::new(skeleton.clone());
            figure.run(0.01, &mut [&mut limb]).unwrap();
            assert_consistent(&figure);
            let tip = DQuat::from_mat3(&model(&figure).last().unwrap().matrix3);
            (figure, tip, f64::from(limb.error()))
        };
        let ((still, tip_0, error_0), (whole, tip_1, error_1)) = (posed(0.0), posed(1.0));
        assert_eq!((still.local(), error_0), (skeleton.rest(), 0.0), "{name}");
        assert!(error_1 < 1e-4 || !["pole", "twist", "straight", "plain"].contains(&name), "{name}: {error_1}");
        for weight in [1e-6_f32, 1e-3, 0.25, 0.5, 0.9, 1.0 - 1e-6] {
            let (figure, tip, error) = posed(weight);
            let part = f64::from(weight);
            assert!((error - part * error_1).abs() < 1e-5, "{name}, {weight}: error {error} of {error_1}");
            let turned = angle_between(tip_0.as_quat(), tip);
            assert!((turned - part * angle_between(tip_0.as_quat(), tip_1)).abs() < 1e-4, "{name}, {weight}: {turned}");
            let is_moved = name.starts_with("plain");
            for bone in 0..skeleton.len() - 1 {
                let [from, now, to] = [&still, &figure, &whole].map(|figure| figure.local()[bone].rotation);
                let [done, left, all] =
                    [(from, now), (now, to), (from, to)].map(|(a, b)| angle_between(a, b.as_dquat()));
                let is_there = (done - part * all).abs() < 1e-4 && (left - (1.0 - part) * all).abs() < 1e-4;
                assert!(is_moved || is_there, "{name}, {weight}: bone {bone} {done} of {all}, {left} left");
            }
            let moved = |point: DVec3, to: DVec3| point.lerp(to, part);
            let [from, now, to] = [&still, &figure, &whole].map(|figure| model(figure).last().unwrap().translation);
            assert!(!is_moved || now.distance(moved(from, to)) < 1e-5, "{name}, {weight}: not straight");
        }
    }
}

/// Returns the largest change of velocity from one frame to the next.
fn largest_kink(ways: &[DVec3], dt: f64) -> f64 {
    ways.windows(3).map(|w| (w[2] - 2.0 * w[1] + w[0]).length() / dt).fold(0.0, f64::max)
}

/// A jump in position or velocity keeps its size when frames get shorter; all smooth changes shrink with them.
#[test]
fn no_limb_jumps_while_it_fades() {
    for (name, skeleton, limb, target) in limbs_to_fade() {
        let kinks = [60_u16, 120].map(|rate| {
            let dt = 1.0 / f32::from(rate);
            let mut limb = limb.clone().with_fade(0.5);
            let mut figure = Figure::new(skeleton.clone());
            let mut ways = vec![Vec::new(); skeleton.len()];
            for frame in 0..4 * rate {
                if frame % rate == rate / 2 {
                    match frame / rate {
                        0 | 2 => limb.set_target(target),
                        _ => limb.release(),
                    }
                }
                figure.run(dt, &mut [&mut limb]).unwrap();
                let model = model(&figure);
                ways.iter_mut().zip(model).for_each(|(way, bone)| way.push(bone.translation));
            }
            ways.iter().map(|way| largest_kink(way, f64::from(dt))).fold(0.0, f64::max)
        });
        println!("{name}: {kinks:?}");
        assert!(kinks[1] < 0.8 * kinks[0], "{name}: {kinks:?}");
    }
}

/// A time, the duration of the fade that starts then, both in seconds, and `true` to set a target or `false` to release
/// it.
type FadeEvent = (f32, f32, bool);

/// Returns the fade value of a hand, frame by frame.
fn faded(events: &[FadeEvent], dt: f32, length_s: f32) -> Vec<f32> {
    let skeleton = body(&mut Rng(11));
    let mut figure = Figure::new(skeleton.clone());
    let mut hand = LimbLayer::new(&skeleton, LEFT).unwrap();
    let (mut events, mut values, mut time) = (events.iter().peekable(), Vec::new(), 0.0_f64);
    while time < f64::from(length_s) {
        while let Some((_, fade_s, is_set)) = events.next_if(|event| f64::from(event.0) < time + 1e-6) {
            hand.fade_s = *fade_s;
            if *is_set { hand.set_target(TipTarget::model(Vec3::Y)) } else { hand.release() }
        }
        figure.run(dt, &mut [&mut hand]).unwrap();
        values.push(hand.faded_in());
        time += f64::from(dt);
    }
    values
}

/// An interrupted fade still ends at its new goal and on time, and never leaves 0..=1.
#[test]
fn interrupted_fades_have_no_kink() {
    let late = [(0.0, 1.0, true), (0.8, 1.0, false)];
    let slow = [(0.0, 0.1, true), (0.05, 1.0, false)];
    let slower = [(0.0, 0.2, true), (0.1, 2.0, false)];
    let quick = [(0.0, 1.0, true), (0.4, 0.1, false)];
    // Reversed to a goal that the present speed would reach far too early.
    let onward = [(0.0, 0.1, true), (0.04, 2.0, false), (0.05, 3.0, true)];
    let back = [(0.0, 0.1, true), (0.5, 0.1, false), (0.56, 2.0, true), (0.57, 3.0, false)];
    // Each case with its largest acceleration, 1/s²: a fade from rest needs 5.8 / time², and stopping a speed v within
    // a distance x needs v² / 2x.
    let cases: [(&[FadeEvent], f64); 6] =
        [(&late, 13.0), (&slow, 600.0), (&slower, 150.0), (&quick, 260.0), (&onward, 900.0), (&back, 2200.0)];
    for (case, (events, most)) in cases.into_iter().enumerate() {
        let (last, fade_s, is_set) = events[events.len() - 1];
        let kinks = [1e-3_f32, 5e-4].map(|dt| {
            let values = faded(events, dt, last + fade_s + 0.1);
            let at = |time: f32| {
                let later = values.iter().zip(1_u16..).find(|(_, frame)| f32::from(*frame) * dt > time);
                *later.unwrap().0
            };
            let goal = f32::from(u8::from(is_set));
            assert!(values.iter().all(|value| (0.0..=1.0).contains(value)), "{case}");
            assert_eq!((at(last + fade_s + 0.01), values[values.len() - 1]), (goal, goal), "{case}");
            assert!((at(last + 0.9 * fade_s) - goal).abs() > 1e-3, "{case}: it takes its time");
            let ways: Vec<DVec3> = values.iter().map(|&value| DVec3::X * f64::from(value)).collect();
            largest_kink(&ways, f64::from(dt))
        });
        println!("{case}: {kinks:?}");
        assert!(kinks[1] < 0.6 * kinks[0], "{case}: {kinks:?}");
        assert!(kinks[0] < 1e-3 * most, "{case}: {kinks:?}");
    }
    // The fade may overshoot up to the end of its range.
    for events in [slow, slower] {
        let most = faded(&events, 1e-3, 3.0).into_iter().fold(0.0, f32::max);
        assert!((0.98..1.0).contains(&most), "{most}");
    }
}

/// If a falling fade is reversed and then set to fall again, slowly, it slows down before it reaches the end.
#[test]
fn a_fade_does_not_stand_at_its_end_before_it_is_over() {
    let events = [(0.0, 0.0, true), (0.5, 5.0, false), (3.0, 10.0, true), (3.02, 10.0, false)];
    let values = faded(&events, 0.01, 12.0);
    assert!(values.iter().skip(2).all(|value| *value > 1e-3), "{values:?}");
}

/// A limb with bones of unequal length cannot fold onto its own root: it gets as near as it can and reports the
/// remaining distance.
#[test]
fn a_hand_at_its_shoulder_is_as_near_as_it_gets() {
    let skeleton = chain(&[Vec3::ZERO, Vec3::new(0.5, 0.0, 0.0), Vec3::new(0.7, 0.0, 0.01)]);
    for weight in [0.5, 1.0] {
        let mut figure = Figure::new(skeleton.clone());
        let mut hand = LimbLayer::new(&skeleton, [0, 1, 2]).unwrap().with_target(TipTarget::model(Vec3::ZERO));
        hand.weight = weight;
        figure.run(0.1, &mut [&mut hand]).unwrap();
        assert_consistent(&figure);
        // Bones of 0.5 and 0.2 m, to within the limits of the solver.
        assert!((hand.error() / weight - 0.2998).abs() < 2e-3, "{weight}: {}", hand.error());
    }
}

#[test]
fn interrupted_fades_are_the_same_at_any_frame_rate() {
    for events in [[(0.0, 0.2, true), (0.125, 2.0, false)], [(0.0, 1.0, true), (0.5, 0.5, false)]] {
        let (large, small) = (faded(&events, 0.125, 2.0), faded(&events, 0.0125, 2.0));
        for (frame, large) in large.iter().enumerate() {
            let small = small[10 * frame + 9];
            assert!((large - small).abs() < 1e-5, "{frame}: {large}, {small}");
        }
    }
}
