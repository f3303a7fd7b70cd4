//! [`LimbLayer`]: brings the tip of a limb to a target.

use alloc::vec::Vec;

use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::ik::{CcdJoint, CcdLimit, TwoBone};
use aim_runtime::rotation::{inverse, product, slerp};

use crate::fade::Ramp;
use crate::figure::{Figure, Layer};
use crate::limb::{Limb, LimbError, PartialFollow, TipGoal};
use crate::mask::clamped;
use crate::pose::{PoseError, check_length};
use crate::skeleton::Skeleton;
use crate::transform::Transform;

/// Coordinate space of a [`TipTarget`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Space {
    /// Model space, which moves with the character.
    #[default]
    Model,
    /// World space: a handrail, for example.
    World,
    /// Space of a bone in the pose left by the previous layers: a gun in the other hand, for example.
    Bone(usize),
}

/// Target position of the tip of a limb, and optionally its orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipTarget {
    /// Target point, in [`space`](Self::space).
    pub point: Vec3,
    /// Target orientation of the tip's bone in [`space`](Self::space), a unit quaternion; `None` keeps the animated
    /// one.
    pub rotation: Option<Quat>,
    /// Space of the point and the rotation.
    pub space: Space,
}

impl TipTarget {
    /// Creates a target point in model space.
    #[must_use]
    pub const fn model(point: Vec3) -> Self {
        Self { point, rotation: None, space: Space::Model }
    }

    /// Creates a target point in world space.
    #[must_use]
    pub const fn world(point: Vec3) -> Self {
        Self { point, rotation: None, space: Space::World }
    }

    /// Creates a target point in the space of a bone.
    #[must_use]
    pub const fn bone(bone: usize, point: Vec3) -> Self {
        Self { point, rotation: None, space: Space::Bone(bone) }
    }

    /// Sets the target orientation of the tip's bone, in the target's space.
    #[must_use]
    pub const fn with_rotation(mut self, rotation: Quat) -> Self {
        self.rotation = Some(rotation);
        self
    }

    /// Converts point and rotation to model space; `None` if the bone does not exist, the place is singular or a result
    /// is not finite.
    fn in_model(&self, figure: &Figure) -> Option<(Vec3, Option<Quat>)> {
        let space = match self.space {
            Space::Model => Affine3A::IDENTITY,
            Space::World => inverse(&figure.place.to_affine())?,
            Space::Bone(bone) => *figure.model().get(bone)?,
        };
        let rotation = match self.rotation {
            Some(rotation) => Some(Transform::from_affine(&(space * Affine3A::from_quat(rotation)))?.rotation),
            None => None,
        };
        let point = space.transform_point3(self.point);
        point.is_finite().then_some((point, rotation))
    }
}

/// Layer that brings the tip of a limb to a target: a hand at the end of an arm, for example.
///
/// A limb of two bones (two joints and the tip) is solved in closed form, in the bend plane of the animation unless
/// [`two_bone`](Self::two_bone) selects another. Any other limb is solved by cyclic coordinate descent.
///
/// [`set_target`](Self::set_target) and [`release`](Self::release) fade within [`fade_s`](Self::fade_s) seconds,
/// continuous in position and velocity, even if one interrupts the other. Set a moving target every frame. A switch to
/// a distant target is not faded: interpolate the targets yourself.
///
/// A partial weight, from the fade or from [`weight`](Self::weight), acts as follows:
///
/// - With two bones and [`TwoBone::new`], the tip moves that fraction of the straight line from its animated position
///   to the target, or to the nearest reachable point.
/// - Otherwise, each joint turns by that fraction of its full rotation, so that poles and limits also set in gradually.
#[derive(Clone, Debug, PartialEq)]
pub struct LimbLayer {
    /// Weight of the layer, 0…1, multiplied by the fade; NaN is treated as 0. Default 1.
    pub weight: f32,
    /// Duration of fading in and out, seconds. Default 0: at once.
    pub fade_s: f32,
    /// Solver for a two-bone limb. A pole is in model space, the axis of a hinge in the space of the middle bone.
    pub two_bone: TwoBone,
    limb: Limb,
    joints: Vec<CcdJoint>,
    /// Scratch memory for the joints' rotations before solving.
    before: Vec<Quat>,
    target: Option<TipTarget>,
    ramp: Ramp,
    error: f32,
}

