//! The seam between the end of a looping clip and its beginning: measured, and mended in position and speed.
//!
//! A clip that travels does not end where it begins. The travel of the hips is removed before mending and restored
//! afterwards, so that the next cycle begins where this one ends.

use core::ops::{Add, Mul, Sub};

use aim_animation::{
    Clip, Continuity, Cursor, HermiteKey, Motion, MotionError, Root, RootPath, Seam, Track, Transform, Value,
};
use aim_gltf::{Document, Skeleton};
use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::rotation::{angle, product};

use super::{MOST_KEYS, continuous, no_keys};
use crate::error::Error;
use crate::measure::Measurement;
use crate::measure::roles::Role;

/// Sampling rate, samples per second.
const RATE: f32 = 60.0;
/// Time before and after the seam over which the mending fades out, seconds.
const WINDOW_S: f32 = 0.25;
/// Largest invisible difference: as a share of the height, in radians, as a factor of scale, or in weights of morph
/// targets.
const CLOSED: f32 = 1e-4;
/// Ratio between the change of speed at the seam and the largest one elsewhere in the clip above which the seam is
/// mended. It exceeds 2 because samples beside a key see only half of the change there.
const JERK: f32 = 2.5;
/// Least displacement of the hips that is taken for travel, as a share of the height.
const TRAVEL: f32 = 0.05;
/// Least rotation of the hips that is taken for travel, radians.
const TRAVEL_RAD: f32 = 0.1;

/// A clip whose end continues into its beginning.
#[derive(Clone, Debug)]
pub struct MendedLoop {
    /// The mended clip.
    pub clip: Clip,
    /// The seam before mending, without the travel of the hips.
    pub seam: Seam,
}

/// Mends a looping clip so that its end continues into its beginning without a jump in position or speed. Returns
/// `None` if it already does.
///
/// If the hips end more than a twentieth of the height, or 6°, from where they begin, that travel is kept, and the next
/// cycle starts from there. Mended tracks become cubic. For a clip that travels, the tracks of the bones that carry the
/// travel get 60 keys per second.
///
/// # Errors
/// Fails if the clip moves the hips to a non-finite position, or if at 60 samples per second it has more samples than a
/// bake may have keys.
pub fn mended_loop(document: &Document, measurement: &Measurement, clip: &Clip) -> Result<Option<MendedLoop>, Error> {
    check_length(clip)?;
    let skeleton = document.skeleton();
    let size = size(measurement);
    let travel = Travel::find(document, measurement, clip, size)?;
    let on_the_spot =
        travel.as_ref().map_or_else(|| Ok(clip.clone()), |travel| travel.apply(clip, TravelChange::Remove))?;
    let seam = on_the_spot.seam();
    let place = seam.place;
    let jumps = (place.translation / size).max(place.rotation_rad).max(place.scale).max(place.scalar) > CLOSED;
    if !jumps && !jerks(skeleton, &on_the_spot, size) {
        return Ok(None);
    }
    let mended = on_the_spot.mended(Continuity::Speed, WINDOW_S);
    let clip = match travel {
        Some(travel) => travel.apply(&mended, TravelChange::Restore)?,
        None => mended,
    };
    Ok(Some(MendedLoop { clip, seam }))
}

/// Returns the path of the hips over a clip: their projection on the ground, 60 samples per second. `None` for a
/// character without hips, or a clip without length.
///
/// # Errors
/// Fails if the clip moves the hips to a non-finite position, or if it has more samples than a bake may have keys.
pub fn root_path(document: &Document, measurement: &Measurement, clip: &Clip) -> Result<Option<RootPath>, Error> {
    check_length(clip)?;
    let Some(hips) = measurement.with_role(Role::Hips).map(|bone| bone.node) else { return Ok(None) };
    let root = Root::Shadow { bone: hips, up: measurement.up.as_vec3() };
    match RootPath::new(clip, document.skeleton(), root, RATE) {
        Ok(path) => Ok(Some(path)),
        Err(MotionError::Length) => Ok(None),
        Err(error) => Err(Error::Clip(error.to_string())),
    }
}

/// Returns a clip without its travel, as [`mended_loop`] judges its seam: if the hips end more than a twentieth of the
/// height, or 6°, from where they begin, that movement is removed.
///
/// # Errors
/// See [`root_path`].
pub fn on_the_spot(document: &Document, measurement: &Measurement, clip: &Clip) -> Result<Clip, Error> {
    let travel = Travel::find(document, measurement, clip, size(measurement))?;
    travel.map_or_else(|| Ok(clip.clone()), |travel| travel.apply(clip, TravelChange::Remove))
}

