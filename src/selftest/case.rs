//! Which cases there are, and what they are called.
//!
//! This file, `check` and `layers` name each other: a case holds its check, a check draws in its case's suite, and layers are cases with
//! checks of their own.

use super::{check::Check, layers};
use crate::{
    hard_scenes::{self, Hard, transparent},
    scene::{
        Accumulate, Filter, FilterWeight, Kernel, KernelEval, Rasterizer, Settings, TileInvocations,
        with_each,
    },
};

/// Width and height of every picture. A quarter of the pixels of the tests' pictures: there are many methods.
pub const SIZE_PX: [u32; 2] = [128, 128];

/// One thing that is checked.
#[derive(Clone, Debug)]
pub struct Case {
    /// A path, such as `methods.perspective.adjust.edge-on-disks`: it stays the same from version to version.
    pub name: String,
    /// Whether the quick form has it.
    pub quick: bool,
    /// Its drawing; `None` where it draws nothing.
    pub(super) drawing: Option<Drawing>,
}

/// The drawing of a case, and what it has to be like.
#[derive(Clone, Debug)]
pub(super) struct Drawing {
    /// The scene, by its index in the suite.
    pub scene: usize,
    /// The method.
    pub settings: Settings,
    /// The check.
    pub check: Check,
}

/// The names of the cases that draw nothing.
pub(super) const OPEN: &str = "device.open";
pub(super) const CLOSE: &str = "device.close";

/// All cases, with what they draw.
pub struct Suite {
    /// The scenes, by index.
    pub(super) scenes: Vec<Hard>,
    /// The cases: group after group.
    pub cases: Vec<Case>,
}

impl Case {
    /// The group: the first part of the name.
    pub fn group(&self) -> &str {
        group_of(&self.name)
    }

    /// Whether it is run whatever is asked for: what the validation layer says outside of all other cases is its.
    pub fn is_always_run(&self) -> bool {
        self.drawing.is_none()
    }
}

/// The first part of a case's name.
pub(super) fn group_of(name: &str) -> &str {
    name.split('.').next().unwrap_or(name)
}

impl Suite {
    /// Every case there is.
    pub fn new() -> Self {
        let mut scenes = hard_scenes::all();
        let mut cases = vec![Case { name: OPEN.to_owned(), quick: true, drawing: None }];
        for method in methods() {
            for (index, hard) in scenes.iter().enumerate() {
                cases.extend(against_oracle(index, hard, &method));
            }
        }
        for (_, rasterizer) in Rasterizer::METHODS {
            for (index, hard) in scenes.iter().enumerate() {
                cases.extend(of_scene(index, hard, "repeat", Check::Repeat, *rasterizer));
            }
        }
        cases.extend(scenes.iter().enumerate().filter_map(|(index, hard)| by_pixels(index, hard)));
        let in_layers = transparent::all();
        cases.extend(layers::cases(scenes.len(), &in_layers));
        scenes.extend(in_layers);
        cases.push(Case { name: CLOSE.to_owned(), quick: true, drawing: None });
        Self { scenes, cases }
    }
}

impl Default for Suite {
    fn default() -> Self {
        Self::new()
    }
}

/// The kernel that is none of the default's kind: with a power, and steep at its end.
const PSI_E: Kernel = Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 };

/// Every combination of what is varied of a method, group after group; the plain one with exact sums first.
fn methods() -> Vec<Settings> {
    let weighted = [
        (Kernel::default(), FilterWeight::Area),
        (Kernel::default(), FilterWeight::Unit),
        (PSI_E, FilterWeight::Area),
    ];
    let every = vec![Settings { size_px: SIZE_PX, ..Settings::default() }];
    let every = with_each(every, &[Accumulate::F32, Accumulate::F16], |own, value| own.accumulate = value);
    let every = with_each(every, KernelEval::NAMES, |own, (_, value)| own.kernel_eval = value);
    let every = with_each(every, &weighted, |own, value| (own.kernel, own.filter_weight) = value);
    let every = with_each(every, Rasterizer::METHODS, |own, (_, value)| own.rasterizer = value);
    let mut every = with_each(every, Filter::NAMES, |own, (_, value)| own.filter = value);
    // Only tangent adjustment leaves a splat a weight to choose.
    every.retain(|own| own.filter_weight == FilterWeight::default() || own.filter.adjusts());
    every
}

