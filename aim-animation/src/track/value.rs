//! [`Value`]: types of values that a track can hold.

use core::fmt::Debug;

use aim_runtime::glam::{Quat, Vec3};
use aim_runtime::rotation::{angle, dot, log, product, slerp, unit};

/// Limit on the magnitude of a track's numbers, so that interpolation does not overflow.
const MOST: f32 = 1e15;

/// A value of a track: a scalar, a vector or a rotation. Sealed.
pub trait Value: Copy + Debug + PartialEq + sealed::Arithmetic {}

impl Value for f32 {}
impl Value for Vec3 {}
impl Value for Quat {}

pub(crate) mod sealed {
    /// Arithmetic of values; rotations are treated as four numbers.
    #[expect(unnameable_types, reason = "sealed: nobody else implements it")]
    pub trait Arithmetic: Sized {
        /// Normalises the value of a key; returns it with the factor applied. `None` if the value is invalid.
        fn key(self) -> Option<(Self, f32)>;
        /// Returns `true` if every number is finite and at most 1e15.
        fn bounded(self) -> bool;
        fn times(self, factor: f32) -> Self;
        fn plus(self, other: Self) -> Self;
        /// Returns the representation nearest to another value: for quaternions, the sign in the same hemisphere.
        fn near(self, other: Self) -> Self;
        /// Linear interpolation from `self` at 0 to `other` at 1; rotations take the shorter way at constant speed.
        fn linear(self, other: Self, part: f32) -> Self;
        /// Number of pieces into which linear interpolation to another value is divided so that a cubic approximates
        /// each.
        fn cubic_pieces(self, other: Self) -> u8;
        /// Velocity at this point of the linear interpolation from one value to another within `interval` seconds.
        fn linear_velocity(self, way: [Self; 2], interval: f32) -> Self;
        /// Makes the result of sums a valid value: normalises rotations, or `fallback` if that is not possible.
        fn value(self, fallback: Self) -> Self;
    }
}

macro_rules! linear_value {
    ($of:ty, $numbers:expr) => {
        impl sealed::Arithmetic for $of {
            fn key(self) -> Option<(Self, f32)> {
                self.bounded().then_some((self, 1.0))
            }
            fn bounded(self) -> bool {
                let numbers = $numbers;
                numbers(self).iter().all(|number: &f32| number.abs() <= MOST)
            }
            fn times(self, factor: f32) -> Self {
                self * factor
            }
            fn plus(self, other: Self) -> Self {
                self + other
            }
            fn near(self, _: Self) -> Self {
                self
            }
            fn linear(self, other: Self, part: f32) -> Self {
                self * (1.0 - part) + other * part
            }
            fn cubic_pieces(self, _: Self) -> u8 {
                1
            }
            fn linear_velocity(self, [from, to]: [Self; 2], interval: f32) -> Self {
                (to - from) / interval
            }
            fn value(self, _: Self) -> Self {
                self
            }
        }
    };
}

linear_value!(f32, |number: f32| [number]);
linear_value!(Vec3, |vector: Vec3| vector.to_array());

impl sealed::Arithmetic for Quat {
    fn key(self) -> Option<(Self, f32)> {
        let unit = unit(self)?;
        // Within rounding, 1 for a quaternion that is already unit.
        let factor = dot(unit, self) / dot(self, self);
        (self.bounded() && factor.is_finite()).then_some((unit, factor))
    }

    fn bounded(self) -> bool {
        self.to_array().iter().all(|number| number.abs() <= MOST)
    }

    fn times(self, factor: f32) -> Self {
        self * factor
    }

    fn plus(self, other: Self) -> Self {
        self + other
    }

    fn near(self, other: Self) -> Self {
        if dot(self, other) < 0.0 { -self } else { self }
    }

    fn linear(self, other: Self, part: f32) -> Self {
        let other = other.near(self);
        let chord = other - self;
        let square = dot(chord, chord);
        if !(square < 0.02) {
            return slerp(self, other, part);
        }
        // Slerp weights sin(p·θ) / sin θ by their series, because keys are seldom far apart. θ = 2 asin(chord / 2) <
        // 0.15.
        let square = square * (1.0 + square * (1.0 / 12.0 + square * (1.0 / 90.0)));
        let series = |part: f32| {
            let square = part * part * square;
            part * (1.0 - square * (1.0 / 6.0 - square * (1.0 / 120.0)))
        };
        let whole = 1.0 / series(1.0);
        let sum = self * (series(1.0 - part) * whole) + other * (series(part) * whole);
        // The sum is unit except for rounding: one Newton step for 1/√x corrects it.
        sum * (1.5 - 0.5 * dot(sum, sum))
    }

    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "of an angle up to half a turn")]
    fn cubic_pieces(self, other: Self) -> u8 {
        // A cubic over a tenth of a radian has an error of 1e-8.
        1 + (angle(product(other, self.conjugate())) * 10.0) as u8
    }

    fn linear_velocity(self, [from, to]: [Self; 2], interval: f32) -> Self {
        // q′ = ω/2 · q, with constant ω.
        let half = log(product(to, from.conjugate())) * (0.5 / interval);
        product(Self::from_xyzw(half.x, half.y, half.z, 0.0), self)
    }

    fn value(self, fallback: Self) -> Self {
        unit(self).or_else(|| unit(fallback)).unwrap_or(fallback)
    }
}
