//! What the commands of uploads copy from, kept until the device has told that it has run them: so it does not matter in which epoch they are submitted.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

use super::{device::Device, staging::Staging};

/// The batches of an upload, for the scene that they are copied to. They go when the device has run them all, or with the scene.
#[derive(Default)]
pub(crate) struct Upload(Arc<Batches>);

type Batches = Mutex<Vec<Staging>>;

/// The uploads of a device that may not have run yet.
#[derive(Default)]
pub(super) struct Uploads(Mutex<Vec<Weak<Batches>>>);

impl Upload {
    /// Keeps a batch that tells when it has run ([`Staging::record_and_tell`]).
    pub fn keep(&self, batch: Staging) {
        lock(&self.0).push(batch);
    }

    /// Lets the device look for batches that have run, from now on, when an epoch is done.
    pub fn begin(self, device: &Device) -> Self {
        lock(&device.0.uploads.0).push(Arc::downgrade(&self.0));
        self
    }
}

impl Uploads {
    /// Lets go what has run. What it was submitted in may go on, or its epoch not have ended: its memory goes with that.
    pub fn let_go(&self) {
        let mut all = lock(&self.0);
        all.retain(|upload| {
            let batches = upload.upgrade();
            batches.is_some_and(|batches| {
                let mut batches = lock(&batches);
                batches.retain(|batch| !batch.has_run());
                !batches.is_empty()
            })
        });
    }
}

/// A panic while it is held leaves what was there.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
