//! What the draws of a part read beside its splats: lists of those that are large and of those that may be seen.

use crate::passes::{
    cull::{
        hidden::list_unhidden,
        large::{LargeIds, LargeList, list_large},
        visible::{VisibleIds, VisibleList, list_visible},
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
    visible: Option<VisibleList>,
}

/// What bodies of passes need of it.
#[derive(Clone)]
pub(crate) struct ListIds {
    large: Vec<Option<LargeIds>>,
    pub visible: Option<VisibleIds>,
}

impl Lists {
    /// Declares the passes that make them. `kind`, in front of the names, tells those of several parts apart.
    pub fn make<'a>(graph: &mut Graph<Body<'a>>, inputs: Inputs<'a>, kind: &str) -> Result<Self> {
        let large = list_large(graph, inputs, kind)?;
        let visible = inputs.listed.map(|listed| list_visible(graph, inputs, kind, listed)).transpose()?;
        Ok(Self { large, visible })
    }

    /// Declares the passes that leave out of the list what this depth hides, where that is wanted.
    pub fn without_hidden<'a>(
        self,
        graph: &mut Graph<Body<'a>>,
        inputs: Inputs<'a>,
        depth: &Handle<Image>,
    ) -> Result<Self> {
        let visible = match self.visible {
            Some(visible) if inputs.culls_hidden => Some(list_unhidden(graph, inputs, visible, depth)?),
            visible => visible,
        };
        Ok(Self { visible, ..self })
    }

    /// Declares that a pass draws with them.
    pub fn read<'g, B>(&self, mut pass: PassBuilder<'g, B>) -> PassBuilder<'g, B> {
        if let Some(visible) = &self.visible {
            pass = visible.read_by_points(pass);
        }
        self.large.iter().flatten().fold(pass, |pass, list| list.read_by_draws(pass))
    }

    /// For the body of the pass.
    pub fn ids(&self) -> ListIds {
        ListIds {
            large: self.large.iter().map(|list| list.as_ref().map(LargeList::ids)).collect(),
            visible: self.visible.as_ref().map(VisibleList::ids),
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
        let Some(large) = self.large(chunk) else { return Ok(Vec::new()) };
        Ok(vec![
            (BIND_LIST_BITS, context.descriptor(large.bits)?),
            (BIND_LIST_ITEMS, context.descriptor(large.list)?),
        ])
    }
}
