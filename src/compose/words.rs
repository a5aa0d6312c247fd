//! The making of an object in words.

use crate::{
    geometry::{Fitness, HybridReport, MeshReport},
    notes::{Deed, Note},
    report::InputReport,
    scene::{Colors, Defect, DefectCounts, MeshObject, Object, Opacity, Shapes, Splats},
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
        summary += &format!("; {} left out: {defects}", counted(defects.total(), "splat", "splats"));
    }
    let report = InputReport {
        name: object.name.clone(),
        vertices: mesh.map(|[vertices, _]| vertices),
        triangles: mesh.map(|[_, triangles]| triangles),
        splats: object.splats.len(),
        dropped: defects.total(),
        drawn_as: "splats",
        because: String::new(),
        model: None,
        notes: defect_notes(&defects),
        summary,
    };
    (object, report)
}

/// What was left out because it can't be drawn.
fn defect_notes(defects: &DefectCounts) -> Vec<Note> {
    let kinds = [
        (Defect::Position, "splats whose position is not finite"),
        (Defect::Normal, "splats whose normal is zero or not finite"),
        (Defect::Radius, "splats whose radius is not above zero or not finite"),
        (Defect::Tangents, "splats whose tangent vectors are collinear or not finite"),
        (Defect::Color, "splats whose color is not finite"),
        (Defect::Clip, "splats with a clip curve that is not finite or of negative weight"),
    ];
    let notes = kinds.into_iter().map(|(defect, what)| Note::of(Deed::Dropped, defects.of(defect), what));
    notes.flatten().collect()
}

/// Puts a mesh that is drawn as triangles in words. `head` is what the mesh was; `counts` its numbers of vertices and
/// triangles before those that can't be drawn were left out; `why` goes on from what it is drawn as.
pub(super) fn finish_triangles(
    object: &MeshObject,
    head: &str,
    counts: [usize; 2],
    why: &str,
) -> InputReport {
    let colors = &object.mesh.colors;
    let drawn = counted(object.mesh.triangles.len(), "triangle", "triangles");
    let opacity = opacity(colors.opacity(), alphas(colors));
    InputReport {
        name: object.name.clone(),
        vertices: Some(counts[0]),
        triangles: Some(counts[1]),
        drawn_as: "triangles",
        summary: format!("{}: {head}; drawn as {drawn}{why}{opacity}", object.name),
        ..InputReport::default()
    }
}

/// A file of splats in words.
fn splats_head(object: &Object) -> String {
    let closed = if object.closed { ", closed" } else { "" };
    let kinds = match splats_kind(&object.splats) {
        "disks" => ["disk", "disks"],
        _ => ["ellipse", "ellipses"],
    };
    format!("{}{closed}", counted(object.splats.len(), kinds[0], kinds[1]))
}

/// A number and what it is of.
pub(super) fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

/// Why a mesh is drawn as triangles though nobody asked for it.
pub(super) fn too_coarse(fitness: &Fitness) -> String {
    format!("too coarse for splats ({fitness}); --representation splats draws disks")
}

/// Why a mesh is sampled anew though nobody asked for it.
pub(super) fn too_uneven(fitness: &Fitness) -> String {
    format!("too uneven for one at each vertex ({fitness}); --representation splats draws those")
}

/// Why a mesh has a disk at each vertex though nobody asked for it.
pub(super) fn dense_enough(fitness: &Fitness) -> String {
    match fitness.rough > 0.0 {
        true => {
            format!("dense enough for a disk at each vertex ({fitness}); --representation mesh draws triangles")
        }
        false => {
            "dense enough for a disk at each vertex (none would stand visibly off its surface); --representation \
             mesh draws triangles"
                .to_owned()
        }
    }
}

/// Why something is drawn as what somebody asked for.
pub(super) const ASKED_FOR: &str = "asked for";

/// The kind of the splats, in the plural.
pub fn splats_kind(splats: &Splats) -> &'static str {
    match splats.shapes {
        Shapes::Disks { .. } => "disks",
        Shapes::Ellipses { .. } => "ellipses",
    }
}

/// A mesh in words.
pub(super) fn mesh_head([vertices, triangles]: [usize; 2], report: &MeshReport) -> String {
    let vertices = counted(vertices, "vertex", "vertices");
    format!("{vertices}, {}: {report}", counted(triangles, "triangle", "triangles"))
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
    let splats = counted(splats, "splat", "splats");
    format!("{splats} and {}{edges}", counted(report.polygons, "triangle", "triangles"))
}

/// A mesh in cells.
pub(super) fn in_cells(report: &HybridReport, cells: usize, splats: usize) -> String {
    let (cells, splats) = (counted(cells, "cell", "cells"), counted(splats, "splat", "splats"));
    format!(
        "{cells} and {splats}, {} of them on {} edges between cells",
        report.edge_splats, report.transition_edges
    )
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
