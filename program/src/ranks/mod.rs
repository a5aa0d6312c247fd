//! `mpirun -n 4 surfel render …`: one picture by several processes, each of which has a part of it (`--features mpi`).

#[cfg(feature = "mpi")]
mod draw;
#[cfg(feature = "mpi")]
mod frame;
#[cfg(feature = "mpi")]
mod world;

use std::env;

use surfel::Result;

use crate::render::RenderArguments;

/// Where a launcher of MPI says how many processes it started: Open MPI; MPICH and Slurm.
const SIZES: [&str; 2] = ["OMPI_COMM_WORLD_SIZE", "PMI_SIZE"];

/// How many processes were started together with this one; `None` of one that was started by itself.
fn started() -> Option<u32> {
    SIZES.iter().find_map(|name| env::var(name).ok()?.parse().ok())
}

/// Draws the picture together with the processes that a launcher of MPI has started; `None` where it was started by itself.
///
/// # Errors
/// As [`draw::run`]; of a program without MPI, that it has none.
#[cfg(feature = "mpi")]
pub fn run(arguments: &RenderArguments) -> Option<Result<()>> {
    started().map(|_| draw::run(arguments, &world::Ranks::join()?))
}

/// As above, of a program without MPI: refuses to draw the same picture as often as there are processes.
#[cfg(not(feature = "mpi"))]
pub fn run(_arguments: &RenderArguments) -> Option<Result<()>> {
    let problem = |count| {
        format!(
            "{count} processes of a surfel without MPI; expected one built with: cargo build --release --features mpi"
        )
    };
    started().filter(|count| *count > 1).map(|count| Err(surfel::Error::option("mpirun", problem(count))))
}
