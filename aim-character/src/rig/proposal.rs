//! Proposes a rig for a file: the chain from the effector to the root, each bone's measured axes, and ranges and rates
//! as in people. `aim rig` writes the proposal to a file; `aim bake` uses it if no rig is given.

use aim_codegen::{AngleRange, Budget, Budgets, EffectorSpec, Frame, JointSpec, LimitsFrom, RigSpec};
use aim_gltf::{Document, LookAt, LookAtKind, RangeMap};
use aim_model::{BoneName, Role as Declared};

use crate::bake::chain::ChainNodes;
use crate::bake::eye_maps::range_maps;
use crate::error::Error;
use crate::measure::clues::Clue;
use crate::measure::limbs::limbs_on_each;
use crate::measure::roles::{Role, trunk_of};
use crate::measure::stance::BodyKind;
use crate::measure::{BoneAxes, Measurement, SignedAxis};
use crate::rig::parts::{Region, of_budget, parts};

/// Largest deviation, degrees, up to which a bone is declared with its nearest signed axes; beyond, with its exact
/// frame.
const CARDINAL_DEG: f64 = 3.0;
/// Largest number of joints in the chain of a machine.
const MACHINE_JOINTS: usize = 4;
/// A proposed rig, with reasons for its joints.
#[derive(Clone, Debug)]
pub struct Proposal {
    /// The rig: its chain from the effector inward, with measured axes and habitual ranges and rates.
    pub spec: RigSpec,
    /// Reason for each joint's ranges and rate, one line per joint. Empty for a joint without a special reason, and in
    /// small builds (`cfg(aim_small)`).
    pub reasons: Vec<String>,
}

impl Proposal {
    /// Returns the reason for a joint, if there is one.
    pub(crate) fn reason(&self, joint: usize) -> Option<&str> {
        self.reasons.get(joint).map(String::as_str).filter(|why| !why.is_empty())
    }
}

/// Habitual ranges and rate of a joint, degrees and degrees per second.
#[derive(Clone, Copy)]
struct JointDefaults {
    heading: Option<[f64; 2]>,
    pitch: Option<[f64; 2]>,
    rate: f64,
    stiffness: f64,
    why: &'static str,
}

/// Range of an angle without limits.
const FREE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

const EYE: JointDefaults = JointDefaults {
    heading: Some([-35.0, 35.0]),
    pitch: Some([-25.0, 20.0]),
    rate: 450.0,
    stiffness: 0.5,
    why: "eyes can turn by about 50 degrees but seldom pass 35; saccades peak at 400 to 700 deg/s",
};
const HIPS: JointDefaults = JointDefaults {
    heading: Some([-20.0, 20.0]),
    pitch: Some([-10.0, 10.0]),
    rate: 70.0,
    stiffness: 4.0,
    why: "hips carry the legs, so turning them moves the feet",
};
const BASE: JointDefaults = JointDefaults {
    heading: Some(FREE),
    pitch: None,
    rate: 120.0,
    stiffness: 1.0,
    why: "its name suggests that it turns about the vertical axis",
};
const BARREL: JointDefaults = JointDefaults {
    heading: None,
    pitch: Some([-10.0, 80.0]),
    rate: 90.0,
    stiffness: 1.0,
    why: "its name suggests that it is raised and lowered",
};
const HINGE: JointDefaults = JointDefaults {
    heading: Some([-45.0, 45.0]),
    pitch: Some([-45.0, 45.0]),
    rate: 90.0,
    stiffness: 2.0,
    why: "its abilities are unknown: set its own ranges and rate",
};
/// Words in the names of bones that turn about the upright axis.
const YAW_WORDS: [&str; 6] = ["base", "yaw", "pan", "swivel", "turret", "turntable"];
/// Words in the names of bones that are raised and lowered.
const PITCH_WORDS: [&str; 7] = ["pitch", "tilt", "elevation", "barrel", "gun", "cannon", "muzzle"];

