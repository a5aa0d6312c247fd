//! A model of few splats, seen so near that single ones are told apart.

use surfel::{
    Error, Result,
    load::{builtin::relief, file_name},
    scene::{Camera, Scene},
};

use super::context::FigureContext;
use crate::{inputs::Inputs, scene::load_scene};

/// Splats of the built-in model: so few that single ones are seen.
const FEW_SPLATS: usize = 12_000;

/// The field of view over that in which all of the model is seen.
const NEARER: f64 = 0.5;

/// The model of a figure that shows single splats.
pub struct CoarseModel {
    pub scene: Scene,
    /// What it is, in words.
    pub what: String,
    pub camera: Camera,
}

impl CoarseModel {
    /// That of the command line, or the built-in one.
    ///
    /// # Errors
    /// A model that can't be loaded, or has no splat.
    pub fn of(context: &FigureContext<'_>) -> Result<Self> {
        let (scene, what) = match context.model {
            Some(path) => {
                let loaded = load_scene(&Inputs::splats_of(vec![path.to_owned()]), context.bars)?;
                let what = format!("{}, {} splats", file_name(path), loaded.scene.splat_count());
                (loaded.scene, what)
            }
            None => {
                let scene = Scene::from(relief(FEW_SPLATS));
                (scene, format!("the built-in relief with {FEW_SPLATS} splats"))
            }
        };
        let ball = scene.ball().ok_or_else(|| Error::input("scene", "", "has no splat"))?;
        let fit = Camera::fit(&ball, context.size_px, Camera::DEFAULT_FOV_Y_RAD);
        let camera = Camera { fov_y_rad: NEARER * fit.fov_y_rad, ..fit };
        Ok(Self { scene, what, camera })
    }
}
