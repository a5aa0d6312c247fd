//! Levels of detail of a mesh: where its splats would be large it is drawn as polygons, elsewhere as splats, each cell of it by its size on the screen
//! (Guennebaud, Barthe, Paulin 2006, section 5.2). `geometry::multiresolution` makes them.

use std::ops::Range;

use super::LeveledObject;

/// A hierarchy of splats above the cells of a mesh.
///
/// A cell has a ball as nodes have: it is drawn as polygons where that is larger on the screen than τ; else its own splats take their place,
/// or a node that stands for these. So of a cell, and of the nodes above, exactly one is drawn; and below splats polygons where polygons are near. Frames without levels of detail draw the mesh.
#[derive(Clone, Debug)]
pub struct HybridLevels {
    /// The place of the mesh in [`super::Scene::meshes`]. It is opaque, and its triangles lie cell by cell.
    pub mesh: usize,
    /// Its splats, which are the hierarchy's leaves, and the nodes above. A leaf is drawn if its parent is larger than τ and one of
    /// [`Self::cells_of_leaf`] is not.
    pub splats: LeveledObject,
    /// Where the cells of each leaf end in [`Self::leaf_cells`].
    pub leaf_cell_ends: Vec<u32>,
    /// The cells that a leaf is drawn for: the one that it lies in; of those on an edge between cells, these.
    pub leaf_cells: Vec<u32>,
    /// All cells of the mesh.
    pub cells: Vec<PolygonCell>,
}

/// Triangles that are drawn, or not, together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PolygonCell {
    /// In the mesh.
    pub triangles: Range<u32>,
    /// The number of its ball in [`LeveledObject::balls`].
    pub ball: u32,
    /// The cells that it meets at an edge or a corner. Where one of them is drawn as polygons, its own polygons are drawn, too, below its splats,
    /// whose sum falls toward that one.
    pub neighbors: Vec<u32>,
}

impl HybridLevels {
    /// The cells that leaf `i` is drawn for.
    pub fn cells_of_leaf(&self, i: usize) -> &[u32] {
        let begin = i.checked_sub(1).map_or(0, |before| self.leaf_cell_ends[before]);
        &self.leaf_cells[begin as usize..self.leaf_cell_ends[i] as usize]
    }

    /// The ball of a cell.
    pub fn ball_of_cell(&self, cell: u32) -> u32 {
        self.cells[cell as usize].ball
    }
}
