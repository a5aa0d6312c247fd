//! Every pipeline that a frame would be drawn with, without a scene: the passes' own recipes, for whoever counts them or
//! compiles them ahead.

use ash::vk;

use super::{
    accumulate, cull, cull_hidden, export, finalize, floor, kernel_texture, layer_accumulate,
    layer_compose::{self, LayerKind},
    layer_rest, layer_visibility, list_large, paper,
    pipelines::GraphicsKey,
    point_records, polygons,
    recipe::{Key, PipelineRecipe, compute, graphics},
    splat_pass::SplatPass,
    splat_shaders::{Primitive, Summed, sets_up_once},
    tiles,
    variant::{Constants, IN_LAYERS, OUTWARD, splat_constants},
    visibility,
};
use crate::{
    error::Result,
    scene::{Cull, KernelEval, Rasterizer, SetUp, Settings, Transition},
    shaders,
};

/// What scene and caller decide about a frame's pipelines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Traits {
    /// Splats are ellipses; else disks.
    pub ellipses: bool,
    /// Their surface is closed.
    pub closed: bool,
    /// Some may be too large or too near to be drawn as the rasterizer's own primitive.
    pub may_be_large: bool,
    /// There are polygons beside the splats.
    pub polygons: bool,
    /// There are transparent things beside the opaque ones, and layers enough to peel one off another.
    pub transparent: bool,
    /// The scene has lights of its own.
    pub lit: bool,
    /// The surface is wanted as data.
    pub export: bool,
    /// The floor benchmark's pipelines too.
    pub floor: bool,
}

impl Default for Traits {
    /// A closed surface of disks, all of them small and in front of the eye.
    fn default() -> Self {
        Self {
            ellipses: false,
            closed: true,
            may_be_large: false,
            polygons: false,
            transparent: false,
            lit: false,
            export: false,
            floor: false,
        }
    }
}

impl Traits {
    /// How many lights of its own a scene has that has some.
    fn lights(self) -> u32 {
        if self.lit { 2 } else { 0 }
    }

    /// More than opaque things of which splats fit into tiles, so that these are not shaded at once.
    fn leaves_sums(self, settings: &Settings) -> bool {
        let of_both = self.polygons && settings.transition == Transition::Attributes;
        of_both || self.transparent || self.may_be_large || self.export
    }
}

/// The pipelines of the papers' own programs: perspective splatting as Guennebaud et al. 2006 publish it, and the ray
/// casting of Botsch et al. 2005, with which they compare it.
pub fn papers_pipelines() -> Vec<PipelineRecipe> {
    let [visibility, accumulate] = paper::keys(&Settings::default(), false);
    let rays = |vertex, fragment| Key::Counted((vertex, fragment));
    [
        ("paper visibility", Key::Graphics(visibility)),
        ("paper accumulate", Key::Graphics(accumulate)),
        ("botsch visibility", rays(&shaders::BOTSCH_VISIBILITY_VERT, &shaders::BOTSCH_VISIBILITY_FRAG)),
        ("botsch accumulate", rays(&shaders::BOTSCH_ACCUMULATE_VERT, &shaders::BOTSCH_ACCUMULATE_FRAG)),
    ]
    .map(|(pass, key)| PipelineRecipe { pass, draws: "points", key })
    .to_vec()
}

