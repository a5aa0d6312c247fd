//! Files that are dropped on the window, and those that change on disk.

use std::{
    path::{Path, PathBuf},
    time::{Duration, Instant, SystemTime},
};

use super::viewer::Viewer;
use crate::inputs::Inputs;

/// How often files are looked at.
const LOOK: Duration = Duration::from_millis(500);
/// Files that are dropped one after the other in so short a time are dropped together.
const DROP: Duration = Duration::from_millis(100);

/// Files of the scene, and those to come.
#[derive(Default)]
pub struct Files {
    dropped: Vec<PathBuf>,
    dropped_at: Option<Instant>,
    watched: Vec<(PathBuf, Option<Stamp>)>,
    looked: Option<Instant>,
    changed: bool,
}

/// What tells that a file has changed.
type Stamp = (SystemTime, u64);

fn stamp(path: &Path) -> Option<Stamp> {
    let metadata = std::fs::metadata(path).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

impl Files {
    /// One is dropped.
    pub fn drop_one(&mut self, path: PathBuf) {
        self.dropped.push(path);
        self.dropped_at = Some(Instant::now());
    }

    /// When they are looked at next.
    pub fn next_look(&self) -> Option<Instant> {
        let dropped = self.dropped_at.map(|at| at + DROP);
        let looked = self.looked.filter(|_| !self.watched.is_empty()).map(|looked| looked + LOOK);
        [dropped, looked].into_iter().flatten().min()
    }

    /// Watches these from now on.
    pub fn watch(&mut self, files: &[PathBuf]) {
        let is_file = |path: &&PathBuf| path.as_os_str() != "-";
        self.watched = files.iter().filter(is_file).map(|path| (path.clone(), stamp(path))).collect();
        (self.looked, self.changed) = (Some(Instant::now()), false);
    }

    /// Those that were dropped, once no more follow.
    fn take_dropped(&mut self, now: Instant) -> Option<Vec<PathBuf>> {
        self.dropped_at.take_if(|at| now >= *at + DROP).map(|_| std::mem::take(&mut self.dropped))
    }

    /// Whether one has changed, and is the same since the look before.
    fn has_settled(&mut self) -> bool {
        let mut changes = false;
        for (path, known) in &mut self.watched {
            let now = stamp(path);
            // One that is being replaced is not there for a moment.
            if now.is_some() && now != *known {
                (*known, changes) = (now, true);
            }
        }
        let settled = self.changed && !changes;
        self.changed = changes;
        settled
    }
}

impl Viewer {
    /// Reads what was dropped, and what has changed on disk.
    pub fn look_at_files(&mut self) {
        let now = Instant::now();
        if let Some(files) = self.files.take_dropped(now) {
            let is_path = |file: &PathBuf| file.extension().is_some_and(|ending| ending == "json");
            let (paths, files): (Vec<_>, Vec<_>) = files.into_iter().partition(is_path);
            paths.iter().for_each(|path| self.take_path(path));
            if files.is_empty() {
                return;
            }
            let options = self.document.as_ref().map(|document| document.files.clone()).unwrap_or_default();
            self.keeps_camera = false;
            self.open(Inputs { files, ..options });
        }
        if self.files.looked.is_some_and(|looked| now >= looked + LOOK) {
            self.files.looked = Some(now);
            if self.files.has_settled() {
                self.reload();
            }
        }
    }

    /// Reads the files again.
    pub fn reload(&mut self) {
        if let Some(document) = &self.document {
            let files = document.files.clone();
            self.keeps_camera = true;
            self.open(files);
        }
    }

    fn open(&mut self, files: Inputs) {
        let names: Vec<_> = files.files.iter().map(|path| surfel::load::file_name(path)).collect();
        self.ui.reading = Some(format!("reading {}", names.join(", ")));
        self.loader.open(files, self.window_px());
        self.window.request_redraw();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_again_once_it_has_changed_and_rests() {
        let folder = temp_dir::TempDir::new().unwrap();
        let path = folder.path().join("a.ply");
        std::fs::write(&path, "one").unwrap();
        let mut files = Files::default();
        assert!(files.next_look().is_none());
        files.watch(&[path.clone(), PathBuf::from("-")]);
        assert!(files.watched.len() == 1 && !files.has_settled() && files.next_look().is_some());
        std::fs::write(&path, "longer").unwrap();
        assert!(!files.has_settled(), "it may go on changing");
        std::fs::remove_file(&path).unwrap();
        assert!(files.has_settled() && !files.has_settled());
        std::fs::write(&path, "longer still").unwrap();
        assert!(!files.has_settled() && files.has_settled());
    }

    #[test]
    fn files_that_are_dropped_together_come_together() {
        let mut files = Files::default();
        files.drop_one(PathBuf::from("a"));
        files.drop_one(PathBuf::from("b"));
        let now = Instant::now();
        assert_eq!(files.take_dropped(now), None);
        assert_eq!(files.take_dropped(now + DROP).map(|all| all.len()), Some(2));
        assert_eq!(files.take_dropped(now + DROP), None);
    }
}
