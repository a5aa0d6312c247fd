//! Pages of hierarchies, as nodes.

use super::tree::{Entry, NodeKey, Span};

/// Bytes of an entry of COPC: level, x, y, z (i32), offset (u64), bytes and points (i32).
const COPC_ENTRY_BYTES: usize = 32;

/// Points of what is no node but a page.
const COPC_PAGE: i32 = -1;

/// Bytes of an entry of Potree: kind and mask of children (u8), points (u32), offset and bytes (u64).
const POTREE_ENTRY_BYTES: usize = 22;

/// The kind of an entry of Potree that is no node but a page.
const POTREE_PROXY: u8 = 2;

fn word<const N: usize>(bytes: &[u8], at: usize) -> [u8; N] {
    bytes.get(at..).and_then(|rest| rest.first_chunk()).copied().unwrap_or([0; N])
}

/// The entries of a page, which has only whole ones.
fn entries(bytes: &[u8], size: usize) -> Result<std::slice::ChunksExact<'_, u8>, String> {
    match bytes.len() % size {
        0 => Ok(bytes.chunks_exact(size)),
        _ => Err(format!("{} bytes; expected entries of {size}", bytes.len())),
    }
}

/// COPC: the key of each node stands beside it.
pub(super) fn of_copc(bytes: &[u8]) -> Result<Vec<(NodeKey, Entry)>, String> {
    let entry = |(number, entry): (usize, &[u8])| {
        let int = |at: usize| i32::from_le_bytes(word(entry, at));
        let at = [int(4), int(8), int(12)];
        let Some(key) = NodeKey::new(int(0).into(), at.map(i64::from)) else {
            let [x, y, z] = at;
            return Err(format!("entry {number}: no octree has a node {}-{x}-{y}-{z}", int(0)));
        };
        let (bytes, points) = (int(24), int(28));
        let refuse = |problem: String| Err(format!("entry {number}, node {key}: {problem}"));
        let Ok(size) = u64::try_from(bytes) else {
            return refuse(format!("{bytes} bytes; expected 0 or more"));
        };
        let span = Span { at: u64::from_le_bytes(word(entry, 16)), bytes: size };
        match (points, u32::try_from(points)) {
            (COPC_PAGE, _) => Ok((key, Entry::Page(span))),
            (_, Ok(points)) => Ok((key, Entry::Node { points, span })),
            _ => refuse(format!("{points} points; expected -1 for a page, or 0 or more")),
        }
    };
    entries(bytes, COPC_ENTRY_BYTES)?.enumerate().map(entry).collect()
}

/// Potree: one level after the other, each node's children by its mask; its bytes are those of its points' records, where these are not compressed.
pub(super) fn of_potree(
    bytes: &[u8],
    root: NodeKey,
    record_bytes: Option<u64>,
) -> Result<Vec<(NodeKey, Entry)>, String> {
    let entries = entries(bytes, POTREE_ENTRY_BYTES)?;
    let count = entries.len();
    let mut keys = vec![root];
    let mut found = Vec::with_capacity(count);
    for (number, entry) in entries.enumerate() {
        let Some(key) = keys.get(number).copied() else { break };
        let refuse = |problem: String| Err(format!("entry {number}, node {key}: {problem}"));
        let [kind, mask] = word(entry, 0);
        let points = u32::from_le_bytes(word(entry, 2));
        let span =
            Span { at: u64::from_le_bytes(word(entry, 6)), bytes: u64::from_le_bytes(word(entry, 14)) };
        if kind == POTREE_PROXY {
            found.push((key, Entry::Page(span)));
            continue;
        }
        // Without bytes it has no points, whatever it says.
        let points = if span.bytes == 0 { 0 } else { points };
        let expected = record_bytes.map_or(span.bytes, |bytes| u64::from(points) * bytes);
        if span.bytes != expected {
            return refuse(format!("{points} points in {} bytes; expected {expected}", span.bytes));
        }
        found.push((key, Entry::Node { points, span }));
        for child in (0..8).filter(|child| mask >> child & 1 != 0) {
            let Some(child) = key.child(child) else {
                return refuse("has children; expected none that deep".to_owned());
            };
            keys.push(child);
        }
    }
    match keys.len() == count {
        true => Ok(found),
        false => Err(format!("{count} entries; its masks name {} nodes", keys.len())),
    }
}
