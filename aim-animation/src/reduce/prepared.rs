//! [`Prepared`]: a track and the data that all of its fits share.

use alloc::sync::Arc;
use alloc::vec::Vec;

use super::fit::{self, FitBound};
use super::samples::Samples;
use crate::packed::grid::{Grid, Packable, exponent_of};
use crate::packed::layout::bits_of;
use crate::track::{Curve, Track};

/// Widths, in keys to each side, of the neighbourhoods from which the velocities at keys of linear tracks are
/// estimated.
const WIDTHS: [usize; 3] = [1, 2, 4];
/// Largest fraction of a tolerance that rounding of values may use.
const VALUE_ROUNDING: f32 = 0.4;
/// Largest fraction of a tolerance that rounding of tangents may use.
const TANGENT_ROUNDING: f32 = 0.15;

/// Storage of the result, which determines what is smallest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Storage {
    /// Unpacked, as floats.
    Floats,
    /// Packed, in a clip with this many key times.
    Packed(usize),
}

/// A track and its samples.
#[derive(Debug)]
pub(super) struct Prepared<'a, T> {
    track: &'a Track<T>,
    samples: Samples<T>,
    /// Candidate velocities at the knots.
    velocities: Vec<Vec<[T; 2]>>,
    pins: &'a [f32],
    omitted_component: u8,
    /// Longest segment expected, seconds.
    segment_s: f32,
    /// Index of the bone, or number of the scalar.
    target: usize,
}

/// A fitted track.
#[derive(Clone, Debug)]
pub(super) struct Fitted<T> {
    pub(super) track: Track<T>,
    /// Grid on which its keys lie, if any.
    pub(super) grid: Option<Grid>,
}

impl<'a, T: Packable> Prepared<'a, T> {
    pub(super) fn new(target: usize, track: &'a Track<T>, pins: &'a [f32]) -> Self {
        let samples = Samples::of(track, pins);
        let own: Option<Vec<[T; 2]>> = samples.knots.iter().map(|knot| knot.tangents).collect();
        let velocities = match (track.curve(), own) {
            (Curve::Cubic, Some(own)) => alloc::vec![own],
            (Curve::Linear, _) => WIDTHS.iter().map(|width| samples.velocities(*width)).collect(),
            _ => Vec::new(),
        };
        let (times, knots) = (track.times(), samples.knots.len());
        #[expect(clippy::cast_precision_loss, reason = "a rough length")]
        let segment_s = 8.0 * (track.end_s() - times[0]) / knots as f32;
        let omitted_component = T::omitted_component_of(&samples.values);
        Self { track, samples, velocities, pins, omitted_component, segment_s, target }
    }

    /// Returns `true` if every sample is within `tolerance` of the first.
    pub(super) fn is_constant(&self, tolerance: f32) -> bool {
        let bound = FitBound { squared: tolerance * tolerance, grid: None };
        self.samples.values.iter().all(|value| bound.holds(*value, self.samples.values[0]))
    }

    /// Returns `true` if every sample is within `tolerance` of `value`.
    pub(super) fn is_everywhere(&self, value: T, tolerance: f32) -> bool {
        let bound = FitBound { squared: tolerance * tolerance, grid: None };
        self.samples.values.iter().all(|sample| bound.holds(value, *sample))
    }

    /// The unchanged track.
    pub(super) fn original(&self) -> Fitted<T> {
        Fitted { track: self.track.clone(), grid: None }
    }

    /// Returns the smallest track within the tolerance.
    pub(super) fn fitted(&self, tolerance: f32, storage: Storage) -> Fitted<T> {
        let grid = match storage {
            Storage::Floats => None,
            Storage::Packed(_) => self.grid(tolerance),
        };
        let bound = FitBound { squared: tolerance * tolerance, grid };
        if let Some(track) = fit::constant(self.track, &self.samples, self.pins, &bound) {
            return Fitted { track, grid };
        }
        let tracks = if self.track.curve() == Curve::Step {
            alloc::vec![fit::steps(&self.samples, &bound)]
        } else {
            let cubics = self.velocities.iter().map(|velocities| fit::cubics(&self.samples, velocities, &bound));
            core::iter::once(fit::lines(&self.samples, &bound)).chain(cubics).collect()
        };
        let fitted = tracks.into_iter().flatten().map(|track| Fitted { track, grid });
        let size = |fitted: &Fitted<T>| match storage {
            Storage::Floats => {
                // The original's times may be shared with other tracks, so using them costs nothing.
                let has_own = !Arc::ptr_eq(fitted.track.shared_times(), self.track.shared_times());
                fitted.track.value_bytes() + if has_own { 4 * fitted.track.times().len() } else { 0 }
            }
            Storage::Packed(times) => bits_of(self.target, &fitted.track, fitted.grid, times),
        };
        // Of equal sizes the first wins. The original comes last; if it lacks a pin's key, it is used only if nothing
        // else fits.
        let is_pinned = self.samples.knots.len() > self.track.times().len();
        let original = Some(self.original()).filter(|_| !is_pinned);
        fitted.chain(original).min_by_key(size).unwrap_or_else(|| self.original())
    }

    /// Chooses a grid whose rounding uses its fraction of a tolerance; `None` if floats are needed for that precision.
    fn grid(&self, tolerance: f32) -> Option<Grid> {
        // Rounding errs by half a step in each component: √3/2 of a step for a vector, and twice that as the angle of a
        // rotation.
        let step = tolerance * if T::NUMBERS == 4 { 0.577 } else { 1.155 };
        let exponent = exponent_of(VALUE_ROUNDING * step, T::FINEST + 1);
        // A tangent contributes at most max u(1−u)² = 4/27 of tangent × interval.
        let tangent_step = TANGENT_ROUNDING * step * 6.75 / self.segment_s;
        let tangent_exponent = exponent_of(tangent_step, T::FINEST + 1).min(T::FINEST);
        (exponent <= T::FINEST).then_some(Grid {
            exponent,
            tangent_exponent,
            omitted_component: self.omitted_component,
        })
    }
}
