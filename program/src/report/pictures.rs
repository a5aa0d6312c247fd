//! The model, and what each method makes of it.

use serde::Serialize;
use surfel::{
    Result,
    prepare::PreparedScene,
    renderer::Wanted,
    report::{CameraReport, InputReport},
};

use super::{
    command_line::CommandLine,
    part::{Block, Panel, Part},
    session::Session,
};
use crate::{json::to_value, render::RenderArguments, scene::upload};

/// The shadings shown, with what they show.
const SHADINGS: [(&str, &str); 3] = [
    ("phong", "lit by one light at the eye: how the surface looks"),
    ("normals", "each direction has a color: where it jumps, the surface or its normals do"),
    ("albedo", "the model's own colors, blended between splats, without light"),
];

/// The model in the page's JSON.
#[derive(Serialize)]
struct Data<'a> {
    camera: CameraReport,
    inputs: &'a [InputReport],
}

/// Gathers the part.
pub fn gather(session: &mut Session<'_>) -> Result<Part> {
    let mut part = Part::default();
    let inputs = &session.loaded.inputs;
    part.finding = inputs.iter().map(|input| input.summary.as_str()).collect::<Vec<_>>().join("; ") + ".";
    let mut panels = Vec::new();
    let Session { headless, loaded, bars, .. } = session;
    let scene = upload(headless, &loaded.scene, bars)?;
    for (shading, about) in SHADINGS {
        let line = session.arguments.render(shading);
        panels.push(picture(session, &scene, &line, [shading, about])?);
        part.commands.push(line);
    }
    part.blocks.push(Block::Pictures {
        columns: 3,
        panels,
        caption:
            "The model with the default method. What is wrong with a scan or its normals is seen here before \
                  any figure tells it."
                .to_owned(),
    });
    part.data = to_value(&Data { camera: session.camera.into(), inputs })?;

    let comparison = session.comparison()?;
    part.commands.push(comparison.line.clone().option("-o", "pictures"));
    part.blocks.push(Block::Heading("What each filter and each rasterizer draws".to_owned()));
    let (columns, panels) = (6, comparison.pictures.drain(..).flatten().collect());
    let truth: Vec<Panel> = comparison.truth.take().into_iter().collect();
    part.blocks.push(Block::Pictures { columns, panels: truth, caption: String::new() });
    part.blocks.push(Block::Pictures {
        columns,
        panels,
        caption: "Each method beside its distance from the ground truth, the continuous surface under the filter's \
                  Gaussian at many samples a pixel. Black is equal. Rims are where filters widen the surface; light \
                  inside is blur or aliasing. Rasterizers of one filter should look alike: they differ in speed."
            .to_owned(),
    });
    Ok(part)
}

/// Draws one picture.
fn picture(
    session: &mut Session<'_>,
    scene: &PreparedScene,
    line: &CommandLine,
    [shading, about]: [&str; 2],
) -> Result<Panel> {
    let arguments: RenderArguments = line.arguments()?;
    let settings = arguments.picture.settings();
    settings.check_scene(&session.loaded.scene)?;
    let frame = session.headless.render(scene, session.camera, &settings, Wanted::PICTURE)?;
    let pixels: Vec<[u8; 3]> = frame.srgb.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect();
    Panel::new(shading, about, "The model", frame.size_px, &pixels)
}
