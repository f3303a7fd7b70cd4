//! [`LimbLayer`]: brings the tip of a limb to a point.

use alloc::vec::Vec;

use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::ik::{CcdJoint, CcdLimit, TwoBone};
use aim_runtime::rotation::{inverse, product, slerp};

use crate::fade::Ramp;
use crate::figure::{Figure, Layer};
use crate::limb::{Limb, LimbError, Part, TipGoal};
use crate::mask::clamped;
use crate::pose::{PoseError, check_length};
use crate::skeleton::Skeleton;
use crate::transform::Transform;

/// The space of a [`TipTarget`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Space {
    /// That of the model, which moves with the character.
    #[default]
    Model,
    /// The world: a handrail.
    World,
    /// That of a bone as the layers before have left it: a gun in the other hand.
    Bone(usize),
}

/// Where the tip of a limb is to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipTarget {
    /// The point.
    pub point: Vec3,
    /// The orientation of the tip's bone there, a unit quaternion; `None` keeps the animated one.
    pub rotation: Option<Quat>,
    /// The space of both.
    pub space: Space,
}

impl TipTarget {
    /// A point in the space of the model.
    #[must_use]
    pub const fn model(point: Vec3) -> Self {
        Self { point, rotation: None, space: Space::Model }
    }

    /// A point in the world.
    #[must_use]
    pub const fn world(point: Vec3) -> Self {
        Self { point, rotation: None, space: Space::World }
    }

    /// A point in the space of a bone.
    #[must_use]
    pub const fn bone(bone: usize, point: Vec3) -> Self {
        Self { point, rotation: None, space: Space::Bone(bone) }
    }

    /// With the orientation of the tip's bone, in the same space.
    #[must_use]
    pub const fn with_rotation(mut self, rotation: Quat) -> Self {
        self.rotation = Some(rotation);
        self
    }

    /// Point and rotation in the space of the model; `None` if there is no such bone or if something is not finite.
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

/// A limb whose tip is brought to a target: an arm by its hand. Of two bones it bends in closed form, in the plane of the animation
/// unless [`two_bone`](Self::two_bone) says otherwise; of more by cyclic coordinate descent.
///
/// [`set_target`](Self::set_target) and [`release`](Self::release) fade within [`fade_s`](Self::fade_s) seconds, without a jump in place
/// or speed, also when one interrupts the other. A target that moves is set every frame; from one that is elsewhere to the next, blend
/// the targets yourself.
///
/// In part, by the fade or by [`weight`](Self::weight), the tip of two bones is at that part of the straight way to its target, or to
/// where it gets if that is out of reach. A limb of more bones, or with a [`two_bone`](Self::two_bone) other than [`TwoBone::new`], turns
/// each joint by that part of its whole turn instead, so that poles and limits come in as gradually.
#[derive(Clone, Debug, PartialEq)]
pub struct LimbLayer {
    /// The part that is applied, 0…1, beside the fade; NaN counts as 0. Default 1.
    pub weight: f32,
    /// The time in which it fades in and out, seconds; 0, the default, is at once.
    pub fade_s: f32,
    /// The solver of a limb of two bones: a pole is in the space of the model, a hinge's axis in that of the middle bone.
    pub two_bone: TwoBone,
    limb: Limb,
    joints: Vec<CcdJoint>,
    /// Memory for the rotations of the joints before.
    before: Vec<Quat>,
    target: Option<TipTarget>,
    ramp: Ramp,
    error: f32,
}

impl LimbLayer {
    /// A limb from its first joint to its tip; each bone hangs on the one before, by any number of bones, which are carried along.
    ///
    /// # Errors
    /// See [`LimbError`].
    pub fn new(skeleton: &Skeleton, limb: impl Into<Vec<usize>>) -> Result<Self, LimbError> {
        let (limb, joints) = Limb::at_rest(skeleton, limb.into())?;
        let (two_bone, ramp, before) = (TwoBone::new(), Ramp::default(), alloc::vec![Quat::IDENTITY; joints.len()]);
        Ok(Self { weight: 1.0, fade_s: 0.0, two_bone, limb, joints, before, target: None, ramp, error: 0.0 })
    }

    /// With a time in which it fades in and out, seconds.
    #[must_use]
    pub const fn with_fade(mut self, fade_s: f32) -> Self {
        self.fade_s = fade_s;
        self
    }

    /// With a solver of a limb of two bones.
    #[must_use]
    pub const fn with_two_bone(mut self, two_bone: TwoBone) -> Self {
        self.two_bone = two_bone;
        self
    }

    /// With a target from the beginning, without a fade.
    #[must_use]
    pub fn with_target(mut self, target: TipTarget) -> Self {
        self.target = Some(target);
        self.ramp.lead(1.0, 0.0);
        self
    }

    /// With a limit of a joint of a limb of more than two bones; a hinge's axis is in the space of the joint's bone. Nothing is done if
    /// there is no such joint.
    #[must_use]
    pub fn with_limit(mut self, joint: usize, limit: CcdLimit) -> Self {
        self.limb.set_limit(joint, limit);
        self
    }

    /// Has the tip at a target from now on.
    pub fn set_target(&mut self, target: TipTarget) {
        self.target = Some(target);
        self.ramp.lead(1.0, self.fade_s);
    }

    /// Leaves the tip to the animation again. While it fades it stays with its last target.
    pub fn release(&mut self) {
        self.ramp.lead(0.0, self.fade_s);
    }

    /// The part that the fade applies by now, 0…1.
    #[must_use]
    pub fn faded_in(&self) -> f32 {
        clamped(self.ramp.value())
    }

    /// The distance of the tip from where it was to be in the last frame, in units of the model: that by which the whole turns miss the
    /// target, times the part that is applied. More than rounding where the limb does not reach that far. Infinite where the target has
    /// no place: a bone that is not there, or what is not finite; then the limb stays as it was.
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
        let mut part = Part { weight, before: &mut self.before };
        let is_straight = self.joints.len() == 2 && self.two_bone == TwoBone::new();
        if weight < 1.0 && is_straight {
            // On the way to a target out of reach the limb would be stretched before the weight is 1, and stop with a jump in speed.
            let (reached, missed) = self.limb.nearest(figure.model(), point);
            goal.point = animated + (reached - animated) * weight;
            part.weight = 1.0;
            self.error = missed * weight;
        }
        self.error += self.limb.follow_in_part(&goal, part, &mut self.joints, &mut figure.both())?;
        Ok(())
    }
}
