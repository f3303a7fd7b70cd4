//! All messages about declarations that a user may read: what was found, what was expected, how to fix it.
//!
//! Messages are the same in both front ends. Help lines quote the declaration in the notation in which it was written.

use aim_model::Role;

use super::expected::Expected;
use super::text::{did_you_mean, list, messages};
use crate::declare::tree::{Kind, Notation, Value};

/// Formats a literal as the user writes it: TOML has no syntax for angles and axes, so they are strings there.
fn literal(text: impl core::fmt::Display, notation: Notation) -> String {
    notation.pick(format!("{text}"), format!("\"{text}\""))
}

/// Formats the number as an angle in degrees and as one in radians.
fn in_units(digits: &str, notation: Notation) -> [String; 2] {
    ["deg", "rad"].map(|unit| literal(format_args!("{digits}{unit}"), notation))
}

fn range(low: &str, high: &str, notation: Notation) -> String {
    notation.pick(format!("{low}..={high}"), format!("[\"{low}\", \"{high}\"]"))
}

/// Returns an example of a range of angles.
fn a_range(key: &str, notation: Notation) -> String {
    Expected::ANGLE_RANGE.example(key, notation)
}

// Form: keys, values, separators.

messages! {
    expected(key: &str, expected: Expected, found: &str, notation: Notation)
        where words = expected.words, example = expected.example(key, notation) =>
        "`{key}` needs {words}, found {found}",
        "write it as in `{example}`";

    not_literal(key: &str, expected: Expected, found: &str, notation: Notation)
        where words = expected.words, example = expected.example(key, notation), reason = notation.pick(
            "a derive macro cannot evaluate expressions: write a literal",
            "only literals are allowed: write one",
        ) =>
        "`{key}` needs {words}, found {found}",
        "{reason}, as in `{example}`";

    capitals(key: &str, expected: Expected, found: &str, notation: Notation)
        where words = expected.words, lower = literal(found.to_lowercase(), notation) =>
        "`{key}` needs {words}, found `{found}`",
        "write `{key} = {lower}`";

    quoted(key: &str, expected: Expected, found: &str, literal: &str) where words = expected.words =>
        "`{key}` needs {words}, found {found}",
        "write `{literal}` without quotes";

    no_value(key: &str, expected: Expected, notation: Notation) where example = expected.example(key, notation) =>
        "`{key}` needs a value",
        "write it as in `{example}`";

    stray(found: &str) =>
        "expected the name of a setting, found `{found}`",
        "settings are written `name = value`, with commas between them";

    stray_option(found: &str) =>
        "expected the name of an option, found `{found}`",
        "write `#[differentiate(wrt(p, h), budget = 46, hessian, crate = ::aim)]`; only `wrt` is required";

    unknown_key(kind: &str, key: &str, nearest: Option<&str>, known: &[&str])
        where help = match nearest {
            Some(nearest) => format!("did you mean `{nearest}`?"),
            None => format!("expected one of {}", list(known)),
        } =>
        "unknown {kind} `{key}`",
        "{help}";

    renamed_key(old: &str, new: &str, value: &Value, notation: Notation)
        where [animation, bind_pose] = ["animation", "bind_pose"].map(|word| literal(word, notation)),
        help = match (&value.kind, old) {
            (Kind::Word(kind), "range") if kind == "absolute" => format!("write `{new} = {bind_pose}`"),
            (Kind::Word(kind), "range") if kind == "relative" => {
                format!("write `{new} = {animation}` or remove it: ranges are relative to the animation by default")
            }
            (_, "range") => format!(
                "write `{new} = {animation}` or `{new} = {bind_pose}`; the ranges themselves are set by `heading` and `pitch`"
            ),
            _ => format!("replace `{old}` by `{new}`; the value stays the same"),
        } =>
        "`{old}` is now called `{new}`",
        "{help}";

    unknown_role(found: &str, nearest: Option<Role>, notation: Notation)
        where meant = nearest.map_or_else(String::new, |role| {
            format!("; did you mean `role = {}`?", literal(role.as_str(), notation))
        }) =>
        "unknown role `{found}`",
        "expected `eye`, `head`, `neck`, `chest` or `none`{meant}";

    unknown_kernel(name: &str, known: &[&str])
        where help = did_you_mean(name, known, || format!("known kernels: {}", list(known))) =>
        "unknown kernel `{name}`",
        "{help}";

    key_of_rig(key: &str, notation: Notation)
        where place = notation
            .pick("`#[aim(…)]` on the struct", "the top of the file, above the first `[[joint]]`") =>
        "`{key}` is a setting of the rig, not of a joint",
        "move it to {place}";

    key_of_joint(key: &str, notation: Notation)
        where place = notation.pick("`#[joint(…)]` on the joint's field", "the joint, below its `[[joint]]`") =>
        "`{key}` is a setting of a joint, not of the rig",
        "move it to {place}";

    duplicate_key(key: &str)
        where help = if key == "wrt" { "put all variables into one `wrt(…)`" } else { "keep one of the two" } =>
        "`{key}` is set twice",
        "{help}";

    duplicate_word(word: &str) => "`{word}` is named twice", "keep one of the two";

    /// Message of the TOML parser about `part` of the text.
    #[cfg(feature = "toml")]
    syntax(found: &str, part: &str)
        where help = if found.starts_with("string values must be quoted") {
            format!("words, names and axes need quotes: `\"{part}\"`")
        } else if found.starts_with("invalid float") || found.starts_with("invalid integer") {
            "a number with a unit needs quotes, as in `\"450deg\"`".to_owned()
        } else {
            "a rig file is TOML 1.0, see https://toml.io".to_owned()
        } =>
        "invalid TOML: {found}",
        "{help}";
}

