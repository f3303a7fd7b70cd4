//! The frame of a joint alone that looks along its own forward from its own origin, as an eye does: in closed form.
//!
//! Heading and pitch are the target's, each as near to it as range and rate let it come. For a target in front the gaze
//! comes the nearer the nearer the heading comes, whatever the pitch; so the heading first, and then the best pitch at
//! it, is the nearest gaze there is, also where a bound is in the way. Where none is, no other angles meet the target.
//! Gives up, having moved nothing, wherever anything is out of the ordinary.

use core::f32::consts::{FRAC_PI_2, PI};

use glam::{Mat3A, Quat, Vec3, Vec3A};

use crate::joint::{self, Side};
use crate::limits::AT_LIMIT_RAD;
use crate::pose::Animated;
use crate::rig::along;
use crate::view::View;
use crate::{AimRig, Axes, Joint, JointInfo, JointSet, Outcome, Scalar, Settings, Status, chain, quick, trig};

/// The squared tangent of the elevation, 60°, beyond which headings tremble with their target.
const STEEP: f32 = 3.0;
/// How far ahead of a heading, in parts of its distance, a target has to be: within 80° or so, beyond which pitches tremble
/// with it.
const FAR_OFF: f32 = 0.173_648_18;
/// How far away an ordinary target is, in lengths of the bone's own space; squared.
const NEAR: f32 = 1e-6;
const FAR: f32 = 1e8;

/// Aims for one frame of `dt` seconds, positive, if it is an ordinary one of such a joint that has the time it takes. The
/// solver is not the paper's.
#[inline]
pub(crate) fn aim<R: AimRig>(
    rig: &mut R,
    pose_ps: &Animated<'_>,
    target_ps: Vec3,
    dt: f32,
    settings: &Settings,
) -> Option<Outcome> {
    let eye = Eye::new(rig, pose_ps, target_ps, settings)?;
    let joint = rig.joint_mut(0)?;
    let gaze = eye.gaze(joint, eye.reach(joint, dt)?)?;
    let status = if gaze.remaining <= settings.effective_tolerance() {
        Status::Reached
    } else if gaze.is_nearest {
        Status::AtLimit
    } else {
        return None;
    };
    Some(eye.put(joint, &gaze, status, dt))
}

/// [`aim`] for a joint that could yet turn further towards its target: is it its rate that keeps it from there, or in
/// the end its ranges too?
pub(crate) fn aim_in_haste<R: AimRig>(
    rig: &mut R,
    pose_ps: &Animated<'_>,
    target_ps: Vec3,
    dt: f32,
    settings: &Settings,
) -> Option<Outcome> {
    let eye = Eye::new(rig, pose_ps, target_ps, settings)?;
    let joint = rig.joint_mut(0)?;
    let gaze = eye.gaze(joint, eye.reach(joint, dt)?)?;
    let within_reach = eye.gaze(joint, eye.ranges)?.remaining <= settings.effective_tolerance();
    Some(eye.put(joint, &gaze, if within_reach { Status::RateLimited } else { Status::AtLimit }, dt))
}

/// Such a joint, and an ordinary target of it.
struct Eye {
    info: JointInfo,
    /// Of pitch and heading, as all pairs here.
    ranges: [[f32; 2]; 2],
    /// In lengths of the bone's own space, and along its axes.
    target: Vec3A,
    animated: View,
    distance: f32,
}

impl Eye {
    #[inline(always)]
    fn new<R: AimRig>(rig: &R, pose_ps: &Animated<'_>, target_ps: Vec3, settings: &Settings) -> Option<Self> {
        let &[info] = rig.joint_infos() else { return None };
        let ranges = [info.pitch?, info.heading?];
        let effector = rig.effector();
        if !(quick::is_plain(&info)
            && info.planes.are_square()
            && !info.is_level()
            && -FRAC_PI_2 <= ranges[0][0]
            && ranges[0][1] <= FRAC_PI_2
            && effector.origin == [0.0; 3]
            && effector.forward == info.axes.forward
            && settings.weight >= 1.0)
        {
            return None;
        }
        let pose = pose_ps.joints.get(..1)?;
        let square_scale = chain::common_scale(pose)?;
        // The inverse of a frame that is turned and scaled is its transpose, divided by the square of its scale.
        let to_target = (Vec3A::from(target_ps) - pose[0].translation) / square_scale;
        let Mat3A { x_axis: x, y_axis: y, z_axis: z } = pose[0].matrix3;
        let products = Mat3A::from_cols(x * to_target, y * to_target, z * to_target).transpose();
        let target = products.x_axis + products.y_axis + products.z_axis;
        let animated = view(&info.axes, target);
        is_ordinary(&animated).then(|| Self { info, ranges, target, animated, distance: animated.distance() })
    }

