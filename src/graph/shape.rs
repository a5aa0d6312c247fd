//! Plans that serve again: frame after frame declares the same graph, in which only the sizes of some buffers follow the view.

use super::{
    declare::{Declared, Graph, Pass, Resource},
    plan::{Plan, PlannedResource},
    resource::ResourceDesc,
};

impl Plan {
    /// Whether a graph compiles to this plan, but for the sizes of buffers and so for places in memory.
    pub(super) fn has_shape_of<Body>(&self, graph: &Graph<'_, Body>) -> bool {
        let Declared { resources, passes, .. } = &graph.declared;
        let mut live = self.passes.iter().peekable();
        let mut culled = self.culled.iter().peekable();
        let is_planned = |(place, pass): (usize, &Pass<'_>)| {
            let live = live.next_if(|live| live.declared == place);
            let live = live.map(|live| (&*live.name, &*live.uses, live.side_effect));
            let mut culled = || culled.next_if(|culled| culled.declared == place);
            let planned = live.or_else(|| culled().map(|culled| (&*culled.name, &*culled.uses, false)));
            pass.foreign.is_none() && planned == Some((pass.name, pass.uses, pass.side_effect))
        };
        self.resources.len() == resources.len()
            && self.passes.len() + self.culled.len() == passes.len()
            && self.resources.iter().zip(resources).all(|(planned, resource)| is_alike(planned, resource))
            && passes.iter().enumerate().all(is_planned)
    }

    /// Whether the buffers of a graph of the same shape have the plan's sizes, too.
    pub(super) fn has_sizes_of<Body>(&self, graph: &Graph<'_, Body>) -> bool {
        self.resources
            .iter()
            .zip(&graph.declared.resources)
            .all(|(planned, resource)| planned.desc == resource.desc)
    }

    /// Takes over the sizes of a graph of the same shape, whose transients have places as large in the plan.
    pub(super) fn resize<Body>(&mut self, graph: &Graph<'_, Body>) {
        for (planned, resource) in self.resources.iter_mut().zip(&graph.declared.resources) {
            planned.desc = resource.desc;
        }
    }
}

fn is_alike(planned: &PlannedResource, resource: &Resource<'_>) -> bool {
    let alike = match (planned.desc, resource.desc) {
        (ResourceDesc::Buffer(a), ResourceDesc::Buffer(b)) => a.texels == b.texels && b.size_bytes > 0,
        (a, b) => a == b,
    };
    alike && planned.origin == resource.origin && planned.name == resource.name
}
