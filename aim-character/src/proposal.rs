//! A rig proposed for a file: the chain from the effector to the root, each bone's measured axes, and what a joint of
//! its part does in people. `aim rig` writes it down, `aim bake` without a rig aims with it.

use aim_codegen::{AngleRange, EffectorSpec, Frame, JointSpec, LimitsFrom, RigSpec};
use aim_gltf::{BoneAxes, ChainNodes, Clue, Document, LookAt, Measurement, Role, limbs_on_each};
use aim_model::BoneName;

use crate::error::Error;

/// Up to this deviation, degrees, a bone's nearest signed axes are its axes; beyond, its exact frame is.
const CARDINAL_DEG: f64 = 3.0;
/// Necks of so many bones are those of animals, and all of them bend; of shorter ones the bone next to the head does.
const LONG_NECK: usize = 3;
/// Joints that a machine's chain has at most.
const MACHINE_JOINTS: usize = 4;

/// A proposed rig with a word on each joint.
#[derive(Clone, Debug)]
pub struct Proposal {
    /// The rig: its chain from the effector inward, with measured axes and habitual ranges and rates.
    pub spec: RigSpec,
    /// Why each joint is as it is, one line a joint; empty where there is nothing to say.
    pub reasons: Vec<String>,
}

impl Proposal {
    /// Why a joint is as it is, where there is something to say.
    pub(crate) fn reason(&self, joint: usize) -> Option<&str> {
        self.reasons.get(joint).map(String::as_str).filter(|why| !why.is_empty())
    }
}

/// What a joint of some part does, degrees and degrees a second.
struct Habit {
    heading: Option<[f64; 2]>,
    pitch: Option<[f64; 2]>,
    rate: f64,
    stiffness: f64,
    why: &'static str,
}

/// Without end.
const FREE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

const EYE: Habit = Habit {
    heading: Some([-35.0, 35.0]),
    pitch: Some([-25.0, 20.0]),
    rate: 450.0,
    stiffness: 0.5,
    why: "eyes can turn by about 50 degrees but seldom pass 35; saccades peak at 400 to 700 deg/s",
};
const NECK: Habit = Habit {
    heading: Some([-60.0, 60.0]),
    pitch: Some([-40.0, 35.0]),
    rate: 170.0,
    stiffness: 1.0,
    why: "cervical spines turn by 70 to 80 degrees and bend by 45 to 60; heads follow a gaze at 100 to 300 deg/s",
};
const SPINE: Habit = Habit {
    heading: Some([-20.0, 20.0]),
    pitch: Some([-10.0, 10.0]),
    rate: 70.0,
    stiffness: 4.0,
    why: "thoracic spines turn by about 35 degrees in all; the trunk is the last to move and the slowest",
};
const BASE: Habit = Habit {
    heading: Some(FREE),
    pitch: None,
    rate: 120.0,
    stiffness: 1.0,
    why: "its name says that it turns about the upright axis",
};
const BARREL: Habit = Habit {
    heading: None,
    pitch: Some([-10.0, 80.0]),
    rate: 90.0,
    stiffness: 1.0,
    why: "its name says that it is raised and lowered",
};
const HINGE: Habit = Habit {
    heading: Some([-45.0, 45.0]),
    pitch: Some([-45.0, 45.0]),
    rate: 90.0,
    stiffness: 2.0,
    why: "nothing tells what it can do: give its own ranges and rate",
};
const TURNING: [&str; 6] = ["base", "yaw", "pan", "swivel", "turret", "turntable"];
const RAISING: [&str; 7] = ["pitch", "tilt", "elevation", "barrel", "gun", "cannon", "muzzle"];

