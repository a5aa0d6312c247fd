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

use glam::DVec3;
use ply_rs_bw::ply::Encoding;

use super::{Input, Loaded, Model};
use crate::{
    error::Result,
    notes::Deed,
    scene::{Colors, Mesh, Points, Shapes, Splats},
};
use body::Body;
use faces::Triangles;
use vertices::{VertexLayout, Vertices};
use viewpoint::Viewpoint;

pub(super) fn parse(input: &Input<'_>) -> Result<Loaded> {
    let Input { path, bytes, .. } = *input;
    let header = header::parse(path, bytes)?;
    let Some(vertex_def) = header.elements.get("vertex") else {
        return Err(input.fault("header", "no element 'vertex'"));
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
    for def in header.elements.values() {
        let mut on_progress = |body: &Body<'_>| input.step(body.bytes_read());
        match (def.name.as_str(), faces::index_list(path, def)?) {
            ("vertex", _) => {
                body.check_size(def)?;
                input.options.limits.check_points(input, def.count as u64)?;
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
    input.step(bytes.len());
    let (small, declared) = (triangles.small_polygons as u64, triangles.declared);
    let model = match declared {
        true => Model::Mesh(mesh(vertices, triangles.triangles)),
        false => splats_or_points(vertices, header.closed, viewpoint),
    };
    let mut loaded = Loaded::new(model, format_words(header.encoding));
    loaded.note(Deed::Dropped, small, "faces with fewer than 3 corners");
    if layout.clip_curves && !declared {
        loaded.note(Deed::Ignored, vertex_count as u64, "clip curves, which are not supported yet,");
    }
    Ok(loaded)
}

fn format_words(encoding: Encoding) -> &'static str {
    match encoding {
        Encoding::Ascii => "PLY, ascii",
        Encoding::BinaryLittleEndian => "PLY, binary, little endian",
        Encoding::BinaryBigEndian => "PLY, binary, big endian",
    }
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
