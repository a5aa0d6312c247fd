//! A pass in the making: each resource is named once, with its access and where the pass finds it; so are its pipelines, and why the
//! frame has it.

use std::{
    cell::{Cell, RefCell},
    fmt::Display,
    mem::ManuallyDrop,
};

use crate::passes::pipeline::{
    cache::{MissingPipelines, Shaders},
    key::{ComputeKey, GraphicsKey, Layout},
    last_sets::LastSets,
    recipe::{Key, PipelineRecipe},
    variant::Constants,
};
use crate::passes::{
    place::{At, Planes, Tints},
    recording::{Pipeline, Recording},
};
use crate::{
    arena::{Arena, ArenaVec},
    error::Result,
    graph::{
        Access, Graph, Handle, PassBuilder, ResourceId, Role, Start,
        execute::{Body, PassContext},
    },
    scene::Camera,
    shaders::config::{SPEC_ORTHOGRAPHIC, SPEC_PLANES, SPEC_TINTED},
    vk::DescriptorPool,
};

/// What passes take pipelines and descriptor sets from.
#[derive(Clone, Copy)]
pub struct Source<'a> {
    /// Where from.
    pub place: Place<'a>,
    /// The camera's rays are parallel, in all of them.
    pub is_orthographic: bool,
    /// The planes that cut what is seen.
    pub planes: Planes,
    /// The tints of all chunks, where some has one.
    pub tints: Option<Tints>,
    /// What is done where a pipeline is not there yet.
    pub missing: MissingPipelines,
}

/// Where pipelines and descriptor sets come from.
#[derive(Clone, Copy)]
pub enum Place<'a> {
    /// A device, which is to record them.
    Device(&'a Shaders, &'a DescriptorPool),
    /// None: their pipelines are listed, and nothing is ever recorded.
    List(&'a RefCell<Vec<PipelineRecipe>>),
}

impl<'a> Source<'a> {
    /// Pipelines for the camera that a pass is seen by.
    pub fn new(place: Place<'a>, camera: &Camera) -> Self {
        Self {
            place,
            is_orthographic: camera.is_orthographic(),
            planes: Planes::default(),
            tints: None,
            missing: MissingPipelines::Make,
        }
    }

    /// The same for a frame that planes cut.
    #[must_use]
    pub fn cut_by(self, planes: Planes) -> Self {
        Self { planes, ..self }
    }

    /// The specialization constants of a pipeline, with those of the camera and of planes. A shader that has no use for one does not know it.
    fn complete(&self, layout: Layout, constants: &mut Constants) {
        if self.is_orthographic {
            constants.push((SPEC_ORTHOGRAPHIC, 1));
        }
        if self.planes.count > 0 && layout.has_planes() {
            constants.push((SPEC_PLANES, self.planes.count));
        }
        if self.tints.is_some() && layout.has_tints() {
            constants.push((SPEC_TINTED, 1));
        }
    }
}