/// The pipelines of a frame, pass by pass.
///
/// # Errors
/// [`crate::error::ErrorKind::Option`] for settings that have no picture.
pub fn frame_pipelines(settings: &Settings, traits: Traits) -> Result<Vec<PipelineRecipe>> {
    settings.validate()?;
    let target = vk::Format::R8G8B8A8_SRGB;
    let variant = splat_constants(settings, traits.ellipses, traits.closed);
    let mut all = Vec::new();
    let by_tiles = settings.rasterizer == Rasterizer::Compute;
    let has_list = traits.may_be_large && !by_tiles && Primitive::of(settings.rasterizer) != Primitive::Quad;
    if by_tiles {
        all.extend(opaque_by_tiles(settings, traits, &variant)?);
    } else {
        all.extend(opaque(settings, traits, &variant, has_list)?);
    }
    if traits.polygons {
        let drawn = match by_tiles && !traits.leaves_sums(settings) {
            true => polygons::shaded_mesh_pass(settings, settings.accumulate, traits.lights()),
            false => polygons::mesh_pass(settings),
        };
        all.push(graphics("polygons", "triangles", drawn.key(traits.closed, false)));
    }
    if traits.transparent {
        if by_tiles && !traits.polygons && !traits.may_be_large {
            let mut open = splat_constants(settings, traits.ellipses, false);
            open.extend([(OUTWARD, u32::from(traits.closed)), (IN_LAYERS, 1)]);
            let (_, set_up) = tiles::list_recipes(settings, &open, false, false).swap_remove(0);
            all.push(compute("set up transparent splats", set_up));
            let (pass, key) = tiles::layers_recipe(settings, traits.lights())?;
            all.push(compute(pass, key));
        } else {
            all.extend(layers(settings, traits)?);
        }
    }
    let shown = finalize::Traits {
        splats: true,
        polygons: traits.polygons,
        layered: traits.transparent,
        lights: traits.lights(),
    };
    let at_once = by_tiles && !traits.leaves_sums(settings);
    if !at_once {
        all.extend(finalize::key(settings, target, shown).map(|key| graphics("finalize", "", key)));
    }
    if at_once && traits.polygons {
        all.push(graphics("finalize", "", finalize::key_of_shown_polygons(target)));
    }
    if at_once {
        let draws = if traits.polygons { "tiles beside polygons" } else { "tiles" };
        all.push(graphics("finalize", draws, finalize::key_of_shown(target, traits.polygons)));
    }
    if traits.export {
        all.push(graphics("export", "", export::key()));
    }
    if traits.floor {
        let [depth, add, fill] = floor::keys(settings, target);
        all.push(compute("floor points", floor::points_key(&variant)));
        all.push(graphics("floor depth", "points", depth));
        all.push(graphics("floor add", "points", add));
        all.push(graphics("floor fill", "", fill));
    }
    Ok(all)
}

/// The splat passes of the opaque part by the graphics pipeline.
fn opaque(
    settings: &Settings,
    traits: Traits,
    variant: &Constants,
    has_list: bool,
) -> Result<Vec<PipelineRecipe>> {
    let mut all = Vec::new();
    if has_list {
        let [count, scan, list] = list_large::keys(variant);
        all.push(compute("count large splats", count));
        all.push(compute("scan large splats", scan));
        all.push(compute("list large splats", list));
    }
    let points = Primitive::of(settings.rasterizer) == Primitive::Point;
    let culled = match settings.cull {
        Cull::List | Cull::Hidden if points => cull::recipes(variant),
        _ => Vec::new(),
    };
    let kept = !culled.is_empty();
    all.extend(culled.into_iter().map(|(pass, key)| compute(pass, key)));
    if records_points(settings) {
        all.push(compute("set up points", point_records::key(variant, has_list, kept)));
    }
    if kept && settings.cull == Cull::Hidden {
        all.push(compute("cells of depth", cull_hidden::cells_key()));
        all.push(compute("mark seen splats", cull_hidden::hidden_key(variant)));
    }
    let summed = Summed::Opaque { with_depth: traits.export, beside_polygons: traits.polygons };
    let accumulate_name = if traits.polygons { "accumulate beside polygons" } else { "accumulate" };
    let splat_passes = [
        ("visibility", visibility::splat_pass(settings, None)?),
        (accumulate_name, accumulate::splat_pass(settings, summed)?),
    ];
    for (pass, splats) in splat_passes {
        if pass == accumulate_name && settings.kernel_eval == KernelEval::Texture {
            all.push(graphics(
                "kernel texture",
                "",
                kernel_texture::key(&shaders::KERNEL_TEXTURE_FRAG, settings.kernel),
            ));
        }
        let keys = splat_keys(&splats, settings, variant, has_list);
        all.extend(keys.into_iter().map(|(draws, key)| graphics(pass, draws, key)));
    }
    Ok(all)
}

/// The same by tiles.
fn opaque_by_tiles(settings: &Settings, traits: Traits, variant: &Constants) -> Result<Vec<PipelineRecipe>> {
    let Traits { may_be_large, polygons, export, .. } = traits;
    let (leaves_sums, lights) = (traits.leaves_sums(settings), traits.lights());
    let of_tiles = tiles::TileTraits { may_be_large, polygons, export, leaves_sums, lights };
    let mut all = Vec::new();
    let culled = if settings.cull == Cull::Setup { Vec::new() } else { cull::recipes(variant) };
    let set_up = culled.len();
    let passes = [
        tiles::list_recipes(settings, variant, may_be_large, set_up > 0),
        tiles::opaque_recipes(settings, of_tiles)?,
    ];
    all.extend(culled.into_iter().chain(passes.into_iter().flatten()).map(|(pass, key)| compute(pass, key)));
    // The same shaders do all splats, or leave the large ones out.
    for recipe in all.iter_mut().filter(|recipe| ["set up splats", "fill tiles"].contains(&recipe.pass)) {
        recipe.draws = if may_be_large { "small splats" } else { "all splats" };
    }
    if may_be_large {
        let summed = Summed::Opaque { with_depth: export, beside_polygons: polygons };
        for (pass, splats) in [
            ("see large splats", visibility::splat_pass(settings, None)?),
            ("sum large splats", accumulate::splat_pass(settings, summed)?),
        ] {
            let key = splats.key(splats.shaders.listed, Primitive::Quad, variant);
            all.push(graphics(pass, "listed quads", key));
        }
    }
    if leaves_sums {
        let (pass, key) = tiles::depth_recipe();
        all.push(graphics(pass, "tiles", key));
    }
    Ok(all)
}

