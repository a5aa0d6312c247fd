//! Which blocks of a chunk may be seen, and in which rows of tiles: found on the host, by what bounds all splats of a block.

use std::{collections::BTreeMap, ops::Range};

use glam::DVec3;

use super::tiles::TILE_PX;
use crate::{
    math::size::{SizeBound, box_within_px},
    prepare::{Block, Chunk, ViewFromLocal},
};

/// A block some of whose splats may be seen.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenBlock {
    /// Its number in its chunk.
    pub number: u32,
    /// Its splats.
    pub count: u32,
    /// What no splat's box exceeds, in pixels; infinite where one may come near the eye plane.
    pub box_px: f64,
    /// The rows of tiles that they may touch.
    pub rows: Range<u32>,
    /// None of them faces away, where such are not drawn, or is nearer than the near plane or beside the image.
    pub all_seen: bool,
}

impl SeenBlock {
    /// Whether none of its splats is left out where splats are looked for in these rows.
    pub fn is_within(&self, rows: &Range<u32>) -> bool {
        self.all_seen && rows.start <= self.rows.start && self.rows.end <= rows.end
    }

    /// Whether it may touch any of these rows.
    pub fn touches(&self, rows: &Range<u32>) -> bool {
        self.rows.start < rows.end && rows.start < self.rows.end
    }
}

/// The blocks of all chunks that may be seen, and how many of their splats may touch which rows.
pub struct SeenSplats {
    /// Chunk by chunk.
    pub chunks: Vec<Vec<SeenBlock>>,
    classes: Vec<SizeClass>,
}

/// Splats with boxes up to a size.
struct SizeClass {
    box_px: f64,
    /// For each row: how many are in blocks that begin before it, and in such that end before it.
    begun: Vec<u32>,
    ended: Vec<u32>,
}

/// Boxes are told apart by so many pixels.
const SIZE_STEP_PX: f64 = 0.25;

impl SeenSplats {
    /// Those of some blocks, in an image with so many rows of tiles.
    pub fn new(chunks: Vec<Vec<SeenBlock>>, rows: u32) -> Self {
        let mut classes: BTreeMap<u64, SizeClass> = BTreeMap::new();
        for block in chunks.iter().flatten() {
            let box_px = (block.box_px / SIZE_STEP_PX).ceil() * SIZE_STEP_PX;
            let none = || vec![0; rows as usize + 1];
            let class = classes.entry(box_px.to_bits()).or_insert_with(|| SizeClass {
                box_px,
                begun: none(),
                ended: none(),
            });
            // In the row behind the one where it begins or ends; then summed up.
            class.begun[block.rows.start as usize + 1] += block.count;
            class.ended[block.rows.end as usize] += block.count;
        }
        let mut classes: Vec<_> = classes.into_values().collect();
        for class in &mut classes {
            for row in 1..=rows as usize {
                class.begun[row] += class.begun[row - 1];
                class.ended[row] += class.ended[row - 1];
            }
        }
        Self { chunks, classes }
    }

    /// How many splats have boxes up to how many pixels, of the blocks that may touch these rows.
    pub fn boxes(&self, rows: &Range<u32>) -> Vec<(u32, f64)> {
        let of = |class: &SizeClass| {
            (class.begun[rows.end as usize] - class.ended[rows.start as usize], class.box_px)
        };
        self.classes.iter().map(of).filter(|(count, _)| *count > 0).collect()
    }

    /// The rows that any of them may touch; `None` where there is none.
    pub fn rows(&self) -> Option<Range<u32>> {
        let rows = || self.chunks.iter().flatten().map(|block| &block.rows);
        Some(rows().map(|rows| rows.start).min()?..rows().map(|rows| rows.end).max()?)
    }
}

