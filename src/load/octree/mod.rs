//! Points in octrees, of which a view reads the nodes that it needs: COPC (version 1.0, <https://copc.io>), whose octree is the order of the chunks of a LAZ
//! file, and Potree 2 (`metadata.json`, with `hierarchy.bin` and `octree.bin` beside it).
//!
//! Both spread points alike: each point is in one node, those of a node are a sample of all within its cube at the level's spacing, which is half that of the level above.
//! So the points of some nodes and of all nodes above them are the cloud at the spacing of the lowest. The hierarchy lies in pages, which are
//! read when a view comes to them.
//!
//! A point is where its file says, in whatever order a view reads it; what an octree says of itself is held against the sizes of its files before memory is
//! taken for it.

mod copc;
mod packed_node;
mod pages;
mod potree;
mod probe;
mod source;
#[cfg(test)]
mod tests;
mod tree;

use std::{
    fs::File,
    io::{Read, Seek},
    path::{Path, PathBuf},
};

use rayon::prelude::*;

use super::{
    Input, Limits, LoadOptions, Loaded,
    las::{Columns, Palette, loaded},
};
use crate::{
    error::{Error, Result},
    progress::Progress,
    scene::{Ball, Bounds},
};
use probe::PROBE_BYTES;
use source::Source;
use tree::{Entry, Span, Tree};

pub use probe::is_point_octree;
pub use tree::{LevelOfOctree, NodeKey, OctreeNode};

/// Nodes whose bytes are in memory at once, to be decoded beside each other.
const BATCH: usize = 32;

/// An octree of points, opened.
pub struct PointOctree<R = File> {
    path: PathBuf,
    words: String,
    /// How many points it says there are.
    points: u64,
    bounds: Bounds,
    tree: Tree,
    /// What has the pages of the hierarchy, where they are not beside the points.
    hierarchy: Option<Source<R>>,
    nodes: Source<R>,
    form: Form,
    limits: Limits,
}

/// How nodes are written.
enum Form {
    Copc(copc::Form),
    Potree(potree::Form),
}

/// Reads all of a Potree 2 octree, as the reader of any other format.
pub(super) fn parse(input: &Input<'_>) -> Result<Loaded> {
    let Some(folder) = input.folder else {
        return Err(input.fault("", "Potree's metadata alone; expected a file in the folder of its points"));
    };
    let (form, files) = potree::open(input.path, input.bytes, folder, input.options)?;
    let mut octree = PointOctree::of_potree(input.path, form, files, &input.options.limits)?;
    let all = octree.choose(&|_| true)?;
    octree.read(&all, input.progress)
}

impl PointOctree {
    /// Opens an octree of points: a COPC file, or the `metadata.json` of Potree 2.
    ///
    /// # Errors
    /// [`crate::ErrorKind::File`] if a file can't be read; [`crate::ErrorKind::Input`] if it is not what its format demands.
    pub fn open(path: &Path, options: &LoadOptions) -> Result<Self> {
        let mut source = Source::open(path)?;
        let most = source.bytes.min(potree::MOST_METADATA_BYTES);
        let head = source.read(Span { at: 0, bytes: most.min(PROBE_BYTES) })?;
        if copc::is_copc(&head) {
            return Self::of_copc(source, options);
        }
        let metadata = source.read(Span { at: 0, bytes: most })?;
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let (form, files) = potree::open(path, &metadata, folder.unwrap_or(Path::new(".")), options)?;
        Self::of_potree(path, form, files, &options.limits)
    }
}

impl<R: Read + Seek> PointOctree<R> {
    fn of_copc(mut source: Source<R>, options: &LoadOptions) -> Result<Self> {
        let path = source.path.clone();
        let copc::Opened { form, words, points, bounds, tree } = copc::open(&mut source, options)?;
        let (form, limits) = (Form::Copc(form), options.limits);
        Ok(Self { path, words, points, bounds, tree, hierarchy: None, nodes: source, form, limits })
    }

    fn of_potree(
        path: &Path,
        opened: potree::Opened,
        [hierarchy, nodes]: [Source<R>; 2],
        limits: &Limits,
    ) -> Result<Self> {
        let potree::Opened { form, words, points, bounds, tree } = opened;
        let fault = |problem: String| Error::input(path, "points", problem);
        if points > limits.points {
            return Err(fault(format!("{points}; expected at most {}", limits.points)));
        }
        let room = if form.is_packed { limits.unpacked(nodes.bytes as usize) } else { nodes.bytes };
        let most = room / form.record_bytes as u64;
        if points > most {
            let problem = format!(
                "{points} of {} bytes in {} bytes; expected at most {most}",
                form.record_bytes, nodes.bytes
            );
            return Err(fault(problem));
        }
        let (path, form) = (path.to_owned(), Form::Potree(form));
        Ok(Self {
            path,
            words,
            points,
            bounds,
            tree,
            hierarchy: Some(hierarchy),
            nodes,
            form,
            limits: *limits,
        })
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// All files that it is made of.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        let others = self.hierarchy.iter().chain(self.hierarchy.is_some().then_some(&self.nodes));
        std::iter::once(self.path.as_path()).chain(others.map(|source| source.path.as_path()))
    }

    /// Its format in words.
    pub fn format(&self) -> &str {
        &self.words
    }

