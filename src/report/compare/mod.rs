//! Methods side by side: what each costs and how wrong it is.
//!
//! Two errors are told apart. The **implementation error** is that against the oracle of the same method: what 32 or 16
//! bits, a texture in place of arithmetic, or a fault in a shader cost. The **method error** is that against the ground
//! truth, the filtered continuous surface that every method approximates.

mod errors;
mod method;
mod pareto;
mod plot;
mod ssim;
mod surface;
mod table;

use std::collections::BTreeMap;

use serde::Serialize;

pub use errors::{Deviation, ErrorFigures, errors};
pub use method::{Method, MethodNames, PictureKey, Selection};
pub use pareto::pareto_front;
pub use ssim::ssim;
pub use surface::Surface;

use super::{CameraReport, DeviceReport, FrameTimes, InputReport, PassFigures, Spread};

/// Everything that a comparison found out.
#[derive(Clone, Debug, Serialize)]
pub struct CompareReport {
    /// The version of surfel.
    pub surfel: String,
    /// What it ran on.
    pub device: DeviceReport,
    /// What all methods have in common, by the names of the options; `size` is that of the errors.
    pub settings: BTreeMap<&'static str, String>,
    /// The camera.
    pub camera: CameraReport,
    /// Where the scene came from.
    pub inputs: Vec<InputReport>,
    /// Splats in the scene.
    pub splats: u64,
    /// Width and height at which errors are found, in pixels.
    pub error_size_px: [u32; 2],
    /// Width and height at which frames are timed and fragments counted, in pixels.
    pub time_size_px: [u32; 2],
    /// Samples along a pixel's side in the ground truth.
    pub samples_per_side: u32,
    /// Frames timed of each method.
    pub timed_frames: u32,
    /// The methods, in the order of the options' values.
    pub methods: Vec<MethodRow>,
    /// The methods that could not be compared.
    pub skipped: Vec<Skipped>,
    /// What a reader of these figures has to know, a sentence each.
    pub notes: Vec<String>,
}

/// One method's figures.
#[derive(Clone, Debug, Serialize)]
pub struct MethodRow {
    /// Its names.
    #[serde(flatten)]
    pub method: MethodNames,
    /// Its passes.
    pub passes: Vec<PassRow>,
    /// Milliseconds of a frame whose passes are not timed; `None` where not measured.
    pub frame_ms: Option<Spread>,
    /// Against the oracle of the same method.
    pub implementation_error: ErrorFigures,
    /// Against the ground truth.
    pub method_error: ErrorFigures,
    /// What is odd about its times, a sentence each.
    pub flags: Vec<String>,
    /// No other method is at least as good in the median of `frame_ms` and in the RMS of the method error's image and
    /// better in one of them.
    pub pareto: bool,
}

/// One pass of a method.
#[derive(Clone, Debug, Serialize)]
pub struct PassRow {
    /// The pass.
    pub name: String,
    /// Its milliseconds; `None` where not measured.
    pub ms: Option<Spread>,
    /// Invocations of the vertex stage in one frame; `None` where not counted.
    pub vertices: Option<u64>,
    /// Invocations of the fragment stage in one frame; `None` where not counted.
    pub fragments: Option<u64>,
    /// Instructions of its vertex stage, paper-comparable ([`crate::instruments::counts_of`]); `None` where not counted.
    pub vertex_instructions: Option<u32>,
    /// The same of its fragment stage.
    pub fragment_instructions: Option<u32>,
}

/// A method that could not be compared.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Skipped {
    /// Its names.
    #[serde(flatten)]
    pub method: MethodNames,
    /// Why, in a line.
    pub reason: String,
}

impl MethodRow {
    /// Of a method's frames and errors; whether it is on the front is not known yet.
    pub fn new(
        method: MethodNames,
        times: FrameTimes,
        implementation_error: ErrorFigures,
        method_error: ErrorFigures,
    ) -> Self {
        let pass = |pass: PassFigures| {
            let PassFigures { name, ms, vertices, fragments } = pass;
            PassRow { name, ms, vertices, fragments, vertex_instructions: None, fragment_instructions: None }
        };
        Self {
            method,
            passes: times.passes.into_iter().map(pass).collect(),
            frame_ms: times.frame_ms,
            flags: times.flags,
            implementation_error,
            method_error,
            pareto: false,
        }
    }

    /// Milliseconds of a frame (median) and the RMS of the method error's image; `None` where one is missing.
    pub fn speed_and_error(&self) -> Option<[f64; 2]> {
        Some([self.frame_ms?.median, self.method_error.image?.rms])
    }

    /// Takes over what was counted of its passes.
    #[cfg(feature = "counts")]
    pub fn set_instructions(&mut self, counted: &[crate::count::PassCounts]) {
        for pass in &mut self.passes {
            if let Some(counts) = counted.iter().find(|counts| counts.pass == pass.name) {
                pass.vertex_instructions = counts.vertex.as_ref().and_then(|counts| counts.arb);
                pass.fragment_instructions = counts.fragment.as_ref().and_then(|counts| counts.arb);
            }
        }
    }

    /// Instructions of the pass of this name, as `46/3`; `-` where not counted.
    fn instructions(&self, pass: &str) -> String {
        let row = self.passes.iter().find(|row| row.name == pass);
        match row.and_then(|row| row.vertex_instructions.zip(row.fragment_instructions)) {
            Some((vertex, fragment)) => format!("{vertex}/{fragment}"),
            None => "-".to_owned(),
        }
    }

    /// Fragments of the pass of this name.
    fn fragments(&self, pass: &str) -> Option<u64> {
        self.passes.iter().find(|row| row.name == pass)?.fragments
    }
}

impl CompareReport {
    /// Marks the methods that are on the Pareto front of speed and error.
    pub fn mark_front(&mut self) {
        let figures: Vec<_> = self.methods.iter().map(MethodRow::speed_and_error).collect();
        for (row, on_front) in self.methods.iter_mut().zip(pareto_front(&figures)) {
            row.pareto = on_front;
        }
    }
}

#[cfg(test)]
mod tests;
