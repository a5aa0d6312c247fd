//! Where splats and polygons of one surface meet: the seam over a sweep of views, without and with the transition's
//! smoothing (Guennebaud et al. 2006, section 5.1, figure 5).

use crate::common::{builder, shared};
use glam::DVec3;
use surfel::{
    geometry::{Hybrid, HybridOptions, hybrid},
    load::builtin::sphere_mesh,
    renderer::{Frame, Headless, Wanted},
    scene::{
        Accumulate, Camera, Colors, Edges, Filter, Kernel, Mesh, MeshObject, Object, Scene, Settings,
        Shading, Transition,
    },
};

const SPLATS: [f32; 4] = [0.9, 0.3, 0.1, 1.0];
const POLYGONS: [f32; 4] = [0.1, 0.6, 0.7, 1.0];

/// Of the half: splats inside have radii of about 40 pixels.
const SAMPLES: u64 = 400;

/// A unit sphere of which the left half stays polygons.
fn ball(samples: u64, sample_edges: bool) -> Hybrid {
    let mesh = sphere_mesh(1280);
    let left = |i: usize| mesh.corners(i).is_some_and(|[a, b, c]| (a + b + c).x < 0.0);
    let options = HybridOptions { samples, seed: 3, sample_edges };
    hybrid(&mesh, &left, &options, &()).unwrap()
}

/// Both parts, each in a color of its own, opaque or not.
fn scene(ball: &Hybrid, alpha: f32) -> Scene {
    let faded = |[red, green, blue, _]: [f32; 4]| [red, green, blue, alpha];
    let mut splats = ball.splats.clone();
    splats.colors = Colors::Uniform(faded(SPLATS));
    let mesh = Mesh { colors: Colors::Uniform(faded(POLYGONS)), ..ball.polygons.clone() };
    Scene {
        objects: vec![Object { name: "splats".to_owned(), splats, closed: ball.closed }],
        meshes: vec![MeshObject { name: "polygons".to_owned(), mesh, closed: ball.closed }],
        ..Scene::default()
    }
}

/// At the middle of the seam, so near that splats on it, which are small over the coarse polygons, have radii of about 40 pixels: as
/// where a model is looked at closely enough to see the seam.
fn close_views() -> Vec<Camera> {
    let close = |camera: Camera| Camera { target: DVec3::Z, fov_y_rad: camera.fov_y_rad / 8.0, ..camera };
    views().into_iter().map(close).collect()
}

/// From the left, where polygons are, to the right, and a little from above.
fn views() -> Vec<Camera> {
    let at = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        builder::camera([3.2 * sin, 0.6, 3.2 * cos], [0.0; 3])
    };
    [-48.0, -12.0, 36.0].map(at).into()
}

fn settings(transition: Transition) -> Settings {
    Settings {
        size_px: [512, 512],
        transition,
        filter: Filter::Adjust,
        accumulate: Accumulate::F32,
        shading: Shading::Albedo,
        // Splats alone end before a background, which is not what lies beside them in the hybrid.
        edges: Edges::Hard,
        ..Settings::default()
    }
}

fn draw(headless: &mut Headless, scene: &Scene, camera: &Camera, settings: &Settings) -> Frame {
    let prepared = headless.prepare(scene, &|_, _| {}).unwrap();
    let wanted = Wanted { picture: true, linear: true, ..Wanted::default() };
    headless.render(&prepared, camera, settings, wanted).unwrap()
}

/// How much of a pixel is splat: 0 where it has the polygons' color, 1 where it has the splats'. The second value is how far
/// the color is from the line between both: nothing darker, nothing brighter, nothing else.
fn share([red, green, blue, _]: [f32; 4]) -> (f64, f64) {
    let color = DVec3::new(red.into(), green.into(), blue.into());
    let of = |color: [f32; 4]| DVec3::new(color[0].into(), color[1].into(), color[2].into());
    let (from, to) = (of(POLYGONS), of(SPLATS));
    let share = (color - from).dot(to - from) / (to - from).length_squared();
    (share, (from + share * (to - from)).distance(color))
}

/// The largest step of the share between neighboring pixels of a row, over the rows that cross the seam well within the
/// silhouette.
fn jumps(frame: &Frame) -> Vec<f64> {
    let [width, height] = frame.size_px.map(|side| side as usize);
    let white = |pixel: [f32; 4]| pixel[..3].iter().all(|c| *c > 0.99);
    let mut jumps = Vec::new();
    for row in height / 4..3 * height / 4 {
        let pixels = &frame.linear[row * width..(row + 1) * width];
        let covered: Vec<usize> = (0..width).filter(|x| !white(pixels[*x])).collect();
        let (Some(first), Some(last)) = (covered.first(), covered.last()) else { continue };
        let inner: Vec<f64> = (first + 6..last - 5).map(|x| share(pixels[x]).0).collect();
        let has_both = inner.iter().any(|s| *s < 0.01) && inner.iter().any(|s| *s > 0.99);
        if has_both {
            jumps.push(inner.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max));
        }
    }
    jumps
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[test]
fn smoothing_makes_the_jump_at_the_seam_a_fifth_or_less_over_a_sweep_of_views() {
    let mut headless = shared();
    let sampled = ball(SAMPLES, true);
    for (what, alpha) in [("opaque", 1.0), ("transparent", 0.5)] {
        let scene = scene(&sampled, alpha);
        let mut means = Vec::new();
        for transition in [Transition::None, Transition::Color, Transition::Attributes, Transition::Paper] {
            let mut all = Vec::new();
            for camera in close_views() {
                let settings = Settings { background: Some([1.0; 3]), ..settings(transition) };
                let frame = draw(&mut headless, &scene, &camera, &settings);
                // Light that passes: over black, and as if it were opaque.
                let frame =
                    if alpha < 1.0 { first_layer(&mut headless, &scene, &camera, &settings) } else { frame };
                all.extend(jumps(&frame));
            }
            println!("{what}, {transition:?}: mean jump {:.3} over {} rows", mean(&all), all.len());
            // Without smoothing the triangles below splats hide them all in two of the three views.
            let least = if transition == Transition::None { 200 } else { 700 };
            assert!(all.len() > least, "{}", all.len());
            means.push(mean(&all));
        }
        assert!(means[0] > 0.95, "{means:?}");
        // What is left is the kernel's own step at its rim, e⁻², and the slope of the sum.
        assert!(means[1..].iter().all(|smooth| 5.0 * smooth <= means[0]), "{what}: {means:?}");
    }
}

