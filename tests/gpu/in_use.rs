//! What lists are told to hold is what they hold: scenes of which it is known, and what the device counts beside.

use crate::common::{scenes, shared, with_limits};
use glam::DVec3;
use surfel::{
    graph::execute::{FrameProfile, Profile},
    hard_scenes::{Hard, sphere},
    instruments::{ListOccupancy, TileOccupancy},
    renderer::{Headless, Wanted},
    scene::{Colors, Cull, Filter, Object, Rasterizer, Scene, Settings, TileInvocations, TileMemory},
};

fn hard(objects: Vec<Object>, eye: [f64; 3], settings: Settings) -> Hard {
    let scene = Scene { objects, ..Scene::default() };
    Hard { name: "", scene, camera: scenes::builder::camera(eye, [0.0; 3]), settings }
}

fn by_tiles(size_px: [u32; 2]) -> Settings {
    Settings { size_px, rasterizer: Rasterizer::Compute, ..Settings::default() }
}

fn in_use(headless: &mut Headless, hard: &Hard) -> ListOccupancy {
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    headless.list_occupancy(&prepared, &hard.camera, &hard.settings).unwrap()
}

fn counted(headless: &mut Headless, hard: &Hard) -> FrameProfile {
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    let wanted = Wanted { profile: Some(Profile::Counts), ..Wanted::default() };
    headless.render(&prepared, &hard.camera, &hard.settings, wanted).unwrap().profile.unwrap()
}

/// Two ellipses in one place, whose box has 4x4 tiles and which do not reach into those in its corners, a smaller one inside of one
/// tile, one between the pixels' centers, and one beside the image.
#[test]
fn lists_of_a_few_splats_hold_what_they_must() {
    let mut headless = shared();
    let unit = |eye_z: f64, camera: &surfel::Camera| 2.0 * eye_z * (0.5 * camera.fov_y_rad).tan() / 128.0;
    for (half_axes_px, tile_invocations, tile_px) in [
        ([11.5, 11.5], TileInvocations::Column, 64),
        ([11.5, 11.5], TileInvocations::Pixel, 64),
        ([11.5, 5.5], TileInvocations::ShortColumn, 32),
    ] {
        let mut hard = hard(Vec::new(), [0.0, 0.0, 5.0], by_tiles([128, 128]));
        let unit = unit(5.0, &hard.camera);
        let mut builder = scenes::builder::Builder::default();
        let mut ellipse = |at_px: [f64; 2], half_axes_px: [f64; 2]| {
            let [s, t] = [DVec3::X * half_axes_px[0] * unit, DVec3::Y * half_axes_px[1] * unit];
            let at = DVec3::new(at_px[0], at_px[1], 0.0) * unit;
            builder.ellipse(at, s, t, [0.5, 0.5, 0.5, 1.0]);
        };
        ellipse([0.0, 0.0], half_axes_px);
        ellipse([0.0, 0.0], half_axes_px);
        ellipse([42.0, 42.0], [1.5, 1.5]);
        ellipse([20.0, 20.0], [0.2, 0.2]);
        ellipse([100.0, 0.0], [5.0, 5.0]);
        hard.scene.objects = vec![builder.object(false)];
        hard.settings = Settings { filter: Filter::None, tile_invocations, ..hard.settings };
        let ListOccupancy { bytes, tiles } = in_use(&mut headless, &hard);
        let tiles_of_ellipse = 4 * 4 - 4;
        let expected = TileOccupancy {
            kind: String::new(),
            records: 3,
            entries: 2 * tiles_of_ellipse + 1,
            tiles: tiles_of_ellipse + 1,
            overflow: 0,
            pixels: (tiles_of_ellipse + 1) * tile_px,
            splat_pixels: (2 * tiles_of_ellipse + 1) * tile_px,
        };
        assert_eq!(tiles, [expected], "{tile_invocations:?}");
        // Four rows of tiles, which invocations may have cut, and one tile; of the list, the four in view are set up, if no more.
        let of = |name: &str| bytes[name];
        assert!((8 * 5..=8 * 13).contains(&of("runs of tiles")), "{}", of("runs of tiles"));
        assert_eq!(of("seen of tiles"), 4 * 13);
        assert_eq!((of("entries of tiles"), of("first quarter of records of tiles")), (4 * 25, 16 * 3));
        assert!((4 * 4..=4 * 5).contains(&of("rects of tiles")), "{}", of("rects of tiles"));
        assert_eq!(bytes.get("list of visible splats"), Some(&of("rects of tiles")));
        assert_eq!(of("overflow of tiles"), 0);
    }
}

