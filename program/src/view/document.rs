//! What files hold, once they are read.

use std::sync::Arc;

use surfel::{
    Error, Result,
    levels_file::{HOST_BYTES, LevelsFile},
    load::PictureDescription,
    report::InputReport,
    scene::{Ball, Bounds, Camera, Scene, Settings},
};

use super::edits::{self, Edits};
use crate::{hierarchies::megabytes, inputs::Inputs};

/// What files hold.
pub struct Document {
    /// The scene, with the lights that are asked for.
    pub scene: Arc<Scene>,
    /// A ball around it.
    pub ball: Ball,
    /// Those around its things, each by itself.
    pub balls: Vec<Option<Ball>>,
    /// The camera for it.
    pub camera: Camera,
    /// What scene files say of the picture.
    pub picture: PictureDescription,
    /// One an object.
    pub inputs: Vec<InputReport>,
    /// What was read.
    pub files: Inputs,
    /// Files beside the scene, of which pages are read as views need them.
    pub paged: Arc<[LevelsFile]>,
}

impl Document {
    /// No changes of its things.
    pub fn no_edits(&self) -> Edits {
        Edits::none(&self.scene, &self.paged)
    }

    /// The names of its things, and what they are.
    pub fn things(&self) -> Vec<(String, String)> {
        edits::things(&self.scene, &self.paged)
    }

    /// The box around all of it.
    pub fn bounds(&self) -> Option<Bounds> {
        self.scene.bounds().into_iter().chain(self.paged.iter().map(LevelsFile::bounds)).reduce(Bounds::union)
    }

    /// Refuses changes that settings or memory rule out: a file that is changed is read as a whole.
    ///
    /// # Errors
    /// As [`Edits::check`]; [`surfel::ErrorKind::Input`] for a file that is larger than `most_bytes`.
    pub fn check(&self, edits: &Edits, settings: &Settings, most_bytes: u64) -> Result<()> {
        let [each, _] = HOST_BYTES;
        let mut bytes = 0_u64;
        for (file, _) in edits.changed_files(&self.scene, &self.paged) {
            bytes = bytes.saturating_add(file.header().splats.saturating_mul(each));
            if bytes > most_bytes {
                let problem = format!(
                    "{} as a whole; expected at most {} (--budget-memory) for what is transparent or of another size",
                    megabytes(bytes),
                    megabytes(most_bytes)
                );
                return Err(Error::input(file.path(), "", problem));
            }
        }
        edits.check(&self.scene, &self.paged, settings)
    }
}
