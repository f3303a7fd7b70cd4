//! Both eyes in one call: joint 0 and the pose's other eye.
//!
//! The chain is solved for a leading eye midway between the two, within the range that convergence leaves to both. At the
//! end the solver replaces it by both eyes: each turns to the target from its own origin in closed form, within its own
//! range and rate. [`Eyes::follow`] serves frames in which both reach the target, [`Eyes::replace_leading`] all others.
//!
//! The other eye's bone may have any axes: its animated gaze counts as parallel to joint 0's, and its angles are about
//! axes parallel to joint 0's. Directions in the pose's space are therefore copied, never angles of bones.

use core::f32::consts::PI;
use core::slice;

use glam::{Affine3A, Mat3A, Quat, Vec3A, Vec4, Vec4Swizzles};

use crate::kinematics::chain::{
    NEGLIGIBLE_DEVIATION, Ray, Space, can_lead, common_scale, corrections_of, inverse, tilts,
};
use crate::kinematics::rotation::{correction, half_products, turn};
use crate::limits::reach::{AT_LIMIT_RAD, Reach};
use crate::limits::{Interval, RangeOfMotion};
use crate::math::Bounded;
use crate::math::trig::{self, Halves};
use crate::rig::{ChainRig, Memory, PerJoint, PoseSlices};
use crate::solve::call::{Call, solver, upright_axis};
use crate::solve::judge::{Verdict, limits_met};
use crate::target::goal::{Goal, Movement};
use crate::{Axes, Joint, JointInfo, JointSet, Outcome, Status, math};

/// Least distance of a point that the eyes look at, relative to the distance between them: 10 cm for eyes 6 cm apart.
const NEAREST: f32 = 10.0 / 6.0;
/// Angle out of an eye's range beyond which the eyes look in parallel with the leading eye: overhead and behind, the
/// directions from the two eyes may differ arbitrarily.
const FAR_OUT_RAD: f32 = 30.0 * PI / 180.0;
/// Difference of the eyes' headings that counts as rounding, radians.
const PARALLEL_RAD: f32 = 1e-3;

/// Returns the heading and pitch that turn a joint's forward to a direction, as near as its reach allows.
///
/// `view` is the direction along forward, left and up before the added rotation, of any length. The heading is chosen
/// first, then the best pitch at it, which is optimal for separate bounds on the two angles. Straight up or down has
/// heading 0; for a zero vector both angles are 0.
pub(crate) fn look_angles(view: [f32; 3], reach: &Reach) -> [f32; 2] {
    let [ahead, left, _] = view;
    look_angles_at_heading(view, trig::atan2(left, ahead), reach)
}

/// [`look_angles`] with a preferred heading.
fn look_angles_at_heading([ahead, left, up]: [f32; 3], heading: f32, reach: &Reach) -> [f32; 2] {
    let heading = reach.heading.hold(heading);
    let (sin, cos) = trig::sin_cos(heading);
    [heading, reach.pitch_at(heading).hold(trig::atan2(up, ahead * cos + left * sin))]
}

/// Joint 0 and the other eye, in this order in all pairs. Points are relative to the middle between their animated
/// positions.
pub(crate) struct Eyes<'a, const C: usize> {
    rig: &'a ChainRig<'a, C>,
    pose: &'a PoseSlices<'a>,
    call: &'a Call<'a>,
    /// Both eyes' ranges of motion; the other eye's are joint 0's mirrored.
    motions: &'a [RangeOfMotion; 2],
    leads: bool,
    /// The other eye's animated transform in the pose's space.
    other_eye: &'a Affine3A,
    middle: Vec3A,
    /// Joint 0's animated position. The other eye is opposite.
    half_way: Vec3A,
    /// The distance between the eyes.
    eye_distance: f32,
    /// 1 if joint 0 is the left eye, −1 if it is the right one.
    side: f32,
    /// Both eyes' headings and pitches before the call.
    start: [[f32; 2]; 2],
}

