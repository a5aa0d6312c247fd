//! What part of a pixel a surface covers, where it ends.
//!
//! The weights of widened splats, which keep their area, are the unfiltered ones convolved with the low-pass filter. Over what a whole
//! surface sums to (`overlap`) they are the part A of the filter in which there is a surface. A large splat alone is seen to end at its rim,
//! where its weight is far below that: there its own part counts, that of a half plane at the distance of the rim. All fragments of a pixel
//! are at hand here, and surfaces are groups of them (`layers`).

use glam::DVec2;

use super::drawn_clip::Kept;
use super::layers::Translucent;
use super::reach::{Reach, normal_distribution};
use super::splat::DrawnSplat;
use crate::scene::{MeshObject, Object, Opacity, Scene, Settings};

/// From this sum on a pixel is covered, unless the surface ends there; sums of a whole surface are not all 1.
const WHOLE_SUM: f64 = 0.79;

/// The same where it falls by less than a quarter of what it does at a border.
const FLAT_SUM: f64 = 0.6;

/// What falls as steeply, over a border, and no steeper, may end there or go on.
const NOT_FLAT: f64 = 0.45;

/// What weights that end at the rims of splats miss of a surface that ends: this times √A (1 - A)².
const LEFT_OUT: f64 = 0.225;

/// What is covered to all but so little is covered.
const NEARLY_WHOLE: f64 = 0.96;

/// Whether surfaces cover pixels in part: all that is opaque, and what is transparent where there are no polygons in its layers.
pub(super) fn covers_in_part(scene: &Scene, settings: &Settings, opacity: Opacity) -> bool {
    let is_transparent = |object: &MeshObject| object.mesh.colors.opacity() == Opacity::Transparent;
    let beside_polygons = opacity == Opacity::Transparent && scene.meshes.iter().any(is_transparent);
    settings.covers_in_part() && !beside_polygons
}

/// What sums miss where a surface ends, of what has this opacity: nothing where clip curves cut off some of it, since no rims stand out there.
pub(super) fn left_out(scene: &Scene, opacity: Opacity) -> f64 {
    let cuts = |object: &Object| object.splats.colors.opacity() == opacity && !object.splats.clips.is_empty();
    if scene.objects.iter().any(cuts) { 0.0 } else { LEFT_OUT }
}

/// What a splat covers of pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Covering {
    /// The factor of the kernel's value in A: the area that the filter leaves, over the overlap.
    pub share: f64,
    /// The minor semi-axis of its image as it is drawn, in pixels.
    pub minor_px: f64,
    /// The filter's radius in pixels.
    pub h_px: f64,
    /// How surely the surface goes on around it, of a sharp one: there what unfiltered ellipses cover tells what is covered.
    pub goes_on: f64,
    /// [`left_out`] of all that is drawn with it.
    pub left_out: f64,
    /// It is seen in layers that don't go on with each other: what is missing of one may be in the next.
    pub alone_in_layers: bool,
    /// It lies at a border, and covers by itself as far as it reaches.
    pub reach: Option<Reach>,
}

impl Covering {
    /// The part of a pixel that it covers by itself, at squared radius `r2`.
    fn alone(&self, r2: f64) -> f64 {
        let h_px = self.h_px;
        // Of the splat as it was: its rim, in radii of the splat as it is drawn.
        let rim2 = (1.0 - (h_px / self.minor_px).powi(2)).max(0.0);
        let own_minor_px = rim2.sqrt() * self.minor_px;
        let is_large = smooth_step((own_minor_px / h_px - 0.5) / 0.5);
        // A half plane at distance d, under a Gaussian of standard deviation h / 2: to first order 1/2 + d / (√(2π) h / 2).
        let distance_px = (rim2 - r2) * self.minor_px / 2.0;
        is_large * (0.5 + distance_px / ((2.0 * std::f64::consts::PI).sqrt() * h_px / 2.0))
    }
}

/// A splat's part of a surface in a pixel: the kernel's value, by how much it falls a pixel, the squared radius, and what clip curves leave.
struct Part<'a> {
    covering: &'a Covering,
    kernel: f64,
    fall: DVec2,
    /// What its own ellipse covers, as no filter has widened it.
    outlined: f64,
    r2: f64,
    uv: DVec2,
    kept: Option<Kept>,
}

impl Part<'_> {
    /// Over the overlap.
    fn weight(&self) -> f64 {
        self.covering.share * self.kernel
    }
}

