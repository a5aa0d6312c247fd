//! The picture at rest, step by step: levels of detail of a pixel where all of it takes long, all of it, and samples until it is the one that `surfel render` writes. Each step is a frame, drawn
//! while the device has nothing else to do, so that what moves meanwhile waits for one at most.

use std::time::{Duration, Instant};

use surfel::{
    Result,
    scene::{Camera, Edges, Lod, Samples, Settings},
};

use super::{frame_desc::Ends, told::Step, viewer::Viewer};
use crate::picture::{samples_unsaid, smoothed};

/// How soon the device is looked at again.
const LOOK: Duration = Duration::from_millis(5);

/// Splats up to this size are drawn as one at first: less than the filter spreads what it sees. On lavapipe 1.4 million splats at 1024x1024 take less than half the time
/// so; at 1 pixel, where most of them are splats of the scene itself, 5 to 15% less.
pub const LEVELED_PX: f64 = 1.25;

/// A step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refinement {
    /// By levels of detail of [`LEVELED_PX`].
    Leveled,
    /// All of it.
    Whole,
    /// One of so many samples, which have such edges.
    Sample(usize, Samples, Edges),
}

/// The steps of a picture; of one sample that is the whole itself.
fn steps(is_leveled: bool, samples: Samples, edges: Edges) -> impl Iterator<Item = Refinement> {
    let several = if samples.0 > 1 { samples.0 as usize } else { 0 };
    let leveled = is_leveled.then_some(Refinement::Leveled);
    leveled
        .into_iter()
        .chain([Refinement::Whole])
        .chain((0..several).map(move |i| Refinement::Sample(i, samples, edges)))
}

impl Refinement {
    /// In a word.
    pub fn what(self) -> &'static str {
        match self {
            Self::Leveled => "leveled",
            Self::Whole => "whole",
            Self::Sample(..) => "sample",
        }
    }

    /// How it is drawn, of how the whole is; and which of several samples it is.
    pub fn of(self, camera: Camera, whole: &Settings) -> (Camera, Settings, Option<Ends>) {
        match self {
            Self::Leveled => (camera, Settings { lod: Lod::Px(LEVELED_PX), ..whole.clone() }, None),
            Self::Whole => (camera, whole.clone(), None),
            Self::Sample(number, samples, edges) => {
                let offsets_px = samples.offsets_px(whole.kernel);
                let ends = Ends { first: number == 0, last: number + 1 == offsets_px.len() };
                let camera = offsets_px.get(number).map_or(camera, |offset_px| camera.sample(*offset_px));
                (camera, Settings { samples, edges, ..whole.clone() }, Some(ends))
            }
        }
    }
}

impl Viewer {
    /// These settings with as many samples as a pixel of the picture has, as `surfel render` would draw it.
    pub fn sampled(&self, settings: &Settings) -> Settings {
        let said = Settings { samples: self.samples, ..settings.clone() };
        let (Some(document), Some(prepared), Some(camera), false) =
            (&self.document, &self.prepared, self.camera(), self.options.says_samples)
        else {
            return said;
        };
        let renderer = &self.gpu.headless.renderer;
        let samples = samples_unsaid(&said, &document.scene, renderer);
        smoothed(Settings { samples, ..said }, (prepared.scene(), &camera), renderer)
    }

    /// The next step to the picture at rest, if there is one. `whole`: how all of it is drawn.
    pub fn next_refinement(&self, whole: &Settings) -> Option<Refinement> {
        let is_leveled = self.has_leveled(whole) && self.is_hasty;
        let of = |samples, edges| steps(is_leveled, samples, edges).nth(self.refined);
        // How many samples there are takes the plan of a frame, which the steps before them do without.
        of(Samples(1), whole.edges).or_else(|| {
            // Two pictures are compared as they are.
            let sampled = self.comparing.is_none().then(|| self.sampled(whole))?;
            of(sampled.samples, sampled.edges)
        })
    }

    /// Has the device count the splats that the picture at rest is made of, for the panel; 0 where a method does not list them.
    ///
    /// # Errors
    /// As [`surfel::Headless::begin_count`].
    pub fn count_drawn(&mut self) -> Result<()> {
        let settings = self.at_rest(&Settings { size_px: self.window_px(), ..self.settings.clone() });
        let (Some(camera), Some(prepared)) = (self.camera(), &self.prepared) else { return Ok(()) };
        let settings = prepared.pages().map_or(Some(settings.clone()), |pages| pages.now(&settings));
        let Some(settings) = settings else { return Ok(()) };
        self.counting = Some(self.gpu.headless.begin_count(prepared.scene(), &camera, &settings)?);
        Ok(())
    }

    /// Takes their number, once the device has counted them.
    ///
    /// # Errors
    /// Of the device.
    pub fn hear_count(&mut self) -> Result<()> {
        let Some(counting) = &self.counting else { return Ok(()) };
        let drawn = counting.listed(self.gpu.headless.queue())?;
        if drawn.is_some() {
            (self.splats_drawn, self.counting) = (drawn, None);
            self.window.request_redraw();
        }
        Ok(())
    }

    /// A step is drawn: the next one comes once the device is done with it.
    pub fn refine(&mut self, whole: &Settings) {
        self.refined += 1;
        let now = Instant::now();
        self.refines = if self.next_refinement(whole).is_some() {
            Some(now + LOOK)
        } else {
            self.next_hidden(whole).map(|_| self.hidden_from(now))
        };
    }

    /// Whether levels of detail may come before all of it.
    pub fn has_leveled(&self, whole: &Settings) -> bool {
        let has_levels = self.prepared.as_ref().is_some_and(|prepared| prepared.step() == Step::Leveled);
        has_levels && self.settings.lod == Lod::Auto && whole.lod != Lod::Auto && self.comparing.is_none()
    }

    /// Whether that is so now; looked at again where it is not.
    ///
    /// # Errors
    /// Of the device.
    pub fn can_refine(&mut self) -> Result<bool> {
        let now = Instant::now();
        let is_due = self.refines.is_some_and(|when| now >= when);
        let can = is_due && self.gpu.is_idle()?;
        if is_due && !can {
            self.refines = Some(now + LOOK);
        }
        Ok(can)
    }
}

#[cfg(test)]
mod tests {
    use surfel::scene::Kernel;

    use super::*;

    #[test]
    fn steps_end_with_the_picture_that_render_writes() {
        let all = |is_leveled, samples| steps(is_leveled, Samples(samples), Edges::Hard).collect::<Vec<_>>();
        assert_eq!(all(false, 1), [Refinement::Whole]);
        assert_eq!(all(true, 1), [Refinement::Leveled, Refinement::Whole]);
        let several = all(false, 8);
        assert_eq!((several.len(), several[8]), (9, Refinement::Sample(7, Samples(8), Edges::Hard)));
        let (camera, whole) = (Camera::default(), Settings::default());
        let offsets_px = Samples(8).offsets_px(Kernel::default());
        for (number, offset_px) in offsets_px.iter().enumerate() {
            let (seen, settings, ends) = several[1 + number].of(camera, &whole);
            assert_eq!(
                (seen, settings.samples, settings.edges),
                (camera.sample(*offset_px), Samples(8), Edges::Hard)
            );
            assert_eq!(ends, Some(Ends { first: number == 0, last: number == 7 }));
        }
    }
}
