//! What leaves the window as words: cameras, to the clipboard.

use std::path::PathBuf;

use surfel::scene::Camera;

use super::{cuts, keys::CopiedAs, viewer::Viewer};
use crate::camera;

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

/// A text with at most so many decimals in its numbers. Powers of ten stay as they are.
pub fn rounded(text: &str, decimals: usize) -> String {
    let mut rounded = String::new();
    let mut rest = text;
    while let Some(begin) = rest.find(|c: char| c.is_ascii_digit()) {
        let (before, from) = rest.split_at(begin);
        rounded += before;
        let end = from.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(from.len());
        let (number, behind) = from.split_at(end);
        let is_long = number.split_once('.').is_some_and(|(_, fraction)| fraction.len() > decimals);
        match number.parse::<f64>() {
            Ok(value) if is_long && !behind.starts_with(|c: char| c.is_alphanumeric() || c == '_') => {
                let short = format!("{value:.decimals$}");
                rounded += short.trim_end_matches('0').trim_end_matches('.');
            }
            _ => rounded += number,
        }
        rest = behind;
    }
    rounded + rest
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

    /// As many decimals as mean something to who looks at the scene: a millionth of its size.
    pub fn decimals(&self) -> usize {
        let radius = self.document.as_ref().map_or(1.0, |document| document.ball.radius);
        (6.0 - radius.log10().floor()).clamp(4.0, 15.0) as usize
    }

    /// Copies a text, prints it and shows it, with fewer digits.
    pub fn copy(&mut self, text: &str) {
        self.ui.tell(&rounded(text, self.decimals()));
        let printed = crate::console::print(text);
        if let Err(error) = self.clipboard.copy(text) {
            self.ui.tell(&format!("there is no clipboard: {error}"));
        }
        if let Err(error) = printed {
            self.tell(&error.to_string());
        }
        self.window.request_redraw();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_shown_with_as_many_decimals_as_mean_something() {
        let text =
            "--eye 0.12345678901234567,-2.9999999999,1e-7 --fov 45 at 500000.0012345; 1.5e-12, -0.00000001";
        let expected = "--eye 0.12346,-3,1e-7 --fov 45 at 500000.00123; 1.5e-12, -0";
        assert_eq!(rounded(text, 5), expected);
        assert_eq!(rounded("2.5.7 v1.2 10.", 1), "2.5.7 v1.2 10.");
    }

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
