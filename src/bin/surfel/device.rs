//! A device, for reports.

use surfel::{report::DeviceReport, vk::DeviceFacts};

/// What a report says of a device.
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
