//! `Limb`: a chain of bones whose tip is brought to a point by inverse kinematics.
//!
//! Used by [`Reach`](crate::Reach), which leads the tip along a trajectory, by [`LimbLayer`](crate::LimbLayer), which
//! brings it to a point, and by [`Plant`](crate::Plant), which keeps a foot on the ground.

use alloc::vec::Vec;
use core::fmt;

use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim_runtime::ik::{self, Ccd, CcdJoint, CcdLimit, TwoBone};
use aim_runtime::rotation::{length, nearest_orthogonal, product, slerp, unit};

use crate::pose::{PoseError, PosePair, check_length};
use crate::skeleton::Skeleton;
use crate::transform::made_unit;

/// Upper limit of solver rounds for a limb in one frame. More than one is needed only if non-uniform scales shear the
/// joints' rotations.
const MOST_ROUNDS: usize = 8;
/// Largest difference between the solver's tip error and the actual one that needs no further round, as a fraction of
/// the limb's length.
const NEAR: f32 = 1e-6;

/// Error of a limb: its bones are not usable. Bones are numbered from the first joint to the tip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LimbError {
    /// The bone at this position of the limb is missing, or is not a descendant of the bone before it. A limb needs at
    /// least two bones: a joint and a tip.
    Bone(usize),
    /// Two consecutive bones of the limb coincide in the rest pose, or a length is not finite.
    Length,
    /// The pelvis bone does not exist, or the leg of this foot is not a descendant of it.
    Pelvis {
        /// The index of the foot.
        foot: usize,
    },
}

impl fmt::Display for LimbError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bone(bone) => write!(f, "bone {bone} of the limb is missing or does not hang on the one before it"),
            Self::Length => f.write_str("two bones of the limb are at one place in the rest pose, or not finite"),
            Self::Pelvis { foot } => write!(f, "the leg of foot {foot} does not hang on the pelvis that is given"),
        }
    }
}

impl core::error::Error for LimbError {}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Limb {
    /// Number of bones of the skeleton.
    count: usize,
    /// Bones from the first joint to the tip; at least two.
    bones: Vec<usize>,
    /// Limit of each joint; the axis of a hinge is in the joint's bone space.
    limits: Vec<CcdLimit>,
    /// Sum of the bones' lengths in the pose passed to [`measure`](Self::measure), model units.
    length: f32,
}

impl Limb {
    pub(crate) fn new(skeleton: &Skeleton, bones: Vec<usize>) -> Result<Self, LimbError> {
        for (place, &bone) in bones.iter().enumerate() {
            let is_below = |on: usize| on != bone && skeleton.subtree(on).contains(&bone);
            if bone >= skeleton.len() || place > 0 && !is_below(bones[place - 1]) {
                return Err(LimbError::Bone(place));
            }
        }
        if bones.len() < 2 {
            return Err(LimbError::Bone(bones.len()));
        }
        let limits = alloc::vec![CcdLimit::Free; bones.len() - 1];
        Ok(Self { count: skeleton.len(), bones, limits, length: 0.0 })
    }

    /// Creates a limb with its length in the rest pose, and scratch memory for its joints.
    pub(crate) fn at_rest(skeleton: &Skeleton, bones: Vec<usize>) -> Result<(Self, Vec<CcdJoint>), LimbError> {
        let mut limb = Self::new(skeleton, bones)?;
        limb.measure(&skeleton.rest_in_model())?;
        let joints = limb.memory();
        Ok((limb, joints))
    }

    /// Allocates scratch memory for the joints.
    pub(crate) fn memory(&self) -> Vec<CcdJoint> {
        alloc::vec![CcdJoint::new(Vec3::ZERO); self.joints()]
    }

    pub(crate) fn set_limit(&mut self, joint: usize, to: CcdLimit) {
        if let Some(limit) = self.limits.get_mut(joint) {
            *limit = to;
        }
    }

    /// Measures the length in a pose. Fails if two consecutive bones coincide or the length is not finite.
    pub(crate) fn measure(&mut self, model: &[Affine3A]) -> Result<(), LimbError> {
        self.length = self.bone_lengths(model).fold(0.0, |sum, bone| sum + bone);
        let has_length = self.bone_lengths(model).all(|bone| bone > 0.0) && self.length.is_finite();
        if has_length { Ok(()) } else { Err(LimbError::Length) }
    }

