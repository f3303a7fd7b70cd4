//! [`AimPoseSet`] and [`AimPosesLayer`]: poses of a clip that aim, blended by where they shall.

use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt;

use aim_runtime::glam::{Affine3A, Quat, Vec3, Vec3A};
use aim_runtime::ik::{AimPose, AimPoses, AimPosesOutcome, Blend, triangulated};
use aim_runtime::rotation::{dot, inverse, length};

use crate::blend::{Method, blended};
use crate::clip::Clip;
use crate::cursor::Cursor;
use crate::figure::{Figure, Layer};
use crate::mask::{Mask, clamped};
use crate::pose::{PoseError, check_length};
use crate::skeleton::Skeleton;
use crate::transform::{Transform, made_unit};

/// Why poses cannot be aimed with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AimPoseError {
    /// There is no such bone to aim by.
    Bone(usize),
    /// This pose aims in no direction, or in that of an earlier one.
    Direction(usize),
    /// The directions span no triangle: they lie on one great circle, or are too few.
    Flat,
}

impl fmt::Display for AimPoseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bone(bone) => write!(f, "there is no bone {bone} to aim by"),
            Self::Direction(pose) => write!(f, "pose {pose} aims in no direction, or in that of an earlier one"),
            Self::Flat => f.write_str("the poses aim along one line; give one above or below it"),
        }
    }
}

impl core::error::Error for AimPoseError {}

/// The line that is aimed: a barrel in the hand that holds it, a gaze in its head.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AimLine {
    /// The bone that it is fixed to.
    pub bone: usize,
    /// Its beginning, in the space of the bone.
    pub origin: Vec3,
    /// Its direction, in the space of the bone, of any length.
    pub forward: Vec3,
}

impl AimLine {
    /// The line by the bones' local transforms, in the space of the model, its direction of length 1; `None` if it has none.
    fn in_model(&self, skeleton: &Skeleton, local: &[Transform]) -> Option<[Vec3A; 2]> {
        let at = skeleton.ancestry(self.bone).fold(Affine3A::IDENTITY, |at, bone| local[bone].to_affine() * at);
        let forward = at.transform_vector3a(self.forward.into());
        let forward = forward / length(forward);
        let origin = at.transform_point3a(self.origin.into());
        (forward.is_finite() && origin.is_finite()).then_some([origin, forward])
    }
}

/// Poses that each aim in a direction, taken from the frames of a clip: of the bones that the clip moves, translations and scales, too.
/// Shared by all characters of a kind; an [`AimPosesLayer`] aims with them.
#[derive(Clone, Debug, PartialEq)]
pub struct AimPoseSet {
    line: AimLine,
    /// The number of bones of the skeleton.
    count: usize,
    /// The bones of the poses, in ascending order, and how much of a pose each takes.
    bones: Vec<(usize, f32)>,
    /// Pose by pose, each bone by bone; rotations in the hemisphere of the first pose's.
    transforms: Vec<Transform>,
    poses: Vec<AimPose<'static>>,
    triangles: Vec<[usize; 3]>,
}

impl AimPoseSet {
    /// The poses of a clip at these times, seconds. Bones that it does not move are at rest where the direction of a pose is measured,
    /// which [`AimPosesLayer`] makes up for. Takes of the order of `n⁴` steps for `n` poses.
    ///
    /// # Errors
    /// See [`AimPoseError`].
    pub fn from_clip(clip: &Clip, skeleton: &Skeleton, times_s: &[f32], line: AimLine) -> Result<Self, AimPoseError> {
        if line.bone >= skeleton.len() {
            return Err(AimPoseError::Bone(line.bone));
        }
        let bones: Vec<(usize, f32)> =
            clip.tracks().iter().map(|tracks| (tracks.bone, 1.0)).filter(|(bone, _)| *bone < skeleton.len()).collect();
        let (mut transforms, mut directions) = (Vec::<Transform>::new(), Vec::new());
        for (number, &time) in times_s.iter().enumerate() {
            let mut local = skeleton.rest().to_vec();
            clip.sample(time, &mut Cursor::default(), &mut local);
            let [_, forward] = line.in_model(skeleton, &local).ok_or(AimPoseError::Direction(number))?;
            if directions.iter().any(|other| length(forward - Vec3A::from(*other)) < 1e-3) {
                return Err(AimPoseError::Direction(number));
            }
            directions.push(Vec3::from(forward));
            for (place, &(bone, _)) in bones.iter().enumerate() {
                let rotation = made_unit(local[bone].rotation);
                let is_far = number > 0 && dot(transforms[place].rotation, rotation) < 0.0;
                transforms.push(Transform { rotation: if is_far { -rotation } else { rotation }, ..local[bone] });
            }
        }
        let mut room = alloc::vec![[0; 3]; 2 * directions.len()];
        let triangles = triangulated(&directions, &mut room).ok_or(AimPoseError::Flat)?.to_vec();
        let poses = directions.into_iter().map(|direction| AimPose { direction, rotations: &[] }).collect();
        Ok(Self { line, count: skeleton.len(), bones, transforms, poses, triangles })
    }

