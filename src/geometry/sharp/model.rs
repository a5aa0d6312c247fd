//! A simplified mesh and the pieces of its ridges.

use std::collections::HashMap;

use glam::DVec3;

use super::{collapse::Piece, conic::Conic, edges::EdgeIndex, tint::Tint};

pub(super) struct Model<'a> {
    pub positions: &'a [DVec3],
    pub triangles: &'a [[u32; 3]],
    /// Unit, of the triangles.
    pub normals: Vec<DVec3>,
    /// Of the triangles, where the mesh has colors.
    pub tints: Option<&'a [Tint]>,
    pub edges: EdgeIndex,
    pub pieces: &'a [Piece],
    /// The vertices of the input's ridges.
    pub chains: &'a [Vec<u32>],
    pub between: HashMap<(u32, u32), usize>,
}

impl Model<'_> {
    /// The piece of a ridge between two vertices.
    pub fn piece(&self, a: u32, b: u32) -> Option<&Piece> {
        self.between.get(&(a.min(b), a.max(b))).map(|i| &self.pieces[*i])
    }

    /// Whether the color steps from a triangle to another one.
    pub fn steps(&self, from: usize, to: usize) -> bool {
        self.tints.is_some_and(|tints| tints[from].steps_to(&tints[to]))
    }
}

/// A piece as it goes from one of its ends: its curve, and the corners of the ridge that it stands for.
pub(super) fn directed(piece: &Piece, model: &Model<'_>, from: u32) -> (Conic, Vec<DVec3>) {
    let [first, last] = piece.places.map(|place| place as usize);
    let vertices = &model.chains[piece.chain as usize][first..=last];
    let mut line: Vec<DVec3> = vertices.iter().map(|vertex| model.positions[*vertex as usize]).collect();
    if piece.ends[0] == from {
        return (piece.fitted.conic, line);
    }
    line.reverse();
    (piece.fitted.conic.reversed(), line)
}
