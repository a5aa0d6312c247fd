//! Samples of a mesh's surface, evenly over its area.
//!
//! **Which triangle.** The areas of all triangles in a row are a line, cut into as many equal pieces as there are samples;
//! each sample is at a random place of its own piece (systematic sampling with jitter). So every place is as likely as
//! any other, and the number of samples in any run of triangles differs from its share of the area by less than 1 at each
//! end; independent samples would differ by the square root of the number.
//!
//! **Where in it.** How far the sample is into its triangle's part of the line is one random coordinate `t`, already
//! stratified; the other, `v`, is the golden ratio's multiples plus a random start, which avoids the values that came
//! before (a Kronecker sequence). Together they are about a lattice over a large triangle. `s = √t` maps both to it with
//! equal areas (Osada, Funkhouser, Chazelle, Dobkin, "Shape Distributions", 2002): `(1−s)A + s(1−v)B + svC`.
//!
//! Only additions, multiplications, divisions and square roots are used, which are the same on every machine. One thread
//! does it all: the search for neighbors takes most of the time.

pub(super) mod radii;
#[cfg(test)]
mod tests;

use glam::{DVec3, Vec3};

use super::{
    corners, creased_mesh,
    mesh_splats::one_color,
    neighbors::Tree,
    surface::{MeshReport, Surface},
};
use crate::{
    error::{Error, Result},
    math::random::{SplitMix, unit_from_bits},
    progress::Progress,
    scene::{Colors, Mesh, Shapes, Splats},
};

pub use radii::RADIUS_PER_DISTANCE;

/// The most samples: their numbers are kept in 32 bits.
pub const MOST_SAMPLES: u64 = u32::MAX as u64;

/// 2⁶⁴ over the golden ratio: a turn of the whole range, so that adding wraps without rounding.
const GOLDEN_STEP: u64 = 0x9E37_79B9_7F4A_7C15;

/// How many samples are made between two progress messages.
const PROGRESS_SAMPLES: usize = 1 << 16;

/// The length below which an interpolated normal is taken as rounding: normals of the corners that cancel.
pub(super) const SHORTEST_NORMAL: f64 = 1e-6;

/// Makes `count` disks at points spread evenly over a mesh's area, the same for the same `seed`.
///
/// Centers are on the surface; they are in the order of the triangles. Normals and colors are interpolated from the
/// vertices, where the mesh has colors; where it has no normals, each side of a crease has its own ([`creased_mesh`]). Radii are [`RADIUS_PER_DISTANCE`] times
/// the mean distance to the 6 nearest neighbors. Degenerate triangles get no sample.
///
/// # Errors
/// [`crate::error::ErrorKind::Option`] for a count of 0, above [`MOST_SAMPLES`], or of more than there is memory for;
/// [`crate::error::ErrorKind::Input`] for a mesh without area.
pub fn resample(mesh: &Mesh, count: u64, seed: u64, progress: &dyn Progress) -> Result<(Splats, MeshReport)> {
    let count = check_count(count, "--resample")?;
    check_memory(count, vertex_colors(mesh).is_some(), "--resample")?;
    let areas = Areas::of(mesh, &|_| 1.0)?;
    if mesh.normals.as_ref().is_some_and(|normals| normals.len() == mesh.positions.len()) {
        let Surface { normals, report, .. } = Surface::of(mesh, || {});
        return Ok((spread(mesh, &normals, &areas, (count, seed), progress), report));
    }
    let (mesh, report) = creased_mesh(mesh.clone());
    let normals: Vec<DVec3> = mesh.normals.iter().flatten().map(|normal| normal.as_dvec3()).collect();
    // Triangles without area are gone.
    let areas = Areas::of(&mesh, &|_| 1.0)?;
    Ok((spread(&mesh, &normals, &areas, (count, seed), progress), report))
}

/// Disks at samples of all triangles that have a part of `areas`. `normals` are the vertices'.
fn spread(
    mesh: &Mesh,
    normals: &[DVec3],
    areas: &Areas,
    (count, seed): (usize, u64),
    progress: &dyn Progress,
) -> Splats {
    let samples = sample(mesh, vertex_colors(mesh), normals, areas, count, seed, progress);
    let radii = radii::radii(&samples.positions, areas.total / count as f64, progress);
    samples.splats(mesh, radii)
}

/// A number of samples that `option` may ask for.
pub(super) fn check_count(count: u64, option: &str) -> Result<usize> {
    let possible = usize::try_from(count).ok().filter(|_| (1..=MOST_SAMPLES).contains(&count));
    possible.ok_or_else(|| Error::option(option, format!("{count} samples, expected 1 to {MOST_SAMPLES}")))
}

/// The mesh's colors, where there is one for each vertex.
pub(super) fn vertex_colors(mesh: &Mesh) -> Option<&[[f32; 4]]> {
    match &mesh.colors {
        Colors::Each(colors) if colors.len() == mesh.positions.len() => Some(colors),
        Colors::Each(_) | Colors::Uniform(_) => None,
    }
}

/// Asks for the memory of `count` samples, with a color each or not, and of the search for their neighbors.
pub(super) fn check_memory(count: usize, colors: bool, option: &str) -> Result<()> {
    let each = size_of::<(DVec3, Vec3, f32, u32)>() + if colors { size_of::<[f32; 4]>() } else { 0 };
    check_memory_for(count, each + Tree::BYTES_PER_POINT).map_err(|problem| Error::option(option, problem))
}

/// Asks for all the memory of `count` splats at once: systems refuse what they can't have, but not its parts one after
/// the other.
///
/// # Errors
/// A sentence, where there is less.
pub fn check_memory_for(count: usize, bytes_each: usize) -> Result<(), String> {
    let needed = count.checked_mul(bytes_each);
    if needed.is_some_and(|needed| Vec::<u8>::new().try_reserve_exact(needed).is_ok()) {
        return Ok(());
    }
    let needed = count as u128 * bytes_each as u128;
    Err(format!("no memory for {count} samples ({needed} bytes)"))
}

