//! How splats are kept on a device: speed and memory, and the picture by rounding alone: of sums, and of splats where they are packed.

use super::option::{named, settings};

named! {
    /// The order in which the splats of an object lie in memory, and are drawn.
    Order {
        /// Along a Z-curve through their centers: what is drawn in succession is near each other on the screen too, which is faster.
        Morton = "morton",
        /// As they were given.
        Input = "input",
    }
}

named! {
    /// The bytes in which a splat is kept.
    SplatFormat {
        /// Disks in 32, ellipses in 48, and 8 for a color of its own: 32-bit floats, and 16-bit fractions for colors; 16 more where a
        /// scene is so extended that f32 can't place them.
        Exact = "exact",
        /// Disks in 16, and 4 for a color of its own: normals turn by 0.0037° at most, radii grow by 1.6e-5, roots of colors and
        /// alpha are rounded to 8 bits, which is 0.73 of a level of sRGB at most. Ellipses stay exact, and chunks that have something farther from their thick than 16 times as far
        /// as half of their splats, because fixed steps would move the others.
        Packed = "packed",
    }
}

settings! {
    /// How the splats of a scene are kept on a device.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    Storage {
        /// The order in which splats lie on the device and are drawn; the picture is the same but for the rounding of sums.
        "order" "ORDER" order: Order,
        /// The bytes in which splats lie on the device.
        "splat-format" "FORMAT" format: SplatFormat,
    }
}
