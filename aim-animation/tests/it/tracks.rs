use aim_animation::glam::{DQuat, Quat, Vec3};
use aim_animation::{BezierKey, Clip, Cursor, Curve, HermiteKey, Track, TrackError, Transform};

use crate::common::{Rng, angle_between};

/// Returns increasing times with unequal steps.
fn times(rng: &mut Rng, count: usize) -> Vec<f32> {
    let mut time = rng.between(0.0, 0.5);
    let step = |_| {
        time += rng.between(0.05, 1.0);
        time
    };
    (0..count).map(step).collect()
}

/// Finds the segment of a time by linear search: the key before it, and the fraction of the interval to the next.
fn segment(times: &[f32], time: f32) -> Option<(usize, f64)> {
    let k = (0..times.len() - 1).rfind(|&k| times[k] <= time && time < times[k + 1])?;
    let [from, to, at] = [times[k], times[k + 1], time].map(f64::from);
    Some((k, (at - from) / (to - from)))
}

#[test]
fn step_and_linear_scalars_agree_with_their_definitions() {
    let mut rng = Rng(1);
    for case in 0..300 {
        let times = times(&mut rng, 1 + case % 7);
        let values: Vec<f32> = times.iter().map(|_| rng.between(-5.0, 5.0)).collect();
        let step = Track::step(times.clone(), values.clone()).unwrap();
        let linear = Track::linear(times.clone(), values.clone()).unwrap();
        assert_eq!(
            (step.curve(), linear.curve(), linear.end_s()),
            (Curve::Step, Curve::Linear, *times.last().unwrap())
        );
        for _ in 0..50 {
            let time = rng.between(-1.0, 8.0);
            match segment(&times, time) {
                Some((k, u)) => {
                    assert_eq!(step.sample(time), values[k]);
                    let truth = f64::from(values[k]) + (f64::from(values[k + 1]) - f64::from(values[k])) * u;
                    assert!((f64::from(linear.sample(time)) - truth).abs() < 2e-6);
                }
                None => {
                    let held = if time < times[0] { values[0] } else { *values.last().unwrap() };
                    assert_eq!((step.sample(time), linear.sample(time)), (held, held));
                }
            }
        }
        for (time, value) in times.iter().zip(&values) {
            assert_eq!((step.sample(*time), linear.sample(*time)), (*value, *value));
        }
        assert_eq!(linear.sample(f32::NAN), values[0]);
        assert_eq!(linear.sample(f32::INFINITY), *values.last().unwrap());
    }
}

/// Rotations follow great circles in f64, for neighbouring keys near together and far apart.
#[test]
fn rotations_turn_at_constant_speed() {
    let mut rng = Rng(2);
    for case in 0..3000 {
        let from = rng.rotation();
        let most = if case % 2 == 0 { 0.1 } else { 1.5 };
        let to = Quat::from_scaled_axis(rng.vector(most)) * from;
        let to = if case % 3 == 0 { -to } else { to };
        let track = Track::linear([0.0, 1.0], [from, to]).unwrap();
        let u = rng.between(0.0, 1.0);
        let found = track.sample(u);
        let truth = from.as_dquat().normalize().slerp(to.as_dquat().normalize(), f64::from(u));
        assert!(angle_between(found, truth) < 1e-6, "{from} {to} {u}: {found} {truth}");
        assert!((found.length() - 1.0).abs() < 3e-7);
    }
}

