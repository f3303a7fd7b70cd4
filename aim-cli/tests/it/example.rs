//! Builds `examples/compiled-rigs` outside the workspace: declarations are edited, the program is rebuilt, and it aims
//! as before.

use aim_runtime::glam::Vec3;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use crate::common::rig::{Axes, conventions};
use crate::common::{Place, in_full};

const EXAMPLE: &str = "../examples/compiled-rigs";
const FILES: [&str; 5] = ["build.rs", "rigs/hero.toml", "rigs/extra.toml", "src/main.rs", "src/checked_in.rs"];
/// Code of each rig: the hero's is written by the test, the other one is checked in.
const CODE: [(&str, &str); 2] = [("hero", "src/hero.rs"), ("extra", "src/checked_in.rs")];

/// Packages that are slow to optimise, so they are compiled without. As dependencies by path from another workspace
/// they are compiled separately for the example, and run only briefly.
const QUICK: [&str; 4] = ["aim-animation", "aim-character", "aim-gltf", "aim-runtime"];

/// Returns the example as a package of its own in another folder, as a user would have it.
fn example() -> Place {
    let place = Place::new();
    let ours = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = |path: &Path| fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    for folder in ["rigs", "src"] {
        fs::create_dir_all(place.path(folder)).expect("a folder of the example");
    }
    for file in FILES {
        place.write(file, &text(&ours.join(EXAMPLE).join(file)));
    }
    let root = ours.parent().expect("the crate lies in the repository");
    let workspace = text(&root.join("Cargo.toml"));
    // Use the workspace's profiles and versions, so that its compiled dependencies are reused.
    let profiles = workspace.split_once("[profile.dev]").and_then(|(_, rest)| rest.split_once("# How macros run"));
    let (profile, _) = profiles.expect("the workspace states its profiles");
    let manifest = text(&ours.join(EXAMPLE).join("Cargo.toml")).replace("\"../..", &format!("\"{}", root.display()));
    // The program itself is compiled nine times and runs only briefly.
    let quick = "[profile.dev.package.compiled-rigs]\nopt-level = 0\ndebug = 0\n";
    place.write("Cargo.toml", &format!("{manifest}\n[workspace]\n[profile.dev]{profile}\n{quick}"));
    place.write("Cargo.lock", &text(&root.join("Cargo.lock")));
    place.done("generate rigs/hero.toml --lang rust -o src/hero.rs");
    place
}

fn cargo_run(place: &Place, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO"))
        .args(["run", "--quiet", "--offline", "--target-dir"])
        .arg(Path::new(env!("CARGO_TARGET_TMPDIR")).parent().expect("it lies in the target folder"))
        .args(
            QUICK
                .iter()
                .flat_map(|package| ["--config".to_owned(), format!("profile.dev.package.{package}.opt-level=0")]),
        )
        .arg("--")
        .args(arguments)
        .current_dir(place.path(""))
        .output()
        .expect("the cargo that built this test can be started")
}

