//! [`Root`] and [`RootPath`]: what of a character moves it, and its way over a clip.

use alloc::vec::Vec;

use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::rotation::{dot, product, unit};

use super::error::MotionError;
use crate::clip::{Clip, sample_times};
use crate::skeleton::Skeleton;
use crate::track::Track;
use crate::transform::{Transform, made_unit};

/// The root that moves a character: a bone of its skeleton, or one that no bone is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Root {
    /// A bone, with all its movement: a root bone made for this, or the pelvis.
    Bone(usize),
    /// The shadow of a bone, such as the pelvis, on the ground: its place without its height, and its turning about the vertical. Its
    /// bobbing and leaning stay in the clip.
    Shadow {
        /// The bone.
        bone: usize,
        /// The direction up in the space of the model, of any length.
        up: Vec3,
    },
}

/// The way of a character's root over a clip, in the space of the model: sampled once, straight in between.
#[derive(Clone, Debug, PartialEq)]
pub struct RootPath {
    pub(super) bone: usize,
    pub(super) translation: Track<Vec3>,
    pub(super) rotation: Track<Quat>,
    pub(super) length_s: f64,
}

impl RootPath {
    /// Samples a clip at least this often a second, at its beginning and its end.
    ///
    /// # Errors
    /// See [`MotionError`].
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

    /// The root at a time, without scale; times outside the clip count as its ends.
    #[must_use]
    pub fn at(&self, time_s: f32) -> Transform {
        Transform::new(self.translation.sample(time_s), self.rotation.sample(time_s))
    }
}

/// A bone in the space of the model, at any time of a clip.
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

    /// Without scale.
    fn placed(&mut self) -> Option<Transform> {
        self.skeleton.to_model(&self.pose, &mut self.model).ok()?;
        let Transform { translation, rotation, .. } = Transform::from_affine(&self.model[self.bone])?;
        Some(Transform::new(translation, rotation))
    }
}

/// The shadow of a bone on the ground.
struct Shadow {
    up: Vec3,
    /// The inverse of the bone's rotation in the rest pose.
    from_rest: Quat,
}

impl Shadow {
    fn new(up: Vec3, rest: Quat) -> Result<Self, MotionError> {
        // Large and small vectors, too.
        let up = unit(Quat::from_xyzw(up.x, up.y, up.z, 0.0)).ok_or(MotionError::Up)?;
        Ok(Self { up: Vec3::new(up.x, up.y, up.z), from_rest: rest.conjugate() })
    }

    /// The place on the ground, and of the turn from the rest pose the part about the vertical: that of the rotation's twist. Half
    /// a turn about a level axis has none; then it is the one before.
    fn cast(&self, bone: &Transform, before: Quat) -> Transform {
        let place = bone.translation - self.up * bone.translation.dot(self.up);
        let turn = product(bone.rotation, self.from_rest);
        let twist = self.up * Vec3::new(turn.x, turn.y, turn.z).dot(self.up);
        let twist = Quat::from_xyzw(twist.x, twist.y, twist.z, turn.w);
        let rotation = if dot(twist, twist) > 1e-6 { made_unit(twist) } else { before };
        Transform::new(place, rotation)
    }
}
