//! Compile stage 6: what each pass has to wait for, in one batch before it.

use ash::vk;

use super::{
    access::writes_of,
    alias::Slot,
    declare::{Declared, Start, Use},
    lifetime::{Lifetime, Usage},
    resource::{Origin, ResourceDesc, ResourceId, State},
    track::{Need, Track, Wait},
};

/// Stages and what they access: one side of a dependency.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Scope {
    /// The stages.
    pub stages: vk::PipelineStageFlags2,
    /// Their accesses. Of what is waited for, only the writes, which become available.
    pub access: vk::AccessFlags2,
}

/// A change of an image's layout; none where both are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transition {
    /// The layout before; `UNDEFINED` where the content isn't needed.
    pub old: vk::ImageLayout,
    /// The layout after.
    pub new: vk::ImageLayout,
}

/// Why a barrier is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// A reader sees what was written.
    ReadAfterWrite,
    /// A writer lets the readers finish.
    WriteAfterRead,
    /// A writer lets an earlier one finish.
    WriteAfterWrite,
    /// A reader needs another layout than those before it.
    Layout,
    /// The first access of a transient lets the former tenants of its memory finish: other transients, or itself
    /// in the execution before.
    FirstUse,
}

/// One resource that a pass waits for; an image or a buffer barrier over the whole resource.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Barrier {
    /// The resource.
    pub resource: ResourceId,
    /// Why.
    pub cause: Cause,
    /// For [`Cause::FirstUse`], whose last accesses are waited on; otherwise empty.
    pub tenants: Vec<ResourceId>,
    /// What has to be finished.
    pub src: Scope,
    /// What has to wait.
    pub dst: Scope,
    /// The layouts of an image; `None` for a buffer.
    pub transition: Option<Transition>,
}

/// The barriers of one `vkCmdPipelineBarrier2`; no call at all where it is empty.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Batch {
    /// A global memory barrier, source and destination. Memory that changes its tenant needs it: the barrier of the
    /// new tenant makes available only what was written through that one (Vulkan 1.3,
    /// "Image Memory Barriers").
    pub memory: Option<(Scope, Scope)>,
    /// The barriers of resources.
    pub resources: Vec<Barrier>,
}

impl Batch {
    /// Whether there is nothing to wait for.
    pub fn is_empty(&self) -> bool {
        self.memory.is_none() && self.resources.is_empty()
    }
}

/// All barriers of a plan.
pub(super) struct Barriers {
    /// One a pass, in the order of execution.
    pub(super) passes: Vec<Batch>,
    /// After the last pass: into the declared final states.
    pub(super) final_: Vec<Barrier>,
    /// The state in which each resource is left.
    pub(super) end: Vec<State>,
}

impl std::ops::BitOrAssign for Scope {
    fn bitor_assign(&mut self, other: Self) {
        self.stages |= other.stages;
        self.access |= other.access;
    }
}

/// Walks through the passes, and keeps of each resource what may still be under way.
pub(super) fn barriers(
    graph: &Declared,
    order: &[usize],
    lifetimes: &[(Usage, Option<Lifetime>)],
    slots: &[Option<Slot>],
) -> Barriers {
    let tenants: Vec<Vec<ResourceId>> =
        (0..slots.len()).map(|i| former_tenants(ResourceId(i as u32), slots, lifetimes)).collect();
    let mut tracks = starts(graph, order, &tenants);
    let mut passes = Vec::with_capacity(order.len());
    for (position, &pass) in order.iter().enumerate() {
        let mut batch = Batch::default();
        for (resource, need) in needs_of(graph, &graph.passes[pass].uses) {
            let Some(wait) = tracks[resource.index()].step(&need) else { continue };
            let mut barrier = barrier_of(graph, resource, &need, wait);
            let tenants = &tenants[resource.index()];
            let is_first = lifetimes[resource.index()].1.is_some_and(|lifetime| lifetime.first == position);
            if is_first && !tenants.is_empty() {
                barrier.cause = Cause::FirstUse;
                barrier.tenants.clone_from(tenants);
                // A tenant's own barrier covers what it has written itself.
                if tenants.iter().any(|&tenant| tenant != resource) {
                    let (src, dst) = batch.memory.get_or_insert_default();
                    *src |= barrier.src;
                    *dst |= barrier.dst;
                }
            }
            batch.resources.push(barrier);
        }
        passes.push(batch);
    }
    let mut final_ = Vec::new();
    let mut end = Vec::with_capacity(tracks.len());
    for (i, (resource, track)) in graph.resources.iter().zip(&mut tracks).enumerate() {
        let mut left = track.state();
        if let Origin::Imported { final_: Some(state), .. } = resource.origin {
            let State { stages, access, layout } = state;
            let scope = Scope { stages, access };
            let need = Need { scope, writes: writes_of(access), layout, discards: false };
            let id = ResourceId(i as u32);
            final_.extend(track.step(&need).map(|wait| barrier_of(graph, id, &need, wait)));
            left = state;
        }
        end.push(left);
    }
    Barriers { passes, final_, end }
}

