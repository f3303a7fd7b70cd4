//! [`Clip`]: tracks of bones and of scalars, and events.

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

/// Something that happens at a time of a clip: a foot that comes down.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// The time, seconds.
    pub time_s: f32,
    /// The event's name.
    pub name: String,
}

/// An event's time is negative or not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EventError {
    /// The time.
    pub time_s: f32,
}

impl fmt::Display for EventError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the time of an event is {} s; it may not be negative and has to be finite", self.time_s)
    }
}

impl core::error::Error for EventError {}

/// The tracks of one bone; what has no track is not moved.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct BoneTracks {
    /// The bone, in the skeleton's order.
    pub bone: usize,
    /// Its translation in its parent's space.
    pub translation: Option<Track<Vec3>>,
    /// Its rotation in its parent's space.
    pub rotation: Option<Track<Quat>>,
    /// Its scale.
    pub scale: Option<Track<Vec3>>,
}

/// A named animation: tracks by bone, tracks of scalars such as morph weights, and events. It knows no skeleton; bones
/// are numbers in the order of the skeleton that it is played on, and those past its end are ignored.
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
    /// A clip without tracks.
    #[must_use]
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), ..Self::default() }
    }

    /// Under another name.
    #[must_use]
    pub fn with_name(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// With a length of at least this, seconds; without, it is the time of the last key or event. NaN and infinity are ignored.
    #[must_use]
    pub fn with_length(mut self, length_s: f32) -> Self {
        if length_s.is_finite() {
            self.length_s = self.length_s.max(length_s);
        }
        self
    }

    /// With a translation track of a bone, in place of another one.
    #[must_use]
    pub fn with_translation(mut self, bone: usize, track: Track<Vec3>) -> Self {
        self.length_s = self.length_s.max(track.end_s());
        self.bone_mut(bone).translation = Some(track);
        self
    }

    /// With a rotation track of a bone, in place of another one.
    #[must_use]
    pub fn with_rotation(mut self, bone: usize, track: Track<Quat>) -> Self {
        self.length_s = self.length_s.max(track.end_s());
        self.bone_mut(bone).rotation = Some(track);
        self
    }

    /// With a scale track of a bone, in place of another one.
    #[must_use]
    pub fn with_scale(mut self, bone: usize, track: Track<Vec3>) -> Self {
        self.length_s = self.length_s.max(track.end_s());
        self.bone_mut(bone).scale = Some(track);
        self
    }

    /// With a track of a scalar, such as a morph weight, under a number of the caller's, in place of another one.
    #[must_use]
    pub fn with_scalar(mut self, index: usize, track: Track<f32>) -> Self {
        self.length_s = self.length_s.max(track.end_s());
        match self.scalars.binary_search_by_key(&index, |(other, _)| *other) {
            Ok(place) => self.scalars[place].1 = track,
            Err(place) => self.scalars.insert(place, (index, track)),
        }
        self
    }

    /// With an event; those of one time keep the order in which they were added.
    ///
    /// # Errors
    /// The time is negative or not finite.
    pub fn with_event(mut self, time_s: f32, name: impl Into<String>) -> Result<Self, EventError> {
        if !(time_s.is_finite() && time_s >= 0.0) {
            return Err(EventError { time_s });
        }
        self.length_s = self.length_s.max(time_s);
        let place = self.events.partition_point(|event| event.time_s <= time_s);
        self.events.insert(place, Event { time_s, name: name.into() });
        Ok(self)
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

    /// The tracks, bone by bone.
    #[must_use]
    pub fn tracks(&self) -> &[BoneTracks] {
        &self.tracks
    }

    /// The tracks of a bone.
    #[must_use]
    pub fn bone(&self, bone: usize) -> Option<&BoneTracks> {
        self.tracks.binary_search_by_key(&bone, |tracks| tracks.bone).ok().map(|at| &self.tracks[at])
    }

    /// The tracks of scalars in the order of their numbers.
    #[must_use]
    pub fn scalars(&self) -> &[(usize, Track<f32>)] {
        &self.scalars
    }

    /// The events in the order of their times.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// The bytes of the keys as they are stored: 4 for each number of their times, values and tangents. Times that tracks
    /// share count once; names and events do not.
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

    /// A cursor at the beginning, for a character that plays this clip.
    #[must_use]
    pub fn cursor(&self) -> Cursor {
        Cursor::with_room(3 * self.tracks.len() + self.scalars.len(), 0)
    }

    /// Writes the clip at a time into a pose. What has no track stays as it is: start from the skeleton's rest pose, so that
    /// bones which only another clip moves come back. Does not allocate.
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

    /// Writes the scalars at a time to the places of their numbers; others stay as they are.
    pub fn sample_scalars(&self, time_s: f32, cursor: &mut Cursor, scalars: &mut [f32]) {
        for (place, (index, track)) in self.scalars.iter().enumerate() {
            if let Some(scalar) = scalars.get_mut(*index) {
                let key = cursor.keys.get_mut(3 * self.tracks.len() + place);
                *scalar = track.sample_near(time_s, key.unwrap_or(&mut 0));
            }
        }
    }

    /// The events that a step passes, in the order in which it does, each as often as it is passed.
    pub fn events_passed<'a>(&'a self, step: &Step) -> impl Iterator<Item = &'a Event> + use<'a> {
        events_passed(&self.events, step)
    }

    /// The same clip without the tracks of a bone.
    #[must_use]
    pub fn without(mut self, bone: usize) -> Self {
        self.tracks.retain(|tracks| tracks.bone != bone);
        self
    }

    /// The same clip for bones in another order: a file's, or another skeleton's. Bones that lead to `None` are left out;
    /// of two that lead to one bone the later counts.
    #[must_use]
    pub fn with_bones_mapped(mut self, bone_of: impl Fn(usize) -> Option<usize>) -> Self {
        for tracks in core::mem::take(&mut self.tracks) {
            if let Some(bone) = bone_of(tracks.bone) {
                *self.bone_mut(bone) = BoneTracks { bone, ..tracks };
            }
        }
        self
    }

    /// Linear tracks of `rate_hz` keys a second in place of all tracks; see [`Track::resampled`].
    #[must_use]
    pub fn resampled(&self, rate_hz: f32) -> Self {
        let length = self.length_s;
        self.edited(Edit {
            vector: &|track| track.resampled(rate_hz, length),
            rotation: &|track| track.resampled(rate_hz, length),
            scalar: &|track| track.resampled(rate_hz, length),
        })
    }

    /// The clip made `length_s` long: repeated where that is more than its own length, with its events, and cut where it is less.
    /// Keys keep their values. Where the last pose differs from the first the seam jumps, as a player's loop does.
    ///
    /// A clip without length stays as it is, and so does one that is asked for a length that is not positive and finite. Repeats
    /// end early where they would not fit into memory: after 65 535 rounds, 2²³ keys or 2²⁰ events.
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
        // Rounding brings no event past the next round's start, so that all are in order.
        let events = |[start, next]: [f32; 2]| {
            self.events.iter().map(move |event| Event { time_s: (start + event.time_s).min(next), ..event.clone() })
        };
        repeated.events = starts.flat_map(events).filter(|event| event.time_s <= end).collect();
        repeated.length_s = end;
        repeated
    }

    /// The piece between two times, which then begins at 0, with the events in it; times are clamped to the clip's.
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

    /// The clip played backwards, its events too.
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

    /// With the length and the events of another clip, which are in order.
    pub(crate) fn with_length_and_events(mut self, length_s: f32, events: Vec<Event>) -> Self {
        (self.length_s, self.events) = (length_s, events);
        self
    }

    /// The tracks of a bone, made where there are none. Bones are sorted.
    pub(crate) fn bone_mut(&mut self, bone: usize) -> &mut BoneTracks {
        let place = self.tracks.binary_search_by_key(&bone, |tracks| tracks.bone).unwrap_or_else(|place| {
            self.tracks.insert(place, BoneTracks { bone, translation: None, rotation: None, scale: None });
            place
        });
        &mut self.tracks[place]
    }
}

