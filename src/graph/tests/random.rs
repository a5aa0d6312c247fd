//! Random legal graphs: no plan has a race, loses a content or leaves an image in the wrong layout.

use ash::vk;
use proptest::prelude::*;

use super::*;

/// One resource: a handle of the right type.
enum Any {
    Image(Handle<Image>, bool),
    Buffer(Handle<Buffer>),
}

/// A pass: its kind, and for some resources which access and start to take.
type PassSeed = (u8, bool, Vec<(usize, u8, u8)>);
/// A resource: its type, whether it is imported and in which state.
type ResourceSeed = (u8, u8, u8);

fn state(seed: u8) -> State {
    use vk::{AccessFlags2 as A, ImageLayout as L, PipelineStageFlags2 as S};
    let (stages, access, layout) = match seed % 7 {
        0 => (S::NONE, A::NONE, L::UNDEFINED),
        1 => (S::NONE, A::NONE, L::READ_ONLY_OPTIMAL),
        2 => (S::COPY, A::TRANSFER_WRITE, L::TRANSFER_DST_OPTIMAL),
        3 => (S::FRAGMENT_SHADER, A::SHADER_SAMPLED_READ, L::READ_ONLY_OPTIMAL),
        4 => (S::COLOR_ATTACHMENT_OUTPUT, A::NONE, L::UNDEFINED),
        5 => (S::COMPUTE_SHADER, A::SHADER_STORAGE_READ | A::SHADER_STORAGE_WRITE, L::GENERAL),
        _ => (S::HOST | S::COMPUTE_SHADER, A::HOST_READ | A::SHADER_STORAGE_READ, L::GENERAL),
    };
    State { stages, access, layout }
}

fn build(resources: &[ResourceSeed], passes: &[PassSeed]) -> Graph<'static, ()> {
    let mut graph = graph();
    let mut handles = Vec::new();
    // Whether there is something to read.
    let mut filled = Vec::new();
    for (i, &(kind, initial, last)) in resources.iter().enumerate() {
        let (name, imported) = (format!("r{i}"), initial % 4 == 0);
        let (first, end) = (state(initial / 4), state(last / 2));
        if kind % 3 == 2 {
            let size = BufferDesc { size_bytes: 1 + u64::from(kind), texels: vk::Format::R32_UINT };
            let as_buffer = |State { stages, access, .. }: State| BufferState { stages, access };
            handles.push(Any::Buffer(if imported {
                graph.import_buffer(&name, size, as_buffer(first), (last % 2 == 0).then(|| as_buffer(end)))
            } else {
                graph.create_buffer(&name, size)
            }));
            filled.push(imported);
        } else {
            let desc = image(if kind % 3 == 0 { COLOR } else { DEPTH });
            let as_image = |State { stages, access, layout }: State| ImageState { stages, access, layout };
            let wanted = last % 2 == 0 && end.layout != vk::ImageLayout::UNDEFINED;
            let handle = if imported {
                graph.import_image(&name, desc, as_image(first), wanted.then(|| as_image(end)))
            } else {
                graph.create_image(&name, desc)
            };
            handles.push(Any::Image(handle, kind % 3 == 1));
            filled.push(imported && first.layout != vk::ImageLayout::UNDEFINED);
        }
    }
    for (i, (kind, side_effect, picks)) in passes.iter().enumerate() {
        let kind = [PassKind::Graphics, PassKind::Compute, PassKind::Transfer][usize::from(kind % 3)];
        let mut chosen: Vec<(usize, Access, Option<Start>)> = Vec::new();
        for &(resource, access, start) in picks {
            let index = resource % handles.len();
            let (is_image, is_depth) = match &handles[index] {
                Any::Image(_, is_depth) => (true, *is_depth),
                Any::Buffer(_) => (false, false),
            };
            let fits = |access: &Access| {
                let info = access.info();
                let shape = if is_image { info.image.is_some() } else { info.buffer.is_some() };
                let storage = info.image.is_some_and(|(_, u)| u.contains(vk::ImageUsageFlags::STORAGE));
                let format = match is_depth {
                    true => *access != Access::ColorAttachment && !storage,
                    false => !access.is_depth_attachment(),
                };
                shape && format && info.kind.is_none_or(|k| k == kind) && (filled[index] || access.writes())
            };
            let fitting: Vec<Access> = Access::ALL.into_iter().filter(|access| fits(access)).collect();
            let Some(&access) = fitting.get(usize::from(access) % fitting.len().max(1)) else { continue };
            let second_depth =
                access.is_depth_attachment() && chosen.iter().any(|c| c.1.is_depth_attachment());
            let clashes = chosen.iter().any(|&(other, earlier, _)| {
                let layout = |access: Access| access.info().image.map(|(layout, _)| layout);
                other == index
                    && (earlier.writes()
                        || access.writes()
                        || earlier == access
                        || (is_image && layout(earlier) != layout(access)))
            });
            if second_depth || clashes {
                continue;
            }
            let start = access.writes().then(|| match start % 3 {
                0 if filled[index] => Start::Load,
                1 if access == Access::ColorAttachment => BLACK,
                1 if access == Access::DepthAttachment => FAR,
                _ => Start::Discard,
            });
            chosen.push((index, access, start));
        }
        let says_kind = match kind {
            PassKind::Graphics => chosen.iter().any(|c| c.1.is_attachment()),
            _ => chosen.iter().any(|c| c.1.info().kind.is_some()),
        };
        if !says_kind {
            continue;
        }
        let mut pass = graph.pass(format_args!("p{i}"));
        for (index, access, start) in chosen {
            filled[index] |= start.is_some();
            pass = match (&mut handles[index], start) {
                (Any::Image(handle, _), Some(start)) => pass.write(handle, access, start),
                (Any::Image(handle, _), None) => pass.read(handle, access),
                (Any::Buffer(handle), Some(start)) => pass.write(handle, access, start),
                (Any::Buffer(handle), None) => pass.read(handle, access),
            };
        }
        if *side_effect { pass.side_effect().finish(()) } else { pass.finish(()) }
    }
    graph
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_random_graph_has_a_race(
        resources in prop::collection::vec(any::<ResourceSeed>(), 1..7),
        passes in prop::collection::vec(
            (any::<u8>(), prop::bool::weighted(0.5), prop::collection::vec(any::<(usize, u8, u8)>(), 1..5)),
            1..20,
        ),
        sizes in prop::collection::vec(1_u64..20, 7),
    ) {
        // Sizes and alignments that make slots overlap in part, and memory types that don't all agree.
        let needs = |id: ResourceId, _: &ResourceDesc, _| Ok(MemoryNeed {
            size_bytes: sizes[id.index()],
            alignment_bytes: 1 << (sizes[id.index()] % 3),
            type_bits: [0b011, 0b110, 0b111][(sizes[id.index()] % 3) as usize],
        });
        let plan = build(&resources, &passes).compile(needs).unwrap();
        if let Err(problem) = simulator::check(&plan) {
            prop_assert!(false, "{}\n{}", problem, plan);
        }
    }
}

