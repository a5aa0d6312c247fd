//! Some rows of the picture: the nearest surface first, then the sums over its fragments, then the colors.

use std::ops::Range;

use super::kernel::limit_r2;
use super::picture::Pixel;
use super::search_box::SearchBox;
use super::splat::DrawnSplat;
use super::surface::{Nearest, Sums};
use super::view::View;
use crate::scene::Settings;

/// All that every band reads.
pub(super) struct Frame<'a> {
    pub view: View,
    pub settings: &'a Settings,
    pub splats: Vec<DrawnSplat>,
    /// Of `splats`, in their order.
    pub boxes: Vec<SearchBox>,
}

/// Renders `rows` into `pixels`, which must be empty pixels of exactly these rows.
pub(super) fn render(frame: &Frame, rows: Range<u32>, pixels: &mut [Pixel]) {
    let nearest = nearest_surface(frame, &rows, pixels.len());
    let sums = accumulate(frame, &rows, &nearest, pixels);
    let width = frame.view.size_px[0] as usize;
    for (i, (pixel, sums)) in pixels.iter_mut().zip(&sums).enumerate() {
        let (column, row) = ((i % width) as u32, rows.start + (i / width) as u32);
        let ray = frame.view.ray(column, row);
        if let Some(surface) = sums.surface(frame.settings.shading, ray) {
            pixel.weight = sums.weight;
            pixel.fragments = sums.fragments;
            pixel.albedo = surface.albedo.to_array();
            pixel.normal = surface.normal.to_array();
            pixel.normal_length = surface.normal_length;
            pixel.depth = surface.depth;
            pixel.color = surface.color.extend(1.0).to_array();
            pixel.alpha = surface.alpha;
        }
    }
}

/// For every pixel the smallest `z · f` of its covering fragments (the ε-shift along the projector; Pajarola et al.
/// 2003, figure 15).
fn nearest_surface(frame: &Frame, rows: &Range<u32>, pixels: usize) -> Vec<Nearest> {
    let mut nearest = vec![Nearest::NONE; pixels];
    for_each_candidate(frame, rows, |splat_index, pixel, column, row| {
        let splat = &frame.splats[splat_index];
        let ray = frame.view.ray(column, row);
        let Some(fragment) = splat.fragment(ray, frame.view.near, frame.settings.kernel) else { return };
        let z_shifted = fragment.z * splat.shift;
        if z_shifted < nearest[pixel].z_shifted {
            nearest[pixel] = Nearest { z_shifted, splat: splat_index };
        }
    });
    nearest
}

/// The sums over all fragments at or before the nearest shifted depth; writes the two diagnostics into `pixels`.
fn accumulate(frame: &Frame, rows: &Range<u32>, nearest: &[Nearest], pixels: &mut [Pixel]) -> Vec<Sums> {
    let view = &frame.view;
    let limit_r2 = limit_r2(frame.settings.kernel);
    let mut all = vec![Sums::default(); pixels.len()];
    for_each_candidate(frame, rows, |splat_index, i, column, row| {
        let splat = &frame.splats[splat_index];
        let ray = view.ray(column, row);
        let (nearest, pixel) = (&nearest[i], &mut pixels[i]);

        let [x_px, y_px] = view.offset_px(column, row);
        if let Some(rim) = splat.rim(ray, x_px.hypot(y_px), limit_r2, view)
            && rim.z <= nearest.z_shifted * (1.0 + rim.margin)
        {
            pixel.rim = true;
        }
        let Some(fragment) = splat.fragment(ray, view.near, frame.settings.kernel) else { return };
        if splat_index != nearest.splat {
            let margin = (fragment.z - nearest.z_shifted).abs() / nearest.z_shifted;
            pixel.epsilon_margin = pixel.epsilon_margin.min(margin);
        }
        if fragment.z <= nearest.z_shifted {
            all[i].add(fragment, splat);
        }
    });
    all
}

/// Calls `f(splat, pixel within the band, column, row)` for every pixel of every splat's search box.
fn for_each_candidate(frame: &Frame, rows: &Range<u32>, mut f: impl FnMut(usize, usize, u32, u32)) {
    let width = frame.view.size_px[0] as usize;
    for (splat_index, search) in frame.boxes.iter().enumerate() {
        for row in search.clipped(rows) {
            let first = (row - rows.start) as usize * width;
            for column in search.columns.clone() {
                f(splat_index, first + column as usize, column, row);
            }
        }
    }
}
