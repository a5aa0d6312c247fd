//! Reading: the header and the table whole, then pages one at a time.

use std::{
    fs::{self, File},
    io::{self, Read, Seek, SeekFrom},
    path::{Path, PathBuf},
};

use super::{
    choose::{Choice, PageView},
    header::{HEADER_BYTES, Header, MAGIC},
    page::{Form, Page},
    table::{ENTRY_BYTES, PageEntry},
};
use crate::{
    error::{Error, Result},
    progress::Progress,
    scene::{Ball, Bounds, Colors, LeveledObject, NodeBalls, Shapes, Splats},
};

/// A file whose header and table were read.
#[derive(Debug)]
pub struct LevelsFile<R = File> {
    path: PathBuf,
    source: R,
    header: Header,
    pages: Vec<PageEntry>,
}

/// What was read for a view.
#[derive(Debug)]
pub struct Chosen {
    /// What a frame may draw of it.
    pub object: LeveledObject,
    /// The largest size on the screen of what is drawn for others, in pixels: what was asked for, or more, where memory ended.
    pub tau_px: f64,
    /// How many pages were read.
    pub pages: usize,
    /// How many bytes those have.
    pub bytes: u64,
    /// The memory that what was asked for takes on its way to a device, in bytes.
    pub wanted_bytes: u64,
}

/// Whether a file is one of this format, by its first bytes; not what can't be read, nor what is no regular file.
pub fn is_levels_file(path: &Path) -> bool {
    let mut magic = [0; MAGIC.len()];
    let is_file = fs::metadata(path).is_ok_and(|metadata| metadata.is_file());
    is_file && File::open(path).and_then(|mut file| file.read_exact(&mut magic)).is_ok() && magic == MAGIC
}

impl LevelsFile {
    /// Opens a file.
    ///
    /// # Errors
    /// [`crate::ErrorKind::File`] if it can't be read; as [`LevelsFile::new`].
    pub fn open(path: &Path) -> Result<Self> {
        let fail = |e| Error::file(path, "read", e);
        let metadata = fs::metadata(path).map_err(fail)?;
        if !metadata.is_file() {
            return Err(Error::input(path, "", "not a file; expected a hierarchy of splats"));
        }
        Self::new(path, File::open(path).map_err(fail)?, metadata.len())
    }
}

impl<R: Read + Seek> LevelsFile<R> {
    /// Reads the header and the table of what has so many bytes; `path` is its name in messages.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Input`] with the header, the table or the page at fault; [`crate::ErrorKind::File`] if it can't be read.
    pub fn new(path: &Path, mut source: R, file_bytes: u64) -> Result<Self> {
        let fail = |e| Error::file(path, "read", e);
        let refuse = |place: String, problem: String| Error::input(path, place, problem);
        if file_bytes < HEADER_BYTES as u64 {
            let problem = format!("{file_bytes} bytes; expected a header of {HEADER_BYTES}");
            return Err(refuse("header".to_owned(), problem));
        }
        let mut bytes = [0; HEADER_BYTES];
        source.read_exact(&mut bytes).map_err(fail)?;
        let header =
            Header::decode(&bytes, file_bytes).map_err(|problem| refuse("header".to_owned(), problem))?;
        // As large as what lies behind its place in the file.
        let table = read_at(&mut source, header.table_at, u64::from(header.pages) * ENTRY_BYTES as u64)
            .map_err(fail)?;
        if crc32fast::hash(&table) != header.table_crc {
            return Err(refuse(
                "table of pages".to_owned(),
                "its checksum is wrong: the file is damaged".to_owned(),
            ));
        }
        let form = Form::of(&header);
        let mut pages = Vec::with_capacity(header.pages as usize);
        let mut at = HEADER_BYTES as u64;
        let mut counts = [0; 2];
        for (number, entry) in table.chunks_exact(ENTRY_BYTES).enumerate() {
            let refuse = |problem: String| refuse(format!("page {number}"), problem);
            let entry = PageEntry::decode(entry).map_err(refuse)?;
            let bytes = form.bytes(&entry);
            if entry.at != at || u64::from(entry.bytes) != bytes {
                let (found, found_at) = (entry.bytes, entry.at);
                return Err(refuse(format!("{found} bytes at byte {found_at}; expected {bytes} at {at}")));
            }
            at += bytes;
            counts[usize::from(entry.nodes)] += u64::from(entry.count);
            pages.push(entry);
        }
        if at != header.table_at || counts != [header.splats, header.nodes] {
            let [splats, nodes] = counts;
            let problem = format!(
                "{splats} splats and {nodes} nodes up to byte {at}; expected {} and {} up to {}",
                header.splats, header.nodes, header.table_at
            );
            return Err(refuse("table of pages".to_owned(), problem));
        }
        Ok(Self { path: path.to_owned(), source, header, pages })
    }

