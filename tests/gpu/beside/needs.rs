//! What scenes and views are told to need is what they ask for, piece by piece; and one block of that size is enough.

use std::sync::{Arc, Mutex};

use ash::vk;
use surfel::{
    Scene, Settings,
    embed::{
        Device, HostAllocation, HostMemory, Import, MemoryNeeds, MemoryPiece, MemoryRequest, Placed,
        Renderer, Rendering, View, ViewFrame,
    },
    geometry::sharp::{SharpOptions, sharp_splats},
    hard_scenes::parts,
    scene::{Camera, ClipPlanes, Object, SplatFormat},
    vk::Limits,
};

use super::{
    Beside, COLOR_FORMAT, Engine, OBJECT_FORMATS, REVERSED, SIZE_PX,
    ahead::{Flight, WITHOUT_ROOM, flights, of_splats, on_the_way},
    allocators::OneBlock,
    engine::Style,
    memory::OfEngine,
};
use crate::common::{PICTURE, scenes, shared};

/// An engine's allocator that takes down what it is asked for.
struct Listing {
    own: Arc<OfEngine>,
    asked: Mutex<Vec<MemoryPiece>>,
}

// SAFETY: as `OfEngine` is.
unsafe impl HostMemory for Listing {
    fn allocate(&self, request: &MemoryRequest<'_>) -> Result<HostAllocation, vk::Result> {
        let MemoryRequest { name, requirements, touched_by, linear } = *request;
        let piece = MemoryPiece { name: name.to_owned(), requirements, touched_by, linear };
        self.asked.lock().unwrap().push(piece);
        self.own.allocate(request)
    }

    fn free(&self, allocation: HostAllocation) {
        self.own.free(allocation);
    }
}

impl Listing {
    /// What it was asked for since this was called before.
    fn take(&self) -> Vec<MemoryPiece> {
        std::mem::take(&mut self.asked.lock().unwrap())
    }
}

/// What is compared of a piece.
fn words(pieces: &[MemoryPiece]) -> Vec<String> {
    let words = |piece: &MemoryPiece| {
        let MemoryPiece { name, requirements, touched_by, linear } = piece;
        let vk::MemoryRequirements { size, alignment, memory_type_bits } = requirements;
        format!("{name}: {size} at {alignment} of {memory_type_bits:b}, {touched_by:?}, linear {linear}")
    };
    pieces.iter().map(words).collect()
}

/// A cube whose edges cut its splats, beside a ball of ellipses without.
fn clipped() -> Scene {
    let (splats, report) = sharp_splats(&parts::cube(4), &SharpOptions::default(), &()).unwrap();
    let cube = Object { name: "cube".to_owned(), splats, closed: report.closed };
    Scene { objects: vec![cube, scenes::sphere(2000, glam::DVec3::X)], ..Scene::default() }
}

/// Of all kinds.
fn kinds() -> Vec<Flight> {
    let settings = Settings { size_px: SIZE_PX, ..Settings::default() };
    let flight = |name, scene, settings| Flight { name, scene, settings };
    let mut packed = of_splats(70_000, true, 1.0);
    packed.storage.format = SplatFormat::Packed;
    let cut = Settings { clip_planes: ClipPlanes([[1.0, 0.0, 0.0, 0.2]].into()), ..settings.clone() };
    let mut all = flights();
    all.push(flight("clipped", clipped(), settings.clone()));
    all.push(flight("packed, in two batches", packed, settings.clone()));
    all.push(flight("cut by planes", of_splats(3000, true, 1.0), cut));
    all.push(flight("updatable", Scene { updatable: true, ..of_splats(3000, true, 1.0) }, settings.clone()));
    all.push(flight("nothing", Scene::default(), settings));
    all
}

