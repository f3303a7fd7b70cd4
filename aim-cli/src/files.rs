//! Reads and writes files. Files are written completely or not at all.

use std::fs;
use std::path::Path;

use aim_codegen::RigSpec;
use aim_gltf::Document;

use crate::failure::{Failure, Result};

/// Reads and checks a rig's TOML file.
pub(crate) fn load_rig(path: &Path) -> Result<RigSpec> {
    if ending(path) == "rs" {
        let text = "a Rust file, not a rig; for one of its differentiated functions, use aim generate FILE --function NAME, \
                    with --lang c or wgsl, or with --trace";
        return Err(Failure::in_file(path, text));
    }
    let text = read_text(path, "expected a rig declaration in TOML")?;
    Ok(aim_codegen::declare::from_toml(&path.display().to_string(), &text)?)
}

/// Reads a text file. The error message ends with `expected`, which says what to give.
pub(crate) fn read_text(path: &Path, expected: &str) -> Result<String> {
    fs::read_to_string(path)
        .map_err(|error| Failure::in_file(path, format!("cannot read as text: {error}; {expected}")))
}

/// Returns the extension of a file in lower case; empty if there is none.
pub(crate) fn ending(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase()
}

/// Reads a glTF, GLB or VRM file.
pub(crate) fn load_model(path: &Path) -> Result<Document> {
    Document::load(path).map_err(|error| Failure::input(error.in_file(path)))
}

/// Returns the size in bytes of a model as one binary file. If the file is text or has external parts, this is the size
/// it would have.
pub(crate) fn bytes_as_binary(path: &Path, document: &Document) -> Result<usize> {
    let is_binary = || {
        use std::io::Read;
        let mut magic = [0; 4];
        fs::File::open(path)?.read_exact(&mut magic)?;
        Ok::<_, std::io::Error>(magic == *b"glTF")
    };
    if document.external_files().is_empty() && is_binary().unwrap_or(false) {
        let size = fs::metadata(path).map_err(Failure::of(path))?.len();
        return usize::try_from(size).map_err(Failure::of(path));
    }
    document.with_clips(&[]).map(|model| model.len()).map_err(Failure::of(path))
}

/// Writes a file completely or not at all.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result {
    write_all(&[(path, bytes)])
}

/// Writes files that belong together: all of them or none. A file that is replaced keeps its permissions.
pub(crate) fn write_all(files: &[(&Path, &[u8])]) -> Result {
    aim_gltf::write_files(files).map_err(|error| Failure::input(error.to_string()))
}

/// Returns indented JSON text that ends with a newline.
pub(crate) fn to_json(value: &impl serde::Serialize) -> Result<String> {
    let text = serde_json::to_string_pretty(value)
        .map_err(|error| Failure::input(format!("cannot write the result as JSON: {error}")))?;
    Ok(text + "\n")
}

/// Prints to standard output. A reader that closes the pipe (`| head`) is not an error.
pub(crate) fn print(text: &str) -> Result {
    use std::io::{ErrorKind, Write};
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::input(format!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}
