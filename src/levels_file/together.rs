//! Several files that one view reads, within one memory.

use std::io::{Read, Seek};

use super::{
    choose::{Choice, PageView},
    read::{Chosen, LevelsFile},
};
use crate::{error::Result, progress::Progress, scene::Opacity};

/// Reads what a view needs of several files, for which at most so many bytes of memory are taken together: where they do not suffice, all of them are
/// drawn coarser than was asked for, alike. Each file gets as much as it has in the view. Of what is invisible nothing is read.
///
/// # Errors
/// As [`LevelsFile::load`].
pub fn load_together<R: Read + Seek>(
    files: &mut [LevelsFile<R>],
    view: &PageView,
    most_bytes: u64,
    progress: &dyn Progress,
) -> Result<Vec<Chosen>> {
    let is_seen = |(_, file): &(usize, &LevelsFile<R>)| file.header().opacity() != Opacity::Invisible;
    let seen = || files.iter().enumerate().filter(is_seen);
    let places: Vec<[usize; 2]> =
        seen().flat_map(|(number, file)| (0..file.pages().len()).map(move |page| [number, page])).collect();
    let pages: Vec<_> = seen().flat_map(|(_, file)| file.pages()).collect();
    let Choice { pages, tau_px, wanted_bytes } = view.choose(&pages, most_bytes)?;
    let mut of_files = vec![Vec::new(); files.len()];
    for chosen in pages {
        let [number, page] = places[chosen];
        of_files[number].push(page);
    }
    let chosen = files.iter_mut().zip(of_files);
    chosen.map(|(file, pages)| file.chosen(Choice { pages, tau_px, wanted_bytes }, progress)).collect()
}
