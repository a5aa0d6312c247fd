//! The transparent surfaces of one pixel, one behind the other (Guennebaud, Barthe, Paulin 2006, section 6): all its
//! fragments are at hand, so that layers are groups of them and no pass repeats.

use glam::{DVec2, DVec3};

use super::covering::{covered, fall};
use super::decision::Decision;
use super::drawn_clip::Kept;
use super::fragment::Fragment;
use super::shade::Shader;
use super::splat::DrawnSplat;
use super::stack::{Extent, Stack};
use super::surface::{Attributes, Sums, direction};
use super::transition::{Premultiplied, Splatted, join};
use super::triangle::DrawnTriangle;
use crate::scene::{LastLayer, Settings};

/// A fragment of something transparent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Translucent {
    pub z: f64,
    /// By ε: what is nearer belongs to the layer of this fragment, if this is the nearest.
    pub z_shifted: f64,
    /// 1 for a polygon.
    pub weight: f64,
    /// Of a splat, the kernel's value, and the squared radius in what the filter makes of it.
    pub kernel: f64,
    pub r2: f64,
    /// u and v, as far as it reaches.
    pub uv: DVec2,
    /// By how much that value falls a pixel along x and y.
    pub fall: DVec2,
    /// What it covers as no filter has widened it.
    pub outlined: f64,
    /// What clip curves leave of it, where it has any.
    pub kept: Option<Kept>,
    pub source: Source,
}

/// The thing that a fragment is of, by its place in the list of all that is transparent.
#[derive(Clone, Copy, Debug)]
pub(super) enum Source {
    Splat(usize),
    Triangle(usize),
}

/// The things that fragments are looked up in.
pub(super) struct Transparent<'a> {
    pub splats: &'a [DrawnSplat],
    pub triangles: &'a [DrawnTriangle],
    pub settings: &'a Settings,
    /// Where they end, layers cover pixels in part.
    pub covers_in_part: bool,
    pub shader: &'a Shader,
}

/// Takes the nearest layer out of `remaining`: all that is not behind the smallest shifted depth, of the side that the fragment shows whose depth it is; of
/// what shows the other one, nothing is taken. The second value is the smallest margin of that; that fragment has none.
pub(super) fn take_nearest_side(
    remaining: &mut Vec<Translucent>,
    faces_away: &dyn Fn(&Translucent) -> bool,
) -> (Vec<Translucent>, f64) {
    let shifted = |i: usize| remaining[i].z_shifted;
    let Some(owner) = (0..remaining.len()).reduce(|a, b| if shifted(b) < shifted(a) { b } else { a }) else {
        return (Vec::new(), f64::INFINITY);
    };
    let threshold = shifted(owner);
    let side = faces_away(&remaining[owner]);
    let others = remaining.iter().filter(|fragment| faces_away(fragment) != side);
    // The other side's nearest might be the nearest of all.
    let mut margin =
        others.map(|other| (other.z_shifted - threshold) / threshold).fold(f64::INFINITY, f64::min);
    let (mut layer, mut behind) = (Vec::new(), Vec::new());
    for (i, fragment) in remaining.drain(..).enumerate() {
        if faces_away(&fragment) != side {
            behind.push(fragment);
            continue;
        }
        let decision = if i == owner { Decision::CERTAIN } else { Decision::at_most(fragment.z, threshold) };
        margin = margin.min(decision.margin);
        if decision.holds { layer.push(fragment) } else { behind.push(fragment) }
    }
    *remaining = behind;
    (layer, margin)
}

