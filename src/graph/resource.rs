//! What passes work on: images and buffers, transient or imported, and the handles that name them.

use std::marker::PhantomData;

use ash::vk;

/// Names one resource of one graph; an index into [`super::Plan::resources`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ResourceId(pub(super) u32);

impl ResourceId {
    /// The index into [`super::Plan::resources`].
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Marks handles of images.
#[derive(Debug)]
pub enum Image {}

/// Marks handles of buffers.
#[derive(Debug)]
pub enum Buffer {}

/// The one name under which passes declare a resource: what is in it after all the passes declared so far. It can't
/// be cloned, and a write takes it by `&mut`, so that a content that was overwritten has no name any more.
#[derive(Debug)]
pub struct Handle<Kind> {
    pub(super) graph: u64,
    pub(super) id: ResourceId,
    /// How many writes were declared with it.
    pub(super) version: u32,
    pub(super) kind: PhantomData<Kind>,
}

impl<Kind> Handle<Kind> {
    /// Where the resource is found when the plan is executed.
    pub fn id(&self) -> ResourceId {
        self.id
    }
}

/// A 2D image of one mip level, one layer and one sample a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImageDesc {
    /// The format; any but `UNDEFINED`.
    pub format: vk::Format,
    /// Width and height in pixels, each above 0.
    pub extent: vk::Extent2D,
}

/// A buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BufferDesc {
    /// Its size in bytes, above 0.
    pub size_bytes: u64,
    /// The format of its texels, where it is read by them; else `UNDEFINED`, the default.
    pub texels: vk::Format,
}

impl BufferDesc {
    /// A buffer of so many bytes that is not read by texels.
    pub fn of_bytes(size_bytes: u64) -> Self {
        Self { size_bytes, ..Self::default() }
    }
}

/// What kind of resource, and its dimensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResourceDesc {
    /// An image.
    Image(ImageDesc),
    /// A buffer.
    Buffer(BufferDesc),
}

/// What was, or shall be, done with an imported image outside the graph.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ImageState {
    /// As in [`State::stages`].
    pub stages: vk::PipelineStageFlags2,
    /// As in [`State::access`].
    pub access: vk::AccessFlags2,
    /// The layout; initially `UNDEFINED` for an image without content.
    pub layout: vk::ImageLayout,
}

impl ImageState {
    /// It is drawn to as an attachment of colors, and blended in.
    pub const COLOR_ATTACHMENT: Self = Self {
        stages: vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT,
        access: vk::AccessFlags2::from_raw(
            vk::AccessFlags2::COLOR_ATTACHMENT_READ.as_raw()
                | vk::AccessFlags2::COLOR_ATTACHMENT_WRITE.as_raw(),
        ),
        layout: vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL,
    };

    /// It is tested and written as an attachment of depth.
    pub const DEPTH_ATTACHMENT: Self = Self {
        stages: vk::PipelineStageFlags2::from_raw(
            vk::PipelineStageFlags2::EARLY_FRAGMENT_TESTS.as_raw()
                | vk::PipelineStageFlags2::LATE_FRAGMENT_TESTS.as_raw(),
        ),
        access: vk::AccessFlags2::from_raw(
            vk::AccessFlags2::DEPTH_STENCIL_ATTACHMENT_READ.as_raw()
                | vk::AccessFlags2::DEPTH_STENCIL_ATTACHMENT_WRITE.as_raw(),
        ),
        layout: vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
    };
}

/// What was, or shall be, done with an imported buffer outside the graph.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BufferState {
    /// As in [`State::stages`].
    pub stages: vk::PipelineStageFlags2,
    /// As in [`State::access`].
    pub access: vk::AccessFlags2,
}

/// What is done with an imported resource outside the graph, just before or just after it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct State {
    /// The stages that access it. None, initially: nothing is under way, and what was written is visible to all
    /// (written by the host before submission, or a fence was waited on). None, finally: nobody on this queue
    /// waits, as before a present or a release by semaphore.
    pub stages: vk::PipelineStageFlags2,
    /// How they access it. With only reads (or nothing), initially: what was written before is visible to them.
    pub access: vk::AccessFlags2,
    /// The layout of an image; `UNDEFINED` for a buffer.
    pub layout: vk::ImageLayout,
}

impl From<ImageState> for State {
    fn from(ImageState { stages, access, layout }: ImageState) -> Self {
        Self { stages, access, layout }
    }
}

impl From<BufferState> for State {
    fn from(BufferState { stages, access }: BufferState) -> Self {
        Self { stages, access, layout: vk::ImageLayout::UNDEFINED }
    }
}

/// Where a resource comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// It lives inside one execution of the plan: without content at its start, lost at its end.
    Transient,
    /// It is the caller's, who gives the physical object when the plan is executed.
    Imported {
        /// Its state at the start of every execution.
        initial: State,
        /// The state in which the plan leaves it; `None` as its last pass leaves it.
        final_: Option<State>,
    },
}

/// What an attachment is cleared to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ClearValue {
    /// A color: red, green, blue, alpha, in the linear values of the attachment.
    Color([f32; 4]),
    /// A depth, 0–1.
    Depth(f32),
}

impl From<ClearValue> for vk::ClearValue {
    fn from(value: ClearValue) -> Self {
        match value {
            ClearValue::Color(float32) => Self { color: vk::ClearColorValue { float32 } },
            ClearValue::Depth(depth) => {
                Self { depth_stencil: vk::ClearDepthStencilValue { depth, stencil: 0 } }
            }
        }
    }
}

/// All aspects of a format: what a barrier has to name.
pub fn aspect_of(format: vk::Format) -> vk::ImageAspectFlags {
    use vk::{Format as F, ImageAspectFlags as A};
    match format {
        F::D16_UNORM | F::X8_D24_UNORM_PACK32 | F::D32_SFLOAT => A::DEPTH,
        F::D16_UNORM_S8_UINT | F::D24_UNORM_S8_UINT | F::D32_SFLOAT_S8_UINT => A::DEPTH | A::STENCIL,
        F::S8_UINT => A::STENCIL,
        _ => A::COLOR,
    }
}