impl<'a, const C: usize> Eyes<'a, C> {
    /// Creates the eyes of a rig with at least one joint. `motions` are both eyes' ranges of motion, `start` their
    /// headings and pitches before the call.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn new(
        rig: &'a ChainRig<'a, C>,
        pose: &'a PoseSlices<'a>,
        other_eye: &'a Affine3A,
        motions: &'a [RangeOfMotion; 2],
        call: &'a Call<'a>,
        start: [[f32; 2]; 2],
    ) -> Self {
        let joint = &pose.joints[0];
        let between_eyes = joint.translation - other_eye.translation;
        let left = rig.joints[0].planes.frame(&joint.matrix3).y_axis;
        Self {
            rig,
            pose,
            call,
            motions,
            leads: can_lead(rig.description),
            other_eye,
            middle: 0.5 * joint.translation + 0.5 * other_eye.translation,
            half_way: 0.5 * between_eyes,
            eye_distance: length(between_eyes),
            side: if between_eyes.dot(left) < 0.0 { -1.0 } else { 1.0 },
            start,
        }
    }

    /// Replaces joint 0 by the leading eye, if one leads. `angles` are that eye's angles before the call. Returns the
    /// pose of the chain.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn lead(&self, joint: &mut Joint, angles: [f32; 2]) -> PerJoint<Affine3A, C> {
        let mut transforms = self.rig.array_from(self.pose.joints, Affine3A::IDENTITY);
        if self.leads {
            *joint = with_angles(joint, angles);
            transforms[0].translation = self.middle;
        }
        transforms
    }

    /// Turns both eyes to the target and measures them, in a frame in which both reach it, given the leading eye's view
    /// of it after the turns of the other joints. Returns `None`, with nothing changed, unless: a leading eye aims at the
    /// point that the outcome is measured against; it is within both ranges and rates and not too near; the other eye's
    /// transform is rigid, and the eyes do not diverge.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn follow(
        &self,
        goal: &Goal,
        view: Vec3A,
        leading: &LeadingFrame<'_>,
        joints: &mut [Joint],
        memory: &mut Memory,
        corrections: &mut [Quat],
    ) -> Option<Outcome> {
        let LeadingFrame { frame, rows, per_size } = *leading;
        if !(self.leads && goal.movement == Movement::Aim && goal.aim_point == goal.measured_point) {
            return None;
        }
        let other_square = common_scale(slice::from_ref(self.other_eye), NEGLIGIBLE_DEVIATION)?;
        let near = NEAREST * self.eye_distance * per_size;
        let half_way = rows * (self.half_way * per_size);
        // Lanes of joint 0, of the other eye, and of both once more.
        let (own, other) = (view - half_way, view + half_way);
        let ahead = Vec4::new(own.x, other.x, own.x, other.x);
        let left = Vec4::new(own.y, other.y, own.y, other.y);
        let up = Vec4::new(own.z, other.z, own.z, other.z);
        let squares = ahead * ahead + left * left;
        let [level, other_level] = [math::root(squares.x), math::root(squares.y)];
        // Both headings, both pitches.
        let angles =
            trig::atan2_of_4(Vec4::new(left.x, left.y, up.x, up.y), Vec4::new(ahead.x, ahead.y, level, other_level));
        let [h, other_h, p, other_p] = angles.to_array();
        let is_free = self.is_within(angles)
            && self.side * (h - other_h) <= 0.0
            && view.dot(view) >= (near * near).at_least(1e-30);
        if !is_free {
            return None;
        }
        let (half_sin, half_cos) = trig::half_sin_cos_4(angles);
        // The target as seen by each eye after its turn.
        let (sin_h, cos_h) = (half_sin * half_cos * 2.0, Vec4::ONE - half_sin * half_sin * 2.0);
        let (sin_p, cos_p) = (sin_h.zwzw(), cos_h.zwzw());
        let level = ahead * cos_h + left * sin_h;
        let [seen_ahead, seen_left, seen_up] =
            [level * cos_p + up * sin_p, left * cos_h - ahead * sin_h, up * cos_p - level * sin_p];
        let aside = seen_left * seen_left + seen_up * seen_up;
        let remaining = trig::small_atan2(math::root(aside.x), seen_ahead.x);
        let other_remaining = trig::small_atan2(math::root(aside.y), seen_ahead.y);
        let tolerance = self.call.settings.effective_tolerance();
        // The negation also catches NaN.
        if !(remaining.at_least(other_remaining) <= tolerance) {
            return None;
        }
        let lead = joints[0];
        joints[0] = with_angles(&lead, [h, p]);
        memory.set_eyes([[other_h, other_p], lead.angles()]);
        let info = &self.rig.joints[0];
        corrections[0] = turn(&info.axes, &info.planes, [half_sin.z, half_cos.z, half_sin.x, half_cos.x]);
        let other_halves = Vec4::new(half_sin.w, half_cos.w, half_sin.y, half_cos.y);
        let other_eye_correction = Some(self.other_turn(frame, other_halves, other_square));
        let verdict = Verdict { remaining, tolerance, behind: false, within_reach: true };
        let outcome = verdict.outcome_at(JointSet::EMPTY, JointSet::EMPTY);
        Some(Outcome { other_eye_remaining: Some(other_remaining), other_eye_correction, ..outcome })
    }

    /// Returns the other eye's correction by these angles about the axes of joint 0's `frame`, if its bone has only
    /// rotation, mirroring and a uniform scale, whose square is given.
    #[cfg_attr(not(aim_small), inline(always))]
    fn other_turn(&self, frame: &Mat3A, halves: Halves, square: f32) -> Quat {
        let Mat3A { x_axis: forward, y_axis: left, z_axis: up } = *frame;
        let [by_heading, by_pitch, by_both, w] = half_products(halves).to_array();
        let axis_ps = forward * by_both - left * by_pitch + up * by_heading;
        // A mirror reverses the sense of rotation.
        let Mat3A { x_axis: x, y_axis: y, z_axis: z } = self.other_eye.matrix3;
        let handedness = math::cross(forward, left).dot(up) * math::cross(x, y).dot(z);
        let per_scale = (1.0 / math::root(square)).copysign(handedness);
        unit_turn(self.other_eye.matrix3.transpose() * (axis_ps * per_scale), w)
    }

    /// Replaces the leading eye, with which `chain` was solved, by both eyes, in any case. Returns `None` if an eye's
    /// transform is not finite or is singular, or if a direction is undefined.
    #[cold]
    #[inline(never)]
    pub(crate) fn replace_leading(
        &self,
        chain: &ChainResult<'_>,
        joints: &mut [Joint],
        memory: &mut Memory,
        corrections: &mut [Quat],
    ) -> Option<Outcome> {
        let to_target = |point| self.undo_corrections(corrections, chain.space.to_pose(point));
        let (aim_point, measured_point) = (to_target(chain.goal.aim_point), to_target(chain.goal.measured_point));
        if let Some(outcome) = self.follow_in_rigid_pose(chain, measured_point, joints, memory, corrections) {
            return Some(outcome);
        }
        if !(self.middle.is_finite() && self.eye_distance.is_finite()) {
            return None;
        }
        let frames = EyeFrames::new(&self.pose.joints[0], self.other_eye, &self.rig.joints[0])?;
        let lead = joints[0];
        let angles = self.angles(&frames, aim_point, &lead, chain)?;
        if !angles.as_flattened().iter().all(|angle| angle.is_finite()) {
            return None;
        }
        joints[0] = with_angles(&lead, angles[0]);
        memory.set_eyes([angles[1], lead.angles()]);
        let (info, tilt) = (&self.rig.joints[0], self.tilts()[0]);
        let turns = both(|eye| correction(info, &with_angles(&lead, angles[eye]), tilt));
        corrections[0] = turns[0];
        let remaining = both(|eye| {
            self.remaining(&frames, corrections, eye, turns[eye], chain.space.to_pose(chain.goal.measured_point))
        });
        let eye_turns = EyeTurns { angles, turns, measured_point, remaining };
        self.outcome(&frames, joints, &eye_turns, &lead, chain)
    }

    /// [`follow`](Self::follow) for any solver, given the measured point as seen by the animated eyes.
    fn follow_in_rigid_pose(
        &self,
        chain: &ChainResult<'_>,
        measured_point: Vec3A,
        joints: &mut [Joint],
        memory: &mut Memory,
        corrections: &mut [Quat],
    ) -> Option<Outcome> {
        let planes = &self.rig.joints[0].planes;
        if !planes.are_square() || self.is_supported() {
            return None;
        }
        let square = common_scale(self.pose.joints, NEGLIGIBLE_DEVIATION)?;
        let frame = planes.frame(&self.pose.joints[0].matrix3) * (1.0 / math::root(square));
        let rows = frame.transpose();
        let leading = LeadingFrame { frame: &frame, rows: &rows, per_size: 1.0 };
        let outcome = self.follow(chain.goal, rows * measured_point, &leading, joints, memory, corrections)?;
        let Outcome { mut at_limit, mut recovering, body_turn, out_of_reach_for, .. } = chain.outcome;
        at_limit.set(0, false);
        recovering.set(0, false);
        Some(Outcome { at_limit, recovering, body_turn, out_of_reach_for, ..outcome })
    }

    /// Returns `true` if a joint further inward is aimed, so that the eyes rest.
    fn is_supported(&self) -> bool {
        self.call.settings.effector.min(self.rig.count().saturating_sub(1)) > 0
    }

    /// Sets the ranges of the leading eye to those within which both eyes can look at a target at this distance from
    /// their middle.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn converge(&self, motions: &mut [RangeOfMotion], distance: impl FnOnce() -> f32) {
        if !self.leads {
            return;
        }
        let distance = distance().at_least(NEAREST * self.eye_distance);
        // NaN if the distance is 0.
        let half =
            (0.5 * self.eye_distance * self.call.settings.effective_weight() / distance).at_least(0.0).at_most(0.5);
        // The arcsine of `half`.
        let inward = self.side * trig::twice_atan(half / (1.0 + math::root(1.0 - half * half)));
        let [own, other] = *self.motions;
        let (own_heading, other_heading) = (own.heading.moved(inward), other.heading.moved(-inward));
        // The nearer eye sees the target at a larger pitch than the leading one, increasingly so with elevation. This
        // margin suffices up to 37°.
        motions[0] = own.shrunk(own_heading.common(other_heading), 1.0 - 1.25 * half);
    }

    /// Returns the distance of the target from the middle between the eyes with the joints at these angles.
    #[cold]
    #[inline(never)]
    pub(crate) fn distance(&self, joints: &[Joint]) -> f32 {
        let mut corrections = self.tilts();
        corrections_of(self.rig, joints, &mut corrections);
        length(self.undo_corrections(&corrections, self.call.target_ps.into()))
    }

    /// Returns the rotation of each joint's upright frame in its bone.
    fn tilts(&self) -> PerJoint<Quat, C> {
        if !self.rig.has_upright {
            return self.rig.array(Quat::IDENTITY);
        }
        tilts(self.rig, self.pose.joints, upright_axis(self.pose, solver(self.rig, self.call.settings)))
    }

    /// Returns the reach of each eye in this call. Neither eye may turn outward further than the other can turn inward,
    /// so that the eyes never diverge.
    fn reaches(&self, start: &[[f32; 2]; 2]) -> [Reach; 2] {
        let [own, other] = *self.motions;
        let [left, right] = if self.side > 0.0 { [own, other] } else { [other, own] };
        let left_heading = left.heading.no_further_up_than(right.heading);
        let right_heading = right.heading.no_further_down_than(left.heading);
        let headings = if self.side > 0.0 { [left_heading, right_heading] } else { [right_heading, left_heading] };
        let rate = self.rig.joints[0].rate;
        both(|eye| {
            let motion = RangeOfMotion { heading: headings[eye], ..self.motions[eye] };
            match self.call.dt {
                Some(dt) => Reach::frame(&motion, rate, &with_angles(&Joint::REST, start[eye]), dt),
                None => Reach::range(&motion),
            }
        })
    }

    /// Returns a point relative to the animated eyes, with the supporting joints' corrections undone.
    fn undo_corrections(&self, corrections: &[Quat], point_ps: Vec3A) -> Vec3A {
        let mut point = point_ps - self.middle;
        for (joint, turn) in self.pose.joints.iter().zip(corrections).skip(1).rev() {
            let place = joint.translation - self.middle;
            let local = match common_scale(slice::from_ref(joint), NEGLIGIBLE_DEVIATION) {
                Some(square) => joint.matrix3.transpose() * ((point - place) * (1.0 / square)),
                None => inverse(joint).matrix3 * (point - place),
            };
            point = place + joint.matrix3 * math::turned(turn.conjugate(), local);
        }
        point
    }

    /// Moves a point out to the least distance at which the eyes look; `None` if it has no direction.
    fn with_min_distance(&self, point: Vec3A) -> Option<Vec3A> {
        let near = NEAREST * self.eye_distance;
        if length(point) < near { Some(math::direction(point)? * near) } else { Some(point) }
    }

    /// Returns `true` if both headings and both pitches are within range and rate.
    #[cfg_attr(not(aim_small), inline(always))]
    fn is_within(&self, angles: Vec4) -> bool {
        let [own, other] = self.motions;
        let ends =
            |of: fn(Interval) -> f32| Vec4::new(of(own.heading), of(other.heading), of(own.pitch), of(other.pitch));
        let [[h, p], [other_h, other_p]] = self.start;
        let step = self.call.dt.map_or(f32::INFINITY, |dt| self.rig.joints[0].rate * dt);
        let inside = (angles - ends(Interval::lo)).min(ends(Interval::hi) - angles);
        let change = (angles - Vec4::new(h, other_h, p, other_p)).abs();
        let fits = inside.cmpgt(Vec4::splat(AT_LIMIT_RAD)) & change.cmple(Vec4::splat(step));
        own.taper.is_none() && fits.bitmask() == 15
    }

    /// Returns both eyes' headings and pitches, given the point to which they turn.
    fn angles(
        &self,
        frames: &EyeFrames,
        aim_point: Vec3A,
        lead: &Joint,
        chain: &ChainResult<'_>,
    ) -> Option<[[f32; 2]; 2]> {
        let start = &self.start;
        if self.call.dt == Some(0.0) {
            return Some(*start);
        }
        let reaches = self.reaches(start);
        Some(if !self.leads {
            [lead.angles(), reaches[1].angles_nearest(lead)]
        } else if chain.goal.movement == Movement::Rest || self.is_supported() {
            // A leading eye that does not rest keeps the gaze on the animation while the head returns.
            both(|eye| reaches[eye].angles_nearest(lead))
        } else if chain.goal.movement == Movement::Stay {
            both(|eye| reaches[eye].angles_nearest(&with_angles(lead, start[eye])))
        } else {
            self.eye_angles(frames, self.with_min_distance(aim_point)?, lead, start).0
        })
    }

    /// Returns both eyes' headings and pitches towards a target, and whether it is within the ranges regardless of the
    /// rates. Each eye looks from its own origin, or in parallel with `lead` if the directions would diverge or are far
    /// out of range.
    fn eye_angles(
        &self,
        frames: &EyeFrames,
        target: Vec3A,
        lead: &Joint,
        start: &[[f32; 2]; 2],
    ) -> ([[f32; 2]; 2], bool) {
        let reaches = self.reaches(start);
        let views = frames.views(target, self.half_way);
        let parallel = || (both(|eye| reaches[eye].angles_nearest(lead)), false);
        let mut headings = [0.0; 2];
        let mut within = true;
        for eye in [0, 1] {
            let Some(direction) = math::direction(views[eye]) else { return parallel() };
            let [ahead, left, up] = direction.to_array();
            headings[eye] = trig::atan2(left, ahead);
            let [heading, pitch] = look_angles([ahead, left, up], &Reach::range(&self.motions[eye]));
            let (sin, cos) = trig::sin_cos(heading);
            let beside = (headings[eye] - heading).abs();
            let above = (trig::atan2(up, ahead * cos + left * sin) - pitch).abs();
            if !(beside.at_least(above) < FAR_OUT_RAD) {
                return parallel();
            }
            within &= beside.at_least(above) < 1e-5;
        }
        let parted = self.side * (headings[0] - headings[1]);
        if parted > PARALLEL_RAD {
            return parallel();
        }
        if parted > 0.0 {
            headings = [0.5 * (headings[0] + headings[1]); 2];
        }
        let angles = both(|eye| {
            let mut heading = headings[eye];
            if self.motions[eye].heading.is_free() {
                heading = start[eye][0] + math::wrap_pi(heading - start[eye][0]);
            }
            let [heading, pitch] = look_angles_at_heading(views[eye].to_array(), heading, &reaches[eye]);
            [if self.motions[eye].heading.is_free() { math::wrap_pi(heading) } else { heading }, pitch]
        });
        (angles, within)
    }

    /// Returns one eye's remaining angle by true forward kinematics, which is accurate even for a target close to an
    /// eye.
    fn remaining(
        &self,
        frames: &EyeFrames,
        corrections: &[Quat],
        eye: usize,
        turn: Quat,
        point_ps: Vec3A,
    ) -> Option<f32> {
        let forward = math::turned(turn, self.rig.joints[0].axes.forward.into());
        let (animated, forward) = match eye {
            0 => (&self.pose.joints[0], forward),
            _ => (self.other_eye, frames.relation * forward),
        };
        // The middle is rounded, so that half of the distance between the eyes is not exact.
        let origin = animated.translation - self.middle;
        let mut ray = Ray { origin, direction: animated.matrix3 * forward };
        for (joint, turn) in self.pose.joints.iter().zip(corrections).skip(1) {
            let frame = Affine3A { matrix3: joint.matrix3, translation: joint.translation - self.middle };
            ray = ray.through(&inverse(&frame)).turned(*turn).through(&frame);
        }
        let to_point = point_ps - self.middle - ray.origin;
        if !(math::length(to_point) > 1e-4 * self.eye_distance) {
            return None;
        }
        let angle = math::angle_between(math::direction(ray.direction)?, math::direction(to_point)?);
        angle.is_finite().then_some(angle)
    }

    /// Returns the outcome of both eyes, each judged from its own origin.
    fn outcome(
        &self,
        frames: &EyeFrames,
        joints: &[Joint],
        eye_turns: &EyeTurns,
        lead: &Joint,
        chain: &ChainResult<'_>,
    ) -> Option<Outcome> {
        // Joint 0's flags cover both eyes.
        let other = with_angles(lead, eye_turns.angles[1]);
        let (mut at_limit, mut recovering) = (chain.outcome.at_limit, chain.outcome.recovering);
        let met = self.limits_met([joints[0], other]);
        at_limit.set(0, met[0]);
        recovering.set(0, met[1]);
        let [own_remaining, other_eye_remaining] = eye_turns.remaining;
        let other_eye_correction = Some(frames.to_other_eye(eye_turns.turns[1]));
        let outcome = Outcome { at_limit, recovering, other_eye_remaining, other_eye_correction, ..chain.outcome };
        if !self.leads || self.is_supported() {
            return Some(outcome);
        }
        let (remaining, tolerance) = (own_remaining?, self.call.settings.effective_tolerance());
        let farther = remaining.at_least(other_eye_remaining?);
        let within_reach = farther > tolerance
            && self.call.dt.is_some()
            && self.is_within_reach(frames, eye_turns, lead, chain.outcome.status);
        let verdict = Verdict { remaining: farther, tolerance, behind: chain.goal.behind, within_reach };
        let status = verdict.status();
        let own = Verdict { remaining, ..verdict }.outcome_at(at_limit, recovering);
        Some(Outcome { aim: own.aim, remaining, status, ..outcome })
    }

    /// Returns `true` if only rates keep the eyes from their target, given the status of the leading eye.
    fn is_within_reach(&self, frames: &EyeFrames, eye_turns: &EyeTurns, lead: &Joint, status: Status) -> bool {
        match status {
            Status::RateLimited => true,
            // The leading eye has reached the target: check whether the ranges let both eyes reach it.
            Status::Reached => self.with_min_distance(eye_turns.measured_point).is_some_and(|seen| {
                let near = NEAREST * self.eye_distance * 1.000_01;
                self.eye_angles(frames, seen, lead, &eye_turns.angles).1 && math::length(seen) > near
            }),
            _ => false,
        }
    }

    /// Returns whether an eye is at a limit, and whether one is out of its range.
    fn limits_met(&self, eyes: [Joint; 2]) -> [bool; 2] {
        let info = slice::from_ref(&self.rig.joints[0]);
        let [own, other] = both(|eye| limits_met(info, &self.motions[eye..=eye], &eyes[eye..=eye]));
        [!(own.0.is_empty() && other.0.is_empty()), !(own.1.is_empty() && other.1.is_empty())]
    }
}

