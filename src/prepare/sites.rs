//! Which splats of an object share a local space.
//!
//! A device has coordinates in f32: half a step of one is up to 2⁻²⁴ of it. So a splat is *at home* in a local space if none of its
//! coordinates there is above 2¹¹ of its smaller half axes: it is then placed within 2⁻¹³ of it, along each axis. A splat that is larger
//! than most is measured by the half axis of most: a wall is looked at from as near as what stands before it. Splats that are not at
//! home where most of an object is get a local space of their own: a second site in the same file, a stray point. What has no such
//! place, a road of many kilometers, becomes *fine*: its coordinates have a second f32, with which 2³⁵ half axes are at
//! home.

use std::ops::Range;

use super::{
    pack::{self, Survey},
    rebase::{Rebase, SAMPLES},
    sequence::Sequence,
};
use crate::scene::{Shapes, SplatFormat, Splats};

/// The farthest that a splat's coordinates may be from its local space's origin, in its smaller half axes.
pub(super) const HOME: f64 = 2048.0;

/// The same of a fine one.
const FINE_HOME: f64 = HOME * 16_777_216.0;

/// A space is for a quarter of the splats that have none yet, or more.
const LEAST_PART: usize = 4;

/// Spaces of an object's piece. What is not at home in any of so many is drawn as exactly as the last can hold it.
const MOST_SITES: usize = 64;

/// Splats with a local space of their own.
pub(super) struct Site {
    pub rebase: Rebase,
    /// Coordinates have two parts.
    pub fine: bool,
    /// Packed, if it can be.
    packed: bool,
    /// The splats' numbers in the input; `None`: all of the piece.
    listed: Option<Vec<usize>>,
}

impl Site {
    /// The facts on some of its splats.
    pub fn survey(&self, splats: &Splats, which: impl Iterator<Item = usize>) -> Survey {
        let survey = Survey { fine: self.fine, ..pack::survey(splats, which, self.rebase) };
        if self.packed { survey.packed().unwrap_or(survey) } else { survey }
    }

    /// How many splats, of a piece.
    pub fn len(&self, piece: &Range<usize>) -> usize {
        self.listed.as_ref().map_or(piece.len(), Vec::len)
    }

    /// The splats at some places of the site.
    pub fn at<'a>(
        &'a self,
        sequence: &'a Sequence,
        piece: &Range<usize>,
        places: Range<usize>,
    ) -> Box<dyn ExactSizeIterator<Item = usize> + 'a> {
        match &self.listed {
            Some(listed) => Box::new(listed[places].iter().copied()),
            None => Box::new(sequence.at(piece.start + places.start..piece.start + places.end)),
        }
    }
}

/// The sites of a piece of an object, in the order of its sequence each. What is to be packed, and can be, is one: it has no more digits
/// anywhere.
pub(super) fn sites(
    splats: &Splats,
    sequence: &Sequence,
    piece: &Range<usize>,
    format: SplatFormat,
) -> Vec<Site> {
    let rebase = Rebase::of(splats, sequence.in_any_order(piece.clone()));
    let packed = format == SplatFormat::Packed;
    let whole = Site { rebase, fine: false, packed, listed: None };
    if packed && whole.survey(splats, sequence.in_any_order(piece.clone())).packed {
        return vec![whole];
    }
    let typical = typical_half_axis(splats, sequence.in_any_order(piece.clone()));
    let is_away = |rebase: &Rebase, i: usize, reach: f64| {
        !is_home(splats, i, rebase, reach, typical) && splats.defect(i).is_none()
    };
    if !sequence.in_any_order(piece.clone()).any(|i| is_away(&rebase, i, HOME)) {
        return vec![whole];
    }
    let mut sites: Vec<Site> = Vec::new();
    let mut rest: Vec<usize> = sequence.at(piece.clone()).collect();
    while !rest.is_empty() {
        let last = sites.len() + 1 == MOST_SITES;
        let mut rebase = Rebase::of(splats, rest.iter().copied());
        let split = |rebase: &Rebase, reach: f64| -> (Vec<usize>, Vec<usize>) {
            rest.iter().partition(|&&i| !is_away(rebase, i, reach))
        };
        let (mut home, mut away) = split(&rebase, HOME);
        let fine = last || home.len() < rest.len().div_ceil(LEAST_PART);
        if fine {
            (home, away) = split(&rebase, FINE_HOME);
        }
        if home.is_empty() {
            // No place in between is anyone's home: the first splat's own is, to the bit.
            rebase =
                Rebase { origin: splats.positions[rest[0]], ..Rebase::of(splats, rest[..1].iter().copied()) };
            (home, away) = split(&rebase, FINE_HOME);
        }
        if last {
            (home, away) = (std::mem::take(&mut rest), Vec::new());
        }
        sites.push(Site { rebase, fine, packed, listed: Some(home) });
        rest = away;
    }
    sites
}

