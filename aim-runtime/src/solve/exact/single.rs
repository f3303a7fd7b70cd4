//! Specialisation of the exact solver for a single joint that looks along its own forward from its own origin, as an eye
//! does: the nearest gaze in closed form.
//!
//! Heading and pitch are the target's, each as near to it as range and rate let it come. For a target in front the gaze
//! comes the nearer the nearer the heading comes, whatever the pitch; so the heading first, and then the best pitch at
//! it, is the nearest gaze there is, also where a bound is in the way. Where none is, no other angles meet the target.
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
use crate::kinematics::chain::{OFF, common_scale};
use crate::kinematics::rotation::turn;
use crate::kinematics::view::View;
use crate::limits::reach::AT_LIMIT_RAD;
use crate::math::{is_within_positive, trig};
use crate::rig::{PoseSlices, Side, StateSlices};
use crate::solve::call::Call;
use crate::solve::judge::Verdict;
use crate::{Description, Joint, JointInfo, JointSet, Outcome, Scalar};

/// The squared tangent of the elevation, 60°, beyond which headings tremble with their target.
const STEEP: f32 = 3.0;
/// How far ahead of a heading, in parts of its distance, a target has to be: within 80° or so, beyond which pitches tremble
/// with it.
const FAR_OFF: f32 = 0.173_648_18;
/// The distance of an ordinary target, in lengths of the bone's own space; squared.
const ORDINARY: Range<f32> = 1e-6..1e8;

/// Aims for one frame, of positive length, if the conditions above hold.
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
    // Does the rate keep it from there, or in the end its ranges too?
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

/// Such a joint, and its target.
#[derive(Clone, Copy)]
struct Eye<'a> {
    info: &'a JointInfo,
    /// Its axes as columns.
    axes: &'a Mat3A,
    /// Of pitch and heading, as all pairs here.
    ranges: [[f32; 2]; 2],
    /// In lengths of the bone's own space, and along its axes.
    target: Vec3A,
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
        let square_scale = common_scale(slice::from_ref(animated), OFF)?;
        // The inverse of a frame that is turned and scaled is its transpose, divided by the square of its scale.
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

    /// How far pitch and heading get in a frame.
    #[inline(always)]
    fn reach(&self, joint: &Joint, dt: f32) -> [[f32; 2]; 2] {
        let step = greater(self.info.rate, 0.0) * dt;
        let within = |[lo, hi]: [f32; 2], angle: f32| [greater(lo, angle - step), lesser(hi, angle + step)];
        let [pitches, headings] = self.ranges;
        [within(pitches, joint.pitch), within(headings, joint.heading)]
    }

    /// The angle that would be left to the target, had the joint all the time it needs. Apart, and of a copy, so that the
    /// other frames keep all of this in registers.
    #[cold]
    #[inline(never)]
    fn remaining_in_time(self, joint: Joint) -> Option<f32> {
        Some(self.gaze(&joint, self.ranges)?.remaining)
    }

    /// The gaze within these bounds that comes nearest to the target; `None` where the heading is so far off that this is
    /// no matter of heading first, or where bounds leave nothing, as on the way back into a range.
    #[inline(always)]
    fn gaze(&self, joint: &Joint, [pitches, headings]: [[f32; 2]; 2]) -> Option<Gaze> {
        let up = self.animated.up;
        // No `or_else`: that is a call, and what it takes has to be in memory.
        let sideways = match self.stays(joint) {
            Some(sideways) => sideways,
            None => self.sideways(headings)?,
        };
        let Sideways { heading, mut is_nearest, half: (sin_h, cos_h), ahead } = sideways;
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
        let turn = turn(&self.info.axes, &self.info.planes, halves);
        let seen = view(self.axes, unturned(turn, self.target));
        let half_tangent = seen.lateral() / (self.distance + seen.forward);
        Sight { turn, half_tangent }
    }

    /// Whether one of these angles is at an end of its range.
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
    turn: Quat,
    /// The tangent of half that angle.
    half_tangent: f32,
}

impl Sight {
    /// The cosine of that angle.
    #[inline(always)]
    fn aim(&self) -> f32 {
        2.0 / (1.0 + self.half_tangent * self.half_tangent) - 1.0
    }
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
    forward > 0.0 && up * up < STEEP * level && is_within_positive(far, ORDINARY)
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
