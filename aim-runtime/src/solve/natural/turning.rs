//! Turns the joints: to their final angles in closed form, or by one frame's motion.

use core::f32::consts::{FRAC_PI_2, PI};

use glam::{Vec3A, Vec4};

use super::body::{Turn, angles};
use super::glide::{Bounds, Glide, Pair, RegionLimits, length, pair, saccade, split_goal_motion, square, to_array};
use super::range::Range;
use super::sight::{SightAngles, turn_to};
use super::{Aims, Gaze, Motion, Posture, SAME_RAD, THERE_RAD, at, sum};
use crate::kinematics::bearing::heading_and_pitch;
use crate::math::Bounded;
use crate::math::trig;
use crate::rig::{BodyPart, EXACT_JOINTS, HeadGoal, PerJoint, Swings};
use crate::{Joint, math};

/// The goal of a region's turn, with the turns of the joints inward of it undone.
#[derive(Clone, Copy)]
struct RegionTarget {
    /// The direction to which its outermost forward turns.
    direction: Vec3A,
    /// The angles of its outermost joint in that direction, if they are known.
    own_angles: Option<Pair>,
    /// The point that its outermost joint looks at instead, if that joint leads.
    lead_point: Option<Vec3A>,
}

/// The turns of all joints in one call.
struct Step<'a, const C: usize> {
    aims: Aims<'a>,
    /// Number of regions, 0 or 1, whose directions are the angles of their joints.
    measured: usize,
    /// The point that the leading joint looks at.
    point: Vec3A,
    /// `true` if that is the point that the outcome is measured against.
    is_measured: bool,
    /// The joints before.
    from: &'a PerJoint<Joint, C>,
    goals: PerJoint<Pair, C>,
    /// The directions of the regions' goals, with the turns of the joints assigned so far undone.
    directions: PerJoint<Vec3A, C>,
    /// The outermost region's view of its goal.
    sight: SightAngles,
}

