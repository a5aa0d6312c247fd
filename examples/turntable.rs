//! A model from all sides, as numbered pictures: `cargo run --release --example turntable -- 24 turn%04d.png`. The scene is brought to the
//! device once.

use surfel::{
    Camera, Headless, HeadlessOptions, Scene, Settings, Validation, Wanted, glam::DQuat, load::builtin,
    scene::Shading,
};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let count: u32 = arguments.next().map_or(Ok(24), |count| count.parse())?;
    let pattern = arguments.next().unwrap_or_else(|| "turn%04d.png".to_owned());
    let scene = Scene::from(builtin::relief(50_000));
    let settings = Settings { size_px: [512, 512], shading: Shading::Phong, ..Settings::default() };
    let first =
        Camera::fit(&scene.ball().ok_or("nothing to see")?, settings.size_px, Camera::DEFAULT_FOV_Y_RAD);
    let mut headless =
        Headless::new(&HeadlessOptions { validation: Validation::On, device: None, cache_folder: None })?;
    let prepared = headless.prepare(&scene, &|_done, _total| {})?;
    for number in 0..count {
        let turn = DQuat::from_rotation_y(std::f64::consts::TAU * f64::from(number) / f64::from(count));
        let camera = Camera { eye: first.target + turn * (first.eye - first.target), ..first };
        let frame = headless.render(&prepared, &camera, &settings, Wanted::PICTURE)?;
        frame.save_png(pattern.replace("%04d", &format!("{number:04}")))?;
    }
    println!("{count} pictures, {pattern}");
    Ok(())
}
