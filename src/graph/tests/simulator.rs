//! A slow and obvious model of what Vulkan promises, which finds the races of a plan. It knows the plan and the table
//! of accesses, and shares nothing with the stage that makes barriers.
//!
//! Memory is cut into cells. Each cell remembers every access ("event") since the program began; an event knows
//! which stages are ordered after it, whether what it wrote is available, and to whom it is visible. A barrier
//! extends that for the cells of its own resource only, which is stricter than Vulkan. The plan runs twice.

use std::collections::{BTreeSet, HashMap};

use ash::vk::{AccessFlags2, ImageLayout, PipelineStageFlags2 as Stages};

use super::*;
use crate::graph::{access::writes_of, track::bits};

type Pairs = BTreeSet<(u64, u64)>;

#[derive(Clone)]
struct Event {
    what: String,
    /// Through which resource.
    resource: ResourceId,
    /// Events of one pass (or one caller's state) don't conflict with each other.
    moment: usize,
    /// One stage; 0 for a change of the layout, which has none.
    stage: u64,
    writes: u64,
    ordered_before: u64,
    available: bool,
    visible: Pairs,
}

impl Event {
    /// One that nothing has waited for yet.
    fn new(what: &str, resource: ResourceId, moment: usize, stage: u64, writes: u64) -> Self {
        let (what, visible) = (what.to_owned(), Pairs::new());
        Self { what, resource, moment, stage, writes, ordered_before: 0, available: false, visible }
    }
}

#[derive(Default)]
struct Memory {
    events: HashMap<Cell, Vec<Event>>,
    /// Which content of which resource a cell holds.
    contents: HashMap<Cell, (ResourceId, u32)>,
    layouts: HashMap<ResourceId, ImageLayout>,
    moment: usize,
}

/// A stretch of bytes of a block, or a whole import.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
enum Cell {
    Bytes(usize, u64),
    Import(ResourceId),
}

/// Executes the plan twice; the first race, lost content or wrong layout.
pub fn check(plan: &Plan) -> Result<(), String> {
    let mut memory = Memory::default();
    for round in 0..2 {
        memory.begin(plan);
        for pass in &plan.passes {
            memory.batch(plan, &pass.barriers.memory, &pass.barriers.resources)?;
            memory.pass(plan, pass, round)?;
        }
        memory.batch(plan, &None, &plan.final_barriers)?;
        memory.end(plan)?;
    }
    Ok(())
}

fn cells(plan: &Plan, id: ResourceId) -> Vec<Cell> {
    match plan.resource(id).slot {
        // One for each stretch between the edges of slots, named by its first byte.
        Some(slot) => {
            let mut edges: Vec<u64> = plan
                .resources
                .iter()
                .filter_map(|other| other.slot)
                .filter(|other| other.block == slot.block)
                .flat_map(|other| [other.offset_bytes, other.end_bytes()])
                .filter(|edge| (slot.offset_bytes..slot.end_bytes()).contains(edge))
                .collect();
            edges.sort_unstable();
            edges.dedup();
            edges.into_iter().map(|edge| Cell::Bytes(slot.block, edge)).collect()
        }
        None => vec![Cell::Import(id)],
    }
}

fn ids(plan: &Plan) -> impl Iterator<Item = ResourceId> + use<> {
    (0..plan.resources.len() as u32).map(ResourceId)
}

/// All combinations of the stages and accesses of a scope.
fn pairs(stages: Stages, access: u64) -> Pairs {
    bits(stages.as_raw()).flat_map(|stage| bits(access).map(move |access| (stage, access))).collect()
}

impl Memory {
    /// The caller brings every import into its initial state; transients start undefined.
    fn begin(&mut self, plan: &Plan) {
        self.moment += 1;
        for id in ids(plan) {
            match plan.resource(id).origin {
                Origin::Imported { initial, .. } => {
                    let cell = Cell::Import(id);
                    self.layouts.insert(id, initial.layout);
                    self.contents.insert(cell, (id, 0));
                    let written = writes_of(initial.access).as_raw();
                    let what = format!("the caller's access to {}", plan.resource(id).name);
                    let event = |stage| Event::new(&what, id, self.moment, stage, written);
                    let mut events: Vec<Event> = bits(initial.stages.as_raw()).map(event).collect();
                    if written == 0 && !initial.stages.is_empty() {
                        // Some write before the declared reads, which they have waited for.
                        events.push(Event {
                            writes: AccessFlags2::MEMORY_WRITE.as_raw(),
                            ordered_before: initial.stages.as_raw(),
                            available: true,
                            visible: pairs(initial.stages, initial.access.as_raw()),
                            ..event(0)
                        });
                    }
                    self.events.insert(cell, events);
                }
                Origin::Transient => {
                    self.layouts.insert(id, ImageLayout::UNDEFINED);
                }
            }
        }
    }

