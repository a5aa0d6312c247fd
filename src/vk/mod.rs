//! Vulkan 1.3 with owners: one kind of object a file, each named, each destroyed after its last use on the device.
//!
//! Every object holds the [`Device`] it was made by, so that dropping them in any order is sound. A drop never
//! destroys at once: it hands the raw handle to the device's [deferred destruction](Device::epoch_done), because a
//! command buffer may still use it. Instance and device are either owned or borrowed from an embedding host; all
//! else works on both alike.

mod allow_list;
mod budget;
mod buffer;
mod choose;
mod commands;
mod compute_pipeline;
mod copies;
mod descriptor;
mod descriptor_pool;
mod descriptors;
mod device;
mod executables;
mod facts;
mod features;
mod formats;
mod garbage;
mod graphics_pipeline;
mod host_memory;
mod host_timeline;
mod image;
mod import;
mod instance;
mod labels;
mod layout;
mod loader;
mod memory;
mod memory_needs;
mod messages;
mod owned;
mod pipeline_cache;
mod pool_sizes;
mod queries;
mod queue;
mod requirements;
mod result;
mod sampler;
#[cfg(feature = "view")]
mod semaphore;
mod stage_limits;
mod staging;
mod staging_ring;
mod stand_ins;
#[cfg(feature = "view")]
mod surface;
#[cfg(feature = "view")]
mod swapchain;
mod uploads;
mod validation;
mod wanted;

pub use allow_list::{ALLOWED, Allowed};
pub use budget::{MemoryHeap, MemoryHeaps, MemoryInUse};
pub(crate) use buffer::texel_bytes;
pub use buffer::{Buffer, BufferDesc};
pub use choose::{DeviceFacts, DeviceKind, Limits, choose};
pub use commands::CommandPool;
pub use compute_pipeline::{ComputePipeline, ComputePipelineDesc};
pub(crate) use copies::Copies;
pub use descriptor::Descriptor;
pub use descriptor_pool::{DescriptorPool, SealedPool};
pub use descriptors::{Binding, SetLayout};
pub use device::Device;
pub use executables::{Executable, executables};
pub(crate) use facts::LEAST_STORAGE_BUFFERS;
pub use facts::all_facts;
pub use features::{Features, FeaturesApart};
pub(crate) use formats::{DEPTH_FORMATS, can, check_color};
pub use graphics_pipeline::{Attachments, Blend, DepthState, GraphicsPipeline, GraphicsPipelineDesc};
pub use host_memory::{HostAllocation, HostMemory, MemoryRequest};
pub use image::{Image, ImageDesc};
pub use import::Import;
pub use instance::Instance;
pub use layout::PipelineLayout;
pub use loader::{LoaderFacts, loader_facts};
pub use memory::{Memory, MemoryUse};
pub use memory_needs::{MemoryNeeds, MemoryPiece};
pub use messages::{Message, Messages};
pub use pipeline_cache::PipelineCache;
pub use pool_sizes::PoolSizes;
pub use queries::{Occlusion, QueryPool, Statistics, Timestamps};
pub use queue::Queue;
pub(crate) use queue::wait_for_all;
pub use requirements::{Requirements, requirements};
pub use result::VkResultExt;
pub use sampler::Sampler;
#[cfg(feature = "view")]
pub use semaphore::Semaphore;
pub use staging::Staging;
pub(crate) use staging_ring::StagingRing;
pub(crate) use stand_ins::STAND_IN_BYTES;
pub use stand_ins::StandIns;
#[cfg(feature = "view")]
pub use surface::{Surface, Window};
#[cfg(feature = "view")]
pub use swapchain::{Swapchain, SwapchainImage, Turn};
pub(crate) use uploads::Upload;
pub use validation::{Validation, arm_validation_across_submits};

/// One shader stage of a pipeline: its name for messages, its SPIR-V, its specialization constants.
#[derive(Clone, Copy)]
pub struct Stage<'a> {
    /// Shown in messages and as the module's debug name.
    pub name: &'a str,
    /// The SPIR-V words; the entry point is `main`.
    pub spirv: &'a [u32],
    /// Values of specialization constants by their id, as 32-bit patterns (booleans are 0 or 1).
    pub constants: &'a [(u32, u32)],
}
