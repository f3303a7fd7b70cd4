//! Intervals of angles: ranges of motion, what a rate leaves of them in one frame, and joints moved within them.
//! Total: an inverted or undefined range is a point, never a panic.

use core::f32::consts::{PI, TAU};

use crate::limits::motion::{Motion, Narrowing};
use crate::{Joint, math};

/// How close to an end of its range an angle counts as at it, radians.
pub(crate) const AT_LIMIT_RAD: f32 = 1e-6;

/// An interval of angles, radians, `lo ≤ hi`; both infinite where an angle may turn freely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Range {
    lo: f32,
    hi: f32,
}

impl Range {
    pub(crate) const REST: Self = Self { lo: 0.0, hi: 0.0 };
    const EVERYTHING: Self = Self { lo: f32::NEG_INFINITY, hi: f32::INFINITY };

    /// A declared range as it counts: rest where there is none or it is undefined, its middle where it is inverted,
    /// at most a full turn to either side unless it is free.
    pub(crate) fn declared(range: Option<[f32; 2]>) -> Self {
        match range {
            Some([f32::NEG_INFINITY, f32::INFINITY]) => Self::EVERYTHING,
            Some([lo, hi]) if !(lo.is_nan() || hi.is_nan()) => {
                let (lo, hi) = (lo.clamp(-TAU, TAU), hi.clamp(-TAU, TAU));
                if lo <= hi {
                    Self { lo, hi }
                } else {
                    let middle = 0.5 * (lo + hi);
                    Self { lo: middle, hi: middle }
                }
            }
            _ => Self::REST,
        }
    }

    /// Whether the angle is in the interval.
    pub(crate) fn contains(self, angle: f32) -> bool {
        self.lo <= angle && angle <= self.hi
    }

    /// Whether it is a single angle.
    pub(crate) fn is_point(self) -> bool {
        self.lo >= self.hi
    }

    pub(crate) fn is_free(self) -> bool {
        self.lo == f32::NEG_INFINITY && self.hi == f32::INFINITY
    }

    pub(crate) fn lo(self) -> f32 {
        self.lo
    }

    pub(crate) fn hi(self) -> f32 {
        self.hi
    }

    /// The angle of the interval nearest to `angle`.
    pub(crate) fn hold(self, angle: f32) -> f32 {
        angle.max(self.lo).min(self.hi)
    }

    /// Whether `angle` cannot move on in the direction of `change`.
    pub(crate) fn blocks(self, angle: f32, change: f32) -> bool {
        (change > 0.0 && angle >= self.hi) || (change < 0.0 && angle <= self.lo)
    }

    /// The interval that a change by `step` at most leads to.
    fn around(from: f32, step: f32) -> Self {
        Self { lo: from - step, hi: from + step }
    }

    /// What is left of the range within `box_`. Where that is nothing, the point of `box_` nearest to the range.
    fn within(self, box_: Self) -> Self {
        if box_.lo > self.hi {
            Self { lo: box_.lo, hi: box_.lo }
        } else if box_.hi < self.lo {
            Self { lo: box_.hi, hi: box_.hi }
        } else {
            Self { lo: self.lo.max(box_.lo), hi: self.hi.min(box_.hi) }
        }
    }

    /// The range from `lo` to `hi`; where it is inverted the middle, rest where that is undefined.
    fn between(lo: f32, hi: f32) -> Self {
        if lo <= hi {
            Self { lo, hi }
        } else {
            let middle = 0.5 * (lo + hi);
            if middle.is_finite() { Self { lo: middle, hi: middle } } else { Self::REST }
        }
    }

    /// The range with both ends moved by `by`.
    pub(crate) fn moved(self, by: f32) -> Self {
        Self { lo: self.lo + by, hi: self.hi + by }
    }

    /// What both ranges have in common; the middle between them where that is nothing.
    pub(crate) fn common(self, other: Self) -> Self {
        Self::between(self.lo.max(other.lo), self.hi.min(other.hi))
    }

    /// The range without what is above the other's.
    pub(crate) fn no_further_up_than(self, other: Self) -> Self {
        Self::between(self.lo, self.hi.min(other.hi))
    }

    /// The range without what is below the other's.
    pub(crate) fn no_further_down_than(self, other: Self) -> Self {
        Self::between(self.lo.max(other.lo), self.hi)
    }

    /// This part of the range, 0…1; finite ranges only.
    pub(crate) fn scaled(self, part: f32) -> Self {
        Self { lo: part * self.lo, hi: part * self.hi }
    }

    /// The range of what may be added to an angle that the animation has at `animated` already: 0 is always in it, so
    /// that an animation outside the range is let be and never pushed further out.
    pub(crate) fn counted_from(self, animated: f32) -> Self {
        Self { lo: (self.lo - animated).min(0.0), hi: (self.hi - animated).max(0.0) }
    }
}

