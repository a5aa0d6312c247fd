//! A page: splats in columns, with the balls of their parents in a list of their own.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::{
    bytes::{In, Out},
    header::Header,
    table::PageEntry,
};
use crate::scene::{Bounds, Colors, ErrorBall, Shapes, Splats};

/// The largest part of its radius by which 32-bit positions may move a splat; otherwise positions have 64 bits.
const MOST_SHIFT: f64 = 1.0 / (1 << 14) as f64;

/// Bytes of a ball.
const BALL_BYTES: usize = 20;

/// One over an overlap is in steps of this, as on a device.
const OVERLAP_STEP: f32 = 1.0 / (1 << 14) as f32;

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
    /// Of other splats: one over the overlap of each (`geometry::Overlaps`).
    pub inverse_overlaps: Vec<f32>,
}

/// What a page tells of its splats by what they are.
pub(super) enum Told {
    /// Nodes: their own balls, and what they weigh.
    Nodes(Vec<(ErrorBall, f32)>),
    /// The object's own: one over the overlap of each.
    Splats(Vec<f32>),
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
        let told = if nodes { BALL_BYTES + 4 } else { 2 };
        position + shape + color + told + 2
    }

    /// Bytes of a page.
    pub fn bytes(&self, entry: &PageEntry) -> u64 {
        let each = self.splat_bytes(entry.nodes, entry.wide) as u64;
        u64::from(entry.count) * each + u64::from(entry.balls) * BALL_BYTES as u64
    }
}

impl Page {
    /// Of splats, and the numbers of their parents, each of which has its ball.
    pub fn of(
        splats: Splats,
        parents: impl Iterator<Item = u32>,
        ball: impl Fn(u32) -> ErrorBall,
        told: Told,
    ) -> Self {
        let (mut numbers, mut balls) = (HashMap::new(), Vec::new());
        let mut number = |parent: u32| {
            *numbers.entry(parent).or_insert_with(|| {
                balls.push(ball(parent));
                balls.len() as u32 - 1
            })
        };
        let parents = parents.map(&mut number).collect();
        let (own, inverse_overlaps) = match told {
            Told::Nodes(own) => (own, Vec::new()),
            Told::Splats(inverse) => (Vec::new(), inverse),
        };
        Self { nodes: !own.is_empty(), splats, parents, balls, own, inverse_overlaps }
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
        for inverse in &self.inverse_overlaps {
            // The cast saturates.
            out.0.extend(((inverse / OVERLAP_STEP).round() as u16).max(1).to_le_bytes());
        }
        self.parents.iter().for_each(|parent| out.0.extend((*parent as u16).to_le_bytes()));
        self.balls.iter().for_each(|ball| push_ball(&mut out, ball));
        let entry = self.entry(form, center, wide, &out.0);
        (out.0, entry)
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
        let (nodes, others) = if entry.nodes { (count, 0) } else { (0, count) };
        let own = (0..nodes).map(|_| own(&mut input)).collect();
        let inverse_overlaps = (0..others).map(|_| OVERLAP_STEP * f32::from(input.u16())).collect();
        let parents = (0..count).map(|_| input.u16().into()).collect();
        let balls = (0..entry.balls).map(|_| ball(&mut input)).collect();
        let splats = Splats::new(positions, shapes, colors);
        let page = Self { nodes: entry.nodes, splats, parents, balls, own, inverse_overlaps };
        page.check(entry, form).map(|()| page)
    }
}

fn push_ball(out: &mut Out, ball: &ErrorBall) {
    out.vec3(ball.center);
    out.f32(ball.radius);
    out.f32(ball.spread);
}

fn ball(input: &mut In<'_>) -> ErrorBall {
    ErrorBall { center: input.vec3(), radius: input.f32(), spread: input.f32() }
}
