//! PLY files: splats, meshes or points, ascii or binary of either byte order; and those of Gaussian splatting.
//!
//! The format is G. Turk's "The PLY Polygon File Format" (1994), and what programs made of it. Elements and properties are
//! known by their names, in any order; others are read past.

mod body;
mod clips;
mod colors;
mod faces;
mod gaussian;
mod header;
mod layout;
mod rows;
mod schema;
#[cfg(test)]
mod tests;
mod vertices;
mod viewpoint;

use glam::DVec3;

use super::{Input, Loaded, Model, fans::Fan};
use crate::{
    error::Result,
    notes::Deed,
    scene::{Clips, Colors, Mesh, Points, Shapes, Splats, Viewpoint},
};
use body::Body;
use faces::{Triangles, corners};
use header::Header;
use layout::Layout;
pub use rows::SplatRows;
use schema::Element;
use vertices::Vertices;

pub(super) fn parse(input: &Input<'_>) -> Result<Loaded> {
    let header = header::parse(input)?;
    let vertex_def = vertex_element(&header)
        .ok_or_else(|| input.fault("header", "no element 'vertex'; expected one with x y z"))?;
    let mut is_mesh = false;
    for def in &header.elements {
        is_mesh |= corners(input, def)?.is_some();
    }
    let place = || format!("element {}", vertex_def.name);
    let mut layout = Layout::of(vertex_def, is_mesh).map_err(|problem| input.fault(place(), problem))?;
    layout.exact_colors = header.own;
    let read = read(input, &header, vertex_def, &layout)?;
    if let Some((i, mode)) = read.vertices.clips.as_ref().and_then(|clips| clips.unknown_mode) {
        let problem = format!("'{}' is {mode}; expected 0 or 1", clips::MODE);
        return Err(input.fault(format!("{} {i}", vertex_def.name), problem));
    }
    input.step(input.bytes.len());
    let words = header.encoding.words();
    let behind = read.behind;
    let (mut loaded, beyond) = match (is_mesh, layout.gaussian) {
        (true, _) => mesh(read, words.to_owned()),
        (false, None) => splats_or_points(read, header.closed, words.to_owned()),
        (false, Some(gaussian)) => {
            let dimensions = if gaussian.third_scale.is_some() { "3D" } else { "2D" };
            gaussians(read, format!("{words}, {dimensions} Gaussians"))
        }
    };
    loaded.up = header.up;
    loaded.note(Deed::Clamped, beyond, "colors beyond 0 to 1");
    for what in &layout.ignored {
        loaded.note(Deed::Ignored, vertex_def.count, what.as_str());
    }
    if !layout.unread.is_empty() {
        let names = layout.unread.iter().take(8).map(String::as_str).collect::<Vec<_>>().join(", ");
        let more = if layout.unread.len() > 8 { ", …" } else { "" };
        let what = format!("fields of vertices ({names}{more})");
        loaded.note(Deed::Ignored, layout.unread.len() as u64, what);
    }
    note_other_elements(&mut loaded, &header, vertex_def);
    loaded.note(Deed::Ignored, behind, "bytes behind the last element of the header");
    Ok(loaded)
}

/// What was read of the body.
struct Read {
    vertices: Vertices,
    triangles: Vec<[u32; 3]>,
    fans: Vec<Fan>,
    /// Faces with fewer than 3 corners.
    small_polygons: u64,
    viewpoint: Option<DVec3>,
    /// Rows with more values than the header declares.
    with_extra: u64,
    /// Bytes behind the last element.
    behind: u64,
}

fn read(input: &Input<'_>, header: &Header, vertex_def: &Element, layout: &Layout) -> Result<Read> {
    let mut body = Body::new(input, header);
    let mut triangles = Triangles::new(input, vertex_def.count);
    let mut vertices = None;
    let mut viewpoint = None;
    for def in &header.elements {
        if std::ptr::eq(def, vertex_def) {
            body.check_size(def)?;
            input.options.limits.check_points(input, def.count)?;
            let mut read = Vertices::new(layout, usize::try_from(def.count).unwrap_or(0));
            body.tables(def, &layout.wanted, &mut |table| read.extend(layout, table))?;
            vertices = Some(read);
        } else if let Some(corners) = corners(input, def)? {
            triangles.read(&mut body, def, corners)?;
        } else if let Some(place) = viewpoint::place(def) {
            viewpoint = viewpoint.or(viewpoint::read(&mut body, def, place)?);
        } else {
            body.tables(def, &[], &mut |_| {})?;
        }
    }
    Ok(Read {
        vertices: vertices.unwrap_or_else(|| Vertices::new(layout, 0)),
        triangles: triangles.triangles,
        fans: triangles.fans,
        small_polygons: triangles.small_polygons,
        viewpoint,
        with_extra: body.with_extra,
        behind: body.left(),
    })
}

