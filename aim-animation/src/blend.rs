//! [`Blender`]: blends two poses, sums any number of weighted poses, and adds difference poses.

use aim_runtime::glam::{Quat, Vec3};
use aim_runtime::rotation::{dot, exp, log, nlerp, product, slerp};

use crate::mask::{LEAST_WEIGHT, Mask, clamped};
use crate::pose::{PoseError, check_length};
use crate::skeleton::Skeleton;
use crate::transform::{Transform, made_unit};

/// Method of interpolating rotations. For small angles all methods give nearly the same result.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Normalised linear interpolation: along the shorter arc, not at constant speed, cheap.
    ///
    /// In a [weighted sum](Blender::sum), quaternions are first flipped into the hemisphere of the rest rotation.
    #[default]
    Nlerp,
    /// Spherical linear interpolation: along the shorter arc, at constant speed.
    ///
    /// A [weighted sum](Blender::sum) uses [`Nlerp`](Self::Nlerp) instead, since slerp is defined for two rotations
    /// only.
    Slerp,
    /// Linear interpolation of rotation vectors (logarithms) relative to the rest pose.
    ///
    /// Not always along the shorter arc. The formula is the same for any number of poses.
    Log,
}

/// Blends local poses of one skeleton, given as slices, without allocating.
///
/// Weights are clamped to 0…1; NaN is treated as 0. A mask multiplies the weight of each bone.
///
/// ```
/// use aim_animation::glam::Vec3;
/// use aim_animation::{Blender, Bone, Skeleton, Transform};
///
/// let skeleton = Skeleton::new([Bone::new("hips", None)])?;
/// let [a, b, c] = [0.0, 1.0, 5.0].map(|x| [Transform::from_translation(Vec3::X * x)]);
/// let mut pose = a;
/// let blender = Blender::new(&skeleton);
/// blender.blend(&mut pose, &b, 0.25)?;
/// assert_eq!(pose[0].translation.x, 0.25);
/// // (½·0 + ½·1 + 1·5) / 2, whatever the order.
/// blender.sum(&[(&a, 0.5), (&b, 0.5), (&c, 1.0)], &mut pose)?;
/// assert_eq!(pose[0].translation.x, 2.75);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Blender<'a> {
    skeleton: &'a Skeleton,
    method: Method,
    mask: Option<&'a Mask>,
}

impl<'a> Blender<'a> {
    /// Creates a blender without a mask that interpolates rotations by [`Method::Nlerp`].
    #[must_use]
    pub fn new(skeleton: &'a Skeleton) -> Self {
        Self { skeleton, method: Method::default(), mask: None }
    }

    /// Sets the method of interpolating rotations.
    #[must_use]
    pub fn with_method(mut self, method: Method) -> Self {
        self.method = method;
        self
    }

    /// Sets a mask, which must belong to the same skeleton.
    #[must_use]
    pub fn with_mask(mut self, mask: &'a Mask) -> Self {
        self.mask = Some(mask);
        self
    }

    /// Interpolates `pose` towards `other` by `weight`: 0 leaves a bone unchanged, 1 copies the bone of `other`.
    ///
    /// With a mask and a weight of 1, the mask alone decides how much of `other` each bone takes.
    ///
    /// # Errors
    /// Fails if a slice or the mask differs in length from the skeleton. Nothing is written then.
    pub fn blend(&self, pose: &mut [Transform], other: &[Transform], weight: f32) -> Result<(), PoseError> {
        self.check(pose.len())?;
        self.check(other.len())?;
        let (rest, weight) = (self.skeleton.rest(), clamped(weight));
        for (bone, (pose, other)) in pose.iter_mut().zip(other).enumerate() {
            let weight = weight * self.mask_weight(bone);
            *pose = blended([pose, other, &rest[bone]], weight, self.method);
        }
        Ok(())
    }

