//! Which methods there are for a scene on a device, and why not the others.

use std::collections::BTreeMap;

use surfel::{
    Error, Result,
    renderer::Renderer,
    report::compare::{Method, Skipped},
    scene::{Camera, Filter, Rasterizer, Scene, Settings},
};

/// The methods that exist, and those that don't with the reason.
pub fn split(
    methods: Vec<Method>,
    base: &Settings,
    (scene, camera): (&Scene, &Camera),
    renderer: &Renderer,
) -> (Vec<Method>, Vec<Skipped>) {
    let (mut left, mut skipped) = (Vec::new(), Vec::new());
    let perspective = methods.iter().any(|method| method.rasterizer == Rasterizer::Perspective);
    for method in methods {
        if perspective && method.filter.filter == Filter::Ewa && method.rasterizer == Rasterizer::AffineCenter
        {
            let reason = "--filter ewa brings the map of affine-center: drawn as perspective's".to_owned();
            skipped.push(Skipped { method, reason });
            continue;
        }
        let settings = method.settings(base);
        match renderer.check(camera, &settings).and_then(|()| settings.check_scene(scene)) {
            Ok(()) => left.push(method),
            Err(error) => skipped.push(Skipped { method, reason: error.to_string() }),
        }
    }
    (left, skipped)
}

/// Refuses to compare nothing.
///
/// # Errors
/// The first reason why a method was left out, where none is left.
pub fn some_left(left: usize, skipped: &[Skipped]) -> Result<()> {
    let reason = skipped.first().map_or_else(String::new, |first| format!("; {}", first.reason));
    match left {
        0 => Err(Error::option("compare", format!("no method is left{reason}"))),
        _ => Ok(()),
    }
}

/// The options that do not say which method it is.
pub fn common_options(mut options: BTreeMap<&'static str, String>) -> BTreeMap<&'static str, String> {
    options.retain(|option, _| !Method::OPTIONS.contains(option));
    options
}
