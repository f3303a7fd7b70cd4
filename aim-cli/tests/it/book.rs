//! Runs the commands shown in the book, the README and the crates' pages, in the order of each page.

use std::fs;
use std::path::{Path, PathBuf};

use aim_character::{Mannequin, Vrm, mannequin};

use crate::common::gltf::{put_together, take_apart};
use crate::common::{Place, bundled_rigs, in_full};

/// Commands shown on pages but not run by this test: the start of the line, and what checks it instead.
const ELSEWHERE: &[(&str, &str)] = &[
    ("cargo new ", "`.ci/five-minutes` goes through the page in an empty folder"),
    ("cd hero", "the same"),
    ("cargo add ", "the same"),
    ("cargo install ", "the command is built for this test"),
    ("cargo run --release --features view -- view", "a window: `.ci/view-screens.mjs`"),
    ("cp ", "the same"),
    ("mkdir ", "the folder is there"),
    ("echo ", "a line of a build script or a program: the example `compiled-rigs`"),
    ("cargo run --example ", "`.ci/run`"),
    ("cargo run -p compiled-rigs", "`example.rs`"),
    ("cargo run -p aim-character --example mannequin ", "`.ci/run`"),
    ("cargo run --release -p aim-viewer-web ", "`.ci/run`"),
    ("rustup target add ", "the toolchain's"),
    ("python3 -m http.server ", "any server will do"),
    ("cargo test", "this very command, or a part of it"),
    ("cargo build --release -p aim-benches", "`.ci/run`"),
    ("AIM_RIGS=folder/with/characters cargo run ", "`.ci/run`"),
    (".ci/", "itself"),
    ("cd integrations/web", "`.ci/web` makes the package and its examples"),
    ("npm ", "the same"),
    ("node build.mjs", "the same"),
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Returns the pages that may show commands.
fn pages() -> Vec<PathBuf> {
    let list = |folder: PathBuf| fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let mut pages: Vec<PathBuf> =
        list(root().join("docs")).filter(|path| path.extension().is_some_and(|end| end == "md")).collect();
    pages.extend(list(root()).map(|folder| folder.join("README.md")).filter(|page| page.is_file()));
    pages.extend(["README.md", "CONTRIBUTING.md", "examples/compiled-rigs/README.md"].map(|page| root().join(page)));
    pages.sort();
    assert!(pages.len() > 30, "{pages:?}");
    pages
}

/// Returns the commands of a page: lines of `sh` blocks without comments, and lines after `$` in `console` blocks.
fn commands(text: &str) -> Vec<String> {
    let (mut language, mut commands) = (None, Vec::new());
    for line in text.lines().map(str::trim) {
        if let Some(info) = line.strip_prefix("```") {
            language = if language.is_none() { Some(info) } else { None };
            continue;
        }
        let command = match language {
            Some("sh") => line.split(" #").next(),
            Some("console") => line.strip_prefix("$ "),
            _ => None,
        };
        commands.extend(command.map(|command| command.trim().to_owned()).filter(|command| !command.is_empty()));
    }
    commands
}

/// Up, forward and left of the upper body's bones in Mixamo characters.
const MIXAMO_AXES: [[f32; 3]; 3] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];

/// Returns the mannequin as a Mixamo character with a clip `Slap`.
fn hero() -> Vec<u8> {
    let (mut json, bin) = take_apart(&mannequin(|_| MIXAMO_AXES).expect("orthonormal axes"));
    let names = [
        ("left_eye", "LeftEye"),
        ("right_eye", "mixamorig:RightEye"),
        ("neck", "Neck"),
        ("spine3", "Spine2"),
        ("right_hand", "RightHand"),
    ];
    for node in json["nodes"].as_array_mut().expect("nodes") {
        if let Some((_, name)) = names.iter().find(|(name, _)| node["name"] == *name) {
            node["name"] = (*name).into();
        }
    }
    json["animations"][0]["name"] = "Slap".into();
    put_together(&json, &bin)
}

/// Returns a folder with the files that pages assume: characters, rigs, a function.
fn place_of_a_user() -> Place {
    let place = Place::new();
    place.write("hero.glb", &hero());
    place.write("hero.vrm", &Mannequin::new().with_vrm(Vrm::V1).glb(|_| MIXAMO_AXES).expect("orthonormal axes"));
    for folder in ["rigs", "src", "assets"] {
        fs::create_dir(place.path(folder)).expect("a new folder");
    }
    place.write("assets/hero.glb", &hero());
    let extra = root().join("examples/compiled-rigs/rigs/extra.toml");
    for rig in bundled_rigs().into_iter().chain([extra]) {
        fs::copy(&rig, place.path("rigs").join(rig.file_name().expect("a file"))).expect("a rig is copied");
    }
    place.write(
        "src/springs.rs",
        "#[differentiate(wrt(a, b))]
         fn spring(a: Vec3, b: Vec3, rest: f32) -> f32 { let stretch = (b - a).length() - rest; 0.5 * stretch * stretch }",
    );
    place
}

/// Runs only the introductory pages unless all tests are asked for.
#[test]
fn every_command_of_a_page_runs() {
    let (mut ran, mut known) = (0, vec![false; ELSEWHERE.len()]);
    for page in pages() {
        let is_first = ["README.md", "docs/five-minutes.md"].iter().any(|first| page == root().join(first));
        if !(is_first || in_full()) {
            continue;
        }
        let text = fs::read_to_string(&page).expect("a page is text");
        let commands = commands(&text);
        if commands.is_empty() {
            continue;
        }
        let place = place_of_a_user();
        let uses = |word: &str| commands.iter().any(|command| command.contains(word));
        if uses("rigs/hero.toml") && !uses("> rigs/hero.toml") {
            place.write("rigs/hero.toml", &place.done("rig hero.glb").stdout);
        }
        for command in commands {
            if let Some(number) = ELSEWHERE.iter().position(|(begins, _)| command.starts_with(begins)) {
                known[number] = true;
                continue;
            }
            let arguments = command.strip_prefix("aim ").or_else(|| command.strip_prefix("cargo run --release -- "));
            let arguments = arguments.unwrap_or_else(|| panic!("{}: who runs `{command}`?", page.display()));
            let (arguments, to) =
                arguments.split_once(" > ").map_or((arguments, None), |(run, to)| (run, Some(to.trim())));
            let said = place.aim(arguments);
            assert!(said.code == 0 && said.only_warns(), "{}: {command}: {said:?}", page.display());
            if let Some(to) = to {
                place.write(to, &said.stdout);
            }
            if let Some(singular) = text.lines().find(|line| line.starts_with("singular where ")) {
                assert!(said.stdout.contains(singular), "{}: {command}: {}", page.display(), said.stdout);
            }
            ran += 1;
        }
    }
    assert!(ran >= if in_full() { 15 } else { 5 }, "{ran} commands");
    for ((begins, _), is_known) in ELSEWHERE.iter().zip(known) {
        assert!(is_known || !in_full(), "no page shows `{begins}` any more");
    }
}