/// The rig of these nodes (from the effector inward), or of the chain that the file's roles and names tell.
///
/// # Errors
/// A file without an eye, a head, a neck or anything that points; named nodes that are no chain; bones whose names are
/// not unique.
pub fn propose(document: &Document, measurement: &Measurement, named: Option<&[String]>) -> Result<Proposal, Error> {
    let skeleton = document.skeleton();
    let nodes = match named {
        Some(names) => {
            let bones: Vec<Vec<String>> = names.iter().map(|name| vec![name.clone()]).collect();
            ChainNodes::find(skeleton, bones.iter().map(Vec::as_slice), None)?.joints
        }
        None => chain(document, measurement).ok_or(Error::NoChain)?,
    };
    let listed = |&node: &usize| {
        measurement.bone(node).ok_or_else(|| Error::NoBone { node: skeleton.nodes()[node].name.clone() })
    };
    let bones: Vec<&BoneAxes> = nodes.iter().map(listed).collect::<Result<_, _>>()?;
    let necks = bones.iter().filter(|bone| bone.role == Some(Role::Neck)).count();
    // However long the neck, a joint's range is one that can be declared: a degree or more to some side.
    let share = if necks >= LONG_NECK { (1.5 / (necks as f64)).max(0.025) } else { 1.0 };
    let mut proposal = Proposal {
        spec: RigSpec {
            name: "Measured".into(),
            joints: Vec::new(),
            effector: effector(bones[0]),
            natural: None,
            region: None,
            kernels: Vec::new(),
        },
        reasons: Vec::new(),
    };
    let of_neck = bones.iter().filter(|bone| matches!(bone.role, Some(Role::Head | Role::Neck)));
    let limbs = limbs_on_each(skeleton, of_neck.map(|bone| bone.node));
    for (at, bone) in bones.iter().enumerate() {
        // Only names that mean one node can be declared.
        skeleton.find(&bone.name)?;
        let habit = habit(bone);
        let name = field_name(bone, &bones, at);
        let mut joint = joint(name, habit, bone, if bone.role == Some(Role::Neck) { share } else { 1.0 });
        let mut why = habit.why.to_owned();
        if at == 0 {
            joint.other_eye = other_eye(measurement, bone).map(|eye| eye.name.clone());
            if let Some(range) = bone.role.and_then(|role| vrm_range(document, role)) {
                [joint.heading, joint.pitch] = range.map(|ends| Some(between(ends)));
                why = "the range maps of the file's lookAt".into();
            }
        }
        if let Some((_, limbs)) = limbs.iter().find(|(node, _)| *node == bone.node) {
            let names: Vec<String> = limbs.iter().map(|&limb| skeleton.nodes()[limb].name.clone()).collect();
            why += &format!("; {} hang on it and are held on the trunk", names.join(", "));
            joint.hold = Some(names);
        }
        if bone.deviation_deg > CARDINAL_DEG {
            why += &format!(
                "; {} {} {} are {:.0} degrees off, hence the exact frame",
                bone.up, bone.forward, bone.left, bone.deviation_deg
            );
        }
        proposal.spec.joints.push(joint);
        proposal.reasons.push(why);
    }
    // Only names that mean one node can be declared. Without any the arms are found where they are held.
    let is_unclear = |limb: &usize| skeleton.find(&skeleton.nodes()[*limb].name).is_err();
    if limbs.iter().flat_map(|(_, limbs)| limbs).any(is_unclear) {
        proposal.spec.joints.iter_mut().for_each(|joint| joint.hold = None);
    }
    Ok(proposal)
}

/// From the outermost bone to the root: an eye, the neck, the first of the spine; without an eye the head, and with a
/// long neck all of it.
fn chain(document: &Document, measurement: &Measurement) -> Option<Vec<usize>> {
    let skeleton = document.skeleton();
    let first = |role: Role| measurement.with_role(role);
    let eye = first(Role::LeftEye).or_else(|| first(Role::RightEye));
    let Some(outermost) = eye.or_else(|| first(Role::Head)).or_else(|| first(Role::Neck)) else {
        return machine(document, measurement);
    };
    let inward: Vec<&BoneAxes> =
        skeleton.ancestry(outermost.node).skip(1).filter_map(|node| measurement.bone(node)).collect();
    let of = |role: Role| inward.iter().filter(move |bone| bone.role == Some(role)).map(|bone| bone.node);
    let necks: Vec<usize> = of(Role::Neck).collect();
    let mut chain = vec![outermost.node];
    if necks.len() >= LONG_NECK || (eye.is_some() && necks.is_empty()) {
        chain.extend(of(Role::Head));
    }
    chain.extend(if necks.len() >= LONG_NECK { &necks[..] } else { &necks[..necks.len().min(1)] });
    chain.extend(of(Role::Spine).next());
    let moves = skeleton.nodes().len() > 1;
    // A head alone on what nobody named: a lamp, a camera on its stand.
    if chain.len() == 1 && moves { Some(inward_of(document, measurement, chain[0])) } else { Some(chain) }
}

/// What points by its shape, and what it stands on.
fn machine(document: &Document, measurement: &Measurement) -> Option<Vec<usize>> {
    let pointer = measurement.evidence.iter().find_map(|said| match said.clue {
        Clue::Reach { node } => Some(node),
        _ => None,
    })?;
    Some(inward_of(document, measurement, pointer))
}

fn inward_of(document: &Document, measurement: &Measurement, node: usize) -> Vec<usize> {
    let inward = document.skeleton().ancestry(node).filter(|at| measurement.bone(*at).is_some());
    let mut chain: Vec<usize> = inward.take(MACHINE_JOINTS).collect();
    // What is turned without end carries the rest: nothing inward of it is needed.
    let turns = |at: &usize| measurement.bone(*at).is_some_and(|bone| says(bone, &TURNING));
    if let Some(last) = chain.iter().position(turns) {
        chain.truncate(last + 1);
    }
    chain
}

