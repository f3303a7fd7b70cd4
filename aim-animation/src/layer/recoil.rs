//! [`Recoil`]: kicks an object held in a hand.

use alloc::vec::Vec;

use aim_runtime::glam::{Affine3A, Vec3};
use aim_runtime::ik::{CcdJoint, TwoBone};
use aim_runtime::rotation::{exp, product};

use crate::attach::attached;
use crate::figure::{Figure, Layer};
use crate::float::decay;
use crate::limb::{Limb, LimbError, TipGoal};
use crate::pose::{PoseError, check_length};
use crate::skeleton::Skeleton;
use crate::transform::Transform;

/// Layer that applies recoil to an object held in a hand. A kick gives the object a velocity and an angular velocity,
/// and it returns without overshoot while the arm follows.
///
/// Run it after the aim, which would otherwise compensate for the kick, and before the layer of the second hand, which
/// then follows the object.
///
/// Between kicks, the offset obeys the critically damped spring `x″ = −ω²x − 2ωx′`. It is advanced by the exact
/// solution, so that the motion does not depend on the frame rate.
///
/// ```
/// use aim_animation::glam::{Affine3A, Quat, Vec3};
/// use aim_animation::{Bone, Figure, Recoil, Skeleton, Transform};
///
/// let at = |z| Transform::from_translation(Vec3::Z * z);
/// let bent = Transform { rotation: Quat::from_rotation_x(0.5), ..at(0.3) };
/// let bones = [("upper_arm", None, at(0.0)), ("forearm", Some(0), bent), ("hand", Some(1), at(0.3))];
/// let skeleton = Skeleton::new(bones.map(|(name, parent, rest)| Bone::new(name, parent).with_rest(rest)))?;
/// let mut recoil = Recoil::new(&skeleton, [0, 1, 2], Affine3A::IDENTITY)?;
/// let mut figure = Figure::new(skeleton);
/// let before = figure.model()[2].translation;
/// // Back along the barrel, which climbs.
/// recoil.kick(Vec3::NEG_Z, Vec3::NEG_X);
/// figure.run(0.03, &mut [&mut recoil])?;
/// assert!(figure.model()[2].translation.distance(before) > 0.01);
/// (0..60).try_for_each(|_| figure.run(1.0 / 60.0, &mut [&mut recoil]))?;
/// assert!(figure.model()[2].translation.distance(before) < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Recoil {
    /// Angular frequency ω of the spring, 1/s. After a kick from rest, the offset peaks 1/ω seconds later. Default 15.
    ///
    /// If it is not positive and finite, the offset returns to zero at once.
    pub rate: f32,
    limb: Limb,
    joints: Vec<CcdJoint>,
    grip: Affine3A,
    /// Offset of the object in its own space: translation and rotation vector.
    offset: [Vec3; 2],
    /// Velocity of both parts of the offset, per second.
    velocity: [Vec3; 2],
}

impl Recoil {
    /// Creates a layer for an object held by the tip of a limb, given as bones from its first joint to its tip. `grip`
    /// is the object's transform in the space of the tip's bone.
    ///
    /// # Errors
    /// Fails if a bone is missing or out of order, or if two consecutive bones coincide in the rest pose: see
    /// [`LimbError`].
    pub fn new(skeleton: &Skeleton, limb: impl Into<Vec<usize>>, grip: Affine3A) -> Result<Self, LimbError> {
        let (limb, joints) = Limb::at_rest(skeleton, limb.into())?;
        Ok(Self { rate: 15.0, limb, joints, grip, offset: [Vec3::ZERO; 2], velocity: [Vec3::ZERO; 2] })
    }

    /// Adds a velocity, model units per second, and an angular velocity, radians per second, both in the object's own
    /// space.
    ///
    /// From rest, the offset peaks at velocity / (e·ω). A sum that is not finite is ignored.
    pub fn kick(&mut self, velocity: Vec3, turning: Vec3) {
        for (own, kick) in self.velocity.iter_mut().zip([velocity, turning]) {
            if (*own + kick).is_finite() {
                *own += kick;
            }
        }
    }

    /// Returns the current offset, in the object's own space.
    #[must_use]
    pub fn offset(&self) -> Transform {
        Transform::new(self.offset[0], exp(self.offset[1]))
    }

    /// Advances offset and velocity by the exact solution of the spring: with s = v₀ + ω·x₀,
    /// x = (x₀ + s·t)·e^(−ωt) and v = s·e^(−ωt) − ω·x.
    fn advance(&mut self, dt_s: f32) {
        let dt = if dt_s.is_finite() { dt_s.max(0.0) } else { 0.0 };
        let is_sprung = self.rate > 0.0 && self.rate.is_finite();
        let left = if is_sprung { decay(self.rate * dt) } else { 0.0 };
        for (offset, velocity) in self.offset.iter_mut().zip(&mut self.velocity) {
            let slope = *velocity + *offset * self.rate;
            *offset = (*offset + slope * dt) * left;
            *velocity = slope * left - *offset * self.rate;
            if !(is_sprung && offset.is_finite() && velocity.is_finite()) {
                (*offset, *velocity) = (Vec3::ZERO, Vec3::ZERO);
            }
        }
    }
}

impl Layer for Recoil {
    fn apply(&mut self, figure: &mut Figure, dt_s: f32) -> Result<(), PoseError> {
        check_length(self.limb.bones(), figure.model().len())?;
        self.advance(dt_s);
        if self.offset == [Vec3::ZERO; 2] {
            return Ok(());
        }
        let tip = figure.model()[self.limb.tip_bone()];
        let thing = Transform::from_affine(&attached(&tip, &self.grip));
        let Some((thing, hand)) = thing.zip(Transform::from_affine(&tip)) else { return Ok(()) };
        // The kicked hand: thing · offset · (thing⁻¹ · hand).
        let hand_in_thing = thing.rigid_inverse().rigid_product(&hand);
        let kicked = thing.rigid_product(&self.offset()).rigid_product(&hand_in_thing);
        let turn = product(kicked.rotation, hand.rotation.conjugate());
        let goal = TipGoal { point: kicked.translation, turn: Some(turn), two_bone: &TwoBone::new() };
        self.limb.follow(&goal, &mut self.joints, &mut figure.pose_pair())?;
        Ok(())
    }
}
