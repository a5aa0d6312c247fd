//! Meshes cut into pieces that a buffer holds.

use super::Cut;
use crate::{
    error::Result,
    prepare::{MeshChunk, mesh_chunk::PackedMesh, mesh_levels::Cells},
    scene::{HybridLevels, MeshObject, Opacity},
};

impl Cut<'_, '_> {
    pub(super) fn mesh(
        &mut self,
        (object_number, object): (usize, &MeshObject),
        hybrid: Option<&HybridLevels>,
    ) -> Result<()> {
        let opacity = object.mesh.colors.opacity();
        if opacity == Opacity::Invisible {
            return Ok(());
        }
        let traits = (object.closed, opacity == Opacity::Transparent);
        let cells = hybrid.map(Cells::of);
        for packed in PackedMesh::pieces(&object.mesh, self.capacity).filter(|packed| !packed.is_empty()) {
            let number = self.prepared.meshes.len();
            let levels = cells.as_ref().map(|cells| cells.words(&packed.numbers, packed.rebase()));
            let mut chunk = MeshChunk::new(self.uploader.as_mut(), number, traits, (&packed, levels))?;
            chunk.object = object_number;
            chunk.numbers = self.numbered.then_some(packed.numbers);
            self.prepared.meshes.push(chunk);
        }
        Ok(())
    }
}
