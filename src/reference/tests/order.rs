//! The order in which things are listed changes nothing but rounding.

use super::*;
use crate::scene::{LastLayer, Layers, Transition};

fn shuffle<T>(list: &mut [T], random: &mut Random) {
    for i in (1..list.len()).rev() {
        list.swap(i, random.within(0.0, (i + 1) as f64) as usize);
    }
}

/// Opaque and transparent objects of splats, and such meshes, through one another.
fn crowd(random: &mut Random, shuffles: Option<&mut Random>) -> Scene {
    let mut lists = Vec::new();
    let mut triangles = Vec::new();
    for object in 0..6 {
        let alpha = |random: &mut Random| if object % 3 == 0 { 1.0 } else { random.within(0.0, 1.0) as f32 };
        let color = |random: &mut Random| [0; 3].map(|_| random.within(0.0, 1.0) as f32);
        let list: Vec<Ellipse> = (0..25)
            .map(|_| {
                let (center, s, t, _) = random_ellipse(random, 0.4, 2.0);
                let [red, green, blue] = color(random);
                (center, s, t, [red, green, blue, alpha(random)])
            })
            .collect();
        lists.push(list);
        let of_mesh: Vec<_> = (0..6)
            .map(|_| {
                let center = random_ellipse(random, 0.1, 1.0).0;
                [0; 3].map(|_| (center + center.z * 0.9 * random.direction(), Vec3::NEG_Z))
            })
            .collect();
        let [red, green, blue] = color(random);
        triangles.push((of_mesh, [red, green, blue, alpha(random)]));
    }
    if let Some(random) = shuffles {
        lists.iter_mut().for_each(|list| shuffle(list, random));
        shuffle(&mut lists, random);
        triangles.iter_mut().for_each(|(list, _)| shuffle(list, random));
        shuffle(&mut triangles, random);
    }
    let mut scene = objects(&lists.iter().map(Vec::as_slice).collect::<Vec<_>>());
    for (list, color) in triangles {
        let vertices: Vec<_> = list.concat();
        let indices: Vec<_> = (0..list.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        scene.meshes.push(mesh(&vertices, &indices, color));
    }
    scene
}

#[test]
fn shuffled_objects_splats_and_triangles_give_the_same_picture() {
    let scene = crowd(&mut Random(3), None);
    let shuffled = crowd(&mut Random(3), Some(&mut Random(4)));
    assert_ne!(scene.objects[0].splats.positions, shuffled.objects[0].splats.positions);
    let cases = [
        (Layers::Fixed(256), LastLayer::Blend, Transition::Color),
        (Layers::Fixed(3), LastLayer::Blend, Transition::Attributes),
        (Layers::Fixed(3), LastLayer::Drop, Transition::Paper),
    ];
    for (layers, last_layer, transition) in cases {
        let epsilon = Epsilon::Radii(0.3);
        let settings = Settings { layers, last_layer, transition, epsilon, background: None, ..settings(48) };
        let (a, b) = (picture(&scene, &settings), picture(&shuffled, &settings));
        let mut seen = [0; 3];
        for (a, b) in a.pixels.iter().zip(&b.pixels) {
            assert!((0..4).all(|i| (a.color[i] - b.color[i]).abs() < 1e-12), "{a:?} {b:?}");
            assert!((a.weight - b.weight).abs() < 1e-12);
            assert_eq!((a.layers, a.polygon, a.rim), (b.layers, b.polygon, b.rim));
            // The mean of the radii is a sum too.
            assert!(
                a.epsilon_margin == b.epsilon_margin || (a.epsilon_margin - b.epsilon_margin).abs() < 1e-12
            );
            assert_eq!(a.border_px, b.border_px);
            seen[0] += usize::from(a.layers > 3);
            seen[1] += usize::from(a.polygon && a.weight > 0.0);
            seen[2] += usize::from(a.weight > 0.0 && a.layers > 0);
        }
        assert!(seen.iter().all(|count| *count > 50), "{seen:?}");
    }
}