    pub(crate) fn length(&self) -> f32 {
        self.length
    }

    /// Returns the sum of the bones' lengths in a pose, model units.
    pub(crate) fn reach(&self, model: &[Affine3A]) -> f32 {
        self.bone_lengths(model).sum()
    }

    /// Returns the number of bones of the skeleton, not of the limb.
    pub(crate) fn bones(&self) -> usize {
        self.count
    }

    /// Returns the bones, from the first joint to the tip.
    pub(crate) fn chain(&self) -> &[usize] {
        &self.bones
    }

    /// Returns the number of joints that turn: all bones but the tip.
    pub(crate) fn joints(&self) -> usize {
        self.limits.len()
    }

    fn bone_lengths<'a>(&'a self, model: &'a [Affine3A]) -> impl Iterator<Item = f32> + 'a {
        self.bones.windows(2).map(|pair| length(model[pair[1]].translation - model[pair[0]].translation))
    }

    /// Returns the bone of the tip.
    pub(crate) fn tip_bone(&self) -> usize {
        self.bones[self.bones.len() - 1]
    }

    pub(crate) fn tip(&self, model: &[Affine3A]) -> Vec3 {
        model[self.tip_bone()].translation.into()
    }

    /// Converts a model-space point to a vector from the first joint, in units of the limb's length.
    pub(crate) fn to_limb_units(&self, model: &[Affine3A], point: Vec3) -> Vec3 {
        (point - Vec3::from(model[self.bones[0]].translation)) / self.length
    }

    /// Returns the reachable point nearest to `point`, and the distance between them. Points and distance are relative
    /// to the first joint, in units of the limb's length, as in [`to_limb_units`](Self::to_limb_units).
    ///
    /// With L the longest bone and S the sum of all, the limb reaches distances from max(2·L − S, 0), folded, to S,
    /// stretched.
    pub(crate) fn within_reach(&self, model: &[Affine3A], point: Vec3) -> (Vec3, f32) {
        let (sum, longest) =
            self.bone_lengths(model).fold((0.0, 0.0_f32), |(sum, longest), bone| (sum + bone, longest.max(bone)));
        let (far, near) = (sum / self.length, (2.0 * longest - sum) / self.length);
        let away = length(point.into());
        let held = away.min(far).max(near);
        if held == away || !away.is_finite() {
            return (point, 0.0);
        }
        let way = if away > 0.0 { point / away } else { Vec3::X };
        (way * held, (held - away).abs())
    }

    /// Returns the reachable point nearest to `point`, and the distance between them, in model space.
    pub(crate) fn nearest(&self, model: &[Affine3A], point: Vec3) -> (Vec3, f32) {
        let (nearest, beyond) = self.within_reach(model, self.to_limb_units(model, point));
        if beyond > 0.0 {
            (Vec3::from(model[self.bones[0]].translation) + nearest * self.length, beyond * self.length)
        } else {
            (point, 0.0)
        }
    }

    /// Turns the joints so that the tip reaches the goal's point, and returns the remaining distance, model units.
    ///
    /// The tip keeps its model-space orientation, turned by `goal.turn`.
    pub(crate) fn follow(
        &self,
        goal: &TipGoal<'_>,
        joints: &mut [CcdJoint],
        pose: &mut PosePair<'_>,
    ) -> Result<f32, PoseError> {
        self.follow_partially(goal, PartialFollow { weight: 1.0, before: &mut [] }, joints, pose)
    }

