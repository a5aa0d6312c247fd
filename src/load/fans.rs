//! Polygons, which readers cut as fans around their first corner: right for convex ones, and for others that all of their corners are seen from the first. What
//! is not is cut by its ears here (Meisters, "Polygons Have Ears", 1975), once all positions are known.

use glam::{DVec2, DVec3};

use crate::scene::Mesh;

/// The triangles of a polygon of four corners or more.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fan {
    /// The first of them.
    pub first: u32,
    /// How many there are, two less than corners.
    pub count: u32,
}

impl Fan {
    /// Of the triangles from one on, if they are two or more.
    pub fn of(begin: usize, triangles: &[[u32; 3]]) -> Option<Self> {
        let count = triangles.len().saturating_sub(begin);
        (count >= 2).then_some(Self { first: begin as u32, count: count as u32 })
    }
}

/// Looks at corners that all polygons of a file may take, seconds: of one that is made for it ears take the third power of its corners.
pub(super) const MOST_LOOKS: u64 = 1 << 30;

/// What is taken for no area, as a part of the polygon's: a corner on the line of its neighbors.
const FLAT: f64 = 1e-9;

/// Cuts polygons by their ears whose fans cover what they do not; tells of how many that can't be done, since they cross themselves or so many
/// looks are not enough.
pub(super) fn cut(mesh: &mut Mesh, fans: &[Fan], mut looks: u64) -> u64 {
    let (mut left, mut corners, mut places) = (0, Vec::new(), Vec::new());
    for fan in fans {
        let range = fan.first as usize..(fan.first + fan.count) as usize;
        let Some(triangles) = mesh.triangles.get_mut(range) else { continue };
        let Some(&[first, second, _]) = triangles.first() else { continue };
        corners.clear();
        corners.extend([first, second].into_iter().chain(triangles.iter().map(|triangle| triangle[2])));
        places.clear();
        places.extend(corners.iter().filter_map(|corner| mesh.positions.get(*corner as usize).copied()));
        if places.len() != corners.len() || covers_itself(&places) {
            continue;
        }
        match ears(&places, &mut looks) {
            Some(ears) => {
                triangles.iter_mut().zip(ears).for_each(|(triangle, ear)| *triangle = ear.map(|i| corners[i]))
            }
            None => left += 1,
        }
    }
    left
}

/// Twice its area along its normal, which a polygon has though it is not plane (Newell).
fn area(places: &[DVec3]) -> DVec3 {
    let Some(&origin) = places.first() else { return DVec3::ZERO };
    let next = places.iter().skip(1);
    places.iter().zip(next).map(|(a, b)| (*a - origin).cross(*b - origin)).sum()
}

/// Whether no triangle of its fan is turned away from it. What has no area, or none that is a number, stays as it is.
fn covers_itself(places: &[DVec3]) -> bool {
    let area = area(places);
    let (Some(normal), [first, rest @ ..]) = (area.try_normalize(), places) else { return true };
    let least = -FLAT * area.length();
    rest.windows(2).all(|pair| {
        let [a, b] = [pair[0] - *first, pair[1] - *first];
        let turned = a.cross(b).dot(normal);
        turned.is_nan() || turned >= least
    })
}

