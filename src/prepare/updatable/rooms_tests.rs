use glam::{DVec3, Vec3};

use super::super::{Block, BlockTree, PreparedScene, prepare_without_device};
use crate::{
    math::random::SplitMix,
    scene::{Colors, Object, Room, Scene, Shapes, Splats},
    vk::Limits,
};

const OWN: u32 = 1000;
const ROOM: u32 = 1500;

fn disks(numbers: std::ops::Range<u32>) -> Splats {
    let at = |i: u32| {
        let turn = 0.37 * f64::from(i);
        DVec3::new(turn.cos(), 0.002 * f64::from(i) - 1.0, turn.sin())
    };
    let positions: Vec<_> = numbers.map(at).collect();
    let normals = positions.iter().map(|at| (at.as_vec3() + 0.01 * Vec3::X).normalize()).collect();
    let shapes = Shapes::Disks { normals, radii: vec![0.05; positions.len()] };
    Splats::new(positions, shapes, Colors::Uniform([0.5, 0.25, 0.75, 1.0]))
}

fn scene(splats: Splats, room: Option<Room>) -> Scene {
    let objects = vec![Object { name: "spiral".to_owned(), splats, closed: false }];
    Scene { objects, updatable: true, numbered: true, rooms: vec![room], ..Scene::default() }
}

fn room() -> Option<Room> {
    Some(Room { splats: ROOM, ..Room::default() })
}

fn prepared(scene: &Scene) -> PreparedScene {
    prepare_without_device(&Limits::plain(), scene).unwrap()
}

/// What the scene has is what a list of its numbers says, after each of many changes; and bounds are those that blocks have together.
#[test]
fn numbers_stay_whatever_comes_and_goes() {
    let mut seen = prepared(&scene(disks(0..OWN), room()));
    let mut is_there: Vec<bool> = (0..OWN + ROOM).map(|number| number < OWN).collect();
    let mut random = SplitMix(3);
    let mut below = |end: u32| (random.unit() * f64::from(end)) as u32;
    for round in 0..400 {
        let first = below(OWN + ROOM);
        let numbers = first..first + below(OWN + ROOM - first + 1).min(300);
        let last_of_room = (OWN..OWN + ROOM).rev().find(|number| is_there[*number as usize]);
        let end = last_of_room.map_or(OWN, |last| last + 1);
        assert_eq!(seen.room_of(0), Some(OWN + ROOM - end), "round {round}");
        let filled = match round % 3 {
            0 => {
                seen.remove(None, 0, numbers.clone()).unwrap().apply(None);
                is_there[numbers.start as usize..numbers.end as usize].fill(false);
                continue;
            }
            1 => {
                seen.update(None, 0, numbers.start, &disks(numbers.clone())).unwrap().apply(None);
                numbers
            }
            _ => {
                let count = below(200).min(OWN + ROOM - end);
                let splats = disks(end..end + count);
                let (update, numbers) = seen.append(None, 0, &splats).unwrap();
                update.apply(None);
                assert_eq!(numbers, end..end + count);
                numbers
            }
        };
        is_there[filled.start as usize..filled.end as usize].fill(true);
        let expected = is_there.iter().filter(|is| **is).count() as u64;
        assert_eq!(seen.splat_count(), expected, "round {round}");
        for chunk in &seen.chunks {
            let (shadow, survey) = (chunk.shadow.as_ref().unwrap(), chunk.packing());
            for [number, place] in &shadow.places {
                assert_eq!(shadow.is_filled(*place, &survey), is_there[*number as usize], "{number}");
                assert_eq!(chunk.number_of(*place as usize), Some(*number));
                assert!(!is_there[*number as usize] || *place < chunk.count, "{number}");
                let center = chunk.rebase.point(disks(*number..number + 1).positions[0]);
                let block = &chunk.blocks[*place as usize / 256];
                let is_within = center.distance(block.center) <= block.radius + 1e-6;
                assert!(!is_there[*number as usize] || is_within, "{number}");
            }
            assert!(chunk.count == 0 || shadow.is_filled(chunk.count - 1, &survey), "no more than there are");
            let counts = chunk.blocks.iter().map(|block: &Block| block.count);
            assert_eq!(counts.sum::<u32>(), chunk.present());
            assert_eq!(format!("{:?}", chunk.tree), format!("{:?}", BlockTree::new(&chunk.blocks)));
            assert_eq!(chunk.radii.iter().map(|step| step.count).sum::<u32>(), chunk.count);
        }
    }
}

