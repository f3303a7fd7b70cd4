use aim_animation::glam::{Quat, Vec3};
use aim_animation::{Clip, Control, EventError, Looping, Marks, MarksError, Phase, Step, Track, Transform};

use crate::common::Rng;

fn told<'a>(clip: &'a Clip, step: &Step) -> Vec<&'a str> {
    clip.events_passed(step).map(|event| event.name.as_str()).collect()
}

fn clip_with(events: &[f32], length: f32) -> Clip {
    let mut clip = Clip::new("clip").with_length(length);
    for (index, time) in events.iter().enumerate() {
        clip = clip.with_event(*time, format!("{index}")).unwrap();
    }
    clip
}

#[test]
fn clips_are_sampled() {
    let slide = Track::linear([0.0, 2.0], [Vec3::ZERO, Vec3::X * 2.0]).unwrap();
    let turn = Track::constant(Quat::from_rotation_y(1.0)).unwrap();
    let smile = Track::linear([0.0, 1.0], [0.0, 1.0]).unwrap();
    let clip = Clip::new("wave")
        .with_translation(2, slide.clone())
        .with_rotation(0, turn.clone())
        .with_scale(2, Track::constant(Vec3::splat(2.0)).unwrap())
        .with_rotation(7, turn.clone())
        .with_scalar(1, smile)
        .with_length(1.0);
    assert_eq!((clip.name(), clip.length_s()), ("wave", 2.0), "as long as its tracks");
    let rest = [Transform::from_translation(Vec3::Z); 3];
    for mut cursor in [clip.cursor(), Default::default(), Clip::new("").with_scale(0, slide).cursor()] {
        let mut pose = rest;
        clip.sample(0.5, &mut cursor, &mut pose);
        assert_eq!(pose[1], rest[1], "what has no track stays");
        assert_eq!(pose[2], Transform { translation: Vec3::X * 0.5, scale: Vec3::splat(2.0), ..rest[2] });
        assert_eq!(pose[0], Transform { rotation: turn.sample(0.0), ..rest[0] });
        let mut scalars = [7.0; 3];
        clip.sample_scalars(0.25, &mut cursor, &mut scalars);
        assert_eq!(scalars, [7.0, 0.25, 7.0]);
        clip.sample_scalars(0.25, &mut cursor, &mut scalars[..1]);
    }
    assert_eq!(clip.tracks().iter().map(|tracks| tracks.bone).collect::<Vec<_>>(), [0, 2, 7]);
    let without = clip.clone().without(2);
    assert!(without.bone(2).is_none() && without.bone(0).is_some() && without.tracks().len() == 2);
    let mapped = clip.clone().with_bones_mapped(|bone| (bone < 7).then(|| 5 - bone));
    assert_eq!(mapped.tracks().iter().map(|tracks| tracks.bone).collect::<Vec<_>>(), [3, 5]);
    assert_eq!(mapped.bone(5).unwrap().rotation, Some(turn));
    assert_eq!(mapped.scalars().len(), 1);
}

