//! [`Segments`]: the cache in a cursor. For each packed track it has the two decoded keys around the time sampled last.

use alloc::sync::Arc;
use alloc::vec::Vec;

use super::grid::Packable;
use super::layout::{Channel, Header};
use crate::track::{Curve, hermite};

/// Two neighbouring keys of a track, decoded.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment {
    pub(super) channel: Channel,
    pub(super) target: usize,
    /// Index of the first of the two keys.
    pub(super) key: usize,
    curve: Curve,
    /// Start of the interval `from_s` ≤ time < `to_s` in which this segment applies.
    from_s: f32,
    to_s: f32,
    /// Time of the first key; up to it the value is constant. Infinite if the first key is the last of the track.
    start_s: f32,
    /// First value, leaving tangent, second value, arriving tangent. Tangents are multiplied by the length of the
    /// interval.
    numbers: [[f32; 4]; 4],
}

impl Segment {
    /// A segment that applies at no time.
    pub(super) const NONE: Self = Self {
        channel: Channel::Scalar,
        target: usize::MAX,
        key: 0,
        curve: Curve::Step,
        from_s: f32::INFINITY,
        to_s: f32::NEG_INFINITY,
        start_s: f32::INFINITY,
        numbers: [[0.0; 4]; 4],
    };

    /// Decodes the segment that starts at a key. `times` are those of the key and of the next one, if there is one.
    pub(super) fn new<T: Packable>(header: &Header, bytes: &[u8], key: usize, times: [Option<f32>; 2]) -> Self {
        let [start, end] = times.map(|time| time.unwrap_or(f32::INFINITY));
        let mut segment = Self {
            channel: header.channel,
            target: header.target,
            key,
            curve: header.curve,
            from_s: if key == 0 { f32::NEG_INFINITY } else { start },
            to_s: end,
            start_s: if times[1].is_some() { start } else { f32::INFINITY },
            numbers: [[0.0; 4]; 4],
        };
        let mut put = |at: usize, value: T| segment.numbers[at] = value.numbers();
        if header.curve != Curve::Cubic {
            put(0, header.value(bytes, key));
            if times[1].is_some() {
                put(2, header.value(bytes, key + 1));
            }
            return segment;
        }
        let (a, [_, out]) = header.cubic_key::<T>(bytes, key, None);
        put(0, a);
        if times[1].is_some() {
            let (b, [into, _]) = header.cubic_key(bytes, key + 1, Some(a));
            put(1, out.times(end - start));
            put(2, b);
            put(3, into.times(end - start));
        }
        segment
    }

    /// Returns `true` if the segment applies at a time.
    #[inline]
    pub(super) fn holds_at(&self, time_s: f32) -> bool {
        self.from_s <= time_s && time_s < self.to_s
    }

    /// Value at a time; identical to that of the unpacked track.
    #[inline]
    pub(super) fn value<T: Packable>(&self, time_s: f32) -> T {
        let value = T::from_numbers(self.numbers[0]);
        let is_after = time_s > self.start_s;
        let part = (time_s - self.start_s) / (self.to_s - self.start_s);
        match self.curve {
            Curve::Linear if is_after => value.linear(T::from_numbers(self.numbers[2]), part),
            Curve::Step | Curve::Linear => value,
            Curve::Cubic if is_after => hermite(self.numbers.map(T::from_numbers), part).value(value),
            Curve::Cubic => value.value(value),
        }
    }
}

/// Cached segments of a packed clip's tracks, as many as there is room for.
#[derive(Clone, Debug, Default)]
pub(crate) struct Segments {
    segments: Vec<Segment>,
    /// The data that the segments were decoded from. Holding it ensures that no other clip's data gets the same
    /// address.
    data: Option<Arc<[u8]>>,
}

impl Segments {
    /// A cache with room for this many tracks.
    pub(crate) fn with_room(tracks: usize) -> Self {
        Self { segments: alloc::vec![Segment::NONE; tracks], data: None }
    }

    pub(crate) fn room(&self) -> usize {
        self.segments.len()
    }

    /// Returns the segments for this data; those of other data are discarded first.
    pub(super) fn of(&mut self, data: &Arc<[u8]>) -> &mut [Segment] {
        let is_same = self.data.as_ref().is_some_and(|known| Arc::ptr_eq(known, data));
        if !is_same && !self.segments.is_empty() {
            self.segments.fill(Segment::NONE);
            self.data = Some(Arc::clone(data));
        }
        &mut self.segments
    }
}
