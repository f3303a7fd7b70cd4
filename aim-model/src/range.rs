//! [`RangeOfMotion`]: where a joint's added angles may be, evaluated in one place for the solvers (`f32`) and for what
//! reads declarations and writes reports (`f64`).

use crate::Float;

/// The pose from which a joint's ranges are counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum LimitsFrom {
    /// The animated pose of the frame: the ranges bound what is added to the animation.
    #[default]
    Animation,
    /// The bind pose: the ranges bound the animation's own turn and the added one together. If the animation itself
    /// exceeds a range, the joint is not corrected back, but is never moved further out. Needs a pose with a bind pose;
    /// without one the ranges are counted from the animation.
    BindPose,
}

/// A joint's two angles, radians unless said otherwise.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Angles<T> {
    /// Positive turns forward towards left.
    pub heading: T,
    /// Positive turns forward towards up.
    pub pitch: T,
}

/// An interval of angles, `lo ≤ hi`; both infinite where an angle may turn freely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval<T> {
    lo: T,
    hi: T,
}

impl<T: Float> Interval<T> {
    /// The one angle 0.
    pub const REST: Self = Self { lo: T::ZERO, hi: T::ZERO };

    /// Every angle.
    #[inline]
    #[must_use]
    pub fn everything() -> Self {
        Self { lo: -T::INFINITY, hi: T::INFINITY }
    }

    /// A declared range as it counts: rest where there is none or an end is NaN, its middle where it is inverted, at most
    /// a full turn to either side unless both ends are infinite.
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

    /// The lower end.
    #[inline]
    #[must_use]
    pub const fn lo(self) -> T {
        self.lo
    }

    /// The upper end.
    #[inline]
    #[must_use]
    pub const fn hi(self) -> T {
        self.hi
    }

    /// Both ends, the lower first.
    #[inline]
    #[must_use]
    pub const fn ends(self) -> [T; 2] {
        [self.lo, self.hi]
    }

    /// Whether the angle may turn freely.
    #[inline]
    #[must_use]
    pub fn is_free(self) -> bool {
        self.lo == -T::INFINITY && self.hi == T::INFINITY
    }

    /// The one angle.
    #[inline]
    #[must_use]
    pub const fn point(angle: T) -> Self {
        Self { lo: angle, hi: angle }
    }

    /// The angles that a change by `step` at most leads to.
    #[inline]
    #[must_use]
    pub fn around(from: T, step: T) -> Self {
        Self { lo: from - step, hi: from + step }
    }

    /// From `lo` to `hi`; their middle where they are inverted, rest where that is undefined.
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

    /// Whether the angle is in the interval.
    #[inline]
    #[must_use]
    pub fn contains(self, angle: T) -> bool {
        self.lo <= angle && angle <= self.hi
    }

    /// Whether it is a single angle.
    #[inline]
    #[must_use]
    pub fn is_point(self) -> bool {
        self.lo >= self.hi
    }

    /// The angle of the interval nearest to `angle`.
    #[inline]
    #[must_use]
    pub fn hold(self, angle: T) -> T {
        angle.max(self.lo).min(self.hi)
    }

    /// Whether `angle` cannot move on in the direction of `change`.
    #[inline]
    #[must_use]
    pub fn blocks(self, angle: T, change: T) -> bool {
        (change > T::ZERO && angle >= self.hi) || (change < T::ZERO && angle <= self.lo)
    }

    /// What is left of the interval within `bounds`. Where that is nothing, the point of `bounds` nearest to it.
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

    /// What both intervals have in common; the middle between them where that is nothing.
    #[inline]
    #[must_use]
    pub fn common(self, other: Self) -> Self {
        Self::between(self.lo.max(other.lo), self.hi.min(other.hi))
    }

    /// The interval without what is above the other's.
    #[inline]
    #[must_use]
    pub fn no_further_up_than(self, other: Self) -> Self {
        Self::between(self.lo, self.hi.min(other.hi))
    }

    /// The interval without what is below the other's.
    #[inline]
    #[must_use]
    pub fn no_further_down_than(self, other: Self) -> Self {
        Self::between(self.lo.max(other.lo), self.hi)
    }

    /// The interval with both ends moved by `by`.
    #[inline]
    #[must_use]
    pub fn moved(self, by: T) -> Self {
        Self { lo: self.lo + by, hi: self.hi + by }
    }

    /// This part of the interval, 0…1; finite intervals only.
    #[inline]
    #[must_use]
    pub fn scaled(self, part: T) -> Self {
        Self { lo: part * self.lo, hi: part * self.hi }
    }

    /// The interval of what may be added to an angle that the animation has at `animated` already. It always contains 0:
    /// an animation outside the range is not corrected back, but is never moved further out.
    #[inline]
    #[must_use]
    pub fn counted_from(self, animated: T) -> Self {
        Self { lo: (self.lo - animated).min(T::ZERO), hi: (self.hi - animated).max(T::ZERO) }
    }
}

