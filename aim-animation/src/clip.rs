//! [`Clip`]: a named animation of bone tracks, scalar tracks and events.

use alloc::string::String;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt;

use aim_runtime::glam::{Quat, Vec3};

use crate::cursor::Cursor;
use crate::float::narrow;
use crate::step::Step;
use crate::track::Track;
use crate::transform::Transform;

/// A named event at a time of a clip, such as a footstep.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Local time, seconds.
    pub time_s: f32,
    /// The event's name.
    pub name: String,
}

/// Error of [`Clip::with_event`]: the time is negative or not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EventError {
    /// The rejected time, seconds.
    pub time_s: f32,
}

impl fmt::Display for EventError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the time of an event is {} s; it may not be negative and has to be finite", self.time_s)
    }
}

impl core::error::Error for EventError {}

/// The tracks of one bone. A component without a track keeps its value in the pose.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct BoneTracks {
    /// Index of the bone in the skeleton.
    pub bone: usize,
    /// Translation in the parent's space.
    pub translation: Option<Track<Vec3>>,
    /// Rotation in the parent's space.
    pub rotation: Option<Track<Quat>>,
    /// Scale along the bone's own axes.
    pub scale: Option<Track<Vec3>>,
}

/// A named animation: tracks of bones, tracks of scalars such as morph weights, and events.
///
/// A clip does not refer to a skeleton. Its bones are indices into the skeleton that it is played on; indices past that
/// skeleton's end are ignored.
///
/// ```
/// use aim_animation::glam::Quat;
/// use aim_animation::{Clip, Track, Transform};
///
/// let nod = Track::linear([0.0, 0.5, 1.0], [0.0, 0.4, 0.0].map(Quat::from_rotation_x))?;
/// let clip = Clip::new("nod").with_rotation(3, nod).with_event(0.5, "bow")?;
/// let mut pose = [Transform::IDENTITY; 4];
/// clip.sample(0.25, &mut clip.cursor(), &mut pose);
/// assert!(pose[3].rotation.angle_between(Quat::from_rotation_x(0.2)) < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Clip {
    name: String,
    length_s: f32,
    tracks: Vec<BoneTracks>,
    scalars: Vec<(usize, Track<f32>)>,
    events: Vec<Event>,
}

