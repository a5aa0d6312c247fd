//! Layouts of descriptor sets.

use std::sync::{
    Arc,
    atomic::{AtomicU64, Ordering},
};

use ash::vk;

use super::{
    device::Device, garbage::Retired, layout::STAGES, owned::Owned, pool_sizes::PoolSizes,
    result::VkResultExt, sampler::Sampler, stand_ins::StandIns,
};
use crate::error::{Error, Result};

/// No layout has more bindings: sets have a bit for each.
const MOST_BINDINGS: usize = u64::BITS as usize;

/// One binding of a set: its type and the stages that see it. Its number is its place in the layout.
#[derive(Clone, Copy, Debug)]
pub struct Binding {
    /// Its type. `COMBINED_IMAGE_SAMPLER` comes with a bilinear sampler of the layout's own.
    pub kind: vk::DescriptorType,
    /// The stages that see it.
    pub stages: vk::ShaderStageFlags,
}

/// The bindings of a set.
pub struct SetLayout {
    owned: Owned<vk::DescriptorSetLayout>,
    /// Of no other layout of the process, as a handle may be.
    pub(super) number: u64,
    bindings: Vec<Binding>,
    // Used by the layout, so that it goes after it.
    _sampler: Option<Sampler>,
    /// The stand-ins for what its sets are not given, and the bindings of texels that are unsigned integers.
    pub(super) stand_ins: Option<(Arc<StandIns>, Vec<u32>)>,
}

impl SetLayout {
    /// A set of bindings numbered from 0.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] for a binding of another kind than those of Vulkan 1.0, or for other stages than vertices, fragments and compute; whatever the driver answers.
    ///
    /// # Panics
    /// With more than 64 bindings.
    pub fn new(device: &Device, name: &str, bindings: &[Binding]) -> Result<Self> {
        assert!(bindings.len() <= MOST_BINDINGS, "{name}: {} bindings", bindings.len());
        let is_known = |binding: &Binding| {
            let kinds = vk::DescriptorType::COMBINED_IMAGE_SAMPLER..=vk::DescriptorType::STORAGE_BUFFER;
            kinds.contains(&binding.kind) && STAGES.contains(binding.stages)
        };
        if let Some(other) = bindings.iter().find(|binding| !is_known(binding)) {
            return Err(Error::option(name, format!("a binding of {:?} for {:?}", other.kind, other.stages)));
        }
        let filtered = |binding: &Binding| binding.kind == vk::DescriptorType::COMBINED_IMAGE_SAMPLER;
        let sampler = bindings.iter().any(filtered).then(|| Sampler::new(device, name)).transpose()?;
        let samplers = [sampler.as_ref().map_or(vk::Sampler::null(), Sampler::raw)];
        let raw_bindings: Vec<_> = (0..)
            .zip(bindings)
            .map(|(number, binding)| {
                let raw = vk::DescriptorSetLayoutBinding::default()
                    .binding(number)
                    .descriptor_type(binding.kind)
                    .descriptor_count(1)
                    .stage_flags(binding.stages);
                if filtered(binding) { raw.immutable_samplers(&samplers) } else { raw }
            })
            .collect();
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&raw_bindings);
        // SAFETY: the device is alive.
        let raw = unsafe { device.raw().create_descriptor_set_layout(&info, None) }
            .of_call("vkCreateDescriptorSetLayout", name)?;
        let owned = device.own(raw, name, Retired::SetLayout);
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let bindings = bindings.to_vec();
        Ok(Self { owned, number, bindings, _sampler: sampler, stand_ins: None })
    }

    /// This layout with sets that are complete: what they are not given has a stand-in. `integers`: the bindings of texels that are
    /// unsigned integers.
    pub fn with_stand_ins(mut self, stand_ins: &Arc<StandIns>, integers: &[u32]) -> Self {
        self.stand_ins = Some((Arc::clone(stand_ins), integers.to_vec()));
        self
    }

    /// Its bindings.
    pub(super) fn bindings(&self) -> &[Binding] {
        &self.bindings
    }

    /// What one set of it takes of a pool.
    pub(super) fn sizes(&self) -> PoolSizes {
        let own = |sizes: PoolSizes, binding: &Binding| sizes.plus(&PoolSizes::one(binding.kind));
        self.bindings.iter().fold(PoolSizes { sets: 1, ..PoolSizes::default() }, own)
    }

    /// Whether it is of this device.
    pub(crate) fn is_of(&self, device: &Device) -> bool {
        self.owned.device.is(device)
    }

    /// The raw layout.
    pub fn raw(&self) -> vk::DescriptorSetLayout {
        self.owned.raw
    }
}
