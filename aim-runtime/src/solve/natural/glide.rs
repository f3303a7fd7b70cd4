//! How joints get to where they belong: regions [glide](Glide), eyes [leap](saccade).
//!
//! Both go along with what their goal does smoothly and make up for what it does at once by an offset that dies away:
//! angle = goal + offset. So a gaze follows a moving target without lag, and a target that leaps sets off one smooth
//! movement, whatever the frame rate. Pairs are of heading and pitch.

use core::f32::consts::PI;

use crate::limits::Interval;
use crate::math;
use crate::math::Bounded;
use crate::rig::Led;

pub(super) type Pair = [f32; 2];

/// The offset of a region from its goal: its mean speed in the last frame and its acceleration at the end of that. It dies away
/// as (c₀ + c₁t + c₂t²)·e^(−ωt): speed and acceleration never jump, the speed is bell-shaped, and its peak is at 32 % of the way,
/// 2/ω after the start.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Glide {
    pub(super) offset: Pair,
    pub(super) speed: Pair,
    pub(super) acceleration: Pair,
}

/// What bounds a glide in a frame.
pub(super) struct Bounds {
    pub(super) dt: f32,
    /// ω.
    pub(super) pace: f32,
    pub(super) rate: f32,
    /// The largest speed at which an offset dies away.
    pub(super) approach: f32,
    pub(super) acceleration: f32,
}

impl Glide {
    /// The glide a frame later, while the goal goes on at speed `with` after `before`. From frame to frame, the region's
    /// speed as it is seen, that of goal and offset together, changes by no more than its acceleration allows.
    pub(super) fn after(&self, bounds: &Bounds, before: Pair, with: Pair) -> Self {
        let &Bounds { dt, pace, rate, approach, acceleration } = bounds;
        let far = length(self.offset);
        // While the offset stays the same, the speed comes to ω·offset/3; what the goal's own leaves of the rate.
        let near = 3.0 * (rate - length(with)).at_least(0.0).at_most(approach) / pace;
        let part = if far > near { near / far } else { 1.0 };
        let fade = exp_of_minus(pace * dt);
        let mut next = *self;
        for axis in [0, 1] {
            let c0 = part * self.offset[axis];
            let start = self.speed[axis] + 0.5 * dt * self.acceleration[axis];
            let c1 = start + pace * c0;
            let c2 = 0.5 * (self.acceleration[axis] + pace * (start + c1));
            let later = (c0 + dt * (c1 + dt * c2)) * fade;
            let end = (c1 + 2.0 * dt * c2) * fade - pace * later;
            next.speed[axis] = (later - c0) / dt;
            next.acceleration[axis] = 2.0 * c2 * fade - pace * (2.0 * end + pace * later);
        }
        let gain = [0, 1].map(|axis| next.speed[axis] + with[axis] - self.speed[axis] - before[axis]);
        let part = (acceleration * dt / length(gain)).at_most(1.0);
        let speed = [0, 1].map(|axis| self.speed[axis] + before[axis] - with[axis] + part * gain[axis]);
        next.speed_up(self, if part < 1.0 { speed } else { next.speed }, part < 1.0, dt);
        next
    }

    /// Gives the glide this mean speed in a frame that began as `before`.
    fn speed_up(&mut self, before: &Self, speed: Pair, is_bounded: bool, dt: f32) {
        for axis in [0, 1] {
            self.speed[axis] = speed[axis];
            self.offset[axis] = before.offset[axis] + speed[axis] * dt;
            if is_bounded {
                self.acceleration[axis] = (speed[axis] - before.speed[axis]) / dt;
            }
        }
    }

    /// Brakes where the region would not stop before the ends of its ranges any more; `sum` is where the frame began, as
    /// `before`, with the goal's speed `begins`.
    pub(super) fn brake(
        &mut self,
        before: &Self,
        sum: Pair,
        ranges: &[Interval; 2],
        [begins, with]: [Pair; 2],
        bounds: &Bounds,
    ) {
        let &Bounds { dt, acceleration, .. } = bounds;
        let gain = acceleration * dt;
        let mut speed = self.speed;
        for axis in [0, 1] {
            let (start, end) = (before.speed[axis] + begins[axis], self.speed[axis] + with[axis]);
            let left = if end > 0.0 { ranges[axis].hi() - sum[axis] } else { sum[axis] - ranges[axis].lo() };
            // More than it takes to stop.
            if left > end.abs() * (dt + 0.5 * end.abs() / acceleration) {
                continue;
            }
            let up = braking(ranges[axis].hi() - sum[axis], gain, dt);
            let down = braking(sum[axis] - ranges[axis].lo(), gain, dt);
            // Where it is too late to brake in time, the range ends the movement.
            let held = end.at_most(up).at_least(-down);
            if held != end {
                speed[axis] = held.at_least(start - gain).at_most(start + gain) - with[axis];
            }
        }
        if speed != self.speed {
            self.speed_up(before, speed, true, dt);
        }
    }

    /// Whether nothing is left of it that could be seen.
    pub(super) fn is_over(&self, pace: f32) -> bool {
        const STILL_RAD: f32 = 2e-5;
        length(self.offset) <= STILL_RAD && length(self.speed) <= STILL_RAD * pace
    }
}

