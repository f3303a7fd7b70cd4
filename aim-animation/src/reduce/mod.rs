//! [`Reduction`]: fewer and smaller keys within a tolerance in the space of the model. `ends.rs` says where errors are measured,
//! `judge.rs` measures them, `samples.rs` and `prepared.rs` ready a track, `fit.rs` fits it, and `parts.rs` does so for a clip.

mod ends;
mod error;
mod fit;
mod judge;
mod parts;
mod prepared;
mod samples;

use alloc::vec::Vec;

pub use error::ReductionError;
use judge::{Errors, Judge};
use parts::{Factors, Fit, Tracks};
use prepared::Storage;

use crate::clip::Clip;
use crate::float::root;
use crate::packed::{PackedClip, times_of};
use crate::played::Played;
use crate::skeleton::Skeleton;

/// The tolerance of scalars, unless another is given.
const SCALAR_TOLERANCE: f32 = 1e-3;
/// Rounds in which tolerances of tracks are fitted to that of the model.
const ROUNDS: u8 = 8;
/// Times at which clips are judged in these rounds, at most.
const ROUGH_KEYS: usize = 1000;
/// How often tracks are tightened before they stay as they are.
const REPAIRS: u8 = 8;
/// The part of the tolerance that is used, so that rounding does not break it.
const USED: f64 = 0.999;

/// A reduction of clips to fewer keys, within a tolerance.
///
/// **The tolerance holds in the space of the model**, at the ends of the bones: at each bone's origin, at its children's, and at points on its three axes on
/// both sides, its length away, so that leaves and twists count. A bone's length is the distance to its farthest child; that of a leaf its
/// parent's. It holds at every key of the clip, just before it, and at eight points between neighbouring keys, as measured in double precision
/// on the very result. Scalars have a tolerance of their own.
///
/// Tracks that equal the skeleton's rest are dropped: poses start there. Others become constant, steps, straight or cubic (Hermite, knots at uneven
/// times), whichever is smallest. The first and the last key of each track, both sides of jumps, and pins keep their values, rotations of cubic tracks to the
/// last digit; so what was continuous stays so, and a loop's seam is as it was. A track that moves by less than the tolerance becomes constant,
/// one that would not hold it stays as it is.
///
/// For every n-th key, see [`Clip::resampled`].
///
/// ```
/// use aim_animation::glam::Quat;
/// use aim_animation::{Bone, Clip, Reduction, Skeleton, Track};
///
/// let skeleton = Skeleton::new([Bone::new("lever", None)])?;
/// let times: Vec<f32> = (0..=60_u8).map(|k| f32::from(k) / 60.0).collect();
/// let turns: Vec<Quat> = times.iter().map(|t| Quat::from_rotation_z(t * t)).collect();
/// let clip = Clip::new("pull").with_rotation(0, Track::linear(times, turns)?);
///
/// let reduced = Reduction::new(1e-3).with_pins([0.5]).reduce(&clip, &skeleton)?;
/// assert!(reduced.error <= 1e-3 && reduced.clip.bytes() * 4 < clip.bytes());
/// let track = reduced.clip.bone(0).and_then(|tracks| tracks.rotation.as_ref()).unwrap();
/// assert!(track.times().contains(&0.5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Reduction {
    tolerance: f32,
    scalar_tolerance: f32,
    pins: Vec<f32>,
}

/// A clip that was reduced.
#[derive(Clone, Debug, PartialEq)]
pub struct Reduced {
    /// The clip.
    pub clip: Clip,
    /// Its largest error, in units of the model.
    pub error: f32,
    /// Where that is; `None` if there is no error.
    pub at: Option<ErrorPlace>,
}

/// A clip that was reduced and packed.
#[derive(Clone, Debug, PartialEq)]
pub struct Packed {
    /// The clip.
    pub clip: PackedClip,
    /// Its largest error, in units of the model.
    pub error: f32,
    /// Where that is; `None` if there is no error.
    pub at: Option<ErrorPlace>,
}