/// The result of solving the chain for the leading eye.
pub(crate) struct ChainResult<'a> {
    pub(crate) outcome: Outcome,
    pub(crate) goal: &'a Goal,
    pub(crate) space: Space,
}

/// The leading eye in a rigid pose.
pub(crate) struct LeadingFrame<'a> {
    /// Its animated forward, left and up.
    pub(crate) frame: &'a Mat3A,
    /// The transposed frame.
    pub(crate) rows: &'a Mat3A,
    /// The factor from the pose's lengths to those of its views.
    pub(crate) per_size: f32,
}

/// The eyes' new angles, and the measurements of the result.
struct EyeTurns {
    /// Headings and pitches, radians.
    angles: [[f32; 2]; 2],
    /// Each eye's correction, in joint 0's bone.
    turns: [Quat; 2],
    /// The point that the eyes are judged by, relative to the animated eyes.
    measured_point: Vec3A,
    /// The remaining angle of each eye to `measured_point`, radians; `None` if it is undefined.
    remaining: [Option<f32>; 2],
}

/// Frames of eyes that may be sheared or scaled non-uniformly.
struct EyeFrames {
    /// Transforms of directions in the pose to each eye's forward, left and up, along which its angles are measured.
    to_angles: [Mat3A; 2],
    /// Transform from joint 0's space to the other eye's bone, which converts corrections.
    relation: Mat3A,
}

