//! [`NumericRig`]: a rig of any joints that needs no compilation, for random rigs by the hundred thousand.
//!
//! Its kernels compute the derivatives geometrically, from rotations about pivots; they are not derived. The derived
//! kernels of compiled rigs have tests of their own.

use aim::glam::{Affine3A, Mat3A, Vec3A};
use aim::{Description, Effector, JointInfo, Rig, Scalar};

/// A rig with geometric kernels.
#[derive(Clone, Debug)]
pub struct NumericRig {
    /// Declaration of each joint, from the effector inward.
    pub infos: Vec<JointInfo>,
    /// The effector, in the space of the first joint.
    pub effector: Effector,
}

impl NumericRig {
    /// Creates a rig of these joints that aims the first joint's forward.
    pub fn new(infos: &[JointInfo]) -> Self {
        let effector = Effector { forward: infos[0].axes().forward, origin: [0.0; 3] };
        Self { infos: infos.to_vec(), effector }
    }

    /// Creates a rig with the declaration of another.
    pub fn like(rig: &dyn Rig) -> Self {
        let description = rig.description();
        Self { effector: *description.effector(), ..Self::new(description.joints()) }
    }
}

/// One declared angle's rotation: its plane and its pivot in the last joint's space.
struct Turn {
    from: Vec3A,
    towards: Vec3A,
    pivot: Vec3A,
}

impl Turn {
    /// Returns the derivative by the angle of `axis · p`, where `p` is a carried point at `arm` from the pivot.
    fn lever(&self, axis: Vec3A, arm: Vec3A) -> f32 {
        axis.dot(self.towards) * self.from.dot(arm) - axis.dot(self.from) * self.towards.dot(arm)
    }
}

/// The chain in the space of its last joint.
struct Carried {
    /// Transform from effector space.
    frame: Affine3A,
    /// Rotations of the declared angles, in order.
    turns: Vec<Turn>,
}

impl Carried {
    fn new(infos: &[JointInfo], links: &[[f32; 12]], sin_cos: &[[f32; 4]]) -> Self {
        let mut carried = Self { frame: Affine3A::IDENTITY, turns: Vec::with_capacity(2 * infos.len()) };
        // Compose from the last joint outward.
        for ((info, link), &[sin_p, cos_p, sin_h, cos_h]) in infos.iter().zip(links).zip(sin_cos).rev() {
            let axes = info.axes();
            if info.heading.is_some() {
                carried.turn(axes.forward.into(), axes.left.into(), sin_h, cos_h);
            }
            if info.pitch.is_some() {
                carried.turn(axes.forward.into(), axes.up.into(), sin_p, cos_p);
            }
            carried.frame *= Affine3A::from_cols_array(link);
        }
        carried.turns.reverse();
        carried
    }

    fn turn(&mut self, from: Vec3A, towards: Vec3A, sin: f32, cos: f32) {
        let Affine3A { matrix3, translation: pivot } = self.frame;
        self.turns.push(Turn { from: matrix3 * from, towards: matrix3 * towards, pivot });
        let plane = Mat3A::from_cols(from, towards, from.cross(towards));
        let turned = Mat3A::from_cols(Vec3A::new(cos, sin, 0.0), Vec3A::new(-sin, cos, 0.0), Vec3A::Z);
        self.frame.matrix3 *= plane * turned * plane.transpose();
    }

    /// Computes the aim, then its derivatives.
    fn aim(&self, forward: [f32; 3], target: Vec3A, out: &mut [f32]) {
        let forward = self.frame.matrix3 * Vec3A::from(forward);
        let to_target = target - self.frame.translation;
        let inverse = reciprocal(to_target.length(), f32::TINY);
        let unit = to_target * inverse;
        let aim = unit.dot(forward);
        let across = (forward - aim * unit) * inverse;
        out[0] = aim;
        for (out, turn) in out[1..].iter_mut().zip(&self.turns) {
            // Two terms: the rotation of the direction, and the movement of the origin.
            *out = turn.lever(unit, forward) - turn.lever(across, self.frame.translation - turn.pivot);
        }
    }

    /// Computes the stereographic residual along two axes, then its derivatives.
    fn residual(&self, axes: [Vec3A; 3], target: Vec3A, out: &mut [f32]) {
        let [forward, left, up] = axes.map(|axis| self.frame.matrix3 * axis);
        let to_target = target - self.frame.translation;
        let length = to_target.length();
        let inverse = reciprocal(length + to_target.dot(forward), 1e-6 * length + f32::TINY);
        let per_length = reciprocal(length, f32::TINY);
        for (k, axis) in [left, up].into_iter().enumerate() {
            let lateral = to_target.dot(axis);
            out[k] = 2.0 * lateral * inverse;
            for (i, turn) in self.turns.iter().enumerate() {
                // In effector space, the target rotates in the opposite sense about the same pivot.
                let arm = target - turn.pivot;
                let d_lateral = -turn.lever(axis, arm);
                let d_length = -turn.lever(to_target, self.frame.translation - turn.pivot) * per_length;
                let d_below = d_length - turn.lever(forward, arm);
                out[2 + k * self.turns.len() + i] = 2.0 * inverse * (d_lateral - lateral * inverse * d_below);
            }
        }
    }
}

/// Returns 1 / `x`, or 0 if `x` is not above `least`.
fn reciprocal(x: f32, least: f32) -> f32 {
    if least < x { x.recip() } else { 0.0 }
}

impl Rig for NumericRig {
    fn description(&self) -> Description<'_> {
        Description::new(&self.infos).with_effector(self.effector)
    }

    fn joint_name(&self, _: usize) -> Option<&str> {
        None
    }

    fn bone_name(&self, _: usize, _: usize) -> Option<&str> {
        None
    }

    fn residual_jacobian(&self, links: &[[f32; 12]], target: &[f32; 3], sin_cos: &[[f32; 4]], out: &mut [f32]) {
        // The effector's forward and two directions perpendicular to it, near the first joint's up and left.
        let (axes, forward) = (self.infos[0].axes(), Vec3A::from(self.effector.forward));
        let up = Vec3A::from(axes.up).reject_from_normalized(forward).normalize();
        let left = Vec3A::from(axes.left).reject_from_normalized(forward).reject_from_normalized(up).normalize();
        Carried::new(&self.infos, links, sin_cos).residual([forward, left, up], (*target).into(), out);
    }

    fn aim_gradient(
        &self,
        joint: usize,
        effector_to_joint: &[f32; 12],
        target: &[f32; 3],
        sin_cos: &[f32; 4],
    ) -> [f32; 3] {
        let mut out = [0.0; 3];
        if let Some(info) = self.infos.get(joint) {
            let carried = Carried::new(&[*info], &[*effector_to_joint], &[*sin_cos]);
            carried.aim(self.effector.forward, (*target).into(), &mut out);
            if info.pitch.is_none() {
                out.swap(1, 2);
            }
        }
        out
    }
}