/// What may be under way on each resource before the first pass.
fn starts(graph: &Declared, order: &[usize], tenants: &[Vec<ResourceId>]) -> Vec<Track> {
    // How each transient is left doesn't depend on what its first access waits for, so it can be known beforehand:
    // what follows a plan is the plan again.
    let mut left = vec![Track::from_tenants(Scope::default()); graph.resources.len()];
    for &pass in order {
        for (resource, need) in needs_of(graph, &graph.passes[pass].uses) {
            left[resource.index()].step(&need);
        }
    }
    let start = |(resource, tenants): (&super::declare::Resource, &Vec<ResourceId>)| match resource.origin {
        Origin::Imported { initial, .. } => Track::from_state(initial),
        Origin::Transient => {
            let mut last = Scope::default();
            tenants.iter().for_each(|tenant| last |= left[tenant.index()].last());
            Track::from_tenants(last)
        }
    };
    graph.resources.iter().zip(tenants).map(start).collect()
}

/// The transients that were the last ones to use the bytes of a transient before its life begins, the latest first,
/// where the execution before comes before this one. Often it is among them itself.
fn former_tenants(
    id: ResourceId,
    slots: &[Option<Slot>],
    lifetimes: &[(Usage, Option<Lifetime>)],
) -> Vec<ResourceId> {
    let (Some(slot), Some(life)) = (slots[id.index()], lifetimes[id.index()].1) else { return Vec::new() };
    let mut others: Vec<(usize, ResourceId, Slot)> = Vec::new();
    for (i, (&other, (_, lifetime))) in slots.iter().zip(lifetimes).enumerate() {
        if let (Some(other), Some(lifetime)) = (other, lifetime)
            && other.overlaps(&slot)
        {
            others.push((lifetime.last, ResourceId(i as u32), other));
        }
    }
    others.sort_by_key(|&(last, id, _)| (last < life.first, last, id));
    let mut unseen = vec![(slot.offset_bytes, slot.end_bytes())];
    let mut found = Vec::new();
    for (_, tenant, other) in others.into_iter().rev() {
        let mut rest = Vec::new();
        for &(begin, end) in &unseen {
            rest.push((begin, end.min(other.offset_bytes)));
            rest.push((begin.max(other.end_bytes()), end));
        }
        rest.retain(|(begin, end)| begin < end);
        if rest != unseen {
            found.push(tenant);
            unseen = rest;
        }
    }
    found
}

/// The accesses of one pass, taken together by resource.
fn needs_of(graph: &Declared, uses: &[Use]) -> Vec<(ResourceId, Need)> {
    let mut needs: Vec<(ResourceId, Need)> = Vec::with_capacity(uses.len());
    for usage in uses {
        let info = usage.access.info();
        let scope = Scope { stages: info.stages, access: info.reads | info.writes };
        if let Some((_, need)) = needs.iter_mut().find(|(resource, _)| *resource == usage.resource) {
            // Several reads, which `validate` has seen to agree on the layout.
            need.scope |= scope;
            continue;
        }
        let layout = match (graph.resource(usage.resource).desc, info.image) {
            (ResourceDesc::Image(_), Some((layout, _))) => layout,
            _ => vk::ImageLayout::UNDEFINED,
        };
        let discards = matches!(usage.start, Some(Start::Clear(_) | Start::Discard));
        needs.push((usage.resource, Need { scope, writes: info.writes, layout, discards }));
    }
    needs
}

fn barrier_of(graph: &Declared, resource: ResourceId, need: &Need, wait: Wait) -> Barrier {
    let transition = match graph.resource(resource).desc {
        ResourceDesc::Image(_) => Some(wait.transition),
        ResourceDesc::Buffer(_) => None,
    };
    Barrier { resource, cause: wait.cause, tenants: Vec::new(), src: wait.src, dst: need.scope, transition }
}