/// How blocks are looked at.
#[derive(Clone, Copy)]
pub struct Look<'a> {
    /// The motion to view space.
    pub view: &'a ViewFromLocal,
    /// What bounds the images of the chunk's splats.
    pub bound: &'a SizeBound,
    /// Splats that face away are not drawn.
    pub culls: bool,
    /// A filter enlarges a splat's image by a few pixels at most.
    pub bounded: bool,
}

/// What a device finds in f32 may differ from this file's f64 by so much of an angle.
const ANGLE_RESERVE_RAD: f64 = 1e-3;

/// The same of a place, as a part of its distance from the eye; and of the distances of the chunk's origin from both, whose difference it
/// is to a device.
const LENGTH_RESERVE: f64 = 1e-5;
const ORIGIN_RESERVE: f64 = 1e-6;

/// The farthest that a filter takes a splat's image beyond itself, and rounding: pixels.
const FILTER_RESERVE_PX: f64 = 6.0;

/// The blocks of a chunk some of whose splats may be seen, in their order. What is left out here, every stage that sets splats up
/// would leave out: what faces away, what is nearer than the near plane, and what is beside the image, by the bounds of
/// `glsl/cull_mark.comp.glsl`, of a ball in place of a splat.
pub fn seen_blocks(chunk: &Chunk, look: &Look<'_>) -> Vec<SeenBlock> {
    (0..).zip(&chunk.blocks).filter_map(|(number, block)| seen_block(number, block, look)).collect()
}

fn seen_block(number: u32, block: &Block, look: &Look<'_>) -> Option<SeenBlock> {
    let ball = Ball::of(block, look);
    let angles = ball.angles(block);
    let right = std::f64::consts::FRAC_PI_2;
    if look.culls && angles[1] < right {
        return None;
    }
    let Image { rows, most_x, is_whole } = ball.image(look)?;
    let scale = look.view.view_from_local_scale;
    let largest_radius = block.largest_radius * scale;
    let bound = SizeBound { nearest_z: ball.z - ball.reach, largest_radius, ..*look.bound };
    let of_chunk = box_within_px(look.bound, largest_radius, most_x);
    Some(SeenBlock {
        number,
        count: block.count,
        box_px: box_within_px(&bound, largest_radius, most_x).min(of_chunk),
        rows,
        all_seen: is_whole && (!look.culls || angles[0] > right),
    })
}

/// A block from the eye, in the view's unit.
struct Ball {
    /// Its middle, in the local space's axes.
    middle: DVec3,
    /// How far from there centers are.
    radius: f64,
    /// How far anything of its splats is.
    reach: f64,
    /// Its middle in view space.
    x: f64,
    y: f64,
    z: f64,
}

/// Where a block's splats may be seen.
struct Image {
    /// In which rows of tiles.
    rows: Range<u32>,
    /// No farther from the middle, along x and y in the image plane.
    most_x: f64,
    /// None of it is beside the image.
    is_whole: bool,
}

impl Ball {
    fn of(block: &Block, look: &Look<'_>) -> Self {
        let scale = look.view.view_from_local_scale;
        let middle = block.center * scale + look.view.origin_from_eye;
        let of_origin = look.view.origin_from_eye.length() + block.center.length() * scale;
        let reserve = LENGTH_RESERVE * middle.length() + ORIGIN_RESERVE * of_origin;
        let radius = block.radius * scale + reserve;
        let [x, y, z] = look.view.rows.map(|row| {
            let [x, y, z, _] = row.map(f64::from);
            DVec3::new(x, y, z).dot(middle)
        });
        // A splat's points are within the root of 2 of its larger radius, for skew axes.
        Self { middle, radius, reach: radius + 2.0 * block.largest_radius * scale, x, y, z }
    }

