//! The same three hundred scenes in every run of the tests.

use super::{draw::draw, rows};
use crate::common::shared;

/// So many scenes of each row.
const SCENES_A_ROW: u64 = 10;

/// A scene by one method each, which take turns: nothing is missed, nothing too much, and no figure beyond its row's bound.
#[test]
fn extreme_scenes_agree_with_the_oracle() {
    let mut headless = shared();
    let (mut scenes, mut compared, mut beyond) = (0, 0, Vec::new());
    for (place, row) in (0..).zip(rows::all()) {
        for number in 0..SCENES_A_ROW {
            let case = row.case(number, true);
            // So that each row has each method, and each method each row's first scenes.
            let turn = (number + 3 * place) as usize;
            let one = |methods: Vec<_>| vec![methods[turn % methods.len()]];
            for drawn in draw(&mut headless, &row, &case, one) {
                compared += drawn.errors.compared;
                if !drawn.beyond.is_empty() {
                    beyond.push(format!(
                        "{}: {number} by {}: {}",
                        row.name,
                        drawn.method.name(),
                        drawn.beyond
                    ));
                }
            }
            scenes += 1;
        }
    }
    println!("{scenes} scenes, {compared} pixels");
    assert!(scenes >= 300 && compared > 50_000, "{scenes} scenes, {compared} pixels: too little is seen");
    assert!(beyond.is_empty(), "{} scenes: {beyond:#?}", beyond.len());
}
