//! Objects in levels of detail: their own splats, and the nodes that stand for them.

use super::{
    super::{levels::Leveled, made_levels::made_levels, part::Numbers, refinements::Refinements},
    Cut,
};
use crate::{
    error::Result,
    scene::{Epsilon, HybridLevels, LeveledObject, Object, Order},
};

impl Cut<'_, '_> {
    /// An object in levels of detail, which are made here, and the numbers of its leaves where such are kept; `None` where it has no room for any.
    pub(super) fn leveled(&mut self, object: &Object) -> Result<Option<(LeveledObject, Option<Vec<u32>>)>> {
        self.step(0);
        let Some(made) = made_levels(object, self.numbered)? else { return Ok(None) };
        self.prepared.defects.merge(&made.defects);
        self.total += made.object.nodes.len() as u64;
        self.done += made.defects.total() as u64;
        Ok(Some((made.object, made.numbers)))
    }

    /// Its own splats, then the nodes, which have ε in radii of their own. `numbers`: of its own splats, where they are known.
    pub(super) fn levels(
        &mut self,
        (number, object, hybrid): (usize, &LeveledObject, Option<&HybridLevels>),
        (epsilon, auto): (Option<Epsilon>, bool),
        numbers: Option<&[u32]>,
    ) -> Result<()> {
        if self.budget {
            self.prepared.refinements.push(Refinements::of(object));
        }
        let leveled = &Leveled::of(object, numbers, hybrid);
        let levels = |nodes: bool| Some((leveled, leveled.chunk(nodes)));
        let numbers = leveled.numbers.as_deref().map_or(Numbers::Unknown, Numbers::Listed);
        let leaves = (number, &leveled.leaves, numbers);
        self.part_of(leaves, (epsilon, auto), Order::Input, levels(false))?;
        let nodes = (number, &leveled.nodes, Numbers::Unknown);
        self.part_of(nodes, (epsilon, false), Order::Input, levels(true))
    }
}
