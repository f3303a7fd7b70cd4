//! [`RangeOfMotion`]: the intervals of a joint's added angles. Evaluated in one place for the solvers (`f32`) and for
//! the code that parses declarations and writes reports (`f64`).

use crate::Float;

/// The pose from which a joint's ranges are measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum LimitsFrom {
    /// The animated pose of the frame: the ranges limit the angles added to the animation.
    #[default]
    Animation,
    /// The bind pose: the ranges limit the sum of the animation's own turn and the added one. If the animation itself
    /// exceeds a range, the joint is not corrected back, but is never moved further out. Needs a pose with a bind pose;
    /// without one the ranges are measured from the animation.
    BindPose,
}

/// A joint's heading and pitch, radians unless stated otherwise.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Angles<T> {
    /// Heading; positive turns forward towards left.
    pub heading: T,
    /// Pitch; positive turns forward towards up.
    pub pitch: T,
}

/// An interval of angles, `lo ≤ hi`; both ends infinite if the angle may turn freely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval<T> {
    lo: T,
    hi: T,
}

impl<T: Float> Interval<T> {
    /// The single angle 0.
    pub const REST: Self = Self { lo: T::ZERO, hi: T::ZERO };

    /// Returns the interval of all angles.
    #[inline]
    #[must_use]
    pub fn everything() -> Self {
        Self { lo: -T::INFINITY, hi: T::INFINITY }
    }

    /// Converts a declared range. Returns [`REST`](Self::REST) if none is declared or an end is NaN, and the midpoint
    /// if the ends are inverted. The ends are clamped to a full turn to either side unless both are infinite.
    #[inline]
    #[must_use]
    pub fn declared(ends: Option<[T; 2]>) -> Self {
        match ends {
            Some([lo, hi]) if lo == -T::INFINITY && hi == T::INFINITY => Self { lo, hi },
            Some([lo, hi]) if lo <= hi || lo > hi => {
                let within_a_turn = |angle: T| angle.max(-T::TAU).min(T::TAU);
                Self::between(within_a_turn(lo), within_a_turn(hi))
            }
            _ => Self::REST,
        }
    }

    /// Returns the lower end.
    #[inline]
    #[must_use]
    pub const fn lo(self) -> T {
        self.lo
    }

    /// Returns the upper end.
    #[inline]
    #[must_use]
    pub const fn hi(self) -> T {
        self.hi
    }

    /// Returns both ends, the lower first.
    #[inline]
    #[must_use]
    pub const fn ends(self) -> [T; 2] {
        [self.lo, self.hi]
    }

    /// Returns `true` if the angle may turn freely: both ends are infinite.
    #[inline]
    #[must_use]
    pub fn is_free(self) -> bool {
        self.lo == -T::INFINITY && self.hi == T::INFINITY
    }

    /// Returns the interval that contains only `angle`.
    #[inline]
    #[must_use]
    pub const fn point(angle: T) -> Self {
        Self { lo: angle, hi: angle }
    }

    /// Returns the angles that a change of at most `step` reaches from `from`.
    #[inline]
    #[must_use]
    pub fn around(from: T, step: T) -> Self {
        Self { lo: from - step, hi: from + step }
    }

    /// Returns the interval from `lo` to `hi`, which must be in this order.
    #[inline]
    #[must_use]
    pub const fn ordered(lo: T, hi: T) -> Self {
        Self { lo, hi }
    }

    /// Returns the interval from `lo` to `hi`; their midpoint if they are inverted, rest if that is not finite.
    #[inline]
    #[must_use]
    pub fn from_ends(lo: T, hi: T) -> Self {
        Self::between(lo, hi)
    }

    #[inline]
    fn between(lo: T, hi: T) -> Self {
        if lo <= hi {
            Self { lo, hi }
        } else {
            let middle = T::HALF * (lo + hi);
            if middle.is_finite() { Self::point(middle) } else { Self::REST }
        }
    }

    /// Returns `true` if `angle` is in the interval.
    #[inline]
    #[must_use]
    pub fn contains(self, angle: T) -> bool {
        self.lo <= angle && angle <= self.hi
    }

    /// Returns `true` if the interval is a single angle.
    #[inline]
    #[must_use]
    pub fn is_point(self) -> bool {
        self.lo >= self.hi
    }

    /// Clamps `angle` to the interval.
    #[inline]
    #[must_use]
    pub fn hold(self, angle: T) -> T {
        angle.max(self.lo).min(self.hi)
    }

