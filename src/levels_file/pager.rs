//! Pages of one file or several read in the background: a host says which it wants, in which order, and takes those that have arrived.

use std::{
    collections::{BTreeMap, BTreeSet, VecDeque},
    io::{Read, Seek},
    ops::Range,
    path::PathBuf,
    sync::{
        Arc, Condvar, Mutex, MutexGuard, PoisonError,
        mpsc::{Receiver, Sender, TryRecvError, channel},
    },
    thread::{self, JoinHandle},
};

use super::{
    header::Header,
    object::{add, empty_object},
    page::Page,
    read::LevelsFile,
    table::PageEntry,
};
use crate::{
    error::{Error, Result},
    scene::LeveledObject,
};

/// From so many bytes of pages on that the host has not taken, reading waits; the host takes as much at once. With the page that is being read they are all that the
/// host's memory holds.
const MOST_WAITING_BYTES: u64 = 32 << 20;

/// Files of which a thread reads pages, each at a number of its own: those of the first file, then those of the next.
pub struct Pager {
    files: Vec<PagedFile>,
    pages: Vec<PageEntry>,
    wanted: Arc<Wanted>,
    /// `None` once it is closed.
    arrived: Option<Receiver<(usize, Result<Page>)>>,
    thread: Option<JoinHandle<()>>,
}

/// A file of a pager.
#[derive(Clone, Debug)]
pub struct PagedFile {
    /// Where it is.
    pub path: PathBuf,
    /// What messages call it.
    pub name: String,
    /// What it holds.
    pub header: Header,
    /// The numbers of its pages.
    pub pages: Range<usize>,
}

/// Pages of one file that have arrived, as one object.
pub struct Arrived {
    /// Of the file.
    pub file: usize,
    /// Their numbers.
    pub pages: Vec<usize>,
    /// Their splats and nodes.
    pub object: LeveledObject,
}

/// What is to be read.
#[derive(Default)]
struct Wanted {
    list: Mutex<List>,
    /// Told when there is something in the list, what waits was taken, or it is closed.
    changed: Condvar,
}

#[derive(Default)]
struct List {
    next: VecDeque<usize>,
    /// Begun, and not taken yet.
    begun: BTreeSet<usize>,
    /// Read, and not taken yet: pages, and the bytes that they take.
    arrived: usize,
    arrived_bytes: u64,
    /// They are not what the file's format demands, or can't be read.
    broken: BTreeSet<usize>,
    is_closed: bool,
}

