//! A splat as it is drawn: in view space, after culling and filter, with all that a pixel asks of it.
//!
//! This file, `ewa`, `intersect`, `fragment` and `surface` name each other, as the papers' sections do: all tell of a splat.

use glam::{DVec2, DVec3};

use super::borders::at_border;
use super::covering::{Covering, covers_in_part, left_out};
use super::drawn_clip::DrawnClip;
use super::epsilon::{EpsilonRule, polygon_reach};
use super::filter::{adjust, area_share, minor_axis, projected};
use super::intersect::Map;
use super::low_pass::{LowPass, Square};
use super::near_surfaces::{Bend, bends};
use super::overlap::{SharpSplat, evened, overlaps};
use super::paper_filter::adjust_paper;
use super::reach::Reach;
use super::surface::Attributes;
use super::tangents::tangents;
use super::thickness::{of_layers, thickened};
use super::view::View;
use crate::scene::{
    Backfaces, DefectCounts, Filter, FilterWeight, Object, Opacity, Rasterizer, Scene, Settings,
};

/// A splat in view space. A point of it is `center + u·s + v·t`.
#[derive(Clone, Copy, Debug)]
pub(super) struct DrawnSplat {
    /// The number of its object, and its own in there.
    pub source: [usize; 2],
    pub center: DVec3,
    /// First tangent vector after the filter.
    pub s: DVec3,
    /// Second tangent vector after the filter.
    pub t: DVec3,
    /// Unit normal of the plane that is drawn, to either side.
    pub plane_normal: DVec3,
    /// `u = u_axis · q` for a point `center + q` of the plane.
    pub u_axis: DVec3,
    /// `v = v_axis · q`.
    pub v_axis: DVec3,
    /// Unit normal of the surface, toward the eye.
    pub normal: DVec3,
    /// Whether its outward normal looks away from the eye.
    pub faces_away: bool,
    /// The normal that a transparent layer sums: outward of what is closed, else that toward the eye. At a silhouette front
    /// and back are one surface within ε; turned before, what is left of their sum would face the eye and shine.
    pub normal_in_layer: DVec3,
    /// Linear.
    pub albedo: DVec3,
    /// Straight, 0–1.
    pub alpha: f64,
    /// Whether it belongs to an object that is drawn in layers.
    pub transparent: bool,
    /// The depth of the visibility test is this times the fragment's own; at least 1.
    pub shift: f64,
    /// The same toward a polygon, where edges are not hard.
    pub toward_polygon: f64,
    /// How the image is mapped onto it.
    pub map: Map,
    /// The factor of the kernel's value, above 0 and at most 1; coverage does not depend on it.
    pub share: f64,
    /// What it covers of pixels where its surface ends, if edges are not hard.
    pub covering: Option<Covering>,
    /// The least weight of a fragment that covers.
    pub least_weight: f64,
    /// The low-pass filter beside it, for [`Filter::Max`].
    pub low_pass: Option<LowPass>,
    /// By how much it reaches further than what the filter makes of it, of which `s` and `t`, `u` and `v` tell then.
    pub reach: Option<Reach>,
    /// What is cut off it.
    pub clip: Option<DrawnClip>,
    /// The square to which it is cut, for [`Rasterizer::RaycastApproximate`].
    pub square: Option<Square>,
    /// Semi-minor axis in pixels: of the map's ellipse, or of the projection at the center; `None` where the disk
    /// reaches the near plane and the projection is no ellipse.
    pub minor_px: Option<f64>,
}

impl DrawnSplat {
    pub fn attributes(&self) -> Attributes {
        Attributes { albedo: self.albedo, normal: self.normal, alpha: self.alpha }
    }

    /// A vector from the eye toward the center; forward where they are the same point.
    pub fn toward_center(&self) -> DVec3 {
        // The largest component becomes 1 first: a square of it would leave the range of f64.
        let largest = self.center.abs().max_element();
        if largest > 0.0 { self.center / largest } else { DVec3::Z }
    }
}

/// The largest depth radius over the center's depth at which a splat is still taken for an ellipse.
const REGULAR_DEPTH_RATIO: f64 = 0.9;

/// The least part of its depth by which a splat is shifted: with less, a surface whose depth has 24 bits would hide itself in part.
/// Farther away than 1e6 ε, surfaces closer to each other than a millionth of their distance are one.
const LEAST_SHIFT: f64 = 1e-6;

