//! Charts of how eye and head share the gaze: target, gaze, head and eye in head, over the whole length, and a close-up
//! of the largest quick shift of the gaze.

use aim_runtime::glam::DVec3;
use std::ops::Range;

use maud::{Markup, html};

use super::chart::{Base, Scale, Series};
use super::directions::{Bearings, Directions, apart};
use crate::words::{self, trimmed};

/// Time within which a quick shift takes place, seconds.
const SHIFT_S: f64 = 0.3;
/// Smallest size of a quick shift, degrees.
const SHIFT_DEG: f64 = 20.0;
/// Span of a close-up before the beginning of a shift, seconds.
const BEFORE_S: f64 = 0.15;
/// Span of a close-up after the beginning of a shift, seconds.
const AFTER_S: f64 = 1.05;

/// Scales end at a multiple of this angle, degrees.
const STEP_DEG: f64 = 30.0;

/// Azimuth or elevation, and how it is drawn.
#[derive(Clone, Copy)]
struct GazeAngle {
    name: &'static str,
    unit: &'static str,
    index: usize,
    most: f64,
    wraps: Option<f64>,
}

const AZIMUTH: GazeAngle =
    GazeAngle { name: "Azimuth", unit: "degrees, positive to the left", index: 0, most: 180.0, wraps: Some(360.0) };
const ELEVATION: GazeAngle =
    GazeAngle { name: "Elevation", unit: "degrees, positive upwards", index: 1, most: 90.0, wraps: None };

/// Returns the charts: azimuth, a close-up if there is a quick shift, and elevation.
pub(super) fn charts(base: &Base<'_>, directions: &Directions) -> Markup {
    let whole = |angle: GazeAngle| {
        let series = series(directions, angle, 0..base.times.len());
        let seen = series.iter().flat_map(|series| &series.values).filter(|value| value.is_finite());
        let most = seen.fold(0.0_f64, |most, value| most.max(value.abs()));
        let most = (most / STEP_DEG).ceil().max(1.0) * STEP_DEG;
        let scale = Scale::Degrees(-most.min(angle.most), most.min(angle.most));
        let label = format!("{} of {} over time.", angle.name, what(directions));
        let mut chart = base.chart(label, angle.unit, scale);
        chart.wraps = angle.wraps;
        chart.wide = angle.index == 0;
        chart.series = series;
        chart.figure(angle.name)
    };
    html! {
        (whole(AZIMUTH))
        @if let Some(shift) = furthest_shift(base.times, &directions.gaze) { (close_up(base, directions, &shift)) }
        (whole(ELEVATION))
    }
}

fn what(directions: &Directions) -> &'static str {
    match directions.head {
        Some(_) => "target, gaze, head, eye in head and the clip's head",
        None => "target, gaze and the clip's gaze",
    }
}

/// Returns the lines for these frames. Later ones are drawn above earlier ones.
fn series(directions: &Directions, angle: GazeAngle, frames: Range<usize>) -> Vec<Series<'static>> {
    let pick = |course: &Bearings| course[frames.clone()].iter().map(|at| at[angle.index]).collect::<Vec<f64>>();
    let gaze = pick(&directions.gaze);
    let mut series = vec![Series { name: "target", class: "target-line", values: pick(&directions.target) }];
    series.push(Series { name: "clip", class: "clip", values: pick(&directions.animated) });
    if let Some(head) = &directions.head {
        let head = pick(head);
        let eye = gaze.iter().zip(&head).map(|(gaze, head)| apart(*gaze, *head)).collect();
        series.push(Series { name: "head", class: "heading", values: head });
        series.push(Series { name: "eye in head", class: "pitch", values: eye });
    }
    series.push(Series { name: "gaze", class: "one", values: gaze });
    series
}

/// Largest change of the gaze within [`SHIFT_S`].
struct Shift {
    /// Index of the frame in which it begins.
    begins: usize,
    /// Angle between the gaze before and after, degrees.
    degrees: f64,
    angle: GazeAngle,
}

