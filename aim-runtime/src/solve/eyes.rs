//! Both eyes in one call: joint 0 and the pose's other eye.
//!
//! The chain is solved for a leading eye midway between the two, within the range that convergence leaves to both. Each
//! eye then turns to the target from its own origin in closed form, within its own range and rate.
//!
//! The other eye's bone may have any axes: its animated gaze counts as parallel to joint 0's, and its angles are about
//! axes parallel to joint 0's. Directions in the pose's space are therefore copied, never angles of bones.

use core::f32::consts::PI;
use core::slice;

use glam::{Affine3A, Mat3A, Quat, Vec3A, Vec4};

use super::natural::body::Turn;
use crate::kinematics::bearing::headings_and_pitches;
use crate::kinematics::chain::{NEGLIGIBLE_DEVIATION, Ray, Upright, can_lead, common_scale, inverse, tilts};
use crate::kinematics::rotation::{joint_turn, tilted, turn};
use crate::limits::motion::mirrored;
use crate::limits::reach::{AT_LIMIT_RAD, Reach};
use crate::limits::{Interval, RangeOfMotion};
use crate::math::Bounded;
use crate::math::trig::{self, Halves};
use crate::rig::{ChainRig, PerJoint, PoseSlices};
use crate::solve::call::Call;
use crate::solve::judge::{Verdict, limits_met};
use crate::solve::task::{ChainSolution, SolveOutput};
use crate::target::goal::Movement;
use crate::{Axes, Joint, JointInfo, Outcome, Status, math};

/// Least distance of a point that the eyes look at, relative to the distance between them: 10 cm for eyes 6 cm apart.
const NEAREST: f32 = 10.0 / 6.0;
/// Angle out of an eye's range beyond which the eyes look in parallel with the leading eye: overhead and behind, the
/// directions from the two eyes may differ arbitrarily.
const FAR_OUT_RAD: f32 = 30.0 * PI / 180.0;
/// Number of times that a snap is repeated, so that the ranges left by convergence are those at the final head pose.
const SNAP_ROUNDS: usize = 4;
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

/// [`look`] with a preferred heading.
fn look_angles_at_heading([ahead, left, up]: [f32; 3], heading: f32, reach: &Reach) -> [f32; 2] {
    let heading = reach.heading.hold(heading);
    let (sin, cos) = trig::sin_cos(heading);
    [heading, reach.pitch_at(heading).hold(trig::atan2(up, ahead * cos + left * sin))]
}

/// Joint 0 and the other eye, in this order in all pairs. Points are relative to `middle`.
pub(crate) struct Eyes<'a, const C: usize> {
    rig: &'a ChainRig<'a, C>,
    pose: &'a PoseSlices<'a>,
    /// Both eyes' ranges of motion; the other eye's are joint 0's mirrored.
    motions: [RangeOfMotion; 2],
    leads: bool,
    middle: Vec3A,
    /// The squared scale of the joints if the pose is rigid. The inverse of a joint's matrix is its transpose divided
    /// by it.
    square: Option<f32>,
    /// The other eye's animated transform in the pose's space.
    other_eye: &'a Affine3A,
    /// The eyes' animated positions.
    places: [Vec3A; 2],
    /// Transform of directions in the pose to forward, left and up, along which the eyes' angles are measured.
    to_angles: Mat3A,
    /// The same for the other eye, if it differs.
    other_to_angles: Option<Mat3A>,
    /// Transform from joint 0's space to the other eye's bone, which converts corrections.
    relation: Mat3A,
    /// The rotation of each joint's upright frame in its bone.
    tilts: PerJoint<Quat, C>,
    /// The distance between the eyes.
    eye_distance: f32,
    /// 1 if joint 0 is the left eye, −1 if it is the right one.
    side: f32,
}

