//! A run's figures for people.

use std::fmt;

use super::{DeviceReport, FrameTimes, RunReport, Spread};

impl fmt::Display for RunReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let DeviceReport { name, driver, api_version, .. } = &self.device;
        writeln!(f, "{name}, {driver}, Vulkan {api_version}; {} splats", self.scene.splats)?;
        writeln!(f, "{:44} {:>9}", "before the frames", "seconds")?;
        for step in &self.steps {
            writeln!(f, "  {:42} {:9.3}", step.name, step.secs)?;
        }
        self.frames.fmt(f)
    }
}

impl fmt::Display for FrameTimes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let head = format!("{} frames after {} to warm up", self.timed_frames, self.warm_up_frames);
        writeln!(
            f,
            "{head:30} {:>9} {:>9} {:>9} {:>11} {:>11}",
            "median ms", "min", "max", "vertices", "fragments"
        )?;
        for pass in &self.passes {
            let (vertices, fragments) = (count(pass.vertices), count(pass.fragments));
            writeln!(f, "  {:28} {} {vertices} {fragments}", pass.name, columns(pass.ms))?;
        }
        for (name, spread) in [
            ("sum of the passes", self.sum_of_passes_ms),
            ("frame, passes not timed", self.frame_ms),
            ("submission to end of wait", self.submit_to_wait_ms),
            ("recorded by the host", self.record_ms),
        ] {
            writeln!(f, "{name:30} {}", columns(spread))?;
        }
        for flag in &self.flags {
            writeln!(f, "note: {flag}")?;
        }
        Ok(())
    }
}

fn columns(spread: Option<Spread>) -> String {
    match spread {
        Some(Spread { median, min, max, .. }) => format!("{median:9.3} {min:9.3} {max:9.3}"),
        None => format!("{:>9} {:>9} {:>9}", "-", "-", "-"),
    }
}

fn count(count: Option<u64>) -> String {
    count.map_or_else(|| format!("{:>11}", "-"), |count| format!("{count:11}"))
}
