use aim_animation::glam::{DVec3, Quat, Vec3};
use aim_animation::{Clip, Continuity, HermiteKey, Track, Transform};

use crate::common::{Rng, angle_between};

const LENGTH: f32 = 1.2;

/// Returns a clip with every kind of track, none of which closes.
fn clip(rng: &mut Rng, case: usize) -> Clip {
    let inner = [0.0, 0.13, 0.4, 0.55, 0.9, LENGTH];
    // In a third of the cases the keys do not reach the ends.
    let times: Vec<f32> = if case % 3 == 0 { inner[1..5].to_vec() } else { inner.to_vec() };
    let count = times.len();
    let start = rng.rotation();
    let mut turn = start;
    let turns: Vec<Quat> = (0..count)
        .map(|k| {
            // Some rotate so far that the last quaternion is in the other hemisphere.
            let step = if case % 5 == 0 { Vec3::X + rng.vector(0.1) } else { rng.vector(0.4) };
            turn = Quat::from_scaled_axis(step) * turn;
            // Either quaternion of a rotation.
            if (case + k) % 4 == 0 { -turn } else { turn }
        })
        .collect();
    let places: Vec<Vec3> = (0..count).map(|_| rng.vector(1.0)).collect();
    let keys: Vec<HermiteKey<f32>> = (0..count)
        .map(|_| HermiteKey { into: rng.between(-2.0, 2.0), value: rng.between(0.0, 1.0), out: rng.between(-2.0, 2.0) })
        .collect();
    let rotation = if case % 2 == 0 { Track::linear(&times[..], turns) } else { Track::catmull_rom(&times[..], turns) };
    Clip::new("loop")
        .with_length(LENGTH)
        .with_translation(0, Track::linear(&times[..], places.clone()).unwrap())
        .with_scale(0, Track::catmull_rom(&times[..], places).unwrap())
        .with_rotation(0, rotation.unwrap())
        .with_scalar(0, Track::hermite(&times[..], &keys).unwrap())
        .with_translation(1, Track::step([0.0, 0.5], [Vec3::ZERO, Vec3::X]).unwrap())
}

#[derive(Clone, Copy)]
struct Sample(Transform, f32);

fn sample(clip: &Clip, time: f32) -> Sample {
    let (mut pose, mut scalar) = ([Transform::IDENTITY], [0.0]);
    clip.sample(time, &mut clip.cursor(), &mut pose);
    clip.sample_scalars(time, &mut clip.cursor(), &mut scalar);
    Sample(pose[0], scalar[0])
}

/// Returns the differences of translation, rotation, scale and scalar.
fn apart(a: Sample, b: Sample) -> [f64; 4] {
    [
        f64::from(a.0.translation.distance(b.0.translation)),
        angle_between(a.0.rotation, b.0.rotation.as_dquat()),
        f64::from(a.0.scale.distance(b.0.scale)),
        f64::from((a.1 - b.1).abs()),
    ]
}

/// Returns the one-sided velocities at both ends by finite differences of second order.
fn velocities(clip: &Clip) -> [[DVec3; 4]; 2] {
    let h = 2e-3_f32;
    let velocity = |at: [f32; 3], sign: f64| {
        let [a, b, c] = at.map(|time| sample(clip, time));
        // (−3a + 4b − c) / 2h.
        let of = |part: fn(&Sample) -> Vec3| {
            let [a, b, c] = [&a, &b, &c].map(|at| part(at).as_dvec3());
            (b * 4.0 - a * 3.0 - c) * (sign / (2.0 * f64::from(h)))
        };
        let vector = |to: &Sample| {
            let turn = to.0.rotation.as_dquat().normalize() * a.0.rotation.as_dquat().normalize().conjugate();
            if turn.w < 0.0 { (-turn).to_scaled_axis() } else { turn.to_scaled_axis() }
        };
        let turning = (vector(&b) * 4.0 - vector(&c)) * (sign / (2.0 * f64::from(h)));
        [of(|at| at.0.translation), turning, of(|at| at.0.scale), of(|at| Vec3::X * at.1)]
    };
    [velocity([0.0, h, 2.0 * h], 1.0), velocity([LENGTH, LENGTH - h, LENGTH - 2.0 * h], -1.0)]
}

