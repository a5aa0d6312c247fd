//! A picture of several samples a pixel: a frame for each, added up on the device.

use super::{Frame, Headless, Wanted};
use crate::{
    error::{Error, Result},
    prepare::PreparedScene,
    scene::{Camera, Samples, Settings},
};

impl Headless {
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
        let offsets_px = settings.samples.offsets_px(settings.kernel);
        let mut before = [0.0; 2];
        let mut last = None;
        for (number, offset_px) in offsets_px.iter().enumerate() {
            let ends = (number == 0, number + 1 == offsets_px.len());
            let frame = self.render_frame(scene, &camera.sample(*offset_px), settings, wanted, Some(ends))?;
            before = [before[0] + frame.wall_secs, before[1] + frame.record_secs];
            last = Some(frame);
        }
        let Some(frame) = last else { return Err(Error::option("--samples", "0: expected 1 or more")) };
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
