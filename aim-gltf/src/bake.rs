//! Aims a rig over a clip, frame by frame, and makes the clip that does it: only the chain's rotations change.

use core::f32::consts::TAU;
use std::sync::Arc;

use aim_runtime::{AimRig, Joint, Outcome, Pose, Settings};
use glam::{Affine3A, DAffine3, DMat3, DQuat, DVec3, Quat};

use crate::clip::{Channel, Clip};
use crate::document::Document;
use crate::error::Error;
use crate::measure::Measurement;
use crate::skeleton::Skeleton;
use crate::stance::Stance;
use crate::trs::{Trs, orthonormal};

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

/// One joint in one frame.
#[derive(Clone, Copy, Debug)]
pub struct JointFrame {
    /// Added heading, radians.
    pub heading: f32,
    /// Added pitch, radians.
    pub pitch: f32,
    /// The heading and pitch, radians, by which the animation turns the joint out of its bind pose, where its ranges are
    /// counted from that.
    pub led: Option<[f64; 2]>,
    /// Whether an angle is at an end of its range.
    pub at_limit: bool,
    /// Whether an angle is on its way back into its range.
    pub recovering: bool,
}

/// One frame.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Seconds.
    pub t: f32,
    /// The target in the world.
    pub target: DVec3,
    /// Between the effector and the direction to the target by the forward kinematics of the file as it is written,
    /// degrees; 90 where either has no direction.
    pub error_deg: f64,
    /// By how much joint 0 is rolled about the gaze more than in the animation, degrees, positive to the character's
    /// left: a roll is the angle, seen along the gaze, from the character's up to the bone's up. 0 where either lies
    /// along the gaze (within 1°). The character's up is the world's as long as the character stands.
    pub roll_deg: f64,
    /// What [`error_deg`](Self::error_deg) is, of the other eye, where both are aimed: it looks as joint 0 does in the
    /// bind pose, from the mirrored point.
    pub pair_error_deg: Option<f64>,
    /// What the solver says.
    pub outcome: Outcome,
    /// Each joint, from the effector inward.
    pub joints: Vec<JointFrame>,
    /// The file's nodes in the world, aimed.
    pub world: Vec<DAffine3>,
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
    let stance = Stance::new(rig, skeleton, plan.chain, plan.measurement);
    let pair = plan.chain.pair.filter(|_| plan.both_eyes);
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
            let joints = Pose { joints: joint_transforms(rig, plan.chain, &pose, &world) };
            let mut joints = joints.with_up(stance.up(&world).as_vec3()).with_bind(stance.bind(rig, &world));
            if let Some(pair) = pair {
                pose[pair].rotation = stance.parallel(skeleton, &pose, &world).unwrap_or(pose[pair].rotation);
                joints = joints.with_pair(joint_transform(&pose, &skeleton.world_f64(&pose), pair));
            }
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
            apply(rig, plan.chain, rig.pair_correction(), skeleton, &mut pose);
            for (track, node) in rotations.iter_mut().zip(plan.chain.all()) {
                track.push(continuous(track.last(), pose[node].rotation));
            }
            let aimed = skeleton.world_f64(&pose);
            frames.push(Frame {
                t,
                target: target_ws,
                error_deg: stance.error_deg(&aimed, target_ws),
                roll_deg: stance.roll_deg(&world, &aimed),
                pair_error_deg: pair.and_then(|_| stance.pair_error_deg(&aimed, target_ws)),
                outcome,
                joints: joint_frames(rig, outcome, |joint| stance.led(rig, joint, &joints)),
                world: aimed,
            });
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

/// The joints in the world as the solver takes them.
fn joint_transforms<R: AimRig>(rig: &R, chain: &ChainNodes, pose: &[Trs], world: &[DAffine3]) -> R::Array<Affine3A> {
    let mut joints = rig.array(Affine3A::IDENTITY);
    for (joint, &node) in joints.as_mut().iter_mut().zip(&chain.joints) {
        *joint = joint_transform(pose, world, node);
    }
    joints
}

/// A node in the world without its own non-uniform scale, so that a correction acts where the node's rotation does.
fn joint_transform(pose: &[Trs], world: &[DAffine3], node: usize) -> Affine3A {
    let scale = pose[node].scale.abs().as_dvec3();
    let uniform = (scale - DVec3::splat(scale.x)).abs().max_element() <= 1e-5 * scale.max_element();
    let own = if uniform || scale.min_element() == 0.0 { DVec3::ONE } else { scale.recip() };
    (world[node] * DAffine3::from_scale(own)).as_affine3a()
}

/// Multiplies the rig's corrections into the chain's local rotations, and the other eye's into its; without one that
/// eye turns in the world as joint 0 does.
fn apply<R: AimRig>(rig: &R, chain: &ChainNodes, pair: Option<Quat>, skeleton: &Skeleton, pose: &mut [Trs]) {
    let eye = chain.joints[0];
    let before = pose[eye].rotation.as_dquat();
    for (joint, correction) in rig.corrections() {
        pose[chain.joints[joint]].turn(correction);
    }
    match (chain.pair, pair) {
        (Some(node), Some(correction)) => pose[node].turn(correction),
        (Some(node), None) => follow(eye, before, node, skeleton, pose),
        (None, _) => {}
    }
}

/// Turns `pair` in the world as the `eye` turned from its rotation `before`.
fn follow(eye: usize, before: DQuat, pair: usize, skeleton: &Skeleton, pose: &mut [Trs]) {
    let turn = DMat3::from_quat(pose[eye].rotation.as_dquat() * before.inverse());
    let world = skeleton.world_f64(pose);
    // Orthogonal, but not always a rotation: a parent may be mirrored.
    let parent = |node: usize| match skeleton.nodes()[node].parent {
        Some(parent) => orthonormal(&world[parent].matrix3).0,
        None => DMat3::IDENTITY,
    };
    let to_pair = parent(pair).transpose() * parent(eye);
    let turn = DQuat::from_mat3(&(to_pair * turn * to_pair.transpose())).as_quat();
    pose[pair].rotation = (turn * pose[pair].rotation).normalize();
}

/// The sign of a quaternion that interpolates the short way from the one before.
pub(crate) fn continuous(before: Option<&Quat>, rotation: Quat) -> Quat {
    if before.is_some_and(|before| before.dot(rotation) < 0.0) { -rotation } else { rotation }
}

fn joint_frames<R: AimRig>(rig: &R, outcome: Outcome, led: impl Fn(usize) -> Option<[f64; 2]>) -> Vec<JointFrame> {
    let joints = rig.joints();
    let joints = joints.as_ref().iter().enumerate().map(|(i, joint)| JointFrame {
        heading: joint.heading(),
        pitch: joint.pitch(),
        led: led(i),
        at_limit: outcome.at_limit.contains(i),
        recovering: outcome.recovering.contains(i),
    });
    joints.collect()
}