#[test]
fn clips_are_edited() {
    let slide = Track::linear([0.0, 4.0], [0.0, 4.0]).unwrap();
    let clip = clip_with(&[3.0, 1.0, 2.0], 4.0).with_scalar(0, slide);
    assert_eq!(clip.events().iter().map(|event| &event.name[..]).collect::<String>(), "120");
    let at = |clip: &Clip, time: f32| {
        let mut scalar = [0.0];
        clip.sample_scalars(time, &mut clip.cursor(), &mut scalar);
        scalar[0]
    };
    let piece = clip.cut(1.0, 2.5);
    assert_eq!((piece.length_s(), at(&piece, 0.5)), (1.5, 1.5));
    let events: Vec<_> = piece.events().iter().map(|event| (&event.name[..], event.time_s)).collect();
    assert_eq!(events, [("1", 0.0), ("2", 1.0)]);
    let back = clip.reversed();
    assert_eq!((back.length_s(), at(&back, 0.5)), (4.0, 3.5));
    let events: Vec<_> = back.events().iter().map(|event| (&event.name[..], event.time_s)).collect();
    assert_eq!(events, [("0", 1.0), ("2", 2.0), ("1", 3.0)]);
    let named = clip.clone().with_name("other");
    assert_eq!((named.name(), named.events(), named.scalars()), ("other", clip.events(), clip.scalars()));
    let dense = clip.resampled(10.0);
    assert_eq!((dense.scalars()[0].1.times().len(), dense.events()), (41, clip.events()));
    for time in [-1.0, f32::NAN, f32::INFINITY] {
        let error = Clip::new("").with_event(time, "").unwrap_err();
        assert!(error.to_string().contains("event"), "{error}");
        let EventError { time_s } = error;
        assert!(time_s.is_nan() == time.is_nan());
    }
}

/// Steps of any size and sign report the same events, in the same order, as many small steps over the same times.
#[test]
fn events_in_order_whatever_the_speed() {
    let mut rng = Rng(1);
    for case in 0..600 {
        // Multiples of a quarter are exact, so steps land on ends and events, too.
        let quarters = |rng: &mut Rng, below: usize| f32::from(u16::try_from(rng.below(below)).unwrap()) * 0.25;
        let length = 1.0 + quarters(&mut rng, 4);
        let events: Vec<f32> = (0..1 + rng.below(5)).map(|_| quarters(&mut rng, 4)).collect();
        let clip = clip_with(&events, length);
        let looping = [Looping::Once, Looping::Repeat, Looping::PingPong][case % 3];
        let mut control = Control::new().with_looping(looping).at(quarters(&mut rng, 4));
        let mut fine = control;
        for _ in 0..12 {
            let speed = [1.0, -1.0, 0.5, 7.0, -3.0, 0.0][rng.below(6)];
            (control.speed, fine.speed) = (speed, speed);
            let dt = quarters(&mut rng, 12);
            let step = control.advance(dt, length);
            // Steps of 1/64 s, so that no step passes an end twice.
            let mut truth = Vec::new();
            let slices = (dt * 64.0).round();
            let mut done = 0.0;
            while done < slices {
                truth.extend(told(&clip, &fine.advance(1.0 / 64.0, length)));
                done += 1.0;
            }
            if slices == 0.0 {
                truth.extend(told(&clip, &fine.advance(0.0, length)));
            }
            assert_eq!(control.time_s(), fine.time_s(), "{looping:?}");
            assert_eq!(told(&clip, &step), truth, "case {case}: {events:?} of {length} s, {step:?}");
        }
    }
}

/// A repeated clip reports its events in order and loses none, although the times of its rounds are rounded.
#[test]
fn a_repeated_clip_reports_all_events() {
    for (period, rounds) in [(0.017, 30_u16), (0.1, 100), (1.0 / 3.0, 77), (0.7, 1000)] {
        let clip = Clip::new("c").with_event(0.0, "s").unwrap().with_event(period, "e").unwrap();
        let long = clip.repeated(period * f32::from(rounds));
        assert!(long.events().is_sorted_by(|a, b| a.time_s <= b.time_s), "{period}");
        let mut once = Control::new().with_looping(Looping::Once);
        let mut names = Vec::new();
        while !once.is_done(long.length_s()) {
            names.extend(told(&long, &once.advance(0.37 * period, long.length_s())));
        }
        assert_eq!(names, ["s", "e"].repeat(usize::from(rounds)), "{period}");
    }
    // At most 2²⁰ events.
    let busy = (0..64_u8).fold(Clip::new("b"), |clip, k| clip.with_event(f32::from(k) / 63.0, "").unwrap());
    let long = busy.repeated(1e30);
    assert_eq!((long.length_s(), long.events().len()), (16_384.0, 1 << 20));
}

