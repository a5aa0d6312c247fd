//! The opaque surface's own depth, for a host that draws beside it.

use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::key::{GraphicsKey, Layout},
    place::sums,
    resolve::{finalize::Opaque, fullscreen::draw_fullscreen},
    tiles::runs::{draw_runs, read_runs, runs_key},
};
use crate::{
    error::Result,
    graph::{Access, ClearValue, Graph, Handle, Image, Start, execute::Body},
    shaders::{self, config::*},
};

/// Declares the pass. `own`: the surface's own depth, where tiles left it; else it follows from sums.
pub(crate) fn surface_depth<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    (opaque, own): (&Opaque<'a>, Option<&Handle<Image>>),
    polygons: bool,
    depth: &mut Handle<Image>,
) -> Result<()> {
    let nothing = Start::Clear(ClearValue::Color([0.0; 4]));
    let constants = inputs.finalize_constants();
    let of_polygons = opaque.depth().filter(|_| polygons);
    let mut pass = Pass::new(graph, inputs.source, "surface depth", "a host draws beside the surface")
        .attach(depth, Access::ColorAttachment, nothing)
        .read_if(sums(BIND_SUMS_POLYGON_COLORS), of_polygons, Access::SampledFragment);
    let key = |source: Option<u32>| {
        let variant =
            source.map(|source| (source, 1)).into_iter().chain(of_polygons.map(|_| (SPEC_POLYGONS, 1)));
        GraphicsKey {
            color_formats: [super::SURFACE_DEPTH_FORMAT].into(),
            ..GraphicsKey::fullscreen(&shaders::SURFACE_DEPTH_FRAG, Layout::Finalize, variant.collect())
        }
    };
    if let Some(own) = own {
        let (with_runs, runs) =
            read_runs(pass.read(sums(BIND_SUMS_DEPTH), own, Access::SampledFragment), &opaque.tiles);
        pass = with_runs;
        let whole = of_polygons.map(|_| pass.graphics(key(None))).transpose()?;
        let of_tiles = key(Some(SPEC_SHADED));
        let of_tiles = GraphicsKey {
            color_formats: of_tiles.color_formats,
            ..runs_key(of_tiles.fragment, of_tiles.constants)
        };
        let of_tiles = pass.graphics(of_tiles)?;
        pass.finish(move |pass| {
            whole.map_or(Ok(()), |pipeline| draw_fullscreen(pass, pipeline, &constants))?;
            draw_runs(pass, of_tiles, runs, constants)
        });
        return Ok(());
    }
    let of_splats = opaque.splats.as_ref().zip(opaque.splat_depth.as_ref());
    if let Some((of_splats, visible)) = of_splats {
        pass = pass
            .read(sums(BIND_SUMS_COLORS), &of_splats.color, Access::SampledFragment)
            .read(sums(BIND_SUMS_NORMALS), &of_splats.normal, Access::SampledFragment)
            .read(sums(BIND_SUMS_DEPTH), visible, Access::SampledFragment);
    }
    let something = of_splats.is_some() || of_polygons.is_some();
    let key = key(of_splats.map(|_| SPEC_SPLATS));
    let pipeline = something.then(|| pass.graphics(key)).transpose()?;
    pass.finish(move |pass| pipeline.map_or(Ok(()), |pipeline| draw_fullscreen(pass, pipeline, &constants)));
    Ok(())
}
