//! The geometry that objectives are stated over: joints from the effector inward, each with a link and an added
//! rotation.

use aim_symbolic::{Angle, Graph, Plane, Rigid, Rotation, Vector};

use crate::{EffectorSpec, Frame, JointSpec, RigSpec};

/// Plane of heading, in the axes forward, left, up: turns forward towards left.
pub const HEADING: Plane = Plane { from: 0, towards: 1 };
/// Plane of pitch, in the axes forward, left, up: turns forward towards up.
pub const PITCH: Plane = Plane { from: 0, towards: 2 };

/// Inputs of a kernel, in the order in which emitted functions take them.
#[derive(Clone, Debug)]
pub struct Inputs {
    /// Transforms: from effector space to the first joint's space before its added rotation, then from each joint to
    /// the next.
    pub links: Vec<Rigid>,
    /// Target, in the last joint's space.
    pub target: Vector,
    /// Pitch and heading of each joint.
    pub angles: Vec<(Angle, Angle)>,
}

impl Inputs {
    /// Declares the inputs of one joint in `g`: link, target, sin p, cos p, sin h, cos h.
    pub fn of_joint(g: &mut Graph) -> Self {
        Self {
            links: vec![g.rigid_input("m")],
            target: g.vector_input("target"),
            angles: vec![(g.angle("p"), g.angle("h"))],
        }
    }

    /// Declares the inputs of a chain in `g`: links, target, then sin p, cos p, sin h, cos h of each joint.
    pub fn of_chain(g: &mut Graph, joints: usize) -> Self {
        Self {
            links: (0..joints).map(|i| g.rigid_input(&format!("l{i}"))).collect(),
            target: g.vector_input("target"),
            angles: (0..joints).map(|i| (g.angle(&format!("p{i}")), g.angle(&format!("h{i}")))).collect(),
        }
    }
}

/// Knowledge about the link from effector space to the first joint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FirstLink {
    /// An input like the other links.
    #[default]
    Given,
    /// Known to be the identity. The input is kept, so that the others keep their indices, but never read.
    Identity,
}

impl FirstLink {
    /// Returns what the runtime guarantees about a rig's first link. It leads from the effector to the animated joint 0
    /// and is the identity if the effector has no origin of its own and joint 0's heading is not turned upright.
    #[must_use]
    pub fn of(spec: &RigSpec) -> Self {
        let is_upright = |joint: &JointSpec| joint.upright.map_or(joint.role.is_upright(), |upright| upright > 0.0);
        let is_upright = spec.joints.first().is_some_and(is_upright);
        if is_upright || spec.effector.origin != [0.0; 3] { Self::Given } else { Self::Identity }
    }
}

/// The joints that an objective is stated over, from the effector inward, and their inputs.
#[derive(Clone, Debug)]
pub struct Chain<'a> {
    /// The effector.
    pub effector: &'a EffectorSpec,
    /// The joints, one for each link.
    pub joints: &'a [JointSpec],
    /// Knowledge about the first link.
    pub first_link: FirstLink,
    /// The kernel's inputs.
    pub inputs: Inputs,
}

impl Chain<'_> {
    /// Returns the effector in the last joint's space.
    pub fn effector_at_end(&self, g: &mut Graph) -> Effector {
        let to_end = self.effector_to_end(g);
        let zero = g.constant_vector([0.0; 3]);
        Effector { to_end, origin: g.transform_point(to_end, zero) }
    }

    /// Composes all links and added rotations, from effector space to the last joint's space.
    fn effector_to_end(&self, g: &mut Graph) -> Rigid {
        let mut to_end: Option<Rigid> = None;
        let joints = self.joints.iter().zip(&self.inputs.links).zip(&self.inputs.angles);
        for (place, ((joint, &link), &(pitch, heading))) in joints.enumerate() {
            let to_joint = match to_end {
                Some(inner) => Some(g.compose_rigid(link, inner)),
                None => (place > 0 || self.first_link == FirstLink::Given).then_some(link),
            };
            let rotation = added_rotation(g, joint, pitch, heading);
            let rotation = g.about_origin(rotation);
            to_end = Some(match to_joint {
                Some(to_joint) => g.compose_rigid(rotation, to_joint),
                None => rotation,
            });
        }
        to_end.unwrap_or_else(|| {
            let nothing = g.basis([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
            g.about_origin(nothing)
        })
    }
}

/// The effector in the space of a chain's last joint.
#[derive(Clone, Copy, Debug)]
pub struct Effector {
    to_end: Rigid,
    /// Origin of the effector.
    pub origin: Vector,
}

impl Effector {
    /// Transforms `direction` from effector space, as a difference of two points: the paper's P₁ − P₀.
    pub fn direction(&self, g: &mut Graph, direction: [f64; 3]) -> Vector {
        let tip = g.constant_vector(direction);
        let tip = g.transform_point(self.to_end, tip);
        g.sub_vectors(tip, self.origin)
    }
}

/// Returns the joint's added rotation: pitch first, then heading, both about the joint's own axes.
///
/// In the axes forward, left, up, heading turns the first towards the second, and pitch the first towards the third.
/// The bone's convention and handedness only enter through the change of basis.
fn added_rotation(g: &mut Graph, joint: &JointSpec, pitch: Angle, heading: Angle) -> Rotation {
    let Frame { up, forward, left } = joint.frame;
    let to_bone = g.basis([forward, left, up]);
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
