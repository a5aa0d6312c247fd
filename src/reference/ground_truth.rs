//! The image that every filter aims at: the continuous surface, low-passed.
//!
//! The normalized surface of the unfiltered splats (exact rasterization, ε-visibility in each sample) is sampled on a
//! regular grid within each pixel, shaded, and low-passed by the Gaussian that the filters stand for. Samples reach
//! beyond the image's border as far as the filter does, so that pixels at the border are like any other.
//!
//! One sample row after the other: the filter is separable, so that each is low-passed along itself first and then
//! added to the pixel rows that it reaches.

use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

use glam::DVec3;

use super::bands;
use super::edges::{Edge, Edges, Seen};
use super::fragment::Fragment;
use super::kernel::limit_r2;
use super::low_pass_taps::Taps;
use super::row_span::row_span;
use super::search_box::SearchBox;
use super::shade::Shader;
use super::splat::{self, DrawnSplat};
use super::surface::{Nearest, Sums};
use super::true_pixel::{Channels, GroundTruth, TruePixel, add, channels};
use super::view::View;
use crate::error::{Error, Result};
use crate::scene::{Camera, Filter, FilterWeight, Kernel, Rasterizer, Scene, Settings, Shading};

/// Pixel rows that a thread takes at a time. The sample rows that the filter reaches beyond them are sampled twice.
const BAND_ROWS: usize = 32;

/// The most samples that a thread holds at a time.
const STRIP_SAMPLES: usize = 1 << 17;

/// The most samples along a pixel's side.
pub const MOST_SAMPLES_PER_SIDE: u32 = 256;

/// The most samples of a picture: 8192² pixels with 256 each.
const MAX_SAMPLES: u64 = 1 << 34;

/// All that every band reads.
struct Field<'a> {
    /// With samples for pixels, and wider than the picture by the filter's reach.
    view: View,
    samples_per_side: usize,
    width_px: usize,
    kernel: Kernel,
    limit_r2: f64,
    shader: Shader,
    taps: &'a Taps,
    splats: Vec<DrawnSplat>,
    /// The search boxes of `splats`, in samples.
    boxes: Vec<SearchBox>,
    /// The x of each sample column in the image plane.
    columns: Vec<f64>,
}

/// Renders what every filter of `scene`, seen by `camera`, aims at, with `samples_per_side` squared samples a
/// pixel: 16 and more for a picture that others are judged by.
///
/// It draws every splat as opaque, and no mesh. Of the settings it reads size, kernel, ε, back faces and shading. The filter's standard deviation is `σ h`, with
/// h = √2 pixels and σ that of a Gaussian kernel, or ½ for another; it is cut off at 4 of them. Splats with a
/// [`crate::scene::Defect`] are left out and counted. Uses all cores; the picture does not depend on how many.
/// `progress(done, total)` is called from several threads, with rows.
///
/// # Errors
/// [`crate::error::ErrorKind::Option`] for settings or a camera out of range, for eye-dome lighting, for a number of samples
/// outside 1–256 or more than 2³⁴ in all, and for a size that memory can't hold.
pub fn ground_truth(
    scene: &Scene,
    camera: &Camera,
    settings: &Settings,
    samples_per_side: u32,
    progress: &(dyn Fn(u64, u64) + Sync),
) -> Result<GroundTruth> {
    settings.validate()?;
    camera.validate()?;
    settings.check_camera(camera)?;
    if settings.shading == Shading::EyeDome {
        let problem = "edl: is of pixels, and the ground truth's samples have other neighbors; expected another shading";
        return Err(Error::option("--shading", problem));
    }
    let [width, height] = settings.size_px;
    check_samples(settings.size_px, samples_per_side)?;
    let taps = Taps::new(settings.kernel, samples_per_side)?;

    let plain = Settings {
        rasterizer: Rasterizer::Perspective,
        filter: Filter::None,
        filter_weight: FilterWeight::Unit,
        ..settings.clone()
    };
    let view = View::of(scene, camera, settings.size_px)
        .cut_by(scene, settings)
        .sampled(taps.reach_px, samples_per_side);
    let (splats, defects) = splat::prepare(scene, &view, &plain);
    let limit_r2 = limit_r2(settings.kernel);
    let field = Field {
        view,
        samples_per_side: samples_per_side as usize,
        width_px: width as usize,
        kernel: settings.kernel,
        limit_r2,
        shader: Shader::new(settings.shading, scene, view.from_world.rotation),
        taps: &taps,
        boxes: splats.iter().map(|splat| SearchBox::of_disk(splat, limit_r2, &view)).collect(),
        splats,
        columns: (0..view.size_px[0]).map(|column| view.ray(column, 0).x).collect(),
    };

    let mut pixels = empty_pixels(settings.size_px)?;
    let rows_done = AtomicU64::new(0);
    progress(0, u64::from(height));
    bands::for_each(&mut pixels, width as usize * BAND_ROWS, |i, pixels| {
        let rows = pixels.len() / field.width_px;
        field.render(i * BAND_ROWS, pixels);
        let done = rows_done.fetch_add(rows as u64, Ordering::Relaxed) + rows as u64;
        progress(done, u64::from(height));
    });
    pixels.iter_mut().for_each(|pixel| pixel.depth -= view.moved_back);
    Ok(GroundTruth { size_px: settings.size_px, pixels, defects })
}