/// The nearest transparent layer alone, its alpha divided out.
fn first_layer(headless: &mut Headless, scene: &Scene, camera: &Camera, settings: &Settings) -> Frame {
    let settings = Settings {
        layers: surfel::scene::Layers::Fixed(1),
        last_layer: surfel::scene::LastLayer::Drop,
        background: None,
        ..settings.clone()
    };
    let mut frame = draw(headless, scene, camera, &settings);
    for pixel in &mut frame.linear {
        if pixel[3] == 0.0 {
            *pixel = [1.0; 4];
        }
    }
    frame
}

#[test]
fn no_pixel_is_darker_or_brighter_than_both_and_what_is_far_from_the_seam_is_not_touched() {
    let mut headless = shared();
    let sampled = ball(SAMPLES, true);
    let both = scene(&sampled, 1.0);
    let only_splats = Scene { meshes: Vec::new(), ..both.clone() };
    let only_polygons = Scene { objects: Vec::new(), ..both.clone() };
    let (mut touched, mut worst) = (0, 0.0_f32);
    for (shading, camera) in
        [Shading::Albedo, Shading::Phong].into_iter().flat_map(|s| views().into_iter().map(move |v| (s, v)))
    {
        let settings = Settings { shading, ..settings(Transition::Color) };
        let [hybrid, splats, polygons] =
            [&both, &only_splats, &only_polygons].map(|scene| draw(&mut headless, scene, &camera, &settings));
        let is_background = |frame: &Frame, i: usize| frame.linear[i][..3] == [1.0; 3];
        for i in 0..hybrid.linear.len() {
            let [got, s, p] = [&hybrid, &splats, &polygons].map(|frame| frame.linear[i]);
            match (is_background(&splats, i), is_background(&polygons, i)) {
                // Where only the one is, it is alone: to 1/1024, and here to the bit but for what the other's far side shows.
                (true, true) => assert_eq!(got, s),
                (false, true) => assert!(near(got, s), "{i}: {got:?}, splats alone {s:?}"),
                (true, false) => assert!(near(got, p), "{i}: {got:?}, polygons alone {p:?}"),
                (false, false) => {
                    touched += 1;
                    // The surface is the nearest of both, so that with polygons below splats other splats may be of it: their normals'
                    // mean differs a little.
                    let rounding = if shading == Shading::Albedo { 1e-5 } else { 1.0 / 1024.0 };
                    for c in 0..3 {
                        worst = worst.max((s[c].min(p[c]) - got[c]).max(got[c] - s[c].max(p[c])));
                        let (low, high) = (s[c].min(p[c]) - rounding, s[c].max(p[c]) + rounding);
                        assert!((low..=high).contains(&got[c]), "{i}: {got:?}, splats {s:?}, polygons {p:?}");
                    }
                }
            }
        }
    }
    println!("{touched} pixels with both, {worst} beyond");
    assert!(touched > 1500, "{touched}");
}

fn near(a: [f32; 4], b: [f32; 4]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1.0 / 1024.0)
}

#[test]
fn sampling_the_edges_is_what_lets_the_weights_saturate_there() {
    let mut headless = shared();
    // Seen from the front the seam is the middle column.
    let camera = builder::camera([0.0, 0.0, 3.2], [0.0; 3]);
    let on_the_edge = [true, false].map(|sample_edges| {
        let scene = scene(&ball(SAMPLES, sample_edges), 1.0);
        // Its weights reach 1 with less overlap to spare than the Gaussian's.
        let kernel = Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 };
        let settings = Settings { kernel, ..settings(Transition::Color) };
        let frame = draw(&mut headless, &scene, &camera, &settings);
        // How much is splat in the last column of pixels that is the polygons'.
        let rows = 128..384;
        let shares: Vec<f64> = rows.map(|row| share(frame.linear[row * 512 + 255]).0).collect();
        (shares.iter().copied().fold(1.0, f64::min), mean(&shares))
    });
    println!(
        "share of splats at the seam: sampled least, mean {:?}; not sampled {:?}",
        on_the_edge[0], on_the_edge[1]
    );
    assert!(on_the_edge[0].0 > 0.9, "{on_the_edge:?}");
    assert!(on_the_edge[1].0 < 0.8 * on_the_edge[0].0, "{on_the_edge:?}");
}
