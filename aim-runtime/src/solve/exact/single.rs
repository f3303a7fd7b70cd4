//! Specialisation of the exact solver for a single joint that looks along its own forward from its own origin, such as
//! an eye: the nearest gaze in closed form.
//!
//! Heading and pitch are the target's, each clamped to range and rate. For a target in front, the best angle to the
//! target at a given heading improves monotonically as the heading approaches the target's, whatever the pitch bounds.
//! Choosing the heading first and then the best pitch at it therefore gives the nearest gaze, even at a bound. If no
//! bound is active, the solution is unique.
//!
//! Returns `None`, having changed nothing, unless all of these hold:
//!
//! - one joint with both angles, without an upright heading, its axes square, its pitch within ±90°;
//! - weight 1, ranges fixed and within ±π, the effector joint 0's own;
//! - no second eye, no turn-round in progress, no strain remembered, target not behind in the last frame;
//! - pose rigid with uniform scale;
//! - target in front, below 60° of elevation, neither near nor far, and within 80° of the heading that can be reached.

use core::f32::consts::{FRAC_PI_2, PI};
use core::ops::Range;
use core::slice;

use glam::{Affine3A, Mat3A, Quat, Vec3A};

use super::following::{unturned, view};
use crate::kinematics::chain::{RIGID_DEVIATION, common_scale};
use crate::kinematics::rotation::turn;
use crate::kinematics::view::View;
use crate::limits::reach::AT_LIMIT_RAD;
use crate::math::{is_within_positive, trig};
use crate::rig::{PoseSlices, Side, StateSlices};
use crate::solve::call::Call;
use crate::solve::judge::Verdict;
use crate::{Description, Joint, JointInfo, JointSet, Outcome, Scalar};

/// The squared tangent of 60°, the elevation beyond which headings are too sensitive to the target.
const STEEP: f32 = 3.0;
/// Least forward component of a target, relative to its level distance, after the heading is applied: within about 80°
/// of it. Beyond that, pitches are too sensitive to the target.
const FAR_OFF: f32 = 0.173_648_18;
/// Squared distances of the targets that are handled here, in lengths of the bone's own space.
const ORDINARY: Range<f32> = 1e-6..1e8;

/// Aims for one frame of positive length, or returns `None` if one of the conditions above does not hold.
#[inline(always)]
pub(crate) fn aim(
    rig: &Description<'_>,
    state: &mut StateSlices<'_>,
    pose: &PoseSlices<'_>,
    call: &Call<'_>,
    corrections: &mut [Quat],
) -> Option<Outcome> {
    let ([joint], [animated], [correction], memory) =
        (&mut *state.joints, pose.joints, corrections, &mut *state.memory)
    else {
        return None;
    };
    if !(call.settings.has_full_weight() && joint.is_free()) {
        return None;
    }
    let eye = Eye::new(rig, animated, call.target_ps.into())?;
    let dt = call.dt?;
    let gaze = eye.gaze(joint, eye.reach(joint, dt))?;
    let tolerance = call.settings.effective_tolerance();
    // If the target is not reached: is the rate the reason, or do the ranges exclude it as well?
    let within_reach = gaze.remaining > tolerance && !gaze.is_nearest && eye.remaining_in_time(*joint)? <= tolerance;
    let verdict = Verdict { remaining: gaze.remaining, tolerance, behind: false, within_reach };
    let outcome = verdict.outcome_by(gaze.sight.aim(), eye.limits_met(gaze.angles), JointSet::EMPTY);

    *joint = joint.turned_to(gaze.angles[1], gaze.angles[0]);
    joint.velocity = [0.0; 2];
    *correction = gaze.sight.turn;
    memory.side = Side::of_coordinate(eye.animated.left);
    memory.blocked_s = if gaze.remaining <= tolerance { 0.0 } else { memory.blocked_s + dt };
    Some(outcome)
}

