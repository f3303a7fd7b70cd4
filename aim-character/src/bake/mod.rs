//! Baking: aims a rig over a clip, frame by frame, and makes a new clip of the result. The new clip differs from its
//! source in the chain's rotations, the transforms of held bones, and the weights of eyes that are morph targets.
//!
//! - `chain.rs` finds the nodes of a rig's joints.
//! - `live.rs` aims them in one frame; `sights.rs` holds the points and directions of their gaze; `eye_maps.rs` and
//!   `morph_eyes.rs` handle eyes that turn by range maps or look by morph targets.
//! - `plausibility/` measures how the result looks.
//! - `seam.rs` makes loops of clips.
//! - `reach.rs` leads a limb through points instead.

pub(crate) mod chain;
pub(crate) mod eye_maps;
pub(crate) mod live;
mod morph_eyes;
pub(crate) mod plausibility;
pub(crate) mod reach;
pub(crate) mod seam;
mod sights;

use core::f32::consts::TAU;
use std::sync::Arc;

use aim_runtime::glam::{DAffine3, DVec3, Quat, Vec3};
use aim_runtime::{DynAim, Joint, Rig, Settings};

use crate::bake::chain::ChainNodes;
use crate::bake::live::{AimedFrame, Live, Moment};
use crate::error::Error;
use crate::measure::Measurement;
use aim_animation::{Clip, Track, Value};
use aim_gltf::Document;

/// State of the rig in the first frame of a bake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Settle {
    /// On the target, regardless of rates.
    Snap,
    /// At the animation: every added angle is 0.
    Animation,
}

/// Inputs of [`bake()`].
#[derive(Clone, Copy, Debug)]
pub struct Plan<'a> {
    /// The file.
    pub document: &'a Document,
    /// The clip to aim over; `None` for the rest pose.
    pub clip: Option<&'a Clip>,
    /// Measurement of the file.
    pub measurement: &'a Measurement,
    /// Nodes of the rig's joints.
    pub chain: &'a ChainNodes,
    /// `true` to aim the other eye itself, instead of turning it as joint 0 turns. It then starts from the direction of
    /// joint 0 rather than from its own animation, because animated eyes are seldom parallel.
    pub both_eyes: bool,
    /// Length of the baked clip, seconds.
    pub seconds: f32,
    /// Keys per second.
    pub fps: f32,
    /// State of the rig in the first frame.
    pub settle: Settle,
    /// `true` to make a loop: the clip is repeated until it ends in the state in which it began, at most eight times,
    /// and only the last round is recorded.
    pub looped: bool,
    /// Settings of the solver.
    pub settings: Settings,
    /// Node at which the target is, if any. If aiming moves that node (a hand, by the chest), the target is searched
    /// iteratively at the moved position. A node that [moves with the gaze](Live::looks_with) is aimed at in its
    /// animated position instead.
    pub target_node: Option<usize>,
}

/// Result of [`bake()`].
#[derive(Clone, Debug)]
pub struct Baked {
    /// The clip: the source's tracks, with the chain's rotations, the translations and rotations of [held](Live::held)
    /// nodes, and the weights of eyes that look by morph targets replaced.
    pub clip: Clip,
    /// Result of each frame.
    pub frames: Vec<AimedFrame>,
}

