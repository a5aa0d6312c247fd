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
    watched: Vec<Watched>,
    looked: Option<Instant>,
    changed: bool,
}

/// A file of the scene.
struct Watched {
    path: PathBuf,
    known: Option<Stamp>,
    /// At so many looks in a row it was not there.
    missed: u32,
}

/// What a look at the files of the scene has found.
#[derive(Debug, Default, PartialEq)]
struct Found {
    /// Some have changed, and are the same since the look before.
    settled: bool,
    /// What is to be told.
    lines: Vec<String>,
}

/// One that is being replaced is not there for a moment; at so many looks in a row it is gone.
const GONE: u32 = 2;

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
        self.watched = files
            .iter()
            .filter(is_file)
            .cloned()
            .map(|path| Watched { known: stamp(&path), path, missed: 0 })
            .collect();
        (self.looked, self.changed) = (Some(Instant::now()), false);
    }

    /// Those that were dropped, once no more follow.
    fn take_dropped(&mut self, now: Instant, waits: bool) -> Option<Vec<PathBuf>> {
        let is_due = |at: &mut Instant| now >= *at + DROP;
        if waits {
            self.dropped_at.take_if(is_due);
            return None;
        }
        let is_due = self.dropped_at.is_none_or(|at| now >= at + DROP);
        if !is_due || self.dropped.is_empty() {
            return None;
        }
        self.dropped_at = None;
        Some(std::mem::take(&mut self.dropped))
    }

    /// Whether some are dropped and not read yet.
    pub fn are_dropped(&self) -> bool {
        !self.dropped.is_empty()
    }

    /// Looks whether they have changed.
    fn look(&mut self) -> Found {
        let (mut lines, mut changes) = (Vec::new(), false);
        for Watched { path, known, missed } in &mut self.watched {
            let now = stamp(path);
            let name = surfel::load::file_name(path);
            if now.is_none() {
                *missed = missed.saturating_add(1);
                if *missed == GONE {
                    lines.push(format!("{name} is not there any more; what is shown stays"));
                }
                continue;
            }
            let was_gone = std::mem::take(missed) >= GONE;
            if now != *known {
                (*known, changes) = (now, true);
                lines.push(format!("{name} has changed and is read again"));
            } else if was_gone {
                lines.push(format!("{name} is there again"));
            }
        }
        let settled = self.changed && !changes;
        self.changed = changes;
        Found { settled, lines }
    }
}

impl Viewer {
    /// Reads what was dropped, and what has changed on disk.
    pub fn look_at_files(&mut self) {
        let now = Instant::now();
        // The first ones are read to their end: what is dropped meanwhile takes their place then.
        if let Some(files) = self.files.take_dropped(now, self.reads_first) {
            let is_path = |file: &PathBuf| file.extension().is_some_and(|ending| ending == "json");
            let (paths, files): (Vec<_>, Vec<_>) = files.into_iter().partition(is_path);
            paths.iter().for_each(|path| self.take_path(path));
            if files.is_empty() {
                return;
            }
            let options = match &self.document {
                Some(document) => document.files.clone(),
                None => self.options.inputs.clone(),
            };
            self.keeps_camera = false;
            self.open(Inputs { files, ..options });
        }
        if self.files.looked.is_some_and(|looked| now >= looked + LOOK) {
            self.files.looked = Some(now);
            let found = self.files.look();
            for line in &found.lines {
                self.tell(line);
            }
            if found.settled {
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
    use crate::outputs::with_models;

    #[test]
    fn a_file_is_read_again_once_it_has_changed_and_rests() {
        let folder = temp_dir::TempDir::new().unwrap();
        let path = folder.path().join("a.ply");
        std::fs::write(&path, "one").unwrap();
        let mut files = Files::default();
        assert!(files.next_look().is_none());
        files.watch(&[path.clone(), PathBuf::from("-")]);
        let look = |files: &mut Files| {
            let Found { settled, lines } = files.look();
            (settled, lines.join(", "))
        };
        let nothing = (false, String::new());
        assert!(files.watched.len() == 1 && look(&mut files) == nothing && files.next_look().is_some());
        std::fs::write(&path, "longer").unwrap();
        assert_eq!(
            look(&mut files),
            (false, "a.ply has changed and is read again".to_owned()),
            "it may go on changing"
        );
        std::fs::remove_file(&path).unwrap();
        assert_eq!(look(&mut files), (true, String::new()), "it may come again at once");
        let gone = "a.ply is not there any more; what is shown stays";
        assert_eq!(look(&mut files), (false, gone.to_owned()));
        assert_eq!(look(&mut files), nothing, "it is told once");
        std::fs::write(&path, "longer still").unwrap();
        assert_eq!(look(&mut files), (false, "a.ply has changed and is read again".to_owned()));
        assert_eq!(look(&mut files), (true, String::new()));
        // Away and back, the same as before.
        let away = folder.path().join("away");
        std::fs::rename(&path, &away).unwrap();
        assert_eq!([look(&mut files), look(&mut files)], [nothing, (false, gone.to_owned())]);
        std::fs::rename(&away, &path).unwrap();
        assert_eq!(look(&mut files), (false, "a.ply is there again".to_owned()));
    }

    #[test]
    fn what_a_scene_file_names_is_watched_with_it() {
        let folder = temp_dir::TempDir::new().unwrap();
        let [scene, model] = ["a.toml", "a.ply"].map(|name| folder.path().join(name));
        std::fs::write(&scene, "[[object]]\nfile = \"a.ply\"\n").unwrap();
        std::fs::write(&model, "one").unwrap();
        let mut files = Files::default();
        files.watch(&with_models(&[scene]));
        std::fs::write(&model, "longer").unwrap();
        assert_eq!(files.look().lines, ["a.ply has changed and is read again"]);
    }

    #[test]
    fn files_that_are_dropped_together_come_together() {
        let mut files = Files::default();
        files.drop_one(PathBuf::from("a"));
        files.drop_one(PathBuf::from("b"));
        let now = Instant::now();
        assert_eq!(files.take_dropped(now, false), None);
        // They wait for the first ones, and the window does not look for them over and over.
        assert_eq!(files.take_dropped(now + DROP, true), None);
        assert!(files.are_dropped() && files.next_look().is_none());
        assert_eq!(files.take_dropped(now + DROP, false).map(|all| all.len()), Some(2));
        assert_eq!(files.take_dropped(now + DROP, false), None);
    }
}