    /// Adds a difference pose, as computed by [`difference`](Self::difference), scaled by `weight`.
    ///
    /// Per bone: adds the translation, multiplies the rotation on the right, and multiplies the scale.
    ///
    /// ```
    /// use aim_animation::glam::Vec3;
    /// use aim_animation::{Blender, Bone, Skeleton, Transform};
    ///
    /// // What breathing changes, added to a chest that is elsewhere.
    /// let skeleton = Skeleton::new([Bone::new("chest", None)])?;
    /// let [out, full, mut walking] = [1.0, 1.25, 3.0].map(|y| [Transform::from_translation(Vec3::Y * y)]);
    /// let (blender, mut breath) = (Blender::new(&skeleton), [Transform::IDENTITY]);
    /// blender.difference(&out, &full, &mut breath)?;
    /// blender.add(&mut walking, &breath, 0.5)?;
    /// assert_eq!(walking[0].translation.y, 3.125);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Fails if a slice or the mask differs in length from the skeleton. Nothing is written then.
    pub fn add(&self, pose: &mut [Transform], differences: &[Transform], weight: f32) -> Result<(), PoseError> {
        self.check(pose.len())?;
        self.check(differences.len())?;
        let weight = clamped(weight);
        for (bone, (pose, added)) in pose.iter_mut().zip(differences).enumerate() {
            let weight = weight * self.mask_weight(bone);
            *pose = added_to(pose, added, weight, self.method);
        }
        Ok(())
    }

    /// Writes the difference pose that gives `to` when [added](Self::add) to `from` with weight 1.
    ///
    /// Where a component of the scale is 0 in `from`, its difference is the factor 1. The mask is ignored.
    ///
    /// # Errors
    /// Fails if a slice differs in length from the skeleton. Nothing is written then.
    pub fn difference(&self, from: &[Transform], to: &[Transform], out: &mut [Transform]) -> Result<(), PoseError> {
        [from.len(), to.len(), out.len()].into_iter().try_for_each(|len| check_length(self.skeleton.len(), len))?;
        for ((from, to), out) in from.iter().zip(to).zip(out) {
            *out = difference(from, to);
        }
        Ok(())
    }

    /// Writes the weighted mean of any number of poses, Σ wᵢ·poseᵢ / Σ wᵢ, bone by bone. The order of the poses does
    /// not matter.
    ///
    /// - If the weights sum to 0, the result is the rest pose.
    /// - Rotations are averaged as quaternions in the hemisphere of the rest rotation, so that `q` and `-q` give the
    ///   same result, or as rotation vectors with [`Method::Log`].
    /// - A mask blends the result towards the rest pose: at 0, a bone is at rest.
    ///
    /// # Errors
    /// Fails if a slice or the mask differs in length from the skeleton. Nothing is written then.
    pub fn sum(&self, poses: &[(&[Transform], f32)], out: &mut [Transform]) -> Result<(), PoseError> {
        poses.iter().try_for_each(|(pose, _)| self.check(pose.len()))?;
        self.check(out.len())?;
        for (bone, (out, rest)) in out.iter_mut().zip(self.skeleton.rest()).enumerate() {
            let mut sum = BoneSum::ZERO;
            for (pose, weight) in poses {
                sum.add(&pose[bone], rest, clamped(*weight), self.method);
            }
            let sum = sum.finish(rest, self.method);
            *out = match self.mask_weight(bone) {
                1.0 => sum,
                weight => interpolated(rest, &sum, weight, |a, b| nlerp(a, b, weight)),
            };
        }
        Ok(())
    }

    fn mask_weight(&self, bone: usize) -> f32 {
        self.mask.map_or(1.0, |mask| mask.weights()[bone])
    }

    fn check(&self, len: usize) -> Result<(), PoseError> {
        self.mask.map_or(Ok(()), |mask| check_length(self.skeleton.len(), mask.weights().len()))?;
        check_length(self.skeleton.len(), len)
    }
}

/// Interpolates from `a` to `b` by a weight; `rest` is the rest transform, which [`Method::Log`] needs.
pub(crate) fn blended([a, b, rest]: [&Transform; 3], weight: f32, method: Method) -> Transform {
    if !(weight > 0.0) {
        return *a;
    }
    interpolated(a, b, weight, |a, b| match method {
        Method::Nlerp => nlerp(a, b, weight),
        Method::Slerp => slerp(a, b, weight),
        Method::Log => by_logs(rest.rotation, a, b, weight),
    })
}