/// Cases whose events are easily counted by hand.
#[test]
fn events_of_simple_cases_are_as_counted_by_hand() {
    let clip = clip_with(&[0.0, 0.5, 1.0], 1.0);
    let mut control = Control::new();
    assert_eq!(told(&clip, &control.advance(0.0, 1.0)), ["0"], "what is at the beginning, once");
    assert_eq!(told(&clip, &control.advance(0.0, 1.0)), [""; 0]);
    assert_eq!(told(&clip, &control.advance(2.75, 1.0)), ["1", "2", "0", "1", "2", "0", "1"]);
    control.speed = -1.0;
    assert_eq!(told(&clip, &control.advance(1.0, 1.0)), ["1", "0", "2"]);
    let mut once = Control::new().with_looping(Looping::Once);
    assert_eq!(told(&clip, &once.advance(9.0, 1.0)), ["0", "1", "2"]);
    assert!(once.is_done(1.0) && told(&clip, &once.advance(9.0, 1.0)).is_empty());
    once.speed = -1.0;
    assert!(!once.is_done(1.0));
    assert_eq!(told(&clip, &once.advance(9.0, 1.0)), ["1", "0"]);
    assert!(once.is_done(1.0));
    let mut bouncing = Control::new().with_looping(Looping::PingPong);
    assert_eq!(told(&clip, &bouncing.advance(2.25, 1.0)), ["0", "1", "2", "1", "0"]);
    assert_eq!(bouncing.time_s(), 0.25);
    // A huge step terminates and reports a bounded number of ends.
    assert!(Control::new().advance(1e30, 1.0).ends_passed() <= 65_536);
    assert!(Control::new().with_speed(1e38).advance(1e38, 1.0).ends_passed() <= 65_536);
}

/// Local time is the integral of the speed in f64, wrapped or reflected at the ends.
#[test]
fn local_time_is_the_integral_of_the_speed() {
    let mut rng = Rng(2);
    for looping in [Looping::Repeat, Looping::PingPong] {
        let length = 1.3_f32;
        let mut control = Control::new().with_looping(looping);
        let mut total = 0.0_f64;
        for _ in 0..5000 {
            let before = control.time_s();
            control.speed = rng.between(-3.0, 3.0);
            assert_eq!(control.time_s(), before, "a change of speed is no jump");
            let dt = rng.between(0.0, 0.7);
            let step = control.advance(dt, length);
            assert_eq!((step.from_s(), step.to_s()), (before, control.time_s()));
            total += f64::from(dt) * f64::from(control.speed);
            let l = f64::from(length);
            let folded = match looping {
                Looping::PingPong => l - (total.rem_euclid(2.0 * l) - l).abs(),
                _ => total.rem_euclid(l),
            };
            let apart = (f64::from(control.time_s()) - folded).abs();
            assert!(apart.min(l - apart) < 1e-6, "{folded} {}", control.time_s());
            // The lengths of the pieces add up to the step.
            let way: f64 = step.pieces().map(|piece| (piece.to_s - piece.from_s).abs()).sum();
            assert!((way - (f64::from(dt) * f64::from(control.speed)).abs()).abs() < 1e-9);
        }
    }
}

