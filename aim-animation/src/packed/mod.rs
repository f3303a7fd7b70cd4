//! [`PackedClip`]: a compressed clip. `grid.rs` quantises values, `layout.rs` encodes one track, `bits.rs` reads and
//! writes bits, `segment.rs` decodes two neighbouring keys, and `bytes.rs` is the file format.

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
use grid::{Grid, Packable};
use layout::{Channel, Header, time_bits};
use segment::Segment;

use crate::clip::{Clip, Event, events_passed};
use crate::cursor::Cursor;
use crate::step::Step;
use crate::track::{Curve, Track};
use crate::transform::Transform;

/// A compressed clip: a tenth to a quarter of the memory, sampled without unpacking.
///
/// Made by [`Reduction::pack`](crate::Reduction::pack), which keeps its error within a tolerance in model space. The
/// times of keys are exact. Components of vectors are integer multiples of a step, in as many bits as their range in
/// that track needs. Rotations are stored the same way, as three components divided by the fourth. Samples are
/// bit-identical on every machine.
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
    /// Times of all keys, without duplicates; tracks refer to them by index. A track that jumps refers to one of them
    /// twice.
    times: Vec<f32>,
    /// Start of each track in `data`, in bits: tracks of bones, then those of scalars.
    tracks: Vec<u32>,
    /// Number of tracks of bones.
    of_bones: usize,
    /// The encoded tracks, one after the other.
    data: Arc<[u8]>,
}

impl PackedClip {
    /// Packs a clip whose values are on the grids; `None` if a track would start beyond 2³² bits, or a count does not
    /// fit.
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

    /// Name of the clip.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Length, seconds.
    #[must_use]
    pub fn length_s(&self) -> f32 {
        self.length_s
    }

