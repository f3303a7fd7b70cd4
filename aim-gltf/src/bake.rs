//! Aims a rig over a clip, frame by frame, and makes the clip that does it: only the chain's rotations change.

use core::f32::consts::TAU;
use std::sync::Arc;

use aim_runtime::{AimRig, Joint, Settings};
use glam::{Affine3A, DAffine3, DVec3, Quat};

use crate::clip::{Channel, Clip};
use crate::document::Document;
use crate::error::Error;
use crate::live::{Frame, Live, Moment};
use crate::measure::Measurement;
use crate::skeleton::Skeleton;

/// The nodes that a rig's joints are in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChainNodes {
    /// One node a joint, from the effector inward.
    pub joints: Vec<usize>,
    /// The other eye: turned in the world as joint 0 is.
    pub pair: Option<usize>,
}

impl ChainNodes {
    /// Finds the nodes by name: for each joint the first of `bones` that the file has.
    ///
    /// # Errors
    /// A bone or pair that is not there or not unique; joints that are not each other's descendants; a pair that is not
    /// beside joint 0 but above or below it.
    pub fn find<'a>(
        skeleton: &Skeleton,
        bones: impl IntoIterator<Item = &'a [String]>,
        pair: Option<&str>,
    ) -> Result<Self, Error> {
        let joints = bones.into_iter().map(|names| find_any(skeleton, names)).collect::<Result<Vec<_>, _>>()?;
        for pair in joints.windows(2) {
            let (outer, inner) = (pair[0], pair[1]);
            if !skeleton.ancestry(outer).skip(1).any(|ancestor| ancestor == inner) {
                let name = |node: usize| &skeleton.nodes()[node].name;
                return Err(Error::Chain {
                    problem: format!(
                        "{:?} does not hang on {:?}; list the joints from the effector inward, each below the next in \
                         the node tree",
                        name(outer),
                        name(inner)
                    ),
                });
            }
        }
        let pair = pair.map(|name| skeleton.find(name)).transpose()?;
        let hangs_on = |node: usize, ancestor: usize| skeleton.ancestry(node).any(|at| at == ancestor);
        if let Some(pair) = pair.filter(|&pair| hangs_on(joints[0], pair) || hangs_on(pair, joints[0])) {
            let name = |node: usize| &skeleton.nodes()[node].name;
            return Err(Error::Chain {
                problem: format!(
                    "the pair {:?} and {:?} hang on each other; name the other eye, beside this one",
                    name(pair),
                    name(joints[0])
                ),
            });
        }
        Ok(Self { joints, pair })
    }

    fn all(&self) -> impl Iterator<Item = usize> + '_ {
        self.joints.iter().copied().chain(self.pair)
    }
}

fn find_any(skeleton: &Skeleton, names: &[String]) -> Result<usize, Error> {
    let mut first_error = None;
    for name in names {
        match skeleton.find(name) {
            Ok(node) => return Ok(node),
            Err(error) => first_error = first_error.or(Some(error)),
        }
    }
    Err(first_error.unwrap_or(Error::Chain { problem: "a joint without any bone name".into() }))
}

/// How a bake begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Settle {
    /// On the target, without regard to rates.
    Snap,
    /// From the animation: every angle 0.
    Animation,
}

/// What to bake.
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
    /// Whether the other eye is aimed itself, instead of turning as joint 0 does. What it is turned from is then not its
    /// own animation, but where it would look as joint 0 does: the eyes of animations are seldom parallel.
    pub both_eyes: bool,
    /// How long the baked clip is, seconds.
    pub seconds: f32,
    /// Keys a second.
    pub fps: f32,
    /// How the bake begins.
    pub settle: Settle,
    /// Whether to run the clip again, and record that, until it ends as it began.
    pub looped: bool,
    /// How to aim.
    pub settings: Settings,
}

/// A baked clip.
#[derive(Clone, Debug)]
pub struct Baked {
    /// The clip: the source's channels, the chain's rotations replaced.
    pub clip: Clip,
    /// What happened in each frame.
    pub frames: Vec<Frame>,
}

