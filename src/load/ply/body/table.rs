//! Values of some elements, as columns.

use glam::DVec3;

/// The values of up to [`Table::ROWS`] elements, one after the other, a column for each wanted property.
#[derive(Debug, Default)]
pub(in crate::load::ply) struct Table {
    columns: Vec<Vec<f64>>,
}

impl Table {
    /// So many that a column stays in the nearest cache.
    pub(super) const ROWS: usize = 1024;

    pub(super) fn new(columns: usize) -> Self {
        Self { columns: vec![Vec::new(); columns] }
    }

    pub(super) fn clear(&mut self) {
        self.columns.iter_mut().for_each(Vec::clear);
    }

    pub(super) fn columns_mut(&mut self) -> &mut [Vec<f64>] {
        &mut self.columns
    }

    /// The values of the wanted property of this number; none where it is not wanted.
    pub(in crate::load::ply) fn column(&self, column: usize) -> &[f64] {
        self.columns.get(column).map_or(&[], Vec::as_slice)
    }

    /// Three columns as vectors.
    pub(in crate::load::ply) fn vectors(
        &self,
        [x, y, z]: [usize; 3],
    ) -> impl ExactSizeIterator<Item = DVec3> {
        let yz = self.column(y).iter().zip(self.column(z));
        self.column(x).iter().zip(yz).map(|(&x, (&y, &z))| DVec3::new(x, y, z))
    }
}
