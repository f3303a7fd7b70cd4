//! [`Model`]: what all characters of a kind share.

use alloc::vec::Vec;

use crate::clip::Clip;
use crate::mask::Mask;
use crate::motion::Motion;
use crate::skeleton::Skeleton;

/// Bones, clips, their root motion, and masks: what all characters of a kind share. Immutable; each character is an
/// [`Instance`](crate::Instance).
///
/// ```
/// use aim_animation::{Bone, Clip, Mask, Model, Skeleton};
///
/// let bones = [Bone::new("hips", None), Bone::new("chest", Some(0)), Bone::new("hand", Some(1))];
/// let skeleton = Skeleton::new(bones)?;
/// let waving = Mask::subtree(&skeleton, 1);
/// let model = Model::new(skeleton, [Clip::new("walk"), Clip::new("wave")]).with_mask(waving);
/// assert_eq!((model.clips()[1].name(), model.masks().len()), ("wave", 1));
/// # Ok::<(), aim_animation::SkeletonError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    skeleton: Skeleton,
    clips: Vec<Clip>,
    motions: Vec<Option<Motion>>,
    masks: Vec<Mask>,
}

impl Model {
    /// A model whose clips stay as they are: without root motion.
    #[must_use]
    pub fn new(skeleton: Skeleton, clips: impl Into<Vec<Clip>>) -> Self {
        let clips = clips.into();
        let motions = alloc::vec![None; clips.len()];
        Self { skeleton, clips, motions, masks: Vec::new() }
    }

    /// With the root motion of a clip, made of that very clip: it is taken out of the poses, and moves the place of the instance.
    /// Nothing is done if there is no such clip.
    #[must_use]
    pub fn with_motion(mut self, clip: usize, motion: Motion) -> Self {
        if let Some(of_clip) = self.motions.get_mut(clip) {
            *of_clip = Some(motion);
        }
        self
    }

    /// With one more mask, which controls name by its number: 0 for the first.
    #[must_use]
    pub fn with_mask(mut self, mask: Mask) -> Self {
        self.masks.push(mask);
        self
    }

    /// The bones.
    #[must_use]
    pub fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }

    /// The clips.
    #[must_use]
    pub fn clips(&self) -> &[Clip] {
        &self.clips
    }

    /// The root motion of a clip, if it has any.
    #[must_use]
    pub fn motion(&self, clip: usize) -> Option<&Motion> {
        self.motions.get(clip)?.as_ref()
    }

    /// The bone by whose weight a clip counts in the movement of the place: that of its own motion, else of the first that any has.
    pub(crate) fn root_bone(&self, clip: usize) -> usize {
        let own = self.motion(clip).or_else(|| self.motions.iter().flatten().next());
        own.map_or(0, Motion::bone)
    }

    /// The masks.
    #[must_use]
    pub fn masks(&self) -> &[Mask] {
        &self.masks
    }
}
