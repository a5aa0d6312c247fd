//! Pipelines ahead: in the background or on the spot; a frame that needs others is refused where that is wanted.

use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    ErrorKind, Scene, Settings,
    embed::{HostCamera, MissingPipelines, Placed, Renderer, Rendering, View, ViewFrame},
    scene::{Budget, Colors, Cull, Edges, Filter, Layers, Mesh, MeshObject, Rasterizer, TileMemory},
    vk::Limits,
};

use super::{Beside, COLOR_FORMAT, OBJECT_FORMATS, REVERSED, SIZE_PX, engine::Style};
use crate::{
    common::{faults, scenes},
    hybrid_levels::{hard as hard_cells, waves},
};

#[test]
fn a_frame_whose_pipelines_were_made_ahead_makes_none_and_one_without_is_refused() {
    ahead(Beside::on_faulty(REVERSED), false);
}

#[test]
fn pipelines_are_made_on_a_thread_of_their_own() {
    ahead(Beside::new(REVERSED), true);
}

/// `in_background`: on another thread, where calls are not counted.
fn ahead(mut beside: Beside, in_background: bool) {
    for (rasterizer, alpha) in
        [(Rasterizer::Compute, 1.0), (Rasterizer::Perspective, 1.0), (Rasterizer::Compute, 0.5)]
    {
        let mut ball = scenes::sphere(3000, DVec3::ZERO);
        ball.splats.colors = Colors::Uniform([0.5, 0.6, 0.7, alpha]);
        let ball = beside.upload(&Scene { objects: vec![ball], ..Scene::default() });
        let placed = [Placed::at_home(&ball)];
        let camera = HostCamera {
            view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y),
            clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
            flips_y: true,
        };
        let settings = Settings { size_px: SIZE_PX, rasterizer, ..Settings::default() };
        let frame = ViewFrame {
            hides: Some(beside.hides()),
            missing: MissingPipelines::Refuse,
            ..ViewFrame::new(&placed, &camera, &settings)
        };
        let made = |beside: &Beside| beside.renderer.pipelines_made();
        let before = made(&beside);
        let Beside { view, renderer, engine, .. } = &mut beside;
        engine.begin();
        engine.begin_rendering(true);
        engine.end_rendering();
        // SAFETY: recording; refused.
        let refused = unsafe { view.prepare(renderer, engine.commands, &frame) }.unwrap_err();
        assert!(matches!(refused.kind(), ErrorKind::NotReady { .. }), "{refused}");
        // SAFETY: nothing is prepared.
        assert!(unsafe { view.draw(renderer, engine.commands) }.is_err());
        assert_eq!(renderer.pipelines_made(), before);
        let rendering = Rendering { color_formats: vec![COLOR_FORMAT], ..Rendering::default() };
        let compile = || renderer.compile_ahead(&rendering, &frame).unwrap();
        let missing = match in_background {
            false => compile(),
            true => std::thread::scope(|scope| scope.spawn(compile).join().unwrap()),
        };
        assert!(missing > 0 && renderer.pipelines_made() == before + missing, "{missing}");
        faults::take_made();
        // SAFETY: recording; all is alive until the wait.
        unsafe { view.prepare(renderer, engine.commands, &frame) }.unwrap();
        let made_then = faults::take_made();
        assert!(!made_then.iter().any(|call| call.ends_with("_pipelines")), "{made_then:?}");
        assert!(in_background || made_then.contains(&"create_image"), "{made_then:?}");
        assert_eq!(renderer.pipelines_made(), before + missing);
        engine.begin_rendering(false);
        // SAFETY: inside of the rendering that the view was made for.
        unsafe { view.draw(renderer, engine.commands) }.unwrap();
        engine.end_rendering();
        beside.submit();
        assert_eq!(beside.renderer.compile_ahead(&rendering, &frame).unwrap(), 0);
        drop(ball);
    }
    beside.end();
}

/// What flies, and by what settings.
pub(super) struct Flight {
    pub name: &'static str,
    pub scene: Scene,
    pub settings: Settings,
}

