//! One transparent layer, as its passes see it.

use crate::passes::{
    cull::lists::Lists, inputs::Inputs, pass::Pass, place::read, predicate::LayerPredicates,
};
use crate::{
    arena::Arena,
    graph::{Access, Buffer, Graph, Handle, Image, execute::Body},
    shaders::config::*,
    vk::Occlusion,
};

/// What the passes of one layer share.
pub(crate) struct Layer<'a, 'f> {
    /// The memory of the frame.
    pub arena: &'a Arena,
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
    pub lists: &'f Lists<'a>,
    pub predicates: Option<&'f LayerPredicates<'a>>,
    /// Another layer follows, and wants to know whether this one is empty.
    pub counted: bool,
}

impl<'a> Layer<'a, '_> {
    /// The name of one of its passes or images.
    pub fn name(&self, what: &str) -> &'a str {
        self.arena.text(format_args!("{what} of layer {}", self.number + 1))
    }

    /// A pass of it, which draws where the layer before is not empty.
    pub fn pass<'g>(
        &self,
        graph: &'g mut Graph<'a, Body<'a>>,
        what: &str,
        why: &'static str,
    ) -> Pass<'g, 'a> {
        let pass = Pass::new(graph, self.inputs.source, self.name(what), why);
        match self.predicates {
            Some(predicates) => predicates.predicate(pass),
            None => pass,
        }
    }

    /// Adds what fragments behind the layer before compare with, and the lists of its splats.
    pub fn read<'g>(&self, pass: Pass<'g, 'a>) -> Pass<'g, 'a> {
        self.lists.read(pass).read_if(read(BIND_READ_DEPTH), self.before, Access::SampledFragment)
    }

    /// The query that counts its pixels.
    pub fn query(&self) -> Option<(&'a Occlusion, u32)> {
        self.predicates.filter(|_| self.counted).map(|predicates| (predicates.queries, self.number))
    }
}
