//! Every text a user may read, in one place: what was found, what was expected, what to do.
//!
//! Messages are the same in both front ends; help lines quote the declaration in the notation it was written in.

use crate::declare::report::text::{Text, did_you_mean, list, text};
use crate::declare::tree::{Kind, Notation, Value};
use aim_model::Role;

/// A choice by notation.
fn by<T>(notation: Notation, rust: T, toml: T) -> T {
    match notation {
        Notation::Rust => rust,
        Notation::Toml => toml,
    }
}

/// What a key's value has to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Expected {
    Angle,
    AngleRange,
    HeadingRange,
    Rate,
    Acceleration,
    Number,
    Direction,
    Point,
    Axes,
    Effector,
    Natural,
    Kernels,
    Seconds,
    Flag,
    Side,
    LimitsFrom,
    Role,
    NodeName,
    NodeNames,
    Name,
    Path,
    Joints,
}

impl Expected {
    fn words(self) -> &'static str {
        match self {
            Self::Angle => "an angle",
            Self::AngleRange => "a range of angles",
            Self::HeadingRange => "a range of angles or `free`",
            Self::Rate => "an angle per second",
            Self::Acceleration => "an angle per second²",
            Self::Number => "a plain number",
            Self::Direction => "a signed axis or a vector",
            Self::Point => "a vector",
            Self::Axes => "two or three axes",
            Self::Effector => "`forward`, `origin` or both",
            Self::Natural => "settings such as `eyes_only`",
            Self::Kernels => "a list of kernels",
            Self::Seconds => "a number of seconds",
            Self::Flag => "`true` or `false`",
            Self::Side => "`left` or `right`",
            Self::LimitsFrom => "`animation` or `bind_pose`",
            Self::Role => "`eye`, `head`, `neck`, `chest` or `none`",
            Self::NodeName => "a node's name",
            Self::NodeNames => "a node's name or a list of names",
            Self::Name => "a name",
            Self::Path => "a path",
            Self::Joints => "a list of joints",
        }
    }

    /// How it is written, key included.
    fn example(self, key: &str, notation: Notation) -> String {
        let value = match self {
            Self::Angle => by(notation, "-35deg", "\"-35deg\""),
            Self::AngleRange | Self::HeadingRange => by(notation, "-35deg..=35deg", "[\"-35deg\", \"35deg\"]"),
            Self::Rate => by(notation, "450deg", "\"450deg\""),
            Self::Acceleration => by(notation, "1200deg", "\"1200deg\""),
            Self::Number => "0.5",
            Self::Direction => by(notation, "+Y", "\"+Y\""),
            Self::Point => by(notation, "(0.0, 0.1, 0.0)", "[0.0, 0.1, 0.0]"),
            Self::Axes => {
                return by(notation, "axes(up = +X, forward = +Y)", "axes = { up = \"+X\", forward = \"+Y\" }").into();
            }
            Self::Effector => {
                return by(notation, "effector(origin = (0.0, 0.1, 0.0))", "effector = { origin = [0.0, 0.1, 0.0] }")
                    .into();
            }
            Self::Natural => {
                let (rust, toml) = ("natural(eyes_only = 15deg)", "natural = { eyes_only = \"15deg\" }");
                return by(notation, rust, toml).into();
            }
            Self::Kernels => {
                return by(notation, "kernels(aim_gradient)", "kernels = [\"aim_gradient\"]").into();
            }
            Self::Seconds => "0.05",
            Self::Flag => "true",
            Self::Side => by(notation, "left", "\"left\""),
            Self::LimitsFrom => by(notation, "bind_pose", "\"bind_pose\""),
            Self::Role => by(notation, "eye", "\"eye\""),
            Self::NodeName | Self::NodeNames => "\"L_eye\"",
            Self::Name => "\"left_eye\"",
            Self::Path => "::aim",
            Self::Joints => return "[[joint]]".into(),
        };
        format!("{key} = {value}")
    }
}

/// A literal as it is written: TOML has no angles and axes of its own and keeps them in strings.
fn literal(text: impl core::fmt::Display, notation: Notation) -> String {
    by(notation, format!("{text}"), format!("\"{text}\""))
}

// Form: what stands where.

pub(crate) fn expected(key: &str, expected: Expected, found: &str, notation: Notation) -> Text {
    text(
        format!("`{key}` needs {}, found {found}", expected.words()),
        format!("write it as in `{}`", expected.example(key, notation)),
    )
}

