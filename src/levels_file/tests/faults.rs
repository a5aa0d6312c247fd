//! Files with faults: cut, changed, and made by somebody who means harm. None is read, none panics, and none takes more memory than its
//! bytes account for.

use super::*;
use crate::{error::ErrorKind, scene::LeveledObject};

/// Bytes of memory that what was read of a file has, with the room left in it.
fn held(object: &LeveledObject) -> usize {
    let splats = |splats: &Splats| {
        let shapes = match &splats.shapes {
            Shapes::Disks { normals, radii } => normals.capacity() * 12 + radii.capacity() * 4,
            Shapes::Ellipses { s, t } => (s.capacity() + t.capacity()) * 12,
        };
        let colors = if let Colors::Each(colors) = &splats.colors { colors.capacity() * 16 } else { 0 };
        splats.positions.capacity() * 24 + shapes + colors
    };
    let numbers = object.leaf_parents.capacity() * 4 + object.node_balls.capacity() * 8;
    splats(&object.leaves)
        + splats(&object.nodes)
        + numbers
        + object.balls.capacity() * 20
        + object.weights.capacity() * 4
}

/// Reads all of it. What is read holds together; what is refused is refused in one line that names the file.
fn attempt(bytes: &[u8]) -> std::result::Result<(), String> {
    match loaded(bytes) {
        Ok(chosen) => {
            let object = chosen.object;
            // A splat with 12 bytes of colors has 16 of them in memory, and its position twice as many.
            assert!(held(&object) <= 2 * bytes.len(), "{} of {}", held(&object), bytes.len());
            let parents =
                object.leaf_parents.iter().chain(object.node_balls.iter().map(|balls| &balls.parent));
            assert!(parents.copied().all(|parent| (parent as usize) < object.balls.len()));
            let sound = |splats: &Splats| (0..splats.len()).all(|i| splats.defect(i).is_none());
            assert!(sound(&object.leaves) && sound(&object.nodes));
            assert_eq!(object.leaves.len(), object.leaf_parents.len());
            assert_eq!(object.nodes.len(), object.node_balls.len());
            Ok(())
        }
        Err(error) => {
            let text = error.to_string();
            let is_input = matches!(error.kind(), ErrorKind::Input { .. });
            assert!(is_input && text.starts_with("a.surfel: ") && !text.contains('\n'), "{text}");
            Err(text)
        }
    }
}

#[test]
fn a_file_that_is_cut_anywhere_is_refused() {
    for object in [relief(60), relief(1)] {
        let bytes = written(&object);
        for end in 0..bytes.len() {
            attempt(&bytes[..end]).unwrap_err();
            // Also where somebody puts the checksums right.
            let mut cut = bytes[..end].to_vec();
            sign(&mut cut);
            attempt(&cut).unwrap_err();
        }
        attempt(&bytes).unwrap();
        attempt(&[&bytes[..], &[0]].concat()).unwrap_err();
    }
}

/// What was not written to its end has no header yet.
#[test]
fn a_file_without_its_header_is_refused() {
    let mut bytes = written(&relief(60));
    bytes[..HEADER_BYTES].fill(0);
    assert!(attempt(&bytes).unwrap_err().contains("does not begin as a hierarchy does"));
}

#[test]
fn each_byte_is_covered_by_a_checksum() {
    let bytes = written(&relief(40));
    for at in 0..bytes.len() {
        for bit in [0, 7] {
            let mut changed = bytes.clone();
            changed[at] ^= 1 << bit;
            attempt(&changed).unwrap_err();
        }
    }
}

#[test]
fn changed_files_with_the_right_checksums_neither_panic_nor_take_memory() {
    let files: Vec<_> = objects()
        .iter()
        .map(|object| {
            let few = object.splats.picked(0..object.splats.len().min(50));
            written(&Object { name: String::new(), splats: few, closed: false })
        })
        .collect();
    let mut random = SplitMix(11);
    let mut below = |most: usize| (random.bits() % most.max(1) as u64) as usize;
    let (mut read, cases) = (0, 30_000);
    for case in 0..cases {
        let mut bytes = files[case % files.len()].clone();
        for _ in 0..=below(3) {
            let table = u64::from_le_bytes(bytes[32..40].try_into().unwrap()) as usize;
            // Header, table or all: most bytes are those of pages.
            let (from, to) = [(0, 256), (table.min(bytes.len()), bytes.len()), (0, bytes.len())][below(3)];
            let at = (from + below(to - from)).min(bytes.len() - 1);
            let end = (at + 4).min(bytes.len());
            match below(6) {
                0 => bytes[at] ^= 1 << below(8),
                1 => bytes[at] = below(256) as u8,
                2 => bytes[at..end].fill([0, 0xff, 0x7f, 0x80][below(4)]),
                3 => bytes[at] = bytes[at].wrapping_add(1),
                4 if bytes.len() > HEADER_BYTES + ENTRY_BYTES => {
                    // An entry or a part of a page twice.
                    let part = bytes[at..(at + ENTRY_BYTES).min(bytes.len())].to_vec();
                    bytes.splice(at..at, part);
                }
                _ => {
                    let kept = below(bytes.len()).max(HEADER_BYTES);
                    bytes.truncate(kept);
                }
            }
        }
        sign(&mut bytes);
        read += usize::from(attempt(&bytes).is_ok());
    }
    // Some changes mean nothing worse than another color: the checks do not refuse all there is.
    assert!(read > cases / 100 && read < cases / 2, "{read}");
}