    /// Turns the joints towards the goal as [`follow`](Self::follow) does, but applies only a part: each joint's local
    /// rotation is interpolated by `part.weight`. `goal.turn` is applied in full.
    ///
    /// Returns the remaining distance at full weight times `part.weight`, model units. If the goal's point is not
    /// finite, changes nothing and returns 0.
    pub(crate) fn follow_partially(
        &self,
        goal: &TipGoal<'_>,
        part: PartialFollow<'_>,
        joints: &mut [CcdJoint],
        pose: &mut PosePair<'_>,
    ) -> Result<f32, PoseError> {
        let PosePair { skeleton, local, model } = pose;
        [skeleton.len(), local.len(), model.len()].into_iter().try_for_each(|len| check_length(self.count, len))?;
        if !goal.point.is_finite() {
            return Ok(0.0);
        }
        let tip = self.tip_bone();
        let (wanted, animated) = (goal.point, model[tip].matrix3);
        let mut error = f32::INFINITY;
        for (before, &bone) in part.before.iter_mut().zip(&self.bones) {
            *before = local[bone].rotation;
        }
        for _ in 0..MOST_ROUNDS {
            // Solved anew from the current pose, until the tip is where the solver says.
            let predicted_error = self.solve(goal, joints, model);
            let mut carried = Quat::IDENTITY;
            for (joint, &bone) in joints.iter().zip(&self.bones) {
                // The joint's own rotation: its total rotation without that of the joints before it.
                let turn = made_unit(product(joint.turn, carried.conjugate()));
                skeleton.turn_in_model(bone, turn, model, local)?;
                skeleton.to_model_below(bone, local, model)?;
                carried = joint.turn;
            }
            error = length((self.tip(model) - wanted).into());
            if !((error - predicted_error).abs() > NEAR * self.length) {
                break;
            }
        }
        if part.weight < 1.0 {
            for (before, &bone) in part.before.iter().zip(&self.bones) {
                local[bone].rotation = slerp(*before, local[bone].rotation, part.weight);
            }
            skeleton.to_model_below(self.bones[0], local, model)?;
        }
        let oriented = goal.turn.map_or(animated, |turn| Mat3A::from_quat(turn) * animated);
        if let Some(turn) = turn_between(model[tip].matrix3, oriented) {
            skeleton.turn_in_model(tip, turn, model, local)?;
            skeleton.to_model_below(tip, local, model)?;
        }
        Ok(error * part.weight)
    }

    /// Solves for the joints' model-space rotations that bring the tip to the goal's point, writes them to `joints`,
    /// and returns the tip's remaining distance as computed by the solver.
    fn solve(&self, goal: &TipGoal<'_>, joints: &mut [CcdJoint], model: &[Affine3A]) -> f32 {
        let at = |bone: usize| Vec3::from(model[bone].translation);
        for ((joint, limit), &bone) in joints.iter_mut().zip(&self.limits).zip(&self.bones) {
            let mut limit = *limit;
            if let CcdLimit::Hinge { axis, .. } = &mut limit {
                *axis = model[bone].transform_vector3(*axis);
            }
            *joint = CcdJoint::new(at(bone)).with_limit(limit);
        }
        let tip = self.tip(model);
        if let [upper, lower] = joints {
            let mut solver = *goal.two_bone;
            if let Some(hinge) = &mut solver.hinge {
                hinge.axis = model[self.bones[1]].transform_vector3(hinge.axis);
            }
            let limb = ik::Limb { root: upper.position, middle: lower.position, tip };
            let outcome = solver.solve(&limb, goal.point);
            (upper.turn, lower.turn) = (outcome.upper, outcome.lower);
            return outcome.error;
        }
        Ccd::new().with_tolerance(1e-5).with_iterations(100).solve(joints, tip, goal.point).error
    }
}

/// Goal for the tip of a limb.
pub(crate) struct TipGoal<'a> {
    /// Point to reach, model space.
    pub(crate) point: Vec3,
    /// Model-space rotation applied to the tip's orientation; `None` keeps the orientation.
    pub(crate) turn: Option<Quat>,
    /// Solver for a two-bone limb; the axis of its hinge is in the space of the middle bone.
    pub(crate) two_bone: &'a TwoBone,
}

/// Fraction of a solution to apply.
pub(crate) struct PartialFollow<'a> {
    /// Fraction, 0…1.
    pub(crate) weight: f32,
    /// Scratch memory for the rotation of each joint; may be empty if the weight is 1.
    pub(crate) before: &'a mut [Quat],
}

/// Returns the rotation that turns the orientation of `from` into that of `to`; `None` if either matrix is singular.
fn turn_between(from: Mat3A, to: Mat3A) -> Option<Quat> {
    unit(Quat::from_mat3a(&(nearest_orthogonal(to)? * nearest_orthogonal(from)?.transpose())))
}
