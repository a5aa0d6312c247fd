//! A camera as an engine has it: two matrices, of which the picture and the engine's own depth follow.

use glam::{DMat3, DMat4, DQuat, DVec3, DVec4};

use super::{Camera, Window, placement::MIRRORED};
use crate::error::{Error, Result};

/// An engine's camera: any motion and unit, any perspective or orthographic projection with square pixels: off-center, jittered, with y up or down,
/// with depth reversed or not, finite or infinite.
///
/// ```
/// use surfel::{embed::HostCamera, glam::{DVec3, dcamera::rh::{proj::directx, view::look_at_mat4}}};
///
/// // y is up in clip space, as in Direct3D, so that the viewport has a negative height.
/// let camera = HostCamera {
///     view_from_world: look_at_mat4(DVec3::new(0.0, 1.0, 4.0), DVec3::ZERO, DVec3::Y),
///     clip_from_view: directx::perspective_infinite_reverse(0.8, 4.0 / 3.0, 0.1),
///     flips_y: true,
/// };
/// assert!(camera.camera([640, 480]).is_ok());
/// assert!(camera.camera([640, 640]).unwrap_err().to_string().contains("square"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HostCamera {
    /// From world to the engine's view space, whatever its axes and its unit: a motion, and one scale of all directions.
    pub view_from_world: DMat4,
    /// From view to clip space as Vulkan has it: x and y from −w to w, depth from 0 to w.
    pub clip_from_view: DMat4,
    /// The viewport has a negative height (`VK_KHR_maintenance1`), so that clip space's y points up in the picture.
    pub flips_y: bool,
}

/// How an engine's depth follows from a view-space depth z, which is positive in front of the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DepthOfHost {
    /// `a + b / z`.
    Perspective {
        /// Where z is infinite.
        a: f64,
        /// In the world's unit.
        b: f64,
    },
    /// `a + b z`.
    Orthographic {
        /// At the eye.
        a: f64,
        /// By the world's unit.
        b: f64,
    },
}

/// What matrices may be wrong by, as a part of what is right: engines have f32.
const ROUNDING: f64 = 1e-5;

fn refused<T>(problem: impl Into<String>) -> Result<T> {
    Err(Error::option("camera", problem.into()))
}

impl HostCamera {
    /// The camera of a left-handed world, as of Direct3D, Unity or Unreal, whose matrices these are: the same pixels and depths of splats that are
    /// mirrored (`transformed` by `DAffine3::from_scale` of (1, 1, −1)) and placed by [`super::Placement::of_left_handed`].
    #[must_use]
    pub fn of_left_handed(self) -> Self {
        Self { view_from_world: self.view_from_world * MIRRORED, ..self }
    }