impl Clip {
    /// Creates an empty clip of length 0.
    #[must_use]
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), ..Self::default() }
    }

    /// Sets the name.
    #[must_use]
    pub fn with_name(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// Raises the length to at least `length_s` seconds. NaN and infinity are ignored.
    ///
    /// By default, the length is the time of the last key or event.
    #[must_use]
    pub fn with_length(mut self, length_s: f32) -> Self {
        if length_s.is_finite() {
            self.length_s = self.length_s.max(length_s);
        }
        self
    }

    /// Sets the translation track of a bone, replacing any previous one.
    #[must_use]
    pub fn with_translation(mut self, bone: usize, track: Track<Vec3>) -> Self {
        self.length_s = self.length_s.max(track.end_s());
        self.bone_mut(bone).translation = Some(track);
        self
    }

    /// Sets the rotation track of a bone, replacing any previous one.
    #[must_use]
    pub fn with_rotation(mut self, bone: usize, track: Track<Quat>) -> Self {
        self.length_s = self.length_s.max(track.end_s());
        self.bone_mut(bone).rotation = Some(track);
        self
    }

    /// Sets the scale track of a bone, replacing any previous one.
    #[must_use]
    pub fn with_scale(mut self, bone: usize, track: Track<Vec3>) -> Self {
        self.length_s = self.length_s.max(track.end_s());
        self.bone_mut(bone).scale = Some(track);
        self
    }

    /// Sets the track of a scalar, such as a morph weight, replacing any previous one. `index` is chosen by the caller.
    #[must_use]
    pub fn with_scalar(mut self, index: usize, track: Track<f32>) -> Self {
        self.length_s = self.length_s.max(track.end_s());
        match self.scalars.binary_search_by_key(&index, |(other, _)| *other) {
            Ok(place) => self.scalars[place].1 = track,
            Err(place) => self.scalars.insert(place, (index, track)),
        }
        self
    }

    /// Adds an event. Events of the same time keep the order in which they were added.
    ///
    /// # Errors
    /// Fails if the time is negative or not finite.
    pub fn with_event(mut self, time_s: f32, name: impl Into<String>) -> Result<Self, EventError> {
        if !(time_s.is_finite() && time_s >= 0.0) {
            return Err(EventError { time_s });
        }
        self.length_s = self.length_s.max(time_s);
        let place = self.events.partition_point(|event| event.time_s <= time_s);
        self.events.insert(place, Event { time_s, name: name.into() });
        Ok(self)
    }

    /// Returns the name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the length, seconds.
    #[must_use]
    pub fn length_s(&self) -> f32 {
        self.length_s
    }

    /// Returns the tracks of all bones, in ascending order of bones.
    #[must_use]
    pub fn tracks(&self) -> &[BoneTracks] {
        &self.tracks
    }

    /// Returns the tracks of a bone; `None` if it has none.
    #[must_use]
    pub fn bone(&self, bone: usize) -> Option<&BoneTracks> {
        self.tracks.binary_search_by_key(&bone, |tracks| tracks.bone).ok().map(|at| &self.tracks[at])
    }

    /// Returns the scalar tracks with their indices, in ascending order of indices.
    #[must_use]
    pub fn scalars(&self) -> &[(usize, Track<f32>)] {
        &self.scalars
    }

    /// Returns the events, in ascending order of times.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Returns the memory size of the keys, bytes: 4 for each number of their times, values and tangents.
    ///
    /// Times that several tracks share are counted once. Names and events are not counted.
    ///
    /// ```
    /// use aim_animation::glam::Vec3;
    /// use aim_animation::{Clip, Track};
    ///
    /// let slide = Track::linear([0.0, 1.0], [Vec3::ZERO, Vec3::X])?;
    /// assert_eq!(Clip::new("slide").with_translation(0, slide).bytes(), 2 * 4 * (1 + 3));
    /// # Ok::<(), aim_animation::TrackError>(())
    /// ```
    #[must_use]
    pub fn bytes(&self) -> usize {
        let mut shared = Vec::new();
        let mut values = 0;
        let mut count = |times: &Arc<[f32]>, of_values: usize| {
            shared.push((times.as_ptr() as usize, times.len()));
            values += of_values;
        };
        for tracks in &self.tracks {
            for track in [&tracks.translation, &tracks.scale].into_iter().flatten() {
                count(track.shared_times(), track.value_bytes());
            }
            if let Some(track) = &tracks.rotation {
                count(track.shared_times(), track.value_bytes());
            }
        }
        for (_, track) in &self.scalars {
            count(track.shared_times(), track.value_bytes());
        }
        shared.sort_unstable();
        shared.dedup();
        values + 4 * shared.iter().map(|(_, keys)| keys).sum::<usize>()
    }

    /// Creates a cursor at the beginning, for one character that plays this clip.
    #[must_use]
    pub fn cursor(&self) -> Cursor {
        Cursor::with_room(3 * self.tracks.len() + self.scalars.len(), 0)
    }

    /// Samples the clip at a local time, seconds, and writes the result into a local pose. Does not allocate.
    ///
    /// Components without a track keep their value. Start from the skeleton's rest pose, so that bones moved only by a
    /// previous clip return to rest.
    pub fn sample(&self, time_s: f32, cursor: &mut Cursor, pose: &mut [Transform]) {
        let mut aside = [0; 3];
        for (index, tracks) in self.tracks.iter().enumerate() {
            let Some(bone) = pose.get_mut(tracks.bone) else { continue };
            let keys = cursor.keys.get_mut(3 * index..3 * index + 3).unwrap_or(&mut aside);
            if let Some(track) = &tracks.translation {
                bone.translation = track.sample_near(time_s, &mut keys[0]);
            }
            if let Some(track) = &tracks.rotation {
                bone.rotation = track.sample_near(time_s, &mut keys[1]);
            }
            if let Some(track) = &tracks.scale {
                bone.scale = track.sample_near(time_s, &mut keys[2]);
            }
        }
    }

    /// Samples the scalar tracks at a local time, seconds, and writes each to `scalars[index]`.
    ///
    /// Elements without a track keep their value; tracks with an index past the slice's end are ignored.
    pub fn sample_scalars(&self, time_s: f32, cursor: &mut Cursor, scalars: &mut [f32]) {
        for (place, (index, track)) in self.scalars.iter().enumerate() {
            if let Some(scalar) = scalars.get_mut(*index) {
                let key = cursor.keys.get_mut(3 * self.tracks.len() + place);
                *scalar = track.sample_near(time_s, key.unwrap_or(&mut 0));
            }
        }
    }

    /// Returns the events passed by a step, in the order in which they are passed, each as often as it is passed.
    pub fn events_passed<'a>(&'a self, step: &Step) -> impl Iterator<Item = &'a Event> + use<'a> {
        events_passed(&self.events, step)
    }

    /// Removes the tracks of a bone.
    #[must_use]
    pub fn without(mut self, bone: usize) -> Self {
        self.tracks.retain(|tracks| tracks.bone != bone);
        self
    }

    /// Replaces each bone index by `bone_of(index)`, for a skeleton with another order of bones, or from a file's
    /// order.
    ///
    /// Bones mapped to `None` are removed. If two bones are mapped to the same one, the tracks of the later replace
    /// those of the earlier.
    #[must_use]
    pub fn with_bones_mapped(mut self, bone_of: impl Fn(usize) -> Option<usize>) -> Self {
        for tracks in core::mem::take(&mut self.tracks) {
            if let Some(bone) = bone_of(tracks.bone) {
                *self.bone_mut(bone) = BoneTracks { bone, ..tracks };
            }
        }
        self
    }

    /// Returns the clip with every track replaced by a linear one of `rate_hz` keys a second: see [`Track::resampled`].
    #[must_use]
    pub fn resampled(&self, rate_hz: f32) -> Self {
        let length = self.length_s;
        self.edited(Edit {
            vector: &|track| track.resampled(rate_hz, length),
            rotation: &|track| track.resampled(rate_hz, length),
            scalar: &|track| track.resampled(rate_hz, length),
        })
    }

    /// Returns the clip with a length of `length_s` seconds: repeated with its events if that is longer than the clip,
    /// cut if it is shorter.
    ///
    /// Keys keep their values. If the last pose differs from the first, the result jumps at each seam, as looped
    /// playback does.
    ///
    /// Returns an unchanged clone if the clip's length is 0, or if `length_s` is not positive and finite. To bound
    /// memory, repetition stops after 65 535 rounds, 2²³ keys or 2²⁰ events, and the result is then shorter than
    /// `length_s`.
    #[must_use]
    pub fn repeated(&self, length_s: f32) -> Self {
        let period = self.length_s;
        if !(length_s > 0.0 && length_s.is_finite() && period > 0.0) || length_s == period {
            return self.clone();
        }
        let keys = |tracks: &BoneTracks| {
            let vectors = [&tracks.translation, &tracks.scale].into_iter().flatten().map(|track| track.times().len());
            vectors.chain(tracks.rotation.as_ref().map(|track| track.times().len())).map(|keys| keys + 2).sum::<usize>()
        };
        let scalars = self.scalars.iter().map(|(_, track)| track.times().len() + 2);
        let round: usize = self.tracks.iter().map(keys).chain(scalars).sum();
        let rounds = ((1 << 23) / round.max(1)).min((1 << 20) / self.events.len().max(1));
        let rounds = u16::try_from(rounds).unwrap_or(u16::MAX).max(1);
        let end = length_s.min(period * f32::from(rounds));
        let mut repeated = self.edited(Edit {
            vector: &|track| track.repeated(period, end),
            rotation: &|track| track.repeated(period, end),
            scalar: &|track| track.repeated(period, end),
        });
        let ends = |round: u16| [round, round + 1].map(|round| f32::from(round) * period);
        let starts = (0..rounds).map(ends).take_while(|[start, _]| *start < end);
        // Clamped to the start of the next round, so that rounding cannot put events out of order.
        let events = |[start, next]: [f32; 2]| {
            self.events.iter().map(move |event| Event { time_s: (start + event.time_s).min(next), ..event.clone() })
        };
        repeated.events = starts.flat_map(events).filter(|event| event.time_s <= end).collect();
        repeated.length_s = end;
        repeated
    }

    /// Returns the part of the clip between two times, seconds, with its events, shifted to begin at 0.
    ///
    /// The times are clamped to 0…length. If `from_s` is not before `to_s`, the length of the result is 0.
    ///
    /// ```
    /// use aim_animation::Clip;
    ///
    /// let clip = Clip::new("walk").with_length(2.0).with_event(0.5, "left")?.with_event(1.5, "right")?;
    /// let second = clip.cut(1.0, 2.0);
    /// assert_eq!((second.length_s(), second.events()[0].time_s), (1.0, 0.5));
    /// assert_eq!(clip.reversed().events()[0].name, "right");
    /// assert_eq!(second.repeated(3.0).events().len(), 3);
    /// # Ok::<(), aim_animation::EventError>(())
    /// ```
    #[must_use]
    pub fn cut(&self, from_s: f32, to_s: f32) -> Self {
        let inside = |time: f32| time.max(0.0).min(self.length_s);
        let (from, to) = (inside(from_s), inside(to_s));
        let mut piece = self.edited(Edit {
            vector: &|track| track.cut(from, to),
            rotation: &|track| track.cut(from, to),
            scalar: &|track| track.cut(from, to),
        });
        piece.length_s = (to - from).max(0.0);
        piece.events.retain(|event| from <= event.time_s && event.time_s <= to);
        piece.events.iter_mut().for_each(|event| event.time_s -= from);
        piece
    }

    /// Returns the clip reversed in time, with its events.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let length = self.length_s;
        let mut reversed = self.edited(Edit {
            vector: &|track| track.reversed(length),
            rotation: &|track| track.reversed(length),
            scalar: &|track| track.reversed(length),
        });
        reversed.events.reverse();
        reversed.events.iter_mut().for_each(|event| event.time_s = length - event.time_s);
        reversed
    }

    pub(crate) fn edited(&self, edit: Edit<'_>) -> Self {
        let bone = |tracks: &BoneTracks| BoneTracks {
            bone: tracks.bone,
            translation: tracks.translation.as_ref().map(edit.vector),
            rotation: tracks.rotation.as_ref().map(edit.rotation),
            scale: tracks.scale.as_ref().map(edit.vector),
        };
        Self {
            tracks: self.tracks.iter().map(bone).collect(),
            scalars: self.scalars.iter().map(|(index, track)| (*index, (edit.scalar)(track))).collect(),
            name: self.name.clone(),
            events: self.events.clone(),
            length_s: self.length_s,
        }
    }

    /// Replaces the length and the events. The events must be sorted by time.
    pub(crate) fn with_length_and_events(mut self, length_s: f32, events: Vec<Event>) -> Self {
        (self.length_s, self.events) = (length_s, events);
        self
    }

    /// Returns the tracks of a bone, inserting empty ones if the bone has none. Keeps the list sorted by bone.
    pub(crate) fn bone_mut(&mut self, bone: usize) -> &mut BoneTracks {
        let place = self.tracks.binary_search_by_key(&bone, |tracks| tracks.bone).unwrap_or_else(|place| {
            self.tracks.insert(place, BoneTracks { bone, translation: None, rotation: None, scale: None });
            place
        });
        &mut self.tracks[place]
    }
}

