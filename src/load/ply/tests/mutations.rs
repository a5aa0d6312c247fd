//! Whatever the bytes: a model within bounds, or an error of one line.

use super::{
    Value::*,
    faults::{POINTS, TRIANGLE, message, triangle},
    gaussians::gaussian_files,
    *,
};
use crate::load::mutate::{Dice, held};

const CASES: u64 = 30_000;

/// Small valid files of every kind.
fn seeds() -> Vec<Vec<u8>> {
    let mut seeds: Vec<Vec<u8>> = triangle(vec![Char(3), Int(0), Int(1), Int(2)]).into();
    let strip = vec![Char(4), Int(0), Int(1), Int(2), Int(-1)];
    let vertices = [vec![UChar(0); 3], vec![UChar(1); 3], vec![UChar(2); 3], strip];
    seeds.extend(encodings(&TRIANGLE.replace("face", "tristrips"), &vertices));
    let splats = [0.0, 1.0, 2.0, 0.0, 0.0, 1.0, 0.5].map(Float).to_vec();
    seeds.extend(encodings(&POINTS.replace("ascii", "ENCODING"), &[splats.clone(), splats]));
    seeds.extend(gaussian_files());
    seeds.push(
        b"ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\nproperty double z\n\
        property list uchar int neighbors\nproperty ushort r\nproperty ushort g\nproperty ushort b\nelement camera 1\n\
        property float view_px\nproperty float view_py\nproperty float view_pz\nend_header\n1 2 3 1 7 8 9 10\n4 5 6\n"
            .to_vec(),
    );
    seeds
}

#[test]
fn the_seeds_are_valid_and_no_cut_of_them_is() {
    for seed in seeds() {
        load(&seed).unwrap();
        // The last byte of an ascii file may be missing: it ends a line. And a number cut short is a number.
        let last_word = seed.iter().rposition(|b| !b.is_ascii_whitespace()).unwrap();
        let is_ascii = seed.starts_with(b"ply\nformat ascii");
        let end = if is_ascii { last_word - 2 } else { seed.len() };
        for cut in 0..end {
            assert!(!message(&seed[..cut]).contains('\n'));
        }
    }
}

const WORDS: [&str; 14] = [
    "0",
    "-1",
    "3",
    "255",
    "65536",
    "4294967295",
    "18446744073709551616",
    "nan",
    "-inf",
    "1e400",
    "list",
    "uchar",
    "double",
    "vertex_index",
];

#[test]
fn no_bytes_panic_and_none_take_much_memory() {
    let seeds = seeds();
    let mut dice = Dice::new(0x5EED);
    let (mut good, mut bad) = (0, 0);
    for _ in 0..CASES {
        let mut bytes = seeds[dice.below(seeds.len())].clone();
        for _ in 0..=dice.below(4) {
            dice.mutate(&mut bytes, &WORDS);
        }
        match load(&bytes) {
            Ok(loaded) => {
                good += 1;
                assert!(held(&loaded.model) <= 16 * bytes.len(), "{}", bytes.escape_ascii());
                if let Model::Mesh(mesh) = &loaded.model {
                    let count = mesh.positions.len();
                    assert!(mesh.triangles.iter().flatten().all(|&i| (i as usize) < count));
                }
            }
            Err(error) => {
                bad += 1;
                assert!(error.exit_code() == 1 && !error.to_string().contains('\n'), "{error}");
            }
        }
    }
    // Mutations that all lead to the same end would find nothing.
    assert!(good > CASES / 20 && bad > CASES / 3, "{good} models, {bad} errors");
}
