//! Checks a declaration against a file: each joint's declared axes against those measured in the bind pose.

use aim_codegen::{Angles, Frame, JointSpec, RigSpec};
use aim_gltf::{Document, Skeleton};
use aim_runtime::glam::DVec3;

use crate::bake::chain::ChainNodes;
use crate::bake::live::JointFrame;
use crate::error::Error;
use crate::measure::roles::Role;
use crate::measure::{BoneAxes, Handedness, Measurement, SignedAxis};

/// Angle between a declared and a measured direction up to which the declaration is right, degrees.
pub const NEAR_DEG: f64 = 15.0;
/// Angle by which a declared direction may be further off than the nearest signed axis is, degrees. A direction is
/// right up to the larger of [`NEAR_DEG`] and the axis's deviation plus this angle.
const HARDLY_DEG: f64 = 5.0;
/// Distance of the effector from its joint, as a share of the character's height, above which its origin must be in
/// other units.
const FAR: f64 = 1.0;
/// Names of the three directions of a frame.
pub const NAMES: [&str; 3] = ["up", "forward", "left"];

/// A declared joint and the bone that was found for it.
#[derive(Clone, Debug)]
pub struct JointFit<'a> {
    /// Name of the joint in the declaration.
    pub joint: &'a str,
    /// Measurement of the bone.
    pub bone: &'a BoneAxes,
    /// Declared up, forward and left, in the bone's space.
    pub declared: [DVec3; 3],
    /// Measured up, forward and left, in the bone's space.
    pub measured: [DVec3; 3],
    /// For up, forward and left, whether the declared direction is wrong.
    pub wrong: [bool; 3],
}

/// Result of checking a declaration against a file.
///
/// ```
/// use aim_character::{Fit, Measurement, PAPER_AXES, mannequin, propose};
/// use aim_gltf::Document;
///
/// let document = Document::from_bytes(&mannequin(|_| PAPER_AXES)?)?;
/// let measurement = Measurement::of(&document);
/// let mut spec = propose(&document, &measurement, None)?.spec;
/// assert!(Fit::new(&spec, &document, &measurement).problems.is_empty());
/// spec.joints[1].bones = vec!["hat".into()];
/// assert!(!Fit::new(&spec, &document, &measurement).problems.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Fit<'a> {
    /// Joints whose bones were found, from the effector inward.
    pub joints: Vec<JointFit<'a>>,
    /// Problems found, one sentence each.
    pub problems: Vec<String>,
}

/// Returns the ranges of heading and pitch in one frame, as added angles in radians.
///
/// The range is empty (both ends 0) for an angle that is not declared, and infinite for a free one. It contains 0,
/// whatever the animation does.
#[must_use]
pub fn range_in_frame(joint: &JointSpec, at: &JointFrame) -> [[f64; 2]; 2] {
    let range = joint.range_of_motion(at.animated_angles.map(|[heading, pitch]| Angles { heading, pitch }));
    [range.heading.ends(), range.pitch_at(f64::from(at.heading)).ends()]
}

/// Finds the nodes of a file that correspond to the joints of a rig.
///
/// # Errors
/// Fails if the file lacks a declared bone, if the joints do not form a chain in it, or if a held bone does not descend
/// from its joint.
pub fn chain_nodes(spec: &RigSpec, skeleton: &Skeleton) -> Result<ChainNodes, Error> {
    let bones = spec.joints.iter().map(|joint| joint.bones.as_slice());
    let chain = ChainNodes::find(skeleton, bones, spec.joints[0].other_eye.as_deref())?;
    if spec.joints.iter().all(|joint| joint.hold.is_none()) {
        return Ok(chain);
    }
    let holds = spec.joints.iter().enumerate();
    let holds = holds.flat_map(|(at, joint)| joint.hold.iter().flatten().map(move |name| (at, name.as_str())));
    chain.with_holds(skeleton, holds)
}

/// Declares the named bones of a file, and no others, as [held](JointSpec::hold), each on the outermost joint that it
/// descends from.
///
/// # Errors
/// Fails if a name does not match exactly one node, if a node descends from no joint, or for the reasons of
/// [`chain_nodes`].
pub fn hold(spec: &mut RigSpec, skeleton: &Skeleton, names: &[String]) -> Result<(), Error> {
    spec.joints.iter_mut().for_each(|joint| joint.hold = Some(Vec::new()));
    let chain = chain_nodes(spec, skeleton)?;
    for name in names {
        let node = skeleton.find(name)?;
        let above: Vec<usize> = skeleton.ancestry(node).skip(1).collect();
        // A bone below no joint is assigned to the innermost one, for which the check below rejects it.
        let last = spec.joints.len() - 1;
        let joint = chain.joints.iter().position(|joint| above.contains(joint)).unwrap_or(last);
        spec.joints[joint].hold.get_or_insert_default().push(name.clone());
    }
    chain_nodes(spec, skeleton).map(|_| ())
}