/// Proposes a rig for the `named` nodes (from the effector inward), or for the chain found by roles and names.
///
/// ```
/// use aim_character::{Measurement, PAPER_AXES, declaration, mannequin, propose};
/// use aim_gltf::Document;
///
/// let document = Document::from_bytes(&mannequin(|_| PAPER_AXES)?)?;
/// let proposal = propose(&document, &Measurement::of(&document), None)?;
/// let toml = declaration::toml(&proposal, "Of the mannequin.");
/// assert!(toml.contains("bone = \"left_eye\"\nrole = \"eye\"\nother_eye = \"right_eye\""));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Fails if the file has no eye, head, neck or pointing part, if the named nodes do not form a chain, or if the name of
/// a bone is not unique.
pub fn propose(document: &Document, measurement: &Measurement, named: Option<&[String]>) -> Result<Proposal, Error> {
    let skeleton = document.skeleton();
    let nodes = match named {
        Some(names) => {
            let bones: Vec<Vec<String>> = names.iter().map(|name| vec![name.clone()]).collect();
            ChainNodes::find(skeleton, bones.iter().map(Vec::as_slice), None)?.joints
        }
        None => chain(document, measurement).ok_or(Error::NoChain)?,
    };
    let listed =
        |&node: &usize| measurement.bone(node).ok_or_else(|| Error::NoBone { node: skeleton.names()[node].clone() });
    let bones: Vec<&BoneAxes> = nodes.iter().map(listed).collect::<Result<_, _>>()?;
    let roles: Vec<Declared> = bones.iter().map(|bone| role(bone)).collect();
    let budgets = match measurement.kind {
        BodyKind::Human => Budgets::HUMAN,
        BodyKind::Quadruped => Budgets::QUADRUPED,
        BodyKind::Bird => Budgets::BIRD,
    };
    let has_region = roles.iter().any(|role| Region::of(*role).is_some());
    let mut proposal = Proposal {
        spec: RigSpec {
            name: "Measured".into(),
            joints: Vec::new(),
            effector: effector(bones[0]),
            natural: None,
            region: has_region.then_some(budgets),
            kernels: Vec::new(),
        },
        reasons: Vec::new(),
    };
    let of_neck = bones.iter().filter(|bone| matches!(bone.role, Some(Role::Head | Role::Neck)));
    let limbs = limbs_on_each(skeleton, measurement, of_neck.map(|bone| bone.node));
    // Only unique names can be declared. If any name is not, `hold` is omitted, and the arms are found when the rig is
    // used.
    let is_clear = |limb: &usize| skeleton.find(&skeleton.names()[*limb]).is_ok();
    let is_declared = limbs.iter().flat_map(|(_, limbs)| limbs).all(is_clear);
    for (at, (bone, part)) in bones.iter().zip(parts(&roles, &bones)).enumerate() {
        // Only unique names can be declared.
        skeleton.find(&bone.name)?;
        let region = Region::of(roles[at]);
        let defaults =
            region.map_or_else(|| *defaults_by_name(bone), |region| defaults_in_region(region, part, &budgets));
        let mut joint = joint(field_name(bone, &bones, at), roles[at], &defaults, bone);
        if at == 0 {
            joint.other_eye = other_eye(measurement, bone).map(|eye| eye.name.clone());
        }
        let mapped = if at == 0 { range_maps(document, bone).and_then(mapped_range) } else { None };
        if let Some(ranges) = mapped {
            [joint.heading, joint.pitch] = ranges.map(|range| range.map(between));
        }
        let names = |limbs: &Vec<usize>| limbs.iter().map(|&limb| skeleton.names()[limb].clone()).collect();
        let held: Option<Vec<String>> =
            limbs.iter().find(|(node, _)| *node == bone.node).map(|(_, limbs)| names(limbs));
        joint.hold = held.clone().filter(|_| is_declared);
        let reason = || {
            let mut why = match region {
                _ if mapped.is_some() => reason_for_maps(skeleton.is_in_file(bone.node)),
                Some(region) => reason_for_region(region, part, &budgets),
                None => defaults.why.to_owned(),
            };
            if let Some(rest) = eyes_rest(document, measurement).filter(|_| at == 0 && named.is_none()) {
                why += "; ";
                why += rest;
            }
            why + &reason_for_limbs(held.as_deref(), is_declared) + &reason_for_frame(bone)
        };
        // Small builds write no declarations and do without the texts.
        proposal.reasons.push(if cfg!(aim_small) { String::new() } else { reason() });
        proposal.spec.joints.push(joint);
    }
    Ok(proposal)
}

