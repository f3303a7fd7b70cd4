//! The bones of a limb, and how they follow their tip.

use alloc::vec::Vec;

use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim_runtime::ik::{self, Ccd, CcdJoint, CcdLimit, TwoBone};
use aim_runtime::rotation::{length, nearest_orthogonal, product, unit};

use super::error::ReachError;
use crate::clip::{Clip, Cursor};
use crate::pose::PoseError;
use crate::skeleton::Skeleton;
use crate::transform::{Transform, made_unit};

/// The most times a limb is solved in a frame: more than once only if uneven scales shear its turns.
const MOST_ROUNDS: usize = 8;
/// As near to what the solver says as is worth another round, of the limb's length.
const NEAR: f32 = 1e-6;

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Limb {
    skeleton: Skeleton,
    /// From the first joint to the tip; at least two.
    bones: Vec<usize>,
    /// Of each joint; a hinge's axis is in the space of its bone.
    limits: Vec<CcdLimit>,
    /// The sum of its bones' lengths when the clip begins.
    length: f32,
}

impl Limb {
    pub(super) fn new(skeleton: &Skeleton, bones: Vec<usize>) -> Result<Self, ReachError> {
        for (place, &bone) in bones.iter().enumerate() {
            let is_below = |on: usize| on != bone && skeleton.subtree(on).contains(&bone);
            if bone >= skeleton.len() || place > 0 && !is_below(bones[place - 1]) {
                return Err(ReachError::Limb(place));
            }
        }
        if bones.len() < 2 {
            return Err(ReachError::Limb(bones.len()));
        }
        let limits = alloc::vec![CcdLimit::Free; bones.len() - 1];
        Ok(Self { skeleton: skeleton.clone(), bones, limits, length: 0.0 })
    }

    pub(super) fn set_limit(&mut self, joint: usize, to: CcdLimit) {
        if let Some(limit) = self.limits.get_mut(joint) {
            *limit = to;
        }
    }

    /// Takes its length from a pose.
    pub(super) fn measure(&mut self, model: &[Affine3A]) -> Result<(), ReachError> {
        self.length = self.bone_lengths(model).fold(0.0, |sum, bone| sum + bone);
        let has_length = self.bone_lengths(model).all(|bone| bone > 0.0) && self.length.is_finite();
        if has_length { Ok(()) } else { Err(ReachError::Place) }
    }

    pub(super) fn length(&self) -> f32 {
        self.length
    }

    /// The number of bones of the skeleton.
    pub(super) fn bones(&self) -> usize {
        self.skeleton.len()
    }

    /// The number of joints that turn.
    pub(super) fn joints(&self) -> usize {
        self.limits.len()
    }

    fn bone_lengths<'a>(&'a self, model: &'a [Affine3A]) -> impl Iterator<Item = f32> + 'a {
        self.bones.windows(2).map(|pair| length(model[pair[1]].translation - model[pair[0]].translation))
    }

    pub(super) fn tip(&self, model: &[Affine3A]) -> Vec3 {
        model[self.bones[self.bones.len() - 1]].translation.into()
    }

    /// A point of the model as seen from the first joint, in lengths of the limb.
    pub(super) fn seen(&self, model: &[Affine3A], point: Vec3) -> Vec3 {
        (point - Vec3::from(model[self.bones[0]].translation)) / self.length
    }

    /// The clip at a time.
    pub(super) fn pose(&self, clip: &Clip, time_s: f32, local: &mut [Transform], model: &mut [Affine3A]) {
        local.copy_from_slice(self.skeleton.rest());
        clip.sample(time_s, &mut Cursor::default(), local);
        // Of equal lengths.
        let _ = self.skeleton.to_model(local, model);
    }

    /// The point nearest to one that is seen from the first joint that the stretched or folded limb reaches, and how far they
    /// are apart.
    pub(super) fn within_reach(&self, model: &[Affine3A], point: Vec3) -> (Vec3, f32) {
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

    /// Turns the joints so that the tip, oriented as before, is moved by `offset` in the space of the model; the distance that it
    /// is then off.
    pub(super) fn follow(
        &self,
        offset: Vec3,
        joints: &mut [CcdJoint],
        local: &mut [Transform],
        model: &mut [Affine3A],
    ) -> Result<f32, PoseError> {
        if !(offset != Vec3::ZERO && offset.is_finite()) {
            return Ok(0.0);
        }
        let tip = self.bones[self.bones.len() - 1];
        let (wanted, animated) = (self.tip(model) + offset, model[tip].matrix3);
        let mut error = f32::INFINITY;
        for _ in 0..MOST_ROUNDS {
            let told = self.solve(wanted, joints, model);
            let mut carried = Quat::IDENTITY;
            for (joint, &bone) in joints.iter().zip(&self.bones) {
                let turn = made_unit(product(joint.turn, carried.conjugate()));
                self.skeleton.turn_in_model(bone, turn, model, local)?;
                self.skeleton.to_model_below(bone, local, model)?;
                carried = joint.turn;
            }
            error = length((self.tip(model) - wanted).into());
            if !((error - told).abs() > NEAR * self.length) {
                break;
            }
        }
        if let Some(turn) = turn_between(model[tip].matrix3, animated) {
            self.skeleton.turn_in_model(tip, turn, model, local)?;
            self.skeleton.to_model_below(tip, local, model)?;
        }
        Ok(error)
    }

    /// The turns of the joints that bring the tip to a point, and how far it then is from it, as the solver has it.
    fn solve(&self, wanted: Vec3, joints: &mut [CcdJoint], model: &[Affine3A]) -> f32 {
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
            let limb = ik::Limb { root: upper.position, middle: lower.position, tip };
            let outcome = TwoBone::new().solve(&limb, wanted);
            (upper.turn, lower.turn) = (outcome.upper, outcome.lower);
            return outcome.error;
        }
        Ccd::new().with_tolerance(1e-5).with_iterations(100).solve(joints, tip, wanted).error
    }
}

/// The turn that leads from one orientation to another; `None` where one of them has none.
fn turn_between(from: Mat3A, to: Mat3A) -> Option<Quat> {
    unit(Quat::from_mat3a(&(nearest_orthogonal(to)? * nearest_orthogonal(from)?.transpose())))
}