fn says(bone: &BoneAxes, words: &[&str]) -> bool {
    let name = bone.name.to_lowercase();
    name.split(|c: char| !c.is_alphabetic()).any(|word| words.contains(&word))
}

fn habit(bone: &BoneAxes) -> &'static Habit {
    match bone.role {
        Some(Role::LeftEye | Role::RightEye) => &EYE,
        Some(Role::Head | Role::Neck) => &NECK,
        Some(Role::Spine | Role::Hips) => &SPINE,
        _ if says(bone, &TURNING) => &BASE,
        _ if says(bone, &RAISING) => &BARREL,
        _ => &HINGE,
    }
}

/// The other eye.
fn other_eye<'m>(measurement: &'m Measurement, eye: &BoneAxes) -> Option<&'m BoneAxes> {
    let other = match eye.role? {
        Role::LeftEye => Role::RightEye,
        Role::RightEye => Role::LeftEye,
        _ => return None,
    };
    measurement.with_role(other)
}

/// An eye's heading and pitch in degrees by the file's VRM range maps.
fn vrm_range(document: &Document, role: Role) -> Option<[[f64; 2]; 2]> {
    let [right, left, down, up] = LookAt::of(document)?.left_eye_range()?;
    let heading = match role {
        Role::LeftEye => [-right, left],
        Role::RightEye => [-left, right],
        _ => return None,
    };
    // A map may hold an eye still in one direction, not in all (less than a degree is none); beyond a half turn it means nothing.
    let usable = |[lo, hi]: [f64; 2]| lo < hi && lo >= -90.0 && hi <= 90.0 && (lo <= -1.0 || hi >= 1.0);
    (usable(heading) && usable([-down, up])).then_some([heading, [-down, up]])
}

fn effector(bone: &BoneAxes) -> EffectorSpec {
    EffectorSpec { frame: frame(bone), origin: [0.0; 3] }
}

/// The signed axes where they are right, else the exact directions.
fn frame(bone: &BoneAxes) -> Frame {
    let exact = [bone.frame.up, bone.frame.forward, bone.frame.left];
    let axes = [bone.up, bone.forward, bone.left].map(aim_gltf::SignedAxis::vector);
    let [up, forward, left] = if bone.deviation_deg > CARDINAL_DEG { exact } else { axes };
    Frame { up: up.to_array(), forward: forward.to_array(), left: left.to_array() }
}

fn between([lo, hi]: [f64; 2]) -> AngleRange {
    // A share of a habit, or a file's single precision: thousandths of a degree are enough, and read well.
    let rounded = |degrees: f64| ((degrees * 1e3).round() / 1e3).to_radians();
    AngleRange::Between(rounded(lo), rounded(hi))
}

/// The role of the joint that a bone becomes: as measured, else as its name tells.
fn role(bone: &BoneAxes) -> aim_model::Role {
    use aim_model::Role as Declared;
    match bone.role {
        Some(Role::LeftEye | Role::RightEye) => Declared::Eye,
        Some(Role::Head) => Declared::Head,
        Some(Role::Neck) => Declared::Neck,
        Some(Role::Spine) => Declared::Chest,
        Some(Role::Hips) => Declared::None,
        _ => BoneName::new(&bone.name).role().unwrap_or_default(),
    }
}

fn joint(name: String, habit: &Habit, bone: &BoneAxes, share: f64) -> JointSpec {
    let range = |range: [f64; 2]| if range == FREE { AngleRange::Free } else { between(range.map(|end| end * share)) };
    JointSpec {
        name,
        role: role(bone),
        bones: vec![bone.name.clone()],
        frame: frame(bone),
        pitch: habit.pitch.map(range),
        heading: habit.heading.map(range),
        limits_from: LimitsFrom::Animation,
        rate: habit.rate.to_radians(),
        acceleration: None,
        stiffness: habit.stiffness,
        upright: None,
        pitch_taper: None,
        other_eye: None,
        hold: None,
    }
}

/// A field's name: the role's, numbered where several joints have it, or what the bone's own name leaves.
fn field_name(bone: &BoneAxes, bones: &[&BoneAxes], at: usize) -> String {
    let Some(role) = bone.role else { return plain_name(&bone.name, at) };
    let alike: Vec<usize> = (0..bones.len()).filter(|other| bones[*other].role == Some(role)).collect();
    match alike.iter().position(|other| *other == at) {
        // Numbered from the trunk outward, as bones are.
        Some(place) if alike.len() > 1 => format!("{role}{}", alike.len() - place),
        _ => role.to_string(),
    }
}

fn plain_name(bone: &str, at: usize) -> String {
    let words = bone.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let words: Vec<String> = words.map(str::to_lowercase).collect();
    let name = words.join("_");
    // Numbered, it is no keyword of any language, and no other joint's name.
    if name.starts_with(|c: char| c.is_ascii_alphabetic()) { format!("{name}_{at}") } else { format!("joint_{at}") }
}
