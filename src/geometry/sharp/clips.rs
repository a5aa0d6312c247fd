//! What ridges cut off the ellipse of a triangle.
//!
//! **Shared curves.** The ellipse of a triangle passes through its corners, so that a ridge at one of its sides begins and ends on the rim, as a
//! clip curve must. Each piece of a ridge has one curve in space, a conic between two vertices (`fit`); its orthogonal projection into the plane
//! of a splat is again a curve of that kind, with the projected control points and the same weights. So the splats on both sides are
//! clipped by the same curve, where the paper fits one in each plane, and the outlines of both meet in its ends and keep to each other
//! between: what is left between them is how far the curve in space is from their planes. Where an ellipse reaches over a ridge elsewhere it is
//! clipped by the part of the same conic within its rim.
//!
//! Ridges are found by walking from the triangle over sides within the ellipse that are none. Where more than two pieces cross the ellipse, those
//! of one ridge become one curve of their own, if it is near them; where that is not enough, the triangle is cut in two across its longest side.

use glam::{DVec2, DVec3};

use super::{
    Clipping,
    conic::Conic,
    ellipse::ellipse,
    fit::fit,
    halves::{Part, halves},
    model::{Model, directed},
    rim::{SHALLOW, STEPS, cut_at_rim, distance_to_side, inside, part_inside},
    standing::Disk,
};
use crate::{
    geometry::clip::removes,
    scene::{Clip, ClipCurve},
};

/// The most triangles that are looked at for one ellipse.
const MOST_TRIANGLES: usize = 64;

/// Cosine of 30°: over a triangle that is bent by more, an ellipse would stick out, though there is no ridge. It ends at the side between them, and where nothing
/// is beyond.
pub(super) const COS_BENT: f64 = 0.866;

/// Cosine of 40°, as of the corners of ridges.
const COS_CORNER: f64 = 0.766;

/// A curve for several pieces is no farther off them, in radii.
const NEAR: f64 = 1e-3;

/// How often a triangle is cut in two.
const MOST_CUTS: u32 = 8;

/// How often, so that its ellipses end where the color steps.
const MOST_CUTS_FOR_COLORS: u32 = 2;

/// The splat of a triangle.
pub(super) struct ClippedEllipse {
    pub center: DVec3,
    pub s: DVec3,
    pub t: DVec3,
    pub clip: Clip,
    /// More curves would have been needed.
    pub crowded: bool,
    /// How far it stands off the surface.
    pub stands_off: f64,
}

impl ClippedEllipse {
    /// A place in its plane, in radii.
    pub fn flat(&self, place: DVec3) -> DVec3 {
        Disk { center: self.center, s: self.s, t: self.t }.flat(place)
    }
}

/// A ridge's piece in the plane of a splat, with the surface on its left.
struct Found {
    from: u32,
    to: u32,
    curve: Conic,
    /// Of the input's ridge.
    line: Vec<DVec3>,
    /// The same in space.
    in_space: Vec<DVec3>,
}

/// Pieces of a ridge one after the other, without a corner between them.
type Run = Vec<Found>;

/// A curve, and the vertices between which its ridge goes.
struct Cut {
    from: u32,
    to: u32,
    curve: ClipCurve,
    /// Directions at its ends.
    ways: [DVec2; 2],
}

/// The ellipses of a triangle: one, or more where one can't be clipped.
pub(super) fn clipped_ellipses(
    model: &Model<'_>,
    triangle: usize,
    clipping: Clipping,
) -> Vec<ClippedEllipse> {
    let corners = model.triangles[triangle];
    let curve = |i: usize| {
        let (from, to) = (corners[i], corners[(i + 1) % 3]);
        model.piece(from, to).map(|piece| directed(piece, model, from).0)
    };
    let p = corners.map(|vertex| model.positions[vertex as usize]);
    let mut open = vec![(Part { p, curves: [0, 1, 2].map(curve) }, 0)];
    let mut made = Vec::new();
    while let Some((part, cuts)) = open.pop() {
        let colors = cuts <= MOST_CUTS_FOR_COLORS;
        let Some(one) = clipped_ellipse(model, triangle, part.p, clipping, colors) else { continue };
        if one.crowded && cuts < MOST_CUTS {
            open.extend(halves(&part, model.normals[triangle]).map(|half| (half, cuts + 1)));
        } else {
            made.push(one);
        }
    }
    made
}

