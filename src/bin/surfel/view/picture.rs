//! A picture of a scene, drawn again and again for one use.

use std::time::{Duration, Instant};

use ash::vk;
use surfel::{
    Result,
    frame::{FrameSlot, Target},
    graph::{ImageState, execute::FrameProfile},
    vk::{Device, Image, ImageDesc},
};

use super::{frame_desc::SceneView, show::Shot};

/// What pictures are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Use {
    /// A scene that moves: as coarse as it must be.
    Moving,
    /// A scene at rest.
    Still,
    /// The same by another method.
    Other,
}

impl Use {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Moving, Self::Still, Self::Other];

    pub fn index(self) -> usize {
        self as usize
    }
}

/// A picture, and what is needed to draw it.
pub struct Picture {
    /// As many as are in flight: a moving picture is drawn while the one before still is.
    slots: [Slot; 2],
    next: usize,
    image: Option<Image>,
    is_drawn: bool,
    costs: Vec<Cost>,
}

/// What a frame has cost.
pub struct Cost {
    /// Seconds on the device; where it can't tell, from the recording to when the end was seen.
    pub secs: f64,
    /// Of its passes.
    pub profile: FrameProfile,
    /// Width and height.
    pub size_px: [u32; 2],
    /// From the input that it answers to when its end was seen.
    pub since_input: Option<Duration>,
}

struct Slot {
    slot: FrameSlot,
    /// The submission that uses it; 0 before the first.
    epoch: u64,
    begun: Option<Begun>,
}

/// A frame under way.
#[derive(Clone, Copy)]
pub struct Begun {
    /// When its recording began.
    pub at: Instant,
    /// The input that it answers to.
    pub input: Option<Instant>,
    /// Width and height.
    pub size_px: [u32; 2],
}

impl Picture {
    /// Not drawn yet.
    pub fn new(device: &Device) -> Self {
        let slots = [(); 2].map(|()| Slot { slot: FrameSlot::new(device), epoch: 0, begun: None });
        Self { slots, next: 0, image: None, is_drawn: false, costs: Vec::new() }
    }

    /// The submission that must be done before the next one is recorded.
    pub fn next_epoch(&self) -> u64 {
        self.slots[self.next].epoch
    }

    /// What the next one is recorded with.
    pub fn slot(&mut self) -> &mut FrameSlot {
        &mut self.slots[self.next].slot
    }

    /// What it is drawn to: an image that fragments sample afterwards.
    ///
    /// # Errors
    /// Whatever the driver or the allocator answers.
    pub fn target(&mut self, device: &Device, view: &SceneView<'_>) -> Result<Target> {
        let [width, height] = view.settings.size_px;
        let extent = vk::Extent2D { width, height };
        let format = if view.is_light { vk::Format::R16G16B16A16_SFLOAT } else { vk::Format::R8G8B8A8_SRGB };
        let kept = self.image.take().filter(|image| (image.extent(), image.format()) == (extent, format));
        self.is_drawn = false;
        let image = match kept {
            Some(image) => image,
            None => {
                let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::SAMPLED;
                Image::new(device, ImageDesc { name: "picture", format, extent, usage })?
            }
        };
        let sampled = ImageState {
            stages: vk::PipelineStageFlags2::FRAGMENT_SHADER,
            access: vk::AccessFlags2::SHADER_SAMPLED_READ,
            layout: vk::ImageLayout::READ_ONLY_OPTIMAL,
        };
        let target = Target {
            image: image.raw(),
            view: image.view(),
            format,
            extent,
            // The frame before may still sample it.
            initial: ImageState { layout: vk::ImageLayout::UNDEFINED, ..sampled },
            last: Some(sampled),
        };
        self.image = Some(image);
        Ok(target)
    }

    /// Its frame is recorded: commands behind it may sample the image.
    pub fn recorded(&mut self) {
        self.is_drawn = true;
    }

    /// What was recorded does not come.
    pub fn forget(&mut self) {
        self.is_drawn = false;
    }

    /// Its frame is submitted.
    pub fn submitted(&mut self, epoch: u64, begun: Begun) {
        let slot = &mut self.slots[self.next];
        (slot.epoch, slot.begun) = (epoch, Some(begun));
        self.next = (self.next + 1) % self.slots.len();
    }

    /// The image, once it was drawn.
    pub fn shot(&self) -> Option<Shot> {
        let image = self.image.as_ref().filter(|_| self.is_drawn)?;
        let vk::Extent2D { width, height } = image.extent();
        Some(Shot { view: image.view(), size_px: [width, height] })
    }

    /// Learns what frames have cost that are done; whether all of them are.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn collect(&mut self, is_done: impl Fn(u64) -> Result<bool>) -> Result<bool> {
        let mut all = true;
        for slot in &mut self.slots {
            let Some(begun) = slot.begun else { continue };
            if !is_done(slot.epoch)? {
                all = false;
                continue;
            }
            slot.begun = None;
            // SAFETY: its submission is done.
            let profile = slot.slot.profiler().map(|profiler| unsafe { profiler.read() }).transpose()?;
            let profile = profile.unwrap_or_default();
            let secs = profile.span_secs.unwrap_or_else(|| begun.at.elapsed().as_secs_f64());
            let since_input = begun.input.map(|input| input.elapsed());
            self.costs.push(Cost { secs, profile, size_px: begun.size_px, since_input });
        }
        Ok(all)
    }

    /// What frames have cost since this was asked for last.
    pub fn take_costs(&mut self) -> Vec<Cost> {
        std::mem::take(&mut self.costs)
    }

    /// Bytes of device memory in transients.
    pub fn transient_bytes(&self) -> u64 {
        self.slots.iter().map(|slot| slot.slot.transient_bytes()).sum()
    }
}