fn is_home(splats: &Splats, i: usize, rebase: &Rebase, reach: f64, typical: f64) -> bool {
    let farthest = (splats.positions[i] - rebase.origin).abs().max_element();
    // Written so that infinity is away.
    farthest <= reach * smaller_half_axis(splats, i).min(typical)
}

/// The median of the smaller half axes of some splats, of as many as are looked at for a local space; infinite without any.
fn typical_half_axis(splats: &Splats, which: impl ExactSizeIterator<Item = usize>) -> f64 {
    let stride = which.len().div_ceil(SAMPLES).max(1);
    let good = which.step_by(stride).filter(|&i| splats.defect(i).is_none());
    let mut axes: Vec<f64> = good.map(|i| smaller_half_axis(splats, i)).collect();
    let middle = axes.len() / 2;
    if axes.is_empty() { f64::INFINITY } else { *axes.select_nth_unstable_by(middle, f64::total_cmp).1 }
}

/// No more than the smaller half axis; of skew tangent vectors their area over the larger.
fn smaller_half_axis(splats: &Splats, i: usize) -> f64 {
    match &splats.shapes {
        Shapes::Disks { radii, .. } => radii[i].into(),
        Shapes::Ellipses { s, t } => {
            let (s, t) = (s[i].as_dvec3(), t[i].as_dvec3());
            s.cross(t).length() / s.length().max(t.length())
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3};

    use super::*;
    use crate::scene::{Colors, Order};

    fn sites_of(positions: Vec<DVec3>, radius: f32) -> Vec<(usize, bool)> {
        let count = positions.len();
        let shapes = Shapes::Disks { normals: vec![Vec3::Z; count], radii: vec![radius; count] };
        let splats = Splats::new(positions, shapes, Colors::Uniform([1.0; 4]));
        let sequence = Sequence::of(&splats, Order::Morton);
        let piece = 0..count;
        let sites = sites(&splats, &sequence, &piece, SplatFormat::Exact);
        let mut all: Vec<usize> = sites
            .iter()
            .flat_map(|site| site.at(&sequence, &piece, 0..site.len(&piece)).collect::<Vec<_>>())
            .collect();
        all.sort_unstable();
        assert!(all.into_iter().eq(0..count), "each splat has one site");
        for site in &sites {
            let reach = if site.fine { FINE_HOME } else { HOME };
            let mut of_site = site.at(&sequence, &piece, 0..site.len(&piece));
            assert!(of_site.all(|i| is_home(&splats, i, &site.rebase, reach, f64::INFINITY)));
        }
        sites.iter().map(|site| (site.len(&piece), site.fine)).collect()
    }

    fn row(count: usize, step: f64, from: DVec3) -> impl Iterator<Item = DVec3> {
        (0..count).map(move |i| from + DVec3::X * (step * i as f64))
    }

    #[test]
    fn a_site_of_its_own_costs_nothing_a_stray_point_little_and_a_long_road_has_fine_coordinates() {
        let far = DVec3::new(5e5, 4.6e6, 3e2);
        assert_eq!(sites_of(row(1000, 0.01, far).collect(), 0.01), [(1000, false)]);
        let stray = row(1000, 0.01, far).chain([DVec3::ZERO]).collect();
        assert_eq!(sites_of(stray, 0.01), [(1000, false), (1, false)]);
        let two = row(1000, 0.01, DVec3::ZERO).chain(row(600, 0.01, DVec3::Y * 1e5)).collect();
        assert_eq!(sites_of(two, 0.01), [(1000, false), (600, false)]);
        assert_eq!(sites_of(row(10_000, 10.0, DVec3::ZERO).collect(), 0.01), [(10_000, true)]);
        // No two in reach of each other, nor of a place in between.
        assert_eq!(sites_of(row(3, 1e15, DVec3::ZERO).collect(), 1e-3).len(), 3);
    }

    #[test]
    fn a_plate_among_grains_is_placed_as_exactly_as_they_are() {
        // Its own local space, rounded to a part of its size, is no home by their measure: its place is the origin, to the bit.
        let mut positions: Vec<DVec3> = row(5, 1e-12, DVec3::ZERO).collect();
        positions.push(DVec3::new(1.0, 3.0, 7.0) * 1.234e11);
        let mut radii = vec![1e-9; 5];
        radii.push(1e12);
        let shapes = Shapes::Disks { normals: vec![Vec3::Z; 6], radii };
        let splats = Splats::new(positions, shapes, Colors::Uniform([1.0; 4]));
        let sites = sites(&splats, &Sequence::of(&splats, Order::Input), &(0..6), SplatFormat::Exact);
        let places: Vec<_> = sites.iter().map(|site| site.listed.clone().unwrap_or_default()).collect();
        assert_eq!(places, [vec![0, 1, 2, 3, 4], vec![5]]);
        assert_eq!(sites[1].rebase.point(splats.positions[5]), DVec3::ZERO);
    }
}
