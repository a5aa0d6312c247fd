//! Which properties of the vertices mean what.

use super::{
    clips::{CURVES, ClipColumns, MODE},
    schema::{Element, Kind, Scalar},
};

/// The properties that are read, as numbers of columns.
#[derive(Clone, Debug, Default)]
pub(super) struct Layout {
    /// The property of each column.
    pub wanted: Vec<usize>,
    /// The type of each column.
    pub types: Vec<Scalar>,
    pub position: [usize; 3],
    pub normal: Option<[usize; 3]>,
    /// In units of the positions.
    pub radius: Option<usize>,
    /// In an unknown unit.
    pub size: Option<usize>,
    /// `su_x … sv_z`, the scaled tangent vectors.
    pub tangents: Option<[[usize; 3]; 2]>,
    /// On the tangent vectors.
    pub clips: Option<ClipColumns>,
    pub rgb: Option<[usize; 3]>,
    pub alpha: Option<usize>,
    /// How much light came back to a scanner, where there is no color.
    pub intensity: Option<usize>,
    pub gaussian: Option<Gaussian>,
    /// Colors have the whole range of their type.
    pub exact_colors: bool,
    /// What is read past although its name tells what it is: each in words that follow a number of vertices.
    pub ignored: Vec<String>,
    /// The names of all others that mean nothing here.
    pub unread: Vec<String>,
}

/// The properties of a trained Gaussian.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gaussian {
    /// Natural logarithms of the standard deviations along the axes.
    pub scales: [usize; 2],
    /// That of the third axis; a Gaussian without it is flat.
    pub third_scale: Option<usize>,
    /// A quaternion w, x, y, z of any length, which turns the axes of space into its own.
    pub rotation: [usize; 4],
    /// ln(α / (1 − α)).
    pub opacity: Option<usize>,
    /// The first spherical harmonic's coefficients of red, green and blue.
    pub color: Option<[usize; 3]>,
}

/// Names that color groups have.
const COLORS: [[&str; 3]; 3] =
    [["red", "green", "blue"], ["diffuse_red", "diffuse_green", "diffuse_blue"], ["r", "g", "b"]];

/// Sizes at which programs draw points: lengths with some, pixels with others, half or whole. The distances of neighbors tell which.
const SIZES: [&str; 5] = ["psize", "psz", "size", "point_size", "pointsize"];

impl Layout {
    /// Finds the groups of properties. Of a group that lacks one, nothing is read; but positions are refused.
    ///
    /// # Errors
    /// What is wrong, in words.
    pub(super) fn of(def: &Element, is_mesh: bool) -> Result<Self, String> {
        if let Some(name) = ["x", "y", "z"].into_iter().find(|name| def.scalar(name).is_none()) {
            return Err(missing(def, name));
        }
        let mut finder = Finder { def, layout: Self::default() };
        finder.layout.position = finder.group(["x", "y", "z"]).unwrap_or_default();
        let gaussian = finder.gaussian().filter(|_| !is_mesh);
        finder.layout.gaussian = gaussian;
        finder.layout.normal =
            finder.group(["nx", "ny", "nz"]).or_else(|| finder.group(["normal_x", "normal_y", "normal_z"]));
        if gaussian.is_none_or(|gaussian| gaussian.color.is_none()) {
            finder.colors();
        }
        if gaussian.is_none() {
            finder.sizes(is_mesh);
        }
        let named = |what: &str| def.properties.iter().any(|p| p.name.starts_with(what));
        if !is_mesh {
            finder.clips();
        }
        if gaussian.is_some() && named("f_rest_") {
            finder.ignore("Gaussians' view-dependent colors, but for their means,");
        }
        finder.layout.unread = finder.unread();
        Ok(finder.layout)
    }
}

/// The refusal of vertices without a coordinate.
fn missing(def: &Element, name: &str) -> String {
    let has = |name: &str| def.properties.iter().any(|p| p.name == name);
    if has(name) {
        return format!("'{name}' is a list; expected one value");
    }
    if has("packed_position") {
        return "packed Gaussians, a compressed form; expected the properties x y z".to_owned();
    }
    format!("'{name}' is missing; expected x y z")
}

/// Makes columns of properties.
struct Finder<'a> {
    def: &'a Element,
    layout: Layout,
}

