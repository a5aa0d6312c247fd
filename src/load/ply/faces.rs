//! The elements `face` and `tristrips`: lists of vertex numbers, made into triangles.

use std::path::Path;

use ply_rs_bw::ply::{BeginList, ElementDef, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType};

use crate::error::{Error, Result};

/// The names that programs give to the list of a face's corners.
fn is_index_list(name: &str) -> bool {
    matches!(name, "vertex_indices" | "vertex_index")
}

/// Whether this element is a `face` or `tristrips` with corners.
pub(super) fn index_list(path: &Path, def: &ElementDef) -> Result<bool> {
    if !matches!(def.name.as_str(), "face" | "tristrips") || def.count == 0 {
        return Ok(false);
    }
    let refuse = |problem: &str| Err(Error::input(path, format!("element {}", def.name), problem));
    let mut lists = def.properties.values().filter(|p| is_index_list(&p.name));
    let (Some(list), None) = (lists.next(), lists.next()) else {
        return refuse("expected one list named vertex_indices or vertex_index");
    };
    match list.data_type {
        PropertyType::List(_, ScalarType::Float | ScalarType::Double) | PropertyType::Scalar(_) => {
            refuse(&format!("'{}' must be a list of an integer type", list.name))
        }
        PropertyType::List(..) => Ok(true),
    }
}

/// The corners of one face or strip as the file has them; at most one of the two is filled.
#[derive(Debug, Default)]
pub(super) struct FaceRecord {
    signed: Vec<i32>,
    unsigned: Vec<u32>,
}

impl FaceRecord {
    fn corners(&self) -> impl Iterator<Item = i64> + '_ {
        let signed = self.signed.iter().map(|&i| i64::from(i));
        signed.chain(self.unsigned.iter().map(|&i| i64::from(i)))
    }

    fn keep<T: Into<i32>>(&mut self, name: &str, values: Vec<T>) -> PropertyAccessResult {
        if !is_index_list(name) {
            return PropertyAccessResult::Ignored;
        }
        self.signed = values.into_iter().map(Into::into).collect();
        PropertyAccessResult::Set
    }
}

/// The setters of lists whose items all fit an `i32`.
macro_rules! signed_setters {
    ($($setter:ident: $type:ty,)+) => {
        $(fn $setter(&mut self, name: &str, values: Vec<$type>) -> PropertyAccessResult {
            self.keep(name, values)
        })+
    };
}

impl PropertyAccess for FaceRecord {
    fn new() -> Self {
        Self::default()
    }

    signed_setters! {
        set_list_char: i8,
        set_list_uchar: u8,
        set_list_short: i16,
        set_list_ushort: u16,
        set_list_int: i32,
    }

    fn set_list_uint(&mut self, name: &str, values: Vec<u32>) -> PropertyAccessResult {
        if !is_index_list(name) {
            return PropertyAccessResult::Ignored;
        }
        self.unsigned = values;
        PropertyAccessResult::Set
    }
    fn begin_list_int(&mut self, name: &str, _len: usize) -> BeginList<'_, i32> {
        if is_index_list(name) { BeginList::Fill(&mut self.signed) } else { BeginList::UseSetter }
    }
    fn begin_list_uint(&mut self, name: &str, _len: usize) -> BeginList<'_, u32> {
        if is_index_list(name) { BeginList::Fill(&mut self.unsigned) } else { BeginList::UseSetter }
    }
}

/// The triangles of all faces and strips.
pub(super) struct Triangles<'a> {
    path: &'a Path,
    vertex_count: usize,
    corners: Vec<u32>,
    /// Counterclockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The file has faces or strips, even if none gave a triangle.
    pub declared: bool,
    /// Faces with fewer than 3 corners.
    pub small_polygons: usize,
}

impl<'a> Triangles<'a> {
    pub(super) fn new(path: &'a Path, vertex_count: usize) -> Self {
        let (corners, triangles) = (Vec::new(), Vec::new());
        Self { path, vertex_count, corners, triangles, declared: false, small_polygons: 0 }
    }

    /// A polygon as a fan around its first corner: right for convex ones.
    pub(super) fn add_polygon(&mut self, face: usize, record: FaceRecord) -> Result<()> {
        self.declared = true;
        self.corners.clear();
        for index in record.corners() {
            let index = self.vertex(index).map_err(|problem| self.refuse("face", face, problem))?;
            self.corners.push(index);
        }
        if self.corners.len() < 3 {
            self.small_polygons += 1;
        }
        for pair in self.corners.get(1..).unwrap_or_default().windows(2) {
            self.triangles.push([self.corners[0], pair[0], pair[1]]);
        }
        Ok(())
    }

    /// Triangle strips, one after the other; −1 starts the next. Every second triangle of a strip is turned around.
    /// A repeated corner only joins two parts of a strip, and gives no triangle.
    pub(super) fn add_strip(&mut self, element: usize, record: FaceRecord) -> Result<()> {
        self.declared = true;
        let mut last: [Option<u32>; 2] = [None; 2];
        let mut odd = false;
        for (entry, index) in record.corners().enumerate() {
            if index == -1 {
                (last, odd) = ([None; 2], false);
                continue;
            }
            let c = self.vertex(index).map_err(|problem| {
                self.refuse("tristrips", element, format!("entry {entry}: {problem}, or -1 for a new strip"))
            })?;
            if let [Some(a), Some(b)] = last {
                if a != b && b != c && c != a {
                    self.triangles.push(if odd { [b, a, c] } else { [a, b, c] });
                }
                odd = !odd;
            }
            last = [last[1], Some(c)];
        }
        Ok(())
    }

    fn vertex(&self, index: i64) -> Result<u32, String> {
        match u32::try_from(index) {
            Ok(i) if (i as usize) < self.vertex_count => Ok(i),
            _ if self.vertex_count == 0 => Err(format!("corner {index}, but the file has no vertices")),
            _ => Err(format!("corner {index}, expected 0 to {}", self.vertex_count - 1)),
        }
    }

    fn refuse(&self, element: &str, number: usize, problem: String) -> Error {
        Error::input(self.path, format!("{element} {number}"), problem)
    }
}
