//! What may still be under way on one resource, and what its next access has to wait for.

use ash::vk;

use super::{
    access::writes_of,
    resource::State,
    scope::{Cause, Scope, Transition},
};

/// The state of one resource between two passes.
#[derive(Clone, Debug)]
pub(super) struct Track {
    layout: vk::ImageLayout,
    /// The last write; after a change of the layout, the stages that waited on that, and no access.
    write: Scope,
    /// The stages that have read since. Each of them waited on the write, which is therefore available.
    readers: vk::PipelineStageFlags2,
    /// To whom the write is visible.
    visible: Vec<Scope>,
    /// It is visible to all: the caller has seen to it.
    visible_to_all: bool,
}

/// All accesses of one pass to one resource, taken together.
#[derive(Clone, Copy, Debug)]
pub(super) struct Need {
    pub(super) scope: Scope,
    /// The writing part of the scope's access.
    pub(super) writes: vk::AccessFlags2,
    /// `UNDEFINED` for a buffer.
    pub(super) layout: vk::ImageLayout,
    /// The content found is not needed.
    pub(super) discards: bool,
}

/// What must happen before a [`Need`] is met.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wait {
    pub(super) cause: Cause,
    pub(super) src: Scope,
    pub(super) transition: Transition,
}

impl Track {
    /// A resource in a declared state.
    pub(super) fn from_state(state: State) -> Self {
        let State { stages, access, layout } = state;
        let access_written = writes_of(access);
        let reads_only = access_written.is_empty();
        Self {
            layout,
            write: Scope { stages, access: access_written },
            readers: if reads_only { stages } else { vk::PipelineStageFlags2::NONE },
            visible: if reads_only { vec![Scope { stages, access }] } else { Vec::new() },
            visible_to_all: stages.is_empty(),
        }
    }

    /// Memory that others have used, whose last accesses were these.
    pub(super) fn from_tenants(last: Scope) -> Self {
        Self {
            layout: vk::ImageLayout::UNDEFINED,
            write: last,
            readers: vk::PipelineStageFlags2::NONE,
            visible: Vec::new(),
            visible_to_all: false,
        }
    }

    /// What whoever overwrites the resource has to wait on. Readers suffice where there are some, because they
    /// waited on the write.
    pub(super) fn last(&self) -> Scope {
        if self.readers.is_empty() {
            self.write
        } else {
            Scope { stages: self.readers, access: vk::AccessFlags2::NONE }
        }
    }

    /// A state that holds now and from which everything can go on; it may claim less than is known.
    pub(super) fn state(&self) -> State {
        State { stages: self.write.stages | self.readers, access: self.write.access, layout: self.layout }
    }

    /// Goes on to the next access; `None` where it can begin without a barrier.
    pub(super) fn step(&mut self, need: &Need) -> Option<Wait> {
        let wait = self.wait(need);
        let changes_layout = need.layout != self.layout;
        if !need.writes.is_empty() {
            self.write = Scope { stages: need.scope.stages, access: need.writes };
            self.readers = vk::PipelineStageFlags2::NONE;
            self.visible.clear();
            self.visible_to_all = false;
        } else if changes_layout {
            // The change is a write that happens inside the barrier: available at once, visible to whom it names.
            self.write = Scope { stages: need.scope.stages, access: vk::AccessFlags2::NONE };
            self.readers = need.scope.stages;
            self.visible = vec![need.scope];
            self.visible_to_all = false;
        } else {
            self.readers |= need.scope.stages;
            if wait.is_some() {
                self.visible.push(need.scope);
            }
        }
        self.layout = need.layout;
        wait
    }

    fn wait(&self, need: &Need) -> Option<Wait> {
        let changes_layout = need.layout != self.layout;
        let writes = !need.writes.is_empty();
        // A change of the layout is a write: it waits on the readers too.
        let src = if writes || changes_layout { self.last() } else { self.write };
        let nothing_to_wait_on = if writes { src.stages.is_empty() } else { self.is_visible_to(need.scope) };
        if nothing_to_wait_on && !changes_layout {
            return None;
        }
        let cause = match (writes, self.readers.is_empty()) {
            (true, false) => Cause::WriteAfterRead,
            (true, true) if !src.stages.is_empty() => Cause::WriteAfterWrite,
            (false, _) if !changes_layout || !src.access.is_empty() => Cause::ReadAfterWrite,
            _ => Cause::Layout,
        };
        // From UNDEFINED, the old content need not be carried over.
        let old = if need.discards && changes_layout { vk::ImageLayout::UNDEFINED } else { self.layout };
        Some(Wait { cause, src, transition: Transition { old, new: need.layout } })
    }

    fn is_visible_to(&self, reader: Scope) -> bool {
        let sees = |stage: u64, access: u64| {
            self.visible.iter().any(|scope| {
                scope.stages.as_raw() & stage == stage && scope.access.as_raw() & access == access
            })
        };
        self.visible_to_all
            || bits(reader.stages.as_raw())
                .all(|stage| sees(stage, 0) && bits(reader.access.as_raw()).all(|access| sees(stage, access)))
    }
}

/// The single bits of a mask.
pub(super) fn bits(mut mask: u64) -> impl Iterator<Item = u64> {
    std::iter::from_fn(move || {
        let lowest = mask & mask.wrapping_neg();
        mask ^= lowest;
        (lowest != 0).then_some(lowest)
    })
}
