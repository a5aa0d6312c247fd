//! The direction that is up, told from a scene's shape: for scans whose files don't say it.
//!
//! Most models have +y up, and most maps and scans +z; a wrong guess of the one is no better than a wrong guess of the other. So
//! +z or +y is told only where the shape is hardly anything else, and nothing of other directions. What is closed is a
//! thing, not a place, and left out but for the first rule. The others need [`FEWEST`] splats or triangles; one has to hold of one of the two:
//!
//! 1. **A place on a map**, for +z: x and y are large against the scene's own size, as easting and northing are, and z, a height, is not.
//! 2. **A terrain**: at least 4 times as long along the other two axes as along this one, but no plane, and 90% of its area slopes by less
//!    than 60° against the ground. A relief of a plaque looks the same, and is then seen obliquely.
//! 3. **Something on the ground**: a floor at the bottom along the axis, level within 20°, below 60% of the box's area, 10% of all area or
//!    more; what stands on it covers less than half of that in its upper half and less than a quarter of the rim, and 15% of all area is
//!    within 20° of upright. A medal has the floor, but no walls; a room has walls at the rim, and so has a stage that is seen from the
//!    front, whose back is no floor. A street has them, too: it is 4 times as long as high, and 1½ times as wide.
//! 4. **A thing that stands** ([`stands`]): on a base, on legs or on its open lower edge, and on no other side; only if none of the above holds.

mod stands;

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
    /// Of the unit normal along z, without sign.
    upright: f64,
    /// The same along y.
    upright_in_y: f64,
    area: f64,
}

impl Piece {
    /// Turned about x, so that what was along y is along z.
    fn with_y_as_z(&self) -> Self {
        let DVec3 { x, y, z } = self.place;
        let place = DVec3::new(x, -z, y);
        Self { place, upright: self.upright_in_y, upright_in_y: self.upright, area: self.area }
    }
}

/// +z or +y, where the scene's shape tells that it is up; `None` where it tells nothing.
pub fn up_of_shape(scene: &Scene) -> Option<FoundUp> {
    if scene.bounds().is_some_and(|bounds| is_on_a_map(&bounds)) {
        return Some(FoundUp { direction: DVec3::Z, because: "its x and y are those of a map".to_owned() });
    }
    let pieces = open_pieces(scene)?;
    let along_z = shape_of(&pieces);
    let turned: Vec<Piece> = pieces.iter().map(Piece::with_y_as_z).collect();
    let standing = |pieces: &[Piece]| stands::stands(pieces).then_some("it stands on what is lowest");
    let told = match (along_z, shape_of(&turned)) {
        (None, None) => (standing(&pieces), standing(&turned)),
        told => told,
    };
    let (direction, because) = match told {
        (Some(because), None) => (DVec3::Z, because),
        (None, Some(because)) => (DVec3::Y, because),
        _ => return None,
    };
    Some(FoundUp { direction, because: because.to_owned() })
}

/// What tells that z is up.
fn shape_of(pieces: &[Piece]) -> Option<&'static str> {
    let bounds = bounds_of(pieces)?;
    match () {
        () if is_terrain(pieces, &bounds) => Some("it lies flat as ground does"),
        () if stands_on_ground(pieces, &bounds) => Some("it stands on a floor"),
        () => None,
    }
}

/// What is not closed; `None` where it is too few.
fn open_pieces(scene: &Scene) -> Option<Vec<Piece>> {
    let splats = scene.objects.iter().filter(|object| !object.closed);
    let meshes = scene.meshes.iter().filter(|object| !object.closed);
    let mut pieces: Vec<Piece> = splats.flat_map(|object| pieces_of_splats(&object.splats)).collect();
    pieces.extend(meshes.flat_map(|object| pieces_of_mesh(&object.mesh)));
    (pieces.len() >= FEWEST).then_some(pieces)
}

fn bounds_of(pieces: &[Piece]) -> Option<Bounds> {
    pieces.iter().map(|piece| Bounds::of_ball(piece.place, 0.0)).reduce(Bounds::union)
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
        usable.then(|| Piece {
            place: *place,
            upright: f64::from(normal.z.abs()),
            upright_in_y: f64::from(normal.y.abs()),
            area,
        })
    };
    splats.positions.iter().enumerate().filter_map(|(i, place)| piece(i, place)).collect()
}

fn pieces_of_mesh(mesh: &Mesh) -> Vec<Piece> {
    let piece = |i: usize| {
        let [a, b, c] = mesh.corners(i)?;
        let normal = (b - a).cross(c - a);
        let unit = normal.try_normalize()?.abs();
        let place = (a + b + c) / 3.0;
        Some(Piece { place, upright: unit.z, upright_in_y: unit.y, area: 0.5 * normal.length() })
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
    let is_floor = |piece: &Piece| is_floor(piece, bounds);
    let cells_of = |part: &dyn Fn(&Piece) -> bool| cells_of(pieces, bounds, part);
    let (floor, above) = (cells_of(&is_floor), cells_of(&|piece| height(piece) > 0.5));
    let covered = |cells: &[bool]| cells.iter().filter(|cell| **cell).count();
    let is_rim = |cell: &usize| [cell / CELLS, cell % CELLS].iter().any(|at| *at == 0 || *at == CELLS - 1);
    let rim: Vec<bool> =
        above.iter().enumerate().filter(|(cell, _)| is_rim(cell)).map(|(_, cell)| *cell).collect();
    let [narrow, wide] = [extent.x.min(extent.y), extent.x.max(extent.y)];
    let is_street = wide >= 4.0 * extent.z && narrow >= 1.5 * extent.z;
    10 * covered(&floor) >= 6 * floor.len()
        && 2 * covered(&above) < covered(&floor)
        && (4 * covered(&rim) < rim.len() || is_street)
        && share(pieces, is_floor) >= 0.1
        && share(pieces, |piece| piece.upright < UPRIGHT) >= 0.15
}

/// Cosine of 20°, and sine.
const LEVEL: f64 = 0.94;
const UPRIGHT: f64 = 0.34;

/// The share of the height that is the bottom.
const LOW: f64 = 0.15;

fn is_floor(piece: &Piece, bounds: &Bounds) -> bool {
    piece.upright > LEVEL && piece.place.z - bounds.min.z < LOW * (bounds.max.z - bounds.min.z)
}

/// The cells of a grid over the ground that have something of this part.
fn cells_of(pieces: &[Piece], bounds: &Bounds, part: &dyn Fn(&Piece) -> bool) -> [bool; CELLS * CELLS] {
    let mut cells = [false; CELLS * CELLS];
    for piece in pieces.iter().filter(|piece| part(piece)) {
        let at = (piece.place - bounds.min) / (bounds.max - bounds.min) * CELLS as f64;
        let [column, row] = [at.x, at.y].map(|at| (at as usize).min(CELLS - 1));
        if let Some(cell) = cells.get_mut(row * CELLS + column) {
            *cell = true;
        }
    }
    cells
}

/// The share of the area in pieces of a kind.
fn share(pieces: &[Piece], kind: impl Fn(&Piece) -> bool) -> f64 {
    let area = |pieces: &mut dyn Iterator<Item = &Piece>| pieces.map(|piece| piece.area).sum::<f64>();
    area(&mut pieces.iter().filter(|piece| kind(piece))) / area(&mut pieces.iter())
}

#[cfg(test)]
mod tests;