fn reason_for_maps(is_in_file: bool) -> String {
    "the angle to the target, within the range of an eye; ".to_owned()
        + if is_in_file {
            "`aim bake` applies the range maps of the file's lookAt to it and turns the bone by the result"
        } else {
            "not a node of the file, but the centre of what its morph targets move; `aim bake` writes their weights"
        }
}

fn reason_for_limbs(held: Option<&[String]>, is_declared: bool) -> String {
    let Some(names) = held else { return String::new() };
    let what = if is_declared {
        ", which are held on the trunk"
    } else {
        ", which `hold` cannot name because names repeat; `aim bake` finds them and holds them on the trunk"
    };
    format!("; it carries {}{what}", names.join(", "))
}

fn reason_for_frame(bone: &BoneAxes) -> String {
    if bone.deviation_deg <= CARDINAL_DEG {
        return String::new();
    }
    let BoneAxes { up, forward, left, deviation_deg, .. } = bone;
    format!("; {up} {forward} {left} would be {deviation_deg:.0} degrees off, so the exact frame is given")
}

/// Returns the chain from the outermost bone to the root: an eye, the head, and the bones of neck and trunk above the
/// hips that carry no legs.
fn chain(document: &Document, measurement: &Measurement) -> Option<Vec<usize>> {
    let skeleton = document.skeleton();
    let outward = [Role::Eyes, Role::LeftEye, Role::RightEye, Role::Head, Role::Neck];
    let skipped = if eyes_rest(document, measurement).is_some() { 3 } else { 0 };
    let Some(outermost) = outward.into_iter().skip(skipped).find_map(|role| measurement.with_role(role)) else {
        return machine(document, measurement);
    };
    let inward = skeleton.ancestry(outermost.node).skip(1).filter_map(|node| measurement.bone(node));
    let turns = |bone: &&BoneAxes| match bone.role {
        Some(Role::Head) => true,
        Some(Role::Neck | Role::Spine) => !bone.carries_legs,
        _ => false,
    };
    let mut chain = vec![outermost.node];
    chain.extend(inward.filter(turns).map(|bone| bone.node));
    let moves = skeleton.len() > 1;
    if chain.len() == 1 && moves {
        // A single bone on unnamed ones is a lamp or a camera on its stand. The chain includes what carries it, but no
        // body with limbs.
        let trunk = trunk_of(skeleton, chain[0]);
        let is_body =
            |node: &usize| Some(*node) == trunk || measurement.bone(*node).is_some_and(|bone| bone.carries_legs);
        chain = inward_of(document, measurement, chain[0]);
        chain.truncate(chain.iter().position(is_body).unwrap_or(chain.len()).max(1));
    }
    Some(chain)
}

/// Returns the chain of a pointing part and the bones that carry it.
fn machine(document: &Document, measurement: &Measurement) -> Option<Vec<usize>> {
    let pointer = measurement.evidence.iter().find_map(|item| match item.clue {
        Clue::Reach { node } => Some(node),
        _ => None,
    })?;
    Some(inward_of(document, measurement, pointer))
}

fn inward_of(document: &Document, measurement: &Measurement, node: usize) -> Vec<usize> {
    let inward = document.skeleton().ancestry(node).filter(|at| measurement.bone(*at).is_some());
    let mut chain: Vec<usize> = inward.take(MACHINE_JOINTS).collect();
    // A joint that turns without limits carries the rest: no joint further inward is needed.
    let turns = |at: &usize| measurement.bone(*at).is_some_and(|bone| name_has_word(bone, &YAW_WORDS));
    if let Some(last) = chain.iter().position(turns) {
        chain.truncate(last + 1);
    }
    chain
}

fn name_has_word(bone: &BoneAxes, words: &[&str]) -> bool {
    let name = bone.name.to_ascii_lowercase();
    name.split(|c: char| !c.is_alphabetic()).any(|word| words.contains(&word))
}