/// The intervals of a joint's two angles, and how far each may change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reach {
    pub(crate) heading: Range,
    /// The pitch's interval where the heading takes nothing of it. See [`pitch_at`](Self::pitch_at).
    pub(crate) pitch: Range,
    /// The largest change of either angle, radians; at most half a turn.
    pub(crate) step: f32,
    /// How the pitch's range narrows with the heading, and where the rate lets the pitch be.
    narrowing: Option<Narrowing>,
    pitch_box: Range,
}

impl Reach {
    /// No movement.
    pub(crate) const REST: Self =
        Self { heading: Range::REST, pitch: Range::REST, step: 0.0, narrowing: None, pitch_box: Range::REST };

    /// All of the joint's ranges of motion; any change within half a turn.
    pub(crate) fn range(motion: &Motion) -> Self {
        let Motion { heading, pitch, narrowing } = *motion;
        Self { heading, pitch, step: PI, narrowing, pitch_box: Range::EVERYTHING }
    }

    /// No movement from where the joint is.
    pub(crate) fn at(joint: &Joint) -> Self {
        let [heading, pitch] = [joint.heading, joint.pitch].map(|angle| Range { lo: angle, hi: angle });
        Self { heading, pitch, ..Self::REST }
    }

    /// What the joint can reach at `rate` within `dt` seconds. Range first, then rate.
    pub(crate) fn frame(motion: &Motion, rate: f32, joint: &Joint, dt: f32) -> Self {
        // NaN and negative rates stand still.
        let step = (rate * dt).max(0.0).min(PI);
        let pitch_box = Range::around(joint.pitch, step);
        Self {
            heading: motion.heading.within(Range::around(joint.heading, step)),
            pitch: motion.pitch.within(pitch_box),
            step,
            narrowing: motion.narrowing,
            pitch_box,
        }
    }

    /// The pitch's interval once the heading is this.
    pub(crate) fn pitch_at(&self, heading: f32) -> Range {
        match &self.narrowing {
            Some(narrowing) => narrowing.pitch_at(heading).within(self.pitch_box),
            None => self.pitch,
        }
    }

    /// How much the end that the joint's pitch is at moves with its heading; 0 for a pitch at none.
    pub(crate) fn ride(&self, joint: &Joint) -> f32 {
        /// Nearer to the middle of its range, where the pitch has all of its own, radians.
        const INWARD_RAD: f32 = 0.01;
        if self.narrowing.is_none() {
            return 0.0;
        }
        let inward = -INWARD_RAD.min(joint.heading.abs()) * joint.heading.signum();
        let (here, there) = (self.pitch_at(joint.heading), self.pitch_at(joint.heading + inward));
        let moved = if joint.pitch >= here.hi {
            there.hi - here.hi
        } else if joint.pitch <= here.lo {
            there.lo - here.lo
        } else {
            0.0
        };
        if moved == 0.0 { 0.0 } else { moved / inward }
    }

    /// The joint moved to the nearest angles within reach, heading first. All solvers end here: it is what makes
    /// ranges, narrowed ones too, and rates hold.
    pub(crate) fn hold(&self, joint: &Joint) -> Joint {
        let heading = self.heading.hold(joint.heading);
        Joint { heading, pitch: self.pitch_at(heading).hold(joint.pitch), ..*joint }
    }

    /// The joint moved from `joint`'s angles towards those of `goal` as far as its reach goes, the shorter way round
    /// where an angle is free.
    pub(crate) fn towards(&self, joint: &Joint, goal: &Joint, motion: &Motion) -> Joint {
        self.part_way(joint, goal, motion, 1.0)
    }

    /// The joint moved by this part of the way from `joint`'s angles to those of `goal`, within its reach.
    pub(crate) fn part_way(&self, joint: &Joint, goal: &Joint, motion: &Motion, part: f32) -> Joint {
        let [heading, pitch] = way(joint, goal, motion);
        self.hold(&Joint { heading: joint.heading + part * heading, pitch: joint.pitch + part * pitch, ..*joint })
    }

    /// The part of the way from `joint`'s angles to those of `goal` that one step covers, 0…1.
    pub(crate) fn part_of_way(&self, joint: &Joint, goal: &Joint, motion: &Motion) -> f32 {
        let [heading, pitch] = way(joint, goal, motion);
        let longest = heading.abs().max(pitch.abs());
        if longest > self.step { self.step / longest } else { 1.0 }
    }

    /// The joint moved from its present angles by its largest step towards rest. Exactly at rest once it is near.
    pub(crate) fn towards_rest(&self, joint: &Joint) -> Joint {
        let towards = |angle: f32| angle - angle.max(-self.step).min(self.step);
        self.hold(&Joint { heading: towards(joint.heading), pitch: towards(joint.pitch), ..*joint })
    }
}

/// The changes of heading and pitch that lead from `joint` to `goal`, the shorter way round where an angle is free.
pub(crate) fn way(joint: &Joint, goal: &Joint, motion: &Motion) -> [f32; 2] {
    let shorter = |way: f32, range: Range| {
        if range.is_free() { math::wrap_pi(way) } else { way }
    };
    [shorter(goal.heading - joint.heading, motion.heading), shorter(goal.pitch - joint.pitch, motion.pitch)]
}
