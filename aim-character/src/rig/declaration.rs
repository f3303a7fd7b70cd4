//! Rigs as source text: a TOML rig file, or a Rust struct with its derive. Both contain all of a [`RigSpec`] and are
//! read back unchanged: angles and numbers exactly, directions to nine decimals.

use aim_animation::Transform;
use aim_codegen::{AngleRange, Budget, Budgets, Frame, JointSpec, LimitsFrom, NaturalSpec, RigSpec};
use aim_gltf::Document;
use aim_runtime::glam::{DAffine3, DVec3};

use crate::measure::Measurement;
use crate::measure::roles::Role;
use crate::rig::proposal::Proposal;

/// Writes a rig file in TOML. Its first line is the comment `about`; above each joint a comment gives the reason for
/// it.
#[must_use]
pub fn toml(proposal: &Proposal, about: &str) -> String {
    use Notation::Toml;
    let written = DeclarationWriter::new(&proposal.spec, Toml);
    let mut out = format!("# {}\nname = {}\n", one_line(about), quoted(&proposal.spec.name, Toml));
    for key in written.rig_keys() {
        out += &format!("{key}\n");
    }
    for (at, joint) in proposal.spec.joints.iter().enumerate() {
        let why = proposal.reason(at).map_or(String::new(), |why| format!("# {}\n", one_line(why)));
        out += &format!("\n{why}[[joint]]\nname = {}\n", quoted(&joint.name, Toml));
        for key in written.joint_keys(joint) {
            out += &format!("{key}\n");
        }
    }
    out
}

/// Writes a Rust struct with its derive, to be pasted into source code. Its documentation is `about`; above each joint
/// a comment gives the reason for it.
#[must_use]
pub fn rust(proposal: &Proposal, about: &str) -> String {
    format!("use aim::{{AimRig, Joint}};\n\n{}", item(proposal, about, &[]))
}

/// Writes the struct of [`rust`] for a Bevy app with the plugin `bevy_aim`, and a function that makes the character to
/// be spawned with the file's scene. The character includes its trunk, and its bind pose if that differs from the
/// file's rest pose.
pub fn bevy(proposal: &Proposal, about: &str, document: &Document, measurement: &Measurement) -> String {
    let name = &proposal.spec.name;
    let item = item(proposal, about, &["crate = bevy_aim::aim".into()]);
    let mut with = String::new();
    let text = |bone: &str| quoted(bone, Notation::Rust);
    let skeleton = document.skeleton();
    let is_clear = |node: &usize| skeleton.find(&skeleton.names()[*node]).is_ok();
    let hips = measurement.with_role(Role::Hips).map(|bone| bone.node).filter(is_clear);
    if let Some(hips) = hips {
        with += &format!("\n            .with_trunk({})", text(&skeleton.names()[hips]));
    }
    let number = |c: f64| format!("{:?}", (c * 1e6).round() / 1e6 + 0.0);
    let triple = |v: DVec3| v.to_array().map(number).join(", ");
    if measurement.up.distance(DVec3::Y) > 1e-6 {
        with += &format!("\n            .with_up(Vec3::new({}))", triple(measurement.up));
    }
    let bind = bind_pose(proposal, document, measurement, hips);
    if !bind.is_empty() {
        with += "\n            .with_bind_pose([";
        for (node, place) in bind {
            let Some(at) = Transform::from_affine(&place.as_affine3a()) else { continue };
            let [x, y, z, w] = at.rotation.as_dquat().to_array().map(number);
            with += &format!(
                "\n                ({}, Affine3A::from_scale_rotation_translation(Vec3::new({}), Quat::from_xyzw({x}, {y}, {z}, {w}), Vec3::new({}))),",
                text(&skeleton.names()[node]),
                triple(at.scale.as_dvec3()),
                triple(at.translation.as_dvec3()),
            );
        }
        with += "\n            ])";
    }
    let types: Vec<&str> =
        ["Affine3A", "Quat", "Vec3"].into_iter().filter(|of| with.contains(&format!("{of}::"))).collect();
    let glam = match types.as_slice() {
        [] => String::new(),
        [one] => format!("use bevy_aim::aim::glam::{one};\n"),
        several => format!("use bevy_aim::aim::glam::{{{}}};\n", several.join(", ")),
    };
    format!(
        "use bevy_aim::AimCharacter;\n{glam}use bevy_aim::aim::{{AimRig, Joint}};\n\n{item}\n\
         impl {name} {{\n    /// The character, to be spawned on the root of its scene, together with an `AimTarget`.\n    \
         pub fn character() -> AimCharacter {{\n        AimCharacter::of::<Self>(){with}\n    }}\n}}\n"
    )
}

