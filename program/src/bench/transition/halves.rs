//! A mesh half as splats and half as polygons, and the whole as either.

use glam::DVec3;
use surfel::{
    Error, ErrorKind, Result,
    compose::{finish, resampled},
    geometry::{Hybrid, HybridOptions, hybrid, shaded_mesh},
    load::{
        Samples,
        builtin::{self, DEFAULT_SPHERE_TRIANGLES},
        file_name,
    },
    report::InputReport,
    scene::{Mesh, MeshObject, Object, Scene},
};

use super::super::model::Source;
use crate::console::Bars;

/// The scenes.
pub struct Halves {
    /// The model's name.
    pub model: String,
    /// Triangles to the right, splats to the left.
    pub hybrid: Scene,
    /// Splats alone, as densely.
    pub splats: Scene,
    /// Triangles alone.
    pub polygons: Scene,
    /// The hybrid's splats and the whole's.
    pub inputs: Vec<InputReport>,
}

/// The seed of the splats' places: the same each time.
const SEED: u64 = 0;

/// Makes the scenes. `splats`: of the whole.
///
/// # Errors
/// A mesh that has no two halves; more splats than there is memory for.
pub fn make(source: &Source, splats: u64, bars: &Bars) -> Result<Halves> {
    let of_file = |error: Error| match (source, error.kind()) {
        // The library knows no file.
        (Source::Mesh(_, path), ErrorKind::Input { problem, .. }) => Error::input(path, "", problem.as_str()),
        _ => error,
    };
    let built_in;
    let (mesh, model) = match source {
        Source::Mesh(mesh, path) => (mesh, file_name(path)),
        Source::BuiltIn => {
            built_in = builtin::sphere_mesh(DEFAULT_SPHERE_TRIANGLES);
            (&built_in, "built-in sphere".to_owned())
        }
    };
    let both = hybrid_scene(mesh, &model, splats, bars).map_err(of_file)?;
    let samples = Samples { count: splats, seed: SEED };
    let (object, report) = resampled(mesh, model.clone(), samples, bars).map_err(of_file)?;
    let (shaded, found) = shaded_mesh(mesh.clone());
    let whole = MeshObject { name: model.clone(), mesh: shaded, closed: found.closed };
    Ok(Halves {
        model,
        hybrid: both.0,
        splats: Scene::from(object),
        polygons: Scene { meshes: vec![whole], ..Scene::default() },
        inputs: vec![both.1, report],
    })
}

fn hybrid_scene(mesh: &Mesh, name: &str, splats: u64, bars: &Bars) -> Result<(Scene, InputReport)> {
    let Some(middle) = middle(mesh) else {
        return Err(Error::input(name, "", "has no triangle that can be drawn"));
    };
    let options = HybridOptions { samples: splats.div_ceil(2), seed: SEED, sample_edges: true };
    let stays = |i: usize| place(mesh, i).is_some_and(|(x, _)| x >= middle);
    let Hybrid { splats, polygons, closed, .. } = hybrid(mesh, &stays, &options, bars)?;
    if splats.is_empty() || polygons.triangles.is_empty() {
        return Err(Error::input(name, "", "has no two halves: expected triangles to the left and right"));
    }
    let head = format!("{} splats and {} triangles", splats.len(), polygons.triangles.len());
    let object = Object { name: format!("{name}, half"), splats, closed };
    let (object, report) = finish(object, head, None);
    let polygons = MeshObject { name: name.to_owned(), mesh: polygons, closed };
    let scene = Scene { objects: vec![object], meshes: vec![polygons], ..Scene::default() };
    Ok((scene, report))
}

/// Where a triangle is between left and right as the camera sees it, and its area; `None` where it can't be drawn.
fn place(mesh: &Mesh, triangle: usize) -> Option<(f64, f64)> {
    let [a, b, c] = mesh.corners(triangle)?;
    let area = 0.5 * (b - a).cross(c - a).length();
    Some(((a + b + c).dot(DVec3::X) / 3.0, area))
}

/// Where half of the area is to the left.
fn middle(mesh: &Mesh) -> Option<f64> {
    let mut places: Vec<(f64, f64)> = (0..mesh.triangles.len()).filter_map(|i| place(mesh, i)).collect();
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    let half = 0.5 * places.iter().map(|(_, area)| area).sum::<f64>();
    let mut left = 0.0;
    let passes = |(_, area): &&(f64, f64)| {
        left += area;
        left > half
    };
    places.iter().find(passes).map(|(x, _)| *x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_of_the_area_is_on_each_side() {
        let ball = builtin::sphere_mesh(1280);
        let middle_of_ball = middle(&ball).unwrap();
        assert!(middle_of_ball.abs() < 0.1, "{middle_of_ball}");
        let left: f64 = (0..ball.triangles.len())
            .filter_map(|i| place(&ball, i))
            .filter(|(x, _)| *x < middle_of_ball)
            .map(|(_, area)| area)
            .sum();
        assert!((left / (2.0 * std::f64::consts::PI) - 1.0).abs() < 0.1, "{left}");
        // One large triangle to the right of many small ones.
        let mesh = Mesh {
            positions: vec![
                DVec3::ZERO,
                DVec3::X,
                DVec3::Y,
                9.0 * DVec3::X,
                12.0 * DVec3::X,
                9.0 * DVec3::ONE,
            ],
            triangles: vec![[3, 4, 5], [0, 1, 2], [0, 1, 2], [0, 0, 7]],
            ..Mesh::default()
        };
        assert_eq!(middle(&mesh), Some(10.0));
        assert_eq!(middle(&Mesh::default()), None);
    }
}
