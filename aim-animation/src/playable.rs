//! [`PlayableClip`]: a clip that can be played, packed or not.

use core::fmt::Debug;

use crate::clip::{Clip, Event};
use crate::cursor::Cursor;
use crate::packed::PackedClip;
use crate::transform::Transform;

/// A clip that can be played, packed or not.
pub(crate) trait PlayableClip: Debug {
    fn bytes(&self) -> usize;
    fn length_s(&self) -> f32;
    fn events(&self) -> &[Event];
    fn cursor(&self) -> Cursor;
    fn sample(&self, time_s: f32, cursor: &mut Cursor, pose: &mut [Transform]);
    /// Returns the value of the scalar at index `place` of the clip's list.
    fn scalar(&self, time_s: f32, place: usize) -> f32;
}

impl PlayableClip for Clip {
    fn bytes(&self) -> usize {
        self.bytes()
    }
    fn length_s(&self) -> f32 {
        self.length_s()
    }
    fn events(&self) -> &[Event] {
        self.events()
    }
    fn cursor(&self) -> Cursor {
        self.cursor()
    }
    fn sample(&self, time_s: f32, cursor: &mut Cursor, pose: &mut [Transform]) {
        self.sample(time_s, cursor, pose);
    }
    fn scalar(&self, time_s: f32, place: usize) -> f32 {
        self.scalars().get(place).map_or(0.0, |(_, track)| track.sample(time_s))
    }
}

impl PlayableClip for PackedClip {
    fn bytes(&self) -> usize {
        self.bytes()
    }
    fn length_s(&self) -> f32 {
        self.length_s()
    }
    fn events(&self) -> &[Event] {
        self.events()
    }
    fn cursor(&self) -> Cursor {
        self.cursor()
    }
    fn sample(&self, time_s: f32, cursor: &mut Cursor, pose: &mut [Transform]) {
        self.sample(time_s, cursor, pose);
    }
    fn scalar(&self, time_s: f32, place: usize) -> f32 {
        self.scalar_in_place(time_s, place)
    }
}