/// More in one tile than a dispatch takes; chunks; and no list of those that may be seen.
#[test]
fn lists_of_overflow_tiles_of_chunks_and_of_all_splats_are_told() {
    let mut headless = shared();
    // A pixel of 24 along a side is 31 units wide: the ball is in the middle of one tile.
    let mut ball = sphere(260_000, DVec3::new(-8.0 * 31.0, 8.0 * 31.0, 0.0));
    ball.closed = false;
    let settings = Settings { tile_invocations: TileInvocations::Column, ..by_tiles([24, 24]) };
    let one_tile = hard(vec![ball], [0.0, 0.0, 900.0], settings);
    let told = in_use(&mut headless, &one_tile).tiles.remove(0);
    assert_eq!((told.tiles, told.overflow, told.entries), (1, 1, told.records));
    assert!(told.records > 200_000, "{}", told.records);

    let mut ball = hard(vec![sphere(10_000, DVec3::ZERO)], [0.0, 0.0, 3.2], by_tiles([131, 203]));
    let whole = in_use(&mut headless, &ball);
    let in_chunks = with_limits(
        &mut headless,
        |limits| limits.max_storage_buffer_range = 200_000,
        |headless| in_use(headless, &ball),
    );
    // Splats are set up the same way in either; where they are of several chunks, each chunk has arguments of its own.
    assert_eq!(in_chunks.tiles, whole.tiles);
    ball.settings.cull = Cull::Setup;
    let of_all = in_use(&mut headless, &ball);
    assert_eq!(of_all.tiles, whole.tiles);
    assert_eq!(of_all.bytes["rects of tiles"], 4 * 10_000);
    assert!(whole.bytes["rects of tiles"] < 4 * 6_000, "{}", whole.bytes["rects of tiles"]);
}

/// Of objects of which one is out of view: a host asks until the device has counted, and hears what the lists of a frame hold.
#[test]
fn splats_are_counted_while_a_host_goes_on() {
    let mut headless = shared();
    let balls = [0.0, 0.5, 900.0].map(|x| sphere(10_000, DVec3::new(x, 0.0, 0.0)));
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
        let settings = Settings { rasterizer, cull: Cull::List, ..by_tiles([131, 203]) };
        let balls = hard(balls.to_vec(), [0.0, 0.0, 3.2], settings);
        let held = in_use(&mut headless, &balls).bytes["list of visible splats"] / 4;
        let prepared = headless.prepare(&balls.scene, &|_, _| {}).unwrap();
        let counting = headless.begin_count(&prepared, &balls.camera, &balls.settings).unwrap();
        let mut answers = std::iter::repeat_with(|| counting.listed(headless.queue()).unwrap());
        assert_eq!(answers.find_map(|count| count), Some(held), "{rasterizer:?}");
        assert!((5_000..20_000).contains(&held), "{rasterizer:?}: {held}");
        assert_eq!(
            headless.count_listed(&prepared, &balls.camera, &balls.settings).unwrap(),
            held,
            "{rasterizer:?}"
        );
    }
}

/// A tile's list has the same splats however the image is cut; those at the borders of bands are set up for both.
#[test]
fn lists_of_bands_hold_together_what_one_of_all_does() {
    let mut headless = shared();
    for transparent in [false, true] {
        let mut ball = sphere(100_000, DVec3::ZERO);
        ball.splats.colors = Colors::Uniform([0.5, 0.5, 0.5, if transparent { 0.5 } else { 1.0 }]);
        let mut hard = hard(vec![ball], [0.3, 0.2, 3.2], by_tiles([131, 203]));
        let part = if transparent { "transparent " } else { "" };
        let mut lists = |tile_memory| {
            hard.settings.tile_memory = tile_memory;
            in_use(&mut headless, &hard).tiles
        };
        let all = lists(TileMemory::Most(u64::MAX));
        let bands = lists(TileMemory::Most(0));
        let [whole] = all.as_slice() else { panic!("one list") };
        assert_eq!(whole.kind, part);
        assert!(bands.len() > 1, "{}", bands.len());
        for (number, band) in (1..).zip(&bands) {
            assert_eq!(band.kind, format!("{part}band-{number} "));
        }
        let sum = |of: fn(&TileOccupancy) -> u64| bands.iter().map(of).sum::<u64>();
        assert_eq!([sum(|t| t.entries), sum(|t| t.tiles)], [whole.entries, whole.tiles]);
        assert_eq!(sum(|t| t.splat_pixels), whole.splat_pixels);
        assert!(sum(|t| t.records) > whole.records, "{} {}", sum(|t| t.records), whole.records);
    }
}

