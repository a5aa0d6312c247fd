//! A hierarchy of more splats than memory holds.
//!
//! 1. All rows are looked through: bounds, defects, and a sample of about [`SAMPLE_SHARE`] of the memory, on which space is cut into parts
//!    (`partition`).
//! 2. Rows are sorted by part into a file beside the one that is written (`parts`): as they are in the input, so that this takes no more
//!    room than that. What each part adds to the nodes above it is summed up on the way.
//! 3. Part by part is read, built and written, and the nodes above it grow (`geometry/hierarchy/top.rs`). At last these are written.
//!
//! Samples are taken by the number of their row, parts are built in the order of the tree: the same input and memory give the same bytes.

mod partition;
mod parts;

use std::path::Path;

use glam::DVec3;
use rayon::prelude::*;

use super::{
    header::{Header, LARGEST},
    page::Form,
    part::{write_part, write_top},
    write::Writer,
    write_object::{Facts, Written, header},
};
use crate::{
    error::{Error, Result},
    geometry::{
        Overlaps,
        hierarchy::{Hierarchy, Top},
        up_of_shape,
    },
    load::{SplatRows, file_name},
    math::random::SplitMix,
    notes::counted,
    progress::Progress,
    save,
    scene::{Bounds, Colors, DefectCounts, Object, Scene, Shapes, Splats},
};
use partition::Partition;
use parts::{Sorter, Tree};

/// Bytes of memory that a splat of a part takes while the part is built, with its share of nodes: as many as half of the splats.
const BYTES_EACH: u64 = 330;

/// The part of the memory that is left to all else.
const REST_SHARE: u64 = 4;

/// The part of the memory that a sample takes, and that rows take which are not written yet.
const SAMPLE_SHARE: u64 = 8;

/// Bytes of a sample, and of what tells its shape.
const SAMPLE_BYTES: u64 = 160;

/// The least memory: what is read and written at once takes some.
pub const LEAST_MEMORY: u64 = 16 << 20;

/// Rows that are read at once.
const BATCH_ROWS: usize = 1 << 15;

/// Rows that one thread looks at.
const ROWS_AT_ONCE: usize = 1 << 12;

/// Whether so many splats fit into so many bytes of memory as one part.
pub fn fits(splats: u64, memory: u64) -> bool {
    splats <= most_splats(memory)
}

/// The most splats of a part.
fn most_splats(memory: u64) -> u64 {
    (memory - memory / REST_SHARE) / BYTES_EACH
}