#[test]
fn scenes_and_views_ask_for_what_they_are_told_to_need_and_nothing_else() {
    for tells_objects in [false, true] {
        let engine = Engine::new(Style { validates: false, tells_objects, ..REVERSED });
        let listing = Arc::new(Listing { own: OfEngine::new(&engine), asked: Mutex::default() });
        let host = Import { memory: Some(listing.clone()), ..engine.lent() };
        // SAFETY: all is the engine's own, which goes last.
        let device = unsafe { Device::import(&host) }.unwrap();
        let beside = Beside::on(engine, device);
        let mut rendering = Rendering { color_formats: vec![COLOR_FORMAT], ..Rendering::default() };
        if tells_objects {
            rendering.color_formats.extend(OBJECT_FORMATS);
            (rendering.ids, rendering.motion) = (true, true);
        }
        // Whose each pixel is changes what a view asks for in the same way for all kinds.
        let most = if tells_objects { 4 } else { usize::MAX };
        for Flight { name, scene, settings } in kinds().into_iter().take(most) {
            let mut renderer = Renderer::new(&beside.device, None).unwrap();
            if name == WITHOUT_ROOM {
                let limits = beside.device.facts().limits;
                renderer.lower_limits(&Limits { max_storage_buffer_range: 1 << 16, ..limits });
            }
            let (needs, measured) = renderer.scene_needs(&scene).unwrap();
            assert_eq!((listing.take().len(), measured.bytes()), (0, 0), "{name}");
            // From near, from afar, where it is tinted, and among the splats.
            for (number, step) in [60, 0, 135].into_iter().enumerate() {
                let camera = on_the_way(settings.size_px).nth(step).unwrap();
                let tint = if number == 1 { [0.5, 1.0, 1.0, 1.0] } else { [1.0; 4] };
                let hides = Some(beside.hides());
                let placed = [Placed { tint, ..Placed::at_home(&measured) }];
                let frame = ViewFrame { hides, ..ViewFrame::new(&placed, &camera, &settings) };
                let made = renderer.pipelines_made();
                let told = renderer.view_needs(&rendering, &frame).unwrap();
                assert_eq!((listing.take().len(), renderer.pipelines_made()), (0, made), "{name}");

                let mut view = View::new(&renderer, &rendering).unwrap();
                beside.engine.begin();
                // SAFETY: recording, here and below; never submitted.
                let refused = unsafe { view.prepare(&renderer, beside.engine.commands, &frame) }.unwrap_err();
                assert!(refused.to_string().contains("is on no device"), "{refused}");
                let refused = renderer.plan_pick(&measured, &Camera::default(), &settings, [0, 0]);
                let refused = refused.map(drop).unwrap_err();
                assert!(refused.to_string().contains("is on no device"), "{refused}");
                // SAFETY: as above.
                let uploaded = unsafe { renderer.upload(beside.engine.commands, &scene) }.unwrap();
                let asked = listing.take();
                assert_eq!(words(&asked), words(&needs.pieces), "{name}: the scene");
                let placed = [Placed { tint, ..Placed::at_home(&uploaded) }];
                let frame = ViewFrame { hides, ..ViewFrame::new(&placed, &camera, &settings) };
                let again = renderer.view_needs(&rendering, &frame).unwrap();
                assert_eq!(words(&again.pieces), words(&told.pieces), "{name}: of a scene on the device");
                // SAFETY: as above.
                unsafe { view.prepare(&renderer, beside.engine.commands, &frame) }.unwrap();
                let asked = listing.take();
                assert_eq!(words(&asked), words(&told.pieces), "{name}: the view, step {step}");
                let bytes: u64 = asked.iter().map(|piece| piece.requirements.size).sum();
                assert_eq!(bytes, told.bytes(), "{name}");
                println!("{name}, {step}: {} and {} bytes", needs.bytes(), bytes);
                drop((view, uploaded));
                // SAFETY: nothing was submitted.
                unsafe { beside.device.epoch_done(beside.device.end_epoch()) };
            }
        }
        beside.end();
    }
}

/// Scene and view, with what is copied from, all at once.
#[test]
fn one_block_of_the_size_that_is_told_holds_a_scene_and_a_view_to_the_byte() {
    crate::common::arm();
    let engine = Engine::new(REVERSED);
    let scene = of_splats(3000, true, 1.0);
    let settings = Settings { size_px: SIZE_PX, ..Settings::default() };
    let camera = on_the_way(SIZE_PX).nth(60).unwrap();
    let rendering = Rendering { color_formats: vec![COLOR_FORMAT], ..Rendering::default() };

    // By a device that nothing is taken from.
    // SAFETY: all is the engine's own, which goes last.
    let device = unsafe { Device::import(&engine.lent()) }.unwrap();
    let renderer = Renderer::new(&device, None).unwrap();
    let (mut needs, measured) = renderer.scene_needs(&scene).unwrap();
    let placed = [Placed::at_home(&measured)];
    let frame = ViewFrame::new(&placed, &camera, &settings);
    needs.pieces.extend(renderer.view_needs(&rendering, &frame).unwrap().pieces);
    assert_eq!(device.memory_in_use(), (0, 0));
    drop((measured, renderer));
    drop(device);

    let bytes = |needs: &MemoryNeeds, granularity| needs.block(granularity, |_| true).size;
    let sized = OneBlock::new(&engine, 4096);
    let granularity = sized.granularity;
    sized.end();
    let block = OneBlock::new(&engine, bytes(&needs, granularity).next_multiple_of(granularity));
    let host = Import { memory: Some(block.clone()), ..engine.lent() };
    // SAFETY: as above.
    let device = unsafe { Device::import(&host) }.unwrap();
    let renderer = Renderer::new(&device, None).unwrap();
    let mut view = View::new(&renderer, &rendering).unwrap();
    engine.begin();
    // SAFETY: recording; waited for below.
    let uploaded = unsafe { renderer.upload(engine.commands, &scene) }.unwrap();
    let placed = [Placed::at_home(&uploaded)];
    // SAFETY: as above.
    unsafe { view.prepare(&renderer, engine.commands, &ViewFrame::new(&placed, &camera, &settings)) }
        .unwrap();
    engine.begin_rendering(true);
    // SAFETY: inside of the rendering that the view was made for.
    unsafe { view.draw(&renderer, engine.commands) }.unwrap();
    engine.end_rendering();
    engine.submit();
    let epoch = device.end_epoch();
    engine.wait();
    // SAFETY: waited for.
    unsafe { device.epoch_done(epoch) };
    assert_eq!(block.most_bytes(), bytes(&needs, granularity).next_multiple_of(granularity));
    let covered = engine.pixels().iter().filter(|color| color[3] > 0.0).count();
    assert!(covered > 1000, "{covered}");
    drop((view, uploaded, renderer));
    // SAFETY: nothing is under way.
    unsafe { device.epoch_done(device.end_epoch()) };
    drop(device);
    block.end();
    assert_eq!(engine.said(), [] as [String; 0]);
}

#[test]
fn a_picture_of_a_scene_that_was_only_measured_is_refused() {
    let mut headless = shared();
    let (_, measured) = headless.renderer.scene_needs(&of_splats(100, true, 1.0)).unwrap();
    let settings = Settings { size_px: [8, 8], ..Settings::default() };
    let refused = headless.render(&measured, &Camera::default(), &settings, PICTURE).map(drop).unwrap_err();
    assert!(refused.to_string().contains("is on no device"), "{refused}");
}
