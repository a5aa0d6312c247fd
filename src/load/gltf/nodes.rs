//! Where a scene's meshes are.

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};

use super::document::{Document, Node};
use crate::{error::Result, load::Input};

/// A mesh of a node.
pub(super) struct Placed {
    /// The mesh's number, which the file has.
    pub mesh: usize,
    pub world_from_mesh: DAffine3,
}

/// The meshes of the default scene, or of the first; where there is none, of all nodes that are no children.
pub(super) fn placed(input: &Input<'_>, document: &Document<'_>) -> Result<Vec<Placed>> {
    let nodes = &document.nodes;
    let roots: Vec<u32> = match (document.scene, document.scenes.first()) {
        (None, None) => {
            let mut is_child = vec![false; nodes.len()];
            for child in nodes.iter().flat_map(|node| node.children.iter()) {
                if let Some(is_child) = is_child.get_mut(*child as usize) {
                    *is_child = true;
                }
            }
            (0..).zip(&is_child).filter(|(_, is_child)| !**is_child).map(|(i, _)| i).collect()
        }
        (None, Some(first)) => first.nodes.to_vec(),
        (Some(scene), _) => match document.scenes.get(scene as usize) {
            Some(scene) => scene.nodes.to_vec(),
            None => {
                let problem = format!("not there; the file has {}", document.scenes.len());
                return Err(input.fault(format!("scene {scene}"), problem));
            }
        },
    };
    let mut placed = Vec::new();
    let mut is_seen = vec![false; nodes.len()];
    // The last is next, so that nodes come in the file's order.
    let mut open: Vec<(u32, DAffine3)> = roots.into_iter().rev().map(|i| (i, DAffine3::IDENTITY)).collect();
    while let Some((i, world_from_parent)) = open.pop() {
        let fault = |problem: String| input.fault(format!("node {i}"), problem);
        let Some((node, is_seen)) = nodes.get(i as usize).zip(is_seen.get_mut(i as usize)) else {
            return Err(fault(format!("not there; the file has {}", nodes.len())));
        };
        if std::mem::replace(is_seen, true) {
            return Err(fault("within itself or in two places; expected a tree".to_owned()));
        }
        let world_from_node = world_from_parent * local(node);
        if let Some(mesh) = node.mesh {
            if mesh as usize >= document.meshes.len() {
                return Err(fault(format!("of mesh {mesh}; the file has {}", document.meshes.len())));
            }
            placed.push(Placed { mesh: mesh as usize, world_from_mesh: world_from_node });
        }
        open.extend(node.children.iter().rev().map(|child| (*child, world_from_node)));
    }
    Ok(placed)
}

/// A node's own matrix, or its scale, then its rotation, then its translation.
fn local(node: &Node) -> DAffine3 {
    if let Some(matrix) = &node.matrix {
        return DAffine3::from_mat4(DMat4::from_cols_array(matrix));
    }
    let scale = node.scale.as_deref().map_or(DVec3::ONE, |scale| DVec3::from_array(*scale));
    let rotation = node.rotation.as_deref().map_or(DQuat::IDENTITY, |rotation| DQuat::from_array(*rotation));
    let translation = node.translation.as_deref().map_or(DVec3::ZERO, |place| DVec3::from_array(*place));
    // The format wants unit quaternions; written with few digits, they are not quite.
    let rotation = if rotation.length_squared() > 0.0 { rotation.normalize() } else { DQuat::IDENTITY };
    let linear = DMat3::from_quat(rotation) * DMat3::from_diagonal(scale);
    DAffine3::from_mat3_translation(linear, translation)
}
