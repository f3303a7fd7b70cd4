//! The bones of a limb, and how they follow their tip. [`Reach`](crate::Reach) leads it along a way, [`LimbLayer`](crate::LimbLayer) to
//! a point, [`Plant`](crate::Plant) has it stand.

use alloc::vec::Vec;
use core::fmt;

use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim_runtime::ik::{self, Ccd, CcdJoint, CcdLimit, TwoBone};
use aim_runtime::rotation::{length, nearest_orthogonal, product, slerp, unit};

use crate::pose::{Both, PoseError, check_length};
use crate::skeleton::Skeleton;
use crate::transform::made_unit;

/// The most times a limb is solved in a frame: more than once only if uneven scales shear its turns.
const MOST_ROUNDS: usize = 8;
/// As near to what the solver says as is worth another round, of the limb's length.
const NEAR: f32 = 1e-6;

/// Why bones are no limb. They are counted from the first joint to the tip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LimbError {
    /// A limb needs a joint and a tip, and every bone but the first has to hang on the one before: this one is not there or
    /// does not.
    Bone(usize),
    /// The limb has no length between two of its bones in the rest pose, or it is not finite.
    Length,
    /// There is no such pelvis, or this foot's limb does not hang on it.
    Pelvis {
        /// The number of the foot.
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
    /// The number of bones of the skeleton.
    count: usize,
    /// From the first joint to the tip; at least two.
    bones: Vec<usize>,
    /// Of each joint; a hinge's axis is in the space of its bone.
    limits: Vec<CcdLimit>,
    /// The sum of its bones' lengths when the clip begins.
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

    /// The limb with its length in the rest pose, and memory for its joints.
    pub(crate) fn at_rest(skeleton: &Skeleton, bones: Vec<usize>) -> Result<(Self, Vec<CcdJoint>), LimbError> {
        let mut limb = Self::new(skeleton, bones)?;
        limb.measure(&skeleton.rest_in_model())?;
        let joints = limb.memory();
        Ok((limb, joints))
    }

    /// Memory for its joints.
    pub(crate) fn memory(&self) -> Vec<CcdJoint> {
        alloc::vec![CcdJoint::new(Vec3::ZERO); self.joints()]
    }

    pub(crate) fn set_limit(&mut self, joint: usize, to: CcdLimit) {
        if let Some(limit) = self.limits.get_mut(joint) {
            *limit = to;
        }
    }

    /// Takes its length from a pose.
    pub(crate) fn measure(&mut self, model: &[Affine3A]) -> Result<(), LimbError> {
        self.length = self.bone_lengths(model).fold(0.0, |sum, bone| sum + bone);
        let has_length = self.bone_lengths(model).all(|bone| bone > 0.0) && self.length.is_finite();
        if has_length { Ok(()) } else { Err(LimbError::Length) }
    }

    pub(crate) fn length(&self) -> f32 {
        self.length
    }

    /// The sum of its bones' lengths in a pose.
    pub(crate) fn reach(&self, model: &[Affine3A]) -> f32 {
        self.bone_lengths(model).sum()
    }

    /// The number of bones of the skeleton.
    pub(crate) fn bones(&self) -> usize {
        self.count
    }

    /// Its bones, from the first joint to the tip.
    pub(crate) fn chain(&self) -> &[usize] {
        &self.bones
    }

    /// The number of joints that turn.
    pub(crate) fn joints(&self) -> usize {
        self.limits.len()
    }

    fn bone_lengths<'a>(&'a self, model: &'a [Affine3A]) -> impl Iterator<Item = f32> + 'a {
        self.bones.windows(2).map(|pair| length(model[pair[1]].translation - model[pair[0]].translation))
    }

    /// The bone of the tip.
    pub(crate) fn tip_bone(&self) -> usize {
        self.bones[self.bones.len() - 1]
    }

    pub(crate) fn tip(&self, model: &[Affine3A]) -> Vec3 {
        model[self.tip_bone()].translation.into()
    }

    /// A point of the model as seen from the first joint, in lengths of the limb.
    pub(crate) fn seen(&self, model: &[Affine3A], point: Vec3) -> Vec3 {
        (point - Vec3::from(model[self.bones[0]].translation)) / self.length
    }

    /// The point nearest to one that is seen from the first joint that the stretched or folded limb reaches, and how far they
    /// are apart.
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

    /// The point of the model nearest to one that the limb reaches, and how far they are apart.
    pub(crate) fn nearest(&self, model: &[Affine3A], point: Vec3) -> (Vec3, f32) {
        let (seen, beyond) = self.within_reach(model, self.seen(model, point));
        if beyond > 0.0 {
            (Vec3::from(model[self.bones[0]].translation) + seen * self.length, beyond * self.length)
        } else {
            (point, 0.0)
        }
    }

    /// Turns the joints so that the tip comes to a point in the space of the model; the distance that it is then off. The tip keeps its
    /// orientation, turned by `turn` in the space of the model.
    pub(crate) fn follow(
        &self,
        goal: &TipGoal<'_>,
        joints: &mut [CcdJoint],
        pose: &mut Both<'_>,
    ) -> Result<f32, PoseError> {
        self.follow_in_part(goal, Part { weight: 1.0, before: &mut [] }, joints, pose)
    }

    /// The same in part: each joint turns by this part of its turn, as seen from its parent, and so much of the distance is told. The
    /// whole of `turn` is applied.
    pub(crate) fn follow_in_part(
        &self,
        goal: &TipGoal<'_>,
        part: Part<'_>,
        joints: &mut [CcdJoint],
        pose: &mut Both<'_>,
    ) -> Result<f32, PoseError> {
        let Both { skeleton, local, model } = pose;
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
            let told = self.solve(goal, joints, model);
            let mut carried = Quat::IDENTITY;
            for (joint, &bone) in joints.iter().zip(&self.bones) {
                let turn = made_unit(product(joint.turn, carried.conjugate()));
                skeleton.turn_in_model(bone, turn, model, local)?;
                skeleton.to_model_below(bone, local, model)?;
                carried = joint.turn;
            }
            error = length((self.tip(model) - wanted).into());
            if !((error - told).abs() > NEAR * self.length) {
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

    /// The turns of the joints that bring the tip to a point, and how far it then is from it, as the solver has it.
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

/// Where a limb's tip goes.
pub(crate) struct TipGoal<'a> {
    /// In the space of the model.
    pub(crate) point: Vec3,
    /// From the tip's orientation before to that after, in the space of the model; none keeps it.
    pub(crate) turn: Option<Quat>,
    /// The solver of a limb of two bones; a hinge's axis is in the space of the middle bone.
    pub(crate) two_bone: &'a TwoBone,
}

/// The part of a solution that is applied.
pub(crate) struct Part<'a> {
    /// 0…1.
    pub(crate) weight: f32,
    /// Memory for the rotation of each joint; none is needed for the whole.
    pub(crate) before: &'a mut [Quat],
}

/// The turn that leads from one orientation to another; `None` where one of them has none.
fn turn_between(from: Mat3A, to: Mat3A) -> Option<Quat> {
    unit(Quat::from_mat3a(&(nearest_orthogonal(to)? * nearest_orthogonal(from)?.transpose())))
}