/// From 0 at `x` = 0 to 1 at 1.
pub(super) fn smooth_step(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// How surely what falls by `a` ends toward the same side as what falls by `b`: the cosine between both, and less where one is shorter than half of the other.
pub(super) fn part_behind(a: DVec2, b: DVec2) -> f64 {
    let [shorter, longer] = [a.length().min(b.length()), a.length().max(b.length())];
    if shorter == 0.0 {
        return 0.0;
    }
    (a.dot(b) / (shorter * longer)).max(0.0) * (2.0 * shorter / longer).min(1.0)
}

/// By how much a sum over the overlap falls a pixel, over that at a border: there it is `A = Φ(d/s)`, at distance d under a Gaussian of standard deviation
/// `s = h/2`, and falls by `φ(Φ⁻¹(A))/s`.
fn steepness(sum: f64, fall: f64, covering: &Covering) -> f64 {
    let a = sum.min(1.0);
    // φ(Φ⁻¹(A)) is this within 0.01.
    let steepest = a * (1.0 - a) * (2.15 - 2.2 * a * (1.0 - a));
    if steepest > 0.0 { fall * covering.h_px / 2.0 / steepest } else { 0.0 }
}

/// Of a sum over the overlap, how steeply it falls, and what disks cover by themselves. `covering`: of any of the splats.
///
/// What falls as steeply as a border ends there, and its sum is right; what does not is inside, and what hardly falls is so for sure, unless an ε has left some of it to the next layer.
fn whole(sum: f64, steepness: f64, alone: f64, covering: &Covering) -> f64 {
    let a = sum.min(1.0);
    let steepness = if covering.alone_in_layers { steepness.max(NOT_FLAT) } else { steepness };
    let ends = smooth_step((steepness - NOT_FLAT) / 0.35) * smooth_step((0.92 - a) / 0.1);
    let whole = FLAT_SUM + (WHOLE_SUM - FLAT_SUM) * smooth_step((steepness - 0.25) / 0.2);
    let inside = if a < 0.5 { a } else { 0.5 + 0.5 * (a - 0.5) / (whole - 0.5) };
    let at_end = a + covering.left_out * a.sqrt() * (1.0 - a).powi(2);
    ((inside + ends * (at_end - inside)).max(alone) / NEARLY_WHOLE).min(1.0)
}

/// The part of a pixel that splats of one surface cover together. What they cover by themselves is taken for independent; but of those at a border, which lie along one, the one that
/// covers most stands for all; and what their own ellipses do sums to a whole where a sharp surface goes on.
///
/// Up to a clip curve the surface goes on as it would without it, and of what it would cover the curve leaves a part: the mean over the splats that are cut toward there, by their
/// weights. Those of both sides of a ridge leave parts that add up. What no curve cuts in the pixel is left, too.
fn opacity(parts: &[Part]) -> f64 {
    let Some(Part { covering, .. }) = parts.first() else { return 0.0 };
    let outlined = parts.iter().map(|part| part.outlined).sum::<f64>().min(1.0);
    let all: f64 = parts.iter().map(Part::weight).sum();
    let fall: DVec2 = parts.iter().map(|part| part.covering.share * part.fall).sum();
    let alone = alone(parts, outlined, |_| 1.0);
    kept(parts) * whole(all, steepness(all, fall.length(), covering), alone, covering)
}

/// What disks cover by themselves, each of which counts so much, where their own ellipses cover as much together.
fn alone(parts: &[Part], outlined: f64, count: impl Fn(&Part) -> f64) -> f64 {
    let (mut gap, mut within) = (1.0, f64::NEG_INFINITY);
    for part in parts {
        match (&part.covering.reach, count(part)) {
            (None, counts) => gap *= 1.0 - counts * part.covering.alone(part.r2).clamp(0.0, 1.0),
            (Some(_), 0.0) => {}
            (Some(reach), _) => within = within.max(reach.within_rim(part.uv)),
        }
    }
    // Which is right as it is: what is all but covered does not count as all.
    1.0 - gap.min(1.0 - outlined) * (1.0 - NEARLY_WHOLE * normal_distribution(within))
}

/// Splats at borders weigh nothing beyond what the filter makes of them, and are cut there, too.
const LEAST_WEIGHT: f64 = 1e-18;

/// What curves leave of it.
fn kept(parts: &[Part]) -> f64 {
    // What is cut off by less than a 32nd counts as cut and as not cut in part.
    let uncut = |part: &Part| part.kept.map_or(1.0, |kept| (32.0 * kept.part - 31.0).clamp(0.0, 1.0));
    let toward = [0, 1, 2, 3].map(|quarter| {
        let cut =
            parts.iter().filter_map(|part| Some((part, part.kept.filter(|kept| kept.toward == quarter)?)));
        cut.fold(DVec2::ZERO, |sums, (part, kept)| {
            sums + part.weight().max(LEAST_WEIGHT) * (1.0 - uncut(part)) * DVec2::new(kept.part, 1.0)
        })
    });
    // Both sides of a ridge keep in opposite directions. Splats of one side may fall into two quarters that are neighbors.
    let pair = |i: usize| match toward[i] + toward[(i + 1) % 4] {
        sums if sums.y > 0.0 => sums.x / sums.y,
        _ => 0.0,
    };
    let Some(Part { covering, .. }) = parts.first() else { return 1.0 };
    match f64::min(pair(0) + pair(2), pair(1) + pair(3)) {
        0.0 => 1.0,
        kept => {
            let sum = parts.iter().map(|part| uncut(part) * part.weight()).sum();
            kept.max(whole(sum, NOT_FLAT, alone(parts, 0.0, uncut), covering)).min(1.0)
        }
    }
}

/// [`opacity`] of fragments of splats.
pub(super) fn covered<'a>(
    fragments: &[&Translucent],
    splat_of: impl Fn(&Translucent) -> &'a DrawnSplat,
) -> f64 {
    let parts: Vec<_> = fragments
        .iter()
        .filter_map(|fragment| {
            let Translucent { kernel, fall, outlined, r2, uv, kept, .. } = **fragment;
            Some(Part {
                covering: splat_of(fragment).covering.as_ref()?,
                kernel,
                fall,
                outlined,
                r2,
                uv,
                kept,
            })
        })
        .collect();
    opacity(&parts)
}

/// By how much the sum of fragments of splats falls a pixel along x and y.
pub(super) fn fall<'a>(
    fragments: &[&Translucent],
    splat_of: impl Fn(&Translucent) -> &'a DrawnSplat,
) -> DVec2 {
    let fall = |fragment: &&Translucent| Some(splat_of(fragment).covering.as_ref()?.share * fragment.fall);
    fragments.iter().filter_map(fall).sum()
}
