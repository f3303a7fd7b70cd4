//! What the solvers need of poses: between local and model space, between two poses, and things that are held.

use core::fmt;

use glam::{Affine3A, Mat3A, Quat, Vec3};

use super::turn::{self, normalized, part};
use crate::math::{self, product};

/// A bone's transform in its parent's space, by its parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Local {
    /// Where the bone is.
    pub translation: Vec3,
    /// How it is turned; unit.
    pub rotation: Quat,
    /// How it is scaled, along its own axes; negative where it is mirrored.
    pub scale: Vec3,
}

impl Default for Local {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Local {
    /// Where and as the parent is.
    pub const IDENTITY: Self = Self { translation: Vec3::ZERO, rotation: Quat::IDENTITY, scale: Vec3::ONE };

    /// The whole transform.
    pub fn to_affine(&self) -> Affine3A {
        let [x, y, z] = Mat3A::from_quat(self.rotation).to_cols_array_2d().map(Vec3::from_array);
        let Vec3 { x: by_x, y: by_y, z: by_z } = self.scale;
        let matrix3 = Mat3A::from_cols((x * by_x).into(), (y * by_y).into(), (z * by_z).into());
        Affine3A { matrix3, translation: self.translation.into() }
    }

    /// The parts of a transform; `None` where it does not span space or is not finite. Shear is lost, and a mirror becomes
    /// one along x.
    pub fn from_affine(transform: &Affine3A) -> Option<Self> {
        let m = transform.matrix3;
        let mut frame = math::orthonormal(m)?;
        let mut scale = Vec3::new(math::length(m.x_axis), math::length(m.y_axis), math::length(m.z_axis));
        if math::cross(frame.x_axis, frame.y_axis).dot(frame.z_axis) < 0.0 {
            frame.x_axis = -frame.x_axis;
            scale.x = -scale.x;
        }
        let local =
            Self { translation: transform.translation.into(), rotation: turn::unit(Quat::from_mat3a(&frame))?, scale };
        (local.translation.is_finite() && local.scale.is_finite()).then_some(local)
    }

    /// This, as far as `weight` goes towards `other`.
    fn towards(&self, other: &Self, weight: f32) -> Self {
        Self {
            translation: lerp(self.translation, other.translation, weight),
            rotation: nlerp(self.rotation, other.rotation, weight),
            scale: lerp(self.scale, other.scale, weight),
        }
    }
}

/// Why poses do not fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PoseError {
    /// The slices differ in length.
    Lengths,
    /// This bone's parent does not stand before it.
    ParentAfter(usize),
    /// This bone's transform does not span space, or is not finite.
    Flat(usize),
}

impl fmt::Display for PoseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lengths => f.write_str("the slices differ in length; give one element a bone"),
            Self::ParentAfter(bone) => {
                write!(f, "the parent of bone {bone} does not stand before it; sort parents first")
            }
            Self::Flat(bone) => {
                write!(f, "the transform of bone {bone} is flat or not finite; its scale may not be zero")
            }
        }
    }
}

impl core::error::Error for PoseError {}

/// Each bone's transform in the space of the model, from those in their parents' spaces.
///
/// ```
/// use aim_runtime::glam::{Affine3A, Quat, Vec3};
/// use aim_runtime::ik::{Local, to_model};
///
/// let arm = Local { rotation: Quat::from_rotation_z(core::f32::consts::FRAC_PI_2), ..Local::IDENTITY };
/// let hand = Local { translation: Vec3::X, ..Local::IDENTITY };
/// let mut model = [Affine3A::IDENTITY; 2];
/// to_model(&[None, Some(0)], &[arm, hand], &mut model)?;
/// assert!(Vec3::from(model[1].translation).distance(Vec3::Y) < 1e-6);
/// # Ok::<(), aim_runtime::ik::PoseError>(())
/// ```
///
/// # Errors
/// The slices differ in length, or a parent does not stand before its child; then nothing is written.
pub fn to_model(parents: &[Option<usize>], local: &[Local], model: &mut [Affine3A]) -> Result<(), PoseError> {
    check(parents, local.len(), model.len())?;
    for (bone, parent) in parents.iter().enumerate() {
        let local = local[bone].to_affine();
        model[bone] = match parent {
            Some(parent) => model[*parent] * local,
            None => local,
        };
    }
    Ok(())
}

/// Each bone's transform in its parent's space, from those in the space of the model. The shear that turned bones under
/// a parent of uneven scale have in model space is lost.
///
/// # Errors
/// The slices differ in length, a parent does not stand before its child, or a bone is flat; then nothing is written.
pub fn to_local(parents: &[Option<usize>], model: &[Affine3A], local: &mut [Local]) -> Result<(), PoseError> {
    check(parents, model.len(), local.len())?;
    let of = |bone: usize| {
        let inverse = |parent: usize| -> Option<Affine3A> {
            math::orthonormal(model[parent].matrix3)?;
            Some(crate::kinematics::chain::inverse(&model[parent]))
        };
        match parents[bone] {
            Some(parent) => Local::from_affine(&(inverse(parent)? * model[bone])),
            None => Local::from_affine(&model[bone]),
        }
    };
    if let Some(flat) = (0..local.len()).find(|&bone| of(bone).is_none()) {
        return Err(PoseError::Flat(flat));
    }
    for (bone, local) in local.iter_mut().enumerate() {
        *local = of(bone).ok_or(PoseError::Flat(bone))?;
    }
    Ok(())
}

