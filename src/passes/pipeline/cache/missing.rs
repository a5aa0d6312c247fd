//! What a frame does about a pipeline that is not there yet.

/// What is done where a frame needs a pipeline that is not there yet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MissingPipelines {
    /// It is made: on a GPU's driver that may take milliseconds, once.
    #[default]
    Make,
    /// The frame is refused ([`crate::ErrorKind::NotReady`]), before anything is recorded of it.
    Refuse,
    /// It is made as long as no more than so many were made in all ([`crate::renderer::Renderer::pipelines_made`]); beyond, the frame is refused. A host that asks again and again goes on between.
    UpTo(u64),
}
