//! A mesh in levels of detail: cells that are polygons near the eye and splats far from it, as the device chooses them.

use crate::{
    common::{PICTURE, builder, moves_corners, passes, render_as, scenes::Hard, shared, with},
    levels::{ball, pixels_apart, rms},
};
use glam::DVec3;
use surfel::{
    geometry::{HybridOptions, Multiresolution, multiresolution},
    load::builtin::sphere_mesh,
    math::random::SplitMix,
    reference::{HybridChoice, hybrid_choice, render},
    renderer::Headless,
    scene::{
        Backfaces, Camera, Colors, Edges, ErrorBall, HybridLevels, LeveledObject, Lod, Mesh, MeshObject,
        NodeBalls, Object, Rasterizer, Scene, Settings, Shading,
    },
    selftest::{
        light::{LightErrors, compare_light},
        tolerance,
    },
};

/// A ball with waves, which hides parts of itself, in colors.
pub fn waves(triangles: u64, samples: u64) -> Multiresolution {
    let mut mesh = sphere_mesh(triangles);
    let mut colors = Vec::new();
    for position in &mut mesh.positions {
        let [x, y, z] = position.to_array();
        let height = (7.0 * x).sin() * (9.0 * y + 1.0).sin() * (8.0 * z).cos();
        colors.push([0.5 + 0.4 * x as f32, 0.5 + 0.4 * height as f32, 0.4, 1.0]);
        *position *= 1.0 + 0.15 * height;
    }
    (mesh.normals, mesh.colors) = (None, Colors::Each(colors));
    let options = HybridOptions { samples, seed: 7, sample_edges: true };
    multiresolution(mesh, "waves".to_owned(), &options, &()).unwrap()
}

fn object(made: &Multiresolution, mesh: Mesh) -> MeshObject {
    MeshObject { name: "waves".to_owned(), mesh, closed: made.closed }
}

/// The mesh with its levels.
pub fn hard(made: &Multiresolution, tau_px: f64) -> Hard {
    let mut hard = ball(1, tau_px);
    hard.scene = Scene {
        meshes: vec![object(made, made.mesh.clone())],
        hybrids: vec![made.levels.clone()],
        ..Scene::default()
    };
    hard.settings.lod = Lod::Px(tau_px);
    hard
}

pub fn direction(random: &mut SplitMix) -> DVec3 {
    DVec3::new(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5).normalize()
}

/// From anywhere, near enough for polygons and far enough for splats at once.
fn camera(random: &mut SplitMix, round: usize) -> Camera {
    let direction = direction(random);
    let eye = (1.5 + 2.5 * random.unit()) * direction;
    Camera {
        eye,
        orthographic_height: (round % 4 == 3).then_some(2.5),
        ..builder::camera([0.0, 0.0, 3.0], [0.0; 3])
    }
}

/// A size for which some cells are polygons and some splats; under parallel rays all are of one size.
fn tau_px(made: &Multiresolution, camera: &Camera, size_px: [u32; 2]) -> f64 {
    let spread = f64::from(made.levels.splats.balls[made.levels.cells[0].ball as usize].spread);
    let distance = if camera.is_orthographic() { 1.2 } else { (camera.eye.length() - 0.4).max(0.3) };
    camera.focal_px(size_px[1]) * spread / distance
}

/// What was chosen, each thing drawn as it is.
fn as_chosen(made: &Multiresolution, choice: &HybridChoice) -> Scene {
    let HybridLevels { splats, cells, .. } = &made.levels;
    let triangles = choice.cells.iter().flat_map(|cell| cells[*cell as usize].triangles.clone());
    let mesh = Mesh {
        triangles: triangles.map(|triangle| made.mesh.triangles[triangle as usize]).collect(),
        ..made.mesh.clone()
    };
    let leaves = choice.leaves.iter().map(|leaf| *leaf as usize);
    let nodes = choice.nodes.iter().map(|node| *node as usize);
    let leveled = LeveledObject {
        balls: vec![ErrorBall::LEAF, ErrorBall::ABOVE_ROOT],
        leaves: splats.leaves.picked(leaves.clone()),
        leaf_parents: vec![1; leaves.len()],
        inverse_overlaps: splats.inverse_overlaps.as_ref().map(|all| leaves.map(|leaf| all[leaf]).collect()),
        nodes: splats.nodes.picked(nodes.clone()),
        node_balls: vec![NodeBalls { own: 0, parent: 1 }; nodes.len()],
        weights: nodes.map(|node| splats.weights[node]).collect(),
        ..splats.clone()
    };
    let meshes = if mesh.triangles.is_empty() { Vec::new() } else { vec![object(made, mesh)] };
    Scene { meshes, leveled: vec![leveled], ..Scene::default() }
}

/// So many splats were listed to be set up.
fn listed(headless: &mut Headless, hard: &Hard) -> u64 {
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    let in_use = headless.list_occupancy(&prepared, &hard.camera, &hard.settings).unwrap();
    in_use.bytes["list of visible splats"] / 4
}