// Numbers and units.

messages! {
    missing_unit(digits: &str, notation: Notation) where [degrees, radians] = in_units(digits, notation) =>
        "`{digits}` has no unit",
        "write `{degrees}` or `{radians}`";

    detached_unit(digits: &str, unit: &str, notation: Notation)
        where joined = literal(format_args!("{digits}{unit}"), notation) =>
        "`{digits}` is separated from its unit",
        "write `{joined}`, without a space";

    unknown_unit(digits: &str, unit: &str, notation: Notation)
        where lower = unit.to_lowercase(), [degrees, radians] = in_units(digits, notation),
        help = if unit == "°" || unit == "º" || lower.starts_with("de") || lower == "d" {
            format!("degrees are written `{degrees}`")
        } else if lower.starts_with("ra") || lower == "r" {
            format!("radians are written `{radians}`")
        } else {
            format!("angles need `deg` or `rad`, as in `{degrees}`")
        } =>
        "`{unit}` is not an angle unit",
        "{help}";

    unit_on_plain(key: &str, digits: &str, unit: &str)
        where help = match (key, unit, digits.parse::<f64>()) {
            ("delay", ..) => "write the seconds without a unit, as in `delay = 0.05`".to_owned(),
            (_, "%", Ok(percent)) => format!("write `{:?}`", percent / 100.0),
            _ => format!("write `{digits}`"),
        } =>
        "`{key}` takes a number without a unit, found the unit `{unit}`",
        "{help}";

    radix(number: &str, radix: &str) => "`{number}` is {radix}", "write the number in decimal, as in `35deg`";

    not_positive(key: &str, number: &str, zero: bool)
        where found = if zero { "zero" } else { "negative" }, help = match key {
            "rate" => "a rate is the joint's largest speed; leave a joint that does not move out of the rig",
            "acceleration" => "remove `acceleration` for no limit",
            _ => "the larger the stiffness, the less the joint moves; the default is 1",
        } =>
        "`{key}` must be positive, `{number}` is {found}",
        "{help}";

    not_finite(key: &str, number: &str)
        where help = match key {
            "acceleration" => "remove `acceleration` for no limit",
            "rate" => "write the largest speed that looks natural, for eyes about `450deg`",
            _ => "write a finite number that fits single precision",
        } =>
        "`{key}` must be finite, `{number}` is not",
        "{help}";

    share_outside(key: &str, number: &str)
        where help = match key {
            "upright" => "0 turns about the bone's own up axis, 1 about the character's",
            "pitch_taper" => "0 keeps the full pitch range at the ends of the heading range, 1 reduces it to nothing",
            _ => "0 leaves the gaze to the eyes, 1 lets the head take all that exceeds `eyes_only`",
        } =>
        "`{key}` must be between 0 and 1, found `{number}`",
        "{help}";
}