/// Returns the program's output for `model.glb`.
#[track_caller]
fn told(place: &Place) -> String {
    let output = cargo_run(place, &["model.glb"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

/// Returns the declaration with each joint's axes replaced.
fn edited(toml: &str, axes_of: impl Fn(&str) -> Axes) -> String {
    let mut out = String::new();
    for line in toml.lines() {
        let name = line.strip_prefix("name = \"").and_then(|rest| rest.strip_suffix('"'));
        if line.starts_with("axes") {
            continue;
        }
        if line.starts_with("effector") {
            // Between the eyes: equally far above and in front of the head's origin.
            let [up, forward, _] = axes_of("head");
            let origin: Vec<f32> = up.iter().zip(forward).map(|(up, forward)| 0.09 * up + 0.09 * forward).collect();
            out += &format!("effector = {{ origin = {origin:?} }}\n");
            continue;
        }
        out += line;
        out.push('\n');
        if let Some(joint) = name.filter(|name| name.starts_with(char::is_lowercase)) {
            let [up, forward, left] = axes_of(joint);
            out += &format!("axes = {{ up = {up:?}, forward = {forward:?}, left = {left:?} }}\n");
            let [u, f, l] = [up, forward, left].map(Vec3::from_array);
            if u.cross(f).dot(l) < 0.0 {
                out += "mirrored = true\n";
            }
        }
    }
    out
}

/// Returns the largest difference between numbers with four decimals. Asserts that everything else is equal, up to the
/// last decimal of angles.
#[track_caller]
fn difference(a: &str, b: &str) -> f64 {
    let numbers = |text: &str| -> Vec<f64> {
        let is_number = |c: char| c.is_ascii_digit() || c == '.' || c == '-';
        text.split(|c| !is_number(c)).filter_map(|word| word.parse().ok()).collect()
    };
    let words = |text: &str| -> Vec<String> {
        text.split_whitespace().filter(|word| word.starts_with(char::is_alphabetic)).map(str::to_owned).collect()
    };
    assert_eq!(words(a), words(b));
    assert_eq!(numbers(a).len(), numbers(b).len());
    let mut largest: f64 = 0.0;
    for (line, other) in a.lines().zip(b.lines()) {
        for (a, b) in numbers(line).into_iter().zip(numbers(other)) {
            let off = (a - b).abs();
            if line.contains("from") && !line.contains("° off") || line.contains("target") {
                largest = largest.max(off);
            } else {
                assert!(off < 0.101, "{line}\n{other}");
            }
        }
    }
    largest
}

/// Axes of each bone, by name.
type AxesOf = Box<dyn Fn(&str) -> Axes>;

/// Returns other axes for the same character: signed ones, general frames, and different ones per bone.
fn other_axes() -> [AxesOf; 8] {
    let all = conventions();
    let signed = |number: usize| -> AxesOf {
        let axes = all[number];
        Box::new(move |_| axes)
    };
    let leaning = [[0.8, 0.0, 0.6], [-0.6, 0.0, 0.8], [0.0, -1.0, 0.0]];
    let [a, b, c, d, e] = [3, 10, 21, 28, 47].map(signed);
    let (some, others) = (all.clone(), all);
    [
        a,
        b,
        c,
        d,
        e,
        Box::new(move |_| leaning),
        Box::new(move |bone| some[bone.bytes().map(usize::from).sum::<usize>() * 5 % some.len()]),
        Box::new(move |bone| if bone.ends_with("eye") { leaning } else { others[bone.len() * 7 % others.len()] }),
    ]
}

/// Writes the declarations with these axes, asserts that their code is reported as stale, and generates it again.
fn convert(place: &Place, declarations: [&str; 2], axes_of: &dyn Fn(&str) -> Axes) {
    for ((rig, file), declaration) in CODE.into_iter().zip(declarations) {
        place.write(&format!("rigs/{rig}.toml"), &edited(declaration, axes_of));
        let stale = place.aim(&format!("generate rigs/{rig}.toml --lang rust --check {file}"));
        assert_eq!(stale.code, 1, "the code of {rig} did not change");
        let advice = format!("generate rigs/{rig}.toml --lang rust -o {file}");
        assert!(stale.stderr.contains(&format!("\n  aim {advice}\n")), "{}", stale.stderr);
        place.done(&advice);
        place.done(&format!("generate rigs/{rig}.toml --lang rust --check {file}"));
    }
}

#[test]
fn code_for_another_convention_is_stale_until_generated_again() {
    let place = example();
    let [hero, extra] =
        ["rigs/hero.toml", "rigs/extra.toml"].map(|file| String::from_utf8(place.read(file)).expect("text"));
    // By default only one signed and one general choice of axes.
    for axes_of in other_axes().iter().step_by(if in_full() { 1 } else { 5 }) {
        convert(&place, [&hero, &extra], axes_of);
    }
}

#[test]
#[ignore = "builds the example ten times: .ci/run does"]
fn another_convention_is_a_change_of_the_declaration_alone() {
    let place = example();
    let [hero, extra] =
        ["rigs/hero.toml", "rigs/extra.toml"].map(|file| String::from_utf8(place.read(file)).expect("text"));
    place.write("model.glb", &crate::common::mannequin());
    let expected = told(&place);
    assert_eq!(expected.matches("Reached").count(), 6, "{expected}");

    for (case, axes_of) in other_axes().into_iter().enumerate() {
        place.write("model.glb", &aim_character::mannequin(&axes_of).expect("the axes are orthonormal"));
        convert(&place, [&hero, &extra], &axes_of);
        let found = told(&place);
        let off = difference(&expected, &found);
        assert!(off <= 1.01e-4, "case {case} is {off} off:\n{expected}\n{found}");
    }

    // Mistakes in a declaration are reported in the style of compiler errors.
    place.write("rigs/hero.toml", &hero.replace("left = \"+Z\"", "left = \"-Z\"").replace("\"450deg\"", "450"));
    let output = cargo_run(&place, &[]);
    let errors = String::from_utf8(output.stderr).expect("text");
    assert!(!output.status.success() && !errors.contains("panicked") && !errors.contains("RUST_BACKTRACE"), "{errors}");
    for expected in [
        "error: the axes are a left-handed triple in a right-handed rig\n",
        " --> rigs/hero.toml:4:44\n",
        "= help: flip one sign, as in `left = \"+Z\"`",
        "error: `450` has no unit\n",
        "rigs/hero.toml:11:8\n",
    ] {
        assert!(errors.contains(expected), "{expected:?} is not in:\n{errors}");
    }
}