#[test]
fn what_has_no_room_is_refused_by_name_and_changes_nothing() {
    let mut seen = prepared(&scene(disks(0..OWN), room()));
    let append = |seen: &mut PreparedScene, object, splats: &Splats| {
        seen.append(None, object, splats).map(|_| ()).map_err(|error| error.to_string())
    };
    let many = disks(0..ROOM + 1);
    let words = "append: 1501 splats behind number 1000 of object 0: it has room up to 2500";
    assert_eq!(append(&mut seen, 0, &many).unwrap_err(), words);
    let words = "append: object 1 has no room: expected one that was uploaded with Scene::rooms";
    assert_eq!(append(&mut seen, 1, &disks(0..3)).unwrap_err(), words);
    let mut wrong = disks(0..3);
    wrong.positions[1].x = f64::NAN;
    assert!(append(&mut seen, 0, &wrong).unwrap_err().contains("splat 1001: "));
    let remove = |seen: &mut PreparedScene, numbers| {
        seen.remove(None, 0, numbers).map(|_| ()).map_err(|error| error.to_string())
    };
    for wrong in [2400..2501, std::ops::Range { start: 9, end: 8 }] {
        let words = format!("remove: {wrong:?} of object 0: expected numbers in order up to 2500");
        assert_eq!(remove(&mut seen, wrong).unwrap_err(), words);
    }
    assert_eq!((seen.splat_count(), seen.room_of(0), seen.room_of(1)), (1000, Some(1500), None));
    assert_eq!(remove(&mut seen, 1000..2500), Ok(()), "nobody is there");
    let mut plain = prepared(&scene(disks(0..OWN), None));
    assert!(remove(&mut plain, 0..1).unwrap_err().contains("no room"));
    assert!(!plain.chunks[0].sparse && plain.chunks.len() == 1);

    let refused = |scene: &Scene| prepare_without_device(&Limits::plain(), scene).err().unwrap().to_string();
    let with = |room: Room| refused(&scene(disks(0..OWN), Some(room)));
    let words = "room of object 0: expected a scene with Scene::updatable";
    assert_eq!(refused(&Scene { updatable: false, ..scene(disks(0..OWN), room()) }), words);
    let two = Scene { rooms: vec![None, room()], ..scene(disks(0..OWN), None) };
    assert_eq!(refused(&two), "room of object 1: the scene has 1 objects of splats");
    assert!(with(Room { splats: u32::MAX, ..Room::default() }).contains("numbers of 32 bits"));
    assert!(with(Room { around: Some(DVec3::NAN), ..Room::default() }).contains("around"));
    assert!(with(Room { overlap: Some(0.5), ..Room::default() }).contains("overlap"));
}

/// Of a transparent object without splats, and of one whose splats are more than a chunk has room for.
#[test]
fn room_has_the_kind_of_its_object_and_as_many_chunks_as_it_needs() {
    let mut none = disks(0..0);
    none.colors = Colors::Uniform([1.0, 1.0, 1.0, 0.5]);
    let mut seen = prepared(&scene(none, room()));
    assert!(seen.is_transparent() && seen.splat_count() == 0 && seen.chunks.len() == 1);
    assert_eq!(seen.append(None, 0, &disks(0..7)).unwrap().1, 0..7);

    let limits = Limits { max_storage_buffer_range: 48 * 400, ..Limits::plain() };
    let mut seen = prepare_without_device(&limits, &scene(disks(0..300), room())).unwrap();
    assert_eq!(seen.chunks.len(), 1 + ROOM.div_ceil(400) as usize);
    for part in [0..500, 500..1500] {
        let splats = disks(part.clone());
        let (update, numbers) = seen.append(None, 0, &splats).unwrap();
        update.apply(None);
        assert_eq!(numbers, part.start + 300..part.end + 300);
    }
    assert_eq!((seen.splat_count(), seen.room_of(0)), (1800, Some(0)));
}
