//! Why a picture shows nothing, and what to try: nobody should look at a white page and wonder.

use glam::DVec3;
use surfel::scene::{Ball, Budget, Camera, ClipBox, ClipPlanes, Settings};

/// One pixel of so many is as good as none.
const FEW: usize = 1000;

/// What is little of the picture's height: one part of so many.
const LITTLE: u32 = 10;

/// What is less than a pixel of it.
const NOTHING: u32 = 1000;

/// What to say of a picture that is all background, or all but a few pixels for a reason that is plain; `None` where something is seen.
pub fn hint(pixels: &[[u8; 4]], settings: &Settings, camera: &Camera, ball: &Ball) -> Option<String> {
    let is_seen = |pixel: &&[u8; 4]| match settings.background {
        None => pixel[3] != 0,
        Some(color) => {
            pixel.iter().zip(color).any(|(byte, value)| (f32::from(*byte) - 255.0 * value).abs() > 1.0)
        }
    };
    let most = pixels.len() / FEW;
    match pixels.iter().filter(is_seen).take(most + 1).count() {
        0 => {
            let reason = beside(camera, ball, NOTHING).unwrap_or_else(|| not_seen(settings));
            Some(format!("nothing is seen in it: {reason}"))
        }
        seen if seen <= most => {
            let reason = beside(camera, ball, LITTLE)?;
            Some(format!("next to nothing is seen in it: {reason}"))
        }
        _ => None,
    }
}

/// Why a scene is not seen that lies elsewhere than the camera looks, or takes less than one of `parts` of the picture's height.
fn beside(camera: &Camera, ball: &Ball, parts: u32) -> Option<String> {
    let center = camera.view_from_world().point(ball.center);
    if let Some(near) = camera.near.filter(|near| *near > (center.z + ball.radius).max(0.0)) {
        return Some(format!("all of the scene is nearer than --near {near}; try without --near"));
    }
    let [distance, across] = [center.length(), center.truncate().length()];
    // Without the sign of what rounds to 0.
    let [x, y, z] = (ball.center * 1e4).round().to_array().map(|value| value / 1e4 + 0.0);
    if camera.is_orthographic() {
        return of_parallel_rays(camera, ball, center, [x, y, z], parts);
    }
    let half_fov_deg = 0.5 * camera.fov_y_rad.to_degrees();
    let to_axis_deg = across.atan2(center.z).to_degrees();
    let reach_deg = (ball.radius / distance).min(1.0).asin().to_degrees();
    let size = small(parts);
    match () {
        () if distance <= ball.radius => {
            Some("the eye is inside of the scene; try without --eye, or --backfaces flip".to_owned())
        }
        // Of the image's corners, which are up to twice as far.
        () if to_axis_deg > reach_deg + 2.0 * half_fov_deg => Some(format!(
            "the scene is around {x},{y},{z}, {to_axis_deg:.0} degrees from where the camera looks; try without --eye and --target"
        )),
        () if reach_deg < half_fov_deg / f64::from(parts) => Some(format!(
            "the scene is {distance:.3e} away and {size}; try without --eye, or a smaller --fov"
        )),
        () => None,
    }
}

fn small(parts: u32) -> &'static str {
    match parts {
        LITTLE => "less than a tenth of the picture's height",
        _ => "smaller than a pixel",
    }
}

/// Of a scene that is in the view.
fn not_seen(settings: &Settings) -> String {
    let given = [
        ("--clip-box", settings.clip_box != ClipBox::default()),
        ("--clip-plane", settings.clip_planes != ClipPlanes::default()),
        ("--budget", settings.budget != Budget::default()),
    ];
    let given: Vec<&str> =
        given.into_iter().filter(|(_, is_given)| *is_given).map(|(option, _)| option).collect();
    match given.is_empty() {
        true => FACES_AWAY.to_owned(),
        false => {
            let options = given.join(" and ");
            format!(
                "{options} may leave nothing of what the camera looks at; try without, or with larger ones"
            )
        }
    }
}

const FACES_AWAY: &str = "what the camera looks at faces away, is seen edge-on, has an alpha of 0 or the background's color; try --backfaces flip, \
                          another --eye, or --shading normals";

