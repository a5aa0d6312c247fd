//! Which passes are left out.

use super::*;

fn color(graph: &mut Graph<'_, ()>, name: &str) -> Handle<Image> {
    graph.create_image(name, image(COLOR))
}

fn draw(
    graph: &mut Graph<'_, ()>,
    name: &str,
    from: Option<&Handle<Image>>,
    to: &mut Handle<Image>,
    start: Start,
) {
    let mut pass = graph.pass(name);
    if let Some(from) = from {
        pass = pass.read(from, Access::SampledFragment);
    }
    pass.write(to, Access::ColorAttachment, start).finish(());
}

#[test]
fn passes_that_lead_nowhere_are_culled_with_what_only_they_read() {
    let mut graph = graph();
    let mut target = import_target(&mut graph);
    let [mut a, mut b] = ["a", "b"].map(|name| color(&mut graph, name));
    draw(&mut graph, "only for b", None, &mut a, BLACK);
    draw(&mut graph, "for nobody", Some(&a), &mut b, BLACK);
    draw(&mut graph, "seen", None, &mut target, BLACK);
    let plan = graph.compile(need).unwrap();
    assert_eq!(pass_names(&plan), ["seen"]);
    assert_eq!(plan.culled.iter().map(|p| &*p.name).collect::<Vec<_>>(), ["only for b", "for nobody"]);
    assert_eq!(plan.resource(a.id()).lifetime, None);
    assert!(plan.blocks.is_empty(), "what isn't used needs no memory");
}

#[test]
fn a_side_effect_keeps_a_pass_and_all_that_it_reads() {
    let mut graph = graph();
    let [mut a, mut b] = ["a", "b"].map(|name| color(&mut graph, name));
    draw(&mut graph, "first", None, &mut a, BLACK);
    graph
        .pass("second")
        .read(&a, Access::SampledFragment)
        .write(&mut b, Access::ColorAttachment, BLACK)
        .side_effect()
        .finish(());
    assert_eq!(pass_names(&plan_of(graph)), ["first", "second"]);
}

#[test]
fn a_content_that_is_overwritten_unread_is_not_made_and_one_that_is_loaded_is() {
    for (start, expected) in [(BLACK, vec!["second"]), (Start::Load, vec!["first", "second"])] {
        let mut graph = graph();
        let mut target = import_target(&mut graph);
        draw(&mut graph, "first", None, &mut target, BLACK);
        draw(&mut graph, "second", None, &mut target, start);
        assert_eq!(pass_names(&plan_of(graph)), expected);
    }
}

#[test]
fn bodies_stay_with_their_passes() {
    let mut graph = graph();
    let last = Some(BufferState::default());
    let mut kept = graph.import_buffer("kept", buffer(), BufferState::default(), last);
    let mut lost = graph.create_buffer("lost", buffer());
    graph.pass("culled").write(&mut lost, Access::TransferWrite, Start::Discard).finish(7);
    graph.pass("left").write(&mut kept, Access::TransferWrite, Start::Discard).finish(8);
    let plan = graph.compile(need).unwrap();
    assert_eq!((pass_names(&plan), graph.bodies[plan.passes[0].declared]), (vec!["left"], 8));
}
