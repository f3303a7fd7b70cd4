//! One joint's settings.

use super::Conventions;
use super::axes;
use super::range::range;
use super::read;
use super::report::Report;
use super::settings::{Key, Settings};
use crate::declare::messages::{self, Expected, Owner};
use crate::declare::tree::{Joint, Kind, Value};
use crate::{AngleRange, Frame, JointSpec};

/// What a joint may say.
pub(super) const KEYS: &[Key] = &[
    ("heading", Expected::HeadingRange),
    ("pitch", Expected::AngleRange),
    ("rate", Expected::Rate),
    ("acceleration", Expected::Acceleration),
    ("comfort", Expected::Number),
    ("level", Expected::Number),
    ("narrowing", Expected::Number),
    ("range", Expected::RangeKind),
    ("bone", Expected::NodeNames),
    ("pair", Expected::NodeName),
    ("bones", Expected::Axes),
    ("mirrored", Expected::Flag),
];

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
    if !settings.has("rate") {
        report.error(name_place(joint), messages::no_rate(&name, report.notation));
    }
    let acceleration = settings
        .get("acceleration")
        .map(|value| read::positive_angle(report, "acceleration", Expected::Acceleration, value));
    let comfort = settings.get("comfort").map_or(Some(1.0), |value| read::positive_number(report, "comfort", value));
    let level = settings.get("level").map(|value| read::share(report, "level", value));
    let has_ends = settings.has("heading") && settings.has("pitch") && heading != Some(Some(AngleRange::Free));
    let narrowing = settings.get("narrowing").map(|value| {
        if !has_ends {
            report
                .error(&value.place, messages::narrowing_without_ends(settings.has("heading"), settings.has("pitch")));
        }
        read::share(report, "narrowing", value)
    });
    let absolute = settings.get("range").map_or(Some(false), |value| {
        read::either(report, "range", Expected::RangeKind, ["absolute", "relative"], value)
    });
    let pair = settings.get("pair").and_then(|value| {
        if !is_first {
            report.error(&value.place, messages::pair_inward());
        }
        read::node(report, "pair", Expected::NodeName, value).map(|(pair, _)| pair.to_owned())
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
        frame: frame?,
        pitch: optional(pitch)?,
        heading: optional(heading)?,
        absolute: absolute?,
        rate: rate?,
        acceleration: match acceleration {
            Some(acceleration) => Some(acceleration?),
            None => None,
        },
        comfort: comfort?,
        level: match level {
            Some(level) => Some(level?),
            None => None,
        },
        narrowing: match narrowing {
            Some(narrowing) => Some(narrowing?),
            None => None,
        },
        pair,
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
    if let Some(value) = settings.get("bones") {
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
