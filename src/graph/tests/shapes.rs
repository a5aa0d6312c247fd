//! Which graphs take over the plan of another.

use super::*;

/// A graph of a list that is made, drawn with, and not looked at; after it has been changed as told.
struct Shape {
    list_name: &'static str,
    list: BufferDesc,
    extent: u32,
    pass_name: &'static str,
    access: Access,
    start: Start,
    side_effect: bool,
    initial: ImageState,
    unread: bool,
}

const SHAPE: Shape = Shape {
    list_name: "list",
    list: BufferDesc { size_bytes: 1024, texels: vk::Format::R32_UINT },
    extent: 64,
    pass_name: "draw",
    access: Access::StorageReadVertex,
    start: BLACK,
    side_effect: false,
    initial: ImageState {
        stages: vk::PipelineStageFlags2::NONE,
        access: vk::AccessFlags2::NONE,
        layout: vk::ImageLayout::UNDEFINED,
    },
    unread: true,
};

impl Shape {
    fn graph(&self) -> Graph<'static, &'static str> {
        let mut graph = graph();
        let extent = vk::Extent2D { width: self.extent, height: 32 };
        let mut target =
            graph.import_image("target", ImageDesc { format: COLOR, extent }, self.initial, None);
        let mut list = graph.create_buffer(self.list_name, self.list);
        let mut unread = graph.create_buffer("unread", buffer());
        let transfer = Access::TransferWrite;
        graph.pass("make").write(&mut list, transfer, Start::Discard).finish("make");
        if self.unread {
            graph.pass("waste").write(&mut unread, transfer, Start::Discard).finish("waste");
        }
        let pass = graph.pass(self.pass_name).read(&list, self.access);
        let pass = pass.write(&mut target, Access::ColorAttachment, self.start);
        let pass = if self.side_effect { pass.side_effect() } else { pass };
        pass.finish("draw");
        graph
    }

    fn plan(&self) -> Plan {
        self.graph().compile(need).unwrap()
    }
}

#[test]
fn a_graph_that_is_declared_again_has_the_plan_and_its_own_bodies() {
    let plan = SHAPE.plan();
    assert_eq!(plan.culled.len(), 1);
    let again = SHAPE.graph();
    assert!(plan.has_shape_of(&again) && plan.has_sizes_of(&again));
    let bodies: Vec<_> = plan.passes.iter().map(|pass| again.bodies[pass.declared]).collect();
    assert_eq!(bodies, ["make", "draw"]);
}

#[test]
fn the_size_of_a_buffer_is_no_part_of_the_shape() {
    let larger = Shape { list: BufferDesc { size_bytes: 1536, ..SHAPE.list }, ..SHAPE };
    let mut plan = SHAPE.plan();
    let graph = larger.graph();
    assert!(plan.has_shape_of(&graph) && !plan.has_sizes_of(&graph));
    plan.resize(&graph);
    assert!(plan.has_sizes_of(&graph));
    // Compiled by itself it is the same, but for memory.
    let without_memory = |mut plan: Plan| {
        plan.resources.iter_mut().for_each(|resource| resource.slot = None);
        plan.blocks.clear();
        plan.to_string()
    };
    assert_eq!(without_memory(plan), without_memory(larger.plan()));
}

#[test]
fn whatever_else_differs_is_another_shape() {
    let import_read = ImageState { stages: vk::PipelineStageFlags2::FRAGMENT_SHADER, ..SHAPE.initial };
    let others = [
        Shape { list_name: "another list", ..SHAPE },
        Shape { list: BufferDesc { texels: vk::Format::UNDEFINED, ..SHAPE.list }, ..SHAPE },
        Shape { list: BufferDesc { size_bytes: 0, ..SHAPE.list }, ..SHAPE },
        Shape { extent: 65, ..SHAPE },
        Shape { pass_name: "another pass", ..SHAPE },
        Shape { access: Access::UniformReadVertex, ..SHAPE },
        Shape { start: Start::Discard, ..SHAPE },
        Shape { start: Start::Clear(ClearValue::Color([1.0; 4])), ..SHAPE },
        Shape { side_effect: true, ..SHAPE },
        Shape { initial: import_read, ..SHAPE },
        Shape { unread: false, ..SHAPE },
    ];
    let plan = SHAPE.plan();
    for (i, other) in others.iter().enumerate() {
        assert!(!plan.has_shape_of(&other.graph()), "{i}");
    }
    // A pass, or a resource, more; and one that is refused.
    let mut more = SHAPE.graph();
    let mut list = more.create_buffer("more", buffer());
    assert!(!plan.has_shape_of(&more));
    more.pass("more").write(&mut list, Access::TransferWrite, Start::Discard).finish("more");
    assert!(!plan.has_shape_of(&more));
    let mut foreign = SHAPE.graph();
    foreign.declared.passes[2].foreign = Some(ResourceId(0));
    assert!(!plan.has_shape_of(&foreign));
    let mut stale = SHAPE.graph();
    let mut uses = stale.declared.passes[2].uses.to_vec();
    uses[0].version = 0;
    stale.declared.passes[2].uses = stale.arena().list(uses);
    assert!(!plan.has_shape_of(&stale));
}
