//! Draws a case and says what is wrong with it.

use std::{collections::BTreeMap, rc::Rc};

use super::{
    agreement,
    case::{Drawing, Suite},
    half, light, tolerance,
};
use crate::{
    error::Result,
    hard_scenes::Hard,
    math::srgb::linear_from_srgb,
    prepare::PreparedScene,
    reference::{self, Picture},
    renderer::{Frame, Headless, Wanted},
    scene::{Accumulate, FilterWeight, Floors, KernelEval, Layers, Rasterizer, Settings, TileInvocations},
};

/// The check of a drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Check {
    /// It agrees with the oracle.
    Oracle,
    /// Its picture, with all its layers, agrees with the oracle's.
    Light,
    /// As many layers as there are give the same bits as a fixed number of them.
    AutoLayers,
    /// Uploaded and drawn again it is the same.
    Repeat,
    /// Tiles drawn an invocation a column give the bits of those drawn an invocation a pixel.
    TileInvocations,
}

/// The result of one try.
#[derive(Clone, Debug, Default)]
pub(super) struct Found {
    /// The problems in words; empty where there are none.
    pub problems: Vec<String>,
    /// The figures by their names.
    pub figures: BTreeMap<&'static str, f64>,
}

/// Everything of Vulkan, and what cases of one scene share.
pub(super) struct Stage<'a> {
    pub headless: Headless,
    suite: &'a Suite,
    /// The scene of this index, uploaded.
    prepared: Option<(usize, PreparedScene)>,
    /// The exact pictures of the scene of this index, by their settings.
    oracles: (usize, Vec<(Settings, Rc<Picture>)>),
}

/// The surface as data and the shaded picture in linear light.
const ALL: Wanted = Wanted { picture: true, linear: true, surface: true, profile: None };

/// The picture alone, which tiles shade themselves.
const PICTURE: Wanted = Wanted { surface: false, ..ALL };

impl<'a> Stage<'a> {
    pub fn new(headless: Headless, suite: &'a Suite) -> Self {
        Self { headless, suite, prepared: None, oracles: (0, Vec::new()) }
    }

    /// Draws a case and checks it.
    ///
    /// # Errors
    /// Whatever device and oracle answer.
    pub fn check(&mut self, drawing: &Drawing) -> Result<Found> {
        let Drawing { scene, settings, check } = drawing;
        let frame = self.draw(*scene, settings)?;
        let mut different_values: fn(&Frame, &Frame) -> usize = agreement::different_values;
        let other = match check {
            Check::Oracle | Check::Light => {
                let linear = match settings.rasterizer {
                    Rasterizer::Compute => self.draw_as(*scene, settings, PICTURE)?.linear,
                    _ => frame.linear,
                };
                return self.against_oracle(drawing, &Frame { linear, ..frame });
            }
            Check::AutoLayers => {
                let layers = Layers::Fixed(settings.layers.most());
                self.draw(*scene, &Settings { layers, ..settings.clone() })?
            }
            Check::TileInvocations => {
                let mut by =
                    |tile_invocations| self.draw(*scene, &Settings { tile_invocations, ..settings.clone() });
                let columns = by(TileInvocations::Column)?;
                match agreement::different_values(&frame, &columns) {
                    0 => {
                        let short = by(TileInvocations::ShortColumn)?;
                        // A tile adds what clip curves cut there after what they leave whole: in a short one that may be less.
                        if self.suite.scenes[*scene].scene.objects.iter().any(|o| !o.splats.clips.is_empty())
                        {
                            different_values = agreement::values_of_other_terms;
                        }
                        short
                    }
                    _ => columns,
                }
            }
            Check::Repeat => {
                self.prepared = None;
                self.draw(*scene, settings)?
            }
        };
        let (different, covered) = (different_values(&frame, &other), seen_px(&frame, settings));
        let mut problems = Vec::new();
        if different > 0 {
            problems.push(format!("{different} values differ"));
        }
        if covered == 0 {
            problems.push("nothing was drawn".to_owned());
        }
        let figures =
            BTreeMap::from([("different_values", different as f64), ("covered_px", covered as f64)]);
        Ok(Found { problems, figures })
    }

