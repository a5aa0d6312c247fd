//! The plan in words and as a drawing, of one small frame.

use super::*;

fn frame() -> Plan {
    let mut graph = graph();
    let uploaded =
        BufferState { stages: vk::PipelineStageFlags2::COPY, access: vk::AccessFlags2::TRANSFER_WRITE };
    let splats = graph.import_buffer("splats", buffer(), uploaded, None);
    let mut target = import_target(&mut graph);
    let mut depth = graph.create_image("depth", image(DEPTH));
    let mut debug = graph.create_image("debug \"view\"", image(COLOR));
    graph
        .pass("visibility")
        .read(&splats, Access::StorageReadVertex)
        .write(&mut depth, Access::DepthAttachment, FAR)
        .finish(());
    graph
        .pass("debug")
        .read(&depth, Access::SampledFragment)
        .write(&mut debug, Access::ColorAttachment, BLACK)
        .finish(());
    graph
        .pass("shading")
        .read(&depth, Access::SampledFragment)
        .write(&mut target, Access::ColorAttachment, Start::Discard)
        .finish(());
    plan_of(graph)
}

#[test]
fn the_plan_in_words() {
    assert_eq!(frame().to_string(), WORDS);
}

#[test]
fn the_plan_as_a_drawing() {
    assert_eq!(frame().to_dot(), DOT);
}

const WORDS: &str = r#"resources
  splats: imported buffer of 1024 bytes, pass 0, STORAGE_BUFFER
    initially COPY (TRANSFER_WRITE)
    left as VERTEX_SHADER | COPY (TRANSFER_WRITE)
  target: imported image 64x32 R16G16B16A16_SFLOAT, pass 1, COLOR_ATTACHMENT
    initially nothing, UNDEFINED
    finally nothing, PRESENT_SRC_KHR
  depth: transient image 64x32 D32_SFLOAT, passes 0 to 1, SAMPLED | DEPTH_STENCIL_ATTACHMENT, block 0 at 0, 8192 bytes
  debug "view": transient image 64x32 R16G16B16A16_SFLOAT, unused
memory
  block 0: images, 8192 bytes, alignment 256, memory types 0b11
pass 0 'visibility', graphics 64x32
  wait for splats (ReadAfterWrite): COPY (TRANSFER_WRITE) before VERTEX_SHADER (SHADER_STORAGE_READ)
  wait for depth (FirstUse after depth): FRAGMENT_SHADER before EARLY_FRAGMENT_TESTS | LATE_FRAGMENT_TESTS (DEPTH_STENCIL_ATTACHMENT_READ | DEPTH_STENCIL_ATTACHMENT_WRITE), UNDEFINED to ATTACHMENT_OPTIMAL
  splats: StorageReadVertex
  depth: DepthAttachment, cleared to 0.0; load CLEAR, store STORE
pass 1 'shading', graphics 64x32
  wait for depth (ReadAfterWrite): EARLY_FRAGMENT_TESTS | LATE_FRAGMENT_TESTS (DEPTH_STENCIL_ATTACHMENT_WRITE) before FRAGMENT_SHADER (SHADER_SAMPLED_READ), ATTACHMENT_OPTIMAL to READ_ONLY_OPTIMAL
  wait for target (Layout): nothing before COLOR_ATTACHMENT_OUTPUT (COLOR_ATTACHMENT_READ | COLOR_ATTACHMENT_WRITE), UNDEFINED to ATTACHMENT_OPTIMAL
  depth: SampledFragment
  target: ColorAttachment, old content discarded; load DONT_CARE, store STORE
after the last pass
  wait for target (ReadAfterWrite): COLOR_ATTACHMENT_OUTPUT (COLOR_ATTACHMENT_WRITE) before nothing, ATTACHMENT_OPTIMAL to PRESENT_SRC_KHR
culled pass 'debug'
"#;
const DOT: &str = r#"digraph frame {
  rankdir=LR;
  "pass visibility" [shape=box, label="visibility"];
  "pass shading" [shape=box, label="shading"];
  "pass debug" [shape=box, label="debug", style=dashed];
  "splats" [shape=ellipse, penwidth=2];
  "target #1" [shape=ellipse, penwidth=2];
  "depth #1" [shape=ellipse];
  "debug \"view\" #1" [shape=ellipse];
  "splats" -> "pass visibility";
  "pass visibility" -> "depth #1";
  "depth #1" -> "pass shading";
  "pass shading" -> "target #1";
  "depth #1" -> "pass debug" [style=dashed];
  "pass debug" -> "debug \"view\" #1" [style=dashed];
}
"#;