// Ranges.

messages! {
    range_open(key: &str, notation: Notation) where example = a_range(key, notation) =>
        "the range of `{key}` is open",
        "write both bounds, inclusive: `{example}`";

    range_list(key: &str, count: usize) where example = a_range(key, Notation::Toml) =>
        "the range of `{key}` needs two bounds, found {count}",
        "write the lower bound, then the upper: `{example}`";

    range_single(key: &str, found: &str, mirrored: &str, notation: Notation)
        where range = range(&format!("-{mirrored}"), mirrored, notation) =>
        "`{key}` needs a range of angles, found {found}",
        "write `{key} = {range}`";

    range_inverted(key: &str, low: &str, high: &str, notation: Notation) where range = range(high, low, notation) =>
        "the range of `{key}` is inverted: {low} is above {high}",
        "write `{key} = {range}`";

    range_empty(key: &str) =>
        "the range of `{key}` is empty: its bounds are equal",
        "remove `{key}` if the joint cannot turn that way";

    range_without_zero(key: &str, low: &str, high: &str) =>
        "the range of `{key}`, {low} to {high}, does not contain 0",
        "angle 0 leaves the animation unchanged, and every joint must be able to rest there";

    range_tiny(key: &str, low: &str, high: &str, notation: Notation)
        where radians = match (low.strip_suffix("deg"), high.strip_suffix("deg")) {
            (Some(low), Some(high)) => {
                let range = range(&format!("{low}rad"), &format!("{high}rad"), notation);
                format!("write `{key} = {range}` if you mean radians; ")
            }
            _ => String::new(),
        } =>
        "the range of `{key}`, {low} to {high}, extends less than 1° to either side",
        "{radians}remove `{key}` if the joint cannot turn that way";

    rate_beyond(found: &str, rate: f64, notation: Notation)
        where turns = rate / core::f64::consts::TAU, help = match found.trim_matches('`').strip_suffix("rad") {
            Some(digits) => format!("write `rate = {}` if you mean degrees", in_units(digits, notation)[0]),
            None => "the largest accepted rate is 100rad (5729deg)".to_owned(),
        } =>
        "the rate {found} is too high: {turns:.0} turns per second",
        "{help}";

    range_beyond(key: &str, number: &str)
        where wraps = if key == "heading" { "; `heading = free` turns without limit" } else { "" } =>
        "`{number}` is beyond ±180°",
        "a joint turns at most 180deg to each side{wraps}";

    pitch_free(notation: Notation) where example = a_range("pitch", notation) =>
        "`pitch` cannot be free",
        "only a heading can turn without limit; give the pitch a range: `{example}`";

    pitch_taper_without_ends(has_heading: bool, has_pitch: bool)
        where (needs, help) = match (has_heading, has_pitch) {
            (true, true) => ("a heading with bounds", "a free heading has no bounds: give it a range"),
            (true, false) => ("a pitch", "it reduces the range of the pitch: declare `pitch`"),
            _ => ("a heading", "its effect grows with the heading: declare `heading`"),
        } =>
        "`pitch_taper` needs {needs}",
        "{help}, or remove `pitch_taper`";
}

// Natural gaze.

messages! {
    angle_outside(key: &str, number: &str) =>
        "`{key}` must be between 0° and 180°, found `{number}`",
        "it is an angle between two directions";

    release_above_engage(engage_deg: f64, release_deg: f64) =>
        "`release`, {release_deg}°, is above `engage`, {engage_deg}°",
        "the head starts to move at the larger angle and stops at the smaller; the defaults are 15° and 8°";

    unknown_body(word: &str) =>
        "unknown body `{word}`",
        "known bodies are `human`, `quadruped`, `bird` and `toon`; for others, set the budgets of `head` and `chest`";

    budget_free() =>
        "a budget cannot be free",
        "remove `heading` from the budget, and give each joint its own range";

    negative_delay(number: &str) =>
        "`delay` must not be negative, found `{number}`",
        "a delay is in seconds; with 0, head and eyes start together";
}

// Axes.

