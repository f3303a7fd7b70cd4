//! The seam of a clip that is to be a loop: found, and mended in place and speed.
//!
//! A clip that goes ahead ends where it does not begin. What its hips have gone and turned is taken out before, and given
//! back after: the next round begins there.

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

/// Samples a second.
const RATE: f32 = 60.0;
/// The time before and after the seam over which what is mended fades, seconds.
const WINDOW_S: f32 = 0.25;
/// As far as no one sees: a part of the height, radians, factors of scale, weights of morph targets.
const CLOSED: f32 = 1e-4;
/// The jump in speed at the seam beside the largest one anywhere else in the clip, of which samples beside keys see a half.
const JERK: f32 = 2.5;
/// A way of the hips that is meant, a part of the height, and a turn, radians.
const TRAVEL: f32 = 0.05;
const TRAVEL_RAD: f32 = 0.1;

/// A clip whose end goes over into its beginning.
#[derive(Clone, Debug)]
pub struct MendedLoop {
    /// The clip.
    pub clip: Clip,
    /// The seam that was mended, without the way of the hips.
    pub seam: Seam,
}

/// Mends a clip that is to be a loop: its end goes over into its beginning without a jump in place or speed. `None` where it does
/// so already: it is left as it is.
///
/// A clip whose hips come out elsewhere than they begin, by more than a twentieth of the height or 6°, goes on from there in the
/// next round: that way stays. Tracks become cubic; those of what carries the hips have 60 keys a second then.
///
/// # Errors
/// A clip that moves the hips to where no numbers are, or that has more samples, 60 a second, than a bake has keys at most.
pub fn mended_loop(document: &Document, measurement: &Measurement, clip: &Clip) -> Result<Option<MendedLoop>, Error> {
    check_length(clip)?;
    let skeleton = document.skeleton();
    let size = size(measurement);
    let travel = Travel::find(document, measurement, clip, size)?;
    let on_the_spot = travel.as_ref().map_or_else(|| Ok(clip.clone()), |travel| travel.moved(clip, Way::Out))?;
    let seam = on_the_spot.seam();
    let place = seam.place;
    let jumps = (place.translation / size).max(place.rotation_rad).max(place.scale).max(place.scalar) > CLOSED;
    if !jumps && !jerks(skeleton, &on_the_spot, size) {
        return Ok(None);
    }
    let mended = on_the_spot.mended(Continuity::Speed, WINDOW_S);
    let clip = match travel {
        Some(travel) => travel.moved(&mended, Way::Back)?,
        None => mended,
    };
    Ok(Some(MendedLoop { clip, seam }))
}

/// The way of the hips over a clip, their shadow on the ground, 60 samples a second. `None` of what has no hips, and of a clip without
/// length.
///
/// # Errors
/// A clip that moves the hips to where no numbers are, or that has more samples than a bake has keys at most.
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

/// A clip as its seam is judged: without the way of hips that come out elsewhere than they begin, by more than a twentieth of the
/// height or 6°.
///
/// # Errors
/// As [`root_path`].
pub fn on_the_spot(document: &Document, measurement: &Measurement, clip: &Clip) -> Result<Clip, Error> {
    let travel = Travel::find(document, measurement, clip, size(measurement))?;
    travel.map_or_else(|| Ok(clip.clone()), |travel| travel.moved(clip, Way::Out))
}

/// A clip without a movement of its root, as [`Motion::remove`] takes it out of poses: what carries the character has cubic tracks
/// of 60 keys a second then. Bones on which nothing of the clip hangs, such as cameras and lights, stay where they are.
///
/// # Errors
/// A clip that is moved to where no numbers are, or that has more samples than a bake has keys at most.
pub fn in_place(document: &Document, clip: &Clip, motion: Motion) -> Result<Clip, Error> {
    check_length(clip)?;
    Travel::new(document.skeleton(), clip, motion).moved(clip, Way::Out)
}

/// The height, or 1 where there is none.
fn size(measurement: &Measurement) -> f32 {
    if measurement.height > 0.0 { crate::num::narrow(measurement.height) } else { 1.0 }
}

fn check_length(clip: &Clip) -> Result<(), Error> {
    if clip.length_s() * RATE > MOST_KEYS { Err(no_keys(clip.length_s(), RATE)) } else { Ok(()) }
}

/// True if something changes its speed at the seam more than anywhere else.
fn jerks(skeleton: &Skeleton, clip: &Clip, size: f32) -> bool {
    let mut steps = vec![Steps::default(); skeleton.len()];
    let mut before: Option<Vec<Transform>> = None;
    // Two poses at a time: a long clip has very many.
    for time in sample_times(clip.length_s()) {
        let pose = skeleton.pose(clip, time);
        for (steps, (from, to)) in steps.iter_mut().zip(before.iter().flatten().zip(&pose)) {
            steps.push(way(from, to, size));
        }
        before = Some(pose);
    }
    steps.iter().any(Steps::jerk)
}

