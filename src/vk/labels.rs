//! Names of objects and labels in command buffers: for people, in captures and messages.

use std::ffi::CStr;

use ash::vk;

use super::device::Device;

impl Device {
    /// Gives an object its debug name, as much of it as has room in place.
    pub(crate) fn set_name<T: vk::Handle>(&self, object: T, name: &str) {
        if let Some(names) = self.debug_utils() {
            let mut room = [0; LABEL_BYTES];
            let text = in_place(name, &mut room);
            let info = vk::DebugUtilsObjectNameInfoEXT::default().object_handle(object).object_name(text);
            // A name is a help for people: failing to set one changes nothing.
            // SAFETY: the object is alive and belongs to this device; the extension is enabled.
            let _ = unsafe { names.set_debug_utils_object_name(&info) };
        }
    }

    /// Begins a debug label in a command buffer, of as much of a name as has room in place; nothing without the debug extension.
    pub(crate) fn begin_label(&self, commands: vk::CommandBuffer, name: &str) {
        if let Some(names) = self.debug_utils() {
            let mut room = [0; LABEL_BYTES];
            let label = vk::DebugUtilsLabelEXT::default().label_name(in_place(name, &mut room));
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

/// Bytes of a name or label with its end.
const LABEL_BYTES: usize = 128;

/// A name, or as much of it as has room, up to what would end it.
fn in_place<'r>(name: &str, room: &'r mut [u8; LABEL_BYTES]) -> &'r CStr {
    let end = (0..LABEL_BYTES.min(name.len() + 1)).rfind(|end| name.is_char_boundary(*end)).unwrap_or(0);
    room[..end].copy_from_slice(&name.as_bytes()[..end]);
    CStr::from_bytes_until_nul(room).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_labels_are_as_long_as_they_have_room() {
        let of = |name: &str| in_place(name, &mut [0; LABEL_BYTES]).to_str().unwrap().to_owned();
        assert_eq!(of("depth of tiles"), "depth of tiles");
        assert_eq!(of("ends\0here"), "ends");
        assert_eq!(of(&"ü".repeat(100)), "ü".repeat(63));
    }
}
