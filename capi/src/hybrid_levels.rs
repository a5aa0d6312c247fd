//! Levels of detail of triangles: near they are triangles, farther away splats.

use std::ffi::c_void;

use surfel::{
    glam::Vec3,
    scene::{ErrorBall, HybridLevels, Opacity, PolygonCell, Scene},
};

use crate::{
    arrays::array,
    handle::get_mut,
    levels::{SurfelErrorBall, SurfelLevels, leveled},
    result::{Failure, Result, SurfelResult, guard},
    scene::SurfelScene,
    structs::{Struct, SurfelStructureType, read},
};

/// Triangles that are drawn, or not, together.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelPolygonCell {
    /// How many triangles of the mesh it has, behind those of the cell before it.
    pub triangle_count: u32,
    /// How many cells it meets at an edge or a corner. Where one of them is drawn as triangles, its own are drawn, too, below its splats.
    pub neighbor_count: u32,
    /// By which it is chosen, from the levels' `origin`, around its triangles and splats, within the balls of the nodes above these. Its spread is above 0, and no more than those nodes'.
    pub ball: SurfelErrorBall,
}

/// Levels of detail of a mesh in the scene, by arrays: for a size of the setting `lod` a cell of it is drawn as triangles where its spread is seen larger, elsewhere as its splats, or nodes that stand for them.
/// A splat is drawn where its parent's spread is seen larger, or it has none, and that of a cell that it is drawn for is not. Frames without `lod` draw the mesh.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelHybridLevels {
    /// `SURFEL_STRUCTURE_TYPE_HYBRID_LEVELS`.
    pub s_type: u32,
    /// `sizeof(SurfelHybridLevels)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// The number of the mesh among those that are in the scene. It is opaque, has no such levels yet, and lies cell by cell.
    pub mesh: u64,
    /// Its splats, opaque, and the nodes above.
    pub levels: *const SurfelLevels,
    /// For how many cells each splat is drawn, at least 1: for that in which it lies; of an edge between cells, for these.
    pub splat_cell_counts: *const u32,
    /// How many numbers `splatCells` has: the sum of those counts.
    pub splat_cell_count: u64,
    /// The numbers of these cells, those of each splat behind those of the splat before it.
    pub splat_cells: *const u32,
    /// How many cells there are.
    pub cell_count: u64,
    /// The cells. Together they have all triangles of the mesh, without those that can't be drawn, which are not in the scene.
    pub cells: *const SurfelPolygonCell,
    /// How many numbers `neighbors` has: the sum of `neighborCount` of the cells.
    pub neighbor_count: u64,
    /// The numbers of the cells that each meets, those of each cell behind those of the cell before it.
    pub neighbors: *const u32,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelHybridLevels {
    const TYPE: SurfelStructureType = SurfelStructureType::HybridLevels;
}

/// Splits numbers of cells by how many of them each thing has.
fn split<'a>(
    numbers: &'a [u32],
    counts: impl Iterator<Item = u32>,
    cells: usize,
    names: [&str; 2],
) -> Result<Vec<&'a [u32]>> {
    let [name, of] = names;
    if let Some(wrong) = numbers.iter().find(|number| **number as usize >= cells) {
        return Err(Failure::invalid(format!("{name}: {wrong}: there are {cells} cells")));
    }
    let (mut rest, mut all) = (numbers, Vec::new());
    let wrong = || Failure::invalid(format!("{name}: {} of them: expected the sum of {of}", numbers.len()));
    for count in counts {
        let (own, behind) = rest.split_at_checked(count as usize).ok_or_else(wrong)?;
        all.push(own);
        rest = behind;
    }
    if rest.is_empty() { Ok(all) } else { Err(wrong()) }
}

/// The number of the mesh, and how many triangles it has.
fn mesh_of(scene: &Scene, mesh: u64) -> Result<(usize, u64)> {
    let count = scene.meshes.len();
    let place = usize::try_from(mesh).ok().filter(|place| *place < count);
    let refused = |problem: &str| Err(Failure::invalid(format!("mesh {mesh}: {problem}")));
    let Some(place) = place else { return refused(&format!("the scene has {count}")) };
    if scene.hybrids.iter().any(|hybrid| hybrid.mesh == place) {
        return refused("it has levels of detail already");
    }
    match &scene.meshes[place].mesh {
        mesh if mesh.colors.opacity() != Opacity::Opaque => refused("expected an opaque one"),
        mesh => Ok((place, mesh.triangles.len() as u64)),
    }
}