/// A Bézier track equals its Bernstein form in f64, and so does a Hermite track of the same curve.
#[test]
fn bezier_and_hermite_keys_agree() {
    let mut rng = Rng(3);
    for _ in 0..300 {
        let times = times(&mut rng, 4);
        let keys: Vec<BezierKey<Vec3>> = times
            .iter()
            .map(|_| BezierKey { before: rng.vector(2.0), value: rng.vector(2.0), after: rng.vector(2.0) })
            .collect();
        let bezier = Track::bezier(times.clone(), &keys).unwrap();
        let hermite: Vec<HermiteKey<Vec3>> = (0..4)
            .map(|k| {
                let tangent = |way: Vec3, from: usize| way * 3.0 / (times[from + 1] - times[from]);
                let into = if k > 0 { tangent(keys[k].value - keys[k].before, k - 1) } else { Vec3::NAN };
                let out = if k < 3 { tangent(keys[k].after - keys[k].value, k) } else { Vec3::INFINITY };
                HermiteKey { into, value: keys[k].value, out }
            })
            .collect();
        let hermite = Track::hermite(times.clone(), &hermite).unwrap();
        for _ in 0..50 {
            let time = rng.between(times[0], times[3]);
            let Some((k, t)) = segment(&times, time) else { continue };
            let [f1, t1, t2, f2] =
                [keys[k].value, keys[k].after, keys[k + 1].before, keys[k + 1].value].map(|point| point.as_dvec3());
            let s = 1.0 - t;
            let truth = f1 * (s * s * s) + t1 * (3.0 * t * s * s) + t2 * (3.0 * t * t * s) + f2 * (t * t * t);
            assert!(bezier.sample(time).as_dvec3().distance(truth) < 5e-6);
            assert!(hermite.sample(time).as_dvec3().distance(truth) < 5e-6);
        }
    }
    // A mirrored control point: the curve passes straight through the key with one velocity.
    let key = BezierKey::mirrored(1.0_f32, 1.5);
    let track = Track::bezier([0.0, 1.0, 2.0], &[BezierKey { before: 0.0, value: 0.0, after: 0.0 }, key, key]).unwrap();
    assert_eq!((key.before, track.tangents()[1]), (0.5, [1.5, 1.5]));
}

/// Barry–Goldman pyramid in f64, with the key times as knots.
#[test]
fn catmull_rom() {
    let mut rng = Rng(4);
    for _ in 0..300 {
        let times = times(&mut rng, 6);
        let values: Vec<f32> = times.iter().map(|_| rng.between(-3.0, 3.0)).collect();
        let track = Track::catmull_rom(times.clone(), values.clone()).unwrap();
        for _ in 0..50 {
            let time = rng.between(times[1], times[4]);
            let Some((k, _)) = segment(&times, time) else { continue };
            let knots: [f64; 4] = core::array::from_fn(|i| f64::from(times[k - 1 + i]));
            let points: [f64; 4] = core::array::from_fn(|i| f64::from(values[k - 1 + i]));
            let t = f64::from(time);
            let between = |(a, t_a): (f64, f64), (b, t_b): (f64, f64)| ((t_b - t) * a + (t - t_a) * b) / (t_b - t_a);
            let a: [f64; 3] = core::array::from_fn(|i| between((points[i], knots[i]), (points[i + 1], knots[i + 1])));
            let b: [f64; 2] = core::array::from_fn(|i| between((a[i], knots[i]), (a[i + 1], knots[i + 2])));
            let truth = between((b[0], knots[1]), (b[1], knots[2]));
            assert!((f64::from(track.sample(time)) - truth).abs() < 2e-5, "{} {truth}", track.sample(time));
        }
        for (time, value) in times.iter().zip(&values) {
            assert_eq!(track.sample(*time), *value, "it passes its keys");
        }
    }
    // Two keys at one time are a jump, which is kept and not smoothed.
    let jump = Track::catmull_rom([0.0, 1.0, 1.0, 2.0], [0.0, 1.0, 5.0, 6.0]).unwrap();
    assert_eq!([0.5, 1.0, 1.5].map(|time| jump.sample(time)), [0.5, 5.0, 5.5]);
}