pub(super) fn of_splats(count: usize, closed: bool, alpha: f32) -> Scene {
    let mut ball = scenes::sphere(count, DVec3::ZERO);
    ball.splats.colors = Colors::Uniform([0.5, 0.6, 0.7, alpha]);
    ball.closed = closed;
    Scene { objects: vec![ball], ..Scene::default() }
}

/// Larger than the ball, and through it.
fn triangle() -> MeshObject {
    let positions = vec![DVec3::new(-3.0, -2.0, 0.1), DVec3::new(3.0, -2.0, 0.0), DVec3::new(0.0, 3.0, 0.0)];
    let colors = Colors::Uniform([0.9, 0.2, 0.1, 1.0]);
    let mesh = Mesh { positions, normals: None, colors, triangles: vec![[0, 1, 2]] };
    MeshObject { name: "triangle".to_owned(), mesh, closed: false }
}

/// Of a device on which lists have room for some of its splats alone.
pub(super) const WITHOUT_ROOM: &str = "levels without room";

pub(super) fn flights() -> Vec<Flight> {
    let by = |rasterizer| Settings { size_px: SIZE_PX, rasterizer, ..Settings::default() };
    let flight = |name, scene, settings| Flight { name, scene, settings };
    let (tiles, points) = (Rasterizer::Compute, Rasterizer::Perspective);
    let layers = |settings, layers| Settings { layers: Layers::Fixed(layers), ..settings };
    let hard = |settings| Settings { edges: Edges::Hard, ..settings };
    let unfiltered = |settings| Settings { filter: Filter::None, ..settings };
    let with_levels = |budget| Scene { levels: true, budget, ..of_splats(20_000, true, 1.0) };
    // From afar all of its cells are splats, and no polygon is drawn; near by some are polygons.
    let cells = || hard_cells(&waves(2500, 2500), 1.0).scene;
    let polygons = || Scene { meshes: vec![triangle()], ..of_splats(3000, true, 1.0) };
    vec![
        flight("closed, by tiles", of_splats(3000, true, 1.0), by(tiles)),
        flight("open, by tiles", of_splats(3000, false, 1.0), by(tiles)),
        // In smaller pictures they are not few.
        flight("few, as is fast", of_splats(15, true, 1.0), hard(by(Rasterizer::Auto))),
        // Places of tiles take a bit more than in smaller ones.
        flight(
            "a long picture",
            of_splats(3000, true, 1.0),
            Settings { size_px: [2100, 60], ..hard(by(tiles)) },
        ),
        flight("points", of_splats(3000, true, 1.0), by(points)),
        flight(
            "points that are listed",
            of_splats(3000, true, 1.0),
            Settings { cull: Cull::Hidden, ..by(points) },
        ),
        flight(
            "points of which some may lie outside",
            of_splats(3000, false, 1.0),
            Settings { filter: Filter::Max, ..hard(by(Rasterizer::Auto)) },
        ),
        flight("quads", of_splats(3000, false, 1.0), by(Rasterizer::Quad)),
        flight("triangles", of_splats(3000, true, 1.0), by(Rasterizer::Triangle)),
        flight(
            "triangles without a filter",
            of_splats(3000, true, 1.0),
            unfiltered(by(Rasterizer::Triangle)),
        ),
        flight("layers, by tiles", of_splats(20_000, true, 0.5), layers(by(tiles), 16)),
        flight("layers, as points", of_splats(3000, false, 0.5), layers(by(points), 2)),
        flight("polygons", polygons(), by(tiles)),
        flight("polygons and points", polygons(), by(points)),
        flight(
            "in bands",
            of_splats(300_000, true, 1.0),
            Settings { tile_memory: TileMemory::Most(20_000_000), ..hard(by(tiles)) },
        ),
        flight("cells", cells(), by(tiles)),
        flight("cells and points", cells(), by(points)),
        flight("levels", with_levels(false), by(tiles)),
        flight(WITHOUT_ROOM, with_levels(false), by(tiles)),
        flight("levels, as points", with_levels(false), by(points)),
        flight("a budget", with_levels(true), Settings { budget: Budget::Splats(15_000), ..by(tiles) }),
    ]
}

