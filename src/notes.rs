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
        write!(f, "{} {}", counted(self.count, &self.what), self.deed.words())
    }
}

/// A number and what it is of, which is given in the plural: `1 triangle`, `2 triangles`, `1 face's normal that is zero`.
pub fn counted(count: u64, plural: &str) -> String {
    match count {
        1 => format!("1 {}", singular(plural)),
        count => format!("{count} {plural}"),
    }
}

/// The noun of a phrase, one of its first two words, as that of one thing.
fn singular(plural: &str) -> String {
    let mut words: Vec<String> = plural.split(' ').map(str::to_owned).collect();
    for word in words.iter_mut().take(2) {
        let end = word.trim_end_matches(',').len();
        let (noun, comma) = word.split_at(end);
        if let Some(owner) = noun.strip_suffix("s'") {
            *word = format!("{owner}'s");
            continue;
        }
        let one = match noun {
            "vertices" => Some("vertex".to_owned()),
            "radii" => Some("radius".to_owned()),
            "transparencies" => Some("transparency".to_owned()),
            _ => noun.strip_suffix('s').filter(|one| one.len() > 2).map(str::to_owned),
        };
        if let Some(one) = one {
            *word = one + comma;
            break;
        }
    }
    words.join(" ").replacen(" that are ", " that is ", 1).replacen(" which are ", " which is ", 1)
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
    /// Of what was computed: to which side it is directed.
    Turned,
    /// What it holds together is taken for several things, each of which is drawn as the file says it: nothing is lost.
    Separated,
}

impl Deed {
    /// Whether something that the file says is not drawn as it says it: what `--strict` refuses.
    pub fn is_loss(self) -> bool {
        !matches!(self, Self::Computed | Self::Turned | Self::Separated)
    }

    fn words(self) -> &'static str {
        match self {
            Self::Dropped => "left out",
            Self::Merged => "merged",
            Self::Replaced => "replaced",
            Self::Clamped => "clamped",
            Self::Ignored => "ignored",
            Self::Computed => "computed",
            Self::Turned => "turned",
            Self::Separated => "cut apart",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_thing_is_no_plural() {
        for (plural, one) in [
            ("triangles", "1 triangle"),
            ("vertices without a face", "1 vertex without a face"),
            ("radii", "1 radius"),
            ("normals, to one side,", "1 normal, to one side,"),
            ("isolated points", "1 isolated point"),
            ("points that are not finite", "1 point that is not finite"),
            (
                "faces' normals that are zero, not finite or not there",
                "1 face's normal that is zero, not finite or not there",
            ),
            (
                "materials' textures, which are not supported,",
                "1 material's texture, which is not supported,",
            ),
            ("splats whose tangent vectors are collinear", "1 splat whose tangent vectors are collinear"),
            ("material files that can't be read", "1 material file that can't be read"),
            ("surface that is inside out", "1 surface that is inside out"),
            ("text behind the last face", "1 text behind the last face"),
        ] {
            assert_eq!(counted(1, plural), one);
            assert_eq!(counted(2, plural), format!("2 {plural}"));
        }
    }
}
