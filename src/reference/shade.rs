//! From a surface to a color: one white light at the eye, no attenuation.

use glam::DVec3;

use crate::scene::Shading;

/// The linear color of a surface with linear `albedo` and unit view-space `normal`, seen along `ray = (x, y, 1)`.
///
/// A normal that points away from the eye, which weights of turned splats can produce, gets no light: `n·l` is taken
/// as at least 0.
pub(super) fn shade(shading: Shading, albedo: DVec3, normal: DVec3, ray: DVec3) -> DVec3 {
    let to_eye = -ray.normalize();
    let to_light = to_eye;
    let n_dot_l = normal.dot(to_light).max(0.0);
    let lambert = albedo * (0.1 + 0.9 * n_dot_l);
    match shading {
        Shading::Lambert => lambert,
        Shading::Phong => {
            let reflected = 2.0 * n_dot_l * normal - to_light;
            lambert + 0.2 * reflected.dot(to_eye).max(0.0).powi(32)
        }
        Shading::Normals => 0.5 * DVec3::new(normal.x, -normal.y, -normal.z) + 0.5,
        Shading::Albedo => albedo,
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
    fn srgb_values_of_the_standard() {
        assert_eq!(linear_from_srgb(0.0), 0.0);
        assert_eq!(linear_from_srgb(1.0), 1.0);
        assert!((linear_from_srgb(0.5) - 0.214_041_140_482_232_55).abs() < 1e-15);
        assert!((linear_from_srgb(0.02) - 0.02 / 12.92).abs() < 1e-18);
    }
}
