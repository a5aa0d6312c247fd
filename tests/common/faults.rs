//! A device on which the n-th call that can fail does: its table of functions, with each such function replaced by one
//! that counts.

use std::{
    cell::{Cell, RefCell},
    collections::HashMap,
    ffi::{CStr, c_char, c_void},
};

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
    static OWN: RefCell<HashMap<&'static str, Function>> = RefCell::default();
    /// What finds them.
    static FIND: Cell<Option<vk::PFN_vkGetDeviceProcAddr>> = const { Cell::new(None) };
    static CREATE: Cell<Option<vk::PFN_vkCreateDevice>> = const { Cell::new(None) };
    static DEVICES: Cell<Option<vk::PFN_vkEnumeratePhysicalDevices>> = const { Cell::new(None) };
}

type Function = unsafe extern "system" fn();

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

/// `vkQueueSubmit2` of `queue_submit2`.
fn called(function: &str) -> String {
    let capital = |word: &str| word[..1].to_ascii_uppercase() + &word[1..];
    function.split('_').fold("vk".to_owned(), |call, word| call + &capital(word))
}

/// An error names the call, the object and what was answered, as one of the device.
#[track_caller]
pub fn is_told(function: &str, answer: vk::Result, error: &surfel::Error) {
    assert_eq!(error.exit_code(), 2, "{function}: {error}");
    let text = error.to_string();
    assert!(!text.contains("''"), "{function}: no object is named: {error}");
    let call = called(function);
    assert!(text.contains(&call), "{call}: the call is not named: {error}");
    // What was answered is in the kind, of memory by what that is.
    match error.kind() {
        surfel::ErrorKind::Memory { .. } => {
            assert_ne!(answer, vk::Result::ERROR_DEVICE_LOST, "{call}: {error}")
        }
        _ => assert!(text.contains(&format!("{answer:?}")), "{call}: not what was answered: {error}"),
    }
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
    ($($function:ident($($argument:ident: $kind:ty),*);)*) => {
        $(unsafe extern "system" fn $function($($argument: $kind),*) -> vk::Result {
            if fails(stringify!($function)) {
                return ANSWER.get();
            }
            let own = OWN.with_borrow(|own| own.get(stringify!($function)).copied());
            own.map_or(vk::Result::ERROR_UNKNOWN, |own| {
                // SAFETY: Vulkan's function of this name has this type; the caller's own contract is that of the function behind.
                unsafe {
                    std::mem::transmute::<Function, unsafe extern "system" fn($($kind),*) -> vk::Result>(own)($($argument),*)
                }
            })
        })*

        /// The function that fails in the place of one.
        fn of_name(name: &str) -> Option<(&'static str, *const c_void)> {
            match name {
                $(stringify!($function) => Some((stringify!($function), $function as *const c_void)),)*
                "wait_semaphores" => Some(("wait_semaphores", wait_semaphores as *const c_void)),
                _ => None,
            }
        }
    };
}

type Allocator<'a> = *const vk::AllocationCallbacks<'a>;

