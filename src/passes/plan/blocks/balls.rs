//! Four balls of splats at once, as the eye sees them.
//!
//! All is computed in f32 and must lose nothing. The reserves of a ball's radius hold what is rounded of where it is, here and on a device. They hold what is rounded of its image, too:
//! a relative error of some 2⁻²² is less than the image of a hundred-thousandth of the distance.

use glam::{BVec4A, DVec3, Vec3, Vec4};

use crate::{
    math::size::SizeBound,
    prepare::{Quad, ViewFromLocal},
};

/// What a device finds of a unit vector may differ from what is found here by so much of an angle: some roundings of 2⁻²⁴, and a
/// packed normal's; much less than this.
const ANGLE_RESERVE_RAD: f32 = 1e-3;

/// Its cosine; its sine is itself but for a ten-thousandth of a millionth.
const COS_RESERVE: f32 = 0.999_999_5;

/// What is rounded of sines and cosines of sums of angles, which all differences of angles may be beside: some 10 roundings of 2⁻²⁴.
const SINE_RESERVE: f32 = 1e-6;

/// What is reserved of a place, as a part of its distance from the eye; and of the distances of the chunk's origin from both, whose difference it
/// is: to a device a sum of four terms, off by some 6 roundings of 2⁻²⁴ of them, 4e-7, and here by half as much.
const LENGTH_RESERVE: f32 = 1e-5;
const ORIGIN_RESERVE: f64 = 1e-6;

/// So far beyond a splat's image a device looks for what a filter makes of it, 2 h (`glsl/inc/outside.glsl`) with h up to √2: less than 3 pixels, roundings and all.
const FILTER_RESERVE_PX: f32 = 3.0;

/// A view's numbers in f32.
pub(super) struct Eye {
    rows: [Vec3; 3],
    origin_from_eye: Vec3,
    scale: f32,
    /// Of where the chunk's origin is.
    reserve: f32,
    /// Of the near plane: no more, and no less.
    near: [f32; 2],
    focal_px: f32,
    is_orthographic: bool,
    size_px: [f32; 2],
    middle_px: [f32; 2],
}

impl Eye {
    /// `by_origin`: how far a chunk's origin is from the eye, and from there the farthest of its centers, together.
    pub fn new(view: &ViewFromLocal, bound: &SizeBound, by_origin: f64) -> Self {
        let narrow = |v: DVec3| v.as_vec3();
        let row = |i: usize| narrow(view.rotation.row(i));
        Self {
            rows: [row(0), row(1), row(2)],
            origin_from_eye: narrow(view.origin_from_eye),
            scale: view.view_from_local_scale as f32,
            reserve: (ORIGIN_RESERVE * by_origin) as f32,
            near: [bound.near * (1.0 - 1e-7), bound.near * (1.0 + 1e-7)].map(|near| near as f32),
            focal_px: bound.focal_px as f32,
            is_orthographic: bound.is_orthographic,
            size_px: bound.size_px.map(|side| side as f32),
            middle_px: bound.middle_px.map(|middle| middle as f32),
        }
    }
}

/// A bit for each of four.
pub(super) type Mask = u32;

/// Four blocks from the eye, in the view's unit.
pub(super) struct Balls {
    /// Their middles from the eye, in the local space's axes.
    middle: [Vec4; 3],
    /// How far from there centers are.
    radius: Vec4,
    /// How far anything of their splats is.
    reach: Vec4,
    /// Their middles in view space.
    in_view: [Vec4; 3],
    /// No less than their distances.
    distance: Vec4,
}

/// Where blocks' splats may be seen.
pub(super) struct Image {
    /// From where to where along y.
    pub y_px: [Vec4; 2],
    /// No farther from the middle, along x and y in the image plane; infinite where they are near.
    pub most_x: Vec4,
    /// They are far enough off for all of that.
    pub far: Mask,
    /// Some of them may be within the image.
    pub seen: Mask,
    /// None of them is beside the image.
    pub whole: Mask,
}

#[inline(always)]
fn dot(a: Vec3, b: [Vec4; 3]) -> Vec4 {
    a.x * b[0] + a.y * b[1] + a.z * b[2]
}

#[inline(always)]
fn dots(a: [Vec4; 3], b: [Vec4; 3]) -> Vec4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn least(all: [Vec4; 4]) -> Vec4 {
    all[0].min(all[1]).min(all[2].min(all[3]))
}

impl Balls {
    #[inline(always)]
    pub fn of(quad: &Quad, eye: &Eye) -> Self {
        let (origin, [x, y, z]) = (eye.origin_from_eye, quad.center);
        let middle = [x * eye.scale + origin.x, y * eye.scale + origin.y, z * eye.scale + origin.z];
        // Of any splat: its block's middle may be the chunk's origin, and the eye.
        let distance = middle[0].abs() + middle[1].abs() + middle[2].abs();
        let radius = quad.radius * eye.scale + (LENGTH_RESERVE * distance + eye.reserve);
        // A splat's points are within its radius, its image within that of twice as much.
        let reach = radius + 2.0 * quad.largest_radius * eye.scale;
        let in_view = [dot(eye.rows[0], middle), dot(eye.rows[1], middle), dot(eye.rows[2], middle)];
        Self { middle, radius, reach, in_view, distance }
    }

