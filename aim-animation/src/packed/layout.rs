//! Encoding of one packed track: a header, the indices of the keys' times, and the keys.

use alloc::vec::Vec;

use super::bits::{BitReader, BitWriter, bits_at, width_of};
use super::grid::{Grid, LARGEST, Packable, from_steps, steps};
use crate::track::{Curve, Track};

/// Property that a track animates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Channel {
    Translation,
    Rotation,
    Scale,
    Scalar,
}

/// Width of the fields that hold the widths of other fields.
const WIDTH_BITS: u32 = 5;
/// Width of the exponent of a step.
const EXPONENT_BITS: u32 = 8;
/// Bias added to an exponent, so that it is stored as an unsigned number.
const EXPONENT_BIAS: i16 = 128;

/// Range of quantised components: each is stored as the number of steps from a base.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Range {
    exponent: i16,
    widths: [u32; 3],
    bases: [i32; 3],
}

impl Range {
    /// Computes the range of the components; `None` if one is too large. If there are several keys, the first component
    /// gets at least one bit.
    fn of(parts: impl Iterator<Item = [f32; 3]>, exponent: i16, count: usize) -> Option<Self> {
        let mut ends: Option<[[i32; 3]; 2]> = None;
        let mut keys = 0;
        for part in parts {
            keys += 1;
            for (index, part) in part.iter().enumerate().take(count) {
                let step = steps(*part, exponent)?;
                let [low, high] = ends.get_or_insert([[i32::MAX; 3], [i32::MIN; 3]]);
                (low[index], high[index]) = (low[index].min(step), high[index].max(step));
            }
        }
        let [low, high] = ends?;
        let mut range = Self { exponent, ..Self::default() };
        for index in 0..count {
            range.bases[index] = low[index];
            range.widths[index] = width_of(high[index].abs_diff(low[index]));
        }
        // Bounds the number of keys by the number of bits, and so the memory that a damaged file can claim.
        range.widths[0] = range.widths[0].max(u32::from(keys > 1));
        Some(range)
    }

    fn stride(&self) -> u32 {
        self.widths.iter().sum()
    }

    fn bits(&self, count: usize) -> u32 {
        let base = |base: &i32| 2 * WIDTH_BITS + width_of(zigzag(*base));
        EXPONENT_BITS + self.bases.iter().take(count).map(base).sum::<u32>()
    }

    fn write(&self, bits: &mut BitWriter, count: usize) {
        bits.push(u32::from((self.exponent + EXPONENT_BIAS).unsigned_abs()), EXPONENT_BITS);
        for index in 0..count {
            let base = zigzag(self.bases[index]);
            bits.push(self.widths[index], WIDTH_BITS);
            bits.push(width_of(base), WIDTH_BITS);
            bits.push(base, width_of(base));
        }
    }

    #[inline]
    fn read(bits: &mut BitReader<'_>, count: usize) -> Self {
        let exponent = i16::try_from(bits.take(EXPONENT_BITS)).unwrap_or(0) - EXPONENT_BIAS;
        let mut range = Self { exponent, ..Self::default() };
        for index in 0..count {
            range.widths[index] = bits.take(WIDTH_BITS);
            let width = bits.take(WIDTH_BITS);
            range.bases[index] = unzigzag(bits.take(width));
        }
        range
    }

    fn push(&self, bits: &mut BitWriter, parts: [f32; 3], count: usize) {
        for (index, part) in parts.into_iter().enumerate().take(count) {
            let step = steps(part, self.exponent).unwrap_or(self.bases[index]);
            bits.push(step.abs_diff(self.bases[index]), self.widths[index]);
        }
    }

    #[inline]
    fn take(&self, bits: &mut BitReader<'_>, count: usize) -> [f32; 3] {
        let mut parts = [0.0; 3];
        for (index, part) in parts.iter_mut().enumerate().take(count) {
            let step = self.bases[index].wrapping_add_unsigned(bits.take(self.widths[index]));
            *part = from_steps(step, self.exponent);
        }
        parts
    }
}

fn zigzag(number: i32) -> u32 {
    (number.unsigned_abs() << 1) | u32::from(number < 0)
}

