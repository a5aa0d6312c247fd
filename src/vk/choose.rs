//! Which device is used: a pure function over plain facts, with a reason for every refusal.

use crate::error::{Error, ErrorKind, Result};

/// The kind of a device's hardware, best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum DeviceKind {
    /// A graphics card.
    Discrete,
    /// Graphics beside the processor.
    Integrated,
    /// A part of a card, in a virtual machine.
    Virtual,
    /// The processor itself, such as lavapipe.
    Cpu,
    /// Unknown.
    Other,
}

/// All that is known of a device before it is opened.
#[derive(Clone, Debug)]
pub struct DeviceFacts {
    /// The device's name.
    pub name: String,
    /// The kind of hardware.
    pub kind: DeviceKind,
    /// The driver's name and version, as it prints them.
    pub driver: String,
    /// The Vulkan version it offers, `[major, minor, patch]`.
    pub api_version: [u32; 3],
    /// The PCI vendor and device, and the driver's version number: the key of its caches.
    pub ids: [u32; 3],
    /// Where it sits on the PCI bus, as domain, bus, device and function; `None` where the driver does not tell
    /// (`VK_EXT_pci_bus_info`).
    pub pci: Option<[u32; 4]>,
    /// A queue family with graphics and compute.
    pub queue_family: Option<u32>,
    /// Features and formats that are needed and missing, by name.
    pub missing: Vec<String>,
    /// Points above one pixel (`largePoints`); without them every splat is a quad.
    pub large_points: bool,
    /// Counts of fragments (`pipelineStatisticsQuery`).
    pub pipeline_statistics: bool,
    /// Color attachments can be written differently (`independentBlend`).
    pub independent_blend: bool,
    /// The number of indirect draws can be read from a buffer.
    pub draw_indirect_count: bool,
    /// Limits that the renderer respects.
    pub limits: Limits,
}

/// Limits of a device, in Vulkan's own units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Bytes of a storage buffer that a shader can reach.
    pub max_storage_buffer_range: u64,
    /// Texels of a texel buffer.
    pub max_texels: u32,
    /// The smallest and the largest point, in pixels.
    pub point_size_range: [f32; 2],
    /// The step of point sizes, in pixels.
    pub point_size_granularity: f32,
    /// The largest buffer in bytes.
    pub max_buffer_size: u64,
    /// The largest side of a 2D image that is a render target, in pixels.
    pub max_image_side: u32,
    /// Nanoseconds of a timestamp's tick.
    pub timestamp_period_ns: f32,
    /// Valid bits of a timestamp; 0 where the queue has none.
    pub timestamp_valid_bits: u32,
    /// Storage buffers that a stage can have, no more than a `u32` holds.
    pub storage_buffers_a_stage: u32,
    /// Shaders store to images of floats of 16 and 32 bits without naming the format.
    pub stores_without_format: bool,
    /// 8 invocations or more of a compute stage can hand values to each other, and vote (`SHUFFLE`, `VOTE`,
    /// `BALLOT`).
    pub shuffles: bool,
    /// Indirect draws may begin at any instance (`drawIndirectFirstInstance`).
    pub first_instance: bool,
    /// 32-bit floats, one and four a texel, can be added up in attachments: `--accumulate f32`.
    pub blend_f32: bool,
    /// The device is the CPU.
    pub is_cpu: bool,
}

impl Limits {
    /// The limits of a plain device, where there is none: what Vulkan promises, and what tiles need.
    pub fn plain() -> Self {
        Self {
            max_storage_buffer_range: 1 << 27,
            max_texels: 1 << 16,
            point_size_range: [1.0, 255.0],
            point_size_granularity: 0.125,
            max_buffer_size: 1 << 30,
            max_image_side: 16_384,
            timestamp_period_ns: 1.0,
            timestamp_valid_bits: 0,
            storage_buffers_a_stage: 32,
            stores_without_format: true,
            shuffles: false,
            first_instance: true,
            blend_f32: false,
            is_cpu: false,
        }
    }
}

impl DeviceFacts {
    /// Why the device can't be used; empty where it can.
    pub fn refusals(&self) -> Vec<String> {
        let mut reasons = Vec::new();
        let [major, minor, _] = self.api_version;
        if (major, minor) < (1, 3) {
            reasons.push(format!("offers Vulkan {major}.{minor}, 1.3 is needed"));
            return reasons;
        }
        if self.queue_family.is_none() {
            reasons.push("has no queue with graphics and compute".to_owned());
        }
        reasons.extend(self.missing.iter().map(|what| format!("lacks {what}")));
        reasons
    }

