//! What `--print-frames` prints.

use surfel::{notes::counted, vk::Device};

use super::picture::Cost;
use crate::allocator;

/// A frame that is done.
pub fn frame(cost: &Cost) -> String {
    let ([width, height], what) = (cost.size_px, cost.what);
    let since = cost.since_input.map_or(String::new(), |since| {
        format!(", its end seen {:.1} ms after its input", 1e3 * since.as_secs_f64())
    });
    let first = match cost.unknown {
        0 => String::new(),
        count => format!(" with {} for the first time", counted(count as u64, "pipelines")),
    };
    format!("{what} {width}x{height}{first}: {:.1} ms on the device{since}", 1e3 * cost.secs)
}

/// What is in use of memory, when the window rests.
pub fn at_rest(device: &Device) -> String {
    let (bytes, pieces) = device.memory_in_use();
    let own = allocator::live_bytes();
    format!("at rest: {own} bytes of the program's own, {bytes} of the device's in {pieces} pieces")
}
