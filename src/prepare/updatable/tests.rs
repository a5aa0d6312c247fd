use glam::Vec3;

use super::*;
use crate::{
    prepare::{BlockTree, CHILDREN, block_tree::above, prepare_without_device},
    scene::{Colors, Object, Order, Scene, Shapes, SplatFormat, Storage},
    vk::Limits,
};

fn disks(count: usize, at: impl Fn(usize) -> DVec3, radius: impl Fn(usize) -> f32) -> Splats {
    let positions: Vec<_> = (0..count).map(&at).collect();
    let normals = positions.iter().map(|at| (at.as_vec3() + 0.01 * Vec3::X).normalize()).collect();
    let shapes = Shapes::Disks { normals, radii: (0..count).map(radius).collect() };
    Splats::new(positions, shapes, Colors::Uniform([0.5, 0.25, 0.75, 1.0]))
}

fn spiral(i: usize) -> DVec3 {
    let turn = 0.37 * i as f64;
    DVec3::new(turn.cos(), 0.002 * i as f64 - 1.0, turn.sin())
}

fn scene(splats: Splats) -> Scene {
    let object = Object { name: "spiral".to_owned(), splats, closed: false };
    Scene { objects: vec![object], updatable: true, ..Scene::default() }
}

/// The splats in 300 to 640 elsewhere, larger and smaller.
fn changed(count: usize) -> (Splats, Splats) {
    let is_moved = |i: usize| (300..640).contains(&i);
    let at = move |i: usize| if is_moved(i) { 3.0 * spiral(i) + DVec3::X } else { spiral(i) };
    let radius = move |i: usize| if is_moved(i) { 0.001 * (i - 290) as f32 } else { 0.05 };
    let whole = disks(count, at, radius);
    let part = disks(340, |i| at(i + 300), |i| radius(i + 300));
    (whole, part)
}

/// Bounds after an update hold all splats, and are those of an upload that lies in the same space.
#[test]
fn bounds_are_those_of_what_is_there_whatever_the_order() {
    for order in [Order::Input, Order::Morton] {
        let mut own = scene(disks(1000, spiral, |_| 0.05));
        own.storage = Storage { order, ..Storage::default() };
        let mut prepared = prepare_without_device(&Limits::plain(), &own).unwrap();
        let before = prepared.chunks[0].blocks.clone();
        let (whole, part) = changed(1000);
        let update = prepared.update(None, 0, 300, &part).unwrap();
        assert!(update.bytes() >= 340 * 40);
        update.apply(None);
        let chunk = &prepared.chunks[0];
        let shadow = chunk.shadow.as_ref().unwrap();
        let survey = chunk.packing();
        let mut largest = 0.0_f64;
        let mut least = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        for [number, place] in &shadow.places {
            let [center, radius] = [
                chunk.rebase.point(whole.positions[*number as usize]),
                DVec3::splat(whole.major_radius(*number as usize)),
            ];
            let radius = radius.x * chunk.rebase.scale;
            let block = &chunk.blocks[(place / BLOCK_SPLATS) as usize];
            assert!(center.distance(block.center) <= block.radius + 1e-6, "splat {number}");
            assert!(radius <= block.largest_radius * (1.0 + 1e-7), "splat {number}");
            largest = largest.max(radius);
            least = [least[0].min(center), least[1].max(center)];
            // Nor has any other been changed.
            let packed = pack::pack(&whole, std::iter::once(*number as usize), &survey, Beside::default());
            let [shape, _] = shadow.words(*place..place + 1, &survey);
            assert_eq!(shape[..16], bytemuck::cast_slice::<_, u8>(&packed.shapes)[..16], "splat {number}");
        }
        assert!((chunk.largest_radius - largest).abs() <= 1e-6 * largest);
        for (side, expected) in chunk.bounds.iter().zip(least) {
            assert!((*side - expected).length() < 1e-6, "{side} {expected}");
        }
        // What is above them holds the blocks.
        assert_eq!(chunk.tree.levels.len(), 1, "there are few");
        let many: Vec<_> = chunk.blocks.iter().cycle().take(90).cloned().collect();
        let mut all = above(&many);
        assert!(!all.is_empty());
        all.insert(0, many);
        for levels in all.windows(2) {
            assert_eq!(levels[1].len(), levels[0].len().div_ceil(CHILDREN));
            for (number, block) in levels[0].iter().enumerate() {
                let run = &levels[1][number / CHILDREN];
                assert!(run.center.distance(block.center) + block.radius <= run.radius + 1e-9, "{number}");
                assert!(block.largest_radius <= run.largest_radius, "{number}");
            }
        }
        let count: u32 = chunk.radii.iter().map(|step| step.count).sum();
        assert!(count == 1000 && chunk.radii.last().unwrap().radius >= largest);
        // And back: all is as it was.
        let back = disks(340, |i| spiral(i + 300), |_| 0.05);
        prepared.update(None, 0, 300, &back).unwrap().apply(None);
        for (block, before) in prepared.chunks[0].blocks.iter().zip(before) {
            assert_eq!((block.center, block.radius, block.axis), (before.center, before.radius, before.axis));
        }
    }
}

