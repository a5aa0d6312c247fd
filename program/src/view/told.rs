//! What the threads that read files, and draw ahead, tell the window.

use std::sync::mpsc::SyncSender;

use surfel::{Error, Result, prepare::PreparedScene, vk::Staging};

use super::{ahead::Ran, document::Document};

/// What a thread tells the window.
pub enum News {
    /// Files are read.
    Opened(Box<Document>),
    /// A scene is on the device; as the last step of its preparation, or as one before.
    Prepared(Box<Prepared>),
    /// Bytes of a job are to be submitted; the thread waits for the answer, and keeps what they go to until then.
    Upload(Staging, u64, SyncSender<Result<()>>),
    /// A picture is written, or not.
    Written,
    /// Another device has drawn pictures.
    Ran(Ran),
    /// Shaders were compiled anew, so many; or what is wrong with them.
    #[cfg(feature = "live-shaders")]
    Shaders(std::result::Result<usize, String>),
    /// Files can't be read.
    Unread(Error),
    /// A scene has no room on the device.
    Failed(Error),
}

/// A scene on the device.
pub struct Prepared {
    /// The scene.
    pub scene: PreparedScene,
    /// How much of it that is.
    pub step: Step,
    /// It is the last of them.
    pub is_last: bool,
    /// The number of the job.
    pub job: u64,
}

/// How far a preparation is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Step {
    /// A part of its splats, larger.
    Part,
    /// All of it.
    Whole,
    /// All of it, and levels of detail for moving pictures.
    Leveled,
}
