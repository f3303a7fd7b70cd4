//! `aim demo`: the files it writes, how well it aims, and its output in a pipe.

use crate::common::Place;
use crate::common::forward::{Bake, list, number};
use crate::common::rig::joints;
use serde_json::Value;

#[test]
fn the_demo_aims_well_and_writes_the_same_files_each_time() {
    let place = Place::new();
    let ran = place.done("demo");
    assert_eq!((place.names(), ran.stderr.as_str()), (vec!["aim-demo".into()], ""));
    let files = ["aimed.glb", "report.html", "report.json", "mannequin.glb"];
    for file in files {
        assert!(place.read(&format!("aim-demo/{file}")).len() > 1000, "{file} is next to nothing");
        assert!(ran.stdout.contains(file), "{file} is not mentioned in {}", ran.stdout);
    }
    // With another output folder.
    place.done("demo --out a/b/c");
    for file in files {
        assert_eq!(place.read(&format!("a/b/c/{file}")), place.read(&format!("aim-demo/{file}")), "{file}");
    }
    assert!(!ran.stdout.contains(['\r', '\u{1b}']), "a progress bar in a pipe: {:?}", ran.stdout);

    let report = place.json("aim-demo/report.json");
    let rig = std::fs::read_to_string(crate::common::bundled_rig("mannequin")).expect("the rig is there");
    let walks_and_runs = aim_character::Mannequin::new().with_walk_to_run().glb(|_| aim_character::PAPER_AXES);
    let (source, output) = (walks_and_runs.expect("orthonormal axes"), place.read("aim-demo/aimed.glb"));
    assert!(source == place.read("aim-demo/mannequin.glb"), "the mannequin as it was before");
    assert_eq!((&report["clip"], list(&report["frames"]).len()), (&"walk_to_run".into(), 601));
    Bake { source: &source, output: &output, report: &report, joints: Some(&joints(&rig)) }.check();

    let followed = |frame: &&Value| frame["status"] == "reached" || frame["status"] == "rate_limited";
    let mut errors: Vec<f64> =
        list(&report["frames"]).iter().filter(followed).map(|frame| number(&frame["error_deg"])).collect();
    errors.sort_by(f64::total_cmp);
    assert!(errors.len() > 300, "only {} frames can be followed", errors.len());
    // When the target comes back into reach on the other side, the head needs half a second to get there.
    let (median, p95) = (errors[errors.len() / 2], errors[errors.len() * 95 / 100]);
    assert!(median <= 0.1 && p95 <= 2.0, "median {median}°, 95th percentile {p95}°");
}

#[test]
fn a_demo_that_has_nowhere_to_go_says_so() {
    let place = Place::new();
    place.write("taken", "a file");
    place.refuses_after_words(&["demo", "--out", "taken"], &["taken", "--out"]);
    place.refuses_after_words(&["demo", "--out", "taken/below"], &["taken", "--out"]);
}
