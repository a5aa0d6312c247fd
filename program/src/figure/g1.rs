//! Guennebaud et al. 2006, figure 1: what the filters make of one splat.

use surfel::{Result, scene::Filter};

use super::{
    context::FigureContext,
    footprint::{Footprint, RoundSplat},
    raster::Raster,
    sheet::{Panel, Sheet},
};

/// A row of the figure.
struct Case {
    name: &'static str,
    splat: RoundSplat,
    /// The part of the image that a panel shows.
    window_px: u16,
}

const CASES: [Case; 3] = [
    Case { name: "Magnification", splat: RoundSplat { radius_px: 7.0, tilt_deg: 50.0 }, window_px: 24 },
    Case { name: "Minification", splat: RoundSplat { radius_px: 0.35, tilt_deg: 50.0 }, window_px: 6 },
    Case { name: "Both", splat: RoundSplat { radius_px: 8.0, tilt_deg: 87.5 }, window_px: 24 },
];

/// EWA comes first: the others are judged by it.
const FILTERS: [(Filter, &str); 5] = [
    (Filter::Ewa, "full EWA"),
    (Filter::None, "unfiltered"),
    (Filter::Adjust, "adjust (surfel)"),
    (Filter::AdjustPaper, "adjust (paper)"),
    (Filter::Max, "maximum"),
];

/// Samples along a pixel, at most.
const MOST_SAMPLES: u32 = 16;

/// The lines of equal weight, over the largest weight.
const CONTOURS: [f32; 2] = [0.5, 0.15];

const CONTOUR: [u8; 3] = [213, 40, 0];
const PIXEL_CENTER: [u8; 3] = [0, 114, 178];

/// Draws the figure.
pub fn draw(context: &mut FigureContext<'_>) -> Result<Sheet> {
    let mut panels = Vec::new();
    let mut headings = Vec::new();
    for Case { name, splat, window_px } in CASES {
        let [major, minor] = splat.half_axes_px();
        headings.push(format!(
            "{name}: the splat's half axes are {major:.2} and {minor:.2} px; the window is {window_px} px wide; the paper's \
             tangents are {:.0}° apart",
            splat.paper_angle_deg()
        ));
        let samples = (context.size_px[0] / u32::from(window_px)).clamp(1, MOST_SAMPLES) as u16;
        let mut ewa = None;
        for (filter, name) in FILTERS {
            let drawn = splat.footprint(context, filter, window_px, samples)?;
            let ewa =
                ewa.get_or_insert_with(|| Footprint { side: drawn.side, weights: drawn.weights.clone() });
            let caption = match filter {
                Filter::Ewa => format!("peak {:.3}", drawn.peak()),
                _ => {
                    format!("peak {:.3}, shape {:.0}% off", drawn.peak(), 100.0 * drawn.shape_difference(ewa))
                }
            };
            let picture = panel(&drawn, ewa, window_px.into(), context.size_px)?;
            panels.push(Panel::new(name, caption, picture));
        }
    }
    Ok(Sheet {
        title: "The footprints of the filters (Guennebaud et al. 2006, figure 1)".to_owned(),
        headings,
        columns: FILTERS.len(),
        panels,
        notes: vec![
            "Gray: the weight of one round splat over the image, white is 0, the darkest is the filter's own peak. Blue: the \
             pixel centers, where it is sampled. Red: where full EWA has 50% and 15% of its peak. \"Off\": the sum of the \
             differences to full EWA, both with peak 1, over the sum of EWA."
                .to_owned(),
            "Drawn by the device at pixel size, in many frames that are shifted by parts of a pixel. Gaussian kernel, sigma \
             0.5 radii; low-pass radius sqrt 2 px; the splat is 45° off the axis of the view."
                .to_owned(),
        ],
    })
}

/// Gray weights with pixel centers and the contours of EWA.
fn panel(drawn: &Footprint, ewa: &Footprint, window_px: u32, size_px: [u32; 2]) -> Result<Raster> {
    let mut raster = Raster::white(size_px)?;
    let size = size_px[0] as usize;
    let (shape, exact) = (drawn.shape(), ewa.shape());
    let fine = |x: usize, y: usize| (y * drawn.side / size) * drawn.side + x * drawn.side / size;
    for y in 0..size {
        for x in 0..size {
            let gray = (255.0 - 225.0 * shape[fine(x, y)]) as u8;
            let here = exact[fine(x, y)];
            let neighbors =
                [[x + 1, y], [x, y + 1]].map(|[x, y]| exact[fine(x.min(size - 1), y.min(size - 1))]);
            let crossed = |level: &f32| neighbors.iter().any(|there| (here < *level) != (*there < *level));
            let contour = CONTOURS.iter().any(crossed);
            raster.pixels[y * size + x] = if contour { CONTOUR } else { [gray; 3] };
        }
    }
    for i in 0..window_px * window_px {
        let [x, y] =
            [i % window_px, i / window_px].map(|k| ((2 * k + 1) * size_px[0] / (2 * window_px)) as usize);
        let [left, above] = [x.saturating_sub(1), y.saturating_sub(1)];
        for [x, y] in [[x, y], [left, y], [x, above], [left, above]] {
            raster.pixels[y * size + x] = PIXEL_CENTER;
        }
    }
    Ok(raster)
}
