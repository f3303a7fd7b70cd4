//! The GLB container: splits it with every length checked, and assembles it.

use core::ops::Range;

use crate::error::Error;

const MAGIC: [u8; 4] = *b"glTF";
const JSON: u32 = u32::from_le_bytes(*b"JSON");
const BIN: u32 = u32::from_le_bytes(*b"BIN\0");

/// A file's JSON text and, for a GLB that has one, its binary chunk (with padding).
pub(crate) struct Chunks<'a> {
    pub(crate) json: &'a [u8],
    /// Byte range of the chunk in the file.
    pub(crate) bin: Option<Range<usize>>,
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let four = bytes.get(at..at.checked_add(4)?)?;
    Some(u32::from_le_bytes(four.try_into().ok()?))
}

fn damaged(problem: impl Into<String>) -> Error {
    Error::Container(problem.into())
}

/// Splits a `.glb` into its chunks; a `.gltf` is returned whole as JSON.
pub(crate) fn split(bytes: &[u8]) -> Result<Chunks<'_>, Error> {
    if bytes.is_empty() {
        return Err(Error::Empty);
    }
    if bytes.starts_with(&MAGIC) {
        return split_glb(bytes);
    }
    // The specification forbids a byte order mark, but it is harmless.
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match text.iter().find(|b| !b.is_ascii_whitespace()) {
        Some(b'{') => Ok(Chunks { json: text, bin: None }),
        _ => Err(Error::NotGltf(bytes.iter().take(4).copied().collect())),
    }
}

fn split_glb(bytes: &[u8]) -> Result<Chunks<'_>, Error> {
    let (Some(version), Some(length)) = (word(bytes, 4), word(bytes, 8)) else {
        return Err(damaged(format!("{} bytes are too few for its 12-byte header", bytes.len())));
    };
    if version != 2 {
        return Err(Error::Version(format!("binary container version {version}")));
    }
    // Ignore bytes after the stated length; missing ones are an error.
    let length = length as usize;
    let whole = bytes
        .get(..length)
        .ok_or_else(|| damaged(format!("its header declares {length} bytes, but the file has {}", bytes.len())))?;
    let (mut json, mut bin, mut at, mut index) = (None, None, 12_usize, 0_usize);
    while at < whole.len() {
        let (Some(size), Some(kind)) = (word(whole, at), word(whole, at + 4)) else {
            return Err(damaged(format!("chunk {index} at byte {at} has no complete header")));
        };
        let start = at + 8;
        let body = start.checked_add(size as usize).and_then(|end| whole.get(start..end)).ok_or_else(|| {
            damaged(format!("chunk {index} at byte {at} declares {size} bytes, but {} follow", whole.len() - start))
        })?;
        match (index, kind) {
            (0, JSON) => json = Some(body),
            (0, _) => return Err(damaged("its first chunk is not JSON")),
            (1, BIN) => bin = Some(start..start + body.len()),
            _ => {} // the specification requires unknown chunks to be ignored
        }
        at = start + body.len();
        index += 1;
    }
    let json = json.ok_or_else(|| damaged("it has no JSON chunk"))?;
    Ok(Chunks { json, bin })
}

/// Assembles a GLB from a JSON text and a binary chunk. Pads the JSON with spaces and the chunk with zeros to multiples
/// of 4 bytes, as the format requires.
///
/// # Errors
/// [`Error::Clip`] if the file would exceed the 4 GiB limit of a GLB.
pub fn to_glb(json: &[u8], bin: Option<&[u8]>) -> Result<Vec<u8>, Error> {
    let too_long = || Error::Clip("the file would be longer than a GLB's 4 GiB".into());
    let padded = |n: usize| n.checked_next_multiple_of(4);
    let json_len = padded(json.len()).ok_or_else(too_long)?;
    let bin_len = bin.map_or(Some(0), |b| padded(b.len())).ok_or_else(too_long)?;
    let total = 12 + 8 + json_len + if bin.is_some() { 8 + bin_len } else { 0 };
    let u32_of = |n: usize| u32::try_from(n).map_err(|_| too_long());
    let mut out = Vec::with_capacity(total);
    out.extend_from_slice(&MAGIC);
    out.extend_from_slice(&2_u32.to_le_bytes());
    out.extend_from_slice(&u32_of(total)?.to_le_bytes());
    out.extend_from_slice(&u32_of(json_len)?.to_le_bytes());
    out.extend_from_slice(&JSON.to_le_bytes());
    out.extend_from_slice(json);
    out.resize(20 + json_len, b' ');
    if let Some(bin) = bin {
        out.extend_from_slice(&u32_of(bin_len)?.to_le_bytes());
        out.extend_from_slice(&BIN.to_le_bytes());
        out.extend_from_slice(bin);
        out.resize(total, 0);
    }
    Ok(out)
}
