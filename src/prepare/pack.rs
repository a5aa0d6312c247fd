//! The layout of splats in GPU buffers.
//!
//! Disks, 32 bytes: `position radius`, `normal two`. Ellipses, 48 bytes: `position major-radius`, `s two`, `t weight`, the weight that of a node (`levels.rs`); of a
//! surface with sharp edges, `t bend` (`near_surfaces/sharp.rs`). Local space, f32; `two` is 1 less the splat's share of ε (`near_surfaces.rs`) as a 15-bit fraction (error 1.5e-5), a bit that tells whether it lies at a border (`geometry/borders.rs`), and in the upper half one over its overlap
//! (`geometry/overlaps.rs`), in steps of 2⁻¹⁴ (error 3e-5). Fine splats (`sites.rs`) have 16 bytes more, `what f32 left of the position 0`. Colors, 8 bytes: linear red, green, blue, alpha as 16-bit fractions (error 8e-6). Packed disks and their colors,
//! unless one is for all, are those of `packed.rs`: 16 and 4 bytes.

use glam::DVec3;

use super::{
    clip_vectors::{ClipVectors, clip_vectors},
    far_apart::{far_apart, turn_rad},
    levels::{ChunkLevels, Leveled},
    packed,
    radii::{RadiusCounts, RadiusStep},
    rebase::Rebase,
};
use crate::scene::{Clip, Colors, Defect, DefectCounts, Shapes, Splats};

/// The facts on some splats before any of them is packed: buffers get their exact size.
pub struct Survey {
    /// Their local space.
    pub rebase: Rebase,
    /// How many are drawn.
    pub count: u32,
    /// Whether they carry tangent vectors.
    pub ellipses: bool,
    /// Coordinates have two parts.
    pub fine: bool,
    /// One color for all.
    pub uniform_color: bool,
    /// Clip curves cut something off some of them.
    pub clipped: bool,
    /// Disks in 16 bytes.
    pub packed: bool,
    /// The box of the centers, local space.
    pub bounds: [DVec3; 2],
    /// The largest major radius, local space.
    pub largest_radius: f64,
    /// How many have which, roughly; local space.
    pub radii: Vec<RadiusStep>,
    /// The sum of the major radii, world space.
    pub sum_of_radii: f64,
    /// The splats that are left out.
    pub defects: DefectCounts,
}

impl Survey {
    /// Bytes of a splat's shape.
    pub fn shape_bytes(&self) -> usize {
        if self.packed { packed::DISK_BYTES } else { shape_bytes(self.ellipses, self.fine) }
    }

    /// Bytes of a splat's color.
    pub fn color_bytes(&self) -> usize {
        if self.colors_are_packed() { packed::COLOR_BYTES } else { COLOR_BYTES }
    }

    /// The survey of these splats in 16 bytes each; `None` where they stay exact: ellipses, fine ones, and what has
    /// something far off ([`packed::rebase`]).
    pub fn packed(&self) -> Option<Self> {
        let [lo, hi] = self.bounds;
        let largest = lo.abs().max(hi.abs()).max_element().max(self.largest_radius);
        let rebase = packed::rebase(self.rebase, largest)
            .filter(|_| !self.ellipses && !self.fine && self.count > 0)?;
        let scale = rebase.scale / self.rebase.scale; // a power of two, so that lengths are exact
        let widened =
            |step: &RadiusStep| RadiusStep { radius: packed::widened(step.radius * scale), ..*step };
        // A coordinate moves by a step at most.
        let step = DVec3::splat(packed::STEP);
        Some(Self {
            rebase,
            packed: true,
            bounds: [lo * scale - step, hi * scale + step],
            largest_radius: packed::widened(self.largest_radius * scale),
            radii: self.radii.iter().map(widened).collect(),
            ..*self
        })
    }

    /// Where one color is for all, nothing is gained by less of it.
    fn colors_are_packed(&self) -> bool {
        self.packed && !self.uniform_color
    }
}