/// Puts a value into a file and its checksums right.
fn with<const N: usize>(bytes: &[u8], at: usize, value: [u8; N]) -> Vec<u8> {
    let mut changed = bytes.to_vec();
    changed[at..at + N].copy_from_slice(&value);
    sign(&mut changed);
    changed
}

#[test]
fn hostile_values_are_refused_with_their_place() {
    let bytes = written(&relief(60));
    let all = pages(&bytes);
    let table = bytes.len() - all.len() * ENTRY_BYTES;
    let entry = |page: usize, at: usize| table + page * ENTRY_BYTES + at;
    let leaf_page = all.iter().position(|page| !page.nodes).unwrap();
    let node_page = all.iter().position(|page| page.nodes && page.count > 1).unwrap();
    let (leaves, nodes) = (&all[leaf_page], &all[node_page]);
    let parent_of_first = leaves.at as usize + leaves.count as usize * (12 + 16 + 12 + 2);
    let overlap_of_first = parent_of_first - leaves.count as usize * 2;
    let own_of_first = nodes.at as usize + nodes.count as usize * (12 + 24 + 12);
    let [nan, huge] = [f64::NAN, 1e300].map(f64::to_le_bytes);
    let cases: Vec<(Vec<u8>, String)> = vec![
        (with(&bytes, 8, 1_u32.to_le_bytes()), "header: version 1; expected 2".to_owned()),
        (with(&bytes, 12, 1_u32.wrapping_shl(5).to_le_bytes()), "header: flags or bytes".to_owned()),
        (with(&bytes, 200, [1]), "header: flags or bytes".to_owned()),
        (with(&bytes, 16, u64::MAX.to_le_bytes()), "table of pages: 60 splats".to_owned()),
        (with(&bytes, 16, 0_u64.to_le_bytes()), "header: 0 splats below".to_owned()),
        (with(&bytes, 24, u64::MAX.to_le_bytes()), "header: 60 splats below".to_owned()),
        (
            with(&bytes, 32, u64::MAX.to_le_bytes()),
            "pages with a table at byte 18446744073709551615".to_owned(),
        ),
        (with(&bytes, 32, 0_u64.to_le_bytes()), "pages with a table at byte 0".to_owned()),
        (with(&bytes, 40, u32::MAX.to_le_bytes()), "header: 4294967295 pages".to_owned()),
        (with(&bytes, 48, nan), "header: within".to_owned()),
        (with(&bytes, 72, huge), "header: within".to_owned()),
        (with(&bytes, 120, nan), "header: a length".to_owned()),
        (with(&bytes, 136, 0.09_f64.to_le_bytes()), "expected 0.1 at least".to_owned()),
        (with(&bytes, entry(1, 0), 256_u64.to_le_bytes()), "page 1: ".to_owned()),
        (with(&bytes, entry(1, 0), u64::MAX.to_le_bytes()), "page 1: ".to_owned()),
        (
            with(&bytes, entry(0, 8), u32::MAX.to_le_bytes()),
            "page 0: 4294967295 bytes at byte 256".to_owned(),
        ),
        (with(&bytes, entry(0, 16), u32::MAX.to_le_bytes()), "page 0: 4294967295 splats".to_owned()),
        (with(&bytes, entry(0, 16), 0_u32.to_le_bytes()), "page 0: 0 splats".to_owned()),
        (with(&bytes, entry(0, 20), 4_u32.to_le_bytes()), "page 0: flags".to_owned()),
        (with(&bytes, entry(0, 24), 0_u32.to_le_bytes()), "with 0 parents".to_owned()),
        (with(&bytes, entry(1, 28), 1_u32.to_le_bytes()), "page 1: flags".to_owned()),
        (with(&bytes, entry(0, 32), nan), "page 0: bounds".to_owned()),
        (with(&bytes, entry(0, 56), (-1.0_f64).to_le_bytes()), "page 0: bounds".to_owned()),
        // Bounds that hide what is in the page.
        (
            with(&bytes, entry(leaf_page, 56), 1e-9_f64.to_le_bytes()),
            format!("page {leaf_page}: its splats are beyond"),
        ),
        (
            with(&bytes, entry(node_page, 64), 0_f64.to_le_bytes()),
            format!("page {node_page}: its splats are beyond"),
        ),
        (with(&bytes, entry(leaf_page, 120), 0_f64.to_le_bytes()), format!("page {leaf_page}: ")),
        (
            with(&bytes, leaves.at as usize, f32::NAN.to_le_bytes()),
            format!("page {leaf_page}: splat 0 can't be drawn"),
        ),
        (
            with(&bytes, parent_of_first, u16::MAX.to_le_bytes()),
            format!("page {leaf_page}: splat 0 is below parent 65535"),
        ),
        (
            with(&bytes, overlap_of_first, 0_u16.to_le_bytes()),
            format!("page {leaf_page}: splat 0 has an overlap without end"),
        ),
        (
            with(&bytes, own_of_first, f32::NAN.to_le_bytes()),
            format!("page {node_page}: node 0 has a ball or a weight"),
        ),
        // A node that is its own parent's parent would be larger than that.
        (
            with(&bytes, own_of_first + 20, 1e9_f32.to_le_bytes()),
            format!("page {node_page}: node 0 has a ball"),
        ),
    ];
    for (i, (changed, expected)) in cases.into_iter().enumerate() {
        let found = attempt(&changed).expect_err(&format!("case {i}: {expected}"));
        assert!(found.contains(&expected), "case {i}: {found}; expected {expected}");
    }
}
