//! What of a frame is beyond f32: refused where the picture would be wrong, told where it is less exact.

use glam::DVec3;

use crate::passes::plan::{FramePlan, SurfacePlan, draws::Draw, range::DepthRange};
use crate::{
    error::{Error, Result},
    prepare::{Chunk, Placed, PreparedScene, Rebase},
    scene::{Accumulate, Camera, Settings},
    shaders::config::LEAST_SHIFT,
};

/// Depth is near / z, in f32, which ends at 1e-38.
const LEAST_NEAR: f64 = 1e-36;

/// One in so many splats may be anywhere.
const STRAYS: u64 = 1000;

/// The longest edge of a polygon, in distances of the target, of which a device's rasterizer, in f32, leaves something near the eye.
const LARGEST_EDGE: f64 = 1e6;

/// Refuses a near plane so near that the depth of something in the scene has no digits.
///
/// # Errors
/// [`crate::error::ErrorKind::Option`] with the nearest that it may be.
pub fn check(scenes: &[Placed<'_>], camera: &Camera) -> Result<()> {
    if camera.is_orthographic() {
        return check_range(scenes, camera);
    }
    let mut near = scenes.iter().filter(|placed| !is_far_from_least(placed, camera));
    near.try_for_each(|placed| check_near(placed, camera))
}

/// The same of one scene, in its own space.
fn check_near(Placed { scene, at, .. }: &Placed<'_>, camera: &Camera) -> Result<()> {
    let (eye, near) = (at.eye(camera), camera.near() / at.scale);
    // Depths that are handed out have the world's unit, and 32 bits.
    let told = near as f32;
    if told == 0.0 || told.is_infinite() {
        let problem = format!("near {near:e}: expected {:e} to {:e}", f32::from_bits(1), f32::MAX);
        return Err(Error::option("camera", problem));
    }
    // Over the distance of what is farthest, or the radius of what is larger than far and has a unit of its own.
    let near_in_units = |rebase: &Rebase, reach: f64| {
        let distance = rebase.origin.distance(eye);
        let unit = rebase.unit_of_view(distance);
        let farthest = (distance + reach / rebase.scale) / unit;
        near / unit / farthest.max(1.0)
    };
    // A stray point beyond all measure, which is seen as nothing, must not refuse the rest.
    let total = scene.splat_count();
    let counts = |count: u32| count > 0 && u64::from(count) * STRAYS >= total;
    let splats = scene
        .chunks
        .iter()
        .filter(|chunk| counts(chunk.count))
        .map(|chunk| near_in_units(&chunk.rebase, reach(chunk, DVec3::length)));
    let meshes = scene.meshes.iter().map(|mesh| near_in_units(&mesh.rebase, 3_f64.sqrt() * mesh.farthest));
    let least = splats.chain(meshes).fold(1.0, f64::min);
    if least < LEAST_NEAR {
        let needed = near / least * LEAST_NEAR;
        let problem = format!(
            "near {near:e}: something in the scene is {:.1e} times as far or as large; expected {needed:.1e} or more",
            least.recip()
        );
        return Err(Error::option("camera", problem));
    }
    Ok(())
}

/// Whether the near plane is so far beyond the nearest that sums of coordinates in place of lengths tell it, in the world's lengths: nearly always, and a frame may show hundreds of scenes.
fn is_far_from_least(Placed { scene, at, .. }: &Placed<'_>, camera: &Camera) -> bool {
    let sum = |v: DVec3| v.abs().element_sum();
    // No less than the distance, the reach and the unit of a chunk together; a unit is twice as long as what it has to be at most.
    let eye = sum(camera.eye - at.translation);
    let extent = |rebase: &Rebase, reach: f64| sum(rebase.origin) + (reach + 1.0) / rebase.scale;
    let splats = scene.chunks.iter().map(|chunk| extent(&chunk.rebase, reach(chunk, sum)));
    let meshes = scene.meshes.iter().map(|mesh| extent(&mesh.rebase, 3.0 * mesh.farthest));
    let farthest = splats.chain(meshes).fold(0.0, f64::max);
    let near = camera.near();
    // NaN is not far.
    (1e-30 * at.scale..1e30 * at.scale).contains(&near)
        && near > 10.0 * LEAST_NEAR * (eye + at.scale * farthest)
}

/// How far from its local origin a chunk reaches, by a length of a vector.
fn reach(chunk: &Chunk, length: impl Fn(DVec3) -> f64) -> f64 {
    let [lo, hi] = chunk.bounds;
    length(lo.abs().max(hi.abs())) + chunk.largest_radius
}

/// The same of an orthographic camera, whose depth ends where the scene does.
fn check_range(scenes: &[Placed<'_>], camera: &Camera) -> Result<()> {
    let range = DepthRange::of(scenes, camera);
    let ends = [range.end as f32, range.from_eye.abs().max(1.0) as f32];
    if ends.iter().all(|end| end.is_normal()) {
        return Ok(());
    }
    let problem = format!(
        "the scene reaches from {:e} to {:e} before the eye: expected lengths between {:e} and {:e}",
        range.from_eye,
        range.from_eye + 0.5 * range.end,
        f32::MIN_POSITIVE,
        f32::MAX
    );
    Err(Error::option("camera", problem))
}

/// What f32 can't tell apart in a frame, or has no digits for, in a sentence each.
pub fn beyond_f32(scene: &PreparedScene, frame: &FramePlan<'_>, camera: &Camera) -> Vec<String> {
    let mut notes = Vec::new();
    let splats = || frame.opaque.splats.iter().chain(frame.transparent.splats);
    if let Some(share) = splats().filter_map(|draw| share_of_range(draw, camera)).reduce(f64::min) {
        notes.push(format!(
            "epsilon is {share:.1e} of how deep the scene is: surfaces that are less than a millionth of that apart are one"
        ));
    }
    let depth_of = |draw| if camera.is_orthographic() { None } else { depth_without_epsilon(draw) };
    if let Some(depth) = splats().filter_map(depth_of).reduce(f64::max) {
        notes.push(format!(
            "epsilon is less than a millionth of the depth of what is {depth:.3e} away: surfaces there that are less than a \
             millionth of their distance apart are one"
        ));
    }
    for (number, mesh) in scene.meshes.iter().enumerate() {
        let (longest, distance) = (mesh.longest_edge, camera.eye.distance(camera.target));
        if longest > LARGEST_EDGE * distance {
            notes.push(format!(
                "mesh {number}: an edge of {longest:.1e} is over a million times as long as the target is far: near the eye such a \
                 polygon has no digits"
            ));
        }
        if let Some([rounding, edge]) = mesh.rounding() {
            notes.push(format!(
                "mesh {number}: its corners are rounded by up to {rounding:.1e}, and its mean edge is {edge:.1e} long: it is too \
                 extended for f32"
            ));
        }
    }
    notes
}

/// What 16-bit sums ask of weights, in a sentence.
pub fn floors(frame: &FramePlan<'_>) -> Option<String> {
    let has_floors = |part: &SurfacePlan<'_>| part.splats.iter().any(|draw| draw.half_sums);
    let has_any = has_floors(&frame.opaque) || has_floors(&frame.transparent);
    has_any.then(|| {
        "sums of 16 bits: a filter leaves each splat a 16th of its weight at least, or the smallest would lose their color; \
         --accumulate f32 has no such floor"
            .to_owned()
    })
}

/// Why levels of detail that were asked for are not drawn, in a sentence; `None` where they are, or nobody asked.
pub(crate) fn unused_levels(
    scene: &PreparedScene,
    frame: &FramePlan<'_>,
    settings: &Settings,
) -> Option<String> {
    let draws_none = |part: &SurfacePlan<'_>, transparent: bool| {
        let own = |chunk: &Chunk| chunk.stands_for_others() && chunk.transparent == transparent;
        scene.chunks.iter().any(own) && part.splats.iter().all(|draw| draw.levels.is_none())
    };
    let unused = draws_none(&frame.opaque, false) || draws_none(&frame.transparent, true);
    let why = "levels of detail (--lod, --budget) are for --rasterizer auto and compute, and for points; the scene itself is drawn";
    (unused && settings.tau_px() > 0.0).then(|| why.to_owned())
}

/// That sums of 16 bits were asked for and are made nowhere, in a sentence.
pub(crate) fn unused_sums(frame: &FramePlan<'_>, settings: &Settings) -> Option<String> {
    let mut drawn =
        [&frame.opaque, &frame.transparent].into_iter().filter(|part| !part.splats.is_empty()).peekable();
    let is_asked = settings.accumulate == Accumulate::F16 && drawn.peek().is_some();
    (is_asked && drawn.all(|part| part.settings.accumulate == Accumulate::F32)).then(|| {
        "sums have 32 bits: 16 (--accumulate f16) are for points, and not for --shading edl".to_owned()
    })
}

/// The depth, in the world's unit, of the farthest splats of a chunk, if their ε is less than [`LEAST_SHIFT`] of it.
fn depth_without_epsilon(draw: &Draw<'_>) -> Option<f64> {
    let constants = &draw.constants;
    let depth = draw.farthest_z();
    let radius = draw.chunk.largest_radius * draw.view.view_from_local_scale;
    let epsilon = f64::from(constants.epsilon_radii) * radius + f64::from(constants.epsilon_length);
    (epsilon > 0.0 && epsilon < f64::from(LEAST_SHIFT) * depth)
        .then(|| depth / draw.view.view_from_world_scale)
}

/// Of an orthographic camera's range of depths, ε, if it is less than [`LEAST_SHIFT`].
fn share_of_range(draw: &Draw<'_>, camera: &Camera) -> Option<f64> {
    let constants = &draw.constants;
    let radius = draw.chunk.largest_radius * draw.view.view_from_local_scale;
    let epsilon = f64::from(constants.epsilon_radii) * radius + f64::from(constants.epsilon_length);
    let share = epsilon / f64::from(constants.near);
    (camera.is_orthographic() && epsilon > 0.0 && share < f64::from(LEAST_SHIFT)).then_some(share)
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3};

    use super::*;
    use crate::{
        prepare::prepare_without_device,
        scene::{
            Accumulate, Colors, Epsilon, Filter, Mesh, MeshObject, Object, Rasterizer, Scene, Settings,
            Shapes, Splats,
        },
        vk::Limits,
    };

    /// Disks of a radius on the axis of view, at these depths.
    fn disks(depths: &[f64], radius: f32) -> Scene {
        let count = depths.len();
        let shapes = Shapes::Disks { normals: vec![Vec3::Z; count], radii: vec![radius; count] };
        let positions = depths.iter().map(|depth| DVec3::NEG_Z * *depth).collect();
        let splats = Splats::new(positions, shapes, Colors::Uniform([1.0; 4]));
        let objects = vec![Object { name: "disks".to_owned(), splats, closed: false }];
        Scene { objects, ..Scene::default() }
    }

    fn camera(near: f64) -> Camera {
        let eye = DVec3::ZERO;
        Camera {
            eye,
            target: DVec3::NEG_Z,
            up: DVec3::Y,
            fov_y_rad: 1.0,
            near: Some(near),
            ..Camera::default()
        }
    }

    fn notes_of(scene: &Scene, settings: &Settings) -> Vec<String> {
        let limits = Limits::plain();
        let prepared = prepare_without_device(&limits, scene).unwrap();
        let arena = crate::arena::Arena::new();
        let frame = FramePlan::new(&arena, &[Placed::at_home(&prepared)], &camera(1e-3), settings, &limits);
        beyond_f32(&prepared, &frame, &camera(1e-3)).into_iter().chain(super::floors(&frame)).collect()
    }

    #[test]
    fn a_near_plane_without_depth_is_refused_whether_things_are_far_or_large() {
        let problem_of = |scene: &Scene, near: f64| {
            let prepared = prepare_without_device(&Limits::plain(), scene).unwrap();
            check(&[Placed::at_home(&prepared)], &camera(near)).map_err(|error| error.to_string())
        };
        assert_eq!(problem_of(&disks(&[1.0, 3.0], 0.1), 1e-30), Ok(()));
        assert_eq!(problem_of(&disks(&[1e6], 0.1), 1e-20), Ok(()));
        for near in [1e-50, 1e40] {
            let problem = problem_of(&disks(&[1.0], 1.0), near).unwrap_err();
            assert!(problem.contains("expected 1e-45 to 3.4028235e38"), "{problem}");
        }
        for (scene, near) in
            // The last has its local space's origin near the eye: most of it is there.
            [
                (disks(&[1.0], 0.1), 1e-37),
                (disks(&[1e12], 0.1), 1e-25),
                (disks(&[1.0], 1e12), 1e-25),
                (disks(&[1.0, 1.0, 1e7], 1e4), 1e-30),
            ]
        {
            let problem = problem_of(&scene, near).unwrap_err();
            assert!(problem.starts_with("camera: near ") && problem.contains("or more"), "{problem}");
        }
    }

    #[test]
    fn what_f32_can_not_tell_apart_is_told_and_nothing_of_an_ordinary_scene() {
        let points =
            Settings { rasterizer: Rasterizer::Perspective, filter: Filter::None, ..Settings::default() };
        assert!(notes_of(&disks(&[1.0, 3.0], 0.1), &points).is_empty());
        let sheets = Settings { epsilon: Epsilon::Length(0.05), ..points.clone() };
        assert!(notes_of(&disks(&[1e4], 0.1), &sheets).is_empty());
        let told = notes_of(&disks(&[1e6], 0.1), &sheets);
        assert!(told.len() == 1 && told[0].starts_with("epsilon is less"), "{told:?}");
        let floors = Settings { filter: Filter::Ewa, ..points.clone() };
        let told = notes_of(&disks(&[1.0], 0.1), &floors);
        assert!(told.len() == 1 && told[0].starts_with("sums of 16 bits"), "{told:?}");
        let exact = Settings { accumulate: Accumulate::F32, ..floors };
        assert!(notes_of(&disks(&[1.0], 0.1), &exact).is_empty());
        let mut scene = disks(&[1.0], 0.1);
        let corner = |x: f64, y: f64| DVec3::new(x, y, -5.0);
        let positions =
            [0.0, 1e4].iter().flat_map(|x| [corner(*x, 0.0), corner(x + 1.0, 0.0), corner(*x, 1.0)]);
        let mesh = Mesh {
            positions: positions.collect(),
            normals: None,
            triangles: vec![[0, 1, 2], [3, 4, 5]],
            colors: Colors::Uniform([1.0; 4]),
        };
        scene.meshes.push(MeshObject { name: "far corners".to_owned(), mesh, closed: false });
        let told = notes_of(&scene, &points);
        assert!(told.len() == 1 && told[0].starts_with("mesh 0: its corners are rounded"), "{told:?}");
        scene.meshes[0].mesh.positions = vec![corner(-1e7, -1.0), corner(1e7, -1.0), corner(0.0, 1e7)];
        scene.meshes[0].mesh.triangles = vec![[0, 1, 2]];
        let told = notes_of(&scene, &points);
        assert!(told.len() == 1 && told[0].starts_with("mesh 0: an edge of 2.0e7"), "{told:?}");
    }
}