/// Returns the defaults of a joint that belongs to no region.
fn defaults_by_name(bone: &BoneAxes) -> &'static JointDefaults {
    match bone.role {
        Some(Role::LeftEye | Role::RightEye | Role::Eyes) => &EYE,
        Some(Role::Hips) => &HIPS,
        _ if name_has_word(bone, &YAW_WORDS) => &BASE,
        _ if name_has_word(bone, &PITCH_WORDS) => &BARREL,
        _ => &HINGE,
    }
}

fn budget_of(region: Region, budgets: &Budgets) -> &Budget {
    match region {
        Region::Head => &budgets.head,
        Region::Chest => &budgets.chest,
    }
}

/// Returns the defaults of a joint that makes `part` of its region's turn.
fn defaults_in_region(region: Region, part: f64, budgets: &Budgets) -> JointDefaults {
    let own = of_budget(budget_of(region, budgets), part);
    let degrees = |ends: [f64; 2]| Some(ends.map(f64::to_degrees));
    JointDefaults {
        heading: degrees(own.heading),
        pitch: degrees(own.pitch),
        rate: own.rate.to_degrees(),
        stiffness: (region.stiffness() / part * 1e2).round() / 1e2,
        why: "",
    }
}

/// Returns the reason for a joint that makes `part` of its region's turn.
fn reason_for_region(region: Region, part: f64, budgets: &Budgets) -> String {
    let whole = budget_of(region, budgets);
    let [percent, heading, down, up] =
        [part * 100.0, whole.heading[1].to_degrees(), whole.pitch[0].to_degrees(), whole.pitch[1].to_degrees()];
    let part = if part < 1.0 {
        format!("{percent:.0} % of the turn of {}", region.name())
    } else {
        "all of the turn of".to_owned() + " " + region.name()
    };
    format!(
        "{part}, which the rig's region limits to {heading:.0} degrees to either side, {:.0} down and {up:.0} up",
        -down
    )
}

/// Returns the eye on the other side.
fn other_eye<'m>(measurement: &'m Measurement, eye: &BoneAxes) -> Option<&'m BoneAxes> {
    let other = match eye.role? {
        Role::LeftEye => Role::RightEye,
        Role::RightEye => Role::LeftEye,
        _ => return None,
    };
    measurement.with_role(other)
}

/// Returns why a file's eyes, if it has any, are not aimed; `None` if they are.
fn eyes_rest(document: &Document, measurement: &Measurement) -> Option<&'static str> {
    let has = |role| measurement.with_role(role).is_some();
    let Some(look) = LookAt::of(document) else {
        return (![Role::LeftEye, Role::RightEye].into_iter().any(has) && document.names_morph_eyes())
            .then_some("the file names morph targets for the eyes, but its meshes have none, so the head leads");
    };
    let is_still = || !look.left_eye().iter().any(RangeMap::moves);
    match look.kind {
        LookAtKind::Expression if !has(Role::Eyes) => {
            Some("the file's eyes use expressions that move no morph targets, so the head leads")
        }
        LookAtKind::Bone if is_still() => Some("the file's lookAt keeps the eyes still, so the head leads"),
        _ => None,
    }
}

/// Returns an eye's ranges of heading and pitch, degrees, from its range maps (right, left, down, up): the range of a
/// human eye or the largest input of the map, whichever is less. `None` for an axis that the maps keep still.
fn mapped_range([right, left, down, up]: [RangeMap; 4]) -> Option<[Option<[f64; 2]>; 2]> {
    let end = |map: RangeMap, usual: f64| {
        // A map without an input range gives its full output at any angle.
        let input = if map.input_max_value >= 1.0 { map.input_max_value } else { usual.abs() };
        if map.moves() { input.min(usual.abs()).copysign(usual) } else { 0.0 }
    };
    let range = |[low, high]: [RangeMap; 2], usual: Option<[f64; 2]>| {
        let [lo, hi] = usual?;
        Some([end(low, lo), end(high, hi)]).filter(|[lo, hi]| lo < hi)
    };
    let ranges = [range([right, left], EYE.heading), range([down, up], EYE.pitch)];
    ranges.iter().any(Option::is_some).then_some(ranges)
}

