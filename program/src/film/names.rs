//! The names of a film's pictures.

use std::path::{Path, PathBuf};

use surfel::{Error, Result};

/// A file name with the place of a number.
#[derive(Clone, Debug, PartialEq)]
pub struct Names {
    folder: PathBuf,
    before: String,
    /// Digits at least.
    digits: usize,
    after: String,
}

/// More than any number of pictures has.
const MOST_DIGITS: usize = 9;

impl Names {
    /// `out%04d.png`, or with `%d`.
    ///
    /// # Errors
    /// A name without one such place.
    pub fn parse(pattern: &Path) -> Result<Self> {
        let expected = || {
            let problem = format!(
                "{}: expected a name with the picture's number, such as out%04d.png, or a film in .mp4",
                pattern.display()
            );
            Error::option("--output", problem)
        };
        let name = pattern.file_name().and_then(|name| name.to_str()).ok_or_else(expected)?;
        let (before, rest) = name.split_once('%').ok_or_else(expected)?;
        let (digits, after) = rest.split_once('d').ok_or_else(expected)?;
        let digits = match digits {
            "" => 1,
            digits => digits.strip_prefix('0').and_then(|digits| digits.parse().ok()).ok_or_else(expected)?,
        };
        if after.contains('%') || !(1..=MOST_DIGITS).contains(&digits) {
            return Err(expected());
        }
        let folder = pattern.parent().map(Path::to_owned).unwrap_or_default();
        Ok(Self { folder, before: before.to_owned(), digits, after: after.to_owned() })
    }

    /// The name of a picture.
    pub fn of(&self, number: u64) -> PathBuf {
        let Self { folder, before, digits, after } = self;
        folder.join(format!("{before}{number:0digits$}{after}"))
    }

    /// Whether it is the name of a picture, of any number.
    pub fn has(&self, path: &Path) -> bool {
        let name = path.file_name().and_then(|name| name.to_str());
        let number = name.and_then(|name| name.strip_prefix(&self.before)?.strip_suffix(&self.after));
        let number = number.filter(|number| number.bytes().all(|digit| digit.is_ascii_digit()));
        number.and_then(|number| number.parse().ok()).is_some_and(|number| self.of(number) == path)
    }

    /// The file that tells of which job pictures are.
    pub fn journal(&self) -> PathBuf {
        let stem = self.before.trim_end_matches(['.', '-', '_']);
        self.folder.join(if stem.is_empty() { "frames.txt".to_owned() } else { format!("{stem}.frames.txt") })
    }

    /// As ffmpeg takes it.
    pub fn pattern(&self) -> PathBuf {
        let Self { folder, before, digits, after } = self;
        folder.join(format!("{before}%0{digits}d{after}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_stands_in_a_name() {
        let of = |pattern: &str| Names::parse(Path::new(pattern)).map_err(|e| e.to_string());
        let names = of("films/out%04d.png").unwrap();
        assert_eq!(names.of(7), Path::new("films/out0007.png"));
        assert_eq!(names.of(123_456), Path::new("films/out123456.png"));
        assert_eq!(names.journal(), Path::new("films/out.frames.txt"));
        assert!(names.has(Path::new("films/out0007.png")) && names.has(Path::new("films/out123456.png")));
        for other in ["out7.png", "out00007.png", "out0007.exr", "out.png", "a0007.png", "b/out0007.png"] {
            assert!(!names.has(&Path::new("films").join(other)), "{other}");
        }
        assert_eq!(of("%d.exr").unwrap().of(12), Path::new("12.exr"));
        assert_eq!(of("%05d.png").unwrap().journal(), Path::new("frames.txt"));
        for refused in ["out.png", "out%s.png", "out%4d.png", "a%d%d.png", "a%099d.png", "%04d/out.png", ""] {
            assert!(
                of(refused).unwrap_err().contains("expected a name with the picture's number"),
                "{refused}"
            );
        }
    }
}
