//! Measures what the device can do at most, one thing at a time; see [`limit_passes::limit_draws`].

use ash::vk;

use super::{
    floor::Points,
    floor_passes::limits::{self as limit_passes, LimitDispatch, LimitInputs},
    limit_points::{covering_points, small_points},
};
use crate::renderer::{Headless, headless::submit_and_wait};
use crate::{
    arena::Arena,
    error::Result,
    frame::{FrameSlot, SlotParts},
    graph::{
        BufferDesc as GraphBufferDesc, BufferState, Graph, Handle,
        execute::{Body, FrameProfile, Kept, PassProfile, Physical, Profile, Profiler},
    },
    passes::{self, Needs, Place, Source},
    report::ThroughputProbe,
    scene::{Accumulate, Camera, Settings},
    vk::{Buffer, BufferDesc, MemoryUse},
};

/// Points of a draw that is about points, not fragments.
const POINTS: usize = 1 << 18;

/// Side of the points that make fragments.
const POINT_SIDE_PX: u32 = 32;

/// What is copied: more than any cache of a device holds.
const COPY_BYTES: u64 = 256 << 20;

/// A measurement that is shorter is repeated within itself, so that what it costs to begin one does not count.
const LONG_ENOUGH_SECS: f64 = 3e-3;

/// The fewest repeats of what covers the image: clearing it, and bringing it into caches where a driver draws tile by tile,
/// is for all of them together.
const FEWEST_COVERS: u32 = 8;

/// The most repeats within a measurement.
const MOST_REPEATS: u32 = 1 << 12;

/// One limit of the device, ready to be measured again and again.
pub struct Probe {
    limit: ThroughputProbe,
    /// What it works on: points to draw; source and target of a copy; what a dispatch writes.
    buffers: Vec<Buffer>,
    /// Where it is one of compute.
    dispatch: Option<LimitDispatch>,
    /// Points in the first of them.
    points: u32,
    /// Units of work in one repeat.
    units: u64,
    repeats: u32,
    slot: FrameSlot,
}

/// All limits that this device has the memory for.
pub struct LimitProbes {
    settings: Settings,
    /// One a limit.
    pub probes: Vec<Probe>,
    /// What could not be set up, a sentence each.
    pub notes: Vec<String>,
}

impl LimitProbes {
    /// Sets all up and finds out how often each must be repeated to be timed well. Images are as large as those of frames
    /// with these settings, and sums as precise.
    ///
    /// # Errors
    /// Whatever the driver answers; memory that is missing for the copy only leaves that out.
    pub fn new(headless: &Headless, settings: &Settings) -> Result<Self> {
        let outside = vec![[2.0, 2.0, 2.0, 1.0]; POINTS];
        let point_px = match headless.renderer.limits.point_size_range[1] {
            most if most < POINT_SIDE_PX as f32 => 1,
            _ => POINT_SIDE_PX,
        };
        let (cover, fragments) = covering_points(settings.size_px, point_px);
        let settings = &passes::with_sums(settings, &headless.renderer.limits);
        let mut made = Self { settings: settings.clone(), probes: Vec::new(), notes: Vec::new() };
        let drawn = |limit, points: &[[f32; 4]], units| {
            let Points { buffer, count } = Points::upload(headless, points)?;
            Ok::<_, crate::error::Error>(Probe::new(headless, limit, vec![buffer], count, units))
        };
        made.probes.push(drawn(ThroughputProbe::Points, &outside, POINTS as u64)?);
        let small = small_points(settings.size_px, POINTS);
        made.probes.push(drawn(ThroughputProbe::DrawnPoints, &small, POINTS as u64)?);
        for limit in
            [ThroughputProbe::Fragments, ThroughputProbe::DepthFragments, ThroughputProbe::BlendedFragments]
        {
            made.probes.push(drawn(limit, &cover, fragments)?);
        }
        match copy_buffers(headless) {
            Ok(buffers) => {
                // What is read and what is written.
                let bytes = 2 * buffers[0].size();
                made.probes.push(Probe::new(headless, ThroughputProbe::Bytes, buffers.into(), 0, bytes));
            }
            Err(error) => made.notes.push(format!("bytes are not measured: {error}")),
        }
        for limit in [ThroughputProbe::Invocations, ThroughputProbe::Atomics, ThroughputProbe::Kernels] {
            let Some(dispatch) = LimitDispatch::of(limit, &headless.renderer.limits) else { continue };
            let usage = vk::BufferUsageFlags::STORAGE_BUFFER;
            let words = BufferDesc { name: "words of a limit", size: 4 * dispatch.words, usage };
            let words = Buffer::new(headless.device(), words, MemoryUse::Device)?;
            let probe = Probe::new(headless, limit, vec![words], 0, dispatch.units);
            made.probes.push(Probe { dispatch: Some(dispatch), ..probe });
        }
        for probe in &mut made.probes {
            probe.calibrate(headless, &made.settings)?;
        }
        Ok(made)
    }

