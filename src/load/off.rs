//! OFF files, as Geomview wrote them first: text; vertices with normals and colors or without, then polygons.
//!
//! The letters before `OFF` say what a vertex has: `N` a normal, `C` a color of three or four numbers, `ST` texture
//! coordinates, which are not read, `4` a fourth coordinate, by which the others are divided. The word may be left out.

#[cfg(test)]
mod tests;

use glam::{DVec3, Vec3};

use super::{
    Input, Limits, Loaded, Model,
    fans::Fan,
    lines::{Line, Lines, shown},
    shade,
};
use crate::{
    error::Result,
    notes::Deed,
    scene::{Colors, Mesh, Points},
};

/// What a vertex has beside its place.
#[derive(Clone, Copy)]
struct Kind {
    normal: bool,
    color: bool,
    texture: bool,
    divisor: bool,
}

pub(super) fn parse(input: &Input<'_>) -> Result<Loaded> {
    let mut lines = Lines::new(input, Some(b'#'));
    let first = lines.expect("OFF")?;
    let is_number = |word: &[u8]| word.iter().all(u8::is_ascii_digit);
    let word = first.words().next().filter(|word| !is_number(word));
    // Some writers leave out what should stand between the word and the first count.
    let digits = word.map_or(0, |word| word.iter().rev().take_while(|byte| byte.is_ascii_digit()).count());
    let glued = word.is_some_and(|word| digits > 0 && first.words().nth(1).is_some() && word.len() > digits);
    let (name, count) = match word {
        Some(word) if glued => word.split_at_checked(word.len() - digits).unzip(),
        word => (word, None),
    };
    let kind = kind(name.unwrap_or(b"OFF")).map_err(|problem| lines.fault(first, problem))?;
    if first.words().nth(1).is_some_and(|word| word.eq_ignore_ascii_case(b"BINARY")) {
        return Err(lines.fault(first, "a binary OFF file; expected one of text"));
    }
    // The counts may stand behind the name.
    let behind = first.words().skip(usize::from(name.is_some()));
    let mut words: Box<dyn Iterator<Item = &[u8]>> = Box::new(count.into_iter().chain(behind));
    let mut place = first;
    if name.is_some() && first.words().nth(1).is_none() {
        place = lines.expect("the numbers of vertices and faces")?;
        words = Box::new(place.words());
    }
    let vertices: u64 = lines.number(place, &mut words, "the number of vertices")?;
    let faces: u64 = lines.number(place, &mut words, "the number of faces")?;
    // The shortest vertex is `0 0 0` and a line's end, which only the last may lack; the shortest face is `0`.
    let room = lines.left() as u64 + 1;
    if vertices > room / 6 || faces > room / 2 {
        let problem =
            format!("{} bytes follow; expected {vertices} vertices and {faces} faces", lines.left());
        return Err(lines.fault(place, problem));
    }
    input.options.limits.check_points(input, vertices)?;
    let mut read = Read::default();
    for i in 0..vertices {
        let line = lines.expect(&format!("vertex {i} of {vertices}"))?;
        read.vertex(&lines, line, kind)?;
    }
    for i in 0..faces {
        let line = lines.expect(&format!("face {i} of {faces}"))?;
        read.face(&lines, line, vertices, &input.options.limits)?;
    }
    read.rest = u64::from(lines.next()?.is_some());
    Ok(read.loaded(name.unwrap_or(b"without its word"), kind))
}

/// What the letters before `OFF` say.
fn kind(name: &[u8]) -> Result<Kind, String> {
    let mut kind = Kind { normal: false, color: false, texture: false, divisor: false };
    let Some(mut letters) = name.strip_suffix(b"OFF").or(name.strip_suffix(b"off")) else {
        return Err(format!("'{}'; expected OFF", shown(name)));
    };
    let mut take = |letter: &[u8]| match letters.strip_prefix(letter) {
        Some(rest) => {
            letters = rest;
            true
        }
        None => false,
    };
    kind.texture = take(b"ST");
    kind.color = take(b"C");
    kind.normal = take(b"N");
    kind.divisor = take(b"4");
    match letters {
        b"" => Ok(kind),
        _ => Err(format!("'{}'; expected OFF, with ST, C, N and 4 before it or not", shown(name))),
    }
}

/// What was read so far.
#[derive(Default)]
struct Read {
    positions: Vec<DVec3>,
    normals: Vec<Vec3>,
    colors: Vec<[f32; 4]>,
    triangles: Vec<[u32; 3]>,
    fans: Vec<Fan>,
    /// Vertices with numbers that have no meaning here.
    longer: u64,
    small_faces: u64,
    colored_faces: u64,
    /// Whether there are lines behind the last face.
    rest: u64,
}

