//! How joints get to where they belong: regions [glide](Glide), eyes [leap](saccade).
//!
//! Both go along with what their goal does smoothly and make up for what it does at once by an offset that dies away:
//! angle = goal + offset. So a gaze follows a moving target without lag, and a target that leaps sets off one smooth
//! movement, whatever the frame rate.

use core::f32::consts::PI;

use glam::{Vec4, Vec4Swizzles};

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

/// So many times its acceleration brake a region before an end that comes too fast for it.
const LATE: f32 = 2.0;
/// The part of its acceleration with which a region brakes before an end that comes nearer, which may come faster yet.
const WARY: f32 = 0.5;

impl Glide {
    /// The glide a frame later, while the goal goes on at speed `with` after `before`. From frame to frame, the region's
    /// speed as it is seen, that of goal and offset together, changes by no more than its acceleration allows.
    #[cfg_attr(not(aim_small), inline(always))]
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
    #[cfg_attr(not(aim_small), inline(always))]
    fn at_speed(&self, speed: Pair, bounds: &Bounds) -> Self {
        Self { offset: self.offset + speed * bounds.dt, speed, acceleration: (speed - self.speed) * bounds.per_dt }
    }

    /// The glide where the region would not stop before the ends of its room any more, which move: braked. `sum` is where the
    /// frame began, as `before`, with the goal's speed `begins`; `ends` are those of the joints' ranges and of the budget.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn braked(
        self,
        before: &Self,
        sum: Pair,
        room: &Room,
        ends: impl Fn() -> [Vec4; 2],
        [begins, with]: [Pair; 2],
        bounds: &Bounds,
    ) -> Self {
        let end = self.speed + with;
        let (sums, speeds) = (both_ways(sum), both_ways(end));
        if room.leaves_room(sums, speeds, bounds) {
            return self;
        }
        let most = room.most_speeds(ends(), sums, speeds, bounds);
        // Where that is too late, too, the range ends the movement.
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

    /// Whether nothing is left of it that could be seen.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn is_over(&self, pace: f32) -> bool {
        const STILL_RAD: f32 = 2e-5;
        square(self.offset) <= STILL_RAD * STILL_RAD && square(self.speed) <= STILL_RAD * STILL_RAD * pace * pace
    }
}

/// The ends of a region's room, which its joints' ranges and its budget limit: the greatest sums of headings and pitches, then the
/// least with their signs changed.
pub(super) struct Room {
    at: Vec4,
    /// The speeds at which the animation brings the ranges' and the budget's ends nearer, negative.
    speeds: [Vec4; 2],
}

/// A pair, and the same with its signs changed.
#[cfg_attr(not(aim_small), inline(always))]
fn both_ways(pair: Pair) -> Vec4 {
    pair.xyxy() * Vec4::new(1.0, 1.0, -1.0, -1.0)
}

