//! Frames in parts: what devices that have a part of a scene each make together is the picture of the whole.

use glam::DVec3;
use surfel::{
    Error,
    hard_scenes::Hard,
    levels_file::{LevelsFile, PageView, write_object},
    load::builtin,
    prepare::PreparedScene,
    renderer::{Frame, Headless, PartSums},
    scene::{Budget, Camera, Cull, Edges, Epsilon, Lod, Rasterizer, Samples, Scene, Settings, Shading},
};

use crate::{
    common::{ALL, scenes, shared, with},
    levels::ball,
};

/// Draws with reductions between the stages, as processes of MPI do it.
fn together(headless: &mut Headless, parts: &[PreparedScene], hard: &Hard) -> Result<Frame, Error> {
    let mut depth = vec![0.0_f32; (hard.settings.size_px[0] * hard.settings.size_px[1]) as usize];
    for part in parts {
        let own = headless.see_part(part, &hard.camera, &hard.settings)?;
        depth.iter_mut().zip(own).for_each(|(depth, own)| *depth = depth.max(own));
    }
    let mut sums = PartSums { colors: vec![0.0; 4 * depth.len()], normals: vec![0.0; 4 * depth.len()] };
    for part in parts {
        let own = headless.sum_part(part, &hard.camera, &hard.settings, &depth, true)?;
        sums.colors.iter_mut().zip(own.colors).for_each(|(sum, own)| *sum += own);
        sums.normals.iter_mut().zip(own.normals).for_each(|(sum, own)| *sum += own);
    }
    headless.shade_parts(&parts[0], &hard.camera, &hard.settings, (&depth, &sums), ALL)
}

/// How far two frames are apart: the part of pixels that differ in a channel, in linear light, or in a weight, by more than 2⁻¹⁰ of the largest; and the root of
/// the mean square of what all others differ by.
fn apart(found: &Frame, truth: &Frame) -> (f64, f64) {
    let most = truth.weight.iter().copied().fold(1.0, f32::max);
    let farthest = |i: usize| {
        let channels = found.linear[i].iter().zip(truth.linear[i]).map(|(a, b)| (a - b).abs());
        channels.fold((found.weight[i] - truth.weight[i]).abs() / most, f32::max)
    };
    let (others, near): (Vec<f32>, Vec<f32>) =
        (0..truth.weight.len()).map(farthest).partition(|difference| *difference > 1.0 / 1024.0);
    let squares: f64 = near.iter().map(|difference| f64::from(*difference).powi(2)).sum();
    (others.len() as f64 / truth.weight.len() as f64, (squares / near.len() as f64).sqrt())
}

/// What two frames of the same splats, in parts and in one, may differ by.
fn assert_one_picture(found: &Frame, truth: &Frame, what: &str) {
    let (others, rms) = apart(found, truth);
    println!("{what}: {others:.2e} of pixels are others, {rms:.2e} RMS of the rest");
    // A chunk has an origin of its own, from which 32 bits place a splat: within 2⁻¹³ of its half axis of where another chunk has it. So a rim may cover a
    // pixel more or less, and a splat at ε behind the nearest be in its sum or not: rims and such edges are about a pixel in ten, which are so near to
    // one in one case of 2¹² or less. Else there is the order of sums, of some ten splats: roundings of 2⁻²⁴.
    assert!(others < 1e-4 && rms < 3e-6, "{what}: {others} {rms}");
}

