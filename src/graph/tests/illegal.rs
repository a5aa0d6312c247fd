//! Illegal graphs, each with the sentence that refuses it.

use super::*;

/// What is said of a graph with a color image, a depth image and a buffer, none of them written yet.
fn refusal(
    declare: impl FnOnce(&mut Graph<'_, ()>, &mut Handle<Image>, &mut Handle<Image>, &mut Handle<Buffer>),
) -> String {
    let mut graph = graph();
    let mut color = graph.create_image("color", image(COLOR));
    let mut depth = graph.create_image("depth", image(DEPTH));
    let mut list = graph.create_buffer("list", buffer());
    declare(&mut graph, &mut color, &mut depth, &mut list);
    let error = graph.compile(need).map(|compiled| compiled.to_string()).unwrap_err();
    assert!(matches!(error.kind(), crate::error::ErrorKind::Graph { .. }));
    error.to_string().strip_prefix("illegal render graph: ").unwrap().to_owned()
}

#[test]
fn contents_that_nobody_wrote() {
    let read = refusal(|g, c, d, _| {
        g.pass("p").read(c, Access::SampledFragment).write(d, Access::DepthAttachment, FAR).finish(());
    });
    assert_eq!(read, "pass 'p', resource 'color': SampledFragment reads what no earlier pass has written");
    let load = refusal(|g, c, _, _| g.pass("p").write(c, Access::ColorAttachment, Start::Load).finish(()));
    assert_eq!(load, "pass 'p', resource 'color': ColorAttachment loads what no earlier pass has written");
    let import = refusal(|g, _, _, _| {
        let mut target = import_target(g);
        g.pass("p").write(&mut target, Access::ColorAttachment, Start::Load).finish(());
    });
    assert_eq!(import, "pass 'p', resource 'target': ColorAttachment loads what no earlier pass has written");
}

#[test]
fn conflicts_inside_a_pass() {
    let conflict = refusal(|g, c, _, _| {
        let pass = g.pass("p").write(c, Access::ColorAttachment, BLACK);
        pass.read(c, Access::SampledFragment).finish(());
    });
    let expected =
        "pass 'p', resource 'color': ColorAttachment and SampledFragment conflict: one of them writes";
    assert_eq!(conflict, expected);
    let layouts = refusal(|g, c, _, _| {
        g.pass("w").write(c, Access::StorageWriteCompute, Start::Discard).finish(());
        let pass = g.pass("p").read(c, Access::SampledCompute);
        pass.read(c, Access::StorageReadCompute).finish(());
    });
    let expected = "pass 'p', resource 'color': SampledCompute and StorageReadCompute need different layouts";
    assert_eq!(layouts, expected);
    let twice = refusal(|g, _, _, l| {
        g.pass("w").write(l, Access::StorageWriteCompute, Start::Discard).finish(());
        g.pass("p").read(l, Access::StorageReadCompute).read(l, Access::StorageReadCompute).finish(());
    });
    assert_eq!(twice, "pass 'p', resource 'list': StorageReadCompute is declared twice");
}

#[test]
fn handles_that_do_not_belong_here() {
    let stale = refusal(|g, c, _, _| {
        drop(g.pass("forgotten").write(c, Access::ColorAttachment, BLACK));
        g.pass("p").write(c, Access::ColorAttachment, BLACK).finish(());
    });
    let expected = "pass 'p', resource 'color': the handle is stale: it took part in 1 write(s), of which 0 are in \
                    the graph; the pass of the other was not finished";
    assert_eq!(stale, expected);
    let mut other = graph::<()>();
    let mut alien = other.create_image("alien", image(COLOR));
    let foreign =
        refusal(|g, _, _, _| g.pass("p").write(&mut alien, Access::ColorAttachment, BLACK).finish(()));
    assert_eq!(foreign, "pass 'p', resource '#0': the handle belongs to another graph");
}

#[test]
fn accesses_that_do_not_fit_the_resource() {
    let depth = refusal(|g, c, _, _| g.pass("p").write(c, Access::DepthAttachment, FAR).finish(()));
    let expected =
        "pass 'p', resource 'color': DepthAttachment needs a depth format, not R16G16B16A16_SFLOAT";
    assert_eq!(depth, expected);
    for access in [Access::ColorAttachment, Access::StorageWriteCompute] {
        let color = refusal(|g, _, d, _| g.pass("p").write(d, access, Start::Discard).finish(()));
        assert_eq!(
            color,
            format!("pass 'p', resource 'depth': {access:?} needs a color format, not D32_SFLOAT")
        );
    }
    let image = refusal(|g, c, _, _| g.pass("p").read(c, Access::IndirectRead).finish(()));
    assert_eq!(image, "pass 'p', resource 'color': IndirectRead is not an access to an image");
    let buffer = refusal(|g, _, _, l| g.pass("p").read(l, Access::SampledFragment).finish(()));
    assert_eq!(buffer, "pass 'p', resource 'list': SampledFragment is not an access to a buffer");
    let reads = refusal(|g, _, _, l| g.pass("p").read(l, Access::TransferWrite).finish(()));
    assert_eq!(reads, "pass 'p', resource 'list': TransferWrite writes: declare it by `write`");
    let writes = refusal(|g, _, _, l| g.pass("p").write(l, Access::TransferRead, Start::Discard).finish(()));
    assert_eq!(writes, "pass 'p', resource 'list': TransferRead only reads: declare it by `read`");
}

#[test]
fn clears_that_can_not_be() {
    let cases: [(bool, Access, Start, &str); 4] = [
        (
            true,
            Access::TransferWrite,
            BLACK,
            "'color': TransferWrite can't begin with a clear: only attachments can",
        ),
        (true, Access::ColorAttachment, FAR, "'color': a color can't be cleared to a depth"),
        (false, Access::DepthAttachment, BLACK, "'depth': a depth can't be cleared to a color"),
        (
            false,
            Access::DepthAttachment,
            Start::Clear(ClearValue::Depth(f32::NAN)),
            "'depth': a depth is cleared to NaN: expected 0 to 1",
        ),
    ];
    for (is_color, access, start, expected) in cases {
        let said = refusal(|g, c, d, _| {
            g.pass("p").write(if is_color { c } else { d }, access, start).finish(());
        });
        assert_eq!(said, format!("pass 'p', resource {expected}"));
    }
}

#[test]
fn attachments_that_do_not_go_together() {
    let sizes = refusal(|g, c, _, _| {
        let extent = vk::Extent2D { width: 8, height: 4 };
        let mut small = g.create_image("small", ImageDesc { format: DEPTH, extent });
        let pass = g.pass("p").write(c, Access::ColorAttachment, BLACK);
        pass.write(&mut small, Access::DepthAttachment, FAR).finish(());
    });
    let expected = "pass 'p', resource 'small': its size 8x4 differs from that of attachment 'color', 64x32";
    assert_eq!(sizes, expected);
    let depths = refusal(|g, _, d, _| {
        let mut second = g.create_image("second", image(DEPTH));
        let pass = g.pass("p").write(d, Access::DepthAttachment, FAR);
        pass.write(&mut second, Access::DepthAttachment, FAR).finish(());
    });
    assert_eq!(depths, "pass 'p', resource 'second': it is the second depth attachment of the pass");
}

#[test]
fn passes_of_no_kind_or_of_two() {
    let none = refusal(|g, _, _, _| g.pass("p").side_effect().finish(()));
    assert_eq!(none, "pass 'p': no access says whether it draws, dispatches or copies");
    let two = refusal(|g, c, _, l| {
        let pass = g.pass("p").write(c, Access::ColorAttachment, BLACK);
        pass.write(l, Access::TransferWrite, Start::Discard).finish(());
    });
    let expected =
        "pass 'p': ColorAttachment and TransferWrite are of different kinds of passes; make it two";
    assert_eq!(two, expected);
    let nothing_to_draw_to = refusal(|g, _, _, l| {
        g.pass("w").write(l, Access::TransferWrite, Start::Discard).finish(());
        g.pass("p").read(l, Access::StorageReadVertex).finish(());
    });
    assert_eq!(nothing_to_draw_to, "pass 'p': it draws but has no attachment");
}

#[test]
fn names_and_dimensions() {
    let pass = |g: &mut Graph<'_, ()>, name: &str, l: &mut Handle<Buffer>| {
        g.pass(name).write(l, Access::TransferWrite, Start::Discard).finish(());
    };
    assert_eq!(refusal(|g, _, _, l| pass(g, "", l)), "a pass has no name");
    let same = refusal(|g, _, _, l| {
        pass(g, "p", l);
        pass(g, "p", l);
    });
    assert_eq!(same, "pass 'p': another pass has this name");
    let same = refusal(|g, _, _, _| {
        let _ = g.create_buffer("color", buffer());
    });
    assert_eq!(same, "resource 'color': another resource has this name");
    assert_eq!(
        refusal(|g, _, _, _| {
            let _ = g.create_buffer("", buffer());
        }),
        "a resource has no name"
    );
    let empty = refusal(|g, _, _, _| {
        let _ = g.create_buffer("b", BufferDesc::of_bytes(0));
    });
    assert_eq!(empty, "resource 'b': a buffer needs at least one byte");
    let wordless =
        refusal(|g, _, _, l| g.pass("p").read(l, Access::TexelReadCompute).side_effect().finish(()));
    assert_eq!(wordless, "pass 'p', resource 'list': TexelReadCompute needs a format of texels");
    let extent = vk::Extent2D { width: 4, height: 0 };
    let empty = refusal(|g, _, _, _| {
        let _ = g.create_image("i", ImageDesc { format: COLOR, extent });
    });
    assert_eq!(empty, "resource 'i': an image needs at least one pixel");
    let formless = refusal(|g, _, _, _| {
        let _ = g.create_image("i", image(vk::Format::UNDEFINED));
    });
    assert_eq!(formless, "resource 'i': an image needs a format");
    let state = Some(ImageState::default());
    let nowhere = refusal(|g, _, _, _| {
        let _ = g.import_image("i", image(COLOR), ImageState::default(), state);
    });
    assert_eq!(nowhere, "resource 'i': no image can be brought into its final layout");
}