impl Transparent<'_> {
    /// All layers of a pixel whose transparent fragments are `remaining`, those behind something opaque left out.
    pub fn stack(&self, ray: DVec3, mut remaining: Vec<Translucent>) -> Stack {
        let most = self.settings.layers.most();
        let (surfaces, blends_rest) = match self.settings.last_layer {
            LastLayer::Drop => (most, false),
            LastLayer::Blend | LastLayer::Stack => (most - 1, true),
        };
        let mut weight_before = None;
        let mut stack = Stack::EMPTY;
        while !remaining.is_empty() {
            if stack.layers == surfaces && blends_rest {
                let blended = self.blend(ray, &remaining);
                let rest = match (self.settings.last_layer, weight_before) {
                    (LastLayer::Stack, Some(before)) => {
                        stacked(blended, weight_of(&remaining) / f64::max(before, 1.0))
                    }
                    _ => blended,
                };
                let part = if self.covers_in_part { self.covered(&remaining) } else { 1.0 };
                stack.put_behind(Premultiplied { color: part * rest.color, alpha: part * rest.alpha });
            }
            let (layer, margin) = self.take_layer(&mut remaining);
            weight_before = Some(weight_of(&layer));
            if stack.layers < surfaces {
                let shown = self.surface(ray, &layer);
                match self.covers_in_part {
                    true => stack.put_part_behind(shown, self.extent(&layer)),
                    false => stack.put_behind(shown),
                }
                stack.margin = stack.margin.min(margin);
            }
            stack.layers += 1;
        }
        stack
    }

    /// Where edges cover pixels in part, a layer is of one side: at a rim both are within ε, and each has a color of its own.
    fn take_layer(&self, remaining: &mut Vec<Translucent>) -> (Vec<Translucent>, f64) {
        take_nearest_side(remaining, &|fragment| match fragment.source {
            Source::Splat(i) => self.covers_in_part && self.splats[i].faces_away,
            Source::Triangle(_) => false,
        })
    }

    /// One layer as one surface, where it is.
    fn surface(&self, ray: DVec3, layer: &[Translucent]) -> Premultiplied {
        let mut sums = Sums::default();
        let mut polygons = Vec::new();
        for fragment in layer {
            match fragment.source {
                Source::Splat(i) => {
                    sums.add_in_layer(Fragment { z: fragment.z, weight: fragment.weight }, &self.splats[i]);
                }
                Source::Triangle(i) => polygons.push(self.triangles[i].attributes_in_layer(ray, fragment.z)),
            }
        }
        let splats = sums.surface(self.shader, ray).map(|surface| Splatted {
            attributes: turned(Attributes { alpha: surface.alpha.min(1.0), ..surface.attributes() }, ray),
            weight: sums.weight,
        });
        let shade = |attributes: &Attributes| self.shader.shade(attributes.albedo, attributes.normal, ray);
        if self.covers_in_part {
            let Some(splats) = splats else { return Premultiplied::NONE };
            let alpha = splats.attributes.alpha;
            return Premultiplied { color: alpha * shade(&splats.attributes), alpha };
        }
        let polygons = mean(&polygons).map(|polygon| turned(polygon, ray));
        join(self.settings.transition, splats, polygons, shade)
    }

    /// The part of the pixel that they cover.
    fn covered(&self, fragments: &[Translucent]) -> f64 {
        covered(&fragments.iter().collect::<Vec<_>>(), |fragment| self.splat_of(fragment))
    }

    /// Where fragments of one side lie, and what they cover.
    fn extent(&self, layer: &[Translucent]) -> Extent {
        let splat_of = |fragment: &Translucent| self.splat_of(fragment);
        let fragments: Vec<_> = layer.iter().collect();
        let begin = layer.iter().min_by(|a, b| a.z_shifted.total_cmp(&b.z_shifted));
        let (z, z_shifted) = begin.map_or((0.0, 0.0), |begin| (begin.z, begin.z_shifted));
        Extent {
            part: covered(&fragments, splat_of),
            fall: fall(&fragments, splat_of),
            faces_away: layer.iter().any(|of| splat_of(of).faces_away),
            z,
            z_shifted,
            is_sharp: layer
                .iter()
                .any(|of| splat_of(of).covering.as_ref().is_some_and(|of| !of.alone_in_layers)),
        }
    }

    fn splat_of(&self, fragment: &Translucent) -> &DrawnSplat {
        match fragment.source {
            Source::Splat(i) => &self.splats[i],
            Source::Triangle(_) => unreachable!("edges beside polygons in layers are hard"),
        }
    }

    /// All fragments at once, each lit by itself, as the last layer: `C = Σ wα·shade / Σ wα`, `α = Σ wα / Σ w`, whose
    /// product is `Σ wα·shade / Σ w`. A splat is lit at its center.
    fn blend(&self, ray: DVec3, fragments: &[Translucent]) -> Premultiplied {
        let (mut weight, mut alpha, mut color) = (0.0, 0.0, DVec3::ZERO);
        for fragment in fragments {
            let (attributes, seen_along) = match fragment.source {
                Source::Splat(i) => (self.splats[i].attributes(), self.splats[i].toward_center()),
                Source::Triangle(i) => (self.triangles[i].attributes(ray, fragment.z), ray),
            };
            let shaded = self.shader.shade(attributes.albedo, attributes.normal, seen_along);
            weight += fragment.weight;
            alpha += fragment.weight * attributes.alpha;
            color += fragment.weight * attributes.alpha * shaded;
        }
        Premultiplied { color: color / weight, alpha: (alpha / weight).min(1.0) }
    }
}

/// Σw of fragments.
fn weight_of(fragments: &[Translucent]) -> f64 {
    fragments.iter().map(|fragment| fragment.weight).sum()
}

/// As many surfaces of one alpha and color behind each other as there are weights of one surface; 1 to 8.
fn stacked(one: Premultiplied, surfaces: f64) -> Premultiplied {
    let alpha = 1.0 - (1.0 - one.alpha).powf(surfaces.clamp(1.0, 8.0));
    let scale = if one.alpha > 0.0 { alpha / one.alpha } else { 0.0 };
    Premultiplied { color: scale * one.color, alpha }
}

/// With the normal to the eye.
fn turned(attributes: Attributes, ray: DVec3) -> Attributes {
    let away = attributes.normal.dot(ray) > 0.0;
    Attributes { normal: if away { -attributes.normal } else { attributes.normal }, ..attributes }
}

/// `None` of none.
fn mean(polygons: &[Attributes]) -> Option<Attributes> {
    let count = polygons.len() as f64;
    let sum = |value: fn(&Attributes) -> DVec3| -> DVec3 { polygons.iter().map(value).sum() };
    let alpha: f64 = polygons.iter().map(|polygon| polygon.alpha).sum();
    (!polygons.is_empty()).then(|| Attributes {
        albedo: sum(|polygon| polygon.albedo) / count,
        normal: direction(sum(|polygon| polygon.normal), count),
        alpha: (alpha / count).min(1.0),
    })
}
