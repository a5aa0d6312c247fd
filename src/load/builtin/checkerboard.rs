//! A checkerboard of disks: what low-pass filters are judged by.

use glam::{DVec3, Vec3};

use crate::scene::{Colors, Object, Shapes, Splats};

/// Splats along the side of a black or white field.
pub const CHECKERBOARD_FIELD: usize = 5;

/// A disk's radius in units of the spacing. Disks of 1/√2 just leave no hole; at 1 a point is in π disks in the mean.
pub const CHECKERBOARD_RADIUS: f64 = 1.0;

/// A board of `side` × `side` disks around the origin in the plane z = 0, facing +z, one unit apart; fields of 5×5 of them
/// are black or white (after figure 3 of Guennebaud et al. 2006, which has 600×600 points).
pub fn checkerboard(side: usize) -> Object {
    let middle = 0.5 * (side as f64 - 1.0);
    let indices = || (0..side * side).map(|i| [i % side, i / side]);
    let position = |[column, row]: [usize; 2]| DVec3::new(column as f64 - middle, row as f64 - middle, 0.0);
    let color = |[column, row]: [usize; 2]| {
        let odd = (column / CHECKERBOARD_FIELD + row / CHECKERBOARD_FIELD) % 2 == 1;
        if odd { [1.0; 4] } else { [0.0, 0.0, 0.0, 1.0] }
    };
    let splats = Splats::new(
        indices().map(position).collect(),
        Shapes::Disks {
            normals: vec![Vec3::Z; side * side],
            radii: vec![CHECKERBOARD_RADIUS as f32; side * side],
        },
        Colors::Each(indices().map(color).collect()),
    );
    Object { name: format!("built-in checkerboard of {side}x{side}"), splats, closed: false }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_alternate_in_both_directions_and_the_board_is_centered() {
        let board = checkerboard(20);
        assert_eq!(board.splats.len(), 400);
        let white = |column: usize, row: usize| board.splats.color(row * 20 + column)[0] == 1.0;
        assert!(!white(0, 0) && !white(4, 4) && white(5, 4) && white(4, 5) && !white(5, 5) && !white(10, 0));
        assert_eq!(board.splats.positions[0], DVec3::new(-9.5, -9.5, 0.0));
        assert_eq!(board.splats.positions[399], DVec3::new(9.5, 9.5, 0.0));
        let bounds = board.splats.bounds().unwrap();
        assert!(bounds.center().length() < 1e-12);
    }

    #[test]
    fn it_has_no_hole_between_the_centers() {
        // The farthest point from four neighboring centers is √½ away.
        assert!(CHECKERBOARD_RADIUS > 0.5_f64.sqrt());
        assert_eq!(checkerboard(3).splats.drop_defective().total(), 0);
    }
}
