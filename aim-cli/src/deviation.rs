//! [`Deviation`]: how far a clip is from another one, by forward kinematics in double precision.

use aim_animation::{Clip, Track};
use aim_gltf::Skeleton;
use aim_runtime::glam::{DAffine3, DVec3};

/// The distance of a clip from another one over time: the largest of all bones' joints and ends.
pub(crate) struct Deviation {
    /// Seconds.
    pub(crate) times: Vec<f64>,
    /// In the file's units.
    pub(crate) distances: Vec<f64>,
    /// The bone that is furthest off, and the time.
    pub(crate) worst: Option<(usize, f64)>,
}

/// Times between two keys.
const BETWEEN: u8 = 8;
/// Samples at most; of more keys each is one, or some of them.
const MOST_SAMPLES: usize = 40_000;

impl Deviation {
    /// At every key of either clip, and at eight times between two.
    pub(crate) fn measure(skeleton: &Skeleton, [before, after]: [&Clip; 2]) -> Self {
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
        Self { times: times.into_iter().map(f64::from).collect(), distances, worst: worst.1 }
    }

    /// The largest distance.
    pub(crate) fn most(&self) -> f64 {
        self.distances.iter().copied().fold(0.0, f64::max)
    }
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

/// The ends of each bone beside its joint: of what has no children, as far from it in each direction as it is from its parent.
fn ends(skeleton: &Skeleton) -> Vec<Vec<DVec3>> {
    let world: Vec<DAffine3> = skeleton.world_f64(skeleton.rest());
    let ends = |bone: usize| {
        let parent = skeleton.parents()[bone].filter(|_| skeleton.children(bone).next().is_none());
        let length = parent.map_or(0.0, |parent| world[parent].translation.distance(world[bone].translation));
        let reach = world[bone].matrix3.to_cols_array().chunks(3).map(|axis| DVec3::from_slice(axis).length()).collect::<Vec<_>>();
        DVec3::AXES.into_iter().zip(reach).filter(|(_, scale)| length > 0.0 && *scale > 0.0).map(|(axis, scale)| axis * (length / scale)).collect()
    };
    (0..skeleton.len()).map(ends).collect()
}
