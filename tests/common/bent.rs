//! A transparent part with sides that bend.

use surfel::{
    geometry::sharp::{SharpOptions, sharp_splats},
    hard_scenes::{builder, parts},
    scene::{Colors, Edges, Layers, Object, Rasterizer, Scene, Shading},
};

use super::{
    scenes::{self, Hard},
    with,
};

/// A cylinder of many sides that bends from side to side, through whose surfaces half of the light goes.
pub fn bent(sides: u32, rows: u32) -> Hard {
    let (mut splats, report) =
        sharp_splats(&parts::cylinder(sides, rows, 2.0), &SharpOptions::default(), &()).unwrap();
    splats.colors = Colors::Uniform([1.0, 1.0, 1.0, 0.5]);
    let object = Object { name: String::new(), splats, closed: report.closed };
    let mut hard = with(&scenes::clipped(), |settings| {
        settings.rasterizer = Rasterizer::Compute;
        settings.edges = Edges::Coverage;
        settings.layers = Layers::Fixed(8);
        settings.shading = Shading::Albedo;
        settings.background = None;
        settings.size_px = [400, 400];
    });
    hard.camera = builder::camera([0.3, 1.5, 4.5], [0.0; 3]);
    hard.scene = Scene { objects: vec![object], ..Scene::default() };
    hard
}