/// Where an error is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorPlace {
    /// The bone at whose ends it is.
    pub bone: usize,
    /// The time, seconds.
    pub time_s: f32,
}

impl Reduction {
    /// By a tolerance in units of the model; with 0 only what changes nothing is removed. Scalars have 0.001.
    #[must_use]
    pub fn new(tolerance: f32) -> Self {
        Self { tolerance, scalar_tolerance: SCALAR_TOLERANCE, pins: Vec::new() }
    }

    /// With another tolerance of scalars, such as morph weights.
    #[must_use]
    pub fn with_scalar_tolerance(mut self, tolerance: f32) -> Self {
        self.scalar_tolerance = tolerance;
        self
    }

    /// With keys at these times, seconds, at which every track that is changed has the value of the clip: for transitions, contacts and golden
    /// poses. Where a track has no movement, as before its first key, there is none. Packed clips have a key there, whose value is rounded.
    #[must_use]
    pub fn with_pins(mut self, times_s: impl IntoIterator<Item = f32>) -> Self {
        self.pins.extend(times_s);
        self
    }

    /// Reduces a clip. Bones past the skeleton's end stay as they are.
    ///
    /// # Errors
    /// A tolerance or a pin that is negative or not finite.
    pub fn reduce(&self, clip: &Clip, skeleton: &Skeleton) -> Result<Reduced, ReductionError> {
        let (clip, errors) = self.result(clip, skeleton, Storage::Floats, |fit| Some(fit.clip))?;
        let (error, at) = worst(&errors);
        Ok(Reduced { clip, error, at })
    }

    /// Reduces and packs a clip: the tolerance is that of both together. Bones past the skeleton's end stay as they are.
    ///
    /// # Errors
    /// A tolerance or a pin that is negative or not finite, or more keys than fit.
    pub fn pack(&self, clip: &Clip, skeleton: &Skeleton) -> Result<Packed, ReductionError> {
        let storage = Storage::Packed(times_of(clip).len());
        let (clip, errors) = self.result(clip, skeleton, storage, |fit| PackedClip::new(&fit.clip, &fit.grids))?;
        let (error, at) = worst(&errors);
        Ok(Packed { clip, error, at })
    }

