//! The order in which the splats of an object go to the device.
//!
//! Along a Z-curve through their centers by default. Splats that are drawn in succession then cover the same part of the
//! image, whose pixels are in the caches still; and an object that is cut into chunks is cut into compact ones.

use std::ops::Range;

use glam::DVec3;

use super::rebase::Rebase;
use crate::{
    math::morton,
    scene::{Order, Splats},
};

/// Splats farther than this from the thick of an object are ordered as if they were that far, along each axis and in
/// the object's local unit, within which half of its splats are: a stray point must not make the curve's cells coarse.
const REACH: f64 = 16.0;

/// The splats of an object in the order in which they go to the device.
pub(super) struct Sequence {
    count: usize,
    /// `None` is the order of input.
    listed: Option<Vec<u32>>,
    /// All splats of the object.
    is_whole: bool,
}

impl Sequence {
    /// The sequence of an object's splats. Holds 12 bytes a splat on its way, and 4 then. What has no more than 2³² splats can be
    /// ordered; more keep the order of input.
    pub fn of(splats: &Splats, order: Order) -> Self {
        let count = splats.len();
        let listed = match (order, u32::try_from(count)) {
            (Order::Morton, Ok(count)) => Some(along_the_curve(splats, count)),
            (Order::Morton, Err(_)) | (Order::Input, _) => None,
        };
        Self { count, listed, is_whole: true }
    }

    /// Those that are something, and those that are not, in their order each.
    pub fn parted(self, is: impl Fn(usize) -> bool) -> [Self; 2] {
        let all = (0..self.count).map(|place| numbers(self.listed.as_deref(), place..place + 1).next());
        let (those, others) = all.flatten().map(|i| i as u32).partition(|i| is(*i as usize));
        [those, others].map(|listed: Vec<u32>| Self {
            count: listed.len(),
            listed: Some(listed),
            is_whole: false,
        })
    }

    /// How many splats.
    pub fn len(&self) -> usize {
        self.count
    }

    /// The splats at some places of the sequence, as their numbers in the input.
    pub fn at(&self, places: Range<usize>) -> impl ExactSizeIterator<Item = usize> + '_ {
        numbers(self.listed.as_deref(), places)
    }

    /// These splats, in the order of input where they are all there are: memory is read in its own order, and what is
    /// found is the same, bit by bit, whatever the sequence.
    pub fn in_any_order(&self, places: Range<usize>) -> impl ExactSizeIterator<Item = usize> + '_ {
        let all = self.is_whole && places == (0..self.count);
        numbers(self.listed.as_deref().filter(|_| !all), places)
    }
}

fn numbers(listed: Option<&[u32]>, places: Range<usize>) -> impl ExactSizeIterator<Item = usize> {
    places.map(move |place| listed.map_or(place, |listed| listed[place] as usize))
}