    /// `None` where nothing of it may be seen.
    fn image(&self, look: &Look<'_>) -> Option<Image> {
        let [width, height] = look.bound.size_px;
        let all = 0..(height as u32).div_ceil(TILE_PX);
        if self.z + self.reach < look.bound.near {
            return None;
        }
        let is_far = self.reach <= 0.25 * self.z; // NaN is not
        if !look.bounded || !is_far {
            return Some(Image { rows: all, most_x: f64::INFINITY, is_whole: false });
        }
        let [x, y] = [self.x, self.y].map(|side| {
            let c = side / self.z;
            (c, self.reach / (self.z - self.reach) * (1.0 + c.abs()))
        });
        let in_px = |(c, away): (f64, f64), side: f64| {
            let (middle_px, away_px) = (0.5 * side + c * look.bound.focal_px, away * look.bound.focal_px);
            [middle_px - away_px - FILTER_RESERVE_PX, middle_px + away_px + FILTER_RESERVE_PX]
        };
        let (x_px, y_px) = (in_px(x, width), in_px(y, height));
        if x_px[1] < 0.0 || x_px[0] > width || y_px[1] < 0.0 || y_px[0] > height {
            return None;
        }
        let row = |y: f64| (y.clamp(0.0, height) as u32) / TILE_PX;
        let first = row(y_px[0]).min(all.end - 1);
        let rows = first..(row(y_px[1]) + 1).min(all.end);
        let within = |px: [f64; 2], side: f64| px[0] >= 0.0 && px[1] <= side;
        let is_whole = self.z - self.reach > look.bound.near && within(x_px, width) && within(y_px, height);
        Some(Image { rows, most_x: (x.0.abs() + x.1).max(y.0.abs() + y.1), is_whole })
    }

    /// Between which the angles lie of normals and the ways from the eye to their centers: above 90° a splat shows the eye its face.
    fn angles(&self, block: &Block) -> [f64; 2] {
        let distance = self.middle.length();
        if !(self.radius < distance) {
            return [0.0, std::f64::consts::PI];
        }
        let of_axis = block.axis.angle_between(self.middle);
        let around = (self.radius / distance).asin() + block.spread_rad + ANGLE_RESERVE_RAD;
        [of_axis - around, of_axis + around]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{math::random::SplitMix, prepare::Rebase, scene::Camera};

    const SIZE_PX: [u32; 2] = [200, 150];

    /// Splats of a block: centers within a ball, normals within a cone. f64 in local space.
    struct Disk {
        center: DVec3,
        normal: DVec3,
    }

    fn random(random: &mut SplitMix) -> impl FnMut(f64, f64) -> f64 + '_ {
        move |lo, hi| lo + (hi - lo) * random.unit()
    }