impl Wanted {
    fn lock(&self) -> MutexGuard<'_, List> {
        // No step between two locks leaves the list in between.
        self.list.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next page, which counts as begun; waits for one, and while much has not been taken. `None` at the end.
    fn begin(&self) -> Option<usize> {
        let mut list = self.lock();
        loop {
            if list.is_closed {
                return None;
            }
            let next = if list.arrived_bytes < MOST_WAITING_BYTES { list.next.pop_front() } else { None };
            if let Some(page) = next {
                list.begun.insert(page);
                return Some(page);
            }
            list = self.changed.wait(list).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

impl Pager {
    /// Starts the thread, which waits for what is wanted, and ends with the pager.
    ///
    /// # Errors
    /// [`crate::ErrorKind::File`] where the system has no thread left.
    pub fn start<R: Read + Seek + Send + 'static>(
        files: impl IntoIterator<Item = LevelsFile<R>>,
    ) -> Result<Self> {
        let (mut own, mut pages, mut sources) = (Vec::new(), Vec::new(), Vec::new());
        for file in files {
            let first = pages.len();
            pages.extend_from_slice(file.pages());
            let (path, name) = (file.path().to_owned(), file.name().to_owned());
            own.push(PagedFile { path, name, header: file.header().clone(), pages: first..pages.len() });
            sources.push((first..pages.len(), file));
        }
        let first = own.first().map_or_else(PathBuf::new, |file| file.path.clone());
        let wanted = Arc::new(Wanted::default());
        let (sender, arrived) = channel();
        let of_thread = Arc::clone(&wanted);
        let thread = thread::Builder::new().name("pages".to_owned());
        let thread = thread
            .spawn(move || read_all(sources, &of_thread, &sender))
            .map_err(|e| Error::file(&first, "read", e))?;
        Ok(Self { files: own, pages, wanted, arrived: Some(arrived), thread: Some(thread) })
    }

    /// What it reads.
    pub fn files(&self) -> &[PagedFile] {
        &self.files
    }

    /// The pages of all files.
    pub fn pages(&self) -> &[PageEntry] {
        &self.pages
    }

    /// What is wanted from now on, in this order, in the place of what was. What is being read, or has arrived, comes only once; what [`Self::take`] has
    /// called broken does not come again.
    pub fn want(&self, pages: &[usize]) {
        let mut list = self.wanted.lock();
        let comes = |page: &usize| !list.begun.contains(page) && !list.broken.contains(page);
        let next = pages.iter().copied().filter(comes).collect();
        list.next = next;
        drop(list);
        self.wanted.changed.notify_one();
    }

    /// The pages that [`Self::take`] has called broken.
    pub fn broken(&self) -> BTreeSet<usize> {
        self.wanted.lock().broken.clone()
    }

    /// Whether something that is wanted has not been taken yet.
    pub fn is_expected(&self) -> bool {
        let list = self.wanted.lock();
        !list.next.is_empty() || !list.begun.is_empty()
    }

    /// Whether [`Self::take`] would find something, or is about to.
    pub fn has_arrived(&self) -> bool {
        self.wanted.lock().arrived > 0
    }

    /// What has arrived since, file by file, without what nobody needs any more. With `wait`, waits for something, unless nothing is wanted.
    ///
    /// # Errors
    /// As [`LevelsFile::check`], for the page at fault, once: it is broken from now on.
    pub fn take(&self, is_needed: impl Fn(usize) -> bool, wait: bool) -> Result<Vec<Arrived>> {
        let Some(receiver) = &self.arrived else { return Ok(Vec::new()) };
        let mut of_files: BTreeMap<usize, Vec<(usize, Page)>> = BTreeMap::new();
        let mut taken_bytes = 0;
        let mut take = |(number, page): (usize, Result<Page>)| -> Result<u64> {
            let bytes = self.pages[number].host_bytes();
            taken_bytes += bytes;
            let mut list = self.wanted.lock();
            list.begun.remove(&number);
            list.arrived = list.arrived.saturating_sub(1);
            list.arrived_bytes = list.arrived_bytes.saturating_sub(bytes);
            if page.is_err() {
                list.broken.insert(number);
            }
            drop(list);
            self.wanted.changed.notify_one();
            let page = page?;
            if is_needed(number) {
                of_files.entry(file_of(&self.files, number)).or_default().push((number, page));
            }
            Ok(taken_bytes)
        };
        let mut bytes = 0;
        if wait && self.is_expected() {
            // The thread ends with the pager alone.
            bytes = receiver.recv().map_or(Ok(0), &mut take)?;
        }
        // No more than waits at once: a thread that is as fast as this would fill all memory.
        while bytes < MOST_WAITING_BYTES {
            match receiver.try_recv() {
                Ok(arrived) => bytes = take(arrived)?,
                Err(TryRecvError::Empty | TryRecvError::Disconnected) => break,
            }
        }
        let arrived = of_files.into_iter().map(|(file, arrived)| {
            let PagedFile { name, header, .. } = &self.files[file];
            let (pages, read): (Vec<usize>, Vec<Page>) = arrived.into_iter().unzip();
            let mut object = empty_object(name, header, &self.pages, &pages);
            read.into_iter().for_each(|page| add(&mut object, page));
            Arrived { file, pages, object }
        });
        Ok(arrived.collect())
    }
}

/// The file that has a page.
fn file_of(files: &[PagedFile], page: usize) -> usize {
    files.partition_point(|file| file.pages.end <= page)
}

impl Drop for Pager {
    fn drop(&mut self) {
        self.wanted.lock().is_closed = true;
        self.wanted.changed.notify_one();
        // A thread that waits for room goes on, and finds that it is closed.
        self.arrived = None;
        if let Some(thread) = self.thread.take() {
            // It has no result; that it panicked was told where it did.
            let _ = thread.join();
        }
    }
}

/// The thread.
fn read_all<R: Read + Seek>(
    mut files: Vec<(Range<usize>, LevelsFile<R>)>,
    wanted: &Wanted,
    arrived: &Sender<(usize, Result<Page>)>,
) {
    while let Some(number) = wanted.begin() {
        let Some((pages, file)) = files.iter_mut().find(|(pages, _)| pages.contains(&number)) else {
            continue;
        };
        let (own, bytes) = (number - pages.start, file.pages()[number - pages.start].host_bytes());
        let page = file.page(own);
        let mut list = wanted.lock();
        list.arrived += 1;
        list.arrived_bytes += bytes;
        drop(list);
        if arrived.send((number, page)).is_err() {
            return;
        }
    }
}