/// The numbers of the splats along the curve; those of one cell keep their order, those without a place come last.
fn along_the_curve(splats: &Splats, count: u32) -> Vec<u32> {
    // A key is the cell's place on the curve above the splat's number: no two are equal, so that an unstable sort, which
    // needs no memory, is a stable one of cells. The number takes the bits that it needs, the curve has what is left: at
    // least 10 bits an axis, 14 for a million splats.
    let number_bits = u32::BITS - count.saturating_sub(1).leading_zeros();
    let bits = ((u64::BITS - number_bits) / 3).min(morton::MOST_BITS);
    let rebase = Rebase::of(splats, 0..splats.len());
    let reach = DVec3::splat(REACH);
    let local = |position: DVec3| rebase.point(position).clamp(-reach, reach);
    let finite = splats.positions.iter().filter(|position| position.is_finite());
    let [lo, hi] = finite.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[lo, hi], position| {
        let p = local(*position);
        [lo.min(p), hi.max(p)]
    });
    // Cells are cubes: what is flat is ordered as the plane that it is.
    let cells_an_axis = f64::from(1_u32 << bits);
    // Not divided by 0 where all are at one place.
    let cells_a_unit = cells_an_axis / (hi - lo).max_element().max(1e-300);
    let cell = |position: DVec3| {
        let cell = ((local(position) - lo) * cells_a_unit).min(DVec3::splat(cells_an_axis - 1.0));
        cell.to_array().map(|x| x as u32)
    };
    let last = (1 << (3 * bits)) - 1;
    let mut keys: Vec<u64> = (0_u64..)
        .zip(&splats.positions)
        .map(|(number, position)| {
            let place = if position.is_finite() { morton::place_of_cell(cell(*position)) } else { last };
            place << number_bits | number
        })
        .collect();
    keys.sort_unstable();
    let numbers = (1_u64 << number_bits) - 1;
    keys.into_iter().map(|key| (key & numbers) as u32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        math::random::SplitMix,
        scene::{Colors, Shapes},
    };
    use glam::Vec3;

    fn splats(positions: Vec<DVec3>) -> Splats {
        let count = positions.len();
        let shapes = Shapes::Disks { normals: vec![Vec3::Z; count], radii: vec![0.01; count] };
        Splats::new(positions, shapes, Colors::Uniform([1.0; 4]))
    }

    /// Points evenly spread over the unit sphere, in no order.
    fn shuffled_sphere(count: usize) -> Vec<DVec3> {
        let mut random = SplitMix(7);
        let mut point = || loop {
            let p = DVec3::new(random.unit(), random.unit(), random.unit()) * 2.0 - 1.0;
            if (0.1..1.0).contains(&p.length()) {
                return p.normalize();
            }
        };
        (0..count).map(|_| point()).collect()
    }

    fn order(positions: &[DVec3]) -> Vec<usize> {
        let sequence = Sequence::of(&splats(positions.to_vec()), Order::Morton);
        sequence.at(0..sequence.len()).collect()
    }

    fn mean_step(positions: &[DVec3], order: &[usize]) -> f64 {
        let steps = order.windows(2).map(|pair| positions[pair[0]].distance(positions[pair[1]]));
        steps.sum::<f64>() / (order.len() - 1) as f64
    }

    #[test]
    fn the_order_is_a_permutation_and_always_the_same() {
        let mut positions = shuffled_sphere(5000);
        positions[17].x = f64::NAN;
        positions[4000].y = f64::INFINITY;
        let listed = order(&positions);
        assert_eq!(listed, order(&positions));
        assert_eq!(listed[4998..], [17, 4000], "what has no place comes last");
        let mut sorted = listed;
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..5000));
    }

    #[test]
    fn successive_splats_are_near_each_other() {
        const COUNT: usize = 20_000;
        let positions = shuffled_sphere(COUNT);
        let input: Vec<usize> = (0..COUNT).collect();
        // Any two points of the sphere are 4/3 apart in the mean.
        assert!((mean_step(&positions, &input) - 4.0 / 3.0).abs() < 0.02);
        // A splat has 4π/n of the area. Along a curve without jumps steps would be about as long as the side of such a
        // square; those of the Z-curve add the same again.
        let side = (4.0 * std::f64::consts::PI / COUNT as f64).sqrt();
        let step = mean_step(&positions, &order(&positions)) / side;
        println!("mean step: {step:.2} sides of a splat's own square");
        assert!(step < 2.0, "{step}");
        // One stray point a million radii off must not change that.
        let mut stray = positions;
        stray.push(DVec3::splat(1e6));
        let listed = order(&stray);
        let step_of_others = mean_step(&stray, &listed[..COUNT]) / side;
        assert!(step_of_others < 2.0, "{step_of_others}");
    }

    #[test]
    fn splats_of_one_cell_keep_their_order() {
        // Two places, in turn; the second one comes first on the curve.
        let positions: Vec<DVec3> = (0..101).map(|i| DVec3::X * f64::from(1 - i % 2)).collect();
        let expected: Vec<usize> = (1..101).step_by(2).chain((0..101).step_by(2)).collect();
        assert_eq!(order(&positions), expected);
        // One place, where the curve has no length; and nothing at all.
        assert!(order(&[DVec3::ONE; 33]).into_iter().eq(0..33));
        assert_eq!(order(&[]), [0_usize; 0]);
        assert!(order(&[DVec3::NAN; 3]).into_iter().eq(0..3));
    }

    #[test]
    fn the_order_of_input_is_kept_where_it_is_asked_for_or_does_not_matter() {
        let splats = splats(shuffled_sphere(100));
        let sequence = Sequence::of(&splats, Order::Input);
        assert!(sequence.at(10..100).eq(10..100));
        let sequence = Sequence::of(&splats, Order::Morton);
        assert!(sequence.in_any_order(0..100).eq(0..100));
        assert!(sequence.in_any_order(10..100).eq(sequence.at(10..100)));
    }
}
