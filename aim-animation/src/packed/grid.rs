//! Quantisation: values as integer multiples of a step. Vectors have their components, rotations three of four.

use aim_runtime::glam::{Quat, Vec3};
use aim_runtime::rotation::{dot, product, unit};

use crate::track::{Arithmetic, Value};

/// Value of [`Grid::omitted_component`] for which each key leaves out its own largest component.
pub(crate) const LARGEST: u8 = 4;

/// Maximum number of steps from zero, for which every multiple is exact in `f32`.
const MOST_STEPS: f64 = 8_388_608.0;

/// Quantisation steps of a track's values and tangents: powers of two, so that decoding is exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grid {
    /// Values are multiples of `2^-exponent`.
    pub(crate) exponent: i16,
    /// Tangents are multiples of `2^-tangent_exponent`.
    pub(crate) tangent_exponent: i16,
    /// For rotations, the component that is left out, or [`LARGEST`].
    pub(crate) omitted_component: u8,
}

/// A value that can be stored as up to three numbers on a grid, or exactly as its own components.
pub(crate) trait Packable: Value {
    /// Count of numbers of a value on a grid.
    const PARTS: usize;
    /// Count of numbers of a value stored exactly.
    const NUMBERS: usize;
    /// Largest exponent of a step: no step is finer than `2^-FINEST`.
    const FINEST: i16;

    fn numbers(self) -> [f32; 4];
    fn from_numbers(numbers: [f32; 4]) -> Self;
    /// Index of the component to leave out, the one with the largest magnitude.
    fn largest(self) -> u8;
    fn parts(self, omitted_component: u8) -> [f32; 3];
    fn from_parts(parts: [f32; 3], omitted_component: u8) -> Self;
    /// Converts a tangent at this value to numbers that are the same for `q` and `-q`.
    fn tangent_parts(self, tangent: Self) -> [f32; 3];
    fn tangent_from_parts(self, parts: [f32; 3]) -> Self;
    /// Square of the distance; for rotations of the angle, if that is small.
    fn distance_squared(self, other: Self) -> f32;
    /// Returns the one component to leave out of all values, or [`LARGEST`] if none suits.
    fn omitted_component_of(values: &[Self]) -> u8;
}

/// `2^exponent`; exponents are clamped to −126…127.
#[inline]
pub(crate) fn power_of_two(exponent: i16) -> f32 {
    let biased = u32::from((exponent.clamp(-126, 127) + 127).unsigned_abs());
    f32::from_bits(biased << 23)
}

/// Exponent of the largest step that does not exceed a size, `step = 2^-exponent ≤ size`. Clamped to −40…`finest`.
pub(crate) fn exponent_of(size: f32, finest: i16) -> i16 {
    if !(size > 0.0) {
        return finest;
    }
    let biased = i16::try_from(size.to_bits() >> 23 & 0xff).unwrap_or(0);
    (127 - biased).clamp(-40, finest)
}

/// Rounds a number to steps of `2^-exponent`; `None` if that is more than 2²³ steps.
pub(crate) fn steps(number: f32, exponent: i16) -> Option<i32> {
    let steps = f64::from(number) * f64::from(power_of_two(exponent));
    let steps = crate::float::floor(steps + 0.5);
    #[expect(clippy::cast_possible_truncation, reason = "within 2²³")]
    (steps.abs() <= MOST_STEPS).then_some(steps as i32)
}

/// Converts steps of `2^-exponent` back to a number.
#[inline]
pub(crate) fn from_steps(steps: i32, exponent: i16) -> f32 {
    #[expect(clippy::cast_precision_loss, reason = "what was counted is within 2²³")]
    let steps = steps as f32;
    steps * power_of_two(-exponent)
}

fn snapped(parts: [f32; 3], exponent: i16) -> Option<[f32; 3]> {
    let snap = |part: f32| Some(from_steps(steps(part, exponent)?, exponent));
    Some([snap(parts[0])?, snap(parts[1])?, snap(parts[2])?])
}

impl Grid {
    /// Index of the component that is left out of a value.
    pub(crate) fn omitted_component_of<T: Packable>(&self, value: T) -> u8 {
        if self.omitted_component == LARGEST { value.largest() } else { self.omitted_component }
    }

    /// Nearest value on the grid; `None` if it is out of range.
    pub(crate) fn value<T: Packable>(&self, value: T) -> Option<T> {
        let omitted_component = self.omitted_component_of(value);
        let parts = snapped(value.parts(omitted_component), self.exponent)?;
        Some(T::from_parts(parts, omitted_component).near(value))
    }

    /// Nearest tangent on the grid; `None` if it is out of range.
    pub(crate) fn tangent<T: Packable>(&self, value: T, tangent: T) -> Option<T> {
        Some(value.tangent_from_parts(snapped(value.tangent_parts(tangent), self.tangent_exponent)?))
    }
}

