//! The rows `v` and `vn`, and a count of all that is read past: the first of two passes, because faces may stand before
//! what they name.

use glam::{DVec3, Vec3};

use super::{
    lines::{Line, Lines},
    materials::Materials,
    rows::Rows,
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
    rows: Rows,
}

impl Vertices {
    pub(super) fn read(input: &Input<'_>) -> Result<Self> {
        let mut vertices = Self::default();
        let mut lines = Lines::new(input);
        while let Some(line) = lines.next()? {
            vertices.add(input, &line, &lines)?;
        }
        vertices.read_rows(&lines)?;
        Ok(vertices)
    }

    fn add(&mut self, input: &Input<'_>, line: &Line<'_>, lines: &Lines<'_>) -> Result<()> {
        let rest = || line.rest().map_err(|problem| lines.fault(problem));
        match line.keyword() {
            b"v" => {
                let row = rest()?;
                if self.rows.is_full() || self.rows.differ_from(row) {
                    self.read_rows(lines)?;
                }
                let most = input.options.limits.points;
                if (self.positions.len() + self.rows.counts[0]) as u64 >= most {
                    return Err(lines.fault(format!("more than {most} vertices; expected at most that many")));
                }
                self.rows.vertex(row, lines.first());
            }
            b"vn" => {
                if self.rows.is_full() {
                    self.read_rows(lines)?;
                }
                self.rows.normal(rest()?, lines.first());
            }
            b"f" => self.has_faces = true,
            b"l" | b"p" => self.lines_and_points += 1,
            b"curv" | b"curv2" | b"surf" => self.free_forms += 1,
            b"mtllib" => self.materials.read_library(input, rest()?),
            _ => {}
        }
        Ok(())
    }

    fn read_rows(&mut self, lines: &Lines<'_>) -> Result<()> {
        let mesh = self.rows.read().map_err(|(line, problem)| lines.fault_at(line, problem))?;
        let rgb = mesh.vertex_color.as_chunks().0.iter().map(|rgb| rgb.map(|value| value as f32));
        // Colors may begin or end anywhere, and belong to their vertices.
        if !mesh.vertex_color.is_empty() {
            self.colors.resize(self.positions.len(), NO_COLOR);
        }
        for rgb in rgb {
            self.largest = rgb.into_iter().filter(|value| value.is_finite()).fold(self.largest, f32::max);
            self.colors.push(rgb);
        }
        let positions = mesh.positions.as_chunks().0;
        self.positions.extend(positions.iter().copied().map(DVec3::from_array));
        let normals = mesh.normals.as_chunks().0;
        self.normals.extend(normals.iter().map(|&normal| DVec3::from_array(normal).as_vec3()));
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
}
