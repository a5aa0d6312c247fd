//! glTF and GLB: triangles or points of the default scene, with base colors and vertex colors, which are linear.
//! Pictures, animations, skins and shapes to morph to are not read; a note says so.

mod accessor;
mod buffers;
mod check;
mod container;
mod document;
mod nodes;
mod primitive;
mod surface;
#[cfg(test)]
mod tests;

use glam::DVec3;

use super::{Input, Loaded, json};
use crate::{error::Result, notes::Deed};
use buffers::Buffers;
use document::Document;
use surface::Surface;

/// Extensions that a file may need although they are not read: they change how surfaces look or how numbers are kept.
const HARMLESS: [&str; 4] =
    ["KHR_mesh_quantization", "KHR_texture_transform", "KHR_lights_punctual", "KHR_texture_basisu"];

pub(super) fn parse(input: &Input<'_>) -> Result<Loaded> {
    let parts = container::split(input)?;
    let document: Document<'_> =
        serde_json::from_slice(parts.json).map_err(|e| input.fault("JSON", json::problem(&e)))?;
    if !document.asset.version.starts_with("2.") {
        let version: String = document.asset.version.chars().take(40).collect();
        return Err(input.fault("asset", format!("version '{}'; expected 2.0", version.escape_debug())));
    }
    let is_harmless = |name: &str| HARMLESS.contains(&name) || name.starts_with("KHR_materials_");
    if let Some(name) = document.extensions_required.iter().find(|name| !is_harmless(name)) {
        let name: String = name.chars().take(40).collect();
        let problem = format!("needs the extension '{}'; expected a file without it", name.escape_debug());
        return Err(input.fault("", problem));
    }
    let placed = nodes::placed(input, &document)?;
    let mut buffers = Buffers::new(input, &document, parts.binary);
    check::check(input, &document, &mut buffers, &placed)?;
    let mut surface = Surface::new(input, &document, buffers);
    for mesh in &placed {
        surface.add(mesh)?;
    }
    input.step(input.bytes.len());
    let mut loaded = surface.loaded(parts.format);
    loaded.up = Some(DVec3::Y);
    loaded.metres_per_unit = Some(1.0);
    let has_texture = |material: &&document::Material<'_>| {
        material.pbr_metallic_roughness.as_ref().is_some_and(|pbr| pbr.base_color_texture.is_some())
    };
    let textures = document.materials.iter().filter(has_texture).count() as u64;
    let skins = document.nodes.iter().filter(|node| node.skin.is_some()).count() as u64;
    let primitives = document.meshes.iter().flat_map(|mesh| mesh.primitives.iter());
    let targets = primitives.filter(|primitive| !primitive.targets.is_empty()).count() as u64;
    loaded.note(Deed::Ignored, textures, "materials' textures, which are not supported,");
    loaded.note(Deed::Ignored, document.animations.len() as u64, "animations");
    loaded.note(Deed::Ignored, skins, "skins of nodes");
    loaded.note(Deed::Ignored, targets, "primitives' shapes to morph to");
    loaded.note(
        Deed::Ignored,
        document.scenes.len().saturating_sub(1) as u64,
        "scenes beside the default one",
    );
    Ok(loaded)
}
