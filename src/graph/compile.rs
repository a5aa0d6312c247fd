//! From a graph to a plan, stage by stage.

use super::{
    alias::{MemoryNeed, alias},
    barrier::barriers,
    cull::cull,
    declare::Graph,
    lifetime::{Usage, lifetimes},
    load_store::rendering,
    order::order,
    plan::{CulledPass, Plan, PlannedPass, PlannedResource},
    resource::{ResourceDesc, ResourceId},
    validate::{kind_of, validate},
};
use crate::error::Result;

/// A plan and what its passes record.
#[derive(Debug)]
pub struct Compiled<Body> {
    /// The plan.
    pub plan: Plan,
    /// The bodies of [`Plan::passes`], in the same order.
    pub bodies: Vec<Body>,
}

impl<Body> Graph<Body> {
    /// Compiles the graph. `needs` says of each transient that is used, in the order of declaration, what memory it
    /// needs: only a device knows.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Graph`] for an illegal graph, with the first mistake; and whatever `needs` fails with.
    pub fn compile(
        self,
        needs: impl FnMut(ResourceId, &ResourceDesc, Usage) -> Result<MemoryNeed>,
    ) -> Result<Compiled<Body>> {
        let graph = &self.declared;
        // First of all, so that no later stage meets what it can't handle.
        validate(graph)?;
        // Before lifetimes, so that what isn't executed holds no memory.
        let live = cull(graph);
        // Lifetimes are counted in places in this order.
        let order = order(&live);
        // Transients are created for these usages, before a device can say what memory they need.
        let lifetimes = lifetimes(graph, &order);
        // Before barriers: a new tenant waits on the former ones.
        let (blocks, slots) = alias(graph, &lifetimes, needs)?;
        // The only synchronization there is.
        let mut barriers = barriers(graph, &order, &lifetimes, &slots);
        // Load and store operations need to know whose results are read: they come with each pass.
        let mut passes = Vec::with_capacity(order.len());
        for (&i, batch) in order.iter().zip(&mut barriers.passes) {
            let pass = &graph.passes[i];
            passes.push(PlannedPass {
                name: pass.name.clone(),
                kind: kind_of(pass)?,
                barriers: std::mem::take(batch),
                rendering: rendering(graph, &live, pass),
                uses: pass.uses.clone(),
                side_effect: pass.side_effect,
            });
        }
        let culled = graph.passes.iter().zip(&live.passes).filter(|(_, live)| !**live);
        let plan = Plan {
            resources: (graph.resources.iter().zip(&lifetimes).zip(&slots).zip(&barriers.end))
                .map(|(((resource, &(usage, lifetime)), &slot), &end)| PlannedResource {
                    name: resource.name.to_string(),
                    desc: resource.desc,
                    origin: resource.origin,
                    usage,
                    lifetime,
                    slot,
                    end,
                })
                .collect(),
            passes,
            final_barriers: barriers.final_,
            blocks,
            culled: culled
                .map(|(pass, _)| CulledPass { name: pass.name.clone(), uses: pass.uses.clone() })
                .collect(),
        };
        let bodies = self.bodies.into_iter().zip(live.passes).filter_map(|(body, live)| live.then_some(body));
        Ok(Compiled { plan, bodies: bodies.collect() })
    }
}
