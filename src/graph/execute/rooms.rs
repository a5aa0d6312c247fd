//! How much room transient buffers have: as much as they need while that stays the same; a quarter more once it has changed, so
//! that a camera that moves finds buffers that it can go on with.

/// The room of one buffer, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Room {
    /// What was needed last.
    size_bytes: u64,
    /// What there is.
    pub room_bytes: u64,
    /// What is needed has changed: it follows the view.
    pub varies: bool,
}

/// What buffers have more than they need, as a part of it, where that varies.
const RESERVE: u64 = 4;

/// Room is given back where all buffers together have so many times what they would be given now.
const MOST_TIMES_TOO_LARGE: u64 = 4;

impl Room {
    /// The room of a new buffer.
    pub fn new(size_bytes: u64, varies: bool, most_bytes: u64) -> Self {
        let reserve = if varies { (size_bytes / RESERVE).next_multiple_of(16) } else { 0 };
        let room_bytes = size_bytes.saturating_add(reserve).min(most_bytes).max(size_bytes);
        Self { size_bytes, room_bytes, varies }
    }

    /// Whether it varies where so much is needed next.
    fn varies_at(&self, size_bytes: u64) -> bool {
        self.varies || size_bytes != self.size_bytes
    }
}

/// Whether buffers that are needed in other sizes now, each of at most so many bytes, have room, and not far too much, and none of them has
/// just begun to vary.
pub(super) fn serve(rooms: &[Room], sizes: impl Iterator<Item = (u64, u64)> + Clone) -> bool {
    let mut pairs = rooms.iter().zip(sizes.clone());
    pairs.all(|(room, (size_bytes, _))| {
        size_bytes <= room.room_bytes && (size_bytes == room.size_bytes || room.varies)
    }) && !are_too_large(rooms, sizes)
}

/// The rooms of buffers where those that there are do not [`serve`]; and whether they serve all that those did. They don't where those have far
/// too much.
pub(super) fn renew(rooms: &[Room], sizes: impl Iterator<Item = (u64, u64)> + Clone) -> (Vec<Room>, bool) {
    let too_large = are_too_large(rooms, sizes.clone());
    let renewed = rooms.iter().zip(sizes).map(|(room, (size_bytes, most_bytes))| {
        let new = Room::new(size_bytes, room.varies_at(size_bytes), most_bytes);
        let kept_bytes = if too_large { 0 } else { room.room_bytes };
        Room { room_bytes: new.room_bytes.max(kept_bytes), ..new }
    });
    (renewed.collect(), !too_large)
}

/// Whether nearly all that there is would be idle.
fn are_too_large(rooms: &[Room], sizes: impl Iterator<Item = (u64, u64)>) -> bool {
    let (mut held, mut wanted) = (0_u64, 0_u64);
    for (room, (size_bytes, most_bytes)) in rooms.iter().zip(sizes) {
        held = held.saturating_add(room.room_bytes);
        let new = Room::new(size_bytes, room.varies_at(size_bytes), most_bytes);
        wanted = wanted.saturating_add(new.room_bytes);
    }
    held / MOST_TIMES_TOO_LARGE > wanted
}

#[cfg(test)]
mod tests {
    use super::*;

    const MOST: u64 = 1 << 30;

    /// What buffers of some sizes, frame after frame, have room for; and in which frames they got it.
    fn rooms_of(frames: &[&[u64]]) -> (Vec<u64>, Vec<usize>) {
        let mut rooms: Vec<Room> = frames[0].iter().map(|&size| Room::new(size, false, MOST)).collect();
        let mut made = vec![0];
        for (frame, sizes) in frames.iter().enumerate().skip(1) {
            let sizes_and_most = sizes.iter().map(|&size| (size, MOST));
            if !serve(&rooms, sizes_and_most.clone()) {
                rooms = renew(&rooms, sizes_and_most).0;
                made.push(frame);
            }
            assert!(
                rooms.iter().zip(*sizes).all(|(room, size)| *size <= room.room_bytes),
                "{frame}: {rooms:?}"
            );
        }
        (rooms.iter().map(|room| room.room_bytes).collect(), made)
    }

    #[test]
    fn what_stays_the_same_has_no_reserve() {
        assert_eq!(rooms_of(&[&[100, 4096], &[100, 4096], &[100, 4096]]), (vec![100, 4096], vec![0]));
    }

    #[test]
    fn what_varies_is_made_anew_once() {
        // Smaller or larger: the second frame is the last that makes any.
        for second in [99_000, 101_000] {
            let (rooms, made) = rooms_of(&[&[64, 100_000], &[64, second], &[64, 110_000], &[64, 120_000]]);
            assert_eq!((rooms[0], made), (64, vec![0, 1]), "{second}");
            assert!((120_000..130_000).contains(&rooms[1]), "{rooms:?}");
        }
    }

    #[test]
    fn what_grows_without_end_is_made_anew_ever_more_rarely() {
        let sizes: Vec<[u64; 1]> = (0..1000).map(|frame| [100_000 + 1000 * frame]).collect();
        let frames: Vec<&[u64]> = sizes.iter().map(<[u64; 1]>::as_slice).collect();
        let (_, made) = rooms_of(&frames);
        assert!(made.len() <= 14, "{made:?}");
    }

    #[test]
    fn room_is_given_back_where_nearly_all_of_it_is_idle_and_not_before() {
        let (rooms, made) = rooms_of(&[&[1 << 20], &[1 << 19], &[1 << 18], &[1 << 17], &[1 << 17]]);
        assert_eq!(made, [0, 1, 3]);
        assert_eq!(rooms, [(1 << 17) + (1 << 15)]);
    }

    #[test]
    fn no_room_is_larger_than_the_device_takes() {
        assert_eq!(Room::new(1000, true, 1100).room_bytes, 1100);
        // Where more is needed all the same, whoever makes the buffer refuses it.
        assert_eq!(Room::new(1000, true, 10).room_bytes, 1000);
        assert_eq!(Room::new(u64::MAX, true, u64::MAX).room_bytes, u64::MAX);
    }
}
