//! The part of a scene that a picture shows, where few things lie so far away that nothing else would be seen: points at 0,0,0 or of no value in a scan,
//! a splinter of a mesh, a plane without end.

use glam::DVec3;

use crate::scene::{Ball, Scene};

/// Most of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MainPart {
    /// A ball around it.
    pub ball: Ball,
    /// The share of splats and vertices that are in it.
    pub share: f64,
}

/// The share of a scene that is most of it.
const MOST: f64 = 0.85;

/// How many times as large as most of it a whole scene is whose picture shows only that.
const FAR: f64 = 20.0;

/// What is beyond most of a scene belongs to it, up to where nothing is for so many times the distance.
const GAP: f64 = 1.5;

/// So many places tell of all.
const SAMPLES: usize = 1 << 16;

/// As [`MOST`] and [`FAR`], of parts of about one size, as scans of two systems of coordinates: the one of the first place is seen.
const PART: f64 = 0.3;
const APART: f64 = 1000.0;

/// Most of a scene that has this ball, and is far larger than that; of parts that are very far apart the first.
pub fn main_part(scene: &Scene, whole: &Ball) -> Option<MainPart> {
    let places = samples(scene);
    let middle = DVec3::from_array([0, 1, 2].map(|axis: usize| {
        let mut along: Vec<f64> = places.iter().map(|place| place[axis]).collect();
        let half = along.len() / 2;
        if along.is_empty() { 0.0 } else { *along.select_nth_unstable_by(half, f64::total_cmp).1 }
    }));
    let first = *places.first()?;
    around(&places, middle, MOST, whole.radius / FAR)
        .or_else(|| around(&places, first, PART, whole.radius / APART))
}

/// This share of places or more, around a middle, if they are within a radius.
fn around(places: &[DVec3], middle: DVec3, least: f64, within: f64) -> Option<MainPart> {
    let mut distances: Vec<f64> = places.iter().map(|place| place.distance(middle)).collect();
    distances.sort_unstable_by(f64::total_cmp);
    let mut last = ((distances.len() as f64 * least) as usize).min(distances.len().checked_sub(1)?);
    while let (Some(here), Some(next)) = (distances.get(last), distances.get(last + 1))
        && *next <= GAP * here
    {
        last += 1;
    }
    let radius = *distances.get(last)?;
    let share = (last + 1) as f64 / distances.len() as f64;
    let part = MainPart { ball: Ball { center: middle, radius: RIM * radius }, share };
    (radius > 0.0 && radius < within).then_some(part)
}

/// Room for the size of splats, and for places that are no samples.
const RIM: f64 = 1.1;

/// Places of splats and of vertices, evenly from all.
fn samples(scene: &Scene) -> Vec<DVec3> {
    let lists = || {
        let splats = scene.objects.iter().map(|object| &object.splats.positions);
        splats.chain(scene.meshes.iter().map(|object| &object.mesh.positions))
    };
    let step = lists().map(Vec::len).sum::<usize>() / SAMPLES + 1;
    lists().flatten().step_by(step).copied().filter(|place| place.is_finite()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Colors, Object, Shapes, Splats};

    fn part_of(places: Vec<DVec3>) -> Option<MainPart> {
        let count = places.len();
        let shapes = Shapes::Disks { normals: vec![glam::Vec3::Z; count], radii: vec![0.1; count] };
        let splats = Splats::new(places, shapes, Colors::unknown());
        let object = Object { name: String::new(), splats, closed: false };
        let scene = Scene { objects: vec![object], ..Scene::default() };
        main_part(&scene, &scene.ball().unwrap())
    }

    fn line(count: u32, at: f64) -> impl Iterator<Item = DVec3> {
        (0..count).map(move |i| DVec3::new(at + f64::from(i) / f64::from(count), 0.0, 0.0))
    }

    #[test]
    fn few_things_far_away_are_not_what_a_picture_shows() {
        let strays = |count: u32, at: f64| part_of(line(1000, 0.0).chain(line(count, at)).collect());
        let found = strays(100, 1000.0).unwrap();
        assert!((found.share - 1000.0 / 1100.0).abs() < 1e-3, "{found:?}");
        // All of the line, and nothing of what is far away.
        assert!(found.ball.center.x.abs() < 1.0 && (0.5..1.0).contains(&found.ball.radius), "{found:?}");
        assert_eq!(strays(100, 9.0), None, "near enough to be seen beside it");
        assert_eq!(strays(400, 900.0), None, "too many");
        let first = strays(1000, 9000.0).unwrap();
        assert!(first.share == 0.5 && first.ball.center == DVec3::ZERO, "{first:?}");
        assert_eq!(strays(0, 0.0), None);
        // What becomes ever more sparse has no gap.
        let sparse = (0..300).map(|i| DVec3::new(1.0_f64 * 1.05_f64.powi(i), 0.0, 0.0));
        assert_eq!(part_of(line(2000, 0.0).chain(sparse).collect()), None);
        assert_eq!(part_of(vec![DVec3::ONE; 5]), None);
    }
}
