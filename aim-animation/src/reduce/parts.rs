//! [`Tracks`]: the tracks of a clip, each with its share of the tolerance in model space.

use alloc::vec::Vec;

use aim_runtime::glam::{Quat, Vec3};

use super::bone_ends::BoneEnds;
use super::prepared::{Fitted, Prepared, Storage};
use crate::clip::Clip;
use crate::packed::Grids;
use crate::skeleton::Skeleton;

/// Fraction of the tolerance reserved for each track that does not move.
const STILL: f32 = 1.0 / 64.0;

/// The tracks of one bone of the skeleton.
#[derive(Debug)]
struct PreparedBone<'a> {
    bone: usize,
    translation: Option<Prepared<'a, Vec3>>,
    rotation: Option<Prepared<'a, Quat>>,
    scale: Option<Prepared<'a, Vec3>>,
    /// Largest movement of the ends per unit of translation, rotation (radian) and scale.
    leverage: [f32; 3],
    moves: [bool; 3],
    /// Fraction of the tolerance for each track that moves.
    share: f32,
}

/// The tracks of a clip.
#[derive(Debug)]
pub(super) struct Tracks<'a> {
    clip: &'a Clip,
    skeleton: &'a Skeleton,
    bones: Vec<PreparedBone<'a>>,
    scalars: Vec<Prepared<'a, f32>>,
    tolerances: [f32; 2],
}

/// Factors on the tolerances of bones and scalars; `None` for what is left unchanged.
#[derive(Clone, Debug)]
pub(super) struct Factors {
    pub(super) bones: Vec<Option<f32>>,
    pub(super) scalars: Vec<Option<f32>>,
}

/// A fitted clip and the grids of its tracks.
#[derive(Clone, Debug)]
pub(super) struct Fit {
    pub(super) clip: Clip,
    pub(super) grids: Grids,
}