/// Adds a difference, scaled by a weight, to a transform.
pub(crate) fn added_to(to: &Transform, difference: &Transform, weight: f32, method: Method) -> Transform {
    if !(weight > 0.0) {
        return *to;
    }
    let part = interpolated(&Transform::IDENTITY, difference, weight, |a, b| match method {
        Method::Nlerp => nlerp(a, b, weight),
        Method::Slerp | Method::Log => slerp(a, b, weight),
    });
    Transform {
        translation: to.translation + part.translation,
        rotation: made_unit(product(to.rotation, part.rotation)),
        scale: to.scale * part.scale,
    }
}

/// Returns the difference that gives `to` when it is added to `from`.
pub(crate) fn difference(from: &Transform, to: &Transform) -> Transform {
    let ratio = |to: f32, from: f32| if from == 0.0 { 1.0 } else { to / from };
    let (a, b) = (from.scale, to.scale);
    Transform {
        translation: to.translation - from.translation,
        rotation: made_unit(product(from.rotation.conjugate(), to.rotation)),
        scale: Vec3::new(ratio(b.x, a.x), ratio(b.y, a.y), ratio(b.z, a.z)),
    }
}

/// Interpolates translation and scale linearly, exactly at both ends, and the rotation by a closure.
fn interpolated(a: &Transform, b: &Transform, weight: f32, rotation: impl Fn(Quat, Quat) -> Quat) -> Transform {
    let lerp = |a: Vec3, b: Vec3| a * (1.0 - weight) + b * weight;
    Transform {
        translation: lerp(a.translation, b.translation),
        rotation: rotation(a.rotation, b.rotation),
        scale: lerp(a.scale, b.scale),
    }
}

/// Interpolates rotation vectors relative to rest: R·exp((1 − w)·log(R⁻¹·a) + w·log(R⁻¹·b)), with R the rest rotation.
fn by_logs(rest: Quat, a: Quat, b: Quat, weight: f32) -> Quat {
    let [a, b] = [a, b].map(|rotation| log(product(rest.conjugate(), rotation)));
    made_unit(product(rest, exp(a * (1.0 - weight) + b * weight)))
}

/// Running weighted sum of one bone's transforms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BoneSum {
    translation: Vec3,
    scale: Vec3,
    /// Weighted sum of quaternions in the hemisphere of the rest rotation; with [`Method::Log`], of rotation vectors
    /// relative to rest, in x, y and z.
    rotation: Quat,
    weight: f32,
}

impl BoneSum {
    pub(crate) const ZERO: Self =
        Self { translation: Vec3::ZERO, scale: Vec3::ZERO, rotation: Quat::from_xyzw(0.0, 0.0, 0.0, 0.0), weight: 0.0 };

    pub(crate) fn add(&mut self, transform: &Transform, rest: &Transform, weight: f32, method: Method) {
        if !(weight > 0.0) {
            return;
        }
        self.translation += transform.translation * weight;
        self.scale += transform.scale * weight;
        self.weight += weight;
        let rotation = match method {
            Method::Nlerp | Method::Slerp => in_hemisphere(made_unit(transform.rotation), rest.rotation),
            Method::Log => {
                let vector = log(product(rest.rotation.conjugate(), transform.rotation));
                Quat::from_xyzw(vector.x, vector.y, vector.z, 0.0)
            }
        };
        self.rotation += rotation * weight;
    }

    pub(crate) fn finish(&self, rest: &Transform, method: Method) -> Transform {
        if !(self.weight >= LEAST_WEIGHT) {
            return *rest;
        }
        let rotation = match method {
            Method::Nlerp | Method::Slerp => aim_runtime::rotation::unit(self.rotation).unwrap_or(rest.rotation),
            Method::Log => {
                let vector = Vec3::new(self.rotation.x, self.rotation.y, self.rotation.z) / self.weight;
                made_unit(product(rest.rotation, exp(vector)))
            }
        };
        Transform { translation: self.translation / self.weight, scale: self.scale / self.weight, rotation }
    }
}

/// Returns `rotation` or `-rotation`, whichever lies in the hemisphere of `like`. If the two rotations are half a turn
/// apart, returns the one whose first non-zero component is positive.
fn in_hemisphere(rotation: Quat, like: Quat) -> Quat {
    let side = dot(rotation, like);
    let is_flipped = if side == 0.0 {
        rotation.to_array().into_iter().find(|part| *part != 0.0).is_some_and(|part| part < 0.0)
    } else {
        side < 0.0
    };
    if is_flipped { -rotation } else { rotation }
}
