//! Memory for one frame: what is made while a frame is recorded lies in it, one behind the other, and goes all at once. From frame to frame it is
//! kept, so that a frame like those before takes nothing from the heap.

use std::fmt::{self, Write};

use bumpalo::Bump;

/// Memory of a frame. Nothing in it is dropped, so that nothing may be in it that owns something else: what is put into it is checked for that when
/// the program is compiled.
#[derive(Debug, Default)]
pub struct Arena(Bump);

/// Bytes that most names have room in: one that grows is copied.
const MOST_OF_A_NAME: usize = 64;

/// A list that grows in an [`Arena`].
pub type ArenaVec<'a, T> = bumpalo::collections::Vec<'a, T>;

impl Arena {
    /// Memory with nothing in it; none is taken yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Forgets all that is in it, and keeps as much memory as one piece holds: after some frames alike, all that they need.
    pub fn reset(&mut self) {
        self.0.reset();
    }

    /// A value in it.
    pub fn keep<T>(&self, value: T) -> &T {
        const { assert!(!std::mem::needs_drop::<T>(), "what is in an arena is not dropped") };
        self.0.alloc(value)
    }

    /// The same, to be changed.
    pub fn keep_changing<T>(&self, value: T) -> &mut T {
        const { assert!(!std::mem::needs_drop::<T>(), "what is in an arena is not dropped") };
        self.0.alloc(value)
    }

    /// The same as [`Self::keep`] of one that is made there: large ones are copied else.
    pub fn keep_made<T>(&self, make: impl FnOnce() -> T) -> &T {
        const { assert!(!std::mem::needs_drop::<T>(), "what is in an arena is not dropped") };
        self.0.alloc_with(make)
    }

    /// What something says.
    pub fn text(&self, text: impl fmt::Display) -> &str {
        let mut string = bumpalo::collections::String::with_capacity_in(MOST_OF_A_NAME, &self.0);
        // Memory of the arena takes all that there is.
        let _ = write!(string, "{text}");
        string.into_bump_str()
    }

    /// Values, one behind the other.
    pub fn list<T>(&self, values: impl IntoIterator<Item = T>) -> &[T] {
        let mut list = self.growing();
        list.extend(values);
        list.into_bump_slice()
    }

    /// The same, or the first error.
    ///
    /// # Errors
    /// As a value's.
    pub fn try_list<T, E>(&self, values: impl IntoIterator<Item = Result<T, E>>) -> Result<&[T], E> {
        let values = values.into_iter();
        let mut list = self.growing();
        list.reserve(values.size_hint().0);
        for value in values {
            list.push(value?);
        }
        Ok(list.into_bump_slice())
    }

    /// A list of the same values, to be changed.
    pub fn copied<T: Copy>(&self, values: &[T]) -> ArenaVec<'_, T> {
        let mut list = self.growing();
        list.extend_from_slice_copy(values);
        list
    }

    /// A list to be filled.
    pub fn growing<T>(&self) -> ArenaVec<'_, T> {
        const { assert!(!std::mem::needs_drop::<T>(), "what is in an arena is not dropped") };
        ArenaVec::new_in(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_in_it_stays_until_all_goes_and_frames_alike_share_its_memory() {
        let mut arena = Arena::new();
        let mut pieces = Vec::new();
        for frame in 0..5_u64 {
            {
                let numbers = arena.list(0..1000 + frame);
                let (text, kept) = (arena.text(format_args!("frame {frame}")), arena.keep(frame));
                let inner = arena.list((0..3).map(|i| arena.list([i, frame])));
                assert_eq!(
                    (numbers.len() as u64, text, *kept),
                    (1000 + frame, &*format!("frame {frame}"), frame)
                );
                assert_eq!(inner, [[0, frame], [1, frame], [2, frame]]);
                assert_eq!(arena.try_list([Ok(1), Err("no"), Ok(2)]), Err("no"));
            }
            pieces.push(arena.0.allocated_bytes());
            arena.reset();
        }
        assert!(pieces[2..].iter().all(|bytes| *bytes == pieces[2]), "{pieces:?}");
    }
}
