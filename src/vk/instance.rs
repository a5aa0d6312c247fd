//! The Vulkan instance, owned or borrowed, and its validation.

use std::{ffi::CStr, sync::Arc};

use ash::{ext, vk};

use super::{
    loader::{VALIDATION_LAYER, load_entry},
    messages::{Messages, on_message},
    result::VkResultExt,
    validation::{FEATURES, Through, Validation, settings},
};
use crate::error::{ErrorKind, Result};

/// A Vulkan instance; clones share it.
#[derive(Clone)]
pub struct Instance(Arc<Shared>);

struct Shared {
    raw: ash::Instance,
    debug_utils: bool,
    messenger: Option<(ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    owned: bool,
    /// It has the extensions of a display.
    #[cfg_attr(not(feature = "view"), expect(dead_code, reason = "only windows ask"))]
    presents: bool,
    // Dropped after the messenger, which points to it, is destroyed (`drop` below runs before any field's).
    messages: Arc<Messages>,
    // The library with Vulkan's code: dropped last.
    _entry: Option<ash::Entry>,
}

impl Instance {
    /// Creates an instance of Vulkan 1.3.
    ///
    /// # Errors
    /// [`ErrorKind::NoDevice`] without a Vulkan loader or driver, or where validation is asked for and its layer is
    /// not installed.
    pub fn new(validation: Validation) -> Result<Self> {
        Self::with_extensions(validation, &[], Arc::default())
    }

    /// Another one without a display, watched as this one is: what its layer says is among this one's [`Self::messages`].
    ///
    /// # Errors
    /// As [`Instance::new`].
    pub fn another(&self) -> Result<Self> {
        let validation = if self.is_validated() { Validation::On } else { Validation::Off };
        Self::with_extensions(validation, &[], self.messages())
    }

    /// As [`Instance::new`], with extensions of which it is known that the loader has them, and messages among these.
    pub(super) fn with_extensions(
        validation: Validation,
        wanted: &[&CStr],
        messages: Arc<Messages>,
    ) -> Result<Self> {
        let no_device = |reason: String| ErrorKind::NoDevice { reasons: vec![reason] };
        let (entry, version) = load_entry()?;
        if version < vk::API_VERSION_1_3 {
            let (major, minor) = (vk::api_version_major(version), vk::api_version_minor(version));
            return Err(no_device(format!("the Vulkan loader is {major}.{minor}, 1.3 is needed")).into());
        }
        let watch = validation == Validation::On;
        if watch && !has_layer(&entry, VALIDATION_LAYER)? {
            let name = VALIDATION_LAYER.to_string_lossy();
            return Err(no_device(format!("validation was asked for, but {name} is not installed")).into());
        }
        let debug_utils = watch || has_extension(&entry, ext::debug_utils::NAME)?;

        let app = vk::ApplicationInfo::default()
            .application_name(c"surfel")
            .engine_name(c"surfel")
            .api_version(vk::API_VERSION_1_3);
        let layers: &[_] = if watch { &[VALIDATION_LAYER.as_ptr()] } else { &[] };
        if let Some(missing) = first_missing(&entry, wanted)? {
            let reason = format!("the Vulkan loader lacks {}", missing.to_string_lossy());
            return Err(no_device(reason).into());
        }
        let mut extensions: Vec<_> = wanted.iter().map(|name| name.as_ptr()).collect();
        if debug_utils {
            extensions.push(ext::debug_utils::NAME.as_ptr());
        }
        let through = if watch { Some(Through::of_installed(&entry)?) } else { None };
        extensions.extend(through.map(|through| through.extension().as_ptr()));
        let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&FEATURES);
        let settings = settings();
        let mut settings = vk::LayerSettingsCreateInfoEXT::default().settings(&settings);
        let mut early = messenger_info(&messages);
        let mut info = vk::InstanceCreateInfo::default()
            .application_info(&app)
            .enabled_layer_names(layers)
            .enabled_extension_names(&extensions);
        if let Some(through) = through {
            info = match through {
                Through::LayerSettings => info.push_next(&mut settings),
                Through::ValidationFeatures => info.push_next(&mut features),
            };
            info = info.push_next(&mut early);
        }
        // SAFETY: the chain above lives until the call returns; `messages` outlives the instance (field order).
        let raw = unsafe { entry.create_instance(&info, None) }.map_err(|result| match result {
            vk::Result::ERROR_INCOMPATIBLE_DRIVER => {
                no_device("no Vulkan driver is installed (or VK_DRIVER_FILES names none)".to_owned()).into()
            }
            other => crate::error::Error::vulkan("vkCreateInstance", "", other),
        })?;
        let mut shared = Shared {
            raw,
            debug_utils,
            messenger: None,
            owned: true,
            presents: !wanted.is_empty(),
            messages,
            _entry: Some(entry.clone()),
        };
        if watch {
            let loader = ext::debug_utils::Instance::new(&entry, &shared.raw);
            let info = messenger_info(&shared.messages);
            // SAFETY: the extension is enabled; `messages` outlives the messenger, see `Drop`.
            let raw = unsafe { loader.create_debug_utils_messenger(&info, None) }
                .of_call("vkCreateDebugUtilsMessengerEXT", "")?;
            shared.messenger = Some((loader, raw));
        }
        Ok(Self(Arc::new(shared)))
    }