/// Every splat of the scene that can be seen from the front or is to be turned, and what was left out as defective.
/// Objects whose every alpha is 0 have none.
pub(super) fn prepare(scene: &Scene, view: &View, settings: &Settings) -> (Vec<DrawnSplat>, DefectCounts) {
    let mut drawn = Vec::new();
    let mut defects = DefectCounts::default();
    let reach = polygon_reach(scene, settings);
    for (number, object) in scene.objects.iter().enumerate() {
        let opacity = object.splats.colors.opacity();
        let cull = culls((settings, !view.planes.is_empty()), object.closed, opacity);
        let overlaps = covers_in_part(scene, settings, opacity).then(|| match scene.meshes.is_empty() {
            true => overlaps(&object.splats, settings.kernel),
            // Where splats meet polygons, their sum is to fall toward their border.
            false => evened(&object.splats, overlaps(&object.splats, settings.kernel)),
        });
        let is_sharp = overlaps.is_some() && !object.splats.clips.is_empty();
        let bends = is_sharp.then(|| bends(&object.splats));
        // Of a surface alone, opaque, with nothing cut off.
        let is_whole = opacity == Opacity::Opaque && !is_sharp && scene.meshes.is_empty();
        let may_reach = overlaps.is_some() && settings.filter == Filter::Adjust && is_whole;
        let at_border = may_reach.then(|| at_border(&object.splats));
        let rule = EpsilonRule::of(scene, number, settings, opacity);
        let left_out = left_out(scene, opacity);
        for i in 0..object.splats.len() {
            let defect = object.splats.defect(i);
            defects.add(defect);
            if defect.is_none() && opacity != Opacity::Invisible {
                let bend = bends.as_ref().map(|bends| bends[i]);
                let overlap = overlaps.as_ref().map(|overlaps| (overlaps[i], bend));
                let splat = prepare_one(
                    object,
                    i,
                    (cull, opacity, overlap, left_out, at_border.as_ref().is_some_and(|at| at[i])),
                    (&rule, reach),
                    view,
                    settings,
                );
                let transparent = opacity == Opacity::Transparent;
                drawn.extend(splat.map(|splat| DrawnSplat { source: [number, i], transparent, ..splat }));
            }
        }
    }
    (drawn, defects)
}

/// Whether what faces away is not drawn. Through a transparent surface its far side is seen, and through a cut its inside.
pub(super) fn culls((settings, is_cut_open): (&Settings, bool), closed: bool, opacity: Opacity) -> bool {
    match settings.backfaces {
        Backfaces::Auto => closed && opacity == Opacity::Opaque && !is_cut_open,
        Backfaces::Flip => false,
        Backfaces::Cull => true,
    }
}

/// The overlap of a splat, and, of a sharp surface, how it bends there.
type Overlap = Option<(f64, Option<Bend>)>;

