//! Charts of the plausibility of a gaze, measured on the written model: heading of the head from the chest, elevation
//! and heading of the gaze from the target, and acceleration of the head.

use aim_character::{Appearance, Criterion, Plausibility};
use maud::{Markup, html};

use super::chart::{Base, Mark, Scale, Series};
use crate::words::trimmed;

/// Returns the charts of the criteria that could be measured.
pub(super) fn charts(base: &Base<'_>, measured: &Plausibility) -> Markup {
    html! {
        (chart(base, measured, Criterion::HeadToChestHeading, |seen| seen.head_to_chest_heading_deg))
        (chart(base, measured, Criterion::ElevationError, |seen| seen.elevation_off_deg))
        (chart(base, measured, Criterion::HeadingError, |seen| seen.heading_off_deg))
        (chart(base, measured, Criterion::HeadAcceleration, |seen| seen.head_acceleration_deg_s2))
    }
}

fn chart(
    base: &Base<'_>,
    measured: &Plausibility,
    criterion: Criterion,
    pick: fn(&Appearance) -> Option<f64>,
) -> Markup {
    let values: Vec<f64> = measured.frames.iter().map(|seen| pick(seen).unwrap_or(f64::NAN)).collect();
    let is_of_head = criterion == Criterion::HeadToChestHeading;
    let animated: Vec<f64> = if is_of_head {
        measured.frames.iter().map(|seen| seen.animated_heading_deg.unwrap_or(f64::NAN)).collect()
    } else {
        Vec::new()
    };
    let seen = values.iter().chain(&animated).filter(|value| value.is_finite());
    let most = seen.fold(0.0_f64, |most, value| most.max(value.abs()));
    if values.iter().all(|value| value.is_nan()) {
        return html! {};
    }
    let must = criterion.must(measured.is_humanoid);
    let (title, label, unit) = match criterion {
        Criterion::HeadToChestHeading => (
            "Head relative to chest",
            "Heading of the head relative to the chest over time, animation and correction together.",
            "degrees, positive to the left",
        ),
        Criterion::ElevationError => (
            "Vertical gaze error",
            "Elevation of the gaze minus that of the target over time; it counts while the target is within reach \
             and the gaze has had time to arrive.",
            "degrees, positive upwards",
        ),
        Criterion::HeadingError => (
            "Horizontal gaze error",
            "Heading of the gaze minus that of the target over time; it counts while the target is within reach \
             and the gaze has had time to turn.",
            "degrees, positive to the left",
        ),
        _ => (
            "Head acceleration",
            "Acceleration of the head's correction relative to the chest's over time.",
            "degrees per second squared",
        ),
    };
    // A limit far beyond all values is left out: it would flatten the curve.
    let room = most.max(must.filter(|must| *must < 2.5 * most.max(5.0)).unwrap_or(0.0)).max(5.0) * 1.08;
    let is_size = criterion == Criterion::HeadAcceleration;
    let scale = if is_size { Scale::Linear(0.0, room) } else { Scale::Degrees(-room, room) };
    let mut chart = base.chart(label.to_owned(), unit, scale);
    chart.wraps = (!is_size).then_some(360.0);
    for must in must.into_iter().filter(|must| *must <= room) {
        let label = trimmed(must, 0);
        let ends: &[f64] = if is_size { &[1.0] } else { &[1.0, -1.0] };
        chart.marks.extend(ends.iter().map(|sign| Mark { value: must * sign, class: "plain", label: label.clone() }));
    }
    let mut counted = values.clone();
    let counts: Option<fn(&Appearance) -> bool> = match criterion {
        Criterion::ElevationError => Some(|seen| seen.elevation_counts),
        Criterion::HeadingError => Some(|seen| seen.heading_counts),
        _ => None,
    };
    if let Some(counts) = counts {
        chart.series.push(Series { name: "on the way or out of reach", class: "pitch", values });
        for (value, _) in counted.iter_mut().zip(&measured.frames).filter(|(_, seen)| !counts(seen)) {
            *value = f64::NAN;
        }
    }
    if is_of_head {
        chart.series.push(Series { name: "in the clip", class: "clip", values: animated });
    }
    chart.series.push(Series { name: if is_of_head { "aimed" } else { "counted" }, class: "one", values: counted });
    chart.figure(title)
}