/// A single joint that meets the conditions, and its target.
#[derive(Clone, Copy)]
struct Eye<'a> {
    info: &'a JointInfo,
    /// The joint's axes as columns.
    axes: &'a Mat3A,
    /// Declared ranges of pitch and heading, in this order like all pairs in this module.
    ranges: [[f32; 2]; 2],
    /// The target relative to the joint's origin, in lengths and coordinates of the bone's own space.
    target: Vec3A,
    /// The target along the animated forward, left and up.
    animated: View,
    distance: f32,
}

impl<'a> Eye<'a> {
    #[inline(always)]
    fn new(rig: &'a Description<'a>, animated: &Affine3A, target_ps: Vec3A) -> Option<Self> {
        let [info] = rig.joints else { return None };
        let ranges = [info.pitch?, info.heading?];
        if !(rig.has_fixed_ranges
            && !rig.has_upright
            && info.planes.are_square()
            && -FRAC_PI_2 <= ranges[0][0]
            && ranges[0][1] <= FRAC_PI_2
            && rig.aims_joint_0())
        {
            return None;
        }
        let square_scale = common_scale(slice::from_ref(animated), RIGID_DEVIATION)?;
        // The inverse of a rotated and uniformly scaled frame is its transpose divided by the squared scale.
        let to_target = (target_ps - animated.translation) / square_scale;
        let Mat3A { x_axis: x, y_axis: y, z_axis: z } = animated.matrix3;
        let products = Mat3A::from_cols(x * to_target, y * to_target, z * to_target).transpose();
        let target = products.x_axis + products.y_axis + products.z_axis;
        let animated = view(&info.planes.basis, target);
        is_ordinary(&animated).then(|| Self {
            info,
            axes: &info.planes.basis,
            ranges,
            target,
            animated,
            distance: animated.distance(),
        })
    }

    /// Returns the intervals of pitch and heading that one frame can reach.
    #[inline(always)]
    fn reach(&self, joint: &Joint, dt: f32) -> [[f32; 2]; 2] {
        let step = greater(self.info.rate, 0.0) * dt;
        let within = |[lo, hi]: [f32; 2], angle: f32| [greater(lo, angle - step), lesser(hi, angle + step)];
        let [pitches, headings] = self.ranges;
        [within(pitches, joint.pitch), within(headings, joint.heading)]
    }

    /// Returns the angle to the target that would remain without rate limits. Out of line and by copy, so that the
    /// common path keeps `self` in registers.
    #[cold]
    #[inline(never)]
    fn remaining_in_time(self, joint: Joint) -> Option<f32> {
        Some(self.gaze(&joint, self.ranges)?.remaining)
    }

