//! The depth of a host, of ours.

use crate::{
    passes::{HostDepth, plan::range::DepthRange},
    scene::{Camera, DepthOfHost},
};

/// How the host's depth follows from w, of which z is near / w, or from where depth begins on linear in it.
pub(super) fn host_depth(depth: DepthOfHost, camera: &Camera, range: DepthRange) -> HostDepth {
    let [scale, offset] = match depth {
        DepthOfHost::Perspective { a, b } => [b / camera.near(), a],
        DepthOfHost::Orthographic { a, b } => [-b * range.end, a + b * (range.from_eye + range.end)],
    };
    HostDepth { scale: scale as f32, offset: offset as f32, ..HostDepth::default() }
}
