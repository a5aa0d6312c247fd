//! Normalization and shading of the opaque part, under the transparent layers: from sums to the picture.
//!
//! Without layers, pixels without any surface are not shaded: the target is cleared to the background, and a triangle at
//! depth 0 (infinitely far) is drawn where the visible depth is above 0 (something is there). Of splats that were drawn by
//! tiles, only those tiles are; and what is shaded already, tiles and the polygons beside them, is but brought to the target.

use ash::vk;

use crate::passes::{
    inputs::Inputs,
    pipeline::{
        cache::{GraphicsKey, Layout},
        constants::FinalizeConstants,
        fullscreen::{draw_fullscreen, read_set},
        variant::{Constants, shading_constants, transition_constant},
    },
    splats::accumulate::Sums,
    tiles::{
        Tiles,
        quads::{SeenTiles, draw_quads_of_tiles, quads_of_tiles, read_seen},
    },
};
use crate::{
    error::Result,
    graph::{Access, Buffer, ClearValue, Graph, Handle, Image, ResourceId, Start, execute::Body},
    math::srgb::linear_from_srgb,
    scene::Settings,
    shaders::{self, config::*},
};

/// What the opaque passes leave.
#[derive(Default)]
pub(crate) struct Opaque<'a> {
    /// Of splats.
    pub splats: Option<Sums>,
    /// The polygons that are seen.
    pub polygons: Option<Sums>,
    /// The depth of splats, moved away from the eye by ε.
    pub splat_depth: Option<Handle<Image>>,
    /// The depth of polygons, or of the splats where those are nearer; where all is shown already, of polygons alone.
    pub polygon_depth: Option<Handle<Image>>,
    /// The tiles that have splats, where outside of them there is nothing, or only polygons that are shown.
    pub tiles: Vec<Tiles<'a>>,
    /// What these and polygons show, in place of sums.
    pub shown: Option<Handle<Image>>,
}

impl Opaque<'_> {
    /// The depth that hides what is behind it; none where there is nothing opaque.
    pub fn depth(&self) -> Option<&Handle<Image>> {
        self.polygon_depth.as_ref().or(self.splat_depth.as_ref())
    }
}

/// What is opaque in a scene, for the pipeline alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Traits {
    pub splats: bool,
    pub polygons: bool,
    /// There are transparent layers.
    pub layered: bool,
    /// The scene's own lights.
    pub lights: u32,
}

/// What its pipeline is; none where the background is all that is seen.
pub(crate) fn key(settings: &Settings, target_format: vk::Format, traits: Traits) -> Option<GraphicsKey> {
    let Traits { splats, polygons, layered, lights } = traits;
    if !splats && !polygons && !layered {
        return None;
    }
    let mut constants = resolve_constants(settings, splats, polygons, lights);
    constants.push((SPEC_LAYERED, layered.into()));
    Some(GraphicsKey {
        color_formats: vec![target_format],
        depth: (!layered).then_some((vk::CompareOp::LESS, false)),
        ..GraphicsKey::fullscreen(&shaders::FINALIZE_FRAG, Layout::Finalize, constants)
    })
}

/// The specialization constants of what shades sums of splats, polygons, or both (`glsl/inc/resolve.glsl`).
pub(crate) fn resolve_constants(settings: &Settings, splats: bool, polygons: bool, lights: u32) -> Constants {
    let mut constants = shading_constants(settings.shading, lights);
    constants.extend([
        transition_constant(settings.transition),
        (SPEC_SPLATS, splats.into()),
        (SPEC_POLYGONS, polygons.into()),
    ]);
    constants
}

/// What passes over the whole image are told of it.
pub(crate) fn constants(inputs: Inputs<'_>) -> FinalizeConstants {
    let [width, height] = inputs.settings.size_px;
    FinalizeConstants {
        background: inputs.settings.background.map_or([0.0; 4], |srgb| {
            let [r, g, b] = srgb.map(linear_from_srgb);
            [r, g, b, 1.0]
        }),
        half_size_px: [0.5 * width as f32, 0.5 * height as f32],
        focal_px: inputs.camera.focal_px(height) as f32,
        tile_height: 0, // quads of tiles bring their own
        near: inputs.camera.near() as f32,
    }
}

/// The images of set 0 by their bindings.
pub(crate) fn sums_descriptors(
    splats: Option<&Sums>,
    polygons: Option<&Sums>,
    layers: Option<&Handle<Image>>,
) -> Vec<(u32, ResourceId)> {
    let of = |sums: &Sums, [color, normal]: [u32; 2]| [(color, sums.color.id()), (normal, sums.normal.id())];
    let splats = splats.map(|sums| of(sums, [BIND_SUMS_COLORS, BIND_SUMS_NORMALS]));
    let polygons = polygons.map(|sums| of(sums, [BIND_SUMS_POLYGON_COLORS, BIND_SUMS_POLYGON_NORMALS]));
    let sums = splats.into_iter().chain(polygons).flatten();
    sums.chain(layers.map(|layers| (BIND_SUMS_LAYERS, layers.id()))).collect()
}

