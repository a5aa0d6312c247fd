//! What C gives and takes without a device, by raw pointers as C does: for Miri, which sees each byte that is read (`.github/workflows/nightly.yml` has the command).

use std::{ffi::CStr, mem::MaybeUninit, ptr::null_mut};

use surfel::{Scene, ash::vk, scene::Epsilon};

use crate::{
    contents::{
        SurfelSceneContents, surfel_scene_ball, surfel_scene_bounds, surfel_scene_contents,
        surfel_scene_object_clips, surfel_scene_object_splats,
    },
    levels::{SurfelErrorBall, SurfelLevels, surfel_scene_add_levels},
    mesh::{SurfelMesh, surfel_scene_add_mesh},
    result::{SurfelResult, surfel_last_error},
    rooms::SurfelRoom,
    scene::{
        SurfelScene, SurfelSceneInfo, surfel_scene_add_light, surfel_scene_add_splats, surfel_scene_create,
        surfel_scene_destroy, surfel_scene_set, surfel_scene_transform,
    },
    settings::{surfel_settings_create, surfel_settings_destroy, surfel_settings_set},
    splats::{SurfelClip, SurfelClipCurve, SurfelSplats},
    structs::{Struct, SurfelStructureType},
};

/// All zeros but for its head, as `{.sType = …, .size = sizeof …}` is in C.
fn plain<T: Struct>() -> T {
    let mut whole = MaybeUninit::<T>::zeroed();
    let head = whole.as_mut_ptr().cast::<u32>();
    // SAFETY: `Struct`'s contract: it begins with both, and may be all zeros.
    unsafe {
        head.write(T::TYPE as u32);
        head.add(1).write(size_of::<T>() as u32);
        whole.assume_init()
    }
}

fn last() -> String {
    // SAFETY: valid until this thread's next failure.
    unsafe { CStr::from_ptr(surfel_last_error()) }.to_string_lossy().into_owned()
}

/// A scene that C has made.
fn scene(info: *const SurfelSceneInfo) -> *mut SurfelScene {
    let mut scene = MaybeUninit::uninit();
    // SAFETY: written by the call, whatever it answers.
    let (answer, scene) = unsafe { (surfel_scene_create(info, scene.as_mut_ptr()), scene.assume_init()) };
    assert_eq!(answer, SurfelResult::Success, "{}", last());
    scene
}

const CENTERS: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
const NORMALS: [[f32; 3]; 3] = [[0.0, 0.0, 1.0]; 3];
const RADII: [f32; 3] = [0.5, 0.25, 0.125];
const TANGENTS: [[[f32; 3]; 3]; 2] = [[[0.5, 0.0, 0.0]; 3], [[0.0, 0.25, 0.0]; 3]];
const COLORS: [[f32; 4]; 3] = [[0.1, 0.2, 0.3, 1.0], [0.4, 0.5, 0.6, 1.0], [0.7, 0.8, 0.9, 1.0]];

fn disks() -> SurfelSplats {
    SurfelSplats {
        count: 3,
        centers: CENTERS.as_ptr().cast(),
        normals: NORMALS.as_ptr().cast(),
        radii: RADII.as_ptr(),
        colors: COLORS.as_ptr().cast(),
        color_count: 3,
        ..plain()
    }
}

fn ellipses(count: u64) -> SurfelSplats {
    SurfelSplats {
        count,
        centers: CENTERS.as_ptr().cast(),
        tangents_s: TANGENTS[0].as_ptr().cast(),
        tangents_t: TANGENTS[1].as_ptr().cast(),
        ..plain()
    }
}

