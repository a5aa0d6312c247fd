//! What the device can do at most, one thing at a time: points without fragments, fragments without computing, blending,
//! copies, invocations, atomics, splats at pixels. Each is a pass of its own that repeats the one thing, and nothing else, for long enough to be timed.
//!
//! Fragments come from points of 32 pixels: a triangle over the whole image would be drawn only once by a driver that
//! sees that the next one hides it tile by tile.

use std::fmt::Display;

use ash::vk;

use crate::passes::pipeline::formats::{DEPTH_FORMAT, sum_format};
use crate::passes::{
    pass::{Pass, Source},
    pipeline::{
        key::{ComputeKey, GraphicsKey, Layout},
        variant::splat_constants,
    },
    place::{Place, lists},
    plan::invocations::Invocations,
};
use crate::{
    error::{ErrorKind, Result},
    graph::{
        Access, Buffer, ClearValue, Graph, Handle, Image, ImageDesc, Start,
        execute::{Body, PassContext},
    },
    report::ThroughputProbe,
    scene::{Settings, TileInvocations},
    shaders::{self, Shader, config::*},
    vk::{Blend, Limits},
};

/// Why there are its passes.
const WHY: &str = "bench floor: what the device can do at most";

/// Splats of each invocation of the kernels' limit.
const KERNEL_SPLATS: u32 = 64;

/// A row of workgroups of a limit of compute.
#[derive(Clone, Copy, Debug)]
pub struct LimitDispatch {
    shader: &'static Shader,
    atomics: bool,
    groups: u32,
    /// Invocations of it.
    pub invocations: u64,
    /// Units of the limit.
    pub units: u64,
    /// Words of the buffer that it writes to.
    pub words: u64,
}

impl LimitDispatch {
    /// That of a limit as this device has it; `None` where it is not one of compute.
    pub fn of(limit: ThroughputProbe, limits: &Limits) -> Option<Self> {
        const GROUPS: u32 = 4096;
        const GROUPS_OF_KERNELS: u32 = 256;
        let nothing = Self {
            shader: &shaders::LIMIT_COMPUTE_COMP,
            atomics: false,
            groups: GROUPS,
            invocations: u64::from(LIMIT_GROUP_SIZE) * u64::from(GROUPS),
            units: u64::from(LIMIT_GROUP_SIZE) * u64::from(GROUPS),
            words: GROUPS.into(),
        };
        match limit {
            ThroughputProbe::Invocations => Some(nothing),
            ThroughputProbe::Atomics => Some(Self { atomics: true, words: nothing.invocations, ..nothing }),
            ThroughputProbe::Kernels => {
                let invocations = u64::from(KERNELS_GROUP_SIZE) * u64::from(GROUPS_OF_KERNELS);
                let (shader, pixels) = match Invocations::of(TileInvocations::Auto, limits, false) {
                    Invocations::Pixels => (&shaders::LIMIT_KERNELS_PIXELS_COMP, 1),
                    columns => (&shaders::LIMIT_KERNELS_COMP, columns.tile_height().into()),
                };
                let units = invocations * pixels * u64::from(KERNEL_SPLATS);
                Some(Self {
                    shader,
                    groups: GROUPS_OF_KERNELS,
                    invocations,
                    units,
                    words: invocations,
                    ..nothing
                })
            }
            _ => None,
        }
    }
}

/// What the pass of a limit is given.
#[derive(Clone, Copy)]
pub struct LimitInputs<'a> {
    /// Size of the image and format of the sums.
    pub settings: &'a Settings,
    /// Where pipelines and sets come from: room for a set of lists.
    pub source: Source<'a>,
    /// How often the work is done in the pass.
    pub repeats: u32,
}

impl LimitInputs<'_> {
    fn image(
        &self,
        graph: &mut Graph<'_, Body<'_>>,
        name: impl Display,
        format: vk::Format,
    ) -> Handle<Image> {
        let [width, height] = self.settings.size_px;
        graph.create_image(name, ImageDesc { format, extent: vk::Extent2D { width, height } })
    }
}