/// Declares the pass. The target's format decides whether the linear light is encoded (an sRGB format) or kept. `layers`:
/// what transparent layers add up to.
pub(crate) fn finalize<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    opaque: &Opaque<'a>,
    layers: Option<&Handle<Image>>,
    lights: Option<&Handle<Buffer>>,
    target: &mut Handle<Image>,
    target_format: vk::Format,
) -> Result<()> {
    let (splats, polygons) = (opaque.splats.as_ref(), opaque.polygons.as_ref());
    let lights = lights.filter(|_| splats.is_some() || polygons.is_some());
    let traits = Traits {
        splats: splats.is_some(),
        polygons: polygons.is_some(),
        layered: layers.is_some(),
        lights: inputs.lights,
    };
    if let Some(shown) = &opaque.shown {
        let key = tile_resolve_key(target_format, opaque.polygon_depth.is_some());
        return match &opaque.polygon_depth {
            Some(depth) => {
                let keys = [polygon_resolve_key(target_format), key];
                finalize_polygons_and_tiles(graph, inputs, (shown, depth), &opaque.tiles, keys, target)
            }
            None => finalize_tiles(graph, inputs, &opaque.tiles, (&[shown], None), key, target),
        };
    }
    let key = key(inputs.settings, target_format, traits);
    if let (false, Some(key), Some(Sums { color, normal })) = (opaque.tiles.is_empty(), &key, splats) {
        let key = key_of_tiles(key);
        return finalize_tiles(graph, inputs, &opaque.tiles, (&[color, normal], lights), key, target);
    }
    let pipeline = key.map(|key| inputs.shaders.graphics(key)).transpose()?;
    let constants = constants(inputs);
    let ids = sums_descriptors(splats, polygons, layers);
    let mut pass = graph.pass("finalize");
    for image in [splats, polygons].into_iter().flatten().flat_map(|sums| [&sums.color, &sums.normal]) {
        pass = pass.read(image, Access::SampledFragment);
    }
    if let Some(lights) = lights {
        pass = pass.read(lights, Access::UniformReadFragment);
    }
    let lights = lights.map(Handle::id);
    match (layers, opaque.depth()) {
        (Some(layers), _) => pass = pass.read(layers, Access::SampledFragment),
        (None, Some(depth)) => pass = pass.read(depth, Access::DepthTest),
        (None, None) => {}
    }
    pass.write(target, Access::ColorAttachment, Start::Clear(ClearValue::Color(constants.background)))
        .finish(Box::new(move |context| match &pipeline {
            Some(pipeline) => draw_fullscreen(context, inputs, pipeline, (&ids, lights), &constants),
            None => Ok(()),
        }));
    Ok(())
}

/// The pipeline that finalizes tiles, from that of the whole target.
pub(crate) fn key_of_tiles(whole: &GraphicsKey) -> GraphicsKey {
    GraphicsKey {
        color_formats: whole.color_formats.clone(),
        ..quads_of_tiles(whole.fragment, whole.constants.clone())
    }
}

/// What the pipeline is that brings to the target what tiles show; `beside`: in a pass that has the depth of polygons.
pub(crate) fn tile_resolve_key(target_format: vk::Format, beside: bool) -> GraphicsKey {
    GraphicsKey {
        color_formats: vec![target_format],
        depth: beside.then_some((vk::CompareOp::ALWAYS, false)),
        ..quads_of_tiles(&shaders::FINALIZE_FRAG, vec![(SPEC_SHADED, 1)])
    }
}

/// What it is where there are polygons alone.
pub(crate) fn polygon_resolve_key(target_format: vk::Format) -> GraphicsKey {
    GraphicsKey {
        color_formats: vec![target_format],
        depth: Some((vk::CompareOp::LESS, false)),
        ..GraphicsKey::fullscreen(&shaders::FINALIZE_FRAG, Layout::Finalize, vec![(SPEC_SHADED, 1)])
    }
}

/// The pass over the tiles that have splats alone. It reads images, of which the first is binding 0, and lights.
fn finalize_tiles<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    tiles: &[Tiles<'a>],
    (images, lights): (&[&Handle<Image>], Option<&Handle<Buffer>>),
    key: GraphicsKey,
    target: &mut Handle<Image>,
) -> Result<()> {
    let pipeline = inputs.shaders.graphics(key)?;
    let constants = constants(inputs);
    let ids: Vec<_> = (0..).zip(images).map(|(binding, image)| (binding, image.id())).collect();
    let seen = SeenTiles::of(tiles);
    let mut pass = read_seen(tiles, graph.pass("finalize"));
    for image in images {
        pass = pass.read(image, Access::SampledFragment);
    }
    if let Some(lights) = lights {
        pass = pass.read(lights, Access::UniformReadFragment);
    }
    let lights = lights.map(Handle::id);
    pass.write(target, Access::ColorAttachment, Start::Clear(ClearValue::Color(constants.background)))
        .finish(Box::new(move |context| {
            let set = read_set(context, inputs, (&ids, lights))?;
            draw_quads_of_tiles(context, inputs, &pipeline, &seen, set, constants)
        }));
    Ok(())
}

/// The pass over polygons, where they are nearer than nothing, and over the tiles that have splats.
fn finalize_polygons_and_tiles<'a>(
    graph: &mut Graph<Body<'a>>,
    inputs: Inputs<'a>,
    (shown, depth): (&Handle<Image>, &Handle<Image>),
    tiles: &[Tiles<'a>],
    [of_polygons, of_tiles]: [GraphicsKey; 2],
    target: &mut Handle<Image>,
) -> Result<()> {
    let [of_polygons, of_tiles] = [inputs.shaders.graphics(of_polygons)?, inputs.shaders.graphics(of_tiles)?];
    let constants = constants(inputs);
    let (images, seen) = ([(0, shown.id())], SeenTiles::of(tiles));
    read_seen(tiles, graph.pass("finalize"))
        .read(shown, Access::SampledFragment)
        .read(depth, Access::DepthTest)
        .write(target, Access::ColorAttachment, Start::Clear(ClearValue::Color(constants.background)))
        .finish(Box::new(move |context| {
            draw_fullscreen(context, inputs, &of_polygons, (&images, None), &constants)?;
            let set = read_set(context, inputs, (&images, None))?;
            draw_quads_of_tiles(context, inputs, &of_tiles, &seen, set, constants)
        }));
    Ok(())
}