#[expect(clippy::cast_possible_wrap, reason = "31 bits at most")]
fn unzigzag(number: u32) -> i32 {
    let size = (number >> 1) as i32;
    if number & 1 == 1 { -size } else { size }
}

/// Encoding of a track's keys.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    /// Components as full floats.
    Exact,
    /// Quantised values and tangents.
    Grid { omitted_component: u8, values: Range, tangents: Range },
}

/// Number of tangents stored for each key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tangents {
    None,
    /// Arriving and leaving tangent are equal.
    One,
    Two,
}

impl Tangents {
    fn count(self) -> u32 {
        match self {
            Self::None => 0,
            Self::One => 1,
            Self::Two => 2,
        }
    }
}

/// The header of a track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Header {
    pub(super) channel: Channel,
    pub(super) curve: Curve,
    /// Index of the bone, or number of the scalar.
    pub(super) target: usize,
    pub(super) keys: usize,
    tangents: Tangents,
    form: Form,
    /// `true` if the track has a key at each time of the clip.
    at_all_times: bool,
    /// Positions of the time indices and of the keys, in bits.
    times_at: usize,
    keys_at: usize,
    stride: u32,
}

/// Widths of a variable-length integer: one flag bit selects 10 or 32 bits.
const SMALL: [u32; 2] = [10, 32];

fn push_small(bits: &mut BitWriter, number: usize) -> Option<()> {
    let number = u32::try_from(number).ok()?;
    let is_wide = width_of(number) > SMALL[0];
    bits.push(u32::from(is_wide), 1);
    bits.push(number, SMALL[usize::from(is_wide)]);
    Some(())
}

fn small_bits(number: usize) -> usize {
    1 + if number >> SMALL[0] == 0 { 10 } else { 32 }
}

#[inline]
fn take_small(bits: &mut BitReader<'_>) -> usize {
    let is_wide = bits.take(1) == 1;
    bits.take(SMALL[usize::from(is_wide)]) as usize
}

/// Width of an index into the clip's times, bits.
pub(super) fn time_bits(times: usize) -> u32 {
    width_of(u32::try_from(times.saturating_sub(1)).unwrap_or(u32::MAX))
}

/// Chooses the encoding of a track's keys: quantised, or exact if they do not fit the grid.
fn form<T: Packable>(track: &Track<T>, grid: Option<Grid>) -> (Tangents, Form) {
    let smooth = |tangents: &[[T; 2]]| {
        // The first arriving and the last leaving tangent have no effect, so they need not match.
        let inner = tangents.get(1..tangents.len().saturating_sub(1)).unwrap_or_default();
        inner.iter().all(|[into, out]| into == out)
    };
    let tangents = match track.curve() {
        Curve::Cubic if smooth(track.tangents()) => Tangents::One,
        Curve::Cubic => Tangents::Two,
        _ => Tangents::None,
    };
    let form = grid.and_then(|grid| {
        let values = track.values();
        let omitted_component = |value: T| grid.omitted_component_of(value);
        let parts = values.iter().map(|value| value.parts(omitted_component(*value)));
        let of_values = Range::of(parts, grid.exponent, T::PARTS)?;
        let of_tangents = if tangents == Tangents::None {
            Range::default()
        } else {
            let parts = values.iter().enumerate().flat_map(|(k, value)| {
                kept_tangents(track, k, tangents).into_iter().map(|tangent| value.tangent_parts(tangent))
            });
            Range::of(parts, grid.tangent_exponent, T::PARTS)?
        };
        Some(Form::Grid { omitted_component: grid.omitted_component, values: of_values, tangents: of_tangents })
    });
    (tangents, form.unwrap_or(Form::Exact))
}

/// Returns the tangents of a key that are stored.
fn kept_tangents<T: Packable>(track: &Track<T>, key: usize, tangents: Tangents) -> Vec<T> {
    let [into, out] = track.tangents()[key];
    match tangents {
        Tangents::None => Vec::new(),
        // The leaving tangent of the first key, the arriving one of the last: their other tangents have no effect.
        Tangents::One => alloc::vec![if key == 0 { out } else { into }],
        Tangents::Two => alloc::vec![into, out],
    }
}

