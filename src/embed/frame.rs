//! What a host says of a frame.

use ash::vk;

use crate::{
    graph::{ImageState, execute::Profile},
    passes::MissingPipelines,
    prepare::Placed,
    scene::{HostCamera, Settings},
};

/// What a view shows in a frame, and from where.
///
/// ```no_run
/// use surfel::{Settings, embed::{HostCamera, Placed, ViewFrame}};
///
/// /// The right one of two pictures side by side.
/// fn right<'a>(scenes: &'a [Placed<'a>], camera: &'a HostCamera, settings: &'a Settings) -> ViewFrame<'a> {
///     ViewFrame { corner_px: [settings.size_px[0] as i32, 0], ..ViewFrame::new(scenes, camera, settings) }
/// }
/// ```
#[derive(Clone, Copy)]
pub struct ViewFrame<'a> {
    /// What is shown, each where it stands: the list may differ from frame to frame, nothing is uploaded by that.
    pub scenes: &'a [Placed<'a>],
    /// From where.
    pub camera: &'a HostCamera,
    /// From where the frame before was seen, of which motion follows; `None`: from there, too. Its picture had the same size.
    pub camera_before: Option<&'a HostCamera>,
    /// What the camera's matrices show is a mirror's picture, as a planar reflection of the host's is: its view turned over by the mirror's plane, or its projection along x. Who has flipped no
    /// mirror into them has y the wrong way around ([`HostCamera::flips_y`]), or a left-handed world ([`HostCamera::of_left_handed`]): so it is said, and refused where it is not said.
    pub mirrored: bool,
    /// How. The size is the view's, in pixels; the background is the host's picture, whatever is said here.
    pub settings: &'a Settings,
    /// Where the view's top left corner lies in the host's images, in pixels.
    pub corner_px: [i32; 2],
    /// What the host has drawn hides transparent things pixel by pixel between each other: its depth. Needed where anything is transparent
    /// and the host's rendering has a depth; what is opaque is tested by the host's own test in [`super::View::draw`].
    pub hides: Option<DepthImage>,
    /// What is done where the frame needs a pipeline that is not there yet.
    pub missing: MissingPipelines,
    /// Each pass is timed, for [`super::View::profile`].
    pub profile: Option<Profile>,
}

impl<'a> ViewFrame<'a> {
    /// Scenes, seen by a camera, in the top left corner of the host's images, with nothing of the host's that hides, nothing timed, nothing moved, and no mirror; pipelines are
    /// made.
    pub fn new(scenes: &'a [Placed<'a>], camera: &'a HostCamera, settings: &'a Settings) -> Self {
        let missing = MissingPipelines::Make;
        Self {
            scenes,
            camera,
            camera_before: None,
            mirrored: false,
            settings,
            corner_px: [0; 2],
            hides: None,
            missing,
            profile: None,
        }
    }
}

/// The depth of what a host has drawn so far.
///
/// ```no_run
/// use surfel::{ash::vk, embed::{DepthImage, ImageState, ViewFrame}};
///
/// /// The host's opaque pass came just before, and its pass of the rest comes just after, both with `image` as their depth.
/// fn between<'a>(frame: ViewFrame<'a>, image: vk::Image, view: vk::ImageView, extent: vk::Extent2D) -> ViewFrame<'a> {
///     let (format, attached) = (vk::Format::D32_SFLOAT, ImageState::DEPTH_ATTACHMENT);
///     let depth = DepthImage { image, view, format, extent, layer: 0, before: attached, after: attached };
///     ViewFrame { hides: Some(depth), ..frame }
/// }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct DepthImage {
    /// The image: one sample a pixel, one mip level; usage `SAMPLED`.
    pub image: vk::Image,
    /// A view of its depth alone, of one layer.
    pub view: vk::ImageView,
    /// Its format.
    pub format: vk::Format,
    /// Width and height in pixels.
    pub extent: vk::Extent2D,
    /// The layer that the view shows: of an image that has one for each eye, say. All else of the image is left as it is.
    pub layer: u32,
    /// What was done with it just before: its writes are waited for.
    pub before: ImageState,
    /// What will be done with it just after; it is left in that layout.
    pub after: ImageState,
}
