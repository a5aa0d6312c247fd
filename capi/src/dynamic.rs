//! Splats that a host writes on the device.

use std::ffi::c_void;

use surfel::{
    ash::vk,
    embed::{
        DynamicSplats,
        dynamic::{color, disk},
    },
    glam::DVec3,
};

use crate::{
    arrays::array,
    handle::{Out, Place, get, get_mut},
    renderer::{SurfelPreparedScene, SurfelRenderer},
    result::{Failure, SurfelResult, guard},
    structs::{Struct, SurfelStructureType, read},
};

/// What is known of disks that a host writes on the device, by a compute shader or by copies. All of it may be wrong by being too large, at
/// the cost of speed, but not by being too small: what lies outside of the bounds may not be drawn.
///
/// Disk i has 32 bytes in the buffer of shapes: x y z radius, then nx ny nz 2.0, all float: its center from `origin` in the scene's unit, a
/// unit normal. It has 8 bytes in the buffer of colors: linear red, green, blue and alpha as 16-bit fractions of 65535.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelDynamicSplats {
    /// `SURFEL_STRUCTURE_TYPE_DYNAMIC_SPLATS`.
    pub s_type: u32,
    /// `sizeof(SurfelDynamicSplats)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// How many there are room for, at most 4 million and what a storage buffer of the device holds at 32 bytes each.
    pub capacity: u32,
    /// How many are drawn, the first ones.
    pub count: u32,
    /// Where positions are counted from.
    pub origin: [f64; 3],
    /// The smallest coordinates of centers, from the origin.
    pub least: [f64; 3],
    /// The largest ones.
    pub most: [f64; 3],
    /// The largest radius.
    pub largest_radius: f64,
    /// How many disks lie over a place of the surface, where they are fewest: it tells how much of a pixel a silhouette covers. 0 is 1. Where
    /// fewer lie than that, a surface inside of its silhouette shows what is behind it.
    pub overlap: f64,
    /// They belong to a closed surface and their normals point outward: those that face away are not drawn.
    pub closed: vk::Bool32,
    /// Some may be transparent: they are drawn in layers.
    pub transparent: vk::Bool32,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelDynamicSplats {
    const TYPE: SurfelStructureType = SurfelStructureType::DynamicSplats;
}

fn splats_of(given: &SurfelDynamicSplats) -> DynamicSplats {
    DynamicSplats {
        capacity: given.capacity,
        count: given.count,
        origin: DVec3::from_array(given.origin),
        bounds: [given.least, given.most].map(DVec3::from_array),
        largest_radius: given.largest_radius,
        overlap: if given.overlap == 0.0 { 1.0 } else { given.overlap },
        closed: given.closed != vk::FALSE,
        transparent: given.transparent != vk::FALSE,
    }
}

/// Makes a scene of splats that the host writes on the device: each time before a frame reads them, with a barrier to
/// `VK_ACCESS_2_SHADER_STORAGE_READ_BIT` of the compute and vertex stages. Nothing is in its buffers yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_dynamic_create(
    renderer: *const SurfelRenderer,
    splats: *const SurfelDynamicSplats,
    scene: *mut *mut SurfelPreparedScene,
) -> SurfelResult {
    guard("surfel_dynamic_create", || {
        // SAFETY: the contract of the header.
        let (out, renderer, splats) =
            unsafe { (Out::new(scene, "scene")?, get(renderer, "renderer")?, read(splats, "splats")?) };
        out.give(SurfelPreparedScene(renderer.renderer.dynamic(&splats_of(&splats))?))
    })
}

/// Says anew what is known of such splats, for frames that are recorded from now on: as many as there is room for, anywhere. `capacity`, `closed` and `transparent`
/// stay as they were. No other thread may use the scene meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_dynamic_set(
    scene: *mut SurfelPreparedScene,
    splats: *const SurfelDynamicSplats,
) -> SurfelResult {
    guard("surfel_dynamic_set", || {
        // SAFETY: the contract of the header.
        let (scene, splats) = unsafe { (get_mut(scene, "scene")?, read(splats, "splats")?) };
        Ok(scene.0.set_dynamic(&splats_of(&splats))?)
    })
}

/// Tells the shape of a disk as it lies in the buffer of shapes: `shape` gets 8 numbers. `center` is counted from `origin`, `normal` is a unit vector.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_dynamic_shape(
    center: *const f32,
    radius: f32,
    normal: *const f32,
    shape: *mut f32,
) -> SurfelResult {
    guard("surfel_dynamic_shape", || {
        // SAFETY: the contract of the header.
        let (center, normal, shape) = unsafe {
            (
                array(center.cast::<[f32; 3]>(), 1, "center")?[0],
                array(normal.cast::<[f32; 3]>(), 1, "normal")?[0],
                Place::new(shape.cast::<[f32; 8]>(), "shape")?,
            )
        };
        shape.write(disk(center.into(), radius, normal.into()));
        Ok(())
    })
}

/// Tells a linear color with its alpha as it lies in the buffer of colors: `packed` gets 4 numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_dynamic_color(rgba: *const f32, packed: *mut u16) -> SurfelResult {
    guard("surfel_dynamic_color", || {
        // SAFETY: the contract of the header.
        let (rgba, packed) = unsafe {
            (array(rgba.cast::<[f32; 4]>(), 1, "rgba")?[0], Place::new(packed.cast::<[u16; 4]>(), "packed")?)
        };
        packed.write(color(rgba));
        Ok(())
    })
}

/// Tells the buffers of such splats: usage `VK_BUFFER_USAGE_STORAGE_BUFFER_BIT` and `VK_BUFFER_USAGE_TRANSFER_DST_BIT`. They are the scene's.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_dynamic_buffers(
    scene: *const SurfelPreparedScene,
    shapes: *mut vk::Buffer,
    colors: *mut vk::Buffer,
) -> SurfelResult {
    guard("surfel_dynamic_buffers", || {
        // SAFETY: the contract of the header.
        let (scene, shapes, colors) =
            unsafe { (get(scene, "scene")?, Place::new(shapes, "shapes")?, Place::new(colors, "colors")?) };
        let buffers = scene.0.dynamic_buffers().ok_or_else(|| {
            Failure::invalid("scene: it was uploaded: expected one of surfel_dynamic_create")
        })?;
        shapes.write(buffers.shapes);
        colors.write(buffers.colors);
        Ok(())
    })
}
