//! The same mistakes through both front ends: same message, at the corresponding place.

use super::{errors_of, excerpt, listed};
use crate::declare::from_toml;

/// One mistake, or several, in both notations.
struct Case {
    /// Settings of the rig: Rust, TOML.
    rig: [&'static str; 2],
    /// Settings of the first joint, `eye`; the second joint, `neck`, is correct.
    joint: [&'static str; 2],
    /// Message, then the underlined text in Rust and in TOML.
    errors: &'static [[&'static str; 3]],
}

const RIG: [&str; 2] = ["axes(up = +X, forward = +Y)", r#"axes = { up = "+X", forward = "+Y" }"#];
const JOINT: [&str; 2] =
    ["heading = -35deg..=35deg, rate = 450deg", "heading = [\"-35deg\", \"35deg\"]\nrate = \"450deg\""];

fn assert_case(Case { rig, joint, errors }: &Case) {
    let item = format!(
        "#[aim({})] struct Thug {{ #[joint({})] eye: Joint, #[joint(pitch = -1deg..=1deg, rate = 1rad)] neck: Joint }}",
        rig[0], joint[0]
    );
    let file = format!(
        "name = \"Thug\"\n{}\n[[joint]]\nname = \"eye\"\n{}\n[[joint]]\nname = \"neck\"\npitch = [\"-1deg\", \"1deg\"]\nrate = \"1rad\"\n",
        rig[1], joint[1]
    );
    let found = errors_of(&item);
    let expected = |at: usize| -> Vec<(String, String)> {
        let mut all: Vec<_> = errors.iter().map(|error| (error[0].to_owned(), error[at].to_owned())).collect();
        all.sort();
        all
    };
    let mut rust = listed(&item, &found);
    rust.sort();
    assert_eq!(rust, expected(1), "{item}");
    let found = match from_toml("rigs/thug.toml", &file) {
        Ok(spec) => panic!("no error in {file}: {spec:?}"),
        Err(found) => found,
    };
    let mut toml = listed(&file, &found);
    toml.sort();
    assert_eq!(toml, expected(2), "{file}");
}

/// Asserts the errors of a declaration that is correct except for its joint.
fn joint(rust: &'static str, toml: &'static str, errors: &'static [[&'static str; 3]]) {
    assert_case(&Case { rig: RIG, joint: [rust, toml], errors });
}

/// Asserts the errors of a declaration that is correct except for its rig settings.
fn rig(rust: &'static str, toml: &'static str, errors: &'static [[&'static str; 3]]) {
    assert_case(&Case { rig: [rust, toml], joint: JOINT, errors });
}

/// Asserts the errors of a joint that is correct except for its heading.
macro_rules! heading {
    ($rust:literal, $toml:literal, $($error:expr),+) => {
        joint(
            concat!("heading = ", $rust, ", rate = 450deg"),
            concat!("heading = ", $toml, "\nrate = \"450deg\""),
            &[$($error),+],
        )
    };
}

/// Asserts the errors of a correct joint with one more setting.
macro_rules! setting {
    ($key:literal, $rust:literal, $toml:literal, $($error:expr),+) => {
        joint(
            concat!("heading = -35deg..=35deg, rate = 450deg, ", $key, " = ", $rust),
            concat!("heading = [\"-35deg\", \"35deg\"]\nrate = \"450deg\"\n", $key, " = ", $toml),
            &[$($error),+],
        )
    };
}

/// Asserts the error of a joint that is correct except for its rate.
macro_rules! for_rate {
    ($rate:literal, $message:literal) => {
        joint(
            concat!("heading = free, rate = ", $rate),
            concat!("heading = \"free\"\nrate = \"", $rate, "\""),
            &[[$message, $rate, concat!("\"", $rate, "\"")]],
        )
    };
}

macro_rules! axes {
    ($rust:literal, $toml:literal, $($error:expr),+) => {
        rig(concat!("axes(", $rust, ")"), concat!("axes = { ", $toml, " }"), &[$($error),+])
    };
}