    /// With a mask of the skeleton: how much of a pose each bone takes; those of weight 0 stay as they are animated.
    #[must_use]
    pub fn with_mask(mut self, mask: &Mask) -> Self {
        for (bone, weight) in &mut self.bones {
            *weight = mask.weights().get(*bone).copied().unwrap_or(0.0);
        }
        self
    }

    /// A bone's transform in a blend of poses.
    fn blend(&self, place: usize, blend: &Blend) -> Transform {
        let zero = Quat::from_xyzw(0.0, 0.0, 0.0, 0.0);
        let mut sum = Transform { translation: Vec3::ZERO, rotation: zero, scale: Vec3::ZERO };
        for (pose, weight) in blend.poses.iter().zip(blend.weights) {
            let of = &self.transforms[pose * self.bones.len() + place];
            sum.translation += of.translation * weight;
            sum.rotation += of.rotation * weight;
            sum.scale += of.scale * weight;
        }
        Transform { rotation: made_unit(sum.rotation), ..sum }
    }
}

/// Poses a character so that its line aims at a point of the world, as an animator posed it; comes before the [aim](super::AimLayer)
/// that does the rest.
///
/// The poses that are blended are asked for what the line misses on top, until it is met: see [`AimPoses`].
///
/// ```
/// use aim_animation::glam::{Quat, Vec3};
/// use aim_animation::{AimLine, AimPoseSet, AimPosesLayer, Bone, Clip, Figure, Skeleton, Track};
///
/// let skeleton = Skeleton::new([Bone::new("chest", None)])?;
/// let times = [0.0, 1.0, 2.0, 3.0];
/// let turns = [[-0.8, 0.5], [0.8, 0.5], [-0.8, -0.5], [0.8, -0.5]];
/// let turns = turns.map(|[left, down]| Quat::from_rotation_y(left) * Quat::from_rotation_x(down));
/// let clip = Clip::new("aim").with_rotation(0, Track::linear(times, turns)?);
/// let line = AimLine { bone: 0, origin: Vec3::ZERO, forward: Vec3::Z };
/// let poses = AimPoseSet::from_clip(&clip, &skeleton, &times, line)?;
///
/// let (mut layer, mut figure) = (AimPosesLayer::new(poses), Figure::new(skeleton));
/// layer.target = Vec3::new(0.3, 0.2, 1.0);
/// figure.run(1.0 / 60.0, &mut [&mut layer])?;
/// assert!(figure.model()[0].transform_vector3(Vec3::Z).angle_between(layer.target) < 2e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct AimPosesLayer {
    /// The target, in the world.
    pub target: Vec3,
    /// The part of it all, 0…1; NaN counts as 0. Default 1.
    pub weight: f32,
    set: Arc<AimPoseSet>,
    /// The bones of the poses as animated.
    animated: Vec<Transform>,
    outcome: Option<AimPosesOutcome>,
}

impl AimPosesLayer {
    /// A character's layer, with the world's origin as its target. Give an `Arc` where several share the poses.
    #[must_use]
    pub fn new(set: impl Into<Arc<AimPoseSet>>) -> Self {
        let set = set.into();
        let animated = alloc::vec![Transform::IDENTITY; set.bones.len()];
        Self { target: Vec3::ZERO, weight: 1.0, set, animated, outcome: None }
    }

    /// The outcome of the last frame, as the poses at full weight met the target; `None` before the first one and at weight 0.
    #[must_use]
    pub fn outcome(&self) -> Option<&AimPosesOutcome> {
        self.outcome.as_ref()
    }
}

impl Layer for AimPosesLayer {
    fn apply(&mut self, figure: &mut Figure, _dt_s: f32) -> Result<(), PoseError> {
        let Self { target, weight, set, animated, outcome } = self;
        check_length(set.count, figure.skeleton().len())?;
        *outcome = None;
        let weight = clamped(*weight);
        let target = inverse(&figure.place.to_affine()).map(|to_model| to_model.transform_point3a((*target).into()));
        let Some(target) = target.filter(|target| weight > 0.0 && target.is_finite()) else { return Ok(()) };
        let (skeleton, local, _) = figure.parts_mut();
        let Some([eye, _]) = set.line.in_model(skeleton, local) else { return Ok(()) };
        for (animated, &(bone, _)) in animated.iter_mut().zip(&set.bones) {
            *animated = local[bone];
        }
        let pose = |blend: &Blend, weight: f32, local: &mut [Transform]| {
            for (place, &(bone, of_bone)) in set.bones.iter().enumerate() {
                let posed = set.blend(place, blend);
                local[bone] =
                    blended([&animated[place], &posed, &skeleton.rest()[bone]], of_bone * weight, Method::Nlerp);
            }
        };
        let mut shown = None;
        *outcome = Some(AimPoses::new(&set.poses, &set.triangles).solve_with((target - eye).into(), |blend| {
            shown = Some(*blend);
            pose(blend, 1.0, local);
            let [origin, forward] = set.line.in_model(skeleton, local)?;
            // Seen from where the line began, so that it is met where the line passes through the target.
            Some((origin + forward * length(target - origin) - eye).into())
        }));
        if let Some(blend) = shown {
            pose(&blend, weight, local);
        }
        figure.edit(|_| Ok(()))
    }
}
