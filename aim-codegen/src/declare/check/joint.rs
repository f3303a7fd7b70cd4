//! One joint's settings.

use super::axes;
use super::conventions::Conventions;
use super::range::range;
use super::read;
use super::settings::Settings;
use crate::declare::report::Report;
use crate::declare::report::messages::{self, Expected, Owner};
use crate::declare::tree::{Joint, Kind, Value};
use crate::{AngleRange, Frame, JointSpec};
use aim_model::{LimitsFrom, Role};

/// The largest rate that is accepted, rad/s (5730°/s). Human eyes reach 700°/s and fast machines a few turns a second;
/// beyond, degrees were written as radians.
const FASTEST_RAD_S: f64 = 100.0;

/// Checks a joint; `None` if anything of it was reported.
pub(super) fn check(
    joint: &Joint,
    settings: &Settings<'_>,
    is_first: bool,
    conventions: &Conventions<'_>,
    report: &mut Report,
) -> Option<JointSpec> {
    let name = name_of(joint);
    let heading = settings.get("heading").map(|value| range(report, "heading", value));
    let pitch = settings.get("pitch").map(|value| range(report, "pitch", value));
    if !settings.has("heading") && !settings.has("pitch") {
        report.error(name_place(joint), messages::no_angle(&name, report.notation));
    }
    let rate = settings.get("rate").and_then(|value| read::positive_angle(report, "rate", Expected::Rate, value));
    if let Some(fast) = rate.filter(|rate| *rate > FASTEST_RAD_S) {
        if let Some(value) = settings.get("rate") {
            report.error(&value.place, messages::rate_beyond(&value.describe(), fast, report.notation));
        }
    }
    let rate = rate.filter(|rate| *rate <= FASTEST_RAD_S);
    if !settings.has("rate") {
        report.error(name_place(joint), messages::no_rate(&name, report.notation));
    }
    let acceleration = settings
        .get("acceleration")
        .map(|value| read::positive_angle(report, "acceleration", Expected::Acceleration, value));
    let stiffness =
        settings.get("stiffness").map_or(Some(1.0), |value| read::positive_number(report, "stiffness", value));
    let upright = settings.get("upright").map(|value| read::share(report, "upright", value));
    let has_ends = settings.has("heading") && settings.has("pitch") && heading != Some(Some(AngleRange::Free));
    let pitch_taper = settings.get("pitch_taper").map(|value| {
        if !has_ends {
            report.error(
                &value.place,
                messages::pitch_taper_without_ends(settings.has("heading"), settings.has("pitch")),
            );
        }
        read::share(report, "pitch_taper", value)
    });
    let limits_from = settings.get("limits_from").map_or(Some(LimitsFrom::Animation), |value| {
        let words = ["bind_pose", "animation"];
        let is_bind_pose = read::either(report, "limits_from", Expected::LimitsFrom, words, value)?;
        Some(if is_bind_pose { LimitsFrom::BindPose } else { LimitsFrom::Animation })
    });
    let role = settings.get("role").map_or(Some(Role::None), |value| read::role(report, "role", value));
    let other_eye = settings.get("other_eye").and_then(|value| {
        if !is_first {
            report.error(&value.place, messages::other_eye_inward());
        }
        read::node(report, "other_eye", Expected::NodeName, value).map(|(node, _)| node.to_owned())
    });
    let bones = match settings.get("bone") {
        Some(value) => read::nodes(report, "bone", value).into_iter().map(|(bone, _)| bone.to_owned()).collect(),
        None => vec![name.clone()],
    };
    let frame = frame(settings, conventions, report);
    // An inner `None` was reported; an outer one is a setting left out.
    let optional = |range: Option<Option<_>>| range.map_or(Some(None), |range| range.map(Some));
    Some(JointSpec {
        name,
        bones,
        role: role?,
        frame: frame?,
        pitch: optional(pitch)?,
        heading: optional(heading)?,
        limits_from: limits_from?,
        rate: rate?,
        acceleration: match acceleration {
            Some(acceleration) => Some(acceleration?),
            None => None,
        },
        stiffness: stiffness?,
        upright: match upright {
            Some(upright) => Some(upright?),
            None => None,
        },
        pitch_taper: match pitch_taper {
            Some(taper) => Some(taper?),
            None => None,
        },
        other_eye,
    })
}

/// The joint's name as far as it has one.
pub(super) fn name_of(joint: &Joint) -> String {
    match &joint.name {
        Some(Value { kind: Kind::Text(name), .. }) => name.clone(),
        _ => "joint".into(),
    }
}

/// Where something missing in the joint is reported: at its name, the smallest place that tells which joint it is.
fn name_place(joint: &Joint) -> &crate::declare::place::Place {
    joint.name.as_ref().map_or(&joint.section.place, |name| &name.place)
}

/// The joint's own axes, or the rig's.
fn frame(settings: &Settings<'_>, conventions: &Conventions<'_>, report: &mut Report) -> Option<Frame> {
    let mirrored = match settings.get("mirrored") {
        Some(value) => read::flag(report, "mirrored", value)?,
        None => false,
    };
    let (owner, hand) =
        if mirrored { (Owner::MirroredJoint, -conventions.hand) } else { (Owner::Joint, conventions.hand) };
    if let Some(value) = settings.get("axes") {
        let axes = axes::read(report, owner, hand, value)?;
        return axes.frame(report, owner, hand);
    }
    let axes = conventions.axes.as_ref()?;
    match settings.get("mirrored") {
        Some(value) if mirrored && axes.is_triple() => {
            let text = messages::mirrored_without_axes(report.notation);
            report.error_with_note(&value.place, text, messages::rig_axes_here(), axes.place);
            None
        }
        _ if mirrored => axes.frame(report, owner, hand),
        // Checked, and reported if need be, once for the rig.
        _ => conventions.frame,
    }
}
