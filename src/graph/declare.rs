//! The graph as its passes declare it: plain data and one opaque body a pass.

use std::{
    fmt::Display,
    marker::PhantomData,
    sync::atomic::{AtomicU64, Ordering},
};

use super::{
    access::Access,
    resource::{
        Buffer, BufferDesc, BufferState, ClearValue, Handle, Image, ImageDesc, ImageState, Origin,
        ResourceDesc, ResourceId,
    },
};
use crate::arena::{Arena, ArenaVec};

/// Uses that most passes have room for: a list that grows is copied.
const MOST_USES: usize = 16;

/// A frame in the making, which lies in a frame's memory. `Body` is what a pass records; the graph carries it and never looks inside.
#[derive(Debug)]
pub struct Graph<'a, Body> {
    pub(super) declared: Declared<'a>,
    /// One a pass.
    pub(super) bodies: ArenaVec<'a, Body>,
    arena: &'a Arena,
}

/// All of a graph but the bodies: what the compile stages work on.
#[derive(Debug)]
pub(super) struct Declared<'a> {
    id: u64,
    pub(super) resources: ArenaVec<'a, Resource<'a>>,
    pub(super) passes: ArenaVec<'a, Pass<'a>>,
}

#[derive(Debug)]
pub(super) struct Resource<'a> {
    pub(super) name: &'a str,
    pub(super) desc: ResourceDesc,
    pub(super) origin: Origin,
    /// The writes that finished passes have declared.
    pub(super) version: u32,
}

#[derive(Debug)]
pub(super) struct Pass<'a> {
    pub(super) name: &'a str,
    pub(super) why: &'static str,
    pub(super) role: Role,
    pub(super) uses: &'a [Use],
    pub(super) side_effect: bool,
    /// The first handle that is another graph's.
    pub(super) foreign: Option<ResourceId>,
}

/// What a pass does, as far as measurements have to know it and no [`Access`] tells it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Role {
    /// Nothing of what follows.
    #[default]
    Other,
    /// Its fragments are blended with what is in the color attachments.
    Blends,
    /// It draws all that is in the lists which it reads, each thing once.
    DrawsAll,
}

/// One resource in one pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Use {
    /// The resource.
    pub resource: ResourceId,
    /// The content it finds: how many writes were declared before. A write leaves `version + 1`.
    pub version: u32,
    /// How it is accessed.
    pub access: Access,
    /// How a write begins; `None` for a read.
    pub start: Option<Start>,
}

/// What a write does with the content that it finds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    /// An attachment is cleared first.
    Clear(ClearValue),
    /// What isn't overwritten stays, so that the pass depends on what was written before.
    Load,
    /// Nothing of it is needed: whatever is read later, the pass writes itself.
    Discard,
}

impl Use {
    /// Whether the pass needs the content that it finds.
    pub fn needs_content(&self) -> bool {
        matches!(self.start, None | Some(Start::Load))
    }
}

impl<'a, Body> Graph<'a, Body> {
    /// A graph without resources and passes.
    pub fn new(arena: &'a Arena) -> Self {
        // Tells the handles of one graph from those of another.
        static NEXT_ID: AtomicU64 = AtomicU64::new(0);
        let id = NEXT_ID.fetch_add(1, Ordering::Relaxed);
        let declared = Declared { id, resources: arena.growing(), passes: arena.growing() };
        Self { declared, bodies: arena.growing(), arena }
    }

    /// Where it lies.
    pub fn arena(&self) -> &'a Arena {
        self.arena
    }

    /// An image that lives inside one execution. Names are unique in a graph, here and below.
    pub fn create_image(&mut self, name: impl Display, desc: ImageDesc) -> Handle<Image> {
        self.declared.add(self.arena.text(name), ResourceDesc::Image(desc), Origin::Transient)
    }

    /// A buffer that lives inside one execution.
    pub fn create_buffer(&mut self, name: impl Display, desc: BufferDesc) -> Handle<Buffer> {
        self.declared.add(self.arena.text(name), ResourceDesc::Buffer(desc), Origin::Transient)
    }

    /// An image of the caller's. No two imports may be the same image.
    pub fn import_image(
        &mut self,
        name: impl Display,
        desc: ImageDesc,
        initial: ImageState,
        final_: Option<ImageState>,
    ) -> Handle<Image> {
        let origin = Origin::Imported { initial: initial.into(), final_: final_.map(Into::into) };
        self.declared.add(self.arena.text(name), ResourceDesc::Image(desc), origin)
    }

    /// A buffer of the caller's. No two imports may share memory. A read by the host is a `final_` state.
    pub fn import_buffer(
        &mut self,
        name: impl Display,
        desc: BufferDesc,
        initial: BufferState,
        final_: Option<BufferState>,
    ) -> Handle<Buffer> {
        let origin = Origin::Imported { initial: initial.into(), final_: final_.map(Into::into) };
        self.declared.add(self.arena.text(name), ResourceDesc::Buffer(desc), origin)
    }

    /// What is in a buffer after all passes declared so far, by its name, for tools that look into frames which others declared.
    pub fn content_of(&self, name: &str) -> Option<(Handle<Buffer>, BufferDesc)> {
        let place = self.declared.resources.iter().position(|resource| resource.name == name)?;
        let resource = &self.declared.resources[place];
        let ResourceDesc::Buffer(desc) = resource.desc else { return None };
        let (graph, id) = (self.declared.id, ResourceId(place as u32));
        Some((Handle { graph, id, version: resource.version, kind: PhantomData }, desc))
    }

    /// Begins a pass, which [`PassBuilder::finish`] ends. Its name is also its debug label and the key of its time.
    pub fn pass(&mut self, name: impl Display) -> PassBuilder<'_, 'a, Body> {
        let pass = Pass {
            name: self.arena.text(name),
            why: "",
            role: Role::Other,
            uses: &[],
            side_effect: false,
            foreign: None,
        };
        let mut uses = self.arena.growing();
        uses.reserve(MOST_USES);
        PassBuilder { uses, graph: self, pass }
    }
}

