//! Nodes of Potree 2 in its encoding `BROTLI`: one column an attribute, one behind the other, compressed together by Brotli (RFC 7932).
//!
//! The numbers of a position, and of a color, stand in a column with their bits in turn (Morton, 1966), from the lowest up, so that neighbors have the first
//! bytes in common: 16 bits of each of three are 48 of 8 bytes. A position's lower halves are in the last 8 of its 16 bytes, the upper ones in the first.

use brotli_decompressor::Decompressor;

use std::io::Read as _;

use crate::load::Limits;

/// Bytes of a position, and of a color.
pub(super) const POSITION_BYTES: u64 = 16;
pub(super) const COLOR_BYTES: u64 = 8;

/// Bytes that are unpacked at once.
const PART_BYTES: usize = 16 << 10;

/// What the bytes of a node hold that has so many.
pub(super) fn unpack(packed: &[u8], bytes: u64, limits: &Limits) -> Result<Vec<u8>, String> {
    let most = limits.unpacked(packed.len());
    if bytes > most {
        return Err(format!(
            "points of {bytes} bytes in {} compressed ones; expected at most {most}",
            packed.len()
        ));
    }
    let mut unpacked = Vec::new();
    // What is behind is nobody's.
    let read = Decompressor::new(packed, PART_BYTES).take(bytes).read_to_end(&mut unpacked);
    match read {
        Ok(_) if unpacked.len() as u64 == bytes => Ok(unpacked),
        Ok(_) => Err(format!("compressed points of {} bytes; expected {bytes}", unpacked.len())),
        Err(_) => Err(format!("Brotli's data is damaged behind {} bytes; expected {bytes}", unpacked.len())),
    }
}

/// The three numbers of a position.
pub(super) fn position(bytes: &[u8]) -> [i32; 3] {
    let (upper, lower) = (three(bytes), three(bytes.get(8..).unwrap_or_default()));
    [0, 1, 2].map(|axis| (u32::from(upper[axis]) << 16 | u32::from(lower[axis])).cast_signed())
}

/// The three numbers of 8 bytes.
pub(super) fn three(bytes: &[u8]) -> [u16; 3] {
    let code = u64::from_le_bytes(bytes.first_chunk().copied().unwrap_or_default());
    [0, 1, 2].map(|axis| every_third(code >> axis))
}

/// The lowest of each three bits, of 48.
fn every_third(code: u64) -> u16 {
    const STEPS: [(u32, u64); 4] =
        [(2, 0x0c30_c30c_30c3), (4, 0xf0_0f00_f00f), (8, 0xff00_00ff), (16, 0xffff)];
    let lowest = code & 0x2492_4924_9249;
    STEPS.iter().fold(lowest, |bits, (by, mask)| (bits | bits >> by) & mask) as u16
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;

    #[test]
    fn bits_in_turn_are_those_of_three_numbers() {
        let mut random = SplitMix(5);
        for round in 0..1000 {
            let wanted = match round {
                0 => [0; 3],
                1 => [i32::MIN, i32::MAX, -1],
                _ => [(); 3].map(|()| random.bits() as i32),
            };
            let half = |shift: u32| {
                let mut code = 0_u64;
                for (bit, axis) in (0..16).flat_map(|bit| (0..3).map(move |axis| (bit, axis))) {
                    code |= u64::from(wanted[axis] as u32 >> (shift + bit) & 1) << (3 * bit + axis as u32);
                }
                code.to_le_bytes()
            };
            assert_eq!(position(&[half(16), half(0)].concat()), wanted);
            assert_eq!(three(&half(0)), wanted.map(|number| number as u16));
        }
    }

    /// A million zeros, as the crate `brotli` (9.1, quality 11) compresses them.
    const ZEROS: [u8; 14] =
        [0x5b, 0xff, 0xff, 0x8f, 0x7f, 0x02, 0x20, 0x1e, 0x0b, 0x04, 0x72, 0xef, 0x1f, 0x00];

    #[test]
    fn what_is_damaged_short_or_beyond_a_limit_is_refused() {
        let limits = Limits { expansion: 0, unpacked_bytes: 1000, ..Limits::DEFAULT };
        let unpack = |bytes, limits: &Limits| unpack(&ZEROS, bytes, limits).map(|all| all.len());
        assert_eq!(unpack(1000, &limits), Ok(1000));
        let words = format!("points of 1001 bytes in {} compressed ones; expected at most 1000", ZEROS.len());
        assert_eq!(unpack(1001, &limits), Err(words));
        let million = 1 << 20;
        assert_eq!(unpack(million, &Limits::DEFAULT), Ok(million as usize));
        let words = "compressed points of 1048576 bytes; expected 1048577";
        assert_eq!(unpack(million + 1, &Limits::DEFAULT), Err(words.to_owned()));
        for end in 0..ZEROS.len() {
            let cut = super::unpack(&ZEROS[..end], million, &Limits::DEFAULT);
            assert!(cut.unwrap_err().contains("expected 1048576"), "{end}");
        }
    }
}
