//! `aim demo`: the bundled mannequin walks while a target orbits it.

use std::fs;
use std::path::Path;

use aim_character::MANNEQUIN_RIG;
use aim_gltf::{Document, Measurement, PAPER_AXES, mannequin};

use super::bake::Job;
use crate::args::{self, Settle};
use crate::failure::{Failure, Result};
use crate::files;
use crate::target::TargetSpec;

/// The target: 2 m away, a little above the eyes, once around in ten seconds.
const TARGET: TargetSpec = TargetSpec::Orbit { radius: 2.0, height: 0.15, seconds: 10.0 };
const FPS: f32 = 60.0;

pub(super) fn run(arguments: &args::Demo) -> Result {
    let spec = aim_codegen::declare::from_toml("rigs/mannequin.toml", MANNEQUIN_RIG)?;
    let model = mannequin(|_| PAPER_AXES).map_err(|error| Failure::input(error.to_string()))?;
    let file = Path::new("the mannequin");
    let document = Document::from_bytes(&model).map_err(|error| Failure::in_file(file, error))?;
    let clip = document.clips().first();
    // Whole walk cycles around one orbit, so that the result loops.
    let seconds = clip.map_or(10.0, |clip| clip.seconds() * (10.0 / clip.seconds()).round());
    let target = match TARGET {
        TargetSpec::Orbit { radius, height, .. } => TargetSpec::Orbit { radius, height, seconds: seconds.into() },
        other => other,
    };
    files::print(&format!(
        "aiming the mannequin's eye, neck and spine at a target that orbits it once in {seconds:.1} s\n"
    ))?;
    let measurement = Measurement::of(&document);
    let job = Job {
        file,
        document: &document,
        measurement: &measurement,
        spec: &spec,
        target: &target,
        clip,
        seconds,
        fps: FPS,
        aiming: arguments.aiming,
        settle: Settle::Snap,
        looped: true,
    };
    let done = job.run()?;
    fs::create_dir_all(&arguments.out).map_err(|error| {
        Failure::in_file(&arguments.out, format!("cannot be made ({error}); give a folder with --out"))
    })?;
    let glb = arguments.out.join("aimed.glb");
    let report = files::to_json(&done.report)?;
    let page = job.page(&done);
    files::write_all(&[
        (&glb, &done.model),
        (&arguments.out.join("report.json"), report.as_bytes()),
        (&arguments.out.join("report.html"), page.as_bytes()),
    ])?;
    files::print(&format!("{}\n", done.report.in_words(&glb)))?;
    files::print(&format!(
        "wrote report.html and report.json beside it; open {}\n",
        arguments.out.join("report.html").display()
    ))
}