fn check(parents: &[Option<usize>], from: usize, to: usize) -> Result<(), PoseError> {
    if parents.len() != from || from != to {
        return Err(PoseError::Lengths);
    }
    let unsorted = parents.iter().enumerate().find(|(bone, parent)| parent.is_some_and(|parent| parent >= *bone));
    unsorted.map_or(Ok(()), |(bone, _)| Err(PoseError::ParentAfter(bone)))
}

/// Between two rotations in a straight line, made a unit again: the short way, a little faster in the middle; `a` at 0.
/// Weights count as within 0…1, NaN as 0; a quaternion without length or not finite as the identity.
pub fn nlerp(a: Quat, b: Quat, weight: f32) -> Quat {
    let [a, b] = [a, b].map(|turn| turn::unit(turn).unwrap_or(Quat::IDENTITY));
    let weight = clamped(weight);
    let b = if turn::dot(a, b) < 0.0 { -b } else { b };
    // Of two in one hemisphere the sum is at least √½ long.
    normalized(a * (1.0 - weight) + b * weight)
}

/// Between two rotations at constant speed, the short way; else as [`nlerp`].
pub fn slerp(a: Quat, b: Quat, weight: f32) -> Quat {
    let [a, b] = [a, b].map(|turn| turn::unit(turn).unwrap_or(Quat::IDENTITY));
    normalized(product(part(normalized(product(b, a.conjugate())), clamped(weight)), a))
}

/// Moves `pose` towards `other` by `weight`, times each bone's own where there is a mask: at 1 a bone is `other`'s, at 0 it
/// is left alone. Rotations by [`nlerp`].
///
/// # Errors
/// The slices differ in length; then nothing is written.
pub fn blend(pose: &mut [Local], other: &[Local], weight: f32, mask: Option<&[f32]>) -> Result<(), PoseError> {
    combine(pose, other, weight, mask, Local::towards)
}

/// Adds a pose of differences as [`difference`] makes them, by `weight`, times each bone's own where there is a mask.
///
/// # Errors
/// The slices differ in length; then nothing is written.
pub fn add(pose: &mut [Local], differences: &[Local], weight: f32, mask: Option<&[f32]>) -> Result<(), PoseError> {
    combine(pose, differences, weight, mask, |bone, added, weight| {
        let added = Local::IDENTITY.towards(added, weight);
        Local {
            translation: bone.translation + added.translation,
            rotation: turn::unit(product(bone.rotation, added.rotation)).unwrap_or(Quat::IDENTITY),
            scale: bone.scale * added.scale,
        }
    })
}

/// What [`add`]ed to `from` gives `to`. A scale of 0 in `from` counts as unchanged.
pub fn difference(from: &Local, to: &Local) -> Local {
    let ratio = |to: f32, from: f32| if from == 0.0 { 1.0 } else { to / from };
    Local {
        translation: to.translation - from.translation,
        rotation: turn::unit(product(from.rotation.conjugate(), to.rotation)).unwrap_or(Quat::IDENTITY),
        scale: Vec3::new(
            ratio(to.scale.x, from.scale.x),
            ratio(to.scale.y, from.scale.y),
            ratio(to.scale.z, from.scale.z),
        ),
    }
}

fn combine(
    pose: &mut [Local],
    other: &[Local],
    weight: f32,
    mask: Option<&[f32]>,
    with: impl Fn(&Local, &Local, f32) -> Local,
) -> Result<(), PoseError> {
    if pose.len() != other.len() || mask.is_some_and(|mask| mask.len() != pose.len()) {
        return Err(PoseError::Lengths);
    }
    for (index, (bone, other)) in pose.iter_mut().zip(other).enumerate() {
        let weight = clamped(weight) * mask.map_or(1.0, |mask| clamped(mask[index]));
        if weight > 0.0 {
            *bone = with(bone, other, weight);
        }
    }
    Ok(())
}

/// Where a thing is that is held: a gun in a hand. `bone` is the bone that holds it, `grip` how it stands in that bone.
pub fn attached(bone: &Affine3A, grip: &Affine3A) -> Affine3A {
    *bone * *grip
}

/// Where a character has to be so that what it holds on to stays: someone hanging off a bridge. `attachment` is the
/// attachment point in the space of the model, `held` where it shall be in the world; the answer places the model in the
/// world. `None` where `attachment` does not span space.
pub fn root_for(attachment: &Affine3A, held: &Affine3A) -> Option<Affine3A> {
    math::orthonormal(attachment.matrix3)?;
    let root = *held * crate::kinematics::chain::inverse(attachment);
    root.is_finite().then_some(root)
}

/// 0…1; NaN counts as 0.
fn clamped(weight: f32) -> f32 {
    weight.max(0.0).min(1.0)
}

/// Exact at both ends.
fn lerp(a: Vec3, b: Vec3, weight: f32) -> Vec3 {
    a * (1.0 - weight) + b * weight
}
