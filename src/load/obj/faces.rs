//! The rows `f` and `usemtl`: triangles over the vertices that faces use, a copy of a vertex for each color that it has.

use std::collections::{HashMap, HashSet};

use glam::DVec3;

use super::{
    corners::{Block, Row},
    lines::Lines,
    materials::Material,
    vertices::Vertices,
};
use crate::{
    error::Result,
    load::{Input, fans::Fan},
};

/// No color of its own.
const PLAIN: u32 = 0;

/// A number that no vertex has.
const NONE: u32 = u32::MAX;

/// The faces of a file, over vertices in the order in which faces first use them.
pub(super) struct Faces<'a> {
    input: &'a Input<'a>,
    file: &'a Vertices,
    pub triangles: Vec<[u32; 3]>,
    pub fans: Vec<Fan>,
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
    corners: Vec<(u32, Option<DVec3>)>,
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
            fans: Vec::new(),
            origins: Vec::new(),
            paints: Vec::new(),
            palette: vec![[1.0; 4]],
            normals: Vec::new(),
            copies: vec![NONE; file.positions.len()],
            more_copies: HashMap::new(),
            paint_of: HashMap::new(),
            corners: Vec::new(),
            paint: PLAIN,
            textures: HashSet::new(),
            counts: Counts::default(),
        };
        let mut lines = Lines::new(input);
        let mut block = Block::new(file);
        while let Some(line) = lines.next()? {
            match line.keyword() {
                b"v" => block.vertex(),
                b"vn" => block.normal(),
                b"usemtl" => {
                    line.rest().map(|name| faces.choose(name)).map_err(|problem| lines.fault(problem))?
                }
                b"f" => {
                    let (paint, most) = (faces.paint, input.options.limits.list_items);
                    let row = line.rest().and_then(|row| block.face(row, lines.first(), paint, most));
                    if let Err(problem) = row {
                        // What is wrong before it is said first.
                        faces.read_block(&mut block, &lines)?;
                        return Err(lines.fault(problem));
                    }
                    if block.is_full() {
                        faces.read_block(&mut block, &lines)?;
                    }
                }
                _ => {}
            }
        }
        faces.read_block(&mut block, &lines)?;
        Ok(faces)
    }

    fn read_block(&mut self, block: &mut Block<'a>, lines: &Lines<'_>) -> Result<()> {
        let (rows, mut corners) = block.read().map_err(|(line, problem)| lines.fault_at(line, problem))?;
        for (row, count) in rows.iter().zip(corners.counts(rows.len())) {
            self.corners.clear();
            self.corners.extend((0..count).map_while(|_| corners.next()));
            self.face(row).map_err(|problem| lines.fault_at(row.line, problem))?;
        }
        Ok(())
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

    /// A polygon is a fan around its first corner: right for convex ones.
    fn face(&mut self, row: &Row) -> Result<(), String> {
        if self.corners.len() < 3 {
            self.counts.small += 1;
            return Ok(());
        }
        let is_finite = |&(vertex, _): &(u32, Option<DVec3>)| {
            self.file.positions.get(vertex as usize).is_some_and(|position| position.is_finite())
        };
        if !self.corners.iter().all(is_finite) {
            self.counts.not_finite += 1;
            return Ok(());
        }
        let most = self.input.options.limits.faces;
        if self.triangles.len() as u64 + self.corners.len() as u64 - 2 > most {
            return Err(format!("more than {most} triangles; expected at most that many"));
        }
        self.add(row);
        Ok(())
    }

    /// Adds the face of the corners.
    fn add(&mut self, row: &Row) {
        self.counts.unusable_normals += u64::from(row.has_unusable_normal);
        let paint = if self.file.have_colors() { PLAIN } else { row.paint };
        self.counts.overruled += u64::from(paint != row.paint);
        let (mut fan, begin) = ([NONE; 2], self.triangles.len());
        for corner in 0..self.corners.len() {
            let Some(&(vertex, normal)) = self.corners.get(corner) else { break };
            let c = self.copy(vertex, paint);
            if let (Some(normal), false) = (normal, row.has_unusable_normal)
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
        self.fans.extend(Fan::of(begin, &self.triangles));
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
}
