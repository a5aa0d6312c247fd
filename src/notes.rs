//! What was done with input that is not drawn as its file says it, in numbers and words.

use std::fmt;

use serde::Serialize;

/// Something that was done with a part of a file: what is drawn is not all that the file says. `--strict` refuses it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Note {
    /// What was done.
    pub deed: Deed,
    /// To how many.
    pub count: u64,
    /// To what and why, after the number: `faces with fewer than 3 corners`.
    pub what: String,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {}", self.count, self.what, self.deed.words())
    }
}

/// What was done with a part of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Deed {
    /// It is not drawn.
    Dropped,
    /// It became one with another.
    Merged,
    /// It was wrong and something else is in its place.
    Replaced,
    /// It was out of its range and is at the end of it.
    Clamped,
    /// It has no meaning here.
    Ignored,
}

impl Deed {
    fn words(self) -> &'static str {
        match self {
            Self::Dropped => "left out",
            Self::Merged => "merged",
            Self::Replaced => "replaced",
            Self::Clamped => "clamped",
            Self::Ignored => "ignored",
        }
    }
}
