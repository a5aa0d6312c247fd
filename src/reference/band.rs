//! Some rows of the picture: what is in front first, then the sums over the fragments of the opaque surface, then its
//! color, then what is transparent before it.
//!
//! This file and `polygons` name each other: polygons are looked for in the band's rows, and are a part of what it shows.

use std::ops::Range;

use glam::{DVec2, DVec3};

use super::front::Front;
use super::kernel::{decline, limit_r2, weight};
use super::layers::{Source, Translucent, Transparent};
use super::picture::Pixel;
use super::polygons;
use super::search_box::SearchBox;
use super::shade::Shader;
use super::splat::DrawnSplat;
use super::surface::{Attributes, Nearest, Sums};
use super::surfaces::surfaces;
use super::transition::{Splatted, join};
use super::triangle::DrawnTriangle;
use super::view::View;
use crate::scene::Settings;

/// Things to draw, and where each is to be looked for, in the same order.
pub(super) struct Drawn<T> {
    pub things: Vec<T>,
    pub boxes: Vec<SearchBox>,
}

/// All that every band reads.
pub(super) struct Frame<'a> {
    pub view: View,
    pub settings: &'a Settings,
    pub shader: Shader,
    pub splats: Drawn<DrawnSplat>,
    pub triangles: Drawn<DrawnTriangle>,
    pub transparent_splats: Drawn<DrawnSplat>,
    pub transparent_triangles: Drawn<DrawnTriangle>,
    /// See [`super::mesh::Triangles::has_opaque`].
    pub has_opaque_polygons: bool,
    /// The places of a pixel, from its center, at which polygons cover parts of it.
    pub polygon_offsets_px: &'static [[f64; 2]],
    /// The ε of transparent polygons: a length.
    pub polygon_epsilon: f64,
    /// Transparent surfaces cover pixels in part where they end.
    pub layers_cover_in_part: bool,
    /// Linear color and alpha of what is behind all.
    pub background: [f64; 4],
}

/// Renders `rows` into `pixels`, which must be empty pixels of exactly these rows.
pub(super) fn render(frame: &Frame, rows: Range<u32>, pixels: &mut [Pixel]) {
    let mut fronts = fronts(frame, &rows, pixels);
    let sums = accumulate(frame, &rows, &fronts, pixels);
    for (i, (pixel, sums)) in pixels.iter_mut().zip(&sums).enumerate() {
        finish_opaque(frame, frame.ray(&rows, i), &fronts[i], sums, pixel);
    }
    polygons::mark_borders(frame, &frame.triangles, &rows, &fronts, pixels);
    if frame.settings.covers_in_part() {
        cover_edges(frame, &rows, &mut fronts, pixels);
    }
    if !frame.transparent_splats.things.is_empty() || !frame.transparent_triangles.things.is_empty() {
        put_layers(frame, &rows, &fronts, pixels);
    }
}

impl Frame<'_> {
    /// Through a pixel of the band.
    fn ray(&self, rows: &Range<u32>, pixel: usize) -> DVec3 {
        let width = self.view.size_px[0] as usize;
        self.view.ray((pixel % width) as u32, rows.start + (pixel / width) as u32)
    }
}

/// The nearest opaque things, in every pixel.
fn fronts(frame: &Frame, rows: &Range<u32>, pixels: &mut [Pixel]) -> Vec<Front> {
    let splats = nearest_surface(frame, rows, pixels.len());
    let polygons = polygons::nearest(frame, rows, pixels);
    let fronts = splats.into_iter().enumerate().map(|(i, splats)| {
        let polygon = polygons.get(i).copied().flatten();
        let (transition, visible) = (frame.settings.transition, polygon.map(|polygon| polygon.nearest));
        let (front, margin) = Front::new(splats, visible, transition, frame.has_opaque_polygons);
        pixels[i].note_margin(margin);
        if let (Some(polygon), Some(_)) = (polygon, front.polygon) {
            pixels[i].note_margin(polygon.margin);
        }
        front
    });
    fronts.collect()
}

