//! The options of `surfel report`.

use std::path::PathBuf;

use clap::Args;
use surfel::scene::OptionValue as _;

use super::command_line::CommandLine;
use crate::{device::DeviceArguments, parse};

const HELP: &str = "\
Make a page of what this device can do: the model in pictures; every method's speed against its error; the filters over \
distance; the papers' figures; what frames cost beside the least that the same pixels can cost; what transparent layers \
cost, and transitions from splats to polygons; numerical stability. It says first what makes its times doubtful, and last \
what to type for each part by itself.

The page is one file that loads nothing: it opens offline, on a phone and on paper, and can be sent as it is. It holds \
no date: two runs differ in times, and what is told of them, alone. It takes many minutes; --quick, one or two. Nothing is \
written before all is done.";

const EXAMPLES: &str = "Examples:
  surfel report --quick                      surfel-report/index.html, of the built-in model
  surfel report --model igea.ply -o igea     of a scan, every method
  surfel report --device 1 --frames 50 -o b  of another device, with more frames";

/// All of it as one page: pictures, tables, and plots of speed against error
#[derive(Args)]
#[command(long_about = HELP, after_help = EXAMPLES)]
pub struct ReportArguments {
    /// The folder: index.html is the page, report.json has all figures; made where it is missing, old ones are replaced
    #[arg(short, long, value_name = "DIR", default_value = "surfel-report")]
    pub output: PathBuf,

    /// A model of any kind that `surfel render` reads [default: the built-in model]
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

    #[command(flatten)]
    pub device: DeviceArguments,
}

/// The size at which the model is shown, over that at which its errors are found.
const PICTURE_SCALE: u32 = 3;

/// The size at which frames are timed in the short form, over that at which their errors are found.
const QUICK_TIME_SCALE: u32 = 2;

impl ReportArguments {
    /// Width and height of the pictures whose errors are found.
    pub fn size_px(&self) -> [u32; 2] {
        self.size.unwrap_or([256, 256])
    }

    /// The command line that draws the model with a shading.
    pub fn render(&self, shading: &str) -> CommandLine {
        let size_px = self.size_px().map(|side| side.saturating_mul(PICTURE_SCALE));
        let line = self.on_model("render").option("-o", format!("{shading}.png"));
        // As the other parts have it.
        let line = line.given("--representation", self.model.as_ref().map(|_| "splats"));
        self.on_device(line.option("--size", size_px.word()).option("--shading", shading))
    }

    /// The command line that compares the methods.
    pub fn compare(&self) -> CommandLine {
        let line = self.with_samples(self.with_size(self.on_model("compare")));
        let time_size_px = self.size_px().map(|side| side.saturating_mul(QUICK_TIME_SCALE));
        let line = match self.quick {
            true => line.word("--quick").option("--time-size", time_size_px.word()),
            false => line,
        };
        self.on_device(self.with_frames(line)).option("--plot", "methods.svg")
    }

    /// The command line that compares the filters over distance.
    pub fn zoom(&self) -> CommandLine {
        let steps = self.zoom_steps.or(self.quick.then_some(9));
        let line = self.with_size(CommandLine::new(["compare", "--zoom"]));
        let line = line.given("--zoom-splats", self.quick.then_some("300"));
        let line = line.given("--zoom-steps", steps.map(|steps| steps.to_string()));
        let line = line.given("--size", (self.quick && self.size.is_none()).then_some("128x128"));
        self.on_device(self.with_samples(line)).option("--plot", "distance.svg")
    }

    /// The command line that draws a figure.
    pub fn figure(&self, name: &str) -> CommandLine {
        self.on_device(CommandLine::new(["figure", name]))
    }

    /// The command line that measures a table; the short form takes fewer splats and pixels.
    pub fn bench(&self, name: &str) -> CommandLine {
        let line = CommandLine::new(["bench", name]);
        if name == "counts" {
            return line;
        }
        let (splats, size) = match name {
            "p1" if !self.quick => (Some("137062,302948,437645,1M"), None),
            _ if !self.quick => (None, None),
            "table1" => (Some("20k,154k"), None),
            "slides" => (Some("154k"), None),
            "p1" => (Some("100k,300k"), None),
            "layers" => (Some("300"), Some("512x512")),
            "transition" | "hybrid" => (Some("20k"), Some("512x512")),
            _ => (None, None),
        };
        let line = line.given("--model", self.model.as_ref().filter(|_| !matches!(name, "layers" | "i3")));
        let line = line.given("--splats", splats).given("--size", size);
        let line = line.given("--plot", ["table1", "i3"].contains(&name).then(|| format!("{name}.svg")));
        if matches!(name, "p1" | "i3") {
            return line;
        }
        let line = self.on_device(self.with_frames(line));
        if self.device.validate { line.word("--validate") } else { line }
    }

    fn on_model(&self, command: &str) -> CommandLine {
        CommandLine::new([command]).input(self.model.as_deref())
    }

    fn with_size(&self, line: CommandLine) -> CommandLine {
        line.given("--size", self.size.map(|size_px| size_px.word()))
    }

    fn with_samples(&self, line: CommandLine) -> CommandLine {
        let samples = self.samples.or(self.quick.then_some(8));
        line.given("--samples", samples.map(|samples| samples.to_string()))
    }

    fn with_frames(&self, line: CommandLine) -> CommandLine {
        let frames = self.frames.or(self.quick.then_some(6));
        line.given("--frames", frames.map(|frames| frames.to_string()))
    }

    fn on_device(&self, line: CommandLine) -> CommandLine {
        line.given("--device", self.device.asked.as_ref())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        bench::BenchArguments, compare::CompareArguments, figure::FigureArguments, render::RenderArguments,
    };

    fn report(words: &[&str]) -> ReportArguments {
        CommandLine::new(["report"].iter().chain(words)).arguments().unwrap_or_else(|e| panic!("{e}"))
    }

    #[test]
    fn every_line_is_one_of_the_program_in_both_forms() {
        let given =
            ["--model", "a b.ply", "--device", "1", "--frames", "7", "--size", "9x9", "--samples", "3"];
        for words in [&[][..], &["--quick"], &given] {
            let arguments = report(words);
            arguments.render("normals").arguments::<RenderArguments>().unwrap_or_else(|e| panic!("{e}"));
            arguments.figure("g1").arguments::<FigureArguments>().unwrap_or_else(|e| panic!("{e}"));
            for table in ["floor", "table1", "slides", "layers", "transition", "p1", "p2", "hybrid", "counts"]
            {
                arguments.bench(table).arguments::<BenchArguments>().unwrap_or_else(|e| panic!("{e}"));
            }
            for line in [arguments.compare(), arguments.zoom()] {
                line.arguments::<CompareArguments>().unwrap_or_else(|e| panic!("{line}: {e}"));
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