impl Form {
    fn stride<T: Packable>(&self, tangents: Tangents) -> u32 {
        let count = tangents.count();
        match self {
            Self::Exact => 32 * u32::try_from(T::NUMBERS).unwrap_or(0) * (1 + count),
            Self::Grid { omitted_component, values, tangents } => {
                values.stride() + 2 * u32::from(*omitted_component == LARGEST) + count * tangents.stride()
            }
        }
    }
}

/// Number of bits that a track takes.
pub(crate) fn bits_of<T: Packable>(target: usize, track: &Track<T>, grid: Option<Grid>, times: usize) -> usize {
    let (tangents, form) = form(track, grid);
    let keys = track.times().len();
    let of_form = match form {
        Form::Exact => 0,
        Form::Grid { values, tangents: of_tangents, .. } => {
            let second = if tangents == Tangents::None { 0 } else { of_tangents.bits(T::PARTS) };
            3 + values.bits(T::PARTS) + second
        }
    };
    let of_times = if keys == times { 0 } else { small_bits(keys) + keys * time_bits(times) as usize };
    6 + small_bits(target) + of_form as usize + of_times + keys * form.stride::<T>(tangents) as usize
}

/// Writes a track whose values are on the grid; `None` if a number does not fit.
pub(super) fn write<T: Packable>(
    bits: &mut BitWriter,
    (channel, target): (Channel, usize),
    (track, grid): (&Track<T>, Option<Grid>),
    times: &[f32],
) -> Option<()> {
    let (tangents, form) = form(track, grid);
    let keys = track.times().len();
    let curve = match (track.curve(), tangents) {
        (Curve::Step, _) => 0,
        (Curve::Linear, _) => 1,
        (Curve::Cubic, Tangents::Two) => 3,
        (Curve::Cubic, _) => 2,
    };
    bits.push(curve, 2);
    bits.push(channel as u32, 2);
    bits.push(u32::from(form == Form::Exact), 1);
    let at_all_times = track.times() == times;
    bits.push(u32::from(at_all_times), 1);
    push_small(bits, target)?;
    if !at_all_times {
        push_small(bits, keys)?;
    }
    if let Form::Grid { omitted_component, values, tangents: of_tangents } = &form {
        bits.push(u32::from(*omitted_component), 3);
        values.write(bits, T::PARTS);
        if tangents != Tangents::None {
            of_tangents.write(bits, T::PARTS);
        }
    }
    if !at_all_times {
        let width = time_bits(times.len());
        for time in track.times() {
            let index = times.partition_point(|other| other < time);
            bits.push(u32::try_from(index).ok()?, width);
        }
    }
    for (k, value) in track.values().iter().enumerate() {
        let stored = if tangents == Tangents::None { Vec::new() } else { kept_tangents(track, k, tangents) };
        match &form {
            Form::Exact => {
                for value in core::iter::once(*value).chain(stored) {
                    value.numbers().iter().take(T::NUMBERS).for_each(|number| bits.push(number.to_bits(), 32));
                }
            }
            Form::Grid { omitted_component, values, tangents: of_tangents } => {
                let omitted = if *omitted_component == LARGEST { value.largest() } else { *omitted_component };
                if *omitted_component == LARGEST {
                    bits.push(u32::from(omitted), 2);
                }
                values.push(bits, value.parts(omitted), T::PARTS);
                for tangent in stored {
                    of_tangents.push(bits, value.tangent_parts(tangent), T::PARTS);
                }
            }
        }
    }
    Some(())
}

