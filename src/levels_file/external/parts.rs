//! The rows of each part, in a file beside the one that is written: as they are in the input, so that they take no more room than that.

use std::{
    io::{Read as _, Seek as _, SeekFrom, Write as _},
    path::{Path, PathBuf},
};

use rayon::prelude::*;

use super::partition::{Cell, Partition};
use crate::{
    error::{Error, Result},
    geometry::hierarchy::{Child, PartSums},
    load::SplatRows,
    save::Scratch,
    scene::Splats,
};

/// The most rows of a run, and the fewest.
const RUN_ROWS: [usize; 2] = [64, 8192];

/// The most children of a node above runs of one part.
const CHILDREN: usize = 8;

/// Rows of a part that were written together.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    /// The first byte.
    at: u64,
    pub rows: usize,
    pub sums: PartSums,
}

/// The rows of all parts, while they are sorted.
pub(super) struct Sorter {
    path: PathBuf,
    scratch: Scratch,
    /// Bytes written.
    end: u64,
    run_bytes: usize,
    /// Of each part what is not written yet.
    open: Vec<Vec<u8>>,
    /// Of each part what is.
    runs: Vec<Vec<Run>>,
}

/// The rows of all parts, sorted.
pub(super) struct Sorted {
    path: PathBuf,
    scratch: Scratch,
    runs: Vec<Vec<Run>>,
}

impl Sorter {
    /// For so many parts, with so many bytes of memory for what is not written yet.
    pub fn new(path: &Path, stride: usize, parts: usize, memory: u64) -> Result<Self> {
        let most = usize::try_from(memory / parts.max(1) as u64).unwrap_or(usize::MAX) / stride;
        Ok(Self {
            path: path.to_owned(),
            scratch: Scratch::beside(path)?,
            end: 0,
            run_bytes: most.clamp(RUN_ROWS[0], RUN_ROWS[1]) * stride,
            open: vec![Vec::new(); parts],
            runs: vec![Vec::new(); parts],
        })
    }

    /// Adds rows of a file, each with its part.
    pub fn add<'r>(&mut self, file: &SplatRows, rows: impl Iterator<Item = (usize, &'r [u8])>) -> Result<()> {
        let mut full = Vec::new();
        for (part, row) in rows {
            let open = &mut self.open[part];
            if open.is_empty() {
                open.reserve_exact(self.run_bytes);
            }
            open.extend(row);
            if open.len() >= self.run_bytes {
                full.push((part, std::mem::take(open)));
            }
        }
        self.write(file, &full)
    }

    /// Writes what is left.
    pub fn finish(mut self, file: &SplatRows) -> Result<Sorted> {
        let open = std::mem::take(&mut self.open);
        // One at a time: there may be many.
        for (part, bytes) in open.into_iter().enumerate() {
            self.write(file, &[(part, bytes)])?;
        }
        Ok(Sorted { path: self.path, scratch: self.scratch, runs: self.runs })
    }

    fn write(&mut self, file: &SplatRows, full: &[(usize, Vec<u8>)]) -> Result<()> {
        let sums: Vec<_> = full.par_iter().map(|(_, bytes)| PartSums::of(&file.splats(bytes))).collect();
        for ((part, bytes), sums) in full.iter().zip(sums) {
            let Some(sums) = sums else { continue };
            let rows = bytes.len() / file.stride();
            self.scratch.file.write_all(bytes).map_err(|e| Error::file(&self.path, "write", e))?;
            self.runs[*part].push(Run { at: self.end, rows, sums });
            self.end += bytes.len() as u64;
        }
        Ok(())
    }
}

/// The nodes above parts, and the runs of each part, in the order of the tree.
#[derive(Default)]
pub(super) struct Tree {
    pub nodes: Vec<Vec<Child>>,
    pub parts: Vec<Vec<Run>>,
}

/// Parts without empty ones, and without nodes above a single one.
enum Branch {
    Part(Vec<Run>),
    Node(Vec<Branch>),
}

impl Sorted {
    /// The tree of parts of at most so many rows. Where the sample was wrong about a part, or it lies at one place, it is cut by its order.
    pub fn tree(&mut self, partition: &Partition, most: usize) -> Tree {
        let mut tree = Tree::default();
        if let Some(root) = self.branch(partition, 0, most) {
            tree.add(root);
        }
        tree
    }

    fn branch(&mut self, partition: &Partition, cell: usize, most: usize) -> Option<Branch> {
        match partition.cell(cell) {
            Cell::Part(part) => cut_by_order(std::mem::take(&mut self.runs[*part]), most),
            Cell::Cut(_, pieces) => {
                let below = pieces.iter().filter_map(|cell| self.branch(partition, *cell, most)).collect();
                one_above(below)
            }
        }
    }

    /// The splats of a part.
    pub fn splats(&mut self, rows: &SplatRows, runs: &[Run]) -> Result<Splats> {
        let count = runs.iter().map(|run| run.rows).sum();
        let mut all: Option<Splats> = None;
        let mut bytes = Vec::new();
        for run in runs {
            bytes.resize(run.rows * rows.stride(), 0);
            let file = &mut self.scratch.file;
            let read = file.seek(SeekFrom::Start(run.at)).and_then(|_| file.read_exact(&mut bytes));
            read.map_err(|e| Error::file(&self.path, "read", e))?;
            let splats = rows.splats(&bytes);
            let all = all.get_or_insert_with(|| splats.with_room(count));
            all.append(splats);
        }
        Ok(all.unwrap_or_else(Splats::none))
    }
}

fn cut_by_order(runs: Vec<Run>, most: usize) -> Option<Branch> {
    let mut parts: Vec<Vec<Run>> = Vec::new();
    let mut rows = usize::MAX;
    for run in runs {
        rows = rows.saturating_add(run.rows);
        match parts.last_mut().filter(|_| rows <= most) {
            Some(part) => part.push(run),
            None => {
                rows = run.rows;
                parts.push(vec![run]);
            }
        }
    }
    let mut branches: Vec<Branch> = parts.into_iter().map(Branch::Part).collect();
    while branches.len() > CHILDREN {
        let mut above = Vec::new();
        let mut below = branches.into_iter().peekable();
        while below.peek().is_some() {
            above.extend(one_above(below.by_ref().take(CHILDREN).collect()));
        }
        branches = above;
    }
    one_above(branches)
}

/// A node above these; itself of a single one.
fn one_above(mut below: Vec<Branch>) -> Option<Branch> {
    if below.len() > 1 { Some(Branch::Node(below)) } else { below.pop() }
}

impl Tree {
    fn add(&mut self, branch: Branch) -> Child {
        match branch {
            Branch::Part(runs) => {
                self.parts.push(runs);
                Child::Part(self.parts.len() - 1)
            }
            Branch::Node(below) => {
                let number = self.nodes.len();
                self.nodes.push(Vec::new());
                self.nodes[number] = below.into_iter().map(|branch| self.add(branch)).collect();
                Child::Node(number)
            }
        }
    }

    /// The sums of each part.
    pub fn sums(&self) -> Vec<PartSums> {
        let of_part = |runs: &Vec<Run>| {
            let sums: Vec<PartSums> = runs.iter().map(|run| run.sums).collect();
            PartSums::of_all(&sums)
        };
        self.parts.iter().filter_map(of_part).collect()
    }
}