#[test]
fn invalid_times_and_lengths_are_harmless() {
    let mut control = Control::new().at(0.5);
    for (dt, length) in [(f32::NAN, 1.0), (f32::INFINITY, 1.0), (0.0, 1.0)] {
        control.advance(dt, length);
        assert_eq!(control.time_s(), 0.5);
    }
    control.seek(f32::NAN);
    assert_eq!(control.time_s(), 0.5);
    control.seek(-3.0);
    assert_eq!(control.time_s(), 0.0);
    control.seek(7.0);
    let step = control.advance(0.25, 2.0);
    assert_eq!((step.from_s(), control.time_s()), (2.0, 0.25));
    for length in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let step = control.advance(0.25, length);
        assert_eq!((control.time_s(), step.ends_passed()), (0.0, 0));
    }
    // At the end playback is done, even at speed 0; backwards it is done at the beginning.
    let mut once = Control::new().with_looping(Looping::Once).at(1.0);
    for (speed, is_done) in [(1.0, true), (0.0, true), (-1.0, false)] {
        once.speed = speed;
        assert_eq!(once.is_done(1.0), is_done, "{speed}");
    }
    once.advance(2.0, 1.0);
    assert!(once.is_done(1.0) && once.time_s() == 0.0);
    // A step back from 0 that is too small to be represented near the end passes no end.
    let mut control = Control::new().with_speed(-1.0);
    assert_eq!(control.advance(1e-20, 1.0).ends_passed(), 0);
    assert_eq!(control.time_s(), 0.0);
    // A huge step reports a capped number of ends, but its direction afterwards is still right.
    for (rounds, then) in [(70_000.25, 0.5), (70_001.25, 0.5)] {
        let mut control = Control::new().with_looping(Looping::PingPong);
        let step = control.advance(rounds, 1.0);
        assert!((65_000..=65_536).contains(&step.ends_passed()), "{}", step.ends_passed());
        let back = step.ends_passed() % 2 == 1;
        assert_eq!((back, control.time_s()), (rounds > 70_001.0, if back { 0.75 } else { 0.25 }));
        control.advance(0.25, 1.0);
        assert_eq!(control.time_s(), then);
    }
    // Stopping on an end does not pass it; leaving it in the other direction does.
    let mut control = Control::new().with_looping(Looping::PingPong);
    let ends = [1.0, 0.25, 0.75, 0.5].map(|dt| (control.advance(dt, 1.0).ends_passed(), control.time_s()));
    assert_eq!(ends, [(0, 1.0), (1, 0.75), (0, 0.0), (1, 0.5)]);
}

#[test]
fn marks_of_synchronised_clips_coincide() {
    let mut rng = Rng(3);
    for _ in 0..300 {
        let length = rng.between(0.5, 2.0);
        let mut times = [0; 3].map(|_| rng.between(0.0, 0.99 * length));
        times.sort_by(f32::total_cmp);
        let Ok(marks) = Marks::new(length, times) else { continue };
        for (mark, time) in times.into_iter().enumerate() {
            let phase = f32::from(u8::try_from(mark).unwrap()) / 3.0;
            assert!(
                (marks.time_at(phase) - time).abs() < 1e-5 || (times[1] - times[0]).min(times[2] - times[1]) < 1e-3
            );
        }
        let phase = rng.between(0.0, 0.999);
        let back = marks.phase_at(marks.time_at(phase));
        let shortest = (times[1] - times[0]).min(times[2] - times[1]);
        assert!((back - phase).abs() < 1e-6 / shortest || (back - phase).abs() > 0.9999, "{phase} {back}");
        assert!((marks.time_at(phase + 2.0) - marks.time_at(phase)).abs() < 1e-4);
    }
    assert_eq!(Marks::new(0.0, [0.0]), Err(MarksError::Length));
    assert_eq!(Marks::new(1.0, []), Err(MarksError::Empty));
    assert_eq!(Marks::new(1.0, [0.2, 0.2]), Err(MarksError::Mark(1)));
    assert_eq!(Marks::new(1.0, [1.0]), Err(MarksError::Mark(0)));
    assert_eq!(Marks::new(1.0, [0.0, f32::NAN]), Err(MarksError::Mark(1)));
    // Times outside the clip are wrapped.
    let marks = Marks::new(1.6, [0.5, 0.9, 1.2]).unwrap();
    assert_eq!(marks.length_s(), 1.6);
    for (round, time) in [(-3.0, 0.7), (2.0, 1.5), (7.0, 0.2)] {
        let apart = (marks.phase_at(time + round * 1.6) - marks.phase_at(time)).abs();
        assert!(apart < 1e-5, "{round} {time}: {apart}");
    }
    let marks = Marks::new(1.0, [0.5]).unwrap();
    assert_eq!((marks.phase_at(f32::NAN), marks.time_at(f32::INFINITY)), (marks.phase_at(0.0), 0.5));
}

