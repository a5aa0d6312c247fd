//! What a frame does about a pipeline that is not there yet.

/// What is done where a frame needs a pipeline that is not there yet.
///
/// ```no_run
/// use surfel::{ErrorKind, ash::vk, embed::{MissingPipelines, Renderer, View, ViewFrame}};
///
/// /// Whether there is a frame to draw; while another thread compiles ahead, there is none, and no hitch.
/// unsafe fn prepared(view: &mut View, renderer: &Renderer, commands: vk::CommandBuffer, frame: ViewFrame<'_>) -> surfel::Result<bool> {
///     let frame = ViewFrame { missing: MissingPipelines::Refuse, ..frame };
///     // SAFETY: this function's contract, that of `prepare`.
///     match unsafe { view.prepare(renderer, commands, &frame) } {
///         Err(error) if matches!(error.kind(), ErrorKind::NotReady { .. }) => Ok(false),
///         prepared => prepared.map(|()| true),
///     }
/// }
/// ```
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