pub(crate) fn not_literal(key: &str, expected: Expected, found: &str, notation: Notation) -> Text {
    let reason = by(
        notation,
        "a derive macro sees tokens before they have values: write a literal",
        "a declaration holds literals only: write one",
    );
    text(
        format!("`{key}` needs {}, found {found}", expected.words()),
        format!("{reason}, as in `{}`", expected.example(key, notation)),
    )
}

pub(crate) fn capitals(key: &str, expected: Expected, found: &str, notation: Notation) -> Text {
    text(
        format!("`{key}` needs {}, found `{found}`", expected.words()),
        format!("write `{key} = {}`", literal(found.to_lowercase(), notation)),
    )
}

pub(crate) fn quoted(key: &str, expected: Expected, found: &str, literal: &str) -> Text {
    text(format!("`{key}` needs {}, found {found}", expected.words()), format!("write `{literal}` without quotes"))
}

pub(crate) fn no_value(key: &str, example: Option<Expected>, notation: Notation) -> Text {
    let help = match example {
        Some(expected) => format!("write it as in `{}`", expected.example(key, notation)),
        None => format!("write `{key} = …`"),
    };
    text(format!("`{key}` has no value"), help)
}

pub(crate) fn stray(found: &str) -> Text {
    text(
        format!("expected a setting's name, found `{found}`"),
        "settings are written `name = value`, with commas between them",
    )
}

pub(crate) fn unknown_key(key: &str, nearest: Option<&str>, known: &[&str]) -> Text {
    let help = match nearest {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None => format!("known here: {}", list(known.iter().copied())),
    };
    text(format!("unknown setting `{key}`"), help)
}

pub(crate) fn renamed_key(old: &str, new: &str, value: &Value, notation: Notation) -> Text {
    let word = |text: &str| literal(text, notation);
    let help = match (&value.kind, old) {
        (Kind::Word(kind), "range") if kind == "absolute" => format!("write `{new} = {}`", word("bind_pose")),
        (Kind::Word(kind), "range") if kind == "relative" => {
            format!("write `{new} = {}` or leave it out: ranges count from the animation by default", word("animation"))
        }
        (_, "range") => {
            let (animation, bind_pose) = (word("animation"), word("bind_pose"));
            format!(
                "write `{new} = {animation}` or `{new} = {bind_pose}`; the ranges are those of `heading` and `pitch`"
            )
        }
        _ => format!("write `{new}` for `{old}`: its value stays as it is"),
    };
    text(format!("`{old}` is now called `{new}`"), help)
}

pub(crate) fn unknown_role(found: &str, nearest: Option<Role>, notation: Notation) -> Text {
    let meant =
        nearest.map_or(String::new(), |role| format!("; did you mean `role = {}`?", literal(role.as_str(), notation)));
    text(format!("unknown role `{found}`"), format!("a role is `eye`, `head`, `neck`, `chest` or `none`{meant}"))
}

pub(crate) fn unknown_kernel(name: &str, known: &[&str]) -> Text {
    let known = known.iter().copied();
    let help = did_you_mean(name, known.clone(), || format!("known kernels: {}", list(known)));
    text(format!("unknown kernel `{name}`"), help)
}

pub(crate) fn duplicate_kernel(name: &str) -> Text {
    text(format!("the kernel `{name}` is listed twice"), "keep one of the two")
}

pub(crate) fn key_of_rig(key: &str, notation: Notation) -> Text {
    let place = by(notation, "`#[aim(…)]` on the struct", "the top of the file, above the first `[[joint]]`");
    text(format!("`{key}` is a setting of the rig, not of a joint"), format!("move it to {place}"))
}

pub(crate) fn key_of_joint(key: &str, notation: Notation) -> Text {
    let place = by(notation, "`#[joint(…)]` on the joint's field", "the joint, below its `[[joint]]`");
    text(format!("`{key}` is a setting of a joint, not of the rig"), format!("move it to {place}"))
}

pub(crate) fn duplicate_key(key: &str) -> Text {
    text(format!("`{key}` is set twice"), "keep one of the two")
}

pub(crate) fn declared_here(what: &str) -> String {
    format!("`{what}` is declared here")
}

pub(crate) fn first_attribute(name: &str) -> String {
    format!("the first `#[{name}]` is here")
}

/// What the TOML parser says of `part` of the text.
#[cfg(feature = "toml")]
pub(crate) fn syntax(found: &str, part: &str) -> Text {
    let help = if found.starts_with("string values must be quoted") {
        format!("words, names and axes stand in quotes: `\"{part}\"`")
    } else if found.starts_with("invalid float") || found.starts_with("invalid integer") {
        "a number with a unit stands in quotes, as in `\"450deg\"`".into()
    } else {
        "a rig file is TOML 1.0, see https://toml.io".into()
    };
    text(format!("this is not TOML: {found}"), help)
}

