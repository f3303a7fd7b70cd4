//! [`Range`]: a joint's range of motion, both angles in one vector.

use glam::{Vec4, Vec4Swizzles};

use super::glide::Pair;
use crate::limits::{Interval, RangeOfMotion};
use crate::math;

/// A joint's range of motion: the lanes are heading, pitch, and the interval that a rate allows the pitch regardless of
/// its range. Ranges that do not fit this form refer to the full [`RangeOfMotion`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Range<'a> {
    pub(super) lo: Pair,
    pub(super) hi: Pair,
    /// The full range, if the pitch range depends on the heading or if the heading is free.
    full: Option<&'a RangeOfMotion>,
}

impl<'a> Range<'a> {
    pub(super) const REST: Self = Self { lo: Vec4::ZERO, hi: Vec4::ZERO, full: None };

    /// Creates the range of a joint; `is_fixed` if no joint's range depends on anything.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn new(motion: &'a RangeOfMotion, is_fixed: bool) -> Self {
        let ([right, left], [down, up]) = (motion.heading.ends(), motion.pitch.ends());
        Self {
            lo: Vec4::new(right, down, f32::NEG_INFINITY, 0.0),
            hi: Vec4::new(left, up, f32::INFINITY, 0.0),
            full: (!is_fixed && (motion.taper.is_some() || motion.heading.is_free())).then_some(motion),
        }
    }

    /// Returns the lower and the upper ends.
    pub(super) fn ends(&self) -> [Pair; 2] {
        [self.lo, self.hi]
    }

    /// Returns the sums of the lower and of the upper ends of one or more joints' ranges.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn sums(several: &[Self]) -> [Pair; 2] {
        several[1..].iter().fold([several[0].lo, several[0].hi], |[lo, hi], own| [lo + own.lo, hi + own.hi])
    }

    /// Returns the shift of the middle of one or more joints' ranges by the pose; 0 if they are infinite.
    pub(super) fn shift(several: &[Self]) -> Pair {
        let [lo, hi] = Self::sums(several);
        let middle = (lo + hi) * 0.5;
        Vec4::select(middle.abs().cmplt(Vec4::INFINITY), middle, Vec4::ZERO)
    }

    /// Returns the part of the range within `step` of either angle; if there is none, the reachable angle nearest to
    /// it.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn within(&self, angles: Pair, step: f32) -> Self {
        let (angles, step) = (angles.xyyy(), Vec4::splat(step));
        let (least, most) = (angles - step, angles + step);
        Self { lo: self.lo.max(least).min(most), hi: self.hi.min(most).max(least), full: self.full }
    }

    /// Clamps the angles to the range, heading first.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn hold(&self, angles: Pair) -> Pair {
        let held = angles.max(self.lo).min(self.hi);
        match self.full {
            None => held,
            Some(motion) => self.hold_narrowed(motion, held.x, angles.y),
        }
    }

    #[cold]
    #[inline(never)]
    fn hold_narrowed(&self, motion: &RangeOfMotion, heading: f32, pitch: f32) -> Pair {
        let range = match motion.taper {
            Some(_) => motion.pitch_at(heading).within(Interval::from_ends(self.lo.z, self.hi.z)),
            None => Interval::from_ends(self.lo.y, self.hi.y),
        };
        Vec4::new(heading, range.hold(pitch), 0.0, 0.0)
    }

    /// Clamps the angles of a joint that is now at `from`: a free heading turns the shorter way round.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn hold_from(&self, from: Pair, angles: Pair) -> Pair {
        match self.full {
            None => angles.max(self.lo).min(self.hi),
            Some(motion) => self.hold_shorter(motion, from, angles),
        }
    }

    #[cold]
    #[inline(never)]
    fn hold_shorter(&self, motion: &RangeOfMotion, from: Pair, angles: Pair) -> Pair {
        let heading = if motion.heading.is_free() {
            from.x + math::wrap_pi(angles.x - from.x)
        } else {
            motion.heading.hold(angles.x)
        };
        Vec4::new(heading, motion.pitch_at(heading).hold(angles.y), 0.0, 0.0)
    }

    /// Returns the distances of the angles from the nearer end of the range, negative outside; −∞ for every range that
    /// refers to the full [`RangeOfMotion`].
    #[cfg_attr(not(aim_small), inline(always))]
    pub(super) fn margins(&self, angles: Pair) -> Pair {
        if self.full.is_some() { Vec4::NEG_INFINITY } else { (angles - self.lo).min(self.hi - angles) }
    }

    /// Returns the angles within `step` of these that are nearest to rest.
    pub(super) fn towards_rest(&self, angles: Pair, step: f32) -> Pair {
        let step = Vec4::splat(step);
        self.hold(angles - angles.max(-step).min(step))
    }
}
