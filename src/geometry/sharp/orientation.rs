//! Triangles that are turned around against their neighbors, turned back: in many files of parts a few are.

/// Turns triangles around so that any two at an edge pass it in opposite directions: of each part that hangs together by its edges the
/// fewer ones, or those that differ from its first triangle where they are half. How many were turned. Where it can't be done, as on a Möbius
/// strip, some edges stay as they are: those that agree in the input do so still, as far as that goes.
pub(super) fn agree(triangles: &mut [[u32; 3]]) -> usize {
    let mut parts = Parts::of(triangles.len());
    let (differ, agree): (Vec<_>, Vec<_>) = pairs(triangles).into_iter().partition(|(.., differ)| *differ);
    for (a, b, differ) in agree.into_iter().chain(differ) {
        parts.join(a, b, differ);
    }
    let kinds: Vec<(u32, bool)> = (0..triangles.len() as u32).map(|i| parts.root(i)).collect();
    // Of each part, by its first triangle: how many have another direction, and how many there are.
    let mut counts = vec![[0_usize; 2]; triangles.len()];
    for &(root, differs) in &kinds {
        counts[root as usize][0] += usize::from(differs);
        counts[root as usize][1] += 1;
    }
    let mut turned = 0;
    for (triangle, &(root, differs)) in triangles.iter_mut().zip(&kinds) {
        let [others, all] = counts[root as usize];
        if differs == (2 * others <= all) && others > 0 {
            triangle.swap(1, 2);
            turned += 1;
        }
    }
    turned
}

/// The two triangles at each edge that has no more, and whether they pass it in the same direction.
fn pairs(triangles: &[[u32; 3]]) -> Vec<(u32, u32, bool)> {
    let mut sides: Vec<(u32, u32, u32, bool)> = (0..)
        .zip(triangles)
        .flat_map(|(i, &[a, b, c])| {
            [(a, b), (b, c), (c, a)].map(|(from, to)| (from.min(to), from.max(to), i, from > to))
        })
        .collect();
    sides.sort_unstable();
    let of_one_edge = sides.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1));
    let pairs = of_one_edge.filter_map(|sides| match sides {
        [first, second] => Some((first.2, second.2, first.3 == second.3)),
        _ => None,
    });
    pairs.collect()
}

/// Triangles that hang together, each with whether its direction is another one than that of the first of its part.
struct Parts {
    /// One of the same part with a smaller number, or itself; and whether the two differ.
    parents: Vec<(u32, bool)>,
}

impl Parts {
    fn of(count: usize) -> Self {
        Self { parents: (0..count as u32).map(|i| (i, false)).collect() }
    }

    /// The first triangle of a part, and whether this one differs from it.
    fn root(&mut self, triangle: u32) -> (u32, bool) {
        let (mut at, mut differs) = (triangle, false);
        while self.parents[at as usize].0 != at {
            let (parent, by_one) = self.parents[at as usize];
            let (grandparent, by_two) = self.parents[parent as usize];
            // The way to the root becomes shorter for who comes next.
            self.parents[at as usize] = (grandparent, by_one ^ by_two);
            differs ^= by_one ^ by_two;
            at = grandparent;
        }
        (at, differs)
    }

    /// Says of two triangles whether they differ; nothing is changed where it is known whether they do.
    fn join(&mut self, a: u32, b: u32, differ: bool) {
        let ((a, a_differs), (b, b_differs)) = (self.root(a), self.root(b));
        if a != b {
            self.parents[a.max(b) as usize] = (a.min(b), differ ^ a_differs ^ b_differs);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fewer_of_each_part_are_turned() {
        // A tetrahedron, and a strip apart from it, of which a half is turned.
        let good = [
            [0, 2, 1],
            [0, 1, 3],
            [1, 2, 3],
            [2, 0, 3],
            [10, 11, 12],
            [11, 13, 12],
            [12, 13, 14],
            [13, 15, 14],
        ];
        let mut triangles = good;
        assert_eq!((agree(&mut triangles), triangles), (0, good));
        for turned in [&[1][..], &[0], &[6], &[6, 7], &[2, 5]] {
            turned.iter().for_each(|i| triangles[*i].swap(1, 2));
            assert_eq!((agree(&mut triangles), triangles), (turned.len(), good), "{turned:?}");
        }
        // Three of four are most.
        let wrong = [1, 2, 3];
        wrong.iter().for_each(|i| triangles[*i].swap(1, 2));
        assert_eq!(agree(&mut triangles), 1);
        assert_eq!(triangles[0], [0, 1, 2]);
    }

    #[test]
    fn what_has_one_side_stays() {
        // A Möbius strip of five triangles.
        let strip = [[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 0, 4], [4, 0, 1]];
        let mut triangles = strip;
        assert_eq!((agree(&mut triangles), triangles), (0, strip));
    }
}
