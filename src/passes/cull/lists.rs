//! What the draws of a part read beside its splats: lists of those that are large and of those that may be seen.

use crate::passes::{
    cull::{
        hidden::list_seen,
        large::{LargeIds, LargeList, list_large},
        visible::{Kept, KeptIds, list_kept},
    },
    inputs::Inputs,
};
use crate::{
    error::Result,
    graph::{
        Graph, Handle, Image, PassBuilder,
        execute::{Body, PassContext},
    },
    shaders::config::*,
    vk::Descriptor,
};

/// What the draws of a part read.
pub(crate) struct Lists {
    large: Vec<Option<LargeList>>,
    kept: Option<Kept>,
}

/// The same for passes that are recorded.
#[derive(Clone)]
pub(crate) struct ListIds {
    large: Vec<Option<LargeIds>>,
    pub kept: Option<KeptIds>,
}

impl Lists {
    /// Declares the passes that make them. `kind`, in front of the names, tells those of several parts apart.
    pub fn make<'a>(graph: &mut Graph<Body<'a>>, inputs: Inputs<'a>, kind: &str) -> Result<Self> {
        let large = list_large(graph, inputs, kind)?;
        let kept = inputs.kept.map(|listed| list_kept(graph, inputs, kind, listed)).transpose()?;
        Ok(Self { large, kept })
    }

    /// Declares the passes that leave out of the list what this depth hides, where that is wanted.
    pub fn without_hidden<'a>(
        self,
        graph: &mut Graph<Body<'a>>,
        inputs: Inputs<'a>,
        depth: &Handle<Image>,
    ) -> Result<Self> {
        let kept = match self.kept {
            Some(kept) if inputs.leaves_hidden_out => Some(list_seen(graph, inputs, kept, depth)?),
            kept => kept,
        };
        Ok(Self { kept, ..self })
    }

    /// Declares that a pass draws with them.
    pub fn read<'g, B>(&self, mut pass: PassBuilder<'g, B>) -> PassBuilder<'g, B> {
        if let Some(kept) = &self.kept {
            pass = kept.read_by_points(pass);
        }
        for list in self.large.iter().flatten() {
            pass = list.read_by_draws(pass);
        }
        pass
    }

    /// For the body of the pass.
    pub fn ids(&self) -> ListIds {
        ListIds {
            large: self.large.iter().map(|list| list.as_ref().map(LargeList::ids)).collect(),
            kept: self.kept.as_ref().map(Kept::ids),
        }
    }
}

impl ListIds {
    /// The large splats of a chunk, where it may have any.
    pub fn large(&self, chunk: usize) -> Option<&LargeIds> {
        self.large[chunk].as_ref()
    }

    /// What set 1 of the draws of a chunk holds; nothing where they read nothing.
    pub fn descriptors(&self, context: &PassContext<'_>, chunk: usize) -> Result<Vec<(u32, Descriptor)>> {
        let mut given = Vec::new();
        if let Some(large) = self.large(chunk) {
            given.push((BIND_LIST_BITS, context.descriptor(large.bits)?));
            given.push((BIND_LIST_ITEMS, context.descriptor(large.list)?));
        }
        Ok(given)
    }
}
