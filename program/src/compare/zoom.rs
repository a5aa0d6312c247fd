//! `surfel compare --zoom`: the filters on a checkerboard over distance, against the ground truth.

use glam::DVec3;
use surfel::{
    Progress as _, Result,
    graph::execute::Profile,
    load::builtin::{CHECKERBOARD_FIELD, CHECKERBOARD_RADIUS, checkerboard},
    renderer::{Headless, Wanted},
    report::{
        compare::{Method, Surface, errors},
        zoom::{Board, DEFAULT_TILT_DEG, ZoomFigures, ZoomReport, ZoomStep, samples_per_side, zoom_path},
    },
    scene::{Camera, Scene, Settings},
};

use super::{arguments::CompareArguments, candidates, context::CompareContext, pictures::BACKGROUND};
use crate::{console::Bars, reports::device_report, scene::upload};

/// Turns the board about its normal and shifts it, in degrees and spacings, so that no row of splats coincides with a row
/// of pixels.
const TURN_DEG: f64 = 20.0;
const SHIFT: DVec3 = DVec3::new(0.31, 0.17, 0.0);

/// How far beyond the picture's border splats count: more than the reach of any filter and of the ground truth.
const MARGIN_PX: f64 = 16.0;

/// Compares all filters at all distances.
///
/// # Errors
/// Whatever goes wrong; a filter that can't be drawn has no figures.
pub fn gather(headless: &mut Headless, arguments: &CompareArguments, bars: &Bars) -> Result<ZoomReport> {
    let base = &arguments.settings();
    let side = arguments.zoom_splats.unwrap_or(600) as usize;
    let tilt_deg = arguments.zoom_tilt.unwrap_or(DEFAULT_TILT_DEG);
    let board = Scene::from(checkerboard(side));
    let (methods, skipped) = candidates::split(
        arguments.selection().product(),
        base,
        (&board, &Camera::default()),
        &headless.renderer,
    );
    candidates::some_left(methods.len(), &skipped)?;
    let mut steps = Vec::new();
    let path = zoom_path(arguments.zoom_steps.unwrap_or(25));
    for (number, pixels_per_splat) in path.iter().copied().enumerate() {
        let camera = camera(pixels_per_splat, tilt_deg, base.size_px);
        let scene = in_view(&board, &camera, base.size_px);
        let prepared = upload(headless, &scene, bars)?;
        let context = CompareContext { scene: &scene, prepared: &prepared, camera: &camera, base, bars };
        let task = format!("ground truth {} of {}", number + 1, path.len());
        let samples = samples_per_side(pixels_per_splat, tilt_deg, arguments.samples);
        let step = step(headless, &context, &methods, (pixels_per_splat, samples), &task);
        bars.clear();
        steps.push(step?);
    }
    let mut report = ZoomReport {
        surfel: env!("CARGO_PKG_VERSION").to_owned(),
        device: device_report(headless.device().facts()),
        settings: zoom_options(base, &methods[0]),
        size_px: base.size_px,
        samples_per_side: arguments.samples,
        board: Board {
            splats_per_side: side,
            splats_per_field: CHECKERBOARD_FIELD,
            radius: CHECKERBOARD_RADIUS,
            tilt_deg,
        },
        filters: methods.iter().map(|method| method.filter).collect(),
        steps,
        claims: Vec::new(),
    };
    report.claims = report.judge();
    Ok(report)
}

/// Everything but the filter.
fn zoom_options(base: &Settings, method: &Method) -> std::collections::BTreeMap<&'static str, String> {
    let mut options = method.settings(base).as_options();
    options.remove("filter");
    options.remove("filter-weight");
    options
}

/// Looks at the board's middle, tilted, from where its splats are so far apart in the middle of the picture.
fn camera(pixels_per_splat: f64, tilt_deg: f64, size_px: [u32; 2]) -> Camera {
    let fov_y_rad = Camera::DEFAULT_FOV_Y_RAD;
    let mut camera = Camera { eye: DVec3::Z, target: SHIFT, up: DVec3::Z, fov_y_rad, ..Camera::default() };
    let distance = camera.focal_px(size_px[1]) / pixels_per_splat;
    let (sin_turn, cos_turn) = TURN_DEG.to_radians().sin_cos();
    let (sin_tilt, cos_tilt) = tilt_deg.to_radians().sin_cos();
    camera.up = DVec3::new(cos_tilt * sin_turn, cos_tilt * cos_turn, sin_tilt);
    camera.eye = SHIFT + distance * DVec3::new(-sin_tilt * sin_turn, -sin_tilt * cos_turn, cos_tilt);
    camera
}