/// Splats as bytes for the GPU.
#[derive(Default)]
pub struct Packed {
    /// How many they are.
    pub count: u32,
    /// See the module: words, or the bits of f32.
    pub shapes: Vec<[u32; 4]>,
    /// See the module: a word each, or two.
    pub colors: Vec<u32>,
    /// What is cut off each, where something is cut off some.
    pub clips: Vec<ClipVectors>,
}

/// What lies beside some splats, by their numbers in the input.
#[derive(Clone, Copy, Default)]
pub(super) struct Beside<'a> {
    /// Their shares of ε.
    pub shares: Option<&'a [f32]>,
    /// How a surface with sharp edges turns away near each, and how wide it is; of others none.
    pub bends: &'a [u32],
    /// Whether each lies at a border, where some do.
    pub at_border: Option<&'a [bool]>,
    /// One over their overlaps.
    pub inverse_overlaps: Option<&'a [f32]>,
    /// Their levels of detail.
    pub levels: Option<(&'a Leveled, ChunkLevels)>,
}

/// The length to which shorter tangent vectors are brought, local space: 2⁻⁹⁰. Devices may flush denormal numbers to
/// zero, and a vector that is zero has no direction for the normal. Nothing so short is seen as more than a point.
const SHORTEST_TANGENT: f64 = 1.0 / (1_u128 << 90) as f64;

/// Bytes of a splat's shape.
pub fn shape_bytes(ellipses: bool, fine: bool) -> usize {
    let exact = if ellipses { 48 } else { 32 };
    exact + if fine { 16 } else { 0 }
}

/// Bytes of a splat's color.
pub const COLOR_BYTES: usize = 8;

/// Looks through some splats.
pub fn survey(splats: &Splats, which: impl Iterator<Item = usize>, rebase: Rebase) -> Survey {
    let mut survey = Survey {
        rebase,
        fine: false,
        count: 0,
        ellipses: matches!(splats.shapes, Shapes::Ellipses { .. }),
        uniform_color: matches!(splats.colors, Colors::Uniform(_)),
        clipped: false,
        packed: false,
        bounds: [DVec3::INFINITY, DVec3::NEG_INFINITY],
        largest_radius: 0.0,
        radii: Vec::new(),
        sum_of_radii: 0.0,
        defects: DefectCounts::default(),
    };
    let mut radii = RadiusCounts::new();
    for i in which {
        match local(splats, i, rebase) {
            Ok((position, radius)) => {
                radii.add(radius);
                survey.bounds = [survey.bounds[0].min(position), survey.bounds[1].max(position)];
                survey.largest_radius = survey.largest_radius.max(radius);
                survey.sum_of_radii += splats.major_radius(i);
                survey.clipped |= splats.clips.get(i) != Clip::None;
                survey.count += 1;
            }
            Err(defect) => survey.defects.add(Some(defect)),
        }
    }
    survey.radii = radii.steps();
    survey
}

/// Position and major radius in local space, of a splat that can be drawn.
pub(super) fn local(splats: &Splats, i: usize, rebase: Rebase) -> Result<(DVec3, f64), Defect> {
    let position = rebase.point(splats.positions[i]);
    let radius = splats.major_radius(i) * rebase.scale;
    // Beyond f32 from where the others are: no shader may meet an infinity.
    let beyond = || !position.as_vec3().is_finite() || !(radius as f32).is_finite();
    match splats.defect(i).or_else(|| beyond().then_some(Defect::Position)) {
        None => Ok((position, radius)),
        Some(defect) => Err(defect),
    }
}

/// Those of some splats that [`pack`] packs.
pub(super) fn packable(splats: &Splats, which: impl Iterator<Item = usize>, rebase: Rebase) -> Vec<usize> {
    which.filter(|i| local(splats, *i, rebase).is_ok()).collect()
}

/// Packs some of the splats of a survey in their order, without those that have a defect. Where one color is for all, it is
/// packed once.
pub(super) fn pack(
    splats: &Splats,
    which: impl ExactSizeIterator<Item = usize>,
    survey: &Survey,
    beside: Beside<'_>,
) -> Packed {
    let mut packed = Packed::default();
    pack_behind(splats, which, survey, beside, &mut packed);
    packed
}

