//! The Z-curve (Morton 1966): cells of a grid that are near each other on it are near each other in space.

/// The most bits of a coordinate: three of them fill 63 bits.
pub const MOST_BITS: u32 = 21;

/// The place of a cell on the curve: the bits of its coordinates in turn, x lowest. Of each coordinate only the lowest
/// [`MOST_BITS`] count.
pub fn place_of_cell([x, y, z]: [u32; 3]) -> u64 {
    spread(x) | spread(y) << 1 | spread(z) << 2
}

/// Moves bit `i` to bit `3 i`: halves are moved apart, then quarters, and so on.
fn spread(coordinate: u32) -> u64 {
    let bits = u64::from(coordinate) & ((1 << MOST_BITS) - 1);
    let bits = (bits | bits << 32) & 0x001f_0000_0000_ffff;
    let bits = (bits | bits << 16) & 0x001f_0000_ff00_00ff;
    let bits = (bits | bits << 8) & 0x100f_00f0_0f00_f00f;
    let bits = (bits | bits << 4) & 0x10c3_0c30_c30c_30c3;
    (bits | bits << 2) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The definition, a bit at a time.
    fn bit_by_bit(cell: [u32; 3]) -> u64 {
        let bit = |i: u32| (u64::from(cell[i as usize % 3]) >> (i / 3) & 1) << i;
        (0..3 * MOST_BITS).map(bit).sum()
    }

    #[test]
    fn every_bit_goes_where_the_definition_has_it() {
        for bit in 0..MOST_BITS {
            for axis in 0..3 {
                let mut cell = [0; 3];
                cell[axis] = 1 << bit;
                assert_eq!(place_of_cell(cell), 1 << (3 * bit + axis as u32), "bit {bit} of axis {axis}");
            }
        }
        for cell in [[0x1f_ffff; 3], [0x15_5555, 0x0a_aaaa, 0x12_3456], [u32::MAX, 0, 1]] {
            assert_eq!(place_of_cell(cell), bit_by_bit(cell), "{cell:x?}");
        }
    }
}