impl Read {
    fn vertex(&mut self, lines: &Lines<'_>, line: Line<'_>, kind: Kind) -> Result<()> {
        let words = &mut line.words();
        let mut three = |what: &str| -> Result<DVec3> {
            let mut next = || lines.number(line, words, what);
            Ok(DVec3::new(next()?, next()?, next()?))
        };
        let mut position = three("a coordinate")?;
        if kind.divisor {
            position /= lines.number::<f64>(line, words, "a fourth coordinate")?;
        }
        self.positions.push(position);
        if kind.normal {
            let mut next = || lines.number(line, words, "a coordinate of the normal");
            self.normals.push(DVec3::new(next()?, next()?, next()?).as_vec3());
        }
        let mut rest = Vec::new();
        while rest.len() < 7
            && let Some(word) = words.next()
        {
            rest.push(lines.number::<f32>(line, &mut [word].into_iter(), "a number")?);
        }
        if kind.texture {
            rest.truncate(rest.len().saturating_sub(2));
        }
        match (kind.color, rest.as_slice()) {
            (true, &[r, g, b]) => self.colors.push([r, g, b, f32::NAN]),
            (true, &[r, g, b, a]) => self.colors.push([r, g, b, a]),
            (true, others) => {
                let problem = format!("a color of {} numbers; expected 3 or 4", others.len());
                return Err(lines.fault(line, problem));
            }
            (false, others) => self.longer += u64::from(!others.is_empty()),
        }
        Ok(())
    }

    fn face(&mut self, lines: &Lines<'_>, line: Line<'_>, vertices: u64, limits: &Limits) -> Result<()> {
        let words = &mut line.words();
        let corners: u64 = lines.number(line, words, "the number of corners")?;
        let Limits { list_items, faces, .. } = *limits;
        if corners > list_items as u64 {
            return Err(lines.fault(line, format!("{corners} corners; expected at most {list_items}")));
        }
        let (mut first, mut before, begin) = (0, 0, self.triangles.len());
        for i in 0..corners {
            let corner: u64 = lines.number(line, words, "the number of a vertex")?;
            let Some(corner) = u32::try_from(corner).ok().filter(|_| corner < vertices) else {
                return Err(
                    lines.fault(line, format!("vertex {corner}, but the file has {vertices}, from 0"))
                );
            };
            match i {
                0 => first = corner,
                1 => {}
                _ => self.triangles.push([first, before, corner]),
            }
            before = corner;
        }
        if self.triangles.len() as u64 > faces {
            return Err(lines.fault(line, format!("more than {faces} triangles; expected at most that many")));
        }
        self.fans.extend(Fan::of(begin, &self.triangles));
        self.small_faces += u64::from(corners < 3);
        self.colored_faces += u64::from(words.next().is_some());
        Ok(())
    }

    fn loaded(self, name: &[u8], kind: Kind) -> Loaded {
        let mut outside = 0;
        let colors = match self.colors.is_empty() {
            true => Colors::unknown(),
            false => {
                let largest = self.colors.iter().flatten().fold(0.0, |a: f32, b| a.max(*b));
                let scale = if largest <= 1.0 { 1.0 } else { 255.0 };
                let rgb: Vec<[f32; 3]> = self.colors.iter().map(|&[r, g, b, _]| [r, g, b]).collect();
                let (mut linear, beyond) = shade::from_srgb(&rgb, scale);
                outside = beyond;
                for (color, [.., alpha]) in linear.iter_mut().zip(&self.colors) {
                    color[3] = if alpha.is_nan() { 1.0 } else { (alpha / scale).clamp(0.0, 1.0) };
                }
                Colors::Each(linear)
            }
        };
        let normals = kind.normal.then_some(self.normals);
        let count = self.positions.len() as u64;
        let model = match self.triangles.is_empty() {
            true => Model::Points(Points {
                positions: self.positions,
                normals,
                radii: None,
                radii_in_doubt: false,
                colors,
                viewpoints: Vec::new(),
            }),
            false => {
                Model::Mesh(Mesh { positions: self.positions, normals, colors, triangles: self.triangles })
            }
        };
        let mut loaded = Loaded::new(model, format!("OFF ({})", shown(name)));
        loaded.fans = self.fans;
        loaded.note(Deed::Dropped, self.small_faces, "faces with fewer than 3 corners");
        loaded.note(Deed::Clamped, outside, "vertices with a color out of its range");
        loaded.note(
            Deed::Ignored,
            self.longer,
            "vertices with more numbers than their kind has, whose rest is",
        );
        loaded.note(Deed::Ignored, self.colored_faces, "colors of faces");
        loaded.note(Deed::Ignored, if kind.texture { count } else { 0 }, "texture coordinates");
        loaded.note(Deed::Ignored, self.rest, "text behind the last face");
        loaded
    }
}
