//! Cameras and scenes of which settings have no picture.

use super::{Camera, Filter, Object, Opacity, Rasterizer, Scene, Settings, Shading, Shapes};
use crate::error::{Error, Result};

/// What meshes are, in a sentence, that are not made splats.
pub(crate) const TRIANGLES: &str = "drawn as triangles";

impl Settings {
    /// Refuses methods that only make something of rays that meet in an eye, where the camera's are parallel.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`].
    pub fn check_camera(&self, camera: &Camera) -> Result<()> {
        let (option, name, why) = match (self.rasterizer, self.filter) {
            _ if !camera.is_orthographic() => return Ok(()),
            (Rasterizer::PerspectivePaper, _) => (
                "--rasterizer",
                self.rasterizer.name(),
                "it is the projective map of rays that meet in an eye",
            ),
            (Rasterizer::AffineCenter | Rasterizer::AffineContour, _) => (
                "--rasterizer",
                self.rasterizer.name(),
                "it approximates a perspective, and parallel rays have none",
            ),
            (Rasterizer::RaycastApproximate, _) => (
                "--rasterizer",
                self.rasterizer.name(),
                "its size of splats goes by their distance from an eye",
            ),
            (_, Filter::AdjustPaper) => {
                ("--filter", self.filter.name(), "its equations have the distance from an eye")
            }
            _ => return Ok(()),
        };
        let problem = format!(
            "{name}: not for an orthographic camera: {why}; use {}",
            if option == "--filter" { "adjust" } else { "perspective" }
        );
        Err(Error::option(option, problem))
    }

    /// Refuses a filter that the splats of an object rule out.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`] for `adjust-paper` where an object has elliptic splats; for lights that are
    /// none, or too many; as [`Self::check_eye_dome`].
    pub fn check_scene(&self, scene: &Scene) -> Result<()> {
        scene.check_lights()?;
        let splats = scene.objects.iter().map(|object| (&object.name, object.splats.colors.opacity()));
        let leveled = scene.leveled.iter().map(|object| (&object.name, object.opacity));
        splats
            .chain(leveled)
            .filter(|(_, opacity)| *opacity == Opacity::Transparent)
            .try_for_each(|(name, _)| self.check_eye_dome(name, "transparent"))?;
        scene.meshes.iter().try_for_each(|mesh| self.check_eye_dome(&mesh.name, TRIANGLES))?;
        let is_elliptic = |object: &Object| matches!(object.splats.shapes, Shapes::Ellipses { .. });
        scene.objects.iter().try_for_each(|object| self.check_object(&object.name, is_elliptic(object)))
    }

    /// Refuses eye-dome lighting of an object of this name that is `what`, and not opaque splats.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`].
    pub fn check_eye_dome(&self, object: &str, what: &str) -> Result<()> {
        if self.shading != Shading::EyeDome {
            return Ok(());
        }
        let expected = match what {
            TRIANGLES => {
                "--representation splats (of a scene file's object, representation = \"splats\"), or another shading"
            }
            _ => "another shading",
        };
        let problem = format!("edl: {object} is {what}, it holds for opaque splats; expected {expected}");
        Err(Error::option("--shading", problem))
    }

    /// Whether an object of this name, whose splats are ellipses or not, can be drawn so.
    ///
    /// # Errors
    /// As [`Self::check_scene`].
    pub fn check_object(&self, object: &str, ellipses: bool) -> Result<()> {
        if self.filter == Filter::AdjustPaper && ellipses {
            let problem =
                format!("adjust-paper: {object} has elliptic splats, it holds for disks; use adjust");
            return Err(Error::option("--filter", problem));
        }
        Ok(())
    }
}
