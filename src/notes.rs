//! What was done with input that is not drawn as its file says it, in numbers and words.

use std::fmt;

use serde::Serialize;

/// Something that was done with a part of a file: what is drawn is not all that the file says, or more. `--strict` refuses
/// what [`Deed::is_loss`] is true of.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Note {
    /// What was done.
    pub deed: Deed,
    /// To how many.
    pub count: u64,
    /// To what and why, after the number: `faces with fewer than 3 corners`.
    pub what: String,
}

impl Note {
    /// A note where there is something to note.
    pub fn of(deed: Deed, count: usize, what: &str) -> Option<Self> {
        (count > 0).then(|| Self { deed, count: count as u64, what: what.to_owned() })
    }
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
    /// The file does not have it, and what is drawn needs it: nothing is lost.
    Computed,
}

impl Deed {
    /// Whether something that the file says is not drawn as it says it: what `--strict` refuses.
    pub fn is_loss(self) -> bool {
        self != Self::Computed
    }

    fn words(self) -> &'static str {
        match self {
            Self::Dropped => "left out",
            Self::Merged => "merged",
            Self::Replaced => "replaced",
            Self::Clamped => "clamped",
            Self::Ignored => "ignored",
            Self::Computed => "computed",
        }
    }
}