impl<const C: usize> Gaze<'_, C> {
    /// Returns the outermost and the innermost joint of a region.
    #[cfg_attr(not(aim_small), inline(always))]
    fn ends(&self, number: usize) -> [usize; 2] {
        self.regions()[number].part.ends::<C>(number)
    }

    /// Turns the joints from the root outward: with `motion`, by one frame's motion; without, all but the eye to their
    /// final angles, and without writing corrections. Returns the leading joint's view of its point.
    pub(super) fn turn_joints(
        &self,
        aims: Aims<'_>,
        from: &PerJoint<Joint, C>,
        mut motion: Option<&mut Motion<'_, C>>,
        posture: &mut Posture<'_, C>,
    ) -> Option<SightAngles> {
        let (first, measured_point) = (self.body.first(), self.goal.measured_point);
        let goals = self.rig.array(Vec4::ZERO);
        let mut directions = self.rig.array(Vec3A::ZERO);
        posture.joints[first] = from[first];
        (posture.aim_point, posture.measured_point) = (measured_point, measured_point);
        let mut measured = 0;
        match aims {
            Aims::At(angles, point) => {
                posture.aim_point = point;
                measured = usize::from(self.measures_bearings(angles[0]));
                let mut number = measured;
                while number < self.count() {
                    if number + 1 == self.count() {
                        directions[number] = self.bearings.direction(angles[number]);
                        break;
                    }
                    let (own, other) = (angles[number], angles[number + 1]);
                    [directions[number], directions[number + 1]] =
                        self.bearings.directions(Vec4::new(own.x, own.y, other.x, other.y));
                    number += 2;
                }
            }
            Aims::EyeAt(point) | Aims::Rest(point) => posture.aim_point = point,
            Aims::Stay => {}
        }
        let (point, is_measured) = (posture.aim_point, posture.aim_point == measured_point);
        let mut step = Step { aims, measured, point, is_measured, from, goals, directions, sight: SightAngles::ZERO };
        if C == EXACT_JOINTS {
            // Two calls, so that both are inlined and know their joints.
            self.turn_region(0, &mut step, &mut motion, posture)?;
            self.turn_region(1, &mut step, &mut motion, posture)?;
        } else {
            for number in 0..self.count() {
                self.turn_region(number, &mut step, &mut motion, posture)?;
            }
        }
        let mut sight = step.sight;
        if is_measured {
            posture.measured_point = posture.aim_point;
        }
        if self.has_eye() {
            match aims {
                Aims::Stay => {
                    if let Some(motion) = &motion {
                        let held = motion.reaches[first].hold(angles(&from[first]));
                        posture.joints[first] = at(&from[first], held);
                    }
                    self.hold_eye(posture.joints);
                }
                Aims::At(..) | Aims::EyeAt(_) | Aims::Rest(_) => {
                    // An eye whose supporting joints have all returned rests as well.
                    let rests =
                        matches!(aims, Aims::Rest(_)) && posture.joints[first + 1..].iter().all(Joint::is_at_rest);
                    sight = if rests {
                        let rest = self.ranges[first].hold_from(Vec4::ZERO, Vec4::ZERO);
                        SightAngles { unclamped: rest, clamped: rest }
                    } else {
                        self.sight_angles(posture.joints, point, posture.aim_point)?
                    };
                    if let Some(motion) = &motion {
                        let held = self.clamp_straight(&sight, &from[first], posture);
                        posture.joints[first] = self.turn_eye(held, &from[first], motion);
                    }
                }
            }
        }
        Some(sight)
    }

    /// Returns `true` if the innermost region's direction, with this heading and elevation, has them as the angles of
    /// its joint.
    #[cfg_attr(not(aim_small), inline(always))]
    fn measures_bearings(&self, angles: Pair) -> bool {
        self.body.measures_bearings(self.ends(0)[0], self.bearings)
            && angles.abs().cmple(pair([PI, FRAC_PI_2])).bitmask() & 3 == 3
    }

    /// Turns the joints of a region.
    #[cfg_attr(not(aim_small), inline(always))]
    fn turn_region(
        &self,
        number: usize,
        step: &mut Step<'_, C>,
        motion: &mut Option<&mut Motion<'_, C>>,
        posture: &mut Posture<'_, C>,
    ) -> Option<()> {
        let (body, from, is_head) = (self.body, step.from, number + 1 == self.count());
        let [outer, inner] = self.ends(number);
        match step.aims {
            Aims::At(angles, _) => {
                let lead_point = (is_head && !self.has_eye()).then_some(step.point);
                let own_angles = (number < step.measured).then(|| angles[number]);
                let target = RegionTarget { direction: step.directions[number], own_angles, lead_point };
                let wanted = self.goals(number, target, from, posture, &mut step.goals)?;
                step.sight = SightAngles { unclamped: wanted, clamped: step.goals[outer] };
            }
            Aims::Rest(_) => {
                for index in outer..=inner {
                    step.goals[index] = self.ranges[index].hold_from(Vec4::ZERO, Vec4::ZERO);
                }
            }
            Aims::EyeAt(_) | Aims::Stay => {}
        }
        if let Some(motion) = motion {
            self.glide(number, &step.goals, from, posture.joints, motion);
        }
        for index in (outer..inner + 1).rev() {
            if motion.is_none() {
                posture.joints[index] = at(&from[index], step.goals[index]);
            }
            if index == body.first() {
                break;
            }
            let turn = if motion.is_some() { posture.correct(body, index) } else { Turn::new(step.goals[index]) };
            let (place, undo) = (body.places[index], body.undoing(index, &turn));
            for direction in &mut step.directions[number + 1..self.count()] {
                *direction = undo(*direction);
            }
            posture.aim_point = place + undo(posture.aim_point - place);
            if !step.is_measured {
                posture.measured_point = place + undo(posture.measured_point - place);
            }
        }
        Some(())
    }

    /// Finds the angles that turn a region to its goal. Returns the angles that the outermost joint would need.
    #[cfg_attr(not(aim_small), inline(always))]
    fn goals(
        &self,
        number: usize,
        target: RegionTarget,
        from: &PerJoint<Joint, C>,
        posture: &mut Posture<'_, C>,
        goals: &mut PerJoint<Pair, C>,
    ) -> Option<Pair> {
        let (wanted, lack) = self.shared_goals(number, target, Vec4::ZERO, from, posture, goals)?;
        let [outer, inner] = self.ends(number);
        if outer == inner || square(lack) <= SAME_RAD * SAME_RAD {
            return Some(wanted);
        }
        self.goals_beyond(number, target, lack, from, posture, goals)
    }

    /// [`goals`](Self::goals) where the outermost joint cannot cover its share: the inner joints cover the remainder.
    #[cold]
    #[inline(never)]
    fn goals_beyond(
        &self,
        number: usize,
        target: RegionTarget,
        mut extra: Pair,
        from: &PerJoint<Joint, C>,
        posture: &mut Posture<'_, C>,
        goals: &mut PerJoint<Pair, C>,
    ) -> Option<Pair> {
        /// Number of iterations: a turn about one joint's axis is slightly smaller about the next one's.
        const ROUNDS: usize = 4;
        let mut wanted = Vec4::ZERO;
        for _ in 0..ROUNDS {
            let lack;
            (wanted, lack) = self.shared_goals(number, target, extra, from, posture, goals)?;
            if square(lack) <= SAME_RAD * SAME_RAD {
                break;
            }
            extra += lack;
        }
        Some(wanted)
    }

    /// [`goals`](Self::goals) with the inner joints making their shares and `extra`, as far as their ranges allow. The
    /// outermost joint covers the remainder, in the frame that they carry. Also returns what it cannot cover.
    #[cfg_attr(not(aim_small), inline(always))]
    fn shared_goals(
        &self,
        number: usize,
        mut target: RegionTarget,
        extra: Pair,
        from: &PerJoint<Joint, C>,
        posture: &mut Posture<'_, C>,
        goals: &mut PerJoint<Pair, C>,
    ) -> Option<(Pair, Pair)> {
        let (body, region, [outer, innermost]) = (self.body, &self.regions()[number], self.ends(number));
        let (mut point, mut inner) = (posture.aim_point, Vec4::ZERO);
        if outer < innermost {
            (point, inner) = self.inner_goals(number, &mut target, extra, from, posture, goals);
        }
        let wanted = match (target.lead_point, target.own_angles) {
            (Some(true_point), _) => self.sight(posture.joints, true_point, point)?,
            (None, Some(angles)) => angles,
            _ if body.is_tilted(outer) => {
                turn_to(region.own_forward, body.rows[outer] * target.direction, self.ranges[outer].ends())
            }
            _ => heading_and_pitch(body.rows[outer] * target.direction),
        };
        let within = (wanted + inner).max(region.lo).min(region.hi) - inner;
        goals[outer] = self.ranges[outer].hold_from(angles(&from[outer]), within);
        Some((wanted, within - goals[outer]))
    }

    /// Finds the goals of the inner joints. Undoes their turns on `target` and on the point, and returns the
    /// point with the sum of their angles.
    #[inline(never)]
    fn inner_goals(
        &self,
        number: usize,
        target: &mut RegionTarget,
        mut extra: Pair,
        from: &PerJoint<Joint, C>,
        posture: &mut Posture<'_, C>,
        goals: &mut PerJoint<Pair, C>,
    ) -> (Vec3A, Pair) {
        let (body, region) = (self.body, &self.regions()[number]);
        let part = region.part;
        let (mut point, mut inner) = (posture.aim_point, Vec4::ZERO);
        let local = body.rows[part.inner] * target.direction;
        let mut whole = turn_to(region.forward, local, [region.lo, region.hi]);
        // Above 45° a heading means less and less, and the outermost joint, which the others carry up, makes it with a
        // smaller angle.
        whole.x *= (2.0 * (local.x * local.x + local.y * local.y)).at_most(1.0);
        // Inner joints turn no further than the region, or the outermost joint would have to turn back.
        whole = whole.max(region.lo).min(region.hi);
        if extra.y != 0.0 {
            extra.y *= region.inner_pitch_part(whole);
        }
        for index in (part.outer + 1..=part.inner).rev() {
            let own = region.share_of(whole, &body.infos()[index]);
            let held = self.ranges[index].hold_from(angles(&from[index]), own + extra);
            extra -= held - own;
            goals[index] = held;
            inner += held;
            let turn = Turn::new(held);
            target.direction = body.undo_turn(index, &turn, target.direction);
            if target.lead_point.is_some() {
                posture.joints[index] = at(&from[index], held);
                point = body.undo_turn_at(index, &turn, point);
            }
        }
        (point, inner)
    }

    /// Moves a region towards its joints' goals by one frame, or to a stop. Velocity and acceleration are stored in the
    /// outermost joint; the shifts of the limits by the animation in the innermost one, if that is a different joint.
    #[cfg_attr(not(aim_small), inline(always))]
    fn glide(
        &self,
        number: usize,
        goals: &PerJoint<Pair, C>,
        from: &PerJoint<Joint, C>,
        joints: &mut PerJoint<Joint, C>,
        motion: &mut Motion<'_, C>,
    ) {
        let (region, is_head, dt, per_dt) =
            (&self.regions()[number], number + 1 == self.count(), motion.dt, motion.per_dt);
        let [outer, innermost] = self.ends(number);
        let pace = region.part.pace * motion.memory.head_goal().pace_factor();
        let &BodyPart { rate, approach, acceleration, .. } = region.part;
        let mut bounds = Bounds { dt, per_dt, pace, rate, approach, acceleration };
        let (before, speed) = (sum(from, [outer, innermost]), pair(from[outer].velocity));
        let acceleration = from[outer].destination().map_or(Vec4::ZERO, pair);
        let mut glide = Glide { speed, acceleration, offset: Vec4::ZERO };
        let mut goal = goals[outer];
        for index in outer + 1..innermost + 1 {
            goal += goals[index];
        }
        let (mut begins, mut carries) = (Vec4::ZERO, Vec4::ZERO);
        let mut head_goal = if is_head { motion.memory.head_goal() } else { HeadGoal::default() };
        if motion.is_first {
            head_goal.angles = to_array(before);
        }
        if motion.stays {
            glide.speed = speed + pair(head_goal.feed_forward);
            (glide.offset, head_goal) = stopping(before, glide.speed, bounds.pace);
            goal = pair(head_goal.angles);
        } else if is_head && motion.fades && !motion.is_first {
            (head_goal, glide) = head_goal.fade([before, goal], glide, dt);
        } else if is_head {
            let mut part = 1.0;
            if !self.has_eye() {
                let mut swings = if motion.is_first { Swings::default() } else { motion.memory.swings() };
                part = swings.followed_part((goal - pair(head_goal.angles)) * per_dt, &bounds);
                motion.memory.set_swings(swings);
            }
            begins = pair(head_goal.feed_forward);
            let [offset, jump] = split_goal_motion(&mut head_goal, [before, goal], part, &bounds);
            glide.offset = offset;
            if !self.has_eye() {
                let jump_lag = jump_lag_after(motion.memory.jump_lag(), jump).at_most(length(glide.offset));
                motion.memory.set_jump_lag(jump_lag);
                bounds.pace *= 1.0 + (jump_pace_factor(jump_lag) - 1.0) * (part - head_goal.slowdown).at_least(0.0);
            }
            carries = pair(head_goal.feed_forward);
        } else {
            glide.offset = before - goal;
        }
        let inner = (outer < innermost).then_some(innermost);
        let own = &self.ranges[outer..innermost + 1];
        let shifts = inner.map_or([Vec4::ZERO; 2], |_| [Range::shift(own), region.budget_shift]);
        let shifts_before = inner.and_then(|inner| Some([from[inner].velocity, from[inner].destination()?]));
        let limits = RegionLimits::new(RegionLimits::pack([region.lo, region.hi]), shifts, shifts_before, &bounds);
        let separate_limits = || {
            let budget = [region.part.least, region.part.most].map(|end| end + region.budget_shift);
            [RegionLimits::pack(Range::sums(own)), RegionLimits::pack(budget)]
        };
        let next = glide.after(&bounds, begins, carries);
        let mut next = next.braked(&glide, before, &limits, separate_limits, [begins, carries], &bounds);
        if next.is_over(bounds.pace) {
            next = Glide::default();
        } else {
            motion.lag += length(next.offset);
            motion.arrived &= square(next.offset) < THERE_RAD * THERE_RAD
                && square(next.speed) < THERE_RAD * THERE_RAD * bounds.pace * bounds.pace;
        }

        let total = goal + next.offset;
        // If it is too late to brake, the limits stop the movement.
        let held = total.max(region.lo.min(before)).min(region.hi.max(before));
        let step = Vec4::splat(rate * dt);
        let held = held.max(before - step).min(before + step);
        let now = if inner.is_some() {
            self.distribute(number, goals, [goal, before, held], from, joints, motion)
        } else {
            let held = motion.reaches[outer].hold(held);
            joints[outer] = with_angles(held);
            held
        };
        // Range and rate take precedence: take the velocity from the actual movement where they intervened.
        let is_free = (now - total).abs().cmple(Vec4::splat(SAME_RAD));
        if is_free.bitmask() & 3 != 3 {
            next.speed = Vec4::select(is_free, next.speed, (now - before) * per_dt - carries);
            next.acceleration = Vec4::select(is_free, next.acceleration, Vec4::ZERO);
        }
        joints[outer].velocity = to_array(next.speed);
        joints[outer].set_destination(Some(to_array(next.acceleration)));
        if let Some(inner) = inner {
            joints[inner].velocity = to_array(shifts[0]);
            joints[inner].set_destination(Some(to_array(shifts[1])));
        }
        if is_head {
            motion.memory.set_head_goal(head_goal);
        }
    }

    /// Turns the joints of a region with several joints so that their angles add up to `total`. The joints' goals add
    /// up to `goal`, their present angles to `before`. Returns the sum that they actually reach.
    ///
    /// An inner joint makes its share of the sum, plus a deviation that gradually changes from its present deviation to
    /// that of its goal. The outermost joint covers the rest.
    #[inline(never)]
    fn distribute(
        &self,
        number: usize,
        goals: &PerJoint<Pair, C>,
        [goal, before, total]: [Pair; 3],
        from: &PerJoint<Joint, C>,
        joints: &mut PerJoint<Joint, C>,
        motion: &Motion<'_, C>,
    ) -> Pair {
        let region = &self.regions()[number];
        let outer = region.part.outer;
        let mut rest = total;
        let taken = 1.0 - 1.0 / (1.0 + motion.dt * region.part.pace);
        for index in (outer + 1..=region.part.inner).rev() {
            let [now, then, end] = [before, total, goal].map(|turn| region.share_of(turn, &self.body.infos()[index]));
            let off = angles(&from[index]) - now;
            let end = if motion.stays { off } else { goals[index] - end };
            let held = motion.reaches[index].hold(then + off + (end - off) * taken);
            joints[index] = with_angles(held);
            rest -= held;
        }
        let held = motion.reaches[outer].hold(rest);
        joints[outer] = with_angles(held);
        rest -= held;
        // The inner joints cover what the outermost cannot.
        for (joint, reach) in joints.iter_mut().zip(&**motion.reaches).take(region.part.inner + 1).skip(outer + 1) {
            if square(rest) <= SAME_RAD * SAME_RAD {
                break;
            }
            let now = angles(joint);
            let held = reach.hold(now + rest);
            *joint = with_angles(held);
            rest -= held - now;
        }
        total - rest
    }

    /// Turns the leading eye to its final angles for a view of its point.
    pub(super) fn settle_eye(&self, sight: &SightAngles, from: &PerJoint<Joint, C>, posture: &mut Posture<'_, C>) {
        if self.has_eye() {
            let eye = &from[self.body.first()];
            posture.joints[self.body.first()] = at(eye, self.clamp_straight(sight, eye, posture));
        }
    }

    /// Turns the eye by one frame towards its view of the point. Stores its goal and the velocity of the saccade.
    #[cfg_attr(not(aim_small), inline(always))]
    fn turn_eye(&self, held: Pair, joint: &Joint, motion: &Motion<'_, C>) -> Joint {
        let first = self.body.first();
        let now = angles(joint);
        let before = joint.destination().map_or(now, pair);
        let rate = self.body.infos()[first].rate.at_least(0.0).at_most(PI * motion.per_dt);
        let change = held - before;
        // Half of the rate is reserved for smooth movement of the goal; faster movement is made up for by a saccade.
        let step = 0.5 * rate * motion.dt;
        let change = if square(change) <= step * step { change } else { Vec4::ZERO };
        let (offset, speed) = saccade(now + change - held, pair(joint.velocity), [motion.dt, motion.per_dt], rate);
        let mut next = with_angles(motion.reaches[first].hold(held + offset));
        next.velocity = to_array(speed);
        next.set_destination(Some(to_array(held)));
        next
    }

    /// Returns the eye's angles for a point. Towards a point out of range it turns along the straight line from its rest,
    /// so that the gaze moves straight while the head follows, and keeps its elevation if the head does not get there.
    /// Towards a point far aside it turns level, because a straight line would lead round the other way.
    #[cfg_attr(not(aim_small), inline(always))]
    fn clamp_straight(&self, sight: &SightAngles, joint: &Joint, posture: &Posture<'_, C>) -> Pair {
        if sight.is_within() { sight.clamped } else { self.clamp_far_aside(sight.unclamped, joint, posture) }
    }

    #[inline(never)]
    fn clamp_far_aside(&self, wanted: Pair, joint: &Joint, posture: &Posture<'_, C>) -> Pair {
        /// Headings between which the eye changes from the straight line to the point's elevation.
        const ASIDE_RAD: [f32; 2] = [50.0 * PI / 180.0, 100.0 * PI / 180.0];
        let (range, glance) = (&self.ranges[self.body.first()], self.glance.turn);
        let (lo, hi, from_rest) = (range.lo + glance, range.hi + glance, wanted + glance);
        // Part of the straight line to the point that the range allows.
        let part = [0, 1].into_iter().fold(1.0_f32, |part, axis| {
            let (lo, hi, angle) = (lo[axis], hi[axis], from_rest[axis]);
            let held = angle.at_least(lo).at_most(hi);
            if lo >= hi || held == angle { part } else { part.at_most((held / angle).at_least(0.0)) }
        });
        let mut held = from_rest * part - glance;
        let aside = (from_rest.x.abs() - ASIDE_RAD[0]) / (ASIDE_RAD[1] - ASIDE_RAD[0]);
        if aside > 0.0 {
            held.y += aside.at_most(1.0) * (self.level_pitch(held.x, posture) - held.y);
        }
        range.hold_from(angles(joint), held)
    }

    /// Returns the pitch at which the eye, at this heading, looks as high as its point: the solution p of a·cos p +
    /// b·sin p = sin ε, where a and b are the vertical components of its forward and its up.
    fn level_pitch(&self, heading: f32, posture: &Posture<'_, C>) -> f32 {
        let body = self.body;
        let up = (body.first() + 1..body.count()).rev().fold(self.bearings.up(), |up, index| {
            body.undo_turn(index, &Turn::new(angles(&posture.joints[index])), up)
        });
        let up = body.rows[body.first()] * up;
        let local = body.view(posture.aim_point);
        let (sin, cos) = trig::sin_cos(heading);
        let (a, b) = (up.x * cos + up.y * sin, up.z);
        let sin_elevation = local.dot(up) / local.length().at_least(f32::MIN_POSITIVE);
        let sin = (sin_elevation / math::sqrt(a * a + b * b).at_least(1e-3)).at_least(-1.0).at_most(1.0);
        trig::atan2(sin, math::sqrt(1.0 - sin * sin)) - trig::atan2(a, b)
    }

    /// Keeps the eye at its present angles.
    pub(super) fn hold_eye(&self, joints: &mut [Joint]) {
        if self.has_eye() {
            let eye = &mut joints[self.body.first()];
            eye.velocity = [0.0; 2];
            eye.set_destination(Some([eye.heading, eye.pitch]));
        }
    }
}