/// Evenly spaced rotations about one axis are passed at constant speed, whichever of their two quaternions are given.
#[test]
fn cubic_rotations() {
    let rotations = [0.0, 0.2, 0.4, 0.6].map(Quat::from_rotation_y);
    let given = [rotations[0], -rotations[1], rotations[2], -rotations[3]];
    let track = Track::catmull_rom([0.0, 1.0, 2.0, 3.0], given).unwrap();
    for step in 0..=30_u8 {
        let time = f32::from(step) * 0.1;
        let truth = DQuat::from_rotation_y(f64::from(time) * 0.2);
        assert!(angle_between(track.sample(time), truth) < 2e-4, "{time}");
        assert!((track.sample(time).length() - 1.0).abs() < 1e-6);
    }
    // Component-wise cubic, then normalised, as glTF defines it.
    let mut rng = Rng(5);
    for _ in 0..500 {
        let keys =
            [0; 2].map(|_| HermiteKey { into: rng.rotation() * 2.0, value: rng.rotation(), out: rng.rotation() * 2.0 });
        let track = Track::hermite([1.0, 3.0], &keys).unwrap();
        let u = f64::from(rng.between(0.0, 1.0));
        let [a, out, b, into] = [keys[0].value, keys[0].out, keys[1].value, keys[1].into].map(|q| q.as_dquat());
        let (uu, uuu) = (u * u, u * u * u);
        let sum = a * (2.0 * uuu - 3.0 * uu + 1.0)
            + out * (2.0 * (uuu - 2.0 * uu + u))
            + b * (3.0 * uu - 2.0 * uuu)
            + into * (2.0 * (uuu - uu));
        #[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
        let found = track.sample((1.0 + 2.0 * u) as f32);
        if sum.length() > 0.1 {
            assert!(angle_between(found, sum) < 2e-5, "{found} {sum}");
        }
    }
}

#[test]
fn two_keys_at_one_time_are_a_jump() {
    let track = Track::linear([0.0, 1.0, 1.0, 2.0], [0.0, 1.0, -3.0, -4.0]).unwrap();
    assert_eq!([0.5, 0.75, 1.0, 1.5].map(|time| track.sample(time)), [0.5, 0.75, -3.0, -3.5]);
    let at_end = Track::step([0.0, 2.0, 2.0], [1.0, 2.0, 3.0]).unwrap();
    assert_eq!([1.9, 2.0, 2.1].map(|time| at_end.sample(time)), [1.0, 3.0, 3.0]);
    // Between keys that share a time, tangents have no effect, whatever their values.
    let key = |into, value, out| HermiteKey { into, value, out };
    let keys = [key(1e38, 0.0, 1.0), key(1.0, 1.0, 1e38), key(1e38, 5.0, 0.0), key(0.0, 5.0, 1e38)];
    let track = Track::hermite([0.0, 1.0, 1.0, 2.0], &keys).unwrap();
    assert_eq!([0.0, 0.5, 1.0, 1.5].map(|time| track.sample(time)), [0.0, 0.5, 5.0, 5.0]);
}

/// Keys close together are interpolated by a series: the same arc, up to rounding.
#[test]
fn rotations_close_together() {
    let mut rng = Rng(12);
    for case in 0..2000 {
        let (start, axis) = (rng.rotation(), rng.vector(1.0).normalize());
        let angle = [0.28, 0.2, 0.05][case % 3] * rng.between(0.9, 1.0);
        let end = Quat::from_axis_angle(axis, angle) * start;
        let track = Track::linear([0.0, 1.0], [start, if case % 2 == 0 { end } else { -end }]).unwrap();
        let part = rng.between(0.0, 1.0);
        // The definition in f64, between the keys as rounded to f32.
        let [from, to] = [start, end].map(|key| key.as_dquat().normalize());
        let turn = (to * from.conjugate()).to_scaled_axis();
        let truth = DQuat::from_scaled_axis(turn * f64::from(part)) * from;
        assert!(angle_between(track.sample(part), truth) < 4e-7, "{angle} {part}");
    }
}

