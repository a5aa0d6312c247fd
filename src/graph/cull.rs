//! Compile stage 2: leaves out the passes whose results nobody reads.

use super::{
    declare::{Declared, Use},
    resource::{Origin, ResourceId},
};

/// What is left after culling.
#[derive(Debug)]
pub(super) struct Live {
    /// One a declared pass.
    pub(super) passes: Vec<bool>,
    /// One a resource: the versions that a live pass, or after the execution the caller, reads.
    read_versions: Vec<Vec<u32>>,
}

impl Live {
    /// Whether somebody reads this content of the resource.
    pub(super) fn is_read(&self, resource: ResourceId, version: u32) -> bool {
        self.read_versions[resource.index()].contains(&version)
    }
}

/// The caller reads the last content of every import. A pass is live if it has a side effect or writes a content
/// that is read; what a live pass needs is read in turn. One walk backwards suffices: contents are read only after
/// they are written.
pub(super) fn cull(graph: &Declared) -> Live {
    let imported_version = |resource: &super::declare::Resource| match resource.origin {
        Origin::Imported { .. } => vec![resource.version],
        Origin::Transient => Vec::new(),
    };
    let mut live = Live {
        passes: vec![false; graph.passes.len()],
        read_versions: graph.resources.iter().map(imported_version).collect(),
    };
    for (i, pass) in graph.passes.iter().enumerate().rev() {
        let is_result =
            |usage: &Use| usage.start.is_some() && live.is_read(usage.resource, usage.version + 1);
        if pass.side_effect || pass.uses.iter().any(is_result) {
            live.passes[i] = true;
            for usage in pass.uses.iter().filter(|usage| usage.needs_content()) {
                live.read_versions[usage.resource.index()].push(usage.version);
            }
        }
    }
    live
}
