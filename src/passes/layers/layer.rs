//! One transparent layer, as its passes see it.

use crate::passes::{
    cull::{
        gate::{Gate, Gates},
        lists::{ListIds, Lists},
    },
    inputs::Inputs,
};
use crate::{
    graph::{Buffer, Handle, Image, PassBuilder},
    vk::Occlusion,
};

/// What the passes of one layer share.
pub(crate) struct Layer<'a, 'f> {
    /// The transparent part.
    pub inputs: Inputs<'a>,
    /// From 0 on.
    pub number: u32,
    /// The depth of the layer before; none for the first.
    pub before: Option<&'f Handle<Image>>,
    /// The depth of opaque things, where there are any.
    pub opaque: Option<&'f Handle<Image>>,
    /// The kernel, where it is a texture.
    pub kernel: Option<&'f Handle<Image>>,
    /// Those of the scene's own.
    pub lights: Option<&'f Handle<Buffer>>,
    pub lists: &'f Lists,
    pub gates: Option<&'f Gates<'a>>,
    /// Another layer follows, and wants to know whether this one is empty.
    pub counted: bool,
}

impl<'a> Layer<'a, '_> {
    /// The name of one of its passes or images.
    pub fn name(&self, what: &str) -> String {
        format!("{what} of layer {}", self.number + 1)
    }

    /// Declares that a pass draws its splats and polygons.
    pub fn read<'g, B>(&self, pass: PassBuilder<'g, B>) -> PassBuilder<'g, B> {
        let pass = match self.before {
            Some(before) => pass.read(before, crate::graph::Access::SampledFragment),
            None => pass,
        };
        self.read_gate(self.lists.read(pass))
    }

    /// Declares that a pass draws something where the layer before is not empty.
    pub fn read_gate<'g, B>(&self, pass: PassBuilder<'g, B>) -> PassBuilder<'g, B> {
        match self.gates {
            Some(gates) => gates.read(pass),
            None => pass,
        }
    }

    /// What its draws depend on.
    pub fn gate(&self) -> Option<Gate> {
        self.gates.and_then(Gates::gate)
    }

    /// What its draws read beside splats.
    pub fn list_ids(&self) -> ListIds {
        self.lists.ids()
    }

    /// The query that counts its pixels.
    pub fn query(&self) -> Option<(&'a Occlusion, u32)> {
        self.gates.filter(|_| self.counted).map(|gates| (gates.queries(), self.number))
    }
}
