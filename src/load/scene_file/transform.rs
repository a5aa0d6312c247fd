//! Where an object of a scene file is.

use glam::{DAffine3, DMat3, DVec3};

use super::document::{Table, Value};
use crate::{error::Result, scene::is_invertible};

pub(super) fn read(table: &Table<'_>) -> Result<DAffine3> {
    let placed = match table.get("matrix") {
        Some(matrix) => {
            for key in ["translate", "rotate_deg", "scale"] {
                table.refuse(key, "beside matrix; expected one or the other")?;
            }
            let placed = of_matrix(&matrix)?;
            if !is_invertible(&placed) {
                return Err(matrix.fault("it flattens the object; expected a matrix that can be inverted"));
            }
            placed
        }
        None => of_parts(table)?,
    };
    match is_invertible(&placed) {
        true => Ok(placed),
        false => Err(table.fault("its place is beyond the range of 64-bit numbers")),
    }
}

/// Scaled, turned about x, then y, then z, and moved last.
fn of_parts(table: &Table<'_>) -> Result<DAffine3> {
    let three = |key: &'static str| {
        let numbers = |value: Value<'_>| value.numbers("three numbers", |_| true).map(DVec3::from_array);
        table.get(key).map(numbers).transpose().map(Option::unwrap_or_default)
    };
    let (translation, rotation) = (three("translate")?, three("rotate_deg")?.map(f64::to_radians));
    let scale = table.get("scale").map(|value| scale(&value)).transpose()?.unwrap_or(DVec3::ONE);
    let turned = DMat3::from_rotation_z(rotation.z)
        * DMat3::from_rotation_y(rotation.y)
        * DMat3::from_rotation_x(rotation.x);
    Ok(DAffine3 { matrix3: turned * DMat3::from_diagonal(scale), translation })
}

fn scale(value: &Value<'_>) -> Result<DVec3> {
    const WHAT: &str = "a number or three numbers, none of them 0";
    let not_zero = |number: f64| number != 0.0;
    match value.elements() {
        None => value.number(WHAT, not_zero).map(DVec3::splat),
        Some(_) => value.numbers(WHAT, not_zero).map(DVec3::from_array),
    }
}

/// Three rows of four numbers as mathematics writes them, or four rows of three: where x, y, z and the origin go.
fn of_matrix(value: &Value<'_>) -> Result<DAffine3> {
    const WHAT: &str = "three rows of four numbers, or four rows of three";
    let rows = value.elements().unwrap_or_default();
    let column = |rows: &[[f64; 4]; 3], i: usize| DVec3::new(rows[0][i], rows[1][i], rows[2][i]);
    match rows.as_slice() {
        [x, y, z] => {
            let row = |row: &Value<'_>| row.numbers("four numbers, as three rows have", |_| true);
            let rows = [row(x)?, row(y)?, row(z)?];
            let [x, y, z, origin] = [0, 1, 2, 3].map(|i| column(&rows, i));
            Ok(DAffine3::from_cols(x, y, z, origin))
        }
        [x, y, z, origin] => {
            let row = |row: &Value<'_>| row.numbers("three numbers, as four rows have", |_| true);
            let [x, y, z, origin] = [row(x)?, row(y)?, row(z)?, row(origin)?].map(DVec3::from_array);
            Ok(DAffine3::from_cols(x, y, z, origin))
        }
        _ => Err(value.expected(WHAT)),
    }
}