/// Of many blocks, of which few change, all that is above them, too, is what is made of them anew.
#[test]
fn what_is_above_the_blocks_is_that_of_the_blocks_that_are_there() {
    let mut prepared =
        prepare_without_device(&Limits::plain(), &scene(disks(50_000, spiral, |_| 0.05))).unwrap();
    for first in [0, 20_123, 49_500] {
        let part = disks(500, |i| (2.0 + 0.01 * i as f64) * spiral(i + first), |i| 0.01 * (i + 1) as f32);
        let before = format!("{:?}", prepared.chunks[0].tree);
        prepared.update(None, 0, first as u32, &part).unwrap().apply(None);
        let chunk = &prepared.chunks[0];
        assert!(chunk.tree.levels.len() > 2, "{}", chunk.tree.levels.len());
        let renewed = format!("{:?}", chunk.tree);
        assert!(renewed != before && renewed == format!("{:?}", BlockTree::new(&chunk.blocks)), "{first}");
    }
}

#[test]
fn what_is_no_update_is_refused_and_changes_nothing() {
    let mut prepared =
        prepare_without_device(&Limits::plain(), &scene(disks(1000, spiral, |_| 0.05))).unwrap();
    let before = prepared.chunks[0].bounds;
    let part = disks(10, |i| 5.0 * spiral(i), |_| 0.05);
    let mut refused = |object, first, splats: &Splats| {
        prepared.update(None, object, first, splats).err().unwrap().to_string()
    };
    assert!(refused(1, 0, &part).contains("object 1"));
    assert!(refused(0, 995, &part).contains("has 5 of the 10"));
    assert!(refused(0, u32::MAX, &part).contains("32 bits"));
    let mut wrong = part.clone();
    wrong.positions[3].y = f64::NAN;
    assert!(refused(0, 100, &wrong).contains("splat 103: "), "{}", refused(0, 100, &wrong));
    let mut wrong = part.clone();
    wrong.colors = Colors::Uniform([1.0, 1.0, 1.0, 0.5]);
    assert!(refused(0, 100, &wrong).contains("transparent"));
    let axes = [Vec3::X, Vec3::Y].map(|axis| vec![0.1 * axis; 10]);
    let [s, t] = axes;
    let shapes = Shapes::Ellipses { s, t };
    assert!(refused(0, 100, &Splats { shapes, ..part.clone() }).contains("expected disks"));
    // Lists of another length, as an upload refuses them.
    let of = |normals, radii| Shapes::Disks { normals: vec![Vec3::Z; normals], radii: vec![0.1; radii] };
    let colors = || Colors::Uniform([1.0; 4]);
    for (shapes, colors, words) in [
        (of(9, 10), colors(), "9 normals"),
        (of(10, 3), colors(), "3 radii"),
        (of(10, 11), colors(), "11 radii"),
        (of(10, 10), Colors::Each(vec![[1.0; 4]; 4]), "4 colors"),
    ] {
        let expected = format!("update: 10 positions, and {words}; expected as many");
        assert_eq!(refused(0, 100, &Splats { shapes, colors, ..part.clone() }), expected);
    }
    // So large that no camera could show the rest.
    let mut wrong = part.clone();
    let Shapes::Disks { radii, .. } = &mut wrong.shapes else { panic!("disks") };
    radii[2] = f32::MAX;
    assert!(refused(0, 100, &wrong).contains("splat 102: its radius"), "{}", refused(0, 100, &wrong));
    let mut wrong = part.clone();
    wrong.positions[4].x = 1e30;
    assert!(refused(0, 100, &wrong).contains("splat 104: it lies"), "{}", refused(0, 100, &wrong));
    assert_eq!(prepared.chunks[0].bounds, before);
    prepared.update(None, 0, 100, &part).unwrap().apply(None);
    assert_ne!(prepared.chunks[0].bounds, before);

    let mut plain = scene(disks(1000, spiral, |_| 0.05));
    plain.updatable = false;
    let mut plain = prepare_without_device(&Limits::plain(), &plain).unwrap();
    assert!(plain.update(None, 0, 100, &part).err().unwrap().to_string().contains("updatable"));
    let packed = Storage { format: SplatFormat::Packed, ..Storage::default() };
    let of = |scene: &Scene| prepare_without_device(&Limits::plain(), scene).err().unwrap().to_string();
    assert!(of(&Scene { storage: packed, ..scene(disks(9, spiral, |_| 0.05)) }).contains("packed"));
    assert!(of(&Scene { levels: true, ..scene(disks(9, spiral, |_| 0.05)) }).contains("levels"));
}
