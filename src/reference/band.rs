//! Some rows of the picture: the nearest surface first, then the sums over its fragments, then the colors.

use std::ops::Range;

use glam::DVec3;

use super::kernel::limit_r2;
use super::picture::Pixel;
use super::search_box::SearchBox;
use super::shade::shade;
use super::splat::DrawnSplat;
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

/// The shifted depth that a fragment must not exceed, and whose it is.
#[derive(Clone, Copy)]
struct Nearest {
    z_shifted: f64,
    splat: usize,
}

/// The weighted sums of a pixel.
#[derive(Clone, Copy, Default)]
struct Sums {
    weight: f64,
    albedo: DVec3,
    normal: DVec3,
    z: f64,
    alpha: f64,
}

/// A sum of normals shorter than this share of the sum of weights is rounding noise and has no direction.
const VANISHING: f64 = 1e-12;

/// Renders `rows` into `pixels`, which must be empty pixels of exactly these rows.
pub(super) fn render(frame: &Frame, rows: Range<u32>, pixels: &mut [Pixel]) {
    let nearest = nearest_surface(frame, &rows, pixels.len());
    let sums = accumulate(frame, &rows, &nearest, pixels);
    let width = frame.view.size_px[0] as usize;
    for (i, (pixel, sums)) in pixels.iter_mut().zip(&sums).enumerate() {
        if sums.weight > 0.0 {
            let (column, row) = ((i % width) as u32, rows.start + (i / width) as u32);
            normalize(pixel, sums, frame, frame.view.ray(column, row));
        }
    }
}

/// For every pixel the smallest `z · f` of its covering fragments (the ε-shift along the projector; Pajarola et al.
/// 2003, figure 15).
fn nearest_surface(frame: &Frame, rows: &Range<u32>, pixels: usize) -> Vec<Nearest> {
    let mut nearest = vec![Nearest { z_shifted: f64::INFINITY, splat: usize::MAX }; pixels];
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
            let sums = &mut all[i];
            sums.weight += fragment.weight;
            sums.albedo += fragment.weight * splat.albedo;
            sums.normal += fragment.weight * splat.normal;
            sums.z += fragment.weight * fragment.z;
            sums.alpha += fragment.weight * splat.alpha;
        }
    });
    all
}

/// Guennebaud et al. 2006, eq. 1, then the shading.
fn normalize(pixel: &mut Pixel, sums: &Sums, frame: &Frame, ray: DVec3) {
    let albedo = sums.albedo / sums.weight;
    let vanishes = sums.normal.length() <= VANISHING * sums.weight;
    let normal = if vanishes { DVec3::NEG_Z } else { sums.normal.normalize() };
    let color = shade(frame.settings.shading, albedo, normal, ray);
    pixel.weight = sums.weight;
    pixel.albedo = albedo.to_array();
    pixel.normal = normal.to_array();
    pixel.depth = sums.z / sums.weight;
    pixel.color = color.extend(1.0).to_array();
    pixel.alpha = sums.alpha / sums.weight;
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
