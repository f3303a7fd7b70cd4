//! [`PackedClip`]: a clip whose keys take few bits. `grid.rs` makes values whole numbers, `layout.rs` is one track, `bits.rs` its
//! bits, `segment.rs` two of its keys decoded, and `bytes.rs` the file of it.

mod bits;
mod bytes;
pub(crate) mod grid;
pub(crate) mod layout;
pub(crate) mod segment;

use alloc::string::String;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::ops::Range;

use aim_runtime::glam::{Quat, Vec3};
use bits::BitWriter;
pub use bytes::PackedError;
use grid::{Grid, Parts};
use layout::{Channel, Header, time_bits};
use segment::Segment;

use crate::clip::{Clip, Event, events_passed};
use crate::cursor::Cursor;
use crate::step::Step;
use crate::track::{Curve, Track};
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
    data: Arc<[u8]>,
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
            data: Arc::from([]),
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
        packed.data = bits.into_bytes().into();
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

    /// A cursor at the beginning, for a character that plays this clip: it keeps two keys of each track decoded, some 100 bytes.
    #[must_use]
    pub fn cursor(&self) -> Cursor {
        Cursor::with_room(1, self.tracks.len())
    }

    /// Writes the clip at a time into a pose, as [`Clip::sample`] does: what has no track stays as it is. Does not allocate.
    ///
    /// A track is decoded when the time has passed a key since the cursor was used last; with a cursor of another clip's or by default,
    /// that may have too little room, in each call.
    pub fn sample(&self, time_s: f32, cursor: &mut Cursor, pose: &mut [Transform]) {
        self.each_segment(0..self.of_bones, time_s, cursor, |segment| {
            let Some(bone) = pose.get_mut(segment.target) else { return };
            match segment.channel {
                Channel::Translation => bone.translation = segment.value(time_s),
                Channel::Rotation => bone.rotation = segment.value(time_s),
                Channel::Scale => bone.scale = segment.value(time_s),
                Channel::Scalar => {}
            }
        });
    }

    /// Writes the scalars at a time to the places of their numbers; others stay as they are.
    pub fn sample_scalars(&self, time_s: f32, cursor: &mut Cursor, scalars: &mut [f32]) {
        self.each_segment(self.of_bones..self.tracks.len(), time_s, cursor, |segment| {
            if let Some(scalar) = scalars.get_mut(segment.target) {
                *scalar = segment.value(time_s);
            }
        });
    }

    /// The value of the scalar at a place of the list of scalars.
    pub(crate) fn scalar_in_place(&self, time_s: f32, place: usize) -> f32 {
        let mut value = 0.0;
        let place = self.of_bones + place;
        self.each_segment(place..place + 1, time_s, &mut Cursor::default(), |segment| value = segment.value(time_s));
        value
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

    /// Calls for each of these tracks with its segment at a time.
    #[inline]
    fn each_segment(&self, places: Range<usize>, time_s: f32, cursor: &mut Cursor, mut call: impl FnMut(&Segment)) {
        let segments = cursor.segments.of(&self.data);
        let (mut alone, mut aside) = (None, 0);
        let moment = cursor.keys.first_mut().unwrap_or(&mut aside);
        for (place, position) in self.tracks.iter().enumerate().take(places.end).skip(places.start) {
            let segment = segments.get_mut(place).unwrap_or_else(|| alone.insert(Segment::NONE));
            if !segment.holds_at(time_s) {
                *segment = self.segment(*position, time_s, moment, segment.key);
            }
            call(segment);
        }
    }

    /// The segment of a track at a time, by the moment and the key that are likely.
    #[inline(never)]
    fn segment(&self, position: u32, time_s: f32, moment: &mut usize, key: usize) -> Segment {
        let header = self.header(position);
        let key = self.key_at(&header, self.moment(time_s, moment), key);
        let (data, width) = (&self.data[..], time_bits(self.times.len()));
        let time = |key: usize| self.times.get(header.time(data, key, width)).copied().filter(|_| key < header.keys);
        let times = [time(key), time(key + 1)];
        match header.channel {
            Channel::Translation | Channel::Scale => Segment::new::<Vec3>(&header, data, key, times),
            Channel::Rotation => Segment::new::<Quat>(&header, data, key, times),
            Channel::Scalar => Segment::new::<f32>(&header, data, key, times),
        }
    }

    #[inline]
    fn header(&self, position: u32) -> Header {
        Header::read(&self.data, position as usize, self.times.len())
    }

    /// The number of the last key's time that is not after a time, by the one that is likely; `None` if there is none.
    fn moment(&self, time_s: f32, likely: &mut usize) -> Option<usize> {
        let times = &self.times[..];
        let is_at = |k: usize| {
            times.get(k).is_some_and(|time| *time <= time_s) && times.get(k + 1).is_none_or(|next| time_s < *next)
        };
        // Played forward, the time is the last one found or the next.
        if !is_at(*likely) {
            let next = likely.saturating_add(1);
            *likely = if is_at(next) { next } else { times.partition_point(|time| *time <= time_s).saturating_sub(1) };
        }
        Some(*likely).filter(|likely| is_at(*likely))
    }

    /// The last key that is not after the moment, else the first, by the one that is likely.
    fn key_at(&self, header: &Header, moment: Option<usize>, likely: usize) -> usize {
        let Some(moment) = moment else { return 0 };
        let width = time_bits(self.times.len());
        let last = header.keys.saturating_sub(1);
        let time_of = |key: usize| header.time(&self.data, key, width);
        let is_at = |k: usize| k <= last && time_of(k) <= moment && (k == last || moment < time_of(k + 1));
        let next = likely.saturating_add(1);
        match [likely, next].into_iter().find(|key| is_at(*key)) {
            Some(key) => key,
            None => key_before(last, |key| time_of(key) <= moment),
        }
    }

    /// A track as floats; `None` if it is none.
    fn track<T: Parts>(&self, header: &Header) -> Option<Track<T>> {
        let width = time_bits(self.times.len());
        let times: Option<Vec<f32>> =
            (0..header.keys).map(|key| self.times.get(header.time(&self.data, key, width)).copied()).collect();
        let (mut values, mut tangents): (Vec<T>, Vec<[T; 2]>) = (Vec::new(), Vec::new());
        let (mut before, mut sign): (Option<T>, f32) = (None, 1.0);
        for key in 0..header.keys {
            if header.curve == Curve::Cubic {
                // Of neighbours half a turn apart either form is near: as in a segment, those that are stored decide.
                let (value, of_key) = header.cubic_key(&self.data, key, None);
                let is_near = before.is_none_or(|before| header.near(value, before) == value);
                before = Some(value);
                sign *= if is_near { 1.0 } else { -1.0 };
                values.push(value.times(sign));
                tangents.push(of_key.map(|tangent: T| tangent.times(sign)));
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
