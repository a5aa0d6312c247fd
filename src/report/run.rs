//! One run of the renderer: on what, of what, and what it cost.

use std::{collections::BTreeMap, fmt};

use serde::Serialize;

use super::{FrameTimes, Grid, ModelReport};
use crate::{
    notes::{Note, counted},
    scene::Camera,
};

/// Everything that is needed to understand, repeat and compare a measurement.
#[derive(Clone, Debug, Serialize)]
pub struct RunReport {
    /// The version of surfel.
    pub surfel: String,
    /// The device.
    pub device: DeviceReport,
    /// The settings by the names of their options.
    pub settings: BTreeMap<&'static str, String>,
    /// The camera.
    pub camera: CameraReport,
    /// The scene.
    pub scene: SceneReport,
    /// The steps before the frames, in order of time.
    pub steps: Vec<Step>,
    /// The frames.
    pub frames: FrameTimes,
}

/// A device and its driver.
#[derive(Clone, Debug, Serialize)]
pub struct DeviceReport {
    /// The device's name.
    pub name: String,
    /// The driver's name and version.
    pub driver: String,
    /// The Vulkan version that it offers, such as `1.3.230`.
    pub api_version: String,
    /// Nanoseconds of a timestamp's tick.
    pub timestamp_period_ns: f64,
    /// Valid bits of a timestamp; 0 where there are none.
    pub timestamp_valid_bits: u32,
}

/// A camera with the names and units of a camera file.
#[derive(Clone, Debug, Serialize)]
pub struct CameraReport {
    /// Where the eye is, world space.
    pub eye: [f64; 3],
    /// The point in the middle of the image, world space.
    pub target: [f64; 3],
    /// The direction that is up, world space.
    pub up: [f64; 3],
    /// The vertical field of view in degrees.
    pub fov_deg: Option<f64>,
    /// The height of an orthographic picture, in world units; `None` has a field of view.
    pub orthographic: Option<f64>,
    /// The depth of the near plane in world units.
    pub near: f64,
    /// Of a part of a picture: width and height of the whole in pixels.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub whole_px: Option<[u32; 2]>,
    /// And where the drawn image's corner lies in it, pixels.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corner_px: Option<[f64; 2]>,
}

/// A scene that was drawn.
#[derive(Clone, Debug, Serialize)]
pub struct SceneReport {
    /// Where it came from.
    pub inputs: Vec<InputReport>,
    /// Splats drawn.
    pub splats: u64,
    /// Splats left out because they can't be drawn.
    pub dropped: u64,
    /// Triangles drawn as such.
    pub triangles: u64,
    /// `--order`: that of the splats on the device.
    pub order: &'static str,
    /// `--splat-format`.
    pub splat_format: &'static str,
    /// The points of the world that are the origins of what the device has, one a chunk of splats:
    /// coordinates there are differences from these.
    pub origins: Vec<[f64; 3]>,
    /// Bytes of device memory in buffers of splats and triangles.
    pub splat_bytes: u64,
    /// Bytes of device memory that a frame's own images and buffers share.
    pub transient_bytes: u64,
}

/// One input.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct InputReport {
    /// The file's name, or that of the built-in model.
    pub name: String,
    /// Vertices, where it is a mesh.
    pub vertices: Option<usize>,
    /// Triangles, where it is a mesh.
    pub triangles: Option<usize>,
    /// Splats that can be drawn.
    pub splats: usize,
    /// Splats that can't, and were left out.
    pub dropped: usize,
    /// As what it is drawn: `splats`, `triangles` or `splats and triangles`.
    pub drawn_as: &'static str,
    /// Why it is drawn as that, in words; empty where there is nothing to choose from.
    pub because: String,
    /// What its file holds; `None` for what was made from none.
    pub model: Option<ModelReport>,
    /// What of it is not drawn as its file says it, and what was computed because its file does not say it.
    pub notes: Vec<Note>,
    /// The input and what was done with it, in words.
    pub summary: String,
}

/// Something that is done once before the frames.
#[derive(Clone, Debug, Serialize)]
pub struct Step {
    /// Its name.
    pub name: String,
    /// How long it took, in seconds of the wall clock.
    pub secs: f64,
}

impl From<&Camera> for CameraReport {
    fn from(camera: &Camera) -> Self {
        Self {
            eye: camera.eye.into(),
            target: camera.target.into(),
            up: camera.up.into(),
            fov_deg: (!camera.is_orthographic()).then(|| camera.fov_y_rad.to_degrees()),
            orthographic: camera.orthographic_height,
            near: camera.near(),
            whole_px: camera.window.whole_px,
            corner_px: camera.window.whole_px.map(|_| camera.window.corner_px),
        }
    }
}

impl fmt::Display for RunReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let DeviceReport { name, driver, api_version, .. } = &self.device;
        writeln!(f, "{name}, {driver}, Vulkan {api_version}; {}", counted(self.scene.splats, "splats"))?;
        let steps = Grid::of("", &self.steps)
            .column("before the frames", |step| format!("  {}", step.name))
            .column("seconds", |step| format!("{:.3}", step.secs));
        write!(f, "{}{}", steps.grid(), self.frames)
    }
}