/// The same splats, polygons where the oracle has them, and so the same picture: by tiles that shade, by tiles that leave sums, by points.
#[test]
fn what_is_drawn_is_what_the_oracle_chooses() {
    let mut headless = shared();
    let mut made = waves(20_000, 10_000);
    // One overlap for all, as beside the polygons of the scene that it is compared with.
    made.levels.splats.inverse_overlaps =
        Some(vec![made.levels.splats.overlap.recip() as f32; made.levels.splats.leaves.len()]);
    let mut random = SplitMix(3);
    let (mut both, mut exact) = (0, 0);
    for round in 0..12 {
        let mut hard = with(&hard(&made, 1.0), |settings| settings.backfaces = Backfaces::Flip);
        hard.camera = camera(&mut random, round);
        // Twice without any polygon.
        let unit = tau_px(&made, &hard.camera, hard.settings.size_px);
        let tau_px = if round % 6 == 0 { 12.0 * unit } else { unit };
        hard.settings.lod = Lod::Px(tau_px);
        let chosen = |room: f64| {
            hybrid_choice(&made.levels, (&hard.camera, hard.settings.size_px), tau_px * (1.0 + room))
        };
        let choice = chosen(0.0);
        if hard.camera.is_orthographic() || chosen(-1e-5) != choice || chosen(1e-5) != choice {
            continue;
        }
        match round % 3 {
            0 => {}
            1 => (hard.settings.edges, hard.settings.rasterizer) = (Edges::Hard, Rasterizer::Compute),
            _ => (hard.settings.edges, hard.settings.rasterizer) = (Edges::Hard, Rasterizer::Perspective),
        }
        if choice.cells.is_empty() {
            // The scene that it is compared with has no polygons, and so an overlap for each splat.
            hard.settings.edges = Edges::Hard;
        }
        let truth =
            render_as(&mut headless, &Hard { scene: as_chosen(&made, &choice), ..hard.clone() }, PICTURE);
        let found = render_as(&mut headless, &hard, PICTURE);
        let error = rms(&truth, &found);
        let of_splats = choice.leaves.len() + choice.nodes.len();
        println!(
            "round {round}: {} cells, {of_splats} splats; {error} apart; {:?}",
            choice.cells.len(),
            passes(&found)
        );
        assert!(passes(&found).contains(&"choose polygons") || choice.cells.is_empty());
        // Sums in another order, of chunks with other origins: in single pixels that turns what is within ε.
        let apart = pixels_apart(&truth, &found);
        assert!(apart <= 16 && error < 1e-3, "round {round}: {apart} pixels, {error}");
        exact += usize::from(error < 2e-6);
        let cells = made.levels.cells.len();
        both += usize::from(of_splats > 500 && (cells / 10..cells * 9 / 10).contains(&choice.cells.len()));
    }
    assert!(both >= 3 && exact >= 6, "{both} views with polygons and splats, {exact} to the last bits");
}

/// Without nodes above, which weigh as they do: the picture is the oracle's of the splats and polygons that it chooses.
#[test]
fn the_picture_is_the_oracles() {
    let mut headless = shared();
    let mut made = waves(12_000, 6000);
    let levels = &mut made.levels.splats;
    levels.leaf_parents.fill(levels.balls.len() as u32 - 1);
    levels.nodes = levels.nodes.picked(std::iter::empty());
    levels.node_balls.clear();
    levels.weights.clear();
    let mut random = SplitMix(8);
    let mut both = 0;
    for round in 0..4 {
        let mut hard = with(&hard(&made, 1.0), |settings| {
            (settings.edges, settings.shading) = (Edges::Hard, Shading::Lambert);
        });
        hard.name = "a hybrid in levels";
        hard.camera = camera(&mut random, 0);
        let tau_px = tau_px(&made, &hard.camera, hard.settings.size_px);
        hard.settings.lod = Lod::Px(tau_px);
        let choice = hybrid_choice(&made.levels, (&hard.camera, hard.settings.size_px), tau_px);
        let Scene { meshes, leveled, .. } = as_chosen(&made, &choice);
        let splats = leveled.into_iter().map(|object| Object {
            name: object.name,
            splats: object.leaves,
            closed: object.closed,
        });
        let chosen = Scene { meshes, objects: splats.collect(), ..Scene::default() };
        let oracle = render(&chosen, &hard.camera, &hard.settings, &|_, _| {}).unwrap();
        let errors = compare_light(&render_as(&mut headless, &hard, PICTURE), &oracle);
        println!("round {round}: {} cells, {} splats: {errors:?}", choice.cells.len(), choice.leaves.len());
        // Corners are snapped to 1/256 pixel, between which colors are found; some devices cut what others round.
        let steps = if moves_corners(headless.device()) { 4.0 } else { 2.0 };
        let allowed = LightErrors { worst: steps * tolerance::LIGHT, ..tolerance::of_light(&hard) };
        let beyond = errors.beyond(&allowed);
        assert!(beyond.is_empty(), "round {round}: {beyond:?}");
        both += usize::from(!choice.cells.is_empty() && !choice.leaves.is_empty());
    }
    assert!(both >= 3, "{both} views with polygons and splats");
}