/// A pass in the making. It lies in the frame's memory: whoever names its resources one after the other hands it on each time.
#[must_use = "a pass is declared by `finish`"]
pub(crate) struct Pass<'g, 'a>(&'g mut ManuallyDrop<Making<'g, 'a>>);

/// Nothing of it has anything to drop but what is in the frame's memory.
struct Making<'g, 'a> {
    declared: PassBuilder<'g, 'a, Body<'a>>,
    source: Source<'a>,
    bound: ArenaVec<'a, (At, ResourceId)>,
}

/// Places that most passes have room for.
const MOST_BOUND: usize = 16;

impl<'g, 'a> Pass<'g, 'a> {
    /// A pass of this name, unique in its frame; `why` the frame has it.
    pub fn new(
        graph: &'g mut Graph<'a, Body<'a>>,
        source: Source<'a>,
        name: impl Display,
        why: &'static str,
    ) -> Self {
        let arena: &'g Arena = graph.arena();
        let mut bound = graph.arena().growing();
        bound.reserve(MOST_BOUND);
        let declared = graph.pass(name).why(why);
        Self(arena.keep_changing(ManuallyDrop::new(Making { declared, source, bound })))
    }

    /// The memory of the frame.
    pub fn arena(&self) -> &'a Arena {
        self.0.declared.arena()
    }

    /// A pipeline of compute, made where it was not made yet.
    pub fn compute(&self, mut key: ComputeKey) -> Result<Pipeline> {
        let layout = key.layout;
        self.0.source.complete(layout, &mut key.constants);
        let raw = match self.0.source.place {
            Place::Device(shaders, _) => shaders.compute_if(key, self.0.source.missing)?,
            Place::List(list) => self.list(list, Key::Compute(key)),
        };
        Ok(Pipeline { raw, layout })
    }

    /// A pipeline of graphics, made where it was not made yet.
    pub fn graphics(&self, mut key: GraphicsKey) -> Result<Pipeline> {
        let layout = key.layout;
        self.0.source.complete(layout, &mut key.constants);
        let raw = match self.0.source.place {
            Place::Device(shaders, _) => shaders.graphics_if(key, self.0.source.missing)?,
            Place::List(list) => self.list(list, Key::Graphics(key)),
        };
        Ok(Pipeline { raw, layout })
    }

    fn list(&self, list: &RefCell<Vec<PipelineRecipe>>, key: Key) -> ash::vk::Pipeline {
        list.borrow_mut().push(PipelineRecipe { pass: self.0.declared.name().to_owned(), key });
        ash::vk::Pipeline::null()
    }

    /// Reads a resource.
    pub fn read<K>(self, at: At, handle: &Handle<K>, access: Access) -> Self {
        self.0.bound.push((at, handle.id()));
        self.uses(handle, access)
    }

    /// Reads what there may be.
    pub fn read_if<K>(self, at: At, handle: Option<&Handle<K>>, access: Access) -> Self {
        match handle {
            Some(handle) => self.read(at, handle, access),
            None => self,
        }
    }

    /// Writes a resource.
    pub fn write<K>(self, at: At, handle: &mut Handle<K>, access: Access, start: Start) -> Self {
        self.0.bound.push((at, handle.id()));
        self.attach(handle, access, start)
    }

    /// Finds the resource that was named last at another place, too.
    pub fn also(self, at: At) -> Self {
        let last = self.0.bound.last().map(|(_, id)| *id);
        self.0.bound.extend(last.map(|id| (at, id)));
        self
    }

    /// Reads what neither sets nor draws name: a depth that is tested.
    pub fn uses<K>(self, handle: &Handle<K>, access: Access) -> Self {
        self.0.declared.reads(handle, access);
        self
    }

    /// Writes what they don't name: an attachment.
    pub fn attach<K>(self, handle: &mut Handle<K>, access: Access, start: Start) -> Self {
        self.0.declared.writes(handle, access, start);
        self
    }

    /// Says what it does, for whoever measures it.
    pub fn role(self, role: Role) -> Self {
        self.0.declared.does(role);
        self
    }

    /// Keeps the pass even if nobody reads what it writes.
    pub fn side_effect(self) -> Self {
        self.0.declared.has_side_effect();
        self
    }

    /// Declares the pass; `body` records it.
    pub fn finish(self, body: impl Fn(&Recording<'_, 'a>) -> Result<()> + 'a) {
        let Making { declared, source, bound } = &mut **self.0;
        let (source, mut bound) = (*source, std::mem::replace(bound, declared.arena().growing()));
        bound.sort_unstable();
        let bound = bound.into_bump_slice();
        let body = declared.arena().keep(move |context: &PassContext<'_>| match source.place {
            Place::Device(shaders, descriptors) => {
                let (pipeline, sets) = (Cell::default(), LastSets::default());
                let (planes, tints) = (source.planes, source.tints);
                body(&Recording { context, shaders, descriptors, bound, pipeline, sets, planes, tints })
            }
            Place::List(_) => Ok(()),
        });
        declared.end(body);
    }
}