/// Buffers are known by their names alone: one that is called something else would count as if it were full.
#[test]
fn what_is_told_is_told_of_buffers_that_the_frame_has() {
    let mut headless = shared();
    let ball = |alpha: f32| {
        let mut ball = sphere(10_000, DVec3::ZERO);
        ball.splats.colors = Colors::Uniform([0.5, 0.5, 0.5, alpha]);
        ball
    };
    let points = Settings { rasterizer: Rasterizer::Perspective, ..by_tiles([131, 203]) };
    let in_bands = Settings { tile_memory: TileMemory::Most(0), ..by_tiles([131, 203]) };
    for (object, eye_z, settings, unknown) in [
        (ball(1.0), 3.2, by_tiles([131, 203]), &[][..]),
        (ball(0.5), 3.2, by_tiles([131, 203]), &[]),
        (ball(1.0), 3.2, in_bands, &[]),
        (ball(1.0), 3.2, Settings { cull: Cull::List, ..points.clone() }, &[]),
        (ball(1.0), 3.2, Settings { cull: Cull::Hidden, ..points.clone() }, &["list of unhidden splats"]),
        (ball(1.0), 1.001, Settings { cull: Cull::Setup, ..points }, &["large list of chunk 0"]),
    ] {
        let hard = hard(vec![object], [0.0, 0.0, eye_z], settings);
        let bytes = in_use(&mut headless, &hard).bytes;
        let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
        let plan = headless.render(&prepared, &hard.camera, &hard.settings, Wanted::default()).unwrap().plan;
        let rooms: Vec<&str> = plan.resources.iter().map(|resource| resource.name.as_str()).collect();
        assert!(
            !bytes.is_empty() && bytes.keys().all(|name| rooms.contains(&name.as_str())),
            "{bytes:?} {rooms:?}"
        );
        // And all lists are.
        for name in rooms.iter().filter(|name| name.contains("list of") || name.contains(" of records of")) {
            assert_eq!(bytes.get(*name) == Some(&0), unknown.contains(name), "{name}: {bytes:?}");
        }
    }
}

#[test]
fn the_device_counts_no_less_than_lists_are_told_to_hold() {
    let mut headless = shared();
    if !headless.device().facts().pipeline_statistics {
        println!("NOT TESTED: the device has no pipeline statistics");
        return;
    }
    let counts_of = |profile: &FrameProfile, name: &str| {
        profile.passes.iter().find(|pass| pass.name == name).unwrap().clone()
    };
    // Tiles at the right and lower borders reach beyond the image, which a ball fills that is near.
    let near = hard(vec![sphere(10_000, DVec3::ZERO)], [0.0, 0.0, 1.2], by_tiles([131, 203]));
    assert_eq!(in_use(&mut headless, &near).tiles[0].pixels, 131 * 203);
    // And of one that does not, no more than are there.
    let mut hard = hard(vec![sphere(10_000, DVec3::ZERO)], [0.0, 0.0, 2.2], by_tiles([131, 203]));
    let tiles = in_use(&mut headless, &hard).tiles.remove(0);
    let profile = counted(&mut headless, &hard);
    // The finalizing quads are as large as the runs of tiles, and are cut at the borders.
    let covered = counts_of(&profile, "finalize").counts.unwrap().fragments;
    println!("{tiles:?}; {covered} fragments");
    assert!(tiles.pixels <= covered && tiles.pixels > covered / 2, "{} {covered}", tiles.pixels);
    let set_up = counts_of(&profile, "project splats").invocations.unwrap();
    assert!(tiles.records <= set_up && tiles.records > set_up / 2, "{} {set_up}", tiles.records);

    // As points, of a list.
    hard.settings = Settings { rasterizer: Rasterizer::Perspective, cull: Cull::List, ..hard.settings };
    let ListOccupancy { bytes, tiles } = in_use(&mut headless, &hard);
    let profile = counted(&mut headless, &hard);
    let vertices = counts_of(&profile, "visibility").counts.unwrap().vertices;
    assert_eq!((bytes["list of visible splats"], tiles.len()), (4 * vertices, 0));

    // Without lists nothing is told.
    hard.settings.cull = Cull::Setup;
    assert_eq!(in_use(&mut headless, &hard), ListOccupancy::default());
}
