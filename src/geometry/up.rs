//! The direction that is up, told from a scene's shape: for scans whose files don't say it.
//!
//! Most models have +y up, and most maps and scans +z; a wrong guess of the one is no better than a wrong guess of the other. So
//! +z is taken only where the shape is hardly anything else, and nothing is said of other directions. What is closed is a
//! thing, not a place, and left out. The rules, of which one has to hold for at least [`FEWEST`] splats or triangles:
//!
//! 1. **A place on a map**: x and y are large against the scene's own size, as easting and northing are, and z, a height, is not.
//! 2. **A terrain**: at least 4 times as long along x and along y as along z, but no plane, and 90% of its area slopes by less
//!    than 60° against the ground. A relief of a plaque looks the same, and is then seen obliquely.
//! 3. **Something on the ground**: a floor at the bottom along z, level within 20°, below 60% of the box's area, 10% of all area or more;
//!    what stands on it covers less than half of that in its upper half and less than a quarter of the rim, and 15% of all area is within
//!    20° of upright. A medal has the floor, but no walls; a room has walls at the rim, and so has a stage that is seen from the front, whose
//!    back is no floor.

use glam::{DVec3, Vec3};

use crate::scene::{Bounds, Mesh, Scene, Shapes, Splats};

/// The fewest splats and triangles of which a shape is told.
const FEWEST: usize = 1000;

/// The side of the grid over which a floor is measured.
const CELLS: usize = 16;

/// A direction that is up.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundUp {
    /// Unit, in world space.
    pub direction: DVec3,
    /// What tells it, in words that go on from "because".
    pub because: String,
}

/// A splat or triangle.
struct Piece {
    place: DVec3,
    /// Of the unit normal, without sign.
    upright: f64,
    area: f64,
}

/// +z, where the scene's shape tells that it is up; `None` where it tells nothing.
pub fn up_of_shape(scene: &Scene) -> Option<FoundUp> {
    let splats = scene.objects.iter().filter(|object| !object.closed);
    let meshes = scene.meshes.iter().filter(|object| !object.closed);
    let mut pieces: Vec<Piece> = splats.flat_map(|object| pieces_of_splats(&object.splats)).collect();
    pieces.extend(meshes.flat_map(|object| pieces_of_mesh(&object.mesh)));
    if pieces.len() < FEWEST {
        return None;
    }
    let bounds = pieces.iter().map(|piece| Bounds::of_ball(piece.place, 0.0)).reduce(Bounds::union)?;
    let because = match () {
        () if is_on_a_map(&bounds) => "its x and y are those of a map",
        () if is_terrain(&pieces, &bounds) => "it lies flat as ground does",
        () if stands_on_ground(&pieces, &bounds) => "it stands on a floor",
        () => return None,
    };
    Some(FoundUp { direction: DVec3::Z, because: because.to_owned() })
}

fn pieces_of_splats(splats: &Splats) -> Vec<Piece> {
    let normal = |i: usize| match &splats.shapes {
        Shapes::Disks { normals, .. } => normals.get(i).copied(),
        Shapes::Ellipses { s, t } => s.get(i).zip(t.get(i)).map(|(s, t)| s.cross(*t)),
    };
    let piece = |i: usize, place: &DVec3| {
        let normal = normal(i).and_then(Vec3::try_normalize)?;
        let radius = splats.major_radius(i);
        let area = radius * radius;
        let usable = place.is_finite() && area.is_finite();
        usable.then(|| Piece { place: *place, upright: f64::from(normal.z.abs()), area })
    };
    splats.positions.iter().enumerate().filter_map(|(i, place)| piece(i, place)).collect()
}

fn pieces_of_mesh(mesh: &Mesh) -> Vec<Piece> {
    let piece = |i: usize| {
        let [a, b, c] = mesh.corners(i)?;
        let normal = (b - a).cross(c - a);
        let upright = normal.try_normalize()?.z.abs();
        Some(Piece { place: (a + b + c) / 3.0, upright, area: 0.5 * normal.length() })
    };
    (0..mesh.triangles.len()).filter_map(piece).collect()
}

/// Eastings are from 100 000 to 900 000 metres, northings up to 10 000 000, and heights below 10 000.
fn is_on_a_map(bounds: &Bounds) -> bool {
    let (center, size) = (bounds.center().abs(), 2.0 * bounds.radius());
    let [low, high] = [center.x.min(center.y), center.x.max(center.y)];
    low > 1e4 && high > 1e5 && low > size && center.z < 1e4 && center.z < 0.1 * low
}

fn is_terrain(pieces: &[Piece], bounds: &Bounds) -> bool {
    let extent = bounds.max - bounds.min;
    let flat = extent.x.min(extent.y) >= 4.0 * extent.z && extent.z > 1e-3 * extent.x.max(extent.y);
    flat && share(pieces, |piece| piece.upright > 0.5) >= 0.9
}

fn stands_on_ground(pieces: &[Piece], bounds: &Bounds) -> bool {
    let extent = bounds.max - bounds.min;
    if extent.min_element() <= 0.0 {
        return false;
    }
    let height = |piece: &Piece| (piece.place.z - bounds.min.z) / extent.z;
    let is_floor = |piece: &Piece| piece.upright > 0.94 && height(piece) < 0.15;
    let cells_of = |part: &dyn Fn(&Piece) -> bool| {
        let mut cells = [false; CELLS * CELLS];
        for piece in pieces.iter().filter(|piece| part(piece)) {
            let at = (piece.place - bounds.min) / extent * CELLS as f64;
            let [column, row] = [at.x, at.y].map(|at| (at as usize).min(CELLS - 1));
            if let Some(cell) = cells.get_mut(row * CELLS + column) {
                *cell = true;
            }
        }
        cells
    };
    let (floor, above) = (cells_of(&is_floor), cells_of(&|piece| height(piece) > 0.5));
    let covered = |cells: &[bool]| cells.iter().filter(|cell| **cell).count();
    let is_rim = |cell: &usize| [cell / CELLS, cell % CELLS].iter().any(|at| *at == 0 || *at == CELLS - 1);
    let rim: Vec<bool> =
        above.iter().enumerate().filter(|(cell, _)| is_rim(cell)).map(|(_, cell)| *cell).collect();
    10 * covered(&floor) >= 6 * floor.len()
        && 2 * covered(&above) < covered(&floor)
        && 4 * covered(&rim) < rim.len()
        && share(pieces, is_floor) >= 0.1
        && share(pieces, |piece| piece.upright < 0.34) >= 0.15
}