/// For every pixel the smallest `z · f` of its covering fragments (the ε-shift along the projector; Pajarola et al.
/// 2003, figure 15).
fn nearest_surface(frame: &Frame, rows: &Range<u32>, pixels: usize) -> Vec<Nearest> {
    let mut nearest = vec![Nearest::NONE; pixels];
    for_each_candidate(frame, &frame.splats.boxes, rows, |splat_index, pixel, column, row| {
        let splat = &frame.splats.things[splat_index];
        let ray = frame.view.ray(column, row);
        let Some(fragment) = splat.fragment(ray, &frame.view, frame.settings.kernel) else { return };
        let z_shifted = fragment.z * splat.shift;
        if z_shifted < nearest[pixel].z_shifted {
            nearest[pixel] = Nearest { z_shifted, splat: splat_index };
        }
    });
    nearest
}

/// The sums over all fragments of the opaque surface; writes the two diagnostics into `pixels`.
fn accumulate(frame: &Frame, rows: &Range<u32>, fronts: &[Front], pixels: &mut [Pixel]) -> Vec<Sums> {
    let view = &frame.view;
    let limit_r2 = limit_r2(frame.settings.kernel);
    let mut all = vec![Sums::default(); pixels.len()];
    for_each_candidate(frame, &frame.splats.boxes, rows, |splat_index, i, column, row| {
        let splat = &frame.splats.things[splat_index];
        let ray = view.ray(column, row);
        let (front, pixel) = (&fronts[i], &mut pixels[i]);

        let [x_px, y_px] = view.offset_px(column, row);
        if let Some(rim) = splat.rim(ray, x_px.hypot(y_px), limit_r2, view)
            && front.may_count(rim.z, splat.shift, rim.margin)
        {
            pixel.rim = true;
        }
        let Some(fragment) = splat.fragment(ray, view, frame.settings.kernel) else { return };
        let counts = front.counts(splat_index, fragment.z, splat.shift);
        pixel.note_margin(counts.margin);
        if counts.holds {
            all[i].add(fragment, splat);
        }
    });
    all
}

/// Writes the surface of the opaque splats, and the color of all that is opaque.
fn finish_opaque(frame: &Frame, ray: DVec3, front: &Front, sums: &Sums, pixel: &mut Pixel) {
    let surface = sums.surface(&frame.shader, ray);
    if let Some(surface) = &surface {
        pixel.weight = sums.weight;
        pixel.fragments = sums.fragments;
        pixel.albedo = surface.albedo.to_array();
        pixel.normal = surface.normal.to_array();
        pixel.normal_length = surface.normal_length;
        pixel.depth = surface.depth;
        pixel.color = surface.color.extend(1.0).to_array();
        pixel.alpha = surface.alpha;
    }
    if let Some(polygon) = front.polygon {
        pixel.polygon = true;
        let opaque = |attributes| Attributes { alpha: 1.0, ..attributes };
        let splats =
            surface.map(|surface| Splatted { attributes: opaque(surface.attributes()), weight: sums.weight });
        let polygon = opaque(frame.triangles.things[polygon.triangle].attributes(ray, polygon.z));
        let shade = |a: &Attributes| frame.shader.shade(a.albedo, a.normal, ray);
        let joined = join(frame.settings.transition, splats, Some(polygon), shade);
        pixel.color = joined.color.extend(1.0).to_array();
    }
}

/// Shows as much of each opaque surface as covers the pixel, over what is behind it.
fn cover_edges(frame: &Frame, rows: &Range<u32>, fronts: &mut [Front], pixels: &mut [Pixel]) {
    let mut fragments = vec![Vec::new(); pixels.len()];
    for_each_candidate(frame, &frame.splats.boxes, rows, |splat_index, i, column, row| {
        let fragment = translucent(frame, &frame.splats.things[splat_index], splat_index, [column, row]);
        fragments[i].extend(fragment);
    });
    let polygons = polygons::samples(frame, rows, pixels);
    let mut seen_to = vec![f64::INFINITY; pixels.len()];
    for (i, (fragments, polygons)) in fragments.into_iter().zip(&polygons).enumerate() {
        let ray = frame.ray(rows, i);
        let opaque = surfaces(frame, ray, (fronts[i].nearest_polygon, polygons), fragments);
        pixels[i].color = opaque.over(frame.background);
        pixels[i].note_margin(opaque.margin);
        fronts[i].hide_beyond(opaque.hides_beyond);
        seen_to[i] = opaque.seen_to;
    }
    polygons::mark_borders_of_samples(frame, rows, (&polygons, &seen_to), pixels);
}

