//! `aim check FILE --rig RIG.toml`: whether a declaration and a model agree, in words.

use std::path::Path;

use aim_character::{Fit, NEAR_DEG, evidence};
use aim_gltf::Measurement;

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
            "{} and {} contradict each other:\n  {}\n{facing} See it: aim inspect {} --rig {} --html look.html",
            rig.display(),
            file.display(),
            fit.problems.join("\n  "),
            file.display(),
            rig.display()
        )));
    }
    let mut out = format!("{} fits {}\n", rig.display(), file.display());
    for joint in &fit.joints {
        let off = (0..3).map(|at| joint.off_deg(at)).fold(0.0, f64::max);
        out += &format!("{}: {} is as declared, {off:.1}° off at most", joint.joint, joint.bone.name);
        out += if off > NEAR_DEG { "; its exact frame (aim rig) would aim better\n" } else { "\n" };
    }
    files::print(&out)
}