#[test]
fn scenes_are_made_of_all_that_c_can_give_and_moved_and_measured() {
    let info = SurfelSceneInfo { updatable: vk::TRUE, without_auto_epsilon: vk::TRUE, ..plain() };
    let scene = scene(&info);
    let curve = SurfelClipCurve { start_rad: -1.0, end_rad: 1.0, middle: [0.5, 0.1], weight: 1.0 };
    let clips = [1, 2, 0].map(|curve_count| SurfelClip { curve_count, both: vk::TRUE, curves: [curve; 2] });
    let room = SurfelRoom { splats: 7, has_around: vk::TRUE, around: [1.0, 2.0, 3.0], ..plain() };
    let all = [
        SurfelSplats { name: c"disks".as_ptr(), closed: vk::TRUE, room: &room, ..disks() },
        SurfelSplats { color_count: 1, epsilon: 0.5, ..disks() },
        SurfelSplats { clips: clips.as_ptr(), epsilon_in_radii: 2.0, ..ellipses(3) },
        SurfelSplats { centers: std::ptr::null(), auto_epsilon: vk::TRUE, ..ellipses(0) },
    ];
    let corners = [[0_u32, 1, 2]];
    let mesh = SurfelMesh {
        vertex_count: 3,
        positions: CENTERS.as_ptr().cast(),
        colors: COLORS.as_ptr().cast(),
        color_count: 3,
        triangle_count: 1,
        triangles: corners.as_ptr().cast(),
        ..plain()
    };
    let turned = [0.0, 2.0, 0.0, 0.0, -2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 5.0, 6.0, 7.0, 1.0];
    let (mut center, mut radius) = ([0.0; 3], 0.0);
    // SAFETY: a scene that was made, and arrays of as many as is said.
    unsafe {
        for splats in &all {
            assert_eq!(surfel_scene_add_splats(scene, splats), SurfelResult::Success, "{}", last());
        }
        assert_eq!(surfel_scene_add_mesh(scene, &mesh), SurfelResult::Success, "{}", last());
        let light = c"direction=0,0,-1".as_ptr();
        assert_eq!(surfel_scene_add_light(scene, light), SurfelResult::Success, "{}", last());
        assert_eq!(surfel_scene_transform(scene, turned.as_ptr()), SurfelResult::Success, "{}", last());
        let answer = surfel_scene_ball(scene, center.as_mut_ptr(), &mut radius);
        assert_eq!(answer, SurfelResult::Success, "{}", last());
        let Scene { objects, rooms, epsilons, meshes, .. } = &(*scene).0;
        assert!((*scene).0.without_auto_epsilon);
        let lengths = [None, Some(Epsilon::Length(0.5)), Some(Epsilon::Radii(2.0)), Some(Epsilon::Auto)];
        assert_eq!(*epsilons, lengths);
        assert_eq!([objects.len(), rooms.len(), epsilons.len(), meshes.len()], [4, 1, 4, 1]);
        assert_eq!(objects[0].splats.positions[1].to_array(), [5.0, 8.0, 7.0]);
        tells_what_it_holds(scene, &clips);
        assert_eq!(rooms[0].as_ref().map(|room| room.splats), Some(7));
        surfel_scene_destroy(scene);
    }
    assert!(radius > 2.0 && center[0] < 5.0, "{center:?} {radius}");
}

#[test]
fn levels_come_as_arrays() {
    let (own, nodes) = (disks(), ellipses(2));
    let balls = [0.5, 0.25].map(|spread| SurfelErrorBall { center: [0.0; 3], radius: 1.0, spread });
    let levels = SurfelLevels {
        splats: &own,
        splat_parents: [1_u32, 1, 0].as_ptr(),
        nodes: &nodes,
        node_parents: [u32::MAX, 0].as_ptr(),
        balls: balls.as_ptr(),
        ..plain()
    };
    let scene = scene(std::ptr::null());
    // SAFETY: a scene that was made, and arrays of as many as is said.
    unsafe {
        assert_eq!(surfel_scene_add_levels(scene, &levels), SurfelResult::Success, "{}", last());
        let beyond = [1_u32, 2, 0];
        let wrong = SurfelLevels { splat_parents: beyond.as_ptr(), ..levels };
        assert_eq!(surfel_scene_add_levels(scene, &wrong), SurfelResult::InvalidArgument);
        assert_eq!((*scene).0.leveled.len(), 1);
        surfel_scene_destroy(scene);
    }
}

