//! The rows `f` and `usemtl`: triangles over the vertices that faces use, a copy of a vertex for each color that it has.

use std::collections::{HashMap, HashSet};

use glam::DVec3;

use super::{
    lines::{Lines, shown},
    materials::Material,
    vertices::Vertices,
};
use crate::{error::Result, load::Input};

/// No color of its own.
const PLAIN: u32 = 0;

/// A number that no vertex has.
const NONE: u32 = u32::MAX;

/// A corner's normal.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Normal {
    /// The row names none.
    Unnamed,
    /// The row names one that is zero, not finite, or not there.
    Unusable,
    /// Of length 1.
    Is(DVec3),
}

/// The faces of a file, over vertices in the order in which faces first use them.
pub(super) struct Faces<'a> {
    input: &'a Input<'a>,
    file: &'a Vertices,
    pub triangles: Vec<[u32; 3]>,
    /// The file's vertex that each one is.
    pub origins: Vec<u32>,
    /// The color of each, as its number in `palette`.
    pub paints: Vec<u32>,
    /// Linear colors of materials; the first one is none.
    pub palette: Vec<[f32; 4]>,
    /// Sums of the corners' normals, one a vertex; empty where the file has no normals.
    pub normals: Vec<DVec3>,
    /// The first vertex that is a copy of each one of the file's.
    copies: Vec<u32>,
    /// The others, by the file's vertex and the color.
    more_copies: HashMap<(u32, u32), u32>,
    paint_of: HashMap<[u32; 4], u32>,
    corners: Vec<(u32, Normal)>,
    /// Rows `v` and `vn` so far, from which negative numbers count back.
    so_far: [u64; 2],
    paint: u32,
    textures: HashSet<String>,
    pub counts: Counts,
}

/// What was left out.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counts {
    pub small: u64,
    pub not_finite: u64,
    pub unusable_normals: u64,
    /// Faces of materials that have a color beside vertices that have one.
    pub overruled: u64,
    /// Rows `usemtl` with a name that no file describes.
    pub unknown_materials: u64,
    pub textures: u64,
    pub transparent: u64,
}

impl<'a> Faces<'a> {
    pub(super) fn read(input: &'a Input<'a>, file: &'a Vertices) -> Result<Self> {
        let mut faces = Self {
            input,
            file,
            triangles: Vec::new(),
            origins: Vec::new(),
            paints: Vec::new(),
            palette: vec![[1.0; 4]],
            normals: Vec::new(),
            copies: vec![NONE; file.positions.len()],
            more_copies: HashMap::new(),
            paint_of: HashMap::new(),
            corners: Vec::new(),
            so_far: [0; 2],
            paint: PLAIN,
            textures: HashSet::new(),
            counts: Counts::default(),
        };
        let mut lines = Lines::new(input);
        while let Some(line) = lines.next()? {
            match line.keyword() {
                b"v" => faces.so_far[0] += 1,
                b"vn" => faces.so_far[1] += 1,
                b"usemtl" => {
                    line.rest().map(|name| faces.choose(name)).map_err(|problem| lines.fault(problem))?
                }
                b"f" => {
                    let row = line.rest().and_then(|row| faces.face(row));
                    row.map_err(|problem| lines.fault(problem))?;
                }
                _ => {}
            }
        }
        Ok(faces)
    }

    /// The material of the faces that follow.
    fn choose(&mut self, name: &str) {
        self.paint = PLAIN;
        let Some(Material { color, has_texture, is_transparent }) = self.file.materials.get(name) else {
            self.counts.unknown_materials += 1;
            return;
        };
        if (*has_texture || *is_transparent) && self.textures.insert(name.to_owned()) {
            self.counts.textures += u64::from(*has_texture);
            self.counts.transparent += u64::from(*is_transparent);
        }
        if let Some(color) = *color {
            let next = self.palette.len() as u32;
            self.paint = *self.paint_of.entry(color.map(f32::to_bits)).or_insert(next);
            if self.paint == next {
                self.palette.push(color);
            }
        }
    }