/// Rotations that are not unit give the same curve if their tangents are scaled with them; tangents that become too
/// large are reported.
#[test]
fn rotations_of_any_length_give_the_same_curve() {
    let mut rng = Rng(11);
    for _ in 0..100 {
        let keys = [0; 3].map(|_| {
            let mut tangent = || Quat::from_xyzw(rng.between(-1.0, 1.0), 0.3, rng.between(-1.0, 1.0), 0.1);
            HermiteKey { into: tangent(), value: Quat::IDENTITY, out: tangent() }
        });
        let keys = keys.map(|key| HermiteKey { value: rng.rotation(), ..key });
        let long = keys.map(|key| HermiteKey { into: key.into * 3.0, value: key.value * 3.0, out: key.out * 3.0 });
        let [one, other] = [keys, long].map(|keys| Track::hermite([0.0, 0.7, 1.0], &keys).unwrap());
        for time in [0.0, 0.2, 0.5, 0.7, 0.8, 1.0] {
            assert!(angle_between(one.sample(time), other.sample(time).as_dquat()) < 1e-5, "{time}");
        }
    }
    let wild = HermiteKey { into: Quat::IDENTITY, value: Quat::IDENTITY, out: Quat::IDENTITY * 1e38 };
    assert_eq!(Track::hermite([0.0, 1.0], &[wild, wild]), Err(TrackError::Tangent(0)));
    assert_eq!(Track::constant(Quat::from_xyzw(1e38, 0.0, 0.0, 1.0)), Err(TrackError::Value(0)));
}

/// For any cursor and any order of times, sampling equals a fresh search.
#[test]
fn cursors_do_not_change_samples() {
    let mut rng = Rng(6);
    for case in 0..200 {
        let times = times(&mut rng, 1 + case % 9);
        let values: Vec<Vec3> = times.iter().map(|_| rng.vector(2.0)).collect();
        let track = Track::catmull_rom(times, values).unwrap();
        let (mut key, mut time) = (rng.below(20), 0.0);
        for _ in 0..200 {
            time = if rng.below(10) == 0 { rng.between(-1.0, 9.0) } else { time + rng.between(-0.05, 0.2) };
            assert_eq!(track.sample_near(time, &mut key), track.sample(time));
        }
    }
}

#[test]
fn invalid_tracks_are_refused() {
    use TrackError as E;
    let linear = |times: &[f32], values: &[f32]| Track::linear(times, values).map(|_| ());
    assert_eq!(linear(&[], &[]), Err(E::Empty));
    assert_eq!(linear(&[0.0], &[1.0, 2.0]), Err(E::Lengths { times: 1, values: 2 }));
    for bad in [-0.5, f32::NAN, f32::INFINITY] {
        assert_eq!(linear(&[0.0, bad], &[1.0, 2.0]), Err(E::Time(1)));
    }
    assert_eq!(linear(&[0.0, 2.0, 1.0], &[0.0; 3]), Err(E::Order(2)));
    assert_eq!(linear(&[0.0, 1.0, 1.0, 1.0], &[0.0; 4]), Err(E::Order(3)));
    for bad in [f32::NAN, f32::NEG_INFINITY, 1e16] {
        assert_eq!(linear(&[0.0, 1.0, 2.0], &[1.0, 2.0, bad]), Err(E::Value(2)));
    }
    let none = Quat::from_xyzw(0.0, 0.0, 0.0, 0.0);
    assert_eq!(Track::constant(none), Err(E::Value(0)));
    let key = |tangent: f32| HermiteKey::smooth(1.0, tangent);
    assert_eq!(Track::hermite([0.0, 1.0], &[key(0.0), key(f32::NAN)]), Err(E::Tangent(1)));
    assert_eq!(Track::hermite([0.0, 1.0], &[key(1e20), key(0.0)]), Err(E::Tangent(0)));
    let bezier = BezierKey { before: 0.0, value: 0.0, after: f32::NAN };
    assert_eq!(Track::bezier([0.0, 1.0], &[bezier, bezier]), Err(E::Tangent(0)));
    assert_eq!(Track::bezier([0.0], &[bezier, bezier]), Err(E::Lengths { times: 1, values: 2 }));
    // Nearly unit rotations are normalised; unused tangents are not checked.
    let loose = Track::constant(Quat::from_xyzw(0.0, 3.0, 0.0, 4.0)).unwrap();
    assert!((loose.sample(0.0) - Quat::from_xyzw(0.0, 0.6, 0.0, 0.8)).length() < 1e-6);
    assert!(Track::bezier([0.0], &[bezier]).is_ok());
    assert!(E::Order(3).to_string().contains("key 3") && E::Value(4).to_string().contains("key 4"));
}

