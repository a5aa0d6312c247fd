//! The options of all that draws one picture: what is drawn, from where and how.

use std::path::PathBuf;

use clap::{Arg, Args};
use surfel::{
    Result,
    load::PictureDescription,
    prepare::PreparedScene,
    renderer::Renderer,
    scene::{Camera, Crop, CropView, Edges, Encoding, Light, OptionValue as _, Samples, Scene, Settings},
};

use crate::{
    camera::CameraArguments,
    console,
    inputs::InputArguments,
    scene::Loaded,
    settings::{Given, Taken},
};

/// A picture.
#[derive(Args)]
pub struct PictureArguments {
    #[command(flatten)]
    pub input: InputArguments,

    /// The picture: .png is 8-bit sRGB, .exr is linear 32-bit floats; what --background none leaves open is alpha, which colors are multiplied by in .exr, and
    /// not in .png [default: surfel.png, or reference.png of `surfel reference`]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Also write weight (the sum), albedo (linear color), normal (view space: x right, y down, z forward) and depth (along
    /// z, in the files' unit) of the opaque splats' surface, and the final picture, as .exr into this folder, 32-bit floats
    #[arg(long, value_name = "DIR")]
    pub dump: Option<PathBuf>,

    /// Draw only this part of the picture, in pixels from its top left corner: it may be larger than the device can draw. The pixels are those of the whole
    /// picture where points draw both, or tiles with --cull setup; else but for rounding, by which a splat or triangle may cover a pixel more or less at its edge
    #[arg(long, value_name = "X,Y,W,H", value_parser = Crop::parse, allow_hyphen_values = true)]
    pub crop: Option<Crop>,

    #[command(flatten)]
    pub camera: CameraArguments,

    /// Print the camera as one line of options that make it again
    #[arg(long, help_heading = "Camera")]
    pub print_camera: bool,

    /// A light in place of those of scene files, and of the one at the eye: eye, or the direction in which it travels, with color (sRGB)
    /// and intensity where they are not 1, such as direction=0,-1,-1,color=1,0.9,0.8,intensity=2; once for each light
    #[arg(long = "light", value_name = "LIGHT", value_parser = Light::parse, allow_hyphen_values = true, help_heading = "Method")]
    lights: Vec<Light>,

    #[command(flatten)]
    settings: Given<Settings>,

    #[command(flatten)]
    encoding: Given<Encoding>,
}

/// An eighth of a pixel is what the eye still sees of a stair.
const SMOOTH: Samples = Samples(8);

impl Taken for Settings {
    type Table = Self;

    fn option(name: &str, option: Arg) -> Option<Arg> {
        Some(option.help_heading((name != "size").then_some("Method")))
    }
}

impl Taken for Encoding {
    type Table = Self;

    fn option(_name: &str, option: Arg) -> Option<Arg> {
        Some(option.help_heading("Method"))
    }
}

impl PictureArguments {
    /// How linear light becomes the picture, not yet checked.
    pub fn encoding(&self) -> Encoding {
        self.encoding.over(Encoding::default())
    }

    /// Puts the lights in the place of the scene's, where there are any.
    pub fn light(&self, scene: &mut Scene) {
        if !self.lights.is_empty() {
            scene.lights.clone_from(&self.lights);
        }
    }

    /// The settings, not yet checked.
    pub fn settings(&self) -> Settings {
        self.settings.over(Settings::default())
    }

