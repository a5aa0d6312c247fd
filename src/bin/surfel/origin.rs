//! The origin on a device: numbers there have 32 bits, so that places far from (0, 0, 0) count from one among them.

use glam::DVec3;
use surfel::{
    Progress as _,
    geometry::{MainPart, main_part},
    prepare::Rebase,
    scene::{Ball, Bounds, Scene},
};

use crate::{
    console::{self, Bars},
    info::number,
};

/// So many times the scene's radius from (0, 0, 0), 32 bits would leave less than a 100 000th of the radius: 2^-24 of 168 is that.
const FAR: f64 = 168.0;

/// The origin of the first object, where it is so far from (0, 0, 0) that this matters for a scene of this radius.
pub fn shift(scene: &Scene, radius: f64) -> Option<DVec3> {
    let of_splats = |splats: &surfel::scene::Splats| Rebase::of(splats, 0..splats.len()).origin;
    let splats = scene.objects.first().map(|object| of_splats(&object.splats));
    let origin = splats
        .or_else(|| scene.meshes.first().map(|object| Rebase::of_points(&object.mesh.positions).origin))?;
    (origin.length() > FAR * radius).then_some(origin)
}

/// What is so many times as wide as the widest of its parts is mostly empty: each part is less than a pixel of most pictures.
const APART: f64 = 1000.0;

/// Tells of parts that can't be seen with the others: their coordinates are of different systems, most likely.
fn tell_apart(scene: &Scene) {
    let Some(whole) = scene.bounds() else { return };
    let splats = scene.objects.iter().map(|object| (&object.name, object.splats.bounds()));
    let meshes = scene.meshes.iter().map(|object| (&object.name, object.mesh.bounds()));
    let parts = splats.chain(meshes).filter_map(|(name, bounds)| Some((name, bounds?)));
    let size = |(_, bounds): &(&String, Bounds)| bounds.radius();
    let farthest = parts.clone().max_by(|a, b| {
        let away = |(_, bounds): &(&String, Bounds)| bounds.center().distance(whole.center());
        away(a).total_cmp(&away(b))
    });
    let widest = parts.clone().map(|part| size(&part)).fold(0.0, f64::max);
    if let Some((name, bounds)) = farthest.filter(|_| whole.radius() > APART * widest && parts.count() > 1) {
        let [x, y, z] = bounds.center().to_array().map(number);
        console::say(&format!(
            "the inputs are so far apart that not all are seen: they are within {} of each other, the widest is {} wide, and {name} is at \
             {x},{y},{z}; expected coordinates of one system, so look at them one by one",
            number(2.0 * whole.radius()),
            number(2.0 * widest)
        ));
    }
}

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

/// What is so many times as high as wide is no thing, if it may be a place in degrees.
const HIGH: f64 = 300.0;

/// Tells of places that may be longitudes and latitudes in degrees, beside heights.
fn tell_degrees(scene: &Scene) {
    let Some(Bounds { min, max }) = scene.bounds() else { return };
    let is_place = min.x >= -180.0 && max.x <= 180.0 && min.y >= -90.0 && max.y <= 90.0;
    let is_away = min.x * max.x > 1.0 && min.y * max.y > 1.0;
    let extent = max - min;
    if is_place && is_away && extent.z > HIGH * extent.x.max(extent.y) {
        console::say(
            "x and y may be longitude and latitude in degrees, beside heights: expected lengths, so project them first, or call the columns lon \
             and lat",
        );
    }
}

/// Tells it, and of what is far apart.
pub fn tell(scene: &Scene, ball: &Ball) {
    tell_apart(scene);
    tell_degrees(scene);
    if let Some(origin) = shift(scene, ball.radius) {
        let origin = origin.to_array().map(number).join(",");
        console::say(&format!("the origin is moved to {origin} on the device, as its numbers have 32 bits"));
    }
}
