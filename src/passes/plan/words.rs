//! The plan in words, for `--explain`.

use crate::passes::{
    pipeline::splat_shaders::Primitive,
    plan::{SplatMethod, SurfacePlan},
};
use crate::scene::{Accumulate, Settings};

impl SurfacePlan<'_> {
    /// How splats are drawn, and why so; `None` where there are none.
    pub fn explained(&self, settings: &Settings) -> Option<String> {
        if self.splats.is_empty() {
            return None;
        }
        let reason = self.reason;
        let (how, lists_visible, culls_hidden) = match &self.method {
            SplatMethod::Primitives { visible, culls_hidden } => {
                let primitive = match Primitive::of(settings.rasterizer) {
                    Primitive::Point => "points",
                    Primitive::Quad => "quads",
                    Primitive::Triangle => "triangles",
                };
                (format!("as {primitive}: {reason}"), visible.is_some(), *culls_hidden)
            }
            SplatMethod::Tiles(bands) => {
                let band = bands.first()?;
                let (plan, most) = (&band.plan, band.plan.most_tiles);
                let (height, draws) = (plan.invocations.tile_height(), plan.invocations.draws());
                let large = match plan.may_be_large {
                    true => "; what touches more, or comes near the eye, as quads",
                    false => "",
                };
                let in_bands = match bands.len() {
                    1 => String::new(),
                    bands => format!(", in {bands} bands for the lists' memory"),
                };
                let how = format!(
                    "by tiles of 8x{height} pixels in compute ({reason}), {draws} an invocation, splats of up to {most} \
                     tiles{large}{in_bands}"
                );
                (how, band.visible.is_some(), plan.hidden)
            }
        };
        let visible = if lists_visible { "; those that may be seen, by a list" } else { "" };
        let hidden = if culls_hidden { "; what is hidden, left out of sums" } else { "" };
        let (accumulate, why) = (self.settings.accumulate, self.sums);
        // In registers they are never less than 32 bits.
        let half_in_images = accumulate == Accumulate::F16 && !self.bands().is_empty();
        let sums = if half_in_images { "sums in images" } else { "sums" };
        Some(format!("{how}{visible}{hidden}; {sums} are {} ({why})", accumulate.name()))
    }
}
