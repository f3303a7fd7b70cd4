//! The frame of a joint alone that looks along its own forward from its own origin, as an eye does: in closed form.
//!
//! Heading and pitch are the target's, each as near to it as range and rate let it come. For a target in front the gaze
//! comes the nearer the nearer the heading comes, whatever the pitch; so the heading first, and then the best pitch at
//! it, is the nearest gaze there is, also where a bound is in the way. Where none is, no other angles meet the target.
//! Gives up, having moved nothing, wherever anything is out of the ordinary.

use core::f32::consts::FRAC_PI_2;

use glam::{Quat, Vec3A};

use crate::exact::ENOUGH_RAD;
use crate::joint::{self, Side};
use crate::limits::AT_LIMIT_RAD;
use crate::pose::Animated;
use crate::rig::along;
use crate::view::View;
use crate::{AimRig, Axes, JointInfo, JointSet, Outcome, Settings, Status, chain, quick, trig};

/// The squared tangent of the elevation, 60°, beyond which headings tremble with their target.
const STEEP: f32 = 3.0;
/// How far away an ordinary target is, in lengths of the bone's own space; squared.
const NEAR: f32 = 1e-6;
const FAR: f32 = 1e8;

/// Aims for one frame of `dt` seconds, positive, if it is an ordinary one of such a joint. The solver is not the paper's.
#[inline]
pub(crate) fn aim<R: AimRig>(
    rig: &mut R,
    pose_ps: &Animated<'_>,
    target_ps: Vec3A,
    dt: f32,
    settings: &Settings,
) -> Option<Outcome> {
    let &[info] = rig.joint_infos() else { return None };
    let (Some(headings), Some(pitches)) = (info.heading, info.pitch) else { return None };
    let effector = rig.effector();
    if !(quick::is_plain(&info)
        && info.planes.are_square()
        && !info.is_level()
        && -FRAC_PI_2 <= pitches[0]
        && pitches[1] <= FRAC_PI_2
        && effector.origin == [0.0; 3]
        && effector.forward == info.axes.forward
        && settings.weight >= 1.0)
    {
        return None;
    }
    let pose = pose_ps.joints.get(..1)?;
    let scale = chain::common_scale(pose)?;
    let target = pose[0].matrix3.transpose() * ((target_ps - pose[0].translation) * (1.0 / scale));
    let animated = view(&info.axes, target);
    if !is_ordinary(&animated) {
        return None;
    }

    let joint = rig.joint_mut(0)?;
    if joint.bound_for.is_some() | joint.pair.is_some() | joint.behind || joint.memory.strain > 0.0 {
        return None;
    }
    let step = info.rate.max(0.0) * dt;
    let within = |[lo, hi]: [f32; 2], angle: f32| [greater(lo, angle - step), lesser(hi, angle + step)];
    let gaze = Gaze::towards(&info, &animated, within(headings, joint.heading), within(pitches, joint.pitch))?;
    let seen = gaze.sees(&info, target);
    let remaining = if seen.is_within(ENOUGH_RAD) { seen.tangent() } else { seen.angle() };
    let tolerance = settings.effective_tolerance();
    let status = if remaining <= tolerance {
        Status::Reached
    } else if gaze.is_nearest(headings, pitches) {
        Status::AtLimit
    } else {
        unhurried(rig, &animated, target, tolerance)?
    };

    let joint = rig.joint_mut(0)?;
    joint.side = Side::of(animated.left);
    joint.memory.blocked_s = if status == Status::Reached { 0.0 } else { joint.memory.blocked_s + dt };
    joint.put(gaze.angles, gaze.halves, gaze.turn, Quat::IDENTITY);
    let [pitch, heading] = gaze.angles;
    let ends = |[lo, hi]: [f32; 2], angle: f32| (angle <= lo + AT_LIMIT_RAD) | (angle >= hi - AT_LIMIT_RAD);
    let mut at_limit = JointSet::EMPTY;
    if ends(headings, heading) | ends(pitches, pitch) {
        at_limit.insert(0);
    }
    let (recovering, pair_remaining) = (JointSet::EMPTY, None);
    Some(Outcome { aim: seen.cosine(), remaining, status, at_limit, recovering, pair_remaining })
}

