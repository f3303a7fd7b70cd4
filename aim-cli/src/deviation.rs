//! [`Deviation`]: how far a clip is from another one, by forward kinematics in double precision.

use aim_animation::{Clip, Track};
use aim_gltf::{Document, Skeleton};
use aim_runtime::glam::{DAffine3, DVec3};

use crate::reduction::WrittenError;

/// The distance of a clip from another one over time: the largest of all bones' joints and ends.
pub(crate) struct Deviation {
    /// Seconds.
    pub(crate) times: Vec<f64>,
    /// In the file's units.
    pub(crate) distances: Vec<f64>,
    /// The bone that is furthest off, and the time.
    pub(crate) worst: Option<(usize, f64)>,
    /// The largest difference of any morph weight; `None` of a clip without any.
    pub(crate) weights: Option<f64>,
}

/// Times between two keys.
const BETWEEN: u8 = 8;
/// Samples at most; of more keys each is one, or some of them.
const MOST_SAMPLES: usize = 40_000;

impl Deviation {
    /// At every key of either clip, and at eight times between two.
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

    /// As it is told of a clip that was reduced; `millimetre` is one of a 1.7 m figure in the file's units.
    pub(crate) fn written_error(&self, document: &Document, millimetre: f64) -> WrittenError {
        let place = |(bone, t): (usize, f64)| (document.skeleton().names()[bone].clone(), t);
        WrittenError { mm: self.most() / millimetre, at: self.worst.map(place), weights: self.weights }
    }

    /// The largest distance.
    pub(crate) fn most(&self) -> f64 {
        self.distances.iter().copied().fold(0.0, f64::max)
    }
}

/// The largest difference of any weight of the first clip from that of the second, which has a track of each.
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

/// The times of all keys of a clip, each once, in order.
pub(crate) fn key_times(clip: &Clip) -> Vec<f32> {
    let mut times: Vec<f32> = clip.scalars().iter().flat_map(|(_, track)| track.times().iter().copied()).collect();
    for tracks in clip.tracks() {
        times.extend(bone_times(tracks));
    }
    times.sort_by(f32::total_cmp);
    times.dedup();
    times
}

/// The times of a bone's keys, not in order.
pub(crate) fn bone_times(tracks: &aim_animation::BoneTracks) -> impl Iterator<Item = f32> + '_ {
    let vectors = [&tracks.translation, &tracks.scale].into_iter().flatten().flat_map(Track::times);
    vectors.chain(tracks.rotation.iter().flat_map(Track::times)).copied()
}

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

/// The ends of each bone, in its own space: beside its joint on its three axes, its length away on both sides.
///
/// A bone's length is the distance to its farthest child, that of a leaf its parent's, as [`Reduction`](aim_animation::Reduction) has it.
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