/// Returns the bones whose bind pose the runtime needs, each with its transform; none if the file's rest pose is the
/// bind pose.
fn bind_pose(
    proposal: &Proposal,
    document: &Document,
    measurement: &Measurement,
    trunk: Option<usize>,
) -> Vec<(usize, DAffine3)> {
    let skeleton = document.skeleton();
    let node = |name: &String| skeleton.find(name).ok();
    let joints: Vec<usize> =
        proposal.spec.joints.iter().filter_map(|joint| joint.bones.first().and_then(node)).collect();
    let carrier = joints.last().and_then(|&innermost| skeleton.parents()[innermost]);
    let other_eye = proposal.spec.joints.first().and_then(|joint| joint.other_eye.as_ref()).and_then(node);
    let mut bones: Vec<usize> = joints.into_iter().chain(carrier).chain(other_eye).chain(trunk).collect();
    bones.sort_unstable();
    bones.dedup();
    bones.retain(|&bone| node(&skeleton.names()[bone]).is_some());
    let rest = skeleton.world_f64(skeleton.rest());
    let is_rest = |&bone: &usize| rest[bone].abs_diff_eq(measurement.bind_world[bone], 1e-4);
    if bones.iter().all(is_rest) {
        return Vec::new();
    }
    bones.into_iter().map(|bone| (bone, measurement.bind_world[bone])).collect()
}

/// Writes the struct with its derive. `first_keys` come before the rig's own keys.
fn item(proposal: &Proposal, about: &str, first_keys: &[String]) -> String {
    let written = DeclarationWriter::new(&proposal.spec, Notation::Rust);
    let mut out = format!("/// {}\n#[derive(AimRig)]\n", one_line(about));
    match [first_keys, &written.rig_keys()].concat().as_slice() {
        [] => {}
        [key] => out += &format!("#[aim({key})]\n"),
        keys => out += &format!("#[aim(\n    {}\n)]\n", keys.join(",\n    ")),
    }
    out += &format!("pub struct {} {{\n", proposal.spec.name);
    for (at, joint) in proposal.spec.joints.iter().enumerate() {
        let why = proposal.reason(at).map_or(String::new(), |why| format!("    // {}\n", one_line(why)));
        let keys = written.joint_keys(joint).join(",\n        ");
        out += &format!("{why}    #[joint(\n        {keys}\n    )]\n    pub {}: Joint,\n", joint.name);
    }
    out + "}\n"
}

/// Returns the name of a Rust type for the stem of a file name: `female_adult-01` → `FemaleAdult01`; `Rig` if nothing
/// usable is left.
#[must_use]
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

/// Language of a declaration.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Notation {
    Toml,
    Rust,
}

/// Writer of one rig.
struct DeclarationWriter<'s> {
    spec: &'s RigSpec,
    /// 1 for a right-handed rig; −1 if all bones are mirrored.
    hand: f64,
    /// Axes that the rig declares once for all joints that have them: those of the first joint with signed axes and the
    /// rig's handedness.
    shared: Option<&'s Frame>,
    notation: Notation,
}