/// Returns the largest shift of the gaze, or `None` if it is smaller than [`SHIFT_DEG`].
fn furthest_shift(times: &[f64], gaze: &Bearings) -> Option<Shift> {
    let count = times.len().min(gaze.len());
    let after = |k: usize| times.partition_point(|t| *t <= times[k] + SHIFT_S).clamp(1, count) - 1;
    let far = |a: usize, b: usize| between(gaze[a], gaze[b]);
    let shifts = (0..count).map(|k| (k, far(k, after(k)))).filter(|(_, degrees)| degrees.is_finite());
    // Of equal shifts, the first.
    let (from, degrees) = shifts.reduce(|best, at| if at.1 > best.1 { at } else { best })?;
    if degrees < SHIFT_DEG {
        return None;
    }
    let to = after(from);
    let steps = || (from + 1..=to).map(|k| (k - 1, far(k - 1, k)));
    let fastest = steps().map(|(_, step)| step).fold(0.0, f64::max);
    // The shift begins with the first step of at least a quarter of the fastest one.
    let begins = steps().find(|(_, step)| *step >= 0.25 * fastest).map_or(from, |(k, _)| k);
    let turned = apart(gaze[to][0], gaze[from][0]).abs();
    let raised = (gaze[to][1] - gaze[from][1]).abs();
    Some(Shift { begins, degrees, angle: if raised > turned { ELEVATION } else { AZIMUTH } })
}

/// Returns the angle between two directions, degrees.
pub(super) fn between(a: [f64; 2], b: [f64; 2]) -> f64 {
    let [a, b] = [a, b].map(|[azimuth, elevation]| {
        let ((sin, cos), (up, level)) = (azimuth.to_radians().sin_cos(), elevation.to_radians().sin_cos());
        DVec3::new(sin * level, up, cos * level)
    });
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}

fn close_up(base: &Base<'_>, directions: &Directions, shift: &Shift) -> Markup {
    let start = base.times[shift.begins];
    let at = |t: f64| base.times.partition_point(|time| *time < t);
    let frames = at(start - BEFORE_S)..at(start + AFTER_S).max(shift.begins + 1);
    let near = Base { times: &base.times[frames.clone()], statuses: &base.statuses[frames.clone()], ..*base };
    let series = series(directions, shift.angle, frames);
    let seen = series.iter().flat_map(|series| &series.values).copied().filter(|value| value.is_finite());
    let (low, high) = seen.fold((0.0_f64, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    let room = (0.06 * (high - low)).max(1.0);
    let label = format!(
        "{} of {} from {} s on, where the gaze shifts by {}.",
        shift.angle.name,
        what(directions),
        trimmed(start, 2),
        words::degrees(shift.degrees)
    );
    let mut chart = near.chart(label, shift.angle.unit, Scale::Degrees(low - room, high + room));
    chart.wraps = shift.angle.wraps;
    chart.wide = true;
    chart.series = series;
    chart.figure(&format!("Close-up of the largest gaze shift: {}", shift.angle.name.to_lowercase()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_leap_is_found_where_it_begins_and_a_drift_is_none() {
        let times: Vec<f64> = (0..200_u32).map(|k| f64::from(k) / 60.0).collect();
        let drift: Bearings = times.iter().map(|t| [20.0 * t, 0.0]).collect();
        assert!(furthest_shift(&times, &drift).is_none());
        let leap = |sign: f64| -> Bearings {
            times.iter().map(|t| [170.0 + sign * (400.0 * (t - 1.0)).clamp(0.0, 40.0), 0.0]).collect()
        };
        for sign in [1.0, -1.0] {
            let shift = furthest_shift(&times, &leap(sign)).expect("a leap of 40°");
            assert!((shift.degrees - 40.0).abs() < 1e-6, "{}", shift.degrees);
            assert!((times[shift.begins] - 1.0).abs() < 0.02, "{}", times[shift.begins]);
        }
        let nod: Bearings = times.iter().map(|t| [10.0, (600.0 * (t - 2.0)).clamp(0.0, 30.0)]).collect();
        assert_eq!(furthest_shift(&times, &nod).expect("a nod of 30°").angle.index, 1);
        assert!(furthest_shift(&[], &Vec::new()).is_none() && furthest_shift(&times[..1], &nod).is_none());
    }
}