/// Returns a clip without a movement of its root, as [`Motion::remove`] removes it from poses.
///
/// The tracks of the bones that carry the character become cubic, with 60 keys per second. Branches without tracks that
/// are no part of the character, such as cameras and lights, stay where they are.
///
/// # Errors
/// Fails if the clip moves bones to a non-finite position, or if it has more samples than a bake may have keys.
pub fn in_place(document: &Document, clip: &Clip, motion: Motion) -> Result<Clip, Error> {
    check_length(clip)?;
    Travel::new(document.skeleton(), clip, motion).apply(clip, TravelChange::Remove)
}

/// Returns the character's height, or 1 if it is unknown.
fn size(measurement: &Measurement) -> f32 {
    if measurement.height > 0.0 { crate::num::narrow(measurement.height) } else { 1.0 }
}

fn check_length(clip: &Clip) -> Result<(), Error> {
    if clip.length_s() * RATE > MOST_KEYS { Err(no_keys(clip.length_s(), RATE)) } else { Ok(()) }
}

/// Returns `true` if any bone's change of speed at the seam clearly exceeds its largest one elsewhere.
fn jerks(skeleton: &Skeleton, clip: &Clip, size: f32) -> bool {
    let mut steps = vec![Steps::default(); skeleton.len()];
    let mut before: Option<Vec<Transform>> = None;
    // Keeps two poses at a time, because a long clip has very many.
    for time in sample_times(clip.length_s()) {
        let pose = skeleton.pose(clip, time);
        for (steps, (from, to)) in steps.iter_mut().zip(before.iter().flatten().zip(&pose)) {
            steps.push(displacement(from, to, size));
        }
        before = Some(pose);
    }
    steps.iter().any(Steps::jerk)
}

/// Displacements of a bone from sample to sample: the first, the last, and the largest change between neighbours.
#[derive(Clone, Copy, Default)]
struct Steps {
    ends: Option<[[Vec3; 2]; 2]>,
    most: [f32; 2],
}

impl Steps {
    fn push(&mut self, step: [Vec3; 2]) {
        let [first, last] = self.ends.unwrap_or([step; 2]);
        let change = change(last, step);
        self.most = [0, 1].map(|kind| self.most[kind].max(change[kind]));
        self.ends = Some([first, step]);
    }

    /// Returns `true` if the first displacement differs from the last much more than any two neighbours differ.
    fn jerk(&self) -> bool {
        let seam = self.ends.map_or([0.0; 2], |[first, last]| change(last, first));
        (0..2).any(|kind| seam[kind] > JERK * self.most[kind] + CLOSED)
    }
}

fn change(from: [Vec3; 2], to: [Vec3; 2]) -> [f32; 2] {
    [0, 1].map(|kind| (to[kind] - from[kind]).length())
}

/// Returns the displacement (in units of `size`) and the rotation vector between two transforms.
fn displacement(from: &Transform, to: &Transform, size: f32) -> [Vec3; 2] {
    let turn = aim_runtime::rotation::log(product(to.rotation, from.rotation.conjugate()));
    [(to.translation - from.translation) / size, turn]
}

/// Returns evenly spaced times from the beginning to the end.
fn sample_times(length_s: f32) -> Vec<f32> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bounded")]
    let steps = (length_s * RATE).ceil().clamp(4.0, 1e6) as u32;
    let part = |step: u32| f64::from(step) / f64::from(steps);
    (0..=steps).map(|step| crate::num::narrow(f64::from(length_s) * part(step))).collect()
}

/// Direction of applying the movement of the root: removing it (`Out`) or restoring it (`Back`).
#[derive(Clone, Copy, PartialEq, Eq)]
enum TravelChange {
    Remove,
    Restore,
}

/// The travel of the hips in a clip, and the bones that carry it.
struct Travel<'a> {
    skeleton: &'a Skeleton,
    motion: Motion,
    /// Topmost bones with tracks, each with the rest transform of its parent in the world.
    carriers: Vec<(usize, Affine3A)>,
}

impl<'a> Travel<'a> {
    /// Finds the travel; `None` if the hips end where they begin.
    fn find(document: &'a Document, measurement: &Measurement, clip: &Clip, size: f32) -> Result<Option<Self>, Error> {
        let Some(path) = root_path(document, measurement, clip)? else { return Ok(None) };
        let [begin, end] = [0.0, clip.length_s()].map(|time| path.at(time));
        let turn = angle(product(end.rotation, begin.rotation.conjugate()));
        if begin.translation.distance(end.translation) <= TRAVEL * size && turn <= TRAVEL_RAD {
            return Ok(None);
        }
        // Along a screw motion the next cycle continues at the same speed, also round a bend.
        Ok(Some(Self::new(document.skeleton(), clip, Motion::composite(&path))))
    }

