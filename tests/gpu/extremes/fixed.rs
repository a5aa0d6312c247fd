//! The same three hundred scenes in every run of the tests.

use super::{
    draw::draw,
    method::Method,
    rows::{self, Row},
};
use crate::common::{moves_corners, shared};
use surfel::scene::Rasterizer;

/// So many scenes of each row.
const SCENES_A_ROW: u64 = 10;

/// What a theme's scenes have to show at least.
const FEWEST_PX: usize = 2000;

/// Of the methods of a scene the one whose turn it is: each row has each, and not each row the same ones first.
pub(super) fn one_in_turn(row: usize, scene: u64, methods: Vec<Method>) -> Vec<Method> {
    vec![methods[(scene as usize + 3 * row) % methods.len()]]
}

/// Scenes by one method each, which take turns: nothing is missed, nothing too much, and no figure beyond its row's bound.
fn agree(theme: &str) {
    let mut headless = shared();
    let moves_corners = moves_corners(headless.device());
    let (mut compared, mut beyond) = (0, Vec::new());
    let all = rows::all();
    for (place, row) in all.iter().enumerate().filter(|(_, row)| row.theme == theme) {
        for number in 0..SCENES_A_ROW {
            let one = |methods| one_in_turn(place, number, methods);
            for drawn in draw(&mut headless, row, &row.case(number, true), one) {
                compared += drawn.errors.compared;
                let is_known = moves_corners && drawn.method == Method::Surface(Rasterizer::Triangle);
                if !drawn.beyond.is_empty() && !is_known {
                    let (name, method) = (row.name, drawn.name());
                    beyond.push(format!("{name}: {number} by {method}: {}", drawn.beyond));
                }
            }
        }
    }
    println!("{theme}: {compared} pixels");
    assert!(compared > FEWEST_PX, "{theme}: {compared} pixels: too little is seen");
    assert!(beyond.is_empty(), "{} scenes: {beyond:#?}", beyond.len());
}

macro_rules! themes {
    ($($test:ident $theme:literal,)+) => {
        const THEMES: &[&str] = &[$($theme),+];

        $(#[test]
        fn $test() {
            agree($theme);
        })+
    };
}

themes! {
    ordinary_scenes_agree "ordinary",
    scenes_that_are_large_beside_their_splats_agree "extent",
    radii_of_every_size_agree "sizes",
    telephoto_lenses_agree "telephoto",
    tangent_vectors_nearly_parallel_agree "skew",
    splats_through_the_eye_plane_agree "eye plane",
    ground_that_the_eye_lies_on_agrees "ground",
    far_sheets_agree "sheets",
    scenes_through_a_file_agree "file",
}

#[test]
fn every_row_has_its_test() {
    let all = rows::all();
    assert!(all.len() as u64 * SCENES_A_ROW >= 300);
    let has_test = |row: &&Row| THEMES.contains(&row.theme);
    assert_eq!(all.iter().filter(has_test).count(), all.len());
}

/// The pictures of tiles are those of the dispatch that sums and shades them, where the eye is outside of the scene.
#[test]
fn most_pictures_by_tiles_are_shaded_at_once() {
    let mut headless = shared();
    let all = rows::all();
    for name in ["ordinary", "telephoto, 10 to 1 degrees", "far sheets, 1e-3 to 1e-6 apart"] {
        let row = all.iter().find(|row| row.name == name).unwrap();
        let (mut pictures, mut at_once) = (0, 0);
        for number in 0..10 {
            let pictures_of = |methods: Vec<Method>| methods.into_iter().filter(|m| m.is_picture()).collect();
            for drawn in draw(&mut headless, row, &row.case(number, true), pictures_of) {
                pictures += 1;
                at_once += usize::from(drawn.at_once);
            }
        }
        println!("{name}: {at_once} of {pictures}");
        assert!(3 * at_once > pictures, "{name}: {at_once} of {pictures}");
    }
}
