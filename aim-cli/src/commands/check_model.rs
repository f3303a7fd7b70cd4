//! `aim check FILE --rig RIG.toml`: checks whether a declaration and a model agree.

use std::path::Path;

use aim_character::{Fit, Measurement, NEAR_DEG, chain_nodes, evidence, limbs_on_each};
use aim_codegen::{JointSpec, RigSpec};
use aim_gltf::Document;

use crate::failure::{Failure, Result};
use crate::files;

pub(super) fn run(file: &Path, rig: &Path) -> Result {
    let spec = files::load_rig(rig)?;
    let document = files::load_model(file)?;
    let measurement = Measurement::of(&document);
    let fit = Fit::new(&spec, &document, &measurement);
    if !fit.problems.is_empty() {
        let facing = evidence::facing(&measurement, &document);
        return Err(Failure::Check(format!(
            "{} does not match {}:\n  {}\n{facing} To see the axes, run `aim inspect {} --rig {} --html look.html`.",
            rig.display(),
            file.display(),
            fit.problems.join("\n  "),
            file.display(),
            rig.display()
        )));
    }
    let mut out = format!("{} matches {}\n", rig.display(), file.display());
    for joint in &fit.joints {
        let off = (0..3).map(|at| joint.off_deg(at)).fold(0.0, f64::max);
        let bone = Some(&joint.bone.name).filter(|bone| *bone != joint.joint);
        let bone = bone.map_or(String::new(), |bone| format!(" (bone {bone})"));
        out += &format!("{}{bone}: axes as declared, off by at most {off:.1}°", joint.joint);
        out += if off > NEAR_DEG { "; the exact frame from `aim rig` would aim better\n" } else { "\n" };
    }
    out += &about_limbs(&spec, &document, &measurement);
    files::print(&out)
}

/// Returns a line for each joint that carries arms, which says whether the rig holds them.
fn about_limbs(spec: &RigSpec, document: &Document, measurement: &Measurement) -> String {
    let skeleton = document.skeleton();
    let Ok(chain) = chain_nodes(spec, skeleton) else { return String::new() };
    let is_of_head = |joint: &(&JointSpec, &usize)| joint.0.role.is_of_head();
    let of_head = spec.joints.iter().zip(&chain.joints).filter(is_of_head).map(|(_, &node)| node);
    let mut out = String::new();
    for (node, limbs) in limbs_on_each(skeleton, measurement, of_head) {
        let joint = chain.joints.iter().position(|&joint| joint == node).map_or("", |at| &spec.joints[at].name);
        let is_held = |limb: usize| chain.holds.as_ref().is_none_or(|holds| holds.iter().any(|hold| hold.node == limb));
        let (held, loose): (Vec<usize>, Vec<usize>) = limbs.into_iter().partition(|&limb| is_held(limb));
        let names = |limbs: &[usize]| {
            limbs.iter().map(|&limb| format!("{:?}", skeleton.names()[limb])).collect::<Vec<_>>().join(", ")
        };
        if !held.is_empty() {
            let how =
                if chain.holds.is_some() { "held as declared" } else { "held by default, as no joint declares hold" };
            out += &format!("{joint}: carries {}, {how}\n", names(&held));
        }
        if !loose.is_empty() {
            let all = names(&loose);
            out += &format!(
                "{joint}: carries {all}, which turn with it; declare hold = [{all}] to keep them with the trunk\n"
            );
        }
    }
    out
}
