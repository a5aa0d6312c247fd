//! Files with faults, for the tests of readers: the same ones in each run.

use super::Model;
use crate::scene::{Colors, Shapes};

/// Marsaglia's xorshift.
pub(super) struct Dice(u64);

impl Dice {
    /// `seed` is not 0.
    pub(super) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// A number below `end`.
    pub(super) fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as usize % end.max(1)
    }

    /// Changes a byte, a part or a word of a file; `words` are some that take others' places.
    pub(super) fn mutate(&mut self, bytes: &mut Vec<u8>, words: &[&str]) {
        // The header is most of a small file, and what is wrong in it is refused soon.
        let part = if self.below(3) > 0 { bytes.len().min(60) } else { bytes.len() };
        let at = bytes.len() - part + self.below(part);
        match self.below(7) {
            0 if at < bytes.len() => bytes[at] = self.below(256) as u8,
            1 => bytes.insert(at, self.below(256) as u8),
            2 if at < bytes.len() => drop(bytes.remove(at)),
            3 if at < bytes.len() => bytes[at] = b'0' + self.below(10) as u8,
            4 => bytes.truncate(bytes.len() - self.below(8).min(bytes.len())),
            5 => {
                // A part again, elsewhere.
                let part = bytes[at..(at + self.below(40)).min(bytes.len())].to_vec();
                let to = self.below(bytes.len());
                bytes.splice(to..to, part);
            }
            _ => {
                let is_end = |b: &u8| b.is_ascii_whitespace();
                let start = bytes[..at].iter().rposition(is_end).map_or(0, |i| i + 1);
                let end = bytes[start..].iter().position(is_end).map_or(bytes.len(), |i| start + i);
                bytes.splice(start..end, words[self.below(words.len())].bytes());
            }
        }
    }
}

/// The bytes that a model's arrays hold, with the room that they have left.
pub(super) fn held(model: &Model) -> usize {
    let colors = |colors: &Colors| match colors {
        Colors::Each(colors) => colors.capacity() * 16,
        Colors::Uniform(_) => 0,
    };
    match model {
        Model::Mesh(mesh) => {
            let normals = mesh.normals.as_ref().map_or(0, |normals| normals.capacity() * 12);
            mesh.positions.capacity() * 24 + normals + colors(&mesh.colors) + mesh.triangles.capacity() * 12
        }
        Model::Points(points) => {
            let normals = points.normals.as_ref().map_or(0, |normals| normals.capacity() * 12);
            let radii = points.radii.as_ref().map_or(0, |radii| radii.capacity() * 4);
            points.positions.capacity() * 24 + normals + radii + colors(&points.colors)
        }
        Model::Splats { splats, .. } => {
            let shapes = match &splats.shapes {
                Shapes::Disks { normals, radii } => normals.capacity() * 12 + radii.capacity() * 4,
                Shapes::Ellipses { s, t } => (s.capacity() + t.capacity()) * 12,
            };
            splats.positions.capacity() * 24 + shapes + colors(&splats.colors)
        }
    }
}