impl Header {
    /// Decodes the header at bit `position`. `times` is the number of the clip's times.
    #[inline]
    pub(super) fn read(bytes: &[u8], position: usize, times: usize) -> Self {
        let mut bits = BitReader { bytes, position };
        let (curve, tangents) = match bits.take(2) {
            0 => (Curve::Step, Tangents::None),
            1 => (Curve::Linear, Tangents::None),
            2 => (Curve::Cubic, Tangents::One),
            _ => (Curve::Cubic, Tangents::Two),
        };
        let channel = match bits.take(2) {
            0 => Channel::Translation,
            1 => Channel::Rotation,
            2 => Channel::Scale,
            _ => Channel::Scalar,
        };
        let is_exact = bits.take(1) == 1;
        let at_all_times = bits.take(1) == 1;
        let target = take_small(&mut bits);
        let keys = if at_all_times { times } else { take_small(&mut bits) };
        let (parts, numbers) = match channel {
            Channel::Scalar => (1, 1),
            Channel::Rotation => (3, 4),
            _ => (3, 3),
        };
        let (form, stride) = if is_exact {
            (Form::Exact, 32 * numbers * (1 + tangents.count()))
        } else {
            let omitted_component = u8::try_from(bits.take(3)).unwrap_or(0).min(LARGEST);
            let values = Range::read(&mut bits, parts);
            let of_tangents = if tangents == Tangents::None { Range::default() } else { Range::read(&mut bits, parts) };
            let omitted_bits = 2 * u32::from(omitted_component == LARGEST);
            let stride = values.stride() + omitted_bits + tangents.count() * of_tangents.stride();
            (Form::Grid { omitted_component, values, tangents: of_tangents }, stride)
        };
        let times_at = bits.position;
        let keys_at = if at_all_times {
            times_at
        } else {
            times_at.saturating_add(keys.saturating_mul(time_bits(times) as usize))
        };
        Self { channel, curve, target, keys, tangents, form, at_all_times, times_at, keys_at, stride }
    }

    /// Position after the last key, in bits.
    pub(super) fn end(&self) -> usize {
        self.keys_at.saturating_add(self.keys.saturating_mul(self.stride as usize))
    }

    /// Returns `true` if each key takes at least one bit, or there is only one.
    pub(super) fn is_bounded(&self) -> bool {
        self.keys == 1 || self.keys > 1 && self.stride > 0
    }

    /// Index of a key's time.
    #[inline]
    pub(super) fn time(&self, bytes: &[u8], key: usize, width: u32) -> usize {
        if self.at_all_times { key } else { bits_at(bytes, self.times_at + key * width as usize, width) as usize }
    }

    /// Value of a key.
    #[inline]
    pub(super) fn value<T: Packable>(&self, bytes: &[u8], key: usize) -> T {
        self.value_and_tangents(bytes, key).0
    }

    /// Value of a key, and a reader positioned at its tangents.
    #[inline]
    fn value_and_tangents<'a, T: Packable>(&self, bytes: &'a [u8], key: usize) -> (T, BitReader<'a>) {
        let mut bits = BitReader { bytes, position: self.keys_at + key * self.stride as usize };
        let value = match &self.form {
            Form::Exact => exact(&mut bits),
            Form::Grid { omitted_component, values, .. } => {
                let omitted_component = if *omitted_component == LARGEST {
                    u8::try_from(bits.take(2)).unwrap_or(3)
                } else {
                    *omitted_component
                };
                T::from_parts(values.take(&mut bits, T::PARTS), omitted_component)
            }
        };
        (value, bits)
    }

    /// Returns the sign of a value that is nearer to `other`. Exactly stored values keep their sign, because it gives
    /// the direction of interpolation.
    #[inline]
    pub(super) fn near<T: Packable>(&self, value: T, other: T) -> T {
        if self.form == Form::Exact { value } else { value.near(other) }
    }

    /// Value of a cubic key, with the sign nearer to `near`, and its arriving and leaving tangents.
    #[inline]
    pub(super) fn cubic_key<T: Packable>(&self, bytes: &[u8], key: usize, near: Option<T>) -> (T, [T; 2]) {
        let (value, mut bits): (T, _) = self.value_and_tangents(bytes, key);
        let value = near.map_or(value, |near| self.near(value, near));
        let mut tangent = || match &self.form {
            Form::Exact => exact(&mut bits),
            Form::Grid { tangents, .. } => value.tangent_from_parts(tangents.take(&mut bits, T::PARTS)),
        };
        let into = tangent();
        let out = if self.tangents == Tangents::Two { tangent() } else { into };
        (value, [into, out])
    }
}

#[inline]
fn exact<T: Packable>(bits: &mut BitReader<'_>) -> T {
    let mut numbers = [0.0; 4];
    numbers.iter_mut().take(T::NUMBERS).for_each(|number| *number = f32::from_bits(bits.take(32)));
    T::from_numbers(numbers)
}
