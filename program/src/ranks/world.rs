//! All processes of a picture, and what they reduce together.

use mpi::{
    Threading,
    collective::SystemOperation,
    environment::Universe,
    topology::{Communicator, SimpleCommunicator},
    traits::{CommunicatorCollectives, Root},
};
use surfel::{Error, Result};

/// So many numbers are reduced at once: what is received needs room beside what is sent, and MPI counts in 31 bits.
const NUMBERS_AT_ONCE: usize = 1 << 22;

/// This process among all.
pub struct Ranks {
    world: SimpleCommunicator,
    /// Ends MPI when all is done.
    _universe: Universe,
}

impl Ranks {
    /// Joins the others.
    ///
    /// # Errors
    /// [`surfel::ErrorKind::Option`] where MPI was begun before.
    pub fn join() -> Result<Self> {
        // Drivers and readers have threads of their own, none of which calls MPI.
        let begun = mpi::initialize_with_threading(Threading::Funneled);
        let (universe, _) = begun.ok_or_else(|| Error::option("mpirun", "MPI was begun already"))?;
        Ok(Self { world: universe.world(), _universe: universe })
    }

    /// The number of this process, from 0 on.
    pub fn number(&self) -> u32 {
        self.world.rank().unsigned_abs()
    }

    /// How many there are.
    pub fn count(&self) -> u32 {
        self.world.size().unsigned_abs().max(1)
    }

    /// Whether this is the one that speaks and writes the picture.
    pub fn is_first(&self) -> bool {
        self.number() == 0
    }

    /// What was done, if all processes have done it: none waits for one that has given up. All call this at the same place.
    ///
    /// # Errors
    /// This process's own, or that another one has failed.
    pub fn agree<T>(&self, done: Result<T>) -> Result<T> {
        let (own, mut most) = (u32::from(done.is_err()), 0_u32);
        self.world.all_reduce_into(&own, &mut most, SystemOperation::max());
        match done {
            Ok(_) if most > 0 => {
                Err(Error::option("mpirun", "another process has failed, and says why in a line of its own"))
            }
            done => done,
        }
    }

    /// What the first process says, for all of them.
    pub fn first_says(&self, own: bool) -> bool {
        let (own, mut most) = (u32::from(self.is_first() && own), 0_u32);
        self.world.all_reduce_into(&own, &mut most, SystemOperation::max());
        most > 0
    }

    /// The largest of all processes' values, for all of them.
    pub fn largest_of(&self, values: &mut [f32]) {
        let mut received = vec![0.0_f32; values.len().min(NUMBERS_AT_ONCE)];
        for values in values.chunks_mut(NUMBERS_AT_ONCE) {
            let received = &mut received[..values.len()];
            self.world.all_reduce_into(&*values, received, SystemOperation::max());
            values.copy_from_slice(received);
        }
    }

    /// The sums of all processes' values, for the first of them.
    pub fn sums_of(&self, values: &mut [f32]) {
        let first = self.world.process_at_rank(0);
        if !self.is_first() {
            for values in values.chunks(NUMBERS_AT_ONCE) {
                first.reduce_into(values, SystemOperation::sum());
            }
            return;
        }
        let mut received = vec![0.0_f32; values.len().min(NUMBERS_AT_ONCE)];
        for values in values.chunks_mut(NUMBERS_AT_ONCE) {
            let received = &mut received[..values.len()];
            first.reduce_into_root(&*values, received, SystemOperation::sum());
            values.copy_from_slice(received);
        }
    }
}
