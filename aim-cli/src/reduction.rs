//! Reduction of clips as users ask for it, in millimetres of a 1.7 m figure.

use std::str::FromStr;

use aim_animation::{Bone, Clip, Reduction, Skeleton, Track, Transform};
use aim_character::Measurement;
use aim_runtime::glam::Vec3;

/// A length of a 1.7 m figure, millimetres; positive and finite.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub(crate) struct Millimetres(pub(crate) f64);

impl FromStr for Millimetres {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = text.strip_suffix("mm").and_then(|number| number.trim_end().parse().ok());
        let length = number.filter(|length: &f64| *length > 0.0 && length.is_finite());
        length.map(Self).ok_or_else(|| "expected millimetres of a 1.7 m figure, such as 1mm or 0.5mm".into())
    }
}

/// A millimetre of a 1.7 m figure, in a file's units: a part of the character's height, or of a metre where nothing has a height.
pub(crate) fn millimetre(measurement: &Measurement) -> f64 {
    if measurement.height > 0.0 { measurement.height / 1700.0 } else { 1e-3 }
}

/// A request to reduce a clip.
pub(crate) struct Kept<'a> {
    /// The largest distance from where it was, in the units of the skeleton's space.
    pub(crate) tolerance: f64,
    /// Times whose poses stay, seconds.
    pub(crate) pins: &'a [f32],
    /// Points of bones, in the bone's space, that count as their ends do: what an eye looks at.
    pub(crate) points: &'a [(usize, Vec3)],
}

/// The length of a point's bone beside its distance.
const SHORT: f32 = 0.02;

/// A clip with as few keys as a tolerance allows.
pub(crate) fn reduced(clip: &Clip, skeleton: &Skeleton, kept: &Kept<'_>) -> Result<Clip, String> {
    let Kept { tolerance, pins, points } = *kept;
    let bones = skeleton.names().iter().zip(skeleton.parents()).zip(skeleton.rest());
    let bones = bones.map(|((name, parent), rest)| Bone::new(name, *parent).with_rest(*rest));
    // A point is a bone at rest on its bone, with a short one on it: that of a leaf would be as long as its parent.
    let point = |(number, (bone, point)): (usize, &(usize, Vec3))| {
        let on = |parent: usize, at: Vec3| Bone::new("", Some(parent)).with_rest(Transform::from_translation(at));
        [on(*bone, *point), on(skeleton.len() + 2 * number, *point * SHORT)]
    };
    let points = points.iter().enumerate().flat_map(point);
    let extended = Skeleton::new(bones.chain(points)).map_err(|error| error.to_string())?;
    let there = clip.clone().with_bones_mapped(|bone| extended.bone_of(bone));
    let reduction = Reduction::new(narrow(tolerance)).with_pins(pins.iter().copied());
    let reduced = reduction.reduce(&there, &extended).map_err(|error| error.to_string())?.clip;
    Ok(held(reduced.with_bones_mapped(|bone| extended.source_of(bone)), skeleton))
}

#[expect(clippy::cast_possible_truncation, reason = "clips are in single precision")]
fn narrow(value: f64) -> f32 {
    value as f32
}

/// A clip with a key at its end, to which a file has its length from.
fn held(clip: Clip, skeleton: &Skeleton) -> Clip {
    let vectors =
        clip.tracks().iter().flat_map(|tracks| [&tracks.translation, &tracks.scale]).flatten().map(Track::end_s);
    let rotations = clip.tracks().iter().filter_map(|tracks| Some(tracks.rotation.as_ref()?.end_s()));
    let end = vectors.chain(rotations).chain(clip.scalars().iter().map(|(_, track)| track.end_s())).fold(0.0, f32::max);
    let length = clip.length_s();
    if end >= length && !(clip.tracks().is_empty() && clip.scalars().is_empty()) {
        return clip;
    }
    let bone =
        clip.tracks().iter().find(|tracks| tracks.rotation.as_ref().is_none_or(|track| track.times().len() == 1));
    let bone = bone.map_or(0, |tracks| tracks.bone);
    let track = clip.bone(bone).and_then(|tracks| tracks.rotation.as_ref());
    let Some(value) = track.map(|track| track.values()[0]).or_else(|| Some(skeleton.rest().get(bone)?.rotation)) else {
        return clip;
    };
    let times = if length > 0.0 { vec![0.0, length] } else { vec![0.0] };
    let values = vec![value; times.len()];
    match Track::step(times, values) {
        Ok(track) => clip.with_rotation(bone, track),
        Err(_) => clip,
    }
}
