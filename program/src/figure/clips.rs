//! Figures of Ivo et al. 2012: sharp edges of few splats, cut by curves, by lines, and not at all.

use glam::{DVec2, DVec3};
use surfel::{
    Error, Result,
    geometry::{creased_mesh, sharp::Clipping},
    prepare::PreparedScene,
    scene::{Camera, ClipCurve, Colors, MeshObject, Object, Samples, Scene, Settings, Shapes, Splats},
};

use super::{
    context::FigureContext,
    sheet::{Panel, Sheet},
};
use crate::part::{Part, camera_covering};

/// The paper's.
const SPLATS: u64 = 2_500;

/// Of figure 1: with fewer the curves are longer.
const FEW_SPLATS: u64 = 300;

/// How much of the image a whole model covers.
const SHARE: f64 = 0.4;

/// How much nearer than that the panels of figure 1 are.
const ZOOMS: [f64; 3] = [2.0, 8.0, 32.0];

/// How much of the image the panels of figure 10 cover.
const OCCUPANCIES: [f64; 3] = [0.031, 0.375, 0.807];

/// Of figure 11: a place of the bore's rim, and linear colors of flat and bent sides.
const BORE: DVec3 = DVec3::new(0.35, 0.35, 0.6);
const FLAT: [f32; 4] = [0.15, 0.35, 0.75, 1.0];
const BENT: [f32; 4] = [0.75, 0.35, 0.1, 1.0];

const WAYS: [(&str, Clipping); 3] =
    [("not cut", Clipping::None), ("cut by lines", Clipping::Lines), ("cut by curves", Clipping::Shared)];

/// A scene on the device.
struct Made {
    scene: Scene,
    prepared: PreparedScene,
}

fn made(context: &FigureContext<'_>, part: &Part, splats: u64, clipping: Clipping) -> Result<Made> {
    let (scene, _) = part.splats(Some(splats), clipping, context.bars)?;
    Ok(Made { prepared: context.prepare(&scene)?, scene })
}

fn settings(context: &FigureContext<'_>) -> Settings {
    Settings { size_px: context.size_px, ..Settings::default() }
}

fn note(part: &Part, splats: u64) -> String {
    format!(
        "Model: {}, {} triangles as {splats} splats or fewer; not the paper's.",
        part.name,
        part.mesh.triangles.len()
    )
}

/// Figure 1: a curved edge from three distances.
///
/// # Errors
/// As those of [`FigureContext`]; a model that is no mesh, or has no edge that a curve cuts.
pub fn i1(context: &mut FigureContext<'_>) -> Result<Sheet> {
    let part = Part::open(context.model, context.bars)?;
    let ways = WAYS.map(|(name, clipping)| Ok((name, made(context, &part, FEW_SPLATS, clipping)?)));
    let ways = ways.into_iter().collect::<Result<Vec<_>>>()?;
    let settings = settings(context);
    let curves = &ways[2].1;
    let (all, _) = camera_covering(context.headless, (&curves.scene, &curves.prepared), &settings, SHARE)?;
    let splats = &curves.scene.objects[0].splats;
    let place = most_bent(splats, all.eye).ok_or_else(|| {
        Error::input(&part.name, "", "has no edge that a curve cuts; expected a mesh with sharp edges")
    })?;
    let mut panels = Vec::new();
    for (letter, zoom) in ('a'..).zip(ZOOMS) {
        let fov_y_rad = 2.0 * ((0.5 * all.fov_y_rad).tan() / zoom).atan();
        let camera = Camera { target: place, fov_y_rad, ..all };
        for (name, made) in &ways {
            let picture = context.picture(&made.prepared, &camera, &settings)?;
            panels.push(Panel::new(format!("{letter}) {name}"), format!("{zoom}x as near"), picture));
        }
    }
    let title = "A curved edge from three distances (Ivo et al. 2012, figure 1)";
    Ok(Sheet::new(title, 3, panels, &[&note(&part, FEW_SPLATS)]))
}

/// Figure 9: a mesh, and few splats for it.
///
/// # Errors
/// As those of [`FigureContext`]; a model that is no mesh.
pub fn i9(context: &mut FigureContext<'_>) -> Result<Sheet> {
    let part = Part::open(context.model, context.bars)?;
    let settings = settings(context);
    let (mesh, report) = creased_mesh(part.mesh.clone());
    let polygons = MeshObject { name: part.name.clone(), mesh, closed: report.closed };
    let scene = Scene { meshes: vec![polygons], ..Scene::default() };
    let polygons = context.prepare(&scene)?;
    // Of the mesh, whatever splats reach.
    let (camera, _) = camera_covering(context.headless, (&scene, &polygons), &settings, SHARE)?;
    let curves = made(context, &part, SPLATS, Clipping::Shared)?;
    let lines = made(context, &part, SPLATS, Clipping::Lines)?;
    let whole = made(context, &part, SPLATS, Clipping::None)?;
    let count = |made: &Made| format!("{} splats", made.scene.splat_count());
    let triangles = format!("{} triangles", part.mesh.triangles.len());
    // Polygons have no stairs in it, as `render` draws them: splats cover pixels in part, too.
    let smooth = Settings { samples: Samples(8), ..settings.clone() };
    let mesh = Panel::new("a) the mesh", triangles, context.picture(&polygons, &camera, &smooth)?);
    let mut panel = |name: &str, caption: String, scene: &PreparedScene| -> Result<Panel> {
        Ok(Panel::new(name, caption, context.picture(scene, &camera, &settings)?))
    };
    let panels = vec![
        mesh,
        panel("b) splats, not cut", count(&whole), &whole.prepared)?,
        panel("c) cut by lines", count(&lines), &lines.prepared)?,
        panel("d) cut by curves", count(&curves), &curves.prepared)?,
    ];
    let title = "A mesh, and few splats for it (Ivo et al. 2012, figure 9)";
    Ok(Sheet::new(title, 2, panels, &[&note(&part, SPLATS)]))
}

