//! A scene of which pages come and go: what files of levels of detail have for some views, on a device, within one fixed budget; beside what is there as a whole.
//!
//! Pages are read in the background ([`Pager`]), coarser ones of all files first. A view draws with the finest size of which all pages are there ([`Ladder`]), so that there are
//! neither holes nor two levels of one thing at any moment. What no view needs stays until its room is.

use crate::{
    error::{Error, Result},
    levels_file::{Arrived, Ladder, PageEntry, PageView, Pager, Rung},
    prepare::PreparedScene,
    scene::{Light, Scene, Storage},
};

/// Uploads a scene, such as [`super::Headless::prepare`].
pub type Prepare<'p> = &'p mut dyn FnMut(&Scene) -> Result<PreparedScene>;

/// Pages of files on a device, for several views.
pub struct PagedScene {
    pager: Pager,
    /// Of device memory, for pages.
    most_bytes: u64,
    /// What is there as a whole, then what pages have.
    prepared: PreparedScene,
    /// Chunks and objects of what is there as a whole.
    whole: [usize; 2],
    /// In the order of the chunks.
    groups: Vec<Group>,
    /// Of each page.
    is_there: Vec<bool>,
    /// Of each file.
    is_seen: Vec<bool>,
    /// What came last found no room.
    is_full: bool,
}

/// Pages of one file that came together, and share chunks.
struct Group {
    file: usize,
    pages: Vec<usize>,
    chunks: usize,
    bytes: u64,
}

/// What a view draws now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drawn {
    /// The size for its settings ([`crate::scene::Lod::Px`]), in pixels.
    pub tau_px: f64,
    /// Whether that is as fine as it asked for, or as memory allows.
    pub is_finest: bool,
}

impl PagedScene {
    /// Nothing yet, of opaque splats, with at most so many bytes of device memory. Half of that is for what is drawn when all is there, the other half for
    /// what is drawn until then.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Input`] for a file in which something is transparent, whose layers would need all levels at once.
    pub fn new(pager: Pager, most_bytes: u64) -> Result<Self> {
        if let Some(file) = pager.files().iter().find(|file| file.header.transparent) {
            return Err(Error::input(&file.path, "", "transparent; expected opaque splats to be paged"));
        }
        let is_seen = vec![true; pager.files().len()];
        let is_there = vec![false; pager.pages().len()];
        let prepared = PreparedScene {
            chunks: Vec::new(),
            objects: pager.files().iter().map(|file| file.name.clone()).collect(),
            meshes: Vec::new(),
            device: None,
            lights: Vec::new(),
            storage: Storage::default(),
            mean_transparent_radius: 0.0,
            refinements: Vec::new(),
            defects: Default::default(),
            bounds: None,
            changes: Default::default(),
            rooms: Vec::new(),
            upload: Default::default(),
        };
        let (whole, groups) = ([0; 2], Vec::new());
        Ok(Self { pager, most_bytes, prepared, whole, groups, is_there, is_seen, is_full: false })
    }

    /// The same under these lights.
    pub fn lit_by(mut self, lights: Vec<Light>) -> Self {
        self.prepared.lights = lights;
        self
    }

    /// With a scene as a whole beside the files, in the place of the one before; its lights are those of the picture.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for a scene that is on another device than the pages.
    pub fn set_beside(&mut self, scene: PreparedScene) -> Result<()> {
        self.check_device(&scene)?;
        let [chunks, objects] = std::mem::replace(&mut self.whole, [scene.chunks.len(), scene.objects.len()]);
        let device = scene.device.clone().or(self.prepared.device.take());
        let before = std::mem::replace(&mut self.prepared, PreparedScene { device, bounds: None, ..scene });
        self.prepared.objects.extend(before.objects.into_iter().skip(objects));
        self.prepared.chunks.extend(before.chunks.into_iter().skip(chunks));
        let of_pages = self.prepared.chunks.iter_mut().skip(self.whole[0]);
        of_pages.for_each(|chunk| chunk.object = chunk.object - objects + self.whole[1]);
        Ok(())
    }

    /// With these of the files; pages of the others go, and none of them is read.
    pub fn show(&mut self, is_seen: &[bool]) {
        self.is_seen = (0..self.pager.files().len()).map(|file| is_seen.get(file) == Some(&true)).collect();
        for group in (0..self.groups.len()).rev() {
            if !self.is_seen[self.groups[group].file] {
                self.remove(group);
            }
        }
    }

    /// What is on the device. Each view of it draws with the size that [`Self::update`] gave it.
    pub fn scene(&self) -> &PreparedScene {
        &self.prepared
    }

    /// Bytes of device memory that pages take.
    pub fn bytes(&self) -> u64 {
        self.groups.iter().map(|group| group.bytes).sum()
    }

    /// Pages that are there.
    pub fn pages(&self) -> usize {
        self.is_there.iter().filter(|is_there| **is_there).count()
    }

