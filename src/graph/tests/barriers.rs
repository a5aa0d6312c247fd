//! What passes wait for, on graphs small enough to say by hand.

use vk::{AccessFlags2 as A, ImageLayout as L, PipelineStageFlags2 as S};

use super::*;

fn scope(stages: S, access: A) -> Scope {
    Scope { stages, access }
}

/// A buffer of the caller's that nobody is at work on.
fn idle_buffer(graph: &mut Graph<'_, ()>) -> Handle<Buffer> {
    graph.import_buffer("b", buffer(), BufferState::default(), None)
}

fn write(graph: &mut Graph<'_, ()>, name: &str, b: &mut Handle<Buffer>) {
    graph.pass(name).write(b, Access::StorageWriteCompute, Start::Load).finish(());
}

fn read(graph: &mut Graph<'_, ()>, name: &str, b: &Handle<Buffer>, access: Access) {
    graph.pass(name).read(b, access).side_effect().finish(());
}

fn barriers(plan: &Plan, pass: usize) -> Vec<(Cause, Scope, Scope)> {
    plan.passes[pass].barriers.resources.iter().map(|b| (b.cause, b.src, b.dst)).collect()
}

const WRITTEN: Scope = Scope { stages: S::COMPUTE_SHADER, access: A::SHADER_STORAGE_WRITE };
const COPIED: Scope = Scope { stages: S::ALL_TRANSFER, access: A::TRANSFER_READ };

#[test]
fn a_reader_waits_for_the_writer_and_sees_its_work() {
    let mut graph = graph();
    let mut b = idle_buffer(&mut graph);
    write(&mut graph, "write", &mut b);
    read(&mut graph, "read", &b, Access::TransferRead);
    let plan = plan_of(graph);
    assert_eq!(plan.passes[0].barriers, Batch::default(), "nobody was at work on it");
    assert_eq!(barriers(&plan, 1), [(Cause::ReadAfterWrite, WRITTEN, COPIED)]);
}

#[test]
fn a_writer_waits_for_all_readers_and_flushes_nothing() {
    let mut graph = graph();
    let mut b = idle_buffer(&mut graph);
    read(&mut graph, "copy", &b, Access::TransferRead);
    read(&mut graph, "compute", &b, Access::StorageReadCompute);
    write(&mut graph, "write", &mut b);
    let plan = plan_of(graph);
    assert_eq!(plan.passes[1].barriers, Batch::default());
    let src = scope(S::ALL_TRANSFER | S::COMPUTE_SHADER, A::NONE);
    assert_eq!(barriers(&plan, 2), [(Cause::WriteAfterRead, src, WRITTEN)]);
}

#[test]
fn a_writer_waits_for_the_writer_before() {
    let mut graph = graph();
    let mut b = idle_buffer(&mut graph);
    write(&mut graph, "first", &mut b);
    write(&mut graph, "second", &mut b);
    assert_eq!(barriers(&plan_of(graph), 1), [(Cause::WriteAfterWrite, WRITTEN, WRITTEN)]);
}

#[test]
fn a_second_reader_waits_only_where_it_can_not_see_the_write_yet() {
    let mut graph = graph();
    let mut b = idle_buffer(&mut graph);
    write(&mut graph, "write", &mut b);
    read(&mut graph, "copy", &b, Access::TransferRead);
    read(&mut graph, "copy again", &b, Access::TransferRead);
    read(&mut graph, "compute", &b, Access::StorageReadCompute);
    let plan = plan_of(graph);
    assert_eq!(plan.passes[2].barriers, Batch::default());
    // The write itself, not the first reader: the two readers may run at the same time.
    let reader = scope(S::COMPUTE_SHADER, A::SHADER_STORAGE_READ);
    assert_eq!(barriers(&plan, 3), [(Cause::ReadAfterWrite, WRITTEN, reader)]);
}

#[test]
fn two_reads_of_one_pass_are_one_barrier() {
    let mut graph = graph();
    let mut b = idle_buffer(&mut graph);
    write(&mut graph, "write", &mut b);
    let pass = graph.pass("read").read(&b, Access::StorageReadCompute).read(&b, Access::IndirectRead);
    pass.side_effect().finish(());
    let dst = scope(S::COMPUTE_SHADER | S::DRAW_INDIRECT, A::SHADER_STORAGE_READ | A::INDIRECT_COMMAND_READ);
    assert_eq!(barriers(&plan_of(graph), 1), [(Cause::ReadAfterWrite, WRITTEN, dst)]);
}

