//! The element `vertex`: positions and what makes them splats.

use std::path::Path;

use glam::{DVec3, Vec3};
use ply_rs_bw::ply::{ElementDef, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType};

use crate::{
    error::{Error, Result},
    math::srgb::linear_from_srgb,
    scene::UNKNOWN_SRGB,
};

/// Which properties the file's vertices have.
#[derive(Clone, Copy, Debug)]
pub(super) struct VertexLayout {
    pub normals: bool,
    pub radius: bool,
    /// `su_x … sv_z`, the scaled tangent vectors.
    pub tangents: bool,
    pub rgb: bool,
    pub alpha: bool,
    /// Some `clip_…` property.
    pub clip_curves: bool,
}

impl VertexLayout {
    /// Finds the groups of properties. A group is there as a whole or not at all.
    pub(super) fn of(path: &Path, def: &ElementDef) -> Result<Self> {
        let refuse = |problem: String| Err(Error::input(path, "element vertex", problem));
        for (name, property) in &def.properties {
            if is_known(name) && !matches!(property.data_type, PropertyType::Scalar(_)) {
                return refuse(format!("'{name}' is a list, expected one value"));
            }
            let color_type = matches!(
                property.data_type,
                PropertyType::Scalar(
                    ScalarType::UChar | ScalarType::UShort | ScalarType::Float | ScalarType::Double
                )
            );
            if matches!(name.as_str(), "red" | "green" | "blue" | "alpha") && !color_type {
                return refuse(format!("'{name}' must be of type uchar, ushort, float or double"));
            }
        }
        let group = |names: &[&str]| -> Result<bool> {
            let missing: Vec<&str> =
                names.iter().copied().filter(|&n| !def.properties.contains_key(n)).collect();
            match missing.as_slice() {
                [] => Ok(true),
                some if some.len() == names.len() => Ok(false),
                [first, ..] => {
                    let problem = format!("'{first}' is missing, its group is {}", names.join(" "));
                    Err(Error::input(path, "element vertex", problem))
                }
            }
        };
        if !group(&["x", "y", "z"])? {
            return refuse("'x' is missing, its group is x y z".to_owned());
        }
        Ok(Self {
            normals: group(&["nx", "ny", "nz"])?,
            radius: def.properties.contains_key("radius"),
            tangents: group(&["su_x", "su_y", "su_z", "sv_x", "sv_y", "sv_z"])?,
            rgb: group(&["red", "green", "blue"])?,
            alpha: def.properties.contains_key("alpha"),
            clip_curves: def.properties.keys().any(|name| name.starts_with("clip_")),
        })
    }
}

fn is_known(name: &str) -> bool {
    VertexRecord::default().store(name, 0.0, 1.0) == PropertyAccessResult::Set
}

/// One vertex as the file has it; colors as sRGB values 0–1.
#[derive(Clone, Copy, Debug)]
pub(super) struct VertexRecord {
    position: DVec3,
    normal: Vec3,
    radius: f32,
    s: Vec3,
    t: Vec3,
    color_srgb: [f32; 4],
}

impl Default for VertexRecord {
    fn default() -> Self {
        let gray = UNKNOWN_SRGB;
        Self {
            position: DVec3::ZERO,
            normal: Vec3::ZERO,
            radius: 0.0,
            s: Vec3::ZERO,
            t: Vec3::ZERO,
            color_srgb: [gray, gray, gray, 1.0],
        }
    }
}

