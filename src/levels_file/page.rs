//! A page: splats in columns, with the balls of their parents in a list of their own.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::{
    bytes::{In, Out},
    header::{Header, LARGEST},
    table::{PageEntry, Reach},
};
use crate::scene::{Bounds, Colors, ErrorBall, Shapes, Splats};

/// The largest part of its radius by which 32-bit positions may move a splat; otherwise positions have 64 bits.
const MOST_SHIFT: f64 = 1.0 / (1 << 14) as f64;

/// By which part of themselves bounds in the table are larger than what they bound.
const ROOM: f64 = 1e-9;

/// Bytes of a ball.
const BALL_BYTES: usize = 20;

/// Splats of a page.
#[derive(Clone, Debug)]
pub(super) struct Page {
    /// They stand for others.
    pub nodes: bool,
    pub splats: Splats,
    /// The number of each one's parent's ball.
    pub parents: Vec<u32>,
    pub balls: Vec<ErrorBall>,
    /// Of nodes: their own balls, and what they weigh.
    pub own: Vec<(ErrorBall, f32)>,
}

/// What all pages of a file have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Form {
    /// The object's own splats are ellipses.
    pub ellipses: bool,
    /// The one color of all.
    pub color: Option<[f32; 4]>,
    /// Colors have an alpha.
    pub alpha: bool,
    /// From where balls are counted.
    pub origin: DVec3,
}

impl Form {
    pub fn of(header: &Header) -> Self {
        let Header { ellipses, color, transparent, origin, .. } = *header;
        Self { ellipses, color, alpha: transparent, origin }
    }

    /// Bytes of a splat in a page, without its parent's ball.
    fn splat_bytes(&self, nodes: bool, wide: bool) -> usize {
        let position = if wide { 24 } else { 12 };
        let shape = if nodes || self.ellipses { 24 } else { 16 };
        let color = match (self.color, self.alpha) {
            (Some(_), _) => 0,
            (None, false) => 12,
            (None, true) => 16,
        };
        let own = if nodes { BALL_BYTES + 4 } else { 0 };
        position + shape + color + own + 2
    }

    /// Bytes of a page.
    pub fn bytes(&self, entry: &PageEntry) -> u64 {
        let each = self.splat_bytes(entry.nodes, entry.wide) as u64;
        u64::from(entry.count) * each + u64::from(entry.balls) * BALL_BYTES as u64
    }
}

impl Page {
    /// Of splats, the numbers of their parents, each of which has its ball, and of nodes their own balls and weights; of other splats none.
    pub fn of(
        splats: Splats,
        parents: impl Iterator<Item = u32>,
        ball: impl Fn(u32) -> ErrorBall,
        own: Vec<(ErrorBall, f32)>,
    ) -> Self {
        let (mut numbers, mut balls) = (HashMap::new(), Vec::new());
        let mut number = |parent: u32| {
            *numbers.entry(parent).or_insert_with(|| {
                balls.push(ball(parent));
                balls.len() as u32 - 1
            })
        };
        let parents = parents.map(&mut number).collect();
        Self { nodes: !own.is_empty(), splats, parents, balls, own }
    }