/// Of the scene above.
///
/// # Safety
/// A scene that was made, of no less.
unsafe fn tells_what_it_holds(scene: *const SurfelScene, clips: &[SurfelClip; 3]) {
    let (mut contents, mut least, mut most) = (plain::<SurfelSceneContents>(), [0.0; 3], [0.0; 3]);
    let (mut told, mut others) = (plain::<SurfelSplats>(), [zeroed_clip(); 3]);
    // SAFETY: this function's contract; and room for all that is told.
    let (tangents, colors) = unsafe {
        assert_eq!(surfel_scene_contents(scene, &mut contents), SurfelResult::Success, "{}", last());
        let answer = surfel_scene_bounds(scene, least.as_mut_ptr(), most.as_mut_ptr());
        assert_eq!(answer, SurfelResult::Success, "{}", last());
        let answer = surfel_scene_object_splats(scene, 2, &mut told);
        assert_eq!(answer, SurfelResult::Success, "{}", last());
        let answer = surfel_scene_object_clips(scene, 2, 0, 3, others.as_mut_ptr());
        assert_eq!(answer, SurfelResult::Success, "{}", last());
        let tangents = std::slice::from_raw_parts(told.tangents_s.cast::<[f32; 3]>(), 3);
        (tangents, std::slice::from_raw_parts(told.colors.cast::<[f32; 4]>(), told.color_count as usize))
    };
    assert_eq!([contents.objects, contents.meshes, contents.lights, contents.splats], [4, 1, 1, 9]);
    assert!(least.iter().zip(most).all(|(least, most)| *least < most), "{least:?} {most:?}");
    assert_eq!(tangents[0], [0.0, 1.0, 0.0]);
    assert!(colors.len() == 1 && told.count == 3 && told.normals.is_null() && told.closed == vk::FALSE);
    let counts = |clips: &[SurfelClip; 3]| clips.each_ref().map(|clip| clip.curve_count);
    assert_eq!(counts(&others), counts(clips));
}

/// A struct of an older header lies in as much memory as that says, and not one byte more is read; of a newer one what is beyond must be zero.
#[test]
fn structs_of_other_versions_are_read_as_far_as_they_go() {
    #[repr(C)]
    struct Newer {
        known: SurfelSceneInfo,
        beyond: [u64; 2],
    }
    const OLD_BYTES: usize = 24;
    let old = SurfelSceneInfo { levels: vk::TRUE, size: OLD_BYTES as u32, ..plain() };
    // No more memory than that.
    let mut short = vec![0_u64; OLD_BYTES / 8];
    // SAFETY: both have so many bytes, none of which is padding.
    unsafe {
        let from = std::ptr::from_ref(&old).cast::<u8>();
        from.copy_to_nonoverlapping(short.as_mut_ptr().cast(), OLD_BYTES);
    }
    let made = scene(short.as_ptr().cast());
    // SAFETY: made by C's call, here and below.
    let levels = unsafe { (*made).0.levels };
    assert!(levels);
    // SAFETY: as above.
    unsafe { surfel_scene_destroy(made) };
    for (last_word, expected) in [(0, SurfelResult::Success), (1, SurfelResult::NewerStruct)] {
        let size = size_of::<Newer>() as u32;
        let newer = Newer { known: SurfelSceneInfo { size, ..plain() }, beyond: [0, last_word] };
        let mut scene = null_mut();
        // SAFETY: it has the size that it says.
        let answer = unsafe { surfel_scene_create((&raw const newer).cast(), &mut scene) };
        assert_eq!(answer, expected, "{}", last());
        // SAFETY: NULL, or made.
        unsafe { surfel_scene_destroy(scene) };
    }
    let next = SurfelStructureType::Frame as u32;
    let chained = SurfelSceneInfo { p_next: (&raw const next).cast(), ..plain() };
    let mut scene = null_mut();
    // SAFETY: `pNext` leads to what begins as structs do.
    let answer = unsafe { surfel_scene_create(&chained, &mut scene) };
    assert!(answer == SurfelResult::UnknownStruct && scene.is_null());
}