    /// Returns `true` if `angle` is at or past an end and cannot move on in the direction of `change`.
    #[inline]
    #[must_use]
    pub fn blocks(self, angle: T, change: T) -> bool {
        (change > T::ZERO && angle >= self.hi) || (change < T::ZERO && angle <= self.lo)
    }

    /// Returns the intersection with `bounds`; if it is empty, the point of `bounds` nearest to this interval.
    #[inline]
    #[must_use]
    pub fn within(self, bounds: Self) -> Self {
        if bounds.lo > self.hi {
            Self::point(bounds.lo)
        } else if bounds.hi < self.lo {
            Self::point(bounds.hi)
        } else {
            Self { lo: self.lo.max(bounds.lo), hi: self.hi.min(bounds.hi) }
        }
    }

    /// Returns the intersection of both intervals; if it is empty, the midpoint of the gap between them.
    #[inline]
    #[must_use]
    pub fn common(self, other: Self) -> Self {
        Self::between(self.lo.max(other.lo), self.hi.min(other.hi))
    }

    /// Returns the interval with its upper end lowered to the other's. If the interval lies above it entirely, returns
    /// the midpoint of the gap.
    #[inline]
    #[must_use]
    pub fn no_further_up_than(self, other: Self) -> Self {
        Self::between(self.lo, self.hi.min(other.hi))
    }

    /// Returns the interval with its lower end raised to the other's. If the interval lies below it entirely, returns
    /// the midpoint of the gap.
    #[inline]
    #[must_use]
    pub fn no_further_down_than(self, other: Self) -> Self {
        Self::between(self.lo.max(other.lo), self.hi)
    }

    /// Returns the interval with both ends moved by `by`.
    #[inline]
    #[must_use]
    pub fn moved(self, by: T) -> Self {
        Self { lo: self.lo + by, hi: self.hi + by }
    }

    /// Returns the interval with both ends multiplied by `part`, 0…1. The interval must be finite.
    #[inline]
    #[must_use]
    pub fn scaled(self, part: T) -> Self {
        Self { lo: part * self.lo, hi: part * self.hi }
    }

    /// Returns the interval of the angle that may be added when the animation is at `animated`. It always contains 0:
    /// an animation outside the range is not corrected back, but is never moved further out.
    #[inline]
    #[must_use]
    pub fn counted_from(self, animated: T) -> Self {
        Self { lo: (self.lo - animated).min(T::ZERO), hi: (self.hi - animated).max(T::ZERO) }
    }
}

/// Narrowing of a joint's pitch range as its heading approaches the ends of its own range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taper<T> {
    /// Part of the pitch range that is lost at either end of the heading's, 0…1.
    most: T,
    /// Part of the pitch range that is lost for each radian of heading to the right and to the left.
    per_rad: [T; 2],
    /// The pitch range without taper.
    pitch: Interval<T>,
    /// The animated angles from which the ranges are measured; `None` if that is the animation.
    animated: Option<Angles<T>>,
}

impl<T: Float> Taper<T> {
    /// Returns `None` if nothing tapers: `most` is 0, the joint has no limited pitch, or its heading has no finite end.
    /// `most` is clamped to 0…1; NaN counts as 0.
    fn new(most: T, heading: Interval<T>, pitch: Interval<T>, animated: Option<Angles<T>>) -> Option<Self> {
        let most = most.max(T::ZERO).min(T::ONE);
        let per_rad = [-heading.lo, heading.hi].map(|end| if end > T::ZERO { most / end } else { T::ZERO });
        if pitch.is_free() || pitch == Interval::REST || per_rad == [T::ZERO; 2] {
            return None;
        }
        Some(Self { most, per_rad, pitch, animated })
    }

    /// Returns the taper of a pitch range scaled by `part`, 0…1.
    #[inline]
    fn shrunk(self, part: T) -> Self {
        Self { pitch: self.pitch.scaled(part), ..self }
    }

    /// Returns the pitch interval at this added heading: `(1 − min(most, |heading| · most / end)) · range`.
    #[inline]
    #[must_use]
    pub fn pitch_at(&self, heading: T) -> Interval<T> {
        let animated = self.animated.unwrap_or(Angles { heading: T::ZERO, pitch: T::ZERO });
        let heading = heading + animated.heading;
        let [right, left] = self.per_rad;
        let taper = if heading < T::ZERO { -heading * right } else { heading * left };
        let tapered = self.pitch.scaled(T::ONE - taper.max(T::ZERO).min(self.most));
        match self.animated {
            Some(_) => tapered.counted_from(animated.pitch),
            None => tapered,
        }
    }
}

