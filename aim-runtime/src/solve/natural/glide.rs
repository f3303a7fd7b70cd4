//! Motion over time: regions [glide](Glide) to their goals, eyes make [saccades](saccade).
//!
//! In both, angle = goal + offset. The smooth part of a goal's movement is followed directly (fed forward), while
//! anything sudden goes into the offset, which decays. A gaze therefore follows a moving target without lag, and a
//! target that jumps starts one smooth movement, whatever the frame rate.

use core::f32::consts::PI;

use glam::{Vec4, Vec4Swizzles};

use crate::math;
use crate::math::Bounded;
use crate::rig::{HeadGoal, Swings};

/// Heading and pitch in the first two lanes; the other lanes are unspecified.
pub(super) type Pair = Vec4;

/// A region's offset from its goal, with its mean velocity in the last frame and its acceleration at the end of that
/// frame. The offset decays as (c₀ + c₁t + c₂t²)·e^(−ωt). Velocity and acceleration are continuous; the speed is
/// bell-shaped, with its peak 2/ω after the start, at 32 % of the way.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Glide {
    pub(super) offset: Pair,
    pub(super) speed: Pair,
    pub(super) acceleration: Pair,
}

/// The bounds of a glide in one frame.
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    pub(super) dt: f32,
    pub(super) per_dt: f32,
    /// The pace of the decay, ω, 1/s.
    pub(super) pace: f32,
    /// The largest speed of the region, rad/s.
    pub(super) rate: f32,
    /// The largest speed at which an offset decays, rad/s.
    pub(super) approach: f32,
    /// The largest change of the region's speed, rad/s².
    pub(super) acceleration: f32,
}

/// Braking before an end that approaches too fast may exceed the acceleration by this factor.
const LATE: f32 = 2.0;
/// Part of the acceleration used to brake before an end that comes nearer; the rest is in reserve, as the end may speed
/// up.
const WARY: f32 = 0.5;

impl Glide {
    /// Returns the glide one frame later, for a goal with the velocity `before` in the last frame and `with` in this
    /// one. From frame to frame, the region's total velocity, that of goal and offset, changes by at most the
    /// acceleration.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn after(&self, bounds: &Bounds, before: Pair, with: Pair) -> Self {
        let &Bounds { dt, per_dt, pace, rate, approach, acceleration } = bounds;
        let far = length(self.offset);
        // A constant offset would decay at speed ω·offset/3. Limit that speed to what the goal's velocity leaves of the
        // rate.
        let near = 3.0 * (rate - length(with)).at_least(0.0).at_most(approach);
        let part = if far * pace > near { near / (pace * far) } else { 1.0 };
        let fade = exp_of_minus(pace * dt);
        let c0 = self.offset * part;
        let start = self.speed + self.acceleration * dt * 0.5;
        let c1 = start + c0 * pace;
        let c2 = (self.acceleration + (start + c1) * pace) * 0.5;
        let c2_dt = c2 * dt;
        let later = (c0 + (c1 + c2_dt) * dt) * fade;
        let end = (c1 + c2_dt * 2.0) * fade - later * pace;
        let speed = (later - c0) * per_dt;
        let base = self.speed + before - with;
        let gain = speed - base;
        let (change, most) = (length(gain), acceleration * dt);
        if change > most {
            return self.at_speed(base + gain * (most / change), bounds);
        }
        let acceleration = c2 * 2.0 * fade - (end * 2.0 + later * pace) * pace;
        Self { offset: self.offset + speed * dt, speed, acceleration }
    }

    /// Returns the glide after a frame at this mean velocity.
    #[cfg_attr(not(aim_small), inline(always))]
    fn at_speed(&self, speed: Pair, bounds: &Bounds) -> Self {
        Self { offset: self.offset + speed * bounds.dt, speed, acceleration: (speed - self.speed) * bounds.per_dt }
    }

    /// Returns the glide, braked if the region could no longer stop before its limits, which may move. `before` is the
    /// glide and `sum` the region's angles at the start of the frame; `begins` and `with` are the goal's velocities.
    /// `separate_limits` computes the limits by the joints' ranges and by the budget.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn braked(
        self,
        before: &Self,
        sum: Pair,
        limits: &RegionLimits,
        separate_limits: impl Fn() -> [Vec4; 2],
        [begins, with]: [Pair; 2],
        bounds: &Bounds,
    ) -> Self {
        let end = self.speed + with;
        let (sums, speeds) = (both_ways(sum), both_ways(end));
        if limits.allows_stop(sums, speeds, bounds) {
            return self;
        }
        let most = limits.max_speeds(separate_limits(), sums, speeds, *bounds);
        // If even the increased braking is too late, the range stops the movement.
        let start = before.speed + begins;
        let held = end.min(most).max(-most.zwxy());
        let late = Vec4::splat(LATE * bounds.acceleration * bounds.dt);
        let held = Vec4::select(held.cmpeq(end), end, held.max(start - late).min(start + late));
        let is_free = held.cmpeq(end);
        if is_free.bitmask() & 3 == 3 {
            return self;
        }
        let speed = held - with;
        let acceleration = Vec4::select(is_free, self.acceleration, Vec4::ZERO);
        Self { offset: before.offset + speed * bounds.dt, speed, acceleration }
    }

    /// Returns `true` if no visible movement remains.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn is_over(&self, pace: f32) -> bool {
        const STILL_RAD: f32 = 2e-5;
        square(self.offset) <= STILL_RAD * STILL_RAD && square(self.speed) <= STILL_RAD * STILL_RAD * pace * pace
    }
}

