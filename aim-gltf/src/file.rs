//! Files appear whole or not at all.

use std::ffi::OsString;
use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use crate::error::Error;

/// Writes `bytes` to `path` by way of a temporary file beside it, renamed once it is complete.
///
/// # Errors
/// [`Error::NotAFile`] when a folder or a device is in the way, [`Error::Write`] when the file system refuses; what was at
/// `path` before is then still there, and the temporary file is gone.
pub fn write_file(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), Error> {
    write_files(&[(path.as_ref(), bytes)])
}

/// Writes several files that belong together: none takes its place before all are complete.
///
/// # Errors
/// As [`write_file`], for the first file that cannot be written.
pub fn write_files(files: &[(&Path, &[u8])]) -> Result<(), Error> {
    let staged = files.iter().map(|(path, bytes)| Staged::write(path, bytes)).collect::<Result<Vec<_>, _>>()?;
    staged.into_iter().try_for_each(Staged::rename)
}

/// A complete file beside the place that it is for; gone when dropped.
struct Staged<'a> {
    path: &'a Path,
    /// The same where links lead.
    place: PathBuf,
    temporary: PathBuf,
}

impl<'a> Staged<'a> {
    fn write(path: &'a Path, bytes: &[u8]) -> Result<Self, Error> {
        // Folders, pipes, devices, and links to streams such as /dev/stdout: renaming would put a file in their place.
        let in_the_way =
            fs::metadata(path).is_ok_and(|there| !there.is_file()) || (path.starts_with("/dev") && path.is_symlink());
        let place = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        let (false, Some(name)) = (in_the_way, place.file_name()) else {
            return Err(Error::NotAFile(path.to_path_buf()));
        };
        let mut hidden = OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{}.tmp", std::process::id()));
        let staged = Self { path, temporary: place.with_file_name(hidden), place };
        let fill = || -> io::Result<()> {
            let mut file = fs::File::create(&staged.temporary)?;
            file.write_all(bytes)?;
            file.sync_all()
        };
        fill().map_err(|source| staged.refused(source))?;
        Ok(staged)
    }

    fn rename(self) -> Result<(), Error> {
        fs::rename(&self.temporary, &self.place).map_err(|source| self.refused(source))
    }

    fn refused(&self, source: io::Error) -> Error {
        Error::Write { path: self.path.to_path_buf(), source }
    }
}

impl Drop for Staged<'_> {
    fn drop(&mut self) {
        // Nothing more can be done if even this fails, and after the renaming it is meant to.
        let _ = fs::remove_file(&self.temporary);
    }
}