/// # Safety
/// Pointers are NULL or lead to as much as the struct says.
unsafe fn hybrid(scene: &Scene, given: &SurfelHybridLevels) -> Result<HybridLevels> {
    let (mesh, triangles) = mesh_of(scene, given.mesh)?;
    // SAFETY: this function's contract, here and below.
    let mut splats = unsafe { leveled(&read(given.levels, "levels")?) }?;
    if splats.opacity != Opacity::Opaque {
        return Err(Failure::invalid("levels: expected opaque splats"));
    }
    let count = splats.leaves.len();
    // SAFETY: as above.
    let (given_cells, counts, splat_cells, neighbors) = unsafe {
        (
            array(given.cells, given.cell_count, "cells")?,
            array(given.splat_cell_counts, count as u64, "splatCellCounts")?,
            array(given.splat_cells, given.splat_cell_count, "splatCells")?,
            array(given.neighbors, given.neighbor_count, "neighbors")?,
        )
    };
    // Numbers of balls and the ends of lists are of 32 bits.
    if [given_cells.len() + splats.balls.len(), splat_cells.len()]
        .iter()
        .any(|count| *count > u32::MAX as usize)
    {
        return Err(Failure::invalid("cells: too many of them"));
    }
    let of_cells = given_cells.iter().map(|cell| u64::from(cell.triangle_count)).sum::<u64>();
    if of_cells != triangles {
        return Err(Failure::invalid(format!(
            "cells: they have {of_cells} triangles, mesh {mesh} {triangles}"
        )));
    }
    let cells_of =
        split(splat_cells, counts.iter().copied(), given_cells.len(), ["splatCells", "splatCellCounts"])?;
    let met = given_cells.iter().map(|cell| cell.neighbor_count);
    let neighbors = split(neighbors, met, given_cells.len(), ["neighbors", "neighborCount"])?;
    for (number, own) in cells_of.iter().enumerate() {
        let parent = splats.balls[splats.leaf_parents[number] as usize].spread;
        if own.is_empty() {
            return Err(Failure::invalid(format!("splat {number} is drawn for no cell")));
        }
        // Else where the cell is drawn as triangles, a node above its splats would be, too.
        if let Some(cell) = own.iter().find(|cell| given_cells[**cell as usize].ball.spread > parent) {
            let text = format!("cell {cell}: its spread is more than that of the node above splat {number}");
            return Err(Failure::invalid(text));
        }
    }
    let (mut cells, mut end) = (Vec::new(), 0);
    for (number, (cell, neighbors)) in given_cells.iter().zip(neighbors).enumerate() {
        let SurfelErrorBall { center, radius, spread } = cell.ball;
        let ball = ErrorBall { center: Vec3::from_array(center), radius, spread };
        let is_ball = ball.center.is_finite() && radius >= 0.0 && radius.is_finite();
        if !(is_ball && spread > 0.0 && spread.is_finite()) {
            return Err(Failure::invalid(format!("cell {number}: its ball is none")));
        }
        splats.radius = splats.radius.max(f64::from(ball.center.length() + radius));
        let begin = end;
        end += cell.triangle_count;
        let ball_number = splats.balls.len() as u32;
        cells.push(PolygonCell { triangles: begin..end, ball: ball_number, neighbors: neighbors.to_vec() });
        splats.balls.push(ball);
    }
    let ends = cells_of.iter().scan(0, |end, own| {
        *end += own.len() as u32;
        Some(*end)
    });
    Ok(HybridLevels { mesh, splats, leaf_cell_ends: ends.collect(), leaf_cells: splat_cells.to_vec(), cells })
}

/// Gives a mesh of the scene levels of detail; its arrays are copied.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surfel_scene_add_hybrid_levels(
    scene: *mut SurfelScene,
    levels: *const SurfelHybridLevels,
) -> SurfelResult {
    guard("surfel_scene_add_hybrid_levels", || {
        // SAFETY: the contract of the header.
        let (scene, levels) = unsafe { (get_mut(scene, "scene")?, read(levels, "levels")?) };
        // SAFETY: the contract of the header.
        let hybrid = unsafe { hybrid(&scene.0, &levels) }?;
        scene.0.hybrids.push(hybrid);
        Ok(())
    })
}
