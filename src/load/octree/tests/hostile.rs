use super::*;

/// Reads all of it.
fn read(octree: Opened) -> Result<()> {
    let mut octree = octree?;
    let all = octree.choose(&|_| true)?;
    let points = octree.size_of(&all).0;
    let read = points_of(octree.read(&all, &())?);
    assert!(read as u64 <= points);
    Ok(())
}

fn in_one_line(error: &crate::error::Error) {
    assert!(error.exit_code() == 1 && !error.to_string().contains('\n'), "{error}");
}

#[test]
fn files_cut_anywhere_are_refused() {
    let octree = octree(40);
    let copc = octree.copc(1).0;
    read(of_copc(copc.clone())).unwrap();
    (0..copc.len()).for_each(|end| in_one_line(&read(of_copc(copc[..end].to_vec())).unwrap_err()));
    for whole in [octree.potree(1), octree.packed_potree(1)] {
        read(of_potree(whole.clone())).unwrap();
        for (file, end) in (0..3).flat_map(|file| (0..whole[file].len()).map(move |end| (file, end))) {
            let mut files = whole.clone();
            files[file].truncate(end);
            in_one_line(&read(of_potree(files)).unwrap_err());
        }
    }
}

/// Whatever bytes are there: an error in one line, or points, without taking long.
#[test]
fn hostile_bytes_are_refused_or_read() {
    // Each node takes the decoder of LAZ as long to begin as thousands of points.
    let octree = octree(40);
    let (copc, root) = octree.copc(1);
    let potree = [octree.potree(1), octree.packed_potree(1)];
    let mut random = SplitMix(11);
    let mut below = |most: usize| (random.bits() % most as u64) as usize;
    for case in 0..40_000 {
        let mut copc = copc.clone();
        let mut files = potree[case / 2 % 2].clone();
        for _ in 0..=below(3) {
            // The hierarchy and the headers, more than the points.
            let (bytes, at) = match (case % 2, below(4)) {
                (0, 0) => (&mut copc, below(700)),
                (0, 1) => (&mut copc, root - 1 - below(root / 2)),
                (0, _) => {
                    let behind = copc.len().saturating_sub(root).max(1);
                    (&mut copc, root + below(behind))
                }
                (_, 3) => {
                    let length = files[2].len().max(1);
                    (&mut files[2], below(length))
                }
                (_, own) => {
                    let file = &mut files[own.min(1)];
                    let length = file.len().max(1);
                    (file, below(length))
                }
            };
            if at >= bytes.len() {
                break;
            }
            match below(4) {
                0 => bytes[at] ^= 1 << below(8),
                1 => {
                    let end = (at + 4).min(bytes.len());
                    bytes[at..end].fill([0, 0xff, 0x7f, 0x80][below(4)]);
                }
                2 => bytes[at] = below(256) as u8,
                _ => {
                    let from = below(bytes.len());
                    bytes[at] = bytes[from];
                }
            }
            if below(40) == 0 {
                bytes.truncate(at + 1);
            }
        }
        let read = match case % 2 {
            0 => read(of_copc(copc)),
            _ => read(of_potree(files)),
        };
        read.err().iter().for_each(in_one_line);
    }
}

fn points_of(loaded: Loaded) -> usize {
    points(loaded).positions.len()
}
