//! Unusable arguments: exit code 2, one message that says what to do instead, and no file written.

use crate::common::Place;

const BAKE: &str = "bake m.glb --rig m.toml --out out.glb";

#[test]
fn targets_that_say_nothing() {
    let place = Place::with_mannequin();
    for (spec, word) in [
        ("1,2", "x,y,z"),
        ("1,2,x", "x,y,z"),
        ("1,2,NaN", "x,y,z"),
        ("inf,0,0", "x,y,z"),
        ("1e300,0,0", "x,y,z"),
        ("orbit:2,0,1e-310", "not 0"),
        ("orbit:2,0", "orbit:2,0,8"),
        ("orbit:-2,0,8", "positive radius"),
        ("orbit:2,0,0", "not 0"),
        ("orbit:", "orbit:2,0,8"),
        ("node:", "node's name"),
        ("file:", "CSV"),
        ("orbits:1,2,3", "orbit:RADIUS"),
        ("", "x,y,z"),
    ] {
        let arguments: Vec<&str> = BAKE.split(' ').chain(["--target", spec]).collect();
        place.refuses(&arguments, &["--target", word]);
    }
    place.refused(BAKE, &["--target"]);
}

#[test]
fn paths_with_mistakes_name_the_line() {
    let place = Place::with_mannequin();
    for (text, words) in [
        ("", &["first line", "t,x,y,z"][..]),
        ("0,1,2,3\n", &["first line", "t,x,y,z"]),
        ("x,y,z,t\n0,1,2,3\n", &["first line", "t,x,y,z"]),
        ("t,x,y,z\n", &["no rows"]),
        ("t,x,y,z\n0,1,2,3\n1,1,2\n", &["line 3"]),
        ("t,x,y,z\n0,1,2,3\n1,1,2,3,4\n", &["line 3"]),
        ("t,x,y,z\n0,1,2,3\n1,one,2,3\n", &["line 3"]),
        ("t,x,y,z\n0,1,2,3\n\n\n1,one,2,3\n", &["line 5"]),
        ("t,x,y,z\n0,1,2,3\n0,1,2,3\n", &["line 3", "sort"]),
        ("t,x,y,z\n0,1,2,3\n1,NaN,2,3\n", &["line 3", "finite"]),
        ("t,x,y,z\n0,1,2,3\n1,1e999,2,3\n", &["line 3"]),
        ("t;x;y;z\n0;1;2;3\n", &["first line", "t,x,y,z"]),
    ] {
        place.write("path.csv", text);
        place.refused(&format!("{BAKE} --target file:path.csv"), &[&["path.csv"], words].concat());
    }
    place.write("path.csv", b"t,x,y,z\n0,1,2,\xff\n");
    place.refused(&format!("{BAKE} --target file:path.csv"), &["path.csv", "text"]);
    place.refused(&format!("{BAKE} --target file:gone.csv"), &["gone.csv", "t,x,y,z"]);
    place.refused(&format!("{BAKE} --target file:."), &["CSV"]);
}

#[test]
fn lengths_and_rates_that_make_no_frames() {
    let place = Place::with_mannequin();
    let target = "--target 0,1,2";
    for value in ["0", "-1", "NaN", "inf", "-inf", "1e30", "1e-30", "x", ""] {
        for option in ["--seconds", "--fps"] {
            let option = format!("{option}={value}");
            let arguments: Vec<&str> = BAKE.split(' ').chain(target.split(' ')).chain([option.as_str()]).collect();
            place.refuses(&arguments, &[]);
        }
    }
    for (option, expected) in [("--seconds", "a number of seconds above 0"), ("--fps", "keys per second above 0")] {
        for value in ["0", "-1", "NaN", "inf", "x"] {
            let words = [option, &format!("invalid value '{value}'"), expected];
            place.refused(&format!("{BAKE} {target} {option} {value}"), &words);
        }
    }
    place.refused(
        "reach m.glb --bone right_hand --at 0.5 --target 0,1,0 --out o.glb --fps 0",
        &["--fps", "invalid value '0'", "above 0"],
    );
    place.refused(
        &format!("{BAKE} {target} --seconds 1e-5"),
        &["--seconds", "--fps", "0.00001 s", "60 frames per second"],
    );
    place.refused(&format!("{BAKE} {target} --fps 1e9"), &["--fps", "frames per second", "at most"]);
}