impl EyeFrames {
    /// Returns `None` if an eye's transform is not finite or is singular.
    fn new(joint: &Affine3A, other_eye: &Affine3A, info: &JointInfo) -> Option<Self> {
        if !(joint.is_finite() && other_eye.is_finite()) {
            return None;
        }
        math::orthonormal(joint.matrix3)?;
        math::orthonormal(other_eye.matrix3)?;
        // Forward first, because Gram–Schmidt keeps the direction of the first column, even if the pose is stretched.
        let Axes { up, forward, left } = info.axes;
        let axes = Mat3A::from_cols(forward.into(), up.into(), left.into());
        let (from_pose, from_pose_to_other) = (inverse(joint).matrix3, inverse(other_eye).matrix3);
        let relation =
            math::orthonormal(from_pose_to_other * joint.matrix3 * axes)? * math::orthonormal(axes)?.transpose();
        // The animated gazes count as parallel.
        let other_from_pose = relation.transpose() * from_pose_to_other;
        let rows = info.planes.basis.transpose();
        (from_pose.is_finite() && other_from_pose.is_finite())
            .then(|| Self { to_angles: [rows * from_pose, rows * other_from_pose], relation })
    }

    /// Returns the vectors from the eyes, which are at `half_way` and opposite, to a point.
    fn views(&self, point: Vec3A, half_way: Vec3A) -> [Vec3A; 2] {
        [self.to_angles[0] * (point - half_way), self.to_angles[1] * (point + half_way)]
    }

