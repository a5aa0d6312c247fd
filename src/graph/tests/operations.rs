//! Load and store operations, usages, kinds, and the table of accesses.

use vk::{AttachmentLoadOp as Load, AttachmentStoreOp as Store};

use super::*;

#[test]
fn attachments_load_and_store_only_what_is_needed() {
    let mut graph = graph();
    let mut target = import_target(&mut graph);
    let mut depth = graph.create_image("depth", image(DEPTH));
    let [mut read, mut unread] = ["read", "unread"].map(|name| graph.create_image(name, image(COLOR)));
    let color = Access::ColorAttachment;
    graph
        .pass("first")
        .write(&mut depth, Access::DepthAttachment, FAR)
        .write(&mut read, color, Start::Discard)
        .write(&mut unread, color, BLACK)
        .finish(());
    graph.pass("second").read(&depth, Access::DepthTest).write(&mut read, color, Start::Load).finish(());
    graph
        .pass("third")
        .read(&read, Access::SampledFragment)
        .write(&mut depth, Access::DepthAttachment, Start::Load)
        .write(&mut target, color, BLACK)
        .finish(());
    let plan = plan_of(graph);
    let ops = |pass: usize| {
        let rendering = plan.passes[pass].rendering.as_ref().unwrap();
        assert_eq!(rendering.extent, image(COLOR).extent);
        let colors: Vec<_> = rendering.colors.iter().map(|a| (a.load, a.store)).collect();
        (colors, rendering.depth.map(|a| (a.load, a.store)))
    };
    let (kept, dropped) = (Store::STORE, Store::DONT_CARE);
    let first = vec![(Load::DONT_CARE, kept), (Load::CLEAR, dropped)];
    assert_eq!(ops(0), (first, Some((Load::CLEAR, kept))));
    assert_eq!(ops(1), (vec![(Load::LOAD, kept)], Some((Load::LOAD, Store::NONE))));
    assert_eq!(ops(2), (vec![(Load::CLEAR, kept)], Some((Load::LOAD, dropped))));
    assert_eq!(plan.passes[0].rendering.as_ref().unwrap().colors[1].clear, Some(ClearValue::Color([0.0; 4])));
}

#[test]
fn usages_are_those_of_all_accesses_that_are_left() {
    let mut graph = graph();
    let mut depth = graph.create_image("depth", image(DEPTH));
    let mut out = graph.import_buffer("out", buffer(), BufferState::default(), None);
    let mut lost = graph.create_buffer("lost", buffer());
    graph.pass("draw").write(&mut depth, Access::DepthAttachment, FAR).finish(());
    graph
        .pass("copy")
        .read(&depth, Access::TransferRead)
        .write(&mut out, Access::TransferWrite, Start::Discard)
        .finish(());
    graph
        .pass("culled")
        .read(&depth, Access::SampledCompute)
        .write(&mut lost, Access::StorageWriteCompute, Start::Discard)
        .finish(());
    let plan = plan_of(graph);
    let expected = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC;
    assert_eq!(plan.resource(depth.id()).usage, Usage::Image(expected));
    assert_eq!(plan.resource(out.id()).usage, Usage::Buffer(vk::BufferUsageFlags::TRANSFER_DST));
    assert_eq!(plan.resource(depth.id()).lifetime, Some(Lifetime { first: 0, last: 1 }));
    let kinds: Vec<PassKind> = plan.passes.iter().map(|pass| pass.kind).collect();
    assert_eq!(kinds, [PassKind::Graphics, PassKind::Transfer]);
}

#[test]
fn the_table_is_consistent_with_vulkan() {
    use vk::{AccessFlags2 as A, PipelineStageFlags2 as S};
    // Which stages support which access (Vulkan 1.3, "Supported access types").
    let supported = [
        (A::INDIRECT_COMMAND_READ, S::DRAW_INDIRECT),
        (A::SHADER_SAMPLED_READ, S::FRAGMENT_SHADER | S::COMPUTE_SHADER | S::VERTEX_SHADER),
        (A::SHADER_STORAGE_READ, S::FRAGMENT_SHADER | S::COMPUTE_SHADER | S::VERTEX_SHADER),
        (A::SHADER_STORAGE_WRITE, S::FRAGMENT_SHADER | S::COMPUTE_SHADER | S::VERTEX_SHADER),
        (A::COLOR_ATTACHMENT_READ, S::COLOR_ATTACHMENT_OUTPUT),
        (A::COLOR_ATTACHMENT_WRITE, S::COLOR_ATTACHMENT_OUTPUT),
        (A::DEPTH_STENCIL_ATTACHMENT_READ, S::EARLY_FRAGMENT_TESTS | S::LATE_FRAGMENT_TESTS),
        (A::DEPTH_STENCIL_ATTACHMENT_WRITE, S::EARLY_FRAGMENT_TESTS | S::LATE_FRAGMENT_TESTS),
        (A::UNIFORM_READ, S::FRAGMENT_SHADER | S::COMPUTE_SHADER | S::VERTEX_SHADER),
        (A::INDEX_READ, S::INDEX_INPUT),
        (A::TRANSFER_READ, S::ALL_TRANSFER),
        (A::TRANSFER_WRITE, S::ALL_TRANSFER),
    ];
    for access in Access::ALL {
        let info = access.info();
        let all = info.reads | info.writes;
        let mut explained = (A::NONE, S::NONE);
        for (bit, stages) in supported.iter().filter(|(bit, _)| all.contains(*bit)) {
            assert!(info.stages.intersects(*stages), "{access:?}: no stage for {bit:?}");
            explained = (explained.0 | *bit, explained.1 | *stages);
        }
        assert_eq!(explained.0, all, "{access:?}");
        assert!(explained.1.contains(info.stages), "{access:?}: a stage without an access");
        assert_eq!(access::writes_of(all), info.writes, "{access:?}");
        assert!(info.image.is_some() || info.buffer.is_some(), "{access:?}");
    }
}
