//! The closed list of ways to access a resource, and the one table of what each means to Vulkan.

use ash::vk;

use vk::{
    AccessFlags2 as A, BufferUsageFlags as B, ImageLayout as L, ImageUsageFlags as I,
    PipelineStageFlags2 as S,
};

/// How a pass accesses a resource.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Access {
    /// A color attachment, written and perhaps blended with. The n-th one declared has location n.
    ColorAttachment,
    /// The depth attachment, tested and written.
    DepthAttachment,
    /// The depth attachment, tested only.
    DepthTest,
    /// The depth attachment, tested only, that the fragment stage samples too.
    DepthTestAndSampled,
    /// Sampled in the fragment stage.
    SampledFragment,
    /// Sampled in a compute shader.
    SampledCompute,
    /// A texel buffer read in a compute shader.
    TexelReadCompute,
    /// A storage buffer or image read in the vertex stage.
    StorageReadVertex,
    /// A storage buffer or image read in a compute shader.
    StorageReadCompute,
    /// A storage buffer or image written, not read, in a compute shader.
    StorageWriteCompute,
    /// A storage buffer or image read and written in a compute shader.
    StorageReadWriteCompute,
    /// An image that a compute shader samples where it writes, as a storage image, afterwards.
    SampledAndStoredCompute,
    /// A storage buffer or image of which a compute shader reads and writes some places, which only the device knows.
    StorageUpdateCompute,
    /// A uniform buffer read in the vertex stage.
    UniformReadVertex,
    /// A uniform buffer read in the fragment stage.
    UniformReadFragment,
    /// A uniform buffer read in a compute shader.
    UniformReadCompute,
    /// The arguments of an indirect draw or dispatch.
    IndirectRead,
    /// The indices of a draw.
    IndexRead,
    /// The source of a copy.
    TransferRead,
    /// The destination of a copy, a fill or a clear outside of rendering.
    TransferWrite,
}

/// What a pass records.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PassKind {
    /// Draws, inside of dynamic rendering.
    Graphics,
    /// Dispatches.
    Compute,
    /// Copies, fills, clears.
    Transfer,
}

/// What an [`Access`] means to Vulkan.
#[derive(Clone, Copy, Debug)]
pub struct AccessInfo {
    /// The stages that access.
    pub stages: vk::PipelineStageFlags2,
    /// Their reading accesses.
    pub reads: vk::AccessFlags2,
    /// Their writing accesses; empty for a reader.
    pub writes: vk::AccessFlags2,
    /// The layout of an image, and the usage it needs; `None` where images can't be accessed so.
    pub image: Option<(vk::ImageLayout, vk::ImageUsageFlags)>,
    /// The usage a buffer needs; `None` where buffers can't be accessed so.
    pub buffer: Option<vk::BufferUsageFlags>,
    /// The kind of pass that accesses so; `None` where several do.
    pub kind: Option<PassKind>,
}

impl Access {
    /// Every access, in the order of the table.
    pub const ALL: [Self; 20] = [
        Self::ColorAttachment,
        Self::DepthAttachment,
        Self::DepthTest,
        Self::DepthTestAndSampled,
        Self::SampledFragment,
        Self::SampledCompute,
        Self::TexelReadCompute,
        Self::StorageReadVertex,
        Self::StorageReadCompute,
        Self::StorageWriteCompute,
        Self::StorageReadWriteCompute,
        Self::SampledAndStoredCompute,
        Self::StorageUpdateCompute,
        Self::UniformReadVertex,
        Self::UniformReadFragment,
        Self::UniformReadCompute,
        Self::IndirectRead,
        Self::IndexRead,
        Self::TransferRead,
        Self::TransferWrite,
    ];

