//! How the long steps tell their caller where they are. Nothing here draws: the program does, an embedder may.

/// Is told how far loading and preparation are, and what was noticed on the way. `()` listens to nothing.
pub trait Progress {
    /// `done` of `total` parts of `task` (such as `read igea.ply`) are finished; `done = total` ends the task.
    fn step(&self, task: &str, done: u64, total: u64) {
        let _ = (task, done, total);
    }

    /// Something the user should know that is no error, such as elements left out; a sentence without a full stop.
    /// Comes once a kind, with a count.
    fn note(&self, text: &str) {
        let _ = text;
    }
}

impl Progress for () {}