impl LimbLayer {
    /// Creates a layer for a limb, given as bones from its first joint to its tip. Each bone must be a descendant of
    /// the one before it, at any depth; the bones in between are carried along.
    ///
    /// # Errors
    /// Fails if a bone is missing or out of order, or if two consecutive bones coincide in the rest pose: see
    /// [`LimbError`].
    pub fn new(skeleton: &Skeleton, limb: impl Into<Vec<usize>>) -> Result<Self, LimbError> {
        let (limb, joints) = Limb::at_rest(skeleton, limb.into())?;
        let (two_bone, ramp, before) = (TwoBone::new(), Ramp::default(), alloc::vec![Quat::IDENTITY; joints.len()]);
        Ok(Self { weight: 1.0, fade_s: 0.0, two_bone, limb, joints, before, target: None, ramp, error: 0.0 })
    }

    /// Sets the duration of fading in and out, seconds.
    #[must_use]
    pub const fn with_fade(mut self, fade_s: f32) -> Self {
        self.fade_s = fade_s;
        self
    }

    /// Sets the solver for a two-bone limb.
    #[must_use]
    pub const fn with_two_bone(mut self, two_bone: TwoBone) -> Self {
        self.two_bone = two_bone;
        self
    }

    /// Sets the initial target, without a fade.
    #[must_use]
    pub fn with_target(mut self, target: TipTarget) -> Self {
        self.target = Some(target);
        self.ramp.set_goal(1.0, 0.0);
        self
    }

    /// Sets the limit of a joint. The axis of a hinge is in the joint's bone space. Does nothing if the joint does not
    /// exist.
    ///
    /// Limits are ignored for a limb of two bones (two joints and the tip): use the hinge of
    /// [`two_bone`](Self::two_bone).
    #[must_use]
    pub fn with_limit(mut self, joint: usize, limit: CcdLimit) -> Self {
        self.limb.set_limit(joint, limit);
        self
    }

    /// Sets the target. Fades in if there was none or if the layer was released.
    pub fn set_target(&mut self, target: TipTarget) {
        self.target = Some(target);
        self.ramp.set_goal(1.0, self.fade_s);
    }

    /// Releases the tip to the animation by fading out. The last target is used until the fade ends.
    pub fn release(&mut self) {
        self.ramp.set_goal(0.0, self.fade_s);
    }

    /// Returns the current weight of the fade, 0…1.
    #[must_use]
    pub fn faded_in(&self) -> f32 {
        clamped(self.ramp.value())
    }

    /// Returns the tip error of the last frame, model units: the distance from the target at full weight, times the
    /// weight applied.
    ///
    /// It exceeds rounding errors if the target is out of reach. It is infinite if the target cannot be located,
    /// because its bone does not exist or a value is not finite; the limb is then left unchanged. It is 0 without a
    /// target or at weight 0.
    #[must_use]
    pub fn error(&self) -> f32 {
        self.error
    }
}

impl Layer for LimbLayer {
    fn apply(&mut self, figure: &mut Figure, dt_s: f32) -> Result<(), PoseError> {
        check_length(self.limb.bones(), figure.model().len())?;
        self.error = 0.0;
        self.ramp.advance(dt_s);
        let weight = clamped(self.weight) * self.faded_in();
        let Some(target) = self.target.filter(|_| weight > 0.0) else { return Ok(()) };
        let Some((point, rotation)) = target.in_model(figure) else {
            self.error = f32::INFINITY;
            return Ok(());
        };
        let animated = self.limb.tip(figure.model());
        let tip = Transform::from_affine(&figure.model()[self.limb.tip_bone()]);
        let turn = rotation.zip(tip).map(|(rotation, tip)| product(rotation, tip.rotation.conjugate()));
        let turn = turn.map(|turn| slerp(Quat::IDENTITY, turn, weight));
        let mut goal = TipGoal { point, turn, two_bone: &self.two_bone };
        let mut part = PartialFollow { weight, before: &mut self.before };
        let is_straight = self.joints.len() == 2 && self.two_bone == TwoBone::new();
        if weight < 1.0 && is_straight {
            // Uses the nearest reachable point. With a target out of reach, the limb would be fully stretched at a
            // weight below 1, and the tip would stop there abruptly.
            let (reached, missed) = self.limb.nearest(figure.model(), point);
            goal.point = animated + (reached - animated) * weight;
            part.weight = 1.0;
            self.error = missed * weight;
        }
        self.error += self.limb.follow_partially(&goal, part, &mut self.joints, &mut figure.pose_pair())?;
        Ok(())
    }
}
