//! Collects what the validation layer says, per instance.

use std::{
    ffi::{CStr, c_void},
    sync::Mutex,
};

use ash::vk;

use super::allow_list::ALLOWED;
use crate::error::{ErrorKind, Result};

/// One warning or error of the validation layer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// The VUID or the layer's own identifier.
    pub vuid: String,
    /// The text.
    pub text: String,
}

/// Everything that an instance's validation layer said; empty for good where validation is off.
#[derive(Debug, Default)]
pub struct Messages {
    log: Mutex<Log>,
}

#[derive(Debug, Default)]
struct Log {
    messages: Vec<Message>,
    allowed_hits: Vec<u64>,
}

impl Messages {
    /// All messages outside the allow-list so far.
    pub fn all(&self) -> Vec<Message> {
        self.log().messages.clone()
    }

    /// All messages outside the allow-list since the last call of this; they are forgotten.
    pub fn take(&self) -> Vec<Message> {
        std::mem::take(&mut self.log().messages)
    }

    /// How often each entry of the allow-list was hit, in its order; only those that were.
    pub fn allowed_hits(&self) -> Vec<(&'static str, u64)> {
        let log = self.log();
        let hits = ALLOWED.iter().zip(&log.allowed_hits);
        hits.filter(|(_, hits)| **hits > 0).map(|(allowed, hits)| (allowed.vuid, *hits)).collect()
    }

    /// Fails if anything was said.
    ///
    /// # Errors
    /// [`ErrorKind::Validation`] with the first message.
    pub fn check(&self) -> Result<()> {
        let log = self.log();
        match log.messages.first() {
            None => Ok(()),
            Some(first) => Err(ErrorKind::Validation {
                count: log.messages.len(),
                first: format!("{}: {}", first.vuid, first.text),
            }
            .into()),
        }
    }

    /// Takes one message in, as the layer's callback does.
    pub(super) fn push(&self, message: Message) {
        let mut log = self.log();
        match ALLOWED.iter().position(|allowed| allowed.covers(&message.vuid, &message.text)) {
            Some(index) => {
                log.allowed_hits.resize(ALLOWED.len(), 0);
                log.allowed_hits[index] += 1;
            }
            None => log.messages.push(message),
        }
    }

    fn log(&self) -> std::sync::MutexGuard<'_, Log> {
        // A panic of another thread while it held the lock leaves a complete log behind.
        self.log.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }
}

/// The callback that the layer calls, on any thread. `user_data` points to the instance's [`Messages`].
///
/// # Safety
/// Only for a messenger whose `user_data` is a `Messages` that lives longer than the messenger.
pub(super) unsafe extern "system" fn on_message(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user_data: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: the layer passes valid data for the duration of the call; user_data is this function's contract.
    let (data, messages) = unsafe { (data.as_ref(), user_data.cast::<Messages>().as_ref()) };
    if let (Some(data), Some(messages)) = (data, messages) {
        let text = |pointer: *const std::ffi::c_char| match pointer.is_null() {
            true => String::new(),
            // SAFETY: Vulkan's strings end with a zero byte and live for the duration of the call.
            false => unsafe { CStr::from_ptr(pointer) }.to_string_lossy().into_owned(),
        };
        messages.push(Message { vuid: text(data.p_message_id_name), text: text(data.p_message) });
    }
    vk::FALSE
}
