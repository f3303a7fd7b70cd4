//! [`Track`]: a value over time, given by keys. `value.rs` defines values, `key.rs` cubic keys, and `error.rs` the
//! errors. `edit.rs` makes tracks from tracks, `looped.rs` matches the ends of loops, `unit_keys.rs` normalises the
//! keys of cubic rotations.

mod edit;
mod error;
mod key;
mod looped;
mod unit_keys;
mod value;

use alloc::sync::Arc;
use alloc::vec::Vec;

pub use error::TrackError;
pub use key::{BezierKey, HermiteKey};
pub use looped::Continuity;
pub use value::Value;
pub(crate) use value::sealed::Arithmetic;

/// Interpolation between the keys of a track.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Curve {
    /// The value is constant until the next key.
    Step,
    /// Linear; rotations take the shorter way at constant speed.
    Linear,
    /// Cubic Hermite splines. Bézier segments and Catmull-Rom splines are converted to these.
    Cubic,
}

/// A value over time, given by keys. Times are seconds of the clip's local time.
///
/// Times do not decrease. Two keys may share a time: there the value jumps from the first to the second. The value is
/// constant before the first key and after the last. Every sample is finite, and rotations are unit, at any time
/// including NaN: the constructors validate everything that sampling depends on.
///
/// ```
/// use aim_animation::{Track, TrackError};
/// use aim_animation::glam::Vec3;
///
/// let track = Track::linear([0.0, 1.0, 3.0], [Vec3::ZERO, Vec3::X, Vec3::Y])?;
/// assert_eq!(track.sample(0.25), Vec3::X * 0.25);
/// assert_eq!(Track::linear([0.0, 2.0, 1.0], [0.0, 1.0, 2.0]), Err(TrackError::Order(2)));
/// # Ok::<(), TrackError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Track<T> {
    times: Arc<[f32]>,
    values: Vec<T>,
    /// Velocities of a cubic track on arriving and on leaving; empty for other curves.
    tangents: Vec<[T; 2]>,
    curve: Curve,
}

impl<T: Value> Track<T> {
    /// A track with the same value at all times.
    ///
    /// # Errors
    /// The value is not finite, exceeds 1e15, or is a quaternion of length 0.
    pub fn constant(value: T) -> Result<Self, TrackError> {
        Self::step([0.0], [value])
    }

    /// A step track: each value is held until the next key.
    ///
    /// # Errors
    /// See [`TrackError`]; returns the first error found.
    pub fn step(times: impl Into<Arc<[f32]>>, values: impl Into<Vec<T>>) -> Result<Self, TrackError> {
        Self::plain(times.into(), values.into(), Curve::Step)
    }

    /// A linear track; rotations take the shorter way at constant speed. Tracks may share their times.
    ///
    /// # Errors
    /// See [`TrackError`]; returns the first error found.
    pub fn linear(times: impl Into<Arc<[f32]>>, values: impl Into<Vec<T>>) -> Result<Self, TrackError> {
        Self::plain(times.into(), values.into(), Curve::Linear)
    }

    /// A cubic Hermite spline. `into` of the first key and `out` of the last have no effect.
    ///
    /// Rotations are interpolated as given: neighbours in opposite hemispheres take the longer way.
    ///
    /// # Errors
    /// See [`TrackError`]; returns the first error found.
    pub fn hermite(times: impl Into<Arc<[f32]>>, keys: &[HermiteKey<T>]) -> Result<Self, TrackError> {
        let values = keys.iter().map(|key| key.value).collect();
        let tangents = keys.iter().map(|key| [key.into, key.out]).collect();
        Self::cubic(times.into(), values, tangents)
    }

    /// A track of cubic Bézier segments. `before` of the first key and `after` of the last have no effect.
    ///
    /// # Errors
    /// See [`TrackError`]; returns the first error found.
    pub fn bezier(times: impl Into<Arc<[f32]>>, keys: &[BezierKey<T>]) -> Result<Self, TrackError> {
        let times = times.into();
        check_times(&times, keys.len())?;
        // Velocity at an end = 3 · (control point − end) / duration of the segment.
        let velocity = |from: T, to: T, interval: f32| {
            let way = to.plus(from.times(-1.0));
            if interval > 0.0 { way.times(3.0 / interval) } else { way.times(0.0) }
        };
        let mut tangents = Vec::with_capacity(keys.len());
        for (k, key) in keys.iter().enumerate() {
            let none = key.value.times(0.0);
            let into = if k == 0 { none } else { velocity(key.before, key.value, times[k] - times[k - 1]) };
            let out = if k + 1 == keys.len() { none } else { velocity(key.value, key.after, times[k + 1] - times[k]) };
            tangents.push([into, out]);
        }
        Self::cubic(times, keys.iter().map(|key| key.value).collect(), tangents)
    }

