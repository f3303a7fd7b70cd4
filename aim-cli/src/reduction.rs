//! Reduction of clips within a tolerance in millimetres of a 1.7 m figure.

use std::path::Path;
use std::str::FromStr;

use aim_animation::{Bone, Clip, Curve, HermiteKey, Reduction, Skeleton, Track, Transform, Value};
use aim_character::Measurement;
use aim_gltf::Document;
use aim_runtime::glam::Vec3;

use crate::failure::Failure;
use crate::words::{fixed, trimmed};

/// A tolerance in millimetres of a 1.7 m figure, from 0 to [`MOST_MM`].
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub(crate) struct Millimetres(pub(crate) f64);

/// Largest tolerance, millimetres.
const MOST_MM: f64 = 1000.0;

impl FromStr for Millimetres {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let length = |suffix: &str| {
            let number = text.trim().strip_suffix(suffix)?.trim_end().parse().ok();
            number.filter(|length: &f64| *length >= 0.0 && length.is_finite())
        };
        match length("mm") {
            Some(length) if length <= MOST_MM => return Ok(Self(length)),
            Some(_) => return Err(format!("the tolerance must be at most {MOST_MM}mm, such as 1mm")),
            None => {}
        }
        let meant =
            [("cm", 10.0), ("m", 1000.0), ("", 1.0)].into_iter().find_map(|(suffix, mm)| Some(length(suffix)? * mm));
        let hint = match meant {
            Some(meant) if meant <= MOST_MM => format!("; did you mean {}mm?", trimmed(meant, 6)),
            _ => String::new(),
        };
        Err(format!("expected millimetres of a 1.7 m figure, such as 1mm or 0.5mm{hint}"))
    }
}

/// Parses one time of a comma-separated list, seconds; the unit `s` is optional.
pub(crate) fn seconds(text: &str) -> Result<f32, String> {
    let number = text.trim();
    let number = number.strip_suffix('s').map_or(number, str::trim_end);
    number.parse().map_err(|_| "expected seconds separated by commas, such as 0.2,0.42".into())
}

/// Returns a millimetre of a 1.7 m figure in a file's units: 1/1700 of the character's height, or 0.001 if it has no
/// height.
pub(crate) fn millimetre(measurement: &Measurement) -> f64 {
    if measurement.height > 0.0 { measurement.height / 1700.0 } else { 1e-3 }
}

/// Accuracy that a reduced clip has to keep.
pub(crate) struct Kept<'a> {
    /// Largest allowed distance of a bone from its original place, in the units of the skeleton's space.
    pub(crate) tolerance: f64,
    /// Times at which the poses stay unchanged, seconds.
    pub(crate) pins: &'a [f32],
    /// Points to which the tolerance also applies, each with its bone and in that bone's space: where an eye looks.
    pub(crate) points: &'a [(usize, Vec3)],
}

/// Length of the auxiliary bone at a point, as a share of the point's distance from its bone.
const SHORT: f32 = 0.02;

/// Returns a clip of the document with as few keys as the tolerance allows.
pub(crate) fn reduced(clip: &Clip, document: &Document, kept: &Kept<'_>) -> Result<Clip, String> {
    let Kept { tolerance, pins, points } = *kept;
    let skeleton = document.skeleton();
    let bones = skeleton.names().iter().zip(skeleton.parents()).zip(skeleton.rest());
    let bones = bones.map(|((name, parent), rest)| Bone::new(name, *parent).with_rest(*rest));
    // Each point becomes an auxiliary bone at rest, with a short child: a leaf would be as long as its parent.
    let point = |(number, (bone, point)): (usize, &(usize, Vec3))| {
        let on = |parent: usize, at: Vec3| Bone::new("", Some(parent)).with_rest(Transform::from_translation(at));
        [on(*bone, *point), on(skeleton.len() + 2 * number, *point * SHORT)]
    };
    let points = points.iter().enumerate().flat_map(point);
    let extended = Skeleton::new(bones.chain(points)).map_err(|error| error.to_string())?;
    let there = clip.clone().with_bones_mapped(|bone| extended.bone_of(bone));
    let reduction = Reduction::new(narrow(tolerance))
        .with_scalar_tolerance(narrow(weight_tolerance(tolerance)))
        .with_pins(pins.iter().copied());
    let reduced = reduction.reduce(&there, &extended).map_err(|error| error.to_string())?.clip;
    let reduced = reduced.with_bones_mapped(|bone| extended.source_of(bone));
    Ok(held(with_smaller_weights(reduced, clip, document), document))
}

/// Returns the tolerance of morph weights for a tolerance of lengths: the default of [`Reduction`], or 0 if nothing may
/// change.
pub(crate) fn weight_tolerance(tolerance: f64) -> f64 {
    if tolerance > 0.0 { 1e-3 } else { 0.0 }
}

/// The error of a reduced clip as written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct WrittenError {
    /// Largest error of any bone, millimetres of a 1.7 m figure.
    pub(crate) mm: f64,
    /// Name of that bone, and the time in seconds.
    pub(crate) at: Option<(String, f64)>,
    /// Largest error of any morph weight; `None` if there are none.
    pub(crate) weights: Option<f64>,
}

