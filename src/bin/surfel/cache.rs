//! Where compiled pipelines are kept from run to run.

use std::{env, path::PathBuf};

/// `$XDG_CACHE_HOME/surfel`, else `~/.cache/surfel`; `None` where neither is known, which costs time only.
pub fn folder() -> Option<PathBuf> {
    let absolute = |name| env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let caches = absolute("XDG_CACHE_HOME").or_else(|| absolute("HOME").map(|home| home.join(".cache")))?;
    Some(caches.join("surfel"))
}
