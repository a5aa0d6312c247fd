//! Meshes without traps, compared with what the crate `tobj` finds in them.

use proptest::prelude::*;

use super::*;

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, ..ProptestConfig::default() })]

    #[test]
    fn meshes_are_what_another_reader_gives(
        vertices in prop::collection::vec(prop::array::uniform3(-1e6..1e6_f64), 3..20),
        normals in prop::collection::vec(prop::array::uniform3(0.5..1.0_f64), 1..5),
        faces in prop::collection::vec(
            prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), any::<bool>()), 3..6),
            1..10,
        ),
    ) {
        let mut text = String::new();
        for [x, y, z] in &vertices {
            text += &format!("v {x} {y} {z}\n");
        }
        for [x, y, z] in &normals {
            text += &format!("vn {x} {y} {z}\n");
        }
        for face in &faces {
            text += "f";
            for (vertex, normal, from_end) in face {
                let back = |i: usize, count: usize| if *from_end { i as i64 - count as i64 } else { i as i64 + 1 };
                let vertex = back(vertex.index(vertices.len()), vertices.len());
                let normal = back(normal.index(normals.len()), normals.len());
                text += &format!(" {vertex}//{normal}");
            }
            text += "\n";
        }
        let options = tobj::LoadOptions { triangulate: true, ..tobj::LoadOptions::default() };
        let no_materials = |_: &Path| Err(tobj::LoadError::OpenFileFailed);
        let (theirs, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, no_materials).unwrap();
        let theirs = &theirs[0].mesh;
        let ours = mesh(&text);
        let positions: Vec<f64> = ours.positions.iter().flat_map(|p| p.to_array()).collect();
        prop_assert_eq!(&positions, &theirs.positions);
        prop_assert_eq!(ours.triangles.as_flattened(), &theirs.indices);
        let their_normals = theirs.normal_indices.iter().map(|&i| {
            DVec3::from_slice(&theirs.normals[3 * i as usize..]).normalize()
        });
        // Each corner's normal is one of those that its vertex's is the mean of.
        for (&vertex, normal) in theirs.indices.iter().zip(their_normals) {
            let mean = ours.normals.as_ref().unwrap()[vertex as usize].as_dvec3();
            prop_assert!(mean.dot(normal) > 0.5 && (mean.length() - 1.0).abs() < 1e-6);
        }
    }
}
