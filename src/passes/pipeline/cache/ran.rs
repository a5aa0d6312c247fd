//! Which pipelines have run. Drivers of CPUs compile one when it first runs, and keep it on disk, where another device of the same driver finds it.

use std::{
    collections::{HashMap, HashSet},
    hash::{DefaultHasher, Hash, Hasher},
    sync::{MutexGuard, PoisonError, atomic::Ordering},
};

use ash::vk;

use super::{
    super::key::{ComputeKey, GraphicsKey},
    Shaders,
};

/// What ran on which device.
#[derive(Default)]
pub(crate) struct Ran {
    /// In a step of a frame of this renderer.
    here: HashSet<vk::Pipeline>,
    /// Here or elsewhere, by their numbers; those that are given up stay.
    compiled: HashSet<u64>,
    /// What this renderer has made.
    numbers: HashMap<vk::Pipeline, u64>,
}

/// Whether a pipeline has run before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Run {
    /// It has.
    Again,
    /// Elsewhere, or here before it was given up.
    FirstHere,
    /// Nowhere, as far as is known.
    First,
}

impl Ran {
    /// It runs in a step that is being recorded.
    pub fn runs(&mut self, pipeline: vk::Pipeline) -> Run {
        if !self.here.insert(pipeline) {
            return Run::Again;
        }
        let is_first = self.numbers.get(&pipeline).is_none_or(|number| self.compiled.insert(*number));
        if is_first { Run::First } else { Run::FirstHere }
    }

    pub(super) fn made(&mut self, pipeline: vk::Pipeline, number: u64) {
        self.numbers.insert(pipeline, number);
    }

    /// Others may get their handles.
    pub(super) fn dropped(&mut self, pipelines: &[vk::Pipeline]) {
        for pipeline in pipelines {
            self.here.remove(pipeline);
            self.numbers.remove(pipeline);
        }
    }
}

impl Shaders {
    pub(crate) fn ran(&self) -> MutexGuard<'_, Ran> {
        self.ran.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Numbers of all pipelines that were made and not given up, which tell what these are made of: equal ones are of equal pipelines, in all renderers of a process.
    pub fn numbers(&self) -> Vec<u64> {
        self.ran().numbers.values().copied().collect()
    }

    /// Pipelines of these [`Self::numbers`] have run on another device of the same driver.
    pub fn ran_elsewhere(&self, numbers: &[u64]) {
        self.ran().compiled.extend(numbers);
    }

    /// How often a pipeline was asked for, which is the time of [`Self::have_run_since`].
    pub fn time(&self) -> u64 {
        self.asked.load(Ordering::Relaxed)
    }

    /// That time, as one is asked for.
    pub(super) fn now(&self) -> u64 {
        self.asked.fetch_add(1, Ordering::Relaxed)
    }

    /// Whether all pipelines that were asked for since have run in a step of a frame, or elsewhere.
    pub fn have_run_since(&self, time: u64) -> bool {
        let asked = [self.graphics.since(time), self.compute.since(time)].concat();
        let ran = self.ran();
        asked
            .iter()
            .all(|pipeline| ran.numbers.get(pipeline).is_some_and(|number| ran.compiled.contains(number)))
    }
}

/// What a pipeline is made of: its key, and the modules that the names of shaders stand for now.
pub(super) fn number_of_graphics(key: &GraphicsKey) -> u64 {
    number_of((key, key.vertex.spirv().as_ptr(), key.fragment.spirv().as_ptr()))
}

/// The same.
pub(super) fn number_of_compute(key: &ComputeKey) -> u64 {
    number_of((key, key.shader.spirv().as_ptr()))
}

fn number_of(what: impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    what.hash(&mut hasher);
    hasher.finish()
}