    /// Events, in order of time.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Events that a step passes; see [`Clip::events_passed`].
    pub fn events_passed<'a>(&'a self, step: &Step) -> impl Iterator<Item = &'a Event> + use<'a> {
        events_passed(&self.events, step)
    }

    /// Size of the keys in memory, bytes: times, the headers and keys of the tracks, and the start of each track. As in
    /// [`Clip::bytes`], names and events are not counted.
    #[must_use]
    pub fn bytes(&self) -> usize {
        4 * (self.times.len() + self.tracks.len()) + self.data.len()
    }

    /// A cursor at the beginning, for one character that plays this clip. It caches two decoded keys of each track,
    /// about 100 bytes.
    #[must_use]
    pub fn cursor(&self) -> Cursor {
        Cursor::with_room(1, self.tracks.len())
    }

    /// Writes the clip at a time into a pose, as [`Clip::sample`] does: bones without a track do not change. Does not
    /// allocate.
    ///
    /// A track is decoded again only when the time has passed a key since the cursor was last used. With a default
    /// cursor, or one of another clip, which may have too little room, it is decoded in every call.
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

    /// Writes the scalars at a time to `scalars`, each at the index of its number; other elements do not change.
    pub fn sample_scalars(&self, time_s: f32, cursor: &mut Cursor, scalars: &mut [f32]) {
        self.each_segment(self.of_bones..self.tracks.len(), time_s, cursor, |segment| {
            if let Some(scalar) = scalars.get_mut(segment.target) {
                *scalar = segment.value(time_s);
            }
        });
    }

    /// Value of the scalar at index `place` of the list of scalars.
    pub(crate) fn scalar_in_place(&self, time_s: f32, place: usize) -> f32 {
        let mut value = 0.0;
        let place = self.of_bones + place;
        self.each_segment(place..place + 1, time_s, &mut Cursor::default(), |segment| value = segment.value(time_s));
        value
    }

    /// Returns the clip with its keys as floats; its samples are the same at every time.
    #[must_use]
    pub fn unpacked(&self) -> Clip {
        let mut clip = Clip::new(self.name.clone());
        for position in &self.tracks {
            let header = self.header(*position);
            let target = header.target;
            // Always `Some`: checked when the clip was made.
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

    /// Calls `call` for each of these tracks with its segment at a time.
    #[inline]
    fn each_segment(&self, places: Range<usize>, time_s: f32, cursor: &mut Cursor, mut call: impl FnMut(&Segment)) {
        let segments = cursor.segments.of(&self.data);
        let (mut alone, mut aside) = (None, 0);
        let time_index = cursor.keys.first_mut().unwrap_or(&mut aside);
        for (place, position) in self.tracks.iter().enumerate().take(places.end).skip(places.start) {
            let segment = segments.get_mut(place).unwrap_or_else(|| alone.insert(Segment::NONE));
            if !segment.holds_at(time_s) {
                *segment = self.segment(*position, time_s, time_index, segment.key);
            }
            call(segment);
        }
    }

    /// Decodes the segment of a track at a time. `time_index` and `key` are guesses for the indices of the time and the
    /// key.
    #[inline(never)]
    fn segment(&self, position: u32, time_s: f32, time_index: &mut usize, key: usize) -> Segment {
        let header = self.header(position);
        let key = self.key_at(&header, self.time_index(time_s, time_index), key);
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

    /// Index of the last key time that is not after `time_s`, or `None` if there is none. Tries `guess` and its
    /// successor first.
    fn time_index(&self, time_s: f32, guess: &mut usize) -> Option<usize> {
        let times = &self.times[..];
        let is_at = |k: usize| {
            times.get(k).is_some_and(|time| *time <= time_s) && times.get(k + 1).is_none_or(|next| time_s < *next)
        };
        // In forward playback the time is in the interval found last, or in the next.
        if !is_at(*guess) {
            let next = guess.saturating_add(1);
            *guess = if is_at(next) { next } else { times.partition_point(|time| *time <= time_s).saturating_sub(1) };
        }
        Some(*guess).filter(|guess| is_at(*guess))
    }

    /// Index of the last key that is not after the time index, or else of the first key. Tries `guess` and its
    /// successor first.
    fn key_at(&self, header: &Header, time_index: Option<usize>, guess: usize) -> usize {
        let Some(time_index) = time_index else { return 0 };
        let width = time_bits(self.times.len());
        let last = header.keys.saturating_sub(1);
        let time_of = |key: usize| header.time(&self.data, key, width);
        let is_at = |k: usize| k <= last && time_of(k) <= time_index && (k == last || time_index < time_of(k + 1));
        let next = guess.saturating_add(1);
        match [guess, next].into_iter().find(|key| is_at(*key)) {
            Some(key) => key,
            None => key_before(last, |key| time_of(key) <= time_index),
        }
    }

    /// Decodes a track to floats; `None` if the data is invalid.
    fn track<T: Packable>(&self, header: &Header) -> Option<Track<T>> {
        let width = time_bits(self.times.len());
        let times: Option<Vec<f32>> =
            (0..header.keys).map(|key| self.times.get(header.time(&self.data, key, width)).copied()).collect();
        let (mut values, mut tangents): (Vec<T>, Vec<[T; 2]>) = (Vec::new(), Vec::new());
        let (mut before, mut sign): (Option<T>, f32) = (None, 1.0);
        for key in 0..header.keys {
            if header.curve == Curve::Cubic {
                // For neighbours half a turn apart, both signs of the quaternion are equally near: compare the stored
                // values, as a segment does.
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

/// Binary search: returns the last key in 0…`last` for which `is_before` holds; 0 if it holds for none. It must hold
/// for a prefix.
fn key_before(last: usize, is_before: impl Fn(usize) -> bool) -> usize {
    let (mut low, mut high) = (0, last + 1);
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if is_before(middle) { low = middle } else { high = middle }
    }
    low
}

/// The grid of each track, in the order of the clip: translation, rotation and scale bone by bone, then scalars. `None`
/// for a track that is stored exactly.
#[derive(Clone, Debug, Default)]
pub(crate) struct Grids(pub(crate) Vec<Option<Grid>>);

/// Times of all keys, sorted and without duplicates.
pub(crate) fn times_of(clip: &Clip) -> Vec<f32> {
    let mut all: Vec<f32> = Vec::new();
    // Adding 0 turns −0 into 0.
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
