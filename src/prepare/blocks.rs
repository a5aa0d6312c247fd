//! Runs of a chunk's splats, small enough in space (they have the order of a Z-curve) that where one may be seen, and from which
//! side, is known on the host before a frame is drawn.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};

use super::{
    facing::Normals,
    levels::BlockLevels,
    pack::{Packed, Survey},
    packed,
    updatable::is_there,
};
use crate::{inline_vec::InlineVec, shaders::config::BLOCK_SPLATS};

/// The bounds of the splats of a block, in the chunk's local space.
#[derive(Clone, Debug)]
pub struct Block {
    /// How many: [`BLOCK_SPLATS`], and fewer of the last one, and where places have none.
    pub count: u32,
    /// The middle of a ball around all centers.
    pub center: DVec3,
    /// Its radius.
    pub radius: f64,
    /// The axis of a cone around all normals, of unit length.
    pub axis: DVec3,
    /// The angle from the axis that none of them exceeds, as a device finds it but for its roundings of unit vectors; π where they have no
    /// common direction.
    pub spread_rad: f64,
    /// Its sine and cosine.
    pub spread_sin_cos: [f64; 2],
    /// The largest major radius: no point of a splat is farther from its center, however skew its tangent vectors (it is the larger
    /// singular value of the two, [`crate::scene::Splats::major_radius`]), but for a rounding to f32.
    pub largest_radius: f64,
    /// What decides about levels of detail, where there are any: elsewhere, so that bounds lie close together.
    pub levels: Option<Box<BlockLevels>>,
}

impl Block {
    /// Bounds of what a device reads, which f64 holds exactly. Any axis would do for the cone, whose angle is that of the normal which is
    /// farthest from it; the mean keeps it narrow.
    fn around(places: &[Sample]) -> Self {
        let splats = || places.iter().filter(|splat| splat.is_there());
        if splats().next().is_none() {
            return Self::EMPTY;
        }
        let [lo, hi] = splats().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[lo, hi], splat| {
            [lo.min(splat.center), hi.max(splat.center)]
        });
        let center = 0.5 * (lo + hi);
        let sum: DVec3 = splats().map(|splat| splat.normal).sum();
        let axis = sum.try_normalize();
        // Not by the cosine, which tells small angles no better than 1e-8.
        let angle = |axis: DVec3, normal: DVec3| 2.0 * (0.5 * (axis - normal).length()).min(1.0).asin();
        let spread_of = |axis: DVec3| splats().map(|splat| angle(axis, splat.normal)).fold(0.0, f64::max);
        let spread_rad = axis.map_or(PI, spread_of).min(PI);
        Self {
            count: splats().count() as u32,
            center,
            radius: splats().map(|splat| splat.center.distance(center)).fold(0.0, f64::max),
            axis: axis.unwrap_or(DVec3::Z),
            spread_rad,
            spread_sin_cos: spread_rad.sin_cos().into(),
            largest_radius: splats().map(|splat| splat.radius).fold(0.0, f64::max),
            levels: None,
        }
    }
}

impl Block {
    /// Of no splat.
    pub(super) const EMPTY: Self = Self {
        count: 0,
        center: DVec3::ZERO,
        radius: 0.0,
        axis: DVec3::Z,
        spread_rad: 0.0,
        spread_sin_cos: [0.0, 1.0],
        largest_radius: 0.0,
        levels: None,
    };

    /// The block of these splats, no more than it has, as they are packed, and the box of their centers.
    pub(super) fn of(words: &[[u32; 4]], survey: &Survey) -> (Self, [DVec3; 2]) {
        let each = survey.shape_bytes() / 16;
        let splats: InlineVec<_, { BLOCK_SPLATS as usize }> =
            words.chunks_exact(each).map(|words| sample(words, survey)).collect();
        let nowhere = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let there = splats.iter().filter(|splat| splat.is_there());
        let bounds = there.fold(nowhere, |[lo, hi], splat| [lo.min(splat.center), hi.max(splat.center)]);
        (Self::around(&splats), bounds)
    }
}

/// A splat as the device has it.
#[derive(Clone, Copy, Default)]
struct Sample {
    center: DVec3,
    /// Of unit length.
    normal: DVec3,
    radius: f64,
}

impl Sample {
    /// Whether its place has a splat.
    fn is_there(&self) -> bool {
        is_there(self.radius as f32)
    }
}

/// The blocks of a chunk, while it is packed.
#[derive(Default)]
pub(super) struct BlockMaker {
    done: Vec<Block>,
    /// The next one's.
    next: Vec<Sample>,
    /// All normals, where they are asked for.
    normals: Option<Normals>,
}

impl BlockMaker {
    /// Counts normals, too.
    pub fn with_normals() -> Self {
        Self { normals: Some(Normals::new()), ..Self::default() }
    }