    /// The names of the settings that the user gave, and of what else makes a picture.
    pub fn said(&self) -> impl Iterator<Item = &'static str> {
        let light = (!self.lights.is_empty()).then_some("light");
        self.settings.said().chain(self.encoding.said()).chain(light)
    }

    /// The settings where a scene file says something of the picture, not yet checked.
    pub fn settings_in(&self, scene_file: &PictureDescription) -> Settings {
        self.settings.said_over(scene_file.over(self.settings()))
    }

    /// The settings for a scene that was loaded, with [`samples_unsaid`] unless the command line says how many; a dump shows one.
    pub fn settings_of(&self, loaded: &Loaded, renderer: &Renderer) -> Settings {
        let settings = self.settings_in(&loaded.picture);
        if self.settings.says("samples") || self.dump.is_some() {
            return settings;
        }
        Settings { samples: samples_unsaid(&settings, &loaded.scene, renderer), ..settings }
    }

    /// These settings for a view of a scene, [`smoothed`] unless the command line says how many samples there are; of a part, as all of the picture is.
    pub fn smoothed(
        &self,
        settings: Settings,
        part: &Drawn,
        view: (&PreparedScene, &Camera),
        renderer: &Renderer,
    ) -> Settings {
        if self.settings.says("samples") || self.dump.is_some() {
            return settings;
        }
        let whole = Settings { size_px: part.whole_px, ..settings.clone() };
        let Settings { samples, edges, .. } = smoothed(whole, view, renderer);
        Settings { samples, edges, ..settings }
    }

    /// Tells where pixels were asked to be covered in part, and how splats are drawn does not do that.
    ///
    /// # Errors
    /// As [`Renderer::covers_in_part`].
    pub fn tell_of_edges(
        &self,
        settings: &Settings,
        (scene, camera): (&PreparedScene, &Camera),
        renderer: &Renderer,
    ) -> Result<()> {
        let is_asked = self.settings.says("edges") && settings.edges == Edges::Coverage;
        if is_asked && settings.samples.0 == 1 && !renderer.covers_in_part(scene, camera, settings)? {
            console::say(NO_EDGES);
        }
        Ok(())
    }

    /// What is drawn, of a picture with those settings: the whole of it, or a part.
    ///
    /// # Errors
    /// A part that is not within the picture.
    pub fn drawn(&self, settings: Settings) -> Result<Drawn> {
        settings.validate()?;
        let whole_px = settings.size_px;
        let crop = self.crop.unwrap_or(Crop { corner_px: [0; 2], size_px: whole_px });
        let drawn_px = crop.view_shaded(whole_px, &Camera::default(), settings.shading)?.drawn_px;
        let settings = Settings { size_px: drawn_px, ..settings };
        Ok(Drawn { whole_px, crop: self.crop, settings })
    }
}

/// How many samples pixels of a scene have where the command line does not say it. With polygons they are several: in one, outlines of triangles are stairs
/// without splats beside them, and with splats twice as far from what there is. Not where they can't be taken.
pub fn samples_unsaid(settings: &Settings, scene: &Scene, renderer: &Renderer) -> Samples {
    let has_outlines = !scene.meshes.is_empty() && settings.edges == Edges::Coverage;
    let several = Settings { samples: SMOOTH, ..settings.clone() };
    let can = has_outlines && renderer.check_settings(&several).is_ok();
    if can { SMOOTH } else { settings.samples }
}

/// These settings; or several samples, where one does not show where the splats of a view end: where they do not cover pixels in part, by their method or by
/// their sizes, with hard edges, which cover as much; and where curves cut them, since at ridges their sums tell too little of what is covered.
pub fn smoothed(
    settings: Settings,
    (scene, camera): (&PreparedScene, &Camera),
    renderer: &Renderer,
) -> Settings {
    if settings.samples.0 > 1 || settings.edges == Edges::Hard {
        return settings;
    }
    let edges = match renderer.covers_in_part(scene, camera, &settings) {
        Ok(false) => Edges::Hard,
        _ if scene.chunks().iter().any(|chunk| chunk.clipped) => Edges::Coverage,
        _ => return settings,
    };
    let several = Settings { samples: SMOOTH, edges, ..settings.clone() };
    if renderer.check_settings(&several).is_ok() { several } else { settings }
}

const NO_EDGES: &str = "--edges coverage has no effect: it is for splats by tiles, with a filter that widens them, shaded by their normals and smaller than the picture; --samples 8 does the same for all";

/// What is drawn of a picture.
pub struct Drawn {
    /// The size of the whole picture.
    pub whole_px: [u32; 2],
    /// The part that is wanted, if not all.
    pub crop: Option<Crop>,
    /// With the size that is drawn.
    pub settings: Settings,
}

