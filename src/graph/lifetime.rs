//! Compile stage 3: from when to when each resource is used, and for what.

use ash::vk;

use super::{
    declare::{Declared, Use},
    resource::ResourceDesc,
};

/// The first and the last pass that access a resource: indices into [`super::Plan::passes`], both included.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Lifetime {
    /// The first pass.
    pub first: usize,
    /// The last pass.
    pub last: usize,
}

impl Lifetime {
    /// Whether some pass belongs to both.
    pub fn overlaps(self, other: Self) -> bool {
        self.first <= other.last && other.first <= self.last
    }
}

/// The usage that a resource has to be created for: those of all its accesses, taken together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Usage {
    /// The usage of an image.
    Image(vk::ImageUsageFlags),
    /// The usage of a buffer.
    Buffer(vk::BufferUsageFlags),
}

/// The usage of every resource, and its lifetime where a pass that is left accesses it.
pub(super) fn lifetimes(graph: &Declared<'_>, order: &[usize]) -> Vec<(Usage, Option<Lifetime>)> {
    let unused = |desc| match desc {
        ResourceDesc::Image(_) => (Usage::Image(vk::ImageUsageFlags::empty()), None),
        ResourceDesc::Buffer(_) => (Usage::Buffer(vk::BufferUsageFlags::empty()), None),
    };
    let mut found: Vec<_> = graph.resources.iter().map(|resource| unused(resource.desc)).collect();
    for (position, &pass) in order.iter().enumerate() {
        for Use { resource, access, .. } in graph.passes[pass].uses {
            let (usage, lifetime) = &mut found[resource.index()];
            let info = access.info();
            match usage {
                Usage::Image(flags) => *flags |= info.image.map(|(_, flags)| flags).unwrap_or_default(),
                Usage::Buffer(flags) => *flags |= info.buffer.unwrap_or_default(),
            }
            lifetime.get_or_insert(Lifetime { first: position, last: position }).last = position;
        }
    }
    found
}
