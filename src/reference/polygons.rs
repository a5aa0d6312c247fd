//! The polygons of some rows of the picture.

use std::ops::Range;

use glam::{DVec2, DVec3};

use super::band::{Drawn, Frame, for_each_candidate};
use super::decision::Decision;
use super::drawn_clip::Clipped;
use super::front::{Front, VisiblePolygon};
use super::layers::{Source, Translucent};
use super::picture::Pixel;
use super::triangle::DrawnTriangle;
use super::view::View;
use crate::scene::{Object, Opacity, Scene, Settings};

/// Within that of a triangle's border, in pixels, another rasterizer may find a pixel on its other side: by what snapping
/// vertices to a grid of 1/256 pixel moves an edge, √2/512 pixel.
const BORDER_MARGIN_PX: f64 = 1.0 / 256.0;

/// How far a depth may be off at a border, relative.
const DEPTH_MARGIN: f64 = 1e-3;

/// In the middle of a pixel.
pub(super) const CENTER: [[f64; 2]; 1] = [[0.0; 2]];

/// Four places about the center, under a Gaussian of σ = √2 / 2 pixels: its quantiles at 3/8 and 1/8 are at 0.319 σ and 1.150 σ; in 256ths of a pixel.
const FOUR: [[f64; 2]; 4] =
    [[-0.226_562_5, -0.8125], [0.8125, -0.226_562_5], [-0.8125, 0.226_562_5], [0.226_562_5, 0.8125]];

/// The places of a pixel at which polygons cover parts of it: four beside splats that do; the center where there are several samples of the picture, and
/// where edges are hard. `alone`: the picture is of one sample.
pub(super) fn offsets_px(scene: &Scene, settings: &Settings, alone: bool) -> &'static [[f64; 2]] {
    let is_opaque =
        |object: &Object| !object.splats.is_empty() && object.splats.colors.opacity() == Opacity::Opaque;
    match alone && settings.covers_in_part() && scene.objects.iter().any(is_opaque) {
        true => &FOUR,
        false => &CENTER,
    }
}

/// The nearest opaque polygon of a pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct NearestPolygon {
    pub nearest: VisiblePolygon,
    /// How much farther the next one is, relative.
    pub margin: f64,
}

/// That of one place of a pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct SampledPolygon {
    /// Which of [`Frame::polygon_offsets_px`].
    pub sample: usize,
    pub ray: DVec3,
    pub nearest: VisiblePolygon,
    /// As [`NearestPolygon::margin`].
    pub margin: f64,
}

/// For every pixel the nearest of the opaque polygons, of two at one depth the first; empty without polygons.
pub(super) fn nearest(frame: &Frame, rows: &Range<u32>, pixels: &mut [Pixel]) -> Vec<Option<NearestPolygon>> {
    nearest_at(frame, rows, CENTER[0], pixels)
}

/// For every pixel the nearest of them at each of its samples.
pub(super) fn samples(frame: &Frame, rows: &Range<u32>, pixels: &mut [Pixel]) -> Vec<Vec<SampledPolygon>> {
    let mut all = vec![Vec::new(); pixels.len()];
    let width = frame.view.size_px[0] as usize;
    for (sample, offset_px) in frame.polygon_offsets_px.iter().enumerate() {
        for (i, polygon) in nearest_at(frame, rows, *offset_px, pixels).into_iter().enumerate() {
            let (column, row) = ((i % width) as u32, rows.start + (i / width) as u32);
            let ray = frame.view.ray_beside(column, row, *offset_px);
            let of_sample =
                |NearestPolygon { nearest, margin }| SampledPolygon { sample, ray, nearest, margin };
            all[i].extend(polygon.map(of_sample));
        }
    }
    all
}

fn nearest_at(
    frame: &Frame,
    rows: &Range<u32>,
    offset_px: [f64; 2],
    pixels: &mut [Pixel],
) -> Vec<Option<NearestPolygon>> {
    if frame.triangles.things.is_empty() {
        return Vec::new();
    }
    let mut all: Vec<Option<NearestPolygon>> = vec![None; pixels.len()];
    for_each_fragment(frame, &frame.triangles, (rows, offset_px), pixels, |triangle, i, z, _| {
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
    for_each_fragment(
        frame,
        &frame.transparent_triangles,
        (rows, CENTER[0]),
        pixels,
        |triangle, i, z, pixel| {
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
                    uv: DVec2::ZERO,
                    fall: DVec2::ZERO,
                    outlined: 0.0,
                    kept: None,
                    source,
                });
            }
        },
    );
}

/// Calls `f(triangle, pixel within the band, z, pixel)` for every fragment, at a place of each pixel.
fn for_each_fragment(
    frame: &Frame,
    triangles: &Drawn<DrawnTriangle>,
    (rows, offset_px): (&Range<u32>, [f64; 2]),
    pixels: &mut [Pixel],
    mut f: impl FnMut(usize, usize, f64, &mut Pixel),
) {
    let View { near, .. } = frame.view;
    for_each_candidate(frame, &triangles.boxes, rows, |triangle, i, column, row| {
        let ray = frame.view.ray_beside(column, row, offset_px);
        let Some(z) = triangles.things[triangle].depth(ray) else { return };
        pixels[i].note_margin(Decision::at_most(z, near).margin);
        let cut = frame.view.cuts(ray, z);
        pixels[i].rim |= z >= near && cut == Clipped::Undecided;
        if z >= near && frame.view.inside_px(ray, z) >= 0.0 {
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
            pixels[i].border_px = pixels[i].border_px.min(border.distance_px);
            pixels[i].rim |= border.distance_px <= margin_px(&frame.view, column, row);
        }
    });
}

/// Writes whether a sample of a pixel is at a border of a polygon that is not hidden: by another one there, or by what is nearer than `seen_to`.
pub(super) fn mark_borders_of_samples(
    frame: &Frame,
    rows: &Range<u32>,
    (samples, seen_to): (&[Vec<SampledPolygon>], &[f64]),
    pixels: &mut [Pixel],
) {
    let triangles = &frame.triangles;
    for (number, offset_px) in frame.polygon_offsets_px.iter().enumerate() {
        for_each_candidate(frame, &triangles.boxes, rows, |triangle, i, column, row| {
            let ray = frame.view.ray_beside(column, row, *offset_px);
            let Some(border) = triangles.things[triangle].border(ray, &frame.view) else { return };
            let nearest = samples[i].iter().find(|polygon| polygon.sample == number);
            let hidden_from = nearest.map_or(f64::INFINITY, |polygon| polygon.nearest.z).min(seen_to[i]);
            let is_near = border.distance_px <= margin_px(&frame.view, column, row);
            pixels[i].rim |= is_near && border.z <= hidden_from * (1.0 + DEPTH_MARGIN);
        });
    }
}

/// Within that of a border, an edge may lie on the other side of the middle of a pixel, or of a sample.
fn margin_px(view: &View, column: u32, row: u32) -> f64 {
    let [x_px, y_px] = view.offset_px(column, row);
    BORDER_MARGIN_PX + 16.0 * 0.5_f64.powi(24) * x_px.hypot(y_px)
}