    /// How far pitch and heading get in a frame, if the joint is as an ordinary frame finds it.
    #[inline(always)]
    fn reach(&self, joint: &Joint, dt: f32) -> Option<[[f32; 2]; 2]> {
        // There is no strain below 0, and of this one comparing the bits takes fewer instructions.
        let is_strained = joint.memory.strain.to_bits() != 0;
        if joint.bound_for.is_some() | joint.pair.is_some() | joint.behind | is_strained {
            return None;
        }
        let step = self.info.rate.max(0.0) * dt;
        let within = |[lo, hi]: [f32; 2], angle: f32| [greater(lo, angle - step), lesser(hi, angle + step)];
        let [pitches, headings] = self.ranges;
        Some([within(pitches, joint.pitch), within(headings, joint.heading)])
    }

    /// The gaze within these bounds that comes nearest to the target; `None` where the heading is so far off that this is
    /// no matter of heading first, or where bounds leave nothing, as on the way back into a range.
    #[inline(always)]
    fn gaze(&self, joint: &Joint, [pitches, headings]: [[f32; 2]; 2]) -> Option<Gaze> {
        let up = self.animated.up;
        let Sideways { heading, mut is_nearest, half: (sin_h, cos_h), ahead } =
            self.stays(joint).or_else(|| self.sideways(headings))?;
        // Pitches are mostly within bounds: their arctangent is taken together with the one that is needed in the end.
        let half_tangent = up / (ahead + length(ahead, up));
        let mut sight = self.sight(trig::half_by_tangent(half_tangent), (sin_h, cos_h));
        let [wanted_pitch, mut remaining] = trig::twice_atan_of_both([half_tangent, sight.half_tangent]);
        let mut pitch = wanted_pitch;
        if !is_within(pitches, wanted_pitch) {
            pitch = held(wanted_pitch, pitches)?;
            is_nearest &= Some(pitch) == held(wanted_pitch, self.ranges[0]);
            sight = self.sight(trig::half_sin_cos_within(pitch), (sin_h, cos_h));
            remaining = if sight.half_tangent > 1.0 {
                PI - trig::twice_atan(1.0 / sight.half_tangent)
            } else {
                trig::twice_atan(sight.half_tangent)
            };
        }
        Some(Gaze { angles: [pitch, heading], is_nearest, remaining, sight })
    }

    /// The heading of a joint that is at an end of its range already, when the target is further that way.
    #[inline(always)]
    fn stays(&self, joint: &Joint) -> Option<Sideways> {
        // The very end, bit by bit.
        let [is_rightmost, is_leftmost] = self.ranges[1].map(|end| end.to_bits() == joint.heading.to_bits());
        if !((is_rightmost || is_leftmost) && joint.is_halved()) {
            return None;
        }
        let [.., sin_h, cos_h] = joint.halves;
        let (ahead, aside) = turned_from(&self.animated, (sin_h, cos_h));
        let is_beyond = if is_leftmost { aside > 0.0 } else { aside < 0.0 };
        let half = (sin_h, cos_h);
        let stays = Sideways { heading: joint.heading, is_nearest: true, half, ahead };
        (is_beyond && ahead > FAR_OFF * aside.abs()).then_some(stays)
    }

    /// The heading within these bounds that comes nearest to the target.
    #[inline(always)]
    fn sideways(&self, headings: [f32; 2]) -> Option<Sideways> {
        let View { forward, left, .. } = self.animated;
        let level = length(forward, left);
        let half_tangent = left / (level + forward);
        let wanted = trig::twice_atan(half_tangent);
        if is_within(headings, wanted) {
            let half = trig::half_by_tangent(half_tangent);
            return Some(Sideways { heading: wanted, is_nearest: true, half, ahead: level });
        }
        let heading = held(wanted, headings)?;
        let is_nearest = Some(heading) == held(wanted, self.ranges[1]);
        let half = trig::half_sin_cos_within(heading);
        let (ahead, _) = turned_from(&self.animated, half);
        (ahead > FAR_OFF * level).then_some(Sideways { heading, is_nearest, half, ahead })
    }