messages! {
    axis_without_sign(letter: &str, notation: Notation)
        where letter = letter.to_uppercase(),
        [plus, minus] = ['+', '-'].map(|sign| literal(format_args!("{sign}{letter}"), notation)) =>
        "the axis `{letter}` has no sign",
        "write `{plus}` or `{minus}`";

    axis_unknown(sign: char, letter: &str, notation: Notation)
        where upper = letter.to_uppercase(), help = match upper.as_str() {
            "X" | "Y" | "Z" => format!("axes are upper-case: `{}`", literal(format_args!("{sign}{upper}"), notation)),
            _ => "a bone's axes are `+X`, `-X`, `+Y`, `-Y`, `+Z` and `-Z`".to_owned(),
        } =>
        "`{sign}{letter}` is not an axis",
        "{help}";

    vector_length(key: &str, count: usize) =>
        "`{key}` needs three components, found {count}",
        "a vector has x, y and z";

    zero_vector(key: &str) => "`{key}` has no direction: its length is 0", "give it a length of 1";

    not_unit(key: &str, length: f64, unit: &str) =>
        "`{key}` is not a unit vector: its length is {length:.4}",
        "write `{key} = {unit}`";

    contradictory(first: &str, second: &str) =>
        "`{first}` and `{second}` declare the same axis",
        "keep one of them: the other is its opposite";

    parallel(first: &str, second: &str) =>
        "`{first}` and `{second}` are parallel",
        "the axes of a bone are perpendicular to each other: use each of X, Y and Z once";

    not_square(first: &str, second: &str, degrees: f64, nearest: &str) =>
        "`{first}` and `{second}` are not perpendicular: the angle between them is {degrees:.1}°",
        "the nearest orthonormal frame is {nearest}";

    no_axes(notation: Notation)
        where example = notation.pick(
            "#[aim(axes(up = +X, forward = +Y, left = +Z))]",
            "axes = { up = \"+X\", forward = \"+Y\", left = \"+Z\" }",
        ) =>
        "the bones' axes are missing",
        "declare which axes point up and forward, as in `{example}`";

    empty_axes(notation: Notation) where example = Expected::AXES.example("axes", notation) =>
        "`axes` declares no axis",
        "give two or three, as in `{example}`";

    one_axis(only: &str) where other = if matches!(only, "forward" | "back") { "up" } else { "forward" } =>
        "`axes` declares only `{only}`",
        "one axis does not determine the bone's roll: declare `{other}`, too; the third axis follows";

    wrong_hand(owner: Owner, rig_is_right: bool, flip: &str, notation: Notation)
        where (rig, other) = if rig_is_right { ("right", "left") } else { ("left", "right") },
        (found, help) = match owner {
            Owner::Rig => {
                let side = literal(other, notation);
                let help = format!("or declare `handedness = {side}` if the engine is {other}-handed");
                (format!("{other}-handed triple in a {rig}-handed rig"), help)
            }
            Owner::Joint => (
                format!("{other}-handed triple in a {rig}-handed rig"),
                "or add `mirrored = true` if the bone's own axes are mirrored".to_owned(),
            ),
            Owner::MirroredJoint => (
                format!("{rig}-handed triple, but the joint is mirrored in a {rig}-handed rig"),
                "or remove `mirrored = true`".to_owned(),
            ),
        } =>
        "the axes are a {found}",
        "flip one sign, as in `{flip}`, {help}";

    mirrored_without_axes(notation: Notation) where example = Expected::AXES.example("axes", notation) =>
        "a mirrored joint cannot share all three axes of the rig",
        "declare its own, as in `{example}`";
}

/// Owner of the axes, for messages about handedness.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Owner {
    Rig,
    Joint,
    MirroredJoint,
}

// Joints.

messages! {
    #[cfg(feature = "toml")]
    single_joint() =>
        "`joint` needs a list of joints, found a group of settings",
        "write `[[joint]]` before each joint";

    no_joints(notation: Notation)
        where how = notation.pick("a field of type `Joint` with `#[joint(…)]`", "a `[[joint]]`") =>
        "the rig has no joints",
        "declare each joint, from the eye inward, as {how}";

    no_angle(name: &str, notation: Notation) where example = a_range("heading", notation) =>
        "`{name}` has neither heading nor pitch",
        "give it a range, as in `{example}`";

    no_rate(name: &str, notation: Notation) where example = Expected::RATE.example("rate", notation) =>
        "`{name}` has no rate",
        "add its largest speed per second, as in `{example}`";

    other_eye_inward() =>
        "`other_eye` is not on the first joint",
        "the eye is the outermost joint: move `other_eye` to the first joint";
}