// Numbers and units.

pub(crate) fn missing_unit(digits: &str, notation: Notation) -> Text {
    let [degrees, radians] = ["deg", "rad"].map(|unit| literal(format_args!("{digits}{unit}"), notation));
    text(format!("`{digits}` has no unit"), format!("write `{degrees}` or `{radians}`"))
}

pub(crate) fn detached_unit(digits: &str, unit: &str, notation: Notation) -> Text {
    let joined = literal(format_args!("{digits}{unit}"), notation);
    text(format!("`{digits}` is separated from its unit"), format!("write `{joined}`, without a space"))
}

pub(crate) fn unknown_unit(digits: &str, unit: &str, notation: Notation) -> Text {
    let lower = unit.to_lowercase();
    let [degrees, radians] = ["deg", "rad"].map(|unit| literal(format_args!("{digits}{unit}"), notation));
    let help = if unit == "°" || unit == "º" || lower.starts_with("de") || lower == "d" {
        format!("degrees are written `{degrees}`")
    } else if lower.starts_with("ra") || lower == "r" {
        format!("radians are written `{radians}`")
    } else {
        format!("angles carry `deg` or `rad`, as in `{degrees}`")
    };
    text(format!("`{unit}` is not a unit of angles"), help)
}

pub(crate) fn unit_on_plain(key: &str, digits: &str, unit: &str) -> Text {
    let help = match (key, unit, digits.parse::<f64>()) {
        ("delay", ..) => "write the seconds without a unit, as in `delay = 0.05`".into(),
        (_, "%", Ok(percent)) => format!("write `{:?}`", percent / 100.0),
        _ => format!("write `{digits}`"),
    };
    text(format!("`{key}` is a plain number, found the unit `{unit}`"), help)
}

pub(crate) fn radix(number: &str, radix: &str) -> Text {
    text(format!("`{number}` is {radix}"), "write the number in decimal, as in `35deg`")
}

pub(crate) fn not_positive(key: &str, number: &str, zero: bool) -> Text {
    let found = if zero { "zero" } else { "negative" };
    let help = match key {
        "rate" => "a rate is a speed above 0; a joint that holds still has no place in a rig",
        "acceleration" => "an acceleration is above 0; leave it out for no bound",
        _ => "a stiffness is above 0: large for a reluctant joint, 1 if left out",
    };
    text(format!("`{key}` must be positive, `{number}` is {found}"), help)
}

pub(crate) fn not_finite(key: &str, number: &str) -> Text {
    let help = match key {
        "acceleration" => "leave `acceleration` out for no bound",
        "rate" => "give the fastest speed that looks natural, for eyes about `450deg`",
        _ => "write a finite number that fits single precision",
    };
    text(format!("`{key}` must be finite, `{number}` is not"), help)
}

pub(crate) fn share_outside(key: &str, number: &str) -> Text {
    let help = match key {
        "upright" => "0 turns about the bone's own up, 1 about the character's up",
        "pitch_taper" => "0 keeps the whole range of pitch at the ends of heading, 1 leaves nothing of it",
        _ => "0 leaves the gaze to the eyes, 1 hands all beyond their own zone to the head",
    };
    text(format!("`{key}` must lie in 0 to 1, found `{number}`"), help)
}

// Ranges.

pub(crate) fn range_open(key: &str, notation: Notation) -> Text {
    text(
        format!("the range of `{key}` is open"),
        format!("both ends are needed and belong to it: `{}`", Expected::AngleRange.example(key, notation)),
    )
}

pub(crate) fn range_list(key: &str, count: usize) -> Text {
    text(
        format!("the range of `{key}` needs two ends, found {count}"),
        format!("write the lower end, then the upper: `{}`", Expected::AngleRange.example(key, Notation::Toml)),
    )
}

pub(crate) fn range_single(key: &str, found: &str, mirrored: &str, notation: Notation) -> Text {
    let range = by(notation, format!("-{mirrored}..={mirrored}"), format!("[\"-{mirrored}\", \"{mirrored}\"]"));
    text(format!("`{key}` needs a range of angles, found {found}"), format!("write `{key} = {range}`"))
}