    /// Converts a correction of joint 0 to the other eye's bone. A mirrored relation reverses the sense of rotation.
    fn to_other_eye(&self, turn: Quat) -> Quat {
        let Mat3A { x_axis, y_axis, z_axis } = self.relation;
        let sense = if math::cross(x_axis, y_axis).dot(z_axis) < 0.0 { -1.0 } else { 1.0 };
        unit_turn(self.relation * Vec3A::new(turn.x, turn.y, turn.z) * sense, turn.w)
    }
}

/// Returns the other eye's correction at this heading and pitch, in its own bone's space. `None` if an eye's transform
/// is not finite or is singular.
#[cold]
pub(crate) fn other_eye_correction<const C: usize>(
    rig: &ChainRig<'_, C>,
    pose: &PoseSlices<'_>,
    angles: [f32; 2],
    tilt: Quat,
) -> Option<Quat> {
    let info = &rig.joints[0];
    let frames = EyeFrames::new(&pose.joints[0], pose.other_eye?, info)?;
    Some(frames.to_other_eye(correction(info, &with_angles(&Joint::REST, angles), tilt)))
}

/// Returns the rotation with this vector part and w, whose squares s add up to nearly 1, scaled to length 1: 1/√s is
/// 1.5 − s/2 to first order.
#[cfg_attr(not(aim_small), inline(always))]
fn unit_turn(axis: Vec3A, w: f32) -> Quat {
    let square = axis.dot(axis) + w * w;
    Quat::from_vec4(Vec4::from((axis, w)) * (1.5 - 0.5 * square))
}

/// Returns a vector's length.
#[cfg_attr(not(aim_small), inline(always))]
fn length(v: Vec3A) -> f32 {
    let square = v.dot(v);
    if square > 1e-24 && square < 1e24 { math::root(square) } else { extreme_length(v) }
}

#[cold]
#[inline(never)]
fn extreme_length(v: Vec3A) -> f32 {
    math::length(v)
}

/// Evaluates `of` for joint 0 and for the other eye.
#[cfg_attr(not(aim_small), inline(always))]
fn both<T>(of: impl Fn(usize) -> T) -> [T; 2] {
    [of(0), of(1)]
}

/// Returns the joint at other angles.
fn with_angles(joint: &Joint, [heading, pitch]: [f32; 2]) -> Joint {
    Joint { heading, pitch, ..*joint }
}

impl Reach {
    /// Returns the angles within reach that are nearest to the joint's, heading first.
    fn angles_nearest(&self, joint: &Joint) -> [f32; 2] {
        let held = self.hold(joint);
        [held.heading, held.pitch]
    }
}