impl<'a> Fit<'a> {
    /// Finds the bone of each declared joint and compares its axes.
    pub fn new(spec: &'a RigSpec, document: &'a Document, measurement: &'a Measurement) -> Self {
        let skeleton = document.skeleton();
        let mut fit = Self { joints: Vec::new(), problems: Vec::new() };
        for joint in &spec.joints {
            let found = joint.bones.iter().map(|name| skeleton.find(name)).reduce(Result::or);
            match found {
                Some(Ok(node)) => match measurement.bone(node) {
                    Some(bone) => fit.joints.push(JointFit::new(&joint.name, bone, &joint.frame)),
                    None => fit.problems.push(format!("{}: {:?} is not a bone", joint.name, skeleton.names()[node])),
                },
                Some(Err(error)) => fit.problems.push(format!("{}: {error}", joint.name)),
                None => {}
            }
        }
        for joint in &fit.joints {
            fit.problems.extend(joint.problems(measurement));
        }
        if fit.joints.len() == spec.joints.len() {
            if let Err(error) = chain_nodes(spec, skeleton) {
                fit.problems.push(error.to_string());
            }
            fit.problems.extend(effector(spec, &fit.joints[0], measurement));
        }
        fit
    }
}

impl<'a> JointFit<'a> {
    fn new(joint: &'a str, bone: &'a BoneAxes, frame: &Frame) -> Self {
        let declared = [frame.up, frame.forward, frame.left].map(DVec3::from_array);
        let measured = [bone.frame.up, bone.frame.forward, bone.frame.left];
        let mut fit = Self { joint, bone, declared, measured, wrong: [false; 3] };
        let allowed = |at: usize| NEAR_DEG.max(bone.deviations_deg[at] + HARDLY_DEG);
        fit.wrong = std::array::from_fn(|at| fit.off_deg(at) > allowed(at));
        fit
    }

    /// Returns the angle between the declared and the measured direction, degrees. `at` is an index into [`NAMES`].
    #[must_use]
    pub fn off_deg(&self, at: usize) -> f64 {
        degrees_between(self.declared[at], self.measured[at])
    }

    /// Returns the signed axis of the bone nearest to the measured direction. `at` is an index into [`NAMES`].
    #[must_use]
    pub fn nearest(&self, at: usize) -> SignedAxis {
        [self.bone.up, self.bone.forward, self.bone.left][at]
    }

    fn problems(&self, measurement: &Measurement) -> Vec<String> {
        let mut out: Vec<String> =
            (0..3).filter(|at| self.wrong[*at]).map(|at| self.sentence(at, measurement)).collect();
        let is_mirrored = self.declared[0].cross(self.declared[1]).dot(self.declared[2]) < 0.0;
        if is_mirrored != (self.bone.handedness == Handedness::Left) {
            let (bone, declared) =
                if is_mirrored { ("not mirrored", "mirrored") } else { ("mirrored", "not mirrored") };
            out.push(format!(
                "{}: {:?} is {bone} in the file but declared {declared}; set mirrored = {}, or the rig's handedness",
                self.joint, self.bone.name, !is_mirrored
            ));
        }
        let other = match self.bone.role {
            Some(Role::LeftEye) => "right",
            Some(Role::RightEye) => "left",
            _ => return out,
        };
        if self.joint.split('_').any(|word| word == other) {
            out.push(format!("{}: {:?} is the eye on the other side", self.joint, self.bone.name));
        }
        out
    }

    /// Returns a sentence such as
    /// `neck: declared forward +Z points down in the bind pose; measured forward is +Y (9° off)`.
    fn sentence(&self, at: usize, measurement: &Measurement) -> String {
        let name = NAMES[at];
        format!(
            "{}: declared {name} {} points {} in the bind pose; measured {name} is {} ({:.0}° off)",
            self.joint,
            crate::measure::evidence::direction(self.declared[at]),
            points(self.bone.bind_world.transform_vector3(self.declared[at]), measurement),
            self.nearest(at),
            self.bone.deviations_deg[at]
        )
    }
}

fn effector(spec: &RigSpec, joint: &JointFit<'_>, measurement: &Measurement) -> Vec<String> {
    let mut out = Vec::new();
    let forward = DVec3::from_array(spec.effector.frame.forward);
    let off = degrees_between(forward, joint.measured[1]);
    if forward.distance(joint.declared[1]) > 1e-6 && off > NEAR_DEG.max(joint.bone.deviations_deg[1] + HARDLY_DEG) {
        out.push(format!(
            "effector: forward {} points {} in the bind pose; the character's forward is {} there ({:.0}° off)",
            crate::measure::evidence::direction(forward),
            points(joint.bone.bind_world.transform_vector3(forward), measurement),
            joint.nearest(1),
            joint.bone.deviations_deg[1]
        ));
    }
    let away = joint.bone.bind_world.transform_vector3(DVec3::from_array(spec.effector.origin)).length();
    if measurement.height > 0.0 && away > FAR * measurement.height {
        out.push(format!(
            "effector: its origin is {:.1} character heights away from {:?}; give it in the units of that bone",
            away / measurement.height,
            joint.bone.name
        ));
    }
    out
}

/// Returns the name of the character's direction that is nearest to a world-space direction.
fn points(direction: DVec3, measurement: &Measurement) -> &'static str {
    let Measurement { up, forward, left, .. } = measurement;
    let ways =
        [("up", *up), ("down", -*up), ("forward", *forward), ("back", -*forward), ("left", *left), ("right", -*left)];
    let nearest = ways.into_iter().max_by(|a, b| a.1.dot(direction).total_cmp(&b.1.dot(direction)));
    nearest.map_or("nowhere", |(name, _)| name)
}

fn degrees_between(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}