#[test]
fn what_can_be_seen_to_be_wrong_is_an_error_and_leaves_the_scene_as_it_was() {
    let scene = scene(std::ptr::null());
    let odd = CENTERS.as_ptr().cast::<u8>().wrapping_add(1).cast();
    let curves = SurfelClip { curve_count: 3, ..zeroed_clip() };
    let clips = [curves; 3];
    let wrong = [
        (SurfelSplats { centers: std::ptr::null(), ..disks() }, "centers is NULL"),
        (SurfelSplats { centers: odd, ..disks() }, "centers is not aligned"),
        (SurfelSplats { count: u64::MAX, ..disks() }, "don't fit into memory"),
        (SurfelSplats { color_count: 2, ..disks() }, "colorCount is 2"),
        (SurfelSplats { radii: std::ptr::null(), ..disks() }, "radii is NULL"),
        (SurfelSplats { tangents_s: TANGENTS[0].as_ptr().cast(), ..disks() }, "expected normals and radii"),
        (SurfelSplats { name: c"\xff".as_ptr(), ..disks() }, "name is not UTF-8"),
        (SurfelSplats { clips: clips.as_ptr(), ..disks() }, "curveCount is 3"),
        (SurfelSplats { epsilon: -1.0, ..disks() }, "epsilon"),
        (SurfelSplats { reserved: 1, ..disks() }, "reserved is 1"),
        (SurfelSplats { reserved_too: 1, ..disks() }, "reserved is 1"),
        (SurfelSplats { auto_epsilon: vk::TRUE, epsilon: 0.5, ..disks() }, "autoEpsilon, and a number"),
    ];
    // SAFETY: a scene that was made; what is given is NULL, not aligned, or as said as far as it is read.
    unsafe {
        for (splats, expected) in &wrong {
            assert_ne!(surfel_scene_add_splats(scene, splats), SurfelResult::Success, "{expected}");
            assert!(last().contains(expected), "{}: {expected}", last());
        }
        assert_ne!(surfel_scene_set(scene, c"none".as_ptr(), c"1".as_ptr()), SurfelResult::Success);
        assert_eq!(surfel_scene_set(scene, std::ptr::null(), c"1".as_ptr()), SurfelResult::InvalidArgument);
        assert!((*scene).0.objects.is_empty() && (*scene).0.epsilons.is_empty());
        surfel_scene_destroy(scene);
        surfel_scene_destroy(null_mut());
    }
}

fn zeroed_clip() -> SurfelClip {
    let curve = SurfelClipCurve { start_rad: 0.0, end_rad: 0.0, middle: [0.0; 2], weight: 0.0 };
    SurfelClip { curve_count: 0, both: vk::FALSE, curves: [curve; 2] }
}

#[test]
fn settings_are_set_by_words() {
    let mut settings = null_mut();
    // SAFETY: made by the first call, and texts that end.
    unsafe {
        assert_eq!(surfel_settings_create(&mut settings), SurfelResult::Success);
        let set = |name: &CStr, value: &CStr| surfel_settings_set(settings, name.as_ptr(), value.as_ptr());
        assert_eq!(set(c"rasterizer", c"quad"), SurfelResult::Success, "{}", last());
        assert_eq!(set(c"rasterizer", c"none of them"), SurfelResult::Option);
        assert_eq!(set(c"nothing", c"1"), SurfelResult::Option);
        surfel_settings_destroy(settings);
        assert_eq!(surfel_settings_create(null_mut()), SurfelResult::InvalidArgument);
    }
}
