//! Pages read in the background: a host says which it wants, in which order, and takes those that have arrived.

use std::{
    collections::{BTreeSet, VecDeque},
    io::{Read, Seek},
    path::{Path, PathBuf},
    sync::{
        Arc, Condvar, Mutex, MutexGuard, PoisonError,
        mpsc::{Receiver, SyncSender, TryRecvError, sync_channel},
    },
    thread::{self, JoinHandle},
};

use super::{
    header::Header,
    page::Page,
    read::{LevelsFile, add, empty_object},
    table::PageEntry,
};
use crate::{
    error::{Error, Result},
    scene::LeveledObject,
};

/// So many pages wait at most until the host takes them; then reading waits. With the one that is being read they are all that the host's memory holds.
const MOST_WAITING: usize = 8;

/// A file of which a thread reads pages.
pub struct Pager {
    path: PathBuf,
    header: Header,
    pages: Vec<PageEntry>,
    wanted: Arc<Wanted>,
    /// `None` once it is closed.
    arrived: Option<Receiver<(usize, Result<Page>)>>,
    thread: Option<JoinHandle<()>>,
}

/// Pages that have arrived, as one object.
pub struct Arrived {
    /// Their numbers.
    pub pages: Vec<usize>,
    /// Their splats and nodes.
    pub object: LeveledObject,
}

/// What is to be read.
#[derive(Default)]
struct Wanted {
    list: Mutex<List>,
    /// Told when there is something in the list, or it is closed.
    changed: Condvar,
}

#[derive(Default)]
struct List {
    next: VecDeque<usize>,
    /// Begun, and not taken yet.
    begun: BTreeSet<usize>,
    /// Read, and not taken yet.
    arrived: usize,
    /// They are not what the file's format demands, or can't be read.
    broken: BTreeSet<usize>,
    is_closed: bool,
}

impl Wanted {
    fn lock(&self) -> MutexGuard<'_, List> {
        // No step between two locks leaves the list in between.
        self.list.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next page, which counts as begun; waits for one. `None` at the end.
    fn begin(&self) -> Option<usize> {
        let mut list = self.lock();
        loop {
            if list.is_closed {
                return None;
            }
            if let Some(page) = list.next.pop_front() {
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
    pub fn start<R: Read + Seek + Send + 'static>(file: LevelsFile<R>) -> Result<Self> {
        let (path, header, pages) = (file.path().to_owned(), file.header().clone(), file.pages().to_vec());
        let wanted = Arc::new(Wanted::default());
        let (sender, arrived) = sync_channel(MOST_WAITING);
        let of_thread = Arc::clone(&wanted);
        let thread = thread::Builder::new().name("pages".to_owned());
        let thread = thread
            .spawn(move || read_all(file, &of_thread, &sender))
            .map_err(|e| Error::file(&path, "read", e))?;
        Ok(Self { path, header, pages, wanted, arrived: Some(arrived), thread: Some(thread) })
    }

    /// What the file holds.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// Its pages.
    pub fn pages(&self) -> &[PageEntry] {
        &self.pages
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
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

    /// Whether something that is wanted has not been taken yet.
    pub fn is_expected(&self) -> bool {
        let list = self.wanted.lock();
        !list.next.is_empty() || !list.begun.is_empty()
    }

    /// Whether [`Self::take`] would find something, or is about to.
    pub fn has_arrived(&self) -> bool {
        self.wanted.lock().arrived > 0
    }

    /// What has arrived since, without what nobody needs any more; `None` where that is nothing. With `wait`, waits for something, unless nothing is wanted.
    ///
    /// # Errors
    /// As [`LevelsFile::check`], for the page at fault, once: it is broken from now on.
    pub fn take(&self, is_needed: impl Fn(usize) -> bool, wait: bool) -> Result<Option<Arrived>> {
        let Some(receiver) = &self.arrived else { return Ok(None) };
        let (mut numbers, mut pages) = (Vec::new(), Vec::new());
        let mut take = |(number, page): (usize, Result<Page>)| -> Result<()> {
            let mut list = self.wanted.lock();
            list.begun.remove(&number);
            list.arrived = list.arrived.saturating_sub(1);
            if page.is_err() {
                list.broken.insert(number);
            }
            drop(list);
            let page = page?;
            if is_needed(number) {
                numbers.push(number);
                pages.push(page);
            }
            Ok(())
        };
        if wait && self.is_expected() {
            // The thread ends with the pager alone.
            receiver.recv().map_or(Ok(()), &mut take)?;
        }
        // No more than wait at once: a thread that is as fast as this would fill all memory.
        for _ in 0..MOST_WAITING {
            match receiver.try_recv() {
                Ok(arrived) => take(arrived)?,
                Err(TryRecvError::Empty | TryRecvError::Disconnected) => break,
            }
        }
        if pages.is_empty() {
            return Ok(None);
        }
        let mut object = empty_object(&self.path, &self.header, &self.pages, &numbers);
        pages.into_iter().for_each(|page| add(&mut object, page));
        Ok(Some(Arrived { pages: numbers, object }))
    }
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
    mut file: LevelsFile<R>,
    wanted: &Wanted,
    arrived: &SyncSender<(usize, Result<Page>)>,
) {
    while let Some(number) = wanted.begin() {
        let page = file.page(number);
        wanted.lock().arrived += 1;
        if arrived.send((number, page)).is_err() {
            return;
        }
    }
}
