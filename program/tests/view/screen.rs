//! An X server whose screen is a file, and its mouse and keyboard.

use std::{
    fs,
    io::{BufRead as _, BufReader},
    os::unix::fs::FileExt as _,
    process::{Child, Command, Stdio},
    sync::atomic::{AtomicU32, Ordering},
    thread,
    time::Duration,
};

use temp_dir::TempDir;

/// An X server of its own; ends with this.
pub struct Screen {
    server: Child,
    name: String,
    folder: TempDir,
}

/// Colors of the top left part of a screen, or of a picture: red, green, blue, row by row.
#[derive(Clone)]
pub struct Shot {
    pub size: [u32; 2],
    pub pixels: Vec<[u8; 3]>,
}

impl Screen {
    /// A server with a screen of 1280x1024 pixels.
    pub fn new() -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let folder = TempDir::new().unwrap();
        // Servers that choose for themselves may choose alike where they start at the same time.
        let display = 1000 + (8 * std::process::id() + COUNT.fetch_add(1, Ordering::Relaxed)) % 50_000;
        let mut server = Command::new("Xvfb")
            .arg(format!(":{display}"))
            // Without `-noreset` it begins anew when its last client goes, and refuses who comes meanwhile.
            .args([
                "-displayfd",
                "1",
                "-noreset",
                "-screen",
                "0",
                "1280x1024x24",
                "-nolisten",
                "tcp",
                "-fbdir",
            ])
            .arg(folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("needs Xvfb: third_party/with-deps installs it");
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        assert_eq!(number.trim().parse(), Ok(display), "Xvfb is not ready");
        Self { server, name: format!(":{display}"), folder }
    }

    /// As in `DISPLAY`.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What is seen now in the top left corner: the server keeps its screen in a file of the format XWD.
    pub fn shot(&self, size: [u32; 2]) -> Shot {
        let bytes = fs::read(self.folder.path().join("Xvfb_screen0")).unwrap();
        let field = |i: usize| u32::from_be_bytes(bytes[4 * i..4 * i + 4].try_into().unwrap()) as usize;
        let (header, row_bytes, colors) = (field(0), field(12), field(19));
        assert_eq!((field(11), field(7)), (32, 0), "32 bits a pixel, the least byte first");
        let first = header + 12 * colors;
        let row = |y: usize| {
            let row = &bytes[first + y * row_bytes..][..4 * size[0] as usize];
            row.chunks_exact(4).map(|pixel| [pixel[2], pixel[1], pixel[0]]).collect::<Vec<_>>()
        };
        Shot { size, pixels: (0..size[1] as usize).flat_map(row).collect() }
    }

    /// What is seen now in a square, each row as the server keeps it: next to nothing is read, so that who looks often takes no time from who draws.
    pub fn square(&self, [left, top]: [u32; 2], side: u32) -> Vec<u8> {
        let file = fs::File::open(self.folder.path().join("Xvfb_screen0")).unwrap();
        let mut header = [0; 80];
        file.read_exact_at(&mut header, 0).unwrap();
        let field = |i: usize| u32::from_be_bytes(header[4 * i..4 * i + 4].try_into().unwrap());
        let first = u64::from(field(0) + 12 * field(19));
        let row_bytes = 4 * side as usize;
        let mut pixels = vec![0; row_bytes * side as usize];
        for (y, row) in (top..).zip(pixels.chunks_exact_mut(row_bytes)) {
            file.read_exact_at(row, first + u64::from(y * field(12) + 4 * left)).unwrap();
        }
        pixels
    }

    /// Runs xdotool, which moves the mouse and presses keys by the extension XTEST.
    pub fn drive(&self, words: &[&str]) -> String {
        let command = Command::new("xdotool").args(words).env("DISPLAY", &self.name).output();
        let output = command.expect("needs xdotool: third_party/with-deps installs it");
        String::from_utf8(output.stdout).unwrap()
    }

    /// Presses a key and releases it.
    pub fn key(&self, name: &str) {
        self.drive(&["key", name]);
    }

    /// Drags the mouse, in steps that a hand could do.
    pub fn drag(&self, from: [i32; 2], to: [i32; 2], button: u32) {
        const STEPS: i32 = 8;
        let at = |step: i32| [0, 1].map(|i| (from[i] + (to[i] - from[i]) * step / STEPS).to_string());
        let button = button.to_string();
        for step in 0..=STEPS {
            let [x, y] = at(step);
            self.drive(&["mousemove", &x, &y]);
            if step == 0 {
                self.drive(&["mousedown", &button]);
            }
            thread::sleep(Duration::from_millis(10));
        }
        self.drive(&["mouseup", &button]);
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

impl Shot {
    /// Its top left part.
    pub fn corner(&self, size: [u32; 2]) -> Self {
        let rows = self.pixels.chunks_exact(self.size[0] as usize).take(size[1] as usize);
        Self { size, pixels: rows.flat_map(|row| &row[..size[0] as usize]).copied().collect() }
    }

    /// In how many pixels a color differs by more than one step of 8 bits.
    pub fn differs_from(&self, other: &Self) -> usize {
        assert_eq!(self.size, other.size);
        let differs = |a: &[u8; 3], b: &[u8; 3]| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 1);
        self.pixels.iter().zip(&other.pixels).filter(|(a, b)| differs(a, b)).count()
    }

    /// How many colors there are.
    pub fn colors(&self) -> usize {
        self.pixels.iter().collect::<std::collections::HashSet<_>>().len()
    }
}