    /// Returns the gaze within these bounds that comes nearest to the target. `None` if the heading is so far off that
    /// choosing it first is not optimal, or if the bounds are empty, as on the way back into a range.
    #[inline(always)]
    fn gaze(&self, joint: &Joint, [pitches, headings]: [[f32; 2]; 2]) -> Option<Gaze> {
        let up = self.animated.up;
        // Not `or_else`: its call would force the operands into memory.
        let sideways = match self.stays(joint) {
            Some(sideways) => sideways,
            None => self.sideways(headings)?,
        };
        let Sideways { heading, mut is_nearest, half: (sin_h, cos_h), ahead } = sideways;
        // Pitches are usually within bounds, so their arctangent is computed together with that of the remaining angle.
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

    /// Returns the present heading if it is at an end of its range and the target lies beyond it.
    #[inline(always)]
    fn stays(&self, joint: &Joint) -> Option<Sideways> {
        // Compare bits: the joint must be exactly at the end.
        let ([rightmost, leftmost], heading) = (self.ranges[1], joint.heading.to_bits());
        let (is_rightmost, is_leftmost) = (rightmost.to_bits() == heading, leftmost.to_bits() == heading);
        if !(is_rightmost || is_leftmost) {
            return None;
        }
        let (sin_h, cos_h) = trig::half_sin_cos_within(joint.heading);
        let (ahead, aside) = turned_from(&self.animated, (sin_h, cos_h));
        let is_beyond = if is_leftmost { aside > 0.0 } else { aside < 0.0 };
        let half = (sin_h, cos_h);
        let stays = Sideways { heading: joint.heading, is_nearest: true, half, ahead };
        (is_beyond && ahead > FAR_OFF * aside.abs()).then_some(stays)
    }

    /// Returns the heading within these bounds that comes nearest to the target.
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

    /// Returns the correction with these half-angle sines and cosines of pitch and heading, and the target's angle from
    /// it.
    #[inline(always)]
    fn sight(&self, (sin_p, cos_p): (f32, f32), (sin_h, cos_h): (f32, f32)) -> Sight {
        let halves = [sin_p, cos_p, sin_h, cos_h];
        let turn = turn(&self.info.axes, &self.info.planes, halves);
        let seen = view(self.axes, unturned(turn, self.target));
        let half_tangent = seen.lateral() / (self.distance + seen.forward);
        Sight { turn, half_tangent }
    }

    /// Returns the set of joint 0 if one of these angles is at an end of its range, else the empty set.
    #[inline(always)]
    fn limits_met(&self, angles: [f32; 2]) -> JointSet {
        let ends = |[lo, hi]: [f32; 2], angle: f32| (angle <= lo + AT_LIMIT_RAD) | (angle >= hi - AT_LIMIT_RAD);
        let mut at_limit = JointSet::EMPTY;
        if ends(self.ranges[0], angles[0]) | ends(self.ranges[1], angles[1]) {
            at_limit.insert(0);
        }
        at_limit
    }
}

/// A heading and the target's position relative to it.
struct Sideways {
    heading: f32,
    /// `true` if the joint's whole range contains no better heading.
    is_nearest: bool,
    /// Sine and cosine of half the heading.
    half: (f32, f32),
    /// Forward component of the target at this heading, projected onto the level plane.
    ahead: f32,
}

/// A pitch and a heading, and the quantities derived from them.
struct Gaze {
    /// Pitch and heading, radians.
    angles: [f32; 2],
    /// `true` if the joint's whole ranges contain no better angles.
    is_nearest: bool,
    /// Remaining angle to the target, by forward kinematics, radians.
    remaining: f32,
    sight: Sight,
}

/// A correction, and the angle that it leaves between forward and the target, by forward kinematics.
struct Sight {
    turn: Quat,
    /// Tangent of half the remaining angle.
    half_tangent: f32,
}

impl Sight {
    /// Returns the cosine of the remaining angle.
    #[inline(always)]
    fn aim(&self) -> f32 {
        2.0 / (1.0 + self.half_tangent * self.half_tangent) - 1.0
    }
}

/// Returns the target's forward and left components after a heading with this half-angle sine and cosine.
#[inline(always)]
fn turned_from(&View { forward, left, .. }: &View, (sin_half, cos_half): (f32, f32)) -> (f32, f32) {
    let (sin, cos) = (2.0 * sin_half * cos_half, 1.0 - 2.0 * sin_half * sin_half);
    (forward * cos + left * sin, left * cos - forward * sin)
}

/// Returns `true` if a target is in front, not steep, and neither near nor far. NaN gives `false`.
#[inline(always)]
fn is_ordinary(&View { forward, left, up }: &View) -> bool {
    let level = forward * forward + left * left;
    let far = level + up * up;
    forward > 0.0 && up * up < STEEP * level && is_within_positive(far, ORDINARY)
}

/// Returns `true` if an angle is within bounds.
#[inline(always)]
fn is_within([lo, hi]: [f32; 2], angle: f32) -> bool {
    lo <= angle && angle <= hi
}

/// Clamps an angle to bounds; `None` if they are empty.
#[inline(always)]
fn held(angle: f32, [lo, hi]: [f32; 2]) -> Option<f32> {
    (lo <= hi).then(|| lesser(greater(angle, lo), hi))
}

/// Returns the length of a vector in the plane.
#[inline(always)]
fn length(x: f32, y: f32) -> f32 {
    <f32 as Scalar>::sqrt(x * x + y * y)
}

/// Returns the larger of two numbers. The standard library's NaN handling would double the number of instructions.
#[inline(always)]
fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// Returns the smaller of two numbers.
#[inline(always)]
fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}