/// For any weights, the marks of all clips are passed together, and each clip is traversed without a gap.
#[test]
fn clips_in_step() {
    let mut rng = Rng(4);
    let (walk, run) = (Marks::new(1.0, [0.1, 0.6]).unwrap(), Marks::new(0.65, [0.3, 0.6]).unwrap());
    let clips = [clip_with(&[0.1, 0.6], 1.0), clip_with(&[0.3, 0.6], 0.65)];
    let mut phase = Phase::new().at(0.2);
    let mut ends = [&walk, &run].map(|marks| phase.step(marks).to_s());
    let mut count = 0;
    for _ in 0..3000 {
        let w = rng.between(0.0, 1.0);
        phase.speed = rng.between(-0.5, 2.0);
        phase.advance(rng.between(0.0, 0.4), &[(&walk, 1.0 - w), (&run, w)]);
        let steps = [&walk, &run].map(|marks| phase.step(marks));
        for (step, end) in steps.iter().zip(&mut ends) {
            assert!((step.from_s() - *end).abs() < 1e-5, "no gap");
            *end = step.to_s();
        }
        let [a, b] = [0, 1].map(|i| told(&clips[i], &steps[i]));
        assert_eq!(a, b, "left with left, right with right");
        count += a.len();
        assert!((walk.phase_at(ends[0]) - phase.phase()).abs().min(1.0) < 1e-4 || phase.phase() > 0.999);
    }
    assert!(count > 500);
    // A cycle lasts the weighted mean of the lengths, (1·3 + 0.65·1)/4, at this speed.
    for speed in [0.5, 2.0, -1.0_f32] {
        let mut phase = Phase::new().at(7.25);
        assert_eq!(phase.phase(), 0.25);
        phase.speed = speed;
        phase.advance(0.1, &[(&walk, 0.375), (&run, 0.125)]);
        let truth = (0.25 + 0.1 * f64::from(speed) / 0.9125).rem_euclid(1.0);
        assert!((f64::from(phase.phase()) - truth).abs() < 1e-6, "{speed}");
    }
    assert_eq!((Phase::new().at(-0.25).phase(), Phase::new().at(0.5).at(f32::NAN).phase()), (0.75, 0.5));
    let before = phase;
    phase.advance(1.0, &[(&walk, 0.0), (&run, f32::NAN)]);
    assert_eq!(phase.phase(), before.phase(), "without weights nothing moves");
    phase.speed = f32::INFINITY;
    phase.advance(1.0, &[(&walk, 1.0)]);
    assert_eq!(phase.phase(), before.phase());
}

/// A clip paused on its end stays there, and a step too small to be represented does not wrap around.
#[test]
fn a_clip_paused_on_its_end_stays_there() {
    let clip = clip_with(&[0.0, 0.3, 0.7, 1.0], 1.0);
    for (speed, dt) in [(0.0, 0.1), (1.0, 0.0), (-1e-20, 0.016)] {
        for looping in [Looping::Once, Looping::Repeat, Looping::PingPong] {
            let mut control = Control::new().with_looping(looping).with_speed(speed).at(1.0);
            for round in 0..2 {
                let step = control.advance(dt, 1.0);
                assert_eq!((control.time_s(), step.to_s()), (1.0, 1.0), "{looping:?} at {speed}");
                // The event at the time that was sought is reported once.
                let expected: &[&str] = if round == 0 { &["3"] } else { &[] };
                assert_eq!(told(&clip, &step), expected, "{looping:?} at {speed}");
            }
        }
    }
}
