//! Normalization and shading of the opaque part, under the transparent layers: from sums to the picture.
//!
//! Without layers, pixels without any surface are not shaded: the target is cleared to the background, and a triangle at
//! depth 0 (infinitely far) is drawn where the visible depth is above 0 (something is there). Of splats that were drawn by
//! tiles, only those tiles are; and what is shaded already, tiles and the polygons beside them, is but brought to the target.

use ash::vk;

use crate::passes::{
    inputs::Inputs,
    pass::Pass,
    pipeline::{
        constants::FinalizeConstants,
        key::{GraphicsKey, Layout},
        variant::resolve_constants,
    },
    place::sums,
    resolve::fullscreen::draw_fullscreen,
    splats::accumulate::Sums,
    tiles::{
        Tiles,
        runs::{draw_runs, read_runs, runs_key},
    },
};
use crate::{
    arena::{Arena, ArenaVec},
    error::Result,
    graph::{Access, Buffer, ClearValue, Graph, Handle, Image, Start, execute::Body},
    scene::Settings,
    shaders::{self, config::*},
};

/// Why every frame has it.
const WHY: &str =
    "every scene: normalizes and shades the sums, unless tiles did, and puts transparent layers over them";

/// What the opaque passes leave.
pub(crate) struct Opaque<'a> {
    /// Of splats.
    pub splats: Option<Sums>,
    /// The polygons that are seen.
    pub polygons: Option<Sums>,
    /// The depth of splats, moved away from the eye by ε; where all is shown already and layers read it, that of polygons with it.
    pub splat_depth: Option<Handle<Image>>,
    /// The depth of polygons, or of the splats where those are nearer; where all is shown already, of polygons alone.
    pub polygon_depth: Option<Handle<Image>>,
    /// The tiles that have splats, where outside of them there is nothing, or only polygons that are shown.
    pub tiles: ArenaVec<'a, Tiles<'a>>,
    /// What these and polygons show, in place of sums.
    pub shown: Option<Handle<Image>>,
    /// How polygons are among what is shown.
    pub shows_polygons: ShownPolygons,
}

/// How polygons are among what is shown already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ShownPolygons {
    /// They are not.
    None,
    /// Where they have a depth, all of the pixel is theirs.
    Whole,
    /// They cover pixels in part, and the depth, if there is one, is that at their middles.
    InPart,
}

impl<'a> Opaque<'a> {
    /// Nothing yet.
    pub fn nothing(arena: &'a Arena) -> Self {
        Self {
            splats: None,
            polygons: None,
            splat_depth: None,
            polygon_depth: None,
            tiles: arena.growing(),
            shown: None,
            shows_polygons: ShownPolygons::None,
        }
    }

    /// The depth that hides what is behind it; none where there is nothing opaque.
    pub fn depth(&self) -> Option<&Handle<Image>> {
        self.polygon_depth.as_ref().or(self.splat_depth.as_ref())
    }
}

/// What is opaque in a scene, for the pipeline alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Traits {
    pub splats: bool,
    pub polygons: bool,
    /// There are transparent layers.
    pub layered: bool,
    /// The scene's own lights.
    pub lights: u32,
}

/// What its pipeline is; none where the background is all that is seen.
fn key(settings: &Settings, target_format: vk::Format, traits: Traits) -> Option<GraphicsKey> {
    let Traits { splats, polygons, layered, lights } = traits;
    if !splats && !polygons && !layered {
        return None;
    }
    let mut constants = resolve_constants(settings, splats, polygons, lights);
    constants.push((SPEC_LAYERED, layered.into()));
    Some(GraphicsKey {
        color_formats: [target_format].into(),
        depth: (!layered).then_some((vk::CompareOp::LESS, false)),
        ..GraphicsKey::fullscreen(&shaders::FINALIZE_FRAG, Layout::Finalize, constants)
    })
}