/// The element that has the vertices; another name than `vertex` counts where only one such element has positions.
fn vertex_element(header: &Header) -> Option<&Element> {
    let has_positions = |def: &Element| ["x", "y", "z"].iter().all(|name| def.scalar(name).is_some());
    let exact = header.elements.iter().find(|def| def.is_named(&["vertex"]));
    let mut others = header
        .elements
        .iter()
        .filter(|def| def.is_named(&["vertices", "point", "points"]) && has_positions(def));
    exact.or_else(|| others.next().filter(|_| others.next().is_none()))
}

/// Tells which elements were read past, and which properties of faces.
fn note_other_elements(loaded: &mut Loaded, header: &Header, vertex_def: &Element) {
    let is_known = |def: &Element| {
        std::ptr::eq(def, vertex_def) || def.is_named(&["face", "faces", "tristrips", "camera"])
    };
    let others = || header.elements.iter().filter(|def| !is_known(def) && def.count > 0);
    if let Some(first) = others().next() {
        let count = others().map(|def| def.count).fold(0, u64::saturating_add);
        let what = match others().nth(1) {
            None => format!("elements '{}'", first.name),
            Some(_) => format!("elements '{}' and of other unknown names", first.name),
        };
        loaded.note(Deed::Ignored, count, what);
    }
    for def in header.elements.iter().filter(|def| def.is_named(&["face", "faces"])) {
        if def.scalar("red").is_some() {
            loaded.note(Deed::Ignored, def.count, "colors of faces");
        }
    }
}

fn mesh(read: Read, format: String) -> (Loaded, u64) {
    let Read { vertices, triangles, fans, small_polygons, with_extra, .. } = read;
    let (colors, beyond) = colors(vertices.colors);
    let mesh = Mesh { positions: vertices.positions, normals: vertices.normals, colors, triangles };
    let mut loaded = Loaded::new(Model::Mesh(mesh), format);
    loaded.fans = fans;
    loaded.note(Deed::Dropped, small_polygons, "faces with fewer than 3 corners");
    loaded.note(Deed::Ignored, with_extra, "ends of rows with more values than the header declares");
    (loaded, beyond)
}

/// Splats where the file has all that makes them.
fn splats_or_points(read: Read, closed: bool, format: String) -> (Loaded, u64) {
    let Vertices { positions, normals, radii, sizes, tangents, clips, colors: file_colors, .. } =
        read.vertices;
    let (colors, beyond) = colors(file_colors);
    let shapes = match (tangents, normals, radii) {
        (Some((s, t)), ..) => Shapes::Ellipses { s, t },
        (None, Some(normals), Some(radii)) => Shapes::Disks { normals, radii },
        (None, normals, radii) => {
            let viewpoints = Viewpoint::of_all(positions.len(), read.viewpoint);
            let radii_in_doubt = radii.is_none();
            let points =
                Points { positions, normals, radii: radii.or(sizes), radii_in_doubt, colors, viewpoints };
            return (Loaded::new(Model::Points(points), format), beyond);
        }
    };
    let clips = clips.map_or_else(Clips::default, |clips| Clips::of(clips.each));
    let splats = Splats { clips, ..Splats::new(positions, shapes, colors) };
    (Loaded::new(Model::Splats { splats, closed }, format), beyond)
}

/// The Gaussians that are part of a surface.
fn gaussians(read: Read, format: String) -> (Loaded, u64) {
    let Vertices { positions, tangents, colors: file_colors, solid, .. } = read.vertices;
    let (colors, beyond) = colors(file_colors);
    let (s, t) = tangents.unwrap_or_default();
    let mut splats = Splats::new(positions, Shapes::Ellipses { s, t }, colors);
    let all = splats.len();
    if let Some(solid) = solid.filter(|solid| solid.len() == all) {
        splats.keep(&solid);
    }
    let kept = splats.len();
    let mut loaded = Loaded::new(Model::Splats { splats, closed: false }, format);
    loaded.note(Deed::Dropped, (all - kept) as u64, "Gaussians with an opacity below one half");
    loaded.note(Deed::Replaced, kept as u64, "Gaussians (by opaque disks of two standard deviations)");
    (loaded, beyond)
}

/// Linear colors, and how many were beyond 0 to 1.
fn colors(colors: Option<colors::FileColors>) -> (Colors, u64) {
    match colors.map(colors::FileColors::finish) {
        Some((colors, beyond)) => (Colors::Each(colors), beyond),
        None => (Colors::unknown(), 0),
    }
}
