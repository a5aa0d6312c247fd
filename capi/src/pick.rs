//! What is seen in one pixel.

use std::{ffi::c_void, sync::Arc};

use surfel::{
    Error, Settings,
    ash::vk,
    embed::{MemoryUse, Placement, Renderer},
    frame::FrameSlot,
    passes::{Picked, PickedPart},
    scene::{Camera, Epsilon},
    vk::{Buffer, BufferDesc},
};

use crate::{
    device::SurfelDevice,
    frame::{SceneList, SurfelFrame, with_frame},
    handle::{Out, destroy, get},
    renderer::{SurfelPreparedScene, SurfelRenderer},
    result::{Failure, SurfelResult, guard},
    structs::{Struct, SurfelStructureType, read, write},
};

/// A pixel that is looked at.
pub struct SurfelPick {
    renderer: Arc<Renderer>,
    _slot: FrameSlot,
    answer: Buffer,
    camera: Camera,
    settings: Settings,
    pixel: [u32; 2],
    at: Placement,
    left_handed: bool,
}

/// Nothing is seen there.
pub const SURFEL_PICKED_NOTHING: u32 = 0;
/// A splat.
pub const SURFEL_PICKED_SPLAT: u32 = 1;
/// A splat that stands for others in levels of detail.
pub const SURFEL_PICKED_NODE: u32 = 2;
/// A triangle.
pub const SURFEL_PICKED_TRIANGLE: u32 = 3;

/// What is seen in a pixel of one scene. `surfel_pick_read` fills it.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelPicked {
    /// `SURFEL_STRUCTURE_TYPE_PICKED`.
    pub s_type: u32,
    /// `sizeof(SurfelPicked)`.
    pub size: u32,
    /// NULL.
    pub p_next: *mut c_void,
    /// `SURFEL_PICKED_*`; of nothing, all that follows is 0.
    pub kind: u32,
    /// The number of the splat or triangle in its object; `UINT32_MAX` where the scene was not made `numbered`, or nobody knows it.
    pub number: u32,
    /// The number of its object.
    pub object: u64,
    /// Where the ray through the pixel's center meets it, in the world.
    pub position: [f64; 3],
    /// Its unit normal there, toward the eye.
    pub normal: [f64; 3],
    /// How far that is from the eye.
    pub distance: f64,
    /// Its depth along the view's axis.
    pub depth: f64,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelPicked {
    const TYPE: SurfelStructureType = SurfelStructureType::Picked;
}

/// Records a look at one pixel of a frame, from its top left corner, of its scene with this number: of several scenes a host looks at each, and takes the nearest. `commands` must be recording, outside of rendering, and be
/// submitted to the device's queue. Once they have run, `surfel_pick_read` tells what is there. What the host draws, and what hides, is not looked at. Clip planes of the settings are for scenes that stand where they are (`worldFromScene` is NULL, or without motion).
/// Takes memory of the device, for the pick alone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_pick(
    device: *const SurfelDevice,
    renderer: *const SurfelRenderer,
    commands: vk::CommandBuffer,
    frame: *const SurfelFrame,
    scene: u32,
    x: u32,
    y: u32,
    pick: *mut *mut SurfelPick,
) -> SurfelResult {
    guard("surfel_pick", || {
        // SAFETY: the contract of the header, here and below.
        let (out, device, renderer, frame) = unsafe {
            (
                Out::new(pick, "pick")?,
                &get(device, "device")?.0,
                &get(renderer, "renderer")?.renderer,
                read(frame, "frame")?,
            )
        };
        if commands == vk::CommandBuffer::null() {
            return Err(crate::handle::null("commands"));
        }
        let mut made = None;
        // SAFETY: as above.
        unsafe {
            with_frame(&frame, &mut SceneList::default(), |seen| {
                let count = seen.scenes.len();
                let placed = seen
                    .scenes
                    .get(scene as usize)
                    .ok_or_else(|| Failure::invalid(format!("scene {scene}: the frame has {count}")))?;
                let size_px = seen.settings.size_px;
                // Of a mirror's picture the one that is turned over is looked at.
                let (camera, x) = match seen.mirrored {
                    true => (seen.camera.of_mirror(), if x < size_px[0] { size_px[0] - 1 - x } else { x }),
                    false => (*seen.camera, x),
                };
                let (camera, _) = camera.camera(size_px)?;
                let mut settings = seen.settings.clone();
                let cuts = settings.clip_box.0.is_some() || !settings.clip_planes.0.is_empty();
                if cuts && placed.at != Placement::default() {
                    let problem = "cuts a scene that stands elsewhere: expected no clip planes";
                    return Err(Error::option("settings", problem).into());
                }
                if let Epsilon::Length(length) = &mut settings.epsilon {
                    *length /= placed.at.scale;
                }
                let (camera, pixel) = (placed.at.camera(&camera), [x, y]);
                let plan = renderer.plan_pick(placed.scene, &camera, &settings, pixel)?;
                let desc = BufferDesc {
                    name: "what is picked",
                    size: plan.size_bytes(),
                    usage: vk::BufferUsageFlags::TRANSFER_DST,
                };
                let answer = Buffer::new(device, desc, MemoryUse::Readback)?;
                let mut slot = FrameSlot::new(device);
                // SAFETY: the contract of the header; the slot is new, and is kept with the buffer.
                renderer.record_pick(commands, &mut slot, &plan, answer.raw())?;
                made = Some(SurfelPick {
                    renderer: renderer.clone(),
                    _slot: slot,
                    answer,
                    camera,
                    settings,
                    pixel,
                    at: placed.at,
                    left_handed: frame.left_handed != vk::FALSE,
                });
                Ok(())
            })
        }?;
        made.map_or(Ok(()), |made| out.give(made))
    })
}

