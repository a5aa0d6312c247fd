//! The steps in which a picture becomes finer while pages arrive: sizes, each with the pages that a view needs for it.

use std::collections::BTreeSet;

use super::{choose::PageView, table::PageEntry};

/// A size on the screen, and what has to be there for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Rung {
    /// The largest size of what is drawn for others, in pixels.
    pub tau_px: f64,
    /// The pages of the file, in its order.
    pub pages: Vec<usize>,
}

/// So many bytes are a small step: it is not worth to draw something coarser before it.
const SMALL_STEP_BYTES: u64 = 8 << 20;

/// The rungs of several views that share memory.
#[derive(Clone, Debug, Default)]
pub struct Ladder {
    /// Of each view: from the finest for which memory suffices to the coarsest. Each is twice as coarse as the one before, or more.
    pub views: Vec<Vec<Rung>>,
    /// The memory that each page takes.
    bytes: Vec<u64>,
}

/// Where a ladder's views stand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Standing {
    /// Of each view the finest rung of which all pages are there, which it draws; `None` where there is none.
    pub drawn: Vec<Option<usize>>,
    /// The pages that are to be there for that, and for the rung that comes next.
    pub needed: Vec<usize>,
    /// Those of them that are missing, in the order in which they are to be read.
    pub missing: Vec<usize>,
}

impl Ladder {
    /// That of some views of those of these pages that are seen, of whose rungs any of one height take `most_bytes` of memory together at most, a page as many as `bytes` says. Where that does not suffice
    /// for what they ask for, all of them become coarser alike.
    pub fn new(
        views: &[PageView],
        (pages, is_seen): (&[PageEntry], impl Fn(usize) -> bool),
        most_bytes: u64,
        bytes: impl Fn(&PageEntry) -> u64,
    ) -> Self {
        let all: Vec<Vec<Rung>> = views.iter().map(|view| view.rungs(pages, &is_seen)).collect();
        let most = all.iter().map(Vec::len).max().unwrap_or(0);
        let mut views = vec![Vec::new(); all.len()];
        let bytes: Vec<u64> = pages.iter().map(bytes).collect();
        for height in 0..most {
            let at = |rungs: &'_ Vec<Rung>| rungs.get(height).or(rungs.last()).cloned();
            let rungs: Vec<Rung> = all.iter().filter_map(at).collect();
            let needed: u64 = union(pages.len(), rungs.iter()).iter().map(|i| bytes[*i]).sum();
            if needed <= most_bytes {
                views.iter_mut().zip(rungs).for_each(|(view, rung)| view.push(rung));
            }
        }
        Self { views, bytes }
    }

    /// What is drawn of the pages that are there, and what comes next: the next finer rung of each view, or the finest that lacks little. With what is drawn
    /// until then that takes twice the memory that the ladder was made for, and more only where views are at several heights.
    /// A rung of which a page is `broken` never comes.
    pub fn standing(&self, is_there: &[bool], broken: &BTreeSet<usize>) -> Standing {
        let lacking = |rung: &Rung| -> u64 {
            rung.pages.iter().filter(|page| !is_there[**page]).map(|page| self.bytes[*page]).sum()
        };
        let drawn = |rungs: &Vec<Rung>| rungs.iter().position(|rung| lacking(rung) == 0);
        let drawn: Vec<Option<usize>> = self.views.iter().map(drawn).collect();
        let next = |(rungs, drawn): (&Vec<Rung>, &Option<usize>)| {
            let finer = &rungs[..drawn.unwrap_or(rungs.len())];
            let comes = |rung: &Rung| !rung.pages.iter().any(|page| broken.contains(page));
            let is_small = |rung: &Rung| lacking(rung) <= SMALL_STEP_BYTES && comes(rung);
            finer.iter().position(is_small).or_else(|| finer.iter().rposition(comes))
        };
        // The coarsest first, of all views that are not as fine: what is of one height has room together.
        let height = self.views.iter().zip(&drawn).filter_map(next).max();
        let at = |height: usize| {
            let coarser = self
                .views
                .iter()
                .zip(&drawn)
                .filter(move |(_, drawn)| drawn.is_none_or(|drawn| height < drawn));
            coarser.filter_map(move |(rungs, _)| rungs.get(height))
        };
        let next: Vec<&Rung> = height.into_iter().flat_map(at).collect();
        let now = self.views.iter().zip(&drawn).filter_map(|(rungs, drawn)| rungs.get((*drawn)?));
        let needed = union(is_there.len(), next.iter().copied().chain(now));
        let missing = union(is_there.len(), next.into_iter());
        Standing { drawn, needed, missing: missing.into_iter().filter(|page| !is_there[*page]).collect() }
    }
}

/// All pages of some rungs, each once.
fn union<'r>(count: usize, rungs: impl Iterator<Item = &'r Rung>) -> Vec<usize> {
    let mut is_in = vec![false; count];
    rungs.flat_map(|rung| &rung.pages).for_each(|page| is_in[*page] = true);
    (0..count).filter(|page| is_in[*page]).collect()
}
