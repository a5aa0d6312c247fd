//! Guennebaud et al. 2006, figure 5: one model half as polygons, half as splats, and the seam between them.

use glam::DVec3;
use surfel::{
    Error, Result,
    geometry::{Hybrid, HybridOptions, hybrid},
    load::{LoadOptions, Model, builtin::relief_mesh, file_name, load},
    prepare::PreparedScene,
    scene::{Accumulate, Camera, Kernel, Mesh, MeshObject, Object, Scene, Settings, Transition},
};

use super::{
    context::FigureContext,
    raster::Raster,
    sheet::{Panel, Sheet},
};

/// Triangles of the built-in model: so few that splats as large as they are blur the relief, and the seam is seen.
const FEW_TRIANGLES: u64 = 80_000;

/// The field of view over that in which all of the model is seen.
const NEARER: f64 = 0.22;

/// Polygons are on this side of the model's middle: to the right of an oblique line in the view.
const POLYGONS: DVec3 = DVec3::new(0.94, 0.34, 0.0);

/// In radii. With the usual ½ a splat's rim has an eighth of its weight, which is seen where no others lie over it.
const SIGMA: f32 = 0.4;

/// Draws the figure.
///
/// # Errors
/// As those of [`FigureContext`]; a model that can't be loaded, or is no mesh.
pub fn draw(context: &mut FigureContext<'_>) -> Result<Sheet> {
    let (mesh, name) = model(context)?;
    let (sampled, plain) = (split(context, &mesh, true)?, split(context, &mesh, false)?);
    let notes = [text(&name, &mesh, &sampled, &plain), settings_text()];
    let (sampled, plain) = (scene(sampled), scene(plain));
    let ball = sampled.ball().ok_or_else(|| Error::input(&name, "", "has nothing to draw"))?;
    let fit = Camera::fit(&ball, context.size_px, Camera::DEFAULT_FOV_Y_RAD);
    let camera = Camera { fov_y_rad: NEARER * fit.fov_y_rad, ..fit };
    let (sampled, plain) = (context.prepare(&sampled)?, context.prepare(&plain)?);
    let settings = |transition| settings(context.size_px, transition);
    let (naive, smoothed) = (settings(Transition::None), settings(Transition::Color));
    let weights = context.weights(&sampled, &camera, &smoothed)?;
    let weights = Raster { size_px: context.size_px, pixels: weights.into_iter().map(gray).collect() };
    let mut panel =
        |name: &str, caption: &str, scene: &PreparedScene, settings: &Settings| -> Result<Panel> {
            let picture = context.picture(scene, &camera, settings)?;
            Ok(Panel::new(name, caption, picture))
        };
    let panels = vec![
        panel("a) naive", "a seam where polygons and splats meet", &sampled, &naive)?,
        panel("b) smoothed", "splats fade into polygons by the sum of their weights", &sampled, &smoothed)?,
        Panel::new("c) the weights", "their sum; white is 1 and above", weights),
        panel("d) smoothed, edges not sampled", "no splats on the edges where both meet", &plain, &smoothed)?,
    ];
    let title = "Polygons and splats of one surface (Guennebaud et al. 2006, figure 5)";
    Ok(Sheet::new(title, 2, panels, &notes.each_ref().map(String::as_str)))
}

fn model(context: &FigureContext<'_>) -> Result<(Mesh, String)> {
    let Some(path) = context.model else {
        return Ok((relief_mesh(FEW_TRIANGLES), "The built-in relief".to_owned()));
    };
    let model = load(path, &LoadOptions::default(), context.bars);
    context.bars.clear();
    match model?.model {
        Model::Mesh(mesh) => Ok((mesh, file_name(path))),
        other => {
            let contents = other.contents();
            let problem = format!("the file holds {contents}; expected a mesh, to draw its triangles");
            Err(Error::input(path, "", problem))
        }
    }
}

/// Half of it as polygons, half as splats, as many as there are vertices.
fn split(context: &FigureContext<'_>, mesh: &Mesh, sample_edges: bool) -> Result<Hybrid> {
    let d = mesh.bounds().map_or(0.0, |bounds| POLYGONS.dot(bounds.center()));
    let stays = |i: usize| mesh.corners(i).is_some_and(|[a, b, c]| POLYGONS.dot((a + b + c) / 3.0) >= d);
    let vertices = mesh.positions.iter().filter(|position| POLYGONS.dot(**position) < d).count();
    let options = HybridOptions { samples: vertices.max(1) as u64, seed: 0, sample_edges };
    let split = hybrid(mesh, &stays, &options, context.bars);
    context.bars.clear();
    split
}

fn scene(Hybrid { splats, polygons, closed, .. }: Hybrid) -> Scene {
    let splats = Object { name: "splats".to_owned(), splats, closed };
    let polygons = MeshObject { name: "polygons".to_owned(), mesh: polygons, closed };
    // A model of another shape may have all in one half.
    Scene {
        objects: Some(splats).filter(|object| !object.splats.is_empty()).into_iter().collect(),
        meshes: Some(polygons).filter(|object| !object.mesh.triangles.is_empty()).into_iter().collect(),
        ..Scene::default()
    }
}

fn settings(size_px: [u32; 2], transition: Transition) -> Settings {
    Settings {
        size_px,
        transition,
        kernel: Kernel::Gaussian { sigma: SIGMA },
        accumulate: Accumulate::F32,
        ..Settings::default()
    }
}

fn text(name: &str, mesh: &Mesh, sampled: &Hybrid, plain: &Hybrid) -> String {
    format!(
        "{name} has {} triangles. On the right, and below small splats, {} of them are drawn; on the left {} splats: {} on \
         the {} edges where both meet, and {} were left out because they were too close to these. In d) {} splats.",
        mesh.triangles.len(),
        sampled.report.polygons,
        sampled.splats.len(),
        sampled.report.edge_splats,
        sampled.report.transition_edges,
        sampled.report.removed,
        plain.splats.len(),
    )
}

fn settings_text() -> String {
    format!(
        "Gaussian kernel, sigma {SIGMA} radii: the paper's is not known. Shaded with one light at the eye."
    )
}

fn gray(weight: f32) -> [u8; 3] {
    [(255.0 * weight.clamp(0.0, 1.0)).round() as u8; 3]
}
