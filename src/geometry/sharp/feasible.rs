//! Which collapses leave a mesh of which splats can be made.

use glam::{DVec2, DVec3};

use super::{
    around::{Around, Marks},
    collapse::State,
    conic::Conic,
    ellipse::ellipse,
    ridges::Kind,
};

/// Cosine of 60°.
const COS_TURN: f64 = 0.5;

/// A triangle's longest side is no more times as long as the triangle is high, where it was not before: ellipses of thin ones reach far.
const THINNEST: f64 = 16.0;

/// By how much, in radii, a curve may leave the ellipse whose triangle it bounds.
const BEYOND: f64 = 0.02;

/// How near a curve may come to the center of that ellipse, in radii.
const NEAREST: f64 = 0.2;

impl State<'_> {
    /// `piece`: of a ridge, the vertex at its other end, and the curve between the two. `most_error`: by how much ellipses may stand off the surface that did not before.
    pub fn is_feasible(
        &self,
        from: u32,
        to: u32,
        around: &Around,
        marks: &mut Marks,
        piece: Option<(u32, &Conic)>,
        most_error: f64,
    ) -> bool {
        let faces = around.of_vertex(from).iter().map(|i| self.triangles[*i as usize]);
        let shared = faces.clone().filter(|corners| corners.contains(&to)).count();
        let others = around.of_vertex(to).iter().flat_map(|i| self.triangles[*i as usize]);
        let common = marks.common(faces.clone().flatten(), others, [from, to]);
        // A ridge that is a border has one triangle between its ends.
        if shared == 0 || common != shared || (piece.is_none() && shared != 2) {
            return false;
        }
        let moved = |corners: [u32; 3]| corners.map(|vertex| if vertex == from { to } else { vertex });
        let stays = faces.filter(|corners| !corners.contains(&to)).all(|corners| {
            let (old, new) = (corners.map(|i| self.place(i)), moved(corners).map(|i| self.place(i)));
            let [before, after] = [old, new].map(|p| (p[1] - p[0]).cross(p[2] - p[0]));
            let turns = before.dot(after) < COS_TURN * before.length() * after.length();
            let thin = |p: [DVec3; 3], area: DVec3| longest_squared(p) / area.length();
            if turns || thin(new, after) > THINNEST.max(thin(old, before)) {
                return false;
            }
            self.curves_fit(moved(corners), new, piece.map(|(end, conic)| (end, to, conic)))
        });
        let end = piece.map(|(end, _)| end);
        let stands_off = |to: Option<u32>| self.stands_off(from, to, around, end);
        stays
            && (most_error == f64::INFINITY || {
                let after = stands_off(Some(to));
                after <= most_error || after <= stands_off(None)
            })
    }

    /// Whether the curves of a triangle's ridges lie in its ellipse.
    fn curves_fit(&self, corners: [u32; 3], p: [DVec3; 3], piece: Option<(u32, u32, &Conic)>) -> bool {
        let is_smooth = |vertex: u32| self.ridges.kinds[vertex as usize] == Kind::Smooth;
        if corners.iter().filter(|vertex| !is_smooth(**vertex)).count() < 2 {
            return true;
        }
        let Some((center, s, t)) = ellipse(p) else { return false };
        let flat = |p: DVec3| {
            let away = p - center;
            DVec2::new(away.dot(s) / s.length_squared(), away.dot(t) / t.length_squared())
        };
        // Within the rim, and well on its side of the center, from which the side itself is ½ away.
        let fits = |conic: &Conic, side: [DVec3; 2]| {
            let to_side = flat(0.5 * (side[0] + side[1])).normalize_or_zero();
            (1..4).all(|i| {
                let uv = flat(conic.point(f64::from(i) / 4.0));
                uv.length() <= 1.0 + BEYOND && uv.dot(to_side) >= NEAREST
            })
        };
        (0..3).all(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            let side = [p[i], p[(i + 1) % 3]];
            match piece {
                Some((end, to, conic)) if (a, b) == (end, to) || (a, b) == (to, end) => fits(conic, side),
                _ => match self.piece_between(a, b) {
                    Some((chain, place)) => self.links[chain as usize].fitted[place as usize]
                        .is_some_and(|fitted| fits(&fitted.conic, side)),
                    None => true,
                },
            }
        })
    }

    /// The piece between two vertices: its chain, and where in it it begins.
    pub(super) fn piece_between(&self, a: u32, b: u32) -> Option<(u32, u32)> {
        let kinds = [a, b].map(|vertex| self.ridges.kinds[vertex as usize]);
        let from = |chain: u32, place: u32, other: u32| {
            let (vertices, links) = (&self.ridges.chains[chain as usize], &self.links[chain as usize]);
            let (last, next) = (links.last[place as usize], links.next[place as usize]);
            let starts = [(next, place), (last, last)];
            let found = starts.into_iter().find(|(end, _)| vertices.get(*end as usize) == Some(&other));
            found.map(|(_, start)| (chain, start))
        };
        match kinds {
            [Kind::Ridge { chain, place }, Kind::Ridge { .. } | Kind::Corner] => from(chain, place, b),
            [Kind::Corner, Kind::Ridge { chain, place }] => from(chain, place, a),
            [Kind::Corner, Kind::Corner] => {
                let chain = *self.between.get(&(a.min(b), a.max(b)))?;
                let vertices = &self.ridges.chains[chain as usize];
                (self.links[chain as usize].next[0] as usize == vertices.len() - 1).then_some((chain, 0))
            }
            _ => None,
        }
    }
}

fn longest_squared(p: [DVec3; 3]) -> f64 {
    (0..3).map(|i| p[i].distance_squared(p[(i + 1) % 3])).fold(0.0, f64::max)
}
