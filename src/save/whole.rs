//! A file that appears whole or not at all: written beside its place under another name, then renamed.

use std::{
    collections::BTreeSet,
    ffi::OsString,
    fs::{self, File, Metadata},
    io::{self, BufWriter, Write as _},
    path::{Path, PathBuf},
    sync::{Mutex, MutexGuard, PoisonError},
};

use tempfile::TempPath;

use crate::error::{Error, Result};

/// The files that are being written. Who makes, renames or removes one holds the lock.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn unfinished() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    // A panic of another thread leaves the set as it is.
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all files that are being written, and lets no other begin or become whole: for a process that is about to end.
pub fn remove_unfinished() {
    let paths = unfinished();
    for path in paths.iter() {
        // There is nobody left to tell.
        let _ = fs::remove_file(path);
    }
    // Threads that still write find the lock taken.
    std::mem::forget(paths);
}

/// A file under another name, removed unless it becomes whole.
struct Temporary(Option<TempPath>);

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(path) = self.0.take() {
            let mut paths = unfinished();
            paths.remove::<Path>(&path);
            // An earlier error is being reported, there is nobody left to tell.
            let _ = path.close();
        }
    }
}

impl Temporary {
    /// A new file beside `place`, of a name that no other has.
    fn beside(place: &Path) -> io::Result<(File, Self)> {
        let Some(name) = place.file_name() else { return Err(io::ErrorKind::InvalidInput.into()) };
        let mut hidden = OsString::from(".");
        hidden.push(name);
        hidden.push(".");
        let mut builder = tempfile::Builder::new();
        builder.prefix(&hidden).suffix(".tmp");
        #[cfg(unix)]
        {
            // As any new file: less what the user's mask takes.
            use std::os::unix::fs::PermissionsExt as _;
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        let folder = place.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let mut paths = unfinished();
        // The error of what makes it names a file that nobody asked for.
        let (file, path) = match builder.tempfile_in(folder) {
            Ok(made) => made.into_parts(),
            Err(e) if matches!(e.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory) => {
                return Err(io::Error::new(e.kind(), format!("there is no folder {}", folder.display())));
            }
            Err(e) => return Err(e),
        };
        paths.insert(path.to_path_buf());
        Ok((file, Self(Some(path))))
    }

    /// Takes the place; an old file there is replaced.
    fn become_whole(mut self, place: &Path) -> io::Result<()> {
        let Some(path) = self.0.take() else { return Ok(()) };
        let mut paths = unfinished();
        paths.remove::<Path>(&path);
        path.persist(place).map_err(|failed| failed.error)
    }
}

/// Creates or replaces `path` with what `fill` writes. A link is followed: what it names is replaced. What is replaced hands on its
/// permissions.
pub(super) fn write(path: &Path, fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<()> {
    create(path, |file| fill(file).map_err(|e| Error::file(path, "write", e)))
}

/// As [`write`], where more than writing may fail, and something is answered.
pub(crate) fn create<T>(path: &Path, fill: impl FnOnce(&mut BufWriter<File>) -> Result<T>) -> Result<T> {
    let fail = |e: io::Error| Error::file(path, "write", e);
    let (place, old) = place_of(path).map_err(fail)?;
    let (file, temporary) = Temporary::beside(&place).map_err(fail)?;
    let mut writer = BufWriter::new(file);
    let filled = fill(&mut writer)?;
    writer.flush().map_err(fail)?;
    if let Some(old) = old {
        writer.get_ref().set_permissions(old.permissions()).map_err(fail)?;
    }
    drop(writer);
    temporary.become_whole(&place).map_err(fail)?;
    Ok(filled)
}

/// A file beside `path` for what is needed until that is written; removed when it is dropped, and with all that is unfinished.
pub(crate) struct Scratch {
    pub file: File,
    _temporary: Temporary,
}

impl Scratch {
    pub fn beside(path: &Path) -> Result<Self> {
        let made = place_of(path).and_then(|(place, _)| Temporary::beside(&place));
        let (file, temporary) = made.map_err(|e| Error::file(path, "write", e))?;
        Ok(Self { file, _temporary: temporary })
    }
}

/// Where a file is written that is named so, and the file that is there.
///
/// # Errors
/// A folder or a device, in whose place renaming would put a file; a link to nothing.
fn place_of(path: &Path) -> io::Result<(PathBuf, Option<Metadata>)> {
    let is_link = fs::symlink_metadata(path).is_ok_and(|metadata| metadata.is_symlink());
    match fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(metadata) if !metadata.is_file() => Err(io::Error::other("not a regular file")),
        Ok(metadata) if is_link => Ok((fs::canonicalize(path)?, Some(metadata))),
        Ok(metadata) => Ok((path.to_owned(), Some(metadata))),
        Err(_) if is_link => Err(io::Error::other("a link to what is not there")),
        Err(_) => Ok((path.to_owned(), None)),
    }
}

/// Whether a file could be written there now: permission bits don't tell (root, read-only file systems), trying does.
///
/// # Errors
/// [`crate::ErrorKind::File`] with the reason why not.
pub fn check_place(path: &Path) -> Result<()> {
    let tried = place_of(path).and_then(|(place, _)| Temporary::beside(&place));
    tried.map(|_| ()).map_err(|e| Error::file(path, "write", e))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<_> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    fn write_text(path: &Path, text: &str) -> Result<()> {
        write(path, |file| file.write_all(text.as_bytes()))
    }

    #[test]
    fn a_failure_leaves_the_old_file_and_no_other() {
        let folder = temp_dir::TempDir::new().unwrap();
        let path = folder.path().join("a.txt");
        write_text(&path, "old").unwrap();
        let failed = write(&path, |file| {
            file.write_all(b"half")?;
            let own = |path: &PathBuf| path.starts_with(folder.path());
            assert!(names(folder.path()).len() == 2 && unfinished().iter().any(own));
            Err(io::Error::other("disk full"))
        });
        let expected = format!("{}: cannot write: disk full", path.display());
        assert_eq!(failed.unwrap_err().to_string(), expected);
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names(folder.path()), ["a.txt"]);
        check_place(&path).unwrap();
        assert_eq!(names(folder.path()), ["a.txt"]);
        assert!(!unfinished().iter().any(|path| path.starts_with(folder.path())));
    }