/// A region's limits by its joints' ranges and its budget: the upper limits of heading and pitch, then the lower limits
/// negated.
#[derive(Clone, Copy)]
pub(super) struct RegionLimits {
    /// The tighter limit of each lane, at least 0.
    at: Vec4,
    /// The velocities at which the animation moves the ranges' and the budget's limits; negative for approaching ones,
    /// else 0.
    speeds: [Vec4; 2],
}

/// Returns a pair, followed by its negation.
#[cfg_attr(not(aim_small), inline(always))]
fn both_ways(pair: Pair) -> Vec4 {
    pair.xyxy() * Vec4::new(1.0, 1.0, -1.0, -1.0)
}

impl RegionLimits {
    /// Returns the limits for sums between `lo` and `hi`.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn pack([lo, hi]: [Pair; 2]) -> Vec4 {
        Vec4::new(hi.x, hi.y, -lo.x, -lo.y).max(Vec4::ZERO)
    }

    /// Creates the limits `at`. The animation has shifted them by `shifts`, and in the last frame by `before`.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn new(at: Vec4, shifts: [Pair; 2], before: Option<[[f32; 2]; 2]>, bounds: &Bounds) -> Self {
        let Some(before) = before else { return Self { at, speeds: [Vec4::ZERO; 2] } };
        let speeds = [0, 1].map(|limit| {
            let speed = both_ways(shifts[limit] - pair(before[limit])) * bounds.per_dt;
            // A limit that jumps has no velocity, and a receding one may stop at any time.
            Vec4::select(speed.cmpge(Vec4::splat(-bounds.rate)), speed.min(Vec4::ZERO), Vec4::ZERO)
        });
        Self { at, speeds }
    }

    /// Returns the distances needed to stop at these speeds before limits that approach.
    #[cfg_attr(not(aim_small), inline(always))]
    fn stopping_distances(speeds: Vec4, limit_speed: Vec4, acceleration: Vec4, dt: f32) -> Vec4 {
        let closing = (speeds - limit_speed).max(Vec4::ZERO);
        closing * (closing * 0.5 / acceleration + Vec4::splat(dt))
    }

    /// Returns `true` if every limit is certainly further away than the distance needed to stop.
    #[cfg_attr(not(aim_small), inline(always))]
    fn allows_stop(&self, sums: Vec4, speeds: Vec4, bounds: &Bounds) -> bool {
        let limit_speed = self.speeds[0].min(self.speeds[1]);
        let distances =
            Self::stopping_distances(speeds, limit_speed, Vec4::splat(WARY * bounds.acceleration), bounds.dt);
        (self.at - sums).cmpgt(distances).bitmask() == 15
    }

    /// Returns the largest speeds from which it is possible to stop before the limits. Takes values, like all functions
    /// here that are rarely called, so that callers can keep theirs in registers.
    #[cold]
    #[inline(never)]
    fn max_speeds(self, ends: [Vec4; 2], sums: Vec4, speeds: Vec4, bounds: Bounds) -> Vec4 {
        let mut most = [f32::INFINITY; 4];
        for (end, limit_speed) in ends.iter().zip(&self.speeds) {
            // Measure the distance from the limit's position at the start of the frame. A limit already at the
            // animation stays.
            let limit_speed = Vec4::select(end.cmpgt(Vec4::ZERO), *limit_speed, Vec4::ZERO);
            let left = *end - limit_speed * bounds.dt - sums;
            let wary = Vec4::select(limit_speed.cmplt(Vec4::ZERO), Vec4::splat(WARY), Vec4::ONE);
            let acceleration = wary * bounds.acceleration;
            let is_near = left.cmple(Self::stopping_distances(speeds, limit_speed, acceleration, bounds.dt));
            for lane in (0..4).filter(|lane| is_near.test(*lane)) {
                let mut speed = braking(left[lane], acceleration[lane] * bounds.dt, bounds.dt) + limit_speed[lane];
                if speed < 0.0 {
                    // A limit comes no nearer than the animation, so a retreating region has to be able to stop there.
                    speed = speed.at_least(-braking(sums[lane], bounds.acceleration * bounds.dt, bounds.dt));
                }
                most[lane] = most[lane].at_most(speed);
            }
        }
        Vec4::from_array(most)
    }
}

