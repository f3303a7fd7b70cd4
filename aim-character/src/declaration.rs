//! A rig written down as its user would declare it: in TOML, or as a derive.

use std::fmt::Write;

use aim_codegen::{AngleRange, Frame, JointSpec, RigSpec};

use crate::proposal::Proposal;

/// What a declaration is written in.
#[derive(Clone, Copy)]
enum Notation {
    Toml,
    Rust,
}

/// A direction as text, in one of the two notations.
fn direction([x, y, z]: [f64; 3], quoted: bool) -> String {
    let axis = [("X", x), ("Y", y), ("Z", z)].into_iter().find(|(_, c)| c.abs() == 1.0);
    match (axis, quoted) {
        (Some((name, c)), true) => format!("\"{}{name}\"", if c < 0.0 { '-' } else { '+' }),
        (Some((name, c)), false) => format!("{}{name}", if c < 0.0 { '-' } else { '+' }),
        (None, true) => format!("[{x:.6}, {y:.6}, {z:.6}]"),
        (None, false) => format!("({x:.6}, {y:.6}, {z:.6})"),
    }
}

fn axes(frame: &Frame, quoted: bool) -> String {
    let [up, forward, left] = [frame.up, frame.forward, frame.left].map(|axis| direction(axis, quoted));
    format!("up = {up}, forward = {forward}, left = {left}")
}

/// Degrees as people write them: no more decimals than it has.
fn degrees(radians: f64) -> String {
    let text = format!("{:.3}", radians.to_degrees());
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

/// A string of TOML, or of Rust, where a code point stands in braces.
fn quoted(text: &str, notation: Notation) -> String {
    let mut out = String::from('"');
    for c in text.chars() {
        let _ = match (c, notation) {
            ('\\' | '"', _) => write!(out, "\\{c}"),
            (c, Notation::Toml) if c.is_control() => write!(out, "\\u{:04X}", u32::from(c)),
            (c, Notation::Rust) if c.is_control() => write!(out, "\\u{{{:X}}}", u32::from(c)),
            (c, _) => write!(out, "{c}"),
        };
    }
    out + "\""
}

/// The first line's words on where all this comes from.
#[derive(Clone, Copy, Debug)]
pub struct Origin<'a> {
    /// The model's file name.
    pub file: &'a str,
    /// Where it faces and what told it.
    pub facing: &'a str,
}

/// A rig file.
pub fn toml(proposal: &Proposal, origin: &Origin<'_>) -> String {
    let RigSpec { name, joints, .. } = &proposal.spec;
    let shared = shared_axes(joints);
    let mut out = format!("# Measured from {}. {}\n", one_line(origin.file), one_line(origin.facing));
    let _ = writeln!(out, "name = {}\nhandedness = \"right\"", quoted(name, Notation::Toml));
    if let Some(frame) = shared {
        let _ = writeln!(out, "bones = {{ {} }}", axes(frame, true));
    }
    for (joint, why) in joints.iter().zip(&proposal.reasons) {
        let _ = writeln!(
            out,
            "\n# {why}\n[[joint]]\nname = {}\nbone = {}",
            quoted(&joint.name, Notation::Toml),
            quoted(&joint.bones[0], Notation::Toml)
        );
        if let Some(pair) = &joint.pair {
            let _ = writeln!(out, "pair = {}", quoted(pair, Notation::Toml));
        }
        if shared != Some(&joint.frame) {
            let _ = writeln!(out, "bones = {{ {} }}", axes(&joint.frame, true));
        }
        if joint.frame.handedness() < 0.0 {
            out += "mirrored = true\n";
        }
        for (key, range) in [("heading", joint.heading), ("pitch", joint.pitch)] {
            let _ = match range {
                Some(AngleRange::Between(lo, hi)) => {
                    writeln!(out, "{key} = [\"{}deg\", \"{}deg\"]", degrees(lo), degrees(hi))
                }
                Some(AngleRange::Free) => writeln!(out, "{key} = \"free\""),
                None => Ok(()),
            };
        }
        let _ = writeln!(out, "rate = \"{}deg\"\ncomfort = {:?}", degrees(joint.rate), joint.comfort);
    }
    out
}

/// A struct to paste.
pub fn rust(proposal: &Proposal, origin: &Origin<'_>) -> String {
    let RigSpec { name, joints, .. } = &proposal.spec;
    let shared = shared_axes(joints);
    let mut out = format!(
        "use aim::{{AimRig, Joint}};\n\n/// Measured from {}. {}\n#[derive(AimRig)]\n",
        one_line(origin.file),
        one_line(origin.facing)
    );
    if let Some(frame) = shared {
        let _ = writeln!(out, "#[aim(bones({}))]", axes(frame, false));
    }
    let _ = writeln!(out, "pub struct {name} {{");
    for (joint, why) in joints.iter().zip(&proposal.reasons) {
        let mut keys = vec![format!("bone = {}", quoted(&joint.bones[0], Notation::Rust))];
        keys.extend(joint.pair.as_deref().map(|pair| format!("pair = {}", quoted(pair, Notation::Rust))));
        keys.extend((shared != Some(&joint.frame)).then(|| format!("bones({})", axes(&joint.frame, false))));
        keys.extend((joint.frame.handedness() < 0.0).then(|| "mirrored = true".to_owned()));
        for (key, range) in [("heading", joint.heading), ("pitch", joint.pitch)] {
            keys.extend(range.map(|range| match range {
                AngleRange::Between(lo, hi) => format!("{key} = {}deg..={}deg", degrees(lo), degrees(hi)),
                AngleRange::Free => format!("{key} = free"),
            }));
        }
        keys.push(format!("rate = {}deg", degrees(joint.rate)));
        keys.push(format!("comfort = {:?}", joint.comfort));
        let _ = writeln!(
            out,
            "    // {why}\n    #[joint(\n        {}\n    )]\n    pub {}: Joint,",
            keys.join(",\n        "),
            joint.name
        );
    }
    out + "}\n"
}

/// The axes of the first joint that are signed and not mirrored: said once, for all that have them.
fn shared_axes(joints: &[JointSpec]) -> Option<&Frame> {
    let is_cardinal = |frame: &Frame| frame.up.iter().chain(&frame.forward).all(|c| c.fract() == 0.0);
    joints.iter().map(|joint| &joint.frame).find(|frame| frame.handedness() > 0.0 && is_cardinal(frame))
}

fn one_line(text: &str) -> String {
    text.replace(char::is_control, " ")
}

/// A Rust type's name from a file's: `female_adult-01` → `FemaleAdult01`; `Rig` where nothing is left of it.
pub fn type_name(stem: &str) -> String {
    let words = stem.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let capital = |word: &str| word[..1].to_ascii_uppercase() + &word[1..];
    let name: String = words.map(capital).collect();
    match name.as_str() {
        "" | "Self" | "Joint" | "AimRig" => "Rig".into(),
        name if name.starts_with(|c: char| c.is_ascii_digit()) => format!("Rig{name}"),
        name => name.into(),
    }
}