fn effector(bone: &BoneAxes) -> EffectorSpec {
    EffectorSpec { frame: frame(bone), origin: [0.0; 3] }
}

/// Returns the signed axes if the bone's deviation is small, otherwise its exact directions.
fn frame(bone: &BoneAxes) -> Frame {
    let exact = [bone.frame.up, bone.frame.forward, bone.frame.left];
    let axes = [bone.up, bone.forward, bone.left].map(SignedAxis::vector);
    let [up, forward, left] = if bone.deviation_deg > CARDINAL_DEG { exact } else { axes };
    Frame { up: up.to_array(), forward: forward.to_array(), left: left.to_array() }
}

fn between([lo, hi]: [f64; 2]) -> AngleRange {
    AngleRange::Between(rounded_rad(lo), rounded_rad(hi))
}

/// Converts degrees to radians, rounded to thousandths of a degree. That is enough for shares of habits and for a
/// file's single precision, and it reads well.
fn rounded_rad(degrees: f64) -> f64 {
    ((degrees * 1e3).round() / 1e3).to_radians()
}

/// Returns the role of the joint for a bone: as measured, otherwise by the bone's name.
fn role(bone: &BoneAxes) -> Declared {
    match bone.role {
        Some(Role::LeftEye | Role::RightEye | Role::Eyes) => Declared::Eye,
        Some(Role::Head) => Declared::Head,
        Some(Role::Neck) => Declared::Neck,
        Some(Role::Spine) => Declared::Chest,
        Some(Role::Hips) => Declared::None,
        _ => BoneName::new(&bone.name).role().unwrap_or_default(),
    }
}

fn joint(name: String, role: Declared, defaults: &JointDefaults, bone: &BoneAxes) -> JointSpec {
    let range = |range: [f64; 2]| if range == FREE { AngleRange::Free } else { between(range) };
    JointSpec {
        name,
        role,
        bones: vec![bone.name.clone()],
        frame: frame(bone),
        pitch: defaults.pitch.map(range),
        heading: defaults.heading.map(range),
        // What a body can do depends on its build, not on the clip: count from the bind pose.
        limits_from: if role == Declared::None { LimitsFrom::Animation } else { LimitsFrom::BindPose },
        rate: rounded_rad(defaults.rate),
        acceleration: None,
        stiffness: defaults.stiffness,
        upright: None,
        pitch_taper: None,
        other_eye: None,
        hold: None,
    }
}

/// Returns the name of a joint's field: its role, numbered if several joints have that role, or a name derived from the
/// bone's.
fn field_name(bone: &BoneAxes, bones: &[&BoneAxes], at: usize) -> String {
    let Some(role) = bone.role else { return plain_name(&bone.name, at) };
    let alike: Vec<&BoneAxes> = bones.iter().copied().filter(|other| other.role == Some(role)).collect();
    if alike.len() == 1 {
        return role.to_string();
    }
    // Numbered as the bones are, or from the trunk outward if the bones' numbers are not distinct.
    let numbers: Vec<Option<u32>> = alike.iter().map(|bone| trailing_number(&bone.name)).collect();
    let are_distinct = (1..numbers.len()).all(|at| !numbers[..at].contains(&numbers[at]));
    let place = alike.iter().position(|other| other.node == bone.node).unwrap_or_default();
    match numbers[place] {
        None if are_distinct => role.to_string(),
        Some(number) if are_distinct => format!("{role}{number}"),
        _ => format!("{role}{}", alike.len() - place),
    }
}

/// Returns the number at the end of a name: 3 for `Spine03`.
fn trailing_number(name: &str) -> Option<u32> {
    name[name.trim_end_matches(|c: char| c.is_ascii_digit()).len()..].parse().ok()
}

fn plain_name(bone: &str, at: usize) -> String {
    let words = bone.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let words: Vec<String> = words.map(str::to_ascii_lowercase).collect();
    let name = words.join("_");
    // The number makes it unique and different from any keyword.
    if name.starts_with(|c: char| c.is_ascii_alphabetic()) { format!("{name}_{at}") } else { format!("joint_{at}") }
}