    /// Whether a view may become finer yet: something that it needs is read, and has room.
    pub fn is_coming(&self) -> bool {
        !self.is_full && self.pager.is_expected()
    }

    /// Whether [`Self::update`] would find something new.
    pub fn has_arrived(&self) -> bool {
        self.pager.has_arrived()
    }

    /// Takes what has arrived since, has what these views need read in the background, and tells what each of them can draw now: `None` where not even the coarsest
    /// pages are there. Waits for nothing, or, with `wait`, for a page. What was dropped by this is destroyed when frames that use it are done.
    ///
    /// # Errors
    /// As [`Pager::take`], of each page that is at fault once: after that a view is as fine as it can be without it. Those of `prepare`; [`crate::ErrorKind::Option`] where the memory does not suffice for the coarsest pages.
    pub fn update(
        &mut self,
        views: &[PageView],
        prepare: Prepare<'_>,
        wait: bool,
    ) -> Result<Vec<Option<Drawn>>> {
        let pages = self.pager.pages();
        let is_seen: Vec<bool> = self
            .pager
            .files()
            .iter()
            .zip(&self.is_seen)
            .flat_map(|(file, is_seen)| std::iter::repeat_n(*is_seen, file.pages.len()))
            .collect();
        let ladder =
            Ladder::new(views, (pages, |page| is_seen[page]), self.most_bytes / 2, PageEntry::device_bytes);
        if ladder.views.iter().any(Vec::is_empty) {
            let problem =
                format!("{} bytes; expected more, for the coarsest pages of the views", self.most_bytes);
            return Err(Error::option("memory", problem));
        }
        let mut standing = ladder.standing(&self.is_there, &self.pager.broken());
        self.pager.want(&standing.missing);
        self.is_full = false;
        let mut is_needed = vec![false; pages.len()];
        standing.needed.iter().for_each(|page| is_needed[*page] = true);
        let arrived = self.pager.take(|page| is_needed[page] && !self.is_there[page], wait)?;
        if !arrived.is_empty() {
            for arrived in arrived {
                self.add(arrived, &is_needed, prepare)?;
            }
            standing = ladder.standing(&self.is_there, &self.pager.broken());
            self.pager.want(&standing.missing);
        }
        let drawn = ladder.views.iter().zip(standing.drawn);
        let of = |(rungs, rung): (&Vec<Rung>, Option<usize>)| {
            let rung = rung?;
            Some(Drawn { tau_px: rungs[rung].tau_px, is_finest: rung == 0 })
        };
        Ok(drawn.map(of).collect())
    }

    /// Uploads what has arrived of a file, once there is room for it.
    fn add(&mut self, arrived: Arrived, is_needed: &[bool], prepare: Prepare<'_>) -> Result<()> {
        let entries = self.pager.pages();
        let bytes: u64 = arrived.pages.iter().map(|page| entries[*page].device_bytes()).sum();
        while self.bytes() + bytes > self.most_bytes {
            // The one of which the largest part is not needed. What else it has is read again.
            let unneeded = |group: &Group| {
                let count = group.pages.iter().filter(|page| !is_needed[**page]).count();
                count as f64 / group.pages.len() as f64
            };
            let shares = self.groups.iter().map(unneeded).enumerate().filter(|(_, share)| *share > 0.0);
            let Some((group, _)) = shares.max_by(|(_, a), (_, b)| a.total_cmp(b)) else {
                // Views at several heights need more than there is: this view stays as coarse as it is, and memory as small.
                self.is_full = true;
                return Ok(());
            };
            self.remove(group);
        }
        let scene = Scene { leveled: vec![arrived.object], ..Scene::default() };
        let new = prepare(&scene)?;
        self.check_device(&new)?;
        let (file, bytes) = (arrived.file, new.bytes());
        self.groups.push(Group { file, pages: arrived.pages, chunks: new.chunks.len(), bytes });
        self.prepared.device = new.device;
        let [_, first] = self.whole;
        self.prepared.chunks.extend(new.chunks.into_iter().map(|mut chunk| {
            chunk.object = first + file;
            chunk
        }));
        for page in self.groups.last().iter().flat_map(|group| &group.pages) {
            self.is_there[*page] = true;
        }
        Ok(())
    }

    /// One `prepare` goes to one device.
    fn check_device(&self, new: &PreparedScene) -> Result<()> {
        match (&self.prepared.device, &new.device) {
            (Some(own), Some(others)) if !own.is(others) => {
                Err(Error::option("prepare", "of another device than before"))
            }
            _ => Ok(()),
        }
    }

    fn remove(&mut self, group: usize) {
        let [whole, _] = self.whole;
        let first = whole + self.groups[..group].iter().map(|group| group.chunks).sum::<usize>();
        let Group { pages, chunks, .. } = self.groups.remove(group);
        self.prepared.chunks.drain(first..first + chunks);
        pages.into_iter().for_each(|page| self.is_there[page] = false);
    }
}
