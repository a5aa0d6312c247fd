//! Into which parts space is cut, found on a sample: at the means of centers, as a hierarchy is (`geometry/hierarchy/split.rs`), down to parts
//! of so few samples that what they stand for fits into memory.

use glam::DVec3;

/// A tree of cuts.
pub(super) struct Partition {
    cells: Vec<Cell>,
    parts: usize,
}

/// A part of space.
pub(super) enum Cell {
    /// Cut, with a cell for each piece.
    Cut(Cut, Vec<usize>),
    /// The part of this number.
    Part(usize),
}

/// How a cell is cut.
#[derive(Clone, Copy, Debug)]
pub(super) enum Cut {
    /// Into octants around a point.
    Octants(DVec3),
    /// In two, below a coordinate along an axis and from it on.
    Halves { axis: usize, at: f64 },
}

impl Cut {
    fn piece_of(self, place: DVec3) -> usize {
        match self {
            Self::Octants(center) => place.cmpge(center).bitmask() as usize,
            Self::Halves { axis, at } => usize::from(place[axis] >= at),
        }
    }

    fn pieces(self) -> usize {
        if matches!(self, Self::Octants(_)) { 8 } else { 2 }
    }

    /// Where the mean leaves more than three quarters in one octant, as an outlier does, halves take its place. `None` where all samples lie at
    /// one place.
    fn of(samples: &mut [DVec3]) -> Option<Self> {
        let octants = Self::Octants(samples.iter().sum::<DVec3>() / samples.len() as f64);
        let mut counts = [0; 8];
        samples.iter().for_each(|sample| counts[octants.piece_of(*sample)] += 1);
        if counts.into_iter().all(|count| 4 * count <= 3 * samples.len()) {
            return Some(octants);
        }
        let [low, high] =
            samples.iter().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], sample| {
                [low.min(*sample), high.max(*sample)]
            });
        let axis = (high - low).max_position();
        let middle = samples.len() / 2;
        let (_, median, _) = samples.select_nth_unstable_by(middle, |a, b| a[axis].total_cmp(&b[axis]));
        let median = median[axis];
        // Of many at the least coordinate, the cut is behind them.
        let at = if median > low[axis] {
            median
        } else {
            samples.iter().map(|sample| sample[axis]).filter(|x| *x > median).fold(f64::INFINITY, f64::min)
        };
        at.is_finite().then_some(Self::Halves { axis, at })
    }
}

impl Partition {
    /// For samples of which a part has so many at most, unless they lie at one place.
    pub fn new(mut samples: Vec<DVec3>, most: usize) -> Self {
        let mut partition = Self { cells: Vec::new(), parts: 0 };
        partition.add(&mut samples, most.max(1));
        partition
    }

    /// Adds a cell and all within it, and gives its number.
    fn add(&mut self, samples: &mut [DVec3], most: usize) -> usize {
        let number = self.cells.len();
        self.cells.push(Cell::Part(self.parts));
        let cut = if samples.len() <= most { None } else { Cut::of(samples) };
        let Some(cut) = cut else {
            self.parts += 1;
            return number;
        };
        samples.sort_by_key(|sample| cut.piece_of(*sample));
        let mut pieces = Vec::with_capacity(cut.pieces());
        let mut rest = samples;
        for piece in 0..cut.pieces() {
            let end = rest.partition_point(|sample| cut.piece_of(*sample) <= piece);
            let (own, after) = rest.split_at_mut(end);
            pieces.push(self.add(own, most));
            rest = after;
        }
        self.cells[number] = Cell::Cut(cut, pieces);
        number
    }

    /// How many parts there are.
    pub fn parts(&self) -> usize {
        self.parts
    }

    /// A cell; that of all space has the number 0.
    pub fn cell(&self, number: usize) -> &Cell {
        &self.cells[number]
    }

    /// The part in which a place lies.
    pub fn part_of(&self, place: DVec3) -> usize {
        let mut cell = 0;
        loop {
            match &self.cells[cell] {
                Cell::Part(part) => return *part,
                Cell::Cut(cut, pieces) => cell = pieces[cut.piece_of(place)],
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;

    fn counts(places: &[DVec3], most: usize) -> Vec<usize> {
        let partition = Partition::new(places.to_vec(), most);
        let mut counts = vec![0; partition.parts()];
        places.iter().for_each(|place| counts[partition.part_of(*place)] += 1);
        counts
    }

    #[test]
    fn no_part_has_more_samples_than_it_may_also_with_outliers() {
        let mut random = SplitMix(3);
        let mut places: Vec<DVec3> =
            (0..5000).map(|_| DVec3::new(random.unit(), random.unit(), 0.0)).collect();
        for far in [None, Some(1e9), Some(-1e30)] {
            places.extend(far.map(DVec3::splat));
            let counts = counts(&places, 100);
            assert!(counts.iter().all(|count| *count <= 100), "{counts:?}");
            // Not many more than are needed.
            assert!(counts.len() < 8 * 50, "{}", counts.len());
            assert_eq!(counts.iter().sum::<usize>(), places.len());
        }
    }

    #[test]
    fn places_that_are_one_are_one_part() {
        let mut places = vec![DVec3::ONE; 1000];
        assert_eq!(counts(&places, 10), [1000]);
        places.push(DVec3::ZERO);
        places.push(2.0 * DVec3::ONE);
        let mut counts = counts(&places, 10);
        counts.sort_unstable();
        assert_eq!(counts, [1, 1, 1000]);
    }
}