/// The same, behind others.
pub(super) fn pack_behind(
    splats: &Splats,
    which: impl ExactSizeIterator<Item = usize>,
    survey: &Survey,
    beside: Beside<'_>,
    packed: &mut Packed,
) {
    let (rebase, uniform_color) = (survey.rebase, survey.uniform_color);
    let room = which.len();
    packed.shapes.reserve(room * survey.shape_bytes() / 16);
    packed.colors.reserve(if uniform_color { 1 } else { room } * survey.color_bytes() / 4);
    let bits = |v: DVec3, w: f64| v.as_vec3().extend(w as f32).to_array().map(f32::to_bits);
    let with = |v: DVec3, word: u32| {
        let [x, y, z] = v.as_vec3().to_array().map(f32::to_bits);
        [x, y, z, word]
    };
    for i in which {
        let Ok((position, radius)) = local(splats, i, rebase) else { continue };
        let less = beside.shares.map_or(0.0, |shares| 1.0 - shares[i]);
        let inverse_overlap = beside.inverse_overlaps.map_or(1.0, |inverse| inverse[i]);
        let at_border = beside.at_border.is_some_and(|at| at[i]);
        let two = two_in_one(less, at_border, inverse_overlap);
        match &splats.shapes {
            Shapes::Disks { normals, .. } => {
                // In f64: a normal may have any length that f32 has.
                let normal = normals[i].as_dvec3().normalize();
                match survey.packed {
                    true => packed.shapes.push(packed::disk(position, normal, radius)),
                    false => packed.shapes.extend([bits(position, radius), with(normal, two)]),
                }
            }
            Shapes::Ellipses { s, t } => {
                let [s, t] = [s[i].as_dvec3(), t[i].as_dvec3()];
                if survey.clipped {
                    packed.clips.push(clip_vectors(&splats.clips.get(i), turn_rad(s, t)));
                }
                let [s, t] = far_apart(s, t);
                let local = |v: DVec3| {
                    let v = v * rebase.scale;
                    if v.length() < SHORTEST_TANGENT { v.normalize() * SHORTEST_TANGENT } else { v }
                };
                // Nodes are not cut.
                let weight = || beside.levels.map_or(0.0, |(leveled, levels)| leveled.weight(levels, i));
                let last = beside.bends.get(i).copied().unwrap_or_else(|| (weight() as f32).to_bits());
                packed.shapes.extend([bits(position, radius), with(local(s), two), with(local(t), last)]);
            }
        }
        if survey.fine {
            packed.shapes.push(bits(position - position.as_vec3().as_dvec3(), 0.0));
        }
        if !uniform_color || packed.colors.is_empty() {
            let color = splats.color(i);
            match survey.colors_are_packed() {
                true => packed.colors.push(packed::color(color)),
                false => packed.colors.extend(bytemuck::cast::<_, [u32; 2]>(packed_color(color))),
            }
        }
        packed.count += 1;
    }
}

/// The word of a splat's share of ε, less than 1 by this, of whether it lies at a border, and of one over its overlap.
fn two_in_one(less: f32, at_border: bool, inverse_overlap: f32) -> u32 {
    let fraction = 2 * (less * 32_767.5).round().min(32_767.0) as u16;
    u32::from(fraction) | u32::from(at_border) | inverse_overlap_in_upper_half(inverse_overlap.into())
}

/// One over an overlap, or what it is multiplied by, in steps of 2⁻¹⁴: at least one, and below 4.
pub fn inverse_overlap_in_upper_half(inverse: f64) -> u32 {
    u32::from(((16_384.0 * inverse).round() as u16).max(1)) << 16
}

/// A color as 16-bit fractions; what is no number is 0.
pub fn packed_color(color: [f32; 4]) -> [u16; 4] {
    color.map(|c| (c.clamp(0.0, 1.0) * 65535.0).round() as u16)
}

#[cfg(test)]
mod tests;