/// Returns the largest mean speed in a frame from which a movement that loses at most `gain` of its speed per frame can
/// stop within `distance`.
///
/// A speed of n + r gains, with integer n and 0 ≤ r ≤ 1, takes a distance of n(n + 1)/2 + (n + 1)·r times gain·dt.
fn braking(distance: f32, gain: f32, dt: f32) -> f32 {
    let distance = (distance / (gain * dt)).at_least(0.0);
    let whole = 0.5 * (math::sqrt(1.0 + 8.0 * distance) - 1.0);
    if !(whole < 3e4) {
        return f32::INFINITY;
    }
    #[expect(clippy::cast_possible_truncation, reason = "whole frames are meant")]
    let frames = f32::from(whole as i16);
    gain * (frames + (distance - 0.5 * frames * (frames + 1.0)) / (frames + 1.0))
}

/// Part of the acceleration up to which a head follows its goal's changes of velocity. Less than half of the
/// acceleration, in either direction, is no full reversal.
const FOLLOWED: f32 = 0.45;

impl Swings {
    /// Returns the part of its goal's movement that a head follows, for the goal's velocity `change` in this frame: all
    /// of it, or as much as keeps the accelerations with which the goal has lately been slowed down within [`FOLLOWED`].
    ///
    /// A head that followed all of a faster swing as far as its acceleration allows would lag behind, and turn away from
    /// its goal half of the time. A goal that speeds up in one direction does not count.
    pub(super) fn followed_part(&mut self, change: Pair, bounds: &Bounds) -> f32 {
        /// Time constant of the mean velocity, seconds. It levels the steps between an animation's keys.
        const MEAN_S: f32 = 0.02;
        /// Time constant with which a deceleration is forgotten, seconds.
        const FORGOTTEN_S: f32 = 0.3;
        let &Bounds { dt, rate, acceleration, .. } = bounds;
        let fastest = Vec4::splat(rate);
        let mean = pair(self.mean_velocity).max(-fastest).min(fastest);
        // A goal that is faster jumps.
        if square(change) <= rate * rate {
            let gain = (change - mean) / (dt + MEAN_S);
            let slows = -(gain.x * mean.x + gain.y * mean.y) / length(mean).at_least(f32::MIN_POSITIVE);
            self.mean_velocity = to_array(mean + gain * dt);
            self.braking = (self.braking / (1.0 + dt / FORGOTTEN_S)).at_least(slows);
        }
        (FOLLOWED * acceleration / self.braking.at_least(f32::MIN_POSITIVE)).at_most(1.0)
    }
}

