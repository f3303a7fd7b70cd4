//! The charts of the page about a bake: their contents and scales.

use aim_character::range_in_frame;
use aim_codegen::AngleRange;
use aim_runtime::Settings;
use maud::{Markup, html};

use super::chart::{Base, Mark, Scale, Series};
use super::directions::Directions;
use super::gaze;
use super::looks;
use super::subject::BakePage;
use crate::bake_report::{BakeFrame, BakeReport, JointReport};
use crate::words::{self, Wanted, chip, shown, trimmed};

/// Returns all charts of the page. `directions` are `None` if the document lacks bones of the rig.
pub(super) fn all(subject: &BakePage<'_>, directions: Option<&Directions>) -> Markup {
    let BakePage { spec, report, .. } = *subject;
    let times: Vec<f64> = report.frames.iter().map(|frame| frame.t.into()).collect();
    let statuses: Vec<&str> = report.frames.iter().map(|frame| frame.status).collect();
    let base = Base { times: &times, statuses: &statuses, wanted: report.wanted() };
    let has_head = directions.is_some_and(|directions| directions.head.is_some());
    html! {
        p {
            "Azimuth and elevation are the angles of a direction, seen from the effector, to the left of and above the \
             direction in which the effector looks in the bind pose. "
            @if let Some(carrier) = directions.and_then(|directions| directions.carrier.as_deref()) {
                "They turn with " (carrier) ", which carries the chain, so that 0° stays ahead of the body. "
            }
            @if has_head {
                "“Head” is where the gaze would point with the eye at rest, “eye in head” is the remainder of the gaze, and \
                 “clip” is the head in the clip alone. "
            } @else {
                "“Clip” is the gaze in the clip alone. "
            }
            "Dashed horizontal lines are limits; shading marks where one is reached: an angle at an end of its range, a \
             speed at its rate. The band below each chart shows the status, with its name in the JSON report:"
        }
        p.statuses {
            @for (word, ours, _, meaning) in report.wanted().statuses().filter(|(word, ..)| statuses.contains(word)) {
                span.chip title=(meaning) { (chip(word)) (ours) @if word != ours { small { code { (word) } } } }
            }
        }
        div.charts {
            (error(&base, report))
            @if let Some(directions) = directions { (gaze::charts(&base, directions)) }
            (roll(&base, report))
            (looks::charts(&base, &report.plausibility))
            @for k in 0..spec.joints.len() { (angles(&base, subject, k)) }
        }
    }
}

fn error(base: &Base<'_>, report: &BakeReport) -> Markup {
    let values: Vec<f64> = report.frames.iter().map(BakeFrame::off_deg).collect();
    let wanted = report.wanted().noun();
    let worst = values.iter().copied().fold(0.0, f64::max);
    let tolerance = f64::from(Settings::default().tolerance).to_degrees();
    let label = format!(
        "Angle between the gaze and the {wanted} over time, at most {}; the {wanted} counts as reached within {}°.",
        words::degrees(worst),
        trimmed(tolerance, 3)
    );
    let mut chart =
        base.chart(label, "degrees, logarithmic; values below 0.001 drawn at 0.001", Scale::Log(1e-3, 180.0));
    chart.wide = true;
    chart.series.push(Series { name: "error", class: "one", values });
    let pair: Vec<f64> = report.frames.iter().filter_map(BakeFrame::pair_off_deg).collect();
    if !pair.is_empty() && pair.len() == report.frames.len() {
        // Drawn below the error of the aimed eye, which decides the status.
        chart.series.insert(0, Series { name: "other eye", class: "pitch", values: pair });
    }
    chart.marks.push(Mark { value: tolerance, class: "plain", label: format!("{}°", trimmed(tolerance, 3)) });
    if report.wanted() == Wanted::Goal {
        let from_target = report.frames.iter().map(|frame| frame.error_deg).collect();
        chart.series.insert(0, Series { name: "from the target", class: "target-line", values: from_target });
    }
    chart.figure(&format!("Error: angle between gaze and {wanted}"))
}

fn roll(base: &Base<'_>, report: &BakeReport) -> Markup {
    let values: Vec<f64> = report.frames.iter().map(|frame| frame.roll_deg).collect();
    let most = report.summary.max_roll_deg;
    let label = format!(
        "Roll of the effector's joint about the gaze over time, in addition to the animation's; at most {} to either side.",
        words::degrees(most)
    );
    let room = (1.1 * most).max(5.0);
    let mut chart = base.chart(label, "degrees, positive to the left", Scale::Degrees(-room, room));
    chart.wraps = Some(360.0);
    chart.series.push(Series { name: "roll", class: "one", values });
    chart.figure("Added roll about the gaze")
}