/// The ways of a bone from sample to sample: the first, the last, and the largest difference of one from the one before.
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

    /// True if the first differs from the last much more than others from the ones before.
    fn jerk(&self) -> bool {
        let seam = self.ends.map_or([0.0; 2], |[first, last]| change(last, first));
        (0..2).any(|kind| seam[kind] > JERK * self.most[kind] + CLOSED)
    }
}

fn change(from: [Vec3; 2], to: [Vec3; 2]) -> [f32; 2] {
    [0, 1].map(|kind| (to[kind] - from[kind]).length())
}

/// The way from one transform to the next, and the turn.
fn way(from: &Transform, to: &Transform, size: f32) -> [Vec3; 2] {
    let turn = aim_runtime::rotation::log(product(to.rotation, from.rotation.conjugate()));
    [(to.translation - from.translation) / size, turn]
}

/// Evenly spaced times from the beginning to the end.
fn sample_times(length_s: f32) -> Vec<f32> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bounded")]
    let steps = (length_s * RATE).ceil().clamp(4.0, 1e6) as u32;
    let part = |step: u32| f64::from(step) / f64::from(steps);
    (0..=steps).map(|step| crate::num::narrow(f64::from(length_s) * part(step))).collect()
}

/// Which way the movement of the root is applied.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Way {
    Out,
    Back,
}

/// The way that the hips go in a clip, and what carries them.
struct Travel<'a> {
    skeleton: &'a Skeleton,
    motion: Motion,
    /// The bones with tracks that hang on none with tracks, and the rest pose of their parents in the world.
    carriers: Vec<(usize, Affine3A)>,
}

impl<'a> Travel<'a> {
    /// `None` where the clip stays where it is.
    fn find(document: &'a Document, measurement: &Measurement, clip: &Clip, size: f32) -> Result<Option<Self>, Error> {
        let Some(path) = root_path(document, measurement, clip)? else { return Ok(None) };
        let [begin, end] = [0.0, clip.length_s()].map(|time| path.at(time));
        let turn = angle(product(end.rotation, begin.rotation.conjugate()));
        if begin.translation.distance(end.translation) <= TRAVEL * size && turn <= TRAVEL_RAD {
            return Ok(None);
        }
        // Along a screw the next round goes on as fast as this one, also round a corner.
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

    /// The clip with this movement taken out, or given back: `P⁻¹ · M(t)^∓¹ · P · local` of each carrier, P what it hangs on.
    fn moved(&self, clip: &Clip, which: Way) -> Result<Clip, Error> {
        let (length, times) = (clip.length_s(), sample_times(clip.length_s()));
        let step = times[1] - times[0];
        let mut moved = clip.clone();
        for &(bone, on) in &self.carriers {
            let mut pose = self.skeleton.rest().to_vec();
            let mut at = |time: f32| {
                clip.sample(time, &mut Cursor::default(), &mut pose);
                let at = self.motion.at(time);
                placed(on, if which == Way::Out { at.rigid_inverse() } else { at }, pose[bone])
            };
            let keys: Vec<Transform> = times.iter().map(|&time| at(time)).collect();
            let places: Vec<Vec3> = keys.iter().map(|key| key.translation).collect();
            let mut turns: Vec<Quat> = Vec::new();
            keys.iter().for_each(|key| turns.push(continuous(turns.last(), key.rotation)));
            // What is to be mended still ends anyhow; what is mended goes on in the next round as in this one, a whole way on.
            let (beyond_places, beyond_turns) = if which == Way::Out {
                (beyond(&places), beyond(&turns))
            } else {
                let whole = self.motion.at(length);
                let [before, after] = [(whole.rigid_inverse(), length - step), (whole, step)]
                    .map(|(whole, time)| placed(on, whole, at(time)));
                let turn = |near: Option<&Quat>, other: Transform| continuous(near, other.rotation);
                ([before.translation, after.translation], [turn(turns.first(), before), turn(turns.last(), after)])
            };
            moved = moved
                .with_translation(bone, smooth(&times, &places, beyond_places)?)
                .with_rotation(bone, smooth(&times, &turns, beyond_turns)?);
        }
        Ok(moved)
    }
}

/// A bone on a parent, moved by a rigid motion of the model.
fn placed(on: Affine3A, by: Transform, local: Transform) -> Transform {
    let moved = on.inverse() * by.to_affine() * on * Transform { scale: Vec3::ONE, ..local }.to_affine();
    Transform { scale: local.scale, ..Transform::from_affine(&moved).unwrap_or(local) }
}

/// The values before the first of some and after the last, on the parabola through three.
fn beyond<T: Copy + Sub<Output = T> + Add<Output = T> + Mul<f32, Output = T>>(values: &[T]) -> [T; 2] {
    let parabola = |a: T, b: T, c: T| (a - b) * 3.0 + c;
    let last = values.len() - 1;
    [parabola(values[0], values[1], values[2]), parabola(values[last], values[last - 1], values[last - 2])]
}

/// A cubic track through values at even times, given the values before and after: its tangents are central differences.
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
