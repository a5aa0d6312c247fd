//! What the columns of rows of numbers mean.

use std::{fmt, str::FromStr};

use crate::error::Error;

/// What one column means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    /// Coordinate 0, 1 or 2.
    Position(u8),
    /// How much light came back: a gray value.
    Intensity,
    /// Red, green or blue: 0, 1 or 2.
    Color(u8),
    /// A coordinate of the normal: 0, 1 or 2.
    Normal(u8),
    /// The radius.
    Radius,
    /// Something else: not read.
    Other,
}

/// How many numbers of a row are kept at most.
pub(super) const SLOTS: usize = 11;

/// The columns that a user may name, in the order of [`Column::slot`].
const NAMES: [&str; SLOTS] = ["x", "y", "z", "i", "r", "g", "b", "nx", "ny", "nz", "radius"];

/// What headers call the columns of [`NAMES`], in lower case.
const ALIASES: [&[&str]; SLOTS] = [
    &["x", "easting", "east", "e", "rechtswert", "px", "pos_x", "position_x", "points:0", "points_0"],
    &["y", "northing", "north", "n", "hochwert", "py", "pos_y", "position_y", "points:1", "points_1"],
    &[
        "z",
        "height",
        "elevation",
        "altitude",
        "elev",
        "alt",
        "h",
        "höhe",
        "hoehe",
        "h\u{fffd}he",
        "pz",
        "pos_z",
        "position_z",
        "points:2",
        "points_2",
    ],
    &["i", "intensity", "scalar_intensity", "reflectance", "amplitude", "gray", "grey"],
    &["r", "red", "diffuse_red"],
    &["g", "green", "diffuse_green"],
    &["b", "blue", "diffuse_blue"],
    &["nx", "normal_x", "normalx", "n_x"],
    &["ny", "normal_y", "normaly", "n_y"],
    &["nz", "normal_z", "normalz", "n_z"],
    &["radius"],
];

impl Column {
    /// Where in a row's numbers it is kept.
    pub(super) fn slot(self) -> Option<usize> {
        match self {
            Self::Position(axis) => Some(usize::from(axis)),
            Self::Intensity => Some(3),
            Self::Color(channel) => Some(4 + usize::from(channel)),
            Self::Normal(axis) => Some(7 + usize::from(axis)),
            Self::Radius => Some(10),
            Self::Other => None,
        }
    }

    fn of_slot(slot: usize) -> Self {
        match slot {
            0..=2 => Self::Position(slot as u8),
            3 => Self::Intensity,
            4..=6 => Self::Color(slot as u8 - 4),
            7..=9 => Self::Normal(slot as u8 - 7),
            10 => Self::Radius,
            _ => Self::Other,
        }
    }

    /// Longitude or latitude in degrees, of a header that calls no column x and y.
    pub(super) fn of_geographic_header(name: &str) -> Option<Self> {
        match plain(name).as_str() {
            "lon" | "long" | "lng" | "longitude" => Some(Self::Position(0)),
            "lat" | "latitude" => Some(Self::Position(1)),
            _ => None,
        }
    }

    /// What a header calls it; units in brackets and quotation marks don't count.
    pub(super) fn of_header(name: &str) -> Self {
        let name = plain(name);
        ALIASES.iter().position(|names| names.contains(&name.as_str())).map_or(Self::Other, Self::of_slot)
    }
}

/// Small letters, without a unit in brackets and quotation marks.
fn plain(name: &str) -> String {
    let name = name.split(['[', '(']).next().unwrap_or_default();
    name.trim_matches(|c: char| c.is_whitespace() || "\"'_".contains(c)).to_ascii_lowercase()
}

/// The columns of rows of numbers, from the left: `x,y,z,-,r,g,b` as text. Columns behind the last are not read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Columns(Vec<Column>);

