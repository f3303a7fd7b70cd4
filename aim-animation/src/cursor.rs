//! [`Cursor`]: where the tracks of a clip were sampled last.

use alloc::vec::Vec;

use crate::packed::segment::Segments;

/// The keys at which a clip's tracks were sampled last, for one character that plays it: saves the search, and of packed clips the
/// decoding. Any cursor is valid for any clip and any time, and changes no result.
#[derive(Clone, Debug, Default)]
pub struct Cursor {
    pub(crate) keys: Vec<usize>,
    pub(crate) segments: Segments,
}

impl Cursor {
    /// One with room for so many keys and so many packed tracks.
    pub(crate) fn with_room(keys: usize, tracks: usize) -> Self {
        Self { keys: alloc::vec![0; keys], segments: Segments::with_room(tracks) }
    }

    /// One with the room of both.
    pub(crate) fn with_room_of_both(&self, other: &Self) -> Self {
        let tracks = self.segments.room().max(other.segments.room());
        Self::with_room(self.keys.len().max(other.keys.len()), tracks)
    }
}

/// By the keys: what is decoded follows from them.
impl PartialEq for Cursor {
    fn eq(&self, other: &Self) -> bool {
        self.keys == other.keys
    }
}

impl Eq for Cursor {}
