//! How much memory a million splats take on their way from a file to the device: on the host at most 3 times what the
//! splats themselves need ([`Splats::bytes`]), on the device at most 1.5 times that, attachments aside: while they are brought there, and
//! in a frame with all its lists, by whichever rasterizer.
//!
//! The host's memory is what this process has from Rust's allocator; every byte is counted, so that the figures are the
//! same in each run. What the driver takes for itself is not in them. The device's is what its allocator has taken in
//! blocks, uploads under way included.

use std::{
    alloc::{GlobalAlloc, Layout, System},
    cell::Cell,
    path::Path,
    sync::atomic::{AtomicUsize, Ordering},
};

use crate::common::ran_alone;
use glam::Vec3;
use surfel::{
    Headless, HeadlessOptions, Validation,
    frame::{FrameSlot, HeadlessTarget},
    graph::MemoryClass,
    load::{LoadOptions, Model, builtin, load},
    renderer::{SceneFrame, Seen},
    save,
    scene::{Colors, Object, Rasterizer, Scene, Settings, Shapes, Splats},
    vk::CommandPool,
};

/// Counts what is allocated. `realloc` is the trait's own, which holds the old and the new at once: an upper bound.
struct Counting;

thread_local! {
    /// Allocations of this thread.
    pub static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

static LIVE: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

// SAFETY: every call is the system allocator's own.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let live = LIVE.fetch_add(layout.size(), Ordering::Relaxed) + layout.size();
        PEAK.fetch_max(live, Ordering::Relaxed);
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: this function's contract.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        LIVE.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: this function's contract.
        unsafe { System.dealloc(pointer, layout) }
    }
}