    fn batch(&mut self, plan: &Plan, memory: &Option<(Scope, Scope)>, all: &[Barrier]) -> Result<(), String> {
        if let Some((src, dst)) = memory {
            self.events.values_mut().for_each(|events| apply(events, *src, *dst, None));
        }
        for barrier in all {
            let name = &plan.resource(barrier.resource).name;
            for cell in cells(plan, barrier.resource) {
                let events = self.events.entry(cell).or_default();
                let Some(Transition { old, new }) = barrier.transition.filter(|t| t.old != t.new) else {
                    apply(events, barrier.src, barrier.dst, Some(barrier.resource));
                    continue;
                };
                // The change waits on the source and is a write of everything.
                for event in events.iter_mut() {
                    let covered = covers(event, barrier.src.stages);
                    let flushed = event.resource == barrier.resource && flushes(event, barrier.src);
                    if !covered || (event.writes != 0 && !event.available && !flushed) {
                        return Err(format!(
                            "the layout of {name} changes while {} is under way",
                            event.what
                        ));
                    }
                }
                apply(events, barrier.src, barrier.dst, Some(barrier.resource));
                let what = format!("the change of {name} to {new:?}");
                let write = AccessFlags2::MEMORY_WRITE.as_raw();
                events.push(Event {
                    ordered_before: barrier.dst.stages.as_raw(),
                    available: true,
                    visible: pairs(barrier.dst.stages, barrier.dst.access.as_raw()),
                    ..Event::new(&what, barrier.resource, self.moment, 0, write)
                });
                if old == ImageLayout::UNDEFINED {
                    self.contents.remove(&cell);
                } else if self.layouts[&barrier.resource] != old {
                    return Err(format!("{name} is not in the layout {old:?}"));
                }
            }
            if let Some(Transition { new, .. }) = barrier.transition {
                self.layouts.insert(barrier.resource, new);
            }
        }
        Ok(())
    }

    fn pass(&mut self, plan: &Plan, pass: &PlannedPass, round: usize) -> Result<(), String> {
        self.moment += 1;
        for usage in &pass.uses {
            let info = usage.access.info();
            let resource = plan.resource(usage.resource);
            let what = format!("pass {} of round {round} on {}", pass.name, resource.name);
            if let (ResourceDesc::Image(_), Some((layout, _))) = (resource.desc, info.image)
                && self.layouts[&usage.resource] != layout
            {
                return Err(format!("{what}: the layout is {:?}", self.layouts[&usage.resource]));
            }
            for cell in cells(plan, usage.resource) {
                if usage.needs_content() && self.contents.get(&cell) != Some(&(usage.resource, usage.version))
                {
                    return Err(format!("{what}: content {} is lost", usage.version));
                }
                self.access(cell, usage.resource, &what, info.stages, info.reads, info.writes)?;
                if usage.start.is_some() {
                    self.contents.insert(cell, (usage.resource, usage.version + 1));
                }
            }
        }
        for attachment in pass.rendering.iter().flat_map(|r| r.colors.iter().chain(&r.depth)) {
            if attachment.store == ash::vk::AttachmentStoreOp::DONT_CARE {
                for cell in cells(plan, attachment.resource) {
                    self.contents.remove(&cell);
                }
            }
        }
        Ok(())
    }

    fn access(
        &mut self,
        cell: Cell,
        resource: ResourceId,
        what: &str,
        stages: Stages,
        reads: AccessFlags2,
        writes: AccessFlags2,
    ) -> Result<(), String> {
        let events = self.events.entry(cell).or_default();
        let access = (reads | writes).as_raw();
        for event in events.iter().filter(|event| event.moment != self.moment) {
            if event.writes == 0 && writes.is_empty() {
                continue;
            }
            if event.ordered_before & stages.as_raw() != stages.as_raw() {
                return Err(format!("{what}: not ordered after {}", event.what));
            }
            if event.writes != 0 && !pairs(stages, access).is_subset(&event.visible) {
                return Err(format!("{what}: can't see {}", event.what));
            }
        }
        for stage in bits(stages.as_raw()) {
            events.push(Event::new(what, resource, self.moment, stage, writes.as_raw()));
        }
        Ok(())
    }

    /// Imports hold their last content, in their final state.
    fn end(&mut self, plan: &Plan) -> Result<(), String> {
        self.moment += 1;
        for id in ids(plan) {
            let resource = plan.resource(id);
            let Origin::Imported { final_, initial } = resource.origin else { continue };
            let uses = || {
                let live = plan.passes.iter().flat_map(|pass| &pass.uses);
                live.chain(plan.culled.iter().flat_map(|pass| &pass.uses))
                    .filter(|usage| usage.resource == id)
            };
            let last = uses().filter(|usage| usage.start.is_some()).map(|usage| usage.version + 1).max();
            let cell = Cell::Import(id);
            let had_content = initial.layout != ImageLayout::UNDEFINED || last.is_some();
            if had_content && self.contents.get(&cell) != Some(&(id, last.unwrap_or(0))) {
                return Err(format!("the last content of {} is lost", resource.name));
            }
            let state = final_.unwrap_or(resource.end);
            if self.layouts[&id] != state.layout {
                return Err(format!("{} ends in layout {:?}", resource.name, self.layouts[&id]));
            }
            if let Some(State { stages, access, .. }) = final_ {
                let writes = writes_of(access);
                let what = format!("the caller after the plan on {}", resource.name);
                self.access(cell, id, &what, stages, access & !writes, writes)?;
            }
        }
        Ok(())
    }
}

/// Whether a barrier with these source stages waits for the event, directly or by a chain.
fn covers(event: &Event, src: Stages) -> bool {
    (event.stage | event.ordered_before) & src.as_raw() != 0
}

/// Whether a barrier with this source makes available what the event wrote.
fn flushes(event: &Event, src: Scope) -> bool {
    event.stage & src.stages.as_raw() != 0 && event.writes & !src.access.as_raw() == 0
}

/// What one barrier adds to what is known of earlier events. `through`: its resource, `None` for all memory.
fn apply(events: &mut [Event], src: Scope, dst: Scope, through: Option<ResourceId>) {
    for event in events {
        if !covers(event, src.stages) {
            continue;
        }
        if event.writes != 0 && flushes(event, src) && through.is_none_or(|id| id == event.resource) {
            event.available = true;
        }
        event.ordered_before |= dst.stages.as_raw();
        if event.available {
            event.visible.extend(pairs(dst.stages, dst.access.as_raw()));
        }
    }
}
