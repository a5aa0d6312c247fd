//! Names of objects and labels in command buffers: for people, in captures and messages.

use std::ffi::CString;

use ash::vk;

use super::device::Device;

impl Device {
    /// Gives an object its debug name.
    pub(crate) fn set_name<T: vk::Handle>(&self, object: T, name: &str) {
        if let Some(names) = self.debug_utils() {
            let text = CString::new(name.replace('\0', " ")).unwrap_or_default();
            let info = vk::DebugUtilsObjectNameInfoEXT::default().object_handle(object).object_name(&text);
            // A name is a help for people: failing to set one changes nothing.
            // SAFETY: the object is alive and belongs to this device; the extension is enabled.
            let _ = unsafe { names.set_debug_utils_object_name(&info) };
        }
    }

    /// Begins a debug label in a command buffer; nothing without the debug extension.
    pub(crate) fn begin_label(&self, commands: vk::CommandBuffer, name: &str) {
        if let Some(names) = self.debug_utils() {
            let text = CString::new(name.replace('\0', " ")).unwrap_or_default();
            let label = vk::DebugUtilsLabelEXT::default().label_name(&text);
            // SAFETY: `commands` is recording (every caller records into it); the extension is enabled.
            unsafe { names.cmd_begin_debug_utils_label(commands, &label) };
        }
    }

    /// Ends the label begun last.
    pub(crate) fn end_label(&self, commands: vk::CommandBuffer) {
        if let Some(names) = self.debug_utils() {
            // SAFETY: as in `begin_label`, which came before.
            unsafe { names.cmd_end_debug_utils_label(commands) };
        }
    }
}
