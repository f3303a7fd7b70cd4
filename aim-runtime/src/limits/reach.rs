//! [`Reach`]: the part of a joint's range of motion that its rate allows in one frame, and moving a joint within it.

use core::f32::consts::PI;

use aim_model::Taper;

use crate::limits::{Interval, RangeOfMotion};
use crate::math::Bounded;
use crate::{Joint, math};

/// Distance from an end of its range within which an angle counts as at the end, radians.
pub(crate) const AT_LIMIT_RAD: f32 = 1e-6;

/// The intervals of a joint's two angles, and the largest change of either.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reach {
    pub(crate) heading: Interval,
    /// The interval of the pitch without taper. See [`pitch_at`](Self::pitch_at).
    pub(crate) pitch: Interval,
    /// The largest change of either angle, radians; at most π.
    pub(crate) step: f32,
    /// The narrowing of the pitch range with the heading; `None` if it does not depend on the heading.
    taper: Option<Taper<f32>>,
    /// The interval that the rate allows the pitch.
    pitch_box: Interval,
}

impl Reach {
    /// No movement: both angles are fixed at 0.
    pub(crate) const REST: Self =
        Self { heading: Interval::REST, pitch: Interval::REST, step: 0.0, taper: None, pitch_box: Interval::REST };

    /// Returns the joint's whole range of motion, with any change up to π.
    pub(crate) fn range(motion: &RangeOfMotion) -> Self {
        let RangeOfMotion { heading, pitch, taper } = *motion;
        Self { heading, pitch, step: PI, taper, pitch_box: Interval::everything() }
    }

    /// Returns the reach of a joint that must not move.
    pub(crate) fn at(joint: &Joint) -> Self {
        let [heading, pitch] = [joint.heading, joint.pitch].map(Interval::point);
        Self { heading, pitch, ..Self::REST }
    }

    /// Returns the angles that the joint can reach at `rate` within `dt` seconds. The range takes precedence over the
    /// rate.
    pub(crate) fn frame(motion: &RangeOfMotion, rate: f32, joint: &Joint, dt: f32) -> Self {
        // A NaN or negative rate does not move.
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

    /// Returns the interval of the pitch at this heading.
    pub(crate) fn pitch_at(&self, heading: f32) -> Interval {
        match &self.taper {
            Some(taper) => taper.pitch_at(heading).within(self.pitch_box),
            None => self.pitch,
        }
    }

    /// Returns the derivative by the heading of the pitch limit at which the joint is; 0 if its pitch is at neither
    /// limit.
    pub(crate) fn pitch_limit_slope(&self, joint: &Joint) -> f32 {
        /// Step towards heading 0, where the pitch range is widest, for the difference quotient, radians.
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

    /// Clamps the joint's angles to its reach, heading first. The general paths of the exact solver and the ascent
    /// clamp their result here, so that ranges (narrowed ones too) and rates hold.
    pub(crate) fn hold(&self, joint: &Joint) -> Joint {
        let heading = self.heading.hold(joint.heading);
        Joint { heading, pitch: self.pitch_at(heading).hold(joint.pitch), ..*joint }
    }

    /// Moves the joint from `joint`'s angles towards those of `goal` as far as its reach allows. A free angle turns the
    /// shorter way round.
    pub(crate) fn towards(&self, joint: &Joint, goal: &Joint, motion: &RangeOfMotion) -> Joint {
        self.part_way(joint, goal, motion, 1.0)
    }

    /// Moves the joint by `part` of the way from `joint`'s angles to those of `goal`, within its reach.
    pub(crate) fn part_way(&self, joint: &Joint, goal: &Joint, motion: &RangeOfMotion, part: f32) -> Joint {
        let [heading, pitch] = angle_changes(joint, goal, motion);
        self.hold(&Joint { heading: joint.heading + part * heading, pitch: joint.pitch + part * pitch, ..*joint })
    }

    /// Returns the part of the way from `joint`'s angles to those of `goal` that one step covers, 0…1.
    pub(crate) fn part_of_way(&self, joint: &Joint, goal: &Joint, motion: &RangeOfMotion) -> f32 {
        let [heading, pitch] = angle_changes(joint, goal, motion);
        let longest = heading.abs().at_least(pitch.abs());
        if longest > self.step { self.step / longest } else { 1.0 }
    }

    /// Moves the joint from its present angles by at most one step towards rest, and exactly to rest within the last
    /// step.
    pub(crate) fn towards_rest(&self, joint: &Joint) -> Joint {
        let towards = |angle: f32| angle - angle.at_least(-self.step).at_most(self.step);
        self.hold(&Joint { heading: towards(joint.heading), pitch: towards(joint.pitch), ..*joint })
    }
}

/// Returns the changes of heading and pitch that lead from `joint` to `goal`. A free angle takes the shorter way round.
pub(crate) fn angle_changes(joint: &Joint, goal: &Joint, motion: &RangeOfMotion) -> [f32; 2] {
    let shorter = |change: f32, range: Interval| {
        if range.is_free() { math::wrap_pi(change) } else { change }
    };
    [shorter(goal.heading - joint.heading, motion.heading), shorter(goal.pitch - joint.pitch, motion.pitch)]
}
