//! A target that jumps: which joints move, when and how.

use std::f64::consts::TAU;

use aim::glam::{Affine3A, Quat};

use super::super::chain::{posed, random_pose};
use super::super::parallel;
use super::super::row::{Row, largest};
use super::super::sample::{FRAME_RATES, Sample};
use super::shift::{CHEST, NECK, Shift};

/// Measures steps of 10, 30 and 60 degrees at all frame rates.
pub fn steps(sample: &Sample) -> Vec<Row> {
    FRAME_RATES
        .into_iter()
        .flat_map(|hz| [10.0, 30.0, 60.0].into_iter().flat_map(move |d| step(sample, d, hz)))
        .collect()
}

/// Measures one size of step to both sides and obliquely, in the rest pose and in random poses.
fn step(sample: &Sample, degrees: f64, hz: f32) -> Vec<Row> {
    let mut random = fastrand::Rng::with_seed(0x57e9);
    let mut poses: Vec<[Affine3A; 3]> = vec![posed([Quat::IDENTITY; 3])];
    poses.extend((0..sample.of(64)).map(|_| random_pose(&mut random)));
    let shifts = |directions: &[f64]| -> Vec<Shift> {
        let count = poses.len() * directions.len();
        parallel::map(count, |i| {
            let (pose, direction) = (&poses[i / directions.len()], directions[i % directions.len()]);
            Shift::new(pose, degrees, TAU * direction, hz, &sample.settings)
        })
    };
    let level = shifts(&[0.0, 0.5]);
    let oblique = shifts(&[0.06, -0.06, 0.125, -0.125, 0.375, 0.44, 0.625]);
    let of = |shifts: &[Shift], f: fn(&Shift) -> f64| largest(shifts.iter().map(f));
    let name = format!("{degrees}° step, {hz} Hz");
    let arrival = if degrees < 20.0 {
        60.0
    } else if degrees < 40.0 {
        135.0
    } else {
        330.0
    };
    let frame = 1e3 / f64::from(hz);

    let mut rows = Vec::new();
    if degrees < 20.0 {
        rows.push(Row::at_most(format!("{name}: the neck turns"), 1.0, "°", of(&level, |shift| shift.most(NECK))));
    } else {
        let mut after: Vec<f64> = level.iter().map(Shift::neck_after_eye).collect();
        after.sort_unstable_by(f64::total_cmp);
        let (first, last) = (after[0], after[after.len() - 1]);
        rows.push(Row::between(format!("{name}: the neck is at 1° after the eye"), [20.0, 100.0], " ms", first));
        rows.push(Row::between(format!("{name}: and at the latest"), [20.0, 100.0], " ms", last));
    }
    rows.push(Row::at_most(format!("{name}: the gaze arrives"), arrival + frame, " ms", of(&level, Shift::arrives)));
    rows.push(
        Row::at_most(format!("{name}: off the target from then on"), 0.1, "°", of(&level, Shift::off_later))
            .noting(&format!("the neck turning {:.1}° more", of(&level, Shift::neck_turns_later))),
    );
    if degrees > 20.0 {
        let [most, end] = [0, 1].map(|k| largest(level.iter().map(|shift| shift.eccentricities()[k])));
        let limit = if degrees > 40.0 { 26.0 } else { 20.0 };
        rows.push(
            Row::at_most(format!("{name}: the eye ends off its middle"), limit, "°", end)
                .noting(&format!("after {most:.1}°")),
        );
    }
    for (joint, part) in [("neck", NECK), ("chest", CHEST)] {
        let jerkiest = largest(level.iter().chain(&oblique).map(|shift| shift.jerkiest(part)));
        let what = format!("{name}: largest change of speed, {joint}");
        rows.push(Row::at_most(what, 1.005, " × acceleration · dt", jerkiest));
    }
    let overshoot = of(&level, Shift::overshoot).max(of(&oblique, Shift::overshoot));
    rows.push(Row::at_most(format!("{name}: overshoot"), 0.5, "°", overshoot));
    // A straight line in heading and elevation deviates by up to 3.4° from the great circle.
    rows.push(
        Row::at_most(format!("{name}: an oblique one off its arc"), 4.0, "°", of(&oblique, Shift::off_arc))
            .noting(&format!("arriving by {:.0} ms", of(&oblique, Shift::arrives))),
    );
    rows
}
