//! [`Deviation`]: the distance between two clips, by forward kinematics in double precision.

use aim_animation::{Clip, Track};
use aim_gltf::{Document, Skeleton};
use aim_runtime::glam::{DAffine3, DVec3};

use crate::reduction::WrittenError;

/// Distance between two clips over time: the largest one between corresponding joints and bone ends.
pub(crate) struct Deviation {
    /// Times of the samples, seconds.
    pub(crate) times: Vec<f64>,
    /// Largest distance at each of the times, in the file's units.
    pub(crate) distances: Vec<f64>,
    /// Bone with the largest distance, and its time in seconds; `None` if no bone differs.
    pub(crate) worst: Option<(usize, f64)>,
    /// Largest difference of any morph weight; `None` if the first clip animates none.
    pub(crate) weights: Option<f64>,
}

/// Number of samples between two keys.
const BETWEEN: u8 = 8;
/// Approximate maximum number of samples. Beyond it, only the keys are sampled, or only every n-th key.
const MOST_SAMPLES: usize = 40_000;

impl Deviation {
    /// Measures at every key of either clip and at [`BETWEEN`] times between two keys, within [`MOST_SAMPLES`].
    pub(crate) fn measure(document: &Document, [before, after]: [&Clip; 2]) -> Self {
        let skeleton = document.skeleton();
        let ends = ends(skeleton);
        let (mut distances, mut worst) = (Vec::new(), (0.0, None));
        let times = sample_times([before, after]);
        for &time in &times {
            let [was, is] = [before, after].map(|clip| skeleton.world_f64(&skeleton.pose(clip, time)));
            let mut most = 0.0_f64;
            for (bone, (was, is)) in was.iter().zip(&is).enumerate() {
                let off = |point: DVec3| was.transform_point3(point).distance(is.transform_point3(point));
                let distance = ends[bone].iter().copied().map(off).fold(off(DVec3::ZERO), f64::max);
                if distance > worst.0 {
                    worst = (distance, Some((bone, f64::from(time))));
                }
                most = most.max(distance);
            }
            distances.push(most);
        }
        let weights = weights_off([before, after], &times);
        Self { times: times.into_iter().map(f64::from).collect(), distances, worst: worst.1, weights }
    }

    /// Returns the deviation as the error of a reduced clip; `millimetre` is one of a 1.7 m figure in the file's units.
    pub(crate) fn written_error(&self, document: &Document, millimetre: f64) -> WrittenError {
        let place = |(bone, t): (usize, f64)| (document.skeleton().names()[bone].clone(), t);
        WrittenError { mm: self.most() / millimetre, at: self.worst.map(place), weights: self.weights }
    }

    /// Returns the largest distance, in the file's units.
    pub(crate) fn most(&self) -> f64 {
        self.distances.iter().copied().fold(0.0, f64::max)
    }
}

/// Returns the largest difference of any morph weight at `times`; infinite if the second clip lacks a track of the
/// first. `None` if the first has no tracks of morph weights.
fn weights_off([before, after]: [&Clip; 2], times: &[f32]) -> Option<f64> {
    let of_scalar = |(scalar, was): &(usize, Track<f32>)| {
        let (_, is) = after.scalars().iter().find(|(known, _)| known == scalar)?;
        let mut keys = [0; 2];
        let off = |time: f32| {
            let [was, is] = [was.sample_near(time, &mut keys[0]), is.sample_near(time, &mut keys[1])].map(f64::from);
            (was - is).abs()
        };
        Some(times.iter().copied().map(off).fold(0.0, f64::max))
    };
    before.scalars().iter().map(|track| of_scalar(track).unwrap_or(f64::INFINITY)).reduce(f64::max)
}

/// Returns the times of all keys of a clip, sorted, each once.
pub(crate) fn key_times(clip: &Clip) -> Vec<f32> {
    let mut times: Vec<f32> = clip.scalars().iter().flat_map(|(_, track)| track.times().iter().copied()).collect();
    for tracks in clip.tracks() {
        times.extend(bone_times(tracks));
    }
    times.sort_by(f32::total_cmp);
    times.dedup();
    times
}

/// Returns the times of a bone's keys, unsorted.
pub(crate) fn bone_times(tracks: &aim_animation::BoneTracks) -> impl Iterator<Item = f32> + '_ {
    let vectors = [&tracks.translation, &tracks.scale].into_iter().flatten().flat_map(Track::times);
    vectors.chain(tracks.rotation.iter().flat_map(Track::times)).copied()
}

/// Returns the times of the clips' keys, of their ends, and of samples in between.
fn sample_times(clips: [&Clip; 2]) -> Vec<f32> {
    let mut keys: Vec<f32> = clips.iter().flat_map(|clip| key_times(clip)).chain([0.0, clips[0].length_s()]).collect();
    keys.sort_by(f32::total_cmp);
    keys.dedup();
    if keys.len() > MOST_SAMPLES {
        return keys.iter().step_by(keys.len().div_ceil(MOST_SAMPLES)).copied().chain(keys.last().copied()).collect();
    }
    let between = if keys.len() * usize::from(BETWEEN + 1) > MOST_SAMPLES { 0 } else { BETWEEN };
    let parts = |pair: &[f32]| {
        let (from, step) = (pair[0], (pair[1] - pair[0]) / f32::from(between + 1));
        (0..=between).map(move |part| from + step * f32::from(part))
    };
    let mut times: Vec<f32> = keys.windows(2).flat_map(parts).chain(keys.last().copied()).collect();
    times.dedup();
    times
}

/// Returns the ends of each bone, in its own space: six points at its length from its joint, in both directions of its
/// three axes.
///
/// A bone's length is the distance to its farthest child, or, for a leaf, its parent's length, as in
/// [`Reduction`](aim_animation::Reduction).
fn ends(skeleton: &Skeleton) -> Vec<[DVec3; 6]> {
    let world: Vec<DAffine3> = skeleton.world_f64(skeleton.rest());
    let apart = |a: usize, b: usize| world[a].translation.distance(world[b].translation);
    let size = (0..skeleton.len()).map(|bone| apart(0, bone)).fold(0.0, f64::max);
    let mut lengths = Vec::<f64>::with_capacity(skeleton.len());
    for (bone, parent) in skeleton.parents().iter().enumerate() {
        let own = skeleton.children(bone).map(|child| apart(bone, child)).fold(0.0, f64::max);
        let inherited = parent.map_or(if size > 0.0 { 0.1 * size } else { 1.0 }, |parent| lengths[parent]);
        lengths.push(if own > 1e-4 * size { own } else { inherited });
    }
    let ends = |(world, length): (&DAffine3, f64)| {
        let axes = [world.matrix3.x_axis, world.matrix3.y_axis, world.matrix3.z_axis];
        let [x, y, z] = [0, 1, 2].map(|k| {
            let scale = axes[k].length();
            DVec3::AXES[k] * if scale > 0.0 { length / scale } else { length }
        });
        [x, y, z, -x, -y, -z]
    };
    world.iter().zip(lengths).map(ends).collect()
}
