//! Nothing leaks and nothing dies too early: whatever the order of drops, with work under way, and whichever step of
//! making something fails. The validation layer reports what is left when a device is destroyed, and what is destroyed
//! in use.

mod everything;
mod own_device;
mod refused;

use crate::common::{
    builder::{self, Random},
    faults,
    host::Host,
    watched::Watched,
};
use ash::vk;
use everything::{FORMAT, SIZE_PX, everything, pixels, scene, settings};
use surfel::{
    Error,
    frame::{FrameSlot, HeadlessTarget},
    graph::execute::Profile,
    prepare::PreparedScene,
    renderer::{Readbacks, Renderer, SceneFrame, Seen},
    vk::{Buffer, BufferDesc, CommandPool, Device, Features, Image, ImageDesc, MemoryUse, Queue, Staging},
};

/// Fisher and Yates.
fn shuffle<T>(things: &mut [T], random: &mut Random) {
    for last in (1..things.len()).rev() {
        things.swap(last, (random.unit() * (last + 1) as f64) as usize);
    }
}

#[test]
fn any_order_of_drops_with_a_frame_under_way_leaks_nothing_and_destroys_nothing_in_use() {
    for seed in 0..6 {
        let watched = Watched::new();
        let (messages, device) = (watched.messages.clone(), watched.device.clone());
        let profile = [Profile::Times, Profile::Counts, Profile::Frame][(seed % 3) as usize];
        let mut things = everything(watched, profile);
        shuffle(&mut things, &mut Random(seed));
        // Every second time our clone is gone first, so that the last of the things takes the device with it.
        let device = (seed % 4 < 2).then_some(device);
        things.into_iter().for_each(drop);
        if let Some(device) = device {
            assert_ne!(device.memory_in_use().1, 0, "what was dropped waits for its epoch");
            let queue = Queue::new(&device).unwrap();
            // SAFETY: nothing is recorded.
            unsafe { queue.wait_idle() }.unwrap();
            assert_eq!(device.memory_in_use(), (0, 0), "seed {seed}");
        }
        assert_eq!(messages.all(), [], "seed {seed}");
    }
}

/// What a leaked object is called: by layer 1.3.239 (Debian 12), and by 1.4.309 (Debian 13).
const LEAKED: [&str; 2] = ["VUID-vkDestroyDevice-device-00378", "VUID-vkDestroyDevice-device-05137"];

/// The layer would have said so above.
#[test]
fn a_leaked_object_is_reported_when_the_device_is_destroyed() {
    let watched = Watched::new();
    // SAFETY: the leak is the defect.
    unsafe { watched.device.raw().create_fence(&vk::FenceCreateInfo::default(), None) }.unwrap();
    let messages = watched.messages.clone();
    drop(watched);
    let vuids: Vec<_> = messages.all().into_iter().map(|message| message.vuid).collect();
    assert!(matches!(&vuids[..], [vuid] if LEAKED.contains(&vuid.as_str())), "{vuids:?}");

    let host = Host::new(Features::NEEDED);
    // SAFETY: as above.
    unsafe { host.device.create_fence(&vk::FenceCreateInfo::default(), None) }.unwrap();
    let said = host.destroy();
    assert!(said.len() == 1 && LEAKED.iter().any(|vuid| said[0].contains(vuid)), "{said:?}");
}