    /// Takes a host's instance, which the host destroys after everything of ours is dropped. `debug_utils` says
    /// whether the host enabled `VK_EXT_debug_utils`: then our objects carry names.
    ///
    /// # Safety
    /// `raw` must be a live Vulkan 1.3 instance and stay alive until every object made from it here is dropped.
    pub unsafe fn borrow(raw: ash::Instance, debug_utils: bool) -> Self {
        let messages = Arc::default();
        Self(Arc::new(Shared {
            raw,
            debug_utils,
            messenger: None,
            owned: false,
            presents: false,
            messages,
            _entry: None,
        }))
    }

    /// The raw instance.
    pub fn raw(&self) -> &ash::Instance {
        &self.0.raw
    }

    /// The loader's entry points; `None` of an instance that was not made for a display.
    #[cfg(feature = "view")]
    pub(super) fn entry(&self) -> Option<&ash::Entry> {
        self.0._entry.as_ref().filter(|_| self.0.presents)
    }

    /// Whether `VK_EXT_debug_utils` is enabled.
    pub fn has_debug_utils(&self) -> bool {
        self.0.debug_utils
    }

    /// Whether the validation layer watches this instance through us.
    pub fn is_validated(&self) -> bool {
        self.0.messenger.is_some()
    }

    /// The messages of the validation layer. They stay readable after the instance is gone.
    pub fn messages(&self) -> Arc<Messages> {
        Arc::clone(&self.0.messages)
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        if let Some((loader, messenger)) = self.messenger.take() {
            // SAFETY: created from this instance, destroyed once.
            unsafe { loader.destroy_debug_utils_messenger(messenger, None) };
        }
        if self.owned {
            // SAFETY: every child holds a clone of the `Arc` around this, so none is left.
            unsafe { self.raw.destroy_instance(None) };
        }
    }
}

fn messenger_info(messages: &Arc<Messages>) -> vk::DebugUtilsMessengerCreateInfoEXT<'static> {
    vk::DebugUtilsMessengerCreateInfoEXT::default()
        .message_severity(
            vk::DebugUtilsMessageSeverityFlagsEXT::WARNING | vk::DebugUtilsMessageSeverityFlagsEXT::ERROR,
        )
        .message_type(
            vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION
                | vk::DebugUtilsMessageTypeFlagsEXT::PERFORMANCE
                | vk::DebugUtilsMessageTypeFlagsEXT::GENERAL,
        )
        .pfn_user_callback(Some(on_message))
        .user_data(Arc::as_ptr(messages).cast_mut().cast())
}

fn has_layer(entry: &ash::Entry, name: &CStr) -> Result<bool> {
    // SAFETY: no contract beyond a loaded entry.
    let layers = unsafe { entry.enumerate_instance_layer_properties() }
        .of_call("vkEnumerateInstanceLayerProperties", "")?;
    Ok(layers.iter().any(|layer| layer.layer_name_as_c_str() == Ok(name)))
}

fn first_missing<'a>(entry: &ash::Entry, wanted: &[&'a CStr]) -> Result<Option<&'a CStr>> {
    for name in wanted {
        if !has_extension(entry, name)? {
            return Ok(Some(name));
        }
    }
    Ok(None)
}

fn has_extension(entry: &ash::Entry, name: &CStr) -> Result<bool> {
    // SAFETY: no contract beyond a loaded entry.
    let extensions = unsafe { entry.enumerate_instance_extension_properties(None) }
        .of_call("vkEnumerateInstanceExtensionProperties", "")?;
    Ok(extensions.iter().any(|extension| extension.extension_name_as_c_str() == Ok(name)))
}
