//! Boxes and planes that cut what is seen: the GPU against the oracle, pixel by pixel, by every way to draw.

mod cuts;

use crate::common::{
    PICTURE, headless, oracle_of, passes, render, render_as,
    scenes::{self, Hard},
    shared, with,
};
use crate::samples::errors;
use cuts::{agrees, cut, cuts, uncut_px};
use glam::DVec3;
use surfel::{
    hard_scenes::transparent,
    renderer::Headless,
    scene::{
        Backfaces, Camera, ClipBox, ClipPlanes, Cull, Edges, Epsilon, Filter, Rasterizer, Samples, Settings,
        TileInvocations, Transition,
    },
    selftest::{light::compare_light, tolerance},
};

#[test]
fn every_rasterizer_and_filter_is_cut_as_the_oracle_is() {
    let mut headless = shared();
    // Without backs, which planes have drawn: where a back and a front are one surface within epsilon, next to nothing is left of their normals' sum.
    let sphere = &with(&scenes::sphere_of_disks(), |settings| settings.backfaces = Backfaces::Cull);
    let most_left_px = 0.9 * uncut_px(&mut headless, sphere);
    for (_, rasterizer) in Rasterizer::METHODS {
        for filter in [Filter::Adjust, Filter::None, Filter::Max, Filter::Ewa, Filter::AdjustPaper] {
            let hard = with(sphere, |settings| {
                (settings.rasterizer, settings.filter) = (*rasterizer, filter);
            });
            if hard.settings.validate().is_ok() {
                let plane = &cuts()[1];
                agrees(&mut headless, &cut(&hard, plane), plane.0, most_left_px);
            }
        }
        let hard = with(sphere, |settings| settings.rasterizer = *rasterizer);
        let hard = with(&hard, |settings| {
            if settings.validate().is_err() {
                settings.filter = Filter::None
            }
        });
        for cut_by in [&cuts()[0], &cuts()[2]] {
            agrees(&mut headless, &cut(&hard, cut_by), cut_by.0, most_left_px);
        }
    }
}

#[test]
fn every_hard_scene_is_cut_as_the_oracle_is() {
    let mut headless = shared();
    for hard in scenes::all() {
        // Through what is looked at, aslant.
        let toward = (hard.camera.target - hard.camera.eye).normalize();
        let ball = hard.scene.ball().unwrap();
        let normal = (toward.cross(hard.camera.up).normalize() + 0.2 * toward + 0.1 * DVec3::Y).normalize();
        let middle = if ball.radius < 100.0 { ball.center } else { hard.camera.target };
        let plane = ClipPlanes([normal.extend(normal.dot(middle)).to_array()].into());
        let most_left_px = 0.95 * uncut_px(&mut headless, &hard);
        for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
            let hard = with(&hard, |settings| {
                // Seven would be too many.
                settings.clip_box = ClipBox::default();
                settings.clip_planes = plane.clone();
                settings.rasterizer = rasterizer;
            });
            agrees(&mut headless, &hard, "plane", most_left_px);
        }
    }
}

#[test]
fn cuts_cover_pixels_in_part_as_the_oracles_do() {
    let mut headless = shared();
    let ways = [Filter::Adjust, Filter::Ewa]
        .into_iter()
        .flat_map(|filter| [TileInvocations::Pixel, TileInvocations::Column].map(|by| (filter, by)));
    let both = [scenes::sphere_of_disks(), scenes::clipped()];
    for (number, (filter, invocations)) in ways.enumerate() {
        // Each cut of each scene, with each filter and each form of tiles.
        for (turn, cut_by) in cuts().iter().enumerate() {
            let hard = with(&cut(&both[(number + number / 2 + turn) % 2], cut_by), |settings| {
                (settings.edges, settings.rasterizer) = (Edges::Coverage, Rasterizer::Compute);
                (settings.filter, settings.tile_invocations) = (filter, invocations);
                settings.background = None;
            });
            let frame = render_as(&mut headless, &hard, PICTURE);
            assert!(!passes(&frame).contains(&"accumulate"));
            let errors = compare_light(&frame, &oracle_of(&hard));
            println!("{}", errors.row(&format!("{}, {}", hard.name, cut_by.0)));
            let good = errors.worst <= tolerance::LIGHT && errors.not_finite == 0;
            assert!(good && errors.seen >= 300, "{}, {}, {filter:?}: {errors:?}", hard.name, cut_by.0);
        }
    }
}

