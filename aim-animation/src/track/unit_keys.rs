//! Conversion of cubic rotation tracks to unit keys.

use alloc::vec::Vec;

use aim_runtime::glam::Quat;
use aim_runtime::rotation::{dot, unit};

use super::{Curve, Track, hermite, hermite_slope};

/// Error up to which an interval is not divided: a chord of unit quaternions, half of the angle of 1e-5 radians.
const MOST_OFF: f32 = 0.5e-5;
/// Maximum number of times an interval is halved; each halving divides the error by about 2⁴.
const MOST_HALVINGS: u8 = 6;

impl Track<Quat> {
    /// Returns the same rotations with unit keys, as file formats require, to within 2e-5 radians. A non-unit key of a
    /// cubic track, which results from a [cut](Track::cut), is normalised; keys are added next to it until the error is
    /// small enough.
    ///
    /// ```
    /// use aim_animation::glam::Quat;
    /// use aim_animation::{HermiteKey, Track};
    ///
    /// let still = Quat::from_xyzw(0.0, 0.0, 0.0, 0.0);
    /// let keys = [0.0, 2.0].map(|angle| HermiteKey { value: Quat::from_rotation_x(angle), into: still, out: still });
    /// let cut = Track::hermite([0.0, 1.0], &keys)?.cut(0.5, 1.0);
    /// assert!(cut.values()[0].length() < 0.9);
    /// let track = cut.with_unit_keys();
    /// assert!(track.values().iter().all(|rotation| rotation.is_normalized()));
    /// # Ok::<(), aim_animation::TrackError>(())
    /// ```
    #[must_use]
    pub fn with_unit_keys(&self) -> Self {
        let is_unit = |value: Quat| (dot(value, value) - 1.0).abs() < 1e-6;
        if self.curve != Curve::Cubic || self.values.iter().all(|value| is_unit(*value)) {
            return self.clone();
        }
        let (mut times, mut keys): (Vec<f32>, Vec<(Quat, [Quat; 2])>) = (Vec::new(), Vec::new());
        let mut into = self.tangents[0][0];
        for (k, &time) in self.times.iter().enumerate() {
            let value = unit(self.values[k]).unwrap_or(Quat::IDENTITY);
            let next = self.times.get(k + 1).map_or(time, |next| *next);
            let is_kept = !(time < next) || is_unit(self.values[k]) && is_unit(self.values[k + 1]);
            times.push(time);
            if is_kept {
                keys.push((value, [into, self.tangents[k][1]]));
                into = self.tangents.get(k + 1).map_or(into, |tangents| tangents[0]);
                continue;
            }
            let piece = Piece { segment: self.segment(k), interval: next - time };
            let mut cuts = Vec::new();
            piece.divide([0.0, 1.0], MOST_HALVINGS, &mut cuts);
            keys.push((value, [into, piece.unit_at(0.0).1]));
            for part in cuts {
                let at = time + part * piece.interval;
                if times.last().is_some_and(|last| *last < at) && at < next {
                    let (value, velocity) = piece.unit_at(part);
                    times.push(at);
                    keys.push((value, [velocity; 2]));
                }
            }
            into = piece.unit_at(1.0).1;
        }
        let (values, tangents) = keys.into_iter().unzip();
        Self::assembled(times.into(), values, tangents, Curve::Cubic).unwrap_or_else(|| self.clone())
    }
}

/// A curve between two keys, and its duration in seconds.
struct Piece {
    segment: [Quat; 4],
    interval: f32,
}

impl Piece {
    /// Rotation and its velocity per second at a fraction of the interval: q = p/|p|, q′ = (p′ − q·(q·p′))/|p|.
    fn unit_at(&self, part: f32) -> (Quat, Quat) {
        let (point, slope) = (hermite(self.segment, part), hermite_slope(self.segment, part));
        let Some(value) = unit(point) else { return (Quat::IDENTITY, slope * 0.0) };
        let across = slope - value * dot(value, slope);
        (value, across * (1.0 / (dot(value, point) * self.interval)))
    }

    /// Collects the parts at which keys are needed so that cubics between unit keys are accurate enough.
    fn divide(&self, [from, to]: [f32; 2], halvings: u8, cuts: &mut Vec<f32>) {
        let seconds = (to - from) * self.interval;
        let ([(a, out), (b, into)], middle) = ([from, to].map(|part| self.unit_at(part)), 0.5 * (from + to));
        let unit_segment = [a, out * seconds, b, into * seconds];
        let is_near = |part: f32| {
            let rotation = unit(hermite(unit_segment, part)).unwrap_or(Quat::IDENTITY);
            let chord = rotation - self.unit_at(from + part * (to - from)).0;
            dot(chord, chord) <= MOST_OFF * MOST_OFF
        };
        if halvings > 0 && ![0.25, 0.5, 0.75].into_iter().all(is_near) {
            self.divide([from, middle], halvings - 1, cuts);
            cuts.push(middle);
            self.divide([middle, to], halvings - 1, cuts);
        }
    }
}