pub(crate) fn range_inverted(key: &str, low: &str, high: &str, notation: Notation) -> Text {
    let range = by(notation, format!("{high}..={low}"), format!("[\"{high}\", \"{low}\"]"));
    text(format!("the range of `{key}` is inverted: {low} is above {high}"), format!("write `{key} = {range}`"))
}

pub(crate) fn range_empty(key: &str) -> Text {
    text(
        format!("the range of `{key}` is empty: its ends are equal"),
        format!("leave `{key}` out if the joint cannot turn that way"),
    )
}

pub(crate) fn range_without_zero(key: &str, low: &str, high: &str) -> Text {
    text(
        format!("the range of `{key}`, {low} to {high}, does not contain 0"),
        "angle 0 is the animation untouched, every joint must be able to rest there",
    )
}

pub(crate) fn range_tiny(key: &str, [low, high]: [&str; 2], notation: Notation) -> Text {
    let leave_out = format!("leave `{key}` out if the joint cannot turn that way");
    let help = match (low.strip_suffix("deg"), high.strip_suffix("deg")) {
        (Some(low), Some(high)) => {
            let range = by(notation, format!("{low}rad..={high}rad"), format!("[\"{low}rad\", \"{high}rad\"]"));
            format!("write `{key} = {range}` if radians are meant; {leave_out}")
        }
        _ => leave_out,
    };
    text(format!("the range of `{key}`, {low} to {high}, is less than 1° to either side"), help)
}

pub(crate) fn rate_beyond(found: &str, rate: f64, notation: Notation) -> Text {
    let help = match found.trim_matches('`').strip_suffix("rad") {
        Some(digits) => format!("write `rate = {}` if degrees are meant", literal(format!("{digits}deg"), notation)),
        None => "the largest rate that is accepted is 100rad, 5729deg".to_owned(),
    };
    let turns = rate / core::f64::consts::TAU;
    text(format!("the rate {found} is {turns:.0} turns a second"), help)
}

pub(crate) fn foreign_field(field: &str, found: &str) -> Text {
    text(
        format!("the field `{field}` is of type `{found}`, not `Joint`"),
        format!("every field of a rig is a joint: write `{field}: Joint`, or move the field to another struct"),
    )
}

pub(crate) fn range_beyond(key: &str, number: &str) -> Text {
    let help = match key {
        "heading" => "a joint turns 180deg to each side at most; `heading = free` turns without limit",
        _ => "a joint turns 180deg to each side at most",
    };
    text(format!("`{number}` is beyond ±180°"), help)
}

pub(crate) fn pitch_free(notation: Notation) -> Text {
    text(
        "`pitch` cannot be free",
        format!("only a heading wraps; give the pitch a range: `{}`", Expected::AngleRange.example("pitch", notation)),
    )
}

pub(crate) fn pitch_taper_without_ends(has_heading: bool, has_pitch: bool) -> Text {
    let (needs, help) = match (has_heading, has_pitch) {
        (true, true) => {
            ("a heading with ends", "a free heading has no ends: give it a range, or leave `pitch_taper` out")
        }
        (true, false) => ("a pitch", "it takes from the pitch's range: declare the pitch, or leave `pitch_taper` out"),
        _ => ("a heading", "it grows with the heading: declare one, or leave `pitch_taper` out"),
    };
    text(format!("`pitch_taper` needs {needs}"), help)
}

// Natural gaze.

pub(crate) fn angle_outside(key: &str, number: &str) -> Text {
    text(format!("`{key}` must lie in 0° to 180°, found `{number}`"), "it is an angle between two directions")
}

pub(crate) fn release_above_engage(engage_deg: f64, release_deg: f64) -> Text {
    text(
        format!("`release`, {release_deg}°, is above `engage`, {engage_deg}°"),
        "the head begins to help at the larger angle and rests again at the smaller; unless set they are 15° and 8°",
    )
}

pub(crate) fn negative_delay(number: &str) -> Text {
    text(
        format!("`delay` must not be negative, found `{number}`"),
        "it is in seconds; 0 lets head and eyes begin together",
    )
}

// Axes.

pub(crate) fn axis_without_sign(letter: &str, notation: Notation) -> Text {
    let letter = letter.to_uppercase();
    let [plus, minus] = ['+', '-'].map(|sign| literal(format_args!("{sign}{letter}"), notation));
    text(format!("the axis `{letter}` has no sign"), format!("write `{plus}` or `{minus}`"))
}

