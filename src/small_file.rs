//! Small files, read whole: lists, cameras, reports, caches.

use std::{
    fs::{self, File},
    io::Read as _,
    path::Path,
};

use crate::error::{Error, Result};

/// The whole of a regular file of at most `most_bytes`. A pipe or a device may never end, and is not opened; a file that grows
/// while it is read is read up to the limit alone. `what` is what it is expected to be, with its article.
///
/// # Errors
/// [`crate::ErrorKind::File`] if it can't be read; [`crate::ErrorKind::Input`] for what is no file, or is larger.
pub fn read_small_file(path: &Path, most_bytes: u64, what: &str) -> Result<Vec<u8>> {
    let fail = |e| Error::file(path, "read", e);
    let metadata = fs::metadata(path).map_err(fail)?;
    if !metadata.is_file() {
        return Err(Error::input(path, "", format!("not a file; expected {what}")));
    }
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(most_bytes.saturating_add(1)).read_to_end(&mut bytes))
        .map_err(fail)?;
    match bytes.len() as u64 > most_bytes {
        false => Ok(bytes),
        true => {
            let found = metadata.len().max(bytes.len() as u64);
            Err(Error::input(path, "", format!("{found} bytes; expected {what}, at most {most_bytes}")))
        }
    }
}

/// As [`read_small_file`], of UTF-8.
///
/// # Errors
/// As that; [`crate::ErrorKind::Input`] with the line that is no UTF-8.
pub fn read_small_text(path: &Path, most_bytes: u64, what: &str) -> Result<String> {
    String::from_utf8(read_small_file(path, most_bytes, what)?).map_err(|e| {
        let before = e.utf8_error().valid_up_to();
        let line = 1 + e.as_bytes().iter().take(before).filter(|byte| **byte == b'\n').count();
        Error::input(path, format!("line {line}"), format!("not UTF-8; expected {what}, which is text"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_up_to_the_limit_are_read() {
        let folder = temp_dir::TempDir::new().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "one\ntwo").unwrap();
        let read = |most| read_small_text(&path, most, "a list").map_err(|e| e.to_string());
        assert_eq!(read(7).unwrap(), "one\ntwo");
        assert!(read(6).unwrap_err().ends_with("a.txt: 7 bytes; expected a list, at most 6"));
        fs::write(&path, b"one\n\xff").unwrap();
        assert!(read(7).unwrap_err().ends_with("a.txt: line 2: not UTF-8; expected a list, which is text"));
        let of = |path: &Path| read_small_file(path, 9, "a list").unwrap_err().to_string();
        assert!(of(folder.path()).ends_with(": not a file; expected a list"));
        assert!(of(&folder.path().join("none")).contains("cannot read: No such file"));
        #[cfg(unix)]
        for device in ["/dev/zero", "/dev/null"] {
            assert!(of(Path::new(device)).ends_with(": not a file; expected a list"));
        }
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_pipe_that_nobody_writes_to_is_not_waited_for() {
        let folder = temp_dir::TempDir::new().unwrap();
        let path = folder.path().join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&path).status().unwrap().success());
        assert!(read_small_file(&path, 9, "a list").unwrap_err().to_string().contains("not a file"));
    }
}