// Names.

messages! {
    no_name(what: &str) where example = if what == "rig" { "Thug" } else { "left_eye" } =>
        "the {what} has no name",
        "add `name = \"{example}\"`";

    not_ascii(name: &str) =>
        "the name `{name}` is not ASCII",
        "it becomes an identifier in C and WGSL: use a-z, A-Z, 0-9 and _";

    not_identifier(name: &str) where name = name.escape_debug() =>
        "`{name}` is not a valid Rust identifier",
        "an identifier starts with a letter, followed by letters, digits and `_`";

    rust_keyword(name: &str) =>
        "`{name}` is a keyword of Rust",
        "choose another name: it becomes an identifier in the generated Rust code";

    keyword(name: &str, snake: &str, language: &str)
        where becomes = if name == snake { "is".to_owned() } else { format!("becomes `{snake}`,") } =>
        "the name `{name}` {becomes} a keyword of {language}",
        "choose another name: it becomes an identifier in the generated C and WGSL code";

    reserved_prefix(name: &str) =>
        "the name `{name}` starts with two underscores",
        "C and WGSL reserve such names: remove an underscore";

    duplicate_name(name: &str) => "two joints are named `{name}`", "each joint needs a name of its own";

    name_collision(first: &str, second: &str, snake: &str) =>
        "`{first}` and `{second}` are both `{snake}` in C and WGSL",
        "rename one, so that they differ in more than case and underscores";

    duplicate_bone(bone: &str) => "the bone `{bone}` is used twice", "each joint needs a bone of its own";

    held_joint(bone: &str) =>
        "`hold` names `{bone}`, a bone that the rig turns",
        "a bone is either turned or held: remove it from one of the two";

    duplicate_held(bone: &str) => "the bone `{bone}` is held twice", "name it once, on the joint to which it is attached";

    empty_bone(key: &str) => "`{key}` names no node", "write the name of the bone's node in the model";
}

// The Rust item.

messages! {
    wrong_shape(what: &str) =>
        "a rig is a struct with named fields, found {what}",
        "declare a struct with one field of type `Joint` for each joint, from the eye inward";

    generics() => "a rig cannot be generic", "its kernels are derived for one set of axes: remove the parameters";

    foreign_field(field: &str, found: &str) =>
        "the field `{field}` is of type `{found}`, not `Joint`",
        "every field of a rig is a joint: write `{field}: Joint`, or move the field to another struct";

    misplaced(attribute: &str)
        where (owner, help) = match attribute {
            "aim" => ("a field", "put the rig's settings above the struct; a joint's are in `#[joint(…)]`"),
            _ => ("the struct", "put a joint's settings on its field; the rig's are in `#[aim(…)]`"),
        } =>
        "`#[{attribute}]` is on {owner}",
        "{help}";

    no_list(attribute: &str)
        where example = match attribute {
            "aim" => "axes(up = +X, forward = +Y)",
            _ => "heading = -35deg..=35deg, rate = 450deg",
        } =>
        "`#[{attribute}]` has no settings",
        "give them in parentheses, as in `#[{attribute}({example})]`";

    no_attribute(name: &str) =>
        "the field `{name}` has no `#[joint]`",
        "every field of a rig is a joint: add `#[joint(heading = -35deg..=35deg, rate = 450deg)]`, \
         or move the field to another struct";

    several_attributes(attribute: &str) where owner = if attribute == "aim" { "struct" } else { "field" } =>
        "the {owner} has a second `#[{attribute}]`",
        "put all settings into one `#[{attribute}(…)]`";
}

// Notes at a second place.

pub(crate) fn first_use(what: &str) -> String {
    format!("`{what}` was first used here")
}

pub(crate) fn declared_here(what: &str) -> String {
    format!("`{what}` is declared here")
}

pub(crate) fn first_attribute(name: &str) -> String {
    format!("the first `#[{name}]` is here")
}

pub(crate) fn default_bone_here(name: &str) -> String {
    format!("this joint has no `bone`, so the name of its bone is `{name}`")
}

pub(crate) fn rig_axes_here() -> String {
    "the rig's three axes are declared here".to_owned()
}
