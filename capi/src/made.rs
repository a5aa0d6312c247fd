//! Splats, and what else becomes of a host's own meshes and points.

use std::ffi::{c_char, c_void};

use surfel::{
    geometry::sharp::{Clipping, SharpOptions, sharp_splats},
    scene::Object,
};

use crate::{
    description::SurfelDescription,
    handle::get_mut,
    listener::{Listener, SurfelListener},
    mesh::{SurfelMesh, mesh_of},
    result::{Failure, Result, SurfelResult, guard},
    scene::{SurfelScene, add},
    structs::{Struct, SurfelStructureType, read},
};

/// Points on surfaces, by arrays, as scanners see them: normals and radii that they don't have are found from the points nearby.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelPoints {
    /// `SURFEL_STRUCTURE_TYPE_POINTS`.
    pub s_type: u32,
    /// `sizeof(SurfelPoints)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// Shown in messages, as UTF-8; NULL: `points`.
    pub name: *const c_char,
    /// How many there are.
    pub count: u64,
    /// Where: x, y, z of each.
    pub positions: *const f64,
    /// Their normals, of any length, x, y, z of each; NULL: there are none.
    pub normals: *const f32,
    /// Their radii; NULL: there are none.
    pub radii: *const f32,
    /// Red, green, blue and alpha of each, linear, straight, 0 to 1; NULL: all are the opaque gray of surfaces without colors.
    pub colors: *const f32,
    /// How many colors there are: `count`, or 1 for all points.
    pub color_count: u64,
    /// From where all of them were seen, x, y, z, which normals turn toward; NULL: it is not known.
    pub viewpoint: *const f64,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelPoints {
    const TYPE: SurfelStructureType = SurfelStructureType::Points;
}

/// How a mesh becomes splats that are cut at its sharp edges.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelSharp {
    /// `SURFEL_STRUCTURE_TYPE_SHARP`.
    pub s_type: u32,
    /// `sizeof(SurfelSharp)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// So many splats at most, where the mesh can be simplified so far; 0: one for each triangle, or as few as `maxError` allows.
    pub splats: u64,
    /// The largest error of a simplification, in the mesh's unit; 0: any.
    pub max_error: f64,
    /// The least angle between the normals of two triangles at a sharp edge, in radians; 0: 30 degrees.
    pub crease_rad: f64,
    /// What cuts splats at sharp edges: `SURFEL_CLIPPING_*`.
    pub clipping: u32,
    /// 0; else it is refused.
    pub reserved: u32,
    /// Who is told how far it is; NULL: nobody.
    pub listener: *const SurfelListener,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelSharp {
    const TYPE: SurfelStructureType = SurfelStructureType::Sharp;

    fn reserved(&self) -> u32 {
        self.reserved
    }
}

/// Adds what `description` makes of a mesh: splats at its vertices or spread over it, its triangles, or both. NULL: what shows it best. Arrays are copied. `listener` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_add_mesh_as(
    scene: *mut SurfelScene,
    mesh: *const SurfelMesh,
    description: *const SurfelDescription,
    listener: *const SurfelListener,
) -> SurfelResult {
    guard("surfel_scene_add_mesh_as", || {
        // SAFETY: the contract of the header.
        unsafe { add_mesh(scene, mesh, description, listener) }
    })
}

/// Adds the splats of points, which close the surface that they lie on. Of `description`, which may be NULL, name, place, color, alpha and ε count; points have no triangles. Arrays are copied. `listener` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_add_points(
    scene: *mut SurfelScene,
    points: *const SurfelPoints,
    description: *const SurfelDescription,
    listener: *const SurfelListener,
) -> SurfelResult {
    guard("surfel_scene_add_points", || {
        // SAFETY: the contract of the header.
        unsafe { add_points(scene, points, description, listener) }
    })
}

/// One curve for each piece of a sharp edge, which the splats on both sides share.
pub const SURFEL_CLIPPING_SHARED: u32 = 0;
/// For each splat a curve of its own.
pub const SURFEL_CLIPPING_OWN: u32 = 1;
/// Straight lines.
pub const SURFEL_CLIPPING_LINES: u32 = 2;
/// Nothing: splats stick out.
pub const SURFEL_CLIPPING_NONE: u32 = 3;