impl Packable for f32 {
    const PARTS: usize = 1;
    const NUMBERS: usize = 1;
    const FINEST: i16 = 40;

    fn numbers(self) -> [f32; 4] {
        [self, 0.0, 0.0, 0.0]
    }
    fn from_numbers(numbers: [f32; 4]) -> Self {
        numbers[0]
    }
    fn largest(self) -> u8 {
        0
    }
    fn parts(self, _: u8) -> [f32; 3] {
        [self, 0.0, 0.0]
    }
    fn from_parts(parts: [f32; 3], _: u8) -> Self {
        parts[0]
    }
    fn tangent_parts(self, tangent: Self) -> [f32; 3] {
        [tangent, 0.0, 0.0]
    }
    fn tangent_from_parts(self, parts: [f32; 3]) -> Self {
        parts[0]
    }
    fn distance_squared(self, other: Self) -> f32 {
        (self - other) * (self - other)
    }
    fn omitted_component_of(_: &[Self]) -> u8 {
        0
    }
}

impl Packable for Vec3 {
    const PARTS: usize = 3;
    const NUMBERS: usize = 3;
    const FINEST: i16 = 40;

    fn numbers(self) -> [f32; 4] {
        [self.x, self.y, self.z, 0.0]
    }
    fn from_numbers([x, y, z, _]: [f32; 4]) -> Self {
        Self::new(x, y, z)
    }
    fn largest(self) -> u8 {
        0
    }
    fn parts(self, _: u8) -> [f32; 3] {
        self.to_array()
    }
    fn from_parts(parts: [f32; 3], _: u8) -> Self {
        Self::from_array(parts)
    }
    fn tangent_parts(self, tangent: Self) -> [f32; 3] {
        tangent.to_array()
    }
    fn tangent_from_parts(self, parts: [f32; 3]) -> Self {
        Self::from_array(parts)
    }
    fn distance_squared(self, other: Self) -> f32 {
        let d = self - other;
        d.x * d.x + d.y * d.y + d.z * d.z
    }
    fn omitted_component_of(_: &[Self]) -> u8 {
        0
    }
}

impl Packable for Quat {
    const PARTS: usize = 3;
    const NUMBERS: usize = 4;
    const FINEST: i16 = 20;

    fn numbers(self) -> [f32; 4] {
        self.to_array()
    }
    fn from_numbers(numbers: [f32; 4]) -> Self {
        Self::from_array(numbers)
    }

    fn largest(self) -> u8 {
        let numbers = self.to_array().map(f32::abs);
        let mut largest = 3;
        for index in 0..3_u8 {
            if numbers[usize::from(index)] > numbers[usize::from(largest)] {
                largest = index;
            }
        }
        largest
    }

    fn parts(self, omitted_component: u8) -> [f32; 3] {
        // The others divided by the one left out, whose size follows from the unit length; its sign is irrelevant,
        // since q and −q are equal.
        let [x, y, z, w] = self.to_array();
        match omitted_component {
            0 => [y / x, z / x, w / x],
            1 => [x / y, z / y, w / y],
            2 => [x / z, y / z, w / z],
            _ => [x / w, y / w, z / w],
        }
    }

    #[inline]
    fn from_parts([a, b, c]: [f32; 3], omitted_component: u8) -> Self {
        let numbers = match omitted_component {
            0 => [1.0, a, b, c],
            1 => [a, 1.0, b, c],
            2 => [a, b, 1.0, c],
            _ => [a, b, c, 1.0],
        };
        unit(Self::from_array(numbers)).unwrap_or(Self::IDENTITY)
    }

    fn tangent_parts(self, tangent: Self) -> [f32; 3] {
        // q′ = (v, 0) · q. Drop the scalar part: it changes the length of q, not the rotation.
        let turn = product(tangent, self.conjugate());
        [turn.x, turn.y, turn.z]
    }

    #[inline]
    fn tangent_from_parts(self, [x, y, z]: [f32; 3]) -> Self {
        product(Self::from_xyzw(x, y, z, 0.0), self)
    }

    fn distance_squared(self, other: Self) -> f32 {
        let chord = other.near(self) - self;
        4.0 * dot(chord, chord)
    }

    fn omitted_component_of(values: &[Self]) -> u8 {
        let least = |index: u8| {
            values.iter().fold(1.0_f32, |least, value| least.min(value.to_array()[usize::from(index)].abs()))
        };
        let best = [3, 0, 1, 2].into_iter().reduce(|a, b| if least(b) > least(a) { b } else { a });
        // Division by a smaller component would enlarge the steps of the others, and its sign might change between
        // keys.
        best.filter(|&index| least(index) > 0.35).unwrap_or(LARGEST)
    }
}
