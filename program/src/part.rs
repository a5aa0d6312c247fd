//! The part with sharp edges that figures and tables of Ivo et al. 2012 show, and from how near.

use std::path::Path;

use glam::DVec3;
use surfel::{
    Error, Result,
    geometry::sharp::{Clipping, SharpOptions, SharpReport, sharp_splats},
    hard_scenes::parts::bored_block,
    load::{LoadOptions, Model, file_name, load},
    prepare::PreparedScene,
    renderer::{Headless, Wanted},
    scene::{Camera, Mesh, Object, Scene, Settings},
};

use crate::console::Bars;

/// Triangles around the built-in part, and along its fillet.
const BUILT_IN: (u32, u32) = (256, 16);

/// From where it is seen.
const TOWARD_EYE: DVec3 = DVec3::new(0.5, -0.6, 0.62);

/// So many fields of view are tried.
const TRIES: usize = 12;

/// A mesh.
pub struct Part {
    pub mesh: Mesh,
    pub name: String,
}

impl Part {
    /// The one of a file, or the built-in block with a bore and a fillet.
    ///
    /// # Errors
    /// As [`load`]; a file of something else than a mesh.
    pub fn open(path: Option<&Path>, bars: &Bars) -> Result<Self> {
        let Some(path) = path else {
            let (sides, steps) = BUILT_IN;
            return Ok(Self { mesh: bored_block(sides, steps), name: "the built-in part".to_owned() });
        };
        let model = load(path, &LoadOptions::default(), bars);
        bars.clear();
        match model?.model {
            Model::Mesh(mesh) => Ok(Self { mesh, name: file_name(path) }),
            other => {
                let problem =
                    format!("the file holds {}; expected a mesh with sharp edges", other.contents());
                Err(Error::input(path, "", problem))
            }
        }
    }

    /// A scene of so many splats at the most; of one a triangle where no number is given.
    ///
    /// # Errors
    /// As [`sharp_splats`].
    pub fn splats(
        &self,
        count: Option<u64>,
        clipping: Clipping,
        bars: &Bars,
    ) -> Result<(Scene, SharpReport)> {
        let options = SharpOptions { splats: count, clipping, ..SharpOptions::default() };
        let made = sharp_splats(&self.mesh, &options, bars);
        bars.clear();
        let (splats, report) = made?;
        let object = Object { name: self.name.clone(), splats, closed: report.closed };
        Ok((Scene::from(object), report))
    }
}

/// The camera by which a scene covers a share of the image, as far as one is found, and the share that it does.
///
/// # Errors
/// A scene without extent; whatever goes wrong with the device.
pub fn camera_covering(
    headless: &mut Headless,
    (scene, prepared): (&Scene, &PreparedScene),
    settings: &Settings,
    share: f64,
) -> Result<(Camera, f64)> {
    let ball = scene.ball().ok_or_else(|| Error::input("scene", "", "has nothing to draw"))?;
    let fit = Camera::fit(&ball, settings.size_px, Camera::DEFAULT_FOV_Y_RAD);
    let distance = fit.eye.distance(fit.target);
    let all = Camera { eye: fit.target + distance * TOWARD_EYE.normalize(), up: DVec3::Z, ..fit };
    let settings = Settings { background: None, ..settings.clone() };
    let (mut least, mut most) = (0.02_f64, 8.0_f64);
    let mut found = (all, 0.0);
    for _ in 0..TRIES {
        let factor = (least * most).sqrt();
        let half_rad = (factor * (0.5 * all.fov_y_rad).tan()).atan();
        let camera = Camera { fov_y_rad: 2.0 * half_rad, ..all };
        let frame = headless.render(prepared, &camera, &settings, Wanted::PICTURE)?;
        let covered = frame.srgb.iter().filter(|[.., alpha]| *alpha > 127).count();
        let covers = covered as f64 / frame.srgb.len() as f64;
        found = (camera, covers);
        if covers > share {
            least = factor;
        } else {
            most = factor;
        }
    }
    Ok(found)
}
