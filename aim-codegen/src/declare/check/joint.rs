//! Checks the settings of one joint.

use aim_model::{LimitsFrom, Role};

use super::conventions::Conventions;
use super::settings::{Setting, Settings};
use super::{axes, range, read};
use crate::declare::report::Report;
use crate::declare::report::messages::{self, Owner};
use crate::declare::tree::Joint;
use crate::{AngleRange, Frame, JointSpec};

/// Largest accepted rate, rad/s (5730°/s). Human eyes reach 700°/s and fast machines a few turns per second; anything
/// above is a number of degrees written as radians.
const FASTEST_RAD_S: f64 = 100.0;

/// Checks a joint. Settings that were reported are treated as absent, since a rig with errors is not emitted.
pub(super) fn check(
    joint: &Joint,
    settings: &Settings<'_>,
    is_first: bool,
    conventions: &Conventions<'_>,
    report: &mut Report,
) -> Option<JointSpec> {
    let name = joint.name_or_joint();
    let heading = settings.read_value("heading", report, range::range);
    let pitch = settings.read_value("pitch", report, range::range);
    let (turns, nods) = (settings.has("heading"), settings.has("pitch"));
    if !turns && !nods {
        report.error(joint.name_place(), messages::no_angle(name, report.notation));
    }
    let rate = settings.read_value("rate", report, rate);
    if !settings.has("rate") {
        report.error(joint.name_place(), messages::no_rate(name, report.notation));
    }
    let acceleration = settings.read_value("acceleration", report, read::positive);
    let stiffness = settings.read_value("stiffness", report, read::positive);
    let upright = settings.read_value("upright", report, read::share);
    let pitch_taper = settings.read_value("pitch_taper", report, |report, setting| {
        if !turns || !nods || heading == Some(AngleRange::Free) {
            report.error(setting.place(), messages::pitch_taper_without_ends(turns, nods));
        }
        read::share(report, setting)
    });
    let from_bind_pose = settings.read_value("limits_from", report, |report, setting| {
        read::is_first_of(report, setting, ["bind_pose", "animation"])
    });
    let role = settings.read_value("role", report, read::role);
    let other_eye = settings.read_value("other_eye", report, |report, setting| {
        if !is_first {
            report.error(setting.place(), messages::other_eye_inward());
        }
        read::node(report, setting)
    });
    let bones = settings.read_value("bone", report, read::nodes);
    let hold = settings.read_value("hold", report, read::any_nodes);
    let frame = frame(settings, conventions, report);
    Some(JointSpec {
        name: name.to_owned(),
        bones: bones.unwrap_or_else(|| vec![name.to_owned()]),
        role: role.unwrap_or(Role::None),
        frame: frame?,
        pitch,
        heading,
        limits_from: if from_bind_pose == Some(true) { LimitsFrom::BindPose } else { LimitsFrom::Animation },
        rate: rate?,
        acceleration,
        stiffness: stiffness.unwrap_or(1.0),
        upright,
        pitch_taper,
        other_eye,
        hold,
    })
}

pub(super) fn rate(report: &mut Report, setting: Setting<'_>) -> Option<f64> {
    let rate = read::positive(report, setting)?;
    if rate <= FASTEST_RAD_S {
        return Some(rate);
    }
    report.refuse(setting.place(), messages::rate_beyond(&setting.value.describe(), rate, report.notation))
}

/// Returns the frame of the joint's own axes, or of the rig's.
fn frame(settings: &Settings<'_>, conventions: &Conventions<'_>, report: &mut Report) -> Option<Frame> {
    let mirrored = match settings.get("mirrored") {
        Some(setting) => read::flag(report, setting)?.then_some(setting),
        None => None,
    };
    let (owner, hand) = match mirrored {
        Some(_) => (Owner::MirroredJoint, -conventions.hand),
        None => (Owner::Joint, conventions.hand),
    };
    if let Some(setting) = settings.get("axes") {
        return axes::read(report, owner, hand, setting)?.frame(report, owner, hand);
    }
    let axes = conventions.axes.as_ref()?;
    match mirrored {
        Some(mirrored) if axes.is_triple() => {
            let text = messages::mirrored_without_axes(report.notation);
            report.error_with_note(mirrored.place(), text, messages::rig_axes_here(), axes.place);
            None
        }
        Some(_) => axes.frame(report, owner, hand),
        // Already checked, and reported if necessary, once for the rig.
        None => conventions.frame,
    }
}