/// So would it of an object that is destroyed before the host has waited for the device.
#[test]
fn an_object_destroyed_in_use_is_reported() {
    let watched = Watched::new();
    let device = watched.device.raw();
    let flag = BufferDesc { name: "flag", size: 256, usage: vk::BufferUsageFlags::TRANSFER_DST };
    let flag = Buffer::new(&watched.device, flag, MemoryUse::Readback).unwrap();
    let info = vk::BufferCreateInfo::default().size(256).usage(vk::BufferUsageFlags::TRANSFER_DST);
    let pool = CommandPool::new(&watched.device, "program").unwrap();
    // SAFETY: the buffer is destroyed too early by the rules: the defect. In fact the device has finished, which only
    // the flag's bytes tell, so that no driver stumbles over it.
    unsafe {
        let buffer = device.create_buffer(&info, None).unwrap();
        let needed = device.get_buffer_memory_requirements(buffer);
        let info = vk::MemoryAllocateInfo::default()
            .allocation_size(1 << 20)
            .memory_type_index(needed.memory_type_bits.trailing_zeros());
        let memory = device.allocate_memory(&info, None).unwrap();
        device.bind_buffer_memory(buffer, memory, 0).unwrap();
        watched.said();
        let commands = pool.begin().unwrap();
        device.cmd_fill_buffer(commands, buffer, 0, 256, 1);
        device.cmd_fill_buffer(commands, flag.raw(), 0, 256, !0);
        let epoch = watched.queue.submit(pool.end().unwrap()).unwrap();
        let last = &raw const flag.bytes()[255];
        while last.read_volatile() == 0 {
            std::thread::yield_now();
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
        device.destroy_buffer(buffer, None);
        assert_eq!(watched.said(), ["VUID-vkDestroyBuffer-buffer-00922"]);
        watched.queue.wait(epoch).unwrap();
        device.free_memory(memory, None);
    }
}

#[test]
fn sizes_that_no_device_has_are_refused_and_leave_nothing() {
    let watched = Watched::new();
    let device = &watched.device;
    let beyond = device.facts().limits.max_image_side + 1;
    for (width, height) in [(0, 5), (5, 0), (beyond, 1), (1, beyond), (u32::MAX, u32::MAX)] {
        let extent = vk::Extent2D { width, height };
        let desc = ImageDesc { name: "wrong", format: FORMAT, extent, usage: vk::ImageUsageFlags::SAMPLED };
        let error = Image::new(device, desc).err().unwrap();
        assert!(error.to_string().starts_with(&format!("wrong: an image of {width}x{height}")), "{error}");
    }
    let usage = vk::BufferUsageFlags::TRANSFER_DST;
    let empty = BufferDesc { name: "empty", size: 0, usage };
    assert!(Buffer::new(device, empty, MemoryUse::Device).is_err());
    let mut staging = Staging::new(device, "staging", 16).unwrap();
    let small = BufferDesc { name: "small", size: 8, usage };
    let small = Buffer::new(device, small, MemoryUse::Device).unwrap();
    assert!(staging.push(&small, 0, &[0; 9]).is_err(), "more than the target has");
    assert!(staging.push(&small, 1, &[0; 8]).is_err(), "beyond the target's end");
    assert!(staging.push(&small, u64::MAX, &[0; 8]).is_err(), "beyond all numbers");
    staging.push(&small, 0, &[0; 8]).unwrap();
    staging.push(&small, 0, &[0; 8]).unwrap();
    assert!(staging.push(&small, 0, &[0; 1]).is_err(), "more than the batch has");
    let pool = CommandPool::new(device, "pool").unwrap();
    assert!(pool.end().is_err(), "not begun");
    drop((pool, staging, small));
    // SAFETY: nothing is recorded.
    unsafe { watched.queue.wait_idle() }.unwrap();
    assert_eq!(device.memory_in_use(), (0, 0));
    let messages = watched.messages.clone();
    drop(watched);
    assert_eq!(messages.all(), []);
}

/// What a host makes of ours before its first frame.
fn set_up(device: &Device) -> Result<(Renderer, PreparedScene), Error> {
    let commands = CommandPool::new(device, "uploads")?;
    let renderer = Renderer::new(device, None)?;
    // SAFETY: new, and never submitted.
    let buffer = unsafe { commands.begin() }?;
    let mut submit = |staging: Staging| {
        // SAFETY: recording; never submitted.
        unsafe { staging.record(buffer) };
        Ok(())
    };
    let prepared = renderer.prepare(&scene(), &mut submit, &|_, _| {})?;
    commands.end()?;
    Ok((renderer, prepared))
}

/// The first frame of a host, whose pipelines the renderer keeps.
fn record(device: &Device, (renderer, prepared): &(Renderer, PreparedScene)) -> Result<(), Error> {
    let commands = CommandPool::new(device, "frame")?;
    let mut slot = FrameSlot::new(device);
    let target = HeadlessTarget::new(device, FORMAT, SIZE_PX)?;
    let picture = pixels(device, "picture", 4)?;
    let readbacks = Readbacks { target: Some(picture.raw()), surface: None, sample: None };
    let camera = builder::camera([0.0, 0.0, 3.2], [0.0; 3]);
    let (target, settings) = (target.target(), settings());
    let profile = Some(Profile::Times);
    let frame = SceneFrame {
        readbacks,
        profile,
        ..SceneFrame::new(Seen { scene: prepared, camera: &camera, settings: &settings }, &target)
    };
    // SAFETY: recording; never submitted.
    unsafe { renderer.record(commands.begin()?, &mut slot, &frame) }?;
    commands.end().map(drop)
}

/// Of what is done with a thing, these calls fail one after the other: each is named, and what was made before is gone. Memory that was
/// taken before is there again, so that the last few calls may not come: how many failed.
fn assert_fail<T>(
    host: &Host,
    device: &Device,
    calls: impl IntoIterator<Item = usize>,
    thing: &dyn Fn() -> T,
    done: &dyn Fn(&T) -> Result<(), Error>,
) -> usize {
    let mut failed = 0;
    let finish = || {
        // SAFETY: nothing was ever submitted.
        unsafe { device.epoch_done(device.end_epoch()) };
        device.memory_in_use()
    };
    for succeed in calls {
        let thing = thing();
        let before = finish();
        faults::fail_after(succeed as u32);
        let result = done(&thing);
        let Some(function) = faults::stop() else {
            result.unwrap();
            break;
        };
        failed += 1;
        let error = result.expect_err(function);
        faults::is_told(function, vk::Result::ERROR_OUT_OF_DEVICE_MEMORY, &error);
        assert_eq!(finish(), before, "{succeed}: {function}");
        assert_eq!(host.said(), [] as [String; 0], "{succeed}: {function}");
    }
    failed
}

#[test]
fn whichever_call_fails_is_named_and_leaves_nothing_behind() {
    let host = Host::new(Features { large_points: true, ..Features::NEEDED });
    let device = host.lend(faults::device(&host.instance, &host.device));
    faults::take_called();
    let own = set_up(&device).unwrap();
    let of_set_up = faults::take_called();
    record(&device, &own).unwrap();
    let of_first = faults::take_called();
    record(&device, &own).unwrap();
    let of_next = faults::take_called();
    let all = [&of_set_up[..], &of_first, &of_next].concat();
    for function in ["allocate_memory", "create_image_view", "create_graphics_pipelines", "bind_image_memory"]
    {
        assert!(all.contains(&function), "{all:?}");
    }
    let failed = assert_fail(&host, &device, 0..of_set_up.len(), &|| (), &|()| set_up(&device).map(drop));
    assert!(failed + 3 >= of_set_up.len() && failed > 30, "{failed} of {of_set_up:?}");
    // Calls of the allocator, on a device that has no block yet; of one that is lost memory is not what is short.
    let answers = [vk::Result::ERROR_DEVICE_LOST, vk::Result::ERROR_OUT_OF_DEVICE_MEMORY];
    for (function, answer) in
        ["allocate_memory", "map_memory"].into_iter().flat_map(|of| answers.map(|is| (of, is)))
    {
        let lent = host.lend(faults::device(&host.instance, &host.device));
        faults::take_called();
        set_up(&lent).map(drop).unwrap();
        let place = faults::take_called().iter().position(|called| *called == function).unwrap();
        drop(lent);
        let lent = host.lend(faults::device(&host.instance, &host.device));
        faults::fail_so(place as u32, answer);
        let error = set_up(&lent).map(drop).expect_err(function);
        assert_eq!(faults::stop(), Some(function));
        faults::is_told(function, answer, &error);
    }
    // A renderer that has its pipelines.
    let failed = assert_fail(&host, &device, 0..of_next.len(), &|| (), &|()| record(&device, &own));
    assert!(failed + 3 >= of_next.len() && failed > 20, "{failed} of {of_next:?}");
    // One that has none: the first and the last of each function that makes them, and every twentieth.
    let is_tried = |i: &usize| {
        let (function, is) = (of_first[*i], |call: &&str| *call == of_first[*i]);
        let is_end = !of_first[..*i].iter().any(is) || !of_first[i + 1..].iter().any(is);
        !of_next.contains(&function) && (is_end || i.is_multiple_of(20))
    };
    let tried: Vec<_> = (0..of_first.len()).filter(is_tried).collect();
    println!(
        "{} calls, {} of a next frame, {tried:?} of {} before",
        of_set_up.len(),
        of_next.len(),
        of_first.len()
    );
    assert!(tried.len() >= 4, "{tried:?} of {of_first:?}");
    let failed =
        assert_fail(&host, &device, tried.clone(), &|| set_up(&device).unwrap(), &|own| record(&device, own));
    assert_eq!(failed, tried.len());
    drop((own, device));
    assert_eq!(host.destroy(), [] as [String; 0]);
}
