//! The rows `v` and `vn`, and a count of all that is read past: the first of two passes, because faces may stand before
//! what they name.

use glam::{DVec3, Vec3};

use super::{
    lines::{Line, Lines, shown},
    materials::Materials,
};
use crate::{error::Result, load::Input, math::srgb::linear_from_srgb, scene::UNKNOWN_SRGB};

/// Of a vertex without a color beside others with one.
const NO_COLOR: [f32; 3] = [f32::NEG_INFINITY; 3];

/// What the rows of a file other than its faces say.
#[derive(Default)]
pub(super) struct Vertices {
    pub positions: Vec<DVec3>,
    pub normals: Vec<Vec3>,
    /// sRGB values as they are written, up to the last vertex that has one.
    colors: Vec<[f32; 3]>,
    /// The largest of them.
    largest: f32,
    pub has_faces: bool,
    /// Rows `l` and `p`.
    pub lines_and_points: u64,
    /// Rows `curv`, `curv2` and `surf`.
    pub free_forms: u64,
    pub materials: Materials,
}

impl Vertices {
    pub(super) fn read(input: &Input<'_>) -> Result<Self> {
        let mut vertices = Self::default();
        let mut lines = Lines::new(input);
        while let Some(line) = lines.next()? {
            vertices.add(input, &line).map_err(|problem| lines.fault(problem))?;
        }
        Ok(vertices)
    }

    fn add(&mut self, input: &Input<'_>, line: &Line<'_>) -> Result<(), String> {
        match line.keyword() {
            b"v" => {
                if self.positions.len() as u64 >= input.options.limits.points {
                    return Err(format!(
                        "more than {} vertices; expected at most that many",
                        self.positions.len()
                    ));
                }
                self.vertex(line.rest()?)?;
            }
            b"vn" => self.normal(line.rest()?)?,
            b"f" => self.has_faces = true,
            b"l" | b"p" => self.lines_and_points += 1,
            b"curv" | b"curv2" | b"surf" => self.free_forms += 1,
            b"mtllib" => self.materials.read_library(input, line.rest()?),
            _ => {}
        }
        Ok(())
    }

    /// `x y z`, then nothing, the divisor `w`, or `r g b`.
    fn vertex(&mut self, row: &str) -> Result<(), String> {
        let (values, count) = numbers::<6>(row)?;
        let [x, y, z, w, ..] = values;
        let (w, rgb) = match count {
            3 => (1.0, None),
            4 if w != 0.0 => (w, None),
            4 => return Err("a vertex with w = 0; expected another divisor".to_owned()),
            6 => (1.0, Some([values[3], values[4], values[5]])),
            _ => return Err(format!("a vertex of {count} numbers; expected 3, 4 or 6")),
        };
        // Colors may begin or end anywhere, and belong to their vertices.
        if let Some(rgb) = rgb {
            self.colors.resize(self.positions.len(), NO_COLOR);
            let rgb = rgb.map(|value| value as f32);
            self.largest = rgb.into_iter().filter(|value| value.is_finite()).fold(self.largest, f32::max);
            self.colors.push(rgb);
        }
        self.positions.push(DVec3::new(x / w, y / w, z / w));
        Ok(())
    }

    /// Whether some vertex has a color of its own.
    pub(super) fn have_colors(&self) -> bool {
        !self.colors.is_empty()
    }

    /// The linear color of a vertex, and whether it was beyond its range. Colors are no part of the format; programs that
    /// write them write sRGB values 0 to 1, some 0 to 255.
    pub(super) fn color(&self, vertex: usize) -> ([f32; 4], bool) {
        let white = if self.largest <= 2.0 { 1.0 } else { 255.0 };
        let own = self.colors.get(vertex).copied().filter(|color| *color != NO_COLOR);
        let [r, g, b] = own.map_or([UNKNOWN_SRGB; 3], |color| color.map(|value| value / white));
        let is_beyond = [r, g, b].iter().any(|value| *value < 0.0 || *value > 1.0);
        let linear = |value: f32| linear_from_srgb(value.clamp(0.0, 1.0));
        ([linear(r), linear(g), linear(b), 1.0], is_beyond)
    }

    fn normal(&mut self, row: &str) -> Result<(), String> {
        let ([x, y, z], count) = numbers::<3>(row)?;
        if count != 3 {
            return Err(format!("a normal of {count} numbers; expected 3"));
        }
        self.normals.push(DVec3::new(x, y, z).as_vec3());
        Ok(())
    }
}

/// Up to `N` numbers and how many words there are in all.
fn numbers<const N: usize>(row: &str) -> Result<([f64; N], usize), String> {
    let (mut values, mut count) = ([0.0; N], 0);
    for word in row.split_ascii_whitespace() {
        let value = word.parse().map_err(|_| format!("'{}'; expected a number", shown(word)))?;
        if let Some(slot) = values.get_mut(count) {
            *slot = value;
        }
        count += 1;
    }
    Ok((values, count))
}
