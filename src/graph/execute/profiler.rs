//! What a frame costs: its time, or the time of each pass, or counts of vertices and fragments, or of invocations of
//! compute.
//!
//! Each is taken in frames of its own: counting costs time, and so do timestamps. On llvmpipe one is work in every part of
//! the image that was drawn to last: in an image of 4096×4096 pixels, more than half a millisecond behind each dispatch.

use ash::vk;

use crate::{
    error::Result,
    graph::{PassKind, PlannedPass},
    vk::{Device, Statistics, Timestamps},
};

/// The most passes of a frame that are measured; what comes after them is not.
const MAX_PASSES: u32 = 2048;

/// What is measured.
///
/// ```no_run
/// use surfel::embed::{Profile, View, ViewFrame};
///
/// fn timed(frame: ViewFrame<'_>) -> ViewFrame<'_> {
///     ViewFrame { profile: Some(Profile::Times), ..frame }
/// }
///
/// /// Once that frame, which was prepared last, has finished.
/// unsafe fn tell(view: &View) -> surfel::Result<()> {
///     // SAFETY: this function's contract.
///     let all = unsafe { view.each_pass(|pass| println!("{}: {:?} s", pass.name, pass.secs)) }?;
///     println!("{all:?} s in all");
///     Ok(())
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Profile {
    /// The frame's time: one timestamp before its first pass, and one behind its last.
    Frame,
    /// The time of each pass: one timestamp more behind each, so that it is from the end of the pass before, its barriers
    /// with it.
    Times,
    /// Counts of vertices and fragments, and of invocations of compute.
    Counts,
}

/// Measures one frame at a time.
pub struct Profiler {
    queries: Queries,
    passes: Vec<(String, PassKind)>,
}

enum Queries {
    Frame(Timestamps),
    Times(Timestamps),
    Counts(Statistics),
    /// The device can't.
    Nothing,
}

/// What one frame's passes cost, in their order.
#[derive(Clone, Debug, Default)]
pub struct FrameProfile {
    /// One a pass.
    pub passes: Vec<PassProfile>,
    /// From before the first pass to behind the last; `None` where not measured. With [`Profile::Times`] to behind the last that
    /// is timed, with what timing them costs.
    pub span_secs: Option<f64>,
}

/// What one pass cost.
#[derive(Clone, Debug)]
pub struct PassProfile {
    /// The pass.
    pub name: String,
    /// Its time; `None` where not measured.
    pub secs: Option<f64>,
    /// Its counts; `None` where not measured, and for a pass that doesn't draw.
    pub counts: Option<PassCounts>,
    /// Invocations of its compute stage; `None` where not measured, and for a pass that doesn't dispatch.
    pub invocations: Option<u64>,
}

/// The same, by a name that lies where the pass was measured.
#[derive(Clone, Copy, Debug)]
pub struct PassFigures<'a> {
    /// The pass.
    pub name: &'a str,
    /// Its time; `None` where not measured.
    pub secs: Option<f64>,
    /// Its counts; `None` where not measured, and for a pass that doesn't draw.
    pub counts: Option<PassCounts>,
    /// Invocations of its compute stage; `None` where not measured, and for a pass that doesn't dispatch.
    pub invocations: Option<u64>,
}

/// What a graphics pass shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PassCounts {
    /// Invocations of the vertex stage.
    pub vertices: u64,
    /// Invocations of the fragment stage.
    pub fragments: u64,
}

