//! What a view refuses of a frame before anything is recorded.

use ash::vk;

use super::{View, frame::ViewFrame};
use crate::{
    error::{Error, Result},
    renderer::Renderer,
    scene::{Camera, DepthOfHost, HostCamera, Settings, Shading},
};

impl View {
    /// The settings that its passes have: the background is the host's picture; where only depth is drawn, nothing shines.
    pub(super) fn settings_of(&self, frame: &ViewFrame<'_>) -> Settings {
        let asked = frame.settings;
        let shading = match asked.shading {
            // Its edges are of its own.
            Shading::EyeDome => asked.shading,
            _ if !self.rendering.has_color() => Shading::Albedo,
            _ => asked.shading,
        };
        Settings { background: None, shading, ..asked.clone() }
    }

    /// Refuses a camera whose depth grows where the rendering's test has it fall: all would be hidden, or nothing; of parallel rays a picture that is
    /// turned over, too.
    pub(super) fn check_order(&self, depth: DepthOfHost) -> Result<()> {
        let nearer_is_greater = match depth {
            DepthOfHost::Perspective { b, .. } => b > 0.0,
            DepthOfHost::Orthographic { b, .. } => b < 0.0,
        };
        match self.rendering.nearer_is_greater() {
            Some(greater) if self.rendering.has_depth() && greater != nearer_is_greater => {
                let (compare, is) =
                    (self.rendering.compare, if nearer_is_greater { "greater" } else { "less" });
                let problem = format!(
                    "{compare:?}, but by the camera's matrices what is nearer has the {is} depth: is depth reversed, the viewport flipped, or the picture a mirror's?"
                );
                Err(Error::option("compare", problem))
            }
            _ => Ok(()),
        }
    }

    /// Refuses a renderer whose pipelines are not the view's, nor, it may be, of its device.
    pub(super) fn check_renderer(&self, renderer: &Renderer) -> Result<()> {
        match renderer.number == self.renderer {
            true => Ok(()),
            false => Err(Error::option("renderer", "is not the one that the view was made with")),
        }
    }

    pub(super) fn check_frame(&self, frame: &ViewFrame<'_>, layered: bool) -> Result<()> {
        let side_px = i64::from(self.device.facts().limits.max_image_side);
        let lies_within = |(at, size): (&i32, &u32)| *at >= 0 && i64::from(*at) + i64::from(*size) <= side_px;
        if !frame.corner_px.iter().zip(&frame.settings.size_px).all(lies_within) {
            let ([x, y], [width, height]) = (frame.corner_px, frame.settings.size_px);
            let problem = format!(
                "{x},{y}: expected {width}x{height} pixels from there on within the host's image, which has at most {side_px} a side"
            );
            return Err(Error::option("corner_px", problem));
        }
        if !layered {
            return Ok(());
        }
        let Some(hides) = &frame.hides else {
            return match self.rendering.has_depth() {
                false => Ok(()),
                true => Err(Error::option(
                    "hides",
                    "something is transparent: expected the depth of what the host has drawn, which hides it pixel by pixel",
                )),
            };
        };
        let holds = |at: i32, side: u32, whole: u32| {
            u64::from(at.unsigned_abs()) + u64::from(side) <= u64::from(whole)
        };
        let ([x, y], [width, height]) = (frame.corner_px, frame.settings.size_px);
        match holds(x, width, hides.extent.width) && holds(y, height, hides.extent.height) {
            true => Ok(()),
            false => {
                let vk::Extent2D { width: w, height: h } = hides.extent;
                let problem = format!("{w}x{h} pixels: expected {width}x{height} from {x},{y} on");
                Err(Error::option("hides", problem))
            }
        }
    }

    /// One of a frame's cameras, and the host's depth; of a mirror's picture the one that shows it turned over.
    pub(super) fn camera_of(frame: &ViewFrame<'_>, camera: &HostCamera) -> Result<(Camera, DepthOfHost)> {
        let size_px = frame.settings.size_px;
        let turned_over = if frame.mirrored { camera.of_mirror() } else { *camera };
        turned_over.camera(size_px).map_err(|error| {
            // What is a camera by itself is none of a mirror's.
            match frame.mirrored && camera.camera(size_px).is_ok() {
                true => Error::option(
                    "mirrored",
                    "the camera's picture is no mirror's: expected one whose x, or y, is turned over",
                ),
                false => error,
            }
        })
    }

    /// The camera of the frame before, where it is another one.
    pub(super) fn camera_before(frame: &ViewFrame<'_>) -> Result<Option<Camera>> {
        let of = |camera: &HostCamera| {
            let refused = |error| Error::option("camera_before", format!("{error}"));
            Ok(Self::camera_of(frame, camera).map_err(refused)?.0)
        };
        frame.camera_before.map(of).transpose()
    }
}
