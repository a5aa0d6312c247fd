//! What is to be recorded, as plain data.

use super::{
    access::PassKind,
    alias::{Block, Slot},
    barrier::{Barrier, Batch},
    declare::{Role, Use},
    lifetime::{Lifetime, Usage},
    load_store::Rendering,
    resource::{Origin, ResourceDesc, ResourceId, State},
};

/// A compiled graph. The module's head says what its execution may rely on.
#[derive(Clone, Debug)]
pub struct Plan {
    /// All declared resources, by [`ResourceId::index`].
    pub resources: Vec<PlannedResource>,
    /// The passes in the order of execution.
    pub passes: Vec<PlannedPass>,
    /// What brings the imports into their final states after the last pass.
    pub final_barriers: Vec<Barrier>,
    /// The memory of the transients.
    pub blocks: Vec<Block>,
    /// The passes that were left out, as declared.
    pub culled: Vec<CulledPass>,
}

/// A resource.
#[derive(Clone, Debug)]
pub struct PlannedResource {
    /// Its name.
    pub name: String,
    /// What it is.
    pub desc: ResourceDesc,
    /// Where it comes from.
    pub origin: Origin,
    /// What it is created for; an import must have been created for at least that.
    pub usage: Usage,
    /// When it is used; `None` where no pass that is left uses it.
    pub lifetime: Option<Lifetime>,
    /// Its memory; `None` for imports and where it isn't used.
    pub slot: Option<Slot>,
    /// In which state the plan leaves it: the declared one for an import that has one. It can be the initial state
    /// of an import in whatever comes next.
    pub end: State,
}

/// A pass that is executed.
#[derive(Clone, Debug)]
pub struct PlannedPass {
    /// Its name: debug label and key of its time.
    pub name: String,
    /// Why the frame has it; empty where it did not say.
    pub why: &'static str,
    /// What it does, where it said so.
    pub role: Role,
    /// Its place among the declared passes.
    pub declared: usize,
    /// What it records.
    pub kind: PassKind,
    /// What has to happen before it.
    pub barriers: Batch,
    /// What it renders to; `Some` exactly for [`PassKind::Graphics`].
    pub rendering: Option<Rendering>,
    /// All its accesses, as declared.
    pub uses: Vec<Use>,
    /// It was kept whatever becomes of its results.
    pub side_effect: bool,
}

/// A pass whose results nobody reads.
#[derive(Clone, Debug)]
pub struct CulledPass {
    /// Its name.
    pub name: String,
    /// Its place among the declared passes.
    pub declared: usize,
    /// All its accesses, as declared.
    pub uses: Vec<Use>,
}

impl Plan {
    /// A resource by its name in the graph.
    pub fn resource(&self, id: ResourceId) -> &PlannedResource {
        &self.resources[id.index()]
    }
}