impl Profiler {
    /// A profiler; where the device can't measure, its figures are `None`.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(device: &Device, profile: Profile) -> Result<Self> {
        let queries = match profile {
            Profile::Frame => Timestamps::new(device, "frame time", 2)?.map(Queries::Frame),
            Profile::Times => Timestamps::new(device, "pass times", MAX_PASSES + 1)?.map(Queries::Times),
            Profile::Counts => Statistics::new(device, "pass counts", MAX_PASSES)?.map(Queries::Counts),
        };
        Ok(Self { queries: queries.unwrap_or(Queries::Nothing), passes: Vec::new() })
    }

    /// The figures of the last frame.
    ///
    /// # Errors
    /// Whatever the driver answers.
    ///
    /// # Safety
    /// As [`Self::each`].
    pub unsafe fn read(&self) -> Result<FrameProfile> {
        let mut passes = Vec::with_capacity(self.passes.len());
        let mut keep = |PassFigures { name, secs, counts, invocations }: PassFigures<'_>| {
            passes.push(PassProfile { name: name.to_owned(), secs, counts, invocations });
        };
        // SAFETY: this function's contract.
        let span_secs = unsafe { self.each(&mut keep) }?;
        Ok(FrameProfile { passes, span_secs })
    }

    /// Tells the figures of the last frame, pass by pass, and answers with its [`FrameProfile::span_secs`]; takes nothing from the heap.
    ///
    /// # Errors
    /// Whatever the driver answers.
    ///
    /// # Safety
    /// That frame has finished: before it has begun, its queries are not even reset.
    pub unsafe fn each(&self, tell: &mut dyn FnMut(PassFigures<'_>)) -> Result<Option<f64>> {
        // SAFETY: this function's contract: the frame resets them.
        let tick = |timestamps: &Timestamps, index: u32| unsafe { timestamps.read(index) };
        let (begin, mut end) = match &self.queries {
            Queries::Frame(timestamps) => (tick(timestamps, 0)?, tick(timestamps, 1)?),
            Queries::Times(timestamps) => (tick(timestamps, 0)?, None),
            Queries::Counts(_) | Queries::Nothing => (None, None),
        };
        let mut before = begin;
        for ((name, kind), pass) in self.passes.iter().zip(0..) {
            let (mut secs, mut counted) = (None, None);
            match &self.queries {
                Queries::Times(timestamps) if pass < MAX_PASSES => {
                    end = tick(timestamps, pass + 1)?;
                    secs = secs_between(timestamps, before, end);
                    before = end;
                }
                Queries::Counts(statistics) if pass < MAX_PASSES => {
                    // SAFETY: this function's contract.
                    counted = unsafe { statistics.read(pass) }?;
                }
                _ => {}
            }
            tell(PassFigures {
                name,
                secs,
                counts: counted
                    .filter(|_| *kind == PassKind::Graphics)
                    .map(|[vertices, fragments, _]| PassCounts { vertices, fragments }),
                invocations: counted
                    .filter(|_| *kind == PassKind::Compute)
                    .map(|[.., invocations]| invocations),
            });
        }
        Ok(match &self.queries {
            Queries::Frame(timestamps) | Queries::Times(timestamps) => secs_between(timestamps, begin, end),
            Queries::Counts(_) | Queries::Nothing => None,
        })
    }

    /// # Safety
    /// `commands` must be recording outside of rendering; the frame measured before has finished.
    pub(super) unsafe fn begin_frame(&mut self, commands: vk::CommandBuffer, passes: &[PlannedPass]) {
        let is_same = |((name, kind), pass): (&(String, PassKind), &PlannedPass)| {
            *name == pass.name && *kind == pass.kind
        };
        // A frame like the one before takes nothing from the heap.
        if self.passes.len() != passes.len() || !self.passes.iter().zip(passes).all(is_same) {
            self.passes = passes.iter().map(|pass| (pass.name.clone(), pass.kind)).collect();
        }
        let count = self.passes.len() as u32 + 1;
        // SAFETY: this function's contract.
        unsafe {
            match &self.queries {
                Queries::Frame(timestamps) | Queries::Times(timestamps) => {
                    timestamps.reset(commands, count.max(2));
                    timestamps.write(commands, 0);
                }
                Queries::Counts(statistics) => statistics.reset(commands, count),
                Queries::Nothing => {}
            }
        }
    }

    /// Counts begin inside of rendering where a pass draws: nothing but its draws, or its dispatches, shall be counted.
    ///
    /// # Safety
    /// After [`Profiler::begin_frame`], at most once for each pass, in order; `commands` is inside of the pass's rendering, where it
    /// has one.
    pub(super) unsafe fn begin_counts(&self, commands: vk::CommandBuffer, pass: u32) {
        if let (Queries::Counts(statistics), true) = (&self.queries, pass < MAX_PASSES) {
            // SAFETY: this function's contract.
            unsafe { statistics.begin(commands, pass) };
        }
    }

    /// # Safety
    /// After [`Profiler::begin_counts`], in the same rendering, where there is one.
    pub(super) unsafe fn end_counts(&self, commands: vk::CommandBuffer, pass: u32) {
        if let (Queries::Counts(statistics), true) = (&self.queries, pass < MAX_PASSES) {
            // SAFETY: this function's contract.
            unsafe { statistics.end(commands, pass) };
        }
    }

    /// # Safety
    /// After [`Profiler::begin_frame`], once for each pass, in order, outside of rendering and after its last command.
    pub(super) unsafe fn end_pass(&self, commands: vk::CommandBuffer, pass: u32) {
        let (timestamps, index) = match &self.queries {
            Queries::Frame(timestamps) if pass as usize + 1 == self.passes.len() => (timestamps, 1),
            Queries::Times(timestamps) if pass < MAX_PASSES => (timestamps, pass + 1),
            _ => return,
        };
        // SAFETY: this function's contract; each index is written once after the reset.
        unsafe { timestamps.write(commands, index) };
    }
}

/// Seconds between two timestamps; `None` where one was not written.
fn secs_between(timestamps: &Timestamps, begin: Option<u64>, end: Option<u64>) -> Option<f64> {
    begin.zip(end).map(|(begin, end)| timestamps.seconds_between(begin, end))
}