/// `None` where the splat faces away and is culled.
fn prepare_one(
    object: &Object,
    i: usize,
    (cull, opacity, overlap, left_out, at_border): (bool, Opacity, Overlap, f64, bool),
    (rule, polygon_reach): (&EpsilonRule, f64),
    view: &View,
    settings: &Settings,
) -> Option<DrawnSplat> {
    let splats = &object.splats;
    let center = view.from_world.point(splats.positions[i]);
    let (s, t) = tangents(&splats.shapes, i);
    let (s, t) = (view.from_world.rotation * s, view.from_world.rotation * t);

    let outward = s.cross(t).normalize();
    let faces_away = outward.dot(center) > 0.0;
    if faces_away && cull {
        return None;
    }
    let normal = if faces_away { -outward } else { outward };
    let normal_in_layer = if object.closed { outward } else { normal };

    // The projection at a center behind the near plane has no meaning: no filter acts there, and nothing is cut off. Nor
    // has the affine approximation of a splat that is nearly as deep as it is far: its tangents stay as they are.
    let in_front = center.z > view.near;
    let depth_radius = s.z.hypot(t.z);
    let reaches_near = center.z - depth_radius < view.near;
    let regular = in_front && !reaches_near && depth_radius <= REGULAR_DEPTH_RATIO * center.z;
    let h = view.filter_radius();
    let original = (s, t);
    let is_layered = opacity == Opacity::Transparent;
    let is_sharp = overlap.is_some_and(|(_, bend)| bend.is_some());
    let (thickness, leaning) = match (settings.filter != Filter::None && regular, is_layered) {
        (true, true) => of_layers(center, (s, t), h, is_sharp),
        (true, false) if overlap.is_some() => {
            (thickened(center, (s, t), h, depth_radius / splats.major_radius(i), is_sharp), 0.0)
        }
        _ => (1.0, 0.0),
    };
    let epsilon = rule.epsilon(i, splats.major_radius(i) * thickness) + rule.of_length(leaning);
    let shift = if epsilon > 0.0 {
        1.0 + (epsilon / center.z.max(epsilon)).max(LEAST_SHIFT * view.depth_share)
    } else {
        1.0
    };
    let (s, t) = match settings.filter {
        Filter::Adjust if regular => adjust(center, s, t, h),
        Filter::AdjustPaper if regular => adjust_paper(center, s, t, h),
        _ => original,
    };

    let map = if regular { Map::of(center, s, t, h, settings) } else { Map::Projective };
    let share = match &map {
        Map::Stretched(stretched) => stretched.share,
        _ if in_front && settings.filter.adjusts() && settings.filter_weight == FilterWeight::Area => {
            area_share(center, original, (s, t), settings.floors().share)
        }
        _ => 1.0,
    };
    let area = match &map {
        Map::Stretched(stretched) => stretched.share,
        _ if in_front && settings.filter.adjusts() => {
            area_share(center, original, (s, t), settings.floors().share)
        }
        _ => 1.0,
    };
    let minor = match &map {
        Map::Projective => minor_axis(projected(center, s), projected(center, t)),
        Map::Affine(ellipse) => ellipse.lengths[1],
        Map::Stretched(stretched) => stretched.ellipse.lengths[1],
    };
    let image_size = map.size([projected(center, s), projected(center, t)]);
    let cosine = outward.dot(center.normalize()).abs();
    let sharp = overlap.and_then(|(_, bend)| bend).map(|Bend { turn, minor_part, width }| {
        let (s, t) = original;
        let longer = if t.length() > s.length() { t } else { s };
        let smaller = s.cross(t).length() / longer.length();
        let across = outward.cross(longer.normalize()) * width * smaller;
        let minor = minor_axis(projected(center, longer), projected(center, across)) / h;
        SharpSplat { turn, cosine, filter_radii: minor_part * h * center.z / smaller, minor }
    });
    let overlap = overlap.map(|(overlap, _)| overlap / sharp.as_ref().map_or(1.0, SharpSplat::sum));
    let low_pass = (in_front && settings.filter == Filter::Max).then(|| LowPass {
        center: center.truncate() / center.z,
        radius: h,
        z: center.z,
        minor_px: view.focal_px * minor.max(h),
    });
    let square = (in_front && settings.rasterizer == Rasterizer::RaycastApproximate)
        .then(|| Square::around(center, s, t, low_pass.as_ref()));

    let reach = match at_border && regular {
        true => Reach::of(center, original, (s, t), h, view.near),
        false => None,
    };
    let by = reach.map_or(DVec2::ONE, |reach| reach.over_filtered);
    let (s, t) = (by.x * s, by.y * t);

    let filtered = regular && (settings.filter.adjusts() || settings.filter == Filter::Ewa);
    let plane_normal = s.cross(t).normalize();
    let (u_direction, v_direction) = (t.cross(plane_normal), plane_normal.cross(s));
    let [red, green, blue, alpha] = splats.color(i).map(f64::from);
    Some(DrawnSplat {
        source: [0, i],
        center,
        s,
        t,
        plane_normal,
        u_axis: u_direction / u_direction.dot(s),
        v_axis: v_direction / v_direction.dot(t),
        normal,
        faces_away,
        normal_in_layer,
        albedo: DVec3::new(red, green, blue),
        alpha: alpha.clamp(0.0, 1.0),
        transparent: false,
        shift,
        toward_polygon: shift.min(1.0 + polygon_reach * image_size),
        map,
        share: share / overlap.filter(|_| settings.weighs_splats()).unwrap_or(1.0),
        covering: overlap.map(|overlap| Covering {
            share: area / overlap,
            minor_px: view.focal_px * minor,
            h_px: view.focal_px * h,
            goes_on: sharp.filter(|_| !is_layered).map_or(0.0, |sharp| sharp.goes_on()),
            left_out,
            alone_in_layers: opacity == Opacity::Transparent && left_out > 0.0,
            reach,
        }),
        least_weight: settings.floors().weight,
        low_pass,
        reach,
        clip: DrawnClip::of(splats.clips.get(i), center, original, overlap.map(|_| h), filtered),
        square,
        minor_px: (!reaches_near).then_some(view.focal_px * minor),
    })
}