/// Splits the movement of the head's goal in a frame into a velocity that the region follows (feed-forward) and an
/// offset. Returns the offset and the jump of the goal.
///
/// - The head follows `part` of the goal's velocity, as far as the rate allows.
/// - A change of that velocity is followed at once up to [`FOLLOWED`], and gradually beyond.
/// - A jump becomes offset entirely, and so does a hop from which the goal returns.
#[cfg_attr(not(aim_small), inline(always))]
pub(super) fn split_goal_motion(
    head_goal: &mut HeadGoal,
    [sum, goal]: [Pair; 2],
    part: f32,
    bounds: &Bounds,
) -> [Pair; 2] {
    let &Bounds { dt, per_dt, rate, acceleration, .. } = bounds;
    let most = Vec4::splat(acceleration * dt);
    let [last_goal, last_feed_forward, last_velocity] =
        [head_goal.angles, head_goal.feed_forward, head_goal.velocity].map(pair);
    let moved = goal - last_goal;
    let change = moved * (per_dt * part);
    let lasts = is_near_to(change, last_velocity, most);
    // The goal hops if its velocities in two frames lie on either side of the feed-forward velocity.
    let mut gain = change - last_feed_forward;
    let hops = (gain * (last_velocity - last_feed_forward)).cmplt(Vec4::ZERO);
    if square(change) <= rate * rate {
        gain = if lasts { gain } else { Vec4::select(hops, Vec4::ZERO, gain) };
    } else {
        let within_rate = change * (rate / length(change));
        gain = if lasts { within_rate - last_feed_forward } else { Vec4::ZERO };
    }
    let speed = last_feed_forward + gain.max(most * -FOLLOWED).min(most * FOLLOWED);
    let (jump, ahead) = (moved - speed * dt, last_goal - sum);
    head_goal.slow_for_reversal(jump, ahead, dt);
    (head_goal.angles, head_goal.feed_forward, head_goal.velocity) =
        (to_array(goal), to_array(speed), to_array(change));
    [-ahead - jump, jump]
}

/// Returns `true` if both angles are within `most` of the others.
#[cfg_attr(not(aim_small), inline(always))]
fn is_near_to(pair: Pair, other: Pair, most: Pair) -> bool {
    (pair - other).abs().cmple(most * 1.0001).bitmask() & 3 == 3
}

impl HeadGoal {
    /// Follows a goal that moves because weight or attention changes. Such a fade ends abruptly, and following its
    /// velocity would overshoot. All of its movement therefore becomes offset, which decays without overshoot.
    #[cold]
    #[inline(never)]
    pub(super) fn fade(mut self, [sum, goal]: [Pair; 2], mut glide: Glide, dt: f32) -> (Self, Glide) {
        glide.speed += pair(self.feed_forward);
        glide.offset = sum - goal;
        self.slow_for_reversal(Vec4::ZERO, Vec4::ZERO, dt);
        (self.angles, self.feed_forward, self.velocity) = (to_array(goal), [0.0; 2], [0.0; 2]);
        (self, glide)
    }

    /// Returns the factor on the head's pace, below 1 if its goal jumps to and fro.
    pub(super) fn pace_factor(&self) -> f32 {
        const LEAST: f32 = 0.4;
        (1.0 - self.slowdown).at_least(LEAST).at_most(1.0)
    }

