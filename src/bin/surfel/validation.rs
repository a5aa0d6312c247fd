//! What the validation layer said, at the end.

use std::collections::BTreeMap;

use surfel::{Result, vk::Messages};

use crate::console;

/// Prints each message once, and how often messages of the allow-list came.
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
