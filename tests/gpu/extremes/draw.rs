//! Draws a scene by its methods, each beside the truth.

use glam::Vec3;
use surfel::{
    prepare::PreparedScene,
    renderer::{Frame, Headless},
    scene::{Accumulate, Settings, Shading},
};

use super::{
    errors::{Errors, Seen},
    loaded,
    method::Method,
    rows::{Case, Row},
    truth::Truths,
};
use crate::common::passes;

/// A method's errors in a scene.
pub struct Drawn {
    pub method: Method,
    pub errors: Errors,
    /// What is beyond the bounds of its row.
    pub beyond: String,
    /// Tiles were shaded in the dispatch that sums them.
    pub at_once: bool,
}

impl Drawn {
    /// The method's name, with what the device made of it.
    pub fn name(&self) -> &'static str {
        match (self.method, self.at_once) {
            (Method::Shaded, true) => "compute, shaded at once",
            (Method::Picture, true) => "compute, shaded at once, sRGB",
            (method, _) => method.name(),
        }
    }
}

/// Draws the scene of a row by some of the methods that its settings allow.
pub fn draw(
    headless: &mut Headless,
    row: &Row,
    case: &Case,
    choose: impl FnOnce(Vec<Method>) -> Vec<Method>,
) -> Vec<Drawn> {
    let read = row.loaded.then(|| loaded::written_and_read(case));
    let drawn_case = read.as_ref().unwrap_or(case);
    let hard = &drawn_case.hard;
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    let mut truths = Truths::of(drawn_case);
    let mut originals = row.loaded.then(|| Truths::of(case));
    let mut drawn = Vec::new();
    for method in choose(Method::all(&hard.settings)) {
        let (seen, at_once) = see(headless, &prepared, drawn_case, method);
        let mut errors = Errors::of(&seen, truths.get(method.rasterizer()), hard.settings.kernel);
        let mut beyond = errors.words_beyond(&row.limit);
        if let Some(originals) = &mut originals {
            let written = loaded::against_original(&seen, case, originals.get(method.rasterizer()), method);
            let words = written.words_beyond(&loaded::of_original(&row.limit));
            if !words.is_empty() {
                beyond += &format!(" of the original: {words}");
            }
        }
        errors.beyond = usize::from(!beyond.is_empty());
        drawn.push(Drawn { method, errors, beyond, at_once });
    }
    drawn
}

/// Tiles that are shaded at once.
const AT_ONCE: &str = "see, sum and shade tiles";

/// What a method shows, and whether by tiles that are shaded at once.
fn see(headless: &mut Headless, prepared: &PreparedScene, case: &Case, method: Method) -> (Seen, bool) {
    let settings = method.of(&case.hard.settings);
    let mut frame = |shading, accumulate| -> Frame {
        let settings = Settings { shading, accumulate, ..settings.clone() };
        headless.render(prepared, &case.hard.camera, &settings, method.wanted()).unwrap()
    };
    let mut albedo = frame(Shading::Albedo, settings.accumulate);
    let at_once = passes(&albedo).contains(&AT_ONCE);
    if settings.accumulate == Accumulate::F16 && !at_once {
        // Sums of large splats lie in images, and those of 16 bits have bounds of their own (`f16.rs`).
        albedo = frame(Shading::Albedo, Accumulate::F32);
    }
    let seen = match method {
        Method::Surface(_) => Seen {
            covered: albedo.weight.iter().map(|weight| *weight > 0.0).collect(),
            albedo: vectors(&albedo.albedo),
            normal: vectors(&albedo.normal),
            weight: albedo.weight,
            depth: albedo.depth,
            srgb: Vec::new(),
        },
        Method::Shaded => {
            let normals = frame(Shading::Normals, settings.accumulate);
            // `(n.x, −n.y, −n.z)/2 + ½`.
            let normal = |color: Vec3| (2.0 * color - 1.0) * Vec3::new(1.0, -1.0, -1.0);
            Seen {
                covered: albedo.linear.iter().map(|color| color[3] > 0.0).collect(),
                albedo: vectors(&albedo.linear),
                normal: vectors(&normals.linear).into_iter().map(normal).collect(),
                ..Seen::default()
            }
        }
        Method::Picture => Seen {
            covered: albedo.srgb.iter().map(|color| color[3] > 0).collect(),
            srgb: albedo.srgb,
            ..Seen::default()
        },
    };
    (seen, at_once)
}

fn vectors(values: &[[f32; 4]]) -> Vec<Vec3> {
    values.iter().map(|value| Vec3::from_slice(&value[..3])).collect()
}
