//! The making of an object in words.

use crate::{
    geometry::{HybridReport, MeshReport},
    report::InputReport,
    scene::{Colors, DefectCounts, MeshObject, Object, Opacity, Shapes, Splats},
};

/// Drops splats that can't be drawn and puts all in words. `head` is what a mesh was and how it became splats, empty for
/// splats; `mesh` its numbers of vertices and triangles.
pub fn finish(object: Object, head: String, mesh: Option<[usize; 2]>) -> (Object, InputReport) {
    finish_splats(object, head, mesh, DefectCounts::default())
}

/// As [`finish`]; some were left out before.
pub(super) fn finish_splats(
    mut object: Object,
    head: String,
    mesh: Option<[usize; 2]>,
    mut defects: DefectCounts,
) -> (Object, InputReport) {
    defects.merge(&object.splats.drop_defective());
    let head = if head.is_empty() { splats_head(&object) } else { head };
    let opacity = opacity(object.splats.colors.opacity(), alphas(&object.splats.colors));
    let mut summary = format!("{}: {head}{opacity}", object.name);
    if defects.total() > 0 {
        summary += &format!("; {} splats left out: {defects}", defects.total());
    }
    let report = InputReport {
        name: object.name.clone(),
        vertices: mesh.map(|[vertices, _]| vertices),
        triangles: mesh.map(|[_, triangles]| triangles),
        splats: object.splats.len(),
        dropped: defects.total(),
        notes: Vec::new(),
        summary,
    };
    (object, report)
}

/// Puts a mesh that is drawn as triangles in words. `head` is what the mesh was; `counts` its numbers of vertices and
/// triangles before those that can't be drawn were left out.
pub(super) fn finish_triangles(object: &MeshObject, head: &str, counts: [usize; 2]) -> InputReport {
    let colors = &object.mesh.colors;
    let triangles = object.mesh.triangles.len();
    let opacity = opacity(colors.opacity(), alphas(colors));
    InputReport {
        name: object.name.clone(),
        vertices: Some(counts[0]),
        triangles: Some(counts[1]),
        splats: 0,
        dropped: 0,
        notes: Vec::new(),
        summary: format!("{}: {head}; drawn as {triangles} triangles{opacity}", object.name),
    }
}

/// A file of splats in words.
fn splats_head(object: &Object) -> String {
    let closed = if object.closed { ", closed" } else { "" };
    format!("{} {}{closed}", object.splats.len(), splats_kind(&object.splats))
}

/// The kind of the splats, in the plural.
pub fn splats_kind(splats: &Splats) -> &'static str {
    match splats.shapes {
        Shapes::Disks { .. } => "disks",
        Shapes::Ellipses { .. } => "ellipses",
    }
}

/// A mesh in words.
pub(super) fn mesh_head([vertices, triangles]: [usize; 2], report: &MeshReport) -> String {
    format!("{vertices} vertices, {triangles} triangles: {report}")
}

/// The attributes that were missing in the file of a mesh that became `splats` splats.
pub(super) fn radii_computed(report: &MeshReport, splats: usize) -> String {
    match report.normals_from_file {
        0 => "normals and radii computed".to_owned(),
        n if n >= splats => "radii computed".to_owned(),
        n => format!("{} normals and all radii computed", splats - n),
    }
}

/// The normals that were missing in a mesh that stays one.
pub(super) fn normals_computed(report: &MeshReport, vertices: usize) -> String {
    match vertices.saturating_sub(report.normals_from_file + report.vertices_without_faces) {
        0 => "normals given".to_owned(),
        _ if report.normals_from_file == 0 => "normals computed".to_owned(),
        missing => format!("{missing} normals computed"),
    }
}

/// A mesh in two parts.
pub(super) fn split_into(report: &HybridReport, splats: usize) -> String {
    let edges = match (report.transition_edges, report.edge_splats) {
        (0, _) => String::new(),
        (edges, 0) => format!(", which meet at {edges} edges"),
        (edges, on_them) => format!(", which meet at {edges} edges with {on_them} of the splats"),
    };
    format!("{splats} splats and {} triangles{edges}", report.polygons)
}

/// The opacity in words; nothing is said of what is opaque.
fn opacity(opacity: Opacity, alphas: [f32; 2]) -> String {
    let [least, most] = alphas;
    match opacity {
        Opacity::Opaque => String::new(),
        Opacity::Invisible => "; invisible, alpha 0".to_owned(),
        Opacity::Transparent if least == most => format!("; transparent, alpha {least}"),
        Opacity::Transparent => format!("; transparent, alpha {least} to {most}"),
    }
}

fn alphas(colors: &Colors) -> [f32; 2] {
    match colors {
        Colors::Uniform(color) => [color[3]; 2],
        Colors::Each(colors) => range(colors),
    }
}

fn range(colors: &[[f32; 4]]) -> [f32; 2] {
    let alphas = colors.iter().map(|color| color[3]).filter(|alpha| alpha.is_finite());
    alphas
        .fold([f32::INFINITY, f32::NEG_INFINITY], |[least, most], alpha| [least.min(alpha), most.max(alpha)])
}
