//! Triangles that a mesh has twice.

use rayon::prelude::*;

/// What they are, in the words of a note.
pub const REPEATED: &str = "triangles of the same vertices as another";

/// Leaves out triangles of the same three vertices as an earlier one, in whatever order; how many.
pub fn drop_repeated(triangles: &mut Vec<[u32; 3]>) -> usize {
    let sorted = |triangle: &[u32; 3]| {
        let mut sorted = *triangle;
        sorted.sort_unstable();
        sorted
    };
    let mut all: Vec<([u32; 3], u32)> =
        triangles.par_iter().enumerate().map(|(i, t)| (sorted(t), i as u32)).collect();
    all.par_sort_unstable();
    let mut keep = vec![true; triangles.len()];
    for same in all.chunk_by(|a, b| a.0 == b.0) {
        same[1..].iter().for_each(|(_, i)| keep[*i as usize] = false);
    }
    let before = triangles.len();
    let mut keep = keep.iter();
    triangles.retain(|_| *keep.next().unwrap_or(&true));
    before - triangles.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_equal_triangles_stays() {
        let mut triangles = vec![[0, 1, 2], [3, 2, 1], [1, 2, 0], [1, 2, 4], [0, 2, 1], [1, 2, 3]];
        assert_eq!(drop_repeated(&mut triangles), 3);
        assert_eq!(triangles, [[0, 1, 2], [3, 2, 1], [1, 2, 4]]);
        assert_eq!(drop_repeated(&mut Vec::new()), 0);
    }
}