impl Finder<'_> {
    fn one(&mut self, name: &str) -> Option<usize> {
        let property = self.def.scalar(name)?;
        Some(self.add(property))
    }

    fn add(&mut self, property: usize) -> usize {
        if let Some(Kind::One(scalar)) = self.def.properties.get(property).map(|p| p.kind) {
            self.layout.types.push(scalar);
            self.layout.wanted.push(property);
        }
        self.layout.wanted.len() - 1
    }

    /// The columns of a group of names; notes what is there of one that is not whole.
    fn group<const N: usize>(&mut self, names: [&str; N]) -> Option<[usize; N]> {
        let present = names.iter().find(|name| self.def.scalar(name).is_some())?;
        if let Some(absent) = names.iter().find(|name| self.def.scalar(name).is_none()) {
            self.ignore(&format!("values of '{present}' without '{absent}'"));
            return None;
        }
        Some(names.map(|name| self.one(name).unwrap_or_default()))
    }

    fn is_whole(&self, names: &[&str]) -> bool {
        names.iter().all(|name| self.def.scalar(name).is_some())
    }

    /// What no column is of, and nothing is said of.
    fn unread(&self) -> Vec<String> {
        let Layout { wanted, ignored, gaussian, .. } = &self.layout;
        let is_told = |name: &str| {
            let is_size = name == "radius" || SIZES.contains(&name);
            let quoted = format!("'{name}'");
            gaussian.is_some() && name.starts_with("f_rest_")
                || ignored.iter().any(|told| told.contains(&quoted) || is_size && told.starts_with("sizes"))
        };
        let all = self.def.properties.iter().enumerate();
        let others = all.filter(|(number, property)| !wanted.contains(number) && !is_told(&property.name));
        others.map(|(_, property)| property.name.clone()).collect()
    }

    fn ignore(&mut self, what: &str) {
        self.layout.ignored.push(what.to_owned());
    }

    fn gaussian(&mut self) -> Option<Gaussian> {
        if !self.is_whole(&["scale_0", "scale_1", "rot_0", "rot_1", "rot_2", "rot_3"]) {
            return None;
        }
        Some(Gaussian {
            scales: self.group(["scale_0", "scale_1"])?,
            third_scale: self.one("scale_2"),
            rotation: self.group(["rot_0", "rot_1", "rot_2", "rot_3"])?,
            opacity: self.one("opacity"),
            color: self.group(["f_dc_0", "f_dc_1", "f_dc_2"]),
        })
    }

    fn colors(&mut self) {
        let whole = COLORS.into_iter().find(|names| self.is_whole(names));
        // One letter alone may mean anything.
        let [full, diffuse, _] = COLORS;
        self.layout.rgb = match whole {
            Some(names) => self.group(names),
            None => self.group(full).or_else(|| self.group(diffuse)),
        };
        self.layout.alpha = match whole {
            Some(["r", ..]) => self.one("a").or_else(|| self.one("alpha")),
            _ => self.one("alpha").or_else(|| self.one("diffuse_alpha")),
        };
        if self.layout.rgb.is_none() {
            let is_intensity = |name: &str| {
                ["intensity", "scalar_intensity", "gray", "grey"]
                    .iter()
                    .any(|known| name.eq_ignore_ascii_case(known))
            };
            let is_one = |kind| matches!(kind, Kind::One(_));
            let found = self.def.properties.iter().position(|p| is_intensity(&p.name) && is_one(p.kind));
            self.layout.intensity = found.map(|property| self.add(property));
        }
    }

    fn clips(&mut self) {
        let curves = CURVES.map(|names| self.group(names));
        if curves == [None; 2] {
            return;
        }
        if self.layout.tangents.is_none() {
            self.ignore("clip curves without tangent vectors");
            return;
        }
        self.layout.clips = Some(ClipColumns { curves, mode: self.one(MODE) });
    }

    fn sizes(&mut self, is_mesh: bool) {
        let tangents = ["su_x", "su_y", "su_z", "sv_x", "sv_y", "sv_z"];
        if is_mesh {
            if self.is_whole(&["radius"]) || self.is_whole(&tangents) {
                self.ignore("sizes of vertices that faces join");
            }
            return;
        }
        let tangents = self.group(tangents);
        self.layout.tangents = tangents.map(|[a, b, c, d, e, f]| [[a, b, c], [d, e, f]]);
        self.layout.radius = if tangents.is_none() { self.one("radius") } else { None };
        if self.layout.radius.is_none() && tangents.is_none() {
            self.layout.size = SIZES.into_iter().find_map(|name| self.one(name));
        }
    }
}
