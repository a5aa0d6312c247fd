//! From a graph to a plan, stage by stage.

use super::{
    alias::{MemoryNeed, alias},
    barrier::barriers,
    cull::cull,
    declare::{Graph, Pass, Resource},
    lifetime::{Usage, lifetimes},
    load_store::rendering,
    plan::{CulledPass, Plan, PlannedPass, PlannedResource},
    resource::{ResourceDesc, ResourceId},
    validate::validate,
};
use crate::error::Result;

impl<Body> Graph<'_, Body> {
    /// Compiles the graph. `needs` says of each transient that is used, in the order of declaration, what memory it
    /// needs: only a device knows.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Graph`] for an illegal graph, with the first mistake; and whatever `needs` fails with.
    pub fn compile(
        &self,
        needs: impl FnMut(ResourceId, &ResourceDesc, Usage) -> Result<MemoryNeed>,
    ) -> Result<Plan> {
        let graph = &self.declared;
        // First of all, so that no later stage meets what it can't handle.
        let kinds = validate(graph)?;
        // Before lifetimes, so that what isn't executed holds no memory; they are counted in places in its order.
        let live = cull(graph);
        // Transients are created for these usages, before a device can say what memory they need.
        let lifetimes = lifetimes(graph, &live.order);
        // Before barriers: a new tenant waits on the former ones.
        let (blocks, slots) = alias(graph, &lifetimes, needs)?;
        // The only synchronization there is.
        let barriers = barriers(graph, &live.order, &lifetimes, &slots);
        // Load and store operations need to know whose results are read.
        let rendering: Vec<_> =
            live.order.iter().map(|&pass| rendering(graph, &live, &graph.passes[pass])).collect();

        let resources = graph.resources.iter().zip(lifetimes).zip(slots).zip(barriers.end);
        let resources = resources.map(|(((resource, (usage, lifetime)), slot), end)| {
            let Resource { name, desc, origin, .. } = *resource;
            PlannedResource { name: name.to_string(), desc, origin, usage, lifetime, slot, end }
        });
        let mut executed = live.order.iter().zip(barriers.passes).zip(rendering).peekable();
        let (mut passes, mut culled) = (Vec::with_capacity(live.order.len()), Vec::new());
        for ((declared, pass), kind) in graph.passes.iter().enumerate().zip(kinds) {
            let Pass { name, why, role, uses, side_effect, .. } = *pass;
            let (name, uses) = (name.to_owned(), uses.to_vec());
            match executed.next_if(|((next, _), _)| **next == declared) {
                Some(((_, barriers), rendering)) => {
                    passes.push(PlannedPass {
                        name,
                        why,
                        role,
                        declared,
                        kind,
                        barriers,
                        rendering,
                        uses,
                        side_effect,
                    });
                }
                None => culled.push(CulledPass { name, declared, uses }),
            }
        }
        let resources = resources.collect();
        Ok(Plan { resources, passes, final_barriers: barriers.final_, blocks, culled })
    }
}
