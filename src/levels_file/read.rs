//! Reading: the header and the table whole, then pages one at a time.

use std::{
    fs::{self, File},
    io::{self, Read, Seek, SeekFrom},
    path::{Path, PathBuf},
};

use super::{
    choose::{Choice, PageView},
    header::{HEADER_BYTES, Header, MAGIC},
    object::{add, empty_object},
    page::{Form, Page},
    placed::{Placed, Placing},
    table::{ENTRY_BYTES, PageEntry},
};
use crate::{
    error::{Error, Result},
    load::file_name,
    progress::Progress,
    scene::{Ball, Bounds, LeveledObject},
};

/// A file whose header and table were read.
#[derive(Debug)]
pub struct LevelsFile<R = File> {
    path: PathBuf,
    /// In messages.
    name: String,
    source: R,
    header: Header,
    pages: Vec<PageEntry>,
    /// Where it stands in a scene, if not as it was written.
    placing: Option<Box<Placing>>,
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

    /// Opens the same file again, which stands as this one does.
    ///
    /// # Errors
    /// As [`Self::open`] and [`Self::placed_as`].
    pub fn again(&self) -> Result<Self> {
        Self::open(&self.path)?.placed_as(self.name.clone(), &self.placed())
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
        let name = file_name(path);
        Ok(Self { path: path.to_owned(), name, source, header, pages, placing: None })
    }

    /// The same as it stands in a scene, under this name.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Input`] for a place beyond what numbers are for.
    pub fn placed_as(self, name: String, placed: &Placed) -> Result<Self> {
        let Self { path, source, mut header, mut pages, placing, .. } = self;
        if let Some(placing) = placing {
            (header, pages) = (placing.header, placing.pages);
        }
        if *placed == Placed::default() {
            return Ok(Self { path, name, source, header, pages, placing: None });
        }
        let there = Placing::new(placed, header, pages);
        let (placing, header, pages) = there.map_err(|problem| Error::input(&path, "", problem))?;
        Ok(Self { path, name, source, header, pages, placing: Some(Box::new(placing)) })
    }

    /// How it stands in a scene.
    pub fn placed(&self) -> Placed {
        self.placing.as_ref().map_or_else(Placed::default, |placing| placing.placed().clone())
    }

    /// What messages call it: its file's name, unless it was given another one.
    pub fn name(&self) -> &str {
        &self.name
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
        let pages: Vec<&PageEntry> = self.pages.iter().collect();
        let choice = match view {
            Some(view) => view.choose(&pages, most_bytes)?,
            None => Choice::all(&pages),
        };
        self.chosen(choice, progress)
    }

    /// Reads some pages.
    pub(super) fn chosen(&mut self, choice: Choice, progress: &dyn Progress) -> Result<Chosen> {
        let mut object = empty_object(&self.name, &self.header, &self.pages, &choice.pages);
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
        let written = self.placing.as_deref().map(|placing| (&placing.header, &placing.pages));
        let (header, pages) = written.unwrap_or((&self.header, &self.pages));
        let Some(entry) = pages.get(number) else {
            return Err(refuse(format!("expected one of {}", self.pages.len())));
        };
        let bytes = read_at(&mut self.source, entry.at, entry.bytes.into())
            .map_err(|e| Error::file(&self.path, "read", e))?;
        if crc32fast::hash(&bytes) != entry.crc {
            return Err(refuse("its checksum is wrong: the file is damaged".to_owned()));
        }
        let page = Page::decode(&bytes, entry, &Form::of(header)).map_err(refuse)?;
        match &self.placing {
            None => Ok(page),
            Some(placing) => placing.page(page).map_err(refuse),
        }
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