impl Drawn {
    /// The camera of what is drawn, of that of the whole picture; and what is cut out then.
    ///
    /// # Errors
    /// A part that is not within the picture.
    pub fn view(&self, camera: Camera) -> Result<(Camera, Option<CropView>)> {
        let shading = self.settings.shading;
        let view = self.crop.map(|crop| crop.view_shaded(self.whole_px, &camera, shading)).transpose()?;
        Ok((view.map_or(camera, |view| view.camera), view))
    }
}

#[cfg(test)]
mod tests {
    use clap::{Command, FromArgMatches as _};
    use surfel::scene::{
        Accumulate, Backfaces, Budget, ClipBox, ClipPlanes, Cull, Edges, Epsilon, Filter, FilterWeight,
        Kernel, KernelEval, LastLayer, Layers, Lod, LodSteps, Outlines, Rasterizer, Samples, Shading,
        TileInvocations, TileMemory, Transition,
    };

    use super::*;
    use crate::up::Up;

    fn picture(words: &[String]) -> PictureArguments {
        let command = PictureArguments::augment_args(Command::new("test").no_binary_name(true));
        PictureArguments::from_arg_matches(&command.get_matches_from(words)).unwrap()
    }

    #[test]
    fn the_defaults_of_the_command_line_are_those_of_the_library() {
        assert_eq!(picture(&[]).settings(), Settings::default());
    }

    #[test]
    fn settings_that_a_report_prints_can_be_given_again() {
        let settings = Settings {
            size_px: [7, 9],
            samples: Samples(16),
            rasterizer: Rasterizer::AffineContour,
            tile_invocations: TileInvocations::Pixel,
            tile_memory: TileMemory::Most(12_500_000),
            filter: Filter::AdjustPaper,
            filter_weight: FilterWeight::Unit,
            edges: Edges::Hard,
            kernel: Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 },
            kernel_eval: KernelEval::Texture,
            cull: Cull::List,
            lod: Lod::Percent(0.25),
            lod_steps: LodSteps::Blend,
            budget: Budget::Splats(250_000),
            accumulate: Accumulate::F32,
            epsilon: Epsilon::Length(0.25),
            backfaces: Backfaces::Cull,
            layers: Layers::Fixed(7),
            last_layer: LastLayer::Drop,
            transition: Transition::Attributes,
            clip_box: ClipBox(None),
            clip_planes: ClipPlanes([[1.0, 0.0, -2.5, 0.25], [0.0, 1.0, 0.0, -3.0]].into()),
            shading: Shading::Normals,
            outlines: Outlines::Splats,
            background: None,
        };
        let others = Settings {
            backfaces: Backfaces::Flip,
            layers: Layers::Auto(16),
            clip_box: ClipBox(Some([[-1.0, -2.0, -3.5], [1.0, 2.0, 3.0]])),
            clip_planes: ClipPlanes::default(),
            shading: Shading::Albedo,
            background: Some([0.5, 0.25, 0.0]),
            ..settings.clone()
        };
        for settings in [settings, others] {
            let options = settings.as_options().into_iter();
            let words: Vec<String> = options.flat_map(|(name, value)| [format!("--{name}"), value]).collect();
            assert_eq!(picture(&words).settings(), settings);
        }
    }

    #[test]
    fn lights_are_as_many_as_are_given_and_take_the_place_of_the_scenes() {
        let words = ["--light", "direction=0,-1,-1,intensity=2", "--light", "eye"].map(str::to_owned);
        let mut scene = Scene { lights: vec![Light::DEFAULT; 3], ..Scene::default() };
        picture(&[]).light(&mut scene);
        assert_eq!(scene.lights.len(), 3);
        picture(&words).light(&mut scene);
        assert_eq!(scene.lights.iter().map(|light| light.color[0]).collect::<Vec<_>>(), [2.0, 1.0]);
    }

    #[test]
    fn negative_coordinates_are_no_options() {
        let camera = picture(&["--eye", "-1,2,-3", "--up", "-0.5,0,1"].map(str::to_owned)).camera;
        assert_eq!((camera.eye, camera.up), (Some([-1.0, 2.0, -3.0]), Some(Up::Given([-0.5, 0.0, 1.0]))));
    }
}