faulty! {
    allocate_memory(d: vk::Device, i: *const vk::MemoryAllocateInfo<'_>, a: Allocator<'_>, o: *mut vk::DeviceMemory);
    map_memory(d: vk::Device, m: vk::DeviceMemory, o: u64, s: u64, f: vk::MemoryMapFlags, p: *mut *mut c_void);
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
    create_semaphore(d: vk::Device, i: *const vk::SemaphoreCreateInfo<'_>, a: Allocator<'_>, o: *mut vk::Semaphore);
    reset_descriptor_pool(d: vk::Device, p: vk::DescriptorPool, f: vk::DescriptorPoolResetFlags);
    reset_command_pool(d: vk::Device, p: vk::CommandPool, f: vk::CommandPoolResetFlags);
    get_query_pool_results(d: vk::Device, p: vk::QueryPool, f: u32, n: u32, s: usize, o: *mut c_void, t: u64, g: vk::QueryResultFlags);
    begin_command_buffer(c: vk::CommandBuffer, i: *const vk::CommandBufferBeginInfo<'_>);
    end_command_buffer(c: vk::CommandBuffer);
    queue_submit2(q: vk::Queue, n: u32, i: *const vk::SubmitInfo2<'_>, f: vk::Fence);
    queue_wait_idle(q: vk::Queue);
    get_semaphore_counter_value(d: vk::Device, s: vk::Semaphore, o: *mut u64);
}

/// Waits until the device is idle, and then for the semaphores, or answers that this failed: layers don't follow timeline semaphores when they look for hazards across
/// submissions (before Vulkan-ValidationLayers 8559), and what was waited for without their knowledge would be one to them.
unsafe extern "system" fn wait_semaphores(
    device: vk::Device,
    info: *const vk::SemaphoreWaitInfo<'_>,
    timeout: u64,
) -> vk::Result {
    type Idle = unsafe extern "system" fn(vk::Device) -> vk::Result;
    type Wait = unsafe extern "system" fn(vk::Device, *const vk::SemaphoreWaitInfo<'_>, u64) -> vk::Result;
    let own = |name: &str| OWN.with_borrow(|own| own.get(name).copied());
    let (Some(idle), Some(wait)) = (own("device_wait_idle"), own("wait_semaphores")) else {
        return vk::Result::ERROR_UNKNOWN;
    };
    // SAFETY: Vulkan's functions of these names have these types; the caller's own contract. One thread submits.
    unsafe {
        let idle = std::mem::transmute::<Function, Idle>(idle)(device);
        match fails("wait_semaphores") {
            true => ANSWER.get(),
            false if idle != vk::Result::SUCCESS => idle,
            false => std::mem::transmute::<Function, Wait>(wait)(device, info, timeout),
        }
    }
}

/// A function of a device: one that fails in its place, where it can.
fn found(name: &CStr, own: vk::PFN_vkVoidFunction) -> vk::PFN_vkVoidFunction {
    // `vkQueueSubmit2` is `queue_submit2`.
    let mut snake = String::new();
    for letter in name.to_str().unwrap_or_default().chars().skip(2) {
        if letter.is_ascii_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.push(letter.to_ascii_lowercase());
    }
    if let (Some(function), "device_wait_idle") = (own, &*snake) {
        OWN.with_borrow_mut(|all| all.insert("device_wait_idle", function));
    }
    let (Some(function), Some((name, instead))) = (own, of_name(&snake)) else { return own };
    OWN.with_borrow_mut(|all| all.insert(name, function));
    // SAFETY: a function is as large as a pointer to it, and is called by the type that its name has.
    unsafe { std::mem::transmute(instead) }
}

/// The device with functions that fail when [`fail_after`] says so. For this thread, one device at a time.
pub fn device(instance: &ash::Instance, own: &ash::Device) -> ash::Device {
    let find = instance.fp_v1_0().get_device_proc_addr;
    // SAFETY: functions of this device, or such that call them.
    unsafe {
        ash::Device::load_with(
            |name| std::mem::transmute(found(name, find(own.handle(), name.as_ptr()))),
            own.handle(),
        )
    }
}

/// The instance, whose devices have functions that fail when [`fail_after`] says so, and are neither found nor made then. For this thread, one device at a time.
pub fn instance(own: &ash::Instance) -> ash::Instance {
    unsafe extern "system" fn find(device: vk::Device, name: *const c_char) -> vk::PFN_vkVoidFunction {
        let own = FIND.get()?;
        // SAFETY: the caller's own contract.
        unsafe { found(CStr::from_ptr(name), own(device, name)) }
    }
    unsafe extern "system" fn create_device(
        physical: vk::PhysicalDevice,
        info: *const vk::DeviceCreateInfo<'_>,
        allocator: Allocator<'_>,
        device: *mut vk::Device,
    ) -> vk::Result {
        if fails("create_device") {
            return ANSWER.get();
        }
        // SAFETY: the caller's own contract.
        CREATE
            .get()
            .map_or(vk::Result::ERROR_UNKNOWN, |own| unsafe { own(physical, info, allocator, device) })
    }
    unsafe extern "system" fn devices(
        instance: vk::Instance,
        count: *mut u32,
        all: *mut vk::PhysicalDevice,
    ) -> vk::Result {
        if fails("enumerate_physical_devices") {
            return ANSWER.get();
        }
        // SAFETY: the caller's own contract.
        DEVICES.get().map_or(vk::Result::ERROR_UNKNOWN, |own| unsafe { own(instance, count, all) })
    }
    let mut table = own.fp_v1_0().clone();
    FIND.set(Some(std::mem::replace(&mut table.get_device_proc_addr, find)));
    CREATE.set(Some(std::mem::replace(&mut table.create_device, create_device)));
    DEVICES.set(Some(std::mem::replace(&mut table.enumerate_physical_devices, devices)));
    ash::Instance::from_parts_1_3(own.handle(), table, own.fp_v1_1().clone(), own.fp_v1_3().clone())
}
