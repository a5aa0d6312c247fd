//! The sweep: single splats over radius, tilt, offset, near plane and size, and close to the eye plane.
//!
//! Each is made in view space and moved into the world by a random rotation and the offset; what the tests compare with
//! is always found from the rounded numbers that the scene holds.

use std::f64::consts::TAU;

use glam::{DMat3, DVec2, DVec3};
use surfel::scene::{Camera, Settings};

use crate::common::{
    builder::{Builder, Random, unfiltered},
    scenes::Hard,
};

/// Radius over the center's depth.
pub const RADII: [f64; 9] = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0, 1e1, 1e2];
/// Degrees between the normal and the ray to the center.
pub const TILTS_DEG: [f64; 7] = [0.0, 30.0, 60.0, 80.0, 89.0, 89.9, 89.99];
/// Of the world's origin from the eye, in depths of the center.
pub const OFFSETS: [f64; 4] = [0.0, 1e3, 1e5, 1e7];
/// The center's depth over the near plane's.
pub const DEPTHS: [f64; 5] = [1.0, 2.0, 1e3, 1e6, 1e9];
/// The center's depth over the radius, at and behind the eye plane.
pub const BEHIND: [f64; 6] = [1e-6, 0.0, -1e-6, -0.1, -0.5, -0.9];

/// A splat of the sweep and its place on each axis.
pub struct Case {
    pub hard: Hard,
    pub tilt_deg: f64,
    pub offset: f64,
    pub depth: f64,
    pub place: Place,
}

/// The first axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// In front of the eye, radius over depth.
    Ahead(f64),
    /// At or behind the eye plane, depth over radius.
    Behind(f64),
}

/// How large a splat is on the screen, and which part of it is looked at.
#[derive(Clone, Copy)]
enum Look {
    /// All of it: the semi-major axis in pixels.
    Whole(f64),
    /// The rim, at the end of the major axis.
    Tip(f64),
    /// The rim, at the end of the minor axis, whose length in pixels this is.
    Side(f64),
    /// All of it, far from the middle of a wide image.
    Edge(f64),
    /// The rim, just inside or outside of a pixel's center next to the middle of a square or of a wide image: the semi-major
    /// axis in pixels.
    Pixel(f64, [u32; 2]),
    /// As large as it is under 45 degrees over a wide image, so many image-plane units from the middle. The others have the
    /// field of view that shows them at the same size for every radius.
    Field(f64),
}

const SQUARE_PX: [u32; 2] = [64, 64];
const WIDE_PX: [u32; 2] = [4096, 8];

const LOOKS: [Look; 11] = [
    Look::Field(0.4),
    Look::Field(0.1),
    Look::Pixel(0.5, SQUARE_PX),
    Look::Pixel(0.5, WIDE_PX),
    Look::Pixel(30.0, WIDE_PX),
    Look::Whole(4.0),
    Look::Whole(25.0),
    Look::Tip(40.0),
    Look::Side(3.0),
    Look::Tip(2000.0),
    Look::Edge(6.0),
];

/// All cases, `rounds` times. In each round every radius meets every tilt and look; offsets and near planes take turns,
/// so that each meets each radius, each tilt and each other.
pub fn all(rounds: usize) -> Vec<Case> {
    (0..rounds).flat_map(round).collect()
}

fn round(number: usize) -> Vec<Case> {
    let mut cases = Vec::new();
    let mut random = Random(11 + number as u64);
    // 7 of 20 pairs further than the round before: the same splat of the grid meets other pairs.
    let mut turn = 7 * number;
    for radius in RADII {
        for tilt_deg in TILTS_DEG {
            for look in LOOKS {
                // 20 pairs; 11 looks, 7 tilts and 9 radii have no factor in common with them.
                cases.push(ahead(
                    radius,
                    tilt_deg,
                    OFFSETS[turn % 4],
                    DEPTHS[turn / 4 % 5],
                    look,
                    &mut random,
                ));
                turn += 1;
            }
        }
    }
    for behind in BEHIND {
        for repeat in 0..20 {
            cases.push(close(behind, OFFSETS[repeat % 4], [1e1, 1e3, 1e6, 1e9][repeat / 4 % 4], &mut random));
        }
    }
    cases
}