    /// Whether its points have room for colors.
    pub fn has_colors(&self) -> bool {
        match &self.form {
            Form::Copc(form) => form.has_colors(),
            Form::Potree(form) => form.has_colors(),
        }
    }

    /// How long its unit is in metres, where it tells it.
    pub fn metres_per_unit(&self) -> Option<f64> {
        match &self.form {
            Form::Copc(form) => form.metres_per_unit(),
            Form::Potree(_) => None,
        }
    }

    /// How many points it says there are.
    pub fn points(&self) -> u64 {
        self.points
    }

    /// The box in which it says all points are.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// The ball around that.
    pub fn ball(&self) -> Ball {
        Ball { center: self.bounds.center(), radius: self.bounds.radius() }
    }

    /// How far the points of the root are apart.
    pub fn spacing(&self) -> f64 {
        self.tree.spacing
    }

    /// What is known of each level, from the root down: all of it once [`Self::choose`] has come to all pages.
    pub fn levels(&self) -> Vec<LevelOfOctree> {
        self.tree.levels()
    }

    /// How many pages of the hierarchy were read.
    pub fn pages(&self) -> usize {
        self.tree.pages()
    }

    /// The root, and of the nodes below those that are chosen the ones that are wanted; without those that are empty. In the order of the file.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Input`] with the page of the hierarchy at fault; [`crate::ErrorKind::File`] if it can't be read.
    pub fn choose(&mut self, is_wanted: &dyn Fn(&OctreeNode) -> bool) -> Result<Vec<NodeKey>> {
        let mut stack = vec![NodeKey::ROOT];
        let mut chosen = Vec::new();
        while let Some(key) = stack.pop() {
            if key != NodeKey::ROOT && !is_wanted(&self.tree.node(key)) {
                continue;
            }
            if let Some(Entry::Page(span)) = self.tree.get(key) {
                self.read_page(key, span)?;
            }
            let Some(Entry::Node { points, span }) = self.tree.get(key) else { continue };
            if points > 0 {
                chosen.push((span.at, key));
            }
            stack.extend(self.tree.children(key));
        }
        chosen.sort_unstable();
        Ok(chosen.into_iter().map(|(_, key)| key).collect())
    }

    /// How many points some nodes have, and how many bytes of the file.
    pub fn size_of(&self, nodes: &[NodeKey]) -> (u64, u64) {
        let sizes = nodes.iter().filter_map(|key| match self.tree.get(*key)? {
            Entry::Node { points, span } => Some((u64::from(points), span.bytes)),
            Entry::Page(_) => None,
        });
        sizes.fold((0, 0), |(points, bytes), own| (points + own.0, bytes + own.1))
    }

    /// Reads the points of some nodes, in the order of the list. What 16 bits of a color or an intensity mean is told by the points of the coarsest of
    /// them, so that it is the same in every view; by all points, where all are read.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Input`] with the node at fault; [`crate::ErrorKind::File`] if it can't be read.
    pub fn read(&mut self, nodes: &[NodeKey], progress: &dyn Progress) -> Result<Loaded> {
        let mut columns = Columns::default();
        let coarsest = nodes.iter().min().copied();
        let mut palette = None;
        let task = format!("read {}", super::file_name(&self.path));
        for (number, batch) in nodes.chunks(BATCH).enumerate() {
            let mut packed = Vec::with_capacity(batch.len());
            for key in batch {
                if let Some(Entry::Node { points, span }) = self.tree.get(*key) {
                    packed.push((*key, points as usize, self.nodes.read(span)?));
                }
            }
            let decode = |(key, points, bytes): &(NodeKey, usize, Vec<u8>)| {
                let read = match &self.form {
                    Form::Copc(form) => form.decode(bytes, *points, &self.limits),
                    Form::Potree(form) => form.decode(bytes, *points, &self.limits),
                };
                read.map_err(|problem| Error::input(&self.nodes.path, format!("node {key}"), problem))
            };
            let read: Vec<Result<Columns>> = packed.par_iter().map(decode).collect();
            for ((key, ..), read) in packed.iter().zip(read) {
                let read = read?;
                if Some(*key) == coarsest {
                    palette = Some(Palette::of(&read));
                }
                columns.append(read);
            }
            progress.step(&task, (nodes.len().min((number + 1) * BATCH)) as u64, nodes.len() as u64);
        }
        let palette = palette.filter(|_| !self.tree.is_all(nodes.len()));
        let mut loaded = loaded(columns, palette, &self.words);
        loaded.metres_per_unit = self.metres_per_unit();
        Ok(loaded)
    }

    fn read_page(&mut self, root: NodeKey, span: Span) -> Result<()> {
        let source = self.hierarchy.as_mut().unwrap_or(&mut self.nodes);
        let bytes = source.read(span)?;
        let place = format!("page of the hierarchy at byte {}", span.at);
        let path = source.path.clone();
        let entries = match &self.form {
            Form::Copc(_) => pages::of_copc(&bytes),
            Form::Potree(form) => pages::of_potree(&bytes, root, form.bytes_of_record()),
        };
        let sizes = [self.hierarchy.as_ref().unwrap_or(&self.nodes).bytes, self.nodes.bytes];
        let added = entries.and_then(|entries| self.tree.add(root, span, entries, sizes));
        added.map_err(|problem| Error::input(path, place, problem))
    }
}