/// The reported seam agrees with the one measured from samples.
#[test]
fn seams_are_measured() {
    let mut rng = Rng(1);
    for case in 0..60 {
        let clip = clip(&mut rng, case);
        let seam = clip.seam();
        let place = apart(sample(&clip, 0.0), sample(&clip, LENGTH));
        let found = [seam.place.translation, seam.place.rotation_rad, seam.place.scale, seam.place.scalar];
        for (found, truth) in found.into_iter().zip(place) {
            assert!((f64::from(found) - truth).abs() < 1e-5, "case {case}: {seam:?} {place:?}");
        }
        let [start, end] = velocities(&clip);
        let found = [seam.speed.translation, seam.speed.rotation_rad, seam.speed.scale, seam.speed.scalar];
        for (k, found) in found.into_iter().enumerate() {
            let truth = start[k].distance(end[k]);
            assert!((f64::from(found) - truth).abs() < 0.02 * (1.0 + truth), "case {case}: {k} {found} {truth}");
        }
    }
}

/// After mending, the ends meet in position and, if asked for, in velocity. Inside the window the clip moves by no more
/// than the bound, outside it not at all.
#[test]
fn seams_are_mended() {
    let mut rng = Rng(2);
    for case in 0..120 {
        let clip = clip(&mut rng, case);
        let window: f32 = [0.2, 0.37, 5.0][case % 3];
        let reach = window.min(0.5 * LENGTH);
        let before = clip.seam();
        for continuity in [Continuity::Place, Continuity::Speed] {
            let mended = clip.mended(continuity, window);
            let gaps = apart(sample(&mended, 0.0), sample(&mended, LENGTH));
            assert!(gaps.iter().all(|gap| *gap < 1e-5), "case {case}: {gaps:?}");
            if continuity == Continuity::Speed {
                let [start, end] = velocities(&mended);
                for k in 0..4 {
                    let (off, size) = (start[k].distance(end[k]), start[k].length());
                    assert!(off < 0.02 * (1.0 + size), "case {case}: {k} {off}");
                }
                let speed = mended.seam().speed;
                let told = [speed.translation, speed.rotation_rad, speed.scale, speed.scalar];
                assert!(told.iter().all(|gap| *gap < 1e-4), "case {case}: {speed:?}");
            }
            let most = |place: f32, speed: f32| {
                let speed = if continuity == Continuity::Speed { speed } else { 0.0 };
                f64::from(0.5 * place + 2.0 / 27.0 * speed * reach) * 1.05 + 2e-5
            };
            let most = [
                most(before.place.translation, before.speed.translation),
                most(before.place.rotation_rad, before.speed.rotation_rad),
                most(before.place.scale, before.speed.scale),
                most(before.place.scalar, before.speed.scalar),
            ];
            let (ends, [first, last]) = ([0.0, LENGTH].map(|time| sample(&clip, time)), velocities(&clip));
            let place = (ends[1].0.translation - ends[0].0.translation).as_dvec3() * 0.5;
            let speed = (last[0] - first[0]) * if continuity == Continuity::Speed { 0.5 } else { 0.0 };
            let fading = |u: f64| [(1.0 + 2.0 * u) * (1.0 - u).powi(2), u * (1.0 - u).powi(2) * f64::from(reach)];
            let correction = |time: f32| {
                let [start, end] = [time, LENGTH - time].map(|from| fading(f64::from((from / reach).min(1.0))));
                place * start[0] + speed * start[1] - place * end[0] + speed * end[1]
            };
            for step in 0..=120_u8 {
                let time = LENGTH * f32::from(step) / 120.0;
                let moved = sample(&mended, time).0.translation - sample(&clip, time).0.translation;
                assert!(moved.as_dvec3().distance(correction(time)) < 3e-4, "case {case} at {time}");
            }
            for step in 0..=120_u8 {
                let time = LENGTH * f32::from(step) / 120.0;
                let moved = apart(sample(&clip, time), sample(&mended, time));
                for (moved, most) in moved.iter().zip(most) {
                    assert!(*moved <= most, "case {case} at {time}: {moved} of {most}");
                }
                if time > reach && time < LENGTH - reach {
                    assert!(moved.iter().all(|moved| *moved < 2e-5), "case {case} at {time}: {moved:?}");
                }
            }
            assert_eq!(mended.bone(1), clip.bone(1), "steps stay");
            assert_eq!(mended.length_s(), LENGTH);
        }
    }
}

