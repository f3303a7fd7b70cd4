//! Leads a hand or foot through given points at given times: its trajectory is deformed as a whole, its limb follows.

use std::sync::Arc;

use aim_runtime::glam::{DAffine3, DQuat, DVec3, Quat, Vec3};
use aim_runtime::ik::{Limb, TwoBone, TwoBoneStatus};
use aim_runtime::trajectory::{Node, Outcome, Trajectory, Waypoint};

use crate::bake::live::rounded;
use crate::bake::{continuous, key_times, line};
use crate::error::Error;
use crate::measure::frame::parent_frame;
use aim_animation::Clip;
use aim_animation::Transform;
use aim_gltf::Document;
use aim_gltf::Skeleton;

/// A bone that is led, and the two above it that follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LimbNodes {
    /// Upper arm or thigh.
    pub upper: usize,
    /// Forearm or shank.
    pub lower: usize,
    /// Hand or foot.
    pub tip: usize,
}

impl LimbNodes {
    /// The bone of that name, its parent and its grandparent.
    ///
    /// # Errors
    /// A bone that is not there, not unique, or without two bones above it.
    pub fn find(skeleton: &Skeleton, bone: &str) -> Result<Self, Error> {
        let tip = skeleton.find(bone)?;
        let mut above = skeleton.ancestry(tip).skip(1);
        match (above.next(), above.next()) {
            (Some(lower), Some(upper)) => Ok(Self { upper, lower, tip }),
            _ => Err(Error::Chain(format!("{bone:?} has no two bones above it to follow; name a hand or a foot"))),
        }
    }
}

/// A point that the bone has to pass at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// Seconds, within the clip.
    pub at: f32,
    /// In the world.
    pub target: DVec3,
}

/// A request to lead a bone through points.
#[derive(Clone, Copy, Debug)]
pub struct ReachPlan<'a> {
    /// The file.
    pub document: &'a Document,
    /// The clip.
    pub clip: &'a Clip,
    /// The bones.
    pub limb: LimbNodes,
    /// The points, at least one; no two within a frame.
    pub goals: &'a [Goal],
    /// Keys a second. One key is moved to the time of each goal.
    pub fps: f32,
}

/// Result for one goal.
#[derive(Clone, Copy, Debug)]
pub struct Arrival {
    /// The goal.
    pub goal: Goal,
    /// Its frame.
    pub frame: usize,
    /// The point that the bone was led to: the target, or the nearest point within the limb's reach at that time.
    pub aimed: DVec3,
    /// Reach of the target: within it, too far or too near.
    pub reach: TwoBoneStatus,
}

/// One frame. Points are in the world.
#[derive(Clone, Copy, Debug)]
pub struct LimbFrame {
    /// Seconds.
    pub t: f32,
    /// The bone as animated.
    pub before: DVec3,
    /// The bone on the deformed trajectory.
    pub wanted: DVec3,
    /// Result of the limb's solver.
    pub status: TwoBoneStatus,
}

/// A clip in which the bone comes through its goals.
#[derive(Clone, Debug)]
pub struct Reached {
    /// The clip: the source's channels, the rotations of the three bones replaced.
    pub clip: Clip,
    /// The limb's length in the first frame, in the world.
    pub length: f64,
    /// Each goal.
    pub arrivals: Vec<Arrival>,
    /// The deformation.
    pub outcome: Outcome,
    /// The result of each frame.
    pub frames: Vec<LimbFrame>,
}