#[test]
fn units() {
    heading!("-35..=35deg", r#"["-35", "35deg"]"#, ["`-35` has no unit", "-35", "\"-35\""]);
    heading!("-35deg..=35grad", r#"["-35deg", "35grad"]"#, ["`grad` is not an angle unit", "35grad", "\"35grad\""]);
    heading!(
        "-35deg..=35degrees",
        r#"["-35deg", "35degrees"]"#,
        ["`degrees` is not an angle unit", "35degrees", "\"35degrees\""]
    );
    heading!(
        "-35 deg..=35deg",
        r#"["-35 deg", "35deg"]"#,
        ["`-35` is separated from its unit", "-35 deg", "\"-35 deg\""]
    );
    heading!("-0x23..=35deg", r#"["-0x23", "35deg"]"#, ["`-0x23` is hexadecimal", "-0x23", "\"-0x23\""]);
    heading!("-35deg..=0b1", r#"["-35deg", "0b1"]"#, ["`0b1` is binary", "0b1", "\"0b1\""]);
    heading!("-1..=2", "[-1, 2]", ["`-1` has no unit", "-1", "-1"], ["`2` has no unit", "2", "2"]);
}

#[test]
fn ranges() {
    heading!(
        "5deg..=20deg",
        r#"["5deg", "20deg"]"#,
        ["the range of `heading`, 5deg to 20deg, does not contain 0", "5deg..=20deg", r#"["5deg", "20deg"]"#]
    );
    heading!(
        "20deg..=-20deg",
        r#"["20deg", "-20deg"]"#,
        ["the range of `heading` is inverted: 20deg is above -20deg", "20deg..=-20deg", r#"["20deg", "-20deg"]"#]
    );
    heading!(
        "0deg..=0rad",
        r#"["0deg", "0rad"]"#,
        ["the range of `heading` is empty: its bounds are equal", "0deg..=0rad", r#"["0deg", "0rad"]"#]
    );
    heading!(
        "-181deg..=3.2rad",
        r#"["-181deg", "3.2rad"]"#,
        ["`-181deg` is beyond ±180°", "-181deg", "\"-181deg\""],
        ["`3.2rad` is beyond ±180°", "3.2rad", "\"3.2rad\""]
    );
    heading!("35deg", "\"35deg\"", ["`heading` needs a range of angles, found `35deg`", "35deg", "\"35deg\""]);
    joint(
        "heading = -35deg..=35deg, pitch = free, rate = 1rad",
        "heading = [\"-35deg\", \"35deg\"]\npitch = \"free\"\nrate = \"1rad\"",
        &[["`pitch` cannot be free", "free", "\"free\""]],
    );
    heading!(
        "loose",
        "\"loose\"",
        ["`heading` needs a range of angles or `free`, found `loose`", "loose", "\"loose\""]
    );
    heading!("true", "true", ["`heading` needs a range of angles or `free`, found `true`", "true", "true"]);
}

#[test]
fn positive_numbers() {
    setting!(
        "acceleration",
        "0deg",
        "\"0deg\"",
        ["`acceleration` must be positive, `0deg` is zero", "0deg", "\"0deg\""]
    );
    setting!(
        "acceleration",
        "-1deg",
        "\"-1deg\"",
        ["`acceleration` must be positive, `-1deg` is negative", "-1deg", "\"-1deg\""]
    );
    setting!(
        "acceleration",
        "1e999deg",
        "\"1e999deg\"",
        ["`acceleration` must be finite, `1e999deg` is not", "1e999deg", "\"1e999deg\""]
    );
    setting!("stiffness", "0", "0", ["`stiffness` must be positive, `0` is zero", "0", "0"]);
    setting!("stiffness", "-0.5", "-0.5", ["`stiffness` must be positive, `-0.5` is negative", "-0.5", "-0.5"]);
    setting!("stiffness", "1e39", "1e39", ["`stiffness` must be finite, `1e39` is not", "1e39", "1e39"]);
    setting!(
        "stiffness",
        "1deg",
        "\"1deg\"",
        ["`stiffness` takes a number without a unit, found the unit `deg`", "1deg", "\"1deg\""]
    );
    setting!("upright", "1.5", "1.5", ["`upright` must be between 0 and 1, found `1.5`", "1.5", "1.5"]);
    setting!("upright", "-0.1", "-0.1", ["`upright` must be between 0 and 1, found `-0.1`", "-0.1", "-0.1"]);
    let both = "heading = -35deg..=35deg, pitch = -9deg..=9deg, rate = 450deg, pitch_taper = 1.1";
    joint(
        both,
        "heading = [\"-35deg\", \"35deg\"]\npitch = [\"-9deg\", \"9deg\"]\nrate = \"450deg\"\npitch_taper = 1.1",
        &[["`pitch_taper` must be between 0 and 1, found `1.1`", "1.1", "1.1"]],
    );
    joint(
        "heading = -1deg..=1deg, rate = 0rad",
        "heading = [\"-1deg\", \"1deg\"]\nrate = \"0rad\"",
        &[["`rate` must be positive, `0rad` is zero", "0rad", "\"0rad\""]],
    );
    joint(
        "heading = -1deg..=1deg, rate = 450",
        "heading = [\"-1deg\", \"1deg\"]\nrate = 450",
        &[["`450` has no unit", "450", "450"]],
    );
}

#[test]
fn wrong_kinds() {
    setting!("mirrored", "left", "\"left\"", ["`mirrored` needs `true` or `false`, found `left`", "left", "\"left\""]);
    setting!(
        "limits_from",
        "total",
        "\"total\"",
        ["`limits_from` needs `animation` or `bind_pose`, found `total`", "total", "\"total\""]
    );
    setting!("bone", "3", "3", ["`bone` needs a node's name or a list of names, found `3`", "3", "3"]);
    setting!("bone", "[\"a\", 3]", "[\"a\", 3]", ["`bone` needs a node's name, found `3`", "3", "3"]);
    setting!("bone", "[]", "[]", ["`bone` names no node", "[]", "[]"]);
    setting!("other_eye", "\"\"", "\"\"", ["`other_eye` names no node", "\"\"", "\"\""]);
    setting!("stiffness", "much", "\"much\"", ["`stiffness` needs a plain number, found `much`", "much", "\"much\""]);
    setting!("axes", "+X", "\"+X\"", ["`axes` needs two or three axes, found `+X`", "+X", "\"+X\""]);
}

#[test]
fn required_settings_of_a_joint() {
    joint("rate = 450deg", "rate = \"450deg\"", &[["`eye` has neither heading nor pitch", "eye", "\"eye\""]]);
    joint("pitch = -1deg..=1deg", "pitch = [\"-1deg\", \"1deg\"]", &[["`eye` has no rate", "eye", "\"eye\""]]);
    joint(
        "",
        "",
        &[["`eye` has neither heading nor pitch", "eye", "\"eye\""], ["`eye` has no rate", "eye", "\"eye\""]],
    );
}

#[test]
fn keys() {
    // A misspelled key is not also missing: one mistake, one error.
    joint(
        "headng = -35deg..=35deg, speed = 450deg",
        "headng = [\"-35deg\", \"35deg\"]\nspeed = \"450deg\"",
        &[["unknown setting `headng`", "headng", "headng"], ["unknown setting `speed`", "speed", "speed"]],
    );
    setting!("rate", "1rad", "\"1rad\"", ["`rate` is set twice", "rate", "rate"]);
    setting!(
        "handedness",
        "left",
        "\"left\"",
        ["`handedness` is a setting of the rig, not of a joint", "handedness", "handedness"]
    );
    rig(
        "axes(up = +X, forward = +Y), stiffness = 1",
        "axes = { up = \"+X\", forward = \"+Y\" }\nstiffness = 1",
        &[["`stiffness` is a setting of a joint, not of the rig", "stiffness", "stiffness"]],
    );
    axes!(
        "up = +X, forward = +Y, sideways = +Z",
        r#"up = "+X", forward = "+Y", sideways = "+Z""#,
        ["unknown setting `sideways`", "sideways", "sideways"]
    );
    axes!(
        "up = +X, forward = +Y, up = +X",
        r#"up = "+X", forward = "+Y", up = "+X""#,
        ["`up` is set twice", "up", "up"]
    );
}

#[test]
fn keys_of_earlier_versions_name_the_new_ones() {
    // The renamed key is not also missing: one mistake, one error.
    rig(
        "bones(up = +X, forward = +Y)",
        "bones = { up = \"+X\", forward = \"+Y\" }",
        &[["`bones` is now called `axes`", "bones", "bones"]],
    );
    setting!("comfort", "0.5", "0.5", ["`comfort` is now called `stiffness`", "comfort", "comfort"]);
    setting!("level", "0.5", "0.5", ["`level` is now called `upright`", "level", "level"]);
    setting!("narrowing", "0.5", "0.5", ["`narrowing` is now called `pitch_taper`", "narrowing", "narrowing"]);
    setting!("pair", "\"R_eye\"", "\"R_eye\"", ["`pair` is now called `other_eye`", "pair", "pair"]);
    setting!("range", "absolute", "\"absolute\"", ["`range` is now called `limits_from`", "range", "range"]);
    setting!("range", "total", "\"total\"", ["`range` is now called `limits_from`", "range", "range"]);
}

#[test]
fn radians_written_as_degrees_and_degrees_as_radians() {
    heading!(
        "-0.6deg..=0.6deg",
        r#"["-0.6deg", "0.6deg"]"#,
        [
            "the range of `heading`, -0.6deg to 0.6deg, extends less than 1° to either side",
            "-0.6deg..=0.6deg",
            r#"["-0.6deg", "0.6deg"]"#
        ]
    );
    heading!(
        "-0.01rad..=0rad",
        r#"["-0.01rad", "0rad"]"#,
        [
            "the range of `heading`, -0.01rad to 0rad, extends less than 1° to either side",
            "-0.01rad..=0rad",
            r#"["-0.01rad", "0rad"]"#
        ]
    );
    for_rate!("450rad", "the rate `450rad` is too high: 72 turns per second");
    for_rate!("5731deg", "the rate `5731deg` is too high: 16 turns per second");
}

#[test]
fn roles_are_known_words() {
    setting!("role", "spine", "\"spine\"", ["unknown role `spine`", "spine", "\"spine\""]);
    setting!("role", "Eye", "\"Eye\"", ["unknown role `Eye`", "Eye", "\"Eye\""]);
    setting!("role", "3", "3", ["`role` needs `eye`, `head`, `neck`, `chest` or `none`, found `3`", "3", "3"]);
}

#[test]
fn missing_or_too_few_axes() {
    rig("", "", &[["the bones' axes are missing", "aim", ""]]);
    axes!("", "", ["`axes` declares no axis", "()", "{  }"]);
    axes!("up = +X", r#"up = "+X""#, ["`axes` declares only `up`", "+X", "\"+X\""]);
}

#[test]
fn signs_and_letters_of_axes() {
    axes!("up = X, forward = +Y", r#"up = "X", forward = "+Y""#, ["the axis `X` has no sign", "X", "\"X\""]);
    axes!(
        "up = +W, forward = -y",
        r#"up = "+W", forward = "-y""#,
        ["`+W` is not an axis", "+W", "\"+W\""],
        ["`-y` is not an axis", "-y", "\"-y\""]
    );
    axes!(
        "up = 5, forward = +Y",
        r#"up = 5, forward = "+Y""#,
        ["`up` needs a signed axis or a vector, found `5`", "5", "5"]
    );
}

#[test]
fn contradictory_parallel_and_skewed_axes() {
    axes!(
        "up = +X, down = -X, forward = +Y",
        r#"up = "+X", down = "-X", forward = "+Y""#,
        ["`up` and `down` declare the same axis", "-X", "\"-X\""]
    );
    axes!("up = +X, forward = -X", r#"up = "+X", forward = "-X""#, ["`up` and `forward` are parallel", "-X", "\"-X\""]);
    assert_case(&Case {
        rig: ["axes(up = (0.0, 0.8, 0.6), forward = +Z)", r#"axes = { up = [0.0, 0.8, 0.6], forward = "+Z" }"#],
        joint: JOINT,
        errors: &[["`up` and `forward` are not perpendicular: the angle between them is 53.1°", "+Z", "\"+Z\""]],
    });
    assert_case(&Case {
        rig: [
            "axes(up = (0.0, 2.0, 0.0), forward = (0, 0, 0))",
            "axes = { up = [0.0, 2.0, 0.0], forward = [0, 0, 0] }",
        ],
        joint: JOINT,
        errors: &[
            ["`forward` has no direction: its length is 0", "(0, 0, 0)", "[0, 0, 0]"],
            ["`up` is not a unit vector: its length is 2.0000", "(0.0, 2.0, 0.0)", "[0.0, 2.0, 0.0]"],
        ],
    });
    assert_case(&Case {
        rig: [
            "axes(up = (1.0, 0.0), forward = (0.0, 1deg, true))",
            r#"axes = { up = [1.0, 0.0], forward = [0.0, "1deg", true] }"#,
        ],
        joint: JOINT,
        errors: &[
            ["`forward` takes a number without a unit, found the unit `deg`", "1deg", "\"1deg\""],
            ["`forward` needs a plain number, found `true`", "true", "true"],
            ["`up` needs three components, found 2", "(1.0, 0.0)", "[1.0, 0.0]"],
        ],
    });
}

#[test]
fn handedness() {
    axes!(
        "up = +X, forward = +Y, left = -Z",
        r#"up = "+X", forward = "+Y", left = "-Z""#,
        ["the axes are a left-handed triple in a right-handed rig", "-Z", "\"-Z\""]
    );
    assert_case(&Case {
        rig: [
            "axes(up = +X, forward = +Y, right = -Z), handedness = left",
            "handedness = \"left\"\naxes = { up = \"+X\", forward = \"+Y\", right = \"-Z\" }",
        ],
        joint: JOINT,
        errors: &[["the axes are a right-handed triple in a left-handed rig", "-Z", "\"-Z\""]],
    });
    let own = ["axes(up = +X, forward = +Y, left = +Z)", r#"axes = { up = "+X", forward = "+Y", left = "+Z" }"#];
    assert_case(&Case {
        rig: own,
        joint: [
            "heading = free, rate = 1rad, mirrored = true, axes(up = +X, forward = +Y, left = +Z)",
            "heading = \"free\"\nrate = \"1rad\"\nmirrored = true\naxes = { up = \"+X\", forward = \"+Y\", left = \"+Z\" }",
        ],
        errors: &[[
            "the axes are a right-handed triple, but the joint is mirrored in a right-handed rig",
            "+Z",
            "\"+Z\"",
        ]],
    });
    assert_case(&Case {
        rig: own,
        joint: ["heading = free, rate = 1rad, mirrored = true", "heading = \"free\"\nrate = \"1rad\"\nmirrored = true"],
        errors: &[["a mirrored joint cannot share all three axes of the rig", "true", "true"]],
    });
    assert_case(&Case {
        rig: [
            "axes(up = +X, forward = +Y), handedness = up",
            "axes = { up = \"+X\", forward = \"+Y\" }\nhandedness = \"up\"",
        ],
        joint: JOINT,
        errors: &[["`handedness` needs `left` or `right`, found `up`", "up", "\"up\""]],
    });
}

#[test]
fn effector() {
    assert_case(&Case {
        rig: [
            "axes(up = +X, forward = +Y), effector(forward = (0.0, 3.0, 0.0), origin = (0.0, 0.0), aim = 1)",
            "axes = { up = \"+X\", forward = \"+Y\" }\neffector = { forward = [0.0, 3.0, 0.0], origin = [0.0, 0.0], aim = 1 }",
        ],
        joint: JOINT,
        errors: &[
            ["`forward` is not a unit vector: its length is 3.0000", "(0.0, 3.0, 0.0)", "[0.0, 3.0, 0.0]"],
            ["`origin` needs three components, found 2", "(0.0, 0.0)", "[0.0, 0.0]"],
            ["unknown setting `aim`", "aim", "aim"],
        ],
    });
}

#[test]
fn narrowing_needs_both_angles_and_ends() {
    setting!("pitch_taper", "0.5", "0.5", ["`pitch_taper` needs a pitch", "0.5", "0.5"]);
    setting!(
        "pitch_taper",
        "-0.5",
        "-0.5",
        ["`pitch_taper` must be between 0 and 1, found `-0.5`", "-0.5", "-0.5"],
        ["`pitch_taper` needs a pitch", "-0.5", "-0.5"]
    );
    joint(
        "pitch = -1deg..=1deg, rate = 1rad, pitch_taper = 0",
        "pitch = [\"-1deg\", \"1deg\"]\nrate = \"1rad\"\npitch_taper = 0",
        &[["`pitch_taper` needs a heading", "0", "0"]],
    );
    joint(
        "heading = free, pitch = -1deg..=1deg, rate = 1rad, pitch_taper = 0.5",
        "heading = \"free\"\npitch = [\"-1deg\", \"1deg\"]\nrate = \"1rad\"\npitch_taper = 0.5",
        &[["`pitch_taper` needs a heading with bounds", "0.5", "0.5"]],
    );
}

/// Asserts the errors of a rig that is correct except for `natural`.
macro_rules! natural {
    ($rust:literal, $toml:literal, $($error:expr),+) => {
        rig(
            concat!("axes(up = +X, forward = +Y), natural(", $rust, ")"),
            concat!("axes = { up = \"+X\", forward = \"+Y\" }\nnatural = { ", $toml, " }"),
            &[$($error),+],
        )
    };
}

#[test]
fn natural_gazes() {
    natural!(
        "eyes_only = 181deg, engage = -1deg",
        r#"eyes_only = "181deg", engage = "-1deg""#,
        ["`engage` must be between 0° and 180°, found `-1deg`", "-1deg", "\"-1deg\""],
        ["`eyes_only` must be between 0° and 180°, found `181deg`", "181deg", "\"181deg\""]
    );
    natural!("eyes_only = 15", "eyes_only = 15", ["`15` has no unit", "15", "15"]);
    natural!(
        "head_share = 1.5, delay = -0.1",
        "head_share = 1.5, delay = -0.1",
        ["`delay` must not be negative, found `-0.1`", "-0.1", "-0.1"],
        ["`head_share` must be between 0 and 1, found `1.5`", "1.5", "1.5"]
    );
    natural!(
        "delay = 50ms",
        r#"delay = "50ms""#,
        ["`delay` takes a number without a unit, found the unit `ms`", "50ms", "\"50ms\""]
    );
    natural!("delay = 1e99", "delay = 1e99", ["`delay` must be finite, `1e99` is not", "1e99", "1e99"]);
    natural!(
        "engage = 10deg, release = 12deg",
        r#"engage = "10deg", release = "12deg""#,
        ["`release`, 12°, is above `engage`, 10°", "12deg", "\"12deg\""]
    );
    // The default of `engage` follows `eyes_only`, and `release` is checked against it.
    natural!(
        "eyes_only = 5deg, release = 8deg",
        r#"eyes_only = "5deg", release = "8deg""#,
        ["`release`, 8°, is above `engage`, 5°", "8deg", "\"8deg\""]
    );
    natural!("eyes = 5deg", r#"eyes = "5deg""#, ["unknown setting `eyes`", "eyes", "eyes"]);
    natural!("share = 0.5", "share = 0.5", ["unknown setting `share`", "share", "share"]);
    rig(
        "axes(up = +X, forward = +Y), natural = true",
        "axes = { up = \"+X\", forward = \"+Y\" }\nnatural = true",
        &[["`natural` needs settings such as `eyes_only`, found `true`", "true", "true"]],
    );
    joint(
        "heading = -1deg..=1deg, rate = 1rad, natural(delay = 0)",
        "heading = [\"-1deg\", \"1deg\"]\nrate = \"1rad\"\nnatural = { delay = 0 }",
        &[["`natural` is a setting of the rig, not of a joint", "natural", "natural"]],
    );
}

/// Asserts the errors of a rig that is correct except for `region`.
macro_rules! region {
    ($rust:literal, $toml:literal, $($error:expr),+) => {
        rig(
            concat!("axes(up = +X, forward = +Y), region", $rust),
            concat!("axes = { up = \"+X\", forward = \"+Y\" }\nregion = ", $toml),
            &[$($error),+],
        )
    };
}

#[test]
fn regions() {
    region!(" = horse", "\"horse\"", ["unknown body `horse`", "horse", "\"horse\""]);
    region!("(like = horse)", "{ like = \"horse\" }", ["unknown body `horse`", "horse", "\"horse\""]);
    region!(
        "(head(heading = free, rate = 240))",
        "{ head = { heading = \"free\", rate = 240 } }",
        ["a budget cannot be free", "free", "\"free\""],
        ["`240` has no unit", "240", "240"]
    );
    region!(
        "(chest(pitch = 5deg..=20deg, acceleration = 0deg))",
        "{ chest = { pitch = [\"5deg\", \"20deg\"], acceleration = \"0deg\" } }",
        ["`acceleration` must be positive, `0deg` is zero", "0deg", "\"0deg\""],
        ["the range of `pitch`, 5deg to 20deg, does not contain 0", "5deg..=20deg", "[\"5deg\", \"20deg\"]"]
    );
    region!("(neck(rate = 1rad))", "{ neck = { rate = \"1rad\" } }", ["unknown setting `neck`", "neck", "neck"]);
    region!(
        " = true",
        "true",
        ["`region` needs a kind of body or budgets of `head` and `chest`, found `true`", "true", "true"]
    );
}

#[test]
fn bones_named_twice() {
    setting!("bone", "\"neck\"", "\"neck\"", ["the bone `neck` is used twice", "\"neck\"", "\"neck\""]);
    setting!(
        "bone",
        "[\"a\", \"b\", \"a\"]",
        "[\"a\", \"b\", \"a\"]",
        ["the bone `a` is used twice", "\"a\"", "\"a\""]
    );
    setting!("other_eye", "\"eye\"", "\"eye\"", ["the bone `eye` is used twice", "\"eye\"", "\"eye\""]);
}

#[test]
fn held_bones() {
    setting!(
        "hold",
        "[\"a\", \"b\", \"a\"]",
        "[\"a\", \"b\", \"a\"]",
        ["the bone `a` is held twice", "\"a\"", "\"a\""]
    );
    setting!("hold", "[\"a\", \" \"]", "[\"a\", \" \"]", ["`hold` names no node", "\" \"", "\" \""]);
    setting!(
        "hold",
        "[\"neck\"]",
        "[\"neck\"]",
        ["`hold` names `neck`, a bone that the rig turns", "\"neck\"", "\"neck\""]
    );
    setting!("hold", "[0.5]", "[0.5]", ["`hold` needs a node's name, found `0.5`", "0.5", "0.5"]);
    joint(
        "heading = -35deg..=35deg, rate = 450deg, bone = \"a\", other_eye = \"b\", hold = [\"c\", \"b\"]",
        "heading = [\"-35deg\", \"35deg\"]\nrate = \"450deg\"\nbone = \"a\"\nother_eye = \"b\"\nhold = [\"c\", \"b\"]",
        &[["`hold` names `b`, a bone that the rig turns", "\"b\"", "\"b\""]],
    );
}

#[test]
fn several_mistakes_are_all_reported() {
    let rust = errors_of(
        "#[aim(axes(up = +X, forward = +X), hand = left)] struct float {
            #[joint(heading = 5deg..=9deg, rate = 0deg, upright = 2)] é: Joint,
            eye: Joint,
        }",
    );
    assert_eq!(rust.iter().count(), 8, "{rust}");
}

#[test]
fn a_repeated_setting_notes_its_first_use() {
    let item = "#[aim(axes(up = +X, forward = +Y))] struct Thug { #[joint(heading = free, rate = 1rad, rate = 2rad)] eye: Joint }";
    let found = errors_of(item);
    let (note, place) = found.iter().next().and_then(|error| error.note()).expect("a note");
    assert_eq!((note, excerpt(item, place).as_str()), ("`rate` was first used here", "rate"));
}
