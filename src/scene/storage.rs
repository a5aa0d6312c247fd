//! How splats are kept on a device: what changes speed and memory, and the picture by rounding alone: of sums, and of
//! splats where they are packed.

use super::methods::named;

named! {
    /// In which order the splats of an object lie in memory, and are drawn.
    Order {
        /// Along a Z-curve through their centers, so that what is drawn in succession is near each other on the screen too.
        Morton = "morton",
        /// As they were given.
        Input = "input",
    }
}

named! {
    /// In how many bytes a splat is kept.
    SplatFormat {
        /// Disks in 32, ellipses in 48, and 8 for a color of its own: 32-bit floats, and 16-bit fractions for colors.
        Exact = "exact",
        /// Disks in 16, and 4 for a color of its own: normals turn by 0.0037° at most, radii grow by 1.6e-5, roots of colors and
        /// alpha are rounded to 8 bits. Exact stay ellipses, and chunks that have something farther from their thick than 16 times as far
        /// as half of their splats, because fixed steps would move the others.
        Packed = "packed",
    }
}

/// How the splats of a scene are kept on a device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Storage {
    /// In which order.
    pub order: Order,
    /// In how many bytes each.
    pub format: SplatFormat,
}
