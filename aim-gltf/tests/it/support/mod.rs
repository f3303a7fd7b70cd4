//! Helpers for small hand-made files, shared by several tests, including those of aim-character.

use base64::Engine as _;
use serde_json::Value;

/// Returns the little-endian bytes of floats.
pub(crate) fn bytes_of(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// Returns a data URI of the bytes.
pub(crate) fn data_uri(bytes: &[u8]) -> String {
    format!("data:application/octet-stream;base64,{}", base64::engine::general_purpose::STANDARD.encode(bytes))
}

/// Returns the JSON and the binary chunk of a GLB, read without the library.
pub(crate) fn take_apart(glb: &[u8]) -> (Value, Vec<u8>) {
    let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap()) as usize;
    let json_len = word(12);
    let json = serde_json::from_slice(&glb[20..20 + json_len]).unwrap();
    let bin = if glb.len() > 20 + json_len {
        glb[28 + json_len..28 + json_len + word(20 + json_len)].to_vec()
    } else {
        Vec::new()
    };
    (json, bin)
}

/// Returns a GLB, written without the library.
pub(crate) fn put_together(json: &Value, bin: &[u8]) -> Vec<u8> {
    let mut text = serde_json::to_vec(json).unwrap();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bin = bin.to_vec();
    bin.resize(bin.len().next_multiple_of(4), 0);
    let size = |n: usize| u32::try_from(n).unwrap().to_le_bytes();
    let mut out = Vec::new();
    out.extend_from_slice(b"glTF");
    out.extend_from_slice(&size(2));
    out.extend_from_slice(&size(28 + text.len() + bin.len()));
    out.extend_from_slice(&size(text.len()));
    out.extend_from_slice(b"JSON");
    out.extend_from_slice(&text);
    out.extend_from_slice(&size(bin.len()));
    out.extend_from_slice(b"BIN\0");
    out.extend_from_slice(&bin);
    out
}
