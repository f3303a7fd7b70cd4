//! The charts: what each shows and over which values; drawn by [`Chart`].

use aim_codegen::{AngleRange, JointSpec, RigSpec};
use aim_gltf::{Baked, ChainNodes, Document, Measurement};
use aim_runtime::Settings;
use glam::{DAffine3, DVec3};
use maud::{Markup, html};

use super::chart::{Chart, Mark, Scale, Series};
use super::words::{self, chip, shown, trimmed};
use crate::report::{JointReport, Report};

/// Every chart of the page.
pub(super) fn all(spec: &RigSpec, report: &Report, document: &Document, baked: &Baked) -> Markup {
    let times: Vec<f64> = report.frames.iter().map(|frame| frame.t.into()).collect();
    let statuses: Vec<&str> = report.frames.iter().map(|frame| frame.status).collect();
    let base = Base { times: &times, statuses: &statuses };
    html! {
        p {
            "Azimuth and elevation are seen from the effector as its bind pose faces, carried by what the chain hangs on; "
            "dashed lines are limits. The band below each chart tells the status:"
        }
        p.statuses {
            @for (word, ours, meaning) in words::STATUSES.iter().filter(|(word, ..)| statuses.contains(word)) {
                span.chip title=(meaning) { (chip(word)) (ours) }
            }
        }
        div.charts {
            (error(&base, report))
            (directions(&base, spec, document, baked))
            @for (k, joint) in spec.joints.iter().enumerate() { (angles(&base, joint, report, k)) }
        }
    }
}

/// What the charts share.
struct Base<'a> {
    times: &'a [f64],
    statuses: &'a [&'a str],
}

