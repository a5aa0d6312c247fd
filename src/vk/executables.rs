//! The programs that a driver's compiler made of a pipeline: `VK_KHR_pipeline_executable_properties`, where a device has it and was
//! opened for it.

use std::ffi::c_char;

use ash::{khr, vk};

use super::{
    device::{Device, Origin},
    instance::Instance,
    result::VkResultExt,
    wanted::Wanted,
};
use crate::error::{Error, Result};

/// One of the programs that a pipeline became.
#[derive(Clone, Debug, PartialEq)]
pub struct Executable {
    /// The driver's name for it.
    pub name: String,
    /// The stages that it is.
    pub stages: vk::ShaderStageFlags,
    /// Invocations that run together.
    pub subgroup_size: u32,
    /// Figures by the driver's names: instructions, registers and the like.
    pub statistics: Vec<(String, f64)>,
}

impl Device {
    /// As [`Self::new`], and all pipelines can be asked what they became ([`executables`]), which costs time.
    ///
    /// # Errors
    /// As [`Self::new`], and where the driver lacks the extension.
    pub fn with_executables(instance: &Instance, asked: Option<&str>) -> Result<Self> {
        Self::open(instance, asked, Wanted { executables: true, ..Wanted::default() })
    }

    /// Whether pipelines can be asked what they became.
    pub fn captures_executables(&self) -> bool {
        matches!(self.origin(), Origin::Ours { executables: true, .. })
    }

    /// The flags that all pipelines are made with.
    pub(super) fn pipeline_flags(&self) -> vk::PipelineCreateFlags {
        match self.captures_executables() {
            true => vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR,
            false => vk::PipelineCreateFlags::empty(),
        }
    }
}

/// The programs that a pipeline became.
///
/// # Safety
/// The pipeline is of this device, and alive.
///
/// # Errors
/// [`crate::error::ErrorKind::Option`] if the device was not opened with [`Device::with_executables`]; whatever the
/// driver answers.
pub unsafe fn executables(device: &Device, pipeline: vk::Pipeline) -> Result<Vec<Executable>> {
    if !device.captures_executables() {
        let problem = "the device was not opened with pipeline executable properties";
        return Err(Error::option("executables", problem));
    }
    let api = khr::pipeline_executable_properties::Device::new(device.instance().raw(), device.raw());
    let name = &device.facts().name;
    let info = vk::PipelineInfoKHR::default().pipeline(pipeline);
    // SAFETY: the extension is enabled; this function's contract; all pipelines of the device are made to be asked.
    let all = unsafe { api.get_pipeline_executable_properties(&info) }
        .of_call("vkGetPipelineExecutablePropertiesKHR", name)?;
    let mut found = Vec::new();
    for (properties, index) in all.iter().zip(0..) {
        let info = vk::PipelineExecutableInfoKHR::default().pipeline(pipeline).executable_index(index);
        // SAFETY: as above; statistics were captured.
        let statistics = unsafe { api.get_pipeline_executable_statistics(&info) }
            .of_call("vkGetPipelineExecutableStatisticsKHR", name)?;
        found.push(Executable {
            name: text(&properties.name),
            stages: properties.stages,
            subgroup_size: properties.subgroup_size,
            statistics: statistics.iter().map(|one| (text(&one.name), figure(one))).collect(),
        });
    }
    Ok(found)
}

fn figure(statistic: &vk::PipelineExecutableStatisticKHR<'_>) -> f64 {
    // SAFETY: the format says which of the union's members was written.
    unsafe {
        match statistic.format {
            vk::PipelineExecutableStatisticFormatKHR::BOOL32 => f64::from(statistic.value.b32),
            vk::PipelineExecutableStatisticFormatKHR::INT64 => statistic.value.i64 as f64,
            vk::PipelineExecutableStatisticFormatKHR::UINT64 => statistic.value.u64 as f64,
            _ => statistic.value.f64,
        }
    }
}

fn text(raw: &[c_char]) -> String {
    let bytes: Vec<u8> = raw.iter().take_while(|c| **c != 0).map(|c| *c as u8).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}