/// The triangles of a polygon, by its corners' numbers; `None` where none of its corners is an ear, or not with so many looks.
fn ears(places: &[DVec3], looks: &mut u64) -> Option<Vec<[usize; 3]>> {
    let normal = area(places).try_normalize()?;
    let along = normal.any_orthonormal_vector();
    let across = normal.cross(along);
    let origin = places[0];
    let flat: Vec<DVec2> = places
        .iter()
        .map(|place| DVec2::new((*place - origin).dot(along), (*place - origin).dot(across)))
        .collect();
    let turn = |[a, b, c]: [usize; 3]| (flat[b] - flat[a]).perp_dot(flat[c] - flat[a]);
    let mut left: Vec<usize> = (0..places.len()).collect();
    let mut found = Vec::with_capacity(places.len() - 2);
    while left.len() > 3 {
        let count = left.len();
        let at = |i: usize| left[i % count];
        let mut is_ear = |i: &usize| {
            let ear = [at(i + count - 1), at(*i), at(i + 1)];
            let [a, b, c] = ear;
            // Not another corner's place, which a hole that is cut open has twice.
            let is_within = |p: &usize| {
                let is_other = ear.iter().all(|corner| flat[*corner] != flat[*p]);
                is_other && turn([a, b, *p]) >= 0.0 && turn([b, c, *p]) >= 0.0 && turn([c, a, *p]) >= 0.0
            };
            if turn(ear) <= 0.0 || *looks < count as u64 {
                return false;
            }
            *looks -= count as u64;
            !left.iter().any(is_within)
        };
        // Or one that has no area: it is of no matter where it goes.
        let is_flat = |i: &usize| turn([at(i + count - 1), at(*i), at(i + 1)]) == 0.0;
        let ear = (0..count).find(&mut is_ear).or_else(|| (0..count).find(is_flat))?;
        found.push([at(ear + count - 1), at(ear), at(ear + 1)]);
        left.remove(ear);
    }
    found.push(left.try_into().ok()?);
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{math::random::SplitMix, scene::Colors};

    fn fan(places: &[DVec3]) -> (Mesh, Fan) {
        let triangles: Vec<[u32; 3]> = (1..places.len() as u32 - 1).map(|i| [0, i, i + 1]).collect();
        let fan = Fan { first: 0, count: triangles.len() as u32 };
        (Mesh { positions: places.to_vec(), normals: None, colors: Colors::unknown(), triangles }, fan)
    }

    /// The area of triangles, each by itself, and that of the polygon.
    fn areas(mesh: &Mesh) -> [f64; 2] {
        let of = |triangle: &[u32; 3]| area(&triangle.map(|i| mesh.positions[i as usize])).length();
        [mesh.triangles.iter().map(of).sum(), area(&mesh.positions).length()]
    }

    fn plane(points: &[[i32; 2]]) -> Vec<DVec3> {
        points.iter().map(|[x, y]| DVec3::new(f64::from(*x), f64::from(*y), f64::from(x - 2 * y))).collect()
    }

    #[test]
    fn concave_polygons_are_covered_once_whatever_their_first_corner_is() {
        let u = [[0, 0], [6, 0], [6, 4], [4, 4], [4, 1], [2, 1], [2, 4], [0, 4]];
        let arrow = [[0, 0], [4, 2], [0, 4], [1, 2]];
        let comb =
            [[0, 0], [9, 0], [9, 5], [8, 1], [7, 5], [6, 1], [5, 5], [4, 1], [3, 5], [2, 1], [1, 5], [0, 1]];
        for shape in [&u[..], &arrow, &comb] {
            for start in 0..shape.len() {
                let mut points = shape.to_vec();
                points.rotate_left(start);
                for turned in [false, true] {
                    if turned {
                        points.reverse();
                    }
                    let (mut mesh, fan) = fan(&plane(&points));
                    assert_eq!(cut(&mut mesh, &[fan], MOST_LOOKS), 0, "{points:?}");
                    let [triangles, polygon] = areas(&mesh);
                    assert!((triangles - polygon).abs() < 1e-9, "{points:?}: {triangles} {polygon}");
                    let normal = area(&mesh.positions);
                    let faces =
                        |triangle: &[u32; 3]| area(&triangle.map(|i| mesh.positions[i as usize])).dot(normal);
                    assert!(mesh.triangles.iter().all(|triangle| faces(triangle) >= 0.0));
                }
            }
        }
        let mut random = SplitMix(6);
        for corners in [5, 12, 60, 400] {
            let star: Vec<DVec3> = (0..corners)
                .map(|i| {
                    let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(corners)).sin_cos();
                    (0.2 + random.unit()) * DVec3::new(cos, sin, 0.0)
                })
                .collect();
            let (mut mesh, fan) = fan(&star);
            assert_eq!(cut(&mut mesh, &[fan], MOST_LOOKS), 0);
            let [triangles, polygon] = areas(&mesh);
            assert!((triangles - polygon).abs() < 1e-9, "{corners}: {triangles} {polygon}");
        }
    }

    #[test]
    fn convex_ones_stay_fans_and_what_has_no_ears_is_told() {
        let square = plane(&[[0, 0], [2, 0], [2, 2], [1, 2], [0, 2]]);
        let (mut mesh, of_square) = fan(&square);
        let before = mesh.triangles.clone();
        assert_eq!((cut(&mut mesh, &[of_square], MOST_LOOKS), &mesh.triangles), (0, &before));
        for places in [vec![DVec3::ONE; 6], vec![DVec3::NAN; 5], plane(&[[0, 0], [1, 0], [2, 0], [3, 0]])] {
            let (mut mesh, fan) = fan(&places);
            let before = mesh.triangles.clone();
            assert_eq!((cut(&mut mesh, &[fan], MOST_LOOKS), &mesh.triangles), (0, &before));
        }
        let u = plane(&[[6, 4], [4, 4], [4, 1], [2, 1], [2, 4], [0, 4], [0, 0], [6, 0]]);
        let (mut mesh, fan) = fan(&u);
        let before = mesh.triangles.clone();
        assert_eq!((cut(&mut mesh, &[fan], 7), &mesh.triangles), (1, &before), "too few looks for an ear");
        assert_eq!(cut(&mut mesh, &[fan], MOST_LOOKS), 0);
        assert_ne!(mesh.triangles, before);
        assert_eq!(
            cut(&mut Mesh { triangles: Vec::new(), ..mesh }, &[fan], MOST_LOOKS),
            0,
            "no such triangles"
        );
    }
}
