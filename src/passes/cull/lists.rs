//! What the draws of a part read beside its splats: lists of those that are large and of those that may be seen.

use crate::passes::{
    cull::{
        hidden::list_unhidden,
        large::{LargeList, list_large},
        visible::{VisibleList, list_visible},
    },
    inputs::Inputs,
    pass::Pass,
};
use crate::{
    error::Result,
    graph::{Graph, Handle, Image, execute::Body},
};

/// What the draws of a part read.
pub(crate) struct Lists<'a> {
    large: &'a [LargeList],
    visible: Option<VisibleList>,
}

impl<'a> Lists<'a> {
    /// Declares the passes that make them. `kind`, in front of the names, tells those of several parts apart.
    pub fn make(graph: &mut Graph<'a, Body<'a>>, inputs: Inputs<'a>, kind: &str) -> Result<Self> {
        let large = list_large(graph, inputs, kind)?;
        let visible = inputs.listed.map(|listed| list_visible(graph, inputs, kind, listed)).transpose()?;
        Ok(Self { large, visible })
    }

    /// Declares the passes that leave out of the list what this depth hides, where that is wanted.
    pub fn without_hidden(
        self,
        graph: &mut Graph<'a, Body<'a>>,
        inputs: Inputs<'a>,
        depth: &Handle<Image>,
    ) -> Result<Self> {
        let visible = match self.visible {
            Some(visible) if inputs.culls_hidden => Some(list_unhidden(graph, inputs, visible, depth)?),
            visible => visible,
        };
        Ok(Self { visible, ..self })
    }

    /// Adds them to a pass that draws with them.
    pub fn read<'g>(&self, mut pass: Pass<'g, 'a>) -> Pass<'g, 'a> {
        if let Some(visible) = &self.visible {
            pass = visible.read(pass);
        }
        self.large.iter().fold(pass, |pass, list| list.read(pass))
    }
}
