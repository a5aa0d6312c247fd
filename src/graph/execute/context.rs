//! What the body of a pass records with: the command buffer, and the objects that the pass declared.

use ash::vk;

use super::{
    super::{Access, PlannedPass, ResourceDesc, ResourceId},
    Physical,
    recorder::Recorder,
};
use crate::{
    arena::Arena,
    error::{Error, ErrorKind, Result},
    vk::Descriptor,
};

/// What a pass records: it is called between the pass's barriers and the next pass, inside of dynamic rendering for
/// a graphics pass, with viewport and scissor set to the whole of the attachments.
pub type Body<'a> = &'a dyn Fn(&PassContext<'_>) -> Result<()>;

/// What a body records with.
pub struct PassContext<'a> {
    pub(super) recorder: &'a Recorder<'a>,
    /// One a resource.
    pub(super) bindings: &'a [Binding],
    /// The pass's place in the plan.
    pub(super) index: u32,
    pub(super) pass: &'a PlannedPass,
}

/// How the last pass that declared a resource accesses it.
#[derive(Clone, Copy, Default)]
pub(super) struct Binding {
    /// The pass's place in the plan; `None` where none has declared it yet.
    pass: Option<u32>,
    /// The layout of an image.
    layout: vk::ImageLayout,
    /// It is read by texels.
    texels: bool,
}

impl Binding {
    /// Takes over all that a pass has declared.
    pub fn declare(bindings: &mut [Self], index: u32, pass: &PlannedPass) {
        for usage in &pass.uses {
            let binding = &mut bindings[usage.resource.index()];
            let texels = usage.access == Access::TexelReadCompute;
            let is_first = binding.pass.replace(index) != Some(index);
            binding.texels = texels || !is_first && binding.texels;
            binding.layout = usage.access.info().image.map(|(layout, _)| layout).unwrap_or_default();
        }
    }
}

impl PassContext<'_> {
    /// The device.
    pub fn device(&self) -> &ash::Device {
        self.recorder.device.raw()
    }

    /// The memory of the frame.
    pub fn arena(&self) -> &Arena {
        self.recorder.arena
    }

    /// Tells who wants to know it that a pipeline runs.
    pub fn runs(&self, pipeline: vk::Pipeline) {
        if let Some(runs) = self.recorder.runs {
            runs.runs(pipeline);
        }
    }

    /// The pass's name.
    pub fn name(&self) -> &str {
        &self.pass.name
    }

    /// The command buffer, recording.
    pub fn commands(&self) -> vk::CommandBuffer {
        self.recorder.commands
    }

    /// A resource that the pass declared, as it declared it, for a set of descriptors: of a buffer as much as was asked for,
    /// whatever room it has.
    ///
    /// # Errors
    /// [`ErrorKind::Graph`] for one that it did not declare.
    pub fn descriptor(&self, id: ResourceId) -> Result<Descriptor> {
        let (Binding { layout, texels, .. }, object) = self.declared(id)?;
        Ok(match (object, self.recorder.plan.resource(id).desc) {
            (Physical::Image(_, view) | Physical::Layer(_, view, _), _) => match layout {
                vk::ImageLayout::GENERAL => Descriptor::Storage(view),
                _ => Descriptor::Sampled(view, layout),
            },
            (Physical::TexelBuffer(_, view), _) if texels => Descriptor::Texels(view),
            (Physical::Buffer(buffer) | Physical::TexelBuffer(buffer, _), ResourceDesc::Buffer(desc)) => {
                Descriptor::Buffer(buffer, desc.size_bytes)
            }
            (_, ResourceDesc::Image(_)) => return Err(self.refuse(id, "is an image, not a buffer")),
        })
    }

    /// The image behind a resource that the pass declared.
    ///
    /// # Errors
    /// [`ErrorKind::Graph`] for one that it did not declare.
    pub fn image(&self, id: ResourceId) -> Result<(vk::Image, vk::ImageView)> {
        match self.declared(id)?.1 {
            // Who copies from an image takes its first layer, which of another one it would not be.
            Physical::Image(image, view) => Ok((image, view)),
            Physical::Layer(..) => Err(self.refuse(id, "is a layer of an image, not all of one")),
            Physical::Buffer(_) | Physical::TexelBuffer(..) => {
                Err(self.refuse(id, "is a buffer, not an image"))
            }
        }
    }

    /// The buffer behind a resource that the pass declared. It may have room for more than was asked for.
    ///
    /// # Errors
    /// [`ErrorKind::Graph`] for one that it did not declare.
    pub fn buffer(&self, id: ResourceId) -> Result<vk::Buffer> {
        match self.declared(id)?.1 {
            Physical::Buffer(buffer) | Physical::TexelBuffer(buffer, _) => Ok(buffer),
            Physical::Image(..) | Physical::Layer(..) => Err(self.refuse(id, "is an image, not a buffer")),
        }
    }

    /// The layout in which the pass finds an image that it declared.
    pub fn layout(&self, id: ResourceId) -> vk::ImageLayout {
        self.declared(id).map_or(vk::ImageLayout::UNDEFINED, |(binding, _)| binding.layout)
    }

    fn declared(&self, id: ResourceId) -> Result<(Binding, Physical)> {
        // A body that reaches for what it did not declare would race: no barrier knows of it.
        match self.bindings.get(id.index()) {
            Some(binding) if binding.pass == Some(self.index) => Ok((*binding, self.recorder.object(id)?)),
            _ => Err(self.refuse(id, "is used by the pass but not declared")),
        }
    }

    fn refuse(&self, id: ResourceId, reason: &str) -> Error {
        let resource = format!("#{}", id.index());
        ErrorKind::Graph { pass: self.pass.name.clone(), resource, reason: reason.to_owned() }.into()
    }
}