    /// Takes in the splats of a batch.
    pub fn add(&mut self, batch: &Packed, survey: &Survey) {
        for words in batch.shapes.chunks_exact(survey.shape_bytes() / 16) {
            self.next.push(sample(words, survey));
            if self.next.len() == BLOCK_SPLATS as usize {
                self.end_block();
            }
        }
    }

    fn end_block(&mut self) {
        self.done.push(Block::around(&self.next));
        if let Some(normals) = &mut self.normals {
            self.next.iter().for_each(|splat| normals.add(splat.normal, splat.center));
        }
        self.next.clear();
    }

    /// All of them, and all normals.
    pub fn finish(mut self) -> (Vec<Block>, Option<Normals>) {
        if !self.next.is_empty() {
            self.end_block();
        }
        (self.done, self.normals)
    }
}

fn sample(words: &[[u32; 4]], survey: &Survey) -> Sample {
    if survey.packed {
        let (center, normal, radius) = packed::unpacked_disk(words[0]);
        return Sample { center, normal, radius };
    }
    let vector = |words: [u32; 4]| Vec3::from_slice(&words.map(f32::from_bits)[..3]).as_dvec3();
    let normal = match survey.ellipses {
        // Their sine is at least 1/4 (`far_apart.rs`): the product keeps its digits on a device, too.
        true => vector(words[1]).normalize().cross(vector(words[2]).normalize()).normalize_or(DVec3::Z),
        false => vector(words[1]),
    };
    let low = if survey.fine { vector(words[words.len() - 1]) } else { DVec3::ZERO };
    let center = vector(words[0]) + low;
    Sample { center, normal, radius: f32::from_bits(words[0][3]).into() }
}

#[cfg(test)]
mod tests {
    use super::{super::pack, *};
    use crate::{
        prepare::Rebase,
        scene::{Colors, Shapes, Splats},
    };

    /// With the scale of their local space.
    fn blocks_of(shapes: Shapes, positions: Vec<DVec3>, as_packed: bool) -> (Vec<Block>, f64) {
        let count = positions.len();
        let splats = Splats::new(positions, shapes, Colors::Uniform([1.0; 4]));
        let survey = pack::survey(&splats, 0..count, Rebase { origin: DVec3::ZERO, scale: 0.5 });
        let survey = if as_packed { survey.packed().unwrap() } else { survey };
        let mut maker = BlockMaker::default();
        // Batches end anywhere.
        for first in (0..count).step_by(1500) {
            maker.add(
                &pack::pack(&splats, first..count.min(first + 1500), &survey, Default::default()),
                &survey,
            );
        }
        (maker.finish().0, survey.rebase.scale)
    }

    #[test]
    fn a_block_holds_its_splats_whatever_they_are_packed_as() {
        let count = 5000;
        let at = |i: usize| 0.001 * i as f64;
        let positions: Vec<_> = (0..count).map(|i| DVec3::new(at(i), at(i).sin(), 0.0)).collect();
        let normals: Vec<_> = (0..count).map(|i| Vec3::new((at(i)).sin() as f32, 0.0, 1.0)).collect();
        let disks = Shapes::Disks { normals: normals.clone(), radii: vec![0.25; count] };
        // Both nearly along one direction, unless their sine is 1; no longer than 0.25 together.
        let ellipses = |sine: f32| {
            let along = |n: &Vec3| n.cross(Vec3::Y).normalize();
            let s = normals.iter().map(|n| 0.17 * along(n)).collect();
            let t = normals.iter().map(|n| {
                0.17 * ((1.0 - sine * sine).sqrt() * along(n) + sine * n.normalize().cross(along(n)))
            });
            Shapes::Ellipses { s, t: t.collect() }
        };
        let skew = [1.0, 0.1, 1e-3, 1e-4].map(|sine| (ellipses(sine), false));
        for (shapes, as_packed) in [(disks.clone(), false), (disks, true)].into_iter().chain(skew) {
            let (blocks, scale) = blocks_of(shapes, positions.clone(), as_packed);
            assert_eq!(
                blocks.iter().map(|block| block.count).collect::<Vec<_>>(),
                [256; 19].into_iter().chain([136]).collect::<Vec<_>>()
            );
            for (i, (p, n)) in positions.iter().zip(&normals).enumerate() {
                let block = &blocks[i / 256];
                assert!((*p * scale).distance(block.center) <= block.radius + 1e-4, "{i}");
                let turn = n.as_dvec3().angle_between(block.axis);
                assert!(turn <= block.spread_rad + 1e-4, "{i}: {turn} of {}", block.spread_rad);
            }
            assert!(blocks.iter().all(|block| block.radius < 0.6 * scale && block.spread_rad < 0.6));
        }
    }

    #[test]
    fn normals_without_a_common_direction_are_of_every_direction() {
        let normals = vec![Vec3::Z, Vec3::NEG_Z];
        let (blocks, _) =
            blocks_of(Shapes::Disks { normals, radii: vec![1.0; 2] }, vec![DVec3::ZERO; 2], false);
        assert_eq!(blocks[0].spread_rad, PI);
    }
}
