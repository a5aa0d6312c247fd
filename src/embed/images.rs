//! What a view's passes leave for its draws.

use std::sync::Arc;

use ash::vk;

use crate::{
    error::{Error, Result},
    graph::{
        Block, ImageDesc as Wanted, ImageState, MemoryClass, MemoryNeed, ResourceDesc, Usage,
        execute::{Blocks, FRAMES_OF_LATE, memory_need, requirements},
    },
    passes::host::{OBJECTS_FORMAT, SURFACE_DEPTH_FORMAT},
    vk::{Device, Image, ImageDesc, Memory, MemoryNeeds, MemoryUse},
};

/// Kept from frame to frame: no memory is allocated as long as no frame is larger than those before.
#[derive(Default)]
pub(super) struct Images {
    surface: Sizes,
    depth: Sizes,
    layers: Sizes,
    objects: Sizes,
    frames: u64,
}

/// Those of one frame.
pub(super) struct OfFrame<'a> {
    /// The opaque surface: linear light, straight alpha.
    pub surface: &'a Image,
    /// Its own depth.
    pub depth: &'a Image,
    /// Transparent layers alike, where there are any.
    pub layers: Option<&'a Image>,
    /// Whose the opaque surface is, where the host asks for it.
    pub objects: Option<&'a Image>,
}

/// Images for one purpose, one for each size that the view had of late, all in one place of memory: each frame writes its own anew.
#[derive(Default)]
struct Sizes {
    /// The one that was used last is the first.
    placed: Vec<Placed>,
    blocks: Blocks,
}

struct Placed {
    extent: vk::Extent2D,
    format: vk::Format,
    block: [Block; 1],
    // Dropped, and so destroyed, before the memory that it is bound to.
    image: Option<Image>,
    memory: Vec<Arc<Memory>>,
}

/// Sizes of which images are kept at most.
const MOST_SIZES: usize = 8;

/// The draws of the frame before read them; they write nothing that has to be seen.
pub(super) const BEFORE: ImageState = ImageState {
    stages: vk::PipelineStageFlags2::FRAGMENT_SHADER,
    access: vk::AccessFlags2::SHADER_SAMPLED_READ,
    layout: vk::ImageLayout::UNDEFINED,
};

/// Draws read them.
pub(super) const AFTER: ImageState = ImageState { layout: vk::ImageLayout::READ_ONLY_OPTIMAL, ..BEFORE };

impl Images {
    /// Bytes of device memory.
    pub fn bytes(&self) -> u64 {
        [&self.surface, &self.depth, &self.layers, &self.objects]
            .map(|sizes| sizes.blocks.bytes())
            .iter()
            .sum()
    }

    /// Adds what memory the first ones of a view will ask for to what is needed.
    ///
    /// # Errors
    /// As [`memory_need`].
    pub fn tell(
        device: &Device,
        of: (vk::Format, [u32; 2]),
        (layers, objects): (bool, bool),
        needs: &mut MemoryNeeds,
    ) -> Result<()> {
        let wanted = [layers, objects, true, true];
        for (desc, _) in descs(of.0, of.1).into_iter().zip(wanted).filter(|(_, wanted)| *wanted) {
            let block = Placed::new(device, desc)?.block[0];
            needs.piece(desc.name, requirements(&block), (MemoryUse::Device, false));
        }
        Ok(())
    }

    /// Those of a frame, the ones there are where they will do.
    ///
    /// # Errors
    /// Whatever the allocator or the driver answers.
    pub fn fit(
        &mut self,
        device: &Device,
        (format, size_px): (vk::Format, [u32; 2]),
        (layers, objects): (bool, bool),
    ) -> Result<OfFrame<'_>> {
        self.frames += 1;
        if self.frames.is_multiple_of(FRAMES_OF_LATE) {
            let all = [&mut self.surface, &mut self.depth, &mut self.layers, &mut self.objects];
            all.into_iter().for_each(Sizes::give_back);
        }
        let [of_layers, of_objects, of_surface, of_depth] = descs(format, size_px);
        let Self { surface, depth, layers: in_layers, objects: in_objects, .. } = self;
        let layers = layers.then(|| in_layers.fit(device, of_layers));
        let objects = objects.then(|| in_objects.fit(device, of_objects));
        Ok(OfFrame {
            surface: surface.fit(device, of_surface)?,
            depth: depth.fit(device, of_depth)?,
            layers: layers.transpose()?,
            objects: objects.transpose()?,
        })
    }
}

/// Those of layers, of objects, of the surface and of its depth.
fn descs(format: vk::Format, [width, height]: [u32; 2]) -> [ImageDesc<'static>; 4] {
    let extent = vk::Extent2D { width, height };
    let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::SAMPLED;
    let desc = |name, format| ImageDesc { name, format, extent, usage };
    [
        desc("layers for a host", format),
        desc("objects for a host", OBJECTS_FORMAT),
        desc("surface for a host", format),
        desc("its depth", SURFACE_DEPTH_FORMAT),
    ]
}

impl Sizes {
    fn fit(&mut self, device: &Device, desc: ImageDesc<'_>) -> Result<&Image> {
        let fits = |placed: &Placed| placed.extent == desc.extent && placed.format == desc.format;
        match self.placed.iter().position(fits) {
            Some(place) => self.placed[..=place].rotate_right(1),
            None => {
                self.placed.truncate(MOST_SIZES - 1);
                self.placed.insert(0, Placed::new(device, desc)?);
            }
        }
        // What is refused finds all memory idle next time.
        self.settle(device, desc).inspect_err(|_| *self = Self::default())?;
        let Some(Placed { image: Some(image), block, memory, .. }) = self.placed.first() else {
            return Err(Error::option(desc.name, "has no image"));
        };
        self.blocks.note(block, memory);
        Ok(image)
    }

    /// Puts the first image in place. Others whose memory had to grow for that leave it, and are placed when they are wanted next.
    fn settle(&mut self, device: &Device, desc: ImageDesc<'_>) -> Result<()> {
        let Self { placed, blocks } = self;
        let Some((Placed { image: image @ None, block, memory, .. }, others)) = placed.split_first_mut()
        else {
            return Ok(());
        };
        blocks.serve(device, |_| desc.name, block, memory)?;
        *image = Some(Image::placed(device, desc, &memory[0], 0)?);
        for other in others.iter_mut().filter(|other| !blocks.have(&other.memory)) {
            other.image = None;
            other.memory.clear();
        }
        Ok(())
    }

    /// Drops images of which the memory was given back: they would hold it.
    fn give_back(&mut self) {
        let Self { placed, blocks } = self;
        blocks.give_back();
        placed.retain(|placed| placed.image.is_some() && blocks.have(&placed.memory));
    }
}

impl Placed {
    /// An image that is in no place yet.
    fn new(device: &Device, desc: ImageDesc<'_>) -> Result<Self> {
        let ImageDesc { format, extent, usage, .. } = desc;
        let wanted = ResourceDesc::Image(Wanted { format, extent });
        let MemoryNeed { size_bytes, alignment_bytes, type_bits } =
            memory_need(device, &wanted, Usage::Image(usage))?;
        let block = [Block { class: MemoryClass::Images, size_bytes, alignment_bytes, type_bits }];
        Ok(Self { extent, format, block, image: None, memory: Vec::new() })
    }
}