impl VertexRecord {
    /// `full` is the value that means 1 in a color of the property's type.
    fn store(&mut self, name: &str, value: f64, full: f64) -> PropertyAccessResult {
        let single = value as f32;
        match name {
            "x" => self.position.x = value,
            "y" => self.position.y = value,
            "z" => self.position.z = value,
            "nx" => self.normal.x = single,
            "ny" => self.normal.y = single,
            "nz" => self.normal.z = single,
            "radius" => self.radius = single,
            "su_x" => self.s.x = single,
            "su_y" => self.s.y = single,
            "su_z" => self.s.z = single,
            "sv_x" => self.t.x = single,
            "sv_y" => self.t.y = single,
            "sv_z" => self.t.z = single,
            "red" => self.color_srgb[0] = (value / full) as f32,
            "green" => self.color_srgb[1] = (value / full) as f32,
            "blue" => self.color_srgb[2] = (value / full) as f32,
            "alpha" => self.color_srgb[3] = (value / full) as f32,
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

/// The setters of properties of each type, with the value that means 1 in a color of it.
macro_rules! setters {
    ($($setter:ident: $type:ty = $full:literal,)+) => {
        $(fn $setter(&mut self, name: &str, value: $type) -> PropertyAccessResult {
            self.store(name, value.into(), $full)
        })+
    };
}

impl PropertyAccess for VertexRecord {
    fn new() -> Self {
        Self::default()
    }

    setters! {
        set_char: i8 = 1.0,
        set_uchar: u8 = 255.0,
        set_short: i16 = 1.0,
        set_ushort: u16 = 65_535.0,
        set_int: i32 = 1.0,
        set_uint: u32 = 1.0,
        set_float: f32 = 1.0,
        set_double: f64 = 1.0,
    }
}

/// All vertices, an array for each group that the file has.
pub(super) struct Vertices {
    pub positions: Vec<DVec3>,
    pub normals: Option<Vec<Vec3>>,
    pub radii: Option<Vec<f32>>,
    pub tangents: Option<(Vec<Vec3>, Vec<Vec3>)>,
    pub colors: Option<Vec<[f32; 4]>>,
    /// The linear value of each 8-bit sRGB value: bytes are the common case, and a power costs more than the rest.
    linear_of_byte: [f32; 256],
    side_from_normals: bool,
}

impl Vertices {
    pub(super) fn new(layout: VertexLayout) -> Self {
        Self {
            positions: Vec::new(),
            // Beside tangent vectors, a normal gives only the side.
            normals: layout.normals.then(Vec::new),
            radii: layout.radius.then(Vec::new),
            tangents: layout.tangents.then(|| (Vec::new(), Vec::new())),
            colors: (layout.rgb || layout.alpha).then(Vec::new),
            linear_of_byte: std::array::from_fn(|byte| linear_from_srgb(byte as f32 / 255.0)),
            side_from_normals: layout.normals && layout.tangents,
        }
    }

    /// Makes room for `count` vertices, a number that was checked against the file's size.
    pub(super) fn reserve(&mut self, count: usize) {
        self.positions.reserve_exact(count);
        if let Some(normals) = &mut self.normals {
            normals.reserve_exact(count);
        }
        if let Some(radii) = &mut self.radii {
            radii.reserve_exact(count);
        }
        if let Some((s, t)) = &mut self.tangents {
            s.reserve_exact(count);
            t.reserve_exact(count);
        }
        if let Some(colors) = &mut self.colors {
            colors.reserve_exact(count);
        }
    }

    pub(super) fn push(&mut self, vertex: VertexRecord) {
        self.positions.push(vertex.position);
        if let Some(normals) = &mut self.normals {
            normals.push(vertex.normal);
        }
        if let Some(radii) = &mut self.radii {
            radii.push(vertex.radius);
        }
        if let Some((s, t)) = &mut self.tangents {
            let away = self.side_from_normals
                && vertex.s.as_dvec3().cross(vertex.t.as_dvec3()).dot(vertex.normal.as_dvec3()) < 0.0;
            s.push(vertex.s);
            // −t spans the same disk and turns the normal s×t around.
            t.push(if away { -vertex.t } else { vertex.t });
        }
        if let Some(colors) = &mut self.colors {
            let [r, g, b, alpha] = vertex.color_srgb;
            let linear = |encoded: f32| linear(&self.linear_of_byte, encoded);
            colors.push([linear(r), linear(g), linear(b), alpha.clamp(0.0, 1.0)]);
        }
    }
}

/// Linear light of an sRGB value, clamped to 0–1; NaN stays NaN, so that the vertex is counted as defective.
fn linear(of_byte: &[f32; 256], encoded: f32) -> f32 {
    let encoded = encoded.clamp(0.0, 1.0);
    let byte = (encoded * 255.0).round();
    if byte / 255.0 == encoded { of_byte[byte as usize] } else { linear_from_srgb(encoded) }
}
