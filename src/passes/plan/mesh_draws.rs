//! Polygons: the meshes of a prepared scene as this frame's camera and settings see them.

use crate::passes::{
    pipeline::constants::FrameConstants,
    plan::{
        frame_constants::frame_constants,
        levels::LevelView,
        range::DepthRange,
        scene_view::{CameraView, SceneView},
    },
};
use crate::{
    arena::Arena,
    prepare::{ChunkLevels, LevelPart, MeshChunk, MeshLevels, Placed},
    scene::{Camera, Epsilon, Settings},
};

/// A piece of a mesh in this frame.
#[derive(Clone, Copy)]
pub struct MeshDraw<'a> {
    /// The triangles.
    pub chunk: &'a MeshChunk,
    /// The number of their scene among those that the frame shows.
    pub placed: u32,
    /// What its shaders are told.
    pub constants: FrameConstants,
    /// Triangles that face away are not drawn.
    pub cull: bool,
    /// How the camera sees its cells, where each is drawn or not.
    pub(crate) levels: Option<LevelView>,
}

impl MeshDraw<'_> {
    /// Whether splats are drawn for all of it, where levels of detail are chosen.
    pub(crate) fn is_all_splats(&self) -> bool {
        match (&self.levels, &self.chunk.levels) {
            (Some(view), Some(levels)) => view.all_are_small(&levels.balls),
            _ => false,
        }
    }
}

/// All pieces of meshes of a scene as seen from a camera; those in cells as a whole where no levels of detail are drawn.
pub fn mesh_draws<'a, 's>(
    placed: Placed<'a>,
    (arena, camera, range): (&'s Arena, &Camera, DepthRange),
    settings: &'s Settings,
) -> impl Iterator<Item = MeshDraw<'a>> + use<'a, 's> {
    let view = arena.keep(CameraView::new((camera, range), settings));
    let view = arena.keep(view.of_scene(arena, &placed.at));
    placed.scene.meshes.iter().map(move |chunk| mesh_draw(placed, chunk, view, settings))
}

/// A piece of a mesh of a scene that is seen so.
pub(super) fn mesh_draw<'a>(
    Placed { scene, at, .. }: Placed<'a>,
    chunk: &'a MeshChunk,
    of_scene: &SceneView<'_>,
    settings: &Settings,
) -> MeshDraw<'a> {
    let epsilon = match settings.epsilon {
        Epsilon::Auto => Epsilon::auto_radii(true) * scene.mean_transparent_radius,
        Epsilon::Radii(radii) => radii * scene.mean_transparent_radius,
        Epsilon::Length(length) => length / at.scale,
    };
    let view = chunk.rebase.view_from(&of_scene.view);
    MeshDraw {
        chunk,
        placed: 0,
        constants: FrameConstants {
            chunk_color: u32::from(chunk.uniform_color),
            ..frame_constants(&view, of_scene, settings, (0.0, epsilon))
        },
        cull: settings.culls(chunk.closed && !chunk.transparent),
        levels: chunk.levels.and_then(|MeshLevels { space, .. }| {
            let levels = ChunkLevels { space, part: LevelPart::OfCells };
            LevelView::new(levels, false, &of_scene.camera(&at), settings)
        }),
    }
}