/// Aims `rig` over the plan's clip.
///
/// `target` returns the target in world space from the time in seconds and the nodes' world transforms: animated ones,
/// or aimed ones while a [`target_node`](Plan::target_node) is searched. `progress` is called after every frame with
/// the number of finished frames and of all frames.
///
/// ```
/// use aim_character::{InterpretedRig, Measurement, PAPER_AXES, Plan, Settle, bake, chain_nodes, mannequin, propose};
/// use aim_gltf::Document;
/// use aim_runtime::glam::DVec3;
/// use aim_runtime::{DynAim, Settings};
///
/// let document = Document::from_bytes(&mannequin(|_| PAPER_AXES)?)?;
/// let measurement = Measurement::of(&document);
/// let spec = propose(&document, &measurement, None)?.spec;
/// let plan = Plan {
///     document: &document,
///     clip: document.default_clip(),
///     measurement: &measurement,
///     chain: &chain_nodes(&spec, document.skeleton())?,
///     both_eyes: true,
///     seconds: 1.2,
///     fps: 30.0,
///     settle: Settle::Snap,
///     looped: false,
///     settings: Settings::default(),
///     target_node: None,
/// };
/// let mut rig = DynAim::new(InterpretedRig::new(&spec));
/// let baked = bake(&mut rig, &plan, |_, _| DVec3::new(1.0, 1.7, 2.0), |_, _| {})?;
/// assert!(baked.frames.iter().all(|frame| frame.error_deg < 0.1));
/// let aimed = document.with_clips(&[baked.clip.with_name("walk_aimed")])?; // a GLB of both clips
/// # assert_eq!(Document::from_bytes(&aimed)?.clips().len(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Fails if length and frame rate do not make between one frame and one hour at 144 Hz, or if the nodes do not form a
/// chain of the document.
pub fn bake<R: Rig>(
    rig: &mut DynAim<R>,
    plan: &Plan<'_>,
    mut target: impl FnMut(f32, &[DAffine3]) -> DVec3,
    mut progress: impl FnMut(usize, usize),
) -> Result<Baked, Error> {
    let times = key_times(plan.seconds, plan.fps)?;
    let skeleton = plan.document.skeleton();
    let live = Live::new(&rig.rig, plan.document, plan.measurement, plan.chain, plan.both_eyes)?;
    // Fixed-point iteration: target ← position of the node while the gaze is on the target. It converges because a hand
    // moves less than the gaze that moves it.
    let follows = plan.target_node.is_some_and(|node| !live.looks_with(skeleton, node, plan.settings.effector));
    let source = plan.clip.map(|clip| clip.repeated(plan.seconds));
    let sample = |t: f32| live.pose(skeleton, source.as_ref(), t);
    // Eyes that look by morph targets are not nodes of the file: their weights are written instead.
    let turned = plan.chain.turned().chain(live.held());
    let turned: Vec<usize> = turned.filter(|node| skeleton.is_in_file(*node)).collect();
    let mut rotations: Vec<Vec<Quat>> = vec![Vec::with_capacity(times.len()); turned.len()];
    let mut places: Vec<Vec<Vec3>> = vec![Vec::with_capacity(times.len()); live.held().count()];
    let mut weights: Vec<Vec<f32>> = vec![Vec::with_capacity(times.len()); live.morphs().scalars().count()];
    let mut frames = Vec::with_capacity(times.len());
    for pass in 0..if plan.looped { MOST_PASSES } else { 1 } {
        rotations.iter_mut().for_each(Vec::clear);
        places.iter_mut().for_each(Vec::clear);
        weights.iter_mut().for_each(Vec::clear);
        frames.clear();
        let mut began = rig.state.joints.clone();
        let mut before: Option<f32> = None;
        for &t in times.iter() {
            let mut pose = sample(t);
            let world = skeleton.world_f64(&pose);
            let mut target_ws = target(t, &world);
            let joints = live.animated(&mut pose, &world);
            let was = follows.then(|| rig.state.clone());
            let mut searches_left = if follows { MOST_SEARCHES } else { 0 };
            let frame = loop {
                let goal = target_ws.as_vec3();
                let outcome = match (before, pass, plan.settle) {
                    (Some(before), ..) => rig.aim(&joints.pose(), goal, t - before, &plan.settings),
                    // The previous round ended here, perhaps in another pose: a time step so small that no angle moves,
                    // but the frame is solved.
                    (None, 1.., _) => rig.aim(&joints.pose(), goal, f32::MIN_POSITIVE, &plan.settings),
                    (None, 0, Settle::Animation) => rig.aim(&joints.pose(), goal, 0.0, &plan.settings),
                    (None, 0, Settle::Snap) => rig.snap(&joints.pose(), goal, &plan.settings),
                };
                let effector = plan.settings.effector;
                let moment = Moment { t, target: target_ws, world: &world, joints: &joints, outcome, effector };
                let mut aimed = pose.clone();
                let frame = live.aimed(rig, skeleton, &mut aimed, &moment);
                let [eye, _] = live.gazes(effector, &frame.world)[0];
                let new_target_ws = if follows { target(t, &frame.world) } else { target_ws };
                if searches_left == 0 || (new_target_ws - eye).angle_between(target_ws - eye) <= SEARCH_TOLERANCE_RAD {
                    pose = aimed;
                    break frame;
                }
                searches_left -= 1;
                target_ws = new_target_ws;
                if let Some(was) = &was {
                    rig.state.clone_from(was);
                }
            };
            if before.is_none() {
                began = rig.state.joints.clone();
            }
            before = Some(t);
            for (track, of_frame) in weights.iter_mut().zip(live.morphs().aimed(source.as_ref(), t, &pose)) {
                track.push(of_frame);
            }
            for (track, node) in places.iter_mut().zip(live.held()) {
                track.push(pose[node].translation);
            }
            for (track, &node) in rotations.iter_mut().zip(&turned) {
                track.push(continuous(track.last(), pose[node].rotation));
            }
            frames.push(frame);
            progress(frames.len(), times.len());
        }
        if is_closed(&began, &rig.state.joints) {
            break;
        }
    }
    let mut clip = source.unwrap_or_else(|| Clip::new("aim"));
    for (&node, rotations) in turned.iter().zip(rotations) {
        clip = clip.with_rotation(node, line(&times, rotations)?);
    }
    for (node, places) in live.held().zip(places) {
        clip = clip.with_translation(node, line(&times, places)?);
    }
    for (scalar, weights) in live.morphs().scalars().zip(weights) {
        clip = clip.with_scalar(scalar, line(&times, weights)?);
    }
    Ok(Baked { clip, frames })
}