    fn draw(&mut self, scene: usize, settings: &Settings) -> Result<Frame> {
        self.draw_as(scene, settings, ALL)
    }

    /// Draws a scene, which is uploaded unless it is there.
    fn draw_as(&mut self, scene: usize, settings: &Settings, wanted: Wanted) -> Result<Frame> {
        let hard = &self.suite.scenes[scene];
        let prepared = match self.prepared.take() {
            Some((there, prepared)) if there == scene => prepared,
            _ => self.headless.prepare(&hard.scene, &|_, _| {})?,
        };
        let frame = self.headless.render(&prepared, &hard.camera, settings, wanted);
        self.prepared = Some((scene, prepared));
        frame
    }

    fn against_oracle(&mut self, drawing: &Drawing, frame: &Frame) -> Result<Found> {
        let hard = Hard { settings: drawing.settings.clone(), ..self.suite.scenes[drawing.scene].clone() };
        let oracle = self.oracle(drawing.scene, &hard)?;
        if drawing.check == Check::Light {
            let errors = light::compare_light(frame, &oracle);
            return Ok(Found {
                problems: errors.beyond(&tolerance::of_light(&hard)),
                figures: errors.figures(),
            });
        }
        let limit = tolerance::of(&hard);
        Ok(match hard.settings.accumulate {
            Accumulate::F32 | Accumulate::Auto => {
                let errors = agreement::compare(frame, &oracle);
                Found { problems: errors.beyond(&limit), figures: errors.figures() }
            }
            Accumulate::F16 => {
                let errors = half::compare(frame, &oracle, &limit);
                Found { problems: errors.beyond(limit.compared), figures: errors.figures() }
            }
        })
    }

    /// The exact picture; cases that differ only in what it does not depend on share it.
    fn oracle(&mut self, scene: usize, hard: &Hard) -> Result<Rc<Picture>> {
        let key = of_oracle(&hard.settings);
        if self.oracles.0 != scene {
            self.oracles = (scene, Vec::new());
        }
        let oracles = &mut self.oracles.1;
        if let Some((_, oracle)) = oracles.iter().find(|(settings, _)| *settings == key) {
            return Ok(Rc::clone(oracle));
        }
        let oracle = Rc::new(reference::render(&hard.scene, &hard.camera, &key, &|_, _| {})?);
        oracles.push((key, Rc::clone(&oracle)));
        Ok(oracle)
    }
}

/// The settings with all that the oracle's picture does not depend on as it is by default.
pub fn of_oracle(settings: &Settings) -> Settings {
    let mut key = Settings {
        // Edges cover in part by tiles alone.
        rasterizer: match settings.covers_in_part() {
            true => settings.rasterizer,
            false => settings.rasterizer.family(),
        },
        // The sums are f64; what a splat weighs at least is as it is on the device.
        accumulate: match settings.floors() == Floors::HALF {
            true => Accumulate::F16,
            false => Accumulate::F32,
        },
        kernel_eval: KernelEval::default(),
        tile_invocations: TileInvocations::default(),
        ..settings.clone()
    };
    if !key.filter.adjusts() {
        key.filter_weight = FilterWeight::default();
    }
    key
}

/// Pixels that are not background: covered by opaque splats, or of another color.
fn seen_px(frame: &Frame, settings: &Settings) -> usize {
    let background = settings.background.map(|srgb| srgb.map(linear_from_srgb)).unwrap_or_default();
    let is_seen = |(weight, color): (&f32, &[f32; 4])| {
        let differs = color.iter().zip(&background).any(|(a, b)| (a - b).abs() > 1.0 / 1024.0);
        *weight > 0.0 || differs
    };
    frame.weight.iter().zip(&frame.linear).filter(|pixel| is_seen(*pixel)).count()
}