#[test]
fn an_image_changes_its_layout_once_and_its_readers_share_it() {
    let mut graph = graph();
    let mut target = import_target(&mut graph);
    let mut depth = graph.create_image("depth", image(DEPTH));
    graph.pass("draw").write(&mut depth, Access::DepthAttachment, FAR).finish(());
    graph
        .pass("test")
        .read(&depth, Access::DepthTestAndSampled)
        .write(&mut target, Access::ColorAttachment, BLACK)
        .finish(());
    graph
        .pass("sample")
        .read(&depth, Access::SampledFragment)
        .write(&mut target, Access::ColorAttachment, Start::Load)
        .finish(());
    let plan = plan_of(graph);
    let transition = |pass: usize, id: ResourceId| {
        let barrier = plan.passes[pass].barriers.resources.iter().find(|b| b.resource == id)?;
        barrier.transition.map(|t| (t.old, t.new))
    };
    assert_eq!(transition(0, depth.id()), Some((L::UNDEFINED, L::ATTACHMENT_OPTIMAL)));
    assert_eq!(transition(1, depth.id()), Some((L::ATTACHMENT_OPTIMAL, L::READ_ONLY_OPTIMAL)));
    assert_eq!(transition(2, depth.id()), None, "seen by the fragment stage already");
    let tests = S::EARLY_FRAGMENT_TESTS | S::LATE_FRAGMENT_TESTS;
    let src = scope(tests, A::DEPTH_STENCIL_ATTACHMENT_WRITE);
    assert_eq!(plan.passes[1].barriers.resources[0].src, src);
}

#[test]
fn a_discarded_content_is_not_carried_into_the_new_layout() {
    for (start, old) in [(BLACK, L::UNDEFINED), (Start::Load, L::READ_ONLY_OPTIMAL)] {
        let mut graph = graph();
        let known = ImageState { layout: L::READ_ONLY_OPTIMAL, ..Default::default() };
        let mut target = graph.import_image("t", image(COLOR), known, None);
        graph.pass("draw").write(&mut target, Access::ColorAttachment, start).finish(());
        let plan = plan_of(graph);
        assert_eq!(plan.passes[0].barriers.resources[0].transition.map(|t| t.old), Some(old));
    }
}

#[test]
fn an_import_begins_in_its_initial_and_ends_in_its_final_state() {
    let mut graph = graph();
    let copied = BufferState { stages: S::COPY, access: A::TRANSFER_WRITE };
    let host = BufferState { stages: S::HOST, access: A::HOST_READ };
    let mut b = graph.import_buffer("b", buffer(), copied, Some(host));
    let mut target = import_target(&mut graph);
    write(&mut graph, "write", &mut b);
    graph.pass("draw").write(&mut target, Access::ColorAttachment, BLACK).finish(());
    let plan = plan_of(graph);
    let before = scope(copied.stages, copied.access);
    assert_eq!(barriers(&plan, 0), [(Cause::WriteAfterWrite, before, WRITTEN)]);
    let [to_host, to_screen] = &plan.final_barriers[..] else { panic!("{plan}") };
    assert_eq!((to_host.src, to_host.dst), (WRITTEN, scope(S::HOST, A::HOST_READ)));
    let (old, new) = (L::ATTACHMENT_OPTIMAL, L::PRESENT_SRC_KHR);
    assert_eq!(to_screen.transition, Some(Transition { old, new }));
    assert_eq!(to_screen.dst, Scope::default());
    assert_eq!(plan.resource(target.id()).end.layout, L::PRESENT_SRC_KHR);
}

#[test]
fn where_no_final_state_is_asked_for_the_end_is_told() {
    let mut graph = graph();
    let mut b = idle_buffer(&mut graph);
    write(&mut graph, "write", &mut b);
    read(&mut graph, "copy", &b, Access::TransferRead);
    let plan = plan_of(graph);
    let end = plan.resource(b.id()).end;
    assert!(plan.final_barriers.is_empty());
    assert_eq!((end.stages, end.access), (S::COMPUTE_SHADER | S::ALL_TRANSFER, A::SHADER_STORAGE_WRITE));
}
