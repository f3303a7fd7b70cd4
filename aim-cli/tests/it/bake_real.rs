//! Third-party characters in the folder that `AIM_RIGS` names. Run with
//! `AIM_RIGS=folder cargo test -p aim-cli --test it -- --ignored`.

use std::path::Path;

use crate::common::Place;
use crate::common::forward::{Bake, both_eyes, list, number};
use crate::common::rig::joints;
use aim_character::{Measurement, mended_loop};
use aim_gltf::Document;
use serde_json::Value;

/// Bakes a file of the folder and checks everything; returns the report.
#[track_caller]
fn bake(file: &Path, rig: Option<&str>, options: &[&str]) -> Value {
    let place = Place::new();
    let rig_file = rig.map(crate::common::bundled_rig);
    let mut arguments = vec!["bake".into(), file.as_os_str().to_owned()];
    arguments.extend(["--out", "out.glb", "--report", "r.json"].map(Into::into));
    arguments.extend(options.iter().map(Into::into));
    if let Some(rig) = &rig_file {
        arguments.extend(["--rig".into(), rig.into()]);
    }
    let ran = place.run(&arguments);
    assert!(ran.code == 0 && ran.only_warns(), "{}: {ran:?}", file.display());
    let declared = rig_file.map(|path| joints(&std::fs::read_to_string(path).expect("the rig is there")));
    let source = std::fs::read(file).expect("the file is there");
    let report = place.json("r.json");
    Bake { source: &source, output: &place.read("out.glb"), report: &report, joints: declared.as_deref() }.check();
    report
}

/// Returns the sorted errors of all frames whose target can be followed, degrees.
fn errors(report: &Value) -> Vec<f64> {
    let followed = |frame: &&Value| frame["status"] == "reached" || frame["status"] == "rate_limited";
    let mut errors: Vec<f64> =
        list(&report["frames"]).iter().filter(followed).map(|frame| number(&frame["error_deg"])).collect();
    errors.sort_by(f64::total_cmp);
    errors
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn the_thug_of_the_paper() {
    let folder = crate::common::real_rigs();
    let file = folder.join("dude.glb");
    let report = bake(&file, Some("thug"), &["--target", "orbit:2,0,8", "--seconds", "8"]);
    let errors = errors(&report);
    assert_eq!(report["summary"]["frames"], 481);
    assert!(errors.len() > 240, "only {} frames can be followed", errors.len());
    assert!(errors[errors.len() / 2] < 0.5, "median {}", errors[errors.len() / 2]);
    // Its clip does not loop. After mending and writing it, a looped bake leaves it as it is.
    let document = Document::load(&file).expect("a file");
    let mended = mended_loop(&document, &Measurement::of(&document), &document.clips()[0]).expect("it has hips");
    let place = Place::new();
    place.write("dude.glb", &document.with_clips(&[mended.expect("it jumps").clip]).expect("it can be written"));
    let looped = ["--target", "node:L_Hand", "--settle", "animation", "--loop", "--fps", "24"];
    bake(&place.path("dude.glb"), Some("thug"), &looped);
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn eyes_with_other_axes_than_their_head() {
    let folder = crate::common::real_rigs();
    let file = folder.join("rocketbox_female_adult_01.glb");
    let report = bake(&file, Some("rocketbox"), &["--target", "orbit:2,0,8", "--seconds", "8"]);
    let errors = errors(&report);
    assert!(errors.len() > 240 && errors[errors.len() / 2] < 0.5, "{} frames, {:?}", errors.len(), errors.last());
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn every_character_with_a_head_without_a_rig() {
    let folder = crate::common::real_rigs();
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .expect("the folder can be listed")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "glb" || extension == "gltf"))
        .collect();
    files.sort();
    let mut baked = 0;
    for file in &files {
        let ran = Place::new().run(["inspect".as_ref(), file.as_os_str(), "--json".as_ref()]);
        assert_eq!(ran.code, 0, "{}: {}", file.display(), ran.stderr);
        let inspection: Value = serde_json::from_str(&ran.stdout).expect("JSON");
        if !list(&inspection["bones"]).iter().any(|bone| bone["role"] == "head") {
            println!("{} has no head by name", file.display());
            continue;
        }
        let report = bake(file, None, &["--target", "orbit:2,0.2,6", "--seconds", "6"]);
        assert_eq!(report["rig"].as_str(), file.file_stem().and_then(|stem| stem.to_str()), "{}", file.display());
        assert_eq!(report["frames"][0]["status"], "reached", "{}: {}", file.display(), report["frames"][0]);
        // `bake` has checked every status against the error in the written file, and every other bone's transform. The
        // natural solver's head has inertia and does not follow every jerk of a clip; the exact solver does.
        let report = bake(file, None, &["--target", "orbit:2,0.2,6", "--seconds", "6", "--solver", "exact"]);
        let reached = list(&report["frames"]).iter().filter(|frame| frame["status"] == "reached").count();
        // The smallest count is that of a dying horse, whose clip itself bends the neck to its limit.
        assert!(reached >= 75, "{}: only {reached} of 361 frames are reached", file.display());
        baked += 1;
    }
    assert!(baked >= 7 || files.len() < 7, "only {baked} characters of {} were aimed", files.len());
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn both_eyes_converge_on_what_is_near_and_are_parallel_for_what_is_far() {
    let folder = crate::common::real_rigs();
    for (file, rig, eyes) in [
        ("dude.glb", "thug", ["L_eyeBall_joint2", "R_eyeBall_joint"]),
        ("rocketbox_female_adult_01.glb", "rocketbox", ["Bip01 LEye", "Bip01 REye"]),
    ] {
        let path = folder.join(file);
        let source = std::fs::read(&path).expect("the file is there");
        // Distances from the eye in metres; the orbit starts in front, and the head turns little within a second.
        for (metres, apart_deg) in [("0.3", [6.0, 20.0]), ("50", [0.0, 0.1])] {
            let place = Place::new();
            let mut arguments: Vec<std::ffi::OsString> = vec!["bake".into(), path.clone().into(), "--rig".into()];
            arguments.push(crate::common::bundled_rig(rig).into());
            let target = format!("--target=orbit:{metres},0,24");
            arguments.extend(
                [&target, "--both-eyes", "--seconds", "1", "--out", "out.glb", "--report", "r.json"].map(Into::into),
            );
            let ran = place.run(&arguments);
            assert_eq!((ran.code, ran.stderr.as_str()), (0, ""), "{file}");
            let found = both_eyes(&source, &place.read("out.glb"), &place.json("r.json"), eyes);
            assert!(apart_deg[0] < found && found < apart_deg[1], "{file} at {metres} m: {found}° apart");
        }
    }
}
