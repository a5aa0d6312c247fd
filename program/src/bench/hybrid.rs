//! `surfel bench hybrid`: a mesh from afar to near, as polygons, as polygons and splats in levels of detail, and as splats alone (Guennebaud, Barthe, Paulin
//! 2006, section 5.2).

use surfel::{
    Result,
    geometry::{HybridOptions, Multiresolution, creased_mesh, multiresolution},
    load::{builtin::sphere_mesh, file_name},
    prepare::PreparedScene,
    renderer::{Headless, Wanted},
    report::bench::{HybridReport, HybridView, HybridWay, LevelError},
    scene::{Ball, Camera, Lod, MeshObject, Rasterizer, Samples, Scene, Settings},
};

use super::{
    arguments::Bench,
    contest::{self, Entry},
    context::BenchContext,
    model::Source,
};
use crate::scene::resample_mesh;

/// Triangles of the ball that is drawn where there is no model.
const TRIANGLES: u64 = 200_000;

/// How large the model is, over a view that it fills.
const ZOOMS: [f64; 7] = [0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0];

/// Samples of a pixel of the picture that others are held against.
const SAMPLES: Samples = Samples(64);

/// Measures them. The first of the options' levels of detail is one pixel where they say none.
///
/// # Errors
/// A model that is no mesh.
pub fn measure(headless: &mut Headless, context: &mut BenchContext<'_>) -> Result<HybridReport> {
    let (mesh, path) = match Source::open(context)? {
        Source::Mesh(mesh, path) => (mesh, path),
        Source::BuiltIn => (sphere_mesh(TRIANGLES), "built-in sphere".into()),
    };
    let model = file_name(&path);
    let count = context.arguments.splats_of(Bench::Hybrid).unwrap_or(mesh.positions.len() as u64);
    let options = HybridOptions { samples: count, seed: 0, sample_edges: true };
    let (splats, report) = resample_mesh(&mesh, &path, count, 0, &context.bars)?;
    context.inputs.push(report);
    let of_splats = Scene { objects: vec![splats], levels: true, ..Scene::default() };
    let (creased, report) = creased_mesh(mesh.clone());
    let object = |mesh| MeshObject { name: model.clone(), mesh, closed: report.closed };
    let of_polygons = Scene { meshes: vec![object(creased)], ..Scene::default() };
    let Multiresolution { mesh, levels, .. } = multiresolution(mesh, model.clone(), &options, &context.bars)?;
    let triangles = mesh.triangles.len() as u64;
    let splats = levels.splats.leaves.len() as u64;
    let of_both = Scene { meshes: vec![object(mesh)], hybrids: vec![levels], ..Scene::default() };
    let ball = of_polygons.ball().unwrap_or(Ball { center: glam::DVec3::ZERO, radius: 1.0 });
    let ways = [
        ("polygons", context.prepare(headless, &of_polygons)?),
        ("hybrid", context.prepare(headless, &of_both)?),
        ("splats", context.prepare(headless, &of_splats)?),
    ];
    let settings =
        Settings { lod: Lod::Px(1.0), rasterizer: Rasterizer::default(), ..context.settings.clone() };
    let views = ZOOMS.into_iter().map(|zoom| view(headless, context, &ways, (&ball, zoom), &settings));
    let views = views.collect::<Result<_>>()?;
    Ok(HybridReport { model, triangles, splats, views })
}

fn view(
    headless: &mut Headless,
    context: &mut BenchContext<'_>,
    ways: &[(&str, PreparedScene)],
    (ball, zoom): (&Ball, f64),
    settings: &Settings,
) -> Result<HybridView> {
    let camera = camera(ball, zoom, settings.size_px);
    headless.renderer.check(&camera, settings)?;
    let picture = |headless: &mut Headless, scene: &PreparedScene, samples: Samples| {
        let wanted = Wanted { picture: true, linear: true, ..Wanted::default() };
        let settings = Settings { background: None, samples, ..settings.clone() };
        headless.render(scene, &camera, &settings, wanted).map(|frame| frame.linear)
    };
    let truth = picture(headless, &ways[0].1, SAMPLES)?;
    let mut entries = Vec::new();
    for (name, scene) in ways {
        let own = picture(headless, scene, Samples(1))?;
        let error = LevelError::of(&own, &truth, settings.size_px[0] as usize);
        let splats = headless.count_listed(scene, &camera, settings)?;
        let (name, settings) = ((*name).to_owned(), settings.clone());
        entries.push(Entry { name, scene, settings, subject: HybridWay { splats, error } });
    }
    let what = format!("hybrid, zoom {zoom}");
    let (ways, _) = contest::measure(headless, context, &what, &camera, entries, None)?;
    Ok(HybridView { zoom, ways })
}

/// From afar below 1, of a narrower view above.
fn camera(ball: &Ball, zoom: f64, size_px: [u32; 2]) -> Camera {
    let camera = Camera::fit(ball, size_px, Camera::DEFAULT_FOV_Y_RAD);
    let eye = camera.target + (camera.eye - camera.target) / zoom.min(1.0);
    let fov_y_rad = 2.0 * ((0.5 * camera.fov_y_rad).tan() / zoom.max(1.0)).atan();
    Camera { eye, fov_y_rad, ..camera }
}
