//! How splats are kept on a device: what changes speed and memory, and the picture by rounding alone.

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

/// How the splats of a scene are kept on a device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Storage {
    /// In which order.
    pub order: Order,
}
