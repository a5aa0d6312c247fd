//! What a window's device tells, and is told, between frames.

use std::time::Duration;

#[cfg(feature = "live-shaders")]
use ash::vk;
use surfel::Result;

use super::{
    super::{
        frame_desc::SceneView,
        memory,
        overlay::OverlayBuffers,
        picture::{Cost, Picture, Use},
    },
    Gpu,
};

/// So long pipelines are made before events are heard again.
const TURN: Duration = Duration::from_millis(100);

/// Those of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pipelines {
    /// All are there.
    pub are_made: bool,
    /// Those that are there have run, here or on another device.
    pub have_run: bool,
}

impl Gpu {
    /// The atlas of letters changes.
    ///
    /// # Errors
    /// As [`Self::draw`].
    pub fn update_overlay(&mut self, delta: &egui::TexturesDelta) -> Result<()> {
        self.make_images()?;
        if let Some(drawing) = &mut self.drawing {
            drawing.overlay.update(delta);
        }
        Ok(())
    }

    /// What frames for a use have cost since this was asked for last, and whether that is all of them.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn take_costs(&mut self, which: Use) -> Result<(Vec<Cost>, bool)> {
        let (queue, picture) = (self.headless.queue(), &mut self.pictures[which.index()]);
        let all = picture.collect(|epoch| queue.is_done(epoch))?;
        Ok((picture.take_costs(), all))
    }

    /// Whether all frames are done.
    ///
    /// # Errors
    /// Whatever the driver answers, such as a lost device.
    pub fn is_idle(&self) -> Result<bool> {
        let last = self.frames.iter().map(|frame| frame.epoch).max();
        self.headless.queue().is_done(last.unwrap_or(0))
    }

    /// How many of the pictures of the last frame are whole; the one behind them is drawn in steps.
    pub fn finished(&self) -> usize {
        self.finished
    }

    /// Whether there is one for a use, drawn before.
    pub fn has_picture(&self, which: Use) -> bool {
        self.pictures[which.index()].shot().is_some()
    }

    /// Makes some of the pipelines that these pictures need and that are not there yet.
    ///
    /// # Errors
    /// As [`surfel::Renderer::make_pipelines`].
    pub fn make_pipelines(&self, views: &[(Use, SceneView<'_>)]) -> Result<Pipelines> {
        let renderer = &self.headless.renderer;
        let time = renderer.shaders().time();
        let mut are_made = true;
        for (_, view) in views {
            are_made = are_made && renderer.make_pipelines(view.seen, view.format(), TURN)?;
        }
        Ok(Pipelines { are_made, have_run: renderer.shaders().have_run_since(time) })
    }

    /// Bytes of device memory in transients of all pictures.
    pub fn transient_bytes(&self) -> u64 {
        self.pictures.iter().map(Picture::transient_bytes).sum()
    }

    /// The time from frame to frame, where the host waited for the device or the window system.
    pub fn take_period(&mut self) -> Option<Duration> {
        self.period.take()
    }

    /// Gives back what is of no use before the next frame, while the device has nothing to do and no picture is drawn in steps. `is_comparing`: the picture by another method is of use.
    /// `for_long`: what the allocator keeps is given back, too, which takes a tenth of a second where a driver has compiled much: not where a hand only pauses.
    ///
    /// # Errors
    /// Whatever the driver answers, such as a lost device.
    pub fn tidy(&mut self, is_comparing: bool, for_long: bool) -> Result<()> {
        for picture in &mut self.pictures {
            picture.stop();
            picture.give_back_excess();
        }
        let other = &mut self.pictures[Use::Other.index()];
        if !is_comparing && other.is_of_use() {
            *other = Picture::new(self.headless.device());
        }
        // SAFETY: nothing is being recorded now.
        unsafe { self.headless.queue().wait_idle() }?;
        if for_long {
            self.dropped = 0;
            memory::give_back();
        }
        Ok(())
    }

    /// Gives back all that pictures were drawn in, and the images that are not shown, while the device has nothing to do; [`Self::tidy`] comes next. `shown`: the picture that is.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn forget_frames(&mut self, shown: Use) -> Result<()> {
        self.headless.forget_frames()?;
        let device = self.headless.device();
        for which in Use::ALL {
            // The picture by another method may be shown beside it.
            let is_shown = which == shown || which == Use::Other;
            self.pictures[which.index()].forget_frames(device, is_shown)?;
        }
        // Their room is that of the most that lay over a picture so far.
        self.frames.iter_mut().for_each(|frame| frame.overlay = OverlayBuffers::default());
        Ok(())
    }

    /// Has all pipelines made again: their shaders have changed.
    #[cfg(feature = "live-shaders")]
    pub fn forget_pipelines(&mut self) {
        // SAFETY: this thread alone records, and has submitted what it recorded.
        unsafe { self.headless.renderer.shaders().keep_newest(0) };
        // Of other shaders.
        self.pictures.iter_mut().for_each(Picture::stop);
        if let Some(drawing) = &mut self.drawing {
            // Of no window, so that they are made for this one.
            drawing.format = vk::Format::UNDEFINED;
            self.fits = false;
        }
    }
}
