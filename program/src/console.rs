//! The program's words: results to the standard output, all else to the standard error, and bars for long steps.

use std::{
    io::{self, Write as _},
    mem,
    sync::{
        Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
};

use indicatif::{ProgressBar, ProgressStyle};
use surfel::{Error, Progress, Result, error::one_line};

/// Prints a result and ends its last line. A reader that has left, as in `surfel info | head -1`, is no failure.
///
/// # Errors
/// The standard output can't be written to, such as a full disk.
pub fn print(text: &str) -> Result<()> {
    let mut out = io::stdout().lock();
    let end = if text.ends_with('\n') { "" } else { "\n" };
    match write!(out, "{text}{end}").and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Error::file("standard output", "write", error))
        }
        _ => Ok(()),
    }
}

/// Another process says what this one would.
static QUIET: AtomicBool = AtomicBool::new(false);

/// From now on this process tells nothing but why it fails.
#[cfg(feature = "mpi")]
pub fn be_quiet() {
    QUIET.store(true, Ordering::Relaxed);
}

/// Tells something that is no result. Names in it may be a file's.
pub fn say(text: &str) {
    if !QUIET.load(Ordering::Relaxed) {
        tell(text);
    }
}

fn tell(text: &str) {
    let lines: Vec<String> = text.split('\n').map(one_line).collect();
    let _ = writeln!(io::stderr(), "{}", lines.join("\n"));
}

/// Tells why the program fails: one line, whatever is in the text.
pub fn fail(text: &str) {
    let lines: Vec<&str> = text.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    let line = lines.join(" ");
    tell(&format!("surfel: {line}"));
}

/// Lines of which equal ones that follow each other are one, with their number.
#[derive(Default)]
pub struct Repeated {
    /// The last line, and how often it came.
    last: Option<(String, usize)>,
}

impl Repeated {
    /// Tells a line once it is known how often it comes.
    pub fn say(&mut self, line: &str, bars: &Bars) {
        match &mut self.last {
            Some((last, times)) if last == line => *times += 1,
            _ => {
                self.end(bars);
                self.last = Some((line.to_owned(), 1));
            }
        }
    }

    /// Tells the last line.
    pub fn end(&mut self, bars: &Bars) {
        match self.last.take() {
            None => {}
            Some((line, 1)) => bars.note(&line),
            Some((line, times)) => bars.note(&format!("{times} × {line}")),
        }
    }
}

/// One progress bar at a time, on the standard error; none where that is not a terminal.
#[derive(Default)]
pub struct Bars {
    /// The running task's name and its bar.
    running: Mutex<Option<(String, ProgressBar)>>,
    /// Notes of work that may still fail.
    held: Mutex<Option<Vec<String>>>,
}

impl Bars {
    /// No bar yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Removes the bar of a task that did not come to its end.
    pub fn clear(&self) {
        if let Some((_, bar)) = self.lock().take() {
            bar.finish_and_clear();
        }
    }

    /// Does work whose notes are told when it has succeeded: where it fails, why is the only line.
    pub fn held<T>(&self, work: impl FnOnce() -> Result<T>) -> Result<T> {
        let outer = self.notes().replace(Vec::new());
        let done = work();
        let notes = mem::replace(&mut *self.notes(), outer);
        if done.is_ok() {
            notes.iter().flatten().for_each(|note| self.note(note));
        }
        done
    }

    fn notes(&self) -> MutexGuard<'_, Option<Vec<String>>> {
        self.held.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn lock(&self) -> MutexGuard<'_, Option<(String, ProgressBar)>> {
        // A panic of another thread leaves a bar behind, which is as good as any.
        self.running.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Progress for Bars {
    fn step(&self, task: &str, done: u64, total: u64) {
        let mut running = self.lock();
        if running.as_ref().is_none_or(|(name, _)| name != task) {
            if let Some((_, bar)) = running.take() {
                bar.finish_and_clear();
            }
            if done >= total {
                return;
            }
            let bar = ProgressBar::new(total);
            // The template is a constant that parses; the plain bar is what is left otherwise.
            if let Ok(style) = ProgressStyle::with_template("{msg:40!} [{bar:30}] {percent:>3}%") {
                bar.set_style(style.progress_chars("=> "));
            }
            bar.set_message(task.to_owned());
            *running = Some((task.to_owned(), bar));
        }
        if let Some((_, bar)) = running.as_ref() {
            bar.set_position(done);
        }
        if done >= total
            && let Some((_, bar)) = running.take()
        {
            bar.finish_and_clear();
        }
    }

    fn note(&self, text: &str) {
        if let Some(held) = self.notes().as_mut() {
            return held.push(text.to_owned());
        }
        match self.lock().as_ref() {
            Some((_, bar)) => bar.suspend(|| say(text)),
            None => say(text),
        }
    }
}
