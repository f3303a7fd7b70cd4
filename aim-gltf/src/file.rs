//! Atomic writing: a file appears complete or not at all.

use std::ffi::OsString;
use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use crate::error::Error;

/// Writes `bytes` to a temporary file beside `path`, then renames it to `path`. A file that is replaced keeps its
/// permissions.
///
/// # Errors
/// [`Error::NotAFile`] if `path` is a folder or a device, [`Error::Write`] if the file system refuses. In both cases
/// what was at `path` before is still there, and the temporary file has been removed.
pub fn write_file(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), Error> {
    write_files(&[(path.as_ref(), bytes)])
}

/// Writes several files that belong together: none is renamed into place before all are written completely.
///
/// # Errors
/// As [`write_file`], for the first file that cannot be written. If renaming one fails, those before it are replaced already.
pub fn write_files(files: &[(&Path, &[u8])]) -> Result<(), Error> {
    let staged = files.iter().map(|(path, bytes)| Staged::write(path, bytes)).collect::<Result<Vec<_>, _>>()?;
    staged.into_iter().try_for_each(Staged::rename)
}

/// A completely written temporary file beside its destination; removed when dropped.
struct Staged<'a> {
    path: &'a Path,
    /// `path` with symbolic links resolved.
    place: PathBuf,
    temporary: PathBuf,
}

impl<'a> Staged<'a> {
    fn write(path: &'a Path, bytes: &[u8]) -> Result<Self, Error> {
        // For folders, pipes, devices and links to streams such as /dev/stdout, renaming would replace them by a file.
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
            // Before the content, which may be private.
            if let Ok(replaced) = fs::metadata(&staged.place) {
                file.set_permissions(replaced.permissions())?;
            }
            file.write_all(bytes)?;
            file.sync_all()
        };
        fill().map_err(|source| staged.write_error(source))?;
        Ok(staged)
    }

    fn rename(self) -> Result<(), Error> {
        fs::rename(&self.temporary, &self.place).map_err(|source| self.write_error(source))
    }

    fn write_error(&self, source: io::Error) -> Error {
        Error::Write { path: self.path.to_path_buf(), source }
    }
}

impl Drop for Staged<'_> {
    fn drop(&mut self) {
        // A failure here cannot be handled. After the renaming the file no longer exists, so failing is expected.
        let _ = fs::remove_file(&self.temporary);
    }
}
