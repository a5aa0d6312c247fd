//! Levels of detail in a file of their own (`.surfel`), of which a view reads what it needs: for what is larger than memory.
//!
//! `docs/format.md` describes the file. Its splats lie in pages, each of which is small, holds neighbors of about one size, and tells each
//! splat's own ball and its parent's: so any of them decides alone whether it is drawn, no page refers to another, and there is nothing in the
//! file that could go in a circle. A table tells where each page is and what bounds it.
//!
//! * **Writing** ([`write_object`], [`convert_splats`]): in memory, or part by part where that is too small.
//! * **Reading** ([`LevelsFile`]): the table whole, then the pages that a [`PageView`] needs, by reads of whole pages at their places. Nothing
//!   is mapped, and no memory is taken that the file's own size does not account for.
//! * **Paging** ([`Pager`], [`Ladder`]): the same by a thread in the background, coarser pages first.

mod bytes;
mod choose;
mod external;
mod header;
mod ladder;
mod object;
mod page;
mod page_bounds;
mod pager;
mod part;
mod placed;
mod read;
mod table;
#[cfg(test)]
mod tests;
mod together;
mod write;
mod write_object;

pub use choose::PageView;
pub use external::{LEAST_MEMORY, convert_splats, fits};
pub use header::Header;
pub use ladder::{Ladder, Rung, Standing};
pub use pager::{Arrived, PagedFile, Pager};
pub use placed::Placed;
pub use read::{Chosen, LevelsFile, is_levels_file};
pub use table::{HOST_BYTES, PageEntry, Reach};
pub use together::load_together;
pub use write_object::{Facts, Written, write_object};

/// The most splats of a page: the number of a ball in it has 16 bits.
pub const MOST_PAGE_SPLATS: usize = 1 << 16;

/// The version of the format that is written, and the only one that is read.
pub const VERSION: u32 = 2;
