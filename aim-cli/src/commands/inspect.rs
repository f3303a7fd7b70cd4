//! `aim inspect`: shows a model's bones with measured axes and roles, and its clips.

use std::path::Path;

use aim_animation::Clip;
use aim_character::{BoneAxes, Evidence, Fit, MeasuredPose, Measurement, Role, evidence, limbs_on_each, propose};
use aim_gltf::Document;
use serde_json::{Value, json};

use crate::args;
use crate::failure::Result;
use crate::files;
use crate::html::{self, Inspected};
use crate::outputs::Outputs;

/// Deviation above which signed axes do not describe a bone, degrees.
const FAR_OFF_DEG: f64 = 20.0;

/// Returns a summary of the measurement: facing with its evidence, pose, size, and the bones that need a general frame.
fn in_words(measurement: &Measurement, document: &Document) -> String {
    let mut out = format!("{}\n", evidence::facing(measurement, document));
    for against in evidence::against(measurement, document) {
        out += &format!("Contrary evidence: {against}.\n");
    }
    out += &format!("Confidence {:.2}.", measurement.confidence);
    out += &evidence::doubt(measurement).map_or("\n".to_owned(), |doubt| format!(" {doubt}\n"));
    // If any bone has a role, only such bones are compared: a root without skin may lie anywhere in either pose.
    let has_role = |bone: &&BoneAxes| bone.role.is_some();
    let any = measurement.bones.iter().any(|bone| bone.role.is_some());
    let bones = measurement.bones.iter().filter(|bone| !any || has_role(bone));
    let turned = bones.max_by(|a, b| a.rest_deg.total_cmp(&b.rest_deg));
    out += &match (measurement.pose, turned.filter(|bone| bone.rest_deg > 0.1)) {
        (MeasuredPose::Rest, _) => "Measured in the rest pose, because no skin defines a bind pose.\n".to_owned(),
        (_, Some(BoneAxes { name, rest_deg, .. })) => {
            format!("Measured in the bind pose; the rest pose differs from it by up to {rest_deg:.1}° ({name}).\n")
        }
        _ => "Measured in the bind pose; the rest pose is the same.\n".to_owned(),
    };
    out += &format!("Height {:.4}, in the file's units.\n", measurement.height);
    let far = measurement.bones.iter().filter(|bone| bone.role.is_some() && bone.deviation_deg > FAR_OFF_DEG);
    let far: Vec<String> = far.map(|bone| format!("{} ({:.0}°)", bone.name, bone.deviation_deg)).collect();
    if !far.is_empty() {
        out += &format!("Far from any axis, so `aim rig` writes the exact frame: {}.\n", far.join(", "));
    }
    for (neck, limbs) in limbs_on_necks(measurement, document) {
        out += &format!(
            "{neck} carries {}, which turn with it unless held; `aim rig` and `aim bake` keep them with the trunk.\n",
            limbs.join(", ")
        );
    }
    out
}

/// Returns the necks that carry arms, each with the names of those arms.
fn limbs_on_necks<'d>(measurement: &Measurement, document: &'d Document) -> Vec<(&'d str, Vec<&'d str>)> {
    let skeleton = document.skeleton();
    let mut necks: Vec<usize> =
        measurement.bones.iter().filter(|bone| bone.role == Some(Role::Neck)).map(|bone| bone.node).collect();
    necks.sort_by_key(|&neck| std::cmp::Reverse(skeleton.ancestry(neck).count()));
    let name = |node: usize| skeleton.names()[node].as_str();
    let limbs = limbs_on_each(skeleton, measurement, necks).into_iter();
    limbs.map(|(neck, limbs)| (name(neck), limbs.into_iter().map(name).collect())).collect()
}

