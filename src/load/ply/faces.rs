//! The elements `face` and `tristrips`: lists of vertex numbers, made into triangles.

use super::{
    body::{Body, Items},
    schema::{Element, Kind, Scalar},
};
use crate::{
    error::Result,
    load::{Input, fans::Fan},
};

/// What an element's list of vertex numbers is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Corners {
    /// Of a polygon.
    Polygon { list: usize },
    /// Of triangle strips.
    Strips { list: usize },
}

/// The list of corners, if this element is a `face` or `tristrips`.
pub(super) fn corners(input: &Input<'_>, def: &Element) -> Result<Option<Corners>> {
    if !def.is_named(&["face", "faces", "tristrips"]) || def.count == 0 {
        return Ok(None);
    }
    let refuse = |problem: &str| Err(input.fault(format!("element {}", def.name), problem));
    let is_list =
        |name: &str| ["vertex_indices", "vertex_index"].iter().any(|own| name.eq_ignore_ascii_case(own));
    let mut lists = def.properties.iter().enumerate().filter(|(_, p)| is_list(&p.name));
    let (Some((list, property)), None) = (lists.next(), lists.next()) else {
        return refuse("expected one list named vertex_indices or vertex_index");
    };
    match property.kind {
        Kind::List { item: Scalar::Float | Scalar::Double, .. } | Kind::One(_) => {
            refuse(&format!("'{}' must be a list of an integer type", property.name))
        }
        Kind::List { .. } if def.is_named(&["tristrips"]) => Ok(Some(Corners::Strips { list })),
        Kind::List { .. } => Ok(Some(Corners::Polygon { list })),
    }
}

/// The triangles of all faces and strips.
pub(super) struct Triangles<'a> {
    input: &'a Input<'a>,
    vertex_count: u64,
    /// Counterclockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    pub fans: Vec<Fan>,
    /// Faces with fewer than 3 corners.
    pub small_polygons: u64,
}

impl<'a> Triangles<'a> {
    pub(super) fn new(input: &'a Input<'a>, vertex_count: u64) -> Self {
        Self { input, vertex_count, triangles: Vec::new(), fans: Vec::new(), small_polygons: 0 }
    }

    /// Reads all elements of this kind.
    pub(super) fn read(&mut self, body: &mut Body<'_>, def: &Element, corners: Corners) -> Result<()> {
        let (Corners::Polygon { list } | Corners::Strips { list }) = corners;
        // Corners of one byte each become triangles of twelve: an array that doubled its length would take twice that. A
        // corner of an ascii file takes two bytes at least, and to count them costs as much as to read them.
        if !body.is_ascii() {
            let mut most = 0_u64;
            let mut ahead = *body;
            ahead.lists(def, list, &mut |_, items| {
                most += items.len().saturating_sub(2) as u64;
                Ok(())
            })?;
            let most = most.min(self.input.options.limits.faces);
            self.triangles.reserve_exact(usize::try_from(most).unwrap_or(0));
        }
        body.lists(def, list, &mut |i, items| {
            let added = match corners {
                Corners::Polygon { .. } => self.add_polygon(items),
                Corners::Strips { .. } => self.add_strips(items),
            };
            added.map_err(|problem| self.input.fault(format!("{} {i}", def.name), problem))
        })
    }

    /// A polygon as a fan around its first corner: right for convex ones.
    fn add_polygon(&mut self, items: Items<'_>) -> Result<(), String> {
        let most = self.input.options.limits.list_items;
        if items.len() > most {
            return Err(format!("{} corners; expected at most {most}", items.len()));
        }
        self.small_polygons += u64::from(items.len() < 3);
        let (mut fan, begin): ([Option<u32>; 2], usize) = ([None; 2], self.triangles.len());
        for index in items {
            let c = self.vertex(index?)?;
            fan = match fan {
                [Some(a), Some(b)] => {
                    self.push([a, b, c])?;
                    [Some(a), Some(c)]
                }
                [Some(a), None] => [Some(a), Some(c)],
                _ => [Some(c), None],
            };
        }
        self.fans.extend(Fan::of(begin, &self.triangles));
        Ok(())
    }

    /// Triangle strips, one after the other; −1 starts the next. Every second triangle of a strip is turned around.
    /// A repeated corner only joins two parts of a strip, and gives no triangle.
    fn add_strips(&mut self, items: Items<'_>) -> Result<(), String> {
        let mut last: [Option<u32>; 2] = [None; 2];
        let mut odd = false;
        for (entry, index) in items.enumerate() {
            let index = index?;
            if index == -1 {
                (last, odd) = ([None; 2], false);
                continue;
            }
            let c = self
                .vertex(index)
                .map_err(|problem| format!("entry {entry}: {problem}, or -1 for a new strip"))?;
            if let [Some(a), Some(b)] = last {
                if a != b && b != c && c != a {
                    self.push(if odd { [b, a, c] } else { [a, b, c] })?;
                }
                odd = !odd;
            }
            last = [last[1], Some(c)];
        }
        Ok(())
    }

    fn push(&mut self, triangle: [u32; 3]) -> Result<(), String> {
        let most = self.input.options.limits.faces;
        if self.triangles.len() as u64 >= most {
            return Err(format!("more than {most} triangles; expected at most that many"));
        }
        self.triangles.push(triangle);
        Ok(())
    }

    fn vertex(&self, index: i64) -> Result<u32, String> {
        match u32::try_from(index) {
            Ok(i) if u64::from(i) < self.vertex_count => Ok(i),
            _ if self.vertex_count == 0 => Err(format!("corner {index}, but the file has no vertices")),
            _ => Err(format!("corner {index}, expected 0 to {}", self.vertex_count - 1)),
        }
    }
}
