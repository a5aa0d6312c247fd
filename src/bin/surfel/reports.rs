//! Devices and scenes in reports.

use surfel::{
    prepare::PreparedScene,
    report::{DeviceReport, InputReport, SceneReport},
    vk::DeviceFacts,
};

/// A device in a report.
pub fn device_report(facts: &DeviceFacts) -> DeviceReport {
    let [major, minor, patch] = facts.api_version;
    DeviceReport {
        name: facts.name.clone(),
        driver: facts.driver.clone(),
        api_version: format!("{major}.{minor}.{patch}"),
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
        splat_bytes: prepared.bytes(),
        transient_bytes,
    }
}