/// Returns those of `all`, sorted by time, that a step passes.
pub(crate) fn events_passed<'a>(all: &'a [Event], step: &Step) -> impl Iterator<Item = &'a Event> + use<'a> {
    step.pieces().flat_map(move |piece| {
        let [low, high] = [piece.from_s.min(piece.to_s), piece.from_s.max(piece.to_s)];
        let first = all.partition_point(|event| f64::from(event.time_s) < low);
        let last = all.partition_point(|event| f64::from(event.time_s) <= high).max(first);
        let events = &all[first..last];
        // An event at the very start was already reported by the previous step, unless the piece includes its start.
        let is_told = move |event: &&Event| piece.includes_from || f64::from(event.time_s) != piece.from_s;
        let backward = piece.to_s < piece.from_s;
        let [forward, back] = if backward { [&[][..], events] } else { [events, &[][..]] };
        forward.iter().chain(back.iter().rev()).filter(is_told)
    })
}

/// The same edit for each type of track: vectors, rotations and scalars.
pub(crate) struct Edit<'a> {
    pub(crate) vector: &'a dyn Fn(&Track<Vec3>) -> Track<Vec3>,
    pub(crate) rotation: &'a dyn Fn(&Track<Quat>) -> Track<Quat>,
    pub(crate) scalar: &'a dyn Fn(&Track<f32>) -> Track<f32>,
}

/// Upper limit of the number of intervals between the samples of a clip.
const MOST_SAMPLES: f32 = 1_048_576.0;

/// Returns evenly spaced times from 0 to `length_s` inclusive, seconds: at least `rate_hz` a second, as far as
/// [`MOST_SAMPLES`] allows.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive and bounded")]
pub(crate) fn sample_times(length_s: f32, rate_hz: f32) -> Vec<f32> {
    let steps = (length_s * rate_hz).max(1.0).min(MOST_SAMPLES);
    let whole = steps as u32;
    let steps = if f64::from(whole) < f64::from(steps) { whole + 1 } else { whole };
    let time = |step| narrow(f64::from(length_s) * (f64::from(step) / f64::from(steps)));
    let mut times: Vec<f32> = (0..=steps).map(time).collect();
    // In a very short clip, neighbouring times may round to the same number.
    times.dedup();
    times
}