    fn new(skeleton: &'a Skeleton, clip: &Clip, motion: Motion) -> Self {
        let moves = |bone: usize| clip.bone(bone).is_some();
        let world = super::live::rounded(&skeleton.world_f64(skeleton.rest()));
        let outermost = |bone: &usize| moves(*bone) && skeleton.ancestry(*bone).skip(1).all(|on| !moves(on));
        let on = |bone: usize| skeleton.parents()[bone].map_or(Affine3A::IDENTITY, |parent| world[parent]);
        let carriers = (0..skeleton.len()).filter(outermost).map(|bone| (bone, on(bone))).collect();
        Self { skeleton, motion, carriers }
    }

    /// Returns the clip with the movement removed or restored: `P⁻¹ · M(t)^∓¹ · P · local` for each carrier, where P is
    /// its parent.
    fn apply(&self, clip: &Clip, change: TravelChange) -> Result<Clip, Error> {
        let (length, times) = (clip.length_s(), sample_times(clip.length_s()));
        let step = times[1] - times[0];
        let mut changed = clip.clone();
        for &(bone, on) in &self.carriers {
            let mut pose = self.skeleton.rest().to_vec();
            let mut at = |time: f32| {
                clip.sample(time, &mut Cursor::default(), &mut pose);
                let at = self.motion.at(time);
                moved_local(on, if change == TravelChange::Remove { at.rigid_inverse() } else { at }, pose[bone])
            };
            let keys: Vec<Transform> = times.iter().map(|&time| at(time)).collect();
            let places: Vec<Vec3> = keys.iter().map(|key| key.translation).collect();
            let mut turns: Vec<Quat> = Vec::new();
            keys.iter().for_each(|key| turns.push(continuous(turns.last(), key.rotation)));
            // Values beyond both ends, for the tangents there. While the ends do not match yet, they are extrapolated.
            // After mending, the neighbouring cycles supply them, displaced by the whole movement.
            let (beyond_places, beyond_turns) = if change == TravelChange::Remove {
                (extrapolate(&places), extrapolate(&turns))
            } else {
                let whole = self.motion.at(length);
                let [before, after] = [(whole.rigid_inverse(), length - step), (whole, step)]
                    .map(|(whole, time)| moved_local(on, whole, at(time)));
                let turn = |near: Option<&Quat>, other: Transform| continuous(near, other.rotation);
                ([before.translation, after.translation], [turn(turns.first(), before), turn(turns.last(), after)])
            };
            changed = changed
                .with_translation(bone, smooth(&times, &places, beyond_places)?)
                .with_rotation(bone, smooth(&times, &turns, beyond_turns)?);
        }
        Ok(changed)
    }
}

/// Returns a bone's local transform after a rigid motion of the model; `on` is the transform of its parent.
fn moved_local(on: Affine3A, by: Transform, local: Transform) -> Transform {
    let changed = on.inverse() * by.to_affine() * on * Transform { scale: Vec3::ONE, ..local }.to_affine();
    Transform { scale: local.scale, ..Transform::from_affine(&changed).unwrap_or(local) }
}

/// Extrapolates values by one step before the first and after the last, on the parabola through the three nearest.
fn extrapolate<T: Copy + Sub<Output = T> + Add<Output = T> + Mul<f32, Output = T>>(values: &[T]) -> [T; 2] {
    let parabola = |a: T, b: T, c: T| (a - b) * 3.0 + c;
    let last = values.len() - 1;
    [parabola(values[0], values[1], values[2]), parabola(values[last], values[last - 1], values[last - 2])]
}

/// Returns a cubic track through values at even times. Its tangents are central differences; `before` and `after` are
/// the values beyond the ends.
fn smooth<T>(times: &[f32], values: &[T], [before, after]: [T; 2]) -> Result<Track<T>, Error>
where
    T: Value + Sub<Output = T> + Mul<f32, Output = T>,
{
    let step = times[1] - times[0];
    let around = |index: usize| {
        let before = index.checked_sub(1).map_or(before, |index| values[index]);
        [before, values.get(index + 1).copied().unwrap_or(after)]
    };
    let key = |(index, &value): (usize, &T)| {
        let [before, after] = around(index);
        HermiteKey::smooth(value, (after - before) * (0.5 / step))
    };
    let keys: Vec<HermiteKey<T>> = values.iter().enumerate().map(key).collect();
    Track::hermite(times, &keys).map_err(|error| Error::Clip(error.to_string()))
}
