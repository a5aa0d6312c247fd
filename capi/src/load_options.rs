//! How files are read.

use std::ffi::{c_char, c_void};

use surfel::ash::vk;
#[cfg(feature = "files")]
use surfel::load::{Limits, LoadOptions};

#[cfg(feature = "files")]
use crate::{handle::text, listener::Listener, result::Result, structs::read};
use crate::{
    listener::SurfelListener,
    structs::{Struct, SurfelStructureType},
};

/// How files are read. Of each limit 0 is the default: as much as any file of use has.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelLoadOptions {
    /// `SURFEL_STRUCTURE_TYPE_LOAD_OPTIONS`.
    pub s_type: u32,
    /// `sizeof(SurfelLoadOptions)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// What the columns of rows of numbers are, by the words of `surfel render --columns`: `x,y,z,-,r,g,b`; NULL: as the file tells it.
    pub columns: *const c_char,
    /// Who is told how far it is, and what was noticed; NULL: nobody.
    pub listener: *const SurfelListener,
    /// Files that a file names may lie outside of its folder.
    pub allow_outside: vk::Bool32,
    /// 0; else it is refused.
    pub reserved: u32,
    /// Points or vertices at most.
    pub most_points: u64,
    /// Triangles at most.
    pub most_faces: u64,
    /// Bytes of a line of text at most.
    pub most_line_bytes: u64,
    /// Bytes of a header of text at most.
    pub most_header_bytes: u64,
    /// Corners of a polygon at most.
    pub most_list_items: u64,
    /// Bytes of standard input, of which no size is known beforehand.
    pub most_piped_bytes: u64,
    /// Bytes to which the compressed points of any LAZ or PCD file may expand, however small it is.
    pub expanded_bytes: u64,
    /// The same of files that are compressed as a whole.
    pub unpacked_bytes: u64,
    /// Bytes to which each byte of a larger compressed file may expand beyond these.
    pub expansion: u64,
    /// The same of the records of LAZ files.
    pub laz_expansion: u64,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelLoadOptions {
    const TYPE: SurfelStructureType = SurfelStructureType::LoadOptions;

    fn reserved(&self) -> u32 {
        self.reserved
    }
}

/// How C wants files to be read, and who listens.
///
/// # Safety
/// `given` is NULL or leads to as much as it says.
#[cfg(feature = "files")]
pub unsafe fn options_of(given: *const SurfelLoadOptions) -> Result<(LoadOptions, Listener)> {
    if given.is_null() {
        // SAFETY: nobody listens.
        return Ok((LoadOptions::default(), unsafe { Listener::new(std::ptr::null()) }?));
    }
    // SAFETY: this function's contract, here and below.
    let given = unsafe { read(given, "options") }?;
    let or = |given: u64, usual: u64| if given == 0 { usual } else { given };
    let size = |given: u64, usual: usize| match given {
        0 => usual,
        _ => usize::try_from(given).unwrap_or(usize::MAX),
    };
    let usual = Limits::DEFAULT;
    let limits = Limits {
        // Their numbers are kept in 32 bits, whatever is allowed.
        points: or(given.most_points, usual.points).min(usual.points),
        faces: or(given.most_faces, usual.faces).min(usual.faces),
        line_bytes: size(given.most_line_bytes, usual.line_bytes),
        header_bytes: size(given.most_header_bytes, usual.header_bytes),
        list_items: size(given.most_list_items, usual.list_items),
        piped_bytes: or(given.most_piped_bytes, usual.piped_bytes),
        expanded_bytes: or(given.expanded_bytes, usual.expanded_bytes),
        unpacked_bytes: or(given.unpacked_bytes, usual.unpacked_bytes),
        expansion: or(given.expansion, usual.expansion),
        laz_expansion: or(given.laz_expansion, usual.laz_expansion),
    };
    let columns = match given.columns.is_null() {
        true => None,
        // SAFETY: as above.
        false => Some(unsafe { text(given.columns, "columns") }?.parse()?),
    };
    let options = LoadOptions { limits, allow_outside: given.allow_outside != vk::FALSE, columns };
    // SAFETY: as above.
    Ok((options, unsafe { Listener::new(given.listener) }?))
}