#[test]
fn places_that_cannot_be_written() {
    let place = Place::with_mannequin();
    std::fs::create_dir(place.path("folder")).expect("a folder can be made");
    let bake = "bake m.glb --rig m.toml --target 0,1,2 --seconds 0.1";
    for out in ["folder", "nowhere/out.glb", "m.glb/out.glb", "/proc/none/out.glb", ".", ".."] {
        place.refused(&format!("{bake} --out {out}"), &[]);
        place.refused(&format!("generate m.toml --lang c -o {out}"), &[]);
    }
    place.refused(&format!("{bake} --out out.GLTF"), &["out.GLTF", ".glb"]);
    place.refused(&format!("{bake} --out x.txt"), &["x.txt", "--out", ".glb"]);
    place.refused(&format!("{bake} --out out.glb --report x.glb"), &["x.glb", "--report", ".json"]);
    place.refused(&format!("{bake} --out out.glb --html x.json"), &["x.json", "--html", ".html"]);
    for stream in ["/dev/null", "/dev/stdout"] {
        place.refused(&format!("{bake} --out out.glb --report {stream}"), &[stream]);
    }
    place.refused(&format!("{bake} --out nowhere/out.glb"), &["nowhere/out.glb", "cannot write", "No such file"]);
    // All or nothing: if the report cannot be written, no model is written either.
    place.refused(&format!("{bake} --out out.glb --report nowhere/r.json"), &["nowhere/r.json"]);
    place.refused(&format!("{bake} --out out.glb --report r.json --html folder"), &["folder"]);
    // One file for two purposes, or an output over an input of another kind.
    for (more, file) in [
        ("--report out.glb", "out.glb"),
        ("--html ./out.glb", "out.glb"),
        ("--report r --html r", "r"),
        ("--report m.glb", "m.glb"),
        ("--html m.toml", "m.toml"),
    ] {
        place.refused(&format!("{bake} --out out.glb {more}"), &[file, "twice"]);
    }
    place.refused(&format!("{bake} --out m.toml"), &["m.toml", "twice"]);
    place.refused("generate m.toml --lang c -o m.toml", &["m.toml", "used twice"]);
    let folder = std::fs::read_dir(place.path("folder")).expect("a folder");
    assert_eq!(folder.count(), 0, "something was left in the folder");
}

#[test]
fn read_only_files_are_not_replaced() {
    let place = Place::with_mannequin();
    let protect = |name: &str, mode: u32| {
        #[cfg(unix)]
        let permissions = std::os::unix::fs::PermissionsExt::from_mode(mode);
        #[cfg(not(unix))]
        let permissions = {
            let mut permissions = std::fs::metadata(place.path(name)).expect("the file is there").permissions();
            permissions.set_readonly(mode & 0o200 == 0);
            permissions
        };
        std::fs::set_permissions(place.path(name), permissions).expect("its owner may change them");
    };
    std::fs::create_dir(place.path("demo")).expect("a folder can be made");
    let names = ["taken.glb", "taken.json", "taken.html", "taken.c", "taken.svg", "demo/mannequin.glb"];
    for name in names {
        place.write(name, name);
        protect(name, 0o444);
    }
    let bake = "bake m.glb --rig m.toml --target 0,1,2 --seconds 0.1";
    for arguments in [
        &format!("{bake} --out taken.glb"),
        &format!("{bake} --out out.glb --report taken.json"),
        &format!("{bake} --out out.glb --html taken.html"),
        "reach m.glb --bone right_hand --at 0.5 --target 0,1,0 --out taken.glb",
        "clip m.glb --reduce 1mm --out taken.glb",
        "clip m.glb --html taken.html",
        "inspect m.glb --html taken.html",
        "generate m.toml --lang c -o taken.c",
        "explain m.toml -o taken.html",
        "plot m.toml -o taken.svg",
    ] {
        place.refused(arguments, &["taken.", "read-only", "choose another path for -"]);
    }
    place.refuses_after_words(&["demo", "--out", "demo"], &["mannequin.glb", "read-only", "--out"]);
    for name in names {
        assert_eq!(place.read(name), name.as_bytes());
    }
    // Any other file that is replaced keeps its permissions.
    protect("taken.glb", 0o600);
    place.done(&format!("{bake} --out taken.glb"));
    #[cfg(unix)]
    {
        let kept = std::fs::metadata(place.path("taken.glb")).expect("it is written").permissions();
        assert_eq!(std::os::unix::fs::PermissionsExt::mode(&kept) & 0o777, 0o600);
    }
    for name in names {
        protect(name, 0o644);
    }
}

