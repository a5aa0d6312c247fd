//! What files hold, once they are read.

use std::{path::PathBuf, sync::Arc};

use surfel::{
    load::PictureDescription,
    report::InputReport,
    scene::{Ball, Camera, Scene},
};

use crate::inputs::Inputs;

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
    /// The file of which pages are to be read as views need them: it is all of the scene.
    pub paged: Option<PathBuf>,
}
