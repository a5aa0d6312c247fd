//! Where a scene stands in the world of a frame.

use glam::{DMat3, DMat4, DQuat, DVec3, DVec4};

use super::Camera;
use crate::error::{Error, Result};

/// A similarity from a scene's own space to the world: turned, then scaled alike in all directions, then moved. The default leaves it where it is.
///
/// ```
/// use surfel::{embed::Placement, glam::{DMat4, DVec3}};
///
/// let matrix = DMat4::from_translation(DVec3::new(0.0, 2.0, 0.0)) * DMat4::from_scale(DVec3::splat(0.5));
/// let at = Placement::of_matrix(&matrix).unwrap();
/// assert_eq!((at.scale, at.translation.y), (0.5, 2.0));
/// assert!(Placement::of_matrix(&DMat4::from_scale(DVec3::new(1.0, 2.0, 1.0))).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// A unit quaternion.
    pub rotation: DQuat,
    /// Above 0.
    pub scale: f64,
    /// Where the scene's origin comes to lie.
    pub translation: DVec3,
}

/// Between a left-handed world, as of Direct3D, Unity or Unreal, and the right-handed one that its splats are drawn in: z points the other way.
pub(crate) const MIRRORED: DMat4 =
    DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::new(0.0, 0.0, -1.0, 0.0), DVec4::W);

/// What a matrix may differ from a similarity by, as a part of its scale: f32 matrices are taken.
const ROUNDING: f64 = 1e-5;

impl Default for Placement {
    fn default() -> Self {
        Self { rotation: DQuat::IDENTITY, scale: 1.0, translation: DVec3::ZERO }
    }
}

impl Placement {
    /// The placement that a matrix of columns says, which takes points of the scene to the world.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`] for a matrix that is not affine, or shears, mirrors or scales differently by direction.
    pub fn of_matrix(world_from_scene: &DMat4) -> Result<Self> {
        let refuse = |problem: &str| {
            Error::option(
                "placement",
                format!("the matrix {problem}: expected rotation, scale and translation"),
            )
        };
        if !world_from_scene.is_finite() {
            return Err(refuse("is not finite"));
        }
        if (world_from_scene.row(3) - DVec4::W).abs().max_element() > ROUNDING {
            return Err(refuse("is not affine"));
        }
        let linear = DMat3::from_mat4(*world_from_scene);
        let determinant = linear.determinant();
        if determinant <= 0.0 {
            return Err(refuse(if determinant < 0.0 { "mirrors" } else { "has no inverse" }));
        }
        let scale = determinant.cbrt();
        let turn = linear * scale.recip();
        let left = turn.transpose() * turn - DMat3::IDENTITY;
        if left.to_cols_array().iter().any(|part| part.abs() > ROUNDING) {
            return Err(refuse("shears, or scales differently by direction"));
        }
        let rotation = DQuat::from_mat3(&turn).normalize();
        Ok(Self { rotation, scale, translation: world_from_scene.w_axis.truncate() })
    }

    /// The placement of a scene in a left-handed world, by the matrix that takes points there as that world has them. The scene's own splats are
    /// mirrored (`transformed` by `DAffine3::from_scale` of (1, 1, −1)), and the camera is [`super::HostCamera::of_left_handed`].
    ///
    /// # Errors
    /// As [`Self::of_matrix`].
    pub fn of_left_handed(world_from_scene: &DMat4) -> Result<Self> {
        Self::of_matrix(&(MIRRORED * *world_from_scene * MIRRORED))
    }

    /// The matrix, of columns, that takes points of the scene to the world.
    pub fn world_from_scene(&self) -> DMat4 {
        let scale = DVec3::splat(self.scale);
        DMat4::from_scale_rotation_translation(scale, self.rotation.normalize(), self.translation)
    }

    /// Refuses a placement that is none.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`] for numbers that are not finite, a scale not above 0, a rotation that is not of length 1.
    pub fn validate(&self) -> Result<()> {
        let finite = self.translation.is_finite() && self.rotation.is_finite() && self.scale.is_finite();
        // A length is nearer to 1 than its square is.
        let is_unit = (self.rotation.length_squared() - 1.0).abs() <= ROUNDING
            || (self.rotation.length() - 1.0).abs() <= ROUNDING;
        if finite && self.scale > 0.0 && is_unit {
            return Ok(());
        }
        let Self { rotation, scale, translation } = self;
        let problem = format!(
            "{rotation} {scale} {translation}: expected a unit rotation, a scale above 0, a finite translation"
        );
        Err(Error::option("placement", problem))
    }

