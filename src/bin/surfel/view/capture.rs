//! What leaves the window: pictures to files, cameras to the clipboard.

use std::path::PathBuf;

use surfel::{
    Result,
    renderer::Wanted,
    scene::{Camera, Settings},
};

use super::{cuts, keys::CopiedAs, on_device::OnDevice, viewer::Viewer};
use crate::{
    camera,
    outputs::PictureFormat,
    pictures::{self, Colors},
};

/// The clipboard, opened when it is first needed; under X11 what is copied is gone with it.
#[derive(Default)]
pub struct Clipboard(Option<arboard::Clipboard>);

impl Clipboard {
    /// Copies a text.
    ///
    /// # Errors
    /// What the window system told.
    fn copy(&mut self, text: &str) -> Result<(), arboard::Error> {
        let clipboard = match self.0.take() {
            Some(clipboard) => clipboard,
            None => arboard::Clipboard::new()?,
        };
        self.0.insert(clipboard).set_text(text)
    }
}

/// A camera file. Numbers come back as they are.
fn camera_file(camera: &Camera) -> String {
    let mut file = serde_json::Map::new();
    file.insert("eye".to_owned(), camera.eye.to_array().to_vec().into());
    file.insert("target".to_owned(), camera.target.to_array().to_vec().into());
    file.insert("up".to_owned(), camera.usable_up().to_array().to_vec().into());
    match camera.orthographic_height {
        Some(height) => file.insert("orthographic".to_owned(), height.into()),
        None => file.insert("fov_deg".to_owned(), camera::degrees(camera.fov_y_rad).into()),
    };
    file.extend(camera.near.map(|near| ("near".to_owned(), near.into())));
    serde_json::Value::Object(file).to_string()
}

/// The first name of a series that no file has.
pub fn free_name(series: &str, ending: &str) -> PathBuf {
    let name = |number: u32| PathBuf::from(format!("{series}-{number:03}.{ending}"));
    (1..).map(name).find(|path| !path.exists()).unwrap_or_else(|| name(0))
}

impl Viewer {
    /// Copies the camera, and prints it.
    pub fn copy_camera(&mut self, how: CopiedAs) {
        let Some(camera) = self.camera() else { return };
        let text = match how {
            CopiedAs::Options => {
                let cuts = cuts::words(&self.settings);
                [camera::words(&camera), cuts].join(" ").trim_end().to_owned()
            }
            CopiedAs::Json => camera_file(&camera),
        };
        self.copy(&text);
    }

    /// Copies a text, prints it and shows it.
    pub fn copy(&mut self, text: &str) {
        self.ui.tell(text);
        let printed = crate::console::print(text);
        if let Err(error) = self.clipboard.copy(text) {
            self.ui.tell(&format!("there is no clipboard: {error}"));
        }
        if let Err(error) = printed {
            self.tell(&error.to_string());
        }
        self.window.request_redraw();
    }

    /// Writes the picture to a file of its own in the current folder.
    pub fn write_picture(&mut self) {
        let path = free_name("surfel", "png");
        match self.picture_to(path.clone()) {
            Ok(true) => self.tell(&format!("{} is written", path.display())),
            Ok(false) => {}
            Err(error) => self.tell(&error.to_string()),
        }
    }

    /// Whether there was anything to write.
    fn picture_to(&mut self, path: PathBuf) -> Result<bool> {
        let size_px = self.options.picture_size.unwrap_or(self.window_px());
        let background = self.settings.background;
        let is_plain = self.encoding.is_plain();
        let settings = self.at_rest(&Settings { size_px, ..self.settings.clone() });
        let settings = Settings { samples: self.samples_of(&settings), ..settings };
        let (Some(camera), Some(prepared)) = (self.camera(), &mut self.prepared) else { return Ok(false) };
        let settings = match prepared {
            OnDevice::Whole(..) => settings,
            OnDevice::Paged(paged) => match paged.wait_for(&self.gpu.headless, &camera, &settings)? {
                Some(settings) => settings,
                None => return Ok(false),
            },
        };
        // A curve is of what is drawn alone; the background is put under it after that.
        let settings = Settings { background: background.filter(|_| is_plain), ..settings };
        let wanted = Wanted { picture: true, linear: !is_plain, ..Wanted::default() };
        let frame = self.gpu.headless.render(prepared.scene(), &camera, &settings, wanted)?;
        let bytes = match is_plain {
            true => frame.srgb,
            false => pictures::encode_shown(&self.encoding, &frame.linear, background),
        };
        let colors = Colors::Srgb(&bytes);
        pictures::write_picture(&path, PictureFormat::Png, frame.size_px, background.is_none(), colors)?;
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_file_holds_either_projection() {
        let camera = Camera { near: Some(0.1), ..Camera::default() };
        let text = camera_file(&camera);
        assert!(text.contains("\"fov_deg\":45.0") && text.contains("\"near\":0.1"), "{text}");
        let camera = Camera { orthographic_height: Some(2.5), ..Camera::default() };
        let text = camera_file(&camera);
        assert!(text.contains("\"orthographic\":2.5") && !text.contains("fov"), "{text}");
    }
}