fn angles(base: &Base<'_>, subject: &BakePage<'_>, index: usize) -> Markup {
    let BakePage { spec, report, .. } = *subject;
    let joint = &spec.joints[index];
    let told = || report.frames.iter().filter_map(|frame| frame.joints.get(index));
    let bone = told().next().map_or(joint.name.as_str(), |joint| joint.bone.name.as_str());
    let of = |pick: fn(&JointReport) -> f64| told().map(pick).collect::<Vec<f64>>();
    let parts = [
        ("heading", joint.heading, of(|joint| joint.heading_deg)),
        ("pitch", joint.pitch, of(|joint| joint.pitch_deg)),
    ];
    let ranges = ranges(subject, index);
    let (mut low, mut high) = (0.0_f64, 0.0_f64);
    let (mut series, mut marks) = (Vec::new(), Vec::new());
    let mut bound: Vec<bool> = told().map(|joint| joint.at_limit).collect();
    for ((name, range, values), ends) in parts.iter().zip(ranges) {
        if range.is_none() {
            continue;
        }
        for (k, bound) in bound.iter_mut().enumerate() {
            *bound |= ends.iter().any(|end| end.get(k).is_some_and(|end| (values[k] - end).abs() < AT_END));
        }
        for value in ends.iter().flatten().chain(values).filter(|value| value.is_finite()) {
            (low, high) = (low.min(*value), high.max(*value));
        }
        for end in ends {
            match end.as_slice() {
                [first, rest @ ..] if rest.iter().all(|value| value == first || (value - first).abs() < 1e-6) => {
                    marks.push(Mark { value: *first, class: name, label: format!("{}°", shown(*first, 1)) });
                }
                // A limit that changes over time is drawn as a line.
                _ => series.push(Series {
                    name: "",
                    class: if *name == "heading" { HEADING_END } else { PITCH_END },
                    values: end,
                }),
            }
        }
        series.push(Series { name, class: name, values: values.clone() });
    }
    marks.retain(|mark| mark.value.is_finite());
    let parts: Vec<_> = parts.into_iter().filter_map(|(name, range, values)| Some((name, range?, values))).collect();
    let room = (0.06 * (high - low)).max(1.0);
    let label = format!("Heading and pitch added to {bone} over time, with the limits of their ranges.");
    let mut chart = base.chart(label, "degrees", Scale::Degrees(low - room, high + room));
    chart.wraps = parts.iter().any(|(_, range, _)| *range == AngleRange::Free).then_some(360.0);
    chart.marks = marks;
    chart.series = series;
    chart.bound = bound;

    let rate = joint.rate.to_degrees();
    let label = format!("Angular speed of {bone} over time; its rate is {}° per second.", trimmed(rate, 1));
    let mut speed = base.chart(label, "degrees per second", Scale::Linear(0.0, rate));
    speed.series.extend(parts.iter().map(|(name, range, values)| Series {
        name,
        class: name,
        values: speeds(base.times, values, *range),
    }));
    let is_at_rate = |speed: &f64| *speed >= rate * (1.0 - AT_RATE);
    let at_rate = |k: usize| speed.series.iter().any(|series| series.values.get(k).is_some_and(is_at_rate));
    speed.bound = (0..base.times.len().min(report.frames.len())).map(at_rate).collect();
    let fastest = speed.series.iter().flat_map(|series| &series.values).filter(|v| v.is_finite());
    speed.scale = Scale::Linear(0.0, fastest.copied().fold(rate, f64::max) * 1.06);
    speed.marks.push(Mark { value: rate, class: "plain", label: format!("{}°/s", trimmed(rate, 1)) });
    html! {
        (chart.figure(&format!("{bone}: angles and ranges")))
        (speed.figure(&format!("{bone}: speed and rate")))
    }
}

/// Distance from an end of its range at which an angle counts as at its limit, degrees.
const AT_END: f64 = 1e-2;
/// Share of its rate by which a speed may be below it and still count as at its rate, because angles are in single
/// precision.
const AT_RATE: f64 = 1e-3;

/// CSS class of heading limits that change over time.
const HEADING_END: &str = "heading limit";
/// CSS class of pitch limits that change over time.
const PITCH_END: &str = "pitch limit";

/// Returns the lower and upper ends of heading and pitch in every frame, degrees.
pub(super) fn ranges(subject: &BakePage<'_>, index: usize) -> [[Vec<f64>; 2]; 2] {
    let mut ends: [[Vec<f64>; 2]; 2] = Default::default();
    for at in subject.baked.frames.iter().filter_map(|frame| frame.joints.get(index)) {
        for (ends, range) in ends.iter_mut().zip(range_in_frame(&subject.spec.joints[index], at)) {
            for (ends, end) in ends.iter_mut().zip(range) {
                ends.push(end.to_degrees());
            }
        }
    }
    ends
}

/// Returns the speed from the previous value to each value, per second; NaN for the first. A free range takes the
/// shorter way around.
pub(super) fn speeds(times: &[f64], values: &[f64], range: AngleRange) -> Vec<f64> {
    let between = |k: usize| {
        let change = values[k] - values[k - 1];
        let change = if range == AngleRange::Free { change - 360.0 * (change / 360.0).round() } else { change };
        change.abs() / (times[k] - times[k - 1])
    };
    (0..values.len().min(times.len())).map(|k| if k == 0 { f64::NAN } else { between(k) }).collect()
}
