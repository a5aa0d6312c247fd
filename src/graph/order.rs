//! Compile stage 3: the order of execution.

use super::cull::Live;

/// The declared passes that are left, by index, in the order of execution.
///
/// That is declaration order: a pass can only name contents that earlier passes made (see `validate`), so that it
/// is a topological order already, and the stable one, where ties are broken by declaration.
pub(super) fn order(live: &Live) -> Vec<usize> {
    (0..live.passes.len()).filter(|&i| live.passes[i]).collect()
}