/// A track resampled densely enough is the same, and its last sample is at the end.
#[test]
fn a_densely_resampled_track_is_the_same() {
    let mut rng = Rng(7);
    let times = times(&mut rng, 6);
    let values: Vec<Quat> = times.iter().map(|_| rng.rotation()).collect();
    let track = Track::catmull_rom(times, values).unwrap();
    let dense = track.resampled(1000.0, track.end_s());
    assert_eq!((dense.curve(), dense.end_s()), (Curve::Linear, track.end_s()));
    assert!(dense.values().windows(2).all(|pair| pair[0].dot(pair[1]) > 0.0));
    for _ in 0..2000 {
        let time = rng.between(0.0, track.end_s());
        assert!(angle_between(dense.sample(time), track.sample(time).as_dquat()) < 1e-4);
    }
    assert_eq!(track.resampled(10.0, 0.35).times(), [0.0, 0.0875, 0.175, 0.2625, 0.35]);
    // A whole number of samples gets no extra one.
    assert_eq!(track.resampled(4.0, 0.5).times(), [0.0, 0.25, 0.5]);
    for (rate, length) in [(0.0, 1.0), (f32::NAN, 1.0), (30.0, -1.0), (30.0, f32::INFINITY), (30.0, f32::NAN)] {
        assert_eq!(track.resampled(rate, length).times(), [0.0]);
    }
    assert!(track.resampled(f32::INFINITY, 1.0).times().len() > 1_000_000);
}

/// A rotation cubic has values that are not unit where it is cut; its samples are unit.
#[test]
fn samples_of_cut_rotations_are_unit() {
    let turns = [0.0, 2.4, 0.3].map(Quat::from_rotation_x);
    let track = Track::catmull_rom([0.0, 1.0, 2.0], turns).unwrap();
    let piece = track.cut(0.5, 1.5);
    assert!((piece.values()[0].length() - 1.0).abs() > 1e-3, "{piece:?}");
    for time in [-1.0, 0.0, 0.5, 1.0, 2.0] {
        assert!((piece.sample(time).length() - 1.0).abs() < 1e-6, "{time}: {}", piece.sample(time));
    }
}

/// `with_unit_keys` keeps the curve of a piece. Normalising each key alone would bend the curve between keys, by
/// degrees on wide swings.
#[test]
fn unit_keys_keep_the_curve() {
    let mut rng = Rng(17);
    let (mut largest, mut added) = (0.0_f64, 0);
    for case in 0..200 {
        let times = times(&mut rng, 2 + case % 4);
        let keys: Vec<HermiteKey<Quat>> = (times.iter())
            .map(|_| HermiteKey { value: rng.rotation(), into: rng.rotation() * 2.0, out: rng.rotation() * 2.0 })
            .collect();
        let track = Track::hermite(times.clone(), &keys).unwrap();
        assert_eq!(track.with_unit_keys(), track);
        let (from, to) = (times[0] + 0.03, track.end_s() - 0.01);
        let piece = track.cut(from, to);
        // Near half a turn between keys, a cubic passes near zero, where it may turn arbitrarily fast.
        if (0..1000_u16).any(|k| point(&track, from + f32::from(k) * 0.001 * (to - from)).length() < 0.3) {
            continue;
        }
        let unit = piece.with_unit_keys();
        assert!(unit.values().iter().all(|value| (value.as_dquat().length() - 1.0).abs() < 1e-6));
        assert!(unit.times().len() < piece.times().len() + 2 * 64, "{}", unit.times().len());
        added += unit.times().len() - piece.times().len();
        for k in 0..=1000_u16 {
            let time = piece.end_s() * f32::from(k) * 0.001;
            largest = largest.max(angle_between(unit.sample(time), piece.sample(time).as_dquat()));
        }
    }
    assert!(largest < 2e-5, "{largest}");
    // Bisection adds as few keys as this.
    assert!(added <= 7_700, "{added} keys");
}