impl<'a> Declared<'a> {
    fn add<Kind>(&mut self, name: &'a str, desc: ResourceDesc, origin: Origin) -> Handle<Kind> {
        // More than 2^32 resources don't fit into memory.
        let id = ResourceId(self.resources.len() as u32);
        self.resources.push(Resource { name, desc, origin, version: 0 });
        Handle { graph: self.id, id, version: 0, kind: PhantomData }
    }

    pub(super) fn resource(&self, id: ResourceId) -> &Resource<'a> {
        &self.resources[id.index()]
    }
}

/// A pass in the making. It is not in the graph before [`PassBuilder::finish`]. Mistakes are told by
/// [`Graph::compile`].
#[derive(Debug)]
#[must_use = "a pass is declared by `finish`"]
pub struct PassBuilder<'g, 'a, Body> {
    graph: &'g mut Graph<'a, Body>,
    pass: Pass<'a>,
    uses: ArenaVec<'a, Use>,
}

impl<'a, Body> PassBuilder<'_, 'a, Body> {
    /// Reads a resource. Several reads of one image must agree on its layout.
    pub fn read<Kind>(mut self, handle: &Handle<Kind>, access: Access) -> Self {
        self.reads(handle, access);
        self
    }

    /// Writes a resource: what is in it from now on is this pass's work.
    pub fn write<Kind>(mut self, handle: &mut Handle<Kind>, access: Access, start: Start) -> Self {
        self.writes(handle, access, start);
        self
    }

    /// Says why the frame has the pass, for whoever explains it.
    pub fn why(mut self, why: &'static str) -> Self {
        self.pass.why = why;
        self
    }

    /// Says what it does, for whoever measures it.
    pub fn role(mut self, role: Role) -> Self {
        self.does(role);
        self
    }

    /// Its name.
    pub fn name(&self) -> &str {
        self.pass.name
    }

    /// Where the graph lies.
    pub fn arena(&self) -> &'a Arena {
        self.graph.arena
    }

    /// Keeps the pass even if nobody reads what it writes.
    pub fn side_effect(mut self) -> Self {
        self.has_side_effect();
        self
    }

    /// Puts the pass into the graph.
    pub fn finish(mut self, body: Body) {
        self.end(body);
    }

    /// The same of one that stays where it is.
    pub(crate) fn end(&mut self, body: Body) {
        let Self { graph, pass, uses } = self;
        for usage in &*uses {
            if usage.start.is_some() {
                graph.declared.resources[usage.resource.index()].version += 1;
            }
        }
        let uses = std::mem::replace(uses, graph.arena.growing()).into_bump_slice();
        let Pass { name, why, role, side_effect, foreign, .. } = *pass;
        graph.declared.passes.push(Pass { name, why, role, uses, side_effect, foreign });
        graph.bodies.push(body);
    }

    /// As [`Self::read`], of one that stays where it is; the others alike.
    pub(crate) fn reads<Kind>(&mut self, handle: &Handle<Kind>, access: Access) {
        self.declare(handle, access, None);
    }

    pub(crate) fn writes<Kind>(&mut self, handle: &mut Handle<Kind>, access: Access, start: Start) {
        self.declare(handle, access, Some(start));
        handle.version += 1;
    }

    pub(crate) fn does(&mut self, role: Role) {
        self.pass.role = role;
    }

    pub(crate) fn has_side_effect(&mut self) {
        self.pass.side_effect = true;
    }

    fn declare<Kind>(&mut self, handle: &Handle<Kind>, access: Access, start: Option<Start>) {
        if handle.graph == self.graph.declared.id {
            self.uses.push(Use { resource: handle.id, version: handle.version, access, start });
        } else {
            self.pass.foreign.get_or_insert(handle.id);
        }
    }
}