impl Columns {
    /// The columns, if they are positions and each is there once.
    pub(super) fn new(columns: Vec<Column>) -> Result<Self, String> {
        let mut seen = [0_u32; SLOTS];
        for slot in columns.iter().filter_map(|column| column.slot()) {
            if let Some(count) = seen.get_mut(slot) {
                *count += 1;
            }
        }
        if let Some(twice) = seen.iter().zip(NAMES).find(|(count, _)| **count > 1) {
            return Err(format!("two columns '{}'; expected one", twice.1));
        }
        let [positions @ .., _, _, _, _, _, _, _, _] = seen;
        if positions.contains(&0) {
            return Err("no columns x, y and z; expected them".to_owned());
        }
        let whole = |group: std::ops::Range<usize>| {
            let group = seen.get(group).unwrap_or_default();
            group.iter().all(|count| *count == 1) || group.iter().all(|count| *count == 0)
        };
        match (whole(4..7), whole(7..10)) {
            (true, true) => Ok(Self(columns)),
            (false, _) => Err("not all of the columns r, g and b; expected all or none".to_owned()),
            (_, false) => Err("not all of the columns nx, ny and nz; expected all or none".to_owned()),
        }
    }

    /// From the left.
    pub fn columns(&self) -> &[Column] {
        &self.0
    }

    /// Whether there is such a column.
    pub(super) fn has(&self, column: Column) -> bool {
        self.0.contains(&column)
    }
}

impl FromStr for Columns {
    type Err = Error;

    /// Names between commas: `x`, `y`, `z`, `i` (intensity), `r`, `g`, `b`, `nx`, `ny`, `nz`, `radius`, and `-` for
    /// a column that is not read.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for other names, one that is there twice, and where x, y or z is missing.
    fn from_str(text: &str) -> Result<Self, Error> {
        let refuse = |problem: String| Error::option("--columns", problem);
        let column = |name: &str| match NAMES.iter().position(|known| *known == name.trim()) {
            Some(slot) => Ok(Column::of_slot(slot)),
            None if name.trim() == "-" => Ok(Column::Other),
            None => {
                let name: String = name.trim().chars().take(40).collect();
                let known = NAMES.join(", ");
                Err(refuse(format!("'{}'; expected names between commas: {known} or -", name.escape_debug())))
            }
        };
        let columns: Vec<Column> = text.split(',').map(column).collect::<Result<_, _>>()?;
        Self::new(columns).map_err(refuse)
    }
}

impl fmt::Display for Columns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |column: &Column| column.slot().and_then(|slot| NAMES.get(slot)).copied().unwrap_or("-");
        f.write_str(&self.0.iter().map(name).collect::<Vec<_>>().join(" "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_columns_and_names_again() {
        let columns: Columns = "x, y,z,-,r,g,b,i,nx,ny,nz,radius".parse().unwrap();
        assert_eq!(columns.to_string(), "x y z - r g b i nx ny nz radius");
        assert_eq!(columns.columns()[3..5], [Column::Other, Column::Color(0)]);
    }

    #[test]
    fn wrong_names_are_told() {
        let refused = |text: &str| text.parse::<Columns>().unwrap_err().to_string();
        let known = "x, y, z, i, r, g, b, nx, ny, nz, radius";
        assert_eq!(refused("x,y,w"), format!("--columns: 'w'; expected names between commas: {known} or -"));
        assert_eq!(refused("x,y,z,x"), "--columns: two columns 'x'; expected one");
        assert_eq!(refused("x,y"), "--columns: no columns x, y and z; expected them");
        assert_eq!(refused("x,y,z,r"), "--columns: not all of the columns r, g and b; expected all or none");
        assert!(refused("").starts_with("--columns: ''; expected"));
    }

    #[test]
    fn headers_have_many_names_for_them() {
        assert_eq!(Column::of_header(" \"X [m]\""), Column::Position(0));
        assert_eq!(Column::of_header("Normal_Y"), Column::Normal(1));
        assert_eq!(Column::of_header("gps_time"), Column::Other);
    }
}
