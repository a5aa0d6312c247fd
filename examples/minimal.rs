//! Splats from a file, as a picture: `cargo run --release --example minimal -- picture.png splats.ply`. `surfel convert` makes such files of
//! meshes and points; without one it is the built-in model.

use surfel::{
    Camera, Headless, HeadlessOptions, Scene, Settings, Validation, Wanted,
    load::{self, LoadOptions, Model, builtin},
    scene::Object,
};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let output = arguments.next().unwrap_or_else(|| "minimal.png".to_owned());
    let input = arguments.next();
    let object = match input {
        None => builtin::relief(50_000),
        Some(file) => match load::load(file.as_ref(), &LoadOptions::default(), &())?.model {
            Model::Splats { splats, closed } => Object { name: file, splats, closed },
            _ => {
                return Err(format!(
                    "{file}: expected splats; surfel convert makes them of meshes and points"
                )
                .into());
            }
        },
    };
    let scene = Scene { objects: vec![object], ..Scene::default() };
    let settings = Settings::default();
    let ball = scene.ball().ok_or("there is nothing to see")?;
    let camera = Camera::fit(&ball, settings.size_px, Camera::DEFAULT_FOV_Y_RAD);
    let mut headless =
        Headless::new(&HeadlessOptions { validation: Validation::On, device: None, cache_folder: None })?;
    let prepared = headless.prepare(&scene, &|_done, _total| {})?;
    let frame =
        headless.render(&prepared, &camera, &settings, Wanted { picture: true, ..Wanted::default() })?;
    surfel::save::png(output.as_ref(), settings.size_px, 4, frame.srgb.as_flattened())?;
    println!("{output}");
    Ok(())
}
