//! Tests of TOML files only: syntax, lines and columns, names as strings.

use super::{listed, parse};
use crate::declare::{from_derive_input, from_toml};

const THUG: &str = r#"name = "Thug"
handedness = "right"
axes = { up = "+X", forward = "+Y", left = "+Z" }
[[joint]]
name = "left_eye"
bone = "L_eyeBall_joint2"
heading = ["-35deg", "35deg"]
pitch = ["-25deg", "20deg"]
rate = "450deg"
stiffness = 0.5
[[joint]]
name = "neck"
heading = "free"
rate = "170deg"
limits_from = "bind_pose"
axes = { up = [0.0, 0.0, 1.0], forward = "+Y" }
upright = 1
"#;

fn assert_errors(text: &str, expected: &[(&str, &str)]) {
    let found = from_toml("rigs/thug.toml", text).expect_err(text);
    let found = listed(text, &found);
    let found: Vec<(&str, &str)> = found.iter().map(|(message, at)| (message.as_str(), at.as_str())).collect();
    assert_eq!(found, expected, "{text}");
}

#[test]
fn both_front_ends_give_the_same_rig() {
    let rust = from_derive_input(&parse(
        "#[aim(axes(up = +X, forward = +Y, left = +Z))] struct Thug {
            #[joint(bone = \"L_eyeBall_joint2\", heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, stiffness = 0.5)]
            left_eye: Joint,
            #[joint(heading = free, rate = 170deg, limits_from = bind_pose, axes(up = +Z, forward = +Y), upright = 1)]
            neck: Joint,
        }",
    ));
    assert_eq!(from_toml("thug.toml", THUG).expect("no error"), rust.expect("no error").spec);
}

#[test]
fn errors_look_like_a_compilers() {
    let text = THUG.replace("\"35deg\"]", "\"35\"]").replace("stiffness", "stifness");
    let found = from_toml("rigs/thug.toml", &text).expect_err("two errors");
    assert_eq!(
        found.to_string(),
        r#"error: `35` has no unit
 --> rigs/thug.toml:7:22
  |
7 | heading = ["-35deg", "35"]
  |                      ^^^^
  = help: write `"35deg"` or `"35rad"`

error: unknown setting `stifness`
  --> rigs/thug.toml:10:1
   |
10 | stifness = 0.5
   | ^^^^^^^^
   = help: did you mean `stiffness`?
"#
    );
}

#[test]
fn keys_of_earlier_versions_are_reported_with_their_replacement() {
    let old = THUG.replace("axes = { up = \"+X", "bones = { up = \"+X").replace("stiffness", "comfort");
    let old = old.replace("limits_from = \"bind_pose\"", "range = \"absolute\"").replace("upright = 1", "level = 1");
    let old = old.replace("rate = \"450deg\"", "rate = \"450deg\"\npitch_taper = 0.5\nother_eye = \"R_eye\"");
    let old = old.replace("pitch_taper", "narrowing").replace("other_eye", "pair");
    let found = from_toml("rigs/thug.toml", &old).expect_err("six keys of earlier versions");
    let found: Vec<(&str, &str)> = found.iter().map(|error| (error.message(), error.help())).collect();
    let stays = |old: &str, new: &str| format!("replace `{old}` by `{new}`; the value stays the same");
    let helps = [
        ("bones", "axes", stays("bones", "axes")),
        ("narrowing", "pitch_taper", stays("narrowing", "pitch_taper")),
        ("pair", "other_eye", stays("pair", "other_eye")),
        ("comfort", "stiffness", stays("comfort", "stiffness")),
        ("range", "limits_from", "write `limits_from = \"bind_pose\"`".to_owned()),
        ("level", "upright", stays("level", "upright")),
    ];
    let expected: Vec<(String, String)> =
        helps.map(|(old, new, help)| (format!("`{old}` is now called `{new}`"), help)).into();
    assert_eq!(found, expected.iter().map(|(text, help)| (text.as_str(), help.as_str())).collect::<Vec<_>>());
}