/// Tells what a look at a pixel has found, once its commands have run. `scene` is the one that was looked at, which must not have changed since.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_pick_read(
    pick: *const SurfelPick,
    scene: *const SurfelPreparedScene,
    picked: *mut SurfelPicked,
) -> SurfelResult {
    guard("surfel_pick_read", || {
        // SAFETY: the contract of the header, here and below.
        let (pick, scene) = unsafe { (get(pick, "pick")?, &get(scene, "scene")?.0) };
        let SurfelPick { renderer, answer, camera, settings, pixel, .. } = pick;
        let plan = renderer.plan_pick(scene, camera, settings, *pixel)?;
        if plan.size_bytes() != answer.size() {
            return Err(Failure::invalid("the scene has changed since it was looked at"));
        }
        // SAFETY: as above: the commands have run.
        let found = plan.read(unsafe { answer.bytes() });
        // SAFETY: as above.
        unsafe { write(picked, "picked", &pick.told(found)) }
    })
}

impl SurfelPick {
    fn told(&self, found: Option<Picked>) -> SurfelPicked {
        let nothing = SurfelPicked {
            s_type: 0,
            size: 0,
            p_next: std::ptr::null_mut(),
            kind: SURFEL_PICKED_NOTHING,
            number: 0,
            object: 0,
            position: [0.0; 3],
            normal: [0.0; 3],
            distance: 0.0,
            depth: 0.0,
        };
        let Some(Picked { position, normal, distance, depth, object, part }) = found else { return nothing };
        let (kind, number) = match part {
            PickedPart::Splat(number) => (SURFEL_PICKED_SPLAT, number),
            PickedPart::Node => (SURFEL_PICKED_NODE, None),
            PickedPart::Triangle(number) => (SURFEL_PICKED_TRIANGLE, number),
        };
        let world_from_scene = self.at.world_from_scene();
        let mut position = world_from_scene.transform_point3(position);
        let mut normal = world_from_scene.transform_vector3(normal).normalize();
        if self.left_handed {
            (position.z, normal.z) = (-position.z, -normal.z);
        }
        SurfelPicked {
            kind,
            number: number.unwrap_or(u32::MAX),
            object: object as u64,
            position: position.to_array(),
            normal: normal.to_array(),
            distance: distance * self.at.scale,
            depth: depth * self.at.scale,
            ..nothing
        }
    }
}

/// Destroys what a look at a pixel has; NULL is nothing. It is freed when the epoch that is recorded now is done.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_pick_destroy(pick: *mut SurfelPick) {
    // SAFETY: the contract of the header.
    unsafe { destroy("surfel_pick_destroy", pick) };
}
