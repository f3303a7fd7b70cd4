//! Aims a rig over a clip, frame by frame, and makes the clip that does it. It differs from its source in the chain's rotations,
//! the transforms of held bones, and the weights of eyes that are morph targets.
//!
//! `chain.rs` finds the nodes of a rig's joints, `live.rs` aims them for a frame, with what `sights.rs` tells of where they look,
//! `eye_maps.rs` and `morph_eyes.rs` of eyes that do not simply turn. `plausibility/` measures how
//! that looks; `seam.rs` makes loops of clips; `reach.rs` leads a limb instead.

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

/// Beginning of a bake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Settle {
    /// On the target, without regard to rates.
    Snap,
    /// From the animation: every angle 0.
    Animation,
}

/// A request to bake.
#[derive(Clone, Copy, Debug)]
pub struct Plan<'a> {
    /// The file.
    pub document: &'a Document,
    /// The clip that is aimed over; without one the rest pose stands still.
    pub clip: Option<&'a Clip>,
    /// The file measured.
    pub measurement: &'a Measurement,
    /// The nodes of the rig.
    pub chain: &'a ChainNodes,
    /// True to aim the other eye itself, instead of turning it as joint 0 turns. It is then turned not from its
    /// own animation, but from the direction of joint 0: the eyes of animations are seldom parallel.
    pub both_eyes: bool,
    /// Length of the baked clip, seconds.
    pub seconds: f32,
    /// Keys a second.
    pub fps: f32,
    /// Beginning of the bake.
    pub settle: Settle,
    /// True to repeat the clip, recording only the last round, until it ends as it began.
    pub looped: bool,
    /// Settings of the solver.
    pub settings: Settings,
    /// The node that the target is at, if it is at one. Where aiming moves that node (a hand, by the chest), the target is
    /// looked for again where it is then; but a node [on what looks](Live::looks_with) is aimed at where the animation has it.
    pub target_node: Option<usize>,
}

/// A baked clip.
#[derive(Clone, Debug)]
pub struct Baked {
    /// The clip: the source's channels, the chain's rotations replaced, places and rotations of what is [held](Live::held), and
    /// the weights of eyes that look by morph targets.
    pub clip: Clip,
    /// The result of each frame.
    pub frames: Vec<AimedFrame>,
}

/// Aims `rig` over the plan's clip. `target` gives the target in the world from the time in seconds and the nodes in the
/// world: animated, or aimed where the plan has a [`target_node`](Plan::target_node); `progress` is told of every finished frame.
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
/// A length or frame rate that makes no frames.
pub fn bake<R: Rig>(
    rig: &mut DynAim<R>,
    plan: &Plan<'_>,
    mut target: impl FnMut(f32, &[DAffine3]) -> DVec3,
    mut progress: impl FnMut(usize, usize),
) -> Result<Baked, Error> {
    let times = key_times(plan.seconds, plan.fps)?;
    let skeleton = plan.document.skeleton();
    let live = Live::new(&rig.rig, plan.document, plan.measurement, plan.chain, plan.both_eyes)?;
    // x ← the node's place with the gaze on x: a fixed point, as a hand moves less than the gaze that it draws.
    let follows = plan.target_node.is_some_and(|node| !live.looks_with(skeleton, node, plan.settings.effector));
    let source = plan.clip.map(|clip| clip.repeated(plan.seconds));
    let sample = |t: f32| live.pose(skeleton, source.as_ref(), t);
    // Eyes that look by morph targets are no nodes of the file: their weights are written.
    let turned = plan.chain.turned().chain(live.held());
    let turned: Vec<usize> = turned.filter(|node| skeleton.is_in_file(*node)).collect();
    let mut rotations: Vec<Vec<Quat>> = vec![Vec::with_capacity(times.len()); turned.len()];
    let mut places: Vec<Vec<Vec3>> = vec![Vec::with_capacity(times.len()); live.held().count()];
    let mut weights: Vec<Vec<f32>> = vec![Vec::with_capacity(times.len()); live.morphs().scalars().count()];
    let mut frames = Vec::with_capacity(times.len());
    for pass in 0..if plan.looped { MOST_ROUNDS } else { 1 } {
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
            let mut rounds = if follows { MOST_SEARCHES } else { 0 };
            let frame = loop {
                let goal = target_ws.as_vec3();
                let outcome = match (before, pass, plan.settle) {
                    (Some(before), ..) => rig.aim(&joints.pose(), goal, t - before, &plan.settings),
                    // The pass before ended here, perhaps in another pose: no time for an angle to move, but a frame.
                    (None, 1.., _) => rig.aim(&joints.pose(), goal, f32::MIN_POSITIVE, &plan.settings),
                    (None, 0, Settle::Animation) => rig.aim(&joints.pose(), goal, 0.0, &plan.settings),
                    (None, 0, Settle::Snap) => rig.snap(&joints.pose(), goal, &plan.settings),
                };
                let effector = plan.settings.effector;
                let moment = Moment { t, target: target_ws, world: &world, joints: &joints, outcome, effector };
                let mut aimed = pose.clone();
                let frame = live.aimed(rig, skeleton, &mut aimed, &moment);
                let [eye, _] = live.gazes(effector, &frame.world)[0];
                let is_now_at = if follows { target(t, &frame.world) } else { target_ws };
                if rounds == 0 || (is_now_at - eye).angle_between(target_ws - eye) <= FOUND_RAD {
                    pose = aimed;
                    break frame;
                }
                rounds -= 1;
                target_ws = is_now_at;
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
        if closes(&began, &rig.state.joints) {
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

/// Most rounds in which a target that aiming moves is looked for, and the angle within which it is found.
const MOST_SEARCHES: u32 = 24;
const FOUND_RAD: f64 = 0.01 / 180.0 * core::f64::consts::PI;

/// Largest number of rounds of a loop; one whose clip or target jumps at the seam may never end as it begins.
const MOST_ROUNDS: u32 = 8;

/// True if the joints are back at the angles they began with, whole turns aside.
fn closes(began: &[Joint], ended: &[Joint]) -> bool {
    const NEAR_RAD: f32 = 1e-5;
    let apart = |a: f32, b: f32| (a - b - TAU * ((a - b) / TAU).round()).abs();
    let pairs = began.iter().zip(ended);
    pairs.fold(0.0_f32, |far, (a, b)| far.max(apart(a.heading(), b.heading())).max(apart(a.pitch(), b.pitch())))
        < NEAR_RAD
}

/// The most keys that one bake makes: an hour at 144 Hz.
const MOST_KEYS: f32 = 144.0 * 3600.0;

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
        "{seconds} s at {fps} frames a second make no clip; give a length and a rate of at least one frame and \
         at most an hour at 144 Hz"
    ))
}

/// A linear track of these keys.
pub(crate) fn line<T: Value>(times: &Arc<[f32]>, keys: Vec<T>) -> Result<Track<T>, Error> {
    Track::linear(times.clone(), keys).map_err(|error| Error::Clip(error.to_string()))
}

/// The sign of a quaternion that interpolates the short way from the one before.
pub(crate) fn continuous(before: Option<&Quat>, rotation: Quat) -> Quat {
    if before.is_some_and(|before| before.dot(rotation) < 0.0) { -rotation } else { rotation }
}
