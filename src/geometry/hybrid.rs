//! One mesh drawn in part as splats, in part as polygons, sampled so that the seam can be smoothed (Guennebaud, Barthe,
//! Paulin, "Splat/Mesh Blending, Perspective Rasterization and Transparency for Point-Based Rendering", 2006, section 5).
//!
//! The renderer fades from splats to polygons by the sum of the splats' weights, which falls from 1 to 0 beyond the edge of
//! the splat part. For that the sum must have reached 1 **on** the edge: splats are centered on the *transition edges*,
//! which a polygon and a splat triangle share, evenly and near enough (`spacing`). What the splat part has too close to
//! them anyway is removed.
//!
//! A splat on an edge is flat and lies half over polygons. Where those bend away below it, it and its neighbors are smaller, so
//! that none sticks out of the polygons' outline (`sizes`). Small splats have the normals of the smooth surface, too, and where
//! they face away at a silhouette what they lie on is still seen: so its triangles are drawn below them.

mod border;
mod cells;
mod chains;
mod multiresolution;
mod near;
mod pieces;
mod sizes;
mod spacing;
#[cfg(test)]
mod tests;

use glam::DVec3;

pub use multiresolution::{Multiresolution, multiresolution};
pub use spacing::EDGE_SPACING;

use super::{
    corners,
    mesh_splats::one_color,
    resample::{
        Areas, MOST_SAMPLES, check_count, check_memory, no_area, radii::radii, sample, vertex_colors,
    },
    shaded_mesh::shaded_mesh,
    surface::MeshReport,
};
use crate::{
    error::{Error, Result},
    progress::Progress,
    scene::{Colors, Mesh, Shapes, Splats},
};
use border::Border;
use chains::{Chains, Place};
use pieces::Pieces;
use sizes::{MARKS_PER_RADIUS, Sizes};

/// How the splat part is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HybridOptions {
    /// The number of splats of the splat part, spread evenly over its area as [`super::resample`] does; those on edges, and
    /// more near edges at which the surface bends, come on top, those removed are missing. 1 to [`MOST_SAMPLES`].
    pub samples: u64,
    /// The seed: the same one gives the same samples.
    pub seed: u64,
    /// Splats on the transition edges, and none too close to them. Without, the seam is the paper's figure 5d.
    pub sample_edges: bool,
}

/// A mesh in two parts.
#[derive(Clone, Debug)]
pub struct Hybrid {
    /// The splats of the splat part in the order of its triangles, then those on transition edges.
    pub splats: Splats,
    /// The other part and the triangles below splats that are smaller than most, as [`shaded_mesh`] makes them; its normals, and the
    /// splats', are those of the whole mesh, so that both parts are shaded alike where they meet. Only vertices that it uses.
    pub polygons: Mesh,
    /// The whole mesh is closed, which neither part need be.
    pub closed: bool,
    /// The report.
    pub report: HybridReport,
}

/// The facts on how a [`Hybrid`] was made.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HybridReport {
    /// The facts found in the whole mesh.
    pub mesh: MeshReport,
    /// Triangles that are drawn as such: those that stay polygons, and those below small splats.
    pub polygons: usize,
    /// Edges that both parts have.
    pub transition_edges: usize,
    /// The length of all of them, in world units.
    pub transition_length: f64,
    /// The radius of the splats on them where no polygon bends away below, which is the median of those that are spread evenly; 0
    /// where there is no splat part.
    pub edge_radius: f64,
    /// Splats on them.
    pub edge_splats: usize,
    /// Samples of the splat part left out because they were too close to them.
    pub removed: usize,
}

/// Makes splats of a mesh's triangles but for those which `stays_polygon`, by their number in `mesh.triangles`; it is
/// asked once for each that can be drawn.
///
/// Splats are as those of [`super::resample`]: radii are 1.5 times the mean distance to the 6 nearest neighbors. Where
/// the splat part ends at a transition edge the neighbors missing beyond it are made up for (`near`), so that radii are
/// there as inside. One part may have everything; the other is empty then.
///
/// # Errors
/// [`crate::error::ErrorKind::Option`] for a number of samples out of range or of more than there is memory for;
/// [`crate::error::ErrorKind::Input`] for a mesh, or a splat part, without area.
pub fn hybrid(
    mesh: &Mesh,
    stays_polygon: &dyn Fn(usize) -> bool,
    options: &HybridOptions,
    progress: &dyn Progress,
) -> Result<Hybrid> {
    let count = check_count(options.samples, SAMPLES)?;
    let drawn = (0..mesh.triangles.len()).filter(|&i| corners(mesh, mesh.triangles[i]).is_some());
    let mut polygon: Vec<bool> = drawn.map(stays_polygon).collect();
    if polygon.is_empty() {
        return Err(no_area(mesh));
    }
    // Leaves out the same triangles.
    let (whole, mesh_report) = shaded_mesh(mesh.clone());
    let mut report = HybridReport { mesh: mesh_report, ..HybridReport::default() };
    let splats = match polygon.iter().all(|polygon| *polygon) {
        true => empty(&whole),
        false => splat_part(&whole, &mut polygon, count, options, &mut report, progress)?,
    };
    let polygons = polygon_part(whole, &polygon);
    report.polygons = polygons.triangles.len();
    Ok(Hybrid { splats, polygons, closed: mesh_report.closed, report })
}

