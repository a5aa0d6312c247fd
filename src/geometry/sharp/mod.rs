//! Splats with sharp edges from a mesh: few ellipses, each for a triangle of a simplified mesh, clipped at ridges (Ivo, Ganovelli, Vidal, Scopigno,
//! "Adaptive clipping of splats to models with sharp features", 2012, sections 4 and 5).
//!
//! The mesh is repaired (`edges`), its ridges are found (`ridges`), edges collapse (`collapse`, by `quadric`, where `feasible`) while each piece of a ridge
//! gets a curve (`fit`, a `conic`), each triangle that is left becomes an ellipse (`ellipse`), and ridges cut it (`clips`).

mod around;
mod choice;
mod clips;
mod collapse;
mod colored;
mod conic;
mod edges;
mod ellipse;
mod feasible;
mod fit;
mod halves;
mod model;
mod orientation;
mod paint;
mod prices;
mod quadric;
mod ridges;
mod rim;
mod slivers;
mod standing;
#[cfg(test)]
mod tests;
mod tint;

use glam::{DVec3, DVec4};
use rayon::prelude::*;

pub use edges::Repairs;

use crate::{
    error::{Error, Result},
    progress::Progress,
    scene::{Clips, Colors, Mesh, Shapes, Splats},
};
use clips::{ClippedEllipse, clipped_ellipses};
use collapse::{Goal, Piece, State};
use colored::Colored;
use edges::{EdgeIndex, Sound};
use model::Model;
use paint::Paint;
use ridges::Ridges;
use tint::Tint;

/// What cuts splats at ridges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Clipping {
    /// One curve for each piece of a ridge, projected into the planes of the splats on both sides.
    #[default]
    Shared,
    /// For each splat a curve fitted in its own plane, as in the paper.
    Own,
    /// The chords of the shared curves (Zwicker et al. 2004; Pauly et al. 2003).
    Lines,
    /// Nothing: splats stick out.
    None,
}

/// How a mesh becomes splats.
#[derive(Clone, Copy, Debug)]
pub struct SharpOptions {
    /// So many splats at the most, where the mesh can be simplified so far; `None`: one for each triangle, or as few as `max_error` allows.
    pub splats: Option<u64>,
    /// The largest error of a collapse, world units: root mean square distance to the planes that meet at the vertex, and largest distance of
    /// a curve from its ridge. Nor does an ellipse come to stand off the triangles beside its own by more, if those before did not. A color that is off by d (linear, root mean square)
    /// over the area A that a splat stands for counts as d √A, and a d below a thousandth as none. `None`: any.
    pub max_error: Option<f64>,
    /// The least angle between the normals of two triangles at a ridge; radians.
    pub crease_rad: f64,
    /// What cuts splats at ridges.
    pub clipping: Clipping,
}

impl Default for SharpOptions {
    fn default() -> Self {
        let crease_rad = 30.0_f64.to_radians();
        Self { splats: None, max_error: None, crease_rad, clipping: Clipping::Shared }
    }
}

/// What was done.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SharpReport {
    /// What was repaired.
    pub repairs: Repairs,
    /// Ridges, from corner to corner.
    pub ridges: usize,
    /// Their pieces, each with a curve.
    pub pieces: usize,
    /// Splats with a clip.
    pub clipped: usize,
    /// Triangles that became several splats, because one can't be cut at all ridges that cross it.
    pub cut_triangles: usize,
    /// Splats that more ridges cross than could be cut even so.
    pub crowded: usize,
    /// The largest error of a collapse; see [`SharpOptions::max_error`].
    pub error: f64,
    /// The largest distance of what is left of an ellipse from the simplified mesh, over edges that are no ridge.
    pub stands_off: f64,
    /// The most that the color of a splat is off the surface's: the root of the integral of the squared difference over what it stands for, a length.
    pub colors_off: f64,
    /// Triangles pass every edge as often in one direction as in the other: a closed surface, seen from outside.
    pub closed: bool,
}

/// Makes clipped splats of a mesh: one for each triangle that is left. The same mesh gives the same bytes, however many threads there are.
///
/// # Errors
/// [`crate::error::ErrorKind::Input`] for a mesh without area; [`crate::error::ErrorKind::Option`] for a count of 0 and for an error that is
/// not a length.
pub fn sharp_splats(
    mesh: &Mesh,
    options: &SharpOptions,
    progress: &dyn Progress,
) -> Result<(Splats, SharpReport)> {
    if options.splats == Some(0) {
        return Err(Error::option("--splats", "0; expected 1 or more"));
    }
    if let Some(error) = options.max_error.filter(|error| !(*error > 0.0 && error.is_finite())) {
        return Err(Error::option("--max-error", format!("{error}; expected a length above 0")));
    }
    if let (Some(_), Some(most)) = (options.splats, options.max_error) {
        // A bound that is kept without it changes nothing.
        let made = sharp_splats(mesh, &SharpOptions { max_error: None, ..*options }, progress)?;
        let SharpReport { error, stands_off, colors_off, .. } = made.1;
        if error.max(stands_off).max(colors_off) <= most {
            return Ok(made);
        }
    }
    const TASK: &str = "find ridges";
    progress.step(TASK, 0, 1);
    let goal = Goal {
        triangles: match (options.splats, options.max_error) {
            (Some(splats), _) => usize::try_from(splats).unwrap_or(usize::MAX),
            (None, Some(_)) => 0,
            (None, None) => usize::MAX,
        },
        most_error: options.max_error.unwrap_or(f64::INFINITY),
    };
    let (Sound { mesh, edges, repairs, closed, .. }, paint) = prepared(mesh, options)?;
    let normals = normals_of(&mesh);
    let ridges = Ridges::of(&mesh, &edges, &normals, options.crease_rad);
    progress.step(TASK, 1, 1);
    drop(edges);
    // Small numbers lose less: quadrics are of products.
    let origin = mesh.bounds().map_or(DVec3::ZERO, |bounds| bounds.center());
    let positions: Vec<DVec3> = mesh.positions.iter().map(|p| *p - origin).collect();
    let colored = paint.map(|paint| Colored::new(&positions, &mesh.triangles, &paint));
    let mut state = State::new(&positions, mesh.triangles, &normals, &ridges, colored);
    drop(normals);
    let mut report = SharpReport { repairs, ridges: ridges.chains.len(), closed, ..SharpReport::default() };
    let mut aim = goal.triangles;
    loop {
        state.collapse(Goal { triangles: aim, ..goal }, progress);
        let pieces = state.pieces();
        let model = model(&state, &pieces);
        let made = ellipses(&model, options.clipping, progress);
        let stands_off = made.iter().flatten().map(|one| one.stands_off).fold(0.0, f64::max);
        report = SharpReport { pieces: pieces.len(), error: state.error(), stands_off, ..report };
        let count: usize = made.iter().map(Vec::len).sum();
        // Triangles that became several splats: so many fewer triangles, if there can be fewer.
        let over = count.saturating_sub(goal.triangles);
        if over == 0 || state.triangles.len() > aim || aim <= over {
            if let Some(colored) = &mut state.colored {
                colored.fill(positions.len(), &state.triangles);
            }
            return Ok(splats(&state, made, &mesh.colors, origin, report));
        }
        aim -= over;
    }
}