/// How a pitch's range tapers as the heading nears the ends of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taper<T> {
    /// The part of the range that is lost at either end, 0…1.
    most: T,
    /// The part that is lost for each radian to the right and to the left.
    per_rad: [T; 2],
    /// The range that tapers, and the angles that it is counted from.
    pitch: Interval<T>,
    animated: Option<Angles<T>>,
}

impl<T: Float> Taper<T> {
    /// `None` where nothing tapers: not asked for, no pitch, no end of the heading. NaN counts as 0.
    fn new(most: T, heading: Interval<T>, pitch: Interval<T>, animated: Option<Angles<T>>) -> Option<Self> {
        let most = most.max(T::ZERO).min(T::ONE);
        let per_rad = [-heading.lo, heading.hi].map(|end| if end > T::ZERO { most / end } else { T::ZERO });
        if pitch.is_free() || pitch == Interval::REST || per_rad == [T::ZERO; 2] {
            return None;
        }
        Some(Self { most, per_rad, pitch, animated })
    }

    /// The taper of this part of the range, 0…1.
    #[inline]
    fn shrunk(self, part: T) -> Self {
        Self { pitch: self.pitch.scaled(part), ..self }
    }

    /// The pitch's interval at this added heading: `(1 − min(most, |heading| · most / end)) · range`.
    #[inline]
    #[must_use]
    pub fn pitch_at(&self, heading: T) -> Interval<T> {
        let animated = self.animated.unwrap_or(Angles { heading: T::ZERO, pitch: T::ZERO });
        let heading = heading + animated.heading;
        let [right, left] = self.per_rad;
        let lost = if heading < T::ZERO { -heading * right } else { heading * left };
        let tapered = self.pitch.scaled(T::ONE - lost.max(T::ZERO).min(self.most));
        match self.animated {
            Some(_) => tapered.counted_from(animated.pitch),
            None => tapered,
        }
    }
}

/// A joint's ranges of motion in one pose, as intervals of its added angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeOfMotion<T> {
    /// The heading's interval.
    pub heading: Interval<T>,
    /// The pitch's interval where the heading takes nothing of it. See [`pitch_at`](Self::pitch_at).
    pub pitch: Interval<T>,
    /// How the pitch's interval depends on the heading.
    pub taper: Option<Taper<T>>,
}

impl<T: Float> RangeOfMotion<T> {
    /// No movement.
    pub const REST: Self = Self { heading: Interval::REST, pitch: Interval::REST, taper: None };

    /// The ranges of a joint from its declared ends (`None` for an angle that it does not have) and taper, where the
    /// animation turns it by `animated` out of the pose that they are counted from; `None` where that is the animation.
    #[inline]
    #[must_use]
    pub fn new(declared: Angles<Option<[T; 2]>>, taper: T, animated: Option<Angles<T>>) -> Self {
        let [heading, pitch] = [declared.heading, declared.pitch].map(Interval::declared);
        let mut range = Self { heading, pitch, taper: Taper::new(taper, heading, pitch, animated) };
        // An angle that was not declared has no range to be counted from anywhere.
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

    /// With another interval of the heading, and this part of the pitch's, 0…1.
    #[inline]
    #[must_use]
    pub fn shrunk(&self, heading: Interval<T>, pitch_part: T) -> Self {
        Self {
            heading,
            pitch: if self.pitch.is_free() { self.pitch } else { self.pitch.scaled(pitch_part) },
            taper: self.taper.map(|taper| taper.shrunk(pitch_part)),
        }
    }

    /// The pitch's interval at this added heading.
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
    fn declared_ranges_count_as_documented() {
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
        for (heading, kept) in [(0.0, 1.0), (0.5, 0.75), (1.0, 0.5), (3.0, 0.5), (-1.0, 0.75), (-2.0, 0.5)] {
            assert_eq!(range.pitch_at(heading).ends(), [-0.4 * kept, 0.8 * kept], "{heading}");
        }
        let free = RangeOfMotion::new(Angles { heading: Some(INFINITE), ..declared }, 0.5, None);
        assert_eq!(free.pitch_at(1.0).ends(), [-0.4, 0.8]);
    }

    #[test]
    fn what_the_animation_does_counts_from_the_bind_pose() {
        let declared = Angles { heading: Some([-1.0, 1.0]), pitch: None };
        let range = RangeOfMotion::new(declared, 0.0, Some(Angles { heading: 0.25, pitch: 7.0 }));
        assert_eq!((range.heading.ends(), range.pitch.ends()), ([-1.25, 0.75], [0.0, 0.0]));
        // Beyond the range the joint is let be and not moved further out.
        let beyond = RangeOfMotion::new(declared, 0.0, Some(Angles { heading: 1.5, pitch: 0.0 }));
        assert_eq!(beyond.heading.ends(), [-2.5, 0.0]);
    }
}
