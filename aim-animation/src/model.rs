//! [`Model`]: the data that all characters of a kind share.

use alloc::vec::Vec;

use crate::clip::Clip;
use crate::cursor::Cursor;
use crate::mask::Mask;
use crate::motion::Motion;
use crate::packed::PackedClip;
use crate::playable::PlayableClip;
use crate::skeleton::Skeleton;

/// Skeleton, clips, root motions and masks shared by all characters of a kind. Immutable; each character is an
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
    /// A cursor at the beginning, with room for each of the clips.
    cursor: Cursor,
}

impl Model {
    /// A model whose clips have no root motion.
    #[must_use]
    pub fn new(skeleton: Skeleton, clips: impl Into<Vec<Clip>>) -> Self {
        let clips = clips.into();
        let motions = alloc::vec![None; clips.len()];
        let cursor = clips.iter().fold(Cursor::default(), |cursor, clip| cursor.with_room_of_both(&clip.cursor()));
        Self { skeleton, clips, packed: Vec::new(), motions, masks: Vec::new(), cursor }
    }

    /// Adds a packed clip, which is played without unpacking. Its number follows on from those of all clips so far.
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

    /// Adds the root motion of a clip, which must have been extracted from that clip. The motion is removed from the
    /// clip's poses and moves the place of the instance instead. Does nothing if there is no such clip.
    #[must_use]
    pub fn with_motion(mut self, clip: usize, motion: Motion) -> Self {
        if let Some(of_clip) = self.motions.get_mut(clip) {
            *of_clip = Some(motion);
        }
        self
    }

    /// Adds a mask. Controls refer to masks by number; the first is 0.
    #[must_use]
    pub fn with_mask(mut self, mask: Mask) -> Self {
        self.masks.push(mask);
        self
    }

    /// The skeleton.
    #[must_use]
    pub fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }

    /// The unpacked clips, numbered from 0.
    #[must_use]
    pub fn clips(&self) -> &[Clip] {
        &self.clips
    }

    /// The packed clips, numbered on from the last unpacked one.
    #[must_use]
    pub fn packed_clips(&self) -> &[PackedClip] {
        &self.packed
    }

    /// Returns the clip with this number.
    pub(crate) fn playable_clip(&self, clip: usize) -> Option<&dyn PlayableClip> {
        match clip.checked_sub(self.clips.len()) {
            None => self.clips.get(clip).map(|clip| clip as &dyn PlayableClip),
            Some(packed) => self.packed.get(packed).map(|clip| clip as &dyn PlayableClip),
        }
    }

    /// A cursor at the beginning, with room for each of the clips.
    pub(crate) fn cursor(&self) -> &Cursor {
        &self.cursor
    }

    /// The root motion of a clip, if it has any.
    #[must_use]
    pub fn motion(&self, clip: usize) -> Option<&Motion> {
        self.motions.get(clip)?.as_ref()
    }

    /// Returns the bone whose blend weight is a clip's weight in the root motion: the bone of its own motion, else of
    /// the first clip that has one.
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
