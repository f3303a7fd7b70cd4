//! `aim reach`: guides a hand or foot through points and writes the result.

use aim_character::{Goal, LimbNodes, Measurement, ReachPlan, reach};
use aim_gltf::Document;

use crate::args;
use crate::failure::{Failure, Result};
use crate::files;
use crate::html::{self, Takes};
use crate::outputs::Outputs;
use crate::reach_report::ReachReport;

pub(super) fn run(arguments: &args::Reach) -> Result {
    let (times, targets) = (&arguments.at, &arguments.target);
    if times.len() != targets.len() {
        return Err(Failure::input(format!(
            "--at is given {} times but --target {} times; give both once for each point",
            times.len(),
            targets.len()
        )));
    }
    let document = files::load_model(&arguments.file)?;
    Outputs::default().reading_parts_of(&document).write_model(arguments.written.targets(), &arguments.file)?;
    let file = &arguments.file;
    let clip = match &arguments.clip {
        Some(name) => document.clip(name).map_err(Failure::of(file))?,
        None => document.default_clip().ok_or_else(|| {
            Failure::in_file(&arguments.file, "no clip to change; export the character with an animation")
        })?,
    };
    let limb = LimbNodes::find(document.skeleton(), &arguments.bone).map_err(Failure::of(file))?;
    let goals: Vec<Goal> = times.iter().zip(targets).map(|(&at, target)| Goal { at, target: target.0 }).collect();
    let plan = ReachPlan { document: &document, clip, limb, goals: &goals, fps: arguments.fps };
    let reached = reach(&plan).map_err(Failure::of(file))?;
    let model = document.with_clips(std::slice::from_ref(&reached.clip)).map_err(Failure::of(file))?;
    let written = Document::from_bytes(&model).map_err(Failure::of(file))?;
    let after = written.clip(reached.clip.name()).map_err(|error| Failure::in_file(&arguments.written.out, error))?;
    let report = ReachReport::new(&arguments.bone, &plan, &reached, &written, after);
    let takes = Takes { document: &document, measurement: &Measurement::of(&document), limb, before: clip, after };
    arguments.written.targets().write(&model, &report, || html::trajectory_page(&report, &goals, &takes))?;
    files::print(&format!("{}wrote {}\n", report.in_words(), arguments.written.out.display()))
}