impl<'a> Tracks<'a> {
    /// Prepares a clip; `tolerances` are those of the model and of scalars.
    pub(super) fn new(
        clip: &'a Clip,
        skeleton: &'a Skeleton,
        (ends, pins): (&[BoneEnds], &'a [f32]),
        tolerances: [f32; 2],
    ) -> Self {
        let of_skeleton = clip.tracks().iter().filter(|tracks| tracks.bone < skeleton.len());
        let mut bones: Vec<PreparedBone<'a>> = of_skeleton
            .map(|tracks| {
                let bone = tracks.bone;
                let BoneEnds { axis_distances, reach, parent_scale, .. } = &ends[bone];
                let longest = axis_distances.iter().fold(0.0, |longest: f64, distance| longest.max(*distance));
                let leverage = [*parent_scale, *reach, (*reach).max(crate::float::narrow(longest))];
                let vector = |track| Prepared::new(bone, track, pins);
                let translation = tracks.translation.as_ref().map(vector);
                let rotation = tracks.rotation.as_ref().map(|track| Prepared::new(bone, track, pins));
                let scale = tracks.scale.as_ref().map(vector);
                let still = leverage.map(|leverage| STILL * tolerances[0] / leverage);
                let moves = [
                    translation.as_ref().is_some_and(|track| !track.is_constant(still[0])),
                    rotation.as_ref().is_some_and(|track| !track.is_constant(still[1])),
                    scale.as_ref().is_some_and(|track| !track.is_constant(still[2])),
                ];
                PreparedBone { bone, translation, rotation, scale, leverage, moves, share: 1.0 }
            })
            .collect();
        share_tolerance(&mut bones, skeleton);
        let scalars = clip.scalars().iter().map(|(index, track)| Prepared::new(*index, track, pins)).collect();
        Self { clip, skeleton, bones, scalars, tolerances }
    }

    /// Fits each track to be as small as its tolerance permits.
    pub(super) fn fitted(&self, factors: &Factors, storage: Storage) -> Fit {
        let mut clip = Clip::new(self.clip.name());
        let mut grids = Grids::default();
        let mut times = Vec::new();
        for bone_tracks in &self.bones {
            let bone = bone_tracks.bone;
            let rest = &self.skeleton.rest()[bone];
            let tolerance = |channel: usize| {
                let share = if bone_tracks.moves[channel] { bone_tracks.share * factors.bones[bone]? } else { STILL };
                factors.bones[bone].map(|_| self.tolerances[0] * share / bone_tracks.leverage[channel])
            };
            if let Some(Fitted { mut track, grid }) =
                fitted(bone_tracks.translation.as_ref(), Some(rest.translation), tolerance(0), storage)
            {
                track.share_times(&mut times);
                grids.0.push(grid);
                clip = clip.with_translation(bone, track);
            }
            if let Some(Fitted { mut track, grid }) =
                fitted(bone_tracks.rotation.as_ref(), Some(rest.rotation), tolerance(1), storage)
            {
                track.share_times(&mut times);
                grids.0.push(grid);
                clip = clip.with_rotation(bone, track);
            }
            if let Some(Fitted { mut track, grid }) =
                fitted(bone_tracks.scale.as_ref(), Some(rest.scale), tolerance(2), storage)
            {
                track.share_times(&mut times);
                grids.0.push(grid);
                clip = clip.with_scale(bone, track);
            }
        }
        // Bones that the skeleton does not have are left unchanged.
        for tracks in self.clip.tracks().iter().filter(|tracks| tracks.bone >= self.skeleton.len()) {
            let count = [tracks.translation.is_some(), tracks.rotation.is_some(), tracks.scale.is_some()];
            grids.0.extend(count.iter().filter(|is_some| **is_some).map(|_| None));
            *clip.bone_mut(tracks.bone) = tracks.clone();
        }
        for ((index, _), (scalar, factor)) in self.clip.scalars().iter().zip(self.scalars.iter().zip(&factors.scalars))
        {
            let tolerance = factor.map(|factor| self.tolerances[1] * factor);
            if let Some(Fitted { mut track, grid }) = fitted(Some(scalar), None, tolerance, storage) {
                track.share_times(&mut times);
                grids.0.push(grid);
                clip = clip.with_scalar(*index, track);
            }
        }
        let clip = clip.with_length_and_events(self.clip.length_s(), self.clip.events().to_vec());
        Fit { clip, grids }
    }
}

/// Fits a track, or leaves it unchanged if there is no tolerance; `None` if there is no track or if it is at rest.
fn fitted<T: crate::packed::grid::Packable>(
    track: Option<&Prepared<'_, T>>,
    rest: Option<T>,
    tolerance: Option<f32>,
    storage: Storage,
) -> Option<Fitted<T>> {
    let track = track?;
    let Some(tolerance) = tolerance else { return Some(track.original()) };
    let is_at_rest = rest.is_some_and(|rest| track.is_everywhere(rest, tolerance));
    (!is_at_rest).then(|| track.fitted(tolerance, storage))
}

/// Divides the tolerance along each chain of bones. A bone with few descendants gets more, because there are more of
/// those.
fn share_tolerance(bones: &mut [PreparedBone<'_>], skeleton: &Skeleton) {
    let mut weights = alloc::vec![0.0_f32; skeleton.len()];
    for bone_tracks in bones.iter() {
        let below = skeleton.subtree(bone_tracks.bone).len();
        let moves = bone_tracks.moves.iter().filter(|moves| **moves).count();
        #[expect(clippy::cast_precision_loss, reason = "a weight")]
        let weight = moves as f32 / (3.0 + below as f32);
        weights[bone_tracks.bone] = weight;
    }
    // Find the sum along the heaviest chain through each bone.
    let mut sums = weights.clone();
    for bone in 0..sums.len() {
        if let Some(parent) = skeleton.parents()[bone] {
            sums[bone] += sums[parent];
        }
    }
    for bone in (0..sums.len()).rev() {
        if let Some(parent) = skeleton.parents()[bone] {
            sums[parent] = sums[parent].max(sums[bone]);
        }
    }
    for bone_tracks in bones {
        let moves = bone_tracks.moves.iter().filter(|moves| **moves).count().max(1);
        let whole = sums[bone_tracks.bone];
        #[expect(clippy::cast_precision_loss, reason = "three at most")]
        let moves = moves as f32;
        bone_tracks.share = if whole > 0.0 { weights[bone_tracks.bone] / whole / moves } else { 1.0 };
    }
}
