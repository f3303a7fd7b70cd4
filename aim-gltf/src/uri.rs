//! Buffer and image URIs: decodes data URIs and turns relative ones into paths. Nothing is fetched.

use std::path::{Path, PathBuf};

use base64::Engine as _;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig, general_purpose::STANDARD};

use crate::error::Error;

/// Base64 decoder that accepts missing padding, which several exporters omit.
const LENIENT: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// The target of a URI.
pub(crate) enum Uri {
    /// Decoded bytes of a data URI.
    Data(Vec<u8>),
    /// A path relative to the glTF file.
    Relative(PathBuf),
}

/// Parses the URI `text`; `place` is where it was found, for error messages.
pub(crate) fn parse(text: &str, place: &str) -> Result<Uri, Error> {
    if text.get(..5).is_some_and(|s| s.eq_ignore_ascii_case("data:")) {
        let (head, body) =
            text.split_once(',').ok_or_else(|| Error::invalid(place, "the data URI has no comma before its data"))?;
        if !head.to_ascii_lowercase().ends_with(";base64") {
            return Ok(Uri::Data(percent_decode(body)));
        }
        let body = percent_decode(body);
        let bytes = LENIENT
            .decode(body)
            .map_err(|e| Error::invalid(place, format!("the data URI has invalid base64 ({e})")))?;
        return Ok(Uri::Data(bytes));
    }
    if let Some((scheme, _)) = text.split_once("://") {
        return Err(Error::NoData {
            place: place.into(),
            problem: format!(
                "its data lies at {scheme}://…, and nothing is fetched; download it and name it relatively"
            ),
        });
    }
    let path = String::from_utf8(percent_decode(text))
        .map_err(|_| Error::invalid(place, "the URI is not UTF-8 after percent decoding"))?;
    let path = PathBuf::from(path);
    if path.as_os_str().is_empty() || path.is_absolute() {
        return Err(Error::invalid(place, "the URI is not a path relative to the file"));
    }
    Ok(Uri::Relative(path))
}

/// Percent-decodes, such as `%41` to `A`; a percent sign without two hexadecimal digits is kept.
fn percent_decode(text: &str) -> Vec<u8> {
    let bytes = text.as_bytes();
    let digit = |at: usize| bytes.get(at).and_then(|b| char::from(*b).to_digit(16)).and_then(|d| u8::try_from(d).ok());
    let (mut out, mut at) = (Vec::with_capacity(bytes.len()), 0);
    while at < bytes.len() {
        match (bytes[at], digit(at + 1), digit(at + 2)) {
            (b'%', Some(high), Some(low)) => {
                out.push(high * 16 + low);
                at += 3;
            }
            (byte, ..) => {
                out.push(byte);
                at += 1;
            }
        }
    }
    out
}

/// Encodes bytes as a base64 data URI of this media type.
pub(crate) fn to_data(media_type: &str, bytes: &[u8]) -> String {
    format!("data:{media_type};base64,{}", STANDARD.encode(bytes))
}

/// Reads a whole regular file. Folders, pipes and devices are rejected first, because reading them can block or never
/// end.
pub(crate) fn read_file(path: &Path) -> Result<Vec<u8>, Error> {
    let fail = |source| Error::Read { path: path.to_path_buf(), source };
    if !std::fs::metadata(path).map_err(fail)?.is_file() {
        return Err(Error::NotAFile(path.to_path_buf()));
    }
    std::fs::read(path).map_err(fail)
}
