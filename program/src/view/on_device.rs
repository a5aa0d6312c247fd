//! What of a scene is on the device: all of it, or pages of files that come and go as the camera moves, beside all of the rest.

use surfel::{
    Error, ErrorKind, Headless, Result,
    levels_file::{LevelsFile, PageView, Pager},
    prepare::PreparedScene,
    renderer::{Drawn, PagedScene},
    scene::{Camera, Light, Lod, Settings},
};

use super::told::Step;

/// A scene on the device.
pub enum OnDevice {
    /// What was read at once, and how much of it that is.
    Whole(Box<PreparedScene>, Step),
    /// Pages, and what is there as a whole beside them.
    Paged(Box<Paged>),
}

/// Pages of files.
pub struct Paged {
    scene: PagedScene,
    /// The size for a picture at rest with what is there.
    still_px: Option<f64>,
    /// More is to come.
    pub is_coming: bool,
    /// What is wrong with the first page that can't be read, until it is told.
    fault: Option<Error>,
    /// How many can't be read.
    faults: usize,
}

impl OnDevice {
    /// What is drawn.
    pub fn scene(&self) -> &PreparedScene {
        match self {
            Self::Whole(scene, _) => scene,
            Self::Paged(paged) => paged.scene.scene(),
        }
    }

    /// How much of the scene that is.
    pub fn step(&self) -> Step {
        match self {
            Self::Whole(_, step) => *step,
            Self::Paged(_) => Step::Leveled,
        }
    }

    /// The pages, if there are files of them.
    pub fn pages(&self) -> Option<&Paged> {
        match self {
            Self::Whole(..) => None,
            Self::Paged(paged) => Some(paged),
        }
    }
}

impl Paged {
    /// Nothing of some files yet, within so many bytes of device memory.
    ///
    /// # Errors
    /// As [`LevelsFile::again`], [`Pager::start`] and [`PagedScene::new`].
    pub fn new(files: &[LevelsFile], most_bytes: u64, lights: Vec<Light>) -> Result<Self> {
        let files = files.iter().map(LevelsFile::again).collect::<Result<Vec<_>>>()?;
        let scene = PagedScene::new(Pager::start(files)?, most_bytes)?.lit_by(lights);
        Ok(Self { scene, still_px: None, is_coming: true, fault: None, faults: 0 })
    }

    /// With all of this beside the pages.
    ///
    /// # Errors
    /// As [`PagedScene::set_beside`].
    pub fn set_beside(&mut self, scene: PreparedScene) -> Result<()> {
        self.scene.set_beside(scene)
    }

    /// With pages of these files alone.
    pub fn show(&mut self, is_seen: &[bool]) {
        self.scene.show(is_seen);
        (self.still_px, self.is_coming) = (None, true);
    }

    /// Takes what has arrived; the settings with which each of these pictures can be drawn now, `None` where not even the coarsest pages are
    /// there. The last one is the picture at rest.
    ///
    /// # Errors
    /// As [`PagedScene::update`], but for pages that can't be read ([`Self::take_fault`]).
    pub fn update(
        &mut self,
        headless: &Headless,
        camera: &Camera,
        wanted: &[&Settings],
    ) -> Result<Vec<Option<Settings>>> {
        let drawn = self.take(headless, camera, wanted, false)?;
        self.is_coming = self.scene.is_coming();
        self.still_px = drawn.last().copied().flatten().map(|drawn| drawn.tau_px);
        let of = |(drawn, wanted): (Option<Drawn>, &&Settings)| Some(at(wanted, drawn?.tau_px));
        Ok(drawn.into_iter().zip(wanted).map(of).collect())
    }

    /// The settings for a picture with all that it wants, once that has come, or all that can: of what is at fault it is coarser; `None` where that is nothing.
    ///
    /// # Errors
    /// As [`PagedScene::update`].
    pub fn wait_for(
        &mut self,
        headless: &Headless,
        camera: &Camera,
        wanted: &Settings,
    ) -> Result<Option<Settings>> {
        loop {
            let drawn = self.take(headless, camera, &[wanted], true)?.into_iter().next().flatten();
            if drawn.is_some_and(|drawn| drawn.is_finest) || !self.scene.is_coming() {
                return Ok(drawn.map(|drawn| at(wanted, drawn.tau_px)));
            }
        }
    }

    /// Whether [`Self::update`] would find something new.
    pub fn has_arrived(&self) -> bool {
        self.scene.has_arrived()
    }

    /// The settings for a picture at rest with what is there now.
    pub fn now(&self, wanted: &Settings) -> Option<Settings> {
        Some(at(wanted, self.still_px?))
    }

    /// How many are there.
    pub fn pages(&self) -> usize {
        self.scene.pages()
    }

    /// What is wrong with the first page that can't be read, once.
    pub fn take_fault(&mut self) -> Option<Error> {
        self.fault.take()
    }

    /// The same in words, with what they take.
    pub fn words(&self) -> String {
        let mib = self.scene.bytes() as f64 / f64::from(1 << 20);
        let more = if self.is_coming { ", more to come" } else { "" };
        let faults = if self.faults > 0 { format!(", {} unreadable", self.faults) } else { String::new() };
        format!("{}, {mib:.1} MiB{more}{faults}", self.pages())
    }

    fn take(
        &mut self,
        headless: &Headless,
        camera: &Camera,
        wanted: &[&Settings],
        waits: bool,
    ) -> Result<Vec<Option<Drawn>>> {
        let view = |settings: &&Settings| {
            let view = PageView::new(camera, settings.size_px, settings.tau_px());
            view.with_blended(settings.blended_size())
        };
        let views: Vec<PageView> = wanted.iter().map(view).collect();
        loop {
            let updated = self.scene.update(&views, &mut |scene| headless.prepare(scene, &|_, _| {}), waits);
            match updated {
                // A page that can't be read does not come again: the picture goes on without it.
                Err(error) if matches!(error.kind(), ErrorKind::Input { .. } | ErrorKind::File { .. }) => {
                    self.faults += 1;
                    if self.faults == 1 {
                        self.fault = Some(error);
                    }
                }
                updated => return updated,
            }
        }
    }
}

fn at(settings: &Settings, tau_px: f64) -> Settings {
    Settings { lod: Lod::Px(tau_px), ..settings.clone() }
}
