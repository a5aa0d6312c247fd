//! Transients that share memory, and what is refused before anything is recorded.

use ash::vk;
use surfel::{
    arena::Arena,
    graph::{
        Cause,
        execute::{Part, Physical, Transients, execute},
    },
    vk::CommandPool,
};

use crate::{
    common::watched::Watched,
    frame_graph::chain::{buffers, chain, submit},
};

#[test]
fn images_that_share_memory_keep_their_pixels_in_execution_after_execution() {
    let watched = Watched::new();
    let (arena, (pattern, result)) = (Arena::new(), buffers(&watched));
    let (plan, ..) = chain(&arena, &watched, &pattern, &result);
    let slot = |name| {
        let mut resources = plan.resources.iter();
        resources.find(|resource| resource.name == name).unwrap().slot.unwrap()
    };
    assert!(slot("first").overlaps(&slot("third")), "{}", plan);
    assert!(!slot("first").overlaps(&slot("second")) && !slot("second").overlaps(&slot("third")));
    let transients = Transients::new(&watched.device, &plan).unwrap();
    let of_one = slot("first").size_bytes;
    assert!(transients.bytes() < 3 * of_one, "{} bytes for three of {of_one}", transients.bytes());

    // Three executions of equal plans on the same memory, without a wait between them.
    let mut last = None;
    let mut pools = Vec::new();
    for _ in 0..3 {
        let (plan, graph, imports) = chain(&arena, &watched, &pattern, &result);
        let (pool, epoch) = submit(&watched, (&plan, &graph), &transients, &imports);
        pools.push(pool);
        last = Some(epoch);
    }
    watched.queue.wait(last.unwrap()).unwrap();
    // SAFETY: waited for.
    let [pattern, result] = [&pattern, &result].map(|buffer| unsafe { buffer.bytes() });
    assert!(pattern == result, "the pixels are the pattern's");
    assert!(pattern.iter().any(|byte| *byte != pattern[0]));
    assert_eq!(watched.said(), [] as [String; 0]);
}

/// The silence above is the barriers' doing.
#[test]
fn without_the_barrier_for_a_former_tenant_the_layer_speaks() {
    let watched = Watched::new();
    let (arena, (pattern, result)) = (Arena::new(), buffers(&watched));
    let (mut plan, graph, imports) = chain(&arena, &watched, &pattern, &result);
    let transients = Transients::new(&watched.device, &plan).unwrap();
    let third = plan.resources.iter().position(|resource| resource.name == "third").unwrap();
    let mut dropped = 0;
    for pass in &mut plan.passes {
        for barrier in &mut pass.barriers.resources {
            if barrier.resource.index() == third && barrier.cause == Cause::FirstUse {
                (barrier.src.stages, barrier.src.access) = Default::default();
                dropped += 1;
            }
        }
        dropped += usize::from(pass.barriers.memory.take().is_some());
    }
    assert!(dropped > 0, "{}", plan);
    let (_pool, epoch) = submit(&watched, (&plan, &graph), &transients, &imports);
    watched.queue.wait(epoch).unwrap();
    let said = watched.said();
    assert!(said.iter().any(|vuid| vuid.starts_with("SYNC-HAZARD")), "{said:?}");
}

#[test]
fn an_import_that_is_missing_or_of_the_wrong_kind_is_refused_before_anything_is_recorded() {
    let watched = Watched::new();
    let (arena, (pattern, result)) = (Arena::new(), buffers(&watched));
    let (plan, _, imports) = chain(&arena, &watched, &pattern, &result);
    let transients = Transients::new(&watched.device, &plan).unwrap();
    let wrong_kind = (imports[1].0, Physical::Image(vk::Image::null(), vk::ImageView::null()));
    let cases = [
        (vec![imports[0]], "resource 'result': has no Vulkan object: an import was not given"),
        (vec![imports[0], wrong_kind], "resource 'result': is a buffer, and an image was given"),
    ];
    for (given, expected) in cases {
        let (plan, graph, _) = chain(&arena, &watched, &pattern, &result);
        let pool = CommandPool::new(&watched.device, "chain").unwrap();
        // SAFETY: the pool is new; what is refused was not recorded, and the rest of it is submitted.
        let error = unsafe {
            let commands = pool.begin().unwrap();
            let error = execute(
                &watched.device,
                commands,
                (&plan, &graph),
                &transients,
                &given,
                None,
                Part::default(),
            )
            .unwrap_err();
            let epoch = watched.queue.submit(pool.end().unwrap()).unwrap();
            watched.queue.wait(epoch).unwrap();
            error
        };
        assert!(error.to_string().ends_with(expected), "{error}");
    }
    assert_eq!(watched.said(), [] as [String; 0]);
}