impl WrittenError {
    /// Checks that a clip is within its tolerance, with an allowance for rounding: a hundredth of the tolerance, but at
    /// least a thousandth of a millimetre or a millionth of a weight.
    ///
    /// # Errors
    /// The error is larger, or not a number.
    pub(crate) fn check(&self, file: &Path, clip: &str, tolerance: Millimetres) -> Result<(), Failure> {
        let is_above =
            |error: f64, limit: f64, rounding: f64| error.is_nan() || error > limit + f64::max(0.01 * limit, rounding);
        let problem = if is_above(self.mm, tolerance.0, 1e-3) {
            let place = match &self.at {
                Some((bone, t)) => format!(" ({bone} at {} s)", trimmed(*t, 3)),
                None => String::new(),
            };
            format!("the written clip would be off by {} mm{place}", fixed(self.mm, 3))
        } else if let Some(error) = self.weights.filter(|error| is_above(*error, weight_tolerance(tolerance.0), 1e-6)) {
            format!("the written morph weights would be off by {}", trimmed(error, 6))
        } else {
            return Ok(());
        };
        Err(Failure::Check(format!(
            "{}: cannot reduce clip {clip:?} to within {} mm: {problem}; nothing was written",
            file.display(),
            tolerance.0
        )))
    }
}

#[expect(clippy::cast_possible_truncation, reason = "clips are in single precision")]
fn narrow(value: f64) -> f32 {
    value as f32
}

/// Returns the reduced clip, with the original tracks for each mesh whose morph weights take less space with them. A
/// file stores the weights of all targets of a mesh at the key times of each, so separate key times can increase the
/// size.
fn with_smaller_weights(mut reduced: Clip, old: &Clip, document: &Document) -> Clip {
    for node in 0..document.skeleton().len() {
        let targets = document.morph_scalars(node);
        let tracks = |clip: &Clip| -> Vec<(usize, Track<f32>)> {
            clip.scalars().iter().filter(|(scalar, _)| targets.contains(scalar)).cloned().collect()
        };
        let (is, was) = (tracks(&reduced), tracks(old));
        if weight_numbers(&is, targets.len()) > weight_numbers(&was, targets.len()) {
            reduced = was.into_iter().fold(reduced, |clip, (scalar, track)| clip.with_scalar(scalar, track));
        }
    }
    reduced
}

/// Returns how many numbers a file stores for the morph weights of a mesh: at each key time, the time itself and for
/// each target a value, or a value and two velocities if any track is cubic.
fn weight_numbers(tracks: &[(usize, Track<f32>)], targets: usize) -> usize {
    let mut times: Vec<u32> =
        tracks.iter().flat_map(|(_, track)| track.times().iter().map(|time| time.to_bits())).collect();
    times.sort_unstable();
    times.dedup();
    let is_cubic = tracks.iter().any(|(_, track)| track.curve() == Curve::Cubic);
    times.len() * (1 + targets * if is_cubic { 3 } else { 1 })
}

/// Returns the clip with a key at its end, because the last key defines its length in a file. The motion stays the
/// same.
fn held(clip: Clip, document: &Document) -> Clip {
    let vectors =
        clip.tracks().iter().flat_map(|tracks| [&tracks.translation, &tracks.scale]).flatten().map(Track::end_s);
    let rotations = clip.tracks().iter().filter_map(|tracks| Some(tracks.rotation.as_ref()?.end_s()));
    let end = vectors.chain(rotations).chain(clip.scalars().iter().map(|(_, track)| track.end_s())).fold(0.0, f32::max);
    let length = clip.length_s();
    if end >= length && !(clip.tracks().is_empty() && clip.scalars().is_empty()) {
        return clip;
    }
    with_end(&clip, document).unwrap_or(clip)
}

/// Returns a clip that ends before its length with an additional track, or key, that ends there; `None` if there is no
/// bone to animate.
fn with_end(clip: &Clip, document: &Document) -> Option<Clip> {
    let (skeleton, length, new) = (document.skeleton(), clip.length_s(), || clip.clone());
    // First choice: a second key on a track with one key.
    for tracks in clip.tracks() {
        let bone = tracks.bone;
        if let Some(track) = tracks.rotation.as_ref().and_then(|track| still(track, length)) {
            return Some(new().with_rotation(bone, track));
        }
        if let Some(track) = tracks.translation.as_ref().and_then(|track| still(track, length)) {
            return Some(new().with_translation(bone, track));
        }
        if let Some(track) = tracks.scale.as_ref().and_then(|track| still(track, length)) {
            return Some(new().with_scale(bone, track));
        }
    }
    // Otherwise, a constant track at rest for a property that an animated bone has no track of.
    for tracks in clip.tracks() {
        let Some(rest) = skeleton.rest().get(tracks.bone) else { continue };
        if tracks.translation.is_none() {
            return Some(new().with_translation(tracks.bone, constant(rest.translation, length)?));
        }
        if tracks.scale.is_none() {
            return Some(new().with_scale(tracks.bone, constant(rest.scale, length)?));
        }
    }
    // Otherwise, a track repeats its last value at the end.
    for tracks in clip.tracks() {
        if let Some(track) = &tracks.translation {
            return Some(new().with_translation(tracks.bone, prolonged(track, length)?));
        }
    }
    if let Some((scalar, track)) = clip.scalars().first() {
        return Some(new().with_scalar(*scalar, prolonged(track, length)?));
    }
    // Otherwise, there are no tracks: the first bone of the file stays at rest.
    let bone = (0..skeleton.len()).find(|bone| skeleton.is_in_file(*bone))?;
    Some(new().with_rotation(bone, constant(skeleton.rest().get(bone)?.rotation, length)?))
}