/// Of events in the order of their times those that a step passes.
pub(crate) fn events_passed<'a>(all: &'a [Event], step: &Step) -> impl Iterator<Item = &'a Event> + use<'a> {
    step.pieces().flat_map(move |piece| {
        let [low, high] = [piece.from_s.min(piece.to_s), piece.from_s.max(piece.to_s)];
        let first = all.partition_point(|event| f64::from(event.time_s) < low);
        let last = all.partition_point(|event| f64::from(event.time_s) <= high).max(first);
        let events = &all[first..last];
        // What lies where a step begins was told by the step before.
        let is_told = move |event: &&Event| piece.includes_from || f64::from(event.time_s) != piece.from_s;
        let backward = piece.to_s < piece.from_s;
        let [forward, back] = if backward { [&[][..], events] } else { [events, &[][..]] };
        forward.iter().chain(back.iter().rev()).filter(is_told)
    })
}

/// An edit of each kind of track.
pub(crate) struct Edit<'a> {
    pub(crate) vector: &'a dyn Fn(&Track<Vec3>) -> Track<Vec3>,
    pub(crate) rotation: &'a dyn Fn(&Track<Quat>) -> Track<Quat>,
    pub(crate) scalar: &'a dyn Fn(&Track<f32>) -> Track<f32>,
}

/// The most samples of a clip.
const MOST_SAMPLES: f32 = 1_048_576.0;

/// Evenly spaced times from 0 to a length, both included.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive and bounded")]
pub(crate) fn sample_times(length_s: f32, rate_hz: f32) -> Vec<f32> {
    let steps = (length_s * rate_hz).max(1.0).min(MOST_SAMPLES);
    let whole = steps as u32;
    let steps = if f64::from(whole) < f64::from(steps) { whole + 1 } else { whole };
    let time = |step| narrow(f64::from(length_s) * (f64::from(step) / f64::from(steps)));
    let mut times: Vec<f32> = (0..=steps).map(time).collect();
    // Of a very short clip.
    times.dedup();
    times
}
