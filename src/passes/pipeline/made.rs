//! Pipelines that were made, each with when it was asked for last, so that the oldest can go.

use std::{
    collections::HashMap,
    hash::{BuildHasherDefault, Hash, Hasher},
    sync::{Mutex, MutexGuard, PoisonError},
};

use ash::vk;

use crate::{
    error::Result,
    vk::{ComputePipeline, GraphicsPipeline},
};

/// Pipelines by what they are made of.
pub(super) struct Made<K, P>(Mutex<Found<K, P>>);

type Found<K, P> = HashMap<K, (P, u64), BuildHasherDefault<Quick>>;

/// Multiplies and turns: a frame asks for a pipeline a pass, by keys that nobody chooses to fall together.
#[derive(Default)]
struct Quick(u64);

impl Hasher for Quick {
    fn write(&mut self, bytes: &[u8]) {
        for bytes in bytes.chunks(8) {
            let mut word = [0; 8];
            word[..bytes.len()].copy_from_slice(bytes);
            self.write_u64(u64::from_le_bytes(word));
        }
    }

    fn write_u8(&mut self, number: u8) {
        self.write_u64(number.into());
    }

    fn write_u32(&mut self, number: u32) {
        self.write_u64(number.into());
    }

    fn write_u64(&mut self, number: u64) {
        self.0 = (self.0.rotate_left(26) ^ number).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }

    fn write_usize(&mut self, number: usize) {
        self.write_u64(number as u64);
    }

    /// The upper bits depend on all words.
    fn finish(&self) -> u64 {
        self.0.rotate_left(32)
    }
}

/// Owns a raw pipeline.
pub(super) trait OwnsPipeline {
    fn raw(&self) -> vk::Pipeline;
}

impl OwnsPipeline for GraphicsPipeline {
    fn raw(&self) -> vk::Pipeline {
        self.raw()
    }
}

impl OwnsPipeline for ComputePipeline {
    fn raw(&self) -> vk::Pipeline {
        self.raw()
    }
}

impl<K, P> Default for Made<K, P> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<K: Eq + Hash, P: OwnsPipeline> Made<K, P> {
    /// The pipeline, made where it was not made yet; it is asked for at this time. While it is made, other threads find what is there, and may
    /// make others, or the same, of which one stays.
    pub fn get(&self, key: K, now: u64, make: impl FnOnce(&K) -> Result<P>) -> Result<vk::Pipeline> {
        if let Some((pipeline, used)) = self.all().get_mut(&key) {
            *used = now;
            return Ok(pipeline.raw());
        }
        let pipeline = make(&key)?;
        Ok(self.all().entry(key).or_insert((pipeline, now)).0.raw())
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.all().len()
    }

    /// What each does with them.
    pub fn for_each<T>(&self, of: impl Fn(&K, u64) -> T) -> Vec<T> {
        self.all().iter().map(|(key, (_, used))| of(key, *used)).collect()
    }

    /// Those that were asked for last at a time or later.
    pub fn since(&self, time: u64) -> Vec<vk::Pipeline> {
        self.all().values().filter(|(_, used)| *used >= time).map(|(pipeline, _)| pipeline.raw()).collect()
    }

    /// Drops those that were asked for last before a time, and tells which.
    pub fn drop_before(&self, time: u64) -> Vec<vk::Pipeline> {
        self.all().extract_if(|_, (_, used)| *used < time).map(|(_, (pipeline, _))| pipeline.raw()).collect()
    }

    fn all(&self) -> MutexGuard<'_, Found<K, P>> {
        // A panic while the lock was held leaves a map without the pipeline that was being made.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// From when on pipelines stay, so that so many do that were asked for last at these times, no two at the same.
pub(super) fn first_to_stay(mut times: Vec<u64>, most: usize) -> u64 {
    times.sort_unstable();
    match times.len().checked_sub(most) {
        None => 0,
        Some(first) => times.get(first).copied().unwrap_or(u64::MAX),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Fake(u64);

    /// A thread that waited for the lock would wait for ever here.
    #[test]
    fn while_a_pipeline_is_made_others_are_found_and_made() {
        let made = Made::<u64, Fake>::default();
        made.get(1, 0, |_| Ok(Fake(1))).unwrap();
        let outer = made.get(2, 1, |_| {
            assert_eq!(made.get(1, 2, |_| unreachable!()).unwrap(), vk::Handle::from_raw(1));
            made.get(3, 3, |_| Ok(Fake(3)))?;
            // Another thread is faster: what it made stays.
            made.get(2, 4, |_| Ok(Fake(20)))?;
            Ok(Fake(2))
        });
        assert_eq!((outer.unwrap(), made.len()), (vk::Handle::from_raw(20), 3));
    }

    impl OwnsPipeline for Fake {
        fn raw(&self) -> vk::Pipeline {
            vk::Handle::from_raw(self.0)
        }
    }

    #[test]
    fn those_that_were_asked_for_longest_ago_go() {
        let made = Made::<u64, Fake>::default();
        for (now, key) in [5, 6, 7, 5, 8].into_iter().enumerate() {
            let raw = made.get(key, now as u64, |key| Ok(Fake(*key))).unwrap();
            assert_eq!(raw, vk::Handle::from_raw(key));
        }
        let times = made.for_each(|_, used| used);
        assert_eq!([0, 4, 5, 9].map(|most| first_to_stay(times.clone(), most)), [u64::MAX, 1, 0, 0]);
        assert_eq!(made.since(4), [vk::Handle::from_raw(8)]);
        made.drop_before(first_to_stay(times, 2));
        let mut left = made.for_each(|key, _| *key);
        left.sort_unstable();
        assert_eq!(left, [5, 8]);
        assert!(made.get(6, 9, |_| Err(crate::error::Error::option("6", "is made again"))).is_err());
    }
}