/// Returns the point of a cubic before normalisation, by the definition.
fn point(track: &Track<Quat>, time: f32) -> DQuat {
    let Some((k, u)) = segment(track.times(), time) else { return DQuat::IDENTITY };
    let interval = f64::from(track.times()[k + 1] - track.times()[k]);
    let [a, b] = [k, k + 1].map(|k| track.values()[k].as_dquat());
    let (out, into) = (track.tangents()[k][1].as_dquat() * interval, track.tangents()[k + 1][0].as_dquat() * interval);
    let v = 1.0 - u;
    a * (v * v * (1.0 + 2.0 * u)) + b * (u * u * (1.0 + 2.0 * v)) + out * (u * v * v) - into * (u * u * v)
}

#[test]
fn cut_and_reversed_tracks_keep_the_curve() {
    let mut rng = Rng(8);
    for case in 0..400 {
        let times = times(&mut rng, 2 + case % 6);
        let scalars: Vec<f32> = times.iter().map(|_| rng.between(-2.0, 2.0)).collect();
        let rotations: Vec<Quat> = times.iter().map(|_| rng.rotation()).collect();
        let end = *times.last().unwrap();
        let scalar = match case % 3 {
            0 => Track::step(times.clone(), scalars),
            1 => Track::linear(times.clone(), scalars),
            _ => Track::catmull_rom(times.clone(), scalars),
        };
        let scalar = scalar.unwrap();
        let rotation = Track::catmull_rom(times.clone(), rotations).unwrap();
        let from = if case % 5 == 0 { times[1] } else { rng.between(0.0, end) };
        let to = if case % 7 == 0 { end } else { rng.between(from, end) };
        let (piece, turned) = (scalar.cut(from, to), rotation.cut(from, to));
        assert!((piece.end_s() - (to - from)).abs() < 1e-6);
        let length = end + rng.between(0.0, 1.0);
        let (back, turned_back) = (scalar.reversed(length), rotation.reversed(length));
        for _ in 0..40 {
            let time = rng.between(0.0, to - from);
            // A step may be rounded one ulp earlier or later.
            let is_near_key = |time: f32| times.iter().any(|key| (key - time).abs() < 1e-5);
            if !is_near_key(from + time) {
                assert!((piece.sample(time) - scalar.sample(from + time)).abs() < 2e-5, "case {case}");
            }
            assert!(angle_between(turned.sample(time), rotation.sample(from + time).as_dquat()) < 3e-5);
            let time = rng.between(0.0, length);
            if !is_near_key(time) {
                assert!((back.sample(length - time) - scalar.sample(time)).abs() < 2e-5, "case {case}");
            }
            assert!(angle_between(turned_back.sample(length - time), rotation.sample(time).as_dquat()) < 3e-5);
        }
    }
    let track = Track::linear([1.0, 2.0], [1.0, 2.0]).unwrap();
    for (from, to, value) in [(1.5, 1.5, 1.5), (1.7, 1.2, 1.7), (f32::NAN, f32::NAN, 1.0), (9.0, 9.9, 2.0)] {
        let piece = track.cut(from, to);
        assert_eq!((piece.times(), piece.sample(3.0)), (&[0.0][..], value));
    }
    // A jump exactly at the end of a piece belongs to what follows.
    let jump = Track::linear([0.0, 1.0, 1.0], [0.0, 1.0, 9.0]).unwrap();
    assert_eq!(jump.cut(0.0, 1.0).values(), [0.0, 1.0]);
}