/// The mean speed in a frame from which something that slows down by `gain` from frame to frame still stops at this distance.
///
/// A speed of n + r gains, 0 ≤ r ≤ 1, takes n(n + 1)/2 + (n + 1)·r times gain·dt.
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

/// What a leading goal did in a frame: the speed that its region goes along with, and the offset that is left. Returns the
/// speed with which the frame begins.
///
/// A change of the goal's speed within `most` is gone along with at once; one that lasts, from the second frame on, with
/// the region's own speed going on evenly; a leap is all offset.
pub(super) fn follow(led: &mut Led, sum: Pair, goal: Pair, glide: &mut Glide, bounds: &Bounds) -> Pair {
    let &Bounds { dt, rate, acceleration, .. } = bounds;
    let most = acceleration * dt;
    let mut begins = led.speed;
    let (mut leap, mut ahead) = ([0.0; 2], [0.0; 2]);
    let change = [0, 1].map(|axis| (goal[axis] - led.goal[axis]) / dt);
    let is_near = |a: Pair, b: Pair| [0, 1].into_iter().all(|axis| (a[axis] - b[axis]).abs() <= most);
    // One axis that leaps makes the other's change part of the leap.
    let is_smooth = is_near(change, led.speed);
    let is_led = (is_smooth || is_near(change, led.change)) && length(change) <= rate;
    for axis in [0, 1] {
        let (change, before) = (change[axis], led.speed[axis]);
        let speed = if is_led { change } else { before };
        if !is_smooth {
            glide.speed[axis] += before - speed;
            begins[axis] = speed;
        }
        ahead[axis] = led.goal[axis] - sum[axis];
        leap[axis] = (change - speed) * dt;
        glide.offset[axis] = -ahead[axis] - leap[axis];
        (led.goal[axis], led.speed[axis], led.change[axis]) = (goal[axis], speed, change);
    }
    led.tire(leap, ahead, dt);
    begins
}

impl Led {
    /// The part of its pace with which the head follows: less where its goal leaps to and fro.
    pub(super) fn haste(&self) -> f32 {
        const LEAST: f32 = 0.4;
        (1.0 - self.tired).at_least(LEAST).at_most(1.0)
    }

    /// A goal that leaps back before the head has come makes it slow for a while: it stays near the middle.
    ///
    /// `leap` is what the goal did at once, and `ahead` how far off it was before.
    fn tire(&mut self, leap: Pair, ahead: Pair, dt: f32) {
        const MOST: f32 = 1.5;
        const RESTS_S: f32 = 0.8;
        // What counts as trembling, and what counts in full.
        const TREMBLING_RAD: f32 = 5.0 * PI / 180.0;
        const WHOLE_RAD: f32 = 15.0 * PI / 180.0;
        let back = -(leap[0] * ahead[0] + leap[1] * ahead[1]);
        if back > 0.0 {
            let size = length(leap);
            let counts = ((size - TREMBLING_RAD) / (WHOLE_RAD - TREMBLING_RAD)).at_least(0.0).at_most(1.0);
            self.tired += counts * (4.0 * back / (size * size)).at_most(1.0);
        }
        self.tired = (self.tired.at_most(MOST) - dt / RESTS_S).at_least(0.0);
    }
}

/// An eye's offset from its goal and that offset's speed a frame later: speeding up evenly and braking evenly.
pub(super) fn saccade(offset: Pair, speed: Pair, dt: f32, rate: f32) -> (Pair, Pair) {
    /// An eye's acceleration, rad/s²: 10° take 58 ms and come to 340°/s, as the main sequence has it (Bahill, Clark and
    /// Stark, *Math. Biosci.* 24, 1975).
    const ACCELERATION: f32 = 11_500.0 * PI / 180.0;
    let gain = ACCELERATION * dt;
    let mean = offset.map(|offset| -offset / dt);
    let change = [mean[0] - speed[0], mean[1] - speed[1]];
    let distance = length(offset);
    let stops = length(speed) <= gain && length(mean) <= 0.5 * gain && length(change) <= 0.5 * gain;
    if stops || !(distance > 0.0) {
        return ([0.0; 2], [0.0; 2]);
    }
    let along = offset.map(|offset| -offset / distance);
    // The speed at the end of the frame from which it still stops: v² = 2a·(distance − (speed + v)·dt/2).
    let (half, towards) = (0.5 * gain, along[0] * speed[0] + along[1] * speed[1]);
    let wanted = (math::sqrt(half * half + gain * (2.0 * distance / dt - towards)) - half).at_most(rate);
    let change = [along[0] * wanted - speed[0], along[1] * wanted - speed[1]];
    let part = (gain / length(change)).at_most(1.0);
    let next = [0, 1].map(|axis| speed[axis] + part * change[axis]);
    let offset = [0, 1].map(|axis| offset[axis] + 0.5 * (speed[axis] + next[axis]) * dt);
    (offset, next)
}

pub(super) fn length([x, y]: Pair) -> f32 {
    math::sqrt(x * x + y * y)
}

/// e^(−x) of x ≥ 0, to 1e-6: the 16th power of a series.
fn exp_of_minus(x: f32) -> f32 {
    let x = -x.at_most(40.0) / 16.0;
    let root = 1.0 + x * (1.0 + x * (1.0 / 2.0 + x * (1.0 / 6.0 + x * (1.0 / 24.0 + x / 120.0))));
    let square = |x: f32| x * x;
    square(square(square(square(root))))
}