/// Jumps inside a clip are preserved: both sides of a jump keep their values.
#[test]
fn jumps_inside_a_clip_are_preserved() {
    let times = [0.0, 0.6, 0.6, LENGTH];
    let places = Track::linear(times, [Vec3::ZERO, Vec3::X, Vec3::Y * 3.0, Vec3::Y]).unwrap();
    let turns = [0.0, 0.5, 2.9, 2.0].map(Quat::from_rotation_z);
    let turns = Track::linear(times, [turns[0], turns[1], -turns[2], turns[3]]).unwrap();
    let clip = Clip::new("b").with_translation(0, places).with_rotation(0, turns);
    let mended = clip.mended(Continuity::Speed, 0.2);
    for time in [0.25, 0.4, 0.59, 0.6, 0.61, 0.9] {
        let moved = apart(sample(&clip, time), sample(&mended, time));
        assert!(moved.iter().all(|moved| *moved < 2e-5), "{time}: {moved:?}");
    }
    assert!(apart(sample(&mended, 0.0), sample(&mended, LENGTH)).iter().all(|gap| *gap < 1e-5));
}

/// Returns `true` if the times are sorted and no more than two keys share a time.
fn is_in_order(times: &[f32]) -> bool {
    times.windows(2).all(|pair| pair[0] <= pair[1]) && times.windows(3).all(|keys| keys[0] < keys[2])
}

/// Keys so close together that keys added between them would be rounded to the same time.
#[test]
fn keys_close_together_are_mended() {
    let late = [3.9, 4.0, 4.0_f32.next_up(), 4.5];
    let turns = [0.0, 0.1, 3.0, 0.2].map(Quat::from_rotation_x);
    let clip = Clip::new("b").with_rotation(0, Track::linear(late, turns).unwrap());
    let mended = clip.mended(Continuity::Speed, 0.3);
    let track = mended.bone(0).unwrap().rotation.clone().unwrap();
    assert!(is_in_order(track.times()), "{:?}", track.times());
    for time in [3.95, 4.0, 4.1, 4.19] {
        let moved = apart(sample(&clip, time), sample(&mended, time));
        assert!(moved[1] < 2e-5, "{time}: {moved:?}");
    }
    let close = [0.0, 1e-7, 2e-7, 1.0];
    let linear = Track::linear(close, [0.0, 1.0, 2.0, 3.0]).unwrap();
    let cubic = Track::hermite(close, &[0.0, 1.0, 2.0, 3.0].map(|value| HermiteKey::smooth(value, 0.0))).unwrap();
    for track in [linear, cubic] {
        let back = Clip::new("b").with_length(8.0).with_scalar(0, track.clone()).reversed();
        let reversed = &back.scalars()[0].1;
        assert_eq!(reversed.times(), [7.0, 8.0, 8.0]);
        assert_eq!([7.0, 8.0].map(|time| reversed.sample(time)), [3.0, 0.0]);
        assert!((reversed.sample(7.999) - 2.0).abs() < 0.02, "{reversed:?}");
        let repeated = Clip::new("b").with_scalar(0, track).repeated(8.5);
        let track = &repeated.scalars()[0].1;
        assert!(is_in_order(track.times()), "{:?}", track.times());
        for round in 0..8_u8 {
            let end = f32::from(round) + 0.999;
            assert!((track.sample(end) - 3.0).abs() < 0.02, "{end}: {}", track.sample(end));
        }
    }
}

