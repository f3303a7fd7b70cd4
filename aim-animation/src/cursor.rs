//! [`Cursor`]: a cache of the keys at which the tracks of a clip were last sampled.

use alloc::vec::Vec;

use crate::packed::segment::Segments;

/// Cache of the keys at which a clip's tracks were last sampled, for one character that plays the clip.
///
/// It saves the search for the keys, and in packed clips their decoding. Any cursor is valid for any clip and any time,
/// and never changes a result.
#[derive(Clone, Debug, Default)]
pub struct Cursor {
    pub(crate) keys: Vec<usize>,
    pub(crate) segments: Segments,
}

impl Cursor {
    /// Creates a cursor with room for `keys` tracks of a plain clip and `tracks` tracks of a packed one.
    pub(crate) fn with_room(keys: usize, tracks: usize) -> Self {
        Self { keys: alloc::vec![0; keys], segments: Segments::with_room(tracks) }
    }

    /// Creates a cursor with the larger room of the two, for keys and for packed tracks.
    pub(crate) fn with_room_of_both(&self, other: &Self) -> Self {
        let tracks = self.segments.room().max(other.segments.room());
        Self::with_room(self.keys.len().max(other.keys.len()), tracks)
    }
}

/// Compares the keys only; the decoded segments follow from them.
impl PartialEq for Cursor {
    fn eq(&self, other: &Self) -> bool {
        self.keys == other.keys
    }
}

impl Eq for Cursor {}