    /// Seconds of each probe, in their order; `None` where the device tells no times.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn measure(&mut self, headless: &Headless) -> Result<Vec<Option<f64>>> {
        self.probes.iter_mut().map(|probe| probe.secs(headless, &self.settings)).collect()
    }

    /// Fragments that each probe is seen to shade, of that of compute its invocations, in their order; `None` where there is
    /// nothing to count, or the device does not.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn counted(&mut self, headless: &Headless) -> Result<Vec<Option<u64>>> {
        let settings = &self.settings;
        let counted = |probe: &mut Probe| {
            let profile = probe.run(headless, settings, Profile::Counts)?;
            let counted =
                |pass: &PassProfile| pass.counts.map(|counts| counts.fragments).or(pass.invocations);
            Ok(profile.passes.last().and_then(counted))
        };
        self.probes.iter_mut().map(counted).collect()
    }

    /// Bytes that blending reads and writes a fragment: two sums.
    pub fn bytes_per_blended_fragment(&self) -> u64 {
        match self.settings.accumulate {
            Accumulate::F16 => 2 * 2 * 8,
            Accumulate::F32 | Accumulate::Auto => 2 * 2 * 16,
        }
    }
}

impl Probe {
    fn new(
        headless: &Headless,
        limit: ThroughputProbe,
        buffers: Vec<Buffer>,
        points: u32,
        units: u64,
    ) -> Self {
        let slot = FrameSlot::new(headless.device());
        let covers = matches!(
            limit,
            ThroughputProbe::Fragments | ThroughputProbe::DepthFragments | ThroughputProbe::BlendedFragments
        );
        let repeats = if covers { FEWEST_COVERS } else { 1 };
        Self { limit, buffers, dispatch: None, points, units, repeats, slot }
    }

    /// What it measures.
    pub fn limit(&self) -> ThroughputProbe {
        self.limit
    }

    /// Units of work in one measurement.
    pub fn units(&self) -> u64 {
        self.units * u64::from(self.repeats)
    }

    /// Doubles the repeats until a measurement is long enough. The first of all makes pipelines and touches memory, so
    /// that it tells nothing.
    fn calibrate(&mut self, headless: &Headless, settings: &Settings) -> Result<()> {
        self.secs(headless, settings)?;
        // A copy is long by itself, and one into the memory of another would have to wait for it.
        while self.limit != ThroughputProbe::Bytes && self.repeats < MOST_REPEATS {
            match self.secs(headless, settings)? {
                Some(secs) if secs < LONG_ENOUGH_SECS => self.repeats *= 2,
                _ => break,
            }
        }
        Ok(())
    }

    fn secs(&mut self, headless: &Headless, settings: &Settings) -> Result<Option<f64>> {
        let profile = self.run(headless, settings, Profile::Times)?;
        Ok(profile.passes.last().and_then(|pass| pass.secs))
    }