#[test]
fn rigs_with_mistakes_name_the_place() {
    let place = Place::with_mannequin();
    let rig = String::from_utf8(place.read("m.toml")).expect("text");
    for (from, to, at) in [
        ("rate = \"450deg\"", "rate = \"450\"", "bad.toml:13:"),
        ("heading = [\"-35deg\", \"35deg\"]", "heading = [\"5deg\", \"35deg\"]", "bad.toml:11:"),
        ("left = \"+Z\"", "left = \"-Z\"", "bad.toml:4:"),
        ("[[joint]]", "[[joint]", "bad.toml:"),
        ("stiffness = 4.0", "stifness = 4.0", "bad.toml:"),
    ] {
        assert!(rig.contains(from), "{from}");
        place.write("bad.toml", &rig.replacen(from, to, 1));
        for command in [
            "generate bad.toml --lang c",
            "count bad.toml",
            "check bad.toml",
            "bake m.glb --rig bad.toml --target 0,1,2 --out o.glb",
        ] {
            let ran = place.refused(command, &[at]);
            let after = ran.stderr.split(at).nth(1).unwrap_or("");
            assert!(
                at.ends_with("toml:") || after.starts_with(|c: char| c.is_ascii_digit()),
                "no column: {}",
                ran.stderr
            );
        }
    }
    // All mistakes are reported together.
    place.write("bad.toml", "");
    let ran = place.aim("count bad.toml");
    assert_eq!((ran.code, ran.stderr.matches("--> bad.toml:1:1").count()), (2, 2), "{}", ran.stderr);
    place.write("bad.toml", b"name = \"\xff\"");
    place.refused("count bad.toml", &["bad.toml"]);
    place.refused("count gone.toml", &["gone.toml"]);
    place.refused("count .", &["TOML"]);
    place.refused("count m.glb", &["m.glb", "TOML"]);
}

#[test]
fn words_that_are_no_command_option_or_language() {
    let place = Place::with_mannequin();
    place.refused("backe", &["bake"]);
    place.refused("generate m.toml --lang wgls", &["--lang", "rust"]);
    place.refused("generate m.toml", &["--lang"]);
    place.refused("generate m.toml --lang c -o a --check b", &["--check"]);
    place.refused("bake m.glb --target 0,1,2", &["--out"]);
    place.refused("inspect", &["FILE"]);
    place.refused("inspect m.glb extra", &["extra"]);
    place.refused("check m.toml --samples 0", &["--samples"]);
    place.refused("check m.toml --samples -1", &["-1"]);
    place.refused("bake m.glb --target 0,1,2 --out o.glb --settle slowly", &["snap"]);
    let ran = place.aim("");
    assert_eq!(ran.code, 2, "{ran:?}");
    assert!((ran.stdout + &ran.stderr).contains("Usage"), "help without arguments");
}

#[test]
fn nothing_is_written_over_what_is_read() {
    let place = Place::with_mannequin();
    let (model, rig) = (place.read("m.glb"), place.read("m.toml"));
    for (arguments, what) in [
        ("inspect m.glb --html m.glb", "it is the model"),
        ("inspect m.glb --rig m.toml --html m.toml", "the rig"),
        ("inspect m.glb --html ./././m.glb", "it is the model"),
        ("generate m.toml --lang c -o m.toml", "it is the rig"),
        ("bake m.glb --rig m.toml --target 0,1,2 --out out.glb --report m.glb", "it is the model"),
        ("bake m.glb --rig m.toml --target 0,1,2 --out m.toml", "the rig"),
        ("bake m.glb --rig m.toml --target 0,1,2 --out m.glb --report m.glb", "the output of --out"),
        ("reach m.glb --bone right_hand --at 0.5 --target 0,1,0 --out o.glb --html m.glb", "it is the model"),
    ] {
        place.refused(arguments, &["used twice", what]);
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(place.path("m.glb"), place.path("link.json")).expect("links can be made");
        let linked = "bake m.glb --rig m.toml --target 0,1,2 --out out.glb --report link.json";
        place.refused(linked, &["used twice", "it is the model"]);
    }
    assert!(place.read("m.glb") == model && place.read("m.toml") == rig);
}

#[test]
fn what_may_not_be_meant_is_said() {
    let place = Place::with_mannequin();
    let ran = place.done("bake m.glb --rig m.toml --target 0,1.6,2 --out out.glb");
    assert_eq!(ran.stderr, "");
    let ran = place.done("bake m.glb --rig m.toml --target node:head --out out.glb");
    assert!(ran.stderr.contains("the target head moves with the gaze;"), "{ran:?}");
    let rig = String::from_utf8(place.read("m.toml")).expect("text");
    let wrong = rig.replacen("forward = \"+Y\"", "forward = \"-Y\"", 1).replacen(", left = \"+Z\"", "", 1);
    assert_ne!(wrong, rig);
    place.write("wrong.toml", &wrong);
    let ran = place.done("bake m.glb --rig wrong.toml --target 0,1.6,2 --out out.glb");
    assert!(ran.stderr.contains("wrong.toml does not match m.glb"), "{ran:?}");
}
