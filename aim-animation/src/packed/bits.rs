//! Bit streams: numbers of any width up to 32 bits, without gaps.

use alloc::vec::Vec;

/// Maximum width of one number, bits.
pub(super) const MOST_BITS: u32 = 32;

/// Zero bytes appended after the last number, so that any number can be read by one 8-byte load.
pub(super) const PADDING: usize = 8;

/// Writes numbers of any width, the lowest bit first.
#[derive(Debug, Default)]
pub(super) struct BitWriter {
    bytes: Vec<u8>,
    used: usize,
}

impl BitWriter {
    pub(super) fn push(&mut self, number: u32, width: u32) {
        let width = width.min(MOST_BITS);
        for bit in 0..width {
            if self.used % 8 == 0 {
                self.bytes.push(0);
            }
            if let Some(byte) = self.bytes.last_mut() {
                *byte |= u8::from(number >> bit & 1 == 1) << (self.used % 8);
            }
            self.used += 1;
        }
    }

    /// Position of the next number, in bits.
    pub(super) fn position(&self) -> usize {
        self.used
    }

    /// Returns the bytes with the padding appended.
    pub(super) fn into_bytes(mut self) -> Vec<u8> {
        self.bytes.extend([0; PADDING]);
        self.bytes
    }
}

/// Reads the number of `width` bits, at most 32, that starts at bit `position`; 0 past the end.
#[inline]
pub(super) fn bits_at(bytes: &[u8], position: usize, width: u32) -> u32 {
    let Some((window, _)) = bytes.get(position / 8..).and_then(<[u8]>::split_first_chunk::<8>) else { return 0 };
    let window = u64::from_le_bytes(*window) >> (position % 8);
    let mask = (1_u64 << width.min(MOST_BITS)) - 1;
    #[expect(clippy::cast_possible_truncation, reason = "masked to 32 bits at most")]
    let number = (window & mask) as u32;
    number
}

/// Number of bits that a number needs.
pub(super) fn width_of(number: u32) -> u32 {
    u32::BITS - number.leading_zeros()
}

/// Reads numbers one after the other.
#[derive(Clone, Copy, Debug)]
pub(super) struct BitReader<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) position: usize,
}

impl BitReader<'_> {
    #[inline]
    pub(super) fn take(&mut self, width: u32) -> u32 {
        let number = bits_at(self.bytes, self.position, width);
        self.position += width as usize;
        number
    }
}
