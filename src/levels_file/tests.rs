//! Files that were written, as they are and with faults.

mod external;
mod faults;
mod placed;
mod round_trip;
mod views;
mod writing;

use std::{fs, io::Cursor, path::Path};

use glam::{DVec3, Vec3};

use super::{
    Chosen, LevelsFile,
    header::HEADER_BYTES,
    table::{ENTRY_BYTES, PageEntry},
    write_object,
};
use crate::{
    error::Result,
    load::builtin::relief,
    math::random::SplitMix,
    scene::{Colors, Object, Shapes, Splats},
};

/// The bytes of an object's file.
fn written(object: &Object) -> Vec<u8> {
    let folder = temp_dir::TempDir::new().unwrap();
    let path = folder.path().join("a.surfel");
    write_object(&path, object, Some(DVec3::Z), &()).unwrap();
    fs::read(path).unwrap()
}

fn opened(bytes: &[u8]) -> Result<LevelsFile<Cursor<&[u8]>>> {
    LevelsFile::new(Path::new("a.surfel"), Cursor::new(bytes), bytes.len() as u64)
}

/// All that a file holds.
fn loaded(bytes: &[u8]) -> Result<Chosen> {
    opened(bytes)?.load(None, u64::MAX, &())
}

/// Puts all checksums right that are within the file: what is wrong then is wrong by itself.
fn sign(bytes: &mut [u8]) {
    let number = |bytes: &[u8], at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap());
    if bytes.len() < HEADER_BYTES {
        return;
    }
    let table = usize::try_from(number(bytes, 32)).unwrap_or(usize::MAX).min(bytes.len());
    let entries = (bytes.len() - table) / ENTRY_BYTES;
    for entry in (0..entries).map(|i| table + i * ENTRY_BYTES) {
        let (at, size) = (number(bytes, entry) as usize, number(bytes, entry + 8) as u32 as usize);
        if let Some(page) = at.checked_add(size).and_then(|end| bytes.get(at..end)) {
            let crc = crc32fast::hash(page);
            bytes[entry + 12..entry + 16].copy_from_slice(&crc.to_le_bytes());
        }
    }
    let crc = crc32fast::hash(&bytes[table..]);
    bytes[44..48].copy_from_slice(&crc.to_le_bytes());
    let crc = crc32fast::hash(&bytes[..HEADER_BYTES - 4]);
    bytes[HEADER_BYTES - 4..HEADER_BYTES].copy_from_slice(&crc.to_le_bytes());
}

/// Objects of each form: disks and ellipses, one color and many, opaque and transparent, near the origin and far from it; one splat, and two.
fn objects() -> Vec<Object> {
    let mut ellipses = relief(3000);
    let Shapes::Disks { normals, radii } = &ellipses.splats.shapes else {
        unreachable!("a relief is of disks")
    };
    let axes = |(normal, radius): (&Vec3, &f32)| {
        let (s, t) = normal.normalize().any_orthonormal_pair();
        (s * *radius, t * (0.5 * *radius))
    };
    let (s, t) = normals.iter().zip(radii).map(axes).unzip();
    ellipses.splats.shapes = Shapes::Ellipses { s, t };
    ellipses.splats.colors = Colors::Uniform([0.25, 0.5, 0.75, 1.0]);
    ellipses.closed = false;
    let mut glass = relief(2000);
    glass.splats.colors.tint(None, 0.5);
    let mut far = relief(1500);
    far.splats.positions.iter_mut().for_each(|position| *position += DVec3::new(4e5, 5.4e6, 100.0));
    let mut scattered = relief(500);
    let mut random = SplitMix(5);
    let mut coordinate = || (60.0 * (random.unit() - 0.5)).exp2();
    scattered.splats.positions.iter_mut().for_each(|position| {
        *position = DVec3::new(coordinate(), coordinate(), coordinate());
    });
    vec![relief(5000), ellipses, glass, far, scattered, relief(1), relief(2)]
}

/// A splat as one line of numbers that compares.
fn rows(splats: &Splats) -> Vec<Vec<u64>> {
    let row = |i: usize| {
        let position = splats.positions[i].to_array();
        let shape: Vec<f32> = match &splats.shapes {
            Shapes::Disks { normals, radii } => [&normals[i].to_array()[..], &[radii[i]]].concat(),
            Shapes::Ellipses { s, t } => [s[i].to_array(), t[i].to_array()].concat(),
        };
        let rest =
            shape.iter().chain(&splats.color(i)).map(|value| u64::from(value.to_bits())).collect::<Vec<_>>();
        [&position.map(f64::to_bits)[..], &rest].concat()
    };
    (0..splats.len()).map(row).collect()
}

/// The pages of a file.
fn pages(bytes: &[u8]) -> Vec<PageEntry> {
    opened(bytes).unwrap().pages().to_vec()
}
