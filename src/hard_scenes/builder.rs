//! Parts of scenes: random numbers that repeat, splats one by one, polygons, camera and settings.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};

use crate::scene::{
    Accumulate, Camera, Colors, Edges, Filter, Mesh, MeshObject, Object, Rasterizer, Scene, Settings, Shapes,
    Splats,
};

pub use crate::math::random::SplitMix as Random;

impl Random {
    /// From `lo` to below `hi`.
    pub fn between(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.unit()
    }

    /// A direction, all alike.
    pub fn direction(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        let (sin, cos) = self.between(0.0, TAU).sin_cos();
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * cos, r * sin, z)
    }

    /// A point at most this far from the origin along each axis, on a grid of f32: the oracle and the GPU read the same.
    pub fn point(&mut self, at_most: [f64; 3]) -> DVec3 {
        let point = DVec3::from(at_most.map(|at_most| self.between(-at_most, at_most)));
        point.as_vec3().as_dvec3()
    }

    /// A color, opaque.
    pub fn color(&mut self) -> [f32; 4] {
        [self.unit() as f32, self.unit() as f32, self.unit() as f32, 1.0]
    }
}

/// Splats one by one.
#[derive(Default)]
pub struct Builder {
    positions: Vec<DVec3>,
    s: Vec<Vec3>,
    t: Vec<Vec3>,
    normals: Vec<Vec3>,
    radii: Vec<f32>,
    colors: Vec<[f32; 4]>,
}

impl Builder {
    /// Adds a disk.
    pub fn disk(&mut self, position: DVec3, normal: DVec3, radius: f64, color: [f32; 4]) {
        self.positions.push(position);
        self.normals.push(normal.as_vec3());
        self.radii.push(radius as f32);
        self.colors.push(color);
    }

    /// Adds an ellipse by its scaled tangent vectors.
    pub fn ellipse(&mut self, position: DVec3, s: DVec3, t: DVec3, color: [f32; 4]) {
        self.positions.push(position);
        self.s.push(s.as_vec3());
        self.t.push(t.as_vec3());
        self.colors.push(color);
    }

    /// All of them as one object: ellipses where there is one, else disks.
    pub fn object(self, closed: bool) -> Object {
        let shapes = match self.s.is_empty() {
            true => Shapes::Disks { normals: self.normals, radii: self.radii },
            false => Shapes::Ellipses { s: self.s, t: self.t },
        };
        let splats = Splats::new(self.positions, shapes, Colors::Each(self.colors));
        Object { name: "test".to_owned(), splats, closed }
    }

    /// A scene of that object alone.
    pub fn scene(self, closed: bool) -> Scene {
        Scene::from(self.object(closed))
    }
}

/// A ball of polygons: `rings` of twice as many quads each, with smooth normals.
pub fn ball_of_polygons(center: DVec3, radius: f64, rings: u32, color: [f32; 4]) -> MeshObject {
    let columns = 2 * rings;
    let (mut positions, mut normals, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    for ring in 0..=rings {
        let (sin, cos) = (std::f64::consts::PI * f64::from(ring) / f64::from(rings)).sin_cos();
        for column in 0..columns {
            let (y, x) = (std::f64::consts::TAU * f64::from(column) / f64::from(columns)).sin_cos();
            let normal = DVec3::new(sin * x, cos, sin * y);
            positions.push(center + radius * normal);
            normals.push(normal.as_vec3());
        }
    }
    for ring in 0..rings {
        for column in 0..columns {
            let at = |ring: u32, column: u32| ring * columns + column % columns;
            let [a, b] = [at(ring, column), at(ring, column + 1)];
            let [c, d] = [at(ring + 1, column), at(ring + 1, column + 1)];
            if ring > 0 {
                triangles.push([a, b, d]);
            }
            if ring + 1 < rings {
                triangles.push([a, d, c]);
            }
        }
    }
    let mesh = Mesh { positions, normals: Some(normals), colors: Colors::Uniform(color), triangles };
    MeshObject { name: "ball of polygons".to_owned(), mesh, closed: true }
}

/// A rectangle of two triangles, its corners counterclockwise.
pub fn rectangle(corners: [DVec3; 4], color: [f32; 4]) -> MeshObject {
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero().as_vec3();
    let mesh = Mesh {
        positions: corners.to_vec(),
        normals: Some(vec![normal; 4]),
        colors: Colors::Uniform(color),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    };
    MeshObject { name: "rectangle".to_owned(), mesh, closed: false }
}

/// 45° of view, +y up.
pub fn camera(eye: [f64; 3], target: [f64; 3]) -> Camera {
    Camera {
        eye: eye.into(),
        target: target.into(),
        up: DVec3::Y,
        fov_y_rad: 45.0_f64.to_radians(),
        ..Camera::default()
    }
}

/// How hard scenes are drawn: small, with exact sums, by the graphics pipeline on every device.
pub fn settings() -> Settings {
    let rasterizer = Rasterizer::Perspective;
    let edges = Edges::Hard; // of surfaces as data; what covers pixels in part has tests of its own
    Settings { size_px: [256, 256], rasterizer, edges, accumulate: Accumulate::F32, ..Settings::default() }
}

/// These settings without a filter.
pub fn unfiltered() -> Settings {
    Settings { filter: Filter::None, ..settings() }
}