/// The random graphs are only worth something if they meet every case.
#[test]
fn random_graphs_meet_every_case() {
    use proptest::{strategy::ValueTree, test_runner::TestRunner};
    let mut runner = TestRunner::deterministic();
    let seeds = (
        prop::collection::vec(any::<ResourceSeed>(), 1..7),
        prop::collection::vec(
            (any::<u8>(), prop::bool::weighted(0.5), prop::collection::vec(any::<(usize, u8, u8)>(), 1..5)),
            1..20,
        ),
    );
    let causes = [
        Cause::ReadAfterWrite,
        Cause::WriteAfterRead,
        Cause::WriteAfterWrite,
        Cause::Layout,
        Cause::FirstUse,
    ];
    let mut met = [0; 5];
    let (mut shared, mut culled, mut finals) = (0, 0, 0);
    for _ in 0..500 {
        let (resources, passes) = seeds.new_tree(&mut runner).unwrap().current();
        let plan = plan_of(build(&resources, &passes));
        let barriers = || plan.passes.iter().flat_map(|pass| &pass.barriers.resources);
        for (count, cause) in met.iter_mut().zip(causes) {
            *count += usize::from(barriers().any(|barrier| barrier.cause == cause));
        }
        shared += usize::from(plan.passes.iter().any(|pass| pass.barriers.memory.is_some()));
        culled += usize::from(!plan.culled.is_empty());
        finals += usize::from(!plan.final_barriers.is_empty());
    }
    println!("of 500: {causes:?} {met:?}, memory shared {shared}, culled {culled}, final barriers {finals}");
    for count in met.into_iter().chain([shared, culled, finals]) {
        assert!(count >= 25, "{causes:?} {met:?}, {shared}, {culled}, {finals}");
    }
}