#[test]
fn layers_polygons_samples_and_parallel_rays_are_cut_too() {
    let mut headless = shared();
    let length = |hard: &Hard| with(hard, |settings| settings.epsilon = Epsilon::Length(0.02));
    let samples = |hard: &Hard| with(hard, |settings| settings.samples = Samples(4));
    let [sphere, hybrid, spheres] =
        [scenes::sphere_of_disks(), transparent::hybrid(Transition::Color), transparent::spheres()];
    let parallel_camera = |hard: &Hard| Hard {
        camera: Camera { orthographic_height: Some(3.0), ..hard.camera },
        ..hard.clone()
    };
    let all = [
        hybrid.clone(),
        spheres.clone(),
        length(&spheres),
        samples(&sphere),
        parallel_camera(&sphere),
        parallel_camera(&hybrid),
        parallel_camera(&spheres),
    ];
    let cuts = cuts();
    for (number, hard) in all.iter().enumerate() {
        // Each scene by each method and with each cut; each cut by each method.
        let methods = [Rasterizer::Compute, Rasterizer::Perspective, Rasterizer::Triangle];
        for (turn, rasterizer) in methods.into_iter().enumerate() {
            let cut_by = &cuts[(number + turn) % cuts.len()];
            let hard = with(&cut(hard, cut_by), |settings| {
                settings.rasterizer = rasterizer;
                settings.background = None;
            });
            let (frame, oracle) = (render_as(&mut headless, &hard, PICTURE), oracle_of(&hard));
            let [mean, beyond] = errors(&frame.linear, oracle.pixels.iter().map(|pixel| pixel.color));
            let name = format!("{}, {}, {rasterizer:?}", hard.name, cut_by.0);
            println!("{name}: mean {mean:.1e}, {:.2}% of pixels beyond 1/255", 100.0 * beyond);
            assert!(mean < 2e-4 && beyond < 8e-3, "{name}: {mean:e}, {beyond}");
            let seen = frame.linear.iter().filter(|pixel| pixel[3] > 0.0).count();
            assert!(seen > 100, "{name}: {seen}");
        }
    }
}

#[test]
fn what_is_wholly_cut_off_is_not_listed_and_nothing_is_left_of_all() {
    let mut headless = shared();
    let sphere = with(&scenes::sphere_of_disks(), |settings| settings.background = None);
    let prepared = headless.prepare(&sphere.scene, &|_, _| {}).unwrap();
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
        let listed = |headless: &mut Headless, plane: [f64; 4]| {
            let settings = Settings {
                rasterizer,
                cull: Cull::List,
                // A plane that cuts nothing has no backs drawn that another may.
                backfaces: Backfaces::Flip,
                clip_planes: ClipPlanes([plane].into()),
                ..sphere.settings.clone()
            };
            let frame = headless.render(&prepared, &sphere.camera, &settings, PICTURE).unwrap();
            let seen = frame.linear.iter().filter(|pixel| pixel[3] > 0.0).count();
            (headless.count_listed(&prepared, &sphere.camera, &settings).unwrap(), seen)
        };
        let [all, some, none] = [-9.0, 0.3, 9.0].map(|d| listed(&mut headless, [1.0, 0.0, 0.0, d]));
        println!("{rasterizer:?}: {all:?}, {some:?}, {none:?}");
        assert!(some.0 < all.0 * 3 / 4 && some.1 < all.1 && some.1 > 0);
        assert_eq!(none, (0, 0));
    }
}

#[test]
fn what_is_cut_open_is_seen_from_inside() {
    let mut headless = shared();
    for hard in [scenes::sphere_of_disks(), transparent::hybrid(Transition::Color)] {
        let mut hard = with(&hard, |settings| settings.background = None);
        hard.scene.objects.iter_mut().for_each(|object| object.closed = true);
        hard.scene.meshes.iter_mut().for_each(|object| object.closed = true);
        // The half that is farther away.
        let away = (hard.camera.target - hard.camera.eye).normalize();
        let plane = ClipPlanes([away.extend(away.dot(hard.camera.target)).to_array()].into());
        for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
            let hard = with(&hard, |settings| {
                (settings.rasterizer, settings.clip_planes) = (rasterizer, plane.clone());
            });
            let (frame, oracle) = (render_as(&mut headless, &hard, PICTURE), oracle_of(&hard));
            let [mean, beyond] = errors(&frame.linear, oracle.pixels.iter().map(|pixel| pixel.color));
            let seen = frame.linear.iter().filter(|pixel| pixel[3] > 0.0).count();
            println!("{}, {rasterizer:?}: {seen} seen, mean {mean:.1e}, {:.2}%", hard.name, 100.0 * beyond);
            assert!(seen > 1000 && mean < 2e-4 && beyond < 8e-3, "{}: {seen}, {mean:e}, {beyond}", hard.name);
        }
    }
}