    /// The features that the device lacks though it can be used, each with what follows.
    pub fn shortcomings(&self) -> Vec<&'static str> {
        let mut lacks = Vec::new();
        if !self.large_points {
            lacks.push("largePoints: splats are drawn as quads, slower");
        }
        if !self.pipeline_statistics {
            lacks.push("pipelineStatisticsQuery: fragments are not counted");
        }
        if !self.limits.blend_f32 {
            lacks.push("blending of R32G32B32A32_SFLOAT: no --accumulate f32");
        }
        if self.limits.timestamp_valid_bits == 0 {
            lacks.push("timestamps: passes are not timed");
        }
        lacks
    }
}

/// The index of the device to use: the one asked for by index or by a part of its name (case does not matter), else
/// the best kind, the first among equals.
///
/// # Errors
/// [`ErrorKind::Option`] where none is called so, [`ErrorKind::NoDevice`] with each device's reasons where none can
/// be used.
pub fn choose(devices: &[DeviceFacts], asked: Option<&str>) -> Result<usize> {
    if devices.is_empty() {
        let reason = "Vulkan finds no device (is a driver installed? lavapipe: package mesa-vulkan-drivers)";
        return Err(ErrorKind::NoDevice { reasons: vec![reason.to_owned()] }.into());
    }
    let refused = |candidates: &[usize]| -> Error {
        let describe = |&i: &usize| format!("{}: {}", devices[i].name, devices[i].refusals().join(", "));
        ErrorKind::NoDevice { reasons: candidates.iter().map(describe).collect() }.into()
    };
    let candidates: Vec<usize> = match asked {
        None => (0..devices.len()).collect(),
        Some(asked) => match asked.parse::<usize>() {
            // A number is never a part of a name: most names have digits.
            Ok(index) => (0..devices.len()).filter(|&i| i == index).collect(),
            Err(_) => {
                let part = asked.to_lowercase();
                let called_so = |&i: &usize| devices[i].name.to_lowercase().contains(&part);
                (0..devices.len()).filter(called_so).collect()
            }
        },
    };
    if candidates.is_empty() {
        let names: Vec<_> = devices.iter().enumerate().map(|(i, d)| format!("{i} {}", d.name)).collect();
        let asked = asked.unwrap_or_default();
        return Err(Error::option("--device", format!("'{asked}' is none of: {}", names.join(", "))));
    }
    let usable = candidates.iter().copied().filter(|&i| devices[i].refusals().is_empty());
    usable.min_by_key(|&i| devices[i].kind).ok_or_else(|| refused(&candidates))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn device(name: &str, kind: DeviceKind) -> DeviceFacts {
        DeviceFacts {
            name: name.to_owned(),
            kind,
            driver: String::new(),
            api_version: [1, 3, 0],
            ids: [0; 3],
            pci: None,
            queue_family: Some(0),
            missing: Vec::new(),
            large_points: true,
            pipeline_statistics: true,
            independent_blend: true,
            draw_indirect_count: true,
            limits: Limits { blend_f32: true, ..Limits::plain() },
        }
    }

    #[test]
    fn the_best_kind_wins_and_the_first_among_equals() {
        let devices = [
            device("llvmpipe", DeviceKind::Cpu),
            device("Card A", DeviceKind::Discrete),
            device("Card B", DeviceKind::Discrete),
        ];
        assert_eq!(choose(&devices, None).unwrap(), 1);
    }

    #[test]
    fn a_device_is_asked_for_by_index_or_part_of_its_name() {
        let devices = [device("llvmpipe (LLVM 15)", DeviceKind::Cpu), device("Card", DeviceKind::Discrete)];
        assert_eq!(choose(&devices, Some("0")).unwrap(), 0);
        assert_eq!(choose(&devices, Some("LLVMPIPE")).unwrap(), 0);
        let error = choose(&devices, Some("voodoo")).unwrap_err();
        assert_eq!(error.to_string(), "--device: 'voodoo' is none of: 0 llvmpipe (LLVM 15), 1 Card");
        assert_eq!(error.exit_code(), 1);
        assert_eq!(choose(&devices, Some("7")).unwrap_err().exit_code(), 1);
        // Of "LLVM 15", which is not the device that was asked for.
        assert_eq!(choose(&devices, Some("15")).unwrap_err().exit_code(), 1);
    }

    #[test]
    fn every_refused_device_is_named_with_its_reasons() {
        let mut old = device("Old", DeviceKind::Discrete);
        old.api_version = [1, 2, 9];
        let mut poor = device("Poor", DeviceKind::Integrated);
        poor.queue_family = None;
        poor.missing = vec!["dynamicRendering".to_owned()];
        let error = choose(&[old.clone(), poor], None).unwrap_err();
        assert_eq!(
            error.to_string(),
            "no Vulkan device can be used: Old: offers Vulkan 1.2, 1.3 is needed; \
             Poor: has no queue with graphics and compute, lacks dynamicRendering"
        );
        assert_eq!(error.exit_code(), 2);
        assert_eq!(choose(&[old, device("New", DeviceKind::Cpu)], None).unwrap(), 1);
        assert_eq!(choose(&[], None).unwrap_err().exit_code(), 2);
    }
}