/// Returns the offset −2·speed/ω with which a joint at `before` stops without turning back, and the place where it
/// does.
#[cold]
#[inline(never)]
fn stopping(before: Pair, speed: Pair, pace: f32) -> (Pair, HeadGoal) {
    let offset = speed * (-2.0 / pace);
    (offset, HeadGoal { angles: to_array(before - offset), ..HeadGoal::default() })
}

/// Returns the angle by which the target's jumps have left the head behind, after another jump. Small ones, as from
/// jerks of the animation, do not count.
fn jump_lag_after(before: f32, jump: Pair) -> f32 {
    const JUMP_RAD: f32 = 5.0 * PI / 180.0;
    let size = length(jump);
    if size > JUMP_RAD { before + size } else { before }
}

/// Returns the factor by which a leading head decays its offset faster, if the target's jumps account for `jump_lag`
/// radians of it: up to 3 for a small angle, 1 for a large one. The lag behind the animation's glances is then too
/// short to be seen. Small offsets also need little acceleration.
fn jump_pace_factor(jump_lag: f32) -> f32 {
    const SMALL_RAD: f32 = 3.0 * PI / 180.0;
    math::sqrt(SMALL_RAD / jump_lag.at_least(SMALL_RAD / 9.0)).at_least(1.0)
}

/// Returns a joint at these angles with an empty memory.
#[cfg_attr(not(aim_small), inline(always))]
fn with_angles(angles: Pair) -> Joint {
    at(&Joint::REST, angles)
}