/// Deforms the trajectory of the plan's bone and has the limb follow it: the plane that it bends in and the bone's
/// orientation in the world stay those of the animation.
///
/// ```
/// use aim_character::{Goal, LimbNodes, PAPER_AXES, ReachPlan, mannequin, reach};
/// use aim_gltf::Document;
/// use aim_runtime::glam::DVec3;
///
/// let document = Document::from_bytes(&mannequin(|_| PAPER_AXES)?)?;
/// let plan = ReachPlan {
///     document: &document,
///     clip: document.clip("walk")?,
///     limb: LimbNodes::find(document.skeleton(), "left_hand")?,
///     goals: &[Goal { at: 0.6, target: DVec3::new(0.3, 1.1, 0.4) }],
///     fps: 60.0,
/// };
/// let reached = reach(&plan)?;
/// assert!(reached.arrivals[0].aimed.distance(plan.goals[0].target) < 1e-6); // within the arm's reach
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A frame rate that makes no frames; a goal outside the clip, or within a frame of another; a limb without length.
pub fn reach(plan: &ReachPlan<'_>) -> Result<Reached, Error> {
    let (times, goal_frames) = frame_times(plan)?;
    let skeleton = plan.document.skeleton();
    let poses: Vec<Vec<Transform>> = times.iter().map(|&t| skeleton.pose(plan.clip, t)).collect();
    let limbs: Vec<[DVec3; 3]> = poses.iter().map(|pose| joints(&skeleton.world_f64(pose), plan.limb)).collect();
    let length = bones(limbs[0]).iter().sum::<f64>();
    if bones(limbs[0]).contains(&0.0) || !length.is_finite() {
        return Err(Error::Chain("the limb has a bone without length; name a hand or a foot".into()));
    }
    let arrival = |(&goal, frame): (&Goal, usize)| {
        let (aimed, reach) = within_reach(limbs[frame], goal.target);
        Arrival { goal, frame, aimed, reach }
    };
    let arrivals: Vec<Arrival> = plan.goals.iter().zip(goal_frames).map(arrival).collect();

    let (points, wanted, outcome) = deform(&limbs, &times, &arrivals, length);
    let nodes = [plan.limb.upper, plan.limb.lower, plan.limb.tip];
    let mut tracks: [Vec<Quat>; 3] = Default::default();
    let mut frames = Vec::with_capacity(times.len());
    for (((&t, mut pose), &before), &wanted) in times.iter().zip(poses).zip(&points).zip(&wanted) {
        let status = if wanted == before {
            TwoBoneStatus::Reached
        } else {
            follow(skeleton, plan.limb, &mut pose, wanted, length)
        };
        for (track, node) in tracks.iter_mut().zip(nodes) {
            track.push(continuous(track.last(), pose[node].rotation));
        }
        frames.push(LimbFrame { t, before, wanted, status });
    }
    let mut clip = plan.clip.clone();
    for (node, rotations) in nodes.into_iter().zip(tracks) {
        clip = clip.with_rotation(node, line(&times, rotations)?);
    }
    Ok(Reached { clip, length, arrivals, outcome, frames })
}

/// The times of keys, one of them that of each goal, and which.
fn frame_times(plan: &ReachPlan<'_>) -> Result<(Arc<[f32]>, Vec<usize>), Error> {
    let seconds = plan.clip.length_s();
    let fail = |problem: String| Err(Error::Clip(problem));
    let mut times = key_times(seconds, plan.fps)?.to_vec();
    let last = times.len() - 1;
    let mut frames = Vec::new();
    for goal in plan.goals {
        if !(0.0..=seconds).contains(&goal.at) {
            let (at, clip) = (goal.at, plan.clip.name());
            return fail(format!("{at} s is not within the clip {clip:?}, which ends at {seconds} s"));
        }
        // The clip's own ends stay where they are.
        let nearest = times.partition_point(|&t| t < goal.at).min(last);
        let frame = match nearest {
            _ if times[nearest] == goal.at => nearest,
            0 => 0,
            k if goal.at - times[k - 1] < times[k] - goal.at && k > 1 || k == last => k - 1,
            k => k,
        };
        if frames.contains(&frame) || (frame == 0 || frame == last) && times[frame] != goal.at {
            return fail(format!("{} s is less than a frame from another goal or the end; raise --fps", goal.at));
        }
        times[frame] = goal.at;
        frames.push(frame);
    }
    Ok((times.into(), frames))
}

fn joints(world: &[DAffine3], limb: LimbNodes) -> [DVec3; 3] {
    [limb.upper, limb.lower, limb.tip].map(|node| world[node].translation)
}

fn bones([root, middle, tip]: [DVec3; 3]) -> [f64; 2] {
    [root.distance(middle), middle.distance(tip)]
}