/// Writes the splats of a file with their levels of detail within so many bytes of memory, at least [`LEAST_MEMORY`], and as much room beside
/// `path` as the file has bytes, which is free again at the end. Splats with a [`crate::scene::Defect`] are left out and counted, or with `strict` refused. The same
/// file and memory give the same bytes.
///
/// # Errors
/// [`crate::ErrorKind::File`] if something can't be read or written; [`crate::ErrorKind::Input`] where there is no splat that can be drawn, or one
/// beyond 1e37. Nothing is left behind then.
pub fn convert_splats(
    mut rows: SplatRows,
    path: &Path,
    memory: u64,
    strict: bool,
    progress: &dyn Progress,
) -> Result<(Written, DefectCounts)> {
    let memory = memory.max(LEAST_MEMORY);
    let survey = Survey::of(&mut rows, memory / SAMPLE_SHARE / SAMPLE_BYTES, progress)?;
    let Some(bounds) = survey.bounds.filter(|_| survey.seen) else {
        return Err(Error::input(rows.path(), "", "no splat can be drawn"));
    };
    if strict && survey.defects.total() > 0 {
        let problem = format!(
            "{} left out: {}; expected none with --strict",
            counted(survey.defects.total() as u64, "splats"),
            survey.defects
        );
        return Err(Error::input(rows.path(), "", problem));
    }
    let most = most_splats(memory);
    let facts = Facts { closed: rows.closed(), up: rows.up().or_else(|| survey.up(rows.closed())) };
    let form = survey.form();
    let splats = (rows.count() - survey.defects.total() as u64).max(1);
    // So that what a part has more than the sample says does not make it too large.
    let samples_of_part = survey.sample.len() as u64 * most / splats * 3 / 4;
    let defects = survey.defects;
    let partition =
        Partition::new(survey.sample.positions, usize::try_from(samples_of_part).unwrap_or(usize::MAX));
    let (tree, mut sorted, radius) =
        sort(&mut rows, path, &partition, (memory, most), bounds.center(), progress)?;
    let mut top = Top::new(&tree.nodes, &tree.sums(), form.origin);
    let header = save::create(path, |file| {
        let fail = |e| Error::file(path, "write", e);
        let mut writer = Writer::new(file, form).map_err(fail)?;
        let mut roots = Vec::new();
        // That of the first part; others weigh by it.
        let mut overlap = None;
        let task = format!("build {}", file_name(path));
        for (number, runs) in tree.parts.iter().enumerate() {
            progress.step(&task, number as u64, tree.parts.len() as u64);
            let splats = sorted.splats(&rows, runs)?;
            let hierarchy = Hierarchy::build_part(&splats, form.origin, &())?;
            top.add(number, &splats, &hierarchy);
            let overlaps = Overlaps::of(&splats);
            let overlap = *overlap.get_or_insert(overlaps.mean);
            let root = write_part(&mut writer, (&splats, rows.count()), &hierarchy, (&overlaps, overlap));
            let root = root.map_err(fail)?;
            roots.push((root, top.parent_of(number)));
        }
        progress.step(&task, tree.parts.len() as u64, tree.parts.len() as u64);
        let nodes = top.finish();
        write_top(&mut writer, &nodes, &roots, form.color).map_err(fail)?;
        let root_radius = nodes.first().map(|root| root.error.radius.into());
        let header = Header {
            radius,
            root_radius: root_radius.or_else(|| roots.first().map(|(root, _)| root.radius())).unwrap_or(0.0),
            overlap: overlap.unwrap_or(1.0),
            ..header(&form, &facts, &bounds)
        };
        writer.finish(header).map_err(fail)
    })?;
    Ok((Written { header, parts: tree.parts.len() }, defects))
}

/// What all rows together are.
struct Survey {
    bounds: Option<Bounds>,
    defects: DefectCounts,
    /// Some alpha is below 1.
    transparent: bool,
    /// Some alpha is above 0.
    seen: bool,
    sample: Splats,
}

/// What some rows are.
type Surveyed = Result<(Option<Bounds>, DefectCounts, [bool; 2], Splats)>;

impl Survey {
    fn of(rows: &mut SplatRows, samples: u64, progress: &dyn Progress) -> Result<Self> {
        let share = (samples as f64 / rows.count().max(1) as f64).min(1.0);
        let mut survey = Self {
            bounds: None,
            defects: DefectCounts::default(),
            transparent: false,
            seen: false,
            sample: rows.splats(&[]),
        };
        for_batches(rows, "look through", progress, |rows, first, bytes| {
            let at_once = ROWS_AT_ONCE * rows.stride();
            let parts = bytes.par_chunks(at_once).enumerate();
            let surveyed: Vec<Surveyed> = parts
                .map(|(i, bytes)| surveyed(rows, first + (i * ROWS_AT_ONCE) as u64, bytes, share))
                .collect();
            for surveyed in surveyed {
                let (bounds, defects, [transparent, seen], sample) = surveyed?;
                survey.bounds = survey.bounds.into_iter().chain(bounds).reduce(Bounds::union);
                survey.defects.merge(&defects);
                survey.transparent |= transparent;
                survey.seen |= seen;
                survey.sample.append(sample);
            }
            Ok(())
        })?;
        Ok(survey)
    }

    fn form(&self) -> Form {
        let sample = &self.sample;
        let start = sample.positions.first().copied().unwrap_or_default();
        let mean = sample.positions.iter().map(|position| *position - start).sum::<DVec3>()
            / sample.len().max(1) as f64;
        Form {
            ellipses: matches!(sample.shapes, Shapes::Ellipses { .. }),
            color: match sample.colors {
                Colors::Uniform(color) => Some(color),
                Colors::Each(_) => None,
            },
            alpha: self.transparent,
            origin: start + mean,
        }
    }