pub(crate) fn axis_unknown(sign: char, letter: &str, notation: Notation) -> Text {
    let upper = letter.to_uppercase();
    let help = match upper.as_str() {
        "X" | "Y" | "Z" => format!("axes are capitals: `{}`", literal(format_args!("{sign}{upper}"), notation)),
        _ => "a bone's axes are `+X`, `-X`, `+Y`, `-Y`, `+Z` and `-Z`".into(),
    };
    text(format!("`{sign}{letter}` is not an axis"), help)
}

pub(crate) fn vector_length(key: &str, count: usize) -> Text {
    text(format!("`{key}` needs three components, found {count}"), "a vector has x, y and z")
}

pub(crate) fn zero_vector(key: &str) -> Text {
    text(format!("`{key}` has no direction: its length is 0"), "give it a length of 1")
}

pub(crate) fn not_unit(key: &str, length: f64, unit: &str) -> Text {
    text(format!("`{key}` is not a unit vector: its length is {length:.4}"), format!("write `{unit}`"))
}

pub(crate) fn contradictory(first: &str, second: &str) -> Text {
    text(format!("`{first}` and `{second}` declare the same axis"), "keep one of them, the other is its opposite")
}

pub(crate) fn parallel(first: &str, second: &str) -> Text {
    text(
        format!("`{first}` and `{second}` are parallel"),
        "the axes of a bone are square to each other: each of X, Y and Z is used once",
    )
}

pub(crate) fn not_square(first: &str, second: &str, degrees: f64, nearest: &str) -> Text {
    text(
        format!("`{first}` and `{second}` are not square: {degrees:.1}° lie between them"),
        format!("the nearest proper frame is {nearest}"),
    )
}

pub(crate) fn no_axes(notation: Notation) -> Text {
    let example = by(
        notation,
        "#[aim(axes(up = +X, forward = +Y, left = +Z))]",
        "axes = { up = \"+X\", forward = \"+Y\", left = \"+Z\" }",
    );
    text("the bones' axes are missing", format!("declare which axes point up and forward, as in `{example}`"))
}

pub(crate) fn empty_axes(notation: Notation) -> Text {
    text("`axes` declares no axis", format!("give two or three, as in `{}`", Expected::Axes.example("axes", notation)))
}

pub(crate) fn one_axis(only: &str) -> Text {
    let other = if matches!(only, "forward" | "back") { "up" } else { "forward" };
    text(
        format!("`axes` declares `{only}` alone"),
        format!("one axis leaves the bone free to roll: give `{other}`, too, the third follows"),
    )
}

/// Whose axes they are, for the messages about handedness.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Owner {
    Rig,
    Joint,
    MirroredJoint,
}

pub(crate) fn wrong_hand(owner: Owner, rig_is_right: bool, flip: &str, notation: Notation) -> Text {
    let rig = if rig_is_right { "right" } else { "left" };
    let other = if rig_is_right { "left" } else { "right" };
    let handedness = by(notation, format!("handedness = {other}"), format!("handedness = \"{other}\""));
    match owner {
        Owner::Rig => text(
            format!("the axes are a {other}-handed triple in a {rig}-handed rig"),
            format!("flip one sign, as in `{flip}`, or declare `{handedness}` if that is the engine's"),
        ),
        Owner::Joint => text(
            format!("the axes are a {other}-handed triple in a {rig}-handed rig"),
            format!("flip one sign, as in `{flip}`, or add `mirrored = true` if the bone's own axes are mirrored"),
        ),
        Owner::MirroredJoint => text(
            format!("the axes are a {rig}-handed triple, but the joint is mirrored in a {rig}-handed rig"),
            format!("flip one sign, as in `{flip}`, or remove `mirrored = true`"),
        ),
    }
}

pub(crate) fn mirrored_without_axes(notation: Notation) -> Text {
    text(
        "a mirrored joint cannot share all three axes of the rig",
        format!("declare its own, as in `{}`", Expected::Axes.example("axes", notation)),
    )
}

pub(crate) fn rig_axes_here() -> String {
    "the rig's three axes are declared here".into()
}

// Joints.

#[cfg(feature = "toml")]
pub(crate) fn single_joint() -> Text {
    text("`joint` needs a list of joints, found a group of settings", "write `[[joint]]` before each of them")
}

pub(crate) fn no_joints(notation: Notation) -> Text {
    let how = by(notation, "a field of type `Joint` with `#[joint(…)]`", "a `[[joint]]`");
    text("a rig needs a joint", format!("declare each joint, from the eye inward, as {how}"))
}

