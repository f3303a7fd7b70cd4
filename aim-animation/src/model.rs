//! [`Model`]: what all characters of a kind share.

use alloc::vec::Vec;

use crate::clip::Clip;
use crate::cursor::Cursor;
use crate::mask::Mask;
use crate::motion::Motion;
use crate::packed::PackedClip;
use crate::played::Played;
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
    packed: Vec<PackedClip>,
    motions: Vec<Option<Motion>>,
    masks: Vec<Mask>,
    /// At the beginning, with room for any of the clips.
    cursor: Cursor,
}

impl Model {
    /// A model whose clips stay as they are: without root motion.
    #[must_use]
    pub fn new(skeleton: Skeleton, clips: impl Into<Vec<Clip>>) -> Self {
        let clips = clips.into();
        let motions = alloc::vec![None; clips.len()];
        let cursor = clips.iter().fold(Cursor::default(), |cursor, clip| cursor.with_room_of_both(&clip.cursor()));
        Self { skeleton, clips, packed: Vec::new(), motions, masks: Vec::new(), cursor }
    }

    /// With one more clip, played as it is packed. Its number is that behind all others so far.
    ///
    /// ```
    /// use aim_animation::glam::Vec3;
    /// use aim_animation::{Bone, Clip, ClipControl, Instance, Model, Reduction, Skeleton, Track};
    ///
    /// let skeleton = Skeleton::new([Bone::new("hips", None)])?;
    /// let slide = Clip::new("slide").with_translation(0, Track::linear([0.0, 1.0], [Vec3::ZERO, Vec3::X])?);
    /// let packed = Reduction::new(1e-3).pack(&slide, &skeleton)?.clip;
    /// let model = Model::new(skeleton, [Clip::new("idle")]).with_packed(packed);
    /// let mut hero = Instance::new(&model);
    /// hero.play(ClipControl::new(1));
    /// hero.advance(&model, 0.5);
    /// let mut local = model.skeleton().rest().to_vec();
    /// hero.pose(&model, &mut local)?;
    /// assert!(local[0].translation.distance(0.5 * Vec3::X) < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_packed(mut self, clip: PackedClip) -> Self {
        self.cursor = self.cursor.with_room_of_both(&clip.cursor());
        self.packed.push(clip);
        self.motions.push(None);
        self
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

    /// The clips of floats, numbered from 0.
    #[must_use]
    pub fn clips(&self) -> &[Clip] {
        &self.clips
    }

    /// The packed clips, numbered on from those of floats.
    #[must_use]
    pub fn packed_clips(&self) -> &[PackedClip] {
        &self.packed
    }

    /// The clip of a number.
    pub(crate) fn played(&self, clip: usize) -> Option<&dyn Played> {
        match clip.checked_sub(self.clips.len()) {
            None => self.clips.get(clip).map(|clip| clip as &dyn Played),
            Some(packed) => self.packed.get(packed).map(|clip| clip as &dyn Played),
        }
    }

    /// A cursor at the beginning, with room for any of the clips.
    pub(crate) fn cursor(&self) -> &Cursor {
        &self.cursor
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
