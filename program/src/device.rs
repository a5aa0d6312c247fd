//! The device that the command line names, and the validation layer that may watch it.

use std::{collections::BTreeMap, env, path::PathBuf};

use clap::Args;
use surfel::{
    Result,
    renderer::{Headless, HeadlessOptions},
    vk::{Messages, Validation},
};

use crate::console;

/// The device.
#[derive(Args, Clone)]
pub struct DeviceArguments {
    /// The device: its number or a part of its name, see `surfel info` [default: the best]
    #[arg(long = "device", id = "device", value_name = "NAME|INDEX")]
    pub asked: Option<String>,

    /// Have the Vulkan validation layer watch, which makes times worthless; any message makes the exit code 3
    #[arg(long)]
    pub validate: bool,
}

impl DeviceArguments {
    /// A host on the device asked for, or the best, with what was compiled in runs before.
    pub fn open(&self) -> Result<Headless> {
        Headless::new(&HeadlessOptions {
            validation: if self.validate { Validation::On } else { Validation::Off },
            device: self.asked.clone(),
            cache_folder: cache_folder(),
        })
    }

    /// Works with the host, keeps what was compiled, and prints what the validation layer said, if it watched.
    ///
    /// # Errors
    /// As `work`; messages of the layer.
    pub fn watch(
        &self,
        mut headless: Headless,
        work: impl FnOnce(&mut Headless) -> Result<()>,
    ) -> Result<()> {
        let messages = headless.device().instance().messages();
        let done = work(&mut headless);
        // A lost cache costs the next run some time, that is all.
        let _ = headless.renderer.shaders().save_cache();
        drop(headless);
        // Everything of Vulkan is destroyed by now, so that what the layer says about that is heard too.
        let said = if self.validate { conclude(&messages) } else { Ok(()) };
        done.and(said)
    }
}

/// The folder in which compiled pipelines are kept from run to run: `$XDG_CACHE_HOME/surfel`, else `~/.cache/surfel`; `None` where
/// neither is known, which costs time only.
pub fn cache_folder() -> Option<PathBuf> {
    let absolute = |name| env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let caches = absolute("XDG_CACHE_HOME").or_else(|| absolute("HOME").map(|home| home.join(".cache")))?;
    Some(caches.join("surfel"))
}

/// Prints each message of the validation layer once, and how often messages of the allow-list came.
///
/// # Errors
/// [`surfel::ErrorKind::Validation`] if there was any outside the allow-list.
pub fn conclude(messages: &Messages) -> Result<()> {
    let mut times: BTreeMap<(String, String), usize> = BTreeMap::new();
    for message in messages.all() {
        *times.entry((message.vuid, message.text)).or_default() += 1;
    }
    for ((vuid, text), times) in &times {
        console::say(&format!("validation ({times} times): {vuid}: {}", text.trim()));
    }
    let allowed: Vec<String> =
        messages.allowed_hits().into_iter().map(|(vuid, times)| format!("{vuid} {times} times")).collect();
    messages.check()?;
    match allowed.is_empty() {
        true => console::say("validation: no message"),
        false => console::say(&format!("validation: no message but allowed ones: {}", allowed.join(", "))),
    }
    Ok(())
}
