//! [`Reduction`]: fewer and smaller keys within a tolerance in model space. `bone_ends.rs` defines where errors are
//! measured, `judge.rs` measures them, `samples.rs` and `prepared.rs` prepare a track, `fit.rs` fits a track, and
//! `parts.rs` fits a whole clip.

mod bone_ends;
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
use crate::playable::PlayableClip;
use crate::skeleton::Skeleton;

/// Default tolerance of scalars.
const SCALAR_TOLERANCE: f32 = 1e-3;
/// Number of iterations that adapt the tolerances of tracks to the tolerance in model space.
const ROUNDS: u8 = 8;
/// Maximum number of keys at which a clip is measured in these iterations.
const ROUGH_KEYS: usize = 1000;
/// Number of times a bone's tolerance is tightened before its tracks are left unchanged.
const REPAIRS: u8 = 8;
/// Fraction of the tolerance that is used, which leaves a margin for rounding.
const USED: f64 = 0.999;

/// Reduction of clips to fewer keys within a tolerance.
///
/// **The tolerance holds in model space**, at the ends of the bones: the origin of each bone, its children's origins,
/// and on both sides of each of its three axes a point at the bone's length, so that leaves and twists are included. A
/// bone's length is the distance to its farthest child; a leaf has its parent's length. Errors are measured in double
/// precision on the final result: at every key of the clip, just before it, and at eight points between neighbouring
/// keys. Scalars have a tolerance of their own.
///
/// Tracks equal to the skeleton's rest are dropped, because poses start from it. Others become constant, step, linear
/// or cubic (Hermite with non-uniform knots), whichever is smallest. The first and last key of each track, both sides
/// of jumps, and pins keep their values (rotations of cubic tracks up to their last digit). So continuous tracks stay
/// continuous, and the seam of a loop does not change. A track that moves by less than the tolerance becomes constant.
/// One that cannot be fitted within the tolerance is left unchanged.
///
/// To keep every n-th key instead, see [`Clip::resampled`].
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

/// Result of [`Reduction::reduce`].
#[derive(Clone, Debug, PartialEq)]
pub struct Reduced {
    /// The reduced clip.
    pub clip: Clip,
    /// Its largest error, in model units.
    pub error: f32,
    /// Location of the largest error; `None` if there is no error.
    pub at: Option<ErrorPlace>,
}

/// Result of [`Reduction::pack`].
#[derive(Clone, Debug, PartialEq)]
pub struct Packed {
    /// The packed clip.
    pub clip: PackedClip,
    /// Its largest error, in model units.
    pub error: f32,
    /// Location of the largest error; `None` if there is no error.
    pub at: Option<ErrorPlace>,
}

/// Location of an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorPlace {
    /// The bone at whose ends the error is.
    pub bone: usize,
    /// Time of the error, seconds.
    pub time_s: f32,
}

impl Reduction {
    /// A reduction with a tolerance in model units. With 0, only redundant data is removed. The tolerance of scalars is
    /// 0.001.
    #[must_use]
    pub fn new(tolerance: f32) -> Self {
        Self { tolerance, scalar_tolerance: SCALAR_TOLERANCE, pins: Vec::new() }
    }

    /// Sets the tolerance of scalars, such as morph weights.
    #[must_use]
    pub fn with_scalar_tolerance(mut self, tolerance: f32) -> Self {
        self.scalar_tolerance = tolerance;
        self
    }

    /// Adds pins: times, in seconds, at which every changed track gets a key with the clip's value. Use them for
    /// transitions, contacts and golden poses. No key is added where a track does not move, as before its first key. In
    /// packed clips the pinned value is rounded.
    #[must_use]
    pub fn with_pins(mut self, times_s: impl IntoIterator<Item = f32>) -> Self {
        self.pins.extend(times_s);
        self
    }

    /// Reduces a clip. Bones that the skeleton does not have are left unchanged.
    ///
    /// # Errors
    /// A tolerance or a pin is negative or not finite.
    pub fn reduce(&self, clip: &Clip, skeleton: &Skeleton) -> Result<Reduced, ReductionError> {
        let (clip, errors) = self.result(clip, skeleton, Storage::Floats, |fit| Some(fit.clip))?;
        let (error, at) = worst(&errors);
        Ok(Reduced { clip, error, at })
    }

