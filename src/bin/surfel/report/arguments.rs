//! The options of `surfel report`.

use std::path::PathBuf;

use clap::Args;

use super::command_line::CommandLine;
use crate::parse;

/// Options of `surfel report`.
#[derive(Debug, Args)]
pub struct ReportArguments {
    /// The folder: index.html is the page, report.json has all figures; made where it is missing, old ones are replaced
    #[arg(short, long, value_name = "DIR", default_value = "surfel-report")]
    pub output: PathBuf,

    /// A PLY or OBJ file [default: the built-in model]
    #[arg(long, value_name = "FILE")]
    pub model: Option<PathBuf>,

    /// Fewer methods, distances, frames and samples: a minute or two in place of many
    #[arg(long)]
    pub quick: bool,

    /// Width and height of the pictures whose errors are found, in pixels [default: 256x256; with --quick
    /// 128x128 over distance]
    #[arg(long, value_name = "WxH", value_parser = parse::size)]
    pub size: Option<[u32; 2]>,

    /// Samples along a pixel's side in the ground truth [default: 16; with --quick: 8]
    #[arg(long, value_name = "N", value_parser = parse::whole::<u32>(1..=256), allow_hyphen_values = true)]
    pub samples: Option<u32>,

    /// Distances at which filters are compared [default: 25; with --quick: 9]
    #[arg(long, value_name = "N", value_parser = parse::whole::<u32>(2..=1000), allow_hyphen_values = true)]
    pub zoom_steps: Option<u32>,

    /// Frames timed of each method and rounds of each bench; below 6 no median's interval is known [default: 10 and
    /// 20; with --quick: 6]
    #[arg(long, value_name = "N", value_parser = parse::whole::<u32>(1..=100_000), allow_hyphen_values = true)]
    pub frames: Option<u32>,

    /// The device: its number or a part of its name, see `surfel info` [default: the best]
    #[arg(long, value_name = "NAME|INDEX")]
    pub device: Option<String>,

    /// Have the Vulkan validation layer watch, which makes the times worthless; any message makes the exit code 3
    #[arg(long)]
    pub validate: bool,
}

/// How much larger the model is shown than its errors are found.
const PICTURE_SCALE: u32 = 3;

/// How much larger frames are timed than their errors are found, in the short form.
const QUICK_TIME_SCALE: u32 = 2;

impl ReportArguments {
    /// Width and height of the pictures whose errors are found.
    pub fn size_px(&self) -> [u32; 2] {
        self.size.unwrap_or([256, 256])
    }

    /// The command line that draws the model with a shading.
    pub fn render(&self, shading: &str) -> CommandLine {
        let size_px = self.size_px().map(|side| side.saturating_mul(PICTURE_SCALE));
        let line = CommandLine::new(["render"]).input(self.model.as_deref());
        let line = line.word("-o").word(format!("{shading}.png"));
        self.on_device(line.option("--size", text(size_px)).option("--shading", shading))
    }

    /// The command line that compares the methods.
    pub fn compare(&self) -> CommandLine {
        let line = CommandLine::new(["compare"]).input(self.model.as_deref());
        let line = self.with_samples(self.with_size(line));
        let time_size_px = self.size_px().map(|side| side.saturating_mul(QUICK_TIME_SCALE));
        let line = match self.quick {
            true => line.word("--quick").option("--time-size", text(time_size_px)),
            false => line,
        };
        self.on_device(self.with_frames(line)).option("--plot", "methods.svg")
    }

    /// The command line that compares the filters over distance.
    pub fn zoom(&self) -> CommandLine {
        let line = self.with_size(CommandLine::new(["compare", "--zoom"]));
        let line = match self.quick {
            true => line.option("--zoom-splats", "300"),
            false => line,
        };
        let line = match self.zoom_steps.or(self.quick.then_some(9)) {
            Some(steps) => line.option("--zoom-steps", steps.to_string()),
            None => line,
        };
        let line = match self.quick && self.size.is_none() {
            true => line.option("--size", "128x128"),
            false => line,
        };
        self.on_device(self.with_samples(line)).option("--plot", "distance.svg")
    }

