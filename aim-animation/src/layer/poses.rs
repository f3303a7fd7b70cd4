//! [`AimPoseSet`] and [`AimPosesLayer`]: poses from a clip that aim in known directions, blended to aim at a target.

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

/// Error of [`AimPoseSet::from_clip`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AimPoseError {
    /// The bone of the [`AimLine`] does not exist.
    Bone(usize),
    /// This pose has no valid aim direction, or the same one as an earlier pose.
    Direction(usize),
    /// The directions do not form a triangle: there are fewer than three, or they lie on one great circle.
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

/// Line to aim, fixed to a bone: the barrel of a gun in a hand, or the gaze of a head.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AimLine {
    /// The bone to which the line is fixed.
    pub bone: usize,
    /// Start point, bone space.
    pub origin: Vec3,
    /// Direction, bone space, of any length but zero.
    pub forward: Vec3,
}

impl AimLine {
    /// Returns origin and unit direction in model space for a local pose; `None` if either is not finite.
    fn in_model(&self, skeleton: &Skeleton, local: &[Transform]) -> Option<[Vec3A; 2]> {
        let at = skeleton.ancestry(self.bone).fold(Affine3A::IDENTITY, |at, bone| local[bone].to_affine() * at);
        let forward = at.transform_vector3a(self.forward.into());
        let forward = forward / length(forward);
        let origin = at.transform_point3a(self.origin.into());
        (forward.is_finite() && origin.is_finite()).then_some([origin, forward])
    }
}

/// Poses that each aim in a known direction, sampled from a clip. Input of [`AimPosesLayer`]; shared by all characters
/// of a kind.
///
/// The poses hold rotation, translation and scale of the bones that the clip moves.
#[derive(Clone, Debug, PartialEq)]
pub struct AimPoseSet {
    line: AimLine,
    /// Number of bones of the skeleton.
    count: usize,
    /// Bones of the poses, in ascending order, each with its mask weight.
    bones: Vec<(usize, f32)>,
    /// Transforms, pose by pose and bone by bone within each. Rotations lie in the hemisphere of the first pose's.
    transforms: Vec<Transform>,
    poses: Vec<AimPose<'static>>,
    triangles: Vec<[usize; 3]>,
}

impl AimPoseSet {
    /// Samples the poses from a clip at these local times, seconds.
    ///
    /// The direction of each pose is measured with all other bones at rest. [`AimPosesLayer`] corrects for the
    /// difference from the actual pose. Takes on the order of `n⁴` steps for `n` poses.
    ///
    /// # Errors
    /// Fails if the line's bone does not exist, if a pose has no direction of its own, or if the directions do not form
    /// a triangle: see [`AimPoseError`].
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

    /// Sets a mask of the skeleton: the weight by which each bone takes the aim pose. Bones of weight 0 keep the
    /// animation.
    #[must_use]
    pub fn with_mask(mut self, mask: &Mask) -> Self {
        for (bone, weight) in &mut self.bones {
            *weight = mask.weights().get(*bone).copied().unwrap_or(0.0);
        }
        self
    }

    /// Returns the transform of the bone at index `place` of the set, in a blend of poses.
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

/// Layer that blends authored poses so that a line of the character aims at a point in world space. Run it before
/// [`AimLayer`](super::AimLayer), which corrects the remaining angle.
///
/// A blend does not aim exactly in the interpolated direction. The requested direction is therefore corrected by the
/// remaining error, iteratively, until the line meets the target: see [`AimPoses`].
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
    /// Target point, world space.
    pub target: Vec3,
    /// Weight of the layer, 0…1; NaN is treated as 0. Default 1.
    pub weight: f32,
    set: Arc<AimPoseSet>,
    /// Scratch memory: animated transforms of the bones of the poses.
    animated: Vec<Transform>,
    outcome: Option<AimPosesOutcome>,
}

impl AimPosesLayer {
    /// Creates a layer for one character, with the world origin as the target. To share a set between characters, pass
    /// an `Arc`.
    #[must_use]
    pub fn new(set: impl Into<Arc<AimPoseSet>>) -> Self {
        let set = set.into();
        let animated = alloc::vec![Transform::IDENTITY; set.bones.len()];
        Self { target: Vec3::ZERO, weight: 1.0, set, animated, outcome: None }
    }

    /// Returns the outcome of the last frame, with the poses at full weight. `None` before the first frame, at weight
    /// 0, and if the target or the line is not finite.
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
            // The direction from the animated origin to the point of the line at the target's distance. It agrees with
            // the wanted direction when the line passes through the target, even if the pose has moved the line's
            // origin.
            Some((origin + forward * length(target - origin) - eye).into())
        }));
        if let Some(blend) = shown {
            pose(&blend, weight, local);
        }
        figure.edit(|_| Ok(()))
    }
}
