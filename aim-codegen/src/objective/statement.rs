//! The inputs that objectives are stated in, in the order in which the emitted functions take them.

use aim_symbolic::{Angle, Graph, Plane, Rigid, Rotation, Vector};

use crate::{Frame, JointSpec, RigSpec};

/// The plane of heading, in the axes forward, left, up: forward turns towards left.
pub const HEADING: Plane = Plane { from: 0, towards: 1 };
/// The plane of pitch, in the same axes: forward turns towards up.
pub const PITCH: Plane = Plane { from: 0, towards: 2 };

/// The inputs of one joint's function.
#[derive(Clone, Copy, Debug)]
pub struct JointInputs {
    /// From effector space to the joint's space before its added rotation.
    pub effector_to_joint: Rigid,
    /// The target, in the joint's space.
    pub target: Vector,
    /// The joint's pitch.
    pub pitch: Angle,
    /// The joint's heading.
    pub heading: Angle,
}

impl JointInputs {
    /// Declares them in `g`: `effector_to_joint`, target, sin p, cos p, sin h, cos h.
    pub fn declare(g: &mut Graph) -> Self {
        Self {
            effector_to_joint: g.rigid_input("m"),
            target: g.vector_input("target"),
            pitch: g.angle("p"),
            heading: g.angle("h"),
        }
    }
}

/// The inputs of a chain's functions.
#[derive(Clone, Debug)]
pub struct ChainInputs {
    /// From effector space to joint 0, then from joint i−1 to joint i.
    pub links: Vec<Rigid>,
    /// The target, in the last joint's space.
    pub target: Vector,
    /// Each joint's pitch and heading.
    pub angles: Vec<(Angle, Angle)>,
}

impl ChainInputs {
    /// Declares them in `g`: links, target, then sin p, cos p, sin h, cos h of each joint.
    pub fn declare(g: &mut Graph, joints: usize) -> Self {
        Self {
            links: (0..joints).map(|i| g.rigid_input(&format!("l{i}"))).collect(),
            target: g.vector_input("target"),
            angles: (0..joints).map(|i| (g.angle(&format!("p{i}")), g.angle(&format!("h{i}")))).collect(),
        }
    }

    /// The angles that the rig declares, pitch before heading, joint by joint.
    pub fn declared_angles(&self, spec: &RigSpec) -> Vec<Angle> {
        let declared = spec.joints.iter().zip(&self.angles).flat_map(|(joint, &(pitch, heading))| {
            [joint.pitch.is_some().then_some(pitch), joint.heading.is_some().then_some(heading)]
        });
        declared.flatten().collect()
    }
}

/// The joint's added rotation: pitch first, then heading, both in the joint's own axes.
///
/// In the axes forward, left, up, heading turns the first towards the second and pitch the first towards the third,
/// whatever the bone's convention and handedness: those are in the change of basis alone.
fn added_rotation(g: &mut Graph, joint: &JointSpec, pitch: Angle, heading: Angle) -> Rotation {
    let to_bone = basis(g, &joint.frame);
    let mut rotation = g.transpose(to_bone);
    if joint.pitch.is_some() {
        let turn = g.turn(PITCH, pitch);
        rotation = g.compose(turn, rotation);
    }
    if joint.heading.is_some() {
        let turn = g.turn(HEADING, heading);
        rotation = g.compose(turn, rotation);
    }
    g.compose(to_bone, rotation)
}

fn basis(g: &mut Graph, frame: &Frame) -> Rotation {
    g.basis([frame.forward, frame.left, frame.up])
}

/// The place and the image of a direction of the effector at the end of a chain.
pub(super) struct Effector {
    to_end: Rigid,
    /// The effector's origin.
    pub(super) origin: Vector,
}

impl Effector {
    /// The effector seen from the space that `to_end` leads to.
    pub(super) fn at(g: &mut Graph, to_end: Rigid) -> Self {
        let zero = g.constant_vector([0.0; 3]);
        Self { to_end, origin: g.transform_point(to_end, zero) }
    }

    /// `direction` of effector space as a difference of two points: the paper's P₁ − P₀.
    pub(super) fn direction(&self, g: &mut Graph, direction: [f64; 3]) -> Vector {
        let tip = g.constant_vector(direction);
        let tip = g.transform_point(self.to_end, tip);
        g.sub_vectors(tip, self.origin)
    }
}

/// From effector space through all links and added rotations to the last joint's space.
pub(super) fn effector_to_end(g: &mut Graph, spec: &RigSpec, inputs: &ChainInputs) -> Rigid {
    let mut to_end: Option<Rigid> = None;
    for ((joint, &link), &(pitch, heading)) in spec.joints.iter().zip(&inputs.links).zip(&inputs.angles) {
        let to_joint = match to_end {
            Some(inner) => g.compose_rigid(link, inner),
            None => link,
        };
        to_end = Some(turned(g, joint, to_joint, pitch, heading));
    }
    to_end.unwrap_or_else(|| {
        let nothing = g.basis([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        g.about_origin(nothing)
    })
}

/// `to_joint`, then the joint's added rotation.
pub(super) fn turned(g: &mut Graph, joint: &JointSpec, to_joint: Rigid, pitch: Angle, heading: Angle) -> Rigid {
    let rotation = added_rotation(g, joint, pitch, heading);
    let rotation = g.about_origin(rotation);
    g.compose_rigid(rotation, to_joint)
}
