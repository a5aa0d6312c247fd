//! Splats of a file as a picture: `cargo run --release --example minimal -- picture.png splats.ply`; without a file, of the built-in model.

use surfel::{Camera, Headless, HeadlessOptions, Scene, Settings, Validation, Wanted, load, load::builtin};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let picture = arguments.next().unwrap_or_else(|| "minimal.png".to_owned());
    let model =
        arguments.next().map_or_else(|| Ok(builtin::relief(50_000)), |file| load::object(file.as_ref()))?;
    let scene = Scene::from(model);
    let settings = Settings::default();
    let ball = scene.ball().ok_or("there is nothing to see")?;
    let camera = Camera::fit(&ball, settings.size_px, Camera::DEFAULT_FOV_Y_RAD);
    let options = HeadlessOptions { validation: Validation::On, ..HeadlessOptions::default() };
    let mut headless = Headless::new(&options)?;
    let prepared = headless.prepare(&scene, &|_done, _total| {})?;
    headless.render(&prepared, &camera, &settings, Wanted::PICTURE)?.save_png(picture)?;
    Ok(())
}
