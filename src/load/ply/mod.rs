//! PLY files: splats, meshes or points, ascii or binary of either byte order.
//!
//! The format is G. Turk's "The PLY Polygon File Format" (1994). The header and binary elements are parsed by the crate
//! `ply-rs-bw`. Ascii values are not, because its grammar knows neither `nan` nor `inf` nor `1.`, which C programs
//! write; see [`ascii`].

mod ascii;
mod body;
mod faces;
mod header;
mod skip;
#[cfg(test)]
mod tests;
mod vertices;
mod viewpoint;

use std::path::Path;

use glam::DVec3;

use super::{Model, file_name};
use crate::{
    error::{Error, Result},
    progress::Progress,
    scene::{Colors, Mesh, Points, Shapes, Splats},
};
use body::Body;
use faces::Triangles;
use vertices::{VertexLayout, Vertices};
use viewpoint::Viewpoint;

pub(super) fn parse(path: &Path, bytes: &[u8], progress: &dyn Progress) -> Result<Model> {
    let header = header::parse(path, bytes)?;
    let Some(vertex_def) = header.elements.get("vertex") else {
        return Err(Error::input(path, "header", "no element 'vertex'"));
    };
    let layout = VertexLayout::of(path, vertex_def)?;
    let vertex_count = vertex_def.count;
    for def in header.elements.values() {
        faces::index_list(path, def)?;
    }
    let mut triangles = Triangles::new(path, vertex_count);
    let mut vertices = Vertices::new(layout);
    let mut viewpoint = None;
    let mut body = Body::new(path, &header, bytes);
    let task = format!("read {}", file_name(path));
    for def in header.elements.values() {
        let mut on_progress = |body: &Body<'_>| {
            let (done, total) = (body.bytes_read(), bytes.len());
            progress.step(&task, done as u64, total as u64);
        };
        match (def.name.as_str(), faces::index_list(path, def)?) {
            ("vertex", _) => {
                body.check_size(def)?;
                vertices.reserve(def.count);
                body.read(def, &mut on_progress, |_, record| {
                    vertices.push(record);
                    Ok(())
                })?;
            }
            ("face", true) => {
                body.read(def, &mut on_progress, |i, record| triangles.add_polygon(i, record))?
            }
            ("tristrips", true) => {
                body.read(def, &mut on_progress, |i, record| triangles.add_strip(i, record))?;
            }
            ("camera", _) if Viewpoint::is_in(def) => {
                body.read(def, &mut on_progress, |_, record: Viewpoint| {
                    viewpoint = viewpoint.or(record.place());
                    Ok(())
                })?;
            }
            _ => body.read(def, &mut on_progress, |_, _: skip::Skipped| Ok(()))?,
        }
    }
    progress.step(&task, bytes.len() as u64, bytes.len() as u64);
    if triangles.small_polygons > 0 {
        let count = triangles.small_polygons;
        progress.note(&format!("{}: {count} face(s) with fewer than 3 corners left out", path.display()));
    }
    if triangles.declared {
        return Ok(Model::Mesh(mesh(vertices, triangles.triangles)));
    }
    if layout.clip_curves {
        progress.note(&format!("{}: clip curves are not supported yet and are left out", path.display()));
    }
    Ok(splats_or_points(vertices, header.closed, viewpoint))
}

fn mesh(vertices: Vertices, triangles: Vec<[u32; 3]>) -> Mesh {
    Mesh {
        positions: vertices.positions,
        normals: vertices.normals,
        colors: vertices.colors.map_or_else(Colors::unknown, Colors::Each),
        triangles,
    }
}

/// Splats where the file has all that makes them.
fn splats_or_points(vertices: Vertices, closed: bool, viewpoint: Option<DVec3>) -> Model {
    let Vertices { positions, normals, radii, tangents, colors, .. } = vertices;
    let colors = colors.map_or_else(Colors::unknown, Colors::Each);
    let shapes = match (tangents, normals, radii) {
        (Some((s, t)), _, _) => Shapes::Ellipses { s, t },
        (None, Some(normals), Some(radii)) => Shapes::Disks { normals, radii },
        (None, normals, radii) => {
            return Model::Points(Points { positions, normals, radii, colors, viewpoint });
        }
    };
    Model::Splats { splats: Splats { positions, shapes, colors }, closed }
}
