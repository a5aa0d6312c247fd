//! Lists of a few values that lie where they are declared, not on the heap.

use std::{
    fmt,
    hash::{Hash, Hasher},
    ops::{Deref, DerefMut},
};

/// Up to `N` values in place.
#[derive(Clone, Copy)]
pub struct InlineVec<T, const N: usize> {
    values: [T; N],
    len: usize,
}

impl<T: Copy + Default, const N: usize> InlineVec<T, N> {
    /// None.
    pub fn new() -> Self {
        Self { values: [T::default(); N], len: 0 }
    }

    /// One more.
    ///
    /// # Panics
    /// If there are `N`: whoever chooses it knows how many there can be.
    pub fn push(&mut self, value: T) {
        self.values[self.len] = value;
        self.len += 1;
    }

    /// Those and these.
    #[must_use]
    pub fn with(mut self, others: impl IntoIterator<Item = T>) -> Self {
        self.extend(others);
        self
    }

    /// Leaves out those for which this does not hold.
    pub fn retain(&mut self, stays: impl Fn(&T) -> bool) {
        *self = self.iter().copied().filter(stays).collect();
    }
}

impl<T: Copy + Default, const N: usize> Default for InlineVec<T, N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Copy + Default, const N: usize> Extend<T> for InlineVec<T, N> {
    fn extend<I: IntoIterator<Item = T>>(&mut self, values: I) {
        values.into_iter().for_each(|value| self.push(value));
    }
}

impl<T: Copy + Default, const N: usize> FromIterator<T> for InlineVec<T, N> {
    fn from_iter<I: IntoIterator<Item = T>>(values: I) -> Self {
        let mut all = Self::new();
        all.extend(values);
        all
    }
}

impl<T: Copy + Default, const M: usize, const N: usize> From<[T; M]> for InlineVec<T, N> {
    fn from(values: [T; M]) -> Self {
        const { assert!(M <= N) };
        Self::from_iter(values)
    }
}

impl<T, const N: usize> Deref for InlineVec<T, N> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.values[..self.len]
    }
}

impl<T, const N: usize> DerefMut for InlineVec<T, N> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.values[..self.len]
    }
}

impl<'v, T, const N: usize> IntoIterator for &'v InlineVec<T, N> {
    type Item = &'v T;
    type IntoIter = std::slice::Iter<'v, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<T: Copy, const N: usize> IntoIterator for InlineVec<T, N> {
    type Item = T;
    type IntoIter = std::iter::Take<std::array::IntoIter<T, N>>;

    fn into_iter(self) -> Self::IntoIter {
        self.values.into_iter().take(self.len)
    }
}

impl<T: PartialEq, const N: usize> PartialEq for InlineVec<T, N> {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl<T: Eq, const N: usize> Eq for InlineVec<T, N> {}

impl<T: Hash, const N: usize> Hash for InlineVec<T, N> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (**self).hash(state);
    }
}

impl<T: fmt::Debug, const N: usize> fmt::Debug for InlineVec<T, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_the_list_of_what_was_put_in_and_what_was_there_before_does_not_count() {
        let mut few: InlineVec<u32, 4> = [3, 1, 4].into();
        few.push(1);
        few.retain(|value| *value != 1);
        assert_eq!((&*few, few.len(), few.into_iter().sum::<u32>()), ([3, 4].as_slice(), 2, 7));
        assert_eq!(few, InlineVec::from([3, 4]));
        assert_eq!(format!("{few:?}"), "[3, 4]");
        let hash = |few: &InlineVec<u32, 4>| {
            let mut state = std::hash::DefaultHasher::new();
            few.hash(&mut state);
            state.finish()
        };
        assert_eq!(hash(&few), hash(&[3, 4].into()));
    }

    #[test]
    #[should_panic = "index out of bounds"]
    fn there_is_no_room_for_more() {
        InlineVec::<u32, 1>::from([1]).push(2);
    }
}