    /// Its bytes, and its entry of the table, but for its place in the file. Positions become what the file has.
    pub fn encode(&mut self, form: &Form) -> (Vec<u8>, PageEntry) {
        let splats = &mut self.splats;
        let places = splats.positions.iter().map(|position| Bounds::of_ball(*position, 0.0));
        let center = places.reduce(Bounds::union).map_or(DVec3::ZERO, |bounds| bounds.center());
        let narrowed = |position: DVec3| center + (position - center).as_vec3().as_dvec3();
        let is_moved = |i: usize| {
            let position = splats.positions[i];
            position.distance(narrowed(position)) > MOST_SHIFT * splats.major_radius(i)
        };
        let wide = (0..splats.len()).any(is_moved);
        let mut out = Out(Vec::with_capacity(
            splats.len() * form.splat_bytes(self.nodes, wide) + self.balls.len() * BALL_BYTES,
        ));
        for position in &mut splats.positions {
            match wide {
                true => out.dvec3(*position),
                false => {
                    out.vec3((*position - center).as_vec3());
                    *position = narrowed(*position);
                }
            }
        }
        match &splats.shapes {
            Shapes::Disks { normals, radii } => {
                normals.iter().for_each(|normal| out.vec3(*normal));
                radii.iter().for_each(|radius| out.f32(*radius));
            }
            Shapes::Ellipses { s, t } => s.iter().chain(t).for_each(|axis| out.vec3(*axis)),
        }
        if let (None, Colors::Each(colors)) = (form.color, &splats.colors) {
            let channels = if form.alpha { 4 } else { 3 };
            colors.iter().for_each(|color| color[..channels].iter().for_each(|value| out.f32(*value)));
        }
        for (ball, weight) in &self.own {
            out.f32(*weight);
            push_ball(&mut out, ball);
        }
        self.parents.iter().for_each(|parent| out.0.extend((*parent as u16).to_le_bytes()));
        self.balls.iter().for_each(|ball| push_ball(&mut out, ball));
        let entry = self.entry(form, center, wide, &out.0);
        (out.0, entry)
    }

    fn entry(&self, form: &Form, center: DVec3, wide: bool, bytes: &[u8]) -> PageEntry {
        let found = self.bounds(form, center);
        let roomy = |reach: Reach| Reach {
            reach: reach.reach * (1.0 + ROOM),
            far: reach.far + ROOM * reach.far.abs(),
            ..reach
        };
        PageEntry {
            at: 0,
            bytes: bytes.len() as u32,
            crc: crc32fast::hash(bytes),
            count: self.splats.len() as u32,
            balls: self.balls.len() as u32,
            nodes: self.nodes,
            wide,
            center,
            radius: found.radius * (1.0 + ROOM),
            own: roomy(found.own),
            parent: roomy(found.parent),
        }
    }

    fn bounds(&self, form: &Form, center: DVec3) -> PageBounds {
        let reach = |i: usize| self.splats.positions[i].distance(center) + self.splats.major_radius(i);
        let middle = center - form.origin;
        PageBounds {
            radius: (0..self.splats.len()).map(reach).fold(0.0, f64::max),
            own: reach_of(middle, self.own.iter().map(|(ball, _)| ball)),
            parent: reach_of(middle, self.balls.iter()),
        }
    }

