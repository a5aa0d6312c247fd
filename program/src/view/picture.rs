//! A picture of a scene, drawn again and again for one use.

mod cost;

pub use cost::{Begun, Cost};

use ash::vk;
use surfel::{
    Result,
    frame::{FrameSlot, Target},
    graph::{
        ImageState,
        execute::{FrameProfile, Profile},
    },
    renderer::SampleSum,
    scene::{Camera, Settings},
    vk::{Device, Image, ImageDesc},
};

use super::{
    frame_desc::{Ends, SceneView},
    show::Shot,
};

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
    /// What is drawn in steps and is not whole yet, and its image, where that is not the one that is shown.
    under_way: Option<UnderWay>,
    making: Option<Image>,
    /// The sum of samples, until the last one is drawn.
    sum: Option<Image>,
    costs: Vec<Cost>,
}

struct Slot {
    slot: FrameSlot,
    /// The submission that uses it; 0 before the first.
    epoch: u64,
    begun: Option<Begun>,
}

/// A picture of which some steps are drawn.
struct UnderWay {
    of: Inputs,
    next: usize,
}

/// All that a picture depends on.
#[derive(PartialEq)]
struct Inputs {
    camera: Camera,
    settings: Settings,
    is_light: bool,
    sample: Option<Ends>,
    scene_number: u64,
    profile: Option<Profile>,
}

impl Inputs {
    fn of(view: &SceneView<'_>) -> Self {
        let SceneView { seen, is_light, sample, scene_number, profile } = *view;
        let (camera, settings) = (*seen.camera, seen.settings.clone());
        Self { camera, settings, is_light, sample, scene_number, profile }
    }
}

impl Picture {
    /// Not drawn yet.
    pub fn new(device: &Device) -> Self {
        let slots = [(); 2].map(|()| Slot { slot: FrameSlot::new(device), epoch: 0, begun: None });
        Self {
            slots,
            next: 0,
            image: None,
            is_drawn: false,
            under_way: None,
            making: None,
            sum: None,
            costs: Vec::new(),
        }
    }

    /// The pass with which the next step of a picture begins: 0, or where the one before of the same picture ended.
    pub fn first_pass(&mut self, view: &SceneView<'_>) -> usize {
        if let Some(under_way) = self.under_way.as_ref().filter(|under_way| under_way.of == Inputs::of(view))
        {
            return under_way.next;
        }
        (self.under_way, self.making) = (None, None);
        0
    }

    /// The submission that must be done before the next one is recorded.
    pub fn next_epoch(&self) -> u64 {
        self.slots[self.next].epoch
    }

    /// What the next one is recorded with.
    pub fn slot(&mut self) -> &mut FrameSlot {
        &mut self.slots[self.next].slot
    }

    /// What it is drawn to: an image that fragments sample afterwards. `aside`: another one than that which is shown, which stays until the picture is whole.
    ///
    /// # Errors
    /// Whatever the driver or the allocator answers.
    pub fn target(&mut self, device: &Device, view: &SceneView<'_>, aside: bool) -> Result<Target> {
        let [width, height] = view.seen.settings.size_px;
        let extent = vk::Extent2D { width, height };
        let format = view.format();
        let is_under_way = self.under_way.is_some();
        let aside = if is_under_way { self.making.is_some() } else { aside && view.shows() };
        let place = if aside { &mut self.making } else { &mut self.image };
        let kept = place.take().filter(|image| (image.extent(), image.format()) == (extent, format));
        if !aside {
            // Of several samples, the last one draws to it.
            self.is_drawn &= kept.is_some() && !view.shows();
        }
        let image = match kept {
            Some(image) => image,
            None => image_of(device, "picture", format, extent)?,
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
        *place = Some(image);
        Ok(target)
    }

    /// Where samples are added up, for a view that is one of them.
    ///
    /// # Errors
    /// Whatever the driver or the allocator answers.
    pub fn sum(&mut self, device: &Device, view: &SceneView<'_>) -> Result<Option<SampleSum>> {
        let Some(Ends { first, last }) = view.sample else { return Ok(None) };
        let [width, height] = view.seen.settings.size_px;
        let extent = vk::Extent2D { width, height };
        let kept = self.sum.take().filter(|image| image.extent() == extent);
        let image = match kept {
            Some(image) => image,
            None => image_of(device, "sum of samples", vk::Format::R32G32B32A32_SFLOAT, extent)?,
        };
        let sum = SampleSum { image: image.raw(), view: image.view(), first, last };
        self.sum = Some(image);
        Ok(Some(sum))
    }

    /// Its frame is recorded, or a step of it: commands behind it may sample the image, if it is drawn. `next`: the pass with which the next step begins, if there is one.
    pub fn recorded(&mut self, view: &SceneView<'_>, next: Option<usize>) {
        self.under_way = next.map(|next| UnderWay { of: Inputs::of(view), next });
        if next.is_none() && view.shows() {
            // What is dropped waits for the frame.
            if let Some(image) = self.making.take() {
                self.image = Some(image);
            }
            (self.is_drawn, self.sum) = (true, None);
        }
    }

    /// Whether anything was drawn to it.
    pub fn is_of_use(&self) -> bool {
        self.slots.iter().any(|slot| slot.epoch > 0)
    }

    /// Whether it is drawn in steps, of which some are to come.
    pub fn is_under_way(&self) -> bool {
        self.under_way.is_some()
    }

    /// Gives back memory that pictures of before have needed.
    pub fn give_back_excess(&mut self) {
        self.slots.iter_mut().for_each(|slot| slot.slot.give_back_excess());
    }

    /// Gives back all that frames are drawn in, and the image, but where it is shown. What frames have cost stays to be taken.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn forget_frames(&mut self, device: &Device, is_shown: bool) -> Result<()> {
        self.collect(|_| Ok(true))?;
        let costs = self.take_costs();
        let (image, is_drawn) = (self.image.take().filter(|_| is_shown), self.is_drawn && is_shown);
        *self = Self { image, is_drawn, costs, ..Self::new(device) };
        Ok(())
    }

    /// What is drawn in steps begins anew, if it is drawn at all.
    pub fn stop(&mut self) {
        (self.under_way, self.making) = (None, None);
    }

    /// What was recorded does not come.
    pub fn forget(&mut self) {
        (self.is_drawn, self.sum) = (false, None);
        (self.under_way, self.making) = (None, None);
    }

    /// Its frame is submitted, or a step of it.
    pub fn submitted(&mut self, epoch: u64, begun: Begun) {
        let slot = &mut self.slots[self.next];
        (slot.epoch, slot.begun) = (epoch, Some(begun));
        if self.under_way.is_none() {
            self.next = (self.next + 1) % self.slots.len();
        }
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
            let span_secs = profile.span_secs.filter(|_| !begun.is_step);
            let secs = span_secs.unwrap_or_else(|| begun.at.elapsed().as_secs_f64());
            let since_input = begun.input.map(|input| input.elapsed());
            let Begun { size_px, what, compiles, unknown, .. } = begun;
            let profile = if begun.is_step { FrameProfile::default() } else { profile };
            self.costs.push(Cost { secs, profile, size_px, compiles, unknown, what, since_input });
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

fn image_of(device: &Device, name: &str, format: vk::Format, extent: vk::Extent2D) -> Result<Image> {
    let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::SAMPLED;
    Image::new(device, ImageDesc { name, format, extent, usage })
}
