//! The points that limits are measured with: x, y and depth in clip space, size in pixels.

/// So many points of a pixel each, at the image's pixel centers, row by row and from the first again.
pub(super) fn small_points(size_px: [u32; 2], count: usize) -> Vec<[f32; 4]> {
    let [width, height] = size_px.map(|side| side as usize);
    let clip = |i: usize, length: usize| (2.0 * (i as f64 + 0.5) / length as f64 - 1.0) as f32;
    let place = |i: usize| [clip(i % width, width), clip(i / width % height, height), 0.5, 1.0];
    (0..count).map(place).collect()
}

/// Points of a side that cover an image, and their fragments. Points whose center is outside would be clipped, so that
/// the last ones of a row and of a column overlap those before where the side does not divide the image's.
pub(super) fn covering_points(size_px: [u32; 2], side_px: u32) -> (Vec<[f32; 4]>, u64) {
    let half = (side_px / 2).max(1);
    // Where the centers lie, and how many pixels each covers.
    let along = |length: u32| -> Vec<(f32, u64)> {
        (0..length.div_ceil(side_px))
            .map(|i| match side_px {
                1 => (i as f32 + 0.5, 1),
                _ => {
                    let center = (i * side_px + half).min(length - 1);
                    (center as f32, u64::from((center + half).min(length) - center.saturating_sub(half)))
                }
            })
            .collect()
    };
    let (columns, rows) = (along(size_px[0]), along(size_px[1]));
    let clip = |center: f32, length: u32| 2.0 * center / length as f32 - 1.0;
    let points = rows.iter().flat_map(|(y, _)| {
        let place = |(x, _): &(f32, u64)| [clip(*x, size_px[0]), clip(*y, size_px[1]), 0.5, side_px as f32];
        columns.iter().map(place).collect::<Vec<_>>()
    });
    let sum = |all: &[(f32, u64)]| all.iter().map(|(_, pixels)| pixels).sum::<u64>();
    (points.collect(), sum(&columns) * sum(&rows))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_cover_the_image_and_none_is_clipped() {
        let (points, fragments) = covering_points([64, 96], 32);
        assert_eq!((points.len(), fragments), (6, 64 * 96));
        assert_eq!(points[0], [-0.5, -1.0 + 1.0 / 3.0, 0.5, 32.0]);
        // The second point's center would be at 48 of 40 pixels; it is at 39, where it has 17 pixels of the image.
        let (points, fragments) = covering_points([40, 32], 32);
        assert_eq!((points.len(), fragments), (2, (32 + 17) * 32));
        for size in [[1, 1], [33, 7], [1000, 1]] {
            let (points, fragments) = covering_points(size, 32);
            assert!(points.iter().all(|[x, y, ..]| x.abs() <= 1.0 && y.abs() <= 1.0), "{size:?}");
            assert!(fragments >= u64::from(size[0]) * u64::from(size[1]), "{size:?}: {fragments}");
        }
        assert_eq!(covering_points([3, 2], 1).1, 6);
        let small = small_points([4, 2], 9);
        assert_eq!((small[0], small[8]), (small[8], [-0.75, -0.5, 0.5, 1.0]));
        assert_eq!(small[5], [-0.25, 0.5, 0.5, 1.0]);
    }
}
