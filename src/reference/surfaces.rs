//! The opaque surfaces of a pixel, as many as are seen side by side: those of splats, each of which covers a part (`covering`), and polygons, which
//! cover as many of a pixel's samples as they are the nearest at.

use glam::{DVec2, DVec3};

use super::band::Frame;
use super::covering::{covered, fall, part_behind};
use super::creases::CreasedSums;
use super::fragment::Fragment;
use super::front::VisiblePolygon;
use super::layers::{Source, Translucent, take_nearest_side};
use super::polygons::SampledPolygon;
use super::splat::DrawnSplat;
use crate::scene::Transition;

/// The most surfaces of a pixel: behind slopes of open things, each of which has two sides, there are four and more.
const MOST_SURFACES: usize = 6;

/// From this sum on, splats hide polygons of the same surface: at a seam half of a whole surface's splats are there.
const WHOLE_SEAM_SUM: f64 = 0.4;

/// What is opaque in a pixel.
pub(super) struct Opaque {
    /// Linear, multiplied by alpha.
    pub color: DVec3,
    pub alpha: f64,
    /// Transparent things are hidden beyond it: the shifted depth of splats with which half of the pixel is covered, or the depth of the polygon in its middle.
    pub hides_beyond: f64,
    /// What is beyond this depth is hidden by what covers all of the pixel.
    pub seen_to: f64,
    /// The smallest margin of a decision.
    pub margin: f64,
}

impl Opaque {
    const NOTHING: Self = Self {
        color: DVec3::ZERO,
        alpha: 0.0,
        hides_beyond: f64::INFINITY,
        seen_to: f64::INFINITY,
        margin: f64::INFINITY,
    };

    /// Adds so much of a color, or what is left of the pixel; the part that it was. `depth_of_half`: where it hides what is behind, if half of the pixel is
    /// covered with it.
    fn add(&mut self, part: f64, color: DVec3, depth_of_half: f64) -> f64 {
        let part = part.min(1.0 - self.alpha);
        if self.alpha < 0.5 && self.alpha + part >= 0.5 {
            self.hides_beyond = depth_of_half;
        }
        self.color += part * color;
        self.alpha += part;
        part
    }

    /// The same of polygons that are behind nothing else that is left.
    fn add_polygons(&mut self, frame: &Frame, part: f64, group: &[SampledPolygon]) {
        if group.is_empty() {
            return;
        }
        let color = |polygon: &SampledPolygon| {
            let SampledPolygon { ray, nearest, .. } = polygon;
            let attributes = frame.triangles.things[nearest.triangle].attributes(*ray, nearest.z);
            frame.shader.shade(attributes.albedo, attributes.normal, *ray)
        };
        let mean = group.iter().map(color).sum::<DVec3>() / group.len() as f64;
        let margins = group.iter().map(|polygon| polygon.margin);
        self.margin = margins.fold(self.margin, f64::min);
        self.add(part, mean, f64::INFINITY);
    }

    /// Over a straight color with alpha, straight again; black where nothing is seen.
    pub fn over(&self, [red, green, blue, alpha]: [f64; 4]) -> [f64; 4] {
        let color = self.color + (1.0 - self.alpha) * alpha * DVec3::new(red, green, blue);
        let alpha = 1.0 - (1.0 - self.alpha) * (1.0 - alpha);
        if alpha > 0.0 { (color / alpha).extend(alpha).to_array() } else { [0.0; 4] }
    }
}

