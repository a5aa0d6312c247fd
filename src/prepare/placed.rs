//! A prepared scene, and where a frame shows it.

use super::PreparedScene;
use crate::scene::Placement;

/// A prepared scene where a frame shows it. A frame may show several, and one at several places: nothing is uploaded again.
#[derive(Clone, Copy)]
pub struct Placed<'a> {
    /// What is shown.
    pub scene: &'a PreparedScene,
    /// Where.
    pub at: Placement,
}

impl<'a> Placed<'a> {
    /// A scene where its own coordinates say.
    pub fn at_home(scene: &'a PreparedScene) -> Self {
        Self { scene, at: Placement::default() }
    }
}
