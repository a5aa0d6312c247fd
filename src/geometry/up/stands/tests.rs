use super::*;
use crate::math::random::SplitMix;

/// Shapes of which things are made.
#[derive(Clone, Copy)]
enum Solid {
    /// An ellipsoid: its center, and half axes along x, y and z.
    Ball([f64; 3], [f64; 3]),
    /// A box, by two corners.
    Cuboid([f64; 3], [f64; 3]),
}

use Solid::{Ball, Cuboid};

impl Solid {
    fn contains(&self, place: DVec3) -> bool {
        match *self {
            Ball(center, axes) => ((place - DVec3::from(center)) / DVec3::from(axes)).length() < 0.999,
            Cuboid(low, high) => {
                let [low, high] = [low, high].map(DVec3::from);
                (place - low).min(high - place).min_element() > 1e-9
            }
        }
    }

    fn extent(&self) -> DVec3 {
        match *self {
            Ball(_, axes) => 2.0 * DVec3::from(axes),
            Cuboid(low, high) => DVec3::from(high) - DVec3::from(low),
        }
    }

    fn place(&self, random: &mut SplitMix) -> DVec3 {
        let mut at = DVec3::from_array([0; 3].map(|_| random.unit()));
        match *self {
            Ball(center, axes) => {
                let z = 2.0 * at.z - 1.0;
                let around = DVec2::from_angle(std::f64::consts::TAU * at.x) * (1.0 - z * z).sqrt();
                DVec3::from(center) + around.extend(z) * DVec3::from(axes)
            }
            Cuboid(low, _) => {
                let extent = self.extent();
                let faces = [extent.y * extent.z, extent.z * extent.x, extent.x * extent.y];
                let mut pick = random.unit() * faces.iter().sum::<f64>();
                let axis = faces
                    .iter()
                    .position(|area| {
                        pick -= area;
                        pick < 0.0
                    })
                    .unwrap_or(2);
                at[axis] = at[axis].round();
                DVec3::from(low) + at * extent
            }
        }
    }
}

/// About 20 000 places on the outside of solids.
fn places(solids: &[Solid]) -> Vec<DVec3> {
    let mut random = SplitMix(17);
    let area = |solid: &Solid| {
        let DVec3 { x, y, z } = solid.extent();
        x * y + y * z + z * x
    };
    let all: f64 = solids.iter().map(area).sum();
    let of_one = |(i, solid): (usize, &Solid)| {
        let count = (20_000.0 * area(solid) / all) as usize;
        let others: Vec<&Solid> =
            solids.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, o)| o).collect();
        let places = (0..count).map(|_| solid.place(&mut random));
        places.filter(|place| !others.iter().any(|other| other.contains(*place))).collect::<Vec<_>>()
    };
    solids.iter().enumerate().flat_map(of_one).collect()
}

fn pieces(places: &[DVec3]) -> Vec<Piece> {
    places.iter().map(|place| Piece { place: *place, upright: 0.0, upright_in_y: 0.0, area: 1.0 }).collect()
}

/// Whether something stands along z; along y, as it lies; and, turned by a right angle so that it has y up, along z and along y.
fn told(places: &[DVec3]) -> [bool; 4] {
    let lying: Vec<DVec3> = places.iter().map(|place| DVec3::new(place.x, place.z, -place.y)).collect();
    let along = |places: &[DVec3]| {
        let pieces = pieces(places);
        [stands(&pieces), stands(&pieces.iter().map(Piece::with_y_as_z).collect::<Vec<_>>())]
    };
    let [[z, y], [lying_z, lying_y]] = [along(places), along(&lying)];
    [z, y, lying_z, lying_y]
}

const STANDS: [bool; 4] = [true, false, false, true];
const UNCLEAR: [bool; 4] = [false; 4];

/// A head on a neck and shoulders.
fn head() -> Vec<Solid> {
    let nose = Ball([0.0, 0.42, 1.0], [0.08, 0.15, 0.12]);
    vec![Ball([0.0, 0.0, 1.0], [0.35, 0.45, 0.5]), nose, Ball([0.0, 0.0, 0.25], [0.6, 0.35, 0.3])]
}

fn legs(thick: f64, high: f64, x: f64, y: f64) -> impl Iterator<Item = Solid> {
    [[-x, -y], [x, -y], [-x, y], [x, y]]
        .into_iter()
        .map(move |[x, y]| Cuboid([x - thick, y - thick, 0.0], [x + thick, y + thick, high]))
}