    /// The table. `ATTACHMENT_OPTIMAL` and `READ_ONLY_OPTIMAL` (core since 1.3) serve color and depth alike, so that
    /// a depth image that is tested and then sampled changes its layout once.
    pub fn info(self) -> AccessInfo {
        use PassKind::{Compute, Graphics, Transfer};
        // A depth attachment is loaded, cleared and tested at the earliest of these stages, stored at the latest.
        let depth = S::EARLY_FRAGMENT_TESTS | S::LATE_FRAGMENT_TESTS;
        let (color, fragment, compute) = (S::COLOR_ATTACHMENT_OUTPUT, S::FRAGMENT_SHADER, S::COMPUTE_SHADER);
        let (color_reads, color_writes) = (A::COLOR_ATTACHMENT_READ, A::COLOR_ATTACHMENT_WRITE);
        let (depth_reads, depth_writes) =
            (A::DEPTH_STENCIL_ATTACHMENT_READ, A::DEPTH_STENCIL_ATTACHMENT_WRITE);
        let (sampled_reads, none) = (A::SHADER_SAMPLED_READ, A::NONE);
        let (storage_reads, storage_writes) = (A::SHADER_STORAGE_READ, A::SHADER_STORAGE_WRITE);
        let attachment = |usage| Some((L::ATTACHMENT_OPTIMAL, usage));
        let read_only = |usage| Some((L::READ_ONLY_OPTIMAL, usage));
        let storage = (Some((L::GENERAL, I::STORAGE)), Some(B::STORAGE_BUFFER));
        let uniform = (None, Some(B::UNIFORM_BUFFER));
        let sampled = (read_only(I::SAMPLED), None);
        let depth_usage = I::DEPTH_STENCIL_ATTACHMENT;
        let from = (Some((L::TRANSFER_SRC_OPTIMAL, I::TRANSFER_SRC)), Some(B::TRANSFER_SRC));
        let to = (Some((L::TRANSFER_DST_OPTIMAL, I::TRANSFER_DST)), Some(B::TRANSFER_DST));
        let row = |stages, reads, writes, (image, buffer), kind| AccessInfo {
            stages,
            reads,
            writes,
            image,
            buffer,
            kind,
        };
        #[rustfmt::skip]
        let info = match self {
            Self::ColorAttachment         => row(color, color_reads, color_writes, (attachment(I::COLOR_ATTACHMENT), None), Some(Graphics)),
            Self::DepthAttachment         => row(depth, depth_reads, depth_writes, (attachment(depth_usage), None), Some(Graphics)),
            Self::DepthTest               => row(depth, depth_reads, none, (read_only(depth_usage), None), Some(Graphics)),
            Self::DepthTestAndSampled     => row(depth | fragment, depth_reads | sampled_reads, none, (read_only(depth_usage | I::SAMPLED), None), Some(Graphics)),
            Self::SampledFragment         => row(fragment, sampled_reads, none, sampled, Some(Graphics)),
            Self::SampledCompute          => row(compute, sampled_reads, none, sampled, Some(Compute)),
            Self::TexelReadCompute        => row(compute, sampled_reads, none, (None, Some(B::UNIFORM_TEXEL_BUFFER)), Some(Compute)),
            Self::StorageReadVertex       => row(S::VERTEX_SHADER, storage_reads, none, storage, Some(Graphics)),
            Self::StorageReadCompute      => row(compute, storage_reads, none, storage, Some(Compute)),
            Self::StorageWriteCompute     => row(compute, none, storage_writes, storage, Some(Compute)),
            Self::StorageReadWriteCompute => row(compute, storage_reads, storage_writes, storage, Some(Compute)),
            Self::SampledAndStoredCompute => row(compute, sampled_reads, storage_writes, (Some((L::GENERAL, I::SAMPLED | I::STORAGE)), None), Some(Compute)),
            Self::StorageUpdateCompute    => row(compute, storage_reads, storage_writes, storage, Some(Compute)),
            Self::UniformReadVertex       => row(S::VERTEX_SHADER, A::UNIFORM_READ, none, uniform, Some(Graphics)),
            Self::UniformReadFragment     => row(fragment, A::UNIFORM_READ, none, uniform, Some(Graphics)),
            Self::UniformReadCompute      => row(compute, A::UNIFORM_READ, none, uniform, Some(Compute)),
            Self::IndirectRead            => row(S::DRAW_INDIRECT, A::INDIRECT_COMMAND_READ, none, (None, Some(B::INDIRECT_BUFFER)), None),
            Self::IndexRead               => row(S::INDEX_INPUT, A::INDEX_READ, none, (None, Some(B::INDEX_BUFFER)), Some(Graphics)),
            Self::TransferRead            => row(S::ALL_TRANSFER, A::TRANSFER_READ, none, from, Some(Transfer)),
            Self::TransferWrite           => row(S::ALL_TRANSFER, none, A::TRANSFER_WRITE, to, Some(Transfer)),
        };
        info
    }

    /// Whether it changes the content.
    pub fn writes(self) -> bool {
        !self.info().writes.is_empty()
    }

    /// Whether it needs a format with a depth.
    pub fn is_depth_attachment(self) -> bool {
        matches!(self, Self::DepthAttachment | Self::DepthTest | Self::DepthTestAndSampled)
    }

    /// Whether dynamic rendering begins with it.
    pub fn is_attachment(self) -> bool {
        self == Self::ColorAttachment || self.is_depth_attachment()
    }
}

/// The accesses of a mask that write. What is unknown here counts as a write, which waits too much, never too little.
pub(super) fn writes_of(access: vk::AccessFlags2) -> vk::AccessFlags2 {
    let reads = A::INDIRECT_COMMAND_READ
        | A::INDEX_READ
        | A::VERTEX_ATTRIBUTE_READ
        | A::UNIFORM_READ
        | A::INPUT_ATTACHMENT_READ
        | A::SHADER_READ
        | A::SHADER_SAMPLED_READ
        | A::SHADER_STORAGE_READ
        | A::COLOR_ATTACHMENT_READ
        | A::DEPTH_STENCIL_ATTACHMENT_READ
        | A::TRANSFER_READ
        | A::HOST_READ
        | A::MEMORY_READ;
    access & !reads
}
