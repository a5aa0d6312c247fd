//! Figures of Ivo et al. 2012 that explain: single splats seen from above, and what is cut off them.

use glam::{DVec2, DVec3, Vec2};
use surfel::{
    Result,
    geometry::sharp::{Clipping, SharpOptions, sharp_splats},
    scene::{
        Camera, Clip, ClipCurve, Clips, Colors, Mesh, MeshObject, Object, Scene, Settings, Shading, Shapes,
        Splats, Window,
    },
};

use super::{
    context::FigureContext,
    raster::Raster,
    sheet::{Panel, Sheet},
};

/// The weights of the middle control point in figure 3.
const WEIGHTS: [f32; 6] = [0.0, 0.2, 0.5, 1.0, 2.0, 8.0];

/// Linear: what is drawn of splats, control points, and triangles.
const SPLAT: [f32; 4] = [0.15, 0.35, 0.75, 1.0];
const POINT: [f32; 4] = [0.6, 0.02, 0.02, 1.0];
const TRIANGLE: [f32; 4] = [0.02, 0.02, 0.02, 1.0];

/// Of figure 7: the circle around the centroid, the circumcircle and the ellipse, in the paper's colors.
const AROUND: [(&str, [f32; 4]); 3] = [
    ("circle around the centroid", [0.2, 0.6, 0.2, 1.0]),
    ("circumcircle", [0.75, 0.15, 0.1, 1.0]),
    ("ellipse", SPLAT),
];

/// Triangles of figure 7: what they are, and the third corner over the side from (0, 0) to (1, 0).
const CORNERS: [(&str, DVec2); 2] =
    [("an ordinary triangle", DVec2::new(0.6, 0.7)), ("a narrow one", DVec2::new(0.7, 0.16))];

/// The radius of a control point's dot.
const DOT: f64 = 0.045;

/// Of an ellipse, or of a circle.
type Axes = (DVec3, DVec3);

fn circle(radius: f64) -> Axes {
    (radius * DVec3::X, radius * DVec3::Y)
}

/// Splats side by side in planes z = const, none of which is blended with another.
fn object(splats: Vec<(DVec3, Axes, [f32; 4], Clip)>) -> Object {
    let axis = |of: fn(&Axes) -> DVec3| splats.iter().map(|splat| of(&splat.1).as_vec3()).collect();
    let splats = Splats {
        positions: splats.iter().map(|splat| splat.0).collect(),
        shapes: Shapes::Ellipses { s: axis(|axes| axes.0), t: axis(|axes| axes.1) },
        colors: Colors::Each(splats.iter().map(|splat| splat.2).collect()),
        clips: Clips::of(splats.iter().map(|splat| splat.3).collect()),
    };
    Object { name: "splats".to_owned(), splats, closed: false }
}

/// The scene from above, by parallel rays.
fn from_above(
    context: &mut FigureContext<'_>,
    scene: &Scene,
    (middle, height): (DVec2, f64),
) -> Result<Raster> {
    let settings = Settings { size_px: context.size_px, shading: Shading::Albedo, ..Settings::default() };
    let camera = Camera {
        eye: middle.extend(5.0),
        target: middle.extend(0.0),
        up: DVec3::Y,
        fov_y_rad: Camera::DEFAULT_FOV_Y_RAD,
        orthographic_height: Some(height),
        near: None,
        window: Window::default(),
    };
    let prepared = context.prepare(scene)?;
    context.picture(&prepared, &camera, &settings)
}

/// A disk that a curve cuts, with the curve's control points.
fn cut_disk(context: &mut FigureContext<'_>, curve: ClipCurve) -> Result<Raster> {
    let ends = [curve.start_rad, curve.end_rad].map(|rad| DVec2::from_angle(rad.into()));
    let dots = ends.into_iter().chain([curve.middle.as_dvec2()]);
    let mut splats = vec![(DVec3::ZERO, circle(1.0), SPLAT, Clip::One(curve))];
    splats.extend(dots.map(|at| (at.extend(1.0), circle(DOT), POINT, Clip::None)));
    let scene = Scene::from(object(splats));
    from_above(context, &scene, (DVec2::ZERO, 2.5))
}

/// From lower left to lower right, over a control point above the middle.
fn curve(weight: f32) -> ClipCurve {
    ClipCurve { start_rad: 3.6, end_rad: 5.8, middle: Vec2::new(0.1, 0.75), weight }
}