/// The ellipse of a part of a triangle; `None` of one without area. `colors`: whether it ends where the color steps.
fn clipped_ellipse(
    model: &Model<'_>,
    triangle: usize,
    p: [DVec3; 3],
    clipping: Clipping,
    colors: bool,
) -> Option<ClippedEllipse> {
    let (center, s, t) = ellipse(p)?;
    let disk = Disk { center, s, t };
    let flat = |p: DVec3| disk.flat(p);
    let Reached { triangles, found, too_many } = find(model, triangle, &flat, colors);
    if clipping == Clipping::None {
        let stands_off = disk.stands_off(model, p, &triangles, &Clip::None);
        return Some(ClippedEllipse { center, s, t, clip: Clip::None, crowded: false, stands_off });
    }
    let runs = runs(found);
    let all: Vec<Option<Cut>> = match clipping {
        Clipping::None => Vec::new(),
        Clipping::Own => runs.iter().map(own_curve).collect(),
        Clipping::Shared | Clipping::Lines => shared_curves(&runs, &flat),
    };
    let lost = all.iter().any(Option::is_none);
    let (mut clip, crowded) = combined(all.into_iter().flatten().collect());
    if clipping == Clipping::Lines {
        clip = clip.map(|curve| ClipCurve::line(curve.start_rad, curve.end_rad));
    }
    let stands_off = disk.stands_off(model, p, &triangles, &clip);
    Some(ClippedEllipse { center, s, t, clip, crowded: crowded || too_many || lost, stands_off })
}

/// What an ellipse reaches over.
struct Reached {
    /// First its own.
    triangles: Vec<usize>,
    /// The pieces of ridges at them.
    found: Vec<Found>,
    too_many: bool,
}

/// Walks from a triangle within an ellipse.
fn find(model: &Model<'_>, triangle: usize, flat: &dyn Fn(DVec3) -> DVec3, colors: bool) -> Reached {
    let normal = model.normals[triangle];
    let (mut reached, mut next, mut found) = (vec![triangle], 0, Vec::new());
    while next < reached.len() {
        let corners = model.triangles[reached[next]];
        next += 1;
        for i in 0..3 {
            let (from, to) = (corners[i], corners[(i + 1) % 3]);
            if let Some(piece) = model.piece(from, to) {
                let (curve, line) = directed(piece, model, from);
                let flat_line = line.iter().map(|p| flat(*p)).collect();
                found.push(Found { from, to, curve: curve.map(flat), line: flat_line, in_space: line });
                continue;
            }
            let [a, b] = [from, to].map(|vertex| flat(model.positions[vertex as usize]).truncate());
            let within = distance_to_side(a, b) < 1.0 - SHALLOW;
            if !within {
                continue;
            }
            let beyond = model.edges.beyond(from, to);
            let is_flat = |beyond: &usize| model.normals[*beyond].dot(normal) >= COS_BENT;
            let goes_on =
                beyond.filter(|beyond| is_flat(beyond) && !(colors && model.steps(triangle, *beyond)));
            if let Some(beyond) = goes_on {
                if reached.len() < MOST_TRIANGLES && !reached.contains(&beyond) {
                    reached.push(beyond);
                }
            } else {
                let ends = [from, to].map(|vertex| model.positions[vertex as usize]);
                let curve = Conic::line(ends[0], ends[1]).map(flat);
                let line = vec![curve.start, curve.end];
                found.push(Found { from, to, curve, line, in_space: ends.to_vec() });
            }
        }
    }
    let too_many = reached.len() == MOST_TRIANGLES;
    Reached { triangles: reached, found, too_many }
}

/// Puts pieces one behind the other, and cuts them apart at corners. Only those that come into the ellipse.
fn runs(found: Vec<Found>) -> Vec<Run> {
    let mut left: Vec<Found> = found.into_iter().filter(|found| inside(&found.curve).is_some()).collect();
    let mut runs = Vec::new();
    while !left.is_empty() {
        // Begin with one that nothing goes before.
        let first =
            (0..left.len()).find(|&i| !left.iter().any(|other| goes_on(other, &left[i]))).unwrap_or(0);
        let mut run = vec![left.remove(first)];
        while let Some(next) = run.last().and_then(|last| left.iter().position(|next| goes_on(last, next))) {
            run.push(left.remove(next));
        }
        runs.push(run);
    }
    runs
}