    #[test]
    fn a_file_is_replaced() {
        let folder = temp_dir::TempDir::new().unwrap();
        let path = folder.path().join("a.txt");
        for content in ["one", "two"] {
            write_text(&path, content).unwrap();
            assert_eq!(fs::read(&path).unwrap(), content.as_bytes());
        }
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    #[cfg(unix)]
    fn a_link_stays_one_and_permissions_stay_what_they_were() {
        use std::os::unix::fs::{PermissionsExt as _, symlink};
        let folder = temp_dir::TempDir::new().unwrap();
        fs::create_dir(folder.path().join("other")).unwrap();
        let [target, link, lost] = ["other/a.txt", "link", "lost"].map(|name| folder.path().join(name));
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
        write_text(&target, "old").unwrap();
        fs::write(folder.path().join("usual"), "").unwrap();
        assert_eq!(mode(&target), mode(&folder.path().join("usual")), "as any new file");
        fs::set_permissions(&target, fs::Permissions::from_mode(0o600)).unwrap();
        symlink("other/a.txt", &link).unwrap();
        write_text(&link, "new").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!((fs::read(&target).unwrap().as_slice(), mode(&target)), (&b"new"[..], 0o600));
        symlink("nowhere", &lost).unwrap();
        for refused in [write_text(&lost, "new"), check_place(&lost)] {
            assert!(
                refused.unwrap_err().to_string().ends_with("lost: cannot write: a link to what is not there")
            );
        }
        assert_eq!(names(folder.path()), ["link", "lost", "other", "usual"]);
    }

    #[test]
    fn folders_devices_and_missing_folders_are_refused() {
        let folder = temp_dir::TempDir::new().unwrap();
        let missing = folder.path().join("missing/a.txt");
        let absent = format!("cannot write: there is no folder {}", folder.path().join("missing").display());
        for (path, problem) in [(folder.path(), "is a directory"), (&missing, &absent)] {
            let error = write_text(path, "").unwrap_err();
            assert_eq!(error.exit_code(), 1);
            assert!(error.to_string().ends_with(problem), "{error}");
        }
        #[cfg(unix)]
        assert!(write_text(Path::new("/dev/null"), "").is_err());
        assert!(write_text(Path::new("/"), "").is_err());
        assert!(names(folder.path()).is_empty());
    }
}
