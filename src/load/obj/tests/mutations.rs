//! Whatever the bytes: a model within bounds, or an error of one line.

use super::*;
use crate::load::mutate::{Dice, held};

const CASES: u64 = 30_000;

const WORDS: [&str; 16] = [
    "0",
    "-1",
    "3",
    "1e400",
    "nan",
    "4294967296",
    "-9223372036854775808",
    "v",
    "vn",
    "f",
    "usemtl",
    "mtllib",
    "1/2/3",
    "2//1",
    "\\\n",
    "#",
];

#[test]
fn no_bytes_panic_and_none_take_much_memory() {
    let seeds = [
        format!(
            "mtllib none.mtl\n{SQUARE}vn 0 0 1\nusemtl a\nf 1//1 2//1 3//1\nf -1/3 -2 \\\n-3 -4\nl 1 2\n"
        ),
        "v 1 2 3 1 0 1\nv 4 5 6\nv 7 8 9 2\nvn 0 0 1\nf 1 2 3\nf 3//1 2//1 1//1\n".to_owned(),
        "v 1 2 3\nv 4 5 6 0.5 0.5 0.5\nvn 0 0 1\nvn 1 0 0\np 1 2\n".to_owned(),
    ];
    let mut dice = Dice::new(0x0B7);
    let (mut good, mut bad) = (0, 0);
    for _ in 0..CASES {
        let mut bytes = seeds[dice.below(seeds.len())].clone().into_bytes();
        for _ in 0..=dice.below(4) {
            dice.mutate(&mut bytes, &WORDS);
        }
        match parse(&bytes) {
            Ok(model) => {
                good += 1;
                // Arrays that grow have room for four at least, and for twice of what they hold at most.
                assert!(held(&model) <= 16 * bytes.len() + 512, "{}", bytes.escape_ascii());
                if let Model::Mesh(mesh) = &model {
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
    assert!(good > CASES / 10 && bad > CASES / 10, "{good} models, {bad} errors");
}

#[test]
fn a_file_cut_anywhere_is_a_model_or_an_error_of_one_line() {
    let text = format!("{SQUARE}vn 0 0 1\nf 1//1 2//1 3//1\nf -1/3 -2 \\\n-3 -4\n");
    for cut in 0..text.len() {
        if let Err(error) = parse(&text.as_bytes()[..cut]) {
            assert!(error.exit_code() == 1 && !error.to_string().contains('\n'), "{error}");
        }
    }
    parse(text.as_bytes()).unwrap();
}
