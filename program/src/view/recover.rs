//! What a window does after an error: goes on with other settings or another device, or ends.

use std::time::{Duration, Instant};

use surfel::{Error, ErrorKind, Result, scene::Settings};

use super::{
    anchor::Anchor,
    device::{is_device_lost, open_again},
    document::Document,
    meanwhile::Before,
    ui::Ui,
    viewer::Viewer,
};

/// A device that is lost more often is not opened again.
const ONCE_IN: Duration = Duration::from_secs(10);

impl Viewer {
    /// Goes on after an error, if that is possible: with settings that are accepted, or on another device.
    ///
    /// # Errors
    /// The error, where it is not.
    pub fn recover(&mut self, error: Error) -> Result<()> {
        self.steps = None;
        // Methods that a camera rules out, and cameras beyond what 32 bits tell apart.
        if let (ErrorKind::Option { .. }, Some(Before { settings, camera, .. })) =
            (error.kind(), self.drawn.take())
        {
            self.tell(&error.to_string());
            self.settings = settings;
            // What was made transparent since then has no eye-dome lighting.
            let is_refused = |document: &Document| {
                self.edits.check(&document.scene, &document.paged, &self.settings).is_err()
            };
            if self.document.as_ref().is_some_and(is_refused) {
                self.settings.shading = Settings::default().shading;
            }
            if let Some(navigation) = &mut self.navigation {
                navigation.camera = camera;
            }
            self.changed();
            return Ok(());
        }
        let now = Instant::now();
        let again_so_soon = self.lost.is_some_and(|lost| now - lost < ONCE_IN);
        if !is_device_lost(&error) || again_so_soon {
            return Err(error);
        }
        self.lost = Some(now);
        self.scene_number += 1;
        (self.prepared, self.coming, self.warm, self.anchor) = (None, None, None, Anchor::default());
        self.gpu = open_again(&self.window, &mut self.gpu, &self.options.device)?;
        let reading = self.ui.reading.take();
        self.ui = Ui::new(self.window.scale_factor() as f32);
        self.ui.reading = reading;
        self.tell("the device was lost and is opened again");
        self.prepare(true);
        self.changed();
        Ok(())
    }
}