    fn direction(between: &mut impl FnMut(f64, f64) -> f64) -> DVec3 {
        loop {
            let v = DVec3::new(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0));
            if (0.1..1.0).contains(&v.length()) {
                return v.normalize();
            }
        }
    }

    /// Whatever is seen of a block's disks is in its rows, and a block that is left out has nothing to see: at random places, sizes and
    /// views, near and far, by the rims of the disks themselves.
    #[test]
    fn what_is_seen_of_a_block_is_in_its_rows() {
        let mut source = SplitMix(3);
        let mut between = random(&mut source);
        let (mut left_out, mut facing, mut narrow, mut tightest) = (0, 0, 0, 0.0_f64);
        for round in 0..4000 {
            let (size, radius) = (0.5 * between(0.0, 1.0).powi(4), 0.3 * between(0.0, 1.0).powi(6));
            let (axis, spread) = (direction(&mut between), between(0.0, 1.0).powi(2));
            let middle = 2.0 * direction(&mut between) * between(0.0, 1.0);
            let disks: Vec<Disk> = (0..40)
                .map(|_| Disk {
                    center: middle + size * between(0.0, 1.0) * direction(&mut between),
                    normal: (axis + spread * between(0.0, 1.0) * direction(&mut between)).normalize(),
                })
                .collect();
            let block = Block {
                count: 40,
                center: middle,
                radius: disks.iter().map(|d| d.center.distance(middle)).fold(0.0, f64::max),
                axis,
                spread_rad: disks.iter().map(|d| d.normal.angle_between(axis)).fold(0.0, f64::max),
                largest_radius: radius,
            };
            let eye = DVec3::new(between(-0.5, 0.5), between(-0.5, 0.5), 3.0);
            let camera = Camera { eye, target: DVec3::ZERO, up: DVec3::Y, fov_y_rad: 0.7, near: None };
            let view = Rebase { origin: DVec3::ZERO, scale: 1.0 }.view_from_local(&camera);
            let focal_px = camera.focal_px(SIZE_PX[1]);
            let near = camera.near() * view.view_from_world_scale;
            let bound = SizeBound {
                nearest_z: -1.0,
                largest_radius: radius * view.view_from_local_scale,
                near,
                focal_px,
                size_px: SIZE_PX.map(f64::from),
                filter_px: std::f64::consts::SQRT_2,
            };
            let look = Look { view: &view, bound: &bound, culls: round % 2 == 0, bounded: true };
            let seen = seen_block(0, &block, &look);
            for disk in &disks {
                let faces_away = disk.normal.dot(disk.center - camera.eye) > 0.0;
                if look.culls && faces_away {
                    assert!(seen.as_ref().is_none_or(|seen| !seen.all_seen), "{round}");
                    continue;
                }
                let s = radius * disk.normal.any_orthonormal_vector();
                let t = disk.normal.cross(s);
                let rim = (0..24).map(|i| f64::from(i).to_radians() * 15.0);
                let image = rim.clone().map(|a| disk.center + s * a.cos() + t * a.sin()).map(|point| {
                    let p = camera.view_from_world().point(point);
                    (p.z, [0, 1].map(|i| focal_px * p[i] / p.z))
                });
                let image: Vec<_> = image.collect();
                let half = SIZE_PX.map(|side| 0.5 * f64::from(side));
                let in_view = |x: &[f64; 2]| x[0].abs() <= half[0] && x[1].abs() <= half[1];
                if image.iter().all(|(z, x)| *z > camera.near() && in_view(x)) {
                    let most_px = seen.as_ref().unwrap_or_else(|| panic!("{round}: left out")).box_px - 3.0;
                    for axis in 0..2 {
                        let along = || image.iter().map(|(_, x)| x[axis]);
                        let span_px = along().fold(f64::MIN, f64::max) - along().fold(f64::MAX, f64::min);
                        assert!(span_px <= most_px, "{round}: {span_px} px of {most_px}");
                        tightest = if span_px > 20.0 { (span_px / most_px).max(tightest) } else { tightest };
                    }
                }
                for point in rim.map(|a| disk.center + s * a.cos() + t * a.sin()).chain([disk.center]) {
                    let p = camera.view_from_world().point(point);
                    let px = [0, 1].map(|i| 0.5 * f64::from(SIZE_PX[i]) + focal_px * p[i] / p.z);
                    let inside = (0..2).all(|i| (0.0..f64::from(SIZE_PX[i])).contains(&px[i]));
                    if p.z < camera.near() || !inside {
                        continue;
                    }
                    let row = px[1] as u32 / TILE_PX;
                    let seen = seen.as_ref().unwrap_or_else(|| panic!("{round}: a seen block was left out"));
                    assert!(seen.rows.contains(&row), "{round}: row {row} of {:?}", seen.rows);
                }
            }
            left_out += usize::from(seen.is_none());
            facing += usize::from(look.culls && seen.as_ref().is_some_and(|seen| seen.all_seen));
            narrow += usize::from(seen.is_some_and(|seen| seen.rows.len() < 10));
        }
        println!("left out {left_out}, facing the eye {facing}, in less than 10 rows {narrow}");
        assert!(tightest > 0.5, "{tightest}: the bound of boxes could be less");
        assert!(left_out > 500 && facing > 100 && narrow > 500, "{left_out} {facing} {narrow}");
    }
}