/// A jump at a track's last key is kept in a piece that ends later, and inner jumps remain in every repetition.
#[test]
fn final_jumps_are_kept() {
    let flat = |value| HermiteKey::smooth(value, 0.0);
    let tracks = [
        Track::linear([0.0, 1.0, 1.0], [0.0, 1.0, 5.0]).unwrap(),
        Track::hermite([0.0, 1.0, 1.0], &[0.0, 1.0, 5.0].map(flat)).unwrap(),
        Track::step([0.0, 1.0, 1.0], [0.0, 1.0, 5.0]).unwrap(),
        Track::linear([0.0, 1.0, 1.0, 2.0], [0.0, 1.0, 5.0, 3.0]).unwrap(),
        Track::linear([1.0, 1.0], [1.0, 5.0]).unwrap(),
        Track::linear([0.0, 0.0], [1.0, 5.0]).unwrap(),
    ];
    for track in tracks {
        let clip = Clip::new("").with_scalar(0, track.clone()).with_length(2.0);
        let at = |clip: &Clip, time: f32| clip.scalars()[0].1.sample(time);
        for time in [0.0, 0.5, 0.999, 1.0, 1.5] {
            let truth = track.sample(time);
            assert_eq!(at(&clip.cut(0.0, 2.0), time), truth, "{track:?} at {time}");
            assert!((at(&clip.cut(0.25, 1.75), time - 0.25) - truth).abs() < 1e-6 || time < 0.25 || time == 1.5);
            // The second repetition begins just after the seam.
            for start in [0.0, 2.0].into_iter().filter(|start| start + time != 2.0) {
                assert!((at(&clip.repeated(4.0), start + time) - truth).abs() < 1e-6, "{track:?} at {start} + {time}");
            }
        }
        assert_eq!(at(&clip.cut(1.25, 2.0), 0.0), track.sample(1.25));
        assert!(clip.repeated(8.0).scalars()[0].1.times().is_sorted());
    }
    let jump = Track::linear([0.0, 1.0, 1.0], [0.0, 1.0, 5.0]).unwrap();
    assert_eq!(jump.cut(0.0, f32::INFINITY), jump);
}

/// If a velocity exceeds the range of f32, a piece is cut without it and stays finite.
#[test]
fn cut_tracks_are_finite() {
    for interval in [1e-25_f32, 1e-20, 1e-40] {
        let keys = [1e15, -1e15].map(|value| HermiteKey::smooth(value, 0.0));
        let track = Track::hermite([0.0, interval], &keys).unwrap();
        let clip = Clip::new("").with_scalar(0, track.clone());
        let repeated = clip.repeated(1.5 * interval).scalars()[0].1.clone();
        for piece in [track.cut(0.4 * interval, interval), track.cut(0.0, 0.6 * interval), repeated] {
            for time in [0.0, 0.1 * interval, 0.5 * interval, interval, 1.0] {
                assert!(piece.sample(time).is_finite(), "{piece:?} at {time}");
            }
            assert!(piece.tangents().iter().flatten().all(|tangent| tangent.is_finite()), "{piece:?}");
        }
    }
}