/// Largest number of iterations in the search for a target that aiming moves.
const MOST_SEARCHES: u32 = 24;
/// Change of the direction to the target below which the search ends, radians.
const SEARCH_TOLERANCE_RAD: f64 = 0.01 / 180.0 * core::f64::consts::PI;

/// Largest number of rounds of a loop. A clip or target that jumps at the seam may never end as it begins.
const MOST_PASSES: u32 = 8;

/// Returns `true` if the joints are back at their first angles, up to whole turns.
fn is_closed(began: &[Joint], ended: &[Joint]) -> bool {
    const NEAR_RAD: f32 = 1e-5;
    let apart = |a: f32, b: f32| (a - b - TAU * ((a - b) / TAU).round()).abs();
    let pairs = began.iter().zip(ended);
    pairs.fold(0.0_f32, |far, (a, b)| far.max(apart(a.heading(), b.heading())).max(apart(a.pitch(), b.pitch())))
        < NEAR_RAD
}

/// Largest number of keys in a bake: an hour at 144 Hz.
const MOST_KEYS: f32 = 144.0 * 3600.0;

/// Returns the times of the keys, the last one at `seconds`.
pub(crate) fn key_times(seconds: f32, fps: f32) -> Result<Arc<[f32]>, Error> {
    let keys = seconds * fps;
    if !(seconds > 0.0 && fps > 0.0 && (1.0..=MOST_KEYS).contains(&keys)) {
        return Err(no_keys(seconds, fps));
    }
    #[expect(clippy::cast_precision_loss, reason = "the number of keys is bounded far below 2^24")]
    let mut times: Vec<f32> = (0_u32..).map(|key| key as f32 / fps).take_while(|t| *t + 0.01 / fps < seconds).collect();
    times.push(seconds);
    Ok(times.into())
}

fn no_keys(seconds: f32, fps: f32) -> Error {
    Error::Clip(format!(
        "{seconds} s at {fps} frames per second is not a valid clip; give a length and a rate that make at least one frame \
         and at most an hour at 144 Hz"
    ))
}

/// Returns a linear track of keys at these times.
pub(crate) fn line<T: Value>(times: &Arc<[f32]>, keys: Vec<T>) -> Result<Track<T>, Error> {
    Track::linear(times.clone(), keys).map_err(|error| Error::Clip(error.to_string()))
}

/// Returns the rotation with the sign that interpolates the short way from the previous one.
pub(crate) fn continuous(before: Option<&Quat>, rotation: Quat) -> Quat {
    if before.is_some_and(|before| before.dot(rotation) < 0.0) { -rotation } else { rotation }
}
