//! OBJ files: the mesh in them, through the crate `tobj`, or their vertices where no row is a face. Materials, texture coordinates, points and lines are left
//! out; no other file is opened.

mod rows;
#[cfg(test)]
mod tests;

use std::io::{self, BufRead};

use glam::{DVec3, Vec3};

use super::{Input, Loaded, Model};
use crate::{
    error::{Error, Result},
    math::srgb::linear_from_srgb,
    notes::Deed,
    scene::{Colors, Mesh, Points},
};
use rows::Rows;

pub(super) fn parse(input: &Input<'_>) -> Result<Loaded> {
    let Input { path, bytes, .. } = *input;
    let mut rows = Rows::new(bytes, |done| input.step(done));
    let options =
        tobj::LoadOptions { triangulate: true, ignore_points: true, ignore_lines: true, single_index: false };
    let loaded = tobj::load_obj_buf(&mut rows, &options, |_| Err(tobj::LoadError::OpenFileFailed));
    if let Some(fault) = rows.fault() {
        return Err(Error::input(path, format!("line {}", fault.line), fault.problem));
    }
    let (models, _) = loaded.map_err(|e| Error::input(path, "", e.to_string()))?;
    // Without `g`, `o` and `usemtl` rows, all faces are in one model and share its vertices.
    let Some(model) = models.into_iter().next().filter(|m| !m.mesh.indices.is_empty()) else {
        if rows.vertices() == 0 || rows.has_faces() {
            return Err(Error::input(path, "", "neither a face nor a point; expected a mesh or points"));
        }
        let points = points(bytes).map(Model::Points);
        return points.map(|model| Loaded::new(model, "OBJ")).map_err(|e| Error::file(path, "read", e));
    };
    let mesh = model.mesh;
    let left_out = rows.vertices() - (mesh.positions.len() / 3) as u64;
    let colors = if rows.has_colors() {
        Colors::Each(mesh.vertex_color.chunks_exact(3).map(linear_color).collect())
    } else {
        Colors::unknown()
    };
    let mesh = Mesh {
        normals: rows.all_corners_have_normals().then(|| vertex_normals(&mesh)),
        positions: mesh.positions.chunks_exact(3).map(DVec3::from_slice).collect(),
        colors,
        triangles: mesh.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
    };
    let mut loaded = Loaded::new(Model::Mesh(mesh), "OBJ");
    loaded.note(Deed::Dropped, left_out, "vertices without a face");
    Ok(loaded)
}

/// The vertices of a file without faces. Normals are theirs where there are as many.
fn points(bytes: &[u8]) -> io::Result<Points> {
    let mut rows = Rows::new(bytes, |_| {});
    let (mut positions, mut colors, mut normals) = (Vec::new(), Vec::new(), Vec::new());
    let mut row = String::new();
    while rows.read_line(&mut row)? > 0 {
        let mut words = row.split_ascii_whitespace();
        let is_vertex = words.next() == Some("v");
        let mut numbers = words.map(|word| word.parse::<f64>().unwrap_or(f64::NAN));
        let mut next = || numbers.next().unwrap_or(f64::NAN);
        let first = DVec3::new(next(), next(), next());
        if is_vertex {
            positions.push(first);
            colors.push(linear_color(&[next(), next(), next()]));
        } else {
            normals.push(first.as_vec3());
        }
        row.clear();
    }
    Ok(Points {
        normals: (normals.len() == positions.len()).then_some(normals),
        positions,
        radii: None,
        colors: if rows.has_colors() { Colors::Each(colors) } else { Colors::unknown() },
        viewpoint: None,
    })
}

/// Vertex colors are not part of the format; programs that write them write sRGB values 0–1.
fn linear_color(srgb: &[f64]) -> [f32; 4] {
    let linear = |i: usize| linear_from_srgb(srgb[i].clamp(0.0, 1.0) as f32);
    [linear(0), linear(1), linear(2), 1.0]
}

/// Corners have their own normals in this format; those of one vertex are averaged.
fn vertex_normals(mesh: &tobj::Mesh) -> Vec<Vec3> {
    let mut sums = vec![DVec3::ZERO; mesh.positions.len() / 3];
    for (&vertex, &normal) in mesh.indices.iter().zip(&mesh.normal_indices) {
        let normal = DVec3::from_slice(&mesh.normals[3 * normal as usize..]);
        sums[vertex as usize] += normal.normalize_or_zero();
    }
    sums.into_iter().map(|sum| sum.normalize_or_zero().as_vec3()).collect()
}
