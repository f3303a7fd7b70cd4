//! [`Samples`]: the points of a track that a fit has to pass.

use alloc::vec::Vec;

use crate::packed::grid::Packable;
use crate::track::{Curve, Track};

/// Number of samples between two knots: for linear tracks, for cubic tracks.
const BETWEEN: [u8; 2] = [2, 4];

/// Values of a track at its keys, at pins and in between.
#[derive(Debug)]
pub(super) struct Samples<T> {
    pub(super) times: Vec<f32>,
    /// Rotations are in one hemisphere from sample to sample.
    pub(super) values: Vec<T>,
    /// The samples at which keys are allowed.
    pub(super) knots: Vec<Knot<T>>,
}

/// A sample at which a key is allowed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Knot<T> {
    /// Index among the samples.
    pub(super) sample: usize,
    /// `true` if there must be a key: at ends, jumps and pins.
    pub(super) is_required: bool,
    /// Velocities of a cubic track on arriving and on leaving.
    pub(super) tangents: Option<[T; 2]>,
}

impl<T: Packable> Samples<T> {
    /// Samples a track, with knots at its keys and at pins, which must be sorted. Step tracks have no samples in
    /// between.
    pub(super) fn of(track: &Track<T>, pins: &[f32]) -> Self {
        let mut samples = Self { times: Vec::new(), values: Vec::new(), knots: Vec::new() };
        let times = track.times();
        let last = times.len() - 1;
        let is_cubic = track.curve() == Curve::Cubic;
        let between = if track.curve() == Curve::Step { 0 } else { BETWEEN[usize::from(is_cubic)] };
        for (k, &time) in times.iter().enumerate() {
            let next = times.get(k + 1).copied();
            let is_jump = next == Some(time) || k > 0 && times[k - 1] == time;
            let is_required =
                k == 0 || k == last || is_jump || pins.binary_search_by(|pin| pin.total_cmp(&time)).is_ok();
            // Use the key's own value: at a jump, sampling at that time gives the second of the two keys only.
            let value = track.values()[k];
            let value = if is_cubic { value.value(value) } else { value };
            let tangents = track.tangents().get(k).copied();
            samples.knot(time, value, is_required, tangents.map(|tangents| (track.values()[k], tangents)));
            let Some(next) = next.filter(|next| *next > time) else { continue };
            // The pins between this key and the next become knots; samples lie between the knots.
            let first = pins.partition_point(|pin| *pin <= time);
            let within = pins[first..].iter().copied().take_while(|pin| *pin < next);
            let mut from = time;
            for to in within.chain([next]) {
                for part in 1..=between {
                    let at = from + (to - from) * (f32::from(part) / f32::from(between + 1));
                    if from < at && at < to {
                        samples.push(at, track.sample(at));
                    }
                }
                if to < next {
                    let velocity =
                        is_cubic.then(|| track.point_and_velocity(to)).map(|(value, velocity)| (value, [velocity; 2]));
                    samples.knot(to, track.sample(to), true, velocity);
                }
                from = to;
            }
        }
        samples
    }

    fn push(&mut self, time: f32, value: T) {
        self.times.push(time);
        self.values.push(self.values.last().map_or(value, |last| value.near(*last)));
    }

    fn knot(&mut self, time: f32, value: T, is_required: bool, of_track: Option<(T, [T; 2])>) {
        self.push(time, value);
        let sample = self.times.len() - 1;
        let tangents = of_track.map(|(of_track, tangents)| {
            // Give the tangents the sign of the value.
            let sign = if of_track.near(self.values[sample]) == of_track { 1.0 } else { -1.0 };
            tangents.map(|tangent| tangent.times(sign))
        });
        self.knots.push(Knot { sample, is_required, tangents });
    }

    pub(super) fn time(&self, knot: usize) -> f32 {
        self.times[self.knots[knot].sample]
    }

    pub(super) fn value(&self, knot: usize) -> T {
        self.values[self.knots[knot].sample]
    }

    /// Estimates the velocity at each knot by the parabola through it and the knots `width` before and after; one-sided
    /// at jumps and ends.
    pub(super) fn velocities(&self, width: usize) -> Vec<[T; 2]> {
        let count = self.knots.len();
        // First knot of the run without jumps that contains each knot.
        let mut starts: Vec<usize> = Vec::with_capacity(count);
        for k in 0..count {
            let goes_on = k > 0 && self.time(k) > self.time(k - 1);
            starts.push(if goes_on { starts[k - 1] } else { k });
        }
        let mut ends: Vec<usize> = (0..count).collect();
        for k in (0..count.saturating_sub(1)).rev() {
            if starts[k + 1] == starts[k] {
                ends[k] = ends[k + 1];
            }
        }
        let none = self.values[0].times(0.0);
        let slope = |a: usize, b: usize| {
            let way = self.value(b).plus(self.value(a).times(-1.0));
            way.times(1.0 / (self.time(b) - self.time(a)))
        };
        let velocity = |k: usize| {
            let (low, high) = (starts[k], ends[k]);
            if low == high {
                return none;
            }
            // Central difference: three knots, with this one in the middle, if possible.
            let before = k.saturating_sub(width).max(low);
            let after = (k + width).min(high);
            if before < k && k < after {
                let (h_a, h_b) = (self.time(k) - self.time(before), self.time(after) - self.time(k));
                let sum = h_a + h_b;
                return slope(before, k).times(h_b / sum).plus(slope(k, after).times(h_a / sum));
            }
            // One-sided difference towards the inside: s₁ + (s₁ − s₂)·h₁ / (h₁ + h₂).
            let near = if k == low { (k + width).min(high) } else { k.saturating_sub(width).max(low) };
            let far = if k == low { (near + width).min(high) } else { near.saturating_sub(width).max(low) };
            if near == far {
                return slope(k.min(near), k.max(near));
            }
            let (first, second) = (slope(k.min(near), k.max(near)), slope(near.min(far), near.max(far)));
            let (h_1, h_2) =
                (self.time(k.max(near)) - self.time(k.min(near)), self.time(near.max(far)) - self.time(near.min(far)));
            first.plus(first.plus(second.times(-1.0)).times(h_1 / (h_1 + h_2)))
        };
        (0..count).map(|k| [velocity(k); 2]).collect()
    }
}
