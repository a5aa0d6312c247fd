//! Which pictures of a film are there: a line each, with what it was made of and what its bytes were. So a picture is kept that is whole and
//! of the same job, and any other is drawn.

use std::{
    collections::HashMap,
    fs::{self, File, OpenOptions},
    hash::{DefaultHasher, Hasher as _},
    io::Write as _,
    path::{Path, PathBuf},
};

use surfel::{Error, Result};

/// More than a line takes, for each of the most pictures.
const MOST_BYTES: u64 = 1 << 27;

/// The file, open for what comes.
pub struct Journal {
    path: PathBuf,
    file: File,
    /// Of each picture, what it was made of and what its bytes were.
    known: HashMap<u64, [u64; 2]>,
}

impl Journal {
    /// What is known; lines that are none, such as one that was cut off, say nothing.
    ///
    /// # Errors
    /// A file that can't be read or written.
    pub fn open(path: PathBuf) -> Result<Self> {
        let fail = |e| Error::file(&path, "read", e);
        let there = fs::metadata(&path).is_ok_and(|metadata| metadata.len() <= MOST_BYTES);
        let text = if there { fs::read(&path).map_err(fail)? } else { Vec::new() };
        let known = String::from_utf8_lossy(&text).lines().filter_map(of_line).collect();
        let file = OpenOptions::new().create(true).append(true).open(&path);
        let mut file = file.map_err(|e| Error::file(&path, "write", e))?;
        if !text.is_empty() && !text.ends_with(b"\n") {
            file.write_all(b"\n").map_err(|e| Error::file(&path, "write", e))?;
        }
        Ok(Self { path, file, known })
    }

    /// Whether this picture is there, whole, and made of that.
    pub fn has(&self, number: u64, made_of: u64, picture: &Path) -> bool {
        let Some([job, bytes]) = self.known.get(&number) else { return false };
        *job == made_of && digest_of_file(picture).is_some_and(|digest| digest == *bytes)
    }

    /// Notes a picture that is there now.
    ///
    /// # Errors
    /// A file that can't be read or written.
    pub fn note(&mut self, number: u64, made_of: u64, picture: &Path) -> Result<()> {
        let Some(digest) = digest_of_file(picture) else {
            return Err(Error::file(picture, "read", std::io::ErrorKind::NotFound.into()));
        };
        let line = format!("{number} {made_of:016x} {digest:016x}\n");
        self.file.write_all(line.as_bytes()).map_err(|e| Error::file(&self.path, "write", e))?;
        self.known.insert(number, [made_of, digest]);
        Ok(())
    }
}

fn of_line(line: &str) -> Option<(u64, [u64; 2])> {
    let mut words = line.split(' ');
    let mut word = || words.next();
    let (number, made_of, digest) = (word()?, word()?, word()?);
    let hex = |word: &str| (word.len() == 16).then(|| u64::from_str_radix(word, 16).ok())?;
    Some((number.parse().ok()?, [hex(made_of)?, hex(digest)?]))
}

fn digest_of_file(path: &Path) -> Option<u64> {
    let mut hasher = DefaultHasher::new();
    hasher.write(&fs::read(path).ok()?);
    Some(hasher.finish())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_known_that_is_as_it_was_made() {
        let folder = temp_dir::TempDir::new().unwrap();
        let (path, picture) = (folder.path().join("frames.txt"), folder.path().join("a.png"));
        fs::write(&picture, "abc").unwrap();
        let mut journal = Journal::open(path.clone()).unwrap();
        assert!(!journal.has(3, 7, &picture));
        journal.note(3, 7, &picture).unwrap();
        fs::write(&path, fs::read_to_string(&path).unwrap() + "4 00").unwrap();
        let mut journal = Journal::open(path.clone()).unwrap();
        assert!(journal.has(3, 7, &picture) && !journal.has(3, 8, &picture) && !journal.has(4, 7, &picture));
        journal.note(4, 8, &picture).unwrap();
        assert!(Journal::open(path.clone()).unwrap().has(4, 8, &picture));
        fs::write(&picture, "ab").unwrap();
        assert!(!Journal::open(path).unwrap().has(3, 7, &picture));
    }
}
