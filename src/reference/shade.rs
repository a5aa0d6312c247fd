//! From a surface to a color. The lights are infinitely far or at the eye, without attenuation or shadow; the ambient
//! one is white.

use glam::{DMat3, DVec3};

use crate::scene::{Light, LightKind, Scene, Shading};

/// How surfaces become colors.
#[derive(Clone, Debug)]
pub(super) struct Shader {
    shading: Shading,
    lights: Vec<ViewLight>,
}

/// A light as seen from the eye.
#[derive(Clone, Copy, Debug)]
struct ViewLight {
    /// Unit, in view space; `None` for a light at the eye, which is where the eye is seen from the surface.
    to_light: Option<DVec3>,
    /// Linear.
    color: DVec3,
}

impl Shader {
    /// With the lights of the scene, or the one at the eye where it has none. `view_from_world` turns directions.
    pub fn new(shading: Shading, scene: &Scene, view_from_world: DMat3) -> Self {
        let given = if scene.lights.is_empty() { &[Light::DEFAULT][..] } else { &scene.lights };
        let lights = given.iter().map(|light| ViewLight {
            to_light: match light.kind {
                LightKind::Eye => None,
                LightKind::Directional(direction) => Some(-(view_from_world * direction).normalize()),
            },
            color: DVec3::from(light.color.map(f64::from)),
        });
        Self { shading, lights: lights.collect() }
    }

    /// The linear color of a surface with linear `albedo` and unit view-space `normal`, seen along `ray`, a view-space
    /// vector of any length from the eye to it.
    ///
    /// `albedo (0.1 + 0.9 Σ c n·l)`, for [`Shading::Phong`] and `0.2 Σ c (r·v)³²` with `r = 2(n·l)n − l`. A normal that
    /// points away from a light, which weights of turned splats can produce, gets nothing of it: `n·l` is taken as at
    /// least 0, and a highlight is only where it is above 0.
    pub fn shade(&self, albedo: DVec3, normal: DVec3, ray: DVec3) -> DVec3 {
        let to_eye = -ray.normalize();
        match self.shading {
            Shading::Lambert => self.lambert(albedo, normal, to_eye),
            Shading::Phong => self.lambert(albedo, normal, to_eye) + 0.2 * self.highlights(normal, to_eye),
            Shading::Normals => 0.5 * DVec3::new(normal.x, -normal.y, -normal.z) + 0.5,
            Shading::Albedo | Shading::EyeDome => albedo,
        }
    }

    fn lambert(&self, albedo: DVec3, normal: DVec3, to_eye: DVec3) -> DVec3 {
        let mut light = DVec3::ZERO;
        for ViewLight { to_light, color } in &self.lights {
            light += color * normal.dot(to_light.unwrap_or(to_eye)).max(0.0);
        }
        albedo * (0.1 + 0.9 * light)
    }

    fn highlights(&self, normal: DVec3, to_eye: DVec3) -> DVec3 {
        let mut light = DVec3::ZERO;
        for ViewLight { to_light, color } in &self.lights {
            let to_light = to_light.unwrap_or(to_eye);
            let n_dot_l = normal.dot(to_light);
            if n_dot_l > 0.0 {
                let reflected = 2.0 * n_dot_l * normal - to_light;
                light += color * reflected.dot(to_eye).max(0.0).powi(32);
            }
        }
        light
    }
}

/// Linear light of an sRGB value, both 0–1 (IEC 61966-2-1).
pub(super) fn linear_from_srgb(encoded: f64) -> f64 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALBEDO: DVec3 = DVec3::new(0.5, 0.25, 1.0);

    /// By the light at the eye.
    fn shade(shading: Shading, albedo: DVec3, normal: DVec3, ray: DVec3) -> DVec3 {
        Shader::new(shading, &Scene::default(), DMat3::IDENTITY).shade(albedo, normal, ray)
    }

    fn close(a: DVec3, b: DVec3) -> bool {
        (a - b).abs().max_element() < 1e-12
    }

    #[test]
    fn a_surface_that_faces_the_eye_gets_all_the_light() {
        let normal = DVec3::NEG_Z;
        assert!(close(shade(Shading::Lambert, ALBEDO, normal, DVec3::Z), ALBEDO));
        assert!(close(shade(Shading::Phong, ALBEDO, normal, DVec3::Z), ALBEDO + 0.2));
        assert!(close(shade(Shading::Albedo, ALBEDO, normal, DVec3::Z), ALBEDO));
        assert!(close(shade(Shading::Normals, ALBEDO, normal, DVec3::Z), DVec3::new(0.5, 0.5, 1.0)));
    }

    #[test]
    fn a_tilted_surface_by_hand() {
        // n·l = cos 20°; r is turned by 40° from v.
        let (sin, cos) = 20.0_f64.to_radians().sin_cos();
        let normal = DVec3::new(sin, 0.0, -cos);
        let expected = ALBEDO * (0.1 + 0.9 * 0.939_692_620_785_908_4);
        assert!(close(shade(Shading::Lambert, ALBEDO, normal, DVec3::Z), expected));
        let highlight = 0.2 * 0.766_044_443_118_978_f64.powi(32);
        assert!(close(shade(Shading::Phong, ALBEDO, normal, DVec3::Z), expected + highlight));
        let color = shade(Shading::Normals, ALBEDO, DVec3::new(0.6, 0.8, 0.0), DVec3::Z);
        assert!(close(color, DVec3::new(0.8, 0.1, 0.5)));
    }

    #[test]
    fn light_and_viewer_are_at_the_eye_off_the_axis_too() {
        let ray = DVec3::new(1.0, 0.0, 1.0);
        // Facing the screen, 45° from the ray: r is orthogonal to v, no highlight.
        let expected = ALBEDO * (0.1 + 0.9 * 0.5_f64.sqrt());
        assert!(close(shade(Shading::Phong, ALBEDO, DVec3::NEG_Z, ray), expected));
        // Facing the eye.
        assert!(close(shade(Shading::Phong, ALBEDO, -ray.normalize(), ray), ALBEDO + 0.2));
    }

    #[test]
    fn a_normal_that_points_away_gets_the_ambient_part_and_no_highlight() {
        assert!(close(shade(Shading::Phong, ALBEDO, DVec3::Z, DVec3::Z), 0.1 * ALBEDO));
    }

    #[test]
    fn a_light_behind_the_surface_has_no_highlight_where_it_would_be_reflected_to_the_eye() {
        // Seen along (10, 0, 1) the surface is nearly edge-on; the light is a hair behind it on the other side.
        let lights = |z: f64| {
            let kind = LightKind::Directional(-DVec3::new(1.0, 0.0, z));
            let scene = Scene { lights: vec![Light { kind, color: [1.0; 3] }], ..Scene::default() };
            Shader::new(Shading::Phong, &scene, DMat3::IDENTITY)
        };
        let ray = DVec3::new(10.0, 0.0, 1.0);
        assert!(close(lights(0.01).shade(ALBEDO, DVec3::NEG_Z, ray), 0.1 * ALBEDO));
        assert!(lights(-0.01).shade(ALBEDO, DVec3::NEG_Z, ray).x > 0.1 * ALBEDO.x + 0.1);
    }

    #[test]
    fn srgb_values_of_the_standard() {
        assert_eq!(linear_from_srgb(0.0), 0.0);
        assert_eq!(linear_from_srgb(1.0), 1.0);
        assert!((linear_from_srgb(0.5) - 0.214_041_140_482_232_55).abs() < 1e-15);
        assert!((linear_from_srgb(0.02) - 0.02 / 12.92).abs() < 1e-18);
    }
}