/// The passes of transparent layers by the graphics pipeline.
fn layers(settings: &Settings, traits: Traits) -> Result<Vec<PipelineRecipe>> {
    let mut all = Vec::new();
    let has_list = traits.may_be_large && Primitive::of(settings.rasterizer) != Primitive::Quad;
    let mut open = splat_constants(settings, traits.ellipses, false);
    open.extend([(OUTWARD, u32::from(traits.closed)), (IN_LAYERS, 1)]);
    if records_points(settings) {
        all.push(compute("set up transparent points", point_records::key(&open, has_list, false)));
    }
    let splats = |pass: &SplatPass| splat_keys(pass, settings, &open, has_list);
    for peeled in [false, true] {
        let names = if peeled {
            ["visibility of a layer", "accumulate a layer", "polygons of a layer"]
        } else {
            ["visibility of layer 1", "accumulate layer 1", "polygons of layer 1"]
        };
        let rest = ["accumulate the only layer", "accumulate the last layer"][usize::from(peeled)];
        let of_splats = [
            (names[0], visibility::splat_pass(settings, Some(peeled))?),
            (names[1], layer_accumulate::splat_pass(settings, peeled)?),
            (rest, layer_rest::splat_pass(settings, peeled, true, traits.lights())?),
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
    let surface = if traits.polygons { LayerKind::Hybrid } else { LayerKind::Splats };
    all.push(graphics("compose a layer", "", layer_compose::key(settings, surface, traits.lights())));
    all.push(graphics(
        "compose the last layer",
        "",
        layer_compose::key(settings, LayerKind::Rest, traits.lights()),
    ));
    Ok(all)
}

fn records_points(settings: &Settings) -> bool {
    settings.set_up == SetUp::Once && sets_up_once(settings).is_ok()
}

/// The pipelines of a splat pass, each with what it draws.
fn splat_keys(
    pass: &SplatPass,
    settings: &Settings,
    variant: &Constants,
    has_list: bool,
) -> Vec<(&'static str, GraphicsKey)> {
    let own = Primitive::of(settings.rasterizer);
    let (all, small) = match own {
        Primitive::Point => ("points", "small points"),
        Primitive::Quad => ("quads", "quads"),
        Primitive::Triangle => ("triangles", "small triangles"),
    };
    let recorded = pass.shaders.recorded.filter(|_| records_points(settings));
    match has_list {
        false => vec![(all, pass.key(recorded.unwrap_or(pass.shaders.all), own, variant))],
        true => vec![
            (small, pass.key(recorded.unwrap_or(pass.shaders.small), own, variant)),
            ("listed quads", pass.key(pass.shaders.listed, Primitive::Quad, variant)),
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_has_the_pipelines_of_its_passes() {
        let of = |settings: &Settings, traits| -> Vec<String> {
            let all = frame_pipelines(settings, traits).unwrap();
            all.iter().map(|recipe| format!("{} {}", recipe.pass, recipe.draws)).collect()
        };
        let settings = Settings::default();
        assert_eq!(of(&settings, Traits::default()), ["visibility points", "accumulate points", "finalize "]);
        let all = Traits { may_be_large: true, export: true, floor: true, ..Traits::default() };
        assert_eq!(
            of(&Settings { kernel_eval: KernelEval::Texture, ..settings }, all),
            [
                "count large splats ",
                "scan large splats ",
                "list large splats ",
                "visibility small points",
                "visibility listed quads",
                "kernel texture ",
                "accumulate small points",
                "accumulate listed quads",
                "finalize ",
                "export ",
                "floor points ",
                "floor depth points",
                "floor add points",
                "floor fill ",
            ]
        );
    }
}
