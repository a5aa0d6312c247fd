//! A picture of several samples a pixel: a frame for each, added up on the device.

use super::{Frame, Headless, Wanted};
use crate::{
    error::{Error, Result},
    prepare::PreparedScene,
    scene::{Camera, Samples, Settings},
};

fn refused(number: usize, expected: &str) -> Error {
    Error::option("--samples", format!("{number}: {expected}"))
}

impl Headless {
    /// Renders one sample of a picture, without the surface, and waits for it: for hosts that go on between samples. They are numbered from 0, in turn; the last one's frame has the picture,
    /// and is the only one that has. What else is rendered meanwhile, picks and counts aside, begins the picture anew.
    ///
    /// # Errors
    /// As [`Headless::render`]; [`crate::ErrorKind::Option`] for a number that is not below [`Settings::samples`].
    pub fn render_sample(
        &mut self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
        wanted: Wanted,
        number: usize,
    ) -> Result<Frame> {
        let wanted = Wanted { surface: false, ..wanted };
        let offsets_px = settings.samples.offsets_px(settings.kernel);
        let Some(offset_px) = offsets_px.get(number) else {
            return Err(refused(number, "expected a number below that of all samples"));
        };
        let ends = (offsets_px.len() > 1).then_some((number == 0, number + 1 == offsets_px.len()));
        let camera = ends.map_or(*camera, |_| camera.sample(*offset_px));
        self.render_frame(scene, &camera, settings, wanted, ends)
    }

    /// The frames of all samples; the surface is that of one in the middle.
    pub(super) fn render_samples(
        &mut self,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
        wanted: Wanted,
    ) -> Result<Frame> {
        let surface = match wanted.surface {
            true => {
                let one = Settings { samples: Samples(1), ..settings.clone() };
                Some(self.render_frame(scene, camera, &one, Wanted { profile: None, ..wanted }, None)?)
            }
            false => None,
        };
        let wanted = Wanted { surface: false, ..wanted };
        let mut before = [0.0; 2];
        let mut last = None;
        for number in 0..settings.samples.0 as usize {
            let frame = self.render_sample(scene, camera, settings, wanted, number)?;
            before = [before[0] + frame.wall_secs, before[1] + frame.record_secs];
            last = Some(frame);
        }
        let Some(frame) = last else { return Err(refused(0, "expected 1 or more")) };
        let [wall_secs, record_secs] = before;
        let frame = Frame { wall_secs, record_secs, ..frame };
        Ok(match surface {
            Some(Frame { weight, albedo, normal, depth, .. }) => {
                Frame { weight, albedo, normal, depth, ..frame }
            }
            None => frame,
        })
    }
}
