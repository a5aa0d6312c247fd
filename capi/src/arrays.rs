//! Arrays of C's.

use std::mem::take;

use surfel::scene::Colors;

use crate::{
    handle::null,
    result::{Failure, Result, SurfelResult},
};

/// Colors of C's, of as many as there are, of all alike, or none.
///
/// # Safety
/// As [`copy_colors`].
pub unsafe fn colors_of(from: *const f32, color_count: u64, count: u64) -> Result<Colors> {
    let mut all = Vec::new();
    // SAFETY: this function's contract.
    unsafe { copy_colors(from, color_count, count, &mut all) }?;
    Ok(colors_in(&mut all))
}

/// The same in a list of ours, in place of what is in it, for [`colors_in`].
///
/// # Safety
/// `from` is NULL or leads to `color_count` of them.
pub unsafe fn copy_colors(
    from: *const f32,
    color_count: u64,
    count: u64,
    into: &mut Vec<[f32; 4]>,
) -> Result<()> {
    let given = if from.is_null() { 0 } else { color_count };
    if ![0, 1, count].contains(&given) || (given == 0 && !from.is_null() && count > 0) {
        return Err(Failure::invalid(format!("colorCount is {color_count}: expected 1 or {count}")));
    }
    // SAFETY: this function's contract.
    unsafe { copy(from.cast(), given, "colors", |color: [f32; 4]| color, into) }
}

/// What a list of ours means: one color for each, whose memory goes with them, one for all, or none.
pub fn colors_in(colors: &mut Vec<[f32; 4]>) -> Colors {
    match colors[..] {
        [] => Colors::unknown(),
        [color] => Colors::Uniform(color),
        _ => Colors::Each(take(colors)),
    }
}

/// An array of C's.
///
/// # Safety
/// `from` is NULL or leads to `count` of them, which stay as they are for so long.
pub unsafe fn array<'a, T: Copy>(from: *const T, count: u64, name: &str) -> Result<&'a [T]> {
    let most = isize::MAX as u64 / size_of::<T>() as u64;
    match usize::try_from(count) {
        Ok(0) => Ok(&[]),
        _ if from.is_null() => Err(null(name)),
        _ if !from.is_aligned() => Err(Failure::invalid(format!("{name} is not aligned"))),
        // SAFETY: this function's contract; not null, aligned, of a size that memory can have.
        Ok(length) if count <= most => Ok(unsafe { std::slice::from_raw_parts(from, length) }),
        _ => Err(Failure::invalid(format!("{name}: {count} of them don't fit into memory"))),
    }
}

/// The same in one of ours, in place of what is in it.
///
/// # Safety
/// As [`array`].
pub unsafe fn copy<T: Copy, U>(
    from: *const T,
    count: u64,
    name: &str,
    of: fn(T) -> U,
    into: &mut Vec<U>,
) -> Result<()> {
    // SAFETY: this function's contract.
    let given = unsafe { array(from, count, name) }?;
    let no_memory = |_| Failure {
        code: SurfelResult::OutOfMemory,
        text: format!("{name}: no memory for {count} of them"),
    };
    into.clear();
    into.try_reserve_exact(given.len()).map_err(no_memory)?;
    into.extend(given.iter().map(|value| of(*value)));
    Ok(())
}

/// The same in a list of its own.
///
/// # Safety
/// As [`array`].
pub unsafe fn copied<T: Copy, U>(from: *const T, count: u64, name: &str, of: fn(T) -> U) -> Result<Vec<U>> {
    let mut all = Vec::new();
    // SAFETY: this function's contract.
    unsafe { copy(from, count, name, of, &mut all) }?;
    Ok(all)
}
