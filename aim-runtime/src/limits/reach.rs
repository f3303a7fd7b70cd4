//! [`Reach`]: what a rate leaves of the ranges of motion in one frame, and joints moved within it.

use core::f32::consts::PI;

use aim_model::Taper;

use crate::limits::{Interval, RangeOfMotion};
use crate::math::Bounded;
use crate::{Joint, math};

/// How close to an end of its range an angle counts as at it, radians.
pub(crate) const AT_LIMIT_RAD: f32 = 1e-6;

/// The intervals of a joint's two angles, and how far each may change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reach {
    pub(crate) heading: Interval,
    /// The pitch's interval where the heading takes nothing of it. See [`pitch_at`](Self::pitch_at).
    pub(crate) pitch: Interval,
    /// The largest change of either angle, radians; at most half a turn.
    pub(crate) step: f32,
    /// How the pitch's range narrows with the heading, and where the rate lets the pitch be.
    taper: Option<Taper<f32>>,
    pitch_box: Interval,
}

impl Reach {
    /// No movement.
    pub(crate) const REST: Self =
        Self { heading: Interval::REST, pitch: Interval::REST, step: 0.0, taper: None, pitch_box: Interval::REST };

    /// All of the joint's ranges of motion; any change within half a turn.
    pub(crate) fn range(motion: &RangeOfMotion) -> Self {
        let RangeOfMotion { heading, pitch, taper } = *motion;
        Self { heading, pitch, step: PI, taper, pitch_box: Interval::everything() }
    }

    /// No movement from where the joint is.
    pub(crate) fn at(joint: &Joint) -> Self {
        let [heading, pitch] = [joint.heading, joint.pitch].map(Interval::point);
        Self { heading, pitch, ..Self::REST }
    }

    /// What the joint can reach at `rate` within `dt` seconds. Range first, then rate.
    pub(crate) fn frame(motion: &RangeOfMotion, rate: f32, joint: &Joint, dt: f32) -> Self {
        // NaN and negative rates stand still.
        let step = (rate * dt).at_least(0.0).at_most(PI);
        let pitch_box = Interval::around(joint.pitch, step);
        Self {
            heading: motion.heading.within(Interval::around(joint.heading, step)),
            pitch: motion.pitch.within(pitch_box),
            step,
            taper: motion.taper,
            pitch_box,
        }
    }

    /// The pitch's interval once the heading is this.
    pub(crate) fn pitch_at(&self, heading: f32) -> Interval {
        match &self.taper {
            Some(taper) => taper.pitch_at(heading).within(self.pitch_box),
            None => self.pitch,
        }
    }

    /// How much the end that the joint's pitch is at moves with its heading; 0 for a pitch at none.
    pub(crate) fn ride(&self, joint: &Joint) -> f32 {
        /// Nearer to the middle of its range, where the pitch has all of its own, radians.
        const INWARD_RAD: f32 = 0.01;
        if self.taper.is_none() {
            return 0.0;
        }
        let inward = -INWARD_RAD.at_most(joint.heading.abs()) * joint.heading.signum();
        let (here, there) = (self.pitch_at(joint.heading), self.pitch_at(joint.heading + inward));
        let moved = if joint.pitch >= here.hi() {
            there.hi() - here.hi()
        } else if joint.pitch <= here.lo() {
            there.lo() - here.lo()
        } else {
            0.0
        };
        if moved == 0.0 { 0.0 } else { moved / inward }
    }

    /// The joint moved to the nearest angles within reach, heading first. What is general of the exact solver and the ascent end
    /// here: it is what makes ranges, narrowed ones too, and rates hold.
    pub(crate) fn hold(&self, joint: &Joint) -> Joint {
        let heading = self.heading.hold(joint.heading);
        Joint { heading, pitch: self.pitch_at(heading).hold(joint.pitch), ..*joint }
    }

    /// The joint moved from `joint`'s angles towards those of `goal` as far as its reach goes, the shorter way round
    /// where an angle is free.
    pub(crate) fn towards(&self, joint: &Joint, goal: &Joint, motion: &RangeOfMotion) -> Joint {
        self.part_way(joint, goal, motion, 1.0)
    }

    /// The joint moved by this part of the way from `joint`'s angles to those of `goal`, within its reach.
    pub(crate) fn part_way(&self, joint: &Joint, goal: &Joint, motion: &RangeOfMotion, part: f32) -> Joint {
        let [heading, pitch] = way(joint, goal, motion);
        self.hold(&Joint { heading: joint.heading + part * heading, pitch: joint.pitch + part * pitch, ..*joint })
    }

    /// The part of the way from `joint`'s angles to those of `goal` that one step covers, 0…1.
    pub(crate) fn part_of_way(&self, joint: &Joint, goal: &Joint, motion: &RangeOfMotion) -> f32 {
        let [heading, pitch] = way(joint, goal, motion);
        let longest = heading.abs().at_least(pitch.abs());
        if longest > self.step { self.step / longest } else { 1.0 }
    }

    /// The joint moved from its present angles by its largest step towards rest. Exactly at rest once it is near.
    pub(crate) fn towards_rest(&self, joint: &Joint) -> Joint {
        let towards = |angle: f32| angle - angle.at_least(-self.step).at_most(self.step);
        self.hold(&Joint { heading: towards(joint.heading), pitch: towards(joint.pitch), ..*joint })
    }
}

/// The changes of heading and pitch that lead from `joint` to `goal`, the shorter way round where an angle is free.
pub(crate) fn way(joint: &Joint, goal: &Joint, motion: &RangeOfMotion) -> [f32; 2] {
    let shorter = |way: f32, range: Interval| {
        if range.is_free() { math::wrap_pi(way) } else { way }
    };
    [shorter(goal.heading - joint.heading, motion.heading), shorter(goal.pitch - joint.pitch, motion.pitch)]
}
