//! Scenes that go through a file: what is drawn is what was read, and is as near to the original as the file's format says.

use std::fs;

use surfel::{
    load::{LoadOptions, Model, load},
    save,
    scene::{Object, Shapes},
};

use super::{
    errors::{Errors, Seen},
    method::Method,
    rows::Case,
    truth::Truth,
};
use crate::common::oracle_of;

/// How far a file may move a splat, in its radii: `MOST_SHIFT` of `src/save/splats.rs`.
const MOST_SHIFT: f64 = 1.0 / 1024.0;

/// The scene as it is read from a file that it was written to.
pub fn written_and_read(case: &Case) -> Case {
    let object = &case.hard.scene.objects[0];
    let folder = temp_dir::TempDir::new().unwrap();
    let path = folder.path().join("scene.ply");
    save::splats(&path, &object.splats, object.closed, None, &()).unwrap();
    assert!(fs::metadata(&path).unwrap().len() > 100);
    let Model::Splats { splats, closed } = load(&path, &LoadOptions::default(), &()).unwrap().model else {
        panic!("a mesh was read")
    };
    assert_eq!((splats.len(), closed), (object.splats.len(), object.closed));
    let mut read = case.clone();
    read.hard.scene.objects = vec![Object { name: object.name.clone(), splats, closed }];
    read
}

/// The errors beside the original. Rims are where splats that are larger or smaller by the shift, and by the oracle's margin, have others.
pub fn against_original(seen: &Seen, case: &Case, truth: &mut Truth, method: Method) -> Errors {
    for factor in [1.0 - 2.0 * MOST_SHIFT, 1.0 + 2.0 * MOST_SHIFT] {
        let mut other = case.hard.clone();
        other.settings = method.of(&other.settings);
        scale(&mut other.scene.objects[0].splats.shapes, factor as f32);
        let other = oracle_of(&other);
        truth.mark_different(&other);
        for (undecided, pixel) in truth.undecided.iter_mut().zip(&other.pixels) {
            *undecided |= pixel.rim;
        }
    }
    Errors::of(seen, truth, case.hard.settings.kernel)
}

fn scale(shapes: &mut Shapes, factor: f32) {
    match shapes {
        Shapes::Disks { radii, .. } => radii.iter_mut().for_each(|radius| *radius *= factor),
        Shapes::Ellipses { s, t } => s.iter_mut().chain(t).for_each(|v| *v *= factor),
    }
}

/// What a shift of that part of a radius does: r moves by it at most, and by four times as much along an ellipse's shorter axis, r² by
/// twice that, and d ln w / d r² is 2, of ψ_E 10 where its weight counts. Other figures are means, as in [`super::errors::F32`]; a depth
/// moves by the shift itself, of which radii beside distances make less than a part in a thousand.
pub fn of_original(limit: &Errors) -> Errors {
    let weight = limit.weight + 10.0 * 2.0 * 4.0 * MOST_SHIFT;
    Errors {
        weight,
        albedo: weight,
        normal_deg: weight.to_degrees(),
        depth: limit.depth + MOST_SHIFT,
        ..*limit
    }
}