/// `center`: the scene's middle in view space.
fn of_parallel_rays(
    camera: &Camera,
    ball: &Ball,
    center: DVec3,
    [x, y, z]: [f64; 3],
    parts: u32,
) -> Option<String> {
    let height = camera.orthographic_height.unwrap_or_default();
    match () {
        () if center.z + ball.radius < camera.near() => {
            Some(format!("the scene is around {x},{y},{z}, behind the eye; try without --eye"))
        }
        // Of the image's corners, which are up to twice as far.
        () if center.truncate().length() > ball.radius + height => Some(format!(
            "the scene is around {x},{y},{z}, beside what the camera shows; try without --eye and --target, or --orthographic fit"
        )),
        () if ball.radius < 0.5 * height / f64::from(parts) => {
            Some(format!("the scene is {}; try --orthographic fit", small(parts)))
        }
        () => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hint_of(eye: DVec3, target: DVec3) -> String {
        let camera = Camera { eye, target, up: DVec3::Y, fov_y_rad: 0.8, ..Camera::default() };
        hint(&[[255; 4]; 9], &Settings::default(), &camera, &Ball { center: DVec3::ZERO, radius: 1.0 })
            .unwrap()
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
            hint(&[[255; 4]; 9], &Settings::default(), &camera, &Ball { center: DVec3::ZERO, radius: 1.0 })
                .unwrap()
        };
        assert!(parallel(far, 2.0 * far, 3.0).contains("behind the eye"));
        assert!(parallel(far + 9.0 * DVec3::X, 9.0 * DVec3::X, 3.0).contains("beside what the camera shows"));
        assert!(parallel(far, DVec3::ZERO, 1e4).contains("smaller than a pixel"));
        assert!(parallel(far, DVec3::ZERO, 3.0).contains("edge-on"));
        let camera =
            Camera { eye: far, target: DVec3::ZERO, up: DVec3::Y, fov_y_rad: 0.8, ..Camera::default() };
        let ball = Ball { center: DVec3::ZERO, radius: 1.0 };
        let seen = |pixels: &[[u8; 4]], background| {
            hint(pixels, &Settings { background, ..Settings::default() }, &camera, &ball).is_none()
        };
        assert!(seen(&[[255; 4], [200, 255, 255, 255]], Some([1.0; 3])) && seen(&[[0, 0, 0, 1]], None));
        assert!(!seen(&[[9, 9, 9, 0]], None));
    }

    #[test]
    fn a_few_pixels_are_as_good_as_none_where_the_reason_is_plain() {
        let ball = Ball { center: DVec3::ZERO, radius: 1.0 };
        let of = |seen: usize, eye: DVec3, orthographic_height| {
            let mut pixels = vec![[255; 4]; 5000];
            pixels[..seen].fill([9, 9, 9, 255]);
            let camera =
                Camera { eye, target: DVec3::ZERO, fov_y_rad: 0.8, orthographic_height, ..Camera::default() };
            hint(&pixels, &Settings::default(), &camera, &ball).unwrap_or_default()
        };
        let [inside, near, far] = [0.1, 5.0, 80.0].map(|z| DVec3::new(0.0, 0.0, z));
        assert!(of(5, inside, None).starts_with("next to nothing is seen in it: the eye is inside"));
        assert!(of(5, far, None).contains("8.000e1 away and less than a tenth of the picture's height"));
        assert!(of(5, near, Some(50.0)).contains("the scene is less than a tenth"));
        for (seen, eye, height) in [(6, inside, None), (6, far, None), (5, near, None), (5, near, Some(3.0))]
        {
            assert_eq!(of(seen, eye, height), "", "{seen} {eye} {height:?}");
        }
    }

    #[test]
    fn what_cuts_the_scene_away_is_named() {
        let eye = DVec3::new(0.0, 0.0, 5.0);
        let ball = Ball { center: DVec3::ZERO, radius: 1.0 };
        let of =
            |camera: &Camera, settings: &Settings| hint(&[[255; 4]; 9], settings, camera, &ball).unwrap();
        let settings = Settings::default();
        for orthographic_height in [None, Some(3.0)] {
            let near = |near: f64| Camera {
                eye,
                target: DVec3::ZERO,
                near: Some(near),
                orthographic_height,
                ..Camera::default()
            };
            assert!(of(&near(6.5), &settings).contains("nearer than --near 6.5"));
            assert!(of(&near(5.5), &settings).contains("edge-on"));
            let cut = Settings { clip_planes: ClipPlanes([[0.0, 0.0, 1.0, 9.0]].into()), ..settings.clone() };
            assert!(of(&near(0.1), &cut).contains("--clip-plane may leave nothing"));
            let cut = Settings { clip_box: ClipBox(Some([[8.0; 3], [9.0; 3]])), ..cut };
            assert!(of(&near(0.1), &cut).contains("--clip-box and --clip-plane may leave nothing"));
        }
    }
}
