//! How joints get to where they belong: regions [glide](Glide), eyes [leap](saccade).
//!
//! Both go along with what their goal does smoothly and make up for what it does at once by an offset that dies away:
//! angle = goal + offset. So a gaze follows a moving target without lag, and a target that leaps sets off one smooth
//! movement, whatever the frame rate.

use core::f32::consts::PI;

use glam::Vec4;

use crate::math;
use crate::math::Bounded;
use crate::rig::Led;

/// Heading and pitch in the first two lanes; what the others hold does not matter.
pub(super) type Pair = Vec4;

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
    pub(super) per_dt: f32,
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
    #[inline(always)]
    pub(super) fn after(&self, bounds: &Bounds, before: Pair, with: Pair) -> Self {
        let &Bounds { dt, per_dt, pace, rate, approach, acceleration } = bounds;
        let far = length(self.offset);
        // While the offset stays the same, the speed comes to ω·offset/3; what the goal's own leaves of the rate.
        let near = 3.0 * (rate - length(with)).at_least(0.0).at_most(approach);
        let part = if far * pace > near { near / (pace * far) } else { 1.0 };
        let fade = exp_of_minus(pace * dt);
        let c0 = self.offset * part;
        let start = self.speed + self.acceleration * (0.5 * dt);
        let c1 = start + c0 * pace;
        let c2 = (self.acceleration + (start + c1) * pace) * 0.5;
        let later = (c0 + (c1 + c2 * dt) * dt) * fade;
        let end = (c1 + c2 * (2.0 * dt)) * fade - later * pace;
        let speed = (later - c0) * per_dt;
        let base = self.speed + before - with;
        let gain = speed - base;
        let (change, most) = (length(gain), acceleration * dt);
        if change > most {
            return self.at_speed(base + gain * (most / change), bounds);
        }
        let acceleration = c2 * (2.0 * fade) - (end * 2.0 + later * pace) * pace;
        Self { offset: self.offset + speed * dt, speed, acceleration }
    }

    /// The glide after a frame at this mean speed.
    #[inline(always)]
    fn at_speed(&self, speed: Pair, bounds: &Bounds) -> Self {
        Self { offset: self.offset + speed * bounds.dt, speed, acceleration: (speed - self.speed) * bounds.per_dt }
    }

    /// The glide where the region would not stop before the ends `lo` and `hi` of its ranges any more: braked. `sum` is where
    /// the frame began, as `before`, with the goal's speed `begins`.
    #[inline(always)]
    pub(super) fn braked(
        self,
        before: &Self,
        sum: Pair,
        [lo, hi]: [Pair; 2],
        [begins, with]: [Pair; 2],
        bounds: &Bounds,
    ) -> Self {
        let end = self.speed + with;
        let left = Vec4::select(end.cmpgt(Vec4::ZERO), hi - sum, sum - lo);
        let size = end.abs();
        // More than it takes to stop.
        let stops = size * (size * (0.5 / bounds.acceleration) + Vec4::splat(bounds.dt));
        if left.cmpgt(stops).bitmask() & 3 == 3 {
            return self;
        }
        let start = before.speed + begins;
        let held = [0, 1].map(|axis| {
            let (gain, sum, end) = (bounds.acceleration * bounds.dt, sum[axis], end[axis]);
            if left[axis] > stops[axis] {
                return end;
            }
            let up = braking(hi[axis] - sum, gain, bounds.dt);
            let down = braking(sum - lo[axis], gain, bounds.dt);
            // Where it is too late to brake in time, the range ends the movement.
            let held = end.at_most(up).at_least(-down);
            if held == end { end } else { held.at_least(start[axis] - gain).at_most(start[axis] + gain) }
        });
        if held == [end.x, end.y] { self } else { before.at_speed(pair(held) - with, bounds) }
    }

    /// Whether nothing is left of it that could be seen.
    #[inline(always)]
    pub(super) fn is_over(&self, pace: f32) -> bool {
        const STILL_RAD: f32 = 2e-5;
        square(self.offset) <= STILL_RAD * STILL_RAD && square(self.speed) <= STILL_RAD * STILL_RAD * pace * pace
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
/// speed with which the frame begins, and what the goal did at once.
///
/// A change of the goal's speed within `most` is gone along with at once; one that lasts, from the second frame on, with
/// the region's own speed going on evenly; a leap is all offset. A region that is shaken goes along with the goal's mean speed.
#[inline(always)]
pub(super) fn follow(led: &mut Led, sum: Pair, goal: Pair, glide: &mut Glide, bounds: &Bounds) -> [Pair; 2] {
    let &Bounds { dt, per_dt, rate, acceleration, .. } = bounds;
    let most = Vec4::splat(acceleration * dt);
    let [led_goal, led_speed, led_change] = [led.goal, led.speed, led.change].map(pair);
    let change = (goal - led_goal) * per_dt;
    let is_near = |other: Pair| (change - other).abs().cmple(most).bitmask() & 3 == 3;
    // One axis that leaps makes the other's change part of the leap.
    let (mut is_smooth, lasts) = (is_near(led_speed), is_near(led_change));
    let mut speed = if (is_smooth || lasts) && square(change) <= rate * rate { change } else { led_speed };
    if !lasts || led.tired > 0.0 {
        (speed, is_smooth) = led.shake(speed, change, lasts, bounds);
    }
    let mut begins = led_speed;
    if !is_smooth {
        glide.speed += led_speed - speed;
        begins = speed;
    }
    let (leap, ahead) = ((change - speed) * dt, led_goal - sum);
    glide.offset = -ahead - leap;
    led.tire(leap, ahead, dt);
    (led.goal, led.speed, led.change) = (ends(goal), ends(speed), ends(change));
    [begins, leap]
}

impl Led {
    /// The part of its pace with which the head follows: less where its goal leaps to and fro.
    pub(super) fn haste(&self) -> f32 {
        const LEAST: f32 = 0.4;
        (1.0 - self.tired).at_least(LEAST).at_most(1.0)
    }

    /// A goal that in motion goes on changing its speed v by more than the acceleration a makes up for shakes the head: going along
    /// overshoots by v²/2a. The more it is shaken, the more it goes along with the mean of its goal's speed alone.
    ///
    /// Returns what it goes along with instead of `speed`, and whether that is within the acceleration; `lasts` tells whether the
    /// goal's last change was.
    #[cold]
    #[inline(never)]
    fn shake(&mut self, speed: Pair, change: Pair, lasts: bool, bounds: &Bounds) -> (Pair, bool) {
        /// The time over which the mean is taken, and that in which shaking comes to count in full, seconds.
        const MEAN_S: f32 = 0.25;
        const SHAKEN_S: f32 = 0.08;
        /// From how far going along overshoots it counts as shaking, and from where in full.
        const OVERSHOOTS_RAD: [f32; 2] = [0.1 * PI / 180.0, 0.5 * PI / 180.0];
        let &Bounds { dt, rate, acceleration, .. } = bounds;
        let most = Vec4::splat(acceleration * dt);
        let before = pair(self.speed);
        let is_near = |speed: Pair| (speed - before).abs().cmple(most).bitmask() & 3 == 3;
        if !lasts {
            let overshoots = square(change).at_most(square(pair(self.change))) / (2.0 * acceleration);
            let counts = (overshoots - OVERSHOOTS_RAD[0]) / (OVERSHOOTS_RAD[1] - OVERSHOOTS_RAD[0]);
            self.tired += counts.at_least(0.0).at_most(1.0) * (dt / SHAKEN_S);
        }
        // A leap is no motion: of its speed no more counts than the head's own.
        let counted = change * (rate / length(change)).at_most(1.0);
        let mean = before + (counted - before) * (dt / (dt + MEAN_S));
        let speed = speed + (mean - speed) * self.tired.at_most(1.0);
        (speed, is_near(speed))
    }

    /// A goal that leaps back before the head has come makes it slow for a while: it stays near the middle.
    ///
    /// `leap` is what the goal did at once, and `ahead` how far off it was before.
    #[inline(always)]
    fn tire(&mut self, leap: Pair, ahead: Pair, dt: f32) {
        const MOST: f32 = 1.5;
        const RESTS_S: f32 = 0.8;
        // What counts as trembling, and what counts in full.
        const TREMBLING_RAD: f32 = 5.0 * PI / 180.0;
        const WHOLE_RAD: f32 = 15.0 * PI / 180.0;
        let back = -(leap.x * ahead.x + leap.y * ahead.y);
        let size = square(leap);
        if back > 0.0 && size > TREMBLING_RAD * TREMBLING_RAD {
            let counts = ((math::sqrt(size) - TREMBLING_RAD) / (WHOLE_RAD - TREMBLING_RAD)).at_most(1.0);
            self.tired += counts * (4.0 * back / size).at_most(1.0);
        }
        self.tired = (self.tired.at_most(MOST) - dt / RESTS_S).at_least(0.0);
    }
}

/// An eye's offset from its goal and that offset's speed a frame later: speeding up evenly and braking evenly.
#[inline(always)]
pub(super) fn saccade(offset: Pair, speed: Pair, dt: f32, rate: f32) -> (Pair, Pair) {
    /// An eye's acceleration, rad/s²: 10° take 58 ms and come to 340°/s, as the main sequence has it (Bahill, Clark and
    /// Stark, *Math. Biosci.* 24, 1975).
    const ACCELERATION: f32 = 11_500.0 * PI / 180.0;
    let gain = ACCELERATION * dt;
    let (far, most) = (square(offset), gain * gain);
    let mean = offset * (-1.0 / dt);
    let stops = square(speed) <= most && 4.0 * square(mean) <= most && 4.0 * square(mean - speed) <= most;
    if stops || !(far > 0.0) {
        return (Vec4::ZERO, Vec4::ZERO);
    }
    let distance = math::sqrt(far);
    let along = offset * (-1.0 / distance);
    // The speed at the end of the frame from which it still stops: v² = 2a·(distance − (speed + v)·dt/2).
    let (half, towards) = (0.5 * gain, along.x * speed.x + along.y * speed.y);
    let wanted = (math::sqrt(half * half + gain * (2.0 * distance / dt - towards)) - half).at_most(rate);
    let change = along * wanted - speed;
    let next = speed + change * (gain / length(change)).at_most(1.0);
    (offset + (speed + next) * (0.5 * dt), next)
}

#[inline(always)]
pub(super) fn pair([heading, pitch]: [f32; 2]) -> Pair {
    Vec4::new(heading, pitch, 0.0, 0.0)
}

#[inline(always)]
pub(super) fn ends(pair: Pair) -> [f32; 2] {
    [pair.x, pair.y]
}

#[inline(always)]
pub(super) fn square(pair: Pair) -> f32 {
    pair.x * pair.x + pair.y * pair.y
}

#[inline(always)]
pub(super) fn length(pair: Pair) -> f32 {
    math::root(square(pair))
}

/// e^(−x) of x ≥ 0, to 1e-6: the 16th power of a series.
#[inline(always)]
fn exp_of_minus(x: f32) -> f32 {
    let x = x.at_most(40.0) * (-1.0 / 16.0);
    let root = 1.0 + x * (1.0 + x * (1.0 / 2.0 + x * (1.0 / 6.0 + x * (1.0 / 24.0 + x * (1.0 / 120.0)))));
    let square = |x: f32| x * x;
    square(square(square(square(root))))
}
