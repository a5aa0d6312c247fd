//! Pipelines as drivers' compilers have them. RADV compiles for chips that are not there: it is told which by the environment,
//! before Vulkan is loaded, so that each chip has a process of its own.

use std::{
    io,
    path::PathBuf,
    process::{Command, Stdio},
};

use surfel::{
    Error, Result,
    passes::{PipelineRecipe, Shaders},
    report::bench::{IsaRow, PipelineNames},
    vk::{Device, Instance, Validation, executables},
};

/// The device of this machine, among the names of chips.
const HERE: &str = "here";

/// Where Vulkan's loader looks for drivers on Linux.
const DRIVER_FOLDERS: [&str; 3] =
    ["/usr/share/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/etc/vulkan/icd.d"];

/// The rows of every pipeline, in their order, as compiled for one chip.
///
/// # Errors
/// RADV is missing or knows no such chip; whatever the driver answers.
pub fn rows_of(chip: &str, all: bool, device: Option<&str>) -> Result<Vec<Vec<IsaRow>>> {
    let failed = |problem: String| Error::option("--isa", format!("{chip}: {problem}"));
    let of_system = |error: io::Error| failed(error.to_string());
    let mut child = Command::new(std::env::current_exe().map_err(of_system)?);
    child.args(["bench", "counts", "--isa-rows"]).stdin(Stdio::null());
    child.args(all.then_some("--all"));
    if chip.eq_ignore_ascii_case(HERE) {
        child.args(device.into_iter().flat_map(|device| ["--device", device]));
    } else {
        let radv = radv().ok_or_else(|| {
            failed("needs RADV, the driver radeon_icd (package mesa-vulkan-drivers)".to_owned())
        })?;
        // The second name is that of older loaders.
        child.env("VK_DRIVER_FILES", &radv).env("VK_ICD_FILENAMES", &radv);
        child.env("RADV_FORCE_FAMILY", chip.to_uppercase());
    }
    let output = child.output().map_err(of_system)?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        let last = said.lines().last().unwrap_or_default().trim_start_matches("surfel: ").to_owned();
        return Err(failed(last));
    }
    let mut rows: Vec<Vec<IsaRow>> =
        serde_json::from_slice(&output.stdout).map_err(|error| failed(error.to_string()))?;
    if !chip.eq_ignore_ascii_case(HERE) {
        for row in rows.iter_mut().flatten() {
            row.device = chip.to_uppercase();
        }
    }
    Ok(rows)
}

/// The rows of every pipeline, in their order, as compiled by the driver of this process.
///
/// # Errors
/// No device, or one that does not tell; whatever the driver answers.
pub fn rows_here(
    pipelines: &[(PipelineNames, PipelineRecipe)],
    device: Option<&str>,
) -> Result<Vec<Vec<IsaRow>>> {
    let instance = Instance::new(Validation::Off)?;
    let device = Device::with_executables(&instance, device)?;
    let shaders = Shaders::new(&device, None)?;
    let mut rows = Vec::new();
    for (_, recipe) in pipelines {
        let made = recipe.make(&shaders)?;
        // SAFETY: the shaders own what they made, and are alive.
        let programs =
            made.map(|pipeline| unsafe { executables(&device, pipeline) }).transpose()?.unwrap_or_default();
        let row = |program: surfel::vk::Executable| IsaRow {
            device: device.facts().name.clone(),
            executable: program.name,
            subgroup: program.subgroup_size,
            // A hash is no figure.
            statistics: program.statistics.into_iter().filter(|(name, _)| !is_hash(name)).collect(),
        };
        rows.push(programs.into_iter().map(row).collect());
    }
    Ok(rows)
}

fn is_hash(statistic: &str) -> bool {
    statistic.to_ascii_lowercase().contains("hash")
}

/// RADV's file for the loader.
fn radv() -> Option<PathBuf> {
    let in_folder = |folder: &str| {
        let files = std::fs::read_dir(folder).ok()?;
        let mut paths = files.flatten().map(|file| file.path());
        paths.find(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            name.starts_with("radeon_icd") && name.ends_with(".json")
        })
    };
    DRIVER_FOLDERS.into_iter().find_map(in_folder)
}
