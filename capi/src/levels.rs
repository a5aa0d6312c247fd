//! Objects that come with their levels of detail.

use std::ffi::c_void;

use surfel::{
    geometry::Overlaps,
    glam::{DVec3, Vec3},
    scene::{ErrorBall, LeveledObject, NodeBalls, Shapes, Splats},
};

use crate::{
    arrays::copied,
    handle::get_mut,
    result::{Failure, Result, SurfelResult, guard},
    scene::SurfelScene,
    splats::{SurfelSplats, object},
    structs::{Struct, SurfelStructureType, read},
};

/// The ball by which a node is chosen, from the levels' `origin`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelErrorBall {
    /// Its middle.
    pub center: [f32; 3],
    /// Its radius: around the node's ellipse, all splats below it, and the balls of its children.
    pub radius: f32,
    /// How far what is below spreads: the root of the mean squared distance of the splats' centers from the node's, by area. Above 0, and no less than a child's.
    pub spread: f32,
}

/// An object of splats with levels of detail, by arrays: nodes, each a splat that stands for all below it. For a size of the setting `lod` a node is drawn whose spread is seen at most so large, where its parent's
/// is seen larger, or it has none; and a splat of the object where its parent's is seen larger, or it has none.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelLevels {
    /// `SURFEL_STRUCTURE_TYPE_LEVELS`.
    pub s_type: u32,
    /// `sizeof(SurfelLevels)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// The object's own splats, neighbors in space one after the other; without `epsilon`, `room` and clip curves.
    pub splats: *const SurfelSplats,
    /// The number of the node above each; `UINT32_MAX`: none is.
    pub splat_parents: *const u32,
    /// The nodes, ellipses, each behind its parent. Their name and `closed` mean nothing.
    pub nodes: *const SurfelSplats,
    /// The number of the node above each; `UINT32_MAX`: none is.
    pub node_parents: *const u32,
    /// Of each node.
    pub balls: *const SurfelErrorBall,
    /// From where their middles are counted, in the scene's own space.
    pub origin: [f64; 3],
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelLevels {
    const TYPE: SurfelStructureType = SurfelStructureType::Levels;
}

/// What no frame could draw.
fn check(what: &str, splats: &Splats) -> Result<()> {
    match (0..splats.len()).find(|number| splats.defect(*number).is_some()) {
        Some(number) => Err(Failure::invalid(format!("{what} {number} can't be drawn"))),
        None if !splats.clips.is_empty() => {
            Err(Failure::invalid(format!("{what}s: expected no clip curves")))
        }
        None => Ok(()),
    }
}

/// Over π.
fn area_of(splats: &Splats, number: usize) -> f64 {
    match &splats.shapes {
        Shapes::Disks { radii, .. } => f64::from(radii[number]).powi(2),
        Shapes::Ellipses { s, t } => s[number].as_dvec3().cross(t[number].as_dvec3()).length(),
    }
}