/// Returns the output of `--json`.
fn json(file: &str, document: &Document, measurement: &Measurement) -> Value {
    let names = document.skeleton().names();
    let bone = |bone: &BoneAxes| {
        json!({
            "name": bone.name,
            "parent": bone.parent.map(|parent| &names[parent]),
            "role": bone.role.map(Role::as_str),
            "up": bone.up.as_str(),
            "forward": bone.forward.as_str(),
            "left": bone.left.as_str(),
            "deviation_deg": rounded(bone.deviation_deg),
            "handedness": bone.handedness.as_str(),
        })
    };
    let said = |said: &Evidence| {
        json!({
            "clue": evidence::word(said),
            "up": said.up.map(|up| up.to_array().map(rounded)),
            "forward": said.forward.map(|forward| forward.to_array().map(rounded)),
            "agrees": said.agrees,
            "weight": said.weight,
        })
    };
    let clip = |clip: &Clip| json!({ "name": clip.name(), "seconds": clip.length_s() });
    json!({
        "file": file,
        "up": measurement.up.to_array().map(rounded),
        "forward": measurement.forward.to_array().map(rounded),
        "confidence": rounded(measurement.confidence),
        "evidence": measurement.evidence.iter().map(said).collect::<Value>(),
        "height": rounded(measurement.height),
        "bones": measurement.bones.iter().map(bone).collect::<Value>(),
        "clips": document.clips().iter().map(clip).collect::<Value>(),
    })
}

/// Returns the table of bones and the list of clips.
fn table(document: &Document, measurement: &Measurement) -> String {
    let widths = measurement.bones.iter().map(|bone| bone.name.chars().count());
    let width = widths.max().unwrap_or(0).max(4);
    let mut out = format!("{:<width$}  {:<9}  up  fwd  left   off  hand\n", "bone", "role");
    for bone in &measurement.bones {
        let BoneAxes { name, role, up, forward, left, deviation_deg, handedness, .. } = bone;
        let (role, hand) = (role.map_or("", Role::as_str), handedness.as_str());
        out += &format!("{name:<width$}  {role:<9}  {up}  {forward}   {left}   {deviation_deg:>4.1}°  {hand}\n");
    }
    out += if document.clips().is_empty() { "\nno clips\n" } else { "\nclips\n" };
    for clip in document.clips() {
        out += &format!("  {} {:.3} s\n", clip.name(), clip.length_s());
    }
    out
}

/// Rounds to a millionth, because further digits are noise of the file. Returns 0 instead of −0.
fn rounded(x: f64) -> f64 {
    (x * 1e6).round() / 1e6 + 0.0
}

/// Writes the page with the given rig, or else the proposed one. If none can be proposed, the page shows only the
/// bones.
fn draw(arguments: &args::Inspect, page: &Path, document: &Document, measurement: &Measurement) -> Result {
    let (spec, rig) = match &arguments.rig {
        Some(path) => (Some(files::load_rig(path)?), path.display().to_string()),
        None => {
            let proposed = propose(document, measurement, None);
            (proposed.ok().map(|proposal| proposal.spec), "the proposed rig".to_owned())
        }
    };
    let fit = spec.as_ref().map(|spec| Fit::new(spec, document, measurement));
    let file = arguments.file.file_name().unwrap_or_default().to_string_lossy();
    let inspected = Inspected { file: &file, document, measurement, fit: fit.as_ref(), rig: &rig };
    files::write(page, html::inspection_page(&inspected).as_bytes())
}

pub(super) fn run(arguments: &args::Inspect) -> Result {
    let document = files::load_model(&arguments.file)?;
    let read = [(Some(&arguments.file), "the model"), (arguments.rig.as_ref(), "the rig")];
    let mut outputs = Outputs::reading(read).reading_parts_of(&document);
    let measurement = arguments.facing.measure(&arguments.file, &document)?;
    if let Some(page) = &arguments.html {
        outputs.writes(page, "--html")?;
        draw(arguments, page, &document, &measurement)?;
    }
    let file = arguments.file.display().to_string();
    files::print(&if arguments.json {
        files::to_json(&json(&file, &document, &measurement))?
    } else {
        let drawn = arguments.html.as_ref().map_or(String::new(), |page| format!("\nwrote {}\n", page.display()));
        format!("{file}\n{}\n{}{drawn}", in_words(&measurement, &document), table(&document, &measurement))
    })
}