/// The same splats and nodes, each in one of the parts: by tiles, with splats of which some are large, by points that are listed; at sizes on the screen
/// and without levels; lit, by depth.
#[test]
fn readers_of_a_file_make_the_picture_of_one() {
    type Change<'c> = &'c dyn Fn(&mut Settings);
    let mut headless = shared();
    let folder = temp_dir::TempDir::new().unwrap();
    let path = folder.path().join("a.surfel");
    write_object(&path, &builtin::relief(60_000), None, &()).unwrap();
    let mut file = LevelsFile::open(&path).unwrap();
    let compute = |settings: &mut Settings| settings.rasterizer = Rasterizer::Compute;
    let points = |settings: &mut Settings| {
        (settings.rasterizer, settings.cull) = (Rasterizer::Perspective, Cull::List);
    };
    let by_depth = |settings: &mut Settings| settings.shading = Shading::EyeDome;
    let cases: [(Change<'_>, f64, f64); 5] = [
        (&compute, 3.5, 1.0),
        (&compute, 1.02, 0.0),
        (&points, 3.5, 2.0),
        (&points, 3.5, 0.0),
        (&by_depth, 3.5, 1.0),
    ];
    for (case, (change, distance, tau_px)) in cases.into_iter().enumerate() {
        let mut hard = with(&ball(1, tau_px), |settings| {
            (settings.edges, settings.lod, settings.epsilon) =
                (Edges::Hard, Lod::Px(tau_px), Epsilon::Radii(1.0));
            change(settings);
        });
        let (eye, target) = (DVec3::new(0.3, 0.2, distance), DVec3::new(0.3, 0.2, 0.0));
        hard.camera = Camera { eye, target, near: Some(0.01), ..Camera::default() };
        let view = PageView::new(&hard.camera, hard.settings.size_px, tau_px);
        let mut read = |view: PageView| {
            let object = file.load(Some(&view), u64::MAX, &()).unwrap().object;
            let scene = Scene { leveled: vec![object], ..Scene::default() };
            headless.prepare(&scene, &|_, _| {}).unwrap()
        };
        let whole = read(view);
        let parts = [1, 2, 4].map(|n| (0..n).map(|i| read(view.with_readers(i, n))).collect::<Vec<_>>());
        let truth = headless.render(&whole, &hard.camera, &hard.settings, ALL).unwrap();
        let covered = truth.weight.iter().filter(|weight| **weight > 0.0).count();
        assert!(covered > 5000, "{covered}");
        for parts in parts {
            let found = together(&mut headless, &parts, &hard).unwrap();
            assert_one_picture(&found, &truth, &format!("case {case}, {} parts", parts.len()));
        }
    }
}

/// Things that hide each other, each on a device of its own; one of the devices has nothing of the view.
#[test]
fn what_another_part_hides_is_not_summed() {
    let mut headless = shared();
    let hard = with(&scenes::sphere_of_disks(), |settings| settings.edges = Edges::Hard);
    let spheres = [DVec3::ZERO, DVec3::new(0.2, 0.1, 1.4), DVec3::new(0.0, 0.0, 900.0)]
        .map(|center| scenes::sphere(4000, center));
    let scene = |objects| Scene { objects, ..hard.scene.clone() };
    let all = headless.prepare(&scene(spheres.to_vec()), &|_, _| {}).unwrap();
    let parts = spheres.map(|sphere| headless.prepare(&scene(vec![sphere]), &|_, _| {}).unwrap());
    let truth = headless.render(&all, &hard.camera, &hard.settings, ALL).unwrap();
    let found = together(&mut headless, &parts, &hard).unwrap();
    assert_one_picture(&found, &truth, "spheres");
    // One of them alone is another picture.
    let alone = together(&mut headless, &parts[..1], &hard).unwrap();
    assert!(apart(&alone, &truth).0 > 0.05);
}

#[test]
fn what_is_not_done_in_parts_is_refused_by_name() {
    let mut headless = shared();
    let hard = scenes::sphere_of_disks();
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    let mut refused = |camera: &Camera, settings: Settings| {
        headless.see_part(&prepared, camera, &settings).unwrap_err().to_string()
    };
    let settings = |change: &dyn Fn(&mut Settings)| with(&hard, change).settings;
    let orthographic = Camera { orthographic_height: Some(2.0), ..hard.camera };
    let cases = [
        (refused(&orthographic, hard.settings.clone()), "--orthographic: not in parts"),
        (refused(&hard.camera, settings(&|of| of.samples = Samples(4))), "--samples: expected 1"),
        (refused(&hard.camera, settings(&|of| of.budget = Budget::Splats(9))), "--budget: not in parts"),
    ];
    for (error, expected) in cases {
        assert!(error.contains(expected), "{error}");
    }
    let hard = scenes::transparent::spheres();
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    let error = headless.see_part(&prepared, &hard.camera, &hard.settings).unwrap_err().to_string();
    assert!(error.contains("expected opaque splats of a frame in parts"), "{error}");
    // Of another picture.
    let opaque = headless.prepare(&scenes::sphere_of_disks().scene, &|_, _| {}).unwrap();
    let few = headless.sum_part(&opaque, &hard.camera, &scenes::sphere_of_disks().settings, &[0.0; 4], false);
    assert!(few.unwrap_err().to_string().contains("16 bytes of a part"));
}
