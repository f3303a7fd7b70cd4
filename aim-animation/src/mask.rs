//! [`Mask`]: a blend weight for each bone.

use alloc::vec::Vec;

use crate::skeleton::Skeleton;

/// A weight in 0…1 for each bone of a skeleton, which multiplies the weight of a blend. With it, a wave can move one
/// arm only.
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
    /// A mask with the same weight for every bone. Weights are clamped to 0…1; NaN is treated as 0.
    #[must_use]
    pub fn new(skeleton: &Skeleton, weight: f32) -> Self {
        Self { weights: alloc::vec![clamped(weight); skeleton.len()] }
    }

    /// A mask with weight 1 for a bone and all its descendants, 0 for the others.
    #[must_use]
    pub fn subtree(skeleton: &Skeleton, bone: usize) -> Self {
        Self::new(skeleton, 0.0).with_subtree(skeleton, bone, 1.0)
    }

    /// Sets the weight of a bone and all its descendants; changes nothing if there is no such bone.
    #[must_use]
    pub fn with_subtree(mut self, skeleton: &Skeleton, bone: usize, weight: f32) -> Self {
        if let Some(weights) = self.weights.get_mut(skeleton.subtree(bone)) {
            weights.fill(clamped(weight));
        }
        self
    }

    /// Sets the weight of one bone; changes nothing if there is no such bone.
    #[must_use]
    pub fn with_bone(mut self, bone: usize, weight: f32) -> Self {
        if let Some(of_bone) = self.weights.get_mut(bone) {
            *of_bone = clamped(weight);
        }
        self
    }

    /// Returns the mask with 1 minus each weight.
    #[must_use]
    pub fn inverted(mut self) -> Self {
        self.weights.iter_mut().for_each(|weight| *weight = 1.0 - *weight);
        self
    }

    /// Weight of each bone.
    #[must_use]
    pub fn weights(&self) -> &[f32] {
        &self.weights
    }
}

/// Smallest weight that is not treated as 0: products with smaller ones would lose all precision.
pub(crate) const LEAST_WEIGHT: f32 = 1e-30;

/// Clamps a weight to 0…1; NaN becomes 0.
pub(crate) fn clamped(weight: f32) -> f32 {
    if weight >= LEAST_WEIGHT { weight.min(1.0) } else { 0.0 }
}
