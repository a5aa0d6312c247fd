//! The element `camera`, in which the Point Cloud Library writes where a scan was taken from.

use glam::DVec3;
use ply_rs_bw::ply::{ElementDef, PropertyAccess, PropertyAccessResult};

/// The place of the scanner; its axes and its lens, which the element has, too, are not kept.
#[derive(Clone, Copy, Debug)]
pub(super) struct Viewpoint(DVec3);

impl Viewpoint {
    /// Whether an element has the properties.
    pub(super) fn is_in(def: &ElementDef) -> bool {
        ["view_px", "view_py", "view_pz"].iter().all(|name| def.properties.contains_key(*name))
    }

    /// The place, if the element tells one: 0 0 0 is what the library writes where it knows none.
    pub(super) fn place(self) -> Option<DVec3> {
        (self.0.is_finite() && self.0 != DVec3::ZERO).then_some(self.0)
    }

    fn store(&mut self, name: &str, value: f64) -> PropertyAccessResult {
        match name {
            "view_px" => self.0.x = value,
            "view_py" => self.0.y = value,
            "view_pz" => self.0.z = value,
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Viewpoint {
    fn new() -> Self {
        Self(DVec3::ZERO)
    }

    fn set_float(&mut self, name: &str, value: f32) -> PropertyAccessResult {
        self.store(name, value.into())
    }

    fn set_double(&mut self, name: &str, value: f64) -> PropertyAccessResult {
        self.store(name, value)
    }
}