pub(crate) fn no_angle(name: &str, notation: Notation) -> Text {
    text(
        format!("`{name}` has neither heading nor pitch"),
        format!("give it a range, as in `{}`", Expected::AngleRange.example("heading", notation)),
    )
}

pub(crate) fn no_rate(name: &str, notation: Notation) -> Text {
    text(
        format!("`{name}` has no rate"),
        format!("add its largest speed in a second, as in `{}`", Expected::Rate.example("rate", notation)),
    )
}

pub(crate) fn other_eye_inward() -> Text {
    text(
        "`other_eye` is not on the first joint",
        "it names the other eye, and the eye is the outermost joint: move it there",
    )
}

// Names.

pub(crate) fn no_name(what: &str) -> Text {
    let example = if what == "rig" { "Thug" } else { "left_eye" };
    text(format!("the {what} has no name"), format!("add `name = \"{example}\"`"))
}

pub(crate) fn not_ascii(name: &str) -> Text {
    text(format!("the name `{name}` is not ASCII"), "it becomes a name in C and WGSL: use a-z, A-Z, 0-9 and _")
}

pub(crate) fn not_identifier(name: &str) -> Text {
    text(
        format!("`{}` is not a Rust name", name.escape_debug()),
        "a name starts with a letter and goes on with letters, digits and `_`",
    )
}

pub(crate) fn rust_keyword(name: &str) -> Text {
    text(format!("`{name}` is a keyword of Rust"), "choose another name: it becomes a name in the emitted Rust")
}

pub(crate) fn keyword(name: &str, snake: &str, language: &str) -> Text {
    let becomes = if name == snake { "is".into() } else { format!("becomes `{snake}`,") };
    text(
        format!("the name `{name}` {becomes} a keyword of {language}"),
        "choose another name: it becomes a name in the emitted C and WGSL",
    )
}

pub(crate) fn reserved_prefix(name: &str) -> Text {
    text(
        format!("the name `{name}` starts with two underscores"),
        "C and WGSL keep such names for themselves: leave out an underscore",
    )
}

pub(crate) fn duplicate_name(name: &str) -> Text {
    text(format!("two joints are named `{name}`"), "each joint needs a name of its own")
}

pub(crate) fn name_collision(first: &str, second: &str, snake: &str) -> Text {
    text(
        format!("`{first}` and `{second}` are both `{snake}` in C and WGSL"),
        "rename one, so that they differ in more than capitals",
    )
}

pub(crate) fn duplicate_bone(bone: &str) -> Text {
    text(format!("the bone `{bone}` is named twice"), "each joint moves a bone of its own")
}

pub(crate) fn default_bone_here(name: &str) -> String {
    format!("without `bone`, the joint's own name `{name}` is its bone's")
}

pub(crate) fn empty_bone(key: &str) -> Text {
    text(format!("`{key}` names no node"), "give the name that the bone's node has in the model")
}

// The Rust item.

pub(crate) fn wrong_shape(what: &str) -> Text {
    text(
        format!("a rig is a struct with named fields, found {what}"),
        "declare a struct with one field of type `Joint` for each joint, from the eye inward",
    )
}

pub(crate) fn generics() -> Text {
    text("a rig cannot be generic", "its kernels are derived for one set of axes: remove the parameters")
}

pub(crate) fn misplaced(attribute: &str) -> Text {
    let help = match attribute {
        "aim" => "put the rig's settings above the struct; a joint's are in `#[joint(…)]`",
        _ => "put a joint's settings on its field; the rig's are in `#[aim(…)]`",
    };
    let message = match attribute {
        "aim" => "`#[aim]` is on a field",
        _ => "`#[joint]` is on the struct",
    };
    text(message, help)
}

pub(crate) fn no_list(attribute: &str) -> Text {
    let example = match attribute {
        "aim" => "#[aim(axes(up = +X, forward = +Y))]",
        _ => "#[joint(heading = -35deg..=35deg, rate = 450deg)]",
    };
    text(format!("`#[{attribute}]` has no settings"), format!("give them in parentheses, as in `{example}`"))
}

pub(crate) fn no_attribute(name: &str) -> Text {
    text(
        format!("the field `{name}` has no `#[joint]`"),
        "every field of a rig is a joint: add `#[joint(heading = -35deg..=35deg, rate = 450deg)]`, or move the field to another struct",
    )
}

pub(crate) fn several_attributes(attribute: &str) -> Text {
    let owner = if attribute == "aim" { "struct" } else { "field" };
    text(format!("the {owner} has a second `#[{attribute}]`"), format!("put all settings into one `#[{attribute}(…)]`"))
}