    /// Corners `v`, `v/vt`, `v//vn` or `v/vt/vn`; negative numbers count back from the last row so far. A polygon is a fan
    /// around its first corner: right for convex ones.
    fn face(&mut self, row: &str) -> Result<(), String> {
        let limits = self.input.options.limits;
        self.corners.clear();
        for word in row.split_ascii_whitespace() {
            if self.corners.len() >= limits.list_items {
                return Err(format!("more than {} corners; expected at most that many", self.corners.len()));
            }
            let corner = self.corner(word)?;
            self.corners.push(corner);
        }
        match self.corners.len() {
            0 => return Err("a face without corners; expected 3 or more".to_owned()),
            1 | 2 => {
                self.counts.small += 1;
                return Ok(());
            }
            _ => {}
        }
        let is_finite = |&(vertex, _): &(u32, Normal)| {
            self.file.positions.get(vertex as usize).is_some_and(|position| position.is_finite())
        };
        if !self.corners.iter().all(is_finite) {
            self.counts.not_finite += 1;
            return Ok(());
        }
        if self.triangles.len() as u64 + self.corners.len() as u64 - 2 > limits.faces {
            return Err(format!("more than {} triangles; expected at most that many", limits.faces));
        }
        self.add();
        Ok(())
    }

    /// Adds the face of the corners.
    fn add(&mut self) {
        let unusable = self.corners.iter().any(|&(_, normal)| normal == Normal::Unusable);
        self.counts.unusable_normals += u64::from(unusable);
        let paint = if self.file.have_colors() { PLAIN } else { self.paint };
        self.counts.overruled += u64::from(paint != self.paint);
        let mut fan = [NONE; 2];
        for corner in 0..self.corners.len() {
            let Some(&(vertex, normal)) = self.corners.get(corner) else { break };
            let c = self.copy(vertex, paint);
            if let (Normal::Is(normal), false) = (normal, unusable)
                && let Some(sum) = self.normals.get_mut(c as usize)
            {
                *sum += normal;
            }
            match fan {
                [NONE, _] => fan[0] = c,
                [_, NONE] => fan[1] = c,
                [a, b] => {
                    self.triangles.push([a, b, c]);
                    fan[1] = c;
                }
            }
        }
    }

    /// The number of the file's vertex with a color.
    fn copy(&mut self, vertex: u32, paint: u32) -> u32 {
        let next = self.origins.len() as u32;
        let Some(first) = self.copies.get_mut(vertex as usize) else { return NONE };
        let found = match *first {
            NONE => {
                *first = next;
                next
            }
            first if self.paints.get(first as usize) == Some(&paint) => first,
            _ => *self.more_copies.entry((vertex, paint)).or_insert(next),
        };
        if found == next {
            self.origins.push(vertex);
            self.paints.push(paint);
            if !self.file.normals.is_empty() {
                self.normals.push(DVec3::ZERO);
            }
        }
        found
    }

    fn corner(&self, word: &str) -> Result<(u32, Normal), String> {
        let mut parts = word.split('/');
        let vertex = whole("vertex", parts.next().unwrap_or_default())?;
        let total = self.file.positions.len() as u64;
        let vertex = counted(vertex, self.so_far[0], total).ok_or_else(|| match total {
            0 => format!("vertex {vertex}, but the file has none"),
            _ => format!("vertex {vertex}; expected 1 to {total}, or -{} to -1", self.so_far[0]),
        })?;
        let normal = match (parts.next(), parts.next(), parts.next()) {
            (_, None | Some(""), None) => Normal::Unnamed,
            (_, Some(normal), None) => self.normal(whole("normal", normal)?),
            _ => return Err(format!("a corner '{}'; expected v/vt/vn", shown(word))),
        };
        Ok((vertex, normal))
    }

    fn normal(&self, number: i64) -> Normal {
        counted(number, self.so_far[1], self.file.normals.len() as u64)
            .and_then(|i| self.file.normals.get(i as usize))
            .and_then(|normal| normal.as_dvec3().try_normalize())
            .map_or(Normal::Unusable, Normal::Is)
    }
}

fn whole(what: &str, word: &str) -> Result<i64, String> {
    word.parse().map_err(|_| format!("a corner with {what} '{}'; expected a whole number", shown(word)))
}

/// A number from 1, or counted back from the last of `so_far`, as one from 0 below `total`.
fn counted(number: i64, so_far: u64, total: u64) -> Option<u32> {
    let index = match u64::try_from(number) {
        Ok(number) => number.checked_sub(1)?,
        Err(_) => so_far.checked_sub(number.unsigned_abs())?,
    };
    u32::try_from(index).ok().filter(|_| index < total)
}