    /// No depth of any point is less.
    #[inline(always)]
    pub fn nearest_z(&self) -> Vec4 {
        self.in_view[2] - self.reach
    }

    /// Whether all that is drawn of their splats is on the side of a plane that is cut off: no farther from a splat than it is large and a filter, which is the larger
    /// the deeper, reaches.
    pub fn are_beyond(&self, plane: Vec4, eye: &Eye) -> Mask {
        let z = self.in_view[2];
        let depth = if eye.is_orthographic { Vec4::ONE } else { z + self.reach };
        let of_filter = FILTER_RESERVE_PX / eye.focal_px * depth.max(Vec4::ZERO);
        let inside = dot(plane.truncate(), self.in_view) + plane.w;
        let reserve = LENGTH_RESERVE * (plane.w.abs() + z.abs());
        inside.cmplt(-(self.reach + of_filter + reserve)).bitmask()
    }

    /// Where they may be seen.
    #[inline(always)]
    pub fn image(&self, eye: &Eye) -> Image {
        let ([x, y, z], reach) = (self.in_view, self.reach);
        // Where they are, all that follows is finite: a reach is no less than a part of the distance. NaN is not far.
        let far = if eye.is_orthographic { BVec4A::TRUE } else { reach.cmple(0.25 * z) };
        // A point d from the middle is seen (d_x − c d_z) / (z + d_z) from the middle's image c, |d| √(1 + c²) / (z − |d|) at most.
        let (x, y, away_x, away_y) = if eye.is_orthographic {
            (x, y, reach, reach)
        } else {
            let (per_z, away_per_z) = (1.0 / z, reach / (z - reach));
            let (x, y) = (x * per_z, y * per_z);
            (x, y, away_per_z * (1.0 + x.abs()), away_per_z * (1.0 + y.abs()))
        };
        let in_px = |c: Vec4, away: Vec4, axis_px: f32| {
            let (middle_px, away_px) = (axis_px + c * eye.focal_px, away * eye.focal_px + FILTER_RESERVE_PX);
            [middle_px - away_px, middle_px + away_px]
        };
        let [width, height] = eye.size_px;
        let (x_px, y_px) = (in_px(x, away_x, eye.middle_px[0]), in_px(y, away_y, eye.middle_px[1]));
        let beside = least([x_px[1], width - x_px[0], y_px[1], height - y_px[0]]).cmplt(Vec4::ZERO);
        let within = least([x_px[0], width - x_px[1], y_px[0], height - y_px[1]]).cmpge(Vec4::ZERO);
        let too_near = (z + reach).cmplt(Vec4::splat(eye.near[0])); // NaN is not
        let beyond = (z - reach).cmpgt(Vec4::splat(eye.near[1]));
        let most_x = (x.abs() + away_x).max(y.abs() + away_y);
        Image {
            y_px,
            most_x: Vec4::select(far, most_x, Vec4::INFINITY),
            far: far.bitmask(),
            seen: !(too_near | (far & beside)).bitmask(),
            whole: (far & beyond & within).bitmask(),
        }
    }

    /// Whether all splats face away, and whether all face the eye. Where a normal and the ray to its center have an angle above 90° it is the face. From outside a ball is seen within
    /// the arc sine α of its radius over its distance; angles of directions add up at most: with the spread σ of normals about an axis, which has an angle θ with
    /// the ray to the middle, all angles are above 90° where θ − α − σ is, cos θ < −sin(α + σ), and below where θ + α + σ is, cos θ > sin(α + σ); if α + σ
    /// itself is less.
    #[inline(always)]
    pub fn faces(&self, quad: &Quad, eye: &Eye) -> [Mask; 2] {
        let (middle, squared, radius, distance) = if eye.is_orthographic {
            let axis = eye.rows[2];
            let ray = [Vec4::splat(axis.x), Vec4::splat(axis.y), Vec4::splat(axis.z)];
            (ray, Vec4::ONE, Vec4::ZERO, Vec4::ONE)
        } else {
            (self.middle, dots(self.middle, self.middle), self.radius, self.distance)
        };
        let [sin, cos] = quad.spread_sin_cos;
        let (sin, cos) =
            (sin * COS_RESERVE + cos * ANGLE_RESERVE_RAD, cos * COS_RESERVE - sin * ANGLE_RESERVE_RAD);
        // Times the distance, as the sum of two angles has them. Of a ball around the eye the root is none, and nothing is known.
        let tangent = (squared - radius * radius).sqrt();
        let reserve = SINE_RESERVE * distance;
        let sin_of_sum = radius * cos + tangent * sin + reserve;
        let cos_of_sum = tangent * cos - radius * sin - reserve;
        let along = dots(quad.axis, middle);
        let known = cos_of_sum.cmpgt(Vec4::ZERO).bitmask(); // NaN is not
        [known & along.cmpgt(sin_of_sum).bitmask(), known & along.cmplt(-sin_of_sum).bitmask()]
    }
}