impl<'a> Base<'a> {
    fn chart(&self, label: String, unit: &'static str, scale: Scale) -> Chart<'a> {
        let (times, statuses) = (self.times, self.statuses);
        Chart { label, unit, wide: false, times, statuses, scale, wraps: None, series: Vec::new(), marks: Vec::new() }
    }
}

fn error(base: &Base<'_>, report: &Report) -> Markup {
    let values: Vec<f64> = report.frames.iter().map(|frame| frame.error_deg).collect();
    let worst = values.iter().copied().fold(0.0, f64::max);
    let tolerance = f64::from(Settings::default().tolerance).to_degrees();
    let label = format!(
        "Angle between the gaze and the target over time, at most {}; the target counts as reached within {}°.",
        words::degrees(worst),
        trimmed(tolerance, 3)
    );
    let mut chart = base.chart(label, "degrees, logarithmic; below 0.001 drawn at 0.001", Scale::Log(1e-3, 180.0));
    chart.wide = true;
    chart.series.push(Series { name: "error", class: "one", values });
    chart.marks.push(Mark { value: tolerance, class: "plain", label: format!("{}°", trimmed(tolerance, 3)) });
    chart.figure("Error: the angle between gaze and target")
}

/// Where the target and the gaze are, as the effector would see them if no joint of the chain had moved from its bind
/// pose: in its bind frame, carried by the bone that the chain hangs on.
fn directions(base: &Base<'_>, spec: &RigSpec, document: &Document, baked: &Baked) -> Markup {
    let bones = spec.joints.iter().map(|joint| joint.bones.as_slice());
    let Ok(chain) = ChainNodes::find(document.skeleton(), bones, None) else { return html! {} };
    let bind = Measurement::of(document).bind_world;
    let carrier = chain.joints.last().and_then(|node| document.skeleton().nodes()[*node].parent);
    let first = chain.joints[0];
    let frame_of = |world: &[DAffine3]| {
        let moved = carrier.map_or(DAffine3::IDENTITY, |node| world[node] * bind[node].inverse());
        let axes = [spec.effector.frame.left, spec.effector.frame.up, spec.effector.frame.forward];
        axes.map(|axis| (moved * bind[first]).transform_vector3(DVec3::from(axis)).normalize_or_zero())
    };
    let seen = |world: &[DAffine3], v: DVec3| {
        let [left, up, forward] = frame_of(world).map(|axis| axis.dot(v));
        (left.atan2(forward).to_degrees(), up.atan2(left.hypot(forward)).to_degrees())
    };
    let (mut target, mut gaze) = (Vec::new(), Vec::new());
    for frame in &baked.frames {
        let eye = &frame.world[first];
        let origin = eye.transform_point3(DVec3::from(spec.effector.origin));
        target.push(seen(&frame.world, frame.target - origin));
        gaze.push(seen(&frame.world, eye.transform_vector3(DVec3::from(spec.effector.frame.forward))));
    }
    let figure = |title: &str, what: &str, scale: Scale, wraps: Option<f64>, pick: fn(&(f64, f64)) -> f64| {
        let mut chart = base.chart(format!("{what} of the target and of the gaze over time."), "degrees", scale);
        chart.wraps = wraps;
        let series = [("target", "target-line", &target), ("gaze", "one", &gaze)];
        chart.series =
            series.map(|(name, class, all)| Series { name, class, values: all.iter().map(pick).collect() }).into();
        chart.figure(title)
    };
    let elevation = Scale::Degrees(-90.0, 90.0);
    html! {
        (figure("Azimuth, positive to the left", "Azimuth", Scale::Degrees(-180.0, 180.0), Some(360.0), |at| at.0))
        (figure("Elevation, positive upwards", "Elevation", elevation, None, |at| at.1))
    }
}

fn angles(base: &Base<'_>, joint: &JointSpec, report: &Report, index: usize) -> Markup {
    let told = || report.frames.iter().filter_map(|frame| frame.joints.get(index));
    let bone = told().next().map_or(joint.name.as_str(), |joint| joint.bone.as_str());
    let of = |pick: fn(&JointReport) -> f64| told().map(pick).collect::<Vec<f64>>();
    let parts = [
        ("heading", joint.heading, of(|joint| joint.heading_deg)),
        ("pitch", joint.pitch, of(|joint| joint.pitch_deg)),
    ];
    let parts: Vec<_> = parts.into_iter().filter_map(|(name, range, values)| Some((name, range?, values))).collect();
    let (mut low, mut high) = (0.0_f64, 0.0_f64);
    let mut marks = Vec::new();
    for (name, range, values) in &parts {
        let ends = limits(*range);
        for value in ends.iter().chain(values).filter(|value| value.is_finite()) {
            (low, high) = (low.min(*value), high.max(*value));
        }
        marks.extend(ends.into_iter().map(|value| Mark { value, class: name, label: format!("{}°", shown(value, 1)) }));
    }
    let room = (0.06 * (high - low)).max(1.0);
    let label = format!("Heading and pitch added to {bone} over time, with the ends of their ranges.");
    let mut chart = base.chart(label, "degrees", Scale::Degrees(low - room, high + room));
    chart.wraps = parts.iter().any(|(_, range, _)| *range == AngleRange::Free).then_some(360.0);
    chart.marks = marks;
    chart.series = parts.iter().map(|(name, _, values)| Series { name, class: name, values: values.clone() }).collect();

    let rate = joint.rate.to_degrees();
    let label = format!("Angular speed of {bone} over time; its rate is {}° a second.", trimmed(rate, 1));
    let mut speed = base.chart(label, "degrees a second", Scale::Linear(0.0, rate));
    speed.series = parts
        .iter()
        .map(|(name, range, values)| Series { name, class: name, values: speeds(base.times, values, *range) })
        .collect();
    let fastest = speed.series.iter().flat_map(|series| &series.values).filter(|v| v.is_finite());
    speed.scale = Scale::Linear(0.0, fastest.copied().fold(rate, f64::max) * 1.06);
    speed.marks.push(Mark { value: rate, class: "plain", label: format!("{}°/s", trimmed(rate, 1)) });
    html! {
        (chart.figure(&format!("{bone}: angles and ranges")))
        (speed.figure(&format!("{bone}: speed and rate")))
    }
}

fn limits(range: AngleRange) -> Vec<f64> {
    match range {
        AngleRange::Between(low, high) => vec![low.to_degrees(), high.to_degrees()],
        AngleRange::Free => Vec::new(),
    }
}

/// The speed with which each value was come to, from the one before it; the first has none.
pub(super) fn speeds(times: &[f64], values: &[f64], range: AngleRange) -> Vec<f64> {
    let between = |k: usize| {
        let change = values[k] - values[k - 1];
        let change = if range == AngleRange::Free { change - 360.0 * (change / 360.0).round() } else { change };
        change.abs() / (times[k] - times[k - 1])
    };
    (0..values.len().min(times.len())).map(|k| if k == 0 { f64::NAN } else { between(k) }).collect()
}