    /// The page in these bytes, of which there are as many as [`Form::bytes`] says.
    ///
    /// # Errors
    /// What is wrong, in words.
    pub fn decode(bytes: &[u8], entry: &PageEntry, form: &Form) -> Result<Self, String> {
        let mut input = In(bytes);
        let count = entry.count as usize;
        let position = |input: &mut In<'_>| match entry.wide {
            true => input.dvec3(),
            false => entry.center + input.vec3().as_dvec3(),
        };
        let positions: Vec<DVec3> = (0..count).map(|_| position(&mut input)).collect();
        let vectors = |input: &mut In<'_>| -> Vec<Vec3> { (0..count).map(|_| input.vec3()).collect() };
        let shapes = match entry.nodes || form.ellipses {
            true => Shapes::Ellipses { s: vectors(&mut input), t: vectors(&mut input) },
            false => {
                let normals = vectors(&mut input);
                Shapes::Disks { normals, radii: (0..count).map(|_| input.f32()).collect() }
            }
        };
        let color = |input: &mut In<'_>| {
            let [red, green, blue] = input.vec3().to_array();
            [red, green, blue, if form.alpha { input.f32() } else { 1.0 }]
        };
        let colors = match form.color {
            Some(color) => Colors::Uniform(color),
            None => Colors::Each((0..count).map(|_| color(&mut input)).collect()),
        };
        let own = |input: &mut In<'_>| {
            let weight = input.f32();
            (ball(input), weight)
        };
        let own = (0..if entry.nodes { count } else { 0 }).map(|_| own(&mut input)).collect();
        let parents = (0..count).map(|_| input.u16().into()).collect();
        let balls = (0..entry.balls).map(|_| ball(&mut input)).collect();
        let splats = Splats::new(positions, shapes, colors);
        let page = Self { nodes: entry.nodes, splats, parents, balls, own };
        page.check(entry, form).map(|()| page)
    }

    fn check(&self, entry: &PageEntry, form: &Form) -> Result<(), String> {
        let kind = if self.nodes { "node" } else { "splat" };
        for i in 0..self.splats.len() {
            let largest = self.splats.positions[i].abs().max_element();
            if self.splats.defect(i).is_some() || largest.max(self.splats.major_radius(i)) > LARGEST {
                return Err(format!("{kind} {i} can't be drawn"));
            }
            let Some(parent) = self.balls.get(self.parents[i] as usize) else {
                return Err(format!(
                    "{kind} {i} is below parent {} of {}",
                    self.parents[i],
                    self.balls.len()
                ));
            };
            let Some((own, weight)) = self.own.get(i) else { continue };
            let is_node = is_ball(own) && *weight > 0.0 && weight.is_finite() && is_within(own, parent);
            if !is_node {
                return Err(format!("{kind} {i} has a ball or a weight that no node below its parent has"));
            }
        }
        if let Some(i) = self.balls.iter().position(|ball| !is_ball(ball) && *ball != ErrorBall::ABOVE_ROOT) {
            return Err(format!("parent {i} has no ball; expected a center, a radius and a spread above 0"));
        }
        let found = self.bounds(form, entry.center);
        let is_inside = |found: Reach, bounds: Reach| {
            let ([least, most], [bounds_least, bounds_most]) = (found.spreads, bounds.spreads);
            let reaches = found.reach <= bounds.reach && found.far <= bounds.far;
            reaches && bounds_least <= least && most <= bounds_most
        };
        let is_bounded = found.radius <= entry.radius
            && is_inside(found.own, entry.own)
            && is_inside(found.parent, entry.parent);
        if is_bounded {
            Ok(())
        } else {
            Err("its splats are beyond the bounds that the table has".to_owned())
        }
    }
}

/// What bounds the splats of a page, without any room.
struct PageBounds {
    radius: f64,
    own: Reach,
    parent: Reach,
}

fn reach_of<'a>(middle: DVec3, balls: impl Iterator<Item = &'a ErrorBall>) -> Reach {
    let none = Reach { reach: 0.0, far: f64::NEG_INFINITY, spreads: [f64::INFINITY, 0.0] };
    let found = balls.fold(none, |found, ball| {
        let distance = middle.distance(ball.center.as_dvec3());
        let (radius, spread) = (f64::from(ball.radius), f64::from(ball.spread));
        let [least, most] = found.spreads;
        Reach {
            reach: found.reach.max(distance + radius),
            far: found.far.max(distance - radius),
            spreads: [least.min(spread), most.max(spread)],
        }
    });
    if found.far == f64::NEG_INFINITY { Reach::NONE } else { found }
}

fn is_ball(ball: &ErrorBall) -> bool {
    let is_length = |length: f32| length >= 0.0 && length.is_finite();
    ball.center.is_finite() && is_length(ball.radius) && is_length(ball.spread) && ball.spread > 0.0
}

/// Sizes on the screen fall from a parent to what is below it, see `geometry::hierarchy`: on each path one is drawn.
fn is_within(own: &ErrorBall, parent: &ErrorBall) -> bool {
    let distance = own.center.as_dvec3().distance(parent.center.as_dvec3());
    let fits = distance + f64::from(own.radius) <= f64::from(parent.radius) && own.spread <= parent.spread;
    fits || *parent == ErrorBall::ABOVE_ROOT
}

fn push_ball(out: &mut Out, ball: &ErrorBall) {
    out.vec3(ball.center);
    out.f32(ball.radius);
    out.f32(ball.spread);
}

fn ball(input: &mut In<'_>) -> ErrorBall {
    ErrorBall { center: input.vec3(), radius: input.f32(), spread: input.f32() }
}