fn ahead(radius: f64, tilt_deg: f64, offset: f64, depth: f64, look: Look, random: &mut Random) -> Case {
    let (sin, cos) = tilt_deg.to_radians().sin_cos();
    let (major_px, size_px) = match look {
        Look::Whole(px) | Look::Tip(px) => (px, SQUARE_PX),
        Look::Side(px) => (px / cos, SQUARE_PX),
        Look::Edge(px) => (px, WIDE_PX),
        Look::Pixel(px, size_px) => (px, size_px),
        Look::Field(_) => (radius * 2048.0 / 22.5_f64.to_radians().tan(), WIDE_PX),
    };
    let focal_px = major_px / radius;
    let azimuth = random.between(0.0, TAU);
    let along = DVec2::from_angle(azimuth); // the major axis on the screen
    let jitter_px = DVec2::new(random.between(-0.5, 0.5), random.between(-0.5, 0.5));
    let center_px = match look {
        Look::Whole(_) => jitter_px,
        Look::Tip(px) => jitter_px + along * px,
        Look::Side(px) => jitter_px + along.perp() * px,
        Look::Edge(_) => jitter_px + DVec2::new(2030.0, 0.0),
        Look::Field(x) => jitter_px + DVec2::new(x * focal_px, 0.0),
        Look::Pixel(px, _) => {
            let inside = if random.unit() < 0.8 { 1.0 } else { -1.0 };
            let r = 1.0 - inside * 10.0_f64.powf(random.between(-4.0, -0.3));
            let (v, u) = random.between(0.0, TAU).sin_cos();
            DVec2::splat(0.5) + (along * u + along.perp() * (v * cos)) * (r * px)
        }
    };
    let p = (center_px / focal_px).extend(1.0);
    let to_eye = -p.normalize();
    let major = along.extend(0.0).cross(to_eye).cross(to_eye).normalize();
    let normal = to_eye * cos + major.cross(to_eye) * sin;
    Case {
        hard: hard(p, normal, major, radius, size_px, focal_px, 1.0 / depth, offset, random),
        tilt_deg,
        offset,
        depth,
        place: Place::Ahead(radius),
    }
}

/// A disk of radius 1 that passes the eye at some distance and is seen in front of it.
fn close(behind: f64, offset: f64, depth: f64, random: &mut Random) -> Case {
    // Leaning forward enough that a part lies ahead: its direction of steepest depth has z > |behind|.
    let height = 0.5 * 10.0_f64.powf(-4.0 * random.unit());
    let lean = random.between(0.0, if behind < -0.6 { 0.3 } else { 0.9 });
    let azimuth = random.between(0.0, TAU);
    let down = DVec2::from_angle(azimuth);
    let forward = (down * lean).extend(1.0).normalize();
    let side = down.perp().extend(0.0);
    let normal = side.cross(forward).normalize();
    let p = DVec3::new(0.0, 0.0, behind)
        + normal.with_z(0.0).normalize() * height
        + side * random.between(-0.3, 0.3);
    let tilt_deg = (normal.dot(p).abs() / p.length()).acos().to_degrees();
    // The far end of the disk, about 20 pixels from the middle of the image.
    let far_end = p + forward;
    let focal_px = 20.0 / (far_end.truncate().length() / far_end.z) * random.between(0.5, 1.3);
    Case {
        hard: hard(p, normal, forward, 1.0, [64, 64], focal_px, height.max(1e-3) / depth, offset, random),
        tilt_deg,
        offset,
        depth,
        place: Place::Behind(behind),
    }
}

/// Moves a splat from view space into the world. `major`: a direction in its plane.
#[allow(clippy::too_many_arguments, reason = "each is a different thing, named at the call")]
fn hard(
    p: DVec3,
    normal: DVec3,
    major: DVec3,
    radius: f64,
    size_px: [u32; 2],
    focal_px: f64,
    near: f64,
    offset: f64,
    random: &mut Random,
) -> Hard {
    let forward = random.direction();
    let right = forward.any_orthonormal_vector();
    // View space has y down.
    let world_from_view = DMat3::from_cols(right, forward.cross(right), forward);
    let eye = random.direction() * offset;
    let (position, normal, major) =
        (eye + world_from_view * p, world_from_view * normal, world_from_view * major);
    let mut builder = Builder::default();
    if random.unit() < 0.5 {
        builder.disk(position, normal, radius, super::GRAY);
    } else {
        // The same disk or a narrower ellipse, by tangent vectors that are not its axes.
        let (a, b) =
            (major * radius, normal.cross(major) * radius * [1.0, 0.3][(random.unit() * 2.0) as usize]);
        let (sin, cos) = random.between(0.0, TAU).sin_cos();
        builder.ellipse(position, a * cos + b * sin, b * cos - a * sin, super::GRAY);
    }
    let camera = Camera {
        eye,
        // So far off that its rounding does not turn the camera.
        target: eye + forward * 1e6,
        up: -world_from_view.y_axis,
        fov_y_rad: 2.0 * (0.5 * f64::from(size_px[1]) / focal_px).atan(),
        near: Some(near),
        ..Camera::default()
    };
    let settings = Settings { size_px, ..unfiltered() };
    Hard { name: "one splat of the sweep", scene: builder.scene(false), camera, settings }
}