    /// A Catmull-Rom spline through the values, for keys at uneven times. The velocity at a key is that of the parabola
    /// through it and its neighbours; at the ends, and next to a jump, that of the line to the only neighbour.
    ///
    /// Rotations take the shorter way from key to key.
    ///
    /// # Errors
    /// See [`TrackError`]; returns the first error found.
    pub fn catmull_rom(times: impl Into<Arc<[f32]>>, values: impl Into<Vec<T>>) -> Result<Self, TrackError> {
        let Self { times, mut values, .. } = Self::linear(times, values)?;
        for k in 1..values.len() {
            values[k] = values[k].near(values[k - 1]);
        }
        let slope = |k: usize| values[k + 1].plus(values[k].times(-1.0)).times(1.0 / (times[k + 1] - times[k]));
        let interval = |k: usize| times[k + 1] - times[k];
        let tangents = (0..values.len()).map(|k| {
            let before = k.checked_sub(1).filter(|&k| interval(k) > 0.0);
            let after = (k + 1 < values.len() && interval(k) > 0.0).then_some(k);
            let tangent = match (before, after) {
                (Some(a), Some(b)) => {
                    let (h_a, h_b) = (interval(a), interval(b));
                    let sum = h_a + h_b;
                    slope(a).times(h_b / sum).plus(slope(b).times(h_a / sum))
                }
                (Some(only), None) | (None, Some(only)) => slope(only),
                (None, None) => values[k].times(0.0),
            };
            [tangent; 2]
        });
        let tangents = tangents.collect();
        Self::cubic(times, values, tangents)
    }

    /// Interpolation between the keys.
    #[must_use]
    pub fn curve(&self) -> Curve {
        self.curve
    }

    /// Times of the keys, seconds.
    #[must_use]
    pub fn times(&self) -> &[f32] {
        &self.times
    }

    /// Values of the keys. Rotations are unit, except where a cubic track was [cut](Self::cut); see
    /// [`with_unit_keys`](Track::with_unit_keys).
    #[must_use]
    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// Velocities of a cubic track's keys on arriving and on leaving, per second; empty for other curves.
    #[must_use]
    pub fn tangents(&self) -> &[[T; 2]] {
        &self.tangents
    }

    /// Time of the last key, seconds.
    #[must_use]
    pub fn end_s(&self) -> f32 {
        self.times.last().copied().unwrap_or_default()
    }

    /// Size of the values and tangents, bytes. Times are not included, because tracks may share them.
    pub(crate) fn value_bytes(&self) -> usize {
        size_of::<T>() * self.values.len() + 2 * size_of::<T>() * self.tangents.len()
    }

    /// Replaces the times by equal ones in `known`, or adds them to `known`.
    pub(crate) fn share_times(&mut self, known: &mut Vec<Arc<[f32]>>) {
        match known.iter().find(|times| **times == self.times) {
            Some(times) => self.times = Arc::clone(times),
            None => known.push(Arc::clone(&self.times)),
        }
    }

    /// The times, with shared ownership.
    pub(crate) fn shared_times(&self) -> &Arc<[f32]> {
        &self.times
    }

    /// Returns the value at a time. NaN is treated as before the first key.
    #[must_use]
    pub fn sample(&self, time_s: f32) -> T {
        self.sample_near(time_s, &mut 0)
    }

    /// Returns the value at a time, like [`sample`](Self::sample). `key` is a hint, the index of the key found in the
    /// last call; it may have any value, and only saves the search.
    #[inline]
    pub fn sample_near(&self, time_s: f32, key: &mut usize) -> T {
        *key = self.key_before(time_s, *key);
        let k = *key;
        let value = self.values[k];
        // Before the first key, after the last, and at NaN.
        if !(time_s > self.times[k]) || k + 1 == self.values.len() || self.curve == Curve::Step {
            // A rotation of a cubic track that was cut need not be unit.
            return if self.curve == Curve::Cubic { value.value(value) } else { value };
        }
        let part = (time_s - self.times[k]) / (self.times[k + 1] - self.times[k]);
        if self.curve == Curve::Linear {
            return value.linear(self.values[k + 1], part);
        }
        hermite(self.segment(k), part).value(value)
    }

    /// Assembles a track from parts, which are kept bit for bit; `None` unless a constructor or a cut could have made
    /// them.
    pub(crate) fn assembled(times: Arc<[f32]>, values: Vec<T>, tangents: Vec<[T; 2]>, curve: Curve) -> Option<Self> {
        check_times(&times, values.len()).ok()?;
        let is_cubic = curve == Curve::Cubic;
        if tangents.len() != if is_cubic { values.len() } else { 0 } {
            return None;
        }
        for (k, value) in values.iter().enumerate() {
            let (_, factor) = value.key()?;
            // Rotations of a cubic track that was cut need not be unit.
            if !is_cubic && !((factor - 1.0).abs() < 1e-5) {
                return None;
            }
            let mut of_key = tangents.get(k).into_iter().flatten().zip(intervals(&times, k));
            if !of_key.all(|(tangent, interval)| is_bounded(*tangent, interval)) {
                return None;
            }
        }
        Some(Self { times, values, tangents, curve })
    }