/// The mesh repaired, and its colors; split where these need more splats than there are triangles.
fn prepared(file: &Mesh, options: &SharpOptions) -> Result<(Sound, Option<Paint>)> {
    let mut sound = Sound::of(file)?;
    let mut paint = Paint::of(file, &sound.mesh, &sound.first);
    sound.first = Vec::new();
    if let Some(paint) = &mut paint {
        let (count, most) = match (options.splats, options.max_error) {
            (Some(count), most) => (usize::try_from(count).unwrap_or(usize::MAX), most.unwrap_or(0.0)),
            (None, Some(most)) => (usize::MAX, most),
            (None, None) => (0, 0.0),
        };
        if paint.split(&mut sound.mesh, count, most) {
            sound.edges = edges::edges(&sound.mesh.triangles).all;
        }
    }
    Ok((sound, paint))
}

fn model<'a>(state: &'a State<'_>, pieces: &'a [Piece]) -> Model<'a> {
    let between = pieces.iter().enumerate().map(|(i, piece)| {
        let [a, b] = piece.ends;
        ((a.min(b), a.max(b)), i)
    });
    let (positions, triangles) = (state.positions, state.triangles.as_slice());
    Model {
        positions,
        triangles,
        normals: triangles.par_iter().map(|t| normal(positions, *t)).collect(),
        tints: state.colored.as_ref().map(|colored| colored.tints.as_slice()),
        edges: EdgeIndex::of(&edges::edges(triangles)),
        between: between.collect(),
        pieces,
        chains: &state.ridges.chains,
    }
}

/// Those of each triangle.
fn ellipses(model: &Model<'_>, clipping: Clipping, progress: &dyn Progress) -> Vec<Vec<ClippedEllipse>> {
    const TASK: &str = "clip ellipses at ridges";
    let total = model.triangles.len() as u64;
    progress.step(TASK, 0, total);
    let made = (0..model.triangles.len()).into_par_iter().map(|i| clipped_ellipses(model, i, clipping));
    let made = made.collect();
    progress.step(TASK, total, total);
    made
}

fn splats(
    state: &State<'_>,
    made: Vec<Vec<ClippedEllipse>>,
    colors: &Colors,
    origin: DVec3,
    mut report: SharpReport,
) -> (Splats, SharpReport) {
    let (mut s, mut t, mut positions, mut clips, mut each) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for (triangle, made) in made.into_iter().enumerate() {
        report.cut_triangles += usize::from(made.len() > 1);
        if let Some(colored) = &state.colored {
            let away = |i: usize, place| made[i].flat(place).length_squared();
            let tints = colored.of_splats(triangle, made.len(), away);
            let off = tints.iter().map(Tint::off).fold(0.0, f64::max).sqrt();
            report.colors_off = report.colors_off.max(off);
            let mean = |tint: &Tint| tint.mean().or(colored.tints[triangle].mean()).unwrap_or(DVec4::NAN);
            each.extend(tints.iter().map(|tint| mean(tint).as_vec4().to_array()));
        }
        for one in made {
            positions.push(one.center + origin);
            s.push(one.s.as_vec3());
            t.push(one.t.as_vec3());
            clips.push(one.clip);
            report.crowded += usize::from(one.crowded);
        }
    }
    let colors = match colors {
        Colors::Uniform(color) => Colors::Uniform(*color),
        Colors::Each(_) => Colors::Each(each),
    };
    let clips = Clips::of(clips);
    report.clipped = clips.count();
    (Splats { clips, ..Splats::new(positions, Shapes::Ellipses { s, t }, colors) }, report)
}

fn normal(positions: &[DVec3], triangle: [u32; 3]) -> DVec3 {
    let [a, b, c] = triangle.map(|vertex| positions[vertex as usize]);
    (b - a).cross(c - a).normalize_or_zero()
}

/// Unit normals of the triangles.
fn normals_of(mesh: &Mesh) -> Vec<DVec3> {
    mesh.triangles.par_iter().map(|triangle| normal(&mesh.positions, *triangle)).collect()
}
