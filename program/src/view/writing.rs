//! Pictures that leave the window for files: drawn a sample at a time, and only while nothing moves, so that the window goes on between; and then encoded and written by a thread.

use std::{path::PathBuf, thread::JoinHandle, time::Instant};

use surfel::{
    Error, Result,
    renderer::{Frame, Wanted},
    scene::{Camera, Encoding, Settings},
};

use super::{capture::free_name, on_device::OnDevice, told::News, viewer::Viewer};
use crate::{
    outputs::PictureFormat,
    pictures::{self, Colors},
};

/// A picture of which some samples are drawn.
pub struct Writing {
    path: PathBuf,
    camera: Camera,
    /// All of it as it was when it was asked for.
    settings: Settings,
    encoding: Encoding,
    background: Option<[f32; 3]>,
    /// The sample that is next.
    next: usize,
    /// The scene of which it is.
    scene_number: u64,
}

/// A picture that is drawn, and the thread that writes it.
pub struct Saving {
    path: PathBuf,
    thread: JoinHandle<Result<()>>,
}

impl Saving {
    /// Has a thread write it, and then say that it is done.
    fn new(
        path: PathBuf,
        write: impl FnOnce() -> Result<()> + Send + 'static,
        done: impl FnOnce() + Send + 'static,
    ) -> Self {
        let thread = std::thread::spawn(move || {
            let written = write();
            done();
            written
        });
        Self { path, thread }
    }
}

impl Writing {
    fn wanted(&self) -> Wanted {
        Wanted { picture: true, linear: !self.encoding.is_plain(), ..Wanted::default() }
    }

    /// Writes the picture of its last sample.
    fn write(&self, frame: &Frame) -> Result<()> {
        let encoded;
        let bytes = match self.encoding.is_plain() {
            true => &frame.srgb,
            false => {
                encoded = pictures::encode_shown(&self.encoding, &frame.linear, self.background);
                &encoded
            }
        };
        let (colors, is_transparent) = (Colors::Srgb(bytes), self.background.is_none());
        pictures::write_picture(&self.path, PictureFormat::Png, frame.size_px, is_transparent, colors)
    }
}

impl Viewer {
    /// Begins to write the picture to a file of its own in the current folder.
    pub fn write_picture(&mut self) {
        let saving = self.saving.as_ref().map(|saving| &saving.path);
        if let Some(path) = self.writing.as_ref().map(|writing| &writing.path).or(saving) {
            let words = format!("{} is being written", path.display());
            self.ui.tell(&words);
            return;
        }
        match self.begin_writing() {
            Ok(writing) => self.writing = writing,
            Err(error) => self.tell(&error.to_string()),
        }
    }

    fn begin_writing(&mut self) -> Result<Option<Writing>> {
        let size_px = self.options.picture_size.unwrap_or(self.window_px());
        let (background, encoding) = (self.settings.background, self.encoding);
        let settings = self.at_rest(&Settings { size_px, ..self.settings.clone() });
        // A curve is of what is drawn alone; the background is put under it after that.
        let background_drawn = background.filter(|_| encoding.is_plain());
        let settings = Settings { background: background_drawn, ..self.sampled(&settings) };
        let (Some(camera), Some(prepared)) = (self.camera(), &mut self.prepared) else { return Ok(None) };
        let path = free_name("surfel", "png");
        let scene_number = self.scene_number;
        let mut writing = Writing { path, camera, settings, encoding, background, next: 0, scene_number };
        if let OnDevice::Paged(paged) = prepared {
            // Its pages are those of another view as soon as the window draws again.
            self.scene_number += 1;
            let Some(settings) = paged.wait_for(&self.gpu.headless, &camera, &writing.settings)? else {
                return Ok(None);
            };
            (writing.settings, writing.scene_number) = (settings, self.scene_number);
            self.writing = Some(writing);
            self.finish_writing();
            return Ok(None);
        }
        Ok(Some(writing))
    }

    /// When the next sample of a picture is drawn.
    pub fn next_sample(&self, now: Instant) -> Option<Instant> {
        let rests = self.moved.is_none() && self.steps.is_none();
        self.writing.as_ref().filter(|_| rests).map(|_| now)
    }

    /// Draws all that is left of a picture that is being written.
    pub fn finish_writing(&mut self) {
        while self.writing.is_some() {
            self.write_on();
        }
        self.end_saving();
    }

    /// Waits for the thread that writes a picture, and tells what came of it.
    pub fn end_saving(&mut self) {
        let Some(Saving { path, thread }) = self.saving.take() else { return };
        match thread.join() {
            // The standard error has heard of it.
            Ok(Ok(())) => self.ui.tell(&format!("{} is written", path.display())),
            Ok(Err(error)) => self.tell(&error.to_string()),
            Err(_) => self.tell(&format!("{} is not written", path.display())),
        }
        self.window.request_redraw();
    }

    /// Draws the next sample of a picture that is being written; behind the last one, has it written.
    pub fn write_on(&mut self) {
        let Some(mut writing) = self.writing.take() else { return };
        match self.draw_sample(&writing) {
            Ok(frame) => {
                writing.next += 1;
                let all = writing.settings.samples.0.max(1) as usize;
                let path = writing.path.display();
                if writing.next < all {
                    self.ui.tell(&format!("{path}: {} of {all} samples", writing.next));
                    self.writing = Some(writing);
                    self.window.request_redraw();
                    return;
                }
                let (path, proxy) = (writing.path.clone(), self.loader.proxy());
                // Nobody hears it once the window is closed.
                let done = move || drop(proxy.send_event(News::Written));
                self.saving = Some(Saving::new(path, move || writing.write(&frame), done));
            }
            Err(error) => self.tell(&error.to_string()),
        }
        // It may be far larger than the window. Errors, such as a lost device, come with the next frame, too.
        let _ = self.gpu.headless.forget_frames();
        self.window.request_redraw();
    }

    fn draw_sample(&mut self, writing: &Writing) -> Result<Frame> {
        let Writing { camera, settings, next, .. } = writing;
        let scene = self.prepared.as_ref().filter(|_| writing.scene_number == self.scene_number);
        let Some(scene) = scene else {
            let path = writing.path.display();
            return Err(Error::option(
                "picture",
                format!("{path} is not written: the scene has changed meanwhile"),
            ));
        };
        self.gpu.headless.render_sample(scene.scene(), camera, settings, writing.wanted(), *next)
    }
}

#[cfg(test)]
mod tests {
    use std::{sync::mpsc::channel, time::Duration};

    use super::*;

    #[test]
    fn who_has_a_picture_written_goes_on_meanwhile() {
        let ((go, goes), (done, is_done)) = (channel(), channel());
        let write = move || {
            let waited = goes.recv_timeout(Duration::from_secs(5));
            waited.map_err(|_| Error::option("picture", "nothing goes on while it is written"))
        };
        let saving = Saving::new(PathBuf::new(), write, move || done.send(()).unwrap());
        assert!(is_done.try_recv().is_err());
        go.send(()).unwrap();
        saving.thread.join().unwrap().unwrap();
        is_done.try_recv().unwrap();
    }
}