/// The splats that may be seen, even if a filter enlarges them. All others change no picture, but references walk them in
/// every pixel where they come near the eye plane.
fn in_view(board: &Scene, camera: &Camera, size_px: [u32; 2]) -> Scene {
    let view = camera.view_from_world();
    let focal_px = camera.focal_px(size_px[1]);
    let [half_width, half_height] = size_px.map(|side| 0.5 * f64::from(side) + MARGIN_PX);
    // The sides of the view's pyramid, facing inward.
    let sides = [
        DVec3::new(focal_px, 0.0, half_width),
        DVec3::new(-focal_px, 0.0, half_width),
        DVec3::new(0.0, focal_px, half_height),
        DVec3::new(0.0, -focal_px, half_height),
    ]
    .map(DVec3::normalize);
    let mut seen = board.clone();
    for object in &mut seen.objects {
        let splats = &mut object.splats;
        let seen = |i: usize| {
            let (center, radius) = (view.point(splats.positions[i]), splats.major_radius(i));
            sides.iter().all(|side| side.dot(center) >= -radius)
        };
        let keep: Vec<bool> = (0..splats.len()).map(seen).collect();
        splats.keep(&keep);
    }
    seen
}

fn step(
    headless: &mut Headless,
    context: &CompareContext<'_>,
    methods: &[Method],
    (pixels_per_splat, samples_per_side): (f64, u32),
    task: &str,
) -> Result<ZoomStep> {
    let truth = Surface::of_truth(&context.truth(samples_per_side, task)?);
    let mut figures = Vec::new();
    for method in methods {
        let mut drawn = || -> Result<ZoomFigures> {
            let drawn = context.draw(headless, method)?;
            let fragments = fragments(headless, context, method)?;
            Ok(ZoomFigures { fragments, error: errors(&drawn.surface, &truth, &[], BACKGROUND) })
        };
        figures.push(match drawn() {
            Ok(figures) => Some(figures),
            Err(error) => {
                context.bars.note(&format!("{method} at {pixels_per_splat:.3} px a splat: {error}"));
                None
            }
        });
    }
    Ok(ZoomStep { pixels_per_splat, samples_per_side, figures })
}

/// Fragments of the accumulation.
fn fragments(headless: &mut Headless, context: &CompareContext<'_>, method: &Method) -> Result<Option<u64>> {
    let wanted = Wanted { profile: Some(Profile::Counts), ..Wanted::default() };
    let settings = method.settings(context.base);
    let profile =
        headless.render(context.prepared, context.camera, &settings, wanted)?.profile.unwrap_or_default();
    let pass = profile.passes.iter().find(|pass| pass.name == "accumulate");
    Ok(pass.and_then(|pass| pass.counts).map(|counts| counts.fragments))
}

#[cfg(test)]
mod tests {
    use super::*;
    use surfel::scene::Edges;

    #[test]
    fn only_splats_that_cannot_be_seen_are_left_out() {
        let board = Scene::from(checkerboard(100));
        for px in [0.5, 5.0, 50.0] {
            let camera = camera(px, 75.0, [64, 48]);
            let seen = in_view(&board, &camera, [64, 48]);
            let (all, left) = (board.splat_count(), seen.splat_count());
            // From afar the whole board is in the picture, from near a part of it.
            assert!(if px < 1.0 { left == all } else { left > 4 && left < all }, "{px}: {left} of {all}");
            // How much the surface overlaps itself at the view's border, where edges cover in part, is found from what is left.
            let settings = Settings { size_px: [64, 48], edges: Edges::Hard, ..Settings::default() };
            let [whole, part] = [&board, &seen]
                .map(|scene| surfel::reference::render(scene, &camera, &settings, &|_, _| {}).unwrap());
            assert_eq!(whole.pixels, part.pixels, "{px}");
        }
    }

    #[test]
    fn neighbors_in_the_middle_are_as_far_apart_as_the_step_says() {
        for (px, tilt_deg) in [(0.05, 75.0), (1.0, 0.0), (50.0, 45.0)] {
            let camera = camera(px, tilt_deg, [256, 256]);
            camera.validate().unwrap();
            let view = camera.view_from_world();
            let project = |world: DVec3| {
                let p = view.point(world);
                camera.focal_px(256) * p.truncate() / p.z
            };
            let (sin, cos) = TURN_DEG.to_radians().sin_cos();
            // Small steps: across the view, then along it, which the tilt foreshortens.
            let across = project(SHIFT + 1e-6 * DVec3::new(cos, -sin, 0.0)) / 1e-6;
            let along = project(SHIFT + 1e-6 * DVec3::new(sin, cos, 0.0)) / 1e-6;
            assert!((across.x.abs() / px - 1.0).abs() < 1e-4 && across.y.abs() < 1e-4 * px, "{across}");
            let foreshortened = px * f64::to_radians(tilt_deg).cos();
            assert!((along.y.abs() / foreshortened - 1.0).abs() < 1e-4, "{along}");
        }
    }
}