#[test]
fn planes_far_from_the_origin_and_none_at_all() {
    let mut headless = shared();
    let far = DVec3::new(500_000.0, 4_600_000.0, 300.0);
    let mut hard = scenes::sphere_of_disks();
    hard.scene.objects[0].splats.positions.iter_mut().for_each(|position| *position += far);
    (hard.camera.eye, hard.camera.target) = (hard.camera.eye + far, hard.camera.target + far);
    let normal = DVec3::new(1.0, 0.5, 0.3);
    let plane = ClipPlanes([normal.extend(normal.dot(far) + 0.1).to_array()].into());
    let cut = with(&hard, |settings| settings.clip_planes = plane.clone());
    let most_left_px = 0.9 * uncut_px(&mut headless, &hard);
    agrees(&mut headless, &cut, "far from the origin", most_left_px);
    // A plane that cuts nothing changes no bit of what the graphics pipeline draws; the backs that it has drawn are culled.
    let whole = ClipBox(Some([(far - 9.0).to_array(), (far + 9.0).to_array()]));
    for rasterizer in [Rasterizer::Perspective, Rasterizer::Quad] {
        let plain = with(&hard, |settings| {
            (settings.rasterizer, settings.cull, settings.backfaces) =
                (rasterizer, Cull::Setup, Backfaces::Cull);
        });
        let boxed = with(&plain, |settings| settings.clip_box = whole);
        let [plain, boxed] = [plain, boxed].map(|hard| render(&mut headless, &hard));
        crate::common::assert_same_bits(&plain, &boxed, "a box around all");
    }
}

#[test]
fn planes_that_meet_nothing_leave_the_frame_as_it_is_and_its_backs_undrawn() {
    // Of its own: others may have made pipelines of the same cuts.
    let mut headless = headless();
    let settings = Settings { backfaces: Backfaces::Auto, background: None, ..Settings::default() };
    let of = |hard: Hard| {
        let mut hard =
            Hard { settings: Settings { size_px: hard.settings.size_px, ..settings.clone() }, ..hard };
        hard.scene.objects.iter_mut().for_each(|object| object.closed = true);
        hard.scene.meshes.iter_mut().for_each(|object| object.closed = true);
        hard
    };
    for hard in [scenes::sphere_of_disks(), scenes::clipped(), transparent::hybrid(Transition::Color)].map(of)
    {
        let bounds = hard.scene.bounds().unwrap();
        let boxed = |by: f64| ClipBox(Some([(bounds.min - by).to_array(), (bounds.max + by).to_array()]));
        for (rasterizer, edges) in [
            (Rasterizer::Compute, Edges::Coverage),
            (Rasterizer::Compute, Edges::Hard),
            (Rasterizer::Perspective, Edges::Hard),
        ] {
            let render = |headless: &mut Headless, clip_box| {
                let hard = with(&hard, |settings| {
                    (settings.rasterizer, settings.edges) = (rasterizer, edges);
                    settings.clip_box = clip_box;
                });
                (render_as(headless, &hard, PICTURE), hard)
            };
            let (plain, _) = render(&mut headless, ClipBox::default());
            let made = headless.renderer.pipelines_made();
            let (around, around_all) = render(&mut headless, boxed(1e-9));
            let name = &hard.name;
            assert_eq!(headless.renderer.pipelines_made(), made, "{name}, {rasterizer:?}, {edges:?}");
            assert_eq!(plain.linear, around.linear, "{name}, {rasterizer:?}, {edges:?}");
            let oracle = oracle_of(&around_all);
            let [mean, beyond] = errors(&around.linear, oracle.pixels.iter().map(|pixel| pixel.color));
            println!("{name}, {rasterizer:?}, {edges:?}: mean {mean:.1e}, {:.2}%", 100.0 * beyond);
            assert!(mean < 2e-4 && beyond < 8e-3, "{name}: {mean:e}, {beyond}");
            // A box that is smaller cuts, and has its own pipelines.
            let (cut, _) = render(&mut headless, boxed(-0.2));
            assert!(headless.renderer.pipelines_made() > made && cut.linear != plain.linear, "{name}");
        }
    }
}