/// A splat's fragment in a pixel; `None` where it does not cover.
fn translucent(
    frame: &Frame,
    splat: &DrawnSplat,
    splat_index: usize,
    [column, row]: [u32; 2],
) -> Option<Translucent> {
    let (ray, near, kernel) = (frame.view.ray(column, row), frame.view.near, frame.settings.kernel);
    let fragment = splat.fragment(ray, &frame.view, kernel)?;
    // With the filter `max`, where the disk is not, the low-pass filter is.
    let hit = splat.hit(ray, near);
    let r2 = hit.map_or(1.0, |hit| splat.filtered_r2(&hit));
    Some(Translucent {
        z: fragment.z,
        z_shifted: fragment.z * splat.shift,
        weight: fragment.weight,
        kernel: weight(kernel, r2),
        fall: decline(kernel, r2) * splat.change_of_filtered_r2(ray, &frame.view),
        outlined: splat.outlined(ray, &frame.view),
        r2,
        uv: hit.map_or(DVec2::X, |hit| hit.uv),
        kept: splat.kept(ray, fragment.z, &frame.view),
        source: Source::Splat(splat_index),
    })
}

/// Puts what is transparent, and not behind something opaque, over the pixels' colors.
fn put_layers(frame: &Frame, rows: &Range<u32>, fronts: &[Front], pixels: &mut [Pixel]) {
    let mut fragments = vec![Vec::new(); pixels.len()];
    collect_splats(frame, rows, fronts, pixels, &mut fragments);
    polygons::collect(frame, rows, fronts, pixels, &mut fragments);
    polygons::mark_borders(frame, &frame.transparent_triangles, rows, fronts, pixels);
    let transparent = Transparent {
        splats: &frame.transparent_splats.things,
        triangles: &frame.transparent_triangles.things,
        settings: frame.settings,
        covers_in_part: frame.layers_cover_in_part,
        shader: &frame.shader,
    };
    for (i, (pixel, fragments)) in pixels.iter_mut().zip(fragments).enumerate() {
        if !fragments.is_empty() {
            let stack = transparent.stack(frame.ray(rows, i), fragments);
            pixel.color = stack.over(pixel.color);
            pixel.layers = stack.layers;
            pixel.note_margin(stack.margin);
        }
    }
}

fn collect_splats(
    frame: &Frame,
    rows: &Range<u32>,
    fronts: &[Front],
    pixels: &mut [Pixel],
    fragments: &mut [Vec<Translucent>],
) {
    let view = &frame.view;
    let limit_r2 = limit_r2(frame.settings.kernel);
    for_each_candidate(frame, &frame.transparent_splats.boxes, rows, |splat_index, i, column, row| {
        let splat = &frame.transparent_splats.things[splat_index];
        let ray = view.ray(column, row);
        let [x_px, y_px] = view.offset_px(column, row);
        if let Some(rim) = splat.rim(ray, x_px.hypot(y_px), limit_r2, view)
            && fronts[i].may_be_seen(rim.z, rim.margin)
        {
            pixels[i].rim = true;
        }
        let Some(fragment) = translucent(frame, splat, splat_index, [column, row]) else { return };
        let seen = fronts[i].shows(fragment.z);
        pixels[i].note_margin(seen.margin);
        if seen.holds {
            fragments[i].push(fragment);
        }
    });
}

/// Calls `f(thing, pixel within the band, column, row)` for every pixel of every search box.
pub(super) fn for_each_candidate(
    frame: &Frame,
    boxes: &[SearchBox],
    rows: &Range<u32>,
    mut f: impl FnMut(usize, usize, u32, u32),
) {
    let width = frame.view.size_px[0] as usize;
    for (index, search) in boxes.iter().enumerate() {
        for row in search.clipped(rows) {
            let first = (row - rows.start) as usize * width;
            for column in search.columns.clone() {
                f(index, first + column as usize, column, row);
            }
        }
    }
}
