//! Intervals of angles: ranges of motion, what a rate leaves of them in one frame, and joints moved within them.
//! Total: an inverted or undefined range is a point, never a panic.

use core::f32::consts::{PI, TAU};

use crate::{Joint, JointInfo, JointSet, math};

/// How close to an end of its range an angle counts as at it, radians.
const AT_LIMIT_RAD: f32 = 1e-6;

/// An interval of angles, radians, `lo ≤ hi`; both infinite where an angle may turn freely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Range {
    lo: f32,
    hi: f32,
}

impl Range {
    const REST: Self = Self { lo: 0.0, hi: 0.0 };

    /// A declared range as it counts: rest where there is none or it is undefined, its middle where it is inverted,
    /// at most a full turn to either side unless it is free.
    fn declared(range: Option<[f32; 2]>) -> Self {
        match range {
            Some([f32::NEG_INFINITY, f32::INFINITY]) => Self { lo: f32::NEG_INFINITY, hi: f32::INFINITY },
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

    pub(crate) fn is_free(self) -> bool {
        self.lo == f32::NEG_INFINITY && self.hi == f32::INFINITY
    }

    pub(crate) fn lo(self) -> f32 {
        self.lo
    }

    pub(crate) fn hi(self) -> f32 {
        self.hi
    }

    fn contains(self, angle: f32) -> bool {
        self.lo <= angle && angle <= self.hi
    }

    /// The angle of the interval nearest to `angle`.
    pub(crate) fn hold(self, angle: f32) -> f32 {
        angle.max(self.lo).min(self.hi)
    }

    /// Whether `angle` cannot move on in the direction of `change`.
    pub(crate) fn blocks(self, angle: f32, change: f32) -> bool {
        (change > 0.0 && angle >= self.hi) || (change < 0.0 && angle <= self.lo)
    }

    /// What is left of the range for an angle at `from` that changes by `step` at most. Where that is nothing, the
    /// point nearest to the range.
    fn within(self, from: f32, step: f32) -> Self {
        if from - step > self.hi {
            Self { lo: from - step, hi: from - step }
        } else if from + step < self.lo {
            Self { lo: from + step, hi: from + step }
        } else {
            Self { lo: self.lo.max(from - step), hi: self.hi.min(from + step) }
        }
    }
}

/// The intervals of a joint's two angles, and how far each may change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reach {
    pub(crate) heading: Range,
    pub(crate) pitch: Range,
    /// The largest change of either angle, radians; at most half a turn.
    pub(crate) step: f32,
}

impl Reach {
    /// No movement.
    pub(crate) const REST: Self = Self { heading: Range::REST, pitch: Range::REST, step: 0.0 };

    /// The joint's ranges of motion; any change within half a turn.
    pub(crate) fn range(info: &JointInfo) -> Self {
        Self { heading: Range::declared(info.heading), pitch: Range::declared(info.pitch), step: PI }
    }

    /// What the joint can reach within `dt` seconds. Range first, then rate.
    pub(crate) fn frame(info: &JointInfo, joint: &Joint, dt: f32) -> Self {
        // NaN and negative rates stand still.
        let step = (info.rate * dt).max(0.0).min(PI);
        let range = Self::range(info);
        Self { heading: range.heading.within(joint.heading, step), pitch: range.pitch.within(joint.pitch, step), step }
    }

    /// The joint moved to the nearest angles within reach.
    pub(crate) fn hold(&self, joint: &Joint) -> Joint {
        Joint { heading: self.heading.hold(joint.heading), pitch: self.pitch.hold(joint.pitch), ..*joint }
    }

    /// The joint moved from `joint`'s angles towards those of `goal` as far as its reach goes, the shorter way round
    /// where an angle is free.
    pub(crate) fn towards(&self, joint: &Joint, goal: &Joint, info: &JointInfo) -> Joint {
        self.part_way(joint, goal, info, 1.0)
    }

    /// The joint moved by this part of the way from `joint`'s angles to those of `goal`, within its reach.
    pub(crate) fn part_way(&self, joint: &Joint, goal: &Joint, info: &JointInfo, part: f32) -> Joint {
        let [heading, pitch] = way(joint, goal, info);
        self.hold(&Joint { heading: joint.heading + part * heading, pitch: joint.pitch + part * pitch, ..*joint })
    }

    /// The part of the way from `joint`'s angles to those of `goal` that one step covers, 0…1.
    pub(crate) fn part_of_way(&self, joint: &Joint, goal: &Joint, info: &JointInfo) -> f32 {
        let [heading, pitch] = way(joint, goal, info);
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
fn way(joint: &Joint, goal: &Joint, info: &JointInfo) -> [f32; 2] {
    let range = Reach::range(info);
    let shorter = |way: f32, range: Range| {
        if range.is_free() { math::wrap_pi(way) } else { way }
    };
    [shorter(goal.heading - joint.heading, range.heading), shorter(goal.pitch - joint.pitch, range.pitch)]
}

/// A free heading brought back within half a turn; everything else as it is.
pub(crate) fn wrap(info: &JointInfo, joint: &mut Joint) {
    let range = Reach::range(info);
    if range.heading.is_free() {
        joint.heading = math::wrap_pi(joint.heading);
    }
    if range.pitch.is_free() {
        joint.pitch = math::wrap_pi(joint.pitch);
    }
}

/// The joints with an angle at or past an end of its range, and those with one outside its range.
pub(crate) fn limits_met(infos: &[JointInfo], joints: &[Joint]) -> (JointSet, JointSet) {
    let (mut at_limit, mut recovering) = (JointSet::EMPTY, JointSet::EMPTY);
    for (index, (info, joint)) in infos.iter().zip(joints).enumerate() {
        let range = Reach::range(info);
        for (declared, range, angle) in
            [(info.heading, range.heading, joint.heading), (info.pitch, range.pitch, joint.pitch)]
        {
            if declared.is_some() && (angle <= range.lo + AT_LIMIT_RAD || angle >= range.hi - AT_LIMIT_RAD) {
                at_limit.insert(index);
            }
            if !range.contains(angle) {
                recovering.insert(index);
            }
        }
    }
    (at_limit, recovering)
}