/// Figure 10: few splats, covering little and much of the image.
///
/// # Errors
/// As those of [`FigureContext`]; a model that is no mesh.
pub fn i10(context: &mut FigureContext<'_>) -> Result<Sheet> {
    let part = Part::open(context.model, context.bars)?;
    let settings = settings(context);
    let curves = made(context, &part, SPLATS, Clipping::Shared)?;
    let mut panels = Vec::new();
    for (letter, share) in ('a'..).zip(OCCUPANCIES) {
        let of = (&curves.scene, &curves.prepared);
        let (camera, covers) = camera_covering(context.headless, of, &settings, share)?;
        let picture = context.picture(&curves.prepared, &camera, &settings)?;
        panels.push(Panel::new(
            format!("{letter})"),
            format!("{:.1}% of the image", 100.0 * covers),
            picture,
        ));
    }
    let title = "Few splats from three distances (Ivo et al. 2012, figure 10)";
    Ok(Sheet::new(title, 3, panels, &[&note(&part, SPLATS)]))
}

/// Figure 11: what clip curves do not repair, since splats are flat.
///
/// # Errors
/// As those of [`FigureContext`].
pub fn i11(context: &mut FigureContext<'_>) -> Result<Sheet> {
    let part = Part::open(None, context.bars)?;
    let settings = settings(context);
    let both = made(context, &part, FEW_SPLATS, Clipping::Shared)?;
    let splats = &both.scene.objects[0].splats;
    // The built-in part has flat sides across z around its bore.
    let Shapes::Ellipses { s, t } = &splats.shapes else {
        return Err(Error::input(&part.name, "", "has no splat"));
    };
    let is_flat: Vec<bool> = s.iter().zip(t).map(|(s, t)| s.cross(*t).normalize().z > 0.99).collect();
    let colors = is_flat.iter().map(|flat| if *flat { FLAT } else { BENT }).collect();
    let colored = Splats { colors: Colors::Each(colors), ..splats.clone() };
    let mut flat = colored.clone();
    flat.keep(&is_flat);
    let scene_of = |splats: Splats, closed: bool| Scene {
        objects: vec![Object { name: part.name.clone(), splats, closed }],
        ..Scene::default()
    };
    let camera = camera_covering(context.headless, (&both.scene, &both.prepared), &settings, SHARE)?.0;
    let eye = BORE + 6.0 * DVec3::new(0.25, -0.35, 1.0).normalize();
    let camera = Camera { eye, target: BORE, up: DVec3::Y, fov_y_rad: 0.1, ..camera };
    let (mesh, report) = creased_mesh(part.mesh.clone());
    let polygons = MeshObject { name: part.name.clone(), mesh, closed: report.closed };
    let polygons = context.prepare(&Scene { meshes: vec![polygons], ..Scene::default() })?;
    let flat = context.prepare(&scene_of(flat, false))?;
    let colored = context.prepare(&scene_of(colored, true))?;
    let panels = vec![
        Panel::new(
            "a) the mesh",
            "a flat side meets a bore",
            context.picture(&polygons, &camera, &settings)?,
        ),
        Panel::new(
            "b) splats of the flat side",
            "the edge is smooth",
            context.picture(&flat, &camera, &settings)?,
        ),
        Panel::new(
            "c) of both sides",
            "the bore's are flat between its corners",
            context.picture(&colored, &camera, &settings)?,
        ),
    ];
    let title = "Where a flat and a bent side meet (Ivo et al. 2012, figure 11)";
    let note = "Splats of the bent side are planes through its chords: between them and the arc of the flat side slivers are left or overlap.";
    Ok(Sheet::new(title, 3, panels, &[&self::note(&part, FEW_SPLATS), note]))
}

/// The middle of the curve that is farthest from its chord as it is seen from a place, of splats that face it.
fn most_bent(splats: &Splats, eye: DVec3) -> Option<DVec3> {
    let Shapes::Ellipses { s, t } = &splats.shapes else { return None };
    let mut best: Option<(f64, DVec3)> = None;
    for i in 0..splats.len() {
        let (position, s, t) = (splats.positions[i], s[i].as_dvec3(), t[i].as_dvec3());
        let facing = s.cross(t).normalize().dot((eye - position).normalize());
        for curve in splats.clips.get(i).curves().into_iter().flatten() {
            let [middle, start, end] = places(curve).map(|at| position + at.x * s + at.y * t);
            // Along its chord a curve may lie anywhere, and be straight.
            let bent = facing * (middle - start).cross((end - start).normalize_or_zero()).length();
            if bent > best.map_or(0.0, |best| best.0) {
                best = Some((bent, middle));
            }
        }
    }
    best.map(|best| best.1)
}

/// The middle of a curve, and its ends.
fn places(curve: &ClipCurve) -> [DVec2; 3] {
    let [start, end] = [curve.start_rad, curve.end_rad].map(|rad| DVec2::from_angle(rad.into()));
    let (chord, weight) = (0.5 * (start + end), f64::from(curve.weight));
    [(chord + weight * curve.middle.as_dvec2()) / (1.0 + weight), start, end]
}
