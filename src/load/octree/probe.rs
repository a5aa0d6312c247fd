//! Whether a file is an octree of points.

use std::{
    fs::{self, File},
    io::{self, Read},
    path::Path,
};

use super::{copc, potree};

/// So much of a file tells what it is.
pub(super) const PROBE_BYTES: u64 = 1 << 16;

/// Whether a file is an octree of points, by its first bytes; not what can't be read, what is no regular file, and COPC of longitude and
/// latitude, all points of which [`load`](crate::load::load()) reads and makes lengths of.
pub fn is_point_octree(path: &Path) -> bool {
    let is_file = fs::metadata(path).is_ok_and(|metadata| metadata.is_file());
    let head = || {
        let mut head = Vec::new();
        File::open(path)?.take(PROBE_BYTES).read_to_end(&mut head)?;
        Ok::<_, io::Error>(head)
    };
    let is_octree = |head: &[u8]| match copc::is_copc(head) {
        true => !copc::has_degrees(head),
        false => potree::is_metadata(head),
    };
    is_file && head().is_ok_and(|head| is_octree(&head))
}
