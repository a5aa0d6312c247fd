//! Numbers in little-endian order.

use glam::{DVec3, Vec3};

/// Bytes that are added one number after the other.
#[derive(Default)]
pub(super) struct Out(pub Vec<u8>);

impl Out {
    pub fn u32(&mut self, value: u32) {
        self.0.extend(value.to_le_bytes());
    }

    pub fn u32s<const N: usize>(&mut self, values: [u32; N]) {
        values.into_iter().for_each(|value| self.u32(value));
    }

    pub fn u64(&mut self, value: u64) {
        self.0.extend(value.to_le_bytes());
    }

    pub fn f32(&mut self, value: f32) {
        self.0.extend(value.to_le_bytes());
    }

    pub fn f32s<const N: usize>(&mut self, values: [f32; N]) {
        values.into_iter().for_each(|value| self.f32(value));
    }

    pub fn f64(&mut self, value: f64) {
        self.0.extend(value.to_le_bytes());
    }

    pub fn f64s<const N: usize>(&mut self, values: [f64; N]) {
        values.into_iter().for_each(|value| self.f64(value));
    }

    pub fn vec3(&mut self, value: Vec3) {
        self.f32s(value.to_array());
    }

    pub fn dvec3(&mut self, value: DVec3) {
        self.f64s(value.to_array());
    }
}

/// Bytes that are taken one number after the other; what lies behind their end is 0, which who takes them excludes by their number.
pub(super) struct In<'a>(pub &'a [u8]);

impl In<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        match self.0.split_first_chunk() {
            Some((first, rest)) => {
                self.0 = rest;
                *first
            }
            None => [0; N],
        }
    }

    pub fn u16(&mut self) -> u16 {
        u16::from_le_bytes(self.take())
    }

    pub fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.take())
    }

    pub fn u64(&mut self) -> u64 {
        u64::from_le_bytes(self.take())
    }

    pub fn f32(&mut self) -> f32 {
        f32::from_le_bytes(self.take())
    }

    pub fn f64(&mut self) -> f64 {
        f64::from_le_bytes(self.take())
    }

    pub fn vec3(&mut self) -> Vec3 {
        Vec3::from([(); 3].map(|()| self.f32()))
    }

    pub fn dvec3(&mut self) -> DVec3 {
        DVec3::from([(); 3].map(|()| self.f64()))
    }
}
