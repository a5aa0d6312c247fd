//! The application, as the event loop knows it: opens the window once it may, and hands events on.

use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use surfel::{
    Error, ErrorKind, Result,
    scene::{Settings, Storage},
    vk::Messages,
};
use winit::{
    application::ApplicationHandler,
    dpi::PhysicalSize,
    event::{StartCause, WindowEvent},
    event_loop::{ActiveEventLoop, ControlFlow, EventLoopProxy},
    window::{Window, WindowId},
};

use super::{
    ViewArguments,
    ahead::Ahead,
    loading::{Loader, Wants},
    path::Path,
    told::News,
    viewer::Viewer,
};
use crate::camera::CameraChoice;

/// How soon a window that is closed looks whether all is done.
const LOOK: Duration = Duration::from_millis(10);

/// The application.
pub struct App<'a> {
    arguments: &'a ViewArguments,
    settings: Settings,
    proxy: EventLoopProxy<News>,
    /// Until the window is open.
    camera: Option<CameraChoice>,
    path: Path,
    viewer: Option<Viewer>,
    /// It ends once this has, of a window that is closed.
    ending: Option<Ahead>,
    messages: Option<Arc<Messages>>,
    failure: Option<Error>,
    #[cfg(feature = "live-shaders")]
    shaders: Option<notify::RecommendedWatcher>,
}

/// What is left of it.
pub struct Ended {
    /// What the validation layer said.
    pub messages: Option<Arc<Messages>>,
    /// Why it ended, where it did not by itself.
    pub failure: Option<Error>,
}

impl<'a> App<'a> {
    /// Without a window yet.
    pub fn new(
        arguments: &'a ViewArguments,
        settings: Settings,
        (camera, path): (CameraChoice, Path),
        proxy: EventLoopProxy<News>,
    ) -> Self {
        let camera = Some(camera);
        Self {
            arguments,
            settings,
            proxy,
            camera,
            path,
            viewer: None,
            ending: None,
            messages: None,
            failure: None,
            #[cfg(feature = "live-shaders")]
            shaders: None,
        }
    }

    /// Closes the window and destroys all of Vulkan.
    pub fn end(mut self) -> Ended {
        self.close();
        self.ending = None;
        Ended { messages: self.messages, failure: self.failure }
    }

    fn close(&mut self) {
        if let Some(viewer) = self.viewer.take() {
            self.ending = viewer.close();
        }
    }

    fn open(&mut self, events: &ActiveEventLoop, camera: CameraChoice) -> Result<Viewer> {
        let [width, height] = self.settings.size_px;
        let attributes = Window::default_attributes()
            .with_title("surfel (? shows the keys)")
            .with_inner_size(PhysicalSize::new(width, height));
        let window = events.create_window(attributes);
        let window = window.map_err(|error| ErrorKind::NoWindow { reason: error.to_string() })?;
        let window = Arc::new(window);
        #[cfg(feature = "live-shaders")]
        (self.shaders = Some(super::live::watch(self.proxy.clone())?));
        let (gpu, messages) = super::device::open_gpu(&window, &self.arguments.device)?;
        self.messages = Some(messages);
        gpu.headless.renderer.check_settings(&self.settings)?;
        let limits = gpu.headless.device().facts().limits;
        let wants = Wants {
            camera,
            lights: self.arguments.lights.clone(),
            storage: self.arguments.storage.over(Storage::default()),
            settings: self.settings.clone(),
            said: self.arguments.said(),
        };
        let loader = Loader::new(self.proxy.clone(), limits, wants);
        loader.open(self.arguments.input.inputs(), gpu.window_px());
        let path = std::mem::take(&mut self.path);
        Ok(Viewer::new(window, gpu, loader, self.settings.clone(), path, self.arguments))
    }

    /// Ends the program. The window is gone at once, before all that the device does is waited for. Where a window can't be hidden, as under Wayland, it is gone once it is closed and events
    /// are looked at again, so that is done while another device compiles on.
    fn exit(&mut self, events: &ActiveEventLoop) {
        if let Some(viewer) = &mut self.viewer {
            viewer.window.set_visible(false);
        }
        self.close();
        self.leave(events);
    }

    /// Ends what hears events, unless something is waited for.
    fn leave(&mut self, events: &ActiveEventLoop) {
        match &self.ending {
            Some(ending) if !ending.is_finished() => {
                events.set_control_flow(ControlFlow::WaitUntil(Instant::now() + LOOK));
            }
            _ => events.exit(),
        }
    }

    /// Ends it for a reason.
    fn fail(&mut self, events: &ActiveEventLoop, error: Error) {
        self.failure = Some(error);
        self.exit(events);
    }

    fn hand_on(&mut self, events: &ActiveEventLoop, event: impl FnOnce(&mut Viewer) -> Result<()>) {
        let Some(viewer) = &mut self.viewer else { return };
        let done = event(viewer);
        match done.or_else(|error| viewer.recover(error)) {
            Ok(()) if viewer.ends => self.exit(events),
            Ok(()) => {}
            Err(error) => self.fail(events, error),
        }
    }
}

impl ApplicationHandler<News> for App<'_> {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        let Some(camera) = self.camera.take() else { return };
        match self.open(events, camera) {
            Ok(viewer) => self.viewer = Some(viewer),
            Err(error) => self.fail(events, error),
        }
    }

    fn new_events(&mut self, _events: &ActiveEventLoop, cause: StartCause) {
        if let (StartCause::ResumeTimeReached { .. }, Some(viewer)) = (cause, &mut self.viewer) {
            viewer.wake();
        }
    }

    fn user_event(&mut self, events: &ActiveEventLoop, news: News) {
        self.hand_on(events, |viewer| viewer.hear(news));
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        self.hand_on(events, |viewer| viewer.event(event));
    }

    fn about_to_wait(&mut self, events: &ActiveEventLoop) {
        let Some(viewer) = &mut self.viewer else {
            return self.leave(events);
        };
        let flow = match viewer.next_wake(Instant::now()) {
            Some(when) => ControlFlow::WaitUntil(when),
            None => ControlFlow::Wait,
        };
        events.set_control_flow(flow);
    }

    fn exiting(&mut self, _events: &ActiveEventLoop) {
        // Before the connection to the display goes.
        self.close();
    }
}