impl<'s> DeclarationWriter<'s> {
    fn new(spec: &'s RigSpec, notation: Notation) -> Self {
        let frames = || spec.joints.iter().map(|joint| &joint.frame);
        let hand = if frames().all(|frame| frame.handedness() < 0.0) { -1.0 } else { 1.0 };
        let is_signed = |frame: &Frame| frame.up.iter().chain(&frame.forward).all(|c| c.fract() == 0.0);
        let shared = frames().find(|frame| frame.handedness() == hand && is_signed(frame));
        Self { spec, hand, shared, notation }
    }

    fn rig_keys(&self) -> Vec<String> {
        let mut keys = Vec::new();
        match (self.hand < 0.0, self.notation) {
            (true, _) => keys.push(format!("handedness = {}", self.word("left"))),
            // Right-handed is the default of derives.
            (false, Notation::Toml) => keys.push(format!("handedness = {}", self.word("right"))),
            (false, Notation::Rust) => {}
        }
        keys.extend(self.shared.map(|frame| self.axes(frame)));
        let effector = &self.spec.effector;
        let own_forward = effector.frame.forward != self.spec.joints[0].frame.forward;
        let forward = own_forward.then(|| format!("forward = {}", self.direction(effector.frame.forward)));
        let origin = (effector.origin != [0.0; 3])
            .then(|| format!("origin = {}", self.vector(effector.origin.map(|c| format!("{c:?}")))));
        let parts: Vec<String> = forward.into_iter().chain(origin).collect();
        keys.extend((!parts.is_empty()).then(|| self.table("effector", &parts)));
        keys.extend(self.spec.natural.as_ref().map(|natural| self.natural(natural)));
        keys.extend(self.spec.region.as_ref().map(|budgets| self.region(budgets)));
        keys
    }

    fn region(&self, budgets: &Budgets) -> String {
        if let Some((name, _)) = Budgets::NAMED.iter().find(|(_, named)| named == budgets) {
            return format!("region = {}", self.word(name));
        }
        let budget = |name: &str, budget: &Budget| {
            let [heading, pitch] =
                [budget.heading, budget.pitch].map(|[lo, hi]| self.range(AngleRange::Between(lo, hi)));
            let [rate, acceleration] = [budget.rate, budget.acceleration].map(|angle| self.angle(angle));
            self.table(
                name,
                &[
                    format!("heading = {heading}"),
                    format!("pitch = {pitch}"),
                    format!("rate = {rate}"),
                    format!("acceleration = {acceleration}"),
                ],
            )
        };
        self.table("region", &[budget("head", &budgets.head), budget("chest", &budgets.chest)])
    }

    fn natural(&self, natural: &NaturalSpec) -> String {
        let NaturalSpec { eyes_only, head_share, engage, release, delay } = natural;
        let [eyes_only, engage, release] = [eyes_only, engage, release].map(|angle| self.angle(*angle));
        self.table(
            "natural",
            &[
                format!("eyes_only = {eyes_only}"),
                format!("head_share = {head_share:?}"),
                format!("engage = {engage}"),
                format!("release = {release}"),
                format!("delay = {delay:?}"),
            ],
        )
    }

    fn joint_keys(&self, joint: &JointSpec) -> Vec<String> {
        let names: Vec<String> = joint.bones.iter().map(|bone| quoted(bone, self.notation)).collect();
        let mut keys = vec![match names.as_slice() {
            [name] => format!("bone = {name}"),
            names => format!("bone = [{}]", names.join(", ")),
        }];
        keys.push(format!("role = {}", self.word(joint.role.as_str())));
        keys.extend(joint.other_eye.as_deref().map(|node| format!("other_eye = {}", quoted(node, self.notation))));
        keys.extend(joint.hold.as_deref().map(|names| {
            let names: Vec<String> = names.iter().map(|name| quoted(name, self.notation)).collect();
            format!("hold = [{}]", names.join(", "))
        }));
        keys.extend((self.shared != Some(&joint.frame)).then(|| self.axes(&joint.frame)));
        keys.extend((joint.frame.handedness() != self.hand).then(|| "mirrored = true".to_owned()));
        for (key, range) in [("heading", joint.heading), ("pitch", joint.pitch)] {
            keys.extend(range.map(|range| format!("{key} = {}", self.range(range))));
        }
        keys.extend(
            (joint.limits_from == LimitsFrom::BindPose).then(|| format!("limits_from = {}", self.word("bind_pose"))),
        );
        keys.extend(joint.pitch_taper.map(|taper| format!("pitch_taper = {taper:?}")));
        keys.extend(joint.upright.map(|upright| format!("upright = {upright:?}")));
        keys.push(format!("rate = {}", self.angle(joint.rate)));
        keys.extend(joint.acceleration.map(|acceleration| format!("acceleration = {}", self.angle(acceleration))));
        keys.push(format!("stiffness = {:?}", joint.stiffness));
        keys
    }

