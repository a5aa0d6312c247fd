//! OBJ files: the mesh in them, through the crate `tobj`. Materials, texture coordinates, points and lines are left
//! out; no other file is opened.

mod rows;
#[cfg(test)]
mod tests;

use std::path::Path;

use glam::{DVec3, Vec3};

use super::file_name;
use crate::{
    error::{Error, Result},
    math::srgb::linear_from_srgb,
    progress::Progress,
    scene::{Colors, Mesh},
};
use rows::Rows;

pub(super) fn parse(path: &Path, bytes: &[u8], progress: &dyn Progress) -> Result<Mesh> {
    let task = format!("read {}", file_name(path));
    let total = bytes.len() as u64;
    let mut rows = Rows::new(bytes, |done| progress.step(&task, done, total));
    let options =
        tobj::LoadOptions { triangulate: true, ignore_points: true, ignore_lines: true, single_index: false };
    let loaded = tobj::load_obj_buf(&mut rows, &options, |_| Err(tobj::LoadError::OpenFileFailed));
    if let Some(fault) = rows.fault() {
        return Err(Error::input(path, format!("line {}", fault.line), fault.problem));
    }
    let (models, _) = loaded.map_err(|e| Error::input(path, "", e.to_string()))?;
    // Without `g`, `o` and `usemtl` rows, all faces are in one model and share its vertices.
    let Some(model) = models.into_iter().next().filter(|m| !m.mesh.indices.is_empty()) else {
        let problem = "no faces; expected a mesh (bare points: normals from points come later)";
        return Err(Error::input(path, "", problem));
    };
    let mesh = model.mesh;
    let left_out = rows.vertices() - (mesh.positions.len() / 3) as u64;
    if left_out > 0 {
        progress.note(&format!("{}: {left_out} vertex(es) without a face left out", path.display()));
    }
    let colors = if rows.has_colors() {
        Colors::Each(mesh.vertex_color.chunks_exact(3).map(linear_color).collect())
    } else {
        Colors::unknown()
    };
    Ok(Mesh {
        normals: rows.all_corners_have_normals().then(|| vertex_normals(&mesh)),
        positions: mesh.positions.chunks_exact(3).map(DVec3::from_slice).collect(),
        colors,
        triangles: mesh.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
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
