//! Why a picture shows nothing, and what to try: nobody should look at a white page and wonder.

use glam::DVec3;
use surfel::scene::{Ball, Camera};

/// What to say of a picture that is all background (sRGB; `None`: transparent); `None` where something is seen.
pub fn hint(
    pixels: &[[u8; 4]],
    background: Option<[f32; 3]>,
    camera: &Camera,
    ball: &Ball,
) -> Option<String> {
    let is_empty = |pixel: &[u8; 4]| match background {
        None => pixel[3] == 0,
        Some(color) => {
            pixel.iter().zip(color).all(|(byte, value)| (f32::from(*byte) - 255.0 * value).abs() <= 1.0)
        }
    };
    pixels.iter().all(is_empty).then(|| format!("nothing is seen in it: {}", reason(camera, ball)))
}

fn reason(camera: &Camera, ball: &Ball) -> String {
    let center = camera.view_from_world().point(ball.center);
    let [distance, across] = [center.length(), center.truncate().length()];
    // Without the sign of what rounds to 0.
    let [x, y, z] = (ball.center * 1e4).round().to_array().map(|value| value / 1e4 + 0.0);
    if camera.is_orthographic() {
        return of_parallel_rays(camera, ball, center, [x, y, z]);
    }
    let half_fov_deg = 0.5 * camera.fov_y_rad.to_degrees();
    let to_axis_deg = across.atan2(center.z).to_degrees();
    let reach_deg = (ball.radius / distance).min(1.0).asin().to_degrees();
    match () {
        () if distance <= ball.radius => {
            "the eye is inside of the scene; try without --eye, or --backfaces flip".to_owned()
        }
        // Of the image's corners, which are up to twice as far.
        () if to_axis_deg > reach_deg + 2.0 * half_fov_deg => format!(
            "the scene is around {x},{y},{z}, {to_axis_deg:.0} degrees from where the camera looks; try without --eye and --target"
        ),
        () if reach_deg < half_fov_deg / 1000.0 => format!(
            "the scene is {distance:.3e} away and smaller than a pixel; try without --eye, or a smaller --fov"
        ),
        () => FACES_AWAY.to_owned(),
    }
}

const FACES_AWAY: &str = "what the camera looks at faces away, is seen edge-on, has an alpha of 0 or the background's color; try --backfaces flip, \
                          another --eye, or --shading normals";

/// `center`: the scene's middle in view space.
fn of_parallel_rays(camera: &Camera, ball: &Ball, center: DVec3, [x, y, z]: [f64; 3]) -> String {
    let height = camera.orthographic_height.unwrap_or_default();
    match () {
        () if center.z + ball.radius < camera.near() => {
            format!("the scene is around {x},{y},{z}, behind the eye; try without --eye")
        }
        // Of the image's corners, which are up to twice as far.
        () if center.truncate().length() > ball.radius + height => format!(
            "the scene is around {x},{y},{z}, beside what the camera shows; try without --eye and --target, or --orthographic fit"
        ),
        () if ball.radius < height / 2000.0 => {
            "the scene is smaller than a pixel; try --orthographic fit".to_owned()
        }
        () => FACES_AWAY.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hint_of(eye: DVec3, target: DVec3) -> String {
        let camera = Camera { eye, target, up: DVec3::Y, fov_y_rad: 0.8, ..Camera::default() };
        hint(&[[255; 4]; 9], Some([1.0; 3]), &camera, &Ball { center: DVec3::ZERO, radius: 1.0 }).unwrap()
    }

    #[test]
    fn an_empty_picture_says_what_to_try_and_any_other_nothing() {
        let far = DVec3::new(0.0, 0.0, 5.0);
        assert!(hint_of(far, DVec3::new(100.0, 0.0, 5.0)).contains("90 degrees from where the camera looks"));
        assert!(hint_of(DVec3::new(0.0, 0.1, 0.0), far).contains("inside of the scene"));
        assert!(hint_of(1e6 * far, DVec3::ZERO).contains("smaller than a pixel"));
        assert!(hint_of(far, DVec3::ZERO).contains("edge-on"));
        let parallel = |eye: DVec3, target: DVec3, height: f64| {
            let camera = Camera { eye, target, orthographic_height: Some(height), ..Camera::default() };
            hint(&[[255; 4]; 9], Some([1.0; 3]), &camera, &Ball { center: DVec3::ZERO, radius: 1.0 }).unwrap()
        };
        assert!(parallel(far, 2.0 * far, 3.0).contains("behind the eye"));
        assert!(parallel(far + 9.0 * DVec3::X, 9.0 * DVec3::X, 3.0).contains("beside what the camera shows"));
        assert!(parallel(far, DVec3::ZERO, 1e4).contains("smaller than a pixel"));
        assert!(parallel(far, DVec3::ZERO, 3.0).contains("edge-on"));
        let camera =
            Camera { eye: far, target: DVec3::ZERO, up: DVec3::Y, fov_y_rad: 0.8, ..Camera::default() };
        let ball = Ball { center: DVec3::ZERO, radius: 1.0 };
        let seen = |pixels: &[[u8; 4]], background| hint(pixels, background, &camera, &ball).is_none();
        assert!(seen(&[[255; 4], [200, 255, 255, 255]], Some([1.0; 3])) && seen(&[[0, 0, 0, 1]], None));
        assert!(!seen(&[[9, 9, 9, 0]], None));
    }
}
