//! Every triangle of a scene that can be drawn.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::splat::culls;
use super::surface::Attributes;
use super::triangle::DrawnTriangle;
use super::view::View;
use crate::scene::{MeshObject, Opacity, Scene, Settings};

/// The triangles of a scene, in its order.
#[derive(Default)]
pub(super) struct Triangles {
    pub opaque: Vec<DrawnTriangle>,
    pub transparent: Vec<DrawnTriangle>,
    /// There is an opaque triangle that can be drawn, if only from another side.
    pub has_opaque: bool,
}

/// Left out are triangles with a corner that is missing, or whose position, normal or color is not finite, those without
/// area, those that face away where they are culled, and objects whose every alpha is 0.
pub(super) fn prepare(scene: &Scene, view: &View, settings: &Settings) -> Triangles {
    let mut triangles = Triangles::default();
    for object in &scene.meshes {
        let opacity = object.mesh.colors.opacity();
        let cull = culls((settings, !view.planes.is_empty()), object.closed, opacity);
        let usable = (0..object.mesh.triangles.len())
            .filter_map(|i| Some((object.mesh.triangles[i], prepare_one(object, i, view)?)));
        let usable: Vec<_> = usable.collect();
        triangles.has_opaque |= opacity == Opacity::Opaque && !usable.is_empty();
        let mut drawn = usable;
        drawn.retain(|(_, triangle)| !(cull && triangle.faces_away()));
        find_borders(&mut drawn);
        let drawn = drawn.into_iter().map(|(_, mut triangle)| {
            triangle.outward = object.closed;
            triangle
        });
        match opacity {
            Opacity::Invisible => {}
            Opacity::Transparent => triangles.transparent.extend(drawn),
            Opacity::Opaque => triangles.opaque.extend(drawn),
        }
    }
    triangles
}

fn prepare_one(object: &MeshObject, i: usize, view: &View) -> Option<DrawnTriangle> {
    let corners = object.mesh.corners(i)?.map(|corner| view.from_world.point(corner));
    let [a, b, c] = object.mesh.triangles[i].map(|vertex| attributes(object, vertex as usize, view));
    DrawnTriangle::new(corners, [a?, b?, c?])
}

/// The attributes of a vertex; without a normal where the mesh has none.
fn attributes(object: &MeshObject, vertex: usize, view: &View) -> Option<Attributes> {
    let color = object.mesh.colors.get(vertex)?;
    let normal = match &object.mesh.normals {
        Some(normals) => *normals.get(vertex)?,
        None => Vec3::ZERO,
    };
    let [red, green, blue, alpha] = color.map(f64::from);
    (color.iter().all(|c| c.is_finite()) && normal.is_finite()).then(|| Attributes {
        albedo: DVec3::new(red, green, blue),
        normal: view.from_world.rotation * normal.as_dvec3(),
        alpha: alpha.clamp(0.0, 1.0),
    })
}

/// An edge is none of the border where exactly one other triangle goes on beyond it, between the same two vertices and with
/// the same side to the eye: coverage, depth and shading are continuous there. At a fold one of them faces away.
fn find_borders(triangles: &mut [([u32; 3], DrawnTriangle)]) {
    let mut count = HashMap::<(u32, u32, bool), u32>::new();
    for ([a, b, c], triangle) in triangles.iter() {
        for (from, to) in [(*b, *c), (*c, *a), (*a, *b)] {
            *count.entry((from, to, triangle.faces_away())).or_default() += 1;
        }
    }
    for ([a, b, c], triangle) in triangles {
        let away = triangle.faces_away();
        let is_one = |from: u32, to: u32| count.get(&(from, to, away)) == Some(&1);
        let edges = [(*b, *c), (*c, *a), (*a, *b)];
        triangle.is_border = edges.map(|(from, to)| !(is_one(from, to) && is_one(to, from)));
    }
}
