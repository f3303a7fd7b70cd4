//! Files appear whole or not at all.

use std::fs;
use std::io::{self, Write as _};
use std::path::Path;

use crate::error::Error;

/// Writes `bytes` to `path` by way of a temporary file beside it, renamed once it is complete.
///
/// # Errors
/// [`Error::NotAFile`] when a folder is in the way, [`Error::Write`] when the file system refuses; what was at
/// `path` before is then still there, and the temporary file is gone.
pub fn write_file(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), Error> {
    let path = path.as_ref();
    let (false, Some(name)) = (path.is_dir(), path.file_name()) else {
        return Err(Error::NotAFile { path: path.to_path_buf() });
    };
    let mut hidden = std::ffi::OsString::from(".");
    hidden.push(name);
    hidden.push(format!(".{}.tmp", std::process::id()));
    let temporary = path.with_file_name(hidden);
    let fill = || -> io::Result<()> {
        let mut file = fs::File::create(&temporary)?;
        file.write_all(bytes)?;
        file.sync_all()?;
        drop(file);
        fs::rename(&temporary, path)
    };
    fill().map_err(|source| {
        // Nothing more can be done if even this fails; the first reason is the one to tell.
        let _ = fs::remove_file(&temporary);
        Error::Write { path: path.to_path_buf(), source }
    })
}
