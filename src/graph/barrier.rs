//! Compile stage 5: what each pass has to wait for, in one batch before it.

use std::collections::BTreeMap;

use ash::vk;

use super::{
    access::writes_of,
    alias::Slot,
    declare::{Declared, Resource, Start, Use},
    lifetime::{Lifetime, Usage},
    resource::{Origin, ResourceDesc, ResourceId, State},
    scope::{Cause, Scope, Transition},
    track::{Need, Track, Wait},
};

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
    graph: &Declared<'_>,
    order: &[usize],
    lifetimes: &[(Usage, Option<Lifetime>)],
    slots: &[Option<Slot>],
) -> Barriers {
    let needs = needs(graph, order);
    let tenants = former_tenants(slots, lifetimes);
    let mut tracks = starts(graph, &needs, &tenants);
    let mut passes = Vec::with_capacity(order.len());
    for (position, needs) in needs.iter().enumerate() {
        let mut batch = Batch::default();
        for (resource, need) in needs {
            let Some(wait) = tracks[resource.index()].step(need) else { continue };
            let mut barrier = barrier_of(graph, *resource, need, wait);
            let tenants = &tenants[resource.index()];
            let is_first = lifetimes[resource.index()].1.is_some_and(|lifetime| lifetime.first == position);
            if is_first && !tenants.is_empty() {
                barrier.cause = Cause::FirstUse;
                barrier.tenants.clone_from(tenants);
                // A tenant's own barrier covers what it has written itself.
                if tenants.iter().any(|tenant| tenant != resource) {
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
    for ((id, resource), track) in (0..).map(ResourceId).zip(&graph.resources).zip(&mut tracks) {
        let mut left = track.state();
        if let Origin::Imported { final_: Some(state), .. } = resource.origin {
            let State { stages, access, layout } = state;
            let scope = Scope { stages, access };
            let need = Need { scope, writes: writes_of(access), layout, discards: false };
            final_.extend(track.step(&need).map(|wait| barrier_of(graph, id, &need, wait)));
            left = state;
        }
        end.push(left);
    }
    Barriers { passes, final_, end }
}

/// The accesses of each pass, taken together by resource.
fn needs(graph: &Declared<'_>, order: &[usize]) -> Vec<Vec<(ResourceId, Need)>> {
    // Where a pass's need of a resource is, if it has one: some earlier pass may have left the place.
    let mut places = vec![0; graph.resources.len()];
    let mut needs_of = |uses: &[Use]| {
        let mut needs: Vec<(ResourceId, Need)> = Vec::with_capacity(uses.len());
        for usage in uses {
            let info = usage.access.info();
            let scope = Scope { stages: info.stages, access: info.reads | info.writes };
            let place = &mut places[usage.resource.index()];
            if let Some((_, need)) = needs.get_mut(*place).filter(|(id, _)| *id == usage.resource) {
                // Several reads, which `validate` has seen to agree on the layout.
                need.scope |= scope;
                continue;
            }
            let layout = match (graph.resource(usage.resource).desc, info.image) {
                (ResourceDesc::Image(_), Some((layout, _))) => layout,
                _ => vk::ImageLayout::UNDEFINED,
            };
            let discards = matches!(usage.start, Some(Start::Clear(_) | Start::Discard));
            *place = needs.len();
            needs.push((usage.resource, Need { scope, writes: info.writes, layout, discards }));
        }
        needs
    };
    order.iter().map(|&pass| needs_of(graph.passes[pass].uses)).collect()
}

/// What may be under way on each resource before the first pass.
fn starts(
    graph: &Declared<'_>,
    needs: &[Vec<(ResourceId, Need)>],
    tenants: &[Vec<ResourceId>],
) -> Vec<Track> {
    // How each transient is left doesn't depend on what its first access waits for, so it can be known beforehand:
    // what follows a plan is the plan again.
    let mut left = vec![Track::from_tenants(Scope::default()); graph.resources.len()];
    for (resource, need) in needs.iter().flatten() {
        left[resource.index()].step(need);
    }
    let start = |(resource, tenants): (&Resource<'_>, &Vec<ResourceId>)| match resource.origin {
        Origin::Imported { initial, .. } => Track::from_state(initial),
        Origin::Transient => {
            let mut last = Scope::default();
            tenants.iter().for_each(|tenant| last |= left[tenant.index()].last());
            Track::from_tenants(last)
        }
    };
    graph.resources.iter().zip(tenants).map(start).collect()
}

/// The transients that were the last ones to use the bytes of each transient before its life begins, the latest first,
/// where the execution before comes before this one. Often it is among them itself.
fn former_tenants(slots: &[Option<Slot>], lifetimes: &[(Usage, Option<Lifetime>)]) -> Vec<Vec<ResourceId>> {
    let placed = (0..).map(ResourceId).zip(slots).zip(lifetimes);
    let placed = placed.filter_map(|((id, slot), (_, life))| Some((id, (*slot)?, (*life)?)));
    let mut placed: Vec<_> = placed.collect();
    placed.sort_by_key(|(id, _, life)| (life.first, *id));
    let mut former = vec![Vec::new(); slots.len()];
    let mut owners = Owners::default();
    // The first round leaves what the execution before leaves.
    for round in 0..2 {
        for &(id, slot, life) in &placed {
            let mut found = owners.replace(slot, (life.last, id));
            if round == 1 {
                found.sort_by_key(|&(last, id)| std::cmp::Reverse((last < life.first, last, id)));
                found.dedup();
                former[id.index()] = found.into_iter().map(|(_, id)| id).collect();
            }
        }
    }
    former
}

/// The last pass of a transient, and the transient.
type Owner = (usize, ResourceId);

/// Who has had the bytes of each block last: by the block and the first byte of a stretch, its end and its owner.
#[derive(Default)]
struct Owners(BTreeMap<(usize, u64), (u64, Owner)>);

impl Owners {
    /// Gives bytes to a new owner; the former ones.
    fn replace(&mut self, slot: Slot, owner: Owner) -> Vec<Owner> {
        let [begin, end] = [slot.offset_bytes, slot.end_bytes()].map(|byte| (slot.block, byte));
        self.cut_at(begin);
        self.cut_at(end);
        let stretches: Vec<_> =
            self.0.range(begin..end).map(|(place, (_, owner))| (*place, *owner)).collect();
        let former = stretches.into_iter().map(|(place, owner)| {
            self.0.remove(&place);
            owner
        });
        let former = former.collect();
        self.0.insert(begin, (slot.end_bytes(), owner));
        former
    }

    /// Makes two stretches of one that goes on over a byte.
    fn cut_at(&mut self, (block, byte): (usize, u64)) {
        let before = self.0.range_mut((block, 0)..(block, byte)).next_back();
        if let Some((_, (end, owner))) = before.filter(|(_, (end, _))| *end > byte) {
            let rest = (std::mem::replace(end, byte), *owner);
            self.0.insert((block, byte), rest);
        }
    }
}

fn barrier_of(graph: &Declared<'_>, resource: ResourceId, need: &Need, wait: Wait) -> Barrier {
    let transition = match graph.resource(resource).desc {
        ResourceDesc::Image(_) => Some(wait.transition),
        ResourceDesc::Buffer(_) => None,
    };
    Barrier { resource, cause: wait.cause, tenants: Vec::new(), src: wait.src, dst: need.scope, transition }
}
