//! The options of `surfel figure`, and what figures there are.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use surfel::{Error, Result};

use crate::{device::DeviceArguments, parse};

const HELP: &str = "\
Draw a figure of the papers as a labeled picture: comparisons as PNG, curves as SVG. G is Guennebaud, Barthe, Paulin, \
\"Splat/Mesh Blending, Perspective Rasterization and Transparency for Point-Based Rendering\", 2006; P is Pajarola, Sainz, \
Guidotti, \"Object-Space Blending and Splatting of Points\", 2003; I is Ivo et al., \"Adaptive Clipping of Splats to Models with Sharp \
Features\", 2012. Everything shown was drawn by the device. Without a name, \
the figures are listed.";

const EXAMPLES: &str = "Examples:
  surfel figure                            what there is
  surfel figure g3                         g3.png in the current folder
  surfel figure p10 -o kernels.svg
  surfel figure p19 --model igea.ply --size 600x600";

/// Draw the papers' figures as labeled pictures
#[derive(Args)]
#[command(long_about = HELP, after_help = EXAMPLES)]
#[command(mut_arg("device", |device| device.requires("name")), mut_arg("validate", |validate| validate.requires("name")))]
pub struct FigureArguments {
    /// Which figure [default: list them]
    #[arg(value_name = "NAME")]
    pub name: Option<Figure>,

    /// The file: .svg for p9, p10 and samples, .png for the others [default: the figure's name, in the current folder]
    #[arg(short, long, value_name = "FILE", requires = "name")]
    pub output: Option<PathBuf>,

    /// Width and height in pixels: of each panel without its labels, or of the plot; 32 to 4096 a side, g1 square [default: the figure's own]
    #[arg(long, value_name = "WxH", requires = "name", value_parser = parse::size)]
    pub size: Option<[u32; 2]>,

    /// The model that g5 (a mesh), p17, p19, p20, and i1, i9 and i10 (a mesh with sharp edges) show [default: the built-in model with few triangles
    /// or splats; for i1, i9 and i10 the built-in part]
    #[arg(long, value_name = "FILE", requires = "name")]
    pub model: Option<PathBuf>,

    #[command(flatten)]
    pub device: DeviceArguments,
}

/// The figures of the papers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Figure {
    /// G figure 1, the filters' footprints: the weight of one splat over the image, magnified, minified and both, without a
    /// filter, under full EWA, under tangent adjustment, ours and the paper's, and under the maximum
    G1,
    /// G figure 3, a checkerboard of 600x600 points to the horizon: no filter, EWA, tangent adjustment, maximum
    G3,
    /// G figure 4, splats that are magnified across and minified along the view: maximum against tangent adjustment
    G4,
    /// G figure 5, one model half as polygons and half as splats: the seam as it is, smoothed, the weights that smooth it,
    /// and smoothed without splats on the edges where both meet
    G5,
    /// G figure 6, 27 transparent balls: in 6 layers, in 3, in 3 with the rest blended into the last; and in all
    G6,
    /// G slides beside figure 6, depth peeling of a glass model: all layers, only the first 1 or 2, and with the rest
    /// blended into one more
    Slides,
    /// P figure 9, Gaussian kernels for six widths, as curves
    P9,
    /// P figure 10, the kernels psi_E for six pairs of n and a, as curves
    P10,
    /// P figure 17, normalization: sums of weights, sums of weighted colors, and their quotient
    P17,
    /// P figure 18, a checkerboard of 512x512 points with a round kernel and a more localized one
    P18,
    /// P figure 19, a model with a narrow kernel and with one that has a plateau
    P19,
    /// P figure 20, a model as it is, at the paper's tolerance, and with half as many splats
    P20,
    /// I figure 1, a curved edge of few splats from three distances: not cut, cut by lines, cut by curves
    I1,
    /// I figure 3, a splat cut by curves with six weights of the middle control point
    I3,
    /// I figure 5, a splat cut by the same curve in both directions
    I5,
    /// I figure 7, splats for a triangle: circles around its centroid and through its corners, the ellipse; and their areas
    I7,
    /// I figure 9, a mesh with sharp edges, and 2500 splats for it: not cut, cut by lines, cut by curves
    I9,
    /// I figure 10, 2500 splats with clip curves from three distances
    I10,
    /// I figure 11, a curved edge of few splats: the mesh's, of the splats of its flat side, and of those of both sides
    I11,
    /// A figure of no paper: the error of pictures of 1 to 256 samples a pixel against the ground truth, as curves
    Samples,
}