    /// Reduces and packs a clip; the tolerance applies to both together. Bones that the skeleton does not have are left
    /// unchanged.
    ///
    /// # Errors
    /// A tolerance or a pin is negative or not finite, or the packed tracks would take more than 2³² bits.
    pub fn pack(&self, clip: &Clip, skeleton: &Skeleton) -> Result<Packed, ReductionError> {
        let storage = Storage::Packed(times_of(clip).len());
        let (clip, errors) = self.result(clip, skeleton, storage, |fit| PackedClip::new(&fit.clip, &fit.grids))?;
        let (error, at) = worst(&errors);
        Ok(Packed { clip, error, at })
    }

    /// Returns the smallest result found that keeps the tolerance, and its errors.
    fn result<R: PlayableClip>(
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
        // Adapt the factors until the errors are close to the tolerance, and remember the smallest result that kept it.
        let mut best: Option<(usize, Factors)> = None;
        for _ in 0..ROUNDS {
            let fit = tracks.fitted(&factors, storage);
            let result = made(fit).ok_or(ReductionError::Size)?;
            let errors = judge.errors_at_keys(&result, ROUGH_KEYS);
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
        // Tighten the bones that exceed the tolerance anywhere; after `REPAIRS` attempts, leave them unchanged.
        let mut repairs = alloc::vec![0_u8; bones];
        loop {
            let result = made(tracks.fitted(&factors, storage)).ok_or(ReductionError::Size)?;
            let errors = judge.errors_everywhere(&result);
            let mut is_good = true;
            for (bone, squared) in worst_below(&errors, skeleton).into_iter().enumerate() {
                // This also rejects NaN.
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

    /// Validates the settings; returns the sorted pins and the tolerances of the model and of scalars.
    fn checked(&self) -> Result<(Vec<f32>, [f32; 2]), ReductionError> {
        let tolerances = [self.tolerance, self.scalar_tolerance];
        if let Some(bad) = tolerances.into_iter().find(|tolerance| !(tolerance.is_finite() && *tolerance >= 0.0)) {
            return Err(ReductionError::Tolerance(bad));
        }
        if let Some(bad) = self.pins.iter().copied().find(|pin| !(pin.is_finite() && *pin >= 0.0)) {
            return Err(ReductionError::Pin(bad));
        }
        let mut pins = self.pins.clone();
        // Adding 0 turns −0 into 0.
        pins.iter_mut().for_each(|pin| *pin += 0.0);
        pins.sort_unstable_by(f32::total_cmp);
        pins.dedup();
        Ok((pins, tolerances))
    }
}

/// Largest squared error in the subtree of each bone.
fn worst_below(errors: &Errors, skeleton: &Skeleton) -> Vec<f64> {
    let mut worst: Vec<f64> = errors.bones.iter().map(|error| error.squared).collect();
    for bone in (0..worst.len()).rev() {
        if let Some(parent) = skeleton.parents()[bone] {
            // NaN is propagated to all ancestors.
            if !(worst[bone] <= worst[parent]) && !worst[parent].is_nan() {
                worst[parent] = worst[bone];
            }
        }
    }
    worst
}

/// Factor that brings an error to the fraction `part` of a limit; 0 if the error is not finite.
fn ratio(limit: f64, squared: f64, part: f64) -> f32 {
    let ratio = root(part * part * limit * limit / squared);
    if ratio.is_nan() { 0.0 } else { ratio }
}

/// Largest error and its location.
fn worst(errors: &Errors) -> (f32, Option<ErrorPlace>) {
    let sizes = errors.bones.iter().map(judge::Error::size).enumerate();
    let worst = sizes.filter(|(_, size)| *size > 0.0).reduce(|a, b| if b.1 > a.1 { b } else { a });
    worst.map_or((0.0, None), |(bone, size)| (size, Some(ErrorPlace { bone, time_s: errors.bones[bone].time_s })))
}
