//! Who shares memory with whom, and who waits for whom because of it.

use super::*;

/// `a` is drawn, sampled into `b`, that into `c`, that into the target.
fn chain() -> (Plan, [ResourceId; 3]) {
    let mut graph = graph();
    let mut target = import_target(&mut graph);
    let [mut a, mut b, mut c] = ["a", "b", "c"].map(|name| graph.create_image(name, image(COLOR)));
    let color = Access::ColorAttachment;
    graph.pass("0").write(&mut a, color, BLACK).finish(());
    graph.pass("1").read(&a, Access::SampledFragment).write(&mut b, color, BLACK).finish(());
    graph.pass("2").read(&b, Access::SampledFragment).write(&mut c, color, BLACK).finish(());
    graph.pass("3").read(&c, Access::SampledFragment).write(&mut target, color, BLACK).finish(());
    let ids = [a.id(), b.id(), c.id()];
    (plan_of(graph), ids)
}

#[test]
fn disjoint_lives_share_memory_and_overlapping_ones_do_not() {
    let (plan, ids) = chain();
    let [a, b, c] = ids.map(|id| plan.resource(id).slot.unwrap());
    assert_eq!(a, c);
    assert!(!a.overlaps(&b));
    assert_eq!(plan.blocks.len(), 1);
    assert_eq!(plan.blocks[0].size_bytes, 2 * 64 * 32 * 4);
}

#[test]
fn the_first_access_waits_for_the_former_tenants_also_of_the_execution_before() {
    let (plan, [a, b, c]) = chain();
    let first_use = |pass: usize, id: ResourceId| {
        let barrier =
            plan.passes[pass].barriers.resources.iter().find(|barrier| barrier.resource == id).unwrap();
        assert_eq!(barrier.cause, Cause::FirstUse);
        assert_eq!(
            barrier.src.stages,
            vk::PipelineStageFlags2::FRAGMENT_SHADER,
            "the last access is sampling"
        );
        barrier.tenants.clone()
    };
    assert_eq!(first_use(0, a), [c], "of the execution before");
    assert_eq!(first_use(1, b), [b], "itself, in the execution before");
    assert_eq!(first_use(2, c), [a]);
    let memory = |pass: usize| plan.passes[pass].barriers.memory.is_some();
    assert_eq!([0, 1, 2, 3].map(memory), [true, false, true, false]);
}

#[test]
fn a_large_one_waits_for_all_the_small_ones_in_its_place() {
    let mut graph = graph();
    let [mut x, mut y, mut large] = [("x", 256), ("y", 512), ("large", 1024)]
        .map(|(n, size_bytes)| graph.create_buffer(n, BufferDesc::of_bytes(size_bytes)));
    let copy = Access::TransferWrite;
    let both = graph.pass("both").write(&mut x, copy, Start::Discard).write(&mut y, copy, Start::Discard);
    both.side_effect().finish(());
    graph.pass("large").write(&mut large, copy, Start::Discard).side_effect().finish(());
    let plan = plan_of(graph);
    assert_eq!(plan.blocks[0].size_bytes, 1024);
    let slot = |handle: &Handle<Buffer>| plan.resource(handle.id()).slot.unwrap();
    assert_eq!((slot(&y).offset_bytes, slot(&x).offset_bytes), (0, 512));
    // It waits on itself too, for the last quarter.
    assert_eq!(plan.passes[1].barriers.resources[0].tenants, [y.id(), x.id(), large.id()]);
}

#[test]
fn images_and_buffers_and_foreign_memory_types_lie_apart() {
    let mut graph = graph();
    let mut color = graph.create_image("color", image(COLOR));
    let [mut x, mut y, mut z] = ["x", "y", "z"].map(|name| graph.create_buffer(name, buffer()));
    graph.pass("i").write(&mut color, Access::TransferWrite, Start::Discard).side_effect().finish(());
    for (name, handle) in [("write x", &mut x), ("write y", &mut y), ("write z", &mut z)] {
        graph.pass(name).write(handle, Access::TransferWrite, Start::Discard).side_effect().finish(());
    }
    let bits = [0b111, 0b011, 0b001, 0b010];
    let needs = |id: ResourceId, _: &ResourceDesc, _| {
        Ok(MemoryNeed { size_bytes: 16, alignment_bytes: 64, type_bits: bits[id.index()] })
    };
    let plan = graph.compile(needs).unwrap();
    simulator::check(&plan).unwrap();
    let block = |handle: ResourceId| plan.resource(handle).slot.unwrap().block;
    assert_eq!([color.id(), x.id(), y.id(), z.id()].map(block), [0, 1, 1, 2]);
    assert_eq!(plan.blocks[1].type_bits, 0b001, "what all of its tenants can live in");
}

#[test]
fn offsets_are_aligned() {
    let mut graph = graph();
    let [mut x, mut y] = ["x", "y"].map(|name| graph.create_buffer(name, buffer()));
    let pass = graph.pass("both").write(&mut x, Access::TransferWrite, Start::Discard);
    pass.write(&mut y, Access::TransferWrite, Start::Discard).side_effect().finish(());
    let needs =
        |_, _: &ResourceDesc, _| Ok(MemoryNeed { size_bytes: 100, alignment_bytes: 64, type_bits: 1 });
    let plan = graph.compile(needs).unwrap();
    assert_eq!(plan.resource(y.id()).slot.unwrap().offset_bytes, 128);
    assert_eq!((plan.blocks[0].size_bytes, plan.blocks[0].alignment_bytes), (228, 64));
}

#[test]
fn what_no_device_can_hold_is_refused_and_what_is_huge_has_a_block_of_its_own() {
    let cases = [(
        MemoryNeed { size_bytes: 1, alignment_bytes: 1, type_bits: 0 },
        "the device has no memory type for it",
    )];
    for (bad, reason) in cases {
        let mut graph = graph();
        let [mut x, mut y] = ["x", "y"].map(|name| graph.create_buffer(name, buffer()));
        let pass = graph.pass("both").write(&mut x, Access::TransferWrite, Start::Discard);
        pass.write(&mut y, Access::TransferWrite, Start::Discard).side_effect().finish(());
        let error = graph.compile(|_, _, _| Ok(bad)).unwrap_err().to_string();
        assert!(error.starts_with("illegal render graph: resource '") && error.ends_with(reason), "{error}");
    }
    for (size_bytes, blocks) in [(u64::MAX, 2), (1 << 30, 2), (1 << 29, 1)] {
        let mut graph = graph();
        let [mut x, mut y] = ["x", "y"].map(|name| graph.create_buffer(name, buffer()));
        let pass = graph.pass("both").write(&mut x, Access::TransferWrite, Start::Discard);
        pass.write(&mut y, Access::TransferWrite, Start::Discard).side_effect().finish(());
        let need = MemoryNeed { size_bytes, alignment_bytes: 2, type_bits: 1 };
        let plan = graph.compile(|_, _, _| Ok(need)).unwrap();
        assert_eq!(plan.blocks.len(), blocks, "{size_bytes}");
    }
}