/// The share of the area in pieces of a kind.
fn share(pieces: &[Piece], kind: impl Fn(&Piece) -> bool) -> f64 {
    let area = |pieces: &mut dyn Iterator<Item = &Piece>| pieces.map(|piece| piece.area).sum::<f64>();
    area(&mut pieces.iter().filter(|piece| kind(piece))) / area(&mut pieces.iter())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        geometry::seams::sphere,
        scene::{Colors, MeshObject, Object},
    };

    /// Disks of radius 0.1 with these centers and normals.
    fn scene(closed: bool, disks: impl Iterator<Item = (DVec3, Vec3)>) -> Scene {
        let (positions, normals): (Vec<DVec3>, Vec<Vec3>) = disks.unzip();
        let radii = vec![0.1; normals.len()];
        let shapes = Shapes::Disks { normals, radii };
        let splats = Splats::new(positions, shapes, Colors::unknown());
        let object = Object { name: String::new(), splats, closed };
        Scene { objects: vec![object], ..Scene::default() }
    }

    fn because(scene: &Scene) -> Option<String> {
        up_of_shape(scene).map(|up| {
            assert_eq!(up.direction, DVec3::Z);
            up.because
        })
    }

    fn square(side: u32) -> impl Iterator<Item = (f64, f64)> {
        (0..side).flat_map(move |y| (0..side).map(move |x| (f64::from(x), f64::from(y))))
    }

    /// Hills of this height on a square of 40.
    fn hills(height: f64) -> impl Iterator<Item = (DVec3, Vec3)> {
        square(40).map(move |(x, y)| {
            let z = height * (0.3 * x).sin() * (0.2 * y).cos();
            (DVec3::new(x, y, z), Vec3::new(0.2, 0.1, 1.0))
        })
    }

    #[test]
    fn terrain_is_flat_and_open() {
        assert_eq!(because(&scene(false, hills(2.0))).unwrap(), "it lies flat as ground does");
        assert_eq!(because(&scene(true, hills(2.0))), None, "a closed thing");
        assert_eq!(because(&scene(false, hills(0.0))), None, "a plane");
        assert_eq!(because(&scene(false, hills(9.0))), None, "a head's half");
        assert_eq!(because(&scene(false, hills(2.0).take(900))), None, "too few");
        let other = hills(2.0).map(|(p, n)| (DVec3::new(p.x, p.z, -p.y), Vec3::new(n.x, n.z, -n.y)));
        assert_eq!(because(&scene(false, other)), None, "terrain with y up");
    }

    #[test]
    fn a_map_has_large_coordinates_and_low_heights() {
        let moved = |by: DVec3| because(&scene(false, hills(30.0).map(move |(p, n)| (p + by, n))));
        assert_eq!(
            moved(DVec3::new(450_000.0, 5_400_000.0, 300.0)).unwrap(),
            "its x and y are those of a map"
        );
        assert_eq!(moved(DVec3::new(450_000.0, 300.0, 5_400_000.0)), None);
        assert_eq!(moved(DVec3::splat(450_000.0)), None);
    }

    /// A house of 12 by 12 by 10 on a floor of 40 by 40, which lies `wide` times as far.
    fn house(wide: f64) -> Vec<(DVec3, Vec3)> {
        let floor = square(40).map(|(x, y)| (DVec3::new(wide * (x - 20.0), wide * (y - 20.0), 0.0), Vec3::Z));
        let walls = square(24).flat_map(|(along, z)| {
            let (along, z) = (0.5 * along - 6.0, 0.5 * z.min(20.0));
            [
                (DVec3::new(along, 6.0, z), Vec3::Y),
                (DVec3::new(along, -6.0, z), Vec3::NEG_Y),
                (DVec3::new(6.0, along, z), Vec3::X),
                (DVec3::new(-6.0, along, z), Vec3::NEG_X),
            ]
        });
        floor.chain(walls).collect()
    }

    #[test]
    fn a_house_stands_on_its_ground_and_a_box_on_nothing() {
        let up = because(&scene(false, house(1.0).into_iter()));
        assert_eq!(up.unwrap(), "it stands on a floor");
        assert_eq!(
            because(&scene(false, house(0.3).into_iter())),
            None,
            "a room, or a stage seen from the front"
        );
        let turned =
            house(1.0).into_iter().map(|(p, n)| (DVec3::new(p.x, p.z, -p.y), Vec3::new(n.x, n.z, -n.y)));
        assert_eq!(because(&scene(false, turned)), None, "with y up");
        let medal = house(1.0).into_iter().filter(|(_, n)| *n == Vec3::Z);
        assert_eq!(because(&scene(false, medal)), None, "no walls");
    }

    #[test]
    fn a_ball_has_no_up() {
        for closed in [false, true] {
            let mesh = MeshObject { name: String::new(), mesh: sphere(5), closed };
            assert_eq!(because(&Scene { meshes: vec![mesh], ..Scene::default() }), None);
        }
    }
}
