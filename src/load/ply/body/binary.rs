//! Elements of binary bodies: values without anything between them.

use super::{Fault, Field, Items, Table};
use crate::load::ply::schema::{Element, Encoding, Kind, Scalar};

/// Calls a function with what makes an `f64` of a type's bytes.
macro_rules! by_type {
    ($scalar:expr, $encoding:expr, $function:ident($($argument:expr),*)) => {
        match ($scalar, $encoding == Encoding::Big) {
            (Scalar::Char, _) => $function($($argument,)* |b| i8::from_le_bytes(b).into()),
            (Scalar::UChar, _) => $function($($argument,)* |b| u8::from_le_bytes(b).into()),
            (Scalar::Short, false) => $function($($argument,)* |b| i16::from_le_bytes(b).into()),
            (Scalar::Short, true) => $function($($argument,)* |b| i16::from_be_bytes(b).into()),
            (Scalar::UShort, false) => $function($($argument,)* |b| u16::from_le_bytes(b).into()),
            (Scalar::UShort, true) => $function($($argument,)* |b| u16::from_be_bytes(b).into()),
            (Scalar::Int, false) => $function($($argument,)* |b| i32::from_le_bytes(b).into()),
            (Scalar::Int, true) => $function($($argument,)* |b| i32::from_be_bytes(b).into()),
            (Scalar::UInt, false) => $function($($argument,)* |b| u32::from_le_bytes(b).into()),
            (Scalar::UInt, true) => $function($($argument,)* |b| u32::from_be_bytes(b).into()),
            (Scalar::Long, false) => $function($($argument,)* |b| i64::from_le_bytes(b) as f64),
            (Scalar::Long, true) => $function($($argument,)* |b| i64::from_be_bytes(b) as f64),
            (Scalar::ULong, false) => $function($($argument,)* |b| u64::from_le_bytes(b) as f64),
            (Scalar::ULong, true) => $function($($argument,)* |b| u64::from_be_bytes(b) as f64),
            (Scalar::Float, false) => $function($($argument,)* |b| f32::from_le_bytes(b).into()),
            (Scalar::Float, true) => $function($($argument,)* |b| f32::from_be_bytes(b).into()),
            (Scalar::Double, false) => $function($($argument,)* f64::from_le_bytes),
            (Scalar::Double, true) => $function($($argument,)* f64::from_be_bytes),
        }
    };
}

/// The value of these bytes; NaN of too few.
pub(super) fn number(bytes: &[u8], scalar: Scalar, encoding: Encoding) -> f64 {
    by_type!(scalar, encoding, one(bytes))
}

fn one<const N: usize>(bytes: &[u8], value: impl Fn([u8; N]) -> f64) -> f64 {
    bytes.first_chunk().map_or(f64::NAN, |bytes| value(*bytes))
}

/// The wanted values of rows that have `stride` bytes each, one property after the other.
pub(super) fn columns(rows: &[u8], stride: usize, wanted: &[Wanted], encoding: Encoding, table: &mut Table) {
    table.clear();
    for (wanted, column) in wanted.iter().zip(table.columns_mut()) {
        by_type!(wanted.scalar, encoding, extend(column, rows, stride, wanted.offset));
    }
}

fn extend<const N: usize>(
    column: &mut Vec<f64>,
    rows: &[u8],
    stride: usize,
    offset: usize,
    value: impl Fn([u8; N]) -> f64,
) {
    let of_row = |row: &[u8]| row.get(offset..).and_then(<[u8]>::first_chunk).map_or(f64::NAN, |b| value(*b));
    column.extend(rows.chunks_exact(stride).map(of_row));
}

/// Where a wanted value is in each row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted {
    offset: usize,
    scalar: Scalar,
}

/// The bytes of an element without lists, and where the wanted properties are in it.
pub(super) fn places(def: &Element, wanted: &[usize]) -> (usize, Vec<Wanted>) {
    let (mut stride, mut places) = (0, Vec::new());
    for property in &def.properties {
        if let Kind::One(scalar) = property.kind {
            places.push(Wanted { offset: stride, scalar });
            stride += scalar.bytes();
        }
    }
    (stride, wanted.iter().filter_map(|&property| places.get(property).copied()).collect())
}

/// Reads one element with lists, and tells what follows it.
pub(super) fn element<'a: 'd, 'd>(
    mut rest: &'a [u8],
    def: &'d Element,
    encoding: Encoding,
    take: &mut dyn FnMut(usize, Field<'d>),
) -> Result<&'a [u8], Fault> {
    for (i, property) in def.properties.iter().enumerate() {
        let (Kind::One(first) | Kind::List { length: first, .. }) = property.kind;
        let (bytes, after) = rest.split_at_checked(first.bytes()).ok_or(Fault::Ends)?;
        let value = number(bytes, first, encoding);
        rest = after;
        let Kind::List { item, .. } = property.kind else {
            take(i, Field::One(value));
            continue;
        };
        if value < 0.0 {
            return Err(Fault::Is(format!("{} has {value} items; expected 0 or more", property.name)));
        }
        let bytes = (value as usize).checked_mul(item.bytes()).ok_or(Fault::Ends)?;
        let (bytes, after) = rest.split_at_checked(bytes).ok_or(Fault::Ends)?;
        rest = after;
        take(i, Field::List(Items::Bytes { bytes, item, encoding }));
    }
    Ok(rest)
}
