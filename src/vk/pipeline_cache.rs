//! The pipeline cache, kept on disk from run to run.

use std::{
    io::Write,
    path::{Path, PathBuf},
    sync::atomic::{AtomicU64, Ordering},
};

use ash::vk;

use super::{choose::DeviceFacts, device::Device, garbage::Retired, owned::Owned, result::VkResultExt};
use crate::{
    error::{Error, Result},
    small_file::read_small_file,
};

/// More than all pipelines of surfel take: what is larger is something else.
const MOST_BYTES: u64 = 1 << 28;

/// Bytes behind the data.
const SUM_BYTES: usize = 8;

/// Compiled pipelines, in memory and, where a folder was given, on disk.
pub struct PipelineCache {
    owned: Owned<vk::PipelineCache>,
    file: Option<PathBuf>,
}

impl PipelineCache {
    /// Opens the cache of this device and driver in `folder`; `None` keeps it in memory only. A file that is
    /// missing, not as it was written or of another driver counts as absent: the cache then starts empty.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn open(device: &Device, folder: Option<&Path>) -> Result<Self> {
        const NAME: &str = "pipeline cache";
        let file = folder.map(|folder| folder.join(file_name(device.facts())));
        let read = |file: &PathBuf| read_small_file(file, MOST_BYTES, "a pipeline cache").ok();
        let stored = file.as_ref().and_then(read).unwrap_or_default();
        // SAFETY: the device is alive.
        let properties = unsafe { device.instance().raw().get_physical_device_properties(device.physical()) };
        let data = as_written(&stored).filter(|data| fits(data, &properties)).unwrap_or_default();
        let create = |data: &[u8]| {
            let info = vk::PipelineCacheCreateInfo::default().initial_data(data);
            // SAFETY: the data is as a driver gave it, and has the header of this very driver and device.
            unsafe { device.raw().create_pipeline_cache(&info, None) }
        };
        let made = match create(data) {
            // The driver may refuse what it finds behind the header: then the cache starts empty.
            Err(_) if !data.is_empty() => create(&[]),
            other => other,
        };
        let raw = made.of_call("vkCreatePipelineCache", NAME)?;
        Ok(Self { owned: device.own(raw, NAME, Retired::PipelineCache), file })
    }

    /// The raw cache.
    pub fn raw(&self) -> vk::PipelineCache {
        self.owned.raw
    }

    /// Writes the cache to its file, whole or not at all; nothing to do without a folder.
    ///
    /// # Errors
    /// Whatever the driver or the file system answers. Losing the cache costs time only.
    pub fn save(&self) -> Result<()> {
        let Some(file) = &self.file else { return Ok(()) };
        let Owned { device, raw, .. } = &self.owned;
        // SAFETY: the cache is alive.
        let data = unsafe { device.raw().get_pipeline_cache_data(*raw) }
            .of_call("vkGetPipelineCacheData", "pipeline cache")?;
        let write = || -> std::io::Result<()> {
            if let Some(folder) = file.parent() {
                std::fs::create_dir_all(folder)?;
            }
            // Several caches of a process may be saved at once.
            static NEXT: AtomicU64 = AtomicU64::new(0);
            let number = NEXT.fetch_add(1, Ordering::Relaxed);
            let unfinished = file.with_extension(format!("{}.{number}.tmp", std::process::id()));
            let written = std::fs::File::create(&unfinished)
                .and_then(|mut out| {
                    out.write_all(&data)?;
                    out.write_all(&sum(&data))
                })
                .and_then(|()| std::fs::rename(&unfinished, file));
            if written.is_err() {
                let _ = std::fs::remove_file(&unfinished);
            }
            written
        };
        write().map_err(|error| Error::file(file.clone(), "write", error))
    }
}

/// One file per vendor, device and driver version.
fn file_name(facts: &DeviceFacts) -> String {
    let [vendor, device, driver] = facts.ids;
    format!("pipelines-{vendor:08x}-{device:08x}-{driver:08x}.bin")
}

/// What tells data that was damaged from what was written (FNV-1a): drivers need not look.
fn sum(data: &[u8]) -> [u8; SUM_BYTES] {
    let sum = data
        .iter()
        .fold(0xcbf2_9ce4_8422_2325_u64, |sum, byte| (sum ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3));
    sum.to_le_bytes()
}

/// The data of a file, if it is what was written.
fn as_written(stored: &[u8]) -> Option<&[u8]> {
    let (data, of_file) = stored.split_at_checked(stored.len().checked_sub(SUM_BYTES)?)?;
    (of_file == sum(data)).then_some(data)
}

/// Whether stored data starts with the header (Vulkan 1.3, `VkPipelineCacheHeaderVersionOne`) of this device.
fn fits(data: &[u8], properties: &vk::PhysicalDeviceProperties) -> bool {
    const HEADER_BYTES: usize = 32;
    let word = |i: usize| data.get(4 * i..4 * i + 4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    data.len() > HEADER_BYTES
        && word(0) == Some(HEADER_BYTES as u32)
        && word(1) == Some(1)
        && word(2) == Some(properties.vendor_id)
        && word(3) == Some(properties.device_id)
        && data[16..32] == properties.pipeline_cache_uuid
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_was_damaged_or_cut_off_counts_as_absent() {
        let data: Vec<u8> = (0..100).collect();
        let stored = [&data[..], &sum(&data)].concat();
        assert_eq!(as_written(&stored), Some(&data[..]));
        for place in 0..stored.len() {
            let mut damaged = stored.clone();
            damaged[place] ^= 4;
            assert_eq!(as_written(&damaged), None, "byte {place}");
            assert_eq!(as_written(&stored[..place]), None, "{place} bytes");
        }
    }

    #[test]
    fn only_a_whole_header_of_the_same_device_fits() {
        let properties = vk::PhysicalDeviceProperties {
            vendor_id: 7,
            device_id: 9,
            pipeline_cache_uuid: [3; 16],
            ..Default::default()
        };
        let mut data = Vec::new();
        for word in [32_u32, 1, 7, 9] {
            data.extend(word.to_le_bytes());
        }
        data.extend([3; 16]);
        assert!(!fits(&data, &properties), "a header alone holds nothing");
        data.push(0);
        assert!(fits(&data, &properties));
        for broken in [0, 4, 8, 12, 16, 31] {
            let mut other = data.clone();
            other[broken] ^= 1;
            assert!(!fits(&other, &properties), "byte {broken}");
        }
        assert!(!fits(&data[..20], &properties));
        assert!(!fits(&[], &properties));
    }
}
