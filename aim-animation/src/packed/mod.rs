//! [`PackedClip`]: a clip whose keys take few bits. `grid.rs` makes values whole numbers, `layout.rs` is one track, `bits.rs` its
//! bits, and `bytes.rs` the file of it.

mod bits;
mod bytes;
pub(crate) mod grid;
pub(crate) mod layout;

use alloc::string::String;
use alloc::sync::Arc;
use alloc::vec::Vec;

use bits::BitWriter;
pub use bytes::PackedError;
use grid::{Grid, Parts};
use layout::{Channel, Header, time_bits};

use crate::clip::{Clip, Cursor, Event, events_passed};
use crate::step::Step;
use crate::track::{Curve, Track, hermite};
use crate::transform::Transform;

/// A clip in a tenth to a quarter of its memory, played from there.
///
/// Made by [`Reduction::pack`](crate::Reduction::pack), which holds a tolerance in the space of the model. The times of keys are exact.
/// Components of vectors are whole numbers of a step, in as many bits as their range in that track takes; so are rotations, by
/// three of their four components over the fourth. Samples have the same bits on every machine.
///
/// ```
/// use aim_animation::glam::Quat;
/// use aim_animation::{Bone, Clip, PackedClip, Reduction, Skeleton, Track};
///
/// let skeleton = Skeleton::new([Bone::new("lever", None)])?;
/// let times: Vec<f32> = (0..=60_u8).map(|k| f32::from(k) / 60.0).collect();
/// let turns: Vec<Quat> = times.iter().map(|t| Quat::from_rotation_z(t * t)).collect();
/// let clip = Clip::new("pull").with_rotation(0, Track::linear(times, turns)?);
///
/// let packed = Reduction::new(1e-3).pack(&clip, &skeleton)?;
/// assert!(packed.error <= 1e-3 && packed.clip.bytes() * 10 < clip.bytes());
/// let mut pose = skeleton.rest().to_vec();
/// packed.clip.sample(0.5, &mut packed.clip.cursor(), &mut pose);
/// assert!(pose[0].rotation.angle_between(Quat::from_rotation_z(0.25)) < 1e-3);
/// assert_eq!(PackedClip::from_bytes(&packed.clip.to_bytes())?, packed.clip);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PackedClip {
    name: String,
    length_s: f32,
    events: Vec<Event>,
    /// The times of all keys, by whose numbers tracks name them: where a track jumps it names one twice.
    times: Vec<f32>,
    /// Where each track begins, in bits: those of bones, then those of scalars.
    tracks: Vec<u32>,
    /// The number of the tracks of bones.
    of_bones: usize,
    /// The tracks, one behind the other.
    data: Vec<u8>,
}

impl PackedClip {
    /// Packs a clip whose values are on the grids; `None` if it has too many keys.
    pub(crate) fn new(clip: &Clip, grids: &Grids) -> Option<Self> {
        let mut packed = Self {
            name: clip.name().into(),
            length_s: clip.length_s(),
            events: clip.events().to_vec(),
            times: times_of(clip),
            tracks: Vec::new(),
            of_bones: 0,
            data: Vec::new(),
        };
        let mut bits = BitWriter::default();
        let mut grids = grids.0.iter().copied();
        let mut grid = || grids.next().flatten();
        for tracks in clip.tracks() {
            let bone = tracks.bone;
            if let Some(track) = &tracks.translation {
                packed.tracks.push(u32::try_from(bits.position()).ok()?);
                layout::write(&mut bits, (Channel::Translation, bone), (track, grid()), &packed.times)?;
            }
            if let Some(track) = &tracks.rotation {
                packed.tracks.push(u32::try_from(bits.position()).ok()?);
                layout::write(&mut bits, (Channel::Rotation, bone), (track, grid()), &packed.times)?;
            }
            if let Some(track) = &tracks.scale {
                packed.tracks.push(u32::try_from(bits.position()).ok()?);
                layout::write(&mut bits, (Channel::Scale, bone), (track, grid()), &packed.times)?;
            }
        }
        packed.of_bones = packed.tracks.len();
        for (index, track) in clip.scalars() {
            packed.tracks.push(u32::try_from(bits.position()).ok()?);
            layout::write(&mut bits, (Channel::Scalar, *index), (track, grid()), &packed.times)?;
        }
        packed.data = bits.into_bytes();
        Some(packed)
    }