/// If two keys share an end time, the seam uses the one visible in a loop: the later key at 0, the earlier key at the
/// end.
#[test]
fn at_a_jump_the_key_visible_in_the_loop_counts() {
    let linear = |times: &[f32], values: &[f32]| Track::linear(times, values).unwrap();
    let cubic = |times: &[f32], values: &[f32]| {
        let keys: Vec<_> = values.iter().map(|value| HermiteKey::smooth(*value, 0.0)).collect();
        Track::hermite(times, &keys).unwrap()
    };
    let cases: [(&[f32], &[f32], f32, f32); 8] = [
        (&[0.0, 0.0, 1.0], &[5.0, 0.0, 0.0], 1.0, 0.0),
        (&[0.0, 1.0, 1.0], &[0.0, 5.0, 0.0], 1.0, 5.0),
        (&[0.0, 1.0, 1.0], &[0.0, 0.0, 5.0], 1.0, 0.0),
        (&[0.0, 0.0, 1.0, 1.0], &[7.0, 1.0, 3.0, 9.0], 1.0, 2.0),
        // A jump before the end of the clip is played in full.
        (&[0.0, 1.0, 1.0], &[0.0, 5.0, 3.0], 2.0, 3.0),
        (&[1.0, 1.0], &[2.0, 5.0], 1.0, 0.0),
        (&[0.0, 0.0], &[2.0, 5.0], 0.0, 0.0),
        (&[0.0, 0.0], &[2.0, 5.0], 1.0, 0.0),
    ];
    for (times, values, length, gap) in cases {
        for track in [linear(times, values), cubic(times, values)] {
            let clip = Clip::new("").with_scalar(0, track.clone()).with_length(length);
            assert_eq!(clip.seam().place.scalar, gap, "{track:?}");
            let mended = clip.mended(Continuity::Speed, 0.25);
            assert!(mended.seam().place.scalar < 1e-6, "{mended:?}");
            assert_eq!(mended.length_s(), length);
            let at = |time: f32| mended.scalars()[0].1.sample(time);
            assert!((at(0.0) - at(length.next_down().max(0.0))).abs() < 1e-4, "{mended:?}");
            assert!((at(0.5 * length) - track.sample(0.5 * length)).abs() < 1e-6, "{mended:?}");
        }
    }
    // Rotations, with the velocities at both ends.
    let turns = [0.9, 0.1, 0.3, 0.8].map(Quat::from_rotation_x);
    let clip = Clip::new("").with_rotation(0, Track::linear([0.0, 0.0, 1.0, 1.0], turns).unwrap());
    let seam = clip.seam();
    assert!((seam.place.rotation_rad - 0.2).abs() < 1e-5 && seam.speed.rotation_rad < 1e-5, "{seam:?}");
}

#[test]
fn seamless_clips_and_invalid_windows_are_unchanged() {
    let clip = clip(&mut Rng(3), 1);
    for window in [0.0, -1.0, f32::NAN] {
        assert_eq!(clip.mended(Continuity::Speed, window), clip);
    }
    assert_eq!(Clip::new("").seam(), Clip::new("").mended(Continuity::Speed, 1.0).seam());
    // A clip that already closes is unchanged, here a cubic.
    let round = Track::hermite([0.0, 1.0], &[HermiteKey { into: 1.0, value: 0.5, out: 1.0 }; 2]).unwrap();
    let round = Clip::new("").with_scalar(0, round);
    let mended = round.mended(Continuity::Speed, 0.5);
    assert_eq!((mended.seam(), round.seam()), Default::default());
    for time in [0.0, 0.2, 0.5, 0.77, 1.0] {
        assert!(apart(sample(&round, time), sample(&mended, time))[3] < 1e-6);
    }
}

/// A velocity that would be too large over the interval before the last key is left alone, too.
#[test]
fn a_velocity_on_arriving_that_is_too_large_is_left_alone() {
    // It leaves the first key at 10²⁵ per second. The last key would arrive with half of that, after 10¹⁶ seconds.
    let track = Track::linear([0.0, 7e-28, 1.5e16], [0.0, 0.0088, 0.0]).unwrap();
    let clip = Clip::new("c").with_scalar(0, track);
    let mended = clip.mended(Continuity::Speed, 1.8e-19);
    for part in [0.0, 0.25, 0.5, 0.75, 1.0] {
        let mut scalars = [0.0];
        mended.sample_scalars(part * clip.length_s(), &mut mended.cursor(), &mut scalars);
        assert!(scalars[0].is_finite(), "{part}: {mended:?}");
    }
}
