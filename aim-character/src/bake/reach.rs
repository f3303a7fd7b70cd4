//! Leads a hand or foot through given points at given times: deforms its trajectory as a whole and makes the limb
//! follow.

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

/// A bone that is led through points, and the two bones above it that follow.
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
    /// Finds the bone by name; the other two are its parent and grandparent.
    ///
    /// # Errors
    /// Fails if the name does not match exactly one bone, or if the bone has fewer than two ancestors.
    pub fn find(skeleton: &Skeleton, bone: &str) -> Result<Self, Error> {
        let tip = skeleton.find(bone)?;
        let mut above = skeleton.ancestry(tip).skip(1);
        match (above.next(), above.next()) {
            (Some(lower), Some(upper)) => Ok(Self { upper, lower, tip }),
            _ => Err(Error::Chain(format!(
                "{bone:?} has no parent and grandparent that could follow it; name a hand or a foot"
            ))),
        }
    }
}

/// A point through which the bone passes at a given time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// Time within the clip, seconds.
    pub at: f32,
    /// Position in world space.
    pub target: DVec3,
}

/// Inputs of [`reach()`].
#[derive(Clone, Copy, Debug)]
pub struct ReachPlan<'a> {
    /// The file.
    pub document: &'a Document,
    /// The clip to change.
    pub clip: &'a Clip,
    /// The bones of the limb.
    pub limb: LimbNodes,
    /// Points to pass, at least one; no two within one frame.
    pub goals: &'a [Goal],
    /// Keys per second. For each goal one key is moved to the goal's time.
    pub fps: f32,
}

/// Result for one goal.
#[derive(Clone, Copy, Debug)]
pub struct Arrival {
    /// The goal.
    pub goal: Goal,
    /// Index of the goal's frame.
    pub frame: usize,
    /// Point to which the bone was led: the target, or the point nearest to it within the limb's reach at that time.
    pub aimed: DVec3,
    /// Reach of the target: within it, too far or too near.
    pub reach: TwoBoneStatus,
}

/// Result for one frame, in world space.
#[derive(Clone, Copy, Debug)]
pub struct LimbFrame {
    /// Time of the frame, seconds.
    pub t: f32,
    /// Animated position of the bone.
    pub before: DVec3,
    /// Position of the bone on the deformed trajectory.
    pub wanted: DVec3,
    /// Status of the limb's solver.
    pub status: TwoBoneStatus,
}

/// Result of [`reach()`]: a clip in which the bone passes its goals.
#[derive(Clone, Debug)]
pub struct Reached {
    /// The clip: the source's tracks, with the rotations of the three bones replaced.
    pub clip: Clip,
    /// Length of the limb in the first frame, in world units.
    pub length: f64,
    /// Result of each goal.
    pub arrivals: Vec<Arrival>,
    /// Outcome of the deformation.
    pub outcome: Outcome,
    /// Result of each frame.
    pub frames: Vec<LimbFrame>,
}

/// Deforms the trajectory of the plan's bone and makes the limb follow it. The plane in which the limb bends and the
/// bone's orientation in the world stay those of the animation.
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
/// Fails if the frame rate makes no frames, if a goal lies outside the clip or within a frame of another goal, or if a
/// bone of the limb has no length.
pub fn reach(plan: &ReachPlan<'_>) -> Result<Reached, Error> {
    let (times, goal_frames) = frame_times(plan)?;
    let skeleton = plan.document.skeleton();
    let poses: Vec<Vec<Transform>> = times.iter().map(|&t| skeleton.pose(plan.clip, t)).collect();
    let limbs: Vec<[DVec3; 3]> = poses.iter().map(|pose| joints(&skeleton.world_f64(pose), plan.limb)).collect();
    let length = bones(limbs[0]).iter().sum::<f64>();
    if bones(limbs[0]).contains(&0.0) || !length.is_finite() {
        return Err(Error::Chain("a bone of the limb has no length; name a hand or a foot".into()));
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

/// Returns the times of the keys, including those of the goals, and the index of each goal's key.
fn frame_times(plan: &ReachPlan<'_>) -> Result<(Arc<[f32]>, Vec<usize>), Error> {
    let seconds = plan.clip.length_s();
    let fail = |problem: String| Err(Error::Clip(problem));
    let mut times = key_times(seconds, plan.fps)?.to_vec();
    let last = times.len() - 1;
    let mut frames = Vec::new();
    for goal in plan.goals {
        if !(0.0..=seconds).contains(&goal.at) {
            let (at, clip) = (goal.at, plan.clip.name());
            return fail(format!("{at} s is outside the clip {clip:?}, which ends at {seconds} s"));
        }
        // The first and last keys keep their times.
        let nearest = times.partition_point(|&t| t < goal.at).min(last);
        let frame = match nearest {
            _ if times[nearest] == goal.at => nearest,
            0 => 0,
            k if goal.at - times[k - 1] < times[k] - goal.at && k > 1 || k == last => k - 1,
            k => k,
        };
        if frames.contains(&frame) || (frame == 0 || frame == last) && times[frame] != goal.at {
            return fail(format!(
                "{} s is less than one frame from another target or an end of the clip; raise --fps",
                goal.at
            ));
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

/// Returns the point nearest to the target that the limb can reach from its present root, and whether that is the
/// target.
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

/// Returns the animated and the deformed trajectory. The deformation is computed relative to the limb's root, which
/// moves with the character, in units of the limb's length, for the best precision in `f32`. Points that do not move
/// are returned exactly.
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

/// Largest number of times a limb is solved in one frame; more than once only if scales in the chain shear the
/// rotations.
const MOST_ROUNDS: usize = 8;
/// Distance from the target, as a share of the limb's length, at which no further round is needed.
const NEAR: f64 = 1e-6;

/// Turns the limb so that its tip is at `wanted`. The tip keeps its orientation in the world.
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

/// Turns a node by a rotation given in world space.
fn turn(skeleton: &Skeleton, pose: &mut [Transform], node: usize, turn: DQuat) {
    let model = rounded(&skeleton.world_f64(pose));
    // Both slices have the skeleton's length.
    let _ = skeleton.turn_in_model(node, turn.as_quat(), &model, pose);
}
