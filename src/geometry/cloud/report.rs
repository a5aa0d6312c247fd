//! What was done with points, in numbers and in words.

use std::fmt;

use super::plane::{MOST_NEIGHBORS, NEIGHBORS};
use crate::notes::{Deed, Note};

/// How the sides of normals were chosen that are not the file's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sides {
    /// Along a spanning tree, so that neighbors agree.
    #[default]
    One,
    /// Toward the place from which the file says that the points were seen.
    TowardScanner,
    /// As most of the neighbors whose normals are the file's.
    AsNeighbors,
}

impl Sides {
    /// Where normals were turned, in words.
    fn words(self) -> &'static str {
        match self {
            Self::One => "to one side",
            Self::TowardScanner => "toward the scanner",
            Self::AsNeighbors => "as their neighbors",
        }
    }
}

/// The facts found on the way from points to splats.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CloudReport {
    /// Points in the file.
    pub points: usize,
    /// Points with a coordinate that is NaN or infinite: left out.
    pub not_finite: usize,
    /// Points at the place of another: merged with it.
    pub duplicates: usize,
    /// Points whose neighbors are 8 times as far from them as these are from theirs, or 2½ times and in a plane that they are off: left out.
    pub isolated: usize,
    /// The points are so noisy that planes were fitted to 48 neighbors each, of all points or of a part.
    pub noisy: bool,
    /// Points whose normal was taken from the file.
    pub normals_from_file: usize,
    /// The sides of the other normals.
    pub sides: Sides,
    /// Most were seen from among them, as in a room: what faces away from there hides it from outside.
    pub around_scanner: bool,
    /// Points whose radius was taken from the file.
    pub radii_from_file: usize,
    /// Sizes of points in the file that are no radii.
    pub sizes_ignored: usize,
    /// Disks over 4 times as large as the median of those around them, which they got instead.
    pub limited: usize,
    /// How far apart two numbers of 32 bits are at the points, where that is about as far as the points are apart.
    pub coarse_step: Option<f64>,
}

impl CloudReport {
    /// What of it is not drawn as the file says it, and what was computed.
    pub fn notes(&self) -> Vec<Note> {
        let splats = self.points - self.not_finite - self.duplicates - self.isolated;
        let computed = splats.saturating_sub(self.normals_from_file);
        let notes = [
            Note::of(Deed::Merged, self.duplicates, "points at the place of another"),
            Note::of(Deed::Dropped, self.isolated, "isolated points"),
            Note::of(Deed::Dropped, self.not_finite, "points that are not finite"),
            Note::of(
                Deed::Computed,
                self.limited,
                "radii as those around them, in place of far larger ones,",
            ),
            Note::of(Deed::Ignored, self.sizes_ignored, "sizes of points, which are no lengths here,"),
            Note::of(Deed::Computed, computed, "normals"),
            Note::of(Deed::Turned, computed, &format!("normals, {},", self.sides.words())),
            Note::of(Deed::Computed, splats.saturating_sub(self.radii_from_file), "radii"),
        ];
        notes.into_iter().flatten().collect()
    }
}

impl fmt::Display for CloudReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let splats = self.points - self.not_finite - self.duplicates - self.isolated;
        let found = match (self.normals_from_file >= splats, self.radii_from_file >= splats) {
            (false, false) => "normals and radii",
            (false, true) => "normals",
            _ => "radii",
        };
        let most = if self.noisy { MOST_NEIGHBORS } else { NEIGHBORS };
        let neighbors = most.min(splats.saturating_sub(1));
        let number =
            |count: usize, one: &str, many: &str| format!("{count} {}", if count == 1 { one } else { many });
        let turned = match self.normals_from_file >= splats {
            true => String::new(),
            false => format!(", turned {}", self.sides.words()),
        };
        write!(
            f,
            "{}: {found} found from {} each{turned}",
            number(self.points, "point", "points"),
            number(neighbors, "neighbor", "neighbors")
        )?;
        let parts = [
            (self.duplicates, "duplicate", "duplicates", "merged"),
            (self.isolated, "isolated point", "isolated points", "left out"),
            (self.not_finite, "point not finite", "points not finite", "left out"),
            (self.limited, "radius", "radii", "limited"),
            (self.sizes_ignored, "size", "sizes", "ignored"),
        ];
        let told = parts.into_iter().filter(|part| part.0 > 0);
        let told: Vec<_> =
            told.map(|(count, one, many, done)| format!("{} {done}", number(count, one, many))).collect();
        if !told.is_empty() {
            write!(f, "; {}", told.join(", "))?;
        }
        if self.around_scanner {
            write!(
                f,
                "; not drawn from behind, for the scanner stood among them (--backfaces flip if it is to be)"
            )?;
        }
        if let Some(step) = self.coarse_step {
            // Two digits.
            let unit = 10_f64.powf(step.log10().floor() - 1.0);
            let step = (step / unit).round() * unit;
            let step = step as f32;
            write!(
                f,
                "; numbers of 32 bits tell places to {step} here: export 64 bits, or from a nearer origin"
            )?;
        }
        Ok(())
    }
}