fn check_samples(size_px: [u32; 2], samples_per_side: u32) -> Result<()> {
    if !(1..=MOST_SAMPLES_PER_SIDE).contains(&samples_per_side) {
        let problem =
            format!("{samples_per_side}: expected 1 to {MOST_SAMPLES_PER_SIDE} along a pixel's side");
        return Err(Error::option("--samples", problem));
    }
    let [width, height] = size_px.map(u64::from);
    let total = width * height * u64::from(samples_per_side).pow(2);
    if total > MAX_SAMPLES {
        let problem = format!(
            "{width}x{height} with {samples_per_side} samples along a pixel's side are {total} samples: expected at \
             most {MAX_SAMPLES}"
        );
        return Err(Error::option("--size", problem));
    }
    Ok(())
}

fn empty_pixels([width, height]: [u32; 2]) -> Result<Vec<TruePixel>> {
    let too_large = || Error::option("--size", format!("{width}x{height}: memory can't hold the picture"));
    let count = usize::try_from(u64::from(width) * u64::from(height)).map_err(|_| too_large())?;
    let mut pixels = Vec::new();
    pixels.try_reserve_exact(count).map_err(|_| too_large())?;
    pixels.resize(count, TruePixel::EMPTY);
    Ok(pixels)
}

impl Field<'_> {
    /// Renders the pixel rows from `first_row` on into `pixels`.
    fn render(&self, first_row: usize, pixels: &mut [TruePixel]) {
        let n = self.samples_per_side;
        let first = first_row * n;
        let end = (first_row + pixels.len() / self.width_px) * n + 2 * self.taps.reach_px as usize * n;
        let here: Vec<usize> = (0..self.splats.len())
            .filter(|&i| !self.boxes[i].clipped(&(first as u32..end as u32)).is_empty())
            .collect();

        let strip_rows = (STRIP_SAMPLES / self.columns.len()).clamp(1, n);
        let mut sums = vec![Channels::default(); pixels.len()];
        let mut line = vec![Channels::default(); self.width_px];
        let (mut edges, mut found) = (self.edges(), vec![Edge::None; pixels.len()]);
        for start in (first..end).step_by(strip_rows) {
            let rows = start..(start + strip_rows).min(end);
            let Some((samples, seen)) = self.sample(&here, rows.start as u32..rows.end as u32) else {
                // Nothing in all of its rows, which the next row's neighbors are, too.
                edges.mark(start - first, &vec![Seen::NOTHING; self.columns.len()], &mut found);
                continue;
            };
            let lines = samples.chunks(self.columns.len()).zip(seen.chunks(self.columns.len()));
            for (row, (samples, seen)) in rows.zip(lines) {
                edges.mark(row - first, seen, &mut found);
                self.filter_along(samples, &mut line);
                for (i, sums) in sums.chunks_mut(self.width_px).enumerate() {
                    let tap = (row - first).checked_sub(i * n).and_then(|tap| self.taps.weights.get(tap));
                    if let Some(&tap) = tap {
                        sums.iter_mut().zip(&line).for_each(|(sum, value)| add(sum, tap, value));
                    }
                }
            }
        }
        for ((pixel, sums), edge) in pixels.iter_mut().zip(&sums).zip(found) {
            *pixel = TruePixel { edge, ..TruePixel::from_sums(sums) };
        }
    }

    fn edges(&self) -> Edges {
        Edges {
            pixel: self.samples_per_side as f64 / self.view.focal_px,
            samples_per_side: self.samples_per_side,
            margin_px: self.taps.reach_px as usize,
            width_px: self.width_px,
            above: Vec::new(),
        }
    }

    /// The surface in each sample of `rows`, seen by the splats of the list `here`, and what matters of it for edges; `None` where
    /// none is near.
    fn sample(&self, here: &[usize], rows: Range<u32>) -> Option<(Vec<Channels>, Vec<Seen>)> {
        let count = rows.len() * self.columns.len();
        let mut nearest = vec![Nearest::NONE; count];
        let mut any = false;
        self.for_each_fragment(here, &rows, |i, splat_index, splat, fragment| {
            let z_shifted = fragment.z * splat.shift;
            if z_shifted < nearest[i].z_shifted {
                nearest[i] = Nearest { z_shifted, splat: splat_index };
            }
            any = true;
        });
        if !any {
            return None;
        }
        let mut sums = vec![Sums::default(); count];
        self.for_each_fragment(here, &rows, |i, _, splat, fragment| {
            if fragment.z <= nearest[i].z_shifted {
                sums[i].add(fragment, splat);
            }
        });
        let mut samples = vec![Channels::default(); count];
        let mut seen = vec![Seen::NOTHING; count];
        for (i, sums) in sums.iter().enumerate() {
            let (row, column) = (rows.start + (i / self.columns.len()) as u32, i % self.columns.len());
            let ray = DVec3::new(self.columns[column], self.view.ray(0, row).y, 1.0);
            let Some(surface) = sums.surface(&self.shader, ray) else { continue };
            samples[i] = channels(&surface);
            let (z, z_shifted) = (surface.depth, nearest[i].z_shifted);
            seen[i] = Seen::surface(z, z_shifted, surface.normal, ray, 1.0 / self.view.focal_px);
        }
        Some((samples, seen))
    }

    /// Calls `f(sample within the rows, splat index, splat, fragment)` for every fragment.
    fn for_each_fragment(
        &self,
        here: &[usize],
        rows: &Range<u32>,
        mut f: impl FnMut(usize, usize, &DrawnSplat, Fragment),
    ) {
        for &splat_index in here {
            let (splat, search) = (&self.splats[splat_index], &self.boxes[splat_index]);
            for row in search.clipped(rows) {
                let first = (row - rows.start) as usize * self.columns.len();
                let y = self.view.ray(0, row).y;
                for column in row_span(splat, search, self.limit_r2, y, &self.view) {
                    let ray = DVec3::new(self.columns[column], y, 1.0);
                    if let Some(fragment) = splat.fragment(ray, &self.view, self.kernel) {
                        f(first + column, splat_index, splat, fragment);
                    }
                }
            }
        }
    }

    /// One row of samples to one value a pixel column.
    fn filter_along(&self, samples: &[Channels], line: &mut [Channels]) {
        for (column, value) in line.iter_mut().enumerate() {
            *value = Channels::default();
            let first = column * self.samples_per_side;
            for (tap, sample) in self.taps.weights.iter().zip(&samples[first..]) {
                add(value, *tap, sample);
            }
        }
    }
}