/// Where a camera is on its way: from where all is less than a pixel to the middle, with stops around the surface, which has a radius of 1.
pub(super) fn on_the_way([width, height]: [u32; 2]) -> impl Iterator<Item = HostCamera> {
    let aspect = f64::from(width) / f64::from(height);
    let far = (0..40).map(|step| 2000.0 * 0.75_f64.powi(step));
    let near = [1.2, 1.1, 1.05, 1.02, 1.01, 1.003, 1.001, 1.0, 0.999, 0.99, 0.95, 0.9, 0.7, 0.3];
    far.chain(near).flat_map(move |distance| {
        let eye = distance * DVec3::new(0.28, 0.6, 0.75).normalize();
        [DVec3::ZERO, 2.0 * eye, eye + DVec3::new(1.0, -0.4, 0.0)].map(move |target| HostCamera {
            view_from_world: look_at_mat4(eye, target, DVec3::new(0.1, 0.2, 1.0)),
            clip_from_view: directx::perspective_infinite_reverse(0.7, aspect, 1e-3),
            flips_y: true,
        })
    })
}

/// After one call a camera comes from afar and goes through the splats, in pictures of several sizes, and no frame wants a pipeline that is not there.
#[test]
fn one_call_makes_all_pipelines_wherever_the_camera_flies() {
    let mut refused = Vec::new();
    for tells_objects in [false, true] {
        let beside = Beside::new(Style { validates: false, tells_objects, ..REVERSED });
        let is_flown = |flight: &Flight| {
            !tells_objects
                || ["closed, by tiles", "points that are listed", "polygons"].contains(&flight.name)
        };
        for Flight { name, scene, settings } in flights().into_iter().filter(is_flown) {
            let scene = beside.upload(&scene);
            let placed = [Placed::at_home(&scene)];
            let mut rendering = Rendering { color_formats: vec![COLOR_FORMAT], ..Rendering::default() };
            if tells_objects {
                rendering.color_formats.extend(OBJECT_FORMATS);
                (rendering.ids, rendering.motion) = (true, true);
            }
            let [width, height] = settings.size_px;
            let hides = Some(beside.hides());
            let first = on_the_way(settings.size_px).nth(20).unwrap();
            let frame = ViewFrame { hides, ..ViewFrame::new(&placed, &first, &settings) };
            let mut renderer = Renderer::new(&beside.device, None).unwrap();
            if name == WITHOUT_ROOM {
                let limits = beside.device.facts().limits;
                renderer.lower_limits(&Limits { max_storage_buffer_range: 1 << 16, ..limits });
            }
            let begin = std::time::Instant::now();
            let made = renderer.compile_ahead(&rendering, &frame).unwrap();
            let secs = begin.elapsed().as_secs_f32();
            let mut view = View::new(&renderer, &rendering).unwrap();
            let (mut not_ready, mut kinds) = (Vec::new(), 0);
            let sizes = [[width, height], [width / 2, height / 2], [width * 3 / 4, height * 3 / 4]];
            let seen = on_the_way(settings.size_px).zip(sizes.into_iter().cycle());
            for (number, (camera, size_px)) in seen.enumerate() {
                let settings = Settings { size_px, ..settings.clone() };
                let frame = ViewFrame {
                    hides,
                    missing: MissingPipelines::Refuse,
                    ..ViewFrame::new(&placed, &camera, &settings)
                };
                beside.engine.begin();
                // SAFETY: recording; never submitted.
                match unsafe { view.prepare(&renderer, beside.engine.commands, &frame) } {
                    Ok(()) => kinds += 1,
                    Err(error) => not_ready.push(format!("{number}: {error}")),
                }
                // SAFETY: nothing was submitted.
                unsafe { beside.device.epoch_done(beside.device.end_epoch()) };
            }
            println!("{name}, objects {tells_objects}: {made} pipelines in {secs:.1} s, {kinds} frames");
            if let Some(first) = not_ready.first() {
                refused.push(format!(
                    "{name}, objects {tells_objects}: {} frames refused, first {first}",
                    not_ready.len()
                ));
            }
            assert_eq!(renderer.compile_ahead(&rendering, &frame).unwrap(), 0, "{name}");
            drop(view);
            drop(scene);
        }
        beside.end();
    }
    assert!(refused.is_empty(), "{refused:#?}");
}
