//! Binary format of [`PackedClip`]: little-endian, versioned, validated on reading.

use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use super::PackedClip;
use super::bits::PADDING;
use super::layout::{Channel, Header};
use crate::clip::Event;
use crate::track::{Track, Value};

/// First bytes of the format.
const MAGIC: [u8; 4] = *b"AIMP";
/// Version that is written, and the only one that is read.
const VERSION: u32 = 1;

/// Reason why bytes are not a packed clip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PackedError {
    /// The bytes do not start with the signature of a packed clip.
    Magic,
    /// The format has this version, which is not supported.
    Version(u32),
    /// The bytes end before the clip does.
    End,
    /// This many bytes are left after the end of the clip.
    Rest(usize),
    /// A name is not UTF-8.
    Name,
    /// The length, or the time of a key or an event, is negative, not finite, out of order or past the length.
    Time,
    /// This track has keys, values or a target that a packed track cannot have.
    Track(usize),
}

impl fmt::Display for PackedError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Magic => write!(f, "the bytes do not begin as a packed clip; they have to be those of to_bytes"),
            Self::Version(version) => {
                write!(f, "the packed clip has version {version}, and {VERSION} is read; pack the clip again")
            }
            Self::End => write!(f, "the bytes end before the packed clip does; they were cut"),
            Self::Rest(count) => write!(f, "{count} bytes are left over behind the packed clip"),
            Self::Name => write!(f, "a name in the packed clip is not UTF-8"),
            Self::Time => {
                write!(f, "a time in the packed clip is negative, not finite, out of order or past its length")
            }
            Self::Track(track) => write!(f, "track {track} of the packed clip is damaged; pack the clip again"),
        }
    }
}

impl core::error::Error for PackedError {}