    fn axes(&self, frame: &Frame) -> String {
        let [up, forward, left] = [frame.up, frame.forward, frame.left].map(|axis| self.direction(axis));
        self.table("axes", &[format!("up = {up}"), format!("forward = {forward}"), format!("left = {left}")])
    }

    fn range(&self, range: AngleRange) -> String {
        match (range, self.notation) {
            (AngleRange::Free, _) => self.word("free"),
            (AngleRange::Between(lo, hi), Notation::Toml) => format!("[{}, {}]", self.angle(lo), self.angle(hi)),
            (AngleRange::Between(lo, hi), Notation::Rust) => format!("{}..={}", self.angle(lo), self.angle(hi)),
        }
    }

    /// Formats an angle in degrees, with as few decimals as it needs to be read back exactly; in radians if no number
    /// of degrees is read back as the same angle.
    fn angle(&self, radians: f64) -> String {
        let degrees = radians.to_degrees();
        let short = [0, 1, 3].into_iter().map(|decimals| format!("{degrees:.decimals$}"));
        let exact = short
            .chain([format!("{degrees}")])
            .find(|text| text.parse::<f64>().is_ok_and(|degrees| degrees.to_radians() == radians));
        match exact {
            Some(text) if text == "-0" => self.word("0deg"),
            Some(text) => self.word(&format!("{text}deg")),
            None => self.word(&format!("{radians}rad")),
        }
    }

    fn direction(&self, direction: [f64; 3]) -> String {
        let axis = ["X", "Y", "Z"].into_iter().zip(direction).find(|(_, c)| c.abs() == 1.0);
        match axis {
            Some((name, c)) => self.word(&format!("{}{name}", if c < 0.0 { '-' } else { '+' })),
            None => self.vector(direction.map(|c| format!("{c:.9}"))),
        }
    }

    fn vector(&self, components: [String; 3]) -> String {
        let components = components.join(", ");
        match self.notation {
            Notation::Toml => format!("[{components}]"),
            Notation::Rust => format!("({components})"),
        }
    }

    fn table(&self, key: &str, entries: &[String]) -> String {
        let entries = entries.join(", ");
        match self.notation {
            Notation::Toml => format!("{key} = {{ {entries} }}"),
            Notation::Rust => format!("{key}({entries})"),
        }
    }

    /// Formats a keyword: a bare word in Rust, a string in TOML.
    fn word(&self, text: &str) -> String {
        match self.notation {
            Notation::Toml => quoted(text, self.notation),
            Notation::Rust => text.into(),
        }
    }
}

/// Formats a string literal. The two languages differ in the escapes of code points.
fn quoted(text: &str, notation: Notation) -> String {
    let mut out = String::from('"');
    for c in text.chars() {
        match (c, notation) {
            ('\\' | '"', _) => out.extend(['\\', c]),
            (c, Notation::Toml) if c.is_control() => out += &format!("\\u{:04X}", u32::from(c)),
            (c, Notation::Rust) if c.is_control() => out += &format!("\\u{{{:X}}}", u32::from(c)),
            (c, _) => out.push(c),
        }
    }
    out + "\""
}

fn one_line(text: &str) -> String {
    text.replace(char::is_control, " ")
}
