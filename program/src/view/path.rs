//! Paths of cameras: recorded by key, played, saved for `surfel render --path`.

use std::{fs, time::Instant};

use surfel::{
    Error, Result,
    scene::{Camera, CameraPath, Interpolation},
};

use super::{capture::free_name, keys::OnPath, viewer::Viewer};
use crate::{
    camera::{path_text, read_path},
    console,
};

/// Seconds from one place to the next.
const STEP_SECS: f64 = 2.0;

/// As a shell takes it for one word.
fn as_word(text: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "/._-+,".contains(c);
    match text.chars().all(is_plain) {
        true => text.to_owned(),
        false => format!("'{}'", text.replace('\'', r"'\''")),
    }
}

/// The places of a path, and how far it is played.
#[derive(Default)]
pub struct Path {
    /// With their times, in seconds.
    places: Vec<(f64, Camera)>,
    interpolation: Interpolation,
    playing: Option<(Instant, CameraPath)>,
}

impl Path {
    /// Whether it is being played.
    pub fn plays(&self) -> bool {
        self.playing.is_some()
    }

    /// The camera of now, if it is being played; at its end it stops.
    fn play(&mut self, now: Instant) -> Option<Camera> {
        let (begun, path) = self.playing.as_ref()?;
        let [first, last] = path.times();
        let secs = first + (now - *begun).as_secs_f64();
        let camera = path.at(secs);
        if secs >= last {
            self.playing = None;
        }
        Some(camera)
    }

    /// # Errors
    /// As [`CameraPath::new`].
    fn made(&self) -> Result<CameraPath> {
        CameraPath::new(self.interpolation, self.places.clone())
    }

    /// That of a file.
    ///
    /// # Errors
    /// As [`read_path`].
    pub fn read(file: &std::path::Path) -> Result<Self> {
        let path = read_path(file)?;
        let (places, interpolation) = (path.keys().to_vec(), path.interpolation());
        Ok(Self { places, interpolation, playing: None })
    }

    /// One place more, if the path goes on with it.
    fn add(&mut self, camera: Camera) -> Result<()> {
        let time = self.places.last().map_or(0.0, |(time, _)| time + STEP_SECS);
        self.places.push((time, camera));
        let made = self.made();
        if made.is_err() {
            self.places.pop();
        }
        made.map(drop)
    }
}

impl Viewer {
    /// Records, plays or saves.
    pub fn on_path(&mut self, what: OnPath) {
        let Some(camera) = self.camera() else { return };
        let done = match what {
            OnPath::Add => {
                self.path.add(camera).map(|()| format!("place {} of the path", self.path.places.len()))
            }
            OnPath::Remove => {
                self.path.places.pop();
                Ok(match self.path.places.len() {
                    0 => "the path has no place".to_owned(),
                    1 => "the path has 1 place".to_owned(),
                    count => format!("the path has {count} places"),
                })
            }
            OnPath::Play if self.path.plays() => {
                self.path.playing = None;
                Ok("the path stops".to_owned())
            }
            OnPath::Play => self.path.made().map(|path| {
                self.path.playing = Some((Instant::now(), path));
                "the path is played".to_owned()
            }),
            // The command is for a shell, too.
            OnPath::Save => self.save_path().inspect(|text| console::say(text)),
        };
        match done {
            Ok(text) => self.ui.tell(&text),
            Err(error) => self.tell(&error.to_string()),
        }
    }

    fn save_path(&self) -> Result<String> {
        let text = path_text(&self.path.made()?)?;
        let name = free_name("surfel-path", "json");
        fs::write(&name, text).map_err(|error| Error::file(&name, "write", error))?;
        let name = name.display();
        let files = self.document.as_ref().map_or(&[][..], |document| &document.files.files);
        let words: String =
            files.iter().map(|file| format!("{} ", as_word(&file.display().to_string()))).collect();
        Ok(format!("{name} is written: surfel render {words}--path {name} -o out%04d.png"))
    }

    /// Takes a path that was dropped in the place of the one there is.
    pub fn take_path(&mut self, file: &std::path::Path) {
        match Path::read(file) {
            Ok(path) => {
                self.path = path;
                let (name, count) = (surfel::load::file_name(file), self.path.places.len());
                let places = if count == 1 { "place" } else { "places" };
                self.tell(&format!("{name}: a path of {count} {places}; / plays it"));
            }
            Err(error) => self.tell(&error.to_string()),
        }
    }

    /// Goes on along the path, if it is being played.
    pub fn play(&mut self) {
        let camera = self.path.play(Instant::now());
        if let (Some(camera), Some(navigation)) = (camera, &mut self.navigation) {
            navigation.camera = camera;
            self.moved();
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn a_path_goes_through_its_places_and_stops_at_the_last() {
        let mut path = Path::default();
        assert!(path.made().is_err() && path.play(Instant::now()).is_none());
        let at = |x: f64| Camera { eye: DVec3::new(x, 0.0, 5.0), ..Camera::default() };
        path.add(at(0.0)).unwrap();
        path.add(at(1.0)).unwrap();
        assert!(path.add(Camera { orthographic_height: Some(1.0), ..at(2.0) }).is_err());
        assert_eq!(path.made().unwrap().times(), [0.0, STEP_SECS]);
        let begun = Instant::now();
        path.playing = Some((begun, path.made().unwrap()));
        assert_eq!(path.play(begun).unwrap().eye.x, 0.0);
        let between = path.play(begun + std::time::Duration::from_secs(1)).unwrap().eye.x;
        assert!(between > 0.1 && between < 0.9 && path.plays());
        assert_eq!(path.play(begun + std::time::Duration::from_secs(9)).unwrap().eye.x, 1.0);
        assert!(!path.plays());
    }
}