#[test]
fn busts_statues_and_animals_stand_and_have_one_up() {
    let base = Cuboid([-0.35, -0.25, -0.3], [0.35, 0.25, 0.05]);
    let bust: Vec<Solid> = head().into_iter().chain([base]).collect();
    assert_eq!(told(&places(&bust)), STANDS, "a bust");
    let cut: Vec<DVec3> = places(&head()).into_iter().filter(|place| place.z > 0.25).collect();
    assert_eq!(told(&cut), STANDS, "a bust that is open below");
    let noisy: Vec<DVec3> = {
        let mut random = SplitMix(3);
        let mut noise = || DVec3::from_array([0; 3].map(|_| 0.012 * (random.unit() - 0.5)));
        places(&bust).into_iter().map(|place| place + noise()).collect()
    };
    assert_eq!(told(&noisy), STANDS, "noise");
    let strays = [noisy, vec![DVec3::new(0.0, 3.0, -9.0); 20]].concat();
    assert_eq!(told(&strays), STANDS, "strays below");
    let body = [Ball([0.0, 0.0, 0.9], [0.28, 0.7, 0.3]), Ball([0.0, 0.9, 1.25], [0.15, 0.3, 0.17])];
    let animal: Vec<Solid> = body.into_iter().chain(legs(0.07, 0.8, 0.18, 0.5)).collect();
    assert_eq!(told(&places(&animal)), STANDS, "an animal");
    let car = [Ball([0.0, 0.0, 0.6], [0.85, 2.1, 0.4]), Ball([0.0, -0.2, 0.9], [0.75, 1.2, 0.55])];
    let car: Vec<Solid> = car.into_iter().chain(legs(0.12, 0.5, 0.6, 1.3)).collect();
    assert_eq!(told(&places(&car)), STANDS, "a car");
}

#[test]
fn what_stands_on_any_side_or_was_seen_from_one_has_no_up() {
    let one = |solid: Solid| told(&places(&[solid]));
    assert_eq!(one(Ball([0.0; 3], [1.0; 3])), UNCLEAR, "a ball");
    assert_eq!(one(Ball([0.0; 3], [1.0, 0.7, 0.5])), UNCLEAR, "an egg");
    assert_eq!(one(Cuboid([0.0; 3], [1.0; 3])), UNCLEAR, "a cube");
    assert_eq!(one(Cuboid([0.0; 3], [1.0, 0.8, 2.0])), UNCLEAR, "a box");
    let table = Cuboid([-0.8, -0.45, 0.7], [0.8, 0.45, 0.74]);
    let table: Vec<Solid> = legs(0.04, 0.7, 0.7, 0.35).chain([table]).collect();
    assert_eq!(told(&places(&table)), UNCLEAR, "a table, which lies on its top as well");
    // The front of a head with y up, as a depth camera sees it: a level rim all around.
    let seen: Vec<DVec3> = places(&head()).into_iter().filter(|place| place.y > 0.05).collect();
    let as_seen: Vec<DVec3> = seen.iter().map(|place| DVec3::new(-place.x, place.z, place.y)).collect();
    assert!(!stands(&pieces(&as_seen)), "a face");
    // A mask on a wall.
    let mask = [Ball([0.0, 0.0, 0.0], [0.5, 0.7, 0.3]), Ball([0.0, 0.0, 0.3], [0.08, 0.15, 0.12])];
    let mask: Vec<DVec3> = places(&mask).into_iter().filter(|place| place.z > 0.0).collect();
    let back = places(&[Cuboid([-0.5, -0.7, -0.001], [0.5, 0.7, 0.0])]);
    let back = back.into_iter().filter(|place| (place.x / 0.5).hypot(place.y / 0.7) < 1.0);
    assert!(!stands(&pieces(&mask.into_iter().chain(back).collect::<Vec<_>>())), "a mask");
}

#[test]
fn what_has_no_extent_stands_on_nothing() {
    for places in [vec![], vec![DVec3::ONE; 2000], (0..2000).map(|i| DVec3::X * f64::from(i)).collect()] {
        assert_eq!(told(&places), UNCLEAR);
    }
    let flat: Vec<DVec3> = (0..2500).map(|i| DVec3::new(f64::from(i % 50), f64::from(i / 50), 0.0)).collect();
    assert_eq!(told(&flat), UNCLEAR);
}
