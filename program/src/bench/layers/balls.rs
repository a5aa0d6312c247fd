//! 27 balls of splats on a grid, seen so that they overlap: the scene of `examples/spheres.toml` without its lights.

use glam::{DAffine3, DQuat, DVec3};
use surfel::{
    Error, Result,
    geometry::check_memory_for,
    load::builtin,
    report::InputReport,
    scene::{Ball, Camera, Object, Scene},
};

/// How many there are.
pub const COUNT: u32 = 27;

/// Splats of each, where nothing else is asked for.
pub const SPLATS: u64 = 2000;

/// How opaque they are.
pub const ALPHA: f32 = 0.5;

/// From center to center, along each axis.
const SPACING: f64 = 1.1;

const RADIUS: f64 = 0.5;

/// Where the eye is beside the middle, but for its distance.
const TO_EYE: DVec3 = DVec3::new(6.2, 4.4, 8.2);

const FOV_Y_DEG: f64 = 30.0;

/// The balls, and a sentence on them.
///
/// # Errors
/// More splats than there is memory for.
pub fn scene(splats: u64, alpha: f32) -> Result<(Scene, InputReport)> {
    let count = usize::try_from(splats).unwrap_or(usize::MAX);
    check_memory_for(count.saturating_mul(COUNT as usize), builtin::BYTES_PER_SPLAT)
        .map_err(|problem| Error::option("--splats", problem))?;
    let ball = builtin::sphere(count);
    let places = (0..COUNT).map(|i| [i % 3, i / 3 % 3, i / 9]);
    let object = |place: [u32; 3]| {
        let center = SPACING * (DVec3::from(place.map(f64::from)) - DVec3::ONE);
        let placed = DAffine3::from_scale_rotation_translation(DVec3::splat(RADIUS), DQuat::IDENTITY, center);
        let mut splats = ball.splats.clone().transformed(&placed);
        // From dark to light along each axis.
        splats.colors.tint(Some(place.map(|step| 0.25 + 0.35 * step as f32)), alpha);
        splats.drop_defective();
        Object { name: ball.name.clone(), splats, closed: true }
    };
    let scene = Scene { objects: places.map(object).collect(), ..Scene::default() };
    let drawn = scene.splat_count();
    let name = format!("{COUNT} balls");
    let input = InputReport {
        summary: format!("{name}: {drawn} disks"),
        name,
        splats: drawn,
        drawn_as: "splats",
        ..InputReport::default()
    };
    Ok((scene, input))
}

/// A camera that sees all of them, obliquely.
pub fn camera(scene: &Scene, size_px: [u32; 2]) -> Camera {
    let ball = scene.ball().unwrap_or(Ball { center: DVec3::ZERO, radius: 1.0 });
    let fit = Camera::fit(&ball, size_px, FOV_Y_DEG.to_radians());
    Camera { eye: fit.target + fit.eye.distance(fit.target) * TO_EYE.normalize(), ..fit }
}

#[cfg(test)]
mod tests {
    use surfel::scene::Opacity;

    use super::*;

    #[test]
    fn there_are_27_transparent_balls_apart_from_each_other_or_the_same_opaque() {
        let (scene, input) = scene(50, ALPHA).unwrap();
        assert_eq!((scene.objects.len(), input.splats), (27, 27 * 50));
        let opacity = |scene: &Scene| {
            let all: Vec<Opacity> =
                scene.objects.iter().map(|object| object.splats.colors.opacity()).collect();
            assert!(all.windows(2).all(|pair| pair[0] == pair[1]));
            all[0]
        };
        assert_eq!(opacity(&scene), Opacity::Transparent);
        assert_eq!(opacity(&super::scene(50, 1.0).unwrap().0), Opacity::Opaque);
        let mut centers: Vec<DVec3> =
            scene.objects.iter().map(|object| object.splats.bounds().unwrap().center()).collect();
        while let Some(center) = centers.pop() {
            assert!(centers.iter().all(|other| other.distance(center) > 2.0 * RADIUS));
        }
        assert!(camera(&scene, [64, 32]).validate().is_ok());
    }

    #[test]
    fn more_splats_than_there_is_memory_for_are_refused() {
        let refused = scene(u64::MAX, ALPHA).unwrap_err();
        assert!(refused.to_string().starts_with("--splats: "), "{refused}");
    }
}