/// Returns a track of one key with a second one at `length_s`; `None` for other tracks.
fn still<T: Value>(track: &Track<T>, length_s: f32) -> Option<Track<T>> {
    if let [value] = track.values() { constant(*value, length_s) } else { None }
}

/// Returns a constant track from 0 to `length_s`.
fn constant<T: Value>(value: T, length_s: f32) -> Option<Track<T>> {
    let times = if length_s > 0.0 { vec![0.0, length_s] } else { vec![0.0] };
    let values = vec![value; times.len()];
    Track::step(times, values).ok()
}

/// Returns a track that ends before `length_s` with its last value repeated at that time.
fn prolonged<T: Value>(track: &Track<T>, length_s: f32) -> Option<Track<T>> {
    let last = *track.values().last()?;
    let times: Vec<f32> = track.times().iter().copied().chain([length_s]).collect();
    let values: Vec<T> = track.values().iter().copied().chain([last]).collect();
    match track.curve() {
        Curve::Step => Track::step(times, values).ok(),
        Curve::Cubic => {
            let still = last.times(0.0);
            let mut keys: Vec<HermiteKey<T>> = track
                .tangents()
                .iter()
                .zip(values)
                .map(|([into, out], value)| HermiteKey { into: *into, value, out: *out })
                .collect();
            if let Some(last) = keys.last_mut() {
                last.out = still;
            }
            keys.push(HermiteKey::smooth(last, still));
            Track::hermite(times, &keys).ok()
        }
        _ => Track::linear(times, values).ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_millimetres_from_none_to_a_thousand() {
        for (text, mm) in [("1mm", 1.0), ("0.5mm", 0.5), ("0mm", 0.0), (" 2 mm", 2.0), ("1000mm", 1000.0)] {
            assert_eq!(text.parse(), Ok(Millimetres(mm)), "{text}");
        }
        for (text, hint) in [
            ("1", "did you mean 1mm?"),
            ("1cm", "did you mean 10mm?"),
            ("0.01m", "did you mean 10mm?"),
            ("1001mm", "at most 1000mm"),
            ("infmm", "such as 1mm or 0.5mm"),
        ] {
            let error = text.parse::<Millimetres>().expect_err(text);
            assert!(error.contains(hint), "{text}: {error}");
        }
        for text in ["-1mm", "NaNmm", "mm", "5000", "much"] {
            let error = text.parse::<Millimetres>().expect_err(text);
            assert!(error.ends_with("such as 1mm or 0.5mm"), "{text}: {error}");
        }
    }

    #[test]
    fn times_may_have_a_unit_and_blanks() {
        for text in ["0.2", " 0.2", "0.2s", "0.2 s "] {
            assert_eq!(seconds(text), Ok(0.2), "{text}");
        }
        for text in ["", "a", "0.2ms", "s"] {
            assert!(seconds(text).is_err_and(|error| error.contains("0.2,0.42")), "{text}");
        }
    }

    #[test]
    fn more_than_the_tolerance_is_an_error() {
        let check = |mm: f64, weights: Option<f64>, tolerance: f64| {
            let error = WrittenError { mm, at: Some(("head".into(), 0.25)), weights };
            error.check(Path::new("m.glb"), "walk", Millimetres(tolerance))
        };
        for (mm, weights, tolerance) in
            [(1.0, None, 1.0), (1.009, Some(1e-3), 1.0), (0.0009, Some(0.0), 0.0), (0.0, Some(1.009e-3), 1.0)]
        {
            assert!(check(mm, weights, tolerance).is_ok(), "{mm} {weights:?} of {tolerance}");
        }
        for (mm, weights, tolerance, words) in [
            (1.02, None, 1.0, "off by 1.020 mm (head at 0.25 s)"),
            (0.0011, None, 0.0, "off by 0.001 mm"),
            (f64::NAN, None, 1.0, "off by NaN mm"),
            (0.1, Some(0.043), 1.0, "weights would be off by 0.043"),
            (0.0, Some(f64::INFINITY), 1.0, "weights would be off by inf"),
        ] {
            let error = check(mm, weights, tolerance).expect_err(words);
            assert!(matches!(error, Failure::Check(_)) && error.to_string().contains(words), "{error}");
        }
    }
}
