//! Rows of a binary body that have the same number of bytes each.

use super::{Table, binary};
use crate::load::ply::schema::{Element, Encoding};

/// How the rows of an element are read.
pub(in crate::load::ply) struct FixedRows {
    stride: usize,
    places: Vec<binary::Wanted>,
    encoding: Encoding,
}

impl FixedRows {
    /// Those of an element without lists, for these of its properties.
    pub(in crate::load::ply) fn new(def: &Element, wanted: &[usize], encoding: Encoding) -> Self {
        let (stride, places) = binary::places(def, wanted);
        Self { stride, places, encoding }
    }

    /// Bytes of a row.
    pub(in crate::load::ply) fn stride(&self) -> usize {
        self.stride
    }

    /// Gives the values of all rows in these bytes, of some after the other.
    pub(in crate::load::ply) fn tables(&self, rows: &[u8], take: &mut dyn FnMut(&Table)) {
        let mut table = Table::new(self.places.len());
        for rows in rows.chunks(Table::ROWS * self.stride.max(1)) {
            binary::columns(rows, self.stride, &self.places, self.encoding, &mut table);
            take(&table);
        }
    }
}
