//! Primitives, placed and joined to one mesh or to one set of points.

use std::collections::HashMap;

use glam::{DMat3, DVec3, Vec3};

use super::{
    buffers::Buffers,
    document::{Document, Primitive},
    nodes::Placed,
    primitive::{Mode, Shared, Vertices, base_color, corners, shared, triangles, vertices},
};
use crate::{
    error::Result,
    load::{Input, Loaded, Model, shade},
    notes::Deed,
    scene::{Colors, Mesh, Points},
};

/// What was joined so far.
pub(super) struct Surface<'a> {
    input: &'a Input<'a>,
    document: &'a Document<'a>,
    buffers: Buffers<'a>,
    positions: Vec<DVec3>,
    normals: Vec<Vec3>,
    colors: Vec<[f32; 4]>,
    triangles: Vec<[u32; 3]>,
    /// Vertices that are points.
    points: Vec<u32>,
    /// Whether a primitive has a color of its own.
    has_colors: bool,
    with_normals: u64,
    without_normals: u64,
    without_positions: u64,
    lines: u64,
    left_over: u64,
    clamped: u64,
}

impl<'a> Surface<'a> {
    pub fn new(input: &'a Input<'a>, document: &'a Document<'a>, buffers: Buffers<'a>) -> Self {
        Self {
            input,
            document,
            buffers,
            positions: Vec::new(),
            normals: Vec::new(),
            colors: Vec::new(),
            triangles: Vec::new(),
            points: Vec::new(),
            has_colors: false,
            with_normals: 0,
            without_normals: 0,
            without_positions: 0,
            lines: 0,
            left_over: 0,
            clamped: 0,
        }
    }

    /// Adds a mesh where a node puts it.
    pub fn add(&mut self, placed: &Placed) -> Result<()> {
        // Primitives often have the same vertices, each with its own triangles.
        let mut known: HashMap<Shared, (u32, usize)> = HashMap::new();
        let document = self.document;
        for primitive in document.meshes.get(placed.mesh).into_iter().flat_map(|mesh| mesh.primitives.iter())
        {
            let mode = Mode::of(self.input, primitive)?;
            if mode == Mode::Lines {
                self.lines += 1;
                continue;
            }
            let key = shared(primitive);
            let found = match known.get(&key) {
                Some(known) => Some(*known),
                None => self.vertices(placed, primitive)?,
            };
            let Some((first, count)) = found else {
                self.without_positions += 1;
                continue;
            };
            known.insert(key, (first, count));
            let corners = corners(self.input, self.document, &mut self.buffers, primitive, count)?;
            if mode == Mode::Points {
                self.points.extend(corners.iter().map(|corner| first + corner));
                continue;
            }
            let (triangles, left_over) = triangles(mode, &corners);
            let mirrors = placed.world_from_mesh.matrix3.determinant() < 0.0;
            let placed = triangles.into_iter().map(|[a, b, c]| {
                let [b, c] = if mirrors { [c, b] } else { [b, c] };
                [first + a, first + b, first + c]
            });
            self.triangles.extend(placed);
            self.left_over += left_over;
        }
        Ok(())
    }

    /// Adds a primitive's vertices: the first, and how many they are.
    fn vertices(&mut self, placed: &Placed, primitive: &Primitive) -> Result<Option<(u32, usize)>> {
        let found = vertices(self.input, self.document, &mut self.buffers, primitive)?;
        let Some(Vertices { positions, normals, colors }) = found else { return Ok(None) };
        let count = positions.count;
        let base = base_color(self.input, self.document, primitive)?;
        self.has_colors |= colors.is_some() || primitive.material.is_some();
        let first = u32::try_from(self.positions.len()).unwrap_or(u32::MAX);
        let [x, y, z] = placed.world_from_mesh.matrix3.to_cols_array_2d().map(DVec3::from_array);
        // Normals stay at right angles under the cofactors, also where the matrix has no inverse.
        let sign = if placed.world_from_mesh.matrix3.determinant() < 0.0 { -1.0 } else { 1.0 };
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign;
        for i in 0..count {
            let [x, y, z, _] = positions.get(i);
            self.positions.push(placed.world_from_mesh.transform_point3(DVec3::new(x, y, z)));
            if let Some(normals) = &normals {
                let [x, y, z, _] = normals.get(i);
                self.normals.push((cofactors * DVec3::new(x, y, z)).normalize_or_zero().as_vec3());
            }
            let own = colors.as_ref().map_or([1.0; 4], |colors| colors.get(i));
            let product: [f64; 4] = std::array::from_fn(|c| {
                own.get(c).copied().unwrap_or(1.0) * base.color.get(c).copied().unwrap_or(1.0)
            });
            let mut color = product.map(|value| shade::unit(value as f32));
            self.clamped += u64::from(product.iter().any(|value| !(0.0..=1.0).contains(value)));
            if base.is_opaque {
                color[3] = 1.0;
            }
            self.colors.push(color);
        }
        self.with_normals += u64::from(normals.is_some());
        self.without_normals += u64::from(normals.is_none());
        Ok(Some((first, count)))
    }

    pub fn loaded(self, format: &str) -> Loaded {
        let colors = match (self.has_colors, self.colors.split_first()) {
            (false, _) | (true, None) => Colors::unknown(),
            (true, Some((first, others))) if others.iter().all(|other| other == first) => {
                Colors::Uniform(*first)
            }
            (true, _) => Colors::Each(self.colors),
        };
        let has_all_normals = self.without_normals == 0 && !self.positions.is_empty();
        let normals = has_all_normals.then_some(self.normals);
        let lost = if self.with_normals > 0 { self.without_normals } else { 0 };
        let stray = if self.triangles.is_empty() { 0 } else { self.points.len() as u64 };
        let model = match self.triangles.is_empty() && !self.points.is_empty() {
            true => {
                let points = self.points.iter().map(|i| *i as usize);
                let pick = |i: usize| {
                    normals.as_ref().and_then(|normals| normals.get(i)).copied().unwrap_or_default()
                };
                Model::Points(Points {
                    positions: points.clone().filter_map(|i| self.positions.get(i)).copied().collect(),
                    normals: normals.is_some().then(|| points.clone().map(pick).collect()),
                    radii: None,
                    radii_in_doubt: false,
                    colors: match colors {
                        Colors::Each(each) => {
                            Colors::Each(points.filter_map(|i| each.get(i)).copied().collect())
                        }
                        uniform => uniform,
                    },
                    viewpoints: Vec::new(),
                })
            }
            false => {
                Model::Mesh(Mesh { positions: self.positions, normals, colors, triangles: self.triangles })
            }
        };
        let mut loaded = Loaded::new(model, format);
        let is_mesh = matches!(loaded.model, Model::Mesh(_));
        loaded.note(Deed::Dropped, self.lines, "primitives of lines");
        loaded.note(Deed::Dropped, self.without_positions, "primitives without positions");
        loaded.note(Deed::Dropped, stray, "points beside triangles");
        loaded.note(Deed::Dropped, self.left_over, "corners that are no whole triangle");
        loaded.note(Deed::Clamped, self.clamped, "vertices with a color out of its range");
        // Those that have normals lose them, too, so that all are made the same way.
        loaded.note(
            Deed::Replaced,
            if is_mesh { lost } else { 0 },
            "primitives without normals, so that those of all are",
        );
        loaded
    }
}