/// What keeps the joint from its target although it may still turn: its rate, or in the end its ranges too.
#[cold]
#[inline(never)]
fn unhurried<R: AimRig>(rig: &R, animated: &View, target: Vec3A, tolerance: f32) -> Option<Status> {
    let info = rig.joint_infos().first()?;
    let gaze = Gaze::towards(info, animated, info.heading?, info.pitch?)?;
    let within_reach = gaze.sees(info, target).angle() <= tolerance;
    Some(if within_reach { Status::RateLimited } else { Status::AtLimit })
}

/// A vector of the bone's space along its axes.
#[inline(always)]
fn view(axes: &Axes, v: Vec3A) -> View {
    View { forward: along(axes.forward, v), left: along(axes.left, v), up: along(axes.up, v) }
}

/// Whether a target is in front, not steep, and neither near nor far. NaN is none of these.
#[inline(always)]
fn is_ordinary(&View { forward, left, up }: &View) -> bool {
    let level = forward * forward + left * left;
    let far = level + up * up;
    forward > 0.0 && up * up < STEEP * level && NEAR < far && far < FAR
}

/// A pitch and a heading, and what follows from them.
struct Gaze {
    angles: [f32; 2],
    /// Those without bounds; the pitch's at this heading.
    wanted: [f32; 2],
    halves: trig::Halves,
    turn: Quat,
}

impl Gaze {
    /// The one within these bounds that comes nearest to an ordinary target; `None` where the heading is so far off that
    /// this is no matter of heading first, or where bounds leave nothing, as on the way back into a range.
    #[inline(always)]
    fn towards(info: &JointInfo, target: &View, headings: [f32; 2], pitches: [f32; 2]) -> Option<Self> {
        let View { forward, left, up } = *target;
        let wanted_heading = trig::atan2_ahead(left, forward);
        let heading = held(wanted_heading, headings)?;
        let (sin_h, cos_h) = trig::half_sin_cos_within(heading);
        let ahead = forward * (1.0 - 2.0 * sin_h * sin_h) + left * (2.0 * sin_h * cos_h);
        if !(4.0 * ahead * ahead > forward * forward + left * left && ahead > 0.0) {
            return None;
        }
        let wanted_pitch = trig::atan2_ahead(up, ahead);
        let pitch = held(wanted_pitch, pitches)?;
        let (sin_p, cos_p) = trig::half_sin_cos_within(pitch);
        let halves = [sin_p, cos_p, sin_h, cos_h];
        let turn = joint::turn(&info.axes, &info.planes, halves);
        Some(Self { angles: [pitch, heading], wanted: [wanted_pitch, wanted_heading], halves, turn })
    }

    /// Whether it would be no other within these bounds.
    #[inline(always)]
    fn is_nearest(&self, headings: [f32; 2], pitches: [f32; 2]) -> bool {
        [held(self.wanted[0], pitches), held(self.wanted[1], headings)] == self.angles.map(Some)
    }

    /// What it sees of a target of the bone's space.
    #[inline(always)]
    fn sees(&self, info: &JointInfo, target: Vec3A) -> View {
        view(&info.axes, quick::unturned(self.turn, target))
    }
}

/// The angle nearest to `angle` within bounds, if those leave any.
#[inline(always)]
fn held(angle: f32, [lo, hi]: [f32; 2]) -> Option<f32> {
    (lo <= hi).then(|| lesser(greater(angle, lo), hi))
}

/// The greater of two numbers: what to do about NaN takes the library's own as many instructions again.
#[inline(always)]
fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The lesser of two numbers.
#[inline(always)]
fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}
