//! From pictures to a film, by ffmpeg.

use std::{
    ffi::OsString,
    fs, io,
    path::Path,
    process::{Command, Stdio},
};

use surfel::{Error, Result};

/// Pictures of a film.
pub struct Pictures<'a> {
    /// Their names, with the place of a number, which begins with 0.
    pub pattern: &'a Path,
    /// How many there are; others of such names may be of a film before.
    pub count: u64,
    /// How many are shown a second.
    pub fps: f64,
}

/// What ffmpeg is told: players know H.264 with colors at half the size, which has even sides.
fn arguments(pictures: &Pictures<'_>, film: &Path) -> Vec<OsString> {
    let Pictures { pattern, count, fps } = pictures;
    let words = ["-y", "-loglevel", "error", "-framerate", &fps.to_string(), "-i"].map(OsString::from);
    let of_film = [
        "-frames:v",
        &count.to_string(),
        "-vf",
        "pad=ceil(iw/2)*2:ceil(ih/2)*2",
        "-c:v",
        "libx264",
        "-crf",
        "16",
        "-pix_fmt",
        "yuv420p",
    ]
    .map(OsString::from);
    let mut all = words.to_vec();
    all.push(pattern.into());
    all.extend(of_film);
    all.push(film.into());
    all
}

/// The command, as it is typed into a shell.
pub fn command_line(pictures: &Pictures<'_>, film: &Path) -> String {
    let quoted = |word: &OsString| {
        let word = word.to_string_lossy();
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_./,:=+@%".contains(c);
        match !word.is_empty() && word.chars().all(plain) {
            true => word.into_owned(),
            false => format!("'{}'", word.replace('\'', "'\\''")),
        }
    };
    let words: Vec<String> = arguments(pictures, film).iter().map(quoted).collect();
    format!("ffmpeg {}", words.join(" "))
}

/// Makes a film of pictures; it appears whole or not at all.
///
/// # Errors
/// No ffmpeg, with the command for when there is one; what ffmpeg says.
pub fn encode(pictures: &Pictures<'_>, film: &Path) -> Result<()> {
    let mut unfinished = film.file_stem().unwrap_or_default().to_owned();
    unfinished.push(".unfinished.mp4");
    let unfinished = film.with_file_name(unfinished);
    let run = Command::new("ffmpeg")
        .args(arguments(pictures, &unfinished))
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .output();
    let refused = |problem: String| Err(Error::option("--output", format!("{}: {problem}", film.display())));
    match run {
        Ok(run) if run.status.success() => {
            fs::rename(&unfinished, film).map_err(|e| Error::file(film, "write", e))
        }
        Ok(run) => {
            let _ = fs::remove_file(&unfinished);
            let said = String::from_utf8_lossy(&run.stderr);
            let said = said.lines().next_back().unwrap_or("nothing").to_owned();
            refused(format!("ffmpeg failed: {said}"))
        }
        Err(e) if e.kind() == io::ErrorKind::NotFound => refused(format!(
            "there is no ffmpeg; the pictures are there, and this makes the film: {}",
            command_line(pictures, film)
        )),
        Err(e) => refused(format!("ffmpeg can't be run: {e}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_can_be_typed() {
        assert_eq!(
            command_line(
                &Pictures { pattern: Path::new("my films/out%04d.png"), count: 12, fps: 29.97 },
                Path::new("a.mp4")
            ),
            "ffmpeg -y -loglevel error -framerate 29.97 -i 'my films/out%04d.png' -frames:v 12 -vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2' -c:v libx264 \
             -crf 16 -pix_fmt yuv420p a.mp4"
        );
    }
}
