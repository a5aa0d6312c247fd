//! Devices and scenes in reports.

use surfel::{
    prepare::PreparedScene,
    report::{DeviceReport, InputReport, SceneReport},
    vk::{DeviceFacts, LoaderFacts},
};

/// A version of Vulkan, such as `1.3.230`.
pub fn version([major, minor, patch]: [u32; 3]) -> String {
    format!("{major}.{minor}.{patch}")
}

/// The validation layer: the version of Vulkan that it was written for, and its own; `None` where it is not installed.
pub fn layer_version(loader: &LoaderFacts) -> Option<String> {
    loader.validation_layer.map(|(spec, own)| format!("{} (version {own})", version(spec)))
}

/// A device in a report.
pub fn device_report(facts: &DeviceFacts) -> DeviceReport {
    DeviceReport {
        name: facts.name.clone(),
        driver: facts.driver.clone(),
        api_version: version(facts.api_version),
        timestamp_period_ns: facts.limits.timestamp_period_ns.into(),
        timestamp_valid_bits: facts.limits.timestamp_valid_bits,
    }
}

/// A scene in a report.
pub fn scene_report(inputs: Vec<InputReport>, prepared: &PreparedScene, transient_bytes: u64) -> SceneReport {
    SceneReport {
        dropped: inputs.iter().map(|input| input.dropped as u64).sum(),
        inputs,
        splats: prepared.splat_count(),
        triangles: prepared.triangle_count(),
        order: prepared.storage.order.name(),
        splat_format: prepared.storage.format.name(),
        origins: prepared.chunks().iter().map(|chunk| chunk.rebase.origin.to_array()).collect(),
        splat_bytes: prepared.bytes(),
        transient_bytes,
    }
}
