//! A device on which the n-th call that makes something fails: its table of functions, with each such function
//! replaced by one that counts.

use std::cell::{Cell, RefCell};

use ash::vk;

thread_local! {
    /// Calls that still succeed; the one after them fails. `u32::MAX`: none does.
    static LEFT: Cell<u32> = const { Cell::new(u32::MAX) };
    /// What they answer then.
    static ANSWER: Cell<vk::Result> = const { Cell::new(vk::Result::ERROR_OUT_OF_DEVICE_MEMORY) };
    /// The function that failed.
    static FAILED: Cell<Option<&'static str>> = const { Cell::new(None) };
    /// The functions that were called since that was asked for last.
    static CALLED: RefCell<Vec<&'static str>> = const { RefCell::new(Vec::new()) };
    /// The device's own functions.
    static OWN: RefCell<Option<ash::DeviceFnV1_0>> = const { RefCell::new(None) };
}

/// Lets `succeed` calls of this thread succeed; the next fails, and every later one of the same function.
pub fn fail_after(succeed: u32) {
    fail_so(succeed, vk::Result::ERROR_OUT_OF_DEVICE_MEMORY);
}

/// The same with another answer.
pub fn fail_so(succeed: u32, answer: vk::Result) {
    LEFT.set(succeed);
    ANSWER.set(answer);
    FAILED.set(None);
}

/// Ends the faults; the function that failed, if one did.
pub fn stop() -> Option<&'static str> {
    LEFT.set(u32::MAX);
    FAILED.take()
}

/// The functions that can fail, call by call since the last time that this was asked for.
pub fn take_called() -> Vec<&'static str> {
    CALLED.take()
}

/// Those of them that made objects or took memory.
pub fn take_made() -> Vec<&'static str> {
    let mut called = take_called();
    called.retain(|function| function.starts_with("create_") || *function == "allocate_memory");
    called
}

fn fails(function: &'static str) -> bool {
    CALLED.with_borrow_mut(|called| called.push(function));
    match LEFT.get() {
        u32::MAX => false,
        0 => match FAILED.get() {
            None => {
                FAILED.set(Some(function));
                true
            }
            // Out of memory is not over at the next try.
            failed => failed == Some(function),
        },
        left => {
            LEFT.set(left - 1);
            false
        }
    }
}

macro_rules! faulty {
    ($table:ident; $($function:ident($($argument:ident: $kind:ty),*);)*) => {$({
        unsafe extern "system" fn $function($($argument: $kind),*) -> vk::Result {
            if fails(stringify!($function)) {
                return ANSWER.get();
            }
            let own = OWN.with_borrow(|own| own.as_ref().map(|own| own.$function));
            // SAFETY: the caller's own contract is that of the function behind.
            own.map_or(vk::Result::ERROR_UNKNOWN, |own| unsafe { own($($argument),*) })
        }
        $table.$function = $function;
    })*};
}

type Allocator<'a> = *const vk::AllocationCallbacks<'a>;

/// The device with functions that fail when [`fail_after`] says so. For this thread, one device at a time.
pub fn device(own: &ash::Device) -> ash::Device {
    let mut table = own.fp_v1_0().clone();
    OWN.set(Some(table.clone()));
    faulty! { table;
        allocate_memory(d: vk::Device, i: *const vk::MemoryAllocateInfo<'_>, a: Allocator<'_>, o: *mut vk::DeviceMemory);
        map_memory(d: vk::Device, m: vk::DeviceMemory, o: u64, s: u64, f: vk::MemoryMapFlags, p: *mut *mut std::ffi::c_void);
        bind_buffer_memory(d: vk::Device, b: vk::Buffer, m: vk::DeviceMemory, o: u64);
        bind_image_memory(d: vk::Device, i: vk::Image, m: vk::DeviceMemory, o: u64);
        create_buffer(d: vk::Device, i: *const vk::BufferCreateInfo<'_>, a: Allocator<'_>, o: *mut vk::Buffer);
        create_buffer_view(d: vk::Device, i: *const vk::BufferViewCreateInfo<'_>, a: Allocator<'_>, o: *mut vk::BufferView);
        create_image(d: vk::Device, i: *const vk::ImageCreateInfo<'_>, a: Allocator<'_>, o: *mut vk::Image);
        create_image_view(d: vk::Device, i: *const vk::ImageViewCreateInfo<'_>, a: Allocator<'_>, o: *mut vk::ImageView);
        create_shader_module(d: vk::Device, i: *const vk::ShaderModuleCreateInfo<'_>, a: Allocator<'_>, o: *mut vk::ShaderModule);
        create_pipeline_cache(d: vk::Device, i: *const vk::PipelineCacheCreateInfo<'_>, a: Allocator<'_>, o: *mut vk::PipelineCache);
        create_graphics_pipelines(d: vk::Device, c: vk::PipelineCache, n: u32, i: *const vk::GraphicsPipelineCreateInfo<'_>, a: Allocator<'_>, o: *mut vk::Pipeline);
        create_compute_pipelines(d: vk::Device, c: vk::PipelineCache, n: u32, i: *const vk::ComputePipelineCreateInfo<'_>, a: Allocator<'_>, o: *mut vk::Pipeline);
        create_pipeline_layout(d: vk::Device, i: *const vk::PipelineLayoutCreateInfo<'_>, a: Allocator<'_>, o: *mut vk::PipelineLayout);
        create_descriptor_set_layout(d: vk::Device, i: *const vk::DescriptorSetLayoutCreateInfo<'_>, a: Allocator<'_>, o: *mut vk::DescriptorSetLayout);
        create_descriptor_pool(d: vk::Device, i: *const vk::DescriptorPoolCreateInfo<'_>, a: Allocator<'_>, o: *mut vk::DescriptorPool);
        allocate_descriptor_sets(d: vk::Device, i: *const vk::DescriptorSetAllocateInfo<'_>, o: *mut vk::DescriptorSet);
        create_query_pool(d: vk::Device, i: *const vk::QueryPoolCreateInfo<'_>, a: Allocator<'_>, o: *mut vk::QueryPool);
        create_command_pool(d: vk::Device, i: *const vk::CommandPoolCreateInfo<'_>, a: Allocator<'_>, o: *mut vk::CommandPool);
        allocate_command_buffers(d: vk::Device, i: *const vk::CommandBufferAllocateInfo<'_>, o: *mut vk::CommandBuffer);
        create_sampler(d: vk::Device, i: *const vk::SamplerCreateInfo<'_>, a: Allocator<'_>, o: *mut vk::Sampler);
        reset_descriptor_pool(d: vk::Device, p: vk::DescriptorPool, f: vk::DescriptorPoolResetFlags);
        get_query_pool_results(d: vk::Device, p: vk::QueryPool, f: u32, n: u32, s: usize, o: *mut std::ffi::c_void, t: u64, g: vk::QueryResultFlags);
        begin_command_buffer(c: vk::CommandBuffer, i: *const vk::CommandBufferBeginInfo<'_>);
        end_command_buffer(c: vk::CommandBuffer);
    }
    let (fp_1_1, fp_1_2, fp_1_3) = (own.fp_v1_1().clone(), own.fp_v1_2().clone(), own.fp_v1_3().clone());
    ash::Device::from_parts_1_3(own.handle(), table, fp_1_1, fp_1_2, fp_1_3)
}