#[test]
fn an_unknown_role_names_the_known_ones() {
    for (word, meant) in
        [("spine", "chest"), ("eyes", "eye"), ("Head", "head"), ("nek", "neck"), ("hand", ""), ("hips", "")]
    {
        let text = THUG.replace("rate = \"170deg\"", &format!("rate = \"170deg\"\nrole = \"{word}\""));
        let found = from_toml("rigs/thug.toml", &text).expect_err(word);
        let error = found.iter().next().expect("an error");
        assert_eq!(error.message(), format!("unknown role `{word}`"));
        let meant = if meant.is_empty() { String::new() } else { format!("; did you mean `role = \"{meant}\"`?") };
        assert_eq!(error.help(), format!("expected `eye`, `head`, `neck`, `chest` or `none`{meant}"));
    }
}

#[test]
fn the_location_of_a_note_is_shown_below_the_error() {
    let text = THUG.replace("\"neck\"", "\"left_eye\"");
    let found = from_toml("rigs/thug.toml", &text).expect_err("a duplicate name");
    assert_eq!(
        found.render(),
        r#"error: two joints are named `left_eye`
  --> rigs/thug.toml:12:8
   |
12 | name = "left_eye"
   |        ^^^^^^^^^^
   = help: each joint needs a name of its own
note: `left_eye` was first used here
 --> rigs/thug.toml:5:8
  |
5 | name = "left_eye"
  |        ^^^^^^^^^^
"#
    );
}

#[test]
fn lines_count_characters_and_survive_tabs_and_carriage_returns() {
    let text = "\u{feff}name = \"Thug\"\r\naxes = { up = \"+X\", forward = \"+Y\" }\r\n# ü\r\n\u{9}é = 1\r\n";
    let text = text.trim_start_matches('\u{feff}');
    let found = from_toml("t.toml", text).expect_err("errors").to_string();
    assert!(found.contains(":4:2\n") && found.contains("4 |  é = 1\n  |  ^\n"), "{found}");
    let found = from_toml("t.toml", "").expect_err("errors").to_string();
    assert!(found.contains("--> t.toml:1:1\n  |\n1 | \n  | ^\n"), "{found}");
}

#[test]
fn syntax_errors_have_the_same_shape() {
    for text in
        ["name = ", "name = \"Thug\nbones", "[[joint", "= 5", "name = \"a\" \"b\"", "x = 99999999999999999999999"]
    {
        let found = from_toml("rigs/thug.toml", text).expect_err(text).to_string();
        assert!(found.starts_with("error: ") && found.contains(" --> rigs/thug.toml:1:"), "{found}");
        assert!(found.contains("invalid TOML: ") || text.starts_with('x'), "{found}");
    }
}

#[test]
fn the_help_for_toml_shows_values_in_quotes() {
    for (wrong, right, help) in [
        ("right", "\"right\"", "words, names and axes need quotes: `\"right\"`"),
        ("\"Right\"", "\"right\"", "write `handedness = \"right\"`"),
        ("450deg", "\"450deg\"", "a number with a unit needs quotes, as in `\"450deg\"`"),
        ("450", "\"450deg\"", "write `\"450deg\"` or `\"450rad\"`"),
        ("\"450 deg\"", "\"450deg\"", "write `\"450deg\"`, without a space"),
        ("\"450°\"", "\"450deg\"", "degrees are written `\"450deg\"`"),
        ("+X", "\"+X\"", "words, names and axes need quotes: `\"+X\"`"),
        ("\"+z\"", "\"+Z\"", "axes are upper-case: `\"+Z\"`"),
        ("\"y\"", "\"+Y\"", "write `\"+Y\"` or `\"-Y\"`"),
        ("\"10%\"", "0.1", "write `0.1`"),
    ] {
        let key = match right {
            "\"right\"" => "handedness",
            "\"450deg\"" => "rate",
            "0.1" => "stiffness",
            _ => "axes.up",
        };
        let found = from_toml("t.toml", &format!("{key} = {wrong}\n[[joint]]\n{key} = {wrong}\n"))
            .expect_err(wrong)
            .to_string();
        assert!(found.contains(help), "{wrong}: {found}");
    }
}

#[test]
fn a_misspelt_list_of_joints_is_one_mistake() {
    let text = THUG.replace("[[joint]]", "[[joints]]");
    let found = from_toml("t.toml", &text).expect_err("a misspelling");
    assert_eq!(found.iter().map(|error| error.message()).collect::<Vec<_>>(), ["unknown setting `joints`"]);
}

