//! The ray of a pick: where it meets what the device found, of which it needs no scene any more.

use glam::DVec3;

use super::{NOTHING_MOVED, Nearest};
use crate::{passes::plan::range::DepthRange, scene::Camera};

/// The ray through a pixel.
#[derive(Clone, Copy, Debug)]
pub struct PickRay {
    /// Sees the one pixel.
    pub(super) camera: Camera,
    /// Where the camera is.
    pub(super) eye: DVec3,
    pub(super) range: DepthRange,
    /// Nothing is looked at, and the answer means nothing.
    pub(super) is_empty: bool,
}

impl PickRay {
    /// Where it meets the surface by the device's answer, in world space, as [`super::Picked::position`] has it; `None` where nothing is seen.
    pub fn read(&self, answer: &[u8]) -> Option<DVec3> {
        let (_, record) = self.nearest(answer)?;
        Some(self.place(record.depth.into()).0)
    }

    /// The nearest record with its number.
    pub(super) fn nearest(&self, answer: &[u8]) -> Option<(usize, Nearest)> {
        let records = answer.chunks_exact(size_of::<Nearest>());
        let nearest = |(found, best): (usize, Nearest), (place, record): (usize, &[u8])| {
            let record: Nearest = bytemuck::pod_read_unaligned(record);
            if record.moved > best.moved { (place, record) } else { (found, best) }
        };
        let nothing = Nearest { moved: NOTHING_MOVED, depth: 0.0, index: 0, unused: 0, normal: [0.0; 4] };
        let found = records.enumerate().filter(|_| !self.is_empty).fold((0, nothing), nearest);
        Some(found).filter(|(_, record)| record.moved > NOTHING_MOVED)
    }

    /// Where the pixel's ray has a reversed depth, in world space, and the depth there from the camera as it was given.
    pub(super) fn place(&self, reversed: f64) -> (DVec3, f64) {
        let camera = &self.camera;
        let focal_px = camera.focal_px(1);
        let [x, y] = camera.middle_px([1; 2]).map(|middle| (0.5 - middle) / focal_px);
        let (depth, at) = match camera.is_orthographic() {
            true => {
                let z = (1.0 - reversed) * self.range.end;
                (self.range.from_eye + z, DVec3::new(x, y, z))
            }
            false => {
                let z = camera.near() / reversed;
                (z, z * DVec3::new(x, y, 1.0))
            }
        };
        let view = camera.view_from_world();
        (view.eye + view.rotation.transpose() * at, depth)
    }
}
