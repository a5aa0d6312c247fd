//! What of a scene is on the device: all of it, or pages of a file that come and go as the camera moves.

use surfel::{
    Headless, Result,
    levels_file::{LevelsFile, PageView, Pager},
    prepare::PreparedScene,
    renderer::{Drawn, PagedScene},
    scene::{Camera, Light, Lod, Settings},
};

use super::loading::Step;

/// A scene on the device.
pub enum OnDevice {
    /// What was read at once, and how much of it that is.
    Whole(PreparedScene, Step),
    /// Pages.
    Paged(Box<Paged>),
}

/// Pages of a file.
pub struct Paged {
    scene: PagedScene,
    /// The size for a picture at rest with what is there.
    still_px: Option<f64>,
    /// More is to come.
    pub is_coming: bool,
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

    /// The pages, if it is a file of them.
    pub fn pages(&self) -> Option<&Paged> {
        match self {
            Self::Whole(..) => None,
            Self::Paged(paged) => Some(paged),
        }
    }
}

impl Paged {
    /// Nothing of a file yet, within so many bytes of device memory.
    ///
    /// # Errors
    /// As [`Pager::start`] and [`PagedScene::new`].
    pub fn new(file: LevelsFile, most_bytes: u64, lights: Vec<Light>) -> Result<Self> {
        let scene = PagedScene::new(Pager::start(file)?, most_bytes)?.lit_by(lights);
        Ok(Self { scene, still_px: None, is_coming: true })
    }

    /// Takes what has arrived; the settings with which each of these pictures can be drawn now, `None` where not even the coarsest pages are
    /// there. The last one is the picture at rest.
    ///
    /// # Errors
    /// As [`PagedScene::update`].
    pub fn update(
        &mut self,
        headless: &Headless,
        camera: &Camera,
        wanted: &[&Settings],
    ) -> Result<Vec<Option<Settings>>> {
        let drawn = self.take(headless, camera, wanted, false)?;
        self.is_coming = drawn.iter().any(|drawn| drawn.is_none_or(|drawn| !drawn.is_finest));
        self.still_px = drawn.last().copied().flatten().map(|drawn| drawn.tau_px);
        let of = |(drawn, wanted): (Option<Drawn>, &&Settings)| Some(at(wanted, drawn?.tau_px));
        Ok(drawn.into_iter().zip(wanted).map(of).collect())
    }

    /// The settings for a picture with all that it wants, once that has come.
    ///
    /// # Errors
    /// As [`PagedScene::update`].
    pub fn wait_for(&mut self, headless: &Headless, camera: &Camera, wanted: &Settings) -> Result<Settings> {
        loop {
            if let [Some(drawn)] = self.take(headless, camera, &[wanted], true)?[..]
                && drawn.is_finest
            {
                return Ok(at(wanted, drawn.tau_px));
            }
        }
    }

    /// The settings for a picture at rest with what is there now.
    pub fn now(&self, wanted: &Settings) -> Option<Settings> {
        Some(at(wanted, self.still_px?))
    }

    /// How many are there.
    pub fn pages(&self) -> usize {
        self.scene.pages()
    }

    /// The same in words, with what they take.
    pub fn words(&self) -> String {
        let mib = self.scene.bytes() as f64 / f64::from(1 << 20);
        let more = if self.is_coming { ", more to come" } else { "" };
        format!("{}, {mib:.1} MiB{more}", self.pages())
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
        self.scene.update(&views, &mut |scene| headless.prepare(scene, &|_, _| {}), waits)
    }
}

fn at(settings: &Settings, tau_px: f64) -> Settings {
    Settings { lod: Lod::Px(tau_px), ..settings.clone() }
}