/// The areas of triangles in a row.
pub(super) struct Areas {
    /// Where each triangle's part ends; a degenerate one has none.
    ends: Vec<f64>,
    /// The area of all, above 0.
    pub(super) total: f64,
}

impl Areas {
    /// The areas of the mesh's triangles, each times its `weight`: how densely it is sampled, 0 where not at all.
    pub(super) fn of(mesh: &Mesh, weight: &dyn Fn(usize) -> f64) -> Result<Self> {
        let mut total = 0.0;
        let mut ends = Vec::with_capacity(mesh.triangles.len());
        for (i, &triangle) in mesh.triangles.iter().enumerate() {
            if let Some([a, b, c]) = corners(mesh, triangle) {
                total += weight(i) * (0.5 * (b - a).cross(c - a).length());
            }
            ends.push(total);
        }
        if total > 0.0 && total.is_finite() { Ok(Self { ends, total }) } else { Err(no_area(mesh)) }
    }
}

/// That there is nothing of the mesh to take samples of, and why.
pub(super) fn no_area(mesh: &Mesh) -> Error {
    let count = mesh.triangles.len();
    let plural = if count == 1 { "" } else { "s" };
    let wrong = mesh.positions.iter().position(|vertex| !vertex.is_finite());
    let because = match wrong {
        Some(vertex) => format!(" (vertex {vertex} is {:?})", mesh.positions[vertex].to_array()),
        None if count > 0 => " (none has an area within the range of 64-bit numbers)".to_owned(),
        None => String::new(),
    };
    Error::input("mesh", "", format!("no area to take samples of in {count} triangle{plural}{because}"))
}

/// Samples without radii.
pub(super) struct Samples {
    pub(super) positions: Vec<DVec3>,
    /// Unit.
    pub(super) normals: Vec<Vec3>,
    pub(super) colors: Option<Vec<[f32; 4]>>,
    /// In which triangle each is, rising.
    pub(super) triangles: Vec<u32>,
}

impl Samples {
    /// Disks at the samples of a mesh.
    pub(super) fn splats(self, mesh: &Mesh, radii: Vec<f32>) -> Splats {
        Splats::new(
            self.positions,
            Shapes::Disks { normals: self.normals, radii },
            self.colors.map_or_else(|| one_color(mesh), Colors::Each),
        )
    }
}

/// `count` samples of the triangles that have a part of `areas`, in their order. `normals` are the vertices'.
pub(super) fn sample(
    mesh: &Mesh,
    colors: Option<&[[f32; 4]]>,
    normals: &[DVec3],
    areas: &Areas,
    count: usize,
    seed: u64,
    progress: &dyn Progress,
) -> Samples {
    let mut samples = Samples {
        positions: Vec::with_capacity(count),
        normals: Vec::with_capacity(count),
        colors: colors.map(|_| Vec::with_capacity(count)),
        triangles: Vec::with_capacity(count),
    };
    let mut random = SplitMix(seed);
    let mut v = random.bits();
    let mut triangle = 0;
    for i in 0..count {
        // Rounding may reach the very end, where no triangle is.
        let at = ((i as f64 + random.unit()) / count as f64 * areas.total).min(areas.total.next_down());
        while areas.ends[triangle] <= at {
            triangle += 1;
        }
        let begin = if triangle == 0 { 0.0 } else { areas.ends[triangle - 1] };
        let s = ((at - begin) / (areas.ends[triangle] - begin)).sqrt();
        v = v.wrapping_add(GOLDEN_STEP);
        let t = s * unit_from_bits(v);
        let corner = mesh.triangles[triangle].map(|vertex| vertex as usize);
        let weights = [1.0 - s, s - t, t];
        samples.triangles.push(triangle as u32);
        samples.positions.push(blend(weights, corner.map(|vertex| mesh.positions[vertex])));
        let normal = blend(weights, corner.map(|vertex| normals[vertex]));
        samples.normals.push(unit_or_face(normal, mesh, corner, normals));
        if let (Some(of_vertices), Some(of_samples)) = (colors, &mut samples.colors) {
            of_samples.push(blend_colors(weights, corner.map(|vertex| of_vertices[vertex])));
        }
        if i % PROGRESS_SAMPLES == 0 {
            progress.step("sample the surface", i as u64, count as u64);
        }
    }
    progress.step("sample the surface", count as u64, count as u64);
    samples
}

fn blend(weights: [f64; 3], values: [DVec3; 3]) -> DVec3 {
    weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2]
}

/// Linear light, each channel for itself; alpha is straight and so is blended alike.
fn blend_colors(weights: [f64; 3], values: [[f32; 4]; 3]) -> [f32; 4] {
    std::array::from_fn(|channel| {
        let at = |corner: usize| weights[corner] * f64::from(values[corner][channel]);
        (at(0) + at(1) + at(2)).clamp(0.0, 1.0) as f32
    })
}

/// Where the corners' normals cancel, the triangle's own, on the side of most of them.
fn unit_or_face(normal: DVec3, mesh: &Mesh, corner: [usize; 3], normals: &[DVec3]) -> Vec3 {
    if normal.length() > SHORTEST_NORMAL {
        return normal.normalize().as_vec3();
    }
    let [a, b, c] = corner.map(|vertex| mesh.positions[vertex]);
    let face = (b - a).cross(c - a).normalize();
    let sides: f64 = corner.iter().map(|&vertex| normals[vertex].dot(face).signum()).sum();
    (if sides < 0.0 { -face } else { face }).as_vec3()
}
