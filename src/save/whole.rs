//! A file that appears whole or not at all: written beside its place under another name, then renamed.

use std::{
    ffi::OsString,
    fs::{self, File, OpenOptions},
    io::{self, BufWriter, Write as _},
    path::{Path, PathBuf},
    process,
};

use crate::error::{Error, Result};

/// Removes the file unless it was renamed.
struct Temporary {
    path: PathBuf,
    renamed: bool,
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if !self.renamed {
            // An earlier error is being reported, there is nobody left to tell.
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Creates or replaces `path` with what `fill` writes.
pub(super) fn write(path: &Path, fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<()> {
    let fail = |e: io::Error| Error::file(path, "write", e);
    if let Ok(metadata) = fs::metadata(path) {
        // Renaming would put a file in the place of a device or a folder.
        if metadata.is_dir() {
            return Err(fail(io::ErrorKind::IsADirectory.into()));
        }
        if !metadata.is_file() {
            return Err(fail(io::Error::other("not a regular file")));
        }
    }
    let (file, mut temporary) = create_beside(path).map_err(fail)?;
    let mut writer = BufWriter::new(file);
    fill(&mut writer).and_then(|()| writer.flush()).map_err(fail)?;
    drop(writer);
    fs::rename(&temporary.path, path).map_err(fail)?;
    temporary.renamed = true;
    Ok(())
}

fn create_beside(path: &Path) -> io::Result<(File, Temporary)> {
    let Some(name) = path.file_name() else { return Err(io::ErrorKind::InvalidInput.into()) };
    for attempt in 0_u32.. {
        let mut hidden = OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{}-{attempt}.tmp", process::id()));
        let path = path.with_file_name(hidden);
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            Ok(file) => return Ok((file, Temporary { path, renamed: false })),
            // Another thread writes to the same place, or an earlier process of this number was killed.
            Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {}
            Err(e) => return Err(e),
        }
    }
    Err(io::ErrorKind::AlreadyExists.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn a_failure_leaves_the_old_file_and_no_other() {
        let folder = temp_dir::TempDir::new().unwrap();
        let path = folder.path().join("a.txt");
        write(&path, |file| file.write_all(b"old")).unwrap();
        let failed = write(&path, |file| {
            file.write_all(b"half")?;
            Err(io::Error::other("disk full"))
        });
        let expected = format!("{}: cannot write: disk full", path.display());
        assert_eq!(failed.unwrap_err().to_string(), expected);
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn a_file_is_replaced() {
        let folder = temp_dir::TempDir::new().unwrap();
        let path = folder.path().join("a.txt");
        for content in [b"one", b"two"] {
            write(&path, |file| file.write_all(content)).unwrap();
            assert_eq!(fs::read(&path).unwrap(), content);
        }
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn folders_devices_and_missing_folders_are_refused() {
        let folder = temp_dir::TempDir::new().unwrap();
        let missing = folder.path().join("missing/a.txt");
        for (path, problem) in [(folder.path(), "is a directory"), (&missing, "No such file")] {
            let error = write(path, |_| Ok(())).unwrap_err();
            assert_eq!(error.exit_code(), 1);
            assert!(error.to_string().contains(problem), "{error}");
        }
        #[cfg(unix)]
        assert!(write(Path::new("/dev/null"), |_| Ok(())).is_err());
        assert!(write(Path::new("/"), |_| Ok(())).is_err());
        assert!(names(folder.path()).is_empty());
    }
}
