//! A device whose commands are not recorded: what is left of the time that recording takes is ours.

use std::ffi::CStr;

use ash::vk;

type Barrier = *const vk::DependencyInfo<'static>;

macro_rules! unrecorded {
    ($($name:literal($($kind:ty),*);)*) => {
        /// A function that does nothing in the place of one that records.
        fn instead(name: &CStr) -> vk::PFN_vkVoidFunction {
            match name.to_bytes() {
                $($name => {
                    unsafe extern "system" fn nothing($(_: $kind),*) {}
                    let nothing: unsafe extern "system" fn($($kind),*) = nothing;
                    // SAFETY: a function is called by the type that its name has, which this one has.
                    Some(unsafe { std::mem::transmute::<unsafe extern "system" fn($($kind),*), unsafe extern "system" fn()>(nothing) })
                })*
                _ => None,
            }
        }
    };
}

unrecorded! {
    b"vkCmdPipelineBarrier2"(vk::CommandBuffer, Barrier);
    b"vkCmdBindPipeline"(vk::CommandBuffer, vk::PipelineBindPoint, vk::Pipeline);
    b"vkCmdBindDescriptorSets"(vk::CommandBuffer, vk::PipelineBindPoint, vk::PipelineLayout, u32, u32, *const vk::DescriptorSet, u32, *const u32);
    b"vkCmdPushConstants"(vk::CommandBuffer, vk::PipelineLayout, vk::ShaderStageFlags, u32, u32, *const std::ffi::c_void);
    b"vkCmdBindIndexBuffer"(vk::CommandBuffer, vk::Buffer, u64, vk::IndexType);
    b"vkCmdDispatch"(vk::CommandBuffer, u32, u32, u32);
    b"vkCmdDispatchIndirect"(vk::CommandBuffer, vk::Buffer, u64);
    b"vkCmdDraw"(vk::CommandBuffer, u32, u32, u32, u32);
    b"vkCmdDrawIndirect"(vk::CommandBuffer, vk::Buffer, u64, u32, u32);
    b"vkCmdDrawIndexedIndirect"(vk::CommandBuffer, vk::Buffer, u64, u32, u32);
    b"vkCmdFillBuffer"(vk::CommandBuffer, vk::Buffer, u64, u64, u32);
    b"vkCmdUpdateBuffer"(vk::CommandBuffer, vk::Buffer, u64, u64, *const std::ffi::c_void);
    b"vkCmdBeginRendering"(vk::CommandBuffer, *const vk::RenderingInfo<'static>);
    b"vkCmdEndRendering"(vk::CommandBuffer);
    b"vkCmdSetViewport"(vk::CommandBuffer, u32, u32, *const vk::Viewport);
    b"vkCmdSetScissor"(vk::CommandBuffer, u32, u32, *const vk::Rect2D);
}

/// The device; what draws opaque splats records nothing on it.
pub fn device(instance: &ash::Instance, own: &ash::Device) -> ash::Device {
    let find = instance.fp_v1_0().get_device_proc_addr;
    // SAFETY: functions of this device, or such that do nothing.
    unsafe {
        let found = |name: &CStr| instead(name).or_else(|| find(own.handle(), name.as_ptr()));
        ash::Device::load_with(|name| std::mem::transmute(found(name)), own.handle())
    }
}