/// As many splats as are chosen: those on edges once, whatever their cells are.
#[test]
fn as_many_splats_are_drawn_as_are_chosen() {
    let mut headless = shared();
    let made = waves(20_000, 10_000);
    let mut random = SplitMix(9);
    for round in 0..16 {
        let mut hard = with(&hard(&made, 1.0), |settings| settings.backfaces = Backfaces::Flip);
        // From far enough that nothing is outside of the view.
        hard.camera = Camera { eye: camera(&mut random, 0).eye.normalize() * 3.6, ..camera(&mut random, 0) };
        let tau_px = tau_px(&made, &hard.camera, hard.settings.size_px) * (0.9 + 0.2 * random.unit());
        hard.settings.lod = Lod::Px(tau_px);
        let count = |tau_px: f64| {
            let choice = hybrid_choice(&made.levels, (&hard.camera, hard.settings.size_px), tau_px);
            (choice.leaves.len() + choice.nodes.len()) as u64
        };
        let near = [1.0 - 1e-5, 1.0, 1.0 + 1e-5].map(|part| count(part * tau_px));
        let found = listed(&mut headless, &hard);
        println!("round {round}: {found} listed, {near:?} chosen");
        assert!((near.iter().min().unwrap()..=near.iter().max().unwrap()).contains(&&found), "round {round}");
    }
}

/// Frames without levels draw the polygons, and so does --lod 0; the pass is not there.
#[test]
fn without_levels_the_mesh_is_drawn() {
    let mut headless = shared();
    let made = waves(5000, 2500);
    let mesh = Scene { meshes: vec![object(&made, made.mesh.clone())], ..Scene::default() };
    let changes: [fn(&mut Settings); 2] =
        [|settings| settings.lod = Lod::Px(0.0), |settings| settings.rasterizer = Rasterizer::Quad];
    for change in changes {
        let own = with(&hard(&made, 2.0), change);
        let truth = render_as(&mut headless, &Hard { scene: mesh.clone(), ..own.clone() }, PICTURE);
        let found = render_as(&mut headless, &own, PICTURE);
        assert!(!passes(&found).contains(&"choose polygons"), "{:?}", passes(&found));
        assert_eq!(rms(&truth, &found), 0.0);
    }
}

/// From everywhere, at any zoom and for any size: no pixel that the mesh covers, and its neighbors with it, is not covered.
#[test]
fn no_pixel_of_the_mesh_is_left_uncovered() {
    let mut headless = shared();
    let made = waves(80_000, 40_000);
    let hybrid = hard(&made, 1.0);
    let prepared = headless.prepare(&hybrid.scene, &|_, _| {}).unwrap();
    let mut random = SplitMix(10);
    let (mut inside, mut seen, mut least) = (0_u64, 0, 1.0_f32);
    for round in 0..200 {
        let mut view = camera(&mut random, round);
        view.fov_y_rad /= 1.0 + 3.0 * random.unit();
        let unit = tau_px(&made, &view, hybrid.settings.size_px);
        let tau_px = unit * 2.0_f64.powf(2.0 * random.unit() - 1.0);
        let mut alphas = |lod: f64, edges: Edges| -> Vec<f32> {
            let settings = Settings { lod: Lod::Px(lod), edges, ..hybrid.settings.clone() };
            let frame = headless.render(&prepared, &view, &settings, PICTURE).unwrap();
            frame.linear.iter().map(|pixel| pixel[3]).collect()
        };
        let mesh = alphas(0.0, Edges::Hard);
        let edges = if round % 2 == 0 { Edges::Coverage } else { Edges::Hard };
        let found = alphas(tau_px, edges);
        let width = hybrid.settings.size_px[0] as usize;
        // A node bends less than what it stands for: its outline is as much inside as a splat is large.
        let away = (1.5 + 2.0 * tau_px).ceil() as usize;
        let whole = |x: usize, y: usize| {
            (y - away..=y + away).all(|y| (x - away..=x + away).all(|x| mesh[y * width + x] > 0.5))
        };
        for y in away..hybrid.settings.size_px[1] as usize - away {
            for x in (away..width - away).filter(|x| whole(*x, y)) {
                inside += 1;
                let alpha = found[y * width + x];
                least = least.min(alpha);
                assert!(alpha > 0.5, "round {round}: {alpha} at {x}, {y}, {tau_px} px");
                seen += usize::from(alpha < 0.99);
            }
        }
    }
    println!("{seen} of {inside} pixels inside let more than a hundredth through, the least is {least}");
    assert!(inside > 500_000 && (seen as u64) < inside / 1000, "{seen} of {inside}");
}