/// The point nearest to the target that the limb reaches from where its root is, and whether that is the target.
fn within_reach(limb: [DVec3; 3], target: DVec3) -> (DVec3, TwoBoneStatus) {
    let [upper, lower] = bones(limb);
    let (way, near, far) = (target - limb[0], (upper - lower).abs(), upper + lower);
    let at = |distance: f64| limb[0] + way.try_normalize().unwrap_or(DVec3::X) * distance;
    match way.length() {
        distance if distance > far => (at(far), TwoBoneStatus::TooFar),
        distance if distance < near => (at(near), TwoBoneStatus::TooNear),
        _ => (target, TwoBoneStatus::Reached),
    }
}

/// The trajectory as animated, and deformed: seen from the limb's root, which walks along with the character, and in units
/// of the limb, where single precision is finest. What does not move stays exactly where it is.
fn deform(limbs: &[[DVec3; 3]], times: &[f32], arrivals: &[Arrival], length: f64) -> (Vec<DVec3>, Vec<DVec3>, Outcome) {
    let seen = |point: DVec3, frame: usize| ((point - limbs[frame][0]) / length).as_vec3();
    let points: Vec<DVec3> = limbs.iter().map(|limb| limb[2]).collect();
    let rest: Vec<Vec3> = points.iter().enumerate().map(|(frame, &point)| seen(point, frame)).collect();
    let waypoints = arrivals.iter().map(|arrival| Waypoint::new(arrival.frame, seen(arrival.aimed, arrival.frame)));
    let waypoints: Vec<Waypoint> = waypoints.collect();
    let (mut through, mut nodes) = (rest.clone(), vec![Node::default(); rest.len()]);
    let outcome = Trajectory::new(&rest).with_times(times).deform(&waypoints, &mut through, &mut nodes);
    let back = |(limb, (rest, through)): (&[DVec3; 3], (&Vec3, &Vec3))| {
        if rest == through { limb[2] } else { limb[0] + through.as_dvec3() * length }
    };
    let mut wanted: Vec<DVec3> = limbs.iter().zip(rest.iter().zip(&through)).map(back).collect();
    for arrival in arrivals {
        wanted[arrival.frame] = arrival.aimed;
    }
    (points, wanted, outcome)
}

/// Largest number of times a limb is solved in a frame: more than once only if scales in the chain shear its rotations.
const MOST_ROUNDS: usize = 8;
/// As near as is worth another round, of the limb's length.
const NEAR: f64 = 1e-6;

/// Turns the limb so that its tip is at `wanted`, the tip itself oriented as before.
fn follow(skeleton: &Skeleton, limb: LimbNodes, pose: &mut [Transform], wanted: DVec3, length: f64) -> TwoBoneStatus {
    let animated = parent_frame(skeleton, &skeleton.world_f64(pose), limb.tip);
    let mut status = TwoBoneStatus::Degenerate;
    for _ in 0..MOST_ROUNDS {
        let world = skeleton.world_f64(pose);
        let [root, middle, tip] = joints(&world, limb);
        let local = |point: DVec3| ((point - root) / length).as_vec3();
        let outcome =
            TwoBone::new().solve(&Limb { root: Vec3::ZERO, middle: local(middle), tip: local(tip) }, local(wanted));
        status = outcome.status;
        let [upper, lower] = [outcome.upper, outcome.lower].map(|turn| turn.as_dquat().normalize());
        turn(skeleton, pose, limb.upper, upper);
        turn(skeleton, pose, limb.lower, lower * upper.inverse());
        if joints(&skeleton.world_f64(pose), limb)[2].distance(wanted) <= NEAR * length
            || matches!(status, TwoBoneStatus::TooFar | TwoBoneStatus::TooNear | TwoBoneStatus::Degenerate)
        {
            break;
        }
    }
    let now = parent_frame(skeleton, &skeleton.world_f64(pose), limb.tip);
    turn(skeleton, pose, limb.tip, DQuat::from_mat3(&(animated * now.transpose())));
    status
}

/// Turns a node in the world.
fn turn(skeleton: &Skeleton, pose: &mut [Transform], node: usize, turn: DQuat) {
    let model = rounded(&skeleton.world_f64(pose));
    // Of equal lengths.
    let _ = skeleton.turn_in_model(node, turn.as_quat(), &model, pose);
}