/// A joint's range of motion in one pose, as intervals of its added angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeOfMotion<T> {
    /// The interval of the heading.
    pub heading: Interval<T>,
    /// The interval of the pitch without taper. See [`pitch_at`](Self::pitch_at).
    pub pitch: Interval<T>,
    /// The dependence of the pitch interval on the heading; `None` if it does not depend on it.
    pub taper: Option<Taper<T>>,
}

impl<T: Float> RangeOfMotion<T> {
    /// No movement: both angles are fixed at 0.
    pub const REST: Self = Self { heading: Interval::REST, pitch: Interval::REST, taper: None };

    /// Evaluates the ranges of a joint from its declared ends (`None` for an angle that the joint lacks) and its taper.
    /// `animated` are the angles by which the animation turns the joint out of the bind pose; `None` if the ranges are
    /// measured from the animation itself.
    #[inline]
    #[must_use]
    pub fn new(declared: Angles<Option<[T; 2]>>, taper: T, animated: Option<Angles<T>>) -> Self {
        let [heading, pitch] = [declared.heading, declared.pitch].map(Interval::declared);
        let mut range = Self { heading, pitch, taper: Taper::new(taper, heading, pitch, animated) };
        // Leave an undeclared angle at rest: it has no range to measure.
        if let Some(animated) = animated {
            if declared.heading.is_some() {
                range.heading = heading.counted_from(animated.heading);
            }
            if declared.pitch.is_some() {
                range.pitch = pitch.counted_from(animated.pitch);
            }
        }
        range
    }

    /// Returns these ranges with the given heading interval and the pitch interval scaled by `pitch_part`, 0…1. A free
    /// pitch stays free.
    #[inline]
    #[must_use]
    pub fn shrunk(&self, heading: Interval<T>, pitch_part: T) -> Self {
        Self {
            heading,
            pitch: if self.pitch.is_free() { self.pitch } else { self.pitch.scaled(pitch_part) },
            taper: self.taper.map(|taper| taper.shrunk(pitch_part)),
        }
    }

    /// Returns the interval of the pitch at this added heading.
    #[inline]
    #[must_use]
    pub fn pitch_at(&self, heading: T) -> Interval<T> {
        match &self.taper {
            Some(taper) => taper.pitch_at(heading),
            None => self.pitch,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INFINITE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

    #[test]
    fn declared_ranges_are_normalised_as_documented() {
        let ends = |declared| Interval::declared(declared).ends();
        assert_eq!(ends(None), [0.0, 0.0]);
        assert_eq!(ends(Some([-1.0, 2.0])), [-1.0, 2.0]);
        assert_eq!(ends(Some([2.0, -1.0])), [0.5, 0.5]);
        assert_eq!(ends(Some([f64::NAN, 1.0])), [0.0, 0.0]);
        assert_eq!(ends(Some([-9.0, f64::INFINITY])), [-core::f64::consts::TAU, core::f64::consts::TAU]);
        assert!(Interval::declared(Some(INFINITE)).is_free());
    }

    #[test]
    fn pitch_tapers_linearly_to_either_end_of_the_heading() {
        let declared = Angles { heading: Some([-2.0, 1.0]), pitch: Some([-0.4, 0.8]) };
        let range = RangeOfMotion::new(declared, 0.5, None);
        for (heading, factor) in [(0.0, 1.0), (0.5, 0.75), (1.0, 0.5), (3.0, 0.5), (-1.0, 0.75), (-2.0, 0.5)] {
            assert_eq!(range.pitch_at(heading).ends(), [-0.4 * factor, 0.8 * factor], "{heading}");
        }
        let free = RangeOfMotion::new(Angles { heading: Some(INFINITE), ..declared }, 0.5, None);
        assert_eq!(free.pitch_at(1.0).ends(), [-0.4, 0.8]);
    }

    #[test]
    fn the_animated_angle_counts_towards_a_range_from_the_bind_pose() {
        let declared = Angles { heading: Some([-1.0, 1.0]), pitch: None };
        let range = RangeOfMotion::new(declared, 0.0, Some(Angles { heading: 0.25, pitch: 7.0 }));
        assert_eq!((range.heading.ends(), range.pitch.ends()), ([-1.25, 0.75], [0.0, 0.0]));
        // Beyond the range the joint is neither corrected back nor moved further out.
        let beyond = RangeOfMotion::new(declared, 0.0, Some(Angles { heading: 1.5, pitch: 0.0 }));
        assert_eq!(beyond.heading.ends(), [-2.5, 0.0]);
    }
}