    fn run(&mut self, headless: &Headless, settings: &Settings, profile: Profile) -> Result<FrameProfile> {
        // Once more, in case that the wait for the measurement before failed.
        headless.queue().wait_submitted()?;
        let room = passes::room_of_lists(1);
        // SAFETY: every submission was waited for.
        unsafe { self.slot.begin(Needs { room, ..Needs::default() }, Some(profile)) }?;
        let SlotParts { descriptors, execution, .. } = self.slot.parts()?;
        let place = Place::Device(&headless.renderer.shaders, descriptors);
        let source = Source::new(place, &Camera::default());
        let inputs = LimitInputs { settings, source, repeats: self.repeats };
        let arena = Arena::new();
        let mut graph = Graph::new(&arena);
        let (mut handles, mut imports) = (Vec::new(), Vec::new());
        for (number, buffer) in self.buffers.iter().enumerate() {
            let handle = import(&mut graph, number, buffer);
            imports.push((handle.id(), Physical::Buffer(buffer.raw())));
            handles.push(handle);
        }
        match (self.limit, handles.as_mut_slice()) {
            (ThroughputProbe::Bytes, [from, to]) => {
                passes::readback_buffer(
                    &mut graph,
                    inputs.source,
                    ThroughputProbe::Bytes.name(),
                    from,
                    to,
                    self.buffers[0].size(),
                );
            }
            (limit, [buffer, ..]) => match self.dispatch {
                Some(dispatch) => limit_passes::limit_dispatch(&mut graph, inputs, limit, dispatch, buffer)?,
                None => limit_passes::limit_draws(&mut graph, inputs, limit, buffer, self.points)?,
            },
            // No probe is made without a buffer.
            (_, []) => return Ok(FrameProfile::default()),
        }
        submit_and_wait(headless, |commands| {
            // SAFETY: recording; all that is used is alive until the wait.
            unsafe { execution.record(commands, &graph, &imports) }.map(drop)
        })?;
        drop(graph);
        // SAFETY: waited for.
        let read = |profiler: &Profiler| unsafe { profiler.read() };
        self.slot.profiler().map_or_else(|| Ok(FrameProfile::default()), read)
    }
}

/// Two buffers to copy between, the first filled.
fn copy_buffers(headless: &Headless) -> Result<[Buffer; 2]> {
    let device = headless.device();
    let size = COPY_BYTES.min(headless.renderer.limits.max_buffer_size) & !3;
    let usage = vk::BufferUsageFlags::TRANSFER_SRC | vk::BufferUsageFlags::TRANSFER_DST;
    let buffer = |name| Buffer::new(device, BufferDesc { name, size, usage }, MemoryUse::Device);
    let buffers = [buffer("what is copied")?, buffer("what it is copied to")?];
    let arena = Arena::new();
    let mut graph: Graph<'_, Body<'_>> = Graph::new(&arena);
    let mut from = import(&mut graph, 0, &buffers[0]);
    let imports = [(from.id(), Physical::Buffer(buffers[0].raw()))];
    limit_passes::limit_fill(&mut graph, &mut from);
    submit_and_wait(headless, |commands| {
        // SAFETY: recording; all that is used is alive until the wait.
        unsafe { Kept::default().execute(device, commands, &graph, &imports, None) }.map(drop)
    })?;
    Ok(buffers)
}

/// A buffer of a limit: the measurement before may have written it.
fn import(graph: &mut Graph<'_, Body<'_>>, number: usize, buffer: &Buffer) -> Handle<crate::graph::Buffer> {
    let initial = BufferState {
        stages: vk::PipelineStageFlags2::ALL_TRANSFER | vk::PipelineStageFlags2::COMPUTE_SHADER,
        access: vk::AccessFlags2::TRANSFER_WRITE | vk::AccessFlags2::SHADER_STORAGE_WRITE,
    };
    let desc = GraphBufferDesc::of_bytes(buffer.size());
    graph.import_buffer(format_args!("buffer {number} of a limit"), desc, initial, None)
}
