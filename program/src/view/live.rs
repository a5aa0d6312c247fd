//! Shaders that are compiled again when their files change (feature `live-shaders`): those of the folder that the program was built from.

use std::{sync::mpsc::channel, time::Duration};

use notify::{EventKind, RecursiveMode, Watcher as _};
use surfel::{Error, Result, shaders::live};
use winit::event_loop::EventLoopProxy;

use super::{told::News, viewer::Viewer};

/// An editor writes a file in several steps, which follow each other so soon.
const SETTLED: Duration = Duration::from_millis(150);

/// Watches the shaders from now on. The thread ends with the watcher.
///
/// # Errors
/// Where the folder is no more, or the system watches no more folders.
pub fn watch(proxy: EventLoopProxy<News>) -> Result<notify::RecommendedWatcher> {
    let folder = live::folder();
    let failed = |error: notify::Error| Error::file(&folder, "watch", std::io::Error::other(error));
    let (sender, changes) = channel();
    let mut watcher = notify::recommended_watcher(move |event: notify::Result<notify::Event>| {
        // To read a file is an event, too.
        if event.is_ok_and(|event| !matches!(event.kind, EventKind::Access(_))) {
            let _ = sender.send(());
        }
    })
    .map_err(failed)?;
    watcher.watch(&folder, RecursiveMode::Recursive).map_err(failed)?;
    std::thread::spawn(move || {
        while changes.recv().is_ok() {
            while changes.recv_timeout(SETTLED).is_ok() {}
            // Nobody hears it once the window is closed.
            let _ = proxy.send_event(News::Shaders(live::reload(&live::folder())));
        }
    });
    Ok(watcher)
}

impl Viewer {
    /// Shaders were compiled, or not.
    pub fn take_shaders(&mut self, compiled: std::result::Result<usize, String>) {
        match compiled {
            Ok(0) => {}
            Ok(count) => {
                self.gpu.forget_pipelines();
                self.tell(&format!("{count} shaders are compiled anew"));
                self.changed();
            }
            Err(problem) => self.tell(&problem),
        }
    }
}
