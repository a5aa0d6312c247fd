//! The pipelines of the opaque splats.

use crate::instruments::{
    catalog::{Traits, splat_keys},
    tile_recipes,
};
use crate::passes::{
    cull::{
        hidden, large,
        visible::{self, list_key},
    },
    pipeline::{
        recipe::{PipelineRecipe, compute, graphics},
        splat_shaders::{Primitive, Summed},
        variant::Constants,
    },
    splats::{accumulate, draw::Portion, kernel_texture, visibility},
};
use crate::{
    error::Result,
    scene::{Cull, KernelEval, Settings},
    shaders,
};

/// By the graphics pipeline.
pub(crate) fn drawn(
    settings: &Settings,
    traits: Traits,
    variant: &Constants,
    has_list: bool,
) -> Result<Vec<PipelineRecipe>> {
    let mut all = Vec::new();
    if has_list {
        let [mark, scan, list] = large::keys(variant);
        all.push(compute("mark large splats", mark));
        all.push(compute("scan large splats", scan));
        all.push(compute("list large splats", list));
    }
    let points = Primitive::of(settings.rasterizer) == Primitive::Point;
    let culled = match settings.cull {
        Cull::List | Cull::Hidden if points => visible::recipes(variant),
        _ => Vec::new(),
    };
    let listed = !culled.is_empty();
    all.extend(culled.into_iter().map(|(pass, key)| compute(pass, key)));
    if listed && settings.cull == Cull::Hidden {
        all.push(compute("cells of depth", hidden::cells_key()));
        all.push(compute("mark unhidden splats", list_key(&shaders::MARK_UNHIDDEN_COMP, variant.clone())));
    }
    let summed = Summed::Opaque { with_depth: traits.export, beside_polygons: traits.polygons };
    let accumulate_name = if traits.polygons { "accumulate beside polygons" } else { "accumulate" };
    let splat_passes = [
        ("visibility", visibility::splat_pass(settings, None)),
        (accumulate_name, accumulate::splat_pass(settings, summed)),
    ];
    for (pass, splats) in splat_passes {
        if pass == accumulate_name && settings.kernel_eval == KernelEval::Texture {
            all.push(graphics("kernel texture", "", kernel_texture::key(settings.kernel, false)));
        }
        let keys = splat_keys(&splats, settings, variant, has_list);
        all.extend(keys.into_iter().map(|(draws, key)| graphics(pass, draws, key)));
    }
    Ok(all)
}

/// By tiles.
pub(crate) fn by_tiles(
    settings: &Settings,
    traits: Traits,
    variant: &Constants,
) -> Result<Vec<PipelineRecipe>> {
    let Traits { may_be_large, polygons, export, .. } = traits;
    let (leaves_sums, lights) = (traits.leaves_sums(settings), traits.lights());
    let of_tiles = tile_recipes::TileTraits { may_be_large, polygons, export, leaves_sums, lights };
    let mut all = Vec::new();
    let culled = if settings.cull == Cull::Setup { Vec::new() } else { visible::recipes(variant) };
    let set_up = culled.len();
    let passes = [
        tile_recipes::list_recipes(settings, variant, may_be_large, set_up > 0),
        tile_recipes::opaque_recipes(settings, of_tiles),
    ];
    all.extend(culled.into_iter().chain(passes.into_iter().flatten()).map(|(pass, key)| compute(pass, key)));
    // The same shaders do all splats, or leave the large ones out.
    for recipe in all.iter_mut().filter(|recipe| ["set up splats", "fill tiles"].contains(&recipe.pass)) {
        recipe.draws = if may_be_large { "small splats" } else { "all splats" };
    }
    if may_be_large {
        let summed = Summed::Opaque { with_depth: export, beside_polygons: polygons };
        for (pass, splats) in [
            ("see large splats", visibility::splat_pass(settings, None)),
            ("sum large splats", accumulate::splat_pass(settings, summed)),
        ] {
            let key = splats.key(Portion::Large, variant);
            all.push(graphics(pass, "listed quads", key));
        }
    }
    if leaves_sums {
        let (pass, key) = tile_recipes::depth_recipe();
        all.push(graphics(pass, "tiles", key));
    }
    Ok(all)
}
