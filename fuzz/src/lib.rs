//! Code shared by the fuzz targets and the seeds: the conversion of an input to a model file.

/// Returns the model file that an input stands for.
///
/// An input that begins with `{` is JSON and, after a zero byte, the binary chunk. It gets a GLB header with the right
/// lengths, so that a mutation of the content is not rejected at the header. Any other input is the file itself.
pub fn model_file(input: &[u8]) -> Vec<u8> {
    let Some((json, bin)) = input.iter().position(|byte| *byte == 0).map(|at| (&input[..at], &input[at + 1..])) else {
        return input.to_vec();
    };
    if !input.starts_with(b"{") {
        return input.to_vec();
    }
    let mut file = Vec::new();
    for (kind, bytes, pad) in [(b"JSON", json, b' '), (b"BIN\0", bin, 0)] {
        let padded = bytes.len().next_multiple_of(4);
        file.extend((padded as u32).to_le_bytes());
        file.extend(kind);
        file.extend(bytes);
        file.resize(file.len() + padded - bytes.len(), pad);
    }
    let length = (12 + file.len()) as u32;
    [b"glTF".as_slice(), &2_u32.to_le_bytes(), &length.to_le_bytes(), &file].concat()
}

/// Returns a GLB's contents as an input of [`model_file`]: its JSON, a zero byte, its binary chunk.
pub fn input_of(json: &[u8], bin: &[u8]) -> Vec<u8> {
    [json.trim_ascii_end(), &[0], bin].concat()
}
