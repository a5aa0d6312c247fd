//! The program with its window, and beside it.

mod folder;

pub use folder::Folder;

use std::{
    path::Path,
    process::{Child, ChildStdin, Command, Stdio},
    sync::{Arc, Mutex},
    thread::{self, JoinHandle},
    time::{Duration, Instant},
};

use super::{
    random::Random,
    screen::{Screen, Shot},
};

/// Patience with a machine that does other things, too.
const PATIENCE: Duration = Duration::from_secs(60);

/// How the program ended, and what it said.
pub struct Run {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

/// Runs the program to its end.
pub fn surfel(folder: &Folder, arguments: &[&str], environment: &[(&str, &str)]) -> Run {
    let output = command(folder, arguments).envs(environment.iter().copied()).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Run { code: output.status.code().unwrap_or(-1), stdout: text(output.stdout), stderr: text(output.stderr) }
}

fn command(folder: &Folder, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_surfel"));
    command.args(arguments).current_dir(folder.root()).stdin(Stdio::null());
    command
}

/// The picture that `surfel render` writes.
pub fn render(folder: &Folder, words: &[&str]) -> Shot {
    let run = surfel(folder, &[&["render", "-o", "rendered.png"], words].concat(), &[]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    shot_of(&folder.path("rendered.png"))
}

fn shot_of(path: &Path) -> Shot {
    let image = image::open(path).unwrap().into_rgb8();
    let size = [image.width(), image.height()];
    Shot { size, pixels: image.pixels().map(|pixel| pixel.0).collect() }
}

/// The program with its window in the top left corner of a screen, under validation.
pub struct View<'a> {
    screen: &'a Screen,
    folder: &'a Folder,
    child: Child,
    window: String,
    stdout: Arc<Mutex<String>>,
    readers: Vec<JoinHandle<()>>,
    stderr: Arc<Mutex<String>>,
    is_validated: bool,
}

/// How many pictures that nobody sees were drawn; not those that are drawn once more.
pub fn hidden(printed: &str) -> usize {
    let is_hidden = |line: &&str| line.starts_with("ahead ") || line.starts_with("ahead, from elsewhere ");
    printed.lines().filter(is_hidden).count()
}

impl<'a> View<'a> {
    /// Opens it, and gives it the keyboard.
    pub fn open(screen: &'a Screen, folder: &'a Folder, words: &[&str]) -> Self {
        Self::open_as(screen, folder, words, true)
    }

    /// The same, with the validation layer or without.
    pub fn open_as(screen: &'a Screen, folder: &'a Folder, words: &[&str], is_validated: bool) -> Self {
        Self::open_in(screen, folder, words, is_validated, &[])
    }

    /// The same, with variables of its own.
    pub fn open_in(
        screen: &'a Screen,
        folder: &'a Folder,
        words: &[&str],
        is_validated: bool,
        environment: &[(&str, &str)],
    ) -> Self {
        Self::open_fed(screen, folder, words, (is_validated, environment), Stdio::null())
    }

    /// The same, with a standard input that is [taken](Self::take_input) and written.
    pub fn open_fed(
        screen: &'a Screen,
        folder: &'a Folder,
        words: &[&str],
        (is_validated, environment): (bool, &[(&str, &str)]),
        input: Stdio,
    ) -> Self {
        let first: &[&str] = if is_validated { &["view", "--validate"] } else { &["view"] };
        let mut child = command(folder, &[first, words].concat())
            .env("DISPLAY", screen.name())
            .env_remove("WAYLAND_DISPLAY")
            .stdin(input)
            .envs(environment.iter().copied())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let (stdout, stderr) = (Arc::default(), Arc::default());
        let readers = vec![
            collect(child.stdout.take().unwrap(), &stdout),
            collect(child.stderr.take().unwrap(), &stderr),
        ];
        let mut view =
            Self { screen, folder, child, window: String::new(), stdout, readers, stderr, is_validated };
        view.wait("a window is there", |view| {
            view.window = view.screen.drive(&["search", "--name", "surfel"]).trim().to_owned();
            view.window.lines().count() == 1
        });
        // Without a window manager nobody else does it.
        view.screen.drive(&["windowfocus", "--sync", &view.window]);
        view
    }

    pub fn wait(&mut self, what: &str, mut is_so: impl FnMut(&mut Self) -> bool) {
        let begun = Instant::now();
        while !is_so(self) {
            let said = || self.stderr.lock().unwrap().clone();
            assert!(begun.elapsed() < PATIENCE, "waited in vain: {what}; {}", said());
            assert!(self.is_running(), "it ended: {what}; {}", self.stderr.lock().unwrap());
            thread::sleep(Duration::from_millis(20));
        }
    }

    /// Its standard input, which ends with this.
    pub fn take_input(&mut self) -> ChildStdin {
        self.child.stdin.take().unwrap()
    }

    pub fn is_running(&mut self) -> bool {
        self.child.try_wait().unwrap().is_none()
    }

    fn size(&self) -> [u32; 2] {
        let told = self.screen.drive(&["getwindowgeometry", "--shell", &self.window]);
        let field = |name: &str| {
            let line = told.lines().find_map(|line| line.strip_prefix(name));
            line.and_then(|value| value.parse().ok()).unwrap_or(1)
        };
        [field("WIDTH="), field("HEIGHT=")]
    }