/// A repeated clip equals the clip at each time modulo its length, however its tracks begin and end.
#[test]
fn a_repeated_clip_equals_itself_modulo_its_length() {
    let times = [0.25, 0.5, 1.0];
    let linear = Track::linear(times, [Vec3::ZERO, Vec3::X, Vec3::Y]).unwrap();
    let late = Track::step([0.0, 2.0], [Vec3::ONE, Vec3::splat(3.0)]).unwrap();
    let key = |into, value, out| HermiteKey { into, value, out };
    let keys =
        [key(Vec3::ONE, Vec3::X, Vec3::ZERO), key(Vec3::X, Vec3::Y, Vec3::NEG_X), key(Vec3::ZERO, Vec3::Z, Vec3::ONE)];
    let cubic = Track::hermite(times, &keys).unwrap();
    let scalar = Track::linear([0.0, 2.0], [0.0, 1.0]).unwrap();
    let clip = Clip::new("c").with_translation(0, linear).with_scale(0, late).with_translation(1, cubic);
    let clip = clip.with_scalar(3, scalar).with_event(0.5, "half").unwrap();
    assert_eq!(clip.length_s(), 2.0);
    for (seconds, halves) in [(0.4_f32, 0), (1.7, 1), (2.0, 1), (5.3, 3), (6.0, 3)] {
        let long = clip.repeated(seconds);
        assert_eq!((long.length_s(), long.events().len()), (seconds, halves));
        for k in 0..500_u16 {
            let t = seconds * (f32::from(k) + 0.37) / 500.0;
            let (mut a, mut b) = (([Transform::IDENTITY; 2], [0.0; 4]), ([Transform::IDENTITY; 2], [0.0; 4]));
            for (clip, t, (pose, scalars)) in [(&clip, t % 2.0, &mut a), (&long, t, &mut b)] {
                clip.sample(t, &mut Cursor::default(), pose);
                clip.sample_scalars(t, &mut Cursor::default(), scalars);
            }
            for (a, b) in a.0.iter().zip(&b.0) {
                let far = (a.translation - b.translation).length().max((a.scale - b.scale).length());
                assert!(far < 2e-4, "{seconds} s at {t}: {a:?} {b:?}");
            }
            assert!((a.1[3] - b.1[3]).abs() < 1e-5, "{seconds} s at {t}");
        }
    }
    // A seam shows the end of its round; the next round begins right after it.
    let long = clip.repeated(6.0);
    let at = |t: f32| long.scalars()[0].1.sample(t);
    assert_eq!((at(2.0), at(4.0), at(6.0)), (1.0, 1.0, 1.0));
    assert!(at(2.0_f32.next_up()) == 0.0 && at(4.0_f32.next_up()) == 0.0);
    // An infinite request, or a clip without length, changes nothing.
    assert_eq!(clip.repeated(f32::INFINITY), clip);
    assert_eq!(Clip::new("still").repeated(3.0), Clip::new("still"));
    for seconds in [0.0, -1.0, f32::NAN] {
        assert_eq!(clip.repeated(seconds), clip);
    }
    assert_eq!(Clip::new("still").repeated(0.0), Clip::new("still"));
    // An event at the beginning of a round does not fire after the last round.
    let first = Clip::new("c").with_length(2.0).with_event(0.0, "first").unwrap();
    assert_eq!(first.repeated(4.0).events().len(), 2);
    // The number of repetitions is limited: to 65 535, and to 2²³ keys with two extra keys per round.
    assert_eq!(first.repeated(1e30).length_s(), 2.0 * 65_535.0);
    let dense = |keys: u16| {
        let times: Vec<f32> = (0..keys).map(f32::from).collect();
        let values = vec![1.0; usize::from(keys)];
        Clip::new("c").with_scalar(0, Track::step(times, values).unwrap())
    };
    assert_eq!(dense(32_767).repeated(1e30).length_s(), 32_766.0 * 255.0);
}

/// Cursors are equal if they last found the same keys.
#[test]
fn cursors_compare_by_their_keys() {
    let clip =
        Clip::new("c").with_translation(0, Track::linear([0.0, 1.0, 2.0], [Vec3::ZERO, Vec3::X, Vec3::Y]).unwrap());
    let (mut a, b) = (clip.cursor(), clip.cursor());
    assert_eq!(a, b);
    clip.sample(1.5, &mut a, &mut [Transform::IDENTITY]);
    assert_ne!(a, b);
}
