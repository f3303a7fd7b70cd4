//! [`Mask`]: a weight for each bone.

use alloc::vec::Vec;

use crate::skeleton::Skeleton;

/// A weight in 0…1 for each bone of a skeleton, by which a blend's weight is multiplied: a wave that moves one arm.
///
/// ```
/// use aim_animation::{Bone, Mask, Skeleton};
///
/// let bones = [Bone::new("hips", None), Bone::new("chest", Some(0)), Bone::new("hand", Some(1))];
/// let skeleton = Skeleton::new(bones)?;
/// let upper = Mask::subtree(&skeleton, 1);
/// assert_eq!(upper.weights(), [0.0, 1.0, 1.0]);
/// assert_eq!(upper.with_bone(2, 0.5).inverted().weights(), [1.0, 0.0, 0.5]);
/// # Ok::<(), aim_animation::SkeletonError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Mask {
    weights: Vec<f32>,
}

impl Mask {
    /// The same weight for every bone. Weights are clamped to 0…1; NaN counts as 0.
    #[must_use]
    pub fn new(skeleton: &Skeleton, weight: f32) -> Self {
        Self { weights: alloc::vec![clamped(weight); skeleton.len()] }
    }

    /// 1 for a bone and all that hangs on it, 0 for the others.
    #[must_use]
    pub fn subtree(skeleton: &Skeleton, bone: usize) -> Self {
        Self::new(skeleton, 0.0).with_subtree(skeleton, bone, 1.0)
    }

    /// The same mask with this weight for a bone and all that hangs on it; unchanged if there is no such bone.
    #[must_use]
    pub fn with_subtree(mut self, skeleton: &Skeleton, bone: usize, weight: f32) -> Self {
        if let Some(weights) = self.weights.get_mut(skeleton.subtree(bone)) {
            weights.fill(clamped(weight));
        }
        self
    }

    /// The same mask with this weight for one bone; unchanged if there is no such bone.
    #[must_use]
    pub fn with_bone(mut self, bone: usize, weight: f32) -> Self {
        if let Some(of_bone) = self.weights.get_mut(bone) {
            *of_bone = clamped(weight);
        }
        self
    }

    /// 1 minus each weight: all that this mask leaves alone.
    #[must_use]
    pub fn inverted(mut self) -> Self {
        self.weights.iter_mut().for_each(|weight| *weight = 1.0 - *weight);
        self
    }

    /// Each bone's weight.
    #[must_use]
    pub fn weights(&self) -> &[f32] {
        &self.weights
    }
}

/// Smaller weights count as 0: products with them would have no digits left.
pub(crate) const LEAST_WEIGHT: f32 = 1e-30;

/// 0…1; NaN counts as 0.
pub(crate) fn clamped(weight: f32) -> f32 {
    if weight >= LEAST_WEIGHT { weight.min(1.0) } else { 0.0 }
}