/// Figure 3: curves of several weights.
///
/// # Errors
/// As those of [`FigureContext`].
pub fn i3(context: &mut FigureContext<'_>) -> Result<Sheet> {
    let mut panels = Vec::new();
    for (letter, weight) in ('a'..).zip(WEIGHTS) {
        let kind = match weight {
            0.0 => "the chord",
            w if w < 1.0 => "an ellipse",
            1.0 => "a parabola",
            _ => "a hyperbola",
        };
        panels.push(Panel::new(format!("{letter}) w = {weight}"), kind, cut_disk(context, curve(weight))?));
    }
    let title = "The weight of the middle control point (Ivo et al. 2012, figure 3)";
    let note = "One splat, cut by a rational Bezier curve of three control points, which are the dots; the weights of the outer ones are 1.";
    Ok(Sheet::new(title, 3, panels, &[note]))
}

/// Figure 5: the two sides of a curve.
///
/// # Errors
/// As those of [`FigureContext`].
pub fn i5(context: &mut FigureContext<'_>) -> Result<Sheet> {
    let one = curve(1.0);
    let other = ClipCurve { start_rad: one.end_rad, end_rad: one.start_rad, ..one };
    let panels = vec![
        Panel::new("a) from left to right", "cut off: the inside of the curve", cut_disk(context, one)?),
        Panel::new("b) from right to left", "cut off: the outside of the curve", cut_disk(context, other)?),
    ];
    let title = "Which side is cut off (Ivo et al. 2012, figure 5)";
    let note = "What lies to the right of the way along the curve is cut off. Places on the curve's own side of the chord and beyond it are told apart \
                by one sign of the conic's implicit form; the paper counts crossings with a line.";
    Ok(Sheet::new(title, 2, panels, &[note]))
}

/// Figure 7: splats for a triangle.
///
/// # Errors
/// As those of [`FigureContext`].
pub fn i7(context: &mut FigureContext<'_>) -> Result<Sheet> {
    let mut panels = Vec::new();
    for (row, (what, third)) in CORNERS.into_iter().enumerate() {
        let corners = [DVec3::ZERO, DVec3::X, third.extend(0.0)];
        let area = 0.5 * third.y;
        for (column, (name, color)) in AROUND.into_iter().enumerate() {
            let (center, axes) = around(corners, column)?;
            let mesh = Mesh {
                positions: corners.map(|corner| corner + DVec3::Z).to_vec(),
                normals: Some(vec![glam::Vec3::Z; 3]),
                colors: Colors::Uniform(TRIANGLE),
                triangles: vec![[0, 1, 2]],
            };
            let scene = Scene {
                objects: vec![object(vec![(center, axes, color, Clip::None)])],
                meshes: vec![MeshObject { name: what.to_owned(), mesh, closed: false }],
                ..Scene::default()
            };
            let picture = from_above(context, &scene, (DVec2::new(0.5, -0.31), 2.4))?;
            let times = std::f64::consts::PI * axes.0.cross(axes.1).length() / area;
            let letter = char::from(b'a' + (3 * row + column) as u8);
            let caption = format!("{what}: {times:.2} times its area");
            panels.push(Panel::new(format!("{letter}) {name}"), caption, picture));
        }
    }
    let title = "Splats for a triangle (Ivo et al. 2012, figure 7)";
    let note = "The ellipse is the image of an equilateral triangle's circumcircle; of all ellipses around a triangle it has the least area, 2.42 times the triangle's.";
    Ok(Sheet::new(title, 3, panels, &[note]))
}

/// Center and half axes of what covers a triangle in the plane z = 0, by its column in figure 7.
fn around(corners: [DVec3; 3], column: usize) -> Result<(DVec3, Axes)> {
    let farthest =
        |center: DVec3| corners.map(|corner| corner.distance(center)).into_iter().fold(0.0, f64::max);
    if column < 2 {
        let [a, b, c] = corners;
        let ab = b - a;
        let center = match column {
            0 => (a + b + c) / 3.0,
            // On the perpendicular bisector of ab.
            _ => {
                let along = DVec3::new(-ab.y, ab.x, 0.0).normalize();
                let middle = 0.5 * (a + b);
                let to_c = c - middle;
                middle
                    + along * (to_c.length_squared() - (a - middle).length_squared())
                        / (2.0 * to_c.dot(along))
            }
        };
        return Ok((center, circle(farthest(center))));
    }
    let mesh = Mesh { positions: corners.to_vec(), triangles: vec![[0, 1, 2]], ..Mesh::default() };
    let options = SharpOptions { clipping: Clipping::None, ..SharpOptions::default() };
    let (splats, _) = sharp_splats(&mesh, &options, &())?;
    let axes = match &splats.shapes {
        Shapes::Ellipses { s, t } => (s[0].as_dvec3(), t[0].as_dvec3()),
        Shapes::Disks { radii, .. } => circle(radii[0].into()),
    };
    Ok((splats.positions[0], axes))
}