/// Its balls: the nodes', then that above the root.
///
/// # Safety
/// Pointers are NULL or lead to as much as the struct says.
pub unsafe fn leveled(given: &SurfelLevels) -> Result<LeveledObject> {
    // SAFETY: this function's contract, here and below.
    let (own, nodes) = unsafe { (read(given.splats, "splats")?, read(given.nodes, "nodes")?) };
    // SAFETY: as above.
    let (whole, nodes) = unsafe { (object(&own)?, object(&nodes)?.splats) };
    let (leaves, count) = (whole.splats, nodes.len());
    check("splat", &leaves)?;
    check("node", &nodes)?;
    if count > 0 && !matches!(nodes.shapes, Shapes::Ellipses { .. }) {
        return Err(Failure::invalid("nodes: expected ellipses, by tangentsS and tangentsT"));
    }
    // SAFETY: as above.
    let parents =
        |from, count: usize, name: &str| unsafe { copied(from, count as u64, name, |parent: u32| parent) };
    let leaf_parents = parents(given.splat_parents, leaves.len(), "splatParents")?;
    let node_parents = parents(given.node_parents, count, "nodeParents")?;
    let ball = |SurfelErrorBall { center, radius, spread }: SurfelErrorBall| ErrorBall {
        center: Vec3::from_array(center),
        radius,
        spread,
    };
    // SAFETY: as above.
    let mut balls = unsafe { copied(given.balls, count as u64, "balls", ball) }?;
    let spread_of = |parent: u32| balls.get(parent as usize).map_or(f32::INFINITY, |ball| ball.spread);
    for (number, (ball, parent)) in balls.iter().zip(&node_parents).enumerate() {
        let ErrorBall { center, radius, spread } = *ball;
        let is_there = *parent == u32::MAX || (*parent as usize) < number;
        let problem = match () {
            () if !is_there => format!("its parent is {parent}: expected one before it, or UINT32_MAX"),
            () if !(center.is_finite() && radius >= 0.0 && radius.is_finite()) => {
                "its ball is none".to_owned()
            }
            () if !(spread > 0.0 && spread.is_finite() && spread <= spread_of(*parent)) => {
                "its spread: expected one above 0, and no more than its parent's".to_owned()
            }
            () => continue,
        };
        return Err(Failure::invalid(format!("node {number}: {problem}")));
    }
    let is_there = |parent: &u32| *parent == u32::MAX || (*parent as usize) < count;
    if let Some(number) = leaf_parents.iter().position(|parent| !is_there(parent)) {
        let parent = leaf_parents[number];
        return Err(Failure::invalid(format!(
            "splat {number}: its parent is {parent}: there are {count} nodes"
        )));
    }
    // Each node leaves on the surface what the splats below it would.
    let overlaps = Overlaps::of(&leaves);
    let mut below = vec![0.0; count];
    for (number, parent) in leaf_parents.iter().enumerate() {
        if let Some(below) = below.get_mut(*parent as usize) {
            *below += area_of(&leaves, number) * overlaps.mean * f64::from(overlaps.inverse[number]);
        }
    }
    for number in (0..count).rev() {
        let own = below[number];
        if let Some(below) = below.get_mut(node_parents[number] as usize) {
            *below += own;
        }
    }
    if let Some(number) = below.iter().position(|area| *area == 0.0) {
        return Err(Failure::invalid(format!("node {number} stands for no splat")));
    }
    balls.push(ErrorBall::ABOVE_ROOT);
    let above = count as u32;
    let radius = balls[..count].iter().map(|ball| f64::from(ball.center.length() + ball.radius));
    let own = (0..).zip(&node_parents);
    Ok(LeveledObject {
        name: whole.name,
        closed: whole.closed,
        opacity: leaves.colors.opacity(),
        overlap: overlaps.mean,
        origin: DVec3::from_array(given.origin),
        radius: radius.fold(0.0, f64::max),
        node_balls: own.map(|(own, parent)| NodeBalls { own, parent: *parent.min(&above) }).collect(),
        leaf_parents: leaf_parents.into_iter().map(|parent| parent.min(above)).collect(),
        inverse_overlaps: Some(overlaps.inverse),
        weights: (0..count).map(|number| (below[number] / area_of(&nodes, number)) as f32).collect(),
        balls,
        leaves,
        nodes,
    })
}

/// Adds an object of splats with its levels of detail; its arrays are copied. For numbers of objects it is behind all objects of splats alone, and before those of triangles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_add_levels(
    scene: *mut SurfelScene,
    levels: *const SurfelLevels,
) -> SurfelResult {
    guard("surfel_scene_add_levels", || {
        // SAFETY: the contract of the header.
        let (scene, levels) = unsafe { (get_mut(scene, "scene")?, read(levels, "levels")?) };
        // SAFETY: the contract of the header.
        scene.0.leveled.push(unsafe { leveled(&levels) }?);
        Ok(())
    })
}