/// Declares the pass. The target's format decides whether the linear light is encoded (an sRGB format) or kept. `layers`:
/// what transparent layers add up to.
pub(crate) fn finalize<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: Inputs<'a>,
    opaque: &Opaque<'a>,
    layers: Option<&Handle<Image>>,
    lights: Option<&Handle<Buffer>>,
    target: &mut Handle<Image>,
    target_format: vk::Format,
) -> Result<()> {
    let constants = inputs.finalize_constants();
    let background = Start::Clear(ClearValue::Color(constants.background));
    let pass =
        Pass::new(graph, inputs.source, "finalize", WHY).attach(target, Access::ColorAttachment, background);
    if let Some(shown) = &opaque.shown {
        let pass = pass.read(sums(BIND_SUMS_COLORS), shown, Access::SampledFragment);
        return match layers {
            None => finalize_shown(pass, opaque, target_format, constants),
            Some(layers) => {
                let pass = pass.read(sums(BIND_SUMS_LAYERS), layers, Access::SampledFragment);
                let pipeline = pass.graphics(layered_resolve_key(target_format))?;
                pass.finish(move |pass| draw_fullscreen(pass, pipeline, &constants));
                Ok(())
            }
        };
    }
    let (splats, polygons) = (opaque.splats.as_ref(), opaque.polygons.as_ref());
    let lights = lights.filter(|_| splats.is_some() || polygons.is_some());
    let mut pass = pass.read_if(sums(BIND_SUMS_LIGHTS), lights, Access::UniformReadFragment);
    let splat_sums = [BIND_SUMS_COLORS, BIND_SUMS_NORMALS];
    let polygon_sums = [BIND_SUMS_POLYGON_COLORS, BIND_SUMS_POLYGON_NORMALS];
    for (of, [color, normal]) in [(splats, splat_sums), (polygons, polygon_sums)] {
        pass = pass.read_if(sums(color), of.map(|sums| &sums.color), Access::SampledFragment).read_if(
            sums(normal),
            of.map(|sums| &sums.normal),
            Access::SampledFragment,
        );
    }
    let traits = Traits {
        splats: splats.is_some(),
        polygons: polygons.is_some(),
        layered: layers.is_some(),
        lights: inputs.lights,
    };
    let key = key(inputs.settings, target_format, traits);
    if let (false, Some(key)) = (opaque.tiles.is_empty(), &key) {
        let (pass, runs) = read_runs(pass, &opaque.tiles);
        let pipeline = pass.graphics(key_of_tiles(key))?;
        pass.finish(move |pass| draw_runs(pass, pipeline, runs, constants));
        return Ok(());
    }
    pass = match (layers, opaque.depth()) {
        (Some(layers), _) => pass.read(sums(BIND_SUMS_LAYERS), layers, Access::SampledFragment),
        (None, Some(depth)) => pass.uses(depth, Access::DepthTest),
        (None, None) => pass,
    };
    let pipeline = key.map(|key| pass.graphics(key)).transpose()?;
    pass.finish(move |pass| match pipeline {
        Some(pipeline) => draw_fullscreen(pass, pipeline, &constants),
        None => Ok(()),
    });
    Ok(())
}

/// Brings to the target what tiles show, and before it, where they are nearer than nothing, polygons; or all, where these cover pixels in part.
fn finalize_shown<'a>(
    pass: Pass<'_, 'a>,
    opaque: &Opaque<'a>,
    target_format: vk::Format,
    constants: FinalizeConstants,
) -> Result<()> {
    if opaque.shows_polygons == ShownPolygons::InPart {
        let pipeline = pass.graphics(GraphicsKey { depth: None, ..polygon_resolve_key(target_format) })?;
        pass.finish(move |pass| draw_fullscreen(pass, pipeline, &constants));
        return Ok(());
    }
    let (mut pass, runs) = read_runs(pass, &opaque.tiles);
    // Where layers are hidden by it, both have one depth.
    let of_polygons = match opaque.depth().filter(|_| opaque.shows_polygons == ShownPolygons::Whole) {
        None => None,
        Some(depth) => {
            pass = pass.uses(depth, Access::DepthTest);
            Some(pass.graphics(polygon_resolve_key(target_format))?)
        }
    };
    let of_tiles = pass.graphics(tile_resolve_key(target_format, of_polygons.is_some()))?;
    pass.finish(move |pass| {
        if let Some(pipeline) = of_polygons {
            draw_fullscreen(pass, pipeline, &constants)?;
        }
        draw_runs(pass, of_tiles, runs, constants)
    });
    Ok(())
}

/// The pipeline that finalizes tiles, from that of the whole target.
fn key_of_tiles(whole: &GraphicsKey) -> GraphicsKey {
    GraphicsKey { color_formats: whole.color_formats, ..runs_key(whole.fragment, whole.constants) }
}

/// What the pipeline is that brings to the target what tiles show; `beside`: in a pass that has the depth of polygons.
fn tile_resolve_key(target_format: vk::Format, beside: bool) -> GraphicsKey {
    GraphicsKey {
        color_formats: [target_format].into(),
        depth: beside.then_some((vk::CompareOp::ALWAYS, false)),
        ..runs_key(&shaders::FINALIZE_FRAG, [(SPEC_SHADED, 1)].into())
    }
}

/// What it is where transparent layers lie over them.
fn layered_resolve_key(target_format: vk::Format) -> GraphicsKey {
    let constants = [(SPEC_SHADED, 1), (SPEC_LAYERED, 1)].into();
    GraphicsKey {
        color_formats: [target_format].into(),
        ..GraphicsKey::fullscreen(&shaders::FINALIZE_FRAG, Layout::Finalize, constants)
    }
}

/// What it is where there are polygons alone.
fn polygon_resolve_key(target_format: vk::Format) -> GraphicsKey {
    GraphicsKey {
        color_formats: [target_format].into(),
        depth: Some((vk::CompareOp::LESS, false)),
        ..GraphicsKey::fullscreen(&shaders::FINALIZE_FRAG, Layout::Finalize, [(SPEC_SHADED, 1)].into())
    }
}
