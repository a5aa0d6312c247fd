//! The graph of a frame: its passes, and a copy for each thing that the host wants to read.

use ash::vk;

use super::{Readbacks, SampleSum};
use crate::{
    arena::{Arena, ArenaVec},
    error::Result,
    frame::Target,
    graph::{
        Buffer as GraphBuffer, BufferDesc, BufferState, Graph, Handle, Image, ImageDesc, ImageState,
        ResourceId,
        execute::{Body, Physical},
    },
    passes::{self, Exported, FramePlan, Inputs},
};

pub(crate) type Imports<'a> = ArenaVec<'a, (ResourceId, Physical)>;

/// The whole frame: its passes, and a copy for each thing that the host wants to read.
pub(crate) fn declare<'a>(
    arena: &'a Arena,
    inputs: Inputs<'a>,
    plan: &'a FramePlan<'a>,
    target: &Target,
    readbacks: Readbacks,
) -> Result<(Graph<'a, Body<'a>>, Imports<'a>)> {
    let (mut graph, mut imports) = (Graph::new(arena), arena.growing());
    let sum = match readbacks.sample {
        None => None,
        Some(sample) => {
            let image = one_sample(&mut graph, &mut imports, inputs, plan, target.extent, sample)?;
            if !sample.last {
                return Ok((graph, imports));
            }
            Some(image)
        }
    };
    let desc = ImageDesc { format: target.format, extent: target.extent };
    let mut image = graph.import_image("target", desc, target.initial, target.last);
    imports.push((image.id(), Physical::Image(target.image, target.view)));

    let export = readbacks.surface.is_some();
    let exported = match &sum {
        None => passes::frame(&mut graph, inputs, plan, &mut image, target.format, (export, None))?,
        Some(sum) => {
            passes::resolve_samples(&mut graph, inputs, sum, (&mut image, target.format))?;
            None
        }
    };

    if let Some(buffer) = readbacks.target {
        copy_out(&mut graph, &mut imports, inputs, ("target", &image, target.format), buffer);
    }
    copy_surface(&mut graph, &mut imports, inputs, exported.as_ref(), readbacks.surface);
    Ok((graph, imports))
}

/// Declares the copy of what is in an image to a buffer that the host reads.
pub(super) fn copy_out<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    imports: &mut Imports<'a>,
    inputs: Inputs<'a>,
    (what, image, format): (&str, &Handle<Image>, vk::Format),
    buffer: vk::Buffer,
) {
    let mut destination = import_readback(graph, what, format, inputs.extent());
    imports.push((destination.id(), Physical::Buffer(buffer)));
    let of = (format, inputs.extent());
    passes::readback(graph, inputs.source, format_args!("read back {what}"), image, of, &mut destination);
}

/// The same for the surface as data, where it was exported and the host wants it.
pub(super) fn copy_surface<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    imports: &mut Imports<'a>,
    inputs: Inputs<'a>,
    exported: Option<&Exported>,
    buffers: Option<[vk::Buffer; 4]>,
) {
    let (Some(exported), Some(buffers)) = (exported, buffers) else { return };
    let images = [&exported.weight, &exported.albedo, &exported.normal, &exported.depth];
    let names = ["weight", "albedo", "normal", "depth"];
    for (((what, image), format), buffer) in names.into_iter().zip(images).zip(Exported::FORMATS).zip(buffers)
    {
        copy_out(graph, imports, inputs, (what, image, format), buffer);
    }
}

/// A frame into an image of its own, which is added to the sum of samples; the sum.
fn one_sample<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    imports: &mut Imports<'a>,
    inputs: Inputs<'a>,
    plan: &'a FramePlan<'a>,
    extent: vk::Extent2D,
    sample: SampleSum,
) -> Result<Handle<Image>> {
    let format = passes::SAMPLE_FORMAT;
    let desc = ImageDesc { format, extent };
    let mut drawn = graph.create_image("sample", desc);
    passes::frame(graph, inputs, plan, &mut drawn, format, (false, None))?;
    let between = ImageState {
        stages: vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT,
        access: vk::AccessFlags2::COLOR_ATTACHMENT_READ | vk::AccessFlags2::COLOR_ATTACHMENT_WRITE,
        layout: vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL,
    };
    let initial = match sample.first {
        // Of the picture before, it may still be read.
        true => ImageState { layout: vk::ImageLayout::UNDEFINED, ..between },
        false => between,
    };
    let mut sum = graph.import_image("sum of samples", desc, initial, Some(between));
    imports.push((sum.id(), Physical::Image(sample.image, sample.view)));
    passes::add_sample(graph, inputs, &drawn, &mut sum, sample.first)?;
    Ok(sum)
}

/// A host-visible buffer for an image: the frame before may still write it; the host reads it after.
pub(crate) fn import_readback(
    graph: &mut Graph<'_, Body<'_>>,
    what: &str,
    format: vk::Format,
    extent: vk::Extent2D,
) -> Handle<GraphBuffer> {
    let size_bytes = u64::from(extent.width) * u64::from(extent.height) * bytes_per_pixel(format);
    let initial = BufferState {
        stages: vk::PipelineStageFlags2::ALL_TRANSFER,
        access: vk::AccessFlags2::TRANSFER_WRITE,
    };
    let last = BufferState { stages: vk::PipelineStageFlags2::HOST, access: vk::AccessFlags2::HOST_READ };
    graph.import_buffer(
        format_args!("read-back of {what}"),
        BufferDesc::of_bytes(size_bytes),
        initial,
        Some(last),
    )
}

/// Bytes of a pixel, for the formats that are read back.
pub(crate) fn bytes_per_pixel(format: vk::Format) -> u64 {
    match format {
        vk::Format::R32G32B32A32_SFLOAT => 16,
        vk::Format::R16G16B16A16_SFLOAT => 8,
        _ => 4,
    }
}