    /// The name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The length, seconds.
    #[must_use]
    pub fn length_s(&self) -> f32 {
        self.length_s
    }

    /// The events in the order of their times.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// The events that a step passes; see [`Clip::events_passed`].
    pub fn events_passed<'a>(&'a self, step: &Step) -> impl Iterator<Item = &'a Event> + use<'a> {
        events_passed(&self.events, step)
    }

    /// The bytes of the keys in memory: times, the tracks' headers and keys, and where each track begins. As in
    /// [`Clip::bytes`], names and events are not counted.
    #[must_use]
    pub fn bytes(&self) -> usize {
        4 * (self.times.len() + self.tracks.len()) + self.data.len()
    }

    /// A cursor at the beginning, for a character that plays this clip.
    #[must_use]
    pub fn cursor(&self) -> Cursor {
        Cursor { keys: alloc::vec![0; 1 + self.tracks.len()] }
    }

    /// Writes the clip at a time into a pose, as [`Clip::sample`] does: what has no track stays as it is. Does not allocate.
    pub fn sample(&self, time_s: f32, cursor: &mut Cursor, pose: &mut [Transform]) {
        let moment = self.moment(time_s, cursor);
        for (place, position) in self.tracks.iter().take(self.of_bones).enumerate() {
            let header = self.header(*position);
            let Some(bone) = pose.get_mut(header.target) else { continue };
            let mut aside = 0;
            let key = cursor.keys.get_mut(1 + place).unwrap_or(&mut aside);
            match header.channel {
                Channel::Translation => bone.translation = self.track_at(&header, moment, key),
                Channel::Rotation => bone.rotation = self.track_at(&header, moment, key),
                Channel::Scale => bone.scale = self.track_at(&header, moment, key),
                Channel::Scalar => {}
            }
        }
    }

    /// Writes the scalars at a time to the places of their numbers; others stay as they are.
    pub fn sample_scalars(&self, time_s: f32, cursor: &mut Cursor, scalars: &mut [f32]) {
        let moment = self.moment(time_s, cursor);
        for (place, position) in self.tracks.iter().enumerate().skip(self.of_bones) {
            let header = self.header(*position);
            let Some(scalar) = scalars.get_mut(header.target) else { continue };
            let mut aside = 0;
            *scalar = self.track_at(&header, moment, cursor.keys.get_mut(1 + place).unwrap_or(&mut aside));
        }
    }

    /// The value of the scalar at a place of the list of scalars.
    pub(crate) fn scalar_in_place(&self, time_s: f32, place: usize) -> f32 {
        let Some(position) = self.tracks.get(self.of_bones + place) else { return 0.0 };
        let moment = self.moment(time_s, &mut Cursor::default());
        self.track_at(&self.header(*position), moment, &mut 0)
    }

    /// The clip with its keys as floats: at every time it has the same samples.
    #[must_use]
    pub fn unpacked(&self) -> Clip {
        let mut clip = Clip::new(self.name.clone());
        for position in &self.tracks {
            let header = self.header(*position);
            let target = header.target;
            // Never left out: checked when it was made.
            clip = match header.channel {
                Channel::Translation => match self.track(&header) {
                    Some(track) => clip.with_translation(target, track),
                    None => clip,
                },
                Channel::Rotation => match self.track(&header) {
                    Some(track) => clip.with_rotation(target, track),
                    None => clip,
                },
                Channel::Scale => match self.track(&header) {
                    Some(track) => clip.with_scale(target, track),
                    None => clip,
                },
                Channel::Scalar => match self.track(&header) {
                    Some(track) => clip.with_scalar(target, track),
                    None => clip,
                },
            };
        }
        clip.with_length_and_events(self.length_s, self.events.clone())
    }

    #[inline]
    fn header(&self, position: u32) -> Header {
        Header::read(&self.data, position as usize, self.times.len())
    }

    /// A time, and the number of the last key's time that is not after it.
    fn moment(&self, time_s: f32, cursor: &mut Cursor) -> (f32, Option<usize>) {
        let times = &self.times[..];
        let mut aside = 0;
        let hint = cursor.keys.first_mut().unwrap_or(&mut aside);
        let is_at = |k: usize| {
            times.get(k).is_some_and(|time| *time <= time_s) && times.get(k + 1).is_none_or(|next| time_s < *next)
        };
        // Played forward, the time is the last one found or the next.
        if !is_at(*hint) {
            let next = hint.saturating_add(1);
            *hint = if is_at(next) { next } else { times.partition_point(|time| *time <= time_s).saturating_sub(1) };
        }
        (time_s, Some(*hint).filter(|hint| is_at(*hint)))
    }

    /// The value of a track; the same as that of the track of floats.
    #[inline]
    fn track_at<T: Parts>(&self, header: &Header, (time_s, moment): (f32, Option<usize>), hint: &mut usize) -> T {
        let width = time_bits(self.times.len());
        let last = header.keys.saturating_sub(1);
        let time_of = |key: usize| header.time(&self.data, key, width);
        let key = match moment {
            None => 0,
            Some(moment) => {
                let is_at = |k: usize| k <= last && time_of(k) <= moment && (k == last || moment < time_of(k + 1));
                let next = hint.saturating_add(1);
                if is_at(*hint) {
                    *hint
                } else if is_at(next) {
                    next
                } else {
                    key_before(last, |key| time_of(key) <= moment)
                }
            }
        };
        *hint = key;
        let time = |key: usize| self.times.get(time_of(key)).copied().unwrap_or_default();
        let (from, to) = if key < last { (time(key), time(key + 1)) } else { (f32::INFINITY, f32::INFINITY) };
        if header.curve != Curve::Cubic {
            let value: T = header.value(&self.data, key);
            if !(time_s > from) || header.curve == Curve::Step {
                return value;
            }
            let next = header.value(&self.data, key + 1);
            return value.linear(next, (time_s - from) / (to - from));
        }
        if !(time_s > from) {
            let value: T = header.value(&self.data, key);
            return value.value(value);
        }
        let interval = to - from;
        let (a, [_, out]) = header.cubic_key::<T>(&self.data, key, None);
        let (b, [into, _]) = header.cubic_key(&self.data, key + 1, Some(a));
        hermite([a, out.times(interval), b, into.times(interval)], (time_s - from) / interval).value(a)
    }

    /// A track as floats; `None` if it is none.
    fn track<T: Parts>(&self, header: &Header) -> Option<Track<T>> {
        let width = time_bits(self.times.len());
        let times: Option<Vec<f32>> =
            (0..header.keys).map(|key| self.times.get(header.time(&self.data, key, width)).copied()).collect();
        let (mut values, mut tangents): (Vec<T>, Vec<[T; 2]>) = (Vec::new(), Vec::new());
        for key in 0..header.keys {
            if header.curve == Curve::Cubic {
                let (value, of_key) = header.cubic_key(&self.data, key, values.last().copied());
                values.push(value);
                tangents.push(of_key);
            } else {
                values.push(header.value(&self.data, key));
            }
        }
        Track::assembled(Arc::from(times?), values, tangents, header.curve)
    }
}

/// The last of the keys 0 to `last` of which something holds that holds of all before it; 0 if it holds of none.
fn key_before(last: usize, is_before: impl Fn(usize) -> bool) -> usize {
    let (mut low, mut high) = (0, last + 1);
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if is_before(middle) { low = middle } else { high = middle }
    }
    low
}

/// The grid of each track in the order of the clip: by bone translation, rotation and scale, then scalars. `None` for a track that is stored
/// as it is.
#[derive(Clone, Debug, Default)]
pub(crate) struct Grids(pub(crate) Vec<Option<Grid>>);

/// The times of all keys in their order.
pub(crate) fn times_of(clip: &Clip) -> Vec<f32> {
    let mut all: Vec<f32> = Vec::new();
    // No zero is negative.
    let mut push = |times: &[f32]| all.extend(times.iter().map(|time| time + 0.0));
    for tracks in clip.tracks() {
        [&tracks.translation, &tracks.scale].into_iter().flatten().for_each(|track| push(track.times()));
        tracks.rotation.iter().for_each(|track| push(track.times()));
    }
    clip.scalars().iter().for_each(|(_, track)| push(track.times()));
    all.sort_unstable_by(f32::total_cmp);
    all.dedup();
    all
}