/// What this process has from the heap now.
pub fn live_bytes() -> usize {
    LIVE.load(Ordering::Relaxed)
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

const MILLION: usize = 1_000_000;

/// 3 is what is asked for. While a file is read, its bytes and the splats are there together, and a row of a binary file
/// that `save` writes is never larger than a splat (40 bytes of 40 for disks without colors and 64-bit positions): so 2
/// is what must hold, and it tells sooner what has become worse.
const MOST_HOST: f64 = 2.0;

/// As asked for.
const MOST_DEVICE: f64 = 1.5;

/// Beside the splats: a batch on its way (3.7 MB), the renderer's own.
const HOST_EXTRA_BYTES: f64 = 8e6;

/// A file of a million splats: without colors, with a color each, and ellipses.
fn write(path: &Path, colors: bool, ellipses: bool) {
    let Object { mut splats, .. } = builtin::relief(MILLION);
    if !colors {
        splats.colors = Colors::unknown();
    }
    if ellipses && let Shapes::Disks { normals, radii } = &splats.shapes {
        let tangents = normals.iter().zip(radii).map(|(normal, radius)| {
            let s = normal.any_orthonormal_vector();
            (*radius * s, 0.5 * *radius * normal.cross(s))
        });
        let (s, t): (Vec<Vec3>, Vec<Vec3>) = tangents.unzip();
        splats.shapes = Shapes::Ellipses { s, t };
    }
    save::splats(path, &splats, true, None, &()).unwrap();
}

fn read(path: &Path) -> (Splats, bool) {
    match load(path, &LoadOptions::default(), &()).unwrap().model {
        Model::Splats { splats, closed } => (splats, closed),
        _ => panic!("no splats"),
    }
}

#[test]
fn a_million_splats_need_little_more_than_themselves() {
    // Where nothing else is allocated meanwhile.
    if ran_alone("memory::a_million_splats_need_little_more_than_themselves", &[]) {
        return;
    }
    // Without validation, whose layer has an allocator of its own but makes the driver's work slow.
    let options = HeadlessOptions {
        validation: Validation::Off,
        device: std::env::var("SURFEL_TEST_DEVICE").ok(),
        cache_folder: None,
    };
    let folder = temp_dir::TempDir::new().unwrap();
    let path = folder.path().join("million.ply");
    for (what, colors, ellipses) in [
        ("disks", false, false),
        ("open disks", false, false),
        ("colored disks", true, false),
        ("colored ellipses", true, true),
    ] {
        // Its own, for an allocator keeps what others have used.
        let mut headless = Headless::new(&options).expect("tests need a Vulkan device");
        write(&path, colors, ellipses);
        let before = LIVE.load(Ordering::Relaxed);
        PEAK.store(before, Ordering::Relaxed);
        let (mut splats, closed) = read(&path);
        splats.drop_defective();
        assert_eq!((splats.len(), closed), (MILLION, true));
        // Of an open surface nothing is left out.
        let closed = closed && what != "open disks";
        let own_bytes = splats.bytes() as f64;
        let scene =
            Scene { objects: vec![Object { name: what.to_owned(), splats, closed }], ..Scene::default() };
        let ball = scene.ball().unwrap();

        let held = Cell::new(0);
        let look = || held.set(held.get().max(headless.device().memory_held()));
        let prepared = headless.prepare(&scene, &|_, _| look()).unwrap();
        look();
        let device = held.get() as f64;
        drop(scene);
        let mut frames = 0.0_f64;
        for rasterizer in [Rasterizer::Perspective, Rasterizer::Compute] {
            let settings = Settings { rasterizer, ..Settings::default() };
            let camera = surfel::Camera::fit(&ball, settings.size_px, surfel::Camera::DEFAULT_FOV_Y_RAD);
            let wanted = surfel::Wanted { picture: true, ..surfel::Wanted::default() };
            let frame = headless.render(&prepared, &camera, &settings, wanted).unwrap();
            let blocks = frame.plan.blocks.iter();
            let lists = blocks.filter(|block| block.class == MemoryClass::Buffers);
            frames = frames.max(lists.map(|block| block.size_bytes).sum::<u64>() as f64);
        }
        let host = (PEAK.load(Ordering::Relaxed) - before) as f64;

        println!(
            "{what}: {:.1} MB; host {:.1} MB ({:.2} x), device {:.1} MB ({:.2} x, {:.1} MB of it splats), a frame's lists {:.1} MB",
            own_bytes / 1e6,
            host / 1e6,
            host / own_bytes,
            device / 1e6,
            device / own_bytes,
            prepared.bytes() as f64 / 1e6,
            frames / 1e6,
        );
        assert!(host <= MOST_HOST * own_bytes + HOST_EXTRA_BYTES, "{what}: {host} bytes of the host");
        assert!(device <= MOST_DEVICE * own_bytes, "{what}: {device} bytes of the device");
        assert!(prepared.bytes() as f64 <= device, "{what}: splats in no memory");
        // What is held after preparation is there in every frame; by tiles, which CPU drivers have by default, lists are, too.
        let in_frames = prepared.bytes() as f64 + frames;
        assert!(frames > 1e6 && in_frames <= MOST_DEVICE * own_bytes, "{what}: {in_frames} bytes in a frame");
        drop(prepared);
        // SAFETY: nothing is being recorded.
        unsafe { headless.queue().wait_idle() }.unwrap();
    }
}

/// So many small balls, and a camera that sees all of them or is among them.
fn balls(count: usize, is_inside: bool) -> (Scene, surfel::Camera) {
    let side = (count as f64).cbrt().ceil() as usize;
    let ball = |i: usize| {
        let place = glam::DVec3::new((i % side) as f64, (i / side % side) as f64, (i / side / side) as f64);
        let Object { mut splats, closed, .. } = builtin::sphere(100);
        splats.positions.iter_mut().for_each(|position| *position += 2.5 * place);
        Object { name: format!("ball {i}"), splats, closed }
    };
    let scene = Scene { objects: (0..count).map(ball).collect(), ..Scene::default() };
    let all = scene.ball().unwrap();
    let mut camera = surfel::Camera::fit(&all, SMALL_PX, surfel::Camera::DEFAULT_FOV_Y_RAD);
    if is_inside {
        camera.eye = all.center + glam::DVec3::new(0.1, 1.25, 1.25);
    }
    (scene, camera)
}

const SMALL_PX: [u32; 2] = [64, 48];
const FORMAT: ash::vk::Format = ash::vk::Format::R8G8B8A8_SRGB;

/// Allocations of a frame that is like the one before, and of one that is not, of so many balls: recorded, and never submitted.
fn allocations(count: usize, rasterizer: Rasterizer, is_inside: bool) -> [usize; 2] {
    let options = HeadlessOptions {
        validation: Validation::Off,
        device: std::env::var("SURFEL_TEST_DEVICE").ok(),
        cache_folder: None,
    };
    let headless = Headless::new(&options).expect("tests need a Vulkan device");
    let (scene, camera) = balls(count, is_inside);
    let prepared = headless.prepare(&scene, &|_, _| {}).unwrap();
    let (device, renderer) = (headless.device(), &headless.renderer);
    let (pool, mut slot) = (CommandPool::new(device, "recorded").unwrap(), FrameSlot::new(device));
    let targets = [SMALL_PX, [SMALL_PX[1], SMALL_PX[0]], [56, 52]];
    let targets = targets.map(|size_px| HeadlessTarget::new(device, FORMAT, size_px).unwrap());
    // The second and the third have one target, the fourth one that no frame had; all have their pipelines by then.
    let frames = [&targets[1], &targets[0], &targets[0], &targets[2]].map(|target| {
        let target = target.target();
        let size_px = [target.extent.width, target.extent.height];
        let settings = Settings { rasterizer, size_px, ..Settings::default() };
        let before = ALLOCATIONS.get();
        // SAFETY: nothing that was recorded is submitted; all is alive as long as that.
        unsafe {
            let shown =
                SceneFrame::new(Seen { scene: &prepared, camera: &camera, settings: &settings }, &target);
            renderer.record(pool.begin().unwrap(), &mut slot, &shown).unwrap();
        }
        pool.end().unwrap();
        ALLOCATIONS.get() - before
    });
    [frames[2], frames[3]]
}

/// What recording takes is in proportion to the objects: at 64 of them a pass over their pairs would be seen, and at 512 be all there is.
#[test]
fn recording_takes_no_more_for_an_object_where_there_are_many() {
    for (rasterizer, is_inside) in [(Rasterizer::Compute, false), (Rasterizer::Perspective, true)] {
        let [few, many] = [64, 512].map(|count| allocations(count, rasterizer, is_inside));
        println!(
            "{rasterizer:?}: {few:?} allocations of a frame of 64 objects, {many:?} of 512; again, and anew"
        );
        for (few, many) in few.into_iter().zip(many) {
            assert!(many <= 9 * few, "{rasterizer:?}: {few}, {many}");
        }
        assert!(few[0] < few[1] && many[0] <= 40 * 512, "{rasterizer:?}: {few:?}, {many:?}");
    }
}
