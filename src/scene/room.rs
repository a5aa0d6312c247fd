//! Room of an object for splats that come later.

use glam::DVec3;

/// Numbers of an object of splats behind those that it is uploaded with, which have nothing yet: [`crate::renderer::Renderer::append`] and
/// [`crate::renderer::Renderer::update`] put splats there. Of an object that has it, [`crate::renderer::Renderer::remove`] takes splats away, its own ones, too.
///
/// The object may be uploaded with no splats at all. Its shapes then say whether it is of disks or of ellipses, and a uniform color with an alpha below 1 that it is transparent.
///
/// A number takes 40 bytes on the device, 56 of ellipses, and 8 more in the host's memory. Behind the last that was ever filled none costs a frame anything.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Room {
    /// How many numbers; with none, splats are only taken away, and put back.
    pub splats: u32,
    /// A place in the world near which they will be: what is farther from it than 2000 times its own smaller half axis is placed less exactly than by 2⁻¹³ of that.
    /// By default the middle of the object, and of none the world's origin.
    pub around: Option<DVec3>,
    /// How many disks will lie over a place of the surface, where they are fewest, as [`crate::embed::DynamicSplats::overlap`] has it. By default as many as in the object,
    /// and of none 2.
    pub overlap: Option<f64>,
}
