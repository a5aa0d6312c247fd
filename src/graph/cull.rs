//! Compile stage 2: leaves out the passes whose results nobody reads, and orders the others.

use std::collections::HashSet;

use super::{
    declare::{Declared, Use},
    resource::{Origin, ResourceId},
};

/// The passes that are left.
#[derive(Debug)]
pub(super) struct Live {
    /// The declared passes that are executed, by index, in the order of execution.
    ///
    /// That is declaration order: a pass can only name contents that earlier passes made (see `validate`), so that it
    /// is a topological order already, and the stable one, where ties are broken by declaration.
    pub(super) order: Vec<usize>,
    /// The contents that a live pass reads, or the caller after the execution: resource and version.
    read: HashSet<(ResourceId, u32)>,
}

impl Live {
    /// Whether somebody reads the content that a write leaves.
    pub(super) fn is_read(&self, write: &Use) -> bool {
        self.read.contains(&(write.resource, write.version + 1))
    }
}

/// The caller reads the last content of every import. A pass is live if it has a side effect or writes a content
/// that is read; what a live pass needs is read in turn. One walk backwards suffices: contents are read only after
/// they are written.
pub(super) fn cull(graph: &Declared<'_>) -> Live {
    let resources = (0..).map(ResourceId).zip(&graph.resources);
    let imports = resources.filter(|(_, resource)| resource.origin != Origin::Transient);
    let read = imports.map(|(id, resource)| (id, resource.version)).collect();
    let mut live = Live { order: Vec::new(), read };
    for (i, pass) in graph.passes.iter().enumerate().rev() {
        let is_result = |usage: &Use| usage.start.is_some() && live.is_read(usage);
        if pass.side_effect || pass.uses.iter().any(is_result) {
            live.order.push(i);
            let needed = pass.uses.iter().filter(|usage| usage.needs_content());
            live.read.extend(needed.map(|usage| (usage.resource, usage.version)));
        }
    }
    live.order.reverse();
    live
}
