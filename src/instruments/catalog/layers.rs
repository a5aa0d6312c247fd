//! The pipelines of transparent layers.

use crate::instruments::{
    catalog::{Traits, splat_keys},
    tile_recipes,
};
use crate::passes::{
    layers::{
        accumulate as layer_accumulate, compose as layer_compose, rest as layer_rest,
        visibility as layer_visibility,
    },
    pipeline::{
        recipe::{PipelineRecipe, compute, graphics},
        splat_shaders::Primitive,
        variant::{Constants, splat_constants},
    },
    splats::{draw::SplatPass, visibility},
};
use crate::{error::Result, scene::Settings, shaders::config::*};

/// By tiles.
pub(crate) fn by_tiles(settings: &Settings, traits: Traits) -> Result<Vec<PipelineRecipe>> {
    let (_, set_up) =
        tile_recipes::list_recipes(settings, &open(settings, traits), false, false).swap_remove(0);
    let (pass, layers) = tile_recipes::layers_recipe(settings, traits.lights());
    Ok(vec![compute("set up transparent splats", set_up), compute(pass, layers)])
}

/// What a transparent splat's shaders are made for.
fn open(settings: &Settings, traits: Traits) -> Constants {
    let mut open = splat_constants(settings, traits.ellipses, false);
    open.extend([(SPEC_OUTWARD, u32::from(traits.closed)), (SPEC_IN_LAYERS, 1)]);
    open
}

/// By the graphics pipeline.
pub(crate) fn drawn(settings: &Settings, traits: Traits) -> Result<Vec<PipelineRecipe>> {
    let mut all = Vec::new();
    let has_list = traits.may_be_large && Primitive::of(settings.rasterizer) != Primitive::Quad;
    let open = open(settings, traits);
    let splats = |pass: &SplatPass| splat_keys(pass, settings, &open, has_list);
    for peeled in [false, true] {
        let names = if peeled {
            ["visibility of a layer", "accumulate a layer", "polygons of a layer"]
        } else {
            ["visibility of layer 1", "accumulate layer 1", "polygons of layer 1"]
        };
        let rest = ["accumulate the only layer", "accumulate the last layer"][usize::from(peeled)];
        let of_splats = [
            (names[0], visibility::splat_pass(settings, Some(peeled))),
            (names[1], layer_accumulate::splat_pass(settings, peeled)),
            (rest, layer_rest::splat_pass(settings, peeled, true, traits.lights())),
        ];
        for (name, pass) in &of_splats {
            all.extend(splats(pass).into_iter().map(|(draws, key)| graphics(name, draws, key)));
        }
        let of_polygons = [
            (names[0], layer_visibility::mesh_pass(peeled)),
            (names[2], layer_accumulate::mesh_pass(settings, peeled)),
            (rest, layer_rest::mesh_pass(settings, peeled, true, traits.lights())),
        ];
        for (name, pass) in of_polygons.iter().filter(|_| traits.polygons) {
            all.push(graphics(name, "triangles", pass.key(false, traits.closed)));
        }
    }
    for (name, rest) in [("compose a layer", false), ("compose the last layer", true)] {
        let of = if rest { [false; 2] } else { [true, traits.polygons] };
        all.push(graphics(name, "", layer_compose::key(settings, rest, of, traits.lights())));
    }
    Ok(all)
}
