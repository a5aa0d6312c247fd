//! Levels of detail that are made when a scene is prepared.

use crate::{
    error::Result,
    geometry::hierarchy::{Hierarchy, left_by_clips},
    progress::Progress,
    scene::{DefectCounts, LeveledObject, Object, Opacity},
};

/// An object in levels of detail.
pub(super) struct MadeLevels {
    pub object: LeveledObject,
    /// The numbers of its leaves in the object as it came, where they are asked for.
    pub numbers: Option<Vec<u32>>,
    /// What was left out.
    pub defects: DefectCounts,
}

/// Progress of building levels of detail is that of one who waits for a chunk.
struct Quiet;

impl Progress for Quiet {}

/// Makes them, without defects; `None` of what is invisible, or has too few splats for a node. Splats keep their clips; nodes stand for what these leave.
///
/// # Errors
/// As [`Hierarchy::build`].
pub(super) fn made_levels(object: &Object, numbered: bool) -> Result<Option<MadeLevels>> {
    if object.splats.colors.opacity() == Opacity::Invisible {
        return Ok(None);
    }
    let mut whole = object.clone();
    let kept = |i: &u32| object.splats.defect(*i as usize).is_none();
    let kept: Option<Vec<u32>> = numbered.then(|| (0..object.splats.len() as u32).filter(kept).collect());
    let defects = whole.splats.drop_defective();
    let left = (!whole.splats.clips.is_empty()).then(|| left_by_clips(&whole.splats));
    let hierarchy = Hierarchy::build(left.as_ref().unwrap_or(&whole.splats), &Quiet)?;
    if hierarchy.tree.is_empty() {
        return Ok(None);
    }
    let numbers = kept.map(|kept| hierarchy.order.iter().map(|i| kept[*i as usize]).collect());
    Ok(Some(MadeLevels { object: hierarchy.leveled(whole, left.as_ref()), numbers, defects }))
}
