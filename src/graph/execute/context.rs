//! What the body of a pass records with: the command buffer, and the objects that the pass declared.

use ash::vk;

use super::{
    super::{Access, PlannedPass, ResourceId},
    Physical,
};
use crate::{
    error::{ErrorKind, Result},
    vk::Device,
};

/// What a pass records: it is called between the pass's barriers and the next pass, inside of dynamic rendering for
/// a graphics pass, with viewport and scissor set to the whole of the attachments.
pub type Body<'a> = Box<dyn FnOnce(&PassContext<'_>) -> Result<()> + 'a>;

/// What a body records with.
pub struct PassContext<'a> {
    pub(super) device: &'a Device,
    pub(super) commands: vk::CommandBuffer,
    pub(super) physical: &'a [Option<Physical>],
    pub(super) pass: &'a PlannedPass,
}

impl PassContext<'_> {
    /// The device.
    pub fn device(&self) -> &ash::Device {
        self.device.raw()
    }

    /// The command buffer, recording.
    pub fn commands(&self) -> vk::CommandBuffer {
        self.commands
    }

    /// The image behind a resource that the pass declared.
    ///
    /// # Errors
    /// [`ErrorKind::Graph`] for one that it did not declare.
    pub fn image(&self, id: ResourceId) -> Result<(vk::Image, vk::ImageView)> {
        match self.declared(id)? {
            Physical::Image(image, view) => Ok((image, view)),
            Physical::Buffer(_) | Physical::TexelBuffer(..) => {
                Err(self.refuse(id, "is a buffer, not an image"))
            }
        }
    }

    /// The buffer behind a resource that the pass declared.
    ///
    /// # Errors
    /// [`ErrorKind::Graph`] for one that it did not declare.
    pub fn buffer(&self, id: ResourceId) -> Result<vk::Buffer> {
        match self.declared(id)? {
            Physical::TexelBuffer(..) if self.reads_texels(id) => {
                Err(self.refuse(id, "was declared to be read by texels"))
            }
            Physical::Buffer(buffer) | Physical::TexelBuffer(buffer, _) => Ok(buffer),
            Physical::Image(..) => Err(self.refuse(id, "is an image, not a buffer")),
        }
    }

    /// The texels of a buffer that the pass declared to read by them.
    ///
    /// # Errors
    /// [`ErrorKind::Graph`] for one that it did not declare, or that has none.
    pub fn texels(&self, id: ResourceId) -> Result<vk::BufferView> {
        match self.declared(id)? {
            Physical::TexelBuffer(_, texels) if self.reads_texels(id) => Ok(texels),
            Physical::TexelBuffer(..) => Err(self.refuse(id, "was not declared to be read by texels")),
            _ => Err(self.refuse(id, "has no texels")),
        }
    }

    fn reads_texels(&self, id: ResourceId) -> bool {
        self.pass.uses.iter().any(|usage| usage.resource == id && usage.access == Access::TexelReadCompute)
    }

    /// The layout in which the pass finds an image that it declared.
    pub fn layout(&self, id: ResourceId) -> vk::ImageLayout {
        let uses = self.pass.uses.iter().filter(|usage| usage.resource == id);
        uses.filter_map(|usage| usage.access.info().image).next().map_or(vk::ImageLayout::UNDEFINED, |i| i.0)
    }

    fn declared(&self, id: ResourceId) -> Result<Physical> {
        // A body that reaches for what it did not declare would race: no barrier knows of it.
        if !self.pass.uses.iter().any(|usage| usage.resource == id) {
            return Err(self.refuse(id, "is used by the pass but not declared"));
        }
        self.physical[id.index()]
            .ok_or_else(|| self.refuse(id, "has no Vulkan object: an import was not given"))
    }

    fn refuse(&self, id: ResourceId, reason: &str) -> crate::error::Error {
        let resource = format!("#{}", id.index());
        ErrorKind::Graph { pass: self.pass.name.clone(), resource, reason: reason.to_owned() }.into()
    }
}
