//! Checks the neutral tree and builds a [`RigSpec`]. The only source of errors in what users declare; reports all of
//! them.

mod axes;
mod conventions;
mod frame;
mod joint;
mod kernels;
pub(crate) mod keys;
mod names;
mod natural;
mod range;
pub(crate) mod read;
mod region;
pub(crate) mod settings;

use proc_macro2::TokenStream;

use self::conventions::Conventions;
use self::keys::{EFFECTOR_KEYS, JOINT_KEYS, Key, RIG_KEYS};
use self::settings::{Level, Setting, Settings};
use super::report::Report;
use super::report::diagnostics::Diagnostic;
use super::report::messages::{self, Owner};
use super::tree::{Joint, Kind, Notation, Rig, Section, Value};
use crate::{EffectorSpec, Frame, JointSpec, RigSpec};

/// A checked declaration.
pub(super) struct Checked {
    pub(super) spec: RigSpec,
    /// Path given by `crate = …`.
    pub(super) krate: Option<TokenStream>,
}

/// Checks the whole declaration.
pub(super) fn check(rig: &Rig) -> Result<Checked, Vec<Diagnostic>> {
    let mut report = Report::new(rig.notation);
    let checked = check_rig(rig, &mut report);
    match checked {
        Some(checked) if report.is_empty() => Ok(checked),
        _ => Err(report.into_list()),
    }
}

fn check_rig(rig: &Rig, report: &mut Report) -> Option<Checked> {
    check_item(rig, report);
    names::check(rig, report);

    let foreign = rig.notation.pick("joint", "crate");
    let keys: Vec<Key> = RIG_KEYS.iter().copied().filter(|(key, _)| *key != foreign).collect();
    let settings = Settings::read(&rig.section.entries, &keys, Level::Rig, report);
    check_attributes("aim", &rig.section, report);

    let is_right = settings
        .read_value("handedness", report, |report, setting| read::is_first_of(report, setting, ["right", "left"]));
    let hand = if is_right == Some(false) { -1.0 } else { 1.0 };
    let axes = settings.read_value("axes", report, |report, setting| axes::read(report, Owner::Rig, hand, setting));
    let frame = axes.as_ref().and_then(|axes| axes.frame(report, Owner::Rig, hand));
    let conventions = Conventions { hand, axes, frame };

    let krate = settings.read_value("crate", report, read::path);
    settings.read_value("joint", report, read::mismatch::<()>);
    if rig.joints.is_empty() && rig.item.wrong_shape.is_none() && !settings.has("joint") {
        let place = rig.name.as_ref().map_or(&rig.section.place, |name| &name.place);
        report.error(place, messages::no_joints(rig.notation));
    }

    let mut joints: Vec<(&Joint, Settings<'_>)> = Vec::new();
    for joint in &rig.joints {
        let settings = Settings::read(&joint.section.entries, JOINT_KEYS, Level::Joint, report);
        if check_joint_attributes(rig.notation, joint, report) {
            joints.push((joint, settings));
        }
    }
    let inherits = joints.iter().any(|(_, settings)| !settings.has("axes"));
    let declares_nothing =
        report.notation == Notation::Rust && rig.section.attributes.iter().any(|found| !found.has_list);
    if inherits && !settings.has("axes") && !declares_nothing {
        report.error(missing_axes_place(rig), messages::no_axes(rig.notation));
    }

    let specs = joints.iter().enumerate();
    let specs: Vec<Option<JointSpec>> =
        specs.map(|(at, (joint, settings))| joint::check(joint, settings, at == 0, &conventions, report)).collect();
    names::check_bones(&joints, report);

    let specs: Option<Vec<JointSpec>> = specs.into_iter().collect();
    let first = specs.as_ref().and_then(|specs| specs.first()).map(|joint| joint.frame);
    let effector = effector(settings.get("effector"), first, report);
    let natural = settings.read_value("natural", report, natural::check);
    let region = settings.read_value("region", report, region::check);
    let kernels = settings.get("kernels").map_or_else(Vec::new, |setting| kernels::check(report, setting));
    let name = rig.name.as_ref().and_then(Value::text)?.to_owned();
    Some(Checked { spec: RigSpec { name, joints: specs?, effector: effector?, natural, region, kernels }, krate })
}

/// Returns the place for a report of missing axes: the first attribute, or the struct's name; in TOML the start of the
/// file.
fn missing_axes_place(rig: &Rig) -> &super::source_place::SourcePlace {
    rig.section.attributes.first().map_or(&rig.section.place, |attribute| &attribute.place)
}

/// Checks the Rust item itself.
fn check_item(rig: &Rig, report: &mut Report) {
    let item = &rig.item;
    if let Some((what, place)) = &item.wrong_shape {
        report.error(place, messages::wrong_shape(what));
    }
    if let Some(place) = &item.generics {
        report.error(place, messages::generics());
    }
    for (field, found) in &item.foreign {
        report.error(&found.place, messages::foreign_field(field, &found.text));
    }
    for attribute in &item.misplaced {
        report.error(&attribute.place, messages::misplaced(&attribute.text));
    }
}

fn check_attributes(name: &str, section: &Section, report: &mut Report) {
    for attribute in section.attributes.iter().filter(|attribute| !attribute.has_list) {
        report.error(&attribute.place, messages::no_list(name));
    }
    if let [first, others @ ..] = section.attributes.as_slice() {
        for other in others {
            let note = messages::first_attribute(name);
            report.error_with_note(&other.place, messages::several_attributes(name), note, &first.place);
        }
    }
}

/// Returns `true` if the joint has settings to check; reports faulty attributes.
fn check_joint_attributes(notation: Notation, joint: &Joint, report: &mut Report) -> bool {
    check_attributes("joint", &joint.section, report);
    if notation == Notation::Rust && joint.section.attributes.is_empty() {
        report.error(&joint.section.place, messages::no_attribute(joint.name_or_joint()));
        return false;
    }
    joint.section.attributes.iter().all(|attribute| attribute.has_list)
}

/// Reads the effector, in the first joint's bone space. If it declares its own forward, up stays as near as possible to
/// the joint's.
fn effector(declared: Option<Setting<'_>>, first: Option<Frame>, report: &mut Report) -> Option<EffectorSpec> {
    let Some(declared) = declared else { return Some(EffectorSpec { frame: first?, origin: [0.0; 3] }) };
    let Kind::Table(entries) = &declared.value.kind else { return read::mismatch(report, declared) };
    let settings = Settings::read(entries, EFFECTOR_KEYS, Level::Table, report);
    let forward = settings.read_value("forward", report, axes::direction);
    let origin = settings.read_value("origin", report, read::vector).unwrap_or_default();
    let first = first?;
    Some(EffectorSpec { frame: forward.map_or(first, |forward| turned(first, forward)), origin })
}

/// Returns the first joint's frame with another forward; up is orthogonalised against it.
///
/// If the new forward is parallel to up, the character looks straight up or down; up then points along the old back
/// (when looking up) or the old forward (when looking down).
fn turned(first: Frame, forward: frame::Vector) -> Frame {
    let along = frame::dot(first.up, forward);
    let is_parallel = frame::length(frame::cross(first.up, forward)) < frame::SQUARE_SIN;
    let up = if is_parallel { frame::scale(-along.signum(), first.forward) } else { first.up };
    frame::square(up, forward, first.handedness())
}