    /// The smallest result that was found to hold the tolerance, and its errors.
    fn result<R: Played>(
        &self,
        clip: &Clip,
        skeleton: &Skeleton,
        storage: Storage,
        made: impl Fn(Fit) -> Option<R>,
    ) -> Result<(R, Errors), ReductionError> {
        let (pins, tolerances) = self.checked()?;
        let judge = Judge::new(skeleton, clip, &pins);
        let tracks = Tracks::new(clip, skeleton, (judge.ends(), &pins), tolerances);
        let limits = tolerances.map(|tolerance| USED * f64::from(tolerance));
        let bones = skeleton.len();
        let mut factors =
            Factors { bones: alloc::vec![Some(1.0); bones], scalars: alloc::vec![Some(1.0); clip.scalars().len()] };
        // Tightens and loosens until bones are near the tolerance, and takes the smallest that held it.
        let mut best: Option<(usize, Factors)> = None;
        for _ in 0..ROUNDS {
            let fit = tracks.fitted(&factors, storage);
            let result = made(fit).ok_or(ReductionError::Size)?;
            let errors = judge.at_keys(&result, ROUGH_KEYS);
            let worst_below = worst_below(&errors, skeleton);
            let holds = worst_below.iter().all(|squared| *squared <= limits[0] * limits[0])
                && errors.scalars.iter().all(|error| f64::from(*error) <= limits[1]);
            let bytes = result.bytes();
            if holds && best.as_ref().is_none_or(|(least, _)| bytes < *least) {
                best = Some((bytes, factors.clone()));
            }
            for (factor, squared) in factors.bones.iter_mut().zip(worst_below) {
                let part = ratio(limits[0], squared, 0.95).max(0.5).min(1.4);
                *factor = factor.map(|factor| (factor * part).min(64.0));
            }
            for (factor, error) in factors.scalars.iter_mut().zip(&errors.scalars) {
                let error = f64::from(*error);
                let part = if error <= limits[1] { 1.0 } else { ratio(limits[1], error * error, 0.95).max(0.5) };
                *factor = factor.map(|factor| factor * part);
            }
        }
        let mut factors = best.map_or(factors, |(_, factors)| factors);
        // Tightens what does not hold it everywhere, and in the end leaves it as it is.
        let mut repairs = alloc::vec![0_u8; bones];
        loop {
            let result = made(tracks.fitted(&factors, storage)).ok_or(ReductionError::Size)?;
            let errors = judge.everywhere(&result);
            let mut is_good = true;
            for (bone, squared) in worst_below(&errors, skeleton).into_iter().enumerate() {
                // Not a number is no good either.
                if squared <= limits[0] * limits[0] || factors.bones[bone].is_none() {
                    continue;
                }
                is_good = false;
                repairs[bone] += 1;
                let part = ratio(limits[0], squared, 0.97).max(0.25).min(0.97);
                factors.bones[bone] =
                    factors.bones[bone].filter(|_| repairs[bone] < REPAIRS).map(|factor| factor * part);
            }
            for (factor, error) in factors.scalars.iter_mut().zip(&errors.scalars) {
                if !(f64::from(*error) <= limits[1]) && factor.is_some() {
                    is_good = false;
                    *factor = factor.filter(|factor| *factor > 0.1).map(|factor| 0.5 * factor);
                }
            }
            if is_good {
                return Ok((result, errors));
            }
        }
    }

    /// Pins in their order, and the tolerances of the model and of scalars.
    fn checked(&self) -> Result<(Vec<f32>, [f32; 2]), ReductionError> {
        let tolerances = [self.tolerance, self.scalar_tolerance];
        if let Some(bad) = tolerances.into_iter().find(|tolerance| !(tolerance.is_finite() && *tolerance >= 0.0)) {
            return Err(ReductionError::Tolerance(bad));
        }
        if let Some(bad) = self.pins.iter().copied().find(|pin| !(pin.is_finite() && *pin >= 0.0)) {
            return Err(ReductionError::Pin(bad));
        }
        let mut pins = self.pins.clone();
        // No zero is negative.
        pins.iter_mut().for_each(|pin| *pin += 0.0);
        pins.sort_unstable_by(f32::total_cmp);
        pins.dedup();
        Ok((pins, tolerances))
    }
}

/// The largest square of an error of a bone and of all that hangs on it.
fn worst_below(errors: &Errors, skeleton: &Skeleton) -> Vec<f64> {
    let mut worst: Vec<f64> = errors.bones.iter().map(|error| error.squared).collect();
    for bone in (0..worst.len()).rev() {
        if let Some(parent) = skeleton.parents()[bone] {
            // Not a number stays.
            if !(worst[bone] <= worst[parent]) && !worst[parent].is_nan() {
                worst[parent] = worst[bone];
            }
        }
    }
    worst
}

/// By what an error has to be multiplied to be a part of a limit; 0 of what is not finite.
fn ratio(limit: f64, squared: f64, part: f64) -> f32 {
    let ratio = root(part * part * limit * limit / squared);
    if ratio.is_nan() { 0.0 } else { ratio }
}

/// The largest error and where it is.
fn worst(errors: &Errors) -> (f32, Option<ErrorPlace>) {
    let sizes = errors.bones.iter().map(judge::Error::size).enumerate();
    let worst = sizes.filter(|(_, size)| *size > 0.0).reduce(|a, b| if b.1 > a.1 { b } else { a });
    worst.map_or((0.0, None), |(bone, size)| (size, Some(ErrorPlace { bone, time_s: errors.bones[bone].time_s })))
}