impl Room {
    /// The sums between `lo` and `hi`.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn ends([lo, hi]: [Pair; 2]) -> Vec4 {
        Vec4::new(hi.x, hi.y, -lo.x, -lo.y).max(Vec4::ZERO)
    }

    /// The room whose ends the animation has shifted by these pairs, where it had shifted them by `before` in the last frame.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn new(at: Vec4, shifts: [Pair; 2], before: Option<[[f32; 2]; 2]>, bounds: &Bounds) -> Self {
        let Some(before) = before else { return Self { at, speeds: [Vec4::ZERO; 2] } };
        let speeds = [0, 1].map(|limit| {
            let speed = both_ways(shifts[limit] - pair(before[limit])) * bounds.per_dt;
            // An end that leaps has no speed, and one that goes away may stop at any time.
            Vec4::select(speed.cmpge(Vec4::splat(-bounds.rate)), speed.min(Vec4::ZERO), Vec4::ZERO)
        });
        Self { at, speeds }
    }

    /// The distances at which something with these speeds has to begin to stop before ends that come nearer.
    #[cfg_attr(not(aim_small), inline(always))]
    fn stops(speeds: Vec4, coming: Vec4, acceleration: Vec4, dt: f32) -> Vec4 {
        let closing = (speeds - coming).max(Vec4::ZERO);
        closing * (closing * 0.5 / acceleration + Vec4::splat(dt))
    }

    /// True if what has these speeds is surely farther away from all ends than it takes to stop.
    #[cfg_attr(not(aim_small), inline(always))]
    fn leaves_room(&self, sums: Vec4, speeds: Vec4, bounds: &Bounds) -> bool {
        let coming = self.speeds[0].min(self.speeds[1]);
        let stops = Self::stops(speeds, coming, Vec4::splat(WARY * bounds.acceleration), bounds.dt);
        (self.at - sums).cmpgt(stops).bitmask() == 15
    }

    /// The largest speeds from which it is possible to stop before the ends.
    #[cold]
    #[inline(never)]
    fn most_speeds(&self, ends: [Vec4; 2], sums: Vec4, speeds: Vec4, bounds: &Bounds) -> Vec4 {
        let mut most = [f32::INFINITY; 4];
        for (end, coming) in ends.iter().zip(&self.speeds) {
            // As the end was when the frame began; where the animation is at it, it stays.
            let coming = Vec4::select(end.cmpgt(Vec4::ZERO), *coming, Vec4::ZERO);
            let left = *end - coming * bounds.dt - sums;
            let wary = Vec4::select(coming.cmplt(Vec4::ZERO), Vec4::splat(WARY), Vec4::ONE);
            let acceleration = wary * bounds.acceleration;
            let is_near = left.cmple(Self::stops(speeds, coming, acceleration, bounds.dt));
            for lane in (0..4).filter(|lane| is_near.test(*lane)) {
                let mut speed = braking(left[lane], acceleration[lane] * bounds.dt, bounds.dt) + coming[lane];
                if speed < 0.0 {
                    // No end comes nearer than the animation, at which the region has to stop in its turn.
                    speed = speed.at_least(-braking(sums[lane], bounds.acceleration * bounds.dt, bounds.dt));
                }
                most[lane] = most[lane].at_most(speed);
            }
        }
        Vec4::from_array(most)
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
/// A change of the goal's speed is gone along with as far as this `part` of the acceleration goes; one that lasts, from the
/// second frame on, as far as the rate goes, with the region's own speed going on evenly; a leap is all offset, and so is a hop from
/// which the goal has come back. A change that the acceleration makes up for comes over two frames where it is a jerk, as at a key:
/// jerks to and fro would throw the head from end to end of its acceleration. A region that is shaken goes along with the goal's
/// mean speed.
#[cfg_attr(not(aim_small), inline(always))]
pub(super) fn follow(
    led: &mut Led,
    [sum, goal]: [Pair; 2],
    glide: &mut Glide,
    part: f32,
    bounds: &Bounds,
) -> [Pair; 2] {
    /// The part of the acceleration that makes up for a jerk at once; what is less than this part before it is no gain of speed.
    const AT_ONCE: f32 = 0.5;
    const GAINS: f32 = 0.25;
    let &Bounds { dt, per_dt, rate, acceleration, .. } = bounds;
    let most = Vec4::splat(acceleration * dt);
    let [led_goal, led_speed, led_change] = [led.goal, led.speed, led.change].map(pair);
    let change = (goal - led_goal) * per_dt;
    let is_near = |other: Pair| is_near_to(change, other, most);
    let lasts = is_near(led_change);
    // The goal hops where its speeds of two frames lie on either side of what is gone along with.
    let gain = change - led_speed;
    let hops = (gain * (led_change - led_speed)).cmplt(Vec4::ZERO);
    let gain = match (lasts, led.gains) {
        (true, true) => gain,
        (true, false) => gain.max(most * -AT_ONCE).min(most * AT_ONCE),
        (false, _) => Vec4::select(hops, Vec4::ZERO, gain.max(most * -part).min(most * part)),
    };
    led.gains = !is_near_to(change, led_speed, most * GAINS);
    let mut speed = led_speed;
    if square(change) <= rate * rate {
        speed += gain;
    } else if lasts {
        speed = change * (rate / length(change));
    }
    let mut is_smooth = is_near_to(speed, led_speed, most);
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

/// True if both angles are within `most` of others.
#[cfg_attr(not(aim_small), inline(always))]
fn is_near_to(pair: Pair, other: Pair, most: Pair) -> bool {
    (pair - other).abs().cmple(most * 1.0001).bitmask() & 3 == 3
}

impl Led {
    /// Notes a goal that moves because weight or attention change. A fade ends at once, and whoever goes along
    /// with it overshoots: all of it is offset, which dies away on one side.
    #[cold]
    #[inline(never)]
    pub(super) fn fade(&mut self, [sum, goal]: [Pair; 2], glide: &mut Glide, dt: f32) {
        glide.speed += pair(self.speed);
        glide.offset = sum - goal;
        self.tire(Vec4::ZERO, Vec4::ZERO, dt);
        (self.goal, self.speed, self.change) = (ends(goal), [0.0; 2], [0.0; 2]);
    }

    /// The part of its pace with which the head follows: less where its goal leaps to and fro.
    pub(super) fn haste(&self) -> f32 {
        const LEAST: f32 = 0.4;
        (1.0 - self.tired).at_least(LEAST).at_most(1.0)
    }

    /// A goal that goes on leaving the speed that is gone along with, by v, faster than the acceleration a makes up for shakes the
    /// head: going along overshoots by v²/2a. So does one that turns back at once. The more it is shaken, the more it goes along with
    /// the mean of its goal's speed alone.
    ///
    /// Returns what it goes along with instead of `speed`, and whether that is within the acceleration; `lasts` tells whether the
    /// goal's last change was.
    #[cold]
    #[inline(never)]
    fn shake(&mut self, speed: Pair, change: Pair, lasts: bool, bounds: &Bounds) -> (Pair, bool) {
        /// The time over which the mean is taken, and that in which shaking comes to count in full, seconds.
        const MEAN_S: f32 = 0.25;
        const SHAKEN_S: f32 = 0.1;
        /// From how far going along overshoots it counts as shaking, and from where in full.
        const OVERSHOOTS_RAD: [f32; 2] = [0.03 * PI / 180.0, 0.2 * PI / 180.0];
        /// From how far on one turn back counts most, whatever the frame rate, and what that is.
        const TURN_BACK_RAD: f32 = 14.0 * PI / 180.0;
        const TURN_BACK: f32 = 1.1;
        let &Bounds { dt, rate, acceleration, .. } = bounds;
        let most = Vec4::splat(acceleration * dt);
        let before = pair(self.speed);
        if !lasts {
            let off = square(change - before);
            // What is faster than the head is a leap.
            let turns_back = change.x * before.x + change.y * before.y < 0.0 && square(change) <= rate * rate;
            self.tired += if turns_back {
                TURN_BACK * (off / (2.0 * acceleration * TURN_BACK_RAD)).at_most(1.0)
            } else {
                let overshoots = off.at_most(square(pair(self.change) - before)) / (2.0 * acceleration);
                let counts = (overshoots - OVERSHOOTS_RAD[0]) / (OVERSHOOTS_RAD[1] - OVERSHOOTS_RAD[0]);
                counts.at_least(0.0).at_most(1.0) * (dt / SHAKEN_S)
            };
        }
        if !(self.tired > 0.0) {
            return (speed, is_near_to(speed, before, most));
        }
        // A leap is no motion: little of its speed counts. What swings faster one way than the other does, or it would drift.
        let counted = change * (3.0 * rate / length(change)).at_most(1.0);
        let mean = before + (counted - before) * (dt / (dt + MEAN_S));
        let speed = speed + (mean - speed) * self.tired.at_most(1.0);
        // Sudden changes one way alone would push the head that way.
        (before + (speed - before).max(-most).min(most), true)
    }

    /// A goal that leaps back before the head has come makes it slow for a while: it stays near the middle.
    ///
    /// `leap` is what the goal did at once, and `ahead` how far off it was before.
    #[cfg_attr(not(aim_small), inline(always))]
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
#[cfg_attr(not(aim_small), inline(always))]
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

#[cfg_attr(not(aim_small), inline(always))]
pub(super) fn pair([heading, pitch]: [f32; 2]) -> Pair {
    Vec4::new(heading, pitch, 0.0, 0.0)
}

#[cfg_attr(not(aim_small), inline(always))]
pub(super) fn ends(pair: Pair) -> [f32; 2] {
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

/// e^(−x) of x ≥ 0, to 1e-6: the 16th power of a series.
#[cfg_attr(not(aim_small), inline(always))]
fn exp_of_minus(x: f32) -> f32 {
    let x = x.at_most(40.0) * (-1.0 / 16.0);
    let root = 1.0 + x * (1.0 + x * (1.0 / 2.0 + x * (1.0 / 6.0 + x * (1.0 / 24.0 + x * (1.0 / 120.0)))));
    let square = |x: f32| x * x;
    square(square(square(square(root))))
}
