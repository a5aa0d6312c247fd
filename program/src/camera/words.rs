//! A camera as options.

use glam::DVec3;
use surfel::scene::Camera;

/// The options that make this camera again, to the bit, whatever the scene and its file say. Of one whose field of view is no number of
/// degrees, the nearest.
pub fn words(camera: &Camera) -> String {
    let triple = |v: DVec3| format!("{},{},{}", v.x, v.y, v.z);
    let up = camera.usable_up();
    let mut words = vec![
        format!("--eye {}", triple(camera.eye)),
        format!("--target {}", triple(camera.target)),
        format!("--up {}", triple(up)),
    ];
    match camera.orthographic_height {
        Some(height) => words.push(format!("--orthographic {height}")),
        None => words.push(format!("--fov {}", degrees(camera.fov_y_rad))),
    }
    words.extend(camera.near.map(|near| format!("--near {near}")));
    words.join(" ")
}

/// The degrees that are so many radians, or nearly so: dividing by π may round to a neighbor. Of several the one that is written shortest.
pub fn degrees(angle_rad: f64) -> f64 {
    let nearest = angle_rad.to_degrees();
    let neighbors = [nearest, nearest.next_up(), nearest.next_down()];
    let exact = neighbors.into_iter().filter(|degrees| degrees.to_radians() == angle_rad);
    exact.min_by_key(|degrees| degrees.to_string().len()).unwrap_or(nearest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_come_back_as_the_same_angle() {
        for i in 1..180_000 {
            let degrees_given = f64::from(i) / 1000.0;
            // As it was given: 30 is not told as 29.999999999999996.
            assert_eq!(degrees(degrees_given.to_radians()).to_string(), degrees_given.to_string(), "{i}");
        }
        assert_eq!(degrees(Camera::DEFAULT_FOV_Y_RAD).to_radians(), Camera::DEFAULT_FOV_Y_RAD);
        for i in 1..10_000 {
            let camera = Camera::default().zoomed(1.0 + f64::from(i) * 1e-3);
            assert_eq!(degrees(camera.fov_y_rad).to_radians(), camera.fov_y_rad, "{i}");
        }
    }
}
