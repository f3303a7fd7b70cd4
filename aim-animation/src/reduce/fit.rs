//! Fits one track: fewer keys, with each segment as long as the tolerance allows.

use alloc::vec::Vec;

use super::samples::Samples;
use crate::packed::grid::{Grid, Packable};
use crate::track::{Curve, Track, hermite};

/// Constraints on a fit.
#[derive(Clone, Copy, Debug)]
pub(super) struct FitBound {
    /// Square of the tolerance: of a distance for vectors, of an angle for rotations.
    pub(super) squared: f32,
    /// Grid on which values and tangents must lie, if any.
    pub(super) grid: Option<Grid>,
}

impl FitBound {
    fn value<T: Packable>(&self, value: T) -> Option<T> {
        self.grid.map_or(Some(value), |grid| grid.value(value))
    }

    fn tangent<T: Packable>(&self, value: T, tangent: T) -> Option<T> {
        self.grid.map_or(Some(tangent), |grid| grid.tangent(value, tangent))
    }

    /// Returns `true` if two values agree within the tolerance.
    pub(super) fn holds<T: Packable>(&self, value: T, other: T) -> bool {
        value.distance_squared(other) <= self.squared
    }
}

/// Fits a track with a single key: within the tolerance everywhere, and exact at pins.
pub(super) fn constant<T: Packable>(
    track: &Track<T>,
    samples: &Samples<T>,
    pins: &[f32],
    bound: &FitBound,
) -> Option<Track<T>> {
    // The value at the pins if there are any, else the first value.
    let pinned: Vec<T> = pins.iter().map(|pin| track.sample(*pin)).collect();
    let value = pinned.first().copied().unwrap_or(samples.values[0]);
    if pinned.iter().any(|other| other.near(value) != value) {
        return None;
    }
    let value = bound.value(value)?;
    let holds = samples.values.iter().all(|sample| bound.holds(value, *sample));
    holds.then(|| Track::assembled([samples.times[0]].into(), alloc::vec![value], Vec::new(), Curve::Step))?
}

/// Fits a step track by dropping the steps that change nothing within the tolerance.
pub(super) fn steps<T: Packable>(samples: &Samples<T>, bound: &FitBound) -> Option<Track<T>> {
    let (mut times, mut values) = (Vec::new(), Vec::<T>::new());
    for (k, knot) in samples.knots.iter().enumerate() {
        let exact = samples.value(k);
        if !knot.is_required && values.last().is_some_and(|last| bound.holds(*last, exact)) {
            continue;
        }
        let value = bound.value(exact)?;
        if !bound.holds(value, exact) {
            return None;
        }
        times.push(samples.times[knot.sample]);
        values.push(value);
    }
    Track::assembled(times.into(), values, Vec::new(), Curve::Step)
}

/// Fits linear segments between as few knots as possible.
pub(super) fn lines<T: Packable>(samples: &Samples<T>, bound: &FitBound) -> Option<Track<T>> {
    let values: Option<Vec<T>> = (0..samples.knots.len()).map(|k| bound.value(samples.value(k))).collect();
    let values = values?;
    let knots = choose_knots(samples, |from, to| {
        let [first, last] = [from, to].map(|k| samples.knots[k].sample);
        let (start, interval) = (samples.times[first], samples.times[last] - samples.times[first]);
        (first..=last).all(|sample| {
            let part = (samples.times[sample] - start) / interval;
            bound.holds(values[from].linear(values[to], part), samples.values[sample])
        })
    })?;
    let times: Vec<f32> = knots.iter().map(|&k| samples.time(k)).collect();
    Track::assembled(times.into(), knots.iter().map(|&k| values[k]).collect(), Vec::new(), Curve::Linear)
}

/// Fits cubic segments between as few knots as possible, with the given velocities at the knots.
pub(super) fn cubics<T: Packable>(samples: &Samples<T>, velocities: &[[T; 2]], bound: &FitBound) -> Option<Track<T>> {
    let mut keys: Vec<(T, [T; 2])> = Vec::with_capacity(samples.knots.len());
    for (k, [into, out]) in velocities.iter().enumerate() {
        let value = bound.value(samples.value(k))?;
        let into = bound.tangent(value, *into)?;
        let out = bound.tangent(value, *out)?;
        keys.push((value, [into, out]));
    }
    let knots = choose_knots(samples, |from, to| {
        let [first, last] = [from, to].map(|k| samples.knots[k].sample);
        let (start, interval) = (samples.times[first], samples.times[last] - samples.times[first]);
        let ((a, [_, out]), (b, [into, _])) = (keys[from], keys[to]);
        // Choose the sign as sampling does, packed or not.
        let sign = if b.near(a) == b { 1.0 } else { -1.0 };
        let segment = [a, out.times(interval), b.times(sign), into.times(sign * interval)];
        (first..=last).all(|sample| {
            let part = (samples.times[sample] - start) / interval;
            bound.holds(hermite(segment, part).value(a), samples.values[sample])
        })
    })?;
    let times: Vec<f32> = knots.iter().map(|&k| samples.time(k)).collect();
    let (mut values, mut tangents) = (Vec::<T>::new(), Vec::new());
    for &k in &knots {
        let (value, of_key) = keys[k];
        let near = values.last().map_or(value, |last| value.near(*last));
        let sign = if near == value { 1.0 } else { -1.0 };
        values.push(near);
        tangents.push(of_key.map(|tangent| tangent.times(sign)));
    }
    Track::assembled(times.into(), values, tangents, Curve::Cubic)
}

/// Chooses knots greedily, each segment as long as `fits` allows. `None` if even neighbouring knots do not fit.
fn choose_knots<T: Packable>(samples: &Samples<T>, fits: impl Fn(usize, usize) -> bool) -> Option<Vec<usize>> {
    let last = samples.knots.len() - 1;
    // For each knot, the next one that must be a key.
    let mut limits: Vec<usize> = alloc::vec![last; last + 1];
    for k in (0..last).rev() {
        limits[k] = if samples.knots[k + 1].is_required { k + 1 } else { limits[k + 1] };
    }
    let mut knots = alloc::vec![0];
    let mut from = 0;
    while from < last {
        let limit = limits[from];
        let to = if samples.time(from + 1) <= samples.time(from) {
            // The segment is a jump.
            from + 1
        } else {
            farthest(from, limit, |to| fits(from, to))?
        };
        knots.push(to);
        from = to;
    }
    Some(knots)
}

/// Returns the farthest index after `from` that fits, found by doubling and then halving the step.
fn farthest(from: usize, limit: usize, fits: impl Fn(usize) -> bool) -> Option<usize> {
    let mut good = from + 1;
    if !fits(good) {
        return None;
    }
    let mut step = 1;
    while good < limit && fits((good + step).min(limit)) {
        good = (good + step).min(limit);
        step *= 2;
    }
    while step > 0 && good < limit {
        let next = good + step;
        if next <= limit && fits(next) {
            good = next;
        }
        step /= 2;
    }
    Some(good)
}
