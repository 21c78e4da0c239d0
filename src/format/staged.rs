//! Files that are complete or not there: written beside their place under a temporary name, and renamed when all is
//! well.

use super::MeshFileError;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// How many symbolic links are followed, as many as Linux does.
const MOST_LINKS: usize = 40;

/// Writes a file of any kind, which is complete or, if that fails, not there (or as it was). What is no file but a
/// pipe or a terminal is written to as it stands. A symbolic link is followed.
///
/// # Errors
/// If it cannot be written.
pub fn write_complete(path: &Path, bytes: &[u8]) -> Result<(), MeshFileError> {
    if path.metadata().is_ok_and(|place| !place.is_file()) {
        return std::fs::write(path, bytes).map_err(|source| MeshFileError::Io {
            path: path.to_path_buf(),
            source,
        });
    }
    let staged = stage(path.to_path_buf(), |out| out.write_all(bytes))?;
    staged.publish().map(|_| ())
}

/// A file that is complete but still has a temporary name. Dropped, it is gone.
pub(super) struct Staged {
    file: NamedTempFile,
    /// Where it goes: the path, or where that leads to if it is a symbolic link.
    place: PathBuf,
    path: PathBuf,
}

impl Staged {
    /// A directory cannot be replaced.
    pub fn check_place(&self) -> Result<(), MeshFileError> {
        if self.place.is_dir() {
            return Err(MeshFileError::Io {
                path: self.path.clone(),
                source: io::ErrorKind::IsADirectory.into(),
            });
        }
        Ok(())
    }

    /// Gives it its name.
    pub fn publish(self) -> Result<PathBuf, MeshFileError> {
        match self.file.persist(&self.place) {
            Ok(_) => Ok(self.path),
            Err(error) => Err(MeshFileError::Io {
                path: self.path,
                source: error.error,
            }),
        }
    }
}

/// Writes a file under a temporary name. Errors name the place that it is meant for.
pub(super) fn stage(
    path: PathBuf,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<Staged, MeshFileError> {
    let written = || -> io::Result<(NamedTempFile, PathBuf)> {
        let place = end_of_links(&path)?;
        let file = temporary_beside(&place)?;
        // The file itself: errors of the wrapper name the temporary file.
        let mut out = BufWriter::new(file.as_file());
        write(&mut out)?;
        out.flush()?;
        drop(out);
        Ok((file, place))
    };
    match written() {
        Ok((file, place)) => Ok(Staged { file, place, path }),
        Err(source) => Err(MeshFileError::Io { path, source }),
    }
}

/// Where a path leads to that may be a symbolic link, to a file that need not be there.
fn end_of_links(path: &Path) -> io::Result<PathBuf> {
    let mut place = path.to_path_buf();
    for _ in 0..MOST_LINKS {
        let is_link = place.symlink_metadata().is_ok_and(|at| at.is_symlink());
        if !is_link {
            return Ok(place);
        }
        let to = place.read_link()?;
        // A link may be relative to where it is.
        place = place.parent().unwrap_or(Path::new("")).join(to);
    }
    Err(io::Error::other("too many symbolic links"))
}

/// A temporary file in the directory of `path`, so that it can be renamed to it, with the permissions of any new file
/// (temporary files are private by default).
fn temporary_beside(path: &Path) -> io::Result<NamedTempFile> {
    let directory = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".tetflip-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    // The error would name the temporary file.
    let file = builder.tempfile_in(directory);
    file.map_err(|error| io::Error::from(error.kind()))
}