    /// The command line that draws a figure.
    pub fn figure(&self, name: &str) -> CommandLine {
        self.on_device(CommandLine::new(["figure", name]))
    }

    /// The command line that measures a table.
    pub fn bench(&self, name: &str) -> CommandLine {
        let line = CommandLine::new(["bench", name]);
        let line = match &self.model {
            Some(model) if name != "layers" => line.option("--model", model),
            _ => line,
        };
        let line = match self.splats(name) {
            Some(splats) => line.option("--splats", splats),
            None => line,
        };
        let line = match self.quick && ["layers", "transition"].contains(&name) {
            true => line.option("--size", "512x512"),
            false => line,
        };
        let line = match name == "table1" {
            true => line.option("--plot", "table1.svg"),
            false => line,
        };
        match name == "counts" {
            true => CommandLine::new(["bench", name]),
            false => {
                let line = self.on_device(self.with_frames(line));
                if self.validate { line.word("--validate") } else { line }
            }
        }
    }

    /// Fewer splats in the short form.
    fn splats(&self, table: &str) -> Option<&'static str> {
        match table {
            "table1" if self.quick => Some("20k,154k"),
            "slides" if self.quick => Some("154k"),
            "layers" if self.quick => Some("300"),
            "transition" if self.quick => Some("20k"),
            _ => None,
        }
    }

    fn with_size(&self, line: CommandLine) -> CommandLine {
        match self.size {
            Some(size_px) => line.option("--size", text(size_px)),
            None => line,
        }
    }

    fn with_samples(&self, line: CommandLine) -> CommandLine {
        match self.samples.or(self.quick.then_some(8)) {
            Some(samples) => line.option("--samples", samples.to_string()),
            None => line,
        }
    }

    fn with_frames(&self, line: CommandLine) -> CommandLine {
        match self.frames.or(self.quick.then_some(6)) {
            Some(frames) => line.option("--frames", frames.to_string()),
            None => line,
        }
    }

    fn on_device(&self, line: CommandLine) -> CommandLine {
        match &self.device {
            Some(device) => line.option("--device", device),
            None => line,
        }
    }
}

fn text([width, height]: [u32; 2]) -> String {
    format!("{width}x{height}")
}

#[cfg(test)]
mod tests {
    use clap::Parser as _;

    use super::*;
    use crate::arguments::{Arguments, Command};

    fn report(words: &[&str]) -> ReportArguments {
        match Arguments::try_parse_from(["surfel", "report"].iter().chain(words)).unwrap().command {
            Command::Report(arguments) => arguments,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn every_line_is_one_of_the_program_in_both_forms() {
        let given =
            ["--model", "a b.ply", "--device", "1", "--frames", "7", "--size", "9x9", "--samples", "3"];
        for words in [&[][..], &["--quick"], &given] {
            let arguments = report(words);
            assert!(matches!(arguments.render("normals").command(), Ok(Command::Render(_))), "{words:?}");
            assert!(matches!(arguments.figure("g1").command(), Ok(Command::Figure(_))), "{words:?}");
            for table in ["floor", "table1", "slides", "layers", "transition", "counts"] {
                assert!(matches!(arguments.bench(table).command(), Ok(Command::Bench(_))), "{words:?}");
            }
            for line in [arguments.compare(), arguments.zoom()] {
                assert!(matches!(line.command(), Ok(Command::Compare(_))), "{line}");
            }
        }
        let line = report(&given).compare().to_string();
        let expected =
            "surfel compare 'a b.ply' --size 9x9 --samples 3 --frames 7 --device 1 --plot methods.svg";
        assert_eq!(line, expected);
    }

    #[test]
    fn the_full_form_is_what_the_subcommands_do_by_themselves() {
        let full = report(&[]);
        assert_eq!(full.compare().to_string(), "surfel compare --plot methods.svg");
        assert_eq!(full.zoom().to_string(), "surfel compare --zoom --plot distance.svg");
        assert_eq!(full.bench("floor").to_string(), "surfel bench floor");
    }
}