#[test]
fn repeated_keys_show_the_first() {
    let text = format!("name = \"Other\"\n{THUG}rate = \"1rad\"\n");
    let found = from_toml("rigs/thug.toml", &text).expect_err("two duplicates");
    let notes: Vec<_> = found.iter().filter_map(|error| error.note()).map(|(note, _)| note).collect();
    assert_eq!(notes, ["`name` was first used here", "`rate` was first used here"]);
    assert_errors(&text, &[("`name` is set twice", "name"), ("`rate` is set twice", "rate")]);
}

#[test]
fn names() {
    let with = |name: &str| THUG.replace("\"neck\"", name);
    for (name, message) in [
        ("\"le ft\"", "`le ft` is not a valid Rust identifier"),
        ("\"3rd\"", "`3rd` is not a valid Rust identifier"),
        ("\"\"", "`` is not a valid Rust identifier"),
        ("\"_\"", "`_` is not a valid Rust identifier"),
        ("\"r#type\"", "`r#type` is not a valid Rust identifier"),
        ("\"hals-ö\"", "`hals-ö` is not a valid Rust identifier"),
        ("\"œil\"", "the name `œil` is not ASCII"),
        ("\"in\"", "`in` is a keyword of Rust"),
        ("\"float\"", "the name `float` is a keyword of C"),
        ("\"leftEye\"", "`left_eye` and `leftEye` are both `left_eye` in C and WGSL"),
        ("3", "`name` needs a name, found `3`"),
    ] {
        assert_errors(&with(name), &[(message, name)]);
    }
    assert_errors(&THUG.replace("name = \"Thug\"", ""), &[("the rig has no name", "")]);
    assert_errors(&THUG.replace("name = \"neck\"", ""), &[("the joint has no name", "[[joint]]")]);
}

#[test]
fn joints_are_a_list() {
    let rig = "name = \"Thug\"\naxes = { up = \"+X\", forward = \"+Y\" }\n";
    assert_errors(rig, &[("the rig has no joints", "\"Thug\"")]);
    assert_errors(
        &format!("{rig}[joint]\nname = \"eye\""),
        &[("`joint` needs a list of joints, found a group of settings", "[joint]")],
    );
    assert_errors(&format!("{rig}joint = 5"), &[("`joint` needs a list of joints, found `5`", "5")]);
    assert_errors(&format!("crate = \"x\"\n{THUG}"), &[("unknown setting `crate`", "crate")]);
    assert_errors(
        &format!("{THUG}effector = {{}}"),
        &[("`effector` is a setting of the rig, not of a joint", "effector")],
    );
}

#[test]
fn values_that_only_toml_has() {
    let with = |rate: &str| THUG.replace("\"170deg\"", rate);
    for (rate, message) in [
        ("inf", "`rate` must be finite, `inf` is not"),
        ("nan", "`rate` must be finite, `nan` is not"),
        ("1979-05-27", "`rate` needs an angle per second, found a date"),
        ("0x10", "`0x10` is hexadecimal"),
        ("\"35°\"", "`°` is not an angle unit"),
        ("\"fast as light\"", "`rate` needs an angle per second, found the string `\"fast as light\"`"),
        ("\"-1deg..=1deg\"", "`rate` needs an angle per second, found a range"),
        ("[\"1deg\"]", "`rate` needs an angle per second, found a list of values"),
    ] {
        assert_errors(&with(rate), &[(message, rate)]);
    }
    let range = |heading: &str| THUG.replace("\"free\"", heading);
    assert_errors(&range("[\"1deg\"]"), &[("the range of `heading` needs two bounds, found 1", "[\"1deg\"]")]);
    assert_errors(
        &range("\"-1deg..=1deg\""),
        &[("`heading` needs a range of angles or `free`, found a range", "\"-1deg..=1deg\"")],
    );
}

#[test]
fn single_brackets_are_one_mistake() {
    let text = THUG.replace("[[joint]]", "[joint]");
    assert_errors(&text, &[("`joint` needs a list of joints, found a group of settings", "[joint]")]);
}

#[test]
fn lines_longer_than_any_screen_are_cut() {
    let text = format!("name = \"A\"{}x", " ".repeat(70_000));
    let rendered = from_toml("long.toml", &text).expect_err("no TOML").render();
    assert!(rendered.contains("--> long.toml:1:70011") && rendered.lines().all(|line| line.len() < 500), "{rendered}");
    assert!(rendered.contains(" ^\n"), "{rendered}");
}
