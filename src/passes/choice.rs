//! Which way splats are drawn where the settings leave it open (`--rasterizer auto`).

use super::{Draw, Part, splat_shaders::Primitive, tiles::STORAGE_BUFFERS};
use crate::{
    error::{Error, Result},
    scene::{Cull, Filter, KernelEval, Rasterizer, Settings},
    vk::Limits,
};

/// Whether splats are drawn by tiles: why, or why not.
///
/// On CPU drivers tiles take a quarter to a fifth of the time of points, from 154 thousand splats to 5 million, and two fifths with ten
/// thousand; with some hundred opaque ones, which are large, points are as fast, so that few keep their few passes and no lists
/// (`benches/README.md`). On GPUs that was not measured yet, so that they keep to points.
///
/// # Errors
/// The reason against, as a sentence.
pub(super) fn by_tiles(
    draws: &[Draw<'_>],
    beside_polygons: bool,
    settings: &Settings,
    limits: &Limits,
) -> std::result::Result<&'static str, &'static str> {
    let opaque_alone = !beside_polygons && draws.iter().all(|draw| !draw.chunk.transparent);
    let few = opaque_alone && are_few(count_of(draws), settings);
    by_tiles_of(few, settings, limits)
}

fn by_tiles_of(
    few: bool,
    settings: &Settings,
    limits: &Limits,
) -> std::result::Result<&'static str, &'static str> {
    match settings.rasterizer {
        Rasterizer::Compute => can(settings, limits).map(|()| "asked for"),
        Rasterizer::Auto if !limits.is_cpu => Err("auto: not measured on this kind of device"),
        Rasterizer::Auto if few => Err("auto: so few that tiles gain little"),
        Rasterizer::Auto => can(settings, limits).map(|()| "auto: on a CPU faster than points"),
        _ => Err("another rasterizer was asked for"),
    }
}

/// Pixels of the image for each splat above which tiles are not taken. Where they begin to lose was measured to lie between 870 and 2600
/// at 512x512, 1050 and 3500 at 1024x1024, 4200 and 14 000 at 2048x2048 (`benches/README.md`).
const MOST_PIXELS_A_SPLAT: u64 = 1000;

fn are_few(splats: u64, settings: &Settings) -> bool {
    let [width, height] = settings.size_px.map(u64::from);
    splats * MOST_PIXELS_A_SPLAT < width * height
}

fn count_of(draws: &[Draw<'_>]) -> u64 {
    draws.iter().map(|draw| u64::from(draw.chunk.count)).sum()
}

/// Whether a list of the splats that may be seen is made where there may be something to leave out. `by_tiles`: they are drawn so.
pub(super) fn lists_kept(draws: &[Draw<'_>], by_tiles: bool, settings: &Settings, limits: &Limits) -> bool {
    match settings.cull {
        // With points named, the set-up is the papers'.
        Cull::Auto if settings.rasterizer == Rasterizer::Auto => {
            by_tiles || limits.is_cpu && !are_few(count_of(draws), settings)
        }
        Cull::Auto => by_tiles,
        Cull::Setup => false,
        Cull::List | Cull::Hidden => by_tiles || Primitive::of(settings.rasterizer) == Primitive::Point,
    }
}

fn can(settings: &Settings, limits: &Limits) -> std::result::Result<(), &'static str> {
    if settings.filter == Filter::Max {
        return Err("the filter max has a second kernel, which records have no room for");
    }
    if settings.kernel_eval == KernelEval::Texture {
        return Err("tiles find kernels by arithmetic");
    }
    if !limits.first_instance || limits.storage_buffers_a_stage < STORAGE_BUFFERS {
        return Err("the device lacks drawIndirectFirstInstance, or storage buffers");
    }
    Ok(())
}

/// Refuses tiles that were asked for where there can be none.
///
/// # Errors
/// [`crate::error::ErrorKind::Option`] with the reason.
pub fn check(settings: &Settings, limits: &Limits) -> Result<()> {
    if let (Rasterizer::Compute, Err(reason)) = (settings.rasterizer, can(settings, limits)) {
        return Err(Error::option("--rasterizer", format!("compute: {reason}")));
    }
    Ok(())
}

/// In words, how the splats of a part are drawn, and why so.
pub(super) fn words(part: &Part<'_>, settings: &Settings, limits: &Limits) -> Option<String> {
    if part.splats.is_empty() {
        return None;
    }
    let primitive = match Primitive::of(settings.rasterizer) {
        Primitive::Point => "points",
        Primitive::Quad => "quads",
        Primitive::Triangle => "triangles",
    };
    let hidden = if part.leaves_hidden_out(settings) { "; what is hidden, left out of sums" } else { "" };
    let kept = if part.kept.is_some() { "; those that may be seen, by a list" } else { "" };
    let how = match (&part.tiles, by_tiles(&part.splats, !part.meshes.is_empty(), settings, limits)) {
        (Some(plan), Ok(why)) => {
            let (most, draws, height) =
                (plan.most_tiles, plan.invocations.draws(), plan.invocations.tile_height());
            let large =
                if plan.may_be_large { "; what touches more, or comes near the eye, as quads" } else { "" };
            let bands = match part.bands.len() {
                0 => String::new(),
                bands => format!(", in {bands} bands for the lists' memory"),
            };
            format!(
                "by tiles of 8x{height} pixels in compute ({why}), {draws} an invocation, splats of up to {most} tiles{large}{bands}"
            )
        }
        (None, Ok(_)) if !part.meshes.is_empty() => {
            format!("as {primitive}: there are polygons in the same layers")
        }
        (None, Ok(_)) => {
            format!("as {primitive}: tiles have no room for so many, or for ones so large in layers")
        }
        (_, Err(why)) => format!("as {primitive}: {why}"),
    };
    Some(format!("{how}{kept}{hidden}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn auto_takes_tiles_on_a_cpu_alone_and_only_for_what_they_can_draw() {
        let cpu = Limits { is_cpu: true, ..Limits::for_tests() };
        let auto = Settings::default();
        assert!(by_tiles_of(false, &auto, &cpu).is_ok());
        assert!(by_tiles_of(false, &auto, &Limits::for_tests()).is_err());
        assert!(by_tiles_of(false, &Settings { filter: Filter::Max, ..auto.clone() }, &cpu).is_err());
        let textured = Settings { kernel_eval: KernelEval::Texture, ..auto.clone() };
        assert!(by_tiles_of(false, &textured, &cpu).is_err());
        assert!(by_tiles_of(false, &auto, &Limits { first_instance: false, ..cpu }).is_err());
        assert!(by_tiles_of(true, &auto, &cpu).is_err());
        // An image of this size has a pixel more than a thousand for each of 1048 splats.
        assert!(are_few(1048, &auto) && !are_few(1049, &auto));
        let named = |rasterizer| Settings { rasterizer, ..Settings::default() };
        assert!(by_tiles_of(true, &named(Rasterizer::Compute), &Limits::for_tests()).is_ok());
        assert!(by_tiles_of(false, &named(Rasterizer::Perspective), &cpu).is_err());
        assert!(check(&named(Rasterizer::Compute), &Limits { storage_buffers_a_stage: 4, ..cpu }).is_err());
        assert!(check(&auto, &Limits { storage_buffers_a_stage: 4, ..cpu }).is_ok());
    }
}
