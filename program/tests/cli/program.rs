//! Runs the program in a folder of its own.

use std::{
    fs,
    io::Write as _,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
};

/// A folder that goes away with its content.
pub struct Folder(temp_dir::TempDir);

impl Folder {
    pub fn new() -> Self {
        Self(temp_dir::TempDir::new().unwrap())
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap();
    }

    pub fn json(&self, name: &str) -> serde_json::Value {
        serde_json::from_slice(&fs::read(self.path(name)).unwrap()).unwrap()
    }

    /// All that is in it, hidden or not, in order.
    pub fn names(&self) -> Vec<String> {
        names(self.0.path())
    }

    pub fn names_in(&self, folder: &str) -> Vec<String> {
        names(&self.path(folder))
    }
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// How the program ended, and what it said.
pub struct Run {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

/// Whether the driver counts all fragments that are drawn, as Mesa 22.3.6 (Debian 12) does, not only those that it must shade.
pub fn counts_all_fragments(report: &serde_json::Value) -> bool {
    report["device"]["driver"].as_str().unwrap().contains("Mesa 22.")
}

pub fn surfel(folder: &Folder, arguments: &[&str]) -> Run {
    surfel_with(folder, arguments, &[])
}

/// What has to work.
#[track_caller]
pub fn done(folder: &Folder, arguments: &[&str]) -> Run {
    let run = surfel(folder, arguments);
    assert_eq!(run.code, 0, "{}", run.stderr);
    run
}

/// With these environment variables.
pub fn surfel_with(folder: &Folder, arguments: &[&str], environment: &[(&str, &str)]) -> Run {
    run(command(folder, arguments).envs(environment.iter().copied()).output().unwrap())
}

/// With these bytes as standard input.
pub fn surfel_reading(folder: &Folder, arguments: &[&str], bytes: &[u8]) -> Run {
    let mut child = command(folder, arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(bytes).unwrap();
    run(child.wait_with_output().unwrap())
}

/// The program in the folder, without standard input.
pub fn command(folder: &Folder, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_surfel"));
    command
        .args(arguments)
        .current_dir(folder.0.path())
        .stdin(Stdio::null())
        // Tests don't fill the user's cache.
        .env_remove("XDG_CACHE_HOME")
        .env_remove("HOME");
    command
}

/// What has ended.
pub fn run(output: Output) -> Run {
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    Run {
        code: output.status.code().expect("the program was killed"),
        stdout: text(output.stdout),
        stderr: text(output.stderr),
    }
}
