//! Every pipeline that a frame would be drawn with, without a device: the frame of a small scene is declared, and its passes list them.

use std::{cell::RefCell, collections::HashSet};

use ash::vk;
use glam::{DVec3, Vec3};

use crate::instruments::{
    floor_passes::{FLOOR_POINT_BYTES, FloorPoints, floor_frame, floor_points},
    paper_passes::paper_frame,
};
use crate::passes::{self, FramePlan, Inputs, PipelineRecipe, Place, pipeline::recipe::Key};
use crate::{
    arena::Arena,
    error::Result,
    graph::{BufferDesc, Graph, Handle, Image, execute::Body},
    prepare::{Placed, prepare_without_device},
    scene::{
        Camera, Colors, Light, LightKind, Mesh, MeshObject, Object, Scene, Settings, Shapes, Splats, Storage,
    },
    shaders,
    vk::Limits,
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

/// The pipelines of the papers' own programs: perspective splatting as Guennebaud et al. 2006 publish it, and the ray
/// casting of Botsch et al. 2005, with which they compare it.
///
/// # Errors
/// None today.
pub fn papers_pipelines() -> Result<Vec<PipelineRecipe>> {
    let mut all = listed(&Settings::default(), Traits::default(), |graph, inputs, _, target| {
        paper_frame(graph, inputs, target, TARGET, false)
    })?;
    all.retain(|recipe| recipe.pass.starts_with("paper"));
    let botsch = [
        ("botsch visibility", (&shaders::BOTSCH_VISIBILITY_VERT, &shaders::BOTSCH_VISIBILITY_FRAG)),
        ("botsch accumulate", (&shaders::BOTSCH_ACCUMULATE_VERT, &shaders::BOTSCH_ACCUMULATE_FRAG)),
    ];
    all.extend(
        botsch.map(|(pass, stages)| PipelineRecipe { pass: pass.to_owned(), key: Key::Counted(stages) }),
    );
    Ok(all)
}

/// The format of the target.
const TARGET: vk::Format = vk::Format::R8G8B8A8_SRGB;

/// The pipelines of a frame, each with the first pass that has it, in the frame's order.
///
/// # Errors
/// [`crate::error::ErrorKind::Option`] for settings that have no picture.
pub fn frame_pipelines(settings: &Settings, traits: Traits) -> Result<Vec<PipelineRecipe>> {
    settings.validate()?;
    let mut all = listed(settings, traits, |graph, inputs, plan, target| {
        passes::frame(graph, inputs, plan, target, TARGET, (traits.export, None)).map(drop)
    })?;
    if traits.floor {
        all.extend(listed(settings, traits, |graph, inputs, plan, target| {
            let mut points = graph.create_buffer("floor points", BufferDesc::of_bytes(FLOOR_POINT_BYTES));
            for draw in plan.opaque.splats {
                floor_points(graph, inputs, draw, 0, &mut points)?;
            }
            let points = [FloorPoints { buffer: &points, count: 1 }];
            floor_frame(graph, inputs, &points, target, TARGET)
        })?);
    }
    let mut seen = HashSet::new();
    all.retain(|recipe| seen.insert(recipe.clone()));
    Ok(all)
}
/// The pipelines of the passes that `declare` adds to the frame of a scene with these traits.
fn listed(
    settings: &Settings,
    traits: Traits,
    declare: impl for<'a> FnOnce(
        &mut Graph<'a, Body<'a>>,
        Inputs<'a>,
        &'a FramePlan<'a>,
        &mut Handle<Image>,
    ) -> Result<()>,
) -> Result<Vec<PipelineRecipe>> {
    // A CPU's, whose tiles are drawn by columns unless asked otherwise.
    let limits = Limits { is_cpu: true, shuffles: true, max_texels: 1 << 27, ..Limits::plain() };
    let settings = &passes::with_sums(settings, &limits);
    let (scene, eye) = (scene_of(traits), DVec3::new(0.0, 0.0, 10.0));
    let camera = Camera {
        eye,
        target: DVec3::ZERO,
        up: DVec3::Y,
        fov_y_rad: Camera::DEFAULT_FOV_Y_RAD,
        ..Camera::default()
    };
    let prepared = prepare_without_device(&limits, &scene)?;
    let arena = Arena::new();
    let plan = FramePlan::new(&arena, &[Placed::at_home(&prepared)], &camera, settings, &limits);
    let list = RefCell::default();
    {
        let mut graph = Graph::new(&arena);
        let inputs = Inputs::new(&camera, settings, Place::List(&list));
        let mut target = graph.create_image("target", inputs.image(TARGET));
        declare(&mut graph, inputs, &plan, &mut target)?;
    }
    Ok(list.into_inner())
}

/// A splat, and what else there is, in front of the eye.
fn scene_of(traits: Traits) -> Scene {
    let object = |alpha: f32| {
        // So large that it reaches behind the eye, or a hundredth of the view.
        let radius = if traits.may_be_large { 100.0 } else { 0.1 };
        let shapes = match traits.ellipses {
            true => Shapes::Ellipses { s: vec![radius * Vec3::X], t: vec![0.5 * radius * Vec3::Y] },
            false => Shapes::Disks { normals: vec![Vec3::Z], radii: vec![radius] },
        };
        let colors = Colors::Uniform([0.5, 0.5, 0.5, alpha]);
        let splats = Splats::new(vec![DVec3::ZERO], shapes, colors);
        Object { name: String::new(), splats, closed: traits.closed }
    };
    let mesh = |alpha: f32| MeshObject {
        name: String::new(),
        mesh: Mesh {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
            normals: Some(vec![Vec3::Z; 3]),
            colors: Colors::Uniform([0.5, 0.5, 0.5, alpha]),
            triangles: vec![[0, 1, 2]],
        },
        closed: traits.closed,
    };
    let alphas: &[f32] = if traits.transparent { &[1.0, 0.5] } else { &[1.0] };
    let polygons: &[f32] = if traits.polygons { alphas } else { &[] };
    let light = Light { kind: LightKind::Eye, ..Light::DEFAULT };
    Scene {
        objects: alphas.iter().map(|alpha| object(*alpha)).collect(),
        meshes: polygons.iter().map(|alpha| mesh(*alpha)).collect(),
        lights: if traits.lit { vec![light; 2] } else { Vec::new() },
        storage: Storage::default(),
        ..Scene::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Edges, KernelEval};

    #[test]
    fn a_frame_has_the_pipelines_of_its_passes() {
        let of = |settings: &Settings, traits| -> Vec<String> {
            let all = frame_pipelines(settings, traits).unwrap();
            all.iter().map(|recipe| format!("{} {}", recipe.pass, recipe.draws())).collect()
        };
        let settings = Settings { edges: Edges::Hard, ..Settings::default() };
        assert_eq!(of(&settings, Traits::default()), ["visibility points", "accumulate points", "finalize "]);
        let all = Traits { may_be_large: true, export: true, floor: true, ..Traits::default() };
        assert_eq!(
            of(&Settings { kernel_eval: KernelEval::Texture, ..settings }, all),
            [
                "kernel texture ",
                "mark large splats ",
                "scan large splats ",
                "list large splats ",
                "visibility small points",
                "visibility listed quads",
                "accumulate small points",
                "accumulate listed quads",
                "finalize ",
                "export ",
                "floor points 0 ",
                "floor depth points",
                "floor add points",
                "floor fill ",
            ]
        );
    }
}
