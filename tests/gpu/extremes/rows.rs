//! The rows: families of scenes, and how far each may be from the oracle.

use surfel::{
    hard_scenes::Hard,
    scene::{Scene, Settings},
};

use super::{
    edge_on,
    errors::{Errors, F32},
    extent, field,
    looking::Draws as _,
    method, near, ordinary,
    posed::keep_posed,
    put::Made,
    sheets, sizes, skew,
};
use crate::common::builder::Random;

/// A family of scenes.
pub struct Row {
    /// What is extreme about it: rows of one theme are one test.
    pub theme: &'static str,
    pub name: &'static str,
    make: Box<dyn Fn(&mut Random) -> Made>,
    pub limit: Errors,
    /// The scenes go through a file.
    pub loaded: bool,
}

/// A scene of a row. Its settings have no method yet.
#[derive(Clone)]
pub struct Case {
    pub hard: Hard,
    /// How far depths may be off, relative, before an ε-threshold is a tie.
    pub depth_steps: f64,
}

impl Row {
    fn new(theme: &'static str, name: &'static str, make: impl Fn(&mut Random) -> Made + 'static) -> Self {
        // A coordinate that f32 holds in one part is off by 2^-13 of its splat's smaller half axis at most (`src/prepare/sites.rs`): in space by
        // the root of 3 as much, in the image of a splat that is tilted by 80 degrees by six times that; d ln w / d ln r is 4 at the rim.
        let weight = 4.0 * 6.0 * 3.0_f64.sqrt() * 0.5_f64.powi(13);
        let is_extended = matches!(theme, "extent" | "telephoto" | "file");
        let limit = if is_extended { Errors { weight: F32.weight + weight, ..F32 } } else { F32 };
        Self { theme, name, make: Box::new(make), limit, loaded: false }
    }

    /// The scene with this number. `plain`: with few different settings, which need few pipelines.
    pub fn case(&self, number: u64, plain: bool) -> Case {
        // A sequence of its own for each row, wherever it stands among the others.
        let row = self
            .name
            .bytes()
            .fold(0_u64, |hash, byte| hash.wrapping_mul(1_099_511_628_211) ^ u64::from(byte));
        let mut random = Random(row.wrapping_add(number << 1));
        let mut made = (self.make)(&mut random);
        let settings: Settings = method::settings(&mut random, &made, plain);
        keep_posed(&mut made.object, &made.camera, settings.filter, made.exact_planes);
        let scene = Scene { objects: vec![made.object], ..Scene::default() };
        Case {
            hard: Hard { name: self.name, scene, camera: made.camera, settings },
            depth_steps: made.depth_steps,
        }
    }
}

/// Every row.
pub fn all() -> Vec<Row> {
    let loaded = |random: &mut Random| {
        let makers: [fn(&mut Random) -> Made; 7] = [
            ordinary::any,
            |random| extent::wide(random, 1e4),
            extent::far_scan,
            sizes::units,
            |random| sizes::mixed(random, 1e6),
            |random| skew::needles(random, 1e-3, 1.0),
            |random| field::telephoto(random, 1.0, 10.0),
        ];
        makers[(random.unit() * makers.len() as f64) as usize](random)
    };
    vec![
        Row::new("ordinary", "ordinary", ordinary::any),
        Row::new("extent", "1 cm in 1 m to 100 m", |random| {
            let side = random.log(1.0, 100.0);
            extent::wide(random, side)
        }),
        Row::new("extent", "1 cm in 1 km", |random| extent::wide(random, 1e3)),
        Row::new("extent", "1 cm in 10 km", |random| extent::wide(random, 1e4)),
        Row::new("extent", "1 cm in 100 km", |random| extent::wide(random, 1e5)),
        Row::new("extent", "sites 1 km apart", |random| extent::sites(random, 1e3, 12)),
        Row::new("extent", "sites 10 km apart", |random| extent::sites(random, 1e4, 12)),
        Row::new("extent", "sites 100 km apart", |random| extent::sites(random, 1e5, 12)),
        Row::new("extent", "sites of many splats, 1 to 100 km apart", |random| {
            let apart = random.log(1e3, 1e5);
            extent::sites(random, apart, 700)
        }),
        Row::new("extent", "millimetres far from the origin", extent::far_scan),
        Row::new("sizes", "units from 1e-12 to 1e12", sizes::units),
        Row::new("sizes", "radii from 1e-4 to 1e4 in one object", |random| sizes::mixed(random, 1e4)),
        Row::new("sizes", "radii from 1e-12 to 1e12 in one object", |random| sizes::mixed(random, 1e12)),
        Row::new("telephoto", "telephoto, 10 to 1 degrees", |random| field::telephoto(random, 1.0, 10.0)),
        Row::new("telephoto", "telephoto, 1 to 0.1 degrees", |random| field::telephoto(random, 0.1, 1.0)),
        Row::new("telephoto", "telephoto, 0.1 to 0.01 degrees", |random| field::telephoto(random, 0.01, 0.1)),
        Row::new("telephoto", "telephoto, 0.01 to 0.001 degrees", |random| {
            field::telephoto(random, 0.001, 0.01)
        }),
        Row::new("ordinary", "120 to 179.99 degrees", field::wide),
        Row::new("skew", "needles, sine 1 to 1e-3", |random| skew::needles(random, 1e-3, 1.0)),
        Row::new("skew", "needles, sine 1e-3 to 1e-7", |random| skew::needles(random, 1e-7, 1e-3)),
        Row::new("skew", "needles among back faces", skew::needles_among_back_faces),
        Row::new("skew", "strips, sine 1 to 1e-3", |random| skew::strips(random, 1e-3, 1.0)),
        Row::new("skew", "strips, sine 1e-3 to 1e-7", |random| skew::strips(random, 1e-7, 1e-3)),
        Row::new("eye plane", "eye plane beside centers, 1 to 1e-4 r", |random| {
            near::eye_plane(random, &[1.0, 0.1, 1e-2, 1e-3, 1e-4, -1e-4, -1e-2, -0.3])
        }),
        Row::new("eye plane", "eye plane through centers, 1e-7 r to 0", |random| {
            near::eye_plane(random, &[1e-7, 1e-9, 0.0, -1e-9, -1e-7])
        }),
        Row::new("eye plane", "near plane cuts", near::near_plane),
        Row::new("ground", "ground, the eye 1e-2 to 1e-5 above", |random| {
            edge_on::ground(random, 1e-5, 1e-2)
        }),
        // Near the horizon (u, v) are sums of terms of which they are a hundred-thousandth; rays, which are told of the plane alone, lose
        // nothing there.
        Row {
            limit: Errors { weight: 2e-2, depth: 1e-3, ..F32 },
            ..Row::new("ground", "ground, the eye 1e-5 to 1e-9 above", |random| {
                edge_on::ground(random, 1e-9, 1e-5)
            })
        },
        Row::new("sheets", "far sheets, 1e-3 to 1e-6 apart", |random| sheets::far(random, 1e-6, 1e-3)),
        Row::new("sheets", "far sheets, 1e-6 to 4e-7 apart", |random| sheets::far(random, 4e-7, 1e-6)),
        Row { loaded: true, ..Row::new("file", "through a file", loaded) },
    ]
}
