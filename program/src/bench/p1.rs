//! `surfel bench p1`: levels of detail in the making (Pajarola, Sainz, Guidotti 2003, table 1), without a device.

use std::{cell::Cell, time::Instant};

use surfel::{
    Progress, Result,
    geometry::hierarchy::{Hierarchy, STEPS},
    report::{
        Spread,
        bench::{HierarchyReport, HierarchyRow},
    },
    scene::Splats,
};

use super::{context::BenchContext, model::Source};

/// So many give an interval.
const BUILDS: usize = 6;

/// Measures it at each number of splats.
///
/// # Errors
/// A model that is no mesh; more splats than there is memory for.
pub fn measure(context: &mut BenchContext<'_>) -> Result<HierarchyReport> {
    let source = Source::open(context)?;
    let mut report = HierarchyReport { threads: rayon::current_num_threads(), ..HierarchyReport::default() };
    for splats in context.arguments.hierarchy_splats() {
        let loaded = source.scene(splats, context)?;
        for object in &loaded.scene.objects {
            report.model.clone_from(&object.name);
            report.rows.push(row(&object.splats, context)?);
        }
        context.inputs.extend(loaded.inputs);
    }
    Ok(report)
}

fn row(splats: &Splats, context: &BenchContext<'_>) -> Result<HierarchyRow> {
    let (mut octree_secs, mut all_secs) = (Vec::new(), Vec::new());
    let mut hierarchy = None;
    for _ in 0..BUILDS {
        // Not two of them at a time.
        drop(hierarchy.take());
        let clock = Clock { begin: Instant::now(), octree_secs: Cell::new(0.0), bars: &context.bars };
        let built = Hierarchy::build(splats, &clock)?;
        all_secs.push(clock.begin.elapsed().as_secs_f64());
        octree_secs.push(clock.octree_secs.get());
        hierarchy = Some(built);
    }
    let of = |count: fn(&Hierarchy) -> u64| hierarchy.as_ref().map_or(0, count);
    Ok(HierarchyRow {
        splats: splats.len() as u64,
        nodes: of(|hierarchy| hierarchy.tree.len() as u64),
        levels: of(|hierarchy| hierarchy.levels.len() as u64),
        bytes: of(Hierarchy::bytes),
        octree_secs: Spread::of(octree_secs),
        all_secs: Spread::of(all_secs),
    })
}

/// Looks at the time when the octree is done.
struct Clock<'a> {
    begin: Instant,
    octree_secs: Cell<f64>,
    bars: &'a dyn Progress,
}

impl Progress for Clock<'_> {
    fn step(&self, task: &str, done: u64, total: u64) {
        if task == STEPS[0] && done == total {
            self.octree_secs.set(self.begin.elapsed().as_secs_f64());
        }
        self.bars.step(task, done, total);
    }
}
