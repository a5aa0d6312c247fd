//! A prepared scene, and where a frame shows it.

use super::PreparedScene;
use crate::{
    error::{Error, Result},
    scene::Placement,
};

/// A prepared scene where a frame shows it. A frame may show several, and one at several places: nothing is uploaded again. What is not in the list is not seen.
///
/// ```no_run
/// use surfel::embed::{Placed, Placement, PreparedScene};
///
/// /// At home, and again beside that, half as large, in red.
/// fn two(scene: &PreparedScene) -> [Placed<'_>; 2] {
///     let beside = Placement { translation: [3.0, 0.0, 0.0].into(), scale: 0.5, ..Placement::default() };
///     [Placed::at_home(scene), Placed { tint: [1.0, 0.1, 0.1, 1.0], id: 1, ..Placed::new(scene, beside) }]
/// }
/// ```
#[derive(Clone, Copy)]
pub struct Placed<'a> {
    /// What is shown.
    pub scene: &'a PreparedScene,
    /// Where.
    pub at: Placement,
    /// Where the frame before showed it, of which motion follows; `None`: there, too.
    pub before: Option<Placement>,
    /// The host's own number of it, for whoever wants to know what is seen in a pixel. Several may have one.
    pub id: u32,
    /// What the scene's linear colors and alphas are multiplied by, 0 to 1 each. An alpha below 1 is for scenes of which all is transparent already: what is
    /// opaque is not drawn in layers, whatever its tint.
    pub tint: [f32; 4],
}

/// The tint that leaves colors as they are.
pub const NO_TINT: [f32; 4] = [1.0; 4];

impl<'a> Placed<'a> {
    /// A scene that stands somewhere, and stood there, as it is colored: number 0.
    pub fn new(scene: &'a PreparedScene, at: Placement) -> Self {
        Self { scene, at, before: None, id: 0, tint: NO_TINT }
    }

    /// Refuses a tint that is none, or would make something transparent that is opaque.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`].
    pub(crate) fn check_tint(&self) -> Result<()> {
        let refused = |what: &str| {
            let [r, g, b, a] = self.tint;
            Err(Error::option("tint", format!("{r},{g},{b},{a}: {what}")))
        };
        if !self.tint.iter().all(|part| (0.0..=1.0).contains(part)) {
            return refused("expected 0 to 1 each");
        }
        let mut transparent = self.scene.chunks.iter().map(|chunk| chunk.transparent);
        let mut of_meshes = self.scene.meshes.iter().map(|mesh| mesh.transparent);
        if self.tint[3] < 1.0 && !(transparent.all(|is| is) && of_meshes.all(|is| is)) {
            return refused("something of the scene is opaque: expected an alpha of 1");
        }
        Ok(())
    }

    /// A scene where its own coordinates say.
    pub fn at_home(scene: &'a PreparedScene) -> Self {
        Self::new(scene, Placement::default())
    }
}