/// Adds a mesh as splats that are cut at its sharp edges, one for each triangle or fewer. The mesh must be a surface: each edge of one triangle or two, which pass it in opposite
/// directions. `options` may be NULL. Arrays are copied.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_add_sharp_mesh(
    scene: *mut SurfelScene,
    mesh: *const SurfelMesh,
    options: *const SurfelSharp,
) -> SurfelResult {
    guard("surfel_scene_add_sharp_mesh", || {
        // SAFETY: the contract of the header, here and below.
        let (scene, mesh) = unsafe { (get_mut(scene, "scene")?, read(mesh, "mesh")?) };
        let mut own = SharpOptions::default();
        let mut listener = std::ptr::null();
        if !options.is_null() {
            // SAFETY: as above.
            let given = unsafe { read(options, "options") }?;
            listener = given.listener;
            own.splats = (given.splats > 0).then_some(given.splats);
            own.max_error = (given.max_error != 0.0).then_some(given.max_error);
            own.crease_rad = match given.crease_rad {
                0.0 => own.crease_rad,
                angle if angle > 0.0 && angle.is_finite() => angle,
                other => {
                    return Err(Failure::invalid(format!("creaseRad is {other}: expected an angle above 0")));
                }
            };
            own.clipping = match given.clipping {
                SURFEL_CLIPPING_SHARED => Clipping::Shared,
                SURFEL_CLIPPING_OWN => Clipping::Own,
                SURFEL_CLIPPING_LINES => Clipping::Lines,
                SURFEL_CLIPPING_NONE => Clipping::None,
                other => return Err(Failure::invalid(format!("clipping is {other}: expected a known one"))),
            };
        }
        // SAFETY: as above.
        let (listener, name, mesh) = unsafe {
            let (name, mesh) = mesh_of(&mesh)?;
            (Listener::new(listener)?, name, mesh)
        };
        let (mut splats, report) = sharp_splats(&mesh, &own, &listener)?;
        splats.drop_defective();
        add(&mut scene.0, Object { name, splats, closed: report.closed }, (false, [0.0; 2]))
    })
}

#[cfg(feature = "files")]
use of_description::{add_mesh, add_points};

#[cfg(feature = "files")]
mod of_description {
    use std::path::Path;

    use surfel::{
        compose::make_model,
        glam::{DVec3, Vec3},
        load::Model,
        scene::{Points, Viewpoint},
    };

    use super::*;
    use crate::{
        arrays::{array, colors_of, copied},
        description::{built, described},
        handle::text,
    };

    /// # Safety
    /// The contract of the header.
    unsafe fn add_model(
        scene: *mut SurfelScene,
        (name, model): (&str, Model),
        description: *const SurfelDescription,
        listener: *const SurfelListener,
    ) -> Result<()> {
        // SAFETY: this function's contract.
        let (scene, description, listener) = unsafe {
            let description = described(description, Path::new(name))?;
            (&mut get_mut(scene, "scene")?.0, description, Listener::new(listener)?)
        };
        built(scene, make_model(model, &description, &listener)?, description.epsilon);
        Ok(())
    }

    /// # Safety
    /// The contract of the header.
    pub unsafe fn add_mesh(
        scene: *mut SurfelScene,
        mesh: *const SurfelMesh,
        description: *const SurfelDescription,
        listener: *const SurfelListener,
    ) -> Result<()> {
        // SAFETY: this function's contract.
        unsafe {
            let (name, mesh) = mesh_of(&read(mesh, "mesh")?)?;
            add_model(scene, (&name, Model::Mesh(mesh)), description, listener)
        }
    }

    /// # Safety
    /// The contract of the header.
    pub unsafe fn add_points(
        scene: *mut SurfelScene,
        points: *const SurfelPoints,
        description: *const SurfelDescription,
        listener: *const SurfelListener,
    ) -> Result<()> {
        // SAFETY: this function's contract, here and below.
        let given = unsafe { read(points, "points") }?;
        let count = given.count;
        // SAFETY: as above.
        let positions = unsafe { copied(given.positions.cast(), count, "positions", DVec3::from_array) }?;
        let normals = match given.normals.is_null() {
            true => None,
            // SAFETY: as above.
            false => Some(unsafe { copied(given.normals.cast(), count, "normals", Vec3::from_array) }?),
        };
        let radii = match given.radii.is_null() {
            true => None,
            // SAFETY: as above.
            false => Some(unsafe { copied(given.radii, count, "radii", |radius: f32| radius) }?),
        };
        let place = match given.viewpoint.is_null() {
            true => None,
            // SAFETY: as above.
            false => Some(unsafe { array(given.viewpoint.cast::<[f64; 3]>(), 1, "viewpoint") }?[0].into()),
        };
        // SAFETY: as above.
        let colors = unsafe { colors_of(given.colors, given.color_count, count) }?;
        let viewpoints = Viewpoint::of_all(positions.len(), place);
        let points = Points { positions, normals, radii, radii_in_doubt: false, colors, viewpoints };
        let name = match given.name.is_null() {
            true => "points",
            // SAFETY: as above.
            false => unsafe { text(given.name, "name") }?,
        };
        // SAFETY: as above.
        unsafe { add_model(scene, (name, Model::Points(points)), description, listener) }
    }
}

#[cfg(not(feature = "files"))]
unsafe fn add_mesh(
    _scene: *mut SurfelScene,
    _mesh: *const SurfelMesh,
    _description: *const SurfelDescription,
    _listener: *const SurfelListener,
) -> Result<()> {
    Err(Failure::without_files())
}

#[cfg(not(feature = "files"))]
unsafe fn add_points(
    _scene: *mut SurfelScene,
    _points: *const SurfelPoints,
    _description: *const SurfelDescription,
    _listener: *const SurfelListener,
) -> Result<()> {
    Err(Failure::without_files())
}
