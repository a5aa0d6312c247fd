//! The polygons of some rows of the picture.

use glam::DVec2;

use std::ops::Range;

use super::band::{Drawn, Frame, for_each_candidate};
use super::decision::Decision;
use super::drawn_clip::Clipped;
use super::front::{Front, VisiblePolygon};
use super::layers::{Source, Translucent};
use super::picture::Pixel;
use super::triangle::DrawnTriangle;
use super::view::View;

/// Within that of a triangle's border, in pixels, another rasterizer may find a pixel on its other side: by what snapping
/// vertices to a grid of 1/256 pixel moves an edge, √2/512 pixel.
const BORDER_MARGIN_PX: f64 = 1.0 / 256.0;

/// How far a depth may be off at a border, relative.
const DEPTH_MARGIN: f64 = 1e-3;

/// The nearest opaque polygon of a pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct NearestPolygon {
    pub nearest: VisiblePolygon,
    /// How much farther the next one is, relative.
    pub margin: f64,
}

/// For every pixel the nearest of the opaque polygons, of two at one depth the first; empty without polygons.
pub(super) fn nearest(frame: &Frame, rows: &Range<u32>, pixels: &mut [Pixel]) -> Vec<Option<NearestPolygon>> {
    if frame.triangles.things.is_empty() {
        return Vec::new();
    }
    let mut all: Vec<Option<NearestPolygon>> = vec![None; pixels.len()];
    for_each_fragment(frame, &frame.triangles, rows, pixels, |triangle, i, z, _| {
        let new = NearestPolygon { nearest: VisiblePolygon { z, triangle }, margin: f64::INFINITY };
        all[i] = Some(match all[i] {
            None => new,
            Some(old) => {
                let (mut nearest, other) = if z < old.nearest.z { (new, old) } else { (old, new) };
                let margin = Decision::at_most(other.nearest.z, nearest.nearest.z).margin;
                nearest.margin = nearest.margin.min(margin);
                nearest
            }
        });
    });
    all
}

/// Adds to every pixel the fragments of transparent polygons that nothing opaque hides.
pub(super) fn collect(
    frame: &Frame,
    rows: &Range<u32>,
    fronts: &[Front],
    pixels: &mut [Pixel],
    fragments: &mut [Vec<Translucent>],
) {
    for_each_fragment(frame, &frame.transparent_triangles, rows, pixels, |triangle, i, z, pixel| {
        let seen = fronts[i].shows(z);
        pixel.note_margin(seen.margin);
        if seen.holds {
            let (z_shifted, source) = (z + frame.polygon_epsilon, Source::Triangle(triangle));
            fragments[i].push(Translucent {
                z,
                z_shifted,
                weight: 1.0,
                kernel: 1.0,
                r2: 0.0,
                fall: DVec2::ZERO,
                kept: None,
                source,
            });
        }
    });
}

/// Calls `f(triangle, pixel within the band, z, pixel)` for every fragment.
fn for_each_fragment(
    frame: &Frame,
    triangles: &Drawn<DrawnTriangle>,
    rows: &Range<u32>,
    pixels: &mut [Pixel],
    mut f: impl FnMut(usize, usize, f64, &mut Pixel),
) {
    let View { near, .. } = frame.view;
    for_each_candidate(frame, &triangles.boxes, rows, |triangle, i, column, row| {
        let Some(z) = triangles.things[triangle].depth(frame.view.ray(column, row)) else { return };
        pixels[i].note_margin(Decision::at_most(z, near).margin);
        let cut = frame.view.cuts(frame.view.ray(column, row), z);
        pixels[i].rim |= z >= near && cut == Clipped::Undecided;
        if z >= near && frame.view.inside_px(frame.view.ray(column, row), z) >= 0.0 {
            f(triangle, i, z, &mut pixels[i]);
        }
    });
}

/// Writes how near each pixel is to a border of a polygon that is not hidden.
pub(super) fn mark_borders(
    frame: &Frame,
    triangles: &Drawn<DrawnTriangle>,
    rows: &Range<u32>,
    fronts: &[Front],
    pixels: &mut [Pixel],
) {
    for_each_candidate(frame, &triangles.boxes, rows, |triangle, i, column, row| {
        let ray = frame.view.ray(column, row);
        let Some(border) = triangles.things[triangle].border(ray, &frame.view) else { return };
        if fronts[i].may_be_seen(border.z, DEPTH_MARGIN) {
            let [x_px, y_px] = frame.view.offset_px(column, row);
            let margin_px = BORDER_MARGIN_PX + 16.0 * 0.5_f64.powi(24) * x_px.hypot(y_px);
            pixels[i].border_px = pixels[i].border_px.min(border.distance_px);
            pixels[i].rim |= border.distance_px <= margin_px;
        }
    });
}
