//! The devices of this machine, and what they lack.

use std::fmt::Write as _;

use serde::Serialize;
use surfel::{
    Result,
    vk::{DeviceFacts, DeviceKind, Instance, LoaderFacts, Validation, all_facts, choose, loader_facts},
};

use crate::reports::{layer_version, version};

/// The answer.
#[derive(Serialize)]
pub struct Info {
    surfel: &'static str,
    vulkan_loader: String,
    /// `None` where it is not installed.
    validation_layer: Option<String>,
    devices: Vec<DeviceInfo>,
}

/// One device. Sizes in bytes, points and images in pixels.
#[derive(Serialize)]
struct DeviceInfo {
    index: usize,
    name: String,
    kind: &'static str,
    driver: String,
    api_version: String,
    vendor_id: u32,
    device_id: u32,
    driver_version: u32,
    /// The family of the queue that would be used.
    queue_family: Option<u32>,
    max_image_side_px: u32,
    point_size_range_px: [f32; 2],
    point_size_step_px: f32,
    max_storage_buffer_bytes: u64,
    timestamp_valid_bits: u32,
    timestamp_period_ns: f32,
    /// The reasons why it can't be used; empty where it can.
    refused: Vec<String>,
    /// The features that it lacks though it can be used.
    lacks: Vec<&'static str>,
    /// It is used where `--device` is not given.
    default: bool,
}

/// Asks Vulkan for all devices.
///
/// # Errors
/// [`surfel::ErrorKind::NoDevice`] where it finds none. Devices that can't be used are listed.
pub fn gather() -> Result<Info> {
    let loader = loader_facts()?;
    let instance = Instance::new(Validation::Off)?;
    let facts: Vec<DeviceFacts> = all_facts(&instance)?.into_iter().map(|(_, facts)| facts).collect();
    let chosen = choose(&facts, None);
    if facts.is_empty() {
        chosen?;
        return Err(surfel::ErrorKind::NoDevice { reasons: Vec::new() }.into());
    }
    Ok(info(&loader, &facts, chosen.ok()))
}

fn info(loader: &LoaderFacts, facts: &[DeviceFacts], chosen: Option<usize>) -> Info {
    Info {
        surfel: env!("CARGO_PKG_VERSION"),
        vulkan_loader: version(loader.version),
        validation_layer: layer_version(loader),
        devices: facts.iter().enumerate().map(|(i, facts)| device(i, facts, chosen == Some(i))).collect(),
    }
}

fn device(index: usize, facts: &DeviceFacts, default: bool) -> DeviceInfo {
    let [vendor_id, device_id, driver_version] = facts.ids;
    let limits = &facts.limits;
    DeviceInfo {
        index,
        name: facts.name.clone(),
        kind: match facts.kind {
            DeviceKind::Discrete => "graphics card",
            DeviceKind::Integrated => "integrated graphics",
            DeviceKind::Virtual => "virtual graphics",
            DeviceKind::Cpu => "processor",
            DeviceKind::Other => "unknown",
        },
        driver: facts.driver.clone(),
        api_version: version(facts.api_version),
        vendor_id,
        device_id,
        driver_version,
        queue_family: facts.queue_family,
        max_image_side_px: limits.max_image_side,
        point_size_range_px: limits.point_size_range,
        point_size_step_px: limits.point_size_granularity,
        max_storage_buffer_bytes: limits.max_storage_buffer_range,
        timestamp_valid_bits: limits.timestamp_valid_bits,
        timestamp_period_ns: limits.timestamp_period_ns,
        refused: facts.refusals(),
        lacks: facts.shortcomings(),
        default,
    }
}