    /// The camera whose picture is this one's turned over along x: of a mirror's, which [`Self::camera`] refuses, one that it takes. What is seen in a column is then in the one as far from
    /// the picture's other side.
    #[must_use]
    pub fn of_mirror(self) -> Self {
        Self { clip_from_view: DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0)) * self.clip_from_view, ..self }
    }

    /// The camera that gives a picture of this size, and the engine's depth.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`] for matrices that are not finite, a view that shears or scales differently by direction, a projection that is none, mirrors the
    /// picture, or has pixels that are not square; as [`Camera::validate`].
    pub fn camera(&self, size_px: [u32; 2]) -> Result<(Camera, DepthOfHost)> {
        if !self.view_from_world.is_finite() || !self.clip_from_view.is_finite() {
            return refused("the matrices are not finite");
        }
        let (rotation, eye, view_from_world_scale) = self.motion()?;
        // In the world's unit.
        let clip_from_view = self.clip_from_view * DMat4::from_scale(DVec3::splat(view_from_world_scale));
        let Lens { is_perspective, rows: [x, y, depth], forward } = Lens::of(&clip_from_view)?;
        let y = if self.flips_y { -y } else { y };
        // Offsets of the picture's middle in clip space: beside z in a perspective, beside 1 else.
        let offset = |row: DVec4| if is_perspective { row.z * forward } else { row.w };
        let size = size_px.map(f64::from);
        let focal = [0.5 * size[0] * x.x, 0.5 * size[1] * y.y];
        if (focal[0].abs() / focal[1].abs() - 1.0).abs() > ROUNDING {
            return refused(format!(
                "a pixel is {:.6} times as high as wide: expected square ones, of {}x{} as of the projection, whose aspect is that of \
                 the picture's size in pixels",
                focal[0].abs() / focal[1].abs(),
                size_px[0],
                size_px[1]
            ));
        }
        // The picture's axes in the world: right, down, into it.
        let in_world = |axis: DVec3| rotation.transpose() * axis;
        let (right, down) = (in_world(DVec3::X * focal[0].signum()), in_world(DVec3::Y * focal[1].signum()));
        let into = right.cross(down);
        if is_perspective && into.dot(in_world(DVec3::Z * forward)) < 0.0 {
            return refused(
                "the picture is a mirror's: does y point down in it, or is the viewport flipped? Of a left-handed world see \
                 HostCamera::of_left_handed, of a mirror's view ViewFrame::mirrored",
            );
        }
        // In view-space depths that grow forward.
        let [a, b] = match is_perspective {
            true => [depth.z * forward, depth.w],
            false => [depth.w, depth.z * (rotation * into).z],
        };
        let at = |d: f64| if is_perspective { b / (d - a) } else { (d - a) / b };
        let ends = [at(0.0), at(1.0)];
        let in_front = |z: &f64| *z > 0.0 || !is_perspective;
        let near = ends.into_iter().filter(in_front).fold(f64::INFINITY, f64::min);
        if !near.is_finite() {
            return refused("the projection has no near plane");
        }
        let middle_px = [0, 1].map(|i| 0.5 * size[i] * (1.0 + offset([x, y][i])));
        // Far enough for f64 to tell the direction.
        let reach = 1.0_f64.max(eye.abs().max_element());
        // Rays that are parallel begin anywhere.
        let (eye, near, a) =
            if is_perspective { (eye, near, a) } else { (eye + near * into, 0.0, a + b * near) };
        let camera = Camera {
            eye,
            target: eye + reach * into,
            up: -down,
            fov_y_rad: if is_perspective {
                2.0 * y.y.abs().recip().atan()
            } else {
                Camera::DEFAULT_FOV_Y_RAD
            },
            orthographic_height: (!is_perspective).then(|| 2.0 / y.y.abs()),
            near: Some(near),
            window: Window { whole_px: None, corner_px: [0, 1].map(|i| 0.5 * size[i] - middle_px[i]) },
        };
        camera.validate()?;
        let depth = if is_perspective {
            DepthOfHost::Perspective { a, b }
        } else {
            DepthOfHost::Orthographic { a, b }
        };
        Ok((camera, depth))
    }

    /// The rotation into view space, the eye, and the world's unit in that of view space.
    fn motion(&self) -> Result<(DMat3, DVec3, f64)> {
        let view = &self.view_from_world;
        let linear = DMat3::from_mat4(*view);
        let found = linear.determinant().abs().cbrt();
        // What is no more than rounding is none, so that matrices of engines without one keep their bits.
        let scale = if (found - 1.0).abs() <= ROUNDING { 1.0 } else { found };
        let linear = linear * scale.recip();
        let left = linear.transpose() * linear - DMat3::IDENTITY;
        let is_motion =
            view.row(3) == DVec4::W && left.to_cols_array().iter().all(|part| part.abs() <= ROUNDING);
        if !is_motion {
            return refused("view_from_world shears, or scales differently by direction: expected a motion");
        }
        // A mirrored view has a mirrored projection.
        let mirror = if linear.determinant() < 0.0 {
            DMat3::from_diagonal(DVec3::new(1.0, 1.0, -1.0))
        } else {
            DMat3::IDENTITY
        };
        let rotation = mirror * DMat3::from_quat(DQuat::from_mat3(&(mirror * linear)).normalize());
        Ok((rotation, -(rotation.transpose() * view.w_axis.truncate()) / scale, scale))
    }
}

/// The rows of a projection that say something.
struct Lens {
    is_perspective: bool,
    /// Clip-space x, y and depth, over what w is of z in a perspective.
    rows: [DVec4; 3],
    /// The sign of view-space z in front of the eye, of a perspective.
    forward: f64,
}

impl Lens {
    fn of(clip_from_view: &DMat4) -> Result<Self> {
        let [x, y, depth, w] = [0, 1, 2, 3].map(|i| clip_from_view.row(i));
        // What f32 leaves of a product of matrices is nothing beside what the row says.
        let is_nothing = |part: f64, beside: f64| part.abs() <= ROUNDING * beside.abs();
        let is_perspective = w.z != 0.0 && [w.x, w.y, w.w].iter().all(|part| is_nothing(*part, w.z));
        let is_orthographic = w.w != 0.0 && [w.x, w.y, w.z].iter().all(|part| is_nothing(*part, w.w));
        if !is_perspective && !is_orthographic {
            return refused("clip_from_view is neither a perspective along z nor orthographic");
        }
        let scale = if is_perspective { w.z.abs() } else { w.w };
        let rows = [x, y, depth].map(|row| row / scale);
        let [x, y, depth] = rows;
        // Offsets that the other kind of projection has.
        let beside = if is_perspective { [x.w, y.w] } else { [x.z, y.z] };
        let turns =
            [(x.y, x.x), (y.x, y.y), (beside[0], x.x), (beside[1], y.y), (depth.x, x.x), (depth.y, y.y)];
        if turns.iter().any(|(part, own)| !is_nothing(*part, *own)) {
            return refused("clip_from_view turns or shears: expected a projection along z");
        }
        let has_depth = if is_perspective { depth.w } else { depth.z };
        if x.x == 0.0 || y.y == 0.0 || has_depth == 0.0 {
            return refused("clip_from_view has no extent, or no depth");
        }
        Ok(Self { is_perspective, rows, forward: w.z.signum() })
    }
}

#[cfg(test)]
mod tests;