    /// What it holds.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// Its pages.
    pub fn pages(&self) -> &[PageEntry] {
        &self.pages
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The box around all of its splats.
    pub fn bounds(&self) -> Bounds {
        let [min, max] = self.header.bounds;
        Bounds { min, max }
    }

    /// A ball around all of its splats.
    pub fn ball(&self) -> Ball {
        Ball { center: self.bounds().center(), radius: self.header.radius }
    }

    /// Reads every page and looks whether it is sound.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Input`] with the page at fault; [`crate::ErrorKind::File`] if it can't be read.
    pub fn check(&mut self, progress: &dyn Progress) -> Result<()> {
        let numbers: Vec<usize> = (0..self.pages.len()).collect();
        self.read(&numbers, progress, |_| {})
    }

    /// Reads what a view needs, for which at most so many bytes of memory are taken: where they do not suffice, what is drawn is coarser than
    /// was asked for, all over the view. Everything where there is no view.
    ///
    /// # Errors
    /// As [`Self::check`]; [`crate::ErrorKind::Option`] where the memory does not suffice for anything.
    pub fn load(
        &mut self,
        view: Option<&PageView>,
        most_bytes: u64,
        progress: &dyn Progress,
    ) -> Result<Chosen> {
        let choice = match view {
            Some(view) => view.choose(&self.pages, most_bytes)?,
            None => Choice::all(&self.pages),
        };
        let mut object = empty_object(&self.path, &self.header, &self.pages, &choice.pages);
        self.read(&choice.pages, progress, |page| add(&mut object, page))?;
        let bytes = choice.pages.iter().map(|number| u64::from(self.pages[*number].bytes)).sum();
        let Choice { tau_px, wanted_bytes, .. } = choice;
        Ok(Chosen { object, tau_px, pages: choice.pages.len(), bytes, wanted_bytes })
    }

    /// Reads pages in the order of the file.
    fn read(&mut self, numbers: &[usize], progress: &dyn Progress, mut take: impl FnMut(Page)) -> Result<()> {
        let task = format!("read {}", self.path.display());
        for (done, number) in numbers.iter().enumerate() {
            progress.step(&task, done as u64, numbers.len() as u64);
            take(self.page(*number)?);
        }
        progress.step(&task, numbers.len() as u64, numbers.len() as u64);
        Ok(())
    }

    /// Reads a page.
    pub(super) fn page(&mut self, number: usize) -> Result<Page> {
        let refuse = |problem: String| Error::input(&self.path, format!("page {number}"), problem);
        let Some(entry) = self.pages.get(number) else {
            return Err(refuse(format!("expected one of {}", self.pages.len())));
        };
        let bytes = read_at(&mut self.source, entry.at, entry.bytes.into())
            .map_err(|e| Error::file(&self.path, "read", e))?;
        if crc32fast::hash(&bytes) != entry.crc {
            return Err(refuse("its checksum is wrong: the file is damaged".to_owned()));
        }
        Page::decode(&bytes, entry, &Form::of(&self.header)).map_err(refuse)
    }
}

/// The object of a file without splats, but with room for those of some pages.
pub(super) fn empty_object(
    path: &Path,
    header: &Header,
    entries: &[PageEntry],
    pages: &[usize],
) -> LeveledObject {
    let sum = |of: &dyn Fn(&PageEntry) -> u32| -> usize {
        pages.iter().map(|number| of(&entries[*number]) as usize).sum()
    };
    let nodes = sum(&|page| if page.nodes { page.count } else { 0 });
    let leaves = sum(&|page| page.count) - nodes;
    let splats = |ellipses: bool, count: usize| {
        let shapes = match ellipses {
            true => Shapes::Ellipses { s: Vec::with_capacity(count), t: Vec::with_capacity(count) },
            false => Shapes::Disks { normals: Vec::with_capacity(count), radii: Vec::with_capacity(count) },
        };
        let colors = header.color.map_or_else(|| Colors::Each(Vec::with_capacity(count)), Colors::Uniform);
        Splats::new(Vec::with_capacity(count), shapes, colors)
    };
    LeveledObject {
        name: path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default(),
        closed: header.closed,
        opacity: header.opacity(),
        overlap: header.overlap,
        origin: header.origin,
        radius: header.root_radius,
        balls: Vec::with_capacity(sum(&|page| page.balls) + nodes),
        leaves: splats(header.ellipses, leaves),
        leaf_parents: Vec::with_capacity(leaves),
        inverse_overlaps: Some(Vec::with_capacity(leaves)),
        nodes: splats(true, nodes),
        node_balls: Vec::with_capacity(nodes),
        weights: Vec::with_capacity(nodes),
    }
}

/// Bytes of a file, at a place and of a number that was compared with its size.
fn read_at(source: &mut (impl Read + Seek), at: u64, bytes: u64) -> io::Result<Vec<u8>> {
    let mut read = Vec::new();
    let size = usize::try_from(bytes).map_err(|_| io::ErrorKind::OutOfMemory)?;
    read.try_reserve_exact(size).map_err(|_| io::ErrorKind::OutOfMemory)?;
    source.seek(SeekFrom::Start(at))?;
    match source.take(bytes).read_to_end(&mut read)? == size {
        true => Ok(read),
        // It was as long when it was opened.
        false => Err(io::ErrorKind::UnexpectedEof.into()),
    }
}

/// Adds a page to what there is.
pub(super) fn add(object: &mut LeveledObject, page: Page) {
    let first = object.balls.len() as u32;
    let parents = page.parents.iter().map(|parent| first + parent);
    if page.nodes {
        let own = first + page.balls.len() as u32..;
        object.node_balls.extend(own.zip(parents).map(|(own, parent)| NodeBalls { own, parent }));
        object.weights.extend(page.own.iter().map(|(_, weight)| *weight));
    } else {
        object.leaf_parents.extend(parents);
        object.inverse_overlaps.get_or_insert_default().extend(page.inverse_overlaps);
    }
    object.balls.extend(page.balls);
    object.balls.extend(page.own.iter().map(|(ball, _)| *ball));
    let all = if page.nodes { &mut object.nodes } else { &mut object.leaves };
    all.append(page.splats);
}
