//! Triangles of arrays.

use std::ffi::{c_char, c_void};

use surfel::{
    ash::vk,
    geometry::shaded_mesh,
    glam::{DVec3, Vec3},
    scene::{Colors, Mesh, MeshObject},
};

use crate::{
    handle::{get_mut, text},
    result::{Failure, Result, SurfelResult, guard},
    scene::SurfelScene,
    splats::copied,
    structs::{Struct, SurfelStructureType, read},
};

/// An object of triangles, by arrays, drawn beside splats.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelMesh {
    /// `SURFEL_STRUCTURE_TYPE_MESH`.
    pub s_type: u32,
    /// `sizeof(SurfelMesh)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// Shown in messages, as UTF-8; NULL: `mesh`.
    pub name: *const c_char,
    /// How many vertices there are.
    pub vertex_count: u64,
    /// Their positions in the scene's own space: x, y, z of each.
    pub positions: *const f64,
    /// Their normals, of any length, x, y, z of each. NULL, and where one is 0: the mean of the triangles around it.
    pub normals: *const f32,
    /// Red, green, blue and alpha of each vertex, linear, straight, 0 to 1; NULL: all are the opaque gray of surfaces without colors.
    pub colors: *const f32,
    /// How many colors there are: `vertexCount`, or 1 for all vertices.
    pub color_count: u64,
    /// How many triangles there are.
    pub triangle_count: u64,
    /// Three numbers of vertices of each, counterclockwise seen from outside. A triangle that can't be drawn is left out.
    pub triangles: *const u32,
    /// The triangles are all of a closed surface: those that face away can't be seen.
    pub closed: vk::Bool32,
    /// 0; else it is refused.
    pub reserved: u32,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelMesh {
    const TYPE: SurfelStructureType = SurfelStructureType::Mesh;

    fn reserved(&self) -> u32 {
        self.reserved
    }
}

/// # Safety
/// Pointers are NULL or lead to as much as the struct says.
unsafe fn object(given: &SurfelMesh) -> Result<MeshObject> {
    let count = given.vertex_count;
    // SAFETY: this function's contract, here and below.
    let positions = unsafe { copied(given.positions.cast(), count, "positions", DVec3::from_array) }?;
    let normals = match given.normals.is_null() {
        true => None,
        // SAFETY: as above.
        false => Some(unsafe { copied(given.normals.cast(), count, "normals", Vec3::from_array) }?),
    };
    let color_count = if given.colors.is_null() { 0 } else { given.color_count };
    if ![0, 1, count].contains(&color_count) || (color_count == 0 && !given.colors.is_null() && count > 0) {
        let text = format!("colorCount is {}: expected 1 or {count}", given.color_count);
        return Err(Failure::invalid(text));
    }
    // SAFETY: as above.
    let colors = unsafe { copied(given.colors.cast(), color_count, "colors", |color: [f32; 4]| color) }?;
    let colors = match colors[..] {
        [] => Colors::unknown(),
        [color] => Colors::Uniform(color),
        _ => Colors::Each(colors),
    };
    // SAFETY: as above.
    let triangles =
        unsafe { copied(given.triangles.cast(), given.triangle_count, "triangles", |corners| corners) }?;
    let has = |corners: &[u32; 3]| corners.iter().all(|corner| u64::from(*corner) < count);
    if let Some(number) = triangles.iter().position(|corners| !has(corners)) {
        let text = format!("triangle {number} is {:?}: there are {count} vertices", triangles[number]);
        return Err(Failure::invalid(text));
    }
    let name = match given.name.is_null() {
        true => "mesh",
        // SAFETY: as above.
        false => unsafe { text(given.name, "name") }?,
    };
    let (mesh, _) = shaded_mesh(Mesh { positions, normals, colors, triangles });
    Ok(MeshObject { name: name.to_owned(), mesh, closed: given.closed != vk::FALSE })
}

/// Adds an object of triangles; its arrays are copied. For `surfel_update` it is behind all objects of splats.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_add_mesh(
    scene: *mut SurfelScene,
    mesh: *const SurfelMesh,
) -> SurfelResult {
    guard("surfel_scene_add_mesh", || {
        // SAFETY: the contract of the header.
        let (scene, mesh) = unsafe { (get_mut(scene, "scene")?, read(mesh, "mesh")?) };
        // SAFETY: the contract of the header.
        scene.0.meshes.push(unsafe { object(&mesh) }?);
        Ok(())
    })
}