/// For people.
pub fn text(info: &Info) -> String {
    let mut text = String::new();
    let layer = info.validation_layer.as_deref().unwrap_or("not installed");
    // Writing to a string can't fail, here and below.
    let _ = writeln!(
        text,
        "surfel {}; Vulkan loader {}; validation layer {layer}",
        info.surfel, info.vulkan_loader
    );
    for device in &info.devices {
        let default = if device.default { " (the default)" } else { "" };
        let _ = writeln!(text, "\ndevice {}: {}{default}", device.index, device.name);
        for (name, value) in rows(device) {
            let _ = writeln!(text, "  {name:16} {value}");
        }
    }
    text
}

fn rows(device: &DeviceInfo) -> Vec<(&'static str, String)> {
    let queue = match device.queue_family {
        Some(family) => format!("family {family}, graphics and compute"),
        None => "none with graphics and compute".to_owned(),
    };
    let [_, largest_px] = device.point_size_range_px;
    let step = match device.point_size_step_px {
        0.0 => String::new(),
        step => format!(" in steps of {step} px"),
    };
    let timestamps = match device.timestamp_valid_bits {
        0 => "none".to_owned(),
        bits if device.timestamp_period_ns.is_normal() => {
            format!("{bits} bits, {} ns a tick", device.timestamp_period_ns)
        }
        bits => format!("{bits} bits of unknown length"),
    };
    let mut rows = vec![
        ("kind", device.kind.to_owned()),
        ("driver", device.driver.clone()),
        ("Vulkan", device.api_version.clone()),
        ("queue", queue),
        ("pictures", format!("up to {0} x {0} px", device.max_image_side_px)),
        ("points", format!("up to {largest_px} px{step}; larger splats are quads")),
        ("storage buffers", format!("{} bytes in reach of a shader", device.max_storage_buffer_bytes)),
        ("timestamps", timestamps),
    ];
    rows.extend(device.refused.iter().map(|reason| ("can't be used", reason.clone())));
    match (device.refused.is_empty(), device.lacks.as_slice()) {
        (true, []) => rows.push(("lacks", "nothing".to_owned())),
        (_, lacks) => rows.extend(lacks.iter().map(|what| ("lacks", (*what).to_owned()))),
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use surfel::vk::Limits;

    fn facts(queue_family: Option<u32>) -> DeviceFacts {
        DeviceFacts {
            name: "Card".to_owned(),
            kind: DeviceKind::Discrete,
            driver: "driver 1".to_owned(),
            api_version: [1, 3, 7],
            ids: [1, 2, 3],
            pci: None,
            queue_family,
            missing: Vec::new(),
            large_points: true,
            pipeline_statistics: false,
            independent_blend: true,
            draw_indirect_count: false,
            limits: Limits {
                blend_f32: true,
                max_storage_buffer_range: 1 << 27,
                max_texels: 1 << 16,
                point_size_range: [1.0, 255.0],
                point_size_granularity: 0.125,
                max_buffer_size: 1 << 30,
                max_image_side: 16384,
                timestamp_period_ns: 1.0,
                timestamp_valid_bits: 0,
                storage_buffers_a_stage: 16,
                stores_without_format: true,
                shuffles: false,
                first_instance: true,
                is_cpu: false,
            },
        }
    }

    #[test]
    fn what_a_device_lacks_is_told_and_why_it_is_refused() {
        let loader = LoaderFacts { version: [1, 3, 239], validation_layer: None };
        let told = text(&info(&loader, &[facts(Some(0)), facts(None)], Some(0)));
        let [_, good, refused] = told.split("\ndevice ").collect::<Vec<_>>()[..] else { panic!("{told}") };
        assert!(told.contains("Vulkan loader 1.3.239; validation layer not installed"));
        assert!(good.starts_with("0: Card (the default)\n") && !good.contains("can't be used"), "{good}");
        assert!(good.contains("pipelineStatisticsQuery: fragments are not counted"), "{good}");
        assert!(good.contains("timestamps: passes are not timed"), "{good}");
        assert!(refused.starts_with("1: Card\n"), "{refused}");
        assert!(refused.contains("can't be used    has no queue with graphics and compute"), "{refused}");
    }
}