/// The group of a method's cases.
fn group(method: &Settings) -> String {
    let parts = [
        (method.kernel == PSI_E).then_some("psi-e"),
        (method.filter_weight == FilterWeight::Unit).then_some("unit-weight"),
        (method.kernel_eval == KernelEval::Texture).then_some("kernel-texture"),
        (method.accumulate == Accumulate::F16).then_some("sums-16"),
    ];
    let parts: Vec<&str> = parts.into_iter().flatten().collect();
    if parts.is_empty() { "methods".to_owned() } else { parts.join("-") }
}

/// `None` where the method can't draw the scene, or the scene is not hard with it.
fn against_oracle(index: usize, hard: &Hard, method: &Settings) -> Option<Case> {
    let Settings { size_px, rasterizer, filter, filter_weight, kernel, kernel_eval, accumulate, .. } =
        *method;
    let settings = Settings {
        size_px,
        rasterizer,
        filter,
        filter_weight,
        kernel,
        kernel_eval,
        accumulate,
        ..hard.settings.clone()
    };
    let own_filter = method.filter == hard.settings.filter;
    let hard_without_filter = hard.settings.filter == Filter::None;
    // The steep kernel magnifies what thin splats err by: its scenes are those whose splats are thick. From a texture it has
    // no bound where all weights of a pixel are far below the steps between texels; on the sphere they nowhere are.
    let is_hard = match method.kernel {
        PSI_E if method.kernel_eval == KernelEval::Texture => index == 0,
        PSI_E => own_filter && WITH_PSI_E.contains(&hard.name),
        _ => !(hard_without_filter && method.filter.adjusts()),
    };
    let group = group(method);
    let name = [group.as_str(), method.rasterizer.name(), method.filter.name(), &slug(hard.name)].join(".");
    // Every method and every option once, the defaults everywhere; every filter where splats are long, and where they are small.
    let by_default = method.rasterizer == Rasterizer::Perspective;
    let quick = match group.as_str() {
        "methods" => index == 0 || own_filter || by_default && WITH_EVERY_FILTER.contains(&hard.name),
        "sums-16" if own_filter && by_default => true,
        _ => index == 0 && method.filter == Filter::default(),
    };
    let allowed = is_hard && can_draw(hard, &settings);
    let drawing = Some(Drawing { scene: index, settings, check: Check::Oracle });
    allowed.then_some(Case { name, quick, drawing })
}

/// Scenes that the quick form has with every filter, as the first one.
const WITH_EVERY_FILTER: [&str; 2] = ["random ellipses of aspect up to 20", "subpixel disks"];

/// The scenes of the groups `psi-e`.
const WITH_PSI_E: [&str; 3] =
    ["sphere of disks", "random ellipses of aspect up to 20", "ground under and behind the eye"];

/// With the scene's own filter.
fn of_scene(index: usize, hard: &Hard, group: &str, check: Check, rasterizer: Rasterizer) -> Option<Case> {
    let settings = Settings { size_px: SIZE_PX, rasterizer, ..hard.settings.clone() };
    let name = [group, rasterizer.name(), settings.filter.name(), &slug(hard.name)].join(".");
    let allowed = can_draw(hard, &settings);
    let drawing = Some(Drawing { scene: index, settings, check });
    allowed.then_some(Case { name, quick: index == 0, drawing })
}

/// Drawn by tiles, an invocation a pixel, then a column.
fn by_pixels(index: usize, hard: &Hard) -> Option<Case> {
    let tile_invocations = TileInvocations::Pixel;
    let hard = Hard { settings: Settings { tile_invocations, ..hard.settings.clone() }, ..hard.clone() };
    let case = of_scene(index, &hard, "tile-invocations", Check::TileInvocations, Rasterizer::Compute)?;
    // What is cut has lists of its own.
    Some(Case { quick: case.quick || !hard.scene.objects.iter().all(|o| o.splats.clips.is_empty()), ..case })
}

/// Whether the method can draw the scene.
pub(super) fn can_draw(hard: &Hard, settings: &Settings) -> bool {
    let of_camera = settings.check_camera(&hard.camera);
    settings.validate().is_ok() && of_camera.is_ok() && settings.check_scene(&hard.scene).is_ok()
}

/// A scene's name as a part of a case's.
pub(super) fn slug(name: &str) -> String {
    let words = name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_ascii_lowercase).collect::<Vec<_>>().join("-")
}
