//! Tests of the graph on plain data: what is known of small graphs by hand, and random ones against a simulator.

mod barriers;
mod culling;
mod dumps;
mod illegal;
mod memory;
mod operations;
mod random;
mod shapes;
mod simulator;

use std::{ptr, sync::Mutex};

use ash::vk;

use super::*;
use crate::arena::Arena;

pub(super) const COLOR: vk::Format = vk::Format::R16G16B16A16_SFLOAT;
pub(super) const DEPTH: vk::Format = vk::Format::D32_SFLOAT;
pub(super) const BLACK: Start = Start::Clear(ClearValue::Color([0.0; 4]));
pub(super) const FAR: Start = Start::Clear(ClearValue::Depth(0.0));

/// A graph that may stay for as long as a test.
pub(super) fn graph<Body>() -> Graph<'static, Body> {
    // For tools that look for what is lost.
    static NEVER_FREED: Mutex<Vec<usize>> = Mutex::new(Vec::new());
    let arena: &'static Arena = Box::leak(Box::default());
    NEVER_FREED.lock().unwrap().push(ptr::from_ref(arena).addr());
    Graph::new(arena)
}

pub(super) fn image(format: vk::Format) -> ImageDesc {
    ImageDesc { format, extent: vk::Extent2D { width: 64, height: 32 } }
}

pub(super) fn buffer() -> BufferDesc {
    BufferDesc::of_bytes(1024)
}

/// A device on which a pixel takes four bytes.
pub(super) fn need(_: ResourceId, desc: &ResourceDesc, _: Usage) -> crate::error::Result<MemoryNeed> {
    let size_bytes = match desc {
        ResourceDesc::Image(desc) => u64::from(desc.extent.width) * u64::from(desc.extent.height) * 4,
        ResourceDesc::Buffer(desc) => desc.size_bytes,
    };
    Ok(MemoryNeed { size_bytes, alignment_bytes: 256, type_bits: 0b11 })
}

pub(super) fn plan_of(graph: Graph<'_, ()>) -> Plan {
    let plan = graph.compile(need).unwrap();
    simulator::check(&plan).unwrap_or_else(|problem| panic!("{problem}\n{plan}"));
    plan
}

/// An image of the caller's that nothing is known of, presented in the end.
pub(super) fn import_target(graph: &mut Graph<'_, ()>) -> Handle<Image> {
    let last = ImageState { layout: vk::ImageLayout::PRESENT_SRC_KHR, ..Default::default() };
    graph.import_image("target", image(COLOR), ImageState::default(), Some(last))
}

pub(super) fn pass_names(plan: &Plan) -> Vec<&str> {
    plan.passes.iter().map(|pass| pass.name.as_str()).collect()
}