    /// What a gaze with these halves of pitch and heading sees of the target.
    #[inline(always)]
    fn sight(&self, (sin_p, cos_p): (f32, f32), (sin_h, cos_h): (f32, f32)) -> Sight {
        let halves = [sin_p, cos_p, sin_h, cos_h];
        let turn = joint::turn(&self.info.axes, &self.info.planes, halves);
        let seen = view(&self.info.axes, quick::unturned(turn, self.target));
        let half_tangent = seen.lateral() / (self.distance + seen.forward);
        Sight { halves, turn, cosine: seen.forward / self.distance, half_tangent }
    }

    /// Leaves the joint there at the end of a frame.
    #[inline(always)]
    fn put(&self, joint: &mut Joint, gaze: &Gaze, status: Status, dt: f32) -> Outcome {
        joint.side = Side::of(self.animated.left);
        joint.memory.blocked_s = if status == Status::Reached { 0.0 } else { joint.memory.blocked_s + dt };
        joint.put(gaze.angles, gaze.sight.halves, gaze.sight.turn, Quat::IDENTITY);
        let ends = |[lo, hi]: [f32; 2], angle: f32| (angle <= lo + AT_LIMIT_RAD) | (angle >= hi - AT_LIMIT_RAD);
        let mut at_limit = JointSet::EMPTY;
        if ends(self.ranges[0], gaze.angles[0]) | ends(self.ranges[1], gaze.angles[1]) {
            at_limit.insert(0);
        }
        let (aim, remaining) = (gaze.sight.cosine, gaze.remaining);
        Outcome { aim, remaining, status, at_limit, recovering: JointSet::EMPTY, pair_remaining: None }
    }
}

/// A heading.
struct Sideways {
    heading: f32,
    /// Whether it would be no other, had the joint all of its range.
    is_nearest: bool,
    /// The sine and cosine of its half.
    half: (f32, f32),
    /// How far ahead the target is then, seen from above.
    ahead: f32,
}

/// A pitch and a heading, and what follows from them.
struct Gaze {
    angles: [f32; 2],
    /// Whether it would be no other, had the joint all of its ranges.
    is_nearest: bool,
    /// The angle that is left to the target, by forward kinematics.
    remaining: f32,
    sight: Sight,
}

/// A correction, and how far off forward the target then is by forward kinematics.
struct Sight {
    halves: trig::Halves,
    turn: Quat,
    /// The cosine of that angle, and the tangent of its half.
    cosine: f32,
    half_tangent: f32,
}

/// A vector of the bone's space along its axes.
#[inline(always)]
fn view(axes: &Axes, v: Vec3A) -> View {
    View { forward: along(axes.forward, v), left: along(axes.left, v), up: along(axes.up, v) }
}

/// How far ahead of a heading with these halves a target is, seen from above, and how far aside to the left.
#[inline(always)]
fn turned_from(&View { forward, left, .. }: &View, (sin_half, cos_half): (f32, f32)) -> (f32, f32) {
    let (sin, cos) = (2.0 * sin_half * cos_half, 1.0 - 2.0 * sin_half * sin_half);
    (forward * cos + left * sin, left * cos - forward * sin)
}

/// Whether a target is in front, not steep, and neither near nor far. NaN is none of these.
#[inline(always)]
fn is_ordinary(&View { forward, left, up }: &View) -> bool {
    let level = forward * forward + left * left;
    let far = level + up * up;
    forward > 0.0 && up * up < STEEP * level && NEAR < far && far < FAR
}

/// Whether an angle is within bounds.
#[inline(always)]
fn is_within([lo, hi]: [f32; 2], angle: f32) -> bool {
    lo <= angle && angle <= hi
}

/// The angle nearest to `angle` within bounds, if those leave any.
#[inline(always)]
fn held(angle: f32, [lo, hi]: [f32; 2]) -> Option<f32> {
    (lo <= hi).then(|| lesser(greater(angle, lo), hi))
}

/// The length of a vector of a plane.
#[inline(always)]
fn length(x: f32, y: f32) -> f32 {
    <f32 as Scalar>::sqrt(x * x + y * y)
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
