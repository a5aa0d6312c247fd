//! What of a frame is beyond f32: refused where the picture would be wrong, told where it is less exact.

use crate::passes::plan::{FramePlan, SplatMethod, SurfacePlan, draws::Draw};
use crate::{
    error::{Error, Result},
    prepare::{PreparedScene, Rebase},
    scene::{Accumulate, Camera, Filter, FilterWeight, Settings},
};

/// Depth is near / z, in f32, which ends at 1e-38.
const LEAST_NEAR: f64 = 1e-36;

/// The least part of its depth by which a splat is shifted: `LEAST_SHIFT` of `glsl/inc/mapping.glsl`.
const LEAST_SHIFT: f64 = 1e-6;

/// Refuses a near plane so near that the depth of something in the scene has no digits.
///
/// # Errors
/// [`crate::error::ErrorKind::Option`] with the nearest that it may be.
pub fn check(scene: &PreparedScene, camera: &Camera) -> Result<()> {
    let near_in_units = |rebase: &Rebase, radius: f64| {
        let view = rebase.view_from_local(camera);
        // A splat that is larger than far has a unit of its own, which is larger, too.
        camera.near() * view.view_from_world_scale / (radius * view.view_from_local_scale).max(1.0)
    };
    let splats = scene.chunks.iter().map(|chunk| near_in_units(&chunk.rebase, chunk.largest_radius));
    let meshes = scene.meshes.iter().map(|mesh| near_in_units(&mesh.rebase, 0.0));
    let least = splats.chain(meshes).fold(1.0, f64::min);
    if least < LEAST_NEAR {
        let (near, needed) = (camera.near(), camera.near() / least * LEAST_NEAR);
        let problem = format!(
            "near {near:e}: something in the scene is {:.1e} times as far or as large; expected {needed:.1e} or more",
            least.recip()
        );
        return Err(Error::option("camera", problem));
    }
    Ok(())
}

/// What a frame can't tell apart, or weighs otherwise than asked, in a sentence each.
pub fn notes(frame: &FramePlan<'_>, settings: &Settings) -> Vec<String> {
    let mut notes = Vec::new();
    let splats = || frame.opaque.splats.iter().chain(&frame.transparent.splats);
    if let Some(depth) = splats().filter_map(depth_without_epsilon).reduce(f64::max) {
        notes.push(format!(
            "epsilon is less than a millionth of the depth of what is {depth:.3e} away: surfaces there that are less than a \
             millionth of their distance apart are one"
        ));
    }
    let is_weighed = settings.filter == Filter::Ewa
        || settings.filter.adjusts() && settings.filter_weight == FilterWeight::Area;
    let by_points = |part: &SurfacePlan<'_>| {
        !part.splats.is_empty() && matches!(part.method, SplatMethod::Primitives { .. })
    };
    if is_weighed
        && settings.accumulate == Accumulate::F16
        && (by_points(&frame.opaque) || by_points(&frame.transparent))
    {
        notes.push("sums of 16 bits: a filter leaves each splat a 16th of its weight at least, or the smallest would lose \
                    their color; --accumulate f32 has no such floor".to_owned());
    }
    for (number, mesh) in frame.opaque.meshes.iter().chain(&frame.transparent.meshes).enumerate() {
        if let Some([rounding, edge]) = mesh.chunk.rounding() {
            notes.push(format!(
                "mesh {number}: its corners are rounded by up to {rounding:.1e}, and its mean edge is {edge:.1e} long: it is too \
                 extended for f32"
            ));
        }
    }
    notes
}

/// The depth, in the world's unit, of the farthest splats of a chunk, if their ε is less than [`LEAST_SHIFT`] of it.
fn depth_without_epsilon(draw: &Draw<'_>) -> Option<f64> {
    let constants = &draw.constants;
    let depth = draw.farthest_z();
    let radius = draw.chunk.largest_radius * draw.view.view_from_local_scale;
    let epsilon = f64::from(constants.epsilon_radii) * radius + f64::from(constants.epsilon_length);
    (epsilon > 0.0 && epsilon < LEAST_SHIFT * depth).then(|| depth / draw.view.view_from_world_scale)
}