/// As messages name it.
const SAMPLES: &str = "samples of the splat part";

fn splat_part(
    whole: &Mesh,
    polygon: &mut [bool],
    count: usize,
    options: &HybridOptions,
    report: &mut HybridReport,
    progress: &dyn Progress,
) -> Result<Splats> {
    let colors = vertex_colors(whole);
    check_memory(count, colors.is_some(), SAMPLES)?;
    let areas = Areas::of(whole, &|triangle| f64::from(u8::from(!polygon[triangle])))?;
    let area_per_sample = areas.total / count as f64;
    let normals: Vec<DVec3> = whole.normals.iter().flatten().map(|normal| normal.as_dvec3()).collect();
    let samples = sample(whole, colors, &normals, &areas, count, options.seed, progress);
    let radii_inside = radii(&samples.positions, area_per_sample, progress);
    let parts: Vec<u32> = polygon.iter().map(|polygon| u32::from(*polygon)).collect();
    let border = Border::of(whole, &parts);
    let chains = Chains::of(&border);
    let inside = f64::from(median(&radii_inside));
    report.transition_edges = border.edges.len();
    report.transition_length = chains.length();
    report.edge_radius = inside;
    let mut splats = samples.splats(whole, radii_inside);
    if border.edges.is_empty() {
        return Ok(splats);
    }
    check_places(&chains, inside, count, colors.is_some())?;
    if !options.sample_edges {
        near::correct_radii(&mut splats, &[], &Sizes::even(&chains, inside), area_per_sample, progress);
        return Ok(splats);
    }
    let sizes = Sizes::of(whole, polygon, &chains, inside);
    let places = if sizes.are_even() {
        chains.places(EDGE_SPACING * inside)
    } else {
        let pieces = sizes.pieces(whole, polygon);
        splats = graded(whole, &pieces, &sizes, area_per_sample, options.seed, progress)?;
        for (piece, triangle) in pieces.triangles.iter().enumerate() {
            polygon[*triangle] |= sizes.at(pieces.middle(piece)) < inside;
        }
        chains.places_by(EDGE_SPACING, &|place| sizes.at(place), inside / MARKS_PER_RADIUS)
    };
    report.removed = near::remove(&mut splats, &sizes);
    report.edge_splats = places.len();
    near::correct_radii(&mut splats, &places, &sizes, area_per_sample, progress);
    add(&mut splats, &places, &|place| sizes.at(place));
    Ok(splats)
}

/// Samples that are the denser the smaller they are to be.
fn graded(
    whole: &Mesh,
    pieces: &Pieces,
    sizes: &Sizes,
    area_per_sample: f64,
    seed: u64,
    progress: &dyn Progress,
) -> Result<Splats> {
    let share = |piece: usize| (sizes.inside() / sizes.at(pieces.middle(piece))).powi(2);
    let areas = Areas::of(&pieces.mesh, &share)?;
    let count = (areas.total / area_per_sample).round();
    let colors = vertex_colors(&pieces.mesh);
    let count = check_count(count as u64, SAMPLES)?;
    check_memory(count, colors.is_some(), SAMPLES)?;
    let samples = sample(&pieces.mesh, colors, &pieces.normals, &areas, count, seed, progress);
    let radii = radii(&samples.positions, area_per_sample, progress);
    Ok(samples.splats(whole, radii))
}

/// Refuses more places on the edges than there can be.
fn check_places(chains: &Chains, radius: f64, samples: usize, colors: bool) -> Result<()> {
    let marks = chains.count(radius / MARKS_PER_RADIUS);
    // Those near the edges are there twice.
    let all = marks + 2.0 * samples as f64;
    if all > MOST_SAMPLES as f64 {
        let length = chains.length();
        let problem = format!(
            "{samples}, and {marks:.0} places on transition edges of length {length}: expected at most {MOST_SAMPLES}"
        );
        return Err(Error::option(SAMPLES, problem));
    }
    check_memory(all as usize, colors, SAMPLES)
}

fn median(radii: &[f32]) -> f32 {
    let mut sorted = radii.to_vec();
    let middle = sorted.len() / 2;
    *sorted.select_nth_unstable_by(middle, f32::total_cmp).1
}

fn empty(mesh: &Mesh) -> Splats {
    let shapes = Shapes::Disks { normals: Vec::new(), radii: Vec::new() };
    Splats::new(Vec::new(), shapes, one_color(mesh))
}

/// Splats at places on edges, of these radii.
fn add(splats: &mut Splats, places: &[Place], radius: &dyn Fn(DVec3) -> f64) {
    splats.positions.extend(places.iter().map(|place| place.position));
    if let Shapes::Disks { normals, radii } = &mut splats.shapes {
        normals.extend(places.iter().map(|place| place.normal.as_vec3()));
        radii.extend(places.iter().map(|place| radius(place.position) as f32));
    }
    if let Colors::Each(colors) = &mut splats.colors {
        colors.extend(places.iter().map(|place| place.color.map(|channel| channel as f32)));
    }
}

/// The triangles that stay, with the vertices that they have.
fn polygon_part(mut mesh: Mesh, polygon: &[bool]) -> Mesh {
    let mut polygon = polygon.iter();
    mesh.triangles.retain(|_| *polygon.next().unwrap_or(&true));
    mesh.drop_unused_vertices();
    mesh
}
