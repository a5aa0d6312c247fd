//! What comes from elsewhere: files that are read, and scenes on their way to the device.

use surfel::{
    Error, Result,
    scene::{Samples, Settings},
};

use super::{
    document::Document,
    navigation::Navigation,
    on_device::{OnDevice, Paged},
    told::{News, Prepared},
    viewer::Viewer,
};
use crate::outputs::with_models;

impl Viewer {
    /// News of a thread.
    ///
    /// # Errors
    /// Of the first files, or the device.
    pub fn hear(&mut self, news: News) -> Result<()> {
        match news {
            News::Opened(document) => self.opened(*document),
            News::Prepared(prepared) if !self.loader.is_newest(prepared.job) => Ok(()),
            News::Prepared(prepared)
                if self.prepared.as_ref().is_some_and(|shown| shown.pages().is_some()) =>
            {
                self.take_beside_pages(*prepared)
            }
            News::Prepared(prepared) => {
                self.coming = Some(OnDevice::Whole(Box::new(prepared.scene), prepared.step));
                self.prepares = !prepared.is_last;
                if self.prepared.is_none() {
                    self.take_scene();
                }
                self.window.request_redraw();
                Ok(())
            }
            // It may be for a device that is lost.
            News::Upload(_, job, answer) if !self.loader.is_newest(job) => {
                let _ = answer.send(Err(Error::option("scene", "another one has come")));
                Ok(())
            }
            News::Upload(staging, _, answer) => {
                let done = self.gpu.headless.queue().run_once("upload", |commands| {
                    // SAFETY: recording; the thread keeps what it uploads to until it has the answer, which comes after the wait.
                    unsafe { staging.record(commands) };
                    Ok(())
                });
                // A thread that is gone needs no answer.
                let _ = answer.send(done);
                Ok(())
            }
            News::Written => {
                self.end_saving();
                Ok(())
            }
            News::Ran(ran) => {
                self.gpu.headless.renderer.shaders().ran_elsewhere(&ran.pipelines);
                if let Some(ahead) = &mut self.ahead {
                    ahead.are_done(ran);
                }
                self.window.request_redraw();
                Ok(())
            }
            #[cfg(feature = "live-shaders")]
            News::Shaders(compiled) => {
                self.take_shaders(compiled);
                Ok(())
            }
            News::Unread(error) => self.unread(error),
            News::Failed(error) => {
                self.prepares = false;
                self.tell(&error.to_string());
                Ok(())
            }
        }
    }

    /// Files can't be read.
    fn unread(&mut self, error: Error) -> Result<()> {
        let is_first = std::mem::take(&mut self.reads_first);
        if is_first && !self.files.are_dropped() {
            return Err(error);
        }
        self.ui.reading = None;
        let stays = if self.prepared.is_some() { "; what is shown stays" } else { "" };
        self.tell(&format!("{error}{stays}"));
        if self.prepares {
            // Reading has cut it short.
            self.prepare(self.prepared.is_none());
        }
        self.look_at_files();
        Ok(())
    }

    fn opened(&mut self, document: Document) -> Result<()> {
        let is_first = std::mem::take(&mut self.reads_first);
        let first = self.document.is_none();
        if first {
            let said = (self.options.said)(document.picture.over(self.settings.clone()));
            self.samples = said.samples;
            self.settings = Settings { samples: Samples(1), ..said };
            self.other = self.settings.clone();
            self.first.0 = self.settings.clone();
        }
        if let Err(error) = self.settings.check_scene(&document.scene) {
            self.keeps_camera = false;
            self.reads_first = is_first;
            return self.unread(error);
        }
        match &mut self.navigation {
            Some(navigation) if self.keeps_camera => navigation.set_ball(document.ball),
            navigation => *navigation = Some(Navigation::new(document.camera, document.ball)),
        }
        if !(self.keeps_camera && self.edits.things.len() == document.no_edits().things.len()) {
            (self.edits, self.thing) = (document.no_edits(), 0);
        }
        let names: Vec<_> = document.inputs.iter().map(|input| input.name.as_str()).collect();
        self.window.set_title(&format!("{} - surfel (? shows the keys)", names.join(", ")));
        self.ui.reading = None;
        self.files.watch(&with_models(&document.files.files));
        self.document = Some(document);
        let is_other = !std::mem::take(&mut self.keeps_camera);
        // Pages of what the file was.
        if self.prepared.take_if(|prepared| prepared.pages().is_some()).is_some() {
            self.scene_number += 1;
        }
        self.prepare(is_other);
        self.changed();
        // Those that came while the first were read.
        self.look_at_files();
        Ok(())
    }

    /// Brings the scene to the device, with the changes of now; pages of files beside it come as views need them. `is_other`: it is not that which is shown, so that
    /// a part of it is better than nothing.
    pub fn prepare(&mut self, is_other: bool) {
        let Some(document) = &self.document else { return };
        self.coming = None;
        let device = self.gpu.headless.device().clone();
        self.prepares = true;
        self.loader.prepare((&document.scene, &document.paged, &self.edits), device, is_other);
        let has_pages = self.prepared.as_ref().is_some_and(|prepared| prepared.pages().is_some());
        if document.paged.is_empty() || has_pages && !is_other {
            return;
        }
        self.scene_number += 1;
        let lights = document.scene.lights.clone();
        match Paged::new(&document.paged, self.options.most_paged_bytes, lights) {
            Ok(mut paged) => {
                paged.show(&self.edits.in_pages(&document.scene, &document.paged));
                self.prepared = Some(OnDevice::Paged(Box::new(paged)));
            }
            Err(error) => self.tell(&error.to_string()),
        }
    }

    /// What is there as a whole beside pages, in the place of what was.
    fn take_beside_pages(&mut self, prepared: Prepared) -> Result<()> {
        let (Some(OnDevice::Paged(paged)), Some(document)) = (&mut self.prepared, &self.document) else {
            return Ok(());
        };
        paged.set_beside(prepared.scene)?;
        paged.show(&self.edits.in_pages(&document.scene, &document.paged));
        self.prepares = !prepared.is_last;
        self.scene_number += 1;
        self.pace.forget_whole();
        self.changed();
        Ok(())
    }
}
