//! Methods side by side: what each costs and how wrong it is.
//!
//! Two errors are told apart. The **implementation error** is that against the oracle of the same method: what 32 or 16
//! bits, a texture in place of arithmetic, or a fault in a shader cost. The **method error** is that against the ground
//! truth, the filtered continuous surface that every method approximates; the **picture error** is that of all that is seen, told
//! apart by place ([`super::picture`]).

mod errors;
mod method;
mod pareto;
mod plot;
mod ssim;
mod surface;
mod table;
mod why;

use std::collections::BTreeMap;

use serde::Serialize;

pub use errors::{Deviation, ErrorFigures, errors};
pub use method::{Method, Selection, WeightedFilter};
pub use pareto::pareto_front;
pub use ssim::ssim;
pub use surface::Surface;

use super::{
    CameraReport, DeviceReport, FrameTimes, InputReport, PassFigures, Spread, picture::PictureError,
};

/// Everything that a comparison found out.
#[derive(Clone, Debug, Serialize)]
pub struct CompareReport {
    /// The version of surfel.
    pub surfel: String,
    /// The device.
    pub device: DeviceReport,
    /// The settings that all methods have in common, by the names of the options; `size` is that of the errors.
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
    /// Why each filter ranks as it does, a line each, the nearest to the truth first.
    pub why: Vec<String>,
    /// Notes for a reader of these figures, a sentence each.
    pub notes: Vec<String>,
}

/// One method's figures.
#[derive(Clone, Debug, Serialize)]
pub struct MethodRow {
    /// Which it is.
    #[serde(flatten)]
    pub method: Method,
    /// Its passes.
    pub passes: Vec<PassRow>,
    /// Milliseconds of a frame whose passes are not timed; `None` where not measured.
    pub frame_ms: Option<Spread>,
    /// Against the oracle of the same method.
    pub implementation_error: ErrorFigures,
    /// Against the ground truth, where both have a surface.
    pub method_error: ErrorFigures,
    /// Against the ground truth, of the picture as a whole and by place.
    pub picture_error: PictureError,
    /// Contradictions of its times, a sentence each.
    pub flags: Vec<String>,
    /// No other method is at least as good in the median of `frame_ms` and in the RMS of the whole picture's error and
    /// better in one of them.
    pub pareto: bool,
}

/// One pass of a method.
#[derive(Clone, Debug, Serialize)]
pub struct PassRow {
    /// Its cost.
    #[serde(flatten)]
    pub figures: PassFigures,
    /// Instructions of its vertex stage, paper-comparable ([`crate::instruments::counts_of`]); `None` where not counted.
    pub vertex_instructions: Option<u32>,
    /// Instructions of its fragment stage, likewise.
    pub fragment_instructions: Option<u32>,
}

impl PassRow {
    /// Its instructions, as `46/3`; `None` where not counted.
    fn instructions(&self) -> Option<String> {
        let (vertex, fragment) = self.vertex_instructions.zip(self.fragment_instructions)?;
        Some(format!("{vertex}/{fragment}"))
    }
}

/// A method that could not be compared.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Skipped {
    /// Which it is.
    #[serde(flatten)]
    pub method: Method,
    /// Why, in a line.
    pub reason: String,
}

impl MethodRow {
    /// A row of a method's frames and errors; whether it is on the front is not known yet.
    pub fn new(
        method: Method,
        times: FrameTimes,
        implementation_error: ErrorFigures,
        method_error: ErrorFigures,
        picture_error: PictureError,
    ) -> Self {
        let pass = |figures| PassRow { figures, vertex_instructions: None, fragment_instructions: None };
        Self {
            method,
            passes: times.passes.into_iter().map(pass).collect(),
            frame_ms: times.frame_ms,
            flags: times.flags,
            implementation_error,
            method_error,
            picture_error,
            pareto: false,
        }
    }

    /// Milliseconds of a frame (median) and the RMS of the whole picture's error; `None` where one is missing.
    pub fn speed_and_error(&self) -> Option<[f64; 2]> {
        Some([self.frame_ms?.median, self.picture_error.whole.rms()?])
    }

    /// Takes over what was counted of its passes.
    #[cfg(feature = "counts")]
    pub fn set_instructions(&mut self, counted: &[crate::count::PassCounts]) {
        for pass in &mut self.passes {
            if let Some(counts) = counted.iter().find(|counts| counts.pass == pass.figures.name) {
                pass.vertex_instructions = counts.vertex.as_ref().and_then(|counts| counts.arb);
                pass.fragment_instructions = counts.fragment.as_ref().and_then(|counts| counts.arb);
            }
        }
    }

    /// The pass of this name.
    fn pass(&self, name: &str) -> Option<&PassRow> {
        self.passes.iter().find(|pass| pass.figures.name == name)
    }
}

impl CompareReport {
    /// Marks the methods that are on the Pareto front of speed and error, and says why the filters rank as they do.
    pub fn judge(&mut self) {
        let figures: Vec<_> = self.methods.iter().map(MethodRow::speed_and_error).collect();
        for (row, on_front) in self.methods.iter_mut().zip(pareto_front(&figures)) {
            row.pareto = on_front;
        }
        self.why = self.why_of_filters();
    }
}

#[cfg(test)]
mod tests;
