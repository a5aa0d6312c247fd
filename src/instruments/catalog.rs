//! Every pipeline that a frame would be drawn with, without a scene: the passes' own recipes, for whoever counts them or
//! compiles them ahead.

pub(crate) mod layers;
pub(crate) mod opaque;

use ash::vk;

use crate::instruments::{floor_passes as floor, paper_passes as paper};
use crate::passes::{
    pipeline::{
        cache::GraphicsKey,
        recipe::{Key, PipelineRecipe, compute, graphics},
        splat_shaders::Primitive,
        variant::{Constants, splat_constants},
    },
    polygons::draw as polygons,
    resolve::{export, finalize},
    splats::draw::{Portion, SplatPass},
};
use crate::{
    error::Result,
    scene::{Rasterizer, Settings, Transition},
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
        all.extend(opaque::by_tiles(settings, traits, &variant)?);
    } else {
        all.extend(opaque::drawn(settings, traits, &variant, has_list)?);
    }
    if traits.polygons {
        let drawn = match by_tiles && !traits.leaves_sums(settings) {
            true => polygons::shaded_mesh_pass(settings, settings.accumulate, traits.lights()),
            false => polygons::mesh_pass(settings),
        };
        all.push(graphics("polygons", "triangles", drawn.key(traits.closed, false)));
    }
    if traits.transparent {
        let tiles = by_tiles && !traits.polygons && !traits.may_be_large;
        all.extend(if tiles {
            layers::by_tiles(settings, traits)?
        } else {
            layers::drawn(settings, traits)?
        });
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
        all.push(graphics("finalize", "", finalize::polygon_resolve_key(target)));
    }
    if at_once {
        let draws = if traits.polygons { "tiles beside polygons" } else { "tiles" };
        all.push(graphics("finalize", draws, finalize::tile_resolve_key(target, traits.polygons)));
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
    match has_list {
        false => vec![(all, pass.key(Portion::All, variant))],
        true => vec![
            (small, pass.key(Portion::Small, variant)),
            ("listed quads", pass.key(Portion::Large, variant)),
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::KernelEval;

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
                "mark large splats ",
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
