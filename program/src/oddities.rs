//! What is odd about the places in a scene, told before it is drawn, and what the view is of where some are far away.

use surfel::{
    Progress as _,
    geometry::{MainPart, main_part},
    scene::{Ball, Bounds, Scene},
};

use crate::{
    console::{self, Bars},
    info::number,
};

/// The ball that a picture shows: of the whole scene, or of most of it where the rest is so far away that nothing else would be seen.
pub fn seen(scene: &Scene, whole: &Ball, bars: &Bars) -> Ball {
    let Some(MainPart { ball, share }) = main_part(scene, whole) else { return *whole };
    let zoom = ball.radius / whole.radius;
    // Nothing is seen of what is much smaller.
    let all = match zoom >= 0.01 {
        true => format!("; --zoom {} shows all", number((zoom * 1000.0).floor() / 1000.0)),
        false => String::new(),
    };
    bars.note(&format!(
        "the view is of {:.1}% of the scene: the rest is up to {} times as far away{all}",
        100.0 * share,
        number((1.0 / zoom).round())
    ));
    ball
}

/// Tells what is odd of a scene that is seen within a ball.
pub fn tell(scene: &Scene, ball: &Ball) {
    let splats = scene.objects.iter().map(|object| (object.name.as_str(), object.splats.bounds()));
    let meshes = scene.meshes.iter().map(|object| (object.name.as_str(), object.mesh.bounds()));
    let parts: Vec<(&str, Bounds)> =
        splats.chain(meshes).filter_map(|(name, bounds)| Some((name, bounds?))).collect();
    if let Some(whole) = parts.iter().map(|(_, bounds)| *bounds).reduce(Bounds::union) {
        tell_apart(&parts, &whole);
        tell_degrees(&whole);
    }
    tell_small(scene, ball);
}

/// What is so many times as wide as the widest of its parts is mostly empty: each part is less than a pixel of most pictures.
const APART: f64 = 1000.0;

/// Tells of parts that can't be seen with the others: their coordinates are of different systems, most likely.
fn tell_apart(parts: &[(&str, Bounds)], whole: &Bounds) {
    let away = |(_, bounds): &(&str, Bounds)| bounds.center().distance(whole.center());
    let farthest = parts.iter().max_by(|a, b| away(a).total_cmp(&away(b)));
    let widest = parts.iter().map(|(_, bounds)| bounds.radius()).fold(0.0, f64::max);
    if let Some((name, bounds)) = farthest.filter(|_| whole.radius() > APART * widest && parts.len() > 1) {
        let [x, y, z] = bounds.center().to_array().map(number);
        console::say(&format!(
            "the inputs are so far apart that not all are seen: they are within {} of each other, the widest is {} wide, and {name} is at \
             {x},{y},{z}; expected coordinates of one system, so look at them one by one",
            number(2.0 * whole.radius()),
            number(2.0 * widest)
        ));
    }
}

/// What is so many times as high as wide is no thing, if it may be a place in degrees.
const HIGH: f64 = 300.0;

/// Tells of places that may be longitudes and latitudes in degrees, beside heights.
fn tell_degrees(Bounds { min, max }: &Bounds) {
    let is_place = min.x >= -180.0 && max.x <= 180.0 && min.y >= -90.0 && max.y <= 90.0;
    let is_away = min.x * max.x > 1.0 && min.y * max.y > 1.0;
    let extent = *max - *min;
    if is_place && is_away && extent.z > HIGH * extent.x.max(extent.y) {
        console::say(
            "x and y may be longitude and latitude in degrees, beside heights: expected lengths, so project them first, or call the columns lon \
             and lat",
        );
    }
}

/// Splats that have less than this part of the square of the scene's radius are no surface in it.
const SMALL: f64 = 0.01;

/// Fewer splats may be a few things far from each other.
const FEWEST: usize = 100;

/// Tells of splats so small that hardly anything is seen of them.
fn tell_small(scene: &Scene, ball: &Ball) {
    let count = scene.splat_count();
    if count < FEWEST || !scene.meshes.is_empty() {
        return;
    }
    let radii = scene
        .objects
        .iter()
        .flat_map(|object| (0..object.splats.len()).map(|i| object.splats.major_radius(i)));
    let area: f64 = radii.map(|radius| radius * radius).filter(|square| square.is_finite()).sum();
    if area < SMALL * ball.radius * ball.radius {
        let mean = number((area / count as f64).sqrt());
        let wide = number(2.0 * ball.radius);
        console::say(&format!(
            "splats are too small for a surface: their radii are {mean}, of something {wide} wide; expected radii that reach to the next splat, \
             or none in the file, so that they are found"
        ));
    }
}
