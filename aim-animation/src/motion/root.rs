//! [`Root`] and [`RootPath`]: the root of a character and its path over a clip.

use alloc::vec::Vec;

use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::rotation::{dot, product, unit};

use super::error::MotionError;
use crate::clip::{Clip, sample_times};
use crate::skeleton::Skeleton;
use crate::track::Track;
use crate::transform::{Transform, made_unit};

/// Definition of the root that moves a character: a bone, or the projection of a bone on the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Root {
    /// All movement of a bone, such as the pelvis or a bone added as root.
    Bone(usize),
    /// Shadow of a bone, such as the pelvis, on the ground: its position without its height, and its rotation about the
    /// vertical. Bobbing and leaning stay in the clip.
    Shadow {
        /// The bone whose shadow it is.
        bone: usize,
        /// Up direction in model space, of any length.
        up: Vec3,
    },
}

/// Path of a character's root over a clip, in model space: samples with linear interpolation.
#[derive(Clone, Debug, PartialEq)]
pub struct RootPath {
    pub(super) bone: usize,
    pub(super) translation: Track<Vec3>,
    pub(super) rotation: Track<Quat>,
    pub(super) length_s: f64,
}

impl RootPath {
    /// Samples a clip at least `rate_hz` times a second, including its beginning and its end.
    ///
    /// # Errors
    /// See [`MotionError`] for the conditions.
    pub fn new(clip: &Clip, skeleton: &Skeleton, root: Root, rate_hz: f32) -> Result<Self, MotionError> {
        let (Root::Bone(bone) | Root::Shadow { bone, .. }) = root;
        let length = clip.length_s();
        if !(length > 0.0 && length.is_finite() && rate_hz > 0.0 && rate_hz.is_finite()) {
            return Err(MotionError::Length);
        }
        if bone >= skeleton.len() {
            return Err(MotionError::Bone(bone));
        }
        let mut sampler = Sampler { clip, skeleton, bone, pose: Vec::new(), model: Vec::new() };
        sampler.model.resize(skeleton.len(), Affine3A::IDENTITY);
        let rest = sampler.rest().ok_or(MotionError::Place)?;
        let shadow = match root {
            Root::Bone(_) => None,
            Root::Shadow { up, .. } => Some(Shadow::new(up, rest.rotation)?),
        };
        let times = sample_times(length, rate_hz);
        let (mut places, mut rotations) = (Vec::new(), Vec::<Quat>::new());
        for time in &times {
            let mut at = sampler.at(*time).ok_or(MotionError::Place)?;
            if let Some(shadow) = &shadow {
                at = shadow.cast(&at, rotations.last().copied().unwrap_or(Quat::IDENTITY));
            }
            places.push(at.translation);
            rotations.push(at.rotation);
        }
        let translation = Track::linear(times.clone(), places).map_err(|_| MotionError::Place)?;
        let rotation = Track::linear(times, rotations).map_err(|_| MotionError::Place)?;
        Ok(Self { bone, translation, rotation, length_s: f64::from(length) })
    }

    /// Returns the root's transform at a time, without scale; times are clamped to the clip.
    #[must_use]
    pub fn at(&self, time_s: f32) -> Transform {
        Transform::new(self.translation.sample(time_s), self.rotation.sample(time_s))
    }
}

/// Samples a bone in model space.
struct Sampler<'a> {
    clip: &'a Clip,
    skeleton: &'a Skeleton,
    bone: usize,
    pose: Vec<Transform>,
    model: Vec<Affine3A>,
}

impl Sampler<'_> {
    fn rest(&mut self) -> Option<Transform> {
        self.pose = self.skeleton.rest().to_vec();
        self.placed()
    }

    fn at(&mut self, time_s: f32) -> Option<Transform> {
        self.pose.copy_from_slice(self.skeleton.rest());
        self.clip.sample(time_s, &mut crate::cursor::Cursor::default(), &mut self.pose);
        self.placed()
    }

    /// Returns the bone's transform in model space, without scale.
    fn placed(&mut self) -> Option<Transform> {
        self.skeleton.to_model(&self.pose, &mut self.model).ok()?;
        let Transform { translation, rotation, .. } = Transform::from_affine(&self.model[self.bone])?;
        Some(Transform::new(translation, rotation))
    }
}

/// Projection of a bone on the ground.
struct Shadow {
    up: Vec3,
    /// Inverse of the bone's rotation at rest.
    from_rest: Quat,
}

impl Shadow {
    fn new(up: Vec3, rest: Quat) -> Result<Self, MotionError> {
        // `unit` also handles very large and very small vectors.
        let up = unit(Quat::from_xyzw(up.x, up.y, up.z, 0.0)).ok_or(MotionError::Up)?;
        Ok(Self { up: Vec3::new(up.x, up.y, up.z), from_rest: rest.conjugate() })
    }

    /// Projects the position on the ground, and keeps of the rotation from rest its twist about the vertical. Half a
    /// turn about a horizontal axis has no twist; then the rotation `before` is kept.
    fn cast(&self, bone: &Transform, before: Quat) -> Transform {
        let place = bone.translation - self.up * bone.translation.dot(self.up);
        let turn = product(bone.rotation, self.from_rest);
        let twist = self.up * Vec3::new(turn.x, turn.y, turn.z).dot(self.up);
        let twist = Quat::from_xyzw(twist.x, twist.y, twist.z, turn.w);
        let rotation = if dot(twist, twist) > 1e-6 { made_unit(twist) } else { before };
        Transform::new(place, rotation)
    }
}
