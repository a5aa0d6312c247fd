//! Binary bodies, compared with what another reader finds in them.

use std::io::Cursor;

use glam::{DVec3, Vec3};
use ply_rs_bw::{
    parser::Parser,
    ply::{DefaultElement, Property},
};
use proptest::prelude::*;

use super::*;
use crate::{math::srgb::linear_from_srgb, scene::Shapes};

const TYPES: [(&str, usize); 8] = [
    ("char", 1),
    ("uint8", 1),
    ("int16", 2),
    ("ushort", 2),
    ("int", 4),
    ("uint32", 4),
    ("float", 4),
    ("float64", 8),
];

/// The properties that are looked at, and of which bytes are colors.
const NAMES: [&str; 10] = ["x", "y", "z", "nx", "ny", "nz", "radius", "red", "green", "blue"];

/// A file of `count` vertices with random bytes. `types` are those of [`NAMES`]; `others` are where further properties
/// stand, of which type, and whether they are lists.
fn file(
    big: bool,
    count: usize,
    order: &[usize],
    types: &[usize],
    others: &[(usize, usize, bool)],
) -> Vec<u8> {
    let order_name = if big { "big" } else { "little" };
    let mut header = format!("ply\nformat binary_{order_name}_endian 1.0\nelement vertex {count}\n");
    let mut sizes = Vec::new();
    let mut property = |name: &str, (kind, bytes): (&str, usize), is_list: bool| {
        header += &format!("property {}{kind} {name}\n", if is_list { "list uchar " } else { "" });
        sizes.push((bytes, is_list));
    };
    for (place, &named) in order.iter().enumerate() {
        for (i, other) in others.iter().enumerate().filter(|(_, other)| other.0 == place) {
            property(&format!("other_{i}"), TYPES[other.1], other.2);
        }
        let kind = if named >= 7 { TYPES[1] } else { TYPES[types[named]] };
        property(NAMES[named], kind, false);
    }
    let mut bytes = format!("{header}end_header\n").into_bytes();
    let mut state = 0x9E37_79B9_u32;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        (state >> 8) as u8
    };
    for _ in 0..count {
        for &(size, is_list) in &sizes {
            let items = if is_list { usize::from(random() % 4) } else { 1 };
            bytes.extend(is_list.then_some(items as u8));
            bytes.extend((0..items * size).map(|_| random()));
        }
    }
    bytes
}

fn value(element: &DefaultElement, name: &str) -> f64 {
    match element[name] {
        Property::Char(v) => v.into(),
        Property::UChar(v) => v.into(),
        Property::Short(v) => v.into(),
        Property::UShort(v) => v.into(),
        Property::Int(v) => v.into(),
        Property::UInt(v) => v.into(),
        Property::Float(v) => v.into(),
        Property::Double(v) => v,
        _ => panic!("{name} is a list"),
    }
}

/// Bit for bit, but for which NaN it is.
fn same(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn any_layout_gives_what_another_reader_gives(
        big in any::<bool>(),
        count in prop_oneof![0..40_usize, 1020..1030_usize],
        order in Just((0..NAMES.len()).collect::<Vec<_>>()).prop_shuffle(),
        types in prop::collection::vec(0..TYPES.len(), 7),
        others in prop::collection::vec((0..NAMES.len(), 0..TYPES.len(), any::<bool>()), 0..4),
    ) {
        let bytes = file(big, count, &order, &types, &others);
        let splats = splats(&bytes);
        let Shapes::Disks { normals, radii } = &splats.shapes else { panic!("disks") };
        let theirs = Parser::<DefaultElement>::new().read_ply(&mut Cursor::new(&bytes)).unwrap();
        let theirs = &theirs.payload["vertex"];
        prop_assert_eq!(theirs.len(), splats.len());
        for (i, vertex) in theirs.iter().enumerate() {
            let get = |name: &str| value(vertex, name);
            let position = DVec3::new(get("x"), get("y"), get("z"));
            prop_assert!(same(&splats.positions[i].to_array(), &position.to_array()));
            let normal = Vec3::new(get("nx") as f32, get("ny") as f32, get("nz") as f32).as_dvec3();
            prop_assert!(same(&normals[i].as_dvec3().to_array(), &normal.to_array()));
            prop_assert!(same(&[radii[i].into()], &[(get("radius") as f32).into()]));
            let color = ["red", "green", "blue"].map(|name| linear_from_srgb(get(name) as f32 / 255.0));
            prop_assert_eq!(&splats.color(i)[..3], &color[..]);
        }
    }
}
