//! The device for a window.

use std::sync::Arc;

use ash::vk;
use surfel::{
    Error, ErrorKind, Headless, Result,
    vk::{Device, Instance, Messages, Surface, Validation},
};
use winit::window::Window;

use super::gpu::Gpu;
use crate::device::{DeviceArguments, cache_folder};

/// Opens the device for a window.
///
/// # Errors
/// As [`Instance::for_display`], [`Device::for_surface`]; whatever the driver answers.
pub fn open_gpu(window: &Arc<Window>, arguments: &DeviceArguments) -> Result<(Gpu, Arc<Messages>)> {
    let validation = if arguments.validate { Validation::On } else { Validation::Off };
    let instance = Instance::for_display(validation, &**window)?;
    let messages = instance.messages();
    let as_window: Arc<dyn surfel::vk::Window> = Arc::clone(window) as Arc<dyn surfel::vk::Window>;
    let surface = Surface::new(&instance, as_window)?;
    let gpu = open_for(window, surface, arguments)?;
    Ok((gpu, messages))
}

/// Opens a device for the window of one that is lost.
///
/// # Errors
/// As [`Device::for_surface`]; whatever the driver answers.
pub fn open_again(window: &Arc<Window>, lost: &mut Gpu, arguments: &DeviceArguments) -> Result<Gpu> {
    let surface = lost.leave();
    open_for(window, surface, arguments)
}

fn open_for(window: &Arc<Window>, surface: Surface, arguments: &DeviceArguments) -> Result<Gpu> {
    let device = Device::for_surface(&surface, arguments.asked.as_deref())?;
    let headless = Headless::on(device, cache_folder().as_deref())?;
    let as_window: Arc<dyn surfel::vk::Window> = Arc::clone(window) as Arc<dyn surfel::vk::Window>;
    let mut gpu = Gpu::new(headless, surface, as_window)?;
    let size = window.inner_size();
    gpu.resize([size.width, size.height]);
    gpu.make_images()?;
    Ok(gpu)
}

/// Whether the device is lost, and another one must be opened.
pub fn is_device_lost(error: &Error) -> bool {
    matches!(error.kind(), ErrorKind::Vulkan { result: vk::Result::ERROR_DEVICE_LOST, .. })
}
