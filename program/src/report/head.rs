//! The page's subject: device, model, settings, versions.

use std::{collections::BTreeMap, env};

use serde::Serialize;
use surfel::{
    report::{DeviceReport, InputReport},
    scene::Settings,
    vk::{DeviceFacts, DeviceKind},
};

use super::{arguments::ReportArguments, command_line::CommandLine};
use crate::{reports::device_report, scene::Loaded};

/// Everything that is needed to understand and repeat the page. No date: two pages of the same differ in times alone.
#[derive(Serialize)]
pub struct Head {
    /// The version of surfel.
    pub surfel: &'static str,
    /// The commit that it was built from; `None` where whoever built it did not say so.
    pub commit: Option<&'static str>,
    /// Operating system and processor.
    pub platform: String,
    /// The device.
    pub device: DeviceReport,
    /// Whether the device is the processor itself.
    pub is_processor: bool,
    /// Where the scene came from.
    pub inputs: Vec<InputReport>,
    /// The settings, by the names of the options; the same everywhere but where a part says otherwise.
    pub settings: BTreeMap<&'static str, String>,
    /// Whether it is the short form.
    pub quick: bool,
    /// The command line.
    pub command: String,
}

impl Head {
    /// The head of this run.
    pub fn of(facts: &DeviceFacts, arguments: &ReportArguments, loaded: &Loaded) -> Self {
        let mut settings = Settings::default().as_options();
        settings.remove("size");
        Self {
            surfel: env!("CARGO_PKG_VERSION"),
            commit: option_env!("SURFEL_COMMIT"),
            platform: format!("{}, {}", env::consts::OS, env::consts::ARCH),
            device: device_report(facts),
            is_processor: facts.kind == DeviceKind::Cpu,
            inputs: loaded.inputs.clone(),
            settings,
            quick: arguments.quick,
            command: CommandLine::new(env::args_os().skip(1)).to_string(),
        }
    }

    /// The subject in a line.
    pub fn title(&self) -> String {
        let model = match self.inputs.first() {
            Some(input) if self.inputs.len() == 1 => input.name.clone(),
            _ => format!("{} files", self.inputs.len()),
        };
        format!("{model} on {}", self.device.name)
    }

    /// Names and values, in the order in which they are read.
    pub fn facts(&self) -> Vec<(&'static str, String)> {
        let device = &self.device;
        let timestamps = match device.timestamp_valid_bits {
            0 => "none: nothing is timed".to_owned(),
            bits => format!("{bits} bits, {} ns a tick", device.timestamp_period_ns),
        };
        let options: Vec<String> =
            self.settings.iter().map(|(name, value)| format!("--{name} {value}")).collect();
        let form = if self.quick { "quick: fewer methods, distances, frames and samples" } else { "full" };
        let mut facts = vec![
            ("device", device.name.clone()),
            ("driver", device.driver.clone()),
            ("Vulkan", device.api_version.clone()),
            ("timestamps", timestamps),
            ("system", self.platform.clone()),
            ("surfel", self.surfel.to_owned()),
        ];
        facts.extend(self.commit.map(|commit| ("commit", commit.to_owned())));
        facts.push((
            "model",
            self.inputs.iter().map(|input| input.summary.as_str()).collect::<Vec<_>>().join("; "),
        ));
        facts.push(("form", form.to_owned()));
        facts.push(("settings", format!("`{}`, where a part says nothing else", options.join(" "))));
        facts
    }
}