    /// Makes the head slower for a while if its goal jumps back before the head has arrived, so that it stays near the
    /// middle. `jump` is the goal's jump, and `ahead` its distance from the head before it.
    #[cfg_attr(not(aim_small), inline(always))]
    fn slow_for_reversal(&mut self, jump: Pair, ahead: Pair, dt: f32) {
        const MOST: f32 = 1.5;
        const RESTS_S: f32 = 0.8;
        // Jumps up to the first angle count as jitter and are ignored; from the second angle on they count in full.
        const TREMBLING_RAD: f32 = 5.0 * PI / 180.0;
        const WHOLE_RAD: f32 = 15.0 * PI / 180.0;
        let back = -(jump.x * ahead.x + jump.y * ahead.y);
        let size = square(jump);
        if back > 0.0 && size > TREMBLING_RAD * TREMBLING_RAD {
            let counts = ((math::sqrt(size) - TREMBLING_RAD) / (WHOLE_RAD - TREMBLING_RAD)).at_most(1.0);
            self.slowdown += counts * (4.0 * back / size).at_most(1.0);
        }
        self.slowdown = (self.slowdown.at_most(MOST) - dt / RESTS_S).at_least(0.0);
    }
}

/// Returns an eye's offset from its goal and the offset's velocity one frame later, with constant acceleration and
/// constant braking.
#[cfg_attr(not(aim_small), inline(always))]
pub(super) fn saccade(offset: Pair, speed: Pair, [dt, per_dt]: [f32; 2], rate: f32) -> (Pair, Pair) {
    /// An eye's acceleration, rad/s²: 10° take 58 ms and reach 340°/s, in agreement with the main sequence (Bahill,
    /// Clark and Stark, *Math. Biosci.* 24, 1975).
    const ACCELERATION: f32 = 11_500.0 * PI / 180.0;
    let gain = ACCELERATION * dt;
    let (far, most) = (square(offset), gain * gain);
    let mean = offset * -per_dt;
    let stops = square(speed) <= most && 4.0 * square(mean) <= most && 4.0 * square(mean - speed) <= most;
    if stops || !(far > 0.0) {
        return (Vec4::ZERO, Vec4::ZERO);
    }
    let distance = math::sqrt(far);
    let along = offset * (-1.0 / distance);
    // The speed v at the end of the frame from which the eye can still stop: v² = 2a·(distance − (speed + v)·dt/2).
    let (half, towards) = (0.5 * gain, along.x * speed.x + along.y * speed.y);
    let wanted = (math::sqrt(half * half + gain * (2.0 * distance * per_dt - towards)) - half).at_most(rate);
    let change = along * wanted - speed;
    let next = speed + change * (gain / length(change)).at_most(1.0);
    (offset + (speed + next) * (0.5 * dt), next)
}

#[cfg_attr(not(aim_small), inline(always))]
pub(super) fn pair([heading, pitch]: [f32; 2]) -> Pair {
    Vec4::new(heading, pitch, 0.0, 0.0)
}

#[cfg_attr(not(aim_small), inline(always))]
pub(super) fn to_array(pair: Pair) -> [f32; 2] {
    [pair.x, pair.y]
}

#[cfg_attr(not(aim_small), inline(always))]
pub(super) fn square(pair: Pair) -> f32 {
    pair.x * pair.x + pair.y * pair.y
}

#[cfg_attr(not(aim_small), inline(always))]
pub(super) fn length(pair: Pair) -> f32 {
    math::root(square(pair))
}

/// Returns e^(−x) for x ≥ 0, accurate to 1e-6: the 16th power of a series.
#[cfg_attr(not(aim_small), inline(always))]
fn exp_of_minus(x: f32) -> f32 {
    let x = x.at_most(40.0) * (-1.0 / 16.0);
    let root = 1.0 + x * (1.0 + x * (1.0 / 2.0 + x * (1.0 / 6.0 + x * (1.0 / 24.0 + x * (1.0 / 120.0)))));
    let square = |x: f32| x * x;
    square(square(square(square(root))))
}