    /// Waits until the screen shows a picture, but for a step of 8 bits.
    pub fn wait_for(&mut self, picture: &Shot) {
        let screen = self.screen;
        let mut least = usize::MAX;
        let begun = Instant::now();
        loop {
            let differ = screen.shot(picture.size).differs_from(picture);
            least = least.min(differ);
            if differ == 0 {
                return;
            }
            let said = self.stderr.lock().unwrap().clone();
            assert!(begun.elapsed() < PATIENCE, "at best {least} pixels differ, {differ} at the end; {said}");
            assert!(self.is_running(), "it ended: {said}");
            thread::sleep(Duration::from_millis(20));
        }
    }

    /// Waits until what the window shows is so.
    pub fn wait_until(&mut self, what: &str, is_so: impl Fn(&Shot) -> bool) {
        let size = self.size();
        self.wait(what, |view| is_so(&view.screen.shot(size)));
    }

    /// Waits for at least so many pictures that nobody sees, and until no more come. The last is from afar.
    pub fn wait_for_hidden(&mut self, least: usize) {
        let mut seen = (0, Instant::now());
        self.wait("pictures that nobody sees are drawn", |view| {
            let count = hidden(&view.printed());
            if count != seen.0 {
                seen = (count, Instant::now());
            }
            count >= least && seen.1.elapsed() > Duration::from_secs(8)
        });
    }

    /// The camera, as the program prints it where it is copied.
    pub fn camera(&mut self) -> Vec<String> {
        let before = self.stdout.lock().unwrap().len();
        self.screen.key("c");
        self.wait("the camera is printed", |view| view.stdout.lock().unwrap()[before..].ends_with('\n'));
        // The message over the picture goes.
        self.screen.key("Escape");
        self.stdout.lock().unwrap()[before..].split_whitespace().map(str::to_owned).collect()
    }

    /// Waits for a picture that the program writes.
    pub fn wait_for_file(&mut self, name: &str) -> Shot {
        let path = self.folder.path(name);
        self.wait(name, |_| path.exists());
        shot_of(&path)
    }

    pub fn resize(&mut self, [width, height]: [u32; 2]) {
        self.screen.drive(&["windowsize", &self.window, &width.to_string(), &height.to_string()]);
    }

    /// Its number in the X server.
    pub fn number(&self) -> u32 {
        self.window.parse().unwrap()
    }

    /// The number of its process.
    pub fn process(&self) -> u32 {
        self.child.id()
    }

    /// What it has printed.
    pub fn printed(&self) -> String {
        self.stdout.lock().unwrap().clone()
    }

    /// Mouse and keys at random.
    pub fn play_at_random(&mut self, random: &mut Random, long: Duration, keys: &str) {
        let keys: Vec<_> = keys.split_whitespace().collect();
        let begun = Instant::now();
        while begun.elapsed() < long {
            let at = |random: &mut Random| [random.below(320) as i32, random.below(220) as i32];
            match random.below(6) {
                0 | 1 => self.screen.key(keys[random.below(keys.len() as u32) as usize]),
                2 => {
                    let (from, to) = (at(random), at(random));
                    self.screen.drag(from, to, 1 + random.below(3));
                }
                3 => drop(self.screen.drive(&["click", if random.below(2) == 0 { "4" } else { "5" }])),
                4 => drop(self.screen.drive(&["click", "--repeat", "2", "--delay", "30", "1"])),
                _ => self.resize([1 + random.below(500), 1 + random.below(400)]),
            }
            assert!(self.is_running(), "it ended: {}", self.stderr.lock().unwrap());
        }
    }

    /// Ends it by key: it has ended well, and the layer has said nothing.
    pub fn end(self) -> Run {
        self.screen.drive(&["windowfocus", &self.window]);
        self.screen.key("ctrl+q");
        let is_validated = self.is_validated;
        let run = self.wait_for_end();
        let Run { code, stderr, .. } = &run;
        assert_eq!(*code, 0, "{stderr}");
        assert!(!is_validated || stderr.contains("validation: no message"), "{stderr}");
        run
    }

    /// Waits until it has ended by itself.
    pub fn wait_for_end(mut self) -> Run {
        let begun = Instant::now();
        while self.is_running() {
            assert!(begun.elapsed() < PATIENCE, "it does not end");
            thread::sleep(Duration::from_millis(20));
        }
        let code = self.child.wait().unwrap().code().unwrap_or(-1);
        self.readers.drain(..).for_each(|reader| reader.join().unwrap());
        let (stdout, stderr) = (self.stdout.lock().unwrap().clone(), self.stderr.lock().unwrap().clone());
        Run { code, stdout, stderr }
    }

    /// What it has said on the standard error.
    pub fn said(&self) -> String {
        self.stderr.lock().unwrap().clone()
    }
}

impl Drop for View<'_> {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn collect(mut from: impl std::io::Read + Send + 'static, into: &Arc<Mutex<String>>) -> JoinHandle<()> {
    let into = Arc::clone(into);
    thread::spawn(move || {
        let mut bytes = [0; 4096];
        while let Ok(count @ 1..) = from.read(&mut bytes) {
            into.lock().unwrap().push_str(&String::from_utf8_lossy(&bytes[..count]));
        }
    })
}