/// All opaque surfaces of a pixel, in the order of their depths. `fragments`: of all opaque splats. `middle`, `polygons`: the nearest at the pixel's middle, and at
/// each sample.
pub(super) fn surfaces(
    frame: &Frame,
    ray: DVec3,
    (middle, polygons): (Option<VisiblePolygon>, &[SampledPolygon]),
    mut fragments: Vec<Translucent>,
) -> Opaque {
    let samples = frame.polygon_offsets_px.len();
    let share_of = |polygons: &[SampledPolygon]| polygons.len() as f64 / samples as f64;
    let splat_of = |fragment: &Translucent| match fragment.source {
        Source::Splat(i) => &frame.splats.things[i],
        Source::Triangle(_) => unreachable!("polygons are not among the fragments of splats"),
    };
    let mut seen = Opaque::NOTHING;
    let mut left = polygons.to_vec();
    // How what covers the pixel falls toward where it ends.
    let mut ended = DVec2::ZERO;
    for number in 1..=MOST_SURFACES {
        let nearest = fragments.iter().map(|fragment| fragment.z_shifted).fold(f64::INFINITY, f64::min);
        if fragments.is_empty() || seen.alpha >= 1.0 {
            break;
        }
        for polygon in &left {
            seen.margin = seen.margin.min((polygon.nearest.z - nearest).abs() / nearest);
        }
        let (before, behind) = left.iter().copied().partition(|polygon| polygon.nearest.z < nearest);
        let group: Vec<SampledPolygon> = before;
        left = behind;
        // Both sides of a thin thing are nearer to each other than a slanted splat's ε.
        let (layer, margin) = take_nearest_side(&mut fragments, &|fragment| splat_of(fragment).faces_away);
        seen.margin = seen.margin.min(margin);
        // Behind the last one nothing is looked for: all that is left covers with it.
        let rest = if number == MOST_SURFACES { fragments.clone() } else { Vec::new() };
        if group.is_empty() {
            let covering: Vec<&Translucent> = layer.iter().chain(&rest).collect();
            let Some((color, part)) = summed(frame, ray, (&layer, &covering), splat_of) else { break };
            // What ends toward the same side as what is before it lies behind that, and is seen only where it reaches further.
            let fall = fall(&covering, splat_of);
            let behind = part_behind(fall, ended);
            ended += (1.0 - behind) * fall;
            let part = (1.0 - behind) * part.min(1.0 - seen.alpha) + behind * (part - seen.alpha).max(0.0);
            seen.add(part, color, nearest);
        } else {
            // Of planes, depth is one over what is linear in the image.
            let polygon_z =
                group.len() as f64 / group.iter().map(|polygon| 1.0 / polygon.nearest.z).sum::<f64>();
            let behind = |fragment: &Translucent| {
                (fragment.z / splat_of(fragment).toward_polygon - polygon_z) / polygon_z
            };
            for fragment in &layer {
                seen.margin = seen.margin.min(behind(fragment).abs());
            }
            // Behind the polygons, shifted toward the eye, they are another surface; what is not behind has been seen.
            let (of_surface, others) = layer.into_iter().partition(|fragment| behind(fragment) <= 0.0);
            let (of_surface, others): (Vec<_>, Vec<_>) = (of_surface, others);
            let too = if number == MOST_SURFACES { &others[..] } else { &[] };
            let covering: Vec<&Translucent> = of_surface.iter().chain(too).chain(&rest).collect();
            ended += fall(&covering, splat_of);
            let seam = (&of_surface[..], &covering[..]);
            let both = show_seam(&mut seen, frame, ray, seam, (share_of(&group), nearest), splat_of);
            seen.add_polygons(frame, both, &group);
            if seen.alpha < 1.0 {
                for fragment in &fragments {
                    seen.margin = seen.margin.min(behind(fragment).abs());
                }
            }
            fragments.retain(|fragment| behind(fragment) > 0.0);
            fragments.extend(others);
            if samples == 1 {
                break;
            }
        }
        if seen.alpha >= 1.0 {
            seen.seen_to = nearest;
        }
    }
    let share = share_of(&left);
    seen.add_polygons(frame, share, &left);
    seen.hides_beyond = middle.map_or(seen.hides_beyond, |middle| seen.hides_beyond.min(middle.z));
    seen
}

/// The color of a surface of splats, and the part that it covers, with all that is `covering`; `None` where nothing is there.
fn summed<'a>(
    frame: &Frame,
    ray: DVec3,
    (of_surface, covering): (&[Translucent], &[&Translucent]),
    splat_of: impl Fn(&Translucent) -> &'a DrawnSplat,
) -> Option<(DVec3, f64)> {
    let sums = sums(of_surface, &splat_of);
    let color = sums.color(&frame.shader, ray)?;
    let part = covered(covering, splat_of);
    Some((color, part))
}

/// Shows splats of the surface that polygons are of, which cover this `share` of the pixel, at the depth at which they hide what is behind; what is left to these then, of all that either of both covers.
fn show_seam<'a>(
    seen: &mut Opaque,
    frame: &Frame,
    ray: DVec3,
    (of_surface, covering): (&[Translucent], &[&Translucent]),
    (share, depth): (f64, f64),
    splat_of: impl Fn(&Translucent) -> &'a DrawnSplat,
) -> f64 {
    let weight = sums(of_surface, &splat_of).weight();
    let Some((color, part)) = summed(frame, ray, (of_surface, covering), splat_of) else { return share };
    let both = part.max(share);
    let of_splats = match frame.settings.transition {
        Transition::None => 0.0,
        _ => both * (weight / WHOLE_SEAM_SUM).min(1.0),
    };
    both - seen.add(of_splats, color, depth)
}

fn sums<'a>(of_surface: &[Translucent], splat_of: impl Fn(&Translucent) -> &'a DrawnSplat) -> CreasedSums {
    let mut sums = CreasedSums::default();
    for fragment in of_surface {
        sums.add(Fragment { z: fragment.z, weight: fragment.weight }, fragment.kept, splat_of(fragment));
    }
    sums
}