/// Aims `rig` over the plan's clip. `target` gives the target in the world from the time in seconds and the animated
/// nodes in the world; `progress` is told of every finished frame.
///
/// # Errors
/// A length or frame rate that makes no frames.
pub fn bake<R: AimRig<Array<Affine3A>: Clone>>(
    rig: &mut R,
    plan: &Plan<'_>,
    mut target: impl FnMut(f32, &[DAffine3]) -> DVec3,
    mut progress: impl FnMut(usize, usize),
) -> Result<Baked, Error> {
    let times = key_times(plan.seconds, plan.fps)?;
    let skeleton = plan.document.skeleton();
    let live = Live::new(rig, plan.document, plan.measurement, plan.chain, plan.both_eyes);
    let source = plan.clip.map(|clip| clip.repeated(plan.seconds));
    let sample = |t: f32| match &source {
        Some(clip) => skeleton.pose(clip, t),
        None => skeleton.rest_pose(),
    };
    let mut rotations: Vec<Vec<Quat>> = vec![Vec::with_capacity(times.len()); plan.chain.all().count()];
    let mut frames = Vec::with_capacity(times.len());
    for pass in 0..if plan.looped { MOST_ROUNDS } else { 1 } {
        rotations.iter_mut().for_each(Vec::clear);
        frames.clear();
        let mut began = rig.joints();
        let mut before: Option<f32> = None;
        for &t in times.iter() {
            let mut pose = sample(t);
            let world = skeleton.world_f64(&pose);
            let target_ws = target(t, &world);
            let joints = live.animated(rig, skeleton, &mut pose, &world);
            let goal = target_ws.as_vec3();
            let outcome = match (before, pass, plan.settle) {
                (Some(before), ..) => rig.aim_with(&joints, goal, t - before, &plan.settings),
                // The pass before ended here, perhaps in another pose: no time for an angle to move, but a frame.
                (None, 1.., _) => rig.aim_with(&joints, goal, f32::MIN_POSITIVE, &plan.settings),
                (None, 0, Settle::Animation) => rig.aim_with(&joints, goal, 0.0, &plan.settings),
                (None, 0, Settle::Snap) => rig.snap_with(&joints, goal, &plan.settings),
            };
            if before.is_none() {
                began = rig.joints();
            }
            before = Some(t);
            let effector = plan.settings.effector;
            let moment = Moment { t, target: target_ws, world: &world, joints: &joints, outcome, effector };
            let frame = live.aimed(rig, skeleton, &mut pose, &moment);
            for (track, node) in rotations.iter_mut().zip(plan.chain.all()) {
                track.push(continuous(track.last(), pose[node].rotation));
            }
            frames.push(frame);
            progress(frames.len(), times.len());
        }
        if closes(began.as_ref(), rig.joints().as_ref()) {
            break;
        }
    }
    let name = source.as_ref().map_or_else(|| "aim".to_owned(), |clip| clip.name.clone());
    let mut clip = source.unwrap_or_else(|| Clip::new(name, Vec::new()));
    for (node, track) in plan.chain.all().zip(&rotations) {
        clip.set(Channel::rotation(node, times.clone(), track));
    }
    Ok(Baked { clip, frames })
}

/// How often a loop is run at most to end as it begins; one whose clip or target jumps at the seam may never do.
const MOST_ROUNDS: u32 = 8;

/// Whether the joints are back where they began, whole turns aside.
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
        return Err(Error::Clip {
            problem: format!(
                "{seconds} s at {fps} frames a second make no clip; give a length and a rate of at least one frame and \
                 at most an hour at 144 Hz"
            ),
        });
    }
    #[expect(clippy::cast_precision_loss, reason = "the number of keys is bounded far below 2^24")]
    let mut times: Vec<f32> = (0_u32..).map(|key| key as f32 / fps).take_while(|t| *t + 0.01 / fps < seconds).collect();
    times.push(seconds);
    Ok(times.into())
}

/// The sign of a quaternion that interpolates the short way from the one before.
pub(crate) fn continuous(before: Option<&Quat>, rotation: Quat) -> Quat {
    if before.is_some_and(|before| before.dot(rotation) < 0.0) { -rotation } else { rotation }
}
