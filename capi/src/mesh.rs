//! Triangles of arrays.

use std::ffi::{c_char, c_void};

use surfel::{
    ash::vk,
    geometry::shaded_mesh,
    glam::{DVec3, Vec3},
    scene::{Mesh, MeshObject},
};

use crate::{
    arrays::{colors_of, copied},
    handle::{get_mut, text},
    result::{Failure, Result, SurfelResult, guard},
    scene::SurfelScene,
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

/// A mesh of C's, and what it is called.
///
/// # Safety
/// Pointers are NULL or lead to as much as the struct says.
pub unsafe fn mesh_of(given: &SurfelMesh) -> Result<(String, Mesh)> {
    let count = given.vertex_count;
    // SAFETY: this function's contract, here and below.
    let positions = unsafe { copied(given.positions.cast(), count, "positions", DVec3::from_array) }?;
    let normals = match given.normals.is_null() {
        true => None,
        // SAFETY: as above.
        false => Some(unsafe { copied(given.normals.cast(), count, "normals", Vec3::from_array) }?),
    };
    // SAFETY: as above.
    let colors = unsafe { colors_of(given.colors, given.color_count, count) }?;
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
    Ok((name.to_owned(), Mesh { positions, normals, colors, triangles }))
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
        let (name, own) = unsafe { mesh_of(&mesh) }?;
        let (own, _) = shaded_mesh(own);
        scene.0.meshes.push(MeshObject { name, mesh: own, closed: mesh.closed != vk::FALSE });
        Ok(())
    })
}
