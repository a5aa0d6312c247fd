//! Splats from a file, as a picture: `cargo run --release --example minimal -- picture.png splats.ply`. `surfel convert` makes such files of
//! meshes and points; without one it is the built-in model.

use surfel::{
    Camera, Headless, HeadlessOptions, Scene, Settings, Validation, Wanted,
    load::{self, builtin},
};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let output = arguments.next().unwrap_or_else(|| "minimal.png".to_owned());
    let object = match arguments.next() {
        None => builtin::relief(50_000),
        Some(file) => load::object(file.as_ref())?,
    };
    let scene = Scene { objects: vec![object], ..Scene::default() };
    let settings = Settings::default();
    let ball = scene.ball().ok_or("there is nothing to see")?;
    let camera = Camera::fit(&ball, settings.size_px, Camera::DEFAULT_FOV_Y_RAD);
    let options = HeadlessOptions { validation: Validation::On, ..HeadlessOptions::default() };
    let mut headless = Headless::new(&options)?;
    let prepared = headless.prepare(&scene, &|_done, _total| {})?;
    let wanted = Wanted { picture: true, ..Wanted::default() };
    let frame = headless.render(&prepared, &camera, &settings, wanted)?;
    surfel::save::png(output.as_ref(), settings.size_px, 4, frame.srgb.as_flattened())?;
    println!("{output}");
    Ok(())
}