/// The sides that a panel or plot may have.
const SIDES_PX: std::ops::RangeInclusive<u32> = 32..=4096;

impl Figure {
    /// The name on the command line.
    pub fn name(self) -> String {
        self.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
    }

    /// The ending of its file's name.
    pub fn extension(self) -> &'static str {
        match self {
            Self::P9 | Self::P10 | Self::Samples => "svg",
            _ => "png",
        }
    }

    /// Width and height of a panel or plot where none are given.
    fn default_size_px(self) -> [u32; 2] {
        match self {
            Self::G1 => [240, 240],
            Self::G3 => [800, 240],
            Self::G4 => [400, 300],
            Self::G5 => [480, 400],
            Self::G6 => [480, 480],
            Self::Slides => [400, 400],
            Self::P9 | Self::P10 | Self::Samples => [900, 600],
            Self::P18 => [512, 400],
            Self::P17 | Self::P19 | Self::P20 => [512, 512],
            Self::I1 | Self::I10 | Self::I11 => [360, 360],
            Self::I3 | Self::I5 | Self::I7 => [300, 240],
            Self::I9 => [512, 512],
        }
    }

    /// Whether it shows another model where one is given.
    pub fn takes_model(self) -> bool {
        matches!(self, Self::G5 | Self::P17 | Self::P19 | Self::P20 | Self::I1 | Self::I9 | Self::I10)
    }

    /// Every figure with what it shows, a line each.
    pub fn list() -> String {
        let line = |figure: &Self| {
            let about =
                figure.to_possible_value().and_then(|value| value.get_help().map(ToString::to_string));
            format!("{:<8}{}\n", figure.name(), about.unwrap_or_default())
        };
        Self::value_variants().iter().map(line).collect()
    }
}

impl FigureArguments {
    /// The figure's file.
    ///
    /// # Errors
    /// A name that does not say what the file will be.
    pub fn output(&self, figure: Figure) -> Result<PathBuf> {
        let (name, extension) = (figure.name(), figure.extension());
        let Some(path) = &self.output else { return Ok(PathBuf::from(format!("{name}.{extension}"))) };
        match path.extension().is_some_and(|e| e.eq_ignore_ascii_case(extension)) {
            true => Ok(path.clone()),
            false => {
                let problem = format!("{}: expected a name in .{extension} for {name}", path.display());
                Err(Error::option("--output", problem))
            }
        }
    }

    /// Width and height of each panel or of the plot.
    ///
    /// # Errors
    /// A side out of range; another shape than square for `g1`.
    pub fn size_px(&self, figure: Figure) -> Result<[u32; 2]> {
        let [width, height] = self.size.unwrap_or_else(|| figure.default_size_px());
        let refuse =
            |expected: String| Err(Error::option("--size", format!("{width}x{height}: expected {expected}")));
        if ![width, height].iter().all(|side| SIDES_PX.contains(side)) {
            return refuse(format!("{} to {} pixels a side", SIDES_PX.start(), SIDES_PX.end()));
        }
        if figure == Figure::G1 && width != height {
            return refuse("a square, the panels of g1 are".to_owned());
        }
        Ok([width, height])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_explains_each_figure() {
        let list = Figure::list();
        assert_eq!(list.lines().count(), Figure::value_variants().len());
        assert!(list.lines().all(|line| line.contains(" figure ") && line.len() > 40), "{list}");
    }
}