impl<'a, const C: usize> Eyes<'a, C> {
    /// Returns `None` if an eye's transform is not finite or is singular.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn new(
        rig: &'a ChainRig<'a, C>,
        pose: &'a PoseSlices<'a>,
        other_eye: &'a Affine3A,
        declared: &[RangeOfMotion],
        about: Upright,
    ) -> Option<Self> {
        let (joint, info, own_motion) = (pose.joints.first()?, rig.joints.first()?, declared.first()?);
        let square = common_scale(pose.joints, NEGLIGIBLE_DEVIATION);
        let other_square = common_scale(slice::from_ref(other_eye), NEGLIGIBLE_DEVIATION);
        // Forward, left and up of joint 0.
        let axes = info.planes.frame(&joint.matrix3);
        let (to_angles, relation, other_to_angles) = match (square, other_square) {
            (Some(own), Some(other)) if info.planes.are_square() => {
                let relation = other_eye.matrix3.transpose() * joint.matrix3 * (1.0 / math::sqrt(own * other));
                (axes.transpose() * (1.0 / own), relation, None)
            }
            _ => {
                let (from_pose, relation, to_other) = eye_transforms(joint, other_eye, info)?;
                let rows = info.planes.basis.transpose();
                // The animated gazes count as parallel.
                (rows * from_pose, relation, Some(rows * (relation.transpose() * to_other)))
            }
        };
        let middle = 0.5 * joint.translation + 0.5 * other_eye.translation;
        let between_eyes = joint.translation - other_eye.translation;
        let eye_distance = length(between_eyes);
        if !(middle.is_finite() && eye_distance.is_finite()) {
            return None;
        }
        let side = if between_eyes.dot(axes.y_axis) < 0.0 { -1.0 } else { 1.0 };
        Some(Self {
            rig,
            pose,
            motions: [*own_motion, mirrored(rig, pose, own_motion)],
            leads: can_lead(rig.description),
            middle,
            square: square.filter(|_| other_to_angles.is_none()),
            other_eye,
            places: [joint.translation - middle, other_eye.translation - middle],
            to_angles,
            other_to_angles,
            relation,
            tilts: if rig.has_upright { tilts(rig, pose.joints, about) } else { rig.array(Quat::IDENTITY) },
            eye_distance,
            side,
        })
    }

    /// Runs one call for both eyes and the chain that `solve` moves. `solve` is given the pose and ranges of the
    /// leading eye, with joint 0 as that eye. `motions` are the declared ranges of all joints. Returns `None` if there
    /// is nothing to aim; the moved state must then be discarded.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn aim(
        &self,
        call: &Call<'_>,
        motions: &mut [RangeOfMotion],
        SolveOutput { joints, memory, corrections, .. }: SolveOutput<'_, C>,
        solve: impl Fn(&PoseSlices<'_>, &[RangeOfMotion], SolveOutput<'_, C>) -> Option<Outcome>,
    ) -> Option<Outcome> {
        let mut solution = None;
        let own = *joints.first()?;
        let [other, leading] = memory.eyes().unwrap_or([[0.0; 2], own.angles()]);
        let start = [own, with_angles(&own, other)];
        let mut transforms = self.rig.array_from(self.pose.joints, Affine3A::IDENTITY);
        if self.leads {
            joints[0] = with_angles(&own, leading);
            transforms[0].translation = self.middle;
        }
        let pose = PoseSlices { joints: &transforms, ..*self.pose };
        // The range that convergence leaves depends on the final head pose: a frame takes it from the last frame, a
        // snap iterates.
        let outcome = if call.dt.is_some() {
            for (index, correction) in corrections.iter_mut().enumerate().skip(1) {
                *correction = self.correction_of(index, &joints[index]);
            }
            if self.leads {
                motions[0] = self.leading_motion(call, corrections);
            }
            solve(&pose, motions, SolveOutput { joints, memory, corrections, solution: Some(&mut solution) })
        } else {
            let before = (*joints, *memory);
            corrections.fill(Quat::IDENTITY);
            let mut outcome = None;
            for _ in 0..SNAP_ROUNDS {
                if self.leads {
                    motions[0] = self.leading_motion(call, corrections);
                }
                (*joints, *memory) = before;
                outcome =
                    solve(&pose, motions, SolveOutput { joints, memory, corrections, solution: Some(&mut solution) });
                if outcome.is_none() {
                    break;
                }
            }
            outcome
        };
        motions[0] = self.motions[0];
        let chain = ChainResult { outcome: outcome.as_ref()?, solution: solution.as_ref()? };
        let lead = joints[0];
        let to_pose = |point| chain.solution.space.to_pose(point);
        let measured_point = match chain.solution.measured_point {
            Some(point) => to_pose(point) - self.middle,
            None => self.undo_corrections(corrections, to_pose(chain.solution.goal.measured_point)),
        };
        let views = self.views(measured_point);
        let unconstrained = if self.leads
            && chain.solution.goal.movement == Movement::Aim
            && chain.solution.goal.aim_point == chain.solution.goal.measured_point
        {
            self.unconstrained_angles(call, measured_point, views, &start)
        } else {
            None
        };
        let angles = match unconstrained {
            Some(angles) if !self.is_supported(call) => angles,
            _ => self.constrained_angles(call, corrections, &lead, &start, &chain)?,
        };
        let [[h, p], [other_h, other_p]] = angles;
        let angles_of_both = Vec4::new(h, p, other_h, other_p);
        if !angles_of_both.is_finite() {
            return None;
        }
        joints[0] = with_angles(&lead, angles[0]);
        memory.set_eyes(Some([angles[1], lead.angles()]));
        let halves = trig::halves_of_both(angles_of_both);
        let info = &self.rig.joints[0];
        let turns = both(|eye| self.tilted(turn(&info.axes, &info.planes, halves[eye].to_array()), 0));
        corrections[0] = turns[0];
        let remaining = self.remaining(
            corrections,
            turns,
            halves,
            [measured_point, views[0], views[1]],
            unconstrained.is_some(),
            &chain,
        );
        let eye_turns = EyeTurns { angles, turns, measured_point, remaining, within_limits: unconstrained.is_some() };
        self.outcome(call, joints, &eye_turns, &lead, &chain)
    }

    /// Returns `true` if a joint further inward is aimed, so that the eyes rest.
    fn is_supported(&self, call: &Call<'_>) -> bool {
        call.settings.effector.min(self.rig.count().saturating_sub(1)) > 0
    }

    /// Returns the ranges of the leading eye within which both eyes can look at its target.
    #[cfg_attr(not(aim_small), inline(always))]
    fn leading_motion(&self, call: &Call<'_>, corrections: &[Quat]) -> RangeOfMotion {
        let target = self.undo_corrections(corrections, call.target_ps.into());
        let distance = length(target).at_least(NEAREST * self.eye_distance);
        // NaN if the distance is 0.
        let half = (0.5 * self.eye_distance * call.settings.effective_weight() / distance).at_least(0.0).at_most(0.5);
        // The arcsine of `half`.
        let inward = self.side * trig::twice_atan(half / (1.0 + math::root(1.0 - half * half)));
        let [own, other] = self.motions;
        let (own_heading, other_heading) = (own.heading.moved(inward), other.heading.moved(-inward));
        // The nearer eye sees the target at a larger pitch than the leading one, increasingly so with elevation. This
        // margin suffices up to 37°.
        own.shrunk(own_heading.common(other_heading), 1.0 - 1.25 * half)
    }

    /// Returns the reach of each eye in this call. Neither eye may turn outward further than the other can turn inward,
    /// so that the eyes never diverge.
    #[cfg_attr(not(aim_small), inline(always))]
    fn reaches(&self, call: &Call<'_>, start: &[Joint; 2]) -> [Reach; 2] {
        let [own, other] = self.motions;
        let [left, right] = if self.side > 0.0 { [own, other] } else { [other, own] };
        let left_heading = left.heading.no_further_up_than(right.heading);
        let right_heading = right.heading.no_further_down_than(left.heading);
        let headings = if self.side > 0.0 { [left_heading, right_heading] } else { [right_heading, left_heading] };
        let rate = self.rig.joints[0].rate;
        both(|eye| {
            let motion = RangeOfMotion { heading: headings[eye], ..self.motions[eye] };
            match call.dt {
                Some(dt) => Reach::frame(&motion, rate, &start[eye], dt),
                None => Reach::range(&motion),
            }
        })
    }

    /// Returns a point relative to the animated eyes, with the supporting joints' corrections undone.
    #[cfg_attr(not(aim_small), inline(always))]
    fn undo_corrections(&self, corrections: &[Quat], point_ps: Vec3A) -> Vec3A {
        let mut point = point_ps - self.middle;
        for (joint, turn) in self.pose.joints.iter().zip(corrections).skip(1).rev() {
            let place = joint.translation - self.middle;
            let local = match self.square {
                Some(square) => joint.matrix3.transpose() * ((point - place) * (1.0 / square)),
                None => inverse(joint).matrix3 * (point - place),
            };
            point = place + joint.matrix3 * math::turned(turn.conjugate(), local);
        }
        point
    }

    /// Moves a point out to the least distance at which the eyes look; `None` if it has no direction.
    #[cfg_attr(not(aim_small), inline(always))]
    fn with_min_distance(&self, point: Vec3A) -> Option<Vec3A> {
        let near = NEAREST * self.eye_distance;
        if length(point) < near { Some(math::direction(point)? * near) } else { Some(point) }
    }

    /// Returns a joint's correction at its angles.
    #[cfg_attr(not(aim_small), inline(always))]
    fn correction_of(&self, index: usize, joint: &Joint) -> Quat {
        self.tilted(joint_turn(&self.rig.joints[index], joint), index)
    }

    /// Converts a joint's rotation in its upright frame to its bone.
    #[cfg_attr(not(aim_small), inline(always))]
    fn tilted(&self, turn: Quat, index: usize) -> Quat {
        if self.rig.has_upright { tilted(turn, self.tilts[index]) } else { turn }
    }

    /// Returns the vectors from the eyes to a point, along the forward, left and up from which the angles are measured.
    #[cfg_attr(not(aim_small), inline(always))]
    fn views(&self, point: Vec3A) -> [Vec3A; 2] {
        let [own, other] = self.places;
        [self.to_angles * (point - own), self.other_to_angles.unwrap_or(self.to_angles) * (point - other)]
    }

    /// Returns both eyes' headings and pitches towards the target with these `views`; `None` unless both are within
    /// range and rate and the eyes do not diverge.
    #[cfg_attr(not(aim_small), inline(always))]
    fn unconstrained_angles(
        &self,
        call: &Call<'_>,
        target: Vec3A,
        views: [Vec3A; 2],
        start: &[Joint; 2],
    ) -> Option<[[f32; 2]; 2]> {
        let near = NEAREST * self.eye_distance;
        let both = headings_and_pitches(views);
        let [own, other] = &self.motions;
        let ends =
            |of: fn(Interval) -> f32| Vec4::new(of(own.heading), of(own.pitch), of(other.heading), of(other.pitch));
        let from = Vec4::new(start[0].heading, start[0].pitch, start[1].heading, start[1].pitch);
        let step = call.dt.map_or(f32::INFINITY, |dt| self.rig.joints[0].rate * dt);
        let inside = (both - ends(Interval::lo)).min(ends(Interval::hi) - both);
        let fits = inside.cmpgt(Vec4::splat(AT_LIMIT_RAD)) & (both - from).abs().cmple(Vec4::splat(step));
        let [h, p, other_h, other_p] = both.to_array();
        let is_free = fits.bitmask() == 15
            && own.taper.is_none()
            && self.side * (h - other_h) <= 0.0
            && target.dot(target) >= near * near
            && views[0].dot(views[0]).at_most(views[1].dot(views[1])) > 1e-30;
        is_free.then_some([[h, p], [other_h, other_p]])
    }

    /// Returns both eyes' headings and pitches in all other cases.
    #[cold]
    #[inline(never)]
    fn constrained_angles(
        &self,
        call: &Call<'_>,
        corrections: &[Quat],
        lead: &Joint,
        start: &[Joint; 2],
        chain: &ChainResult<'_>,
    ) -> Option<[[f32; 2]; 2]> {
        if call.dt == Some(0.0) {
            return Some(both(|eye| start[eye].angles()));
        }
        let reaches = self.reaches(call, start);
        Some(if !self.leads {
            [lead.angles(), reaches[1].angles_nearest(lead)]
        } else if chain.solution.goal.movement == Movement::Rest || self.is_supported(call) {
            // A leading eye that does not rest keeps the gaze on the animation while the head returns.
            both(|eye| reaches[eye].angles_nearest(lead))
        } else if chain.solution.goal.movement == Movement::Stay {
            both(|eye| reaches[eye].angles_nearest(&start[eye]))
        } else {
            self.eye_angles(
                self.with_min_distance(
                    self.undo_corrections(corrections, chain.solution.space.to_pose(chain.solution.goal.aim_point)),
                )?,
                lead,
                &reaches,
                start,
            )
            .0
        })
    }

    /// Returns both eyes' headings and pitches towards a target, and whether it is within the ranges regardless of the
    /// rates. Each eye looks from its own origin, or in parallel with `lead` if the directions would diverge or are far
    /// out of range.
    #[cold]
    fn eye_angles(
        &self,
        target: Vec3A,
        lead: &Joint,
        reaches: &[Reach; 2],
        start: &[Joint; 2],
    ) -> ([[f32; 2]; 2], bool) {
        let views = self.views(target);
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
                heading = start[eye].heading + math::wrap_pi(heading - start[eye].heading);
            }
            let [heading, pitch] = look_angles_at_heading(views[eye].to_array(), heading, &reaches[eye]);
            [if self.motions[eye].heading.is_free() { math::wrap_pi(heading) } else { heading }, pitch]
        });
        (angles, within)
    }

    /// Returns the other eye's correction at this heading and pitch, in its own bone's space.
    #[cold]
    pub(crate) fn correction(&self, angles: &[f32; 2]) -> Quat {
        self.to_other_eye(self.correction_of(0, &with_angles(&Joint::REST, *angles)))
    }

    /// Converts a correction of joint 0 to the other eye's bone. A mirrored relation reverses the sense of rotation.
    #[cfg_attr(not(aim_small), inline(always))]
    fn to_other_eye(&self, turn: Quat) -> Quat {
        let Mat3A { x_axis, y_axis, z_axis } = self.relation;
        let sense = if math::cross(x_axis, y_axis).dot(z_axis) < 0.0 { -1.0 } else { 1.0 };
        let axis = self.relation * Vec3A::new(turn.x, turn.y, turn.z) * sense;
        let square = axis.dot(axis) + turn.w * turn.w;
        Quat::from_vec4(Vec4::from((axis, turn.w)) * (1.0 / math::sqrt(square)))
    }

    /// Returns the remaining angle between each eye, turned by `turns`, and the point that the outcome is measured
    /// against.
    #[cfg_attr(not(aim_small), inline(always))]
    fn remaining(
        &self,
        corrections: &[Quat],
        turns: [Quat; 2],
        halves: [Halves; 2],
        [measured_point, views @ ..]: [Vec3A; 3],
        within_limits: bool,
        chain: &ChainResult<'_>,
    ) -> [Option<f32>; 2] {
        if self.square.is_none() || !within_limits {
            return both(|eye| {
                self.true_remaining(
                    corrections,
                    eye,
                    turns,
                    chain.solution.space.to_pose(chain.solution.goal.measured_point),
                )
            });
        }
        let angles = both(|eye| {
            let seen = Turn::of_halves(halves[eye]).undo(views[eye]);
            trig::small_atan2(math::root(seen.y * seen.y + seen.z * seen.z), seen.x)
        });
        let least = 1e-4 * self.eye_distance;
        both(|eye| {
            let away = measured_point - self.places[eye];
            (away.dot(away) > least * least && angles[eye].is_finite()).then_some(angles[eye])
        })
    }

    /// Returns one eye's remaining angle by true forward kinematics, which is accurate even for a target close to an
    /// eye.
    #[cold]
    fn true_remaining(&self, corrections: &[Quat], eye: usize, turns: [Quat; 2], point_ps: Vec3A) -> Option<f32> {
        let matrix = if eye == 0 { self.pose.joints[0].matrix3 } else { self.other_eye.matrix3 };
        let forward = Vec3A::from(self.rig.joints[0].axes.forward);
        let forward =
            if eye == 0 { math::turned(turns[0], forward) } else { self.relation * math::turned(turns[1], forward) };
        let mut ray = Ray { origin: self.places[eye], direction: matrix * forward };
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

    /// Returns the outcome of both eyes, each judged from its own origin by forward kinematics.
    #[cfg_attr(not(aim_small), inline(always))]
    fn outcome(
        &self,
        call: &Call<'_>,
        joints: &[Joint],
        eye_turns: &EyeTurns,
        lead: &Joint,
        chain: &ChainResult<'_>,
    ) -> Option<Outcome> {
        // Joint 0's flags cover both eyes.
        let other = with_angles(lead, eye_turns.angles[1]);
        let (mut at_limit, mut recovering) = (chain.outcome.at_limit, chain.outcome.recovering);
        let met = if eye_turns.within_limits { [false; 2] } else { self.limits_met([joints[0], other]) };
        at_limit.set(0, met[0]);
        recovering.set(0, met[1]);
        let [own_remaining, other_eye_remaining] = eye_turns.remaining;
        let other_eye_correction = Some(self.to_other_eye(eye_turns.turns[1]));
        let outcome = Outcome { at_limit, recovering, other_eye_remaining, other_eye_correction, ..*chain.outcome };
        if !self.leads || self.is_supported(call) {
            return Some(outcome);
        }
        let (remaining, tolerance) = (own_remaining?, call.settings.effective_tolerance());
        let farther = remaining.at_least(other_eye_remaining?);
        let within_reach =
            farther > tolerance && call.dt.is_some() && self.is_within_reach(call, eye_turns, lead, chain);
        let verdict = Verdict { remaining: farther, tolerance, behind: chain.solution.goal.behind, within_reach };
        let status = verdict.status();
        let own = Verdict { remaining, ..verdict }.outcome_at(at_limit, recovering);
        Some(Outcome { aim: own.aim, remaining, status, ..outcome })
    }

    /// Returns `true` if only rates keep the eyes from their target.
    #[cold]
    fn is_within_reach(&self, call: &Call<'_>, eye_turns: &EyeTurns, lead: &Joint, chain: &ChainResult<'_>) -> bool {
        match chain.outcome.status {
            Status::RateLimited => true,
            // The leading eye has reached the target: check whether the ranges let both eyes reach it.
            Status::Reached => self.with_min_distance(eye_turns.measured_point).is_some_and(|seen| {
                let near = NEAREST * self.eye_distance * 1.000_01;
                let start = eye_turns.angles.map(|angles| with_angles(lead, angles));
                self.eye_angles(seen, lead, &self.reaches(call, &start), &start).1 && math::length(seen) > near
            }),
            _ => false,
        }
    }

    /// Returns whether an eye is at a limit, and whether one is out of its range.
    #[cold]
    fn limits_met(&self, eyes: [Joint; 2]) -> [bool; 2] {
        let info = slice::from_ref(&self.rig.joints[0]);
        let [own, other] = both(|eye| limits_met(info, &self.motions[eye..=eye], &eyes[eye..=eye]));
        [!(own.0.is_empty() && other.0.is_empty()), !(own.1.is_empty() && other.1.is_empty())]
    }
}

