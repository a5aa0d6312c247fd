//! Frames in parts: what devices that have a part of a scene each make together is the picture of the whole.

use glam::DVec3;
use surfel::{
    Error,
    hard_scenes::Hard,
    levels_file::{LevelsFile, PageView, write_object},
    load::builtin,
    prepare::PreparedScene,
    renderer::{Frame, Headless, LayerSums, PartSums, PartsAround},
    scene::{
        Budget, Camera, ClipPlanes, Cull, Edges, Epsilon, LastLayer, Layers, Lod, Rasterizer, Samples, Scene,
        Settings, Shading, Shapes,
    },
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
    let layers = match parts.iter().any(PreparedScene::is_transparent) {
        true => Some(layers_together(headless, parts, hard, &depth)?),
        false => None,
    };
    headless.shade_parts(&parts[0], &hard.camera, &hard.settings, (&depth, &sums, layers.as_deref()), ALL)
}

/// The same of transparent layers, before opaque things of this depth.
fn layers_together(
    headless: &mut Headless,
    parts: &[PreparedScene],
    hard: &Hard,
    opaque: &[f32],
) -> Result<Vec<f32>, Error> {
    let Hard { camera, settings, .. } = hard;
    let add = |all: &mut PartSums, own: PartSums| {
        for (all, own) in [(&mut all.colors, own.colors), (&mut all.normals, own.normals)] {
            all.resize(own.len(), 0.0);
            all.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
        }
    };
    let (mut composed, mut before) = (None, None::<(Vec<f32>, PartSums)>);
    let count = settings.layers.most();
    for number in 1..=count {
        let around =
            PartsAround { opaque: Some(opaque), before: before.as_ref().map(|(depth, _)| &depth[..]) };
        let (mut depth, mut sums) = (vec![0.0_f32; opaque.len()], PartSums::default());
        let of_rest = number == count && settings.last_layer != LastLayer::Drop;
        if of_rest {
            for part in parts {
                add(&mut sums, headless.sum_rest_part(part, camera, settings, around)?);
            }
        } else {
            for part in parts {
                let own = headless.see_layer_part(part, camera, settings, around)?;
                depth.iter_mut().zip(own).for_each(|(depth, own)| *depth = depth.max(own));
            }
            for part in parts {
                add(&mut sums, headless.sum_layer_part(part, camera, settings, around, &depth)?);
            }
        }
        if !sums.colors.chunks_exact(4).any(|of| of[3] > 0.0) {
            break;
        }
        let counts = before.as_ref().filter(|_| settings.last_layer == LastLayer::Stack);
        let of_layer = match of_rest {
            true => LayerSums::Rest(&sums, counts.map(|(_, sums)| sums)),
            false => LayerSums::Surface(&sums),
        };
        let under = composed.take();
        let done = headless.compose_parts(&parts[0], camera, settings, of_layer, under.as_deref())?;
        (composed, before) = (Some(done), Some((depth, sums)));
    }
    Ok(composed.unwrap_or_else(|| vec![0.0; 4 * opaque.len()]))
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
/// and without levels; lit, by depth; transparent ones, which parts draw as points, layer by layer.
#[test]
fn readers_of_a_file_make_the_picture_of_one() {
    type Change<'c> = &'c dyn Fn(&mut Settings);
    let mut headless = shared();
    let folder = temp_dir::TempDir::new().unwrap();
    let mut files = [1.0, 0.4].map(|alpha| {
        let path = folder.path().join(format!("{alpha}.surfel"));
        let relief = scenes::transparent::tinted(builtin::relief(60_000), [0.8, 0.5, 0.3, alpha]);
        write_object(&path, &relief, None, &()).unwrap();
        LevelsFile::open(&path).unwrap()
    });
    let compute = |settings: &mut Settings| settings.rasterizer = Rasterizer::Compute;
    let points = |settings: &mut Settings| {
        (settings.rasterizer, settings.cull) = (Rasterizer::Perspective, Cull::List);
    };
    let by_depth = |settings: &mut Settings| settings.shading = Shading::EyeDome;
    let cases: [(usize, Change<'_>, f64, f64); 8] = [
        (0, &compute, 3.5, 1.0),
        (0, &compute, 1.02, 0.0),
        (0, &points, 3.5, 2.0),
        (0, &points, 3.5, 0.0),
        (0, &by_depth, 3.5, 1.0),
        (1, &compute, 3.5, 1.0),
        (1, &points, 3.5, 2.0),
        (1, &points, 3.5, 0.0),
    ];
    for (case, (file, change, distance, tau_px)) in cases.into_iter().enumerate() {
        let file = &mut files[file];
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
        let nothing = truth.linear[0];
        let covered = truth.linear.iter().filter(|color| **color != nothing).count();
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

/// A ball with two transparent ones that cross it and each other, one of which two devices have in halves: with all layers, as many as there are, few of
/// which the last one is dropped, blended or counts surfaces; lit by lights of the scene, cut by a plane.
#[test]
fn transparent_layers_of_parts_are_those_of_one() {
    let mut headless = shared();
    let mut hard = with(&scenes::sphere_of_disks(), |settings| settings.edges = Edges::Hard);
    hard.scene.lights = scenes::transparent::meshes_only().scene.lights;
    assert!(!hard.scene.lights.is_empty());
    let ball = |place, color| scenes::transparent::tinted(scenes::sphere(3000, place), color);
    let opaque = scenes::sphere(3000, DVec3::new(0.5, 0.0, -0.6));
    let near = ball(DVec3::new(0.0, 0.3, 0.4), [0.9, 0.4, 0.1, 0.5]);
    let far = ball(DVec3::new(-0.5, -0.2, -0.3), [0.1, 0.5, 0.9, 0.3]);
    let half = |first: usize| {
        let mut half = near.clone();
        let Shapes::Disks { normals, radii } = &mut half.splats.shapes else { panic!("disks") };
        half.splats.positions = half.splats.positions.into_iter().skip(first).step_by(2).collect();
        *normals = normals.drain(first..).step_by(2).collect();
        *radii = radii.drain(first..).step_by(2).collect();
        half
    };
    let scene = |objects| Scene { objects, ..hard.scene.clone() };
    let whole =
        headless.prepare(&scene(vec![opaque.clone(), near.clone(), far.clone()]), &|_, _| {}).unwrap();
    let parts = [vec![half(0)], vec![opaque, half(1)], vec![far]]
        .map(|objects| headless.prepare(&scene(objects), &|_, _| {}).unwrap());
    let plane = ClipPlanes([[0.0, -1.0, 0.1, 0.7]].into());
    let cases = [
        (Rasterizer::Compute, Layers::Fixed(24), LastLayer::Drop, ClipPlanes::default()),
        (Rasterizer::Perspective, Layers::Auto(16), LastLayer::Stack, ClipPlanes::default()),
        (Rasterizer::Perspective, Layers::Fixed(2), LastLayer::Drop, ClipPlanes::default()),
        (Rasterizer::Perspective, Layers::Fixed(2), LastLayer::Blend, ClipPlanes::default()),
        (Rasterizer::Perspective, Layers::Fixed(3), LastLayer::Stack, ClipPlanes::default()),
        (Rasterizer::Compute, Layers::Auto(16), LastLayer::Stack, plane),
    ];
    for (rasterizer, layers, last_layer, plane) in cases {
        let what = format!("{rasterizer:?}, {layers}, {last_layer:?}, {plane:?}");
        let hard = with(&hard, |settings| {
            (settings.rasterizer, settings.layers, settings.last_layer) = (rasterizer, layers, last_layer);
            settings.clip_planes = plane;
        });
        let truth = headless.render(&whole, &hard.camera, &hard.settings, ALL).unwrap();
        let found = together(&mut headless, &parts, &hard).unwrap();
        assert_one_picture(&found, &truth, &what);
        // What one of them has alone is another picture.
        let alone = together(&mut headless, &parts[1..2], &hard).unwrap();
        assert!(apart(&alone, &truth).0 > 0.05, "{what}");
    }
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
    let hard = scenes::transparent::meshes_only();
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    let error = headless.see_part(&prepared, &hard.camera, &hard.settings).unwrap_err().to_string();
    assert!(error.contains("polygons; expected splats of a frame in parts"), "{error}");
    // Of another picture.
    let opaque = headless.prepare(&scenes::sphere_of_disks().scene, &|_, _| {}).unwrap();
    let few = headless.sum_part(&opaque, &hard.camera, &scenes::sphere_of_disks().settings, &[0.0; 4], false);
    assert!(few.unwrap_err().to_string().contains("16 bytes of a part"));
}