/// Whether the second piece begins where the first ends, without a corner.
fn goes_on(first: &Found, second: &Found) -> bool {
    let ways = [first.curve.end - first.curve.middle, second.curve.middle - second.curve.start];
    let [before, after] = ways.map(DVec3::normalize_or_zero);
    first.to == second.from && before.dot(after) > COS_CORNER
}

/// `None` for what no curve was found for.
fn shared_curves(runs: &[Run], flat: &dyn Fn(DVec3) -> DVec3) -> Vec<Option<Cut>> {
    let pieces: usize = runs.iter().map(Vec::len).sum();
    let mut cuts = Vec::new();
    for run in runs {
        if run.len() == 1 || pieces <= 2 {
            let of_piece = |found: &Found| Some(cut(found.from, found.to, &part_inside(&found.curve)?));
            cuts.extend(run.iter().map(of_piece));
        } else {
            cuts.push(joined(run, flat));
        }
    }
    cuts
}

/// One curve for all pieces of a run, fitted in space; `None` where it is not near them.
fn joined(run: &Run, flat: &dyn Fn(DVec3) -> DVec3) -> Option<Cut> {
    let mut line: Vec<DVec3> = run.iter().flat_map(|found| found.in_space.iter().copied()).collect();
    line.dedup();
    let curve = fit(&line)?.conic.map(flat);
    let points: Vec<DVec2> =
        (0..=2 * STEPS).map(|i| curve.point(f64::from(i) / f64::from(2 * STEPS)).truncate()).collect();
    let distance = |p: DVec2| {
        let sides = points.windows(2).map(|side| distance_to_side(side[0] - p, side[1] - p));
        sides.fold(f64::INFINITY, f64::min)
    };
    let places =
        run.iter().flat_map(|found| (0..=4).map(|i| found.curve.point(f64::from(i) / 4.0).truncate()));
    let is_near = places.filter(|p| p.length() < 1.0).all(|p| distance(p) <= NEAR);
    Some(cut(run.first()?.from, run.last()?.to, &part_inside(&curve)?)).filter(|_| is_near)
}

/// One curve for all pieces of a run, fitted in the plane of the splat between the places where its polyline enters and leaves the disk.
fn own_curve(run: &Run) -> Option<Cut> {
    let mut line: Vec<DVec3> = run.iter().flat_map(|found| found.line.iter().copied()).collect();
    line.dedup();
    let fitted = fit(&cut_at_rim(&line)?)?;
    Some(cut(run.first()?.from, run.last()?.to, &fitted.conic))
}

fn cut(from: u32, to: u32, curve: &Conic) -> Cut {
    let [start, middle, end] = [curve.start, curve.middle, curve.end].map(DVec3::truncate);
    let angle = |p: DVec2| p.y.atan2(p.x) as f32;
    let chord = end - start;
    let is_line = chord.perp_dot(middle - start).abs() <= 1e-7 * chord.length();
    let clip = match is_line {
        true => ClipCurve::line(angle(start), angle(end)),
        false => ClipCurve {
            start_rad: angle(start),
            end_rad: angle(end),
            middle: middle.as_vec2(),
            weight: curve.weight as f32,
        },
    };
    Cut { from, to, curve: clip, ways: [middle - start, end - middle].map(DVec2::normalize_or_zero) }
}

/// At most two curves, and how they act together; whether there are more.
fn combined(mut cuts: Vec<Cut>) -> (Clip, bool) {
    let crowded = cuts.len() > 2;
    if crowded {
        let removed = |cut: &Cut| {
            let places =
                (0..400).map(|i| (f64::from(i) / 400.0).sqrt() * DVec2::from_angle(2.4 * f64::from(i)));
            places.filter(|place| removes(&Clip::One(cut.curve), *place)).count()
        };
        cuts.sort_by_cached_key(|cut| std::cmp::Reverse(removed(cut)));
        cuts.truncate(2);
    }
    let clip = match cuts.as_slice() {
        [] => Clip::None,
        [one] => Clip::One(one.curve),
        [a, b, ..] => {
            let turn = |first: &Cut, second: &Cut| first.ways[1].perp_dot(second.ways[0]);
            let bends_right = a.to == b.from && turn(a, b) < 0.0 || b.to == a.from && turn(b, a) < 0.0;
            if bends_right { Clip::Both(a.curve, b.curve) } else { Clip::Either(a.curve, b.curve) }
        }
    };
    (clip, crowded)
}
