//! What the tests of all readers do to small files: cut them at every byte, and change bytes at random.

use super::{Input, Loaded, Model, input::of_bytes};
use crate::{error::Result, math::random::SplitMix, scene::Colors};

/// Bytes that mean something in formats of text.
const WORDS: &[u8] = b"0123456789-+.eE,;:# \n\r\t\"{}[]/vfnxyzNF";

/// Reads each file as it is, cut at every byte, and `cases` changed ones. None may panic, every error is one line,
/// and what is read holds together.
pub(super) fn attack(files: &[Vec<u8>], cases: usize, parse: impl Fn(&Input<'_>) -> Result<Loaded>) {
    let try_one = |bytes: &[u8]| match of_bytes("a", bytes, &parse) {
        Ok(loaded) => check(&loaded),
        Err(error) => {
            let text = error.to_string();
            assert!(error.exit_code() == 1 && text.starts_with("a: ") && !text.contains('\n'), "{text}");
        }
    };
    for file in files {
        (0..=file.len()).for_each(|end| try_one(&file[..end]));
    }
    let mut random = SplitMix(7);
    let mut below = |most: usize| (random.bits() % most.max(1) as u64) as usize;
    for case in 0..cases {
        let mut bytes = files[case % files.len()].clone();
        for _ in 0..=below(5) {
            if bytes.is_empty() {
                break;
            }
            let at = below(bytes.len());
            match below(8) {
                0 => bytes.insert(at, below(256) as u8),
                1 => drop(bytes.remove(at)),
                2 => bytes.truncate(at),
                3 => bytes[at] = WORDS[below(WORDS.len())],
                4 => bytes[at] ^= 1 << below(8),
                5 => {
                    let end = (at + 4).min(bytes.len());
                    bytes[at..end].fill([0, 0xff, 0x7f, 0x80][below(4)]);
                }
                6 => {
                    let end = (at + below(40)).min(bytes.len());
                    let again = bytes[at..end].to_vec();
                    bytes.splice(at..at, again);
                }
                _ => bytes[at] = below(256) as u8,
            }
        }
        try_one(&bytes);
    }
}

/// Everything that is there has as many entries as it says.
fn check(loaded: &Loaded) {
    let (count, normals, colors) = match &loaded.model {
        Model::Mesh(mesh) => {
            let count = mesh.positions.len();
            assert!(mesh.triangles.iter().flatten().all(|&i| (i as usize) < count));
            (count, &mesh.normals, &mesh.colors)
        }
        Model::Points(points) => {
            assert!(points.radii.as_ref().is_none_or(|radii| radii.len() == points.positions.len()));
            (points.positions.len(), &points.normals, &points.colors)
        }
        Model::Splats { .. } => return,
    };
    assert!(normals.as_ref().is_none_or(|normals| normals.len() == count));
    if let Colors::Each(colors) = colors {
        assert_eq!(colors.len(), count);
        assert!(colors.iter().flatten().all(|value| (0.0..=1.0).contains(value)));
    }
}
