//! A walk that turns into a run and back, on the spot: two clips blended in step, as in a game.

use aim_animation::{Blender, Clip, Cursor, Marks, Motion, Root, RootPath, Transform};
use aim_gltf::Skeleton;
use aim_runtime::glam::{Quat, Vec3};

use crate::bake::{continuous, key_times, line};
use crate::error::Error;
use crate::num;

/// Length of the clip, seconds.
const SECONDS: f32 = 10.0;
/// Keys per second.
const RATE: f32 = 60.0;

/// A gait with its travel removed and its footfalls marked. A cycle begins with the left foot.
struct Gait<'a> {
    clip: &'a Clip,
    motion: Motion,
    marks: Marks,
}

impl<'a> Gait<'a> {
    fn new(clip: &'a Clip, skeleton: &Skeleton, root: Root) -> Result<Self, Error> {
        let path = RootPath::new(clip, skeleton, root, RATE).map_err(|error| Error::Clip(error.to_string()))?;
        let marks = Marks::new(clip.length_s(), [0.0, 0.5 * clip.length_s()]);
        Ok(Self { clip, motion: Motion::linear(&path), marks: marks.map_err(|error| Error::Clip(error.to_string()))? })
    }

    /// Returns the pose at a phase of the cycle, 0…1.
    fn pose(&self, skeleton: &Skeleton, phase: f32) -> Vec<Transform> {
        let (mut pose, time) = (skeleton.rest().to_vec(), self.marks.time_at(phase));
        self.clip.sample(time, &mut Cursor::default(), &mut pose);
        // The pose has the skeleton's length.
        let _ = self.motion.remove(time, skeleton, &mut pose);
        pose
    }
}

/// Returns a loop in which the figure walks, runs in the middle, and walks again.
pub(super) fn walk_to_run(skeleton: &Skeleton, [walk, run]: [&Clip; 2], root: Root) -> Result<Clip, Error> {
    let [walk, run] = [Gait::new(walk, skeleton, root)?, Gait::new(run, skeleton, root)?];
    let times = key_times(SECONDS, RATE)?;
    // The length of a cycle is interpolated between those of the gaits.
    let length = |time: f32| {
        let share = f64::from(run_share(time));
        f64::from(walk.clip.length_s()) * (1.0 - share) + f64::from(run.clip.length_s()) * share
    };
    let mut cycles = vec![0.0];
    for pair in times.windows(2) {
        cycles.push(cycles[cycles.len() - 1] + f64::from(pair[1] - pair[0]) / length(0.5 * (pair[0] + pair[1])));
    }
    // The phase is scaled to a whole number of cycles, so that the clip loops.
    let total = cycles[cycles.len() - 1];
    let mut tracks = vec![(Vec::<Vec3>::new(), Vec::<Quat>::new()); skeleton.len()];
    for (&time, cycles) in times.iter().zip(cycles) {
        let phase = num::narrow((cycles * total.round() / total).rem_euclid(1.0));
        let mut pose = walk.pose(skeleton, phase);
        // Both poses have the skeleton's length.
        let _ = Blender::new(skeleton).blend(&mut pose, &run.pose(skeleton, phase), run_share(time));
        for (bone, (places, turns)) in pose.iter().zip(&mut tracks) {
            places.push(bone.translation);
            turns.push(continuous(turns.last(), bone.rotation));
        }
    }
    let mut clip = Clip::new("walk_to_run");
    for (bone, (places, turns)) in tracks.into_iter().enumerate() {
        let is_moved = walk.clip.bone(bone).or(run.clip.bone(bone));
        if is_moved.is_some_and(|tracks| tracks.translation.is_some()) {
            clip = clip.with_translation(bone, line(&times, places)?);
        }
        if is_moved.is_some() {
            clip = clip.with_rotation(bone, line(&times, turns)?);
        }
    }
    Ok(clip)
}

/// Returns the share of the run at a time: from 0 to 1 and back over the loop, by smoothstep.
fn run_share(time: f32) -> f32 {
    let way = ((0.75 - (2.0 * time / SECONDS - 1.0).abs()) / 0.4).clamp(0.0, 1.0);
    way * way * (3.0 - 2.0 * way)
}