impl PackedClip {
    /// Encodes the clip in a binary format that [`from_bytes`](Self::from_bytes) reads: little-endian, versioned, and
    /// the same on every machine.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        push(&mut bytes, VERSION);
        push_text(&mut bytes, &self.name);
        bytes.extend(self.length_s.to_le_bytes());
        push_count(&mut bytes, self.events.len());
        for event in &self.events {
            bytes.extend(event.time_s.to_le_bytes());
            push_text(&mut bytes, &event.name);
        }
        push_count(&mut bytes, self.times.len());
        self.times.iter().for_each(|time| bytes.extend(time.to_le_bytes()));
        push_count(&mut bytes, self.of_bones);
        push_count(&mut bytes, self.tracks.len());
        let data = &self.data[..self.data.len().saturating_sub(PADDING)];
        push_count(&mut bytes, data.len());
        bytes.extend(data);
        bytes
    }

    /// Decodes a clip from the format of [`to_bytes`](Self::to_bytes). Any clip that is accepted gives finite samples
    /// and unit rotations, and memory use is proportional to the number of bytes, even if they are malicious.
    ///
    /// # Errors
    /// See [`PackedError`]; returns the first error found.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, PackedError> {
        let mut reader = Reader(bytes);
        if reader.array()? != MAGIC {
            return Err(PackedError::Magic);
        }
        let version = reader.number()?;
        if version != VERSION {
            return Err(PackedError::Version(version));
        }
        let name = reader.text()?;
        let length_s = reader.float()?;
        if !(length_s.is_finite() && length_s >= 0.0) {
            return Err(PackedError::Time);
        }
        let mut events: Vec<Event> = Vec::new();
        for _ in 0..reader.number()? {
            let time_s = reader.float()?;
            let before = events.last().map_or(0.0, |event| event.time_s);
            if !(before <= time_s && time_s <= length_s) {
                return Err(PackedError::Time);
            }
            events.push(Event { time_s, name: reader.text()? });
        }
        let mut times = Vec::new();
        for _ in 0..reader.number()? {
            times.push(reader.float()?);
        }
        let is_in_order = times.windows(2).all(|pair| pair[0] < pair[1]);
        if !is_in_order || times.iter().any(|time| !(0.0 <= *time && *time <= length_s)) {
            return Err(PackedError::Time);
        }
        let of_bones = reader.count()?;
        let count = reader.count()?;
        let size = reader.count()?;
        let mut data = reader.slice(size)?.to_vec();
        if !reader.0.is_empty() {
            return Err(PackedError::Rest(reader.0.len()));
        }
        data.extend([0; PADDING]);
        let mut packed = Self { name, length_s, events, times, of_bones, data: data.into(), tracks: Vec::new() };
        packed.find_tracks(count)?;
        Ok(packed)
    }

    /// Finds and validates the tracks, which are stored one after the other.
    fn find_tracks(&mut self, count: usize) -> Result<(), PackedError> {
        if self.of_bones > count {
            return Err(PackedError::Track(count));
        }
        let end = 8 * (self.data.len() - PADDING);
        let (mut position, mut before) = (0, None);
        for track in 0..count {
            let at = u32::try_from(position).map_err(|_| PackedError::Track(track))?;
            let header = Header::read(&self.data, position, self.times.len());
            // Required order: by bone, for each its translation, rotation and scale; then scalars.
            let place = (header.channel == Channel::Scalar, header.target, header.channel as u32);
            let is_sound = header.end() <= end
                && (header.channel == Channel::Scalar) == (track >= self.of_bones)
                && before.is_none_or(|before| before < place)
                && self.has_sound_keys(&header);
            if !is_sound {
                return Err(PackedError::Track(track));
            }
            self.tracks.push(at);
            (position, before) = (header.end(), Some(place));
        }
        // Less than a byte may be left: the bits that fill the last byte.
        if end - position < 8 { Ok(()) } else { Err(PackedError::Rest((end - position) / 8)) }
    }

    fn has_sound_keys(&self, header: &Header) -> bool {
        fn sound<T: Value>(track: &Option<Track<T>>) -> bool {
            track.is_some()
        }
        header.is_bounded()
            // At most two keys at one time, where the track jumps.
            && header.keys <= 2 * self.times.len()
            && match header.channel {
                Channel::Rotation => sound(&self.track::<aim_runtime::glam::Quat>(header)),
                Channel::Scalar => sound(&self.track::<f32>(header)),
                Channel::Translation | Channel::Scale => sound(&self.track::<aim_runtime::glam::Vec3>(header)),
            }
    }
}

fn push(bytes: &mut Vec<u8>, number: u32) {
    bytes.extend(number.to_le_bytes());
}

/// Writes a count, saturated at 2³² − 1. Clips are far smaller.
fn push_count(bytes: &mut Vec<u8>, count: usize) {
    push(bytes, u32::try_from(count).unwrap_or(u32::MAX));
}

fn push_text(bytes: &mut Vec<u8>, text: &str) {
    push_count(bytes, text.len());
    bytes.extend(text.as_bytes());
}

/// The bytes not read yet.
struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    fn slice(&mut self, count: usize) -> Result<&'a [u8], PackedError> {
        let (slice, rest) = self.0.split_at_checked(count).ok_or(PackedError::End)?;
        self.0 = rest;
        Ok(slice)
    }

    fn array(&mut self) -> Result<[u8; 4], PackedError> {
        let (array, rest) = self.0.split_first_chunk().ok_or(PackedError::End)?;
        self.0 = rest;
        Ok(*array)
    }

    fn number(&mut self) -> Result<u32, PackedError> {
        self.array().map(u32::from_le_bytes)
    }

    fn count(&mut self) -> Result<usize, PackedError> {
        self.number().map(|number| number as usize)
    }

    fn float(&mut self) -> Result<f32, PackedError> {
        self.array().map(f32::from_le_bytes)
    }

    fn text(&mut self) -> Result<String, PackedError> {
        let count = self.count()?;
        let text = core::str::from_utf8(self.slice(count)?).map_err(|_| PackedError::Name)?;
        Ok(text.into())
    }
}