/// The result of solving the chain for the leading eye.
struct ChainResult<'a> {
    outcome: &'a Outcome,
    solution: &'a ChainSolution,
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
    /// `true` if neither eye is at a limit.
    within_limits: bool,
}

/// The transforms of [`Eyes::new`] for eyes that are sheared or scaled non-uniformly: the inverse of joint 0's matrix,
/// the transform from joint 0's space to the other eye's bone, and the inverse of the other eye's matrix.
#[cold]
fn eye_transforms(joint: &Affine3A, other_eye: &Affine3A, info: &JointInfo) -> Option<(Mat3A, Mat3A, Mat3A)> {
    if !(joint.is_finite() && other_eye.is_finite()) {
        return None;
    }
    math::orthonormal(joint.matrix3)?;
    math::orthonormal(other_eye.matrix3)?;
    // Forward first, because Gram–Schmidt keeps the direction of the first column, even if the pose is stretched.
    let Axes { up, forward, left } = info.axes;
    let axes = Mat3A::from_cols(forward.into(), up.into(), left.into());
    let (from_pose, from_pose_to_other) = (inverse(joint).matrix3, inverse(other_eye).matrix3);
    let relation = math::orthonormal(from_pose_to_other * joint.matrix3 * axes)? * math::orthonormal(axes)?.transpose();
    let is_seen = from_pose.is_finite() && (relation.transpose() * from_pose_to_other).is_finite();
    is_seen.then_some((from_pose, relation, from_pose_to_other))
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