    /// The camera that sees the scene in its own space as `camera` sees it in the world.
    pub fn camera(&self, camera: &Camera) -> Camera {
        if *self == Self::default() {
            return *camera;
        }
        self.camera_of_usable_up(&Camera { up: camera.usable_up(), ..*camera })
    }

    /// The same of a camera whose up is neither zero nor parallel to the view.
    pub(crate) fn camera_of_usable_up(&self, camera: &Camera) -> Camera {
        let turn = self.rotation.normalize().conjugate();
        let point = |point: DVec3| turn * (point - self.translation) / self.scale;
        Camera {
            eye: point(camera.eye),
            target: point(camera.target),
            up: turn * camera.up,
            near: Some(camera.near() / self.scale),
            orthographic_height: camera.orthographic_height.map(|height| height / self.scale),
            ..*camera
        }
    }

    /// The eye of that camera, by itself.
    pub(crate) fn eye(&self, camera: &Camera) -> DVec3 {
        self.eye_turned(camera, self.rotation.normalize())
    }

    /// The same, by the rotation as a unit quaternion.
    pub(crate) fn eye_turned(&self, camera: &Camera, turn: DQuat) -> DVec3 {
        turn.conjugate() * (camera.eye - self.translation) / self.scale
    }

    /// A plane of the world in the scene's own space: its unit normal, and how far the origin is on the side that the normal points to.
    pub fn plane(&self, plane: DVec4) -> DVec4 {
        if *self == Self::default() {
            return plane;
        }
        let normal = plane.truncate();
        (self.rotation.normalize().conjugate() * normal)
            .extend((normal.dot(self.translation) + plane.w) / self.scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placed() -> Placement {
        let rotation = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 1.1);
        Placement { rotation, scale: 2.5, translation: DVec3::new(3.0, -1.0, 7.0) }
    }

    #[test]
    fn a_scene_is_seen_in_its_own_space_as_in_the_world() {
        let placed = placed();
        for orthographic_height in [None, Some(3.0)] {
            let camera = Camera { eye: DVec3::new(4.0, 1.0, 9.0), orthographic_height, ..Camera::default() };
            let own = placed.camera(&camera);
            let point = DVec3::new(0.3, -0.2, 0.7);
            let in_world = placed.rotation * point * placed.scale + placed.translation;
            let [seen, expected] = [(own, point), (camera, in_world)]
                .map(|(camera, point)| camera.view_from_world().point(point));
            assert!(
                (seen * placed.scale - expected).length() < 1e-14 * expected.length(),
                "{seen} {expected}"
            );
            assert!((own.near() * placed.scale - camera.near()).abs() <= 1e-15 * camera.near());
            let plane = DVec3::new(0.0, 0.6, -0.8).extend(0.7);
            let inside = plane.truncate().dot(in_world) + plane.w;
            let own_plane = placed.plane(plane);
            assert!((own_plane.truncate().dot(point) + own_plane.w - inside / placed.scale).abs() < 1e-14);
        }
        assert_eq!(Placement::default().camera(&Camera::default()), Camera::default());
    }

    #[test]
    fn matrices_are_similarities_or_refused_by_name() {
        let Placement { rotation, scale, translation } = placed();
        let matrix = DMat4::from_scale_rotation_translation(DVec3::splat(scale), rotation, translation);
        let of = Placement::of_matrix(&matrix).unwrap();
        assert!((of.scale - scale).abs() < 1e-14 && of.translation == translation);
        assert!(of.rotation.dot(rotation).abs() > 1.0 - 1e-14);
        of.validate().unwrap();
        let refused = |matrix: DMat4| Placement::of_matrix(&matrix).unwrap_err().to_string();
        assert!(refused(DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0))).contains("mirrors"));
        assert!(refused(DMat4::from_scale(DVec3::new(1.0, 1.0, 2.0))).contains("by direction"));
        assert!(refused(DMat4::ZERO).contains("not affine"));
        assert!(refused(DMat4::from_scale(DVec3::NAN)).contains("not finite"));
        assert!(Placement { scale: 0.0, ..Placement::default() }.validate().is_err());
    }
}
