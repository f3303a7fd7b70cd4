//! `aim demo`: aims the bundled mannequin at an orbiting target while it walks and runs; also writes the mannequin
//! before it was aimed.

use std::fs;

use aim_animation::Clip;
use aim_character::{MANNEQUIN_RIG, Mannequin, Measurement, PAPER_AXES, Settle};
use aim_gltf::Document;
use aim_runtime::Behind;

use super::bake::bake;
use crate::args;
use crate::facing::Facing;
use crate::failure::{Failure, Result};
use crate::files;
use crate::outputs::Outputs;
use crate::target::TargetSpec;

/// Time of one orbit if there is no clip, seconds.
const ORBIT: f32 = 10.0;

pub(super) fn run(arguments: &args::Demo) -> Result {
    let spec = aim_codegen::declare::from_toml("rigs/mannequin.toml", MANNEQUIN_RIG)?;
    let model =
        Mannequin::new().with_walk_to_run().glb(|_| PAPER_AXES).map_err(|error| Failure::input(error.to_string()))?;
    let document = Document::from_bytes(&model).map_err(|error| Failure::input(error.to_string()))?;
    // One orbit takes the length of the clip, so that the result loops.
    let seconds = document.clips().first().map_or(ORBIT, Clip::length_s);
    files::print(&format!(
        "aiming the eye, neck and spine of the walking and running mannequin at a target that orbits it once in {seconds:.1} s\n"
    ))?;
    let first = document.clips().first().map(|clip| clip.name().to_owned());
    let out = |name: &str| arguments.out.join(name);
    fs::create_dir_all(&arguments.out).map_err(|error| {
        Failure::in_file(&arguments.out, format!("cannot create the folder: {error}; choose another with --out"))
    })?;
    let mut outputs = Outputs::default();
    for name in ["aimed.glb", "report.json", "report.html", "mannequin.glb"] {
        outputs.writes(&out(name), "--out")?;
    }
    let request = args::Bake {
        facing: Facing::default(),
        file: "the mannequin".into(),
        // 2 m away, a little above the eyes.
        target: TargetSpec::Orbit { radius: 2.0, height: 0.15, seconds: seconds.into() },
        rig: None,
        // Replaces the file's first clip, because players show that one.
        clip: first.clone(),
        name: first,
        aiming: arguments.aiming,
        effector: None,
        weight: 1.0,
        attention: 0.0,
        behind: Behind::default(),
        patience: None,
        seconds: Some(seconds),
        fps: 60.0,
        hold: None,
        settle: Settle::Snap,
        looped: true,
        reduce: None,
        strict: false,
        written: args::Written {
            out: out("aimed.glb"),
            report: Some(out("report.json")),
            html: Some(out("report.html")),
            no_json: args::NoJson::default(),
        },
    };
    bake(&request, &document, &Measurement::of(&document), &spec)?;
    files::write(&out("mannequin.glb"), &model)?;
    files::print(&format!(
        "wrote {}: the mannequin before aiming\nopen {} to see the result\n",
        out("mannequin.glb").display(),
        out("report.html").display()
    ))
}