    /// Value and velocity of a cubic track before rotations are normalised. Outside the keys the velocity is zero.
    pub(crate) fn point_and_velocity(&self, time_s: f32) -> (T, T) {
        let k = self.key_before(time_s, 0);
        if k + 1 == self.values.len() || !(time_s >= self.times[k]) {
            return (self.values[k], self.values[k].times(0.0));
        }
        let interval = self.times[k + 1] - self.times[k];
        let u = (time_s - self.times[k]) / interval;
        let segment = self.segment(k);
        (hermite(segment, u), hermite_slope(segment, u).times(1.0 / interval))
    }

    /// The cubic segment after key `k`: value and tangent at that key and at the next, for a parameter in 0…1.
    pub(crate) fn segment(&self, k: usize) -> [T; 4] {
        let interval = self.times[k + 1] - self.times[k];
        let [out, into] = [self.tangents[k][1], self.tangents[k + 1][0]].map(|tangent| tangent.times(interval));
        [self.values[k], out, self.values[k + 1], into]
    }

    /// Index of the last key that is not after a time; 0 if there is none.
    #[inline]
    fn key_before(&self, time_s: f32, hint: usize) -> usize {
        let times = &self.times[..];
        let is_at = |k: usize| times[k] <= time_s && times.get(k + 1).is_none_or(|next| time_s < *next);
        // In forward playback, the key is the one found last or the next.
        if hint < times.len() && times[hint] <= time_s {
            if is_at(hint) {
                return hint;
            } else if is_at(hint + 1) {
                return hint + 1;
            }
        }
        times.partition_point(|time| *time <= time_s).saturating_sub(1)
    }

    fn plain(times: Arc<[f32]>, mut values: Vec<T>, curve: Curve) -> Result<Self, TrackError> {
        check_times(&times, values.len())?;
        for (k, value) in values.iter_mut().enumerate() {
            *value = value.key().ok_or(TrackError::Value(k))?.0;
        }
        Ok(Self { times, values, tangents: Vec::new(), curve })
    }

    fn cubic(times: Arc<[f32]>, mut values: Vec<T>, mut tangents: Vec<[T; 2]>) -> Result<Self, TrackError> {
        check_times(&times, values.len())?;
        for (k, value) in values.iter_mut().enumerate() {
            let (checked, factor) = value.key().ok_or(TrackError::Value(k))?;
            *value = checked;
            // Set the tangents without effect to 0.
            for (tangent, interval) in tangents[k].iter_mut().zip(intervals(&times, k)) {
                *tangent = if interval > 0.0 { tangent.times(factor) } else { value.times(0.0) };
                if !is_bounded(*tangent, interval) {
                    return Err(TrackError::Tangent(k));
                }
            }
        }
        Ok(Self { times, values, tangents, curve: Curve::Cubic })
    }
}

/// Cubic from `a` to `b` with derivatives `out` and `into` at the ends, for a parameter in 0…1.
pub(crate) fn hermite<T: Value>([a, out, b, into]: [T; 4], u: f32) -> T {
    let v = 1.0 - u;
    // H₀ = v²(1 + 2u), H₁ = u·v², H₂ = u²(1 + 2v), H₃ = −u²·v.
    let ends = a.times(v * v * (1.0 + 2.0 * u)).plus(b.times(u * u * (1.0 + 2.0 * v)));
    ends.plus(out.times(u * v * v)).plus(into.times(-u * u * v))
}

/// Derivative of [`hermite`] with respect to its parameter.
pub(crate) fn hermite_slope<T: Value>([a, out, b, into]: [T; 4], u: f32) -> T {
    let way = b.plus(a.times(-1.0)).times(6.0 * u * (1.0 - u));
    way.plus(out.times(1.0 - u * (4.0 - 3.0 * u))).plus(into.times(u * (3.0 * u - 2.0)))
}

/// Durations from the previous key to key `k` and from there to the next; 0 at the ends.
fn intervals(times: &[f32], k: usize) -> [f32; 2] {
    let after = |k: usize| times.get(k + 1).map_or(0.0, |next| next - times[k]);
    [k.checked_sub(1).map_or(0.0, after), after(k)]
}

/// Returns `true` if a tangent is within bounds, both by itself and multiplied by its interval, as in sampling.
fn is_bounded<T: Value>(tangent: T, interval: f32) -> bool {
    tangent.times(interval).bounded() && tangent.times(1e-12).bounded()
}

fn check_times(times: &[f32], values: usize) -> Result<(), TrackError> {
    if times.len() != values {
        return Err(TrackError::Lengths { times: times.len(), values });
    }
    if times.is_empty() {
        return Err(TrackError::Empty);
    }
    for (k, time) in times.iter().enumerate() {
        if !(time.is_finite() && *time >= 0.0) {
            return Err(TrackError::Time(k));
        }
        let before = |by: usize| k.checked_sub(by).map(|k| times[k]);
        if before(1).is_some_and(|before| before > *time) || before(2).is_some_and(|before| before >= *time) {
            return Err(TrackError::Order(k));
        }
    }
    Ok(())
}
