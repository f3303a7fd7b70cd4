//! General behaviour of the command: help with examples everywhere, no progress bar in pipes, no failure when the
//! reader of its output exits.

use std::io::Read;
use std::process::{Command, Stdio};

use crate::common::{Place, command};

#[test]
fn every_help_has_an_example_that_names_its_command() {
    let place = Place::new();
    for name in ["demo", "inspect", "rig", "generate", "count", "check", "plot", "bake", "clip"] {
        let help = place.done(&format!("{name} --help")).stdout;
        let example = help.split("Example:").nth(1).unwrap_or_else(|| panic!("no example in\n{help}"));
        assert!(example.trim_start().starts_with(&format!("aim {name}")), "{help}");
        assert!(place.done("--help").stdout.contains(&format!("  {name}")), "{name} is not listed");
        assert!(place.done(&format!("help {name}")).stdout.contains("Example:"), "{name}");
    }
    assert!(place.done("--help").stdout.contains("Example:"), "the command itself");
    assert!(place.done("--version").stdout.starts_with("aim "), "its version");
}

#[test]
fn the_short_help_has_one_line_for_each_option() {
    let place = Place::new();
    // The words of `view --show` alone fill more than a line.
    for name in ["demo", "inspect", "rig", "generate", "count", "check", "explain", "plot", "bake", "reach", "clip"] {
        let help = place.done(&format!("{name} -h")).stdout;
        let (options, after) = help.split_once("\nExample").expect("an example");
        let (_, options) = options.split_once("\nOptions:\n").expect("options");
        for line in options.lines() {
            assert!(line.is_empty() || line.trim_start().starts_with('-'), "{name}: {line}");
        }
        assert!(!after.contains("\n\n"), "{name}: details after the example:{after}");
    }
    for word in ["Targets:", "Reduction:", "Plausibility:", "rate_limited", "replaces a clip of this name"] {
        assert!(place.done("bake --help").stdout.contains(word), "{word}");
    }
}

#[test]
fn the_examples_of_the_help_are_accepted() {
    let place = Place::with_mannequin();
    std::fs::create_dir(place.path("rigs")).expect("a folder can be made");
    place.write("rigs/thug.toml", &place.read("m.toml"));
    for file in ["hero.glb", "dude.glb"] {
        place.write(file, &crate::common::mannequin());
    }
    for name in ["inspect", "rig", "generate", "count", "plot", "bake", "clip"] {
        let help = place.done(&format!("{name} --help")).stdout;
        let example = help.split("Example:").nth(1).expect("an example");
        let example = example.split("\n\n").next().expect("its text").replace('\n', " ");
        place.done(example.trim().strip_prefix("aim ").expect("the command"));
    }
}

#[test]
fn a_reader_that_leaves_is_no_failure() {
    let place = Place::with_mannequin();
    for arguments in [
        "inspect m.glb",
        "inspect m.glb --json",
        "rig m.glb",
        "generate m.toml --lang c",
        "generate m.toml --lang rust",
        "count m.toml",
        "--help",
    ] {
        let mut child = command(&place.path("."))
            .args(arguments.split(' '))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the command starts");
        // Like `head -1`: reads the beginning, then closes the pipe.
        let mut first = [0; 1];
        let mut stdout = child.stdout.take().expect("a pipe");
        let _ = stdout.read(&mut first);
        drop(stdout);
        let output = child.wait_with_output().expect("it ends");
        assert_eq!((output.status.code(), &output.stderr[..]), (Some(0), &b""[..]), "aim {arguments}");

        let gone = command(&place.path(".")).args(arguments.split(' ')).stdout(closed()).output();
        let gone = gone.expect("the command starts");
        assert_eq!((gone.status.code(), &gone.stderr[..]), (Some(0), &b""[..]), "aim {arguments}, nobody reads");
    }
}

/// Returns a pipe whose reader has exited.
fn closed() -> Stdio {
    let mut reader = Command::new("true").stdin(Stdio::piped()).spawn().expect("`true` starts");
    let writer = reader.stdin.take().expect("a pipe");
    reader.wait().expect("`true` ends");
    writer.into()
}

#[test]
fn a_bake_in_a_pipe_prints_what_it_wrote_and_how_that_looks() {
    let place = Place::with_mannequin();
    let ran = place.done("bake m.glb --rig m.toml --target orbit:2,0,8 --seconds 8 --out out.glb");
    assert!(
        ran.stdout.starts_with("wrote out.glb: 481 frames of \"walk\", aimed with the rig Mannequin"),
        "{}",
        ran.stdout
    );
    let looks = ran.stdout.lines().nth(1).expect("a second line");
    assert!(looks.starts_with("plausibility: all values within their limits; nearest to its limit: "), "{looks}");
    assert!(ran.stdout.ends_with('\n') && ran.stdout.lines().count() == 2, "{:?}", ran.stdout);
}

#[test]
fn a_count_and_an_inspection_for_people() {
    let place = Place::with_mannequin();
    let inspection = place.done("inspect m.glb").stdout;
    for word in ["left_eye", "+X", "+Y", "+Z", "walk", "1.200 s"] {
        assert!(inspection.contains(word), "{word} is not in\n{inspection}");
    }
    let count = place.done("count m.toml").stdout;
    assert!(count.contains("aim and gradient") && count.contains("46"), "{count}");
}

#[test]
fn names_from_anywhere() {
    let place = Place::new();
    let odd = "Kopf <script>alert(1)</script> \"é\"\n頭, 100%";
    let model = crate::common::changed(|json| {
        for node in json["nodes"].as_array_mut().expect("nodes") {
            if node["name"] == "neck" {
                node["name"] = odd.into();
            }
        }
        json["animations"][0]["name"] = odd.into();
    });
    place.write("Fig ur 頭.glb", &model);
    let rig = std::fs::read_to_string(crate::common::bundled_rig("mannequin")).expect("the rig is there");
    let quoted = serde_json::to_string(odd).expect("text");
    place.write("rig", &rig.replace("bone = \"neck\"", &format!("bone = {quoted}")));
    let ran = place.run([
        "bake",
        "Fig ur 頭.glb",
        "--rig",
        "rig",
        "--clip",
        odd,
        "--target",
        "0,1.6,2",
        "--out",
        "ou t.glb",
        "--report",
        "r",
        "--html",
        "h",
    ]);
    assert_eq!((ran.code, ran.stderr.as_str()), (0, ""));
    assert_eq!(ran.stdout.lines().count(), 4, "a name's line end is printed as one: {}", ran.stdout);
    let report = place.json("r");
    let written = format!("{odd}_aimed").into();
    assert_eq!((&report["clip"], &report["frames"][0]["joints"][1]["bone"]), (&written, &odd.into()));
    let page = String::from_utf8(place.read("h")).expect("text");
    assert!(!page.contains("<script>alert"), "a name became a script");
    let inspection = place.run(["inspect", "Fig ur 頭.glb", "--json"]);
    assert_eq!(inspection.code, 0, "{}", inspection.stderr);
    assert!(inspection.stdout.contains("\\n頭"), "the name is in the JSON");
    assert_eq!(place.names(), ["Fig ur 頭.glb", "h", "ou t.glb", "r", "rig"]);
}