    /// As the shape of the sample tells it.
    fn up(&self, closed: bool) -> Option<DVec3> {
        let object = Object { name: String::new(), splats: self.sample.clone(), closed };
        let scene = Scene { objects: vec![object], ..Scene::default() };
        up_of_shape(&scene).map(|found| found.direction)
    }
}

fn surveyed(rows: &SplatRows, first: u64, bytes: &[u8], share: f64) -> Surveyed {
    let splats = rows.splats(bytes);
    let mut defects = DefectCounts::default();
    let (mut transparent, mut seen) = (false, false);
    let mut sampled = Vec::new();
    for i in 0..splats.len() {
        let defect = splats.defect(i);
        defects.add(defect);
        if defect.is_some() {
            continue;
        }
        let number = first + i as u64;
        if splats.positions[i].abs().max_element().max(splats.major_radius(i)) > LARGEST {
            return Err(Error::input(rows.path(), format!("vertex {number}"), "beyond 1e37"));
        }
        let alpha = splats.color(i)[3];
        transparent |= alpha < 1.0;
        seen |= alpha > 0.0;
        // Random by its number: where rows repeat in some rhythm, the sample does not.
        if crate::math::random::unit_from_bits(SplitMix(number).bits()) < share {
            sampled.push(i);
        }
    }
    Ok((splats.bounds(), defects, [transparent, seen], splats.picked(sampled.into_iter())))
}

/// Sorts all rows by part. Gives also how far splats reach from `center`.
fn sort(
    rows: &mut SplatRows,
    path: &Path,
    partition: &Partition,
    (memory, most): (u64, u64),
    center: DVec3,
    progress: &dyn Progress,
) -> Result<(Tree, parts::Sorted, f64)> {
    let mut sorter = Sorter::new(path, rows.stride(), partition.parts(), memory / SAMPLE_SHARE)?;
    let mut radius = 0.0_f64;
    for_batches(rows, "sort", progress, |rows, _, bytes| {
        let stride = rows.stride();
        let of_rows = |bytes: &[u8]| {
            let splats = rows.splats(bytes);
            let mut radius = 0.0_f64;
            let mut part_of = |i: usize| {
                splats.defect(i).is_none().then(|| {
                    let position = splats.positions[i];
                    radius = radius.max(position.distance(center) + splats.major_radius(i));
                    partition.part_of(position)
                })
            };
            let parts: Vec<Option<usize>> = (0..splats.len()).map(&mut part_of).collect();
            (parts, radius)
        };
        let sorted: Vec<_> = bytes.par_chunks(ROWS_AT_ONCE * stride).map(of_rows).collect();
        radius = sorted.iter().map(|(_, radius)| *radius).fold(radius, f64::max);
        let parts = sorted.iter().flat_map(|(parts, _)| parts.iter());
        sorter
            .add(rows, parts.zip(bytes.chunks_exact(stride)).filter_map(|(part, row)| Some(((*part)?, row))))
    })?;
    let mut sorted = sorter.finish(rows)?;
    let tree = sorted.tree(partition, usize::try_from(most).unwrap_or(usize::MAX));
    Ok((tree, sorted, radius))
}

/// Reads all rows, some after the other: with the number of the first of them.
fn for_batches(
    rows: &mut SplatRows,
    what: &str,
    progress: &dyn Progress,
    mut take: impl FnMut(&SplatRows, u64, &[u8]) -> Result<()>,
) -> Result<()> {
    let task = format!("{what} {}", file_name(rows.path()));
    let (count, mut bytes) = (rows.count(), Vec::new());
    for first in (0..count).step_by(BATCH_ROWS) {
        progress.step(&task, first, count);
        rows.read(first, BATCH_ROWS, &mut bytes)?;
        take(rows, first, &bytes)?;
    }
    progress.step(&task, count, count);
    Ok(())
}
