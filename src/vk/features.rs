//! The features of a device that are made use of.

use ash::vk;

/// Features of a device: those that it offers, or those that are enabled on it. The first four are needed; Vulkan 1.3 promises them, but a
/// device has them only where they were enabled.
///
/// ```
/// use surfel::embed::Features;
///
/// // What an engine enables anyway, of a device that it made before.
/// let enabled = Features { independent_blend: true, synchronization2: false, ..Features::NEEDED };
/// assert_eq!(enabled.missing(), ["synchronization2"]);
/// assert_eq!(enabled.core().independent_blend, 1);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Features {
    /// `synchronization2`: needed.
    pub synchronization2: bool,
    /// `dynamicRendering`: needed.
    pub dynamic_rendering: bool,
    /// `maintenance4`: needed.
    pub maintenance4: bool,
    /// `shaderTerminateInvocation`: needed.
    pub shader_terminate_invocation: bool,
    /// `largePoints`; without it every splat above one pixel is a quad.
    pub large_points: bool,
    /// `drawIndirectFirstInstance`; without it splats are not drawn by tiles.
    pub draw_indirect_first_instance: bool,
    /// `drawIndirectCount`; without it all layers of `--layers auto` are drawn, the empty ones too.
    pub draw_indirect_count: bool,
    /// `pipelineStatisticsQuery`; without it vertices and fragments are not counted.
    pub pipeline_statistics_query: bool,
    /// `independentBlend`; without it a view is drawn within renderings of one color attachment only.
    pub independent_blend: bool,
}

impl Features {
    /// Those that are needed, and no other.
    pub const NEEDED: Self = Self {
        synchronization2: true,
        dynamic_rendering: true,
        maintenance4: true,
        shader_terminate_invocation: true,
        large_points: false,
        draw_indirect_first_instance: false,
        draw_indirect_count: false,
        pipeline_statistics_query: false,
        independent_blend: false,
    };

    /// The names of needed ones that are not among these.
    pub fn missing(&self) -> Vec<&'static str> {
        let needed = [
            (self.synchronization2, "synchronization2"),
            (self.dynamic_rendering, "dynamicRendering"),
            (self.maintenance4, "maintenance4"),
            (self.shader_terminate_invocation, "shaderTerminateInvocation"),
        ];
        needed.into_iter().filter(|(there, _)| !there).map(|(_, name)| name).collect()
    }

    /// Those of Vulkan 1.0, as a device is created with.
    pub fn core(&self) -> vk::PhysicalDeviceFeatures {
        vk::PhysicalDeviceFeatures::default()
            .large_points(self.large_points)
            .draw_indirect_first_instance(self.draw_indirect_first_instance)
            .pipeline_statistics_query(self.pipeline_statistics_query)
            .independent_blend(self.independent_blend)
    }

    /// Those of Vulkan 1.2, for the chain that a device is created with.
    pub fn vulkan12(&self) -> vk::PhysicalDeviceVulkan12Features<'static> {
        vk::PhysicalDeviceVulkan12Features::default().draw_indirect_count(self.draw_indirect_count)
    }

    /// Those of Vulkan 1.3, for that chain.
    pub fn vulkan13(&self) -> vk::PhysicalDeviceVulkan13Features<'static> {
        vk::PhysicalDeviceVulkan13Features::default()
            .synchronization2(self.synchronization2)
            .dynamic_rendering(self.dynamic_rendering)
            .maintenance4(self.maintenance4)
            .shader_terminate_invocation(self.shader_terminate_invocation)
    }

    /// Those of Vulkan 1.3 in structures of one feature each: for a host whose chain has others of these, beside which `VkPhysicalDeviceVulkan13Features` may not be.
    pub fn apart(&self) -> FeaturesApart {
        FeaturesApart {
            synchronization2: vk::PhysicalDeviceSynchronization2Features::default()
                .synchronization2(self.synchronization2),
            dynamic_rendering: vk::PhysicalDeviceDynamicRenderingFeatures::default()
                .dynamic_rendering(self.dynamic_rendering),
            maintenance4: vk::PhysicalDeviceMaintenance4Features::default().maintenance4(self.maintenance4),
            shader_terminate_invocation: vk::PhysicalDeviceShaderTerminateInvocationFeatures::default()
                .shader_terminate_invocation(self.shader_terminate_invocation),
        }
    }
}

/// Features in structures of one each ([`Features::apart`]).
pub struct FeaturesApart {
    synchronization2: vk::PhysicalDeviceSynchronization2Features<'static>,
    dynamic_rendering: vk::PhysicalDeviceDynamicRenderingFeatures<'static>,
    maintenance4: vk::PhysicalDeviceMaintenance4Features<'static>,
    shader_terminate_invocation: vk::PhysicalDeviceShaderTerminateInvocationFeatures<'static>,
}

impl FeaturesApart {
    /// What a device is created with, with these in front of its chain, in which none of the four may be.
    pub fn enable<'a>(&'a mut self, info: vk::DeviceCreateInfo<'a>) -> vk::DeviceCreateInfo<'a> {
        info.push_next(&mut self.synchronization2)
            .push_next(&mut self.dynamic_rendering)
            .push_next(&mut self.maintenance4)
            .push_next(&mut self.shader_terminate_invocation)
    }
}