/// Declares the pass that draws points: those of `count` in `points`, which lie outside of the clip volume for
/// [`ThroughputProbe::Points`], are a pixel each for [`ThroughputProbe::DrawnPoints`], and cover the image for limits of fragments.
///
/// # Errors
/// [`ErrorKind::Graph`] for a limit that is not one of drawing; whatever the driver answers when the pipeline is made.
pub fn limit_draws<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: LimitInputs<'a>,
    limit: ThroughputProbe,
    points: &Handle<Buffer>,
    count: u32,
) -> Result<()> {
    let key = |fragment| {
        let stages = (&shaders::FLOOR_POINTS_VERT, fragment);
        GraphicsKey::new(stages, Layout::Splat, vk::PrimitiveTopology::POINT_LIST, [].into())
    };
    let sums = sum_format(inputs.settings.accumulate);
    let color = vk::Format::R8G8B8A8_UNORM;
    let mut far = 0.0;
    let (key, colors) = match limit {
        ThroughputProbe::Points | ThroughputProbe::Fragments => (key(&shaders::FLOOR_FILL_FRAG), vec![color]),
        ThroughputProbe::DrawnPoints => {
            far = 1.0;
            let depth = Some((vk::CompareOp::GREATER, true));
            (GraphicsKey { depth, ..key(&shaders::FLOOR_DEPTH_FRAG) }, Vec::new())
        }
        // All have one depth, so that every fragment passes and is written.
        ThroughputProbe::DepthFragments => {
            let depth = Some((vk::CompareOp::GREATER_OR_EQUAL, true));
            (GraphicsKey { depth, ..key(&shaders::FLOOR_DEPTH_FRAG) }, Vec::new())
        }
        ThroughputProbe::BlendedFragments => {
            (GraphicsKey { blend: Blend::Add, ..key(&shaders::FLOOR_ADD_FRAG) }, vec![sums; 2])
        }
        ThroughputProbe::Bytes
        | ThroughputProbe::Invocations
        | ThroughputProbe::Atomics
        | ThroughputProbe::Kernels => {
            let (pass, reason) = (limit.name().to_owned(), "is not a limit of drawing".to_owned());
            return Err(ErrorKind::Graph { pass, resource: String::new(), reason }.into());
        }
    };
    let has_depth = key.depth.is_some();
    let mut images: Vec<_> = (0..)
        .zip(&colors)
        .map(|(i, format)| inputs.image(graph, format_args!("limit color {i}"), *format))
        .collect();
    let mut depth = has_depth.then(|| inputs.image(graph, "limit depth", DEPTH_FORMAT));
    // Nobody reads what is drawn.
    let mut pass = Pass::new(graph, inputs.source, limit.name(), WHY)
        .read(lists(BIND_LIST_POINTS), points, Access::StorageReadVertex)
        .side_effect();
    for image in &mut images {
        pass = pass.attach(image, Access::ColorAttachment, Start::Clear(ClearValue::Color([0.0; 4])));
    }
    if let Some(depth) = &mut depth {
        pass = pass.attach(depth, Access::DepthAttachment, Start::Clear(ClearValue::Depth(far)));
    }
    let pipeline = pass.graphics(GraphicsKey { color_formats: colors.into_iter().collect(), ..key })?;
    pass.finish(move |pass| {
        pass.bind(pipeline);
        pass.bind_sets(pipeline.layout, 1, &[pass.set(Place::Lists(0))?])?;
        for _ in 0..inputs.repeats {
            pass.draw([count, 1]);
        }
        Ok(())
    });
    Ok(())
}

/// Declares the pass that fills a buffer: memory that was never written may not be there at all.
pub fn limit_fill<'a>(graph: &mut Graph<'a, Body<'a>>, buffer: &mut Handle<Buffer>) {
    let id = buffer.id();
    let fill = graph.arena().keep(move |context: &PassContext<'_>| {
        // SAFETY: outside of rendering; all of a buffer made for transfers, whose size is a multiple of 4.
        unsafe {
            let (device, commands) = (context.device(), context.commands());
            device.cmd_fill_buffer(commands, context.buffer(id)?, 0, vk::WHOLE_SIZE, 0x3c5a_96e1);
        }
        Ok(())
    });
    graph.pass("fill what is copied").write(buffer, Access::TransferWrite, Start::Discard).finish(fill);
}

/// Declares the pass that dispatches a limit of compute, `repeats` rows of it, which write to `words`.
///
/// # Errors
/// Whatever the driver answers when the pipeline is made.
pub fn limit_dispatch<'a>(
    graph: &mut Graph<'a, Body<'a>>,
    inputs: LimitInputs<'a>,
    limit: ThroughputProbe,
    dispatch: LimitDispatch,
    words: &mut Handle<Buffer>,
) -> Result<()> {
    let LimitDispatch { shader, atomics, groups, .. } = dispatch;
    // Those that are not the shader's own have no effect.
    let mut constants = splat_constants(inputs.settings, inputs.settings.size_px, false, false);
    constants.extend([(SPEC_LIMIT_SPLATS, KERNEL_SPLATS), (SPEC_ATOMICS, atomics.into())]);
    let pass = Pass::new(graph, inputs.source, limit.name(), WHY).write(
        lists(BIND_LIST_POINTS),
        words,
        Access::StorageReadWriteCompute,
        Start::Load,
    );
    let pipeline = pass.compute(ComputeKey { shader, layout: Layout::List, constants })?;
    pass.finish(move |pass| {
        // The shader uses no push constants.
        pass.bind(pipeline);
        pass.bind_sets(pipeline.layout, 1, &[pass.set(Place::Lists(0))?])?;
        pass.dispatch([groups, inputs.repeats]);
        Ok(())
    });
    Ok(())
}
