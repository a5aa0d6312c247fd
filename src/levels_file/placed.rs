//! A file that stands in a scene: moved, turned, scaled and colored there. Its header, table and pages are read as if it had been written so.
//!
//! What tells whether a splat is drawn are lengths: those of its ball, and how far that is from the eye. A map makes none of them longer than by its
//! largest stretch, so balls that grow by that still lie within one another, and none is smaller on the screen than what it stands for. Under a map that
//! stretches alike in all directions they are exact, under another one what is drawn is finer than it must be.

use glam::{DAffine3, DMat3, DVec3};

use super::{
    header::{Header, LARGEST},
    page::Page,
    table::{PageEntry, Reach},
};
use crate::{
    geometry::eigen,
    scene::{Bounds, Colors, ErrorBall, is_similarity},
};

/// By which part of itself a stretch is larger than what is found of it.
const ROOM: f64 = 1e-9;

/// How an object of a file stands in a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// From the file's coordinates to the world's; invertible.
    pub world_from_file: DAffine3,
    /// Replaces its own colors: linear, 0 to 1.
    pub color: Option<[f32; 3]>,
    /// Multiplies its own alpha: 0 to 1.
    pub alpha: f32,
}

impl Default for Placed {
    /// As it was written.
    fn default() -> Self {
        Self { world_from_file: DAffine3::IDENTITY, color: None, alpha: 1.0 }
    }
}

/// What turns pages of a file into those of the scene.
#[derive(Debug)]
pub(super) struct Placing {
    placed: Placed,
    stretch: f64,
    /// The one color that all splats get.
    color: Option<[f32; 4]>,
    /// As they were written: what pages are read and checked by.
    pub header: Header,
    pub pages: Vec<PageEntry>,
}

impl Placing {
    /// That of a file with this header and table, and what both are in the scene.
    ///
    /// # Errors
    /// What is wrong, in words: a place beyond what numbers are for.
    pub fn new(
        placed: &Placed,
        header: Header,
        pages: Vec<PageEntry>,
    ) -> Result<(Self, Header, Vec<PageEntry>), String> {
        let map = placed.world_from_file;
        let stretch = stretch(&map.matrix3);
        let header_there = header_in_scene(&header, placed, stretch);
        header_there
            .check_places()
            .map_err(|_| format!("placed farther out than {LARGEST:e}, where coordinates end"))?;
        let there = pages.iter().map(|page| entry_in_scene(page, &map, stretch, header.origin)).collect();
        let placed = placed.clone();
        Ok((Self { placed, stretch, color: header_there.color, header, pages }, header_there, there))
    }

    /// How the file stands.
    pub fn placed(&self) -> &Placed {
        &self.placed
    }

    /// A page as it is in the scene.
    ///
    /// # Errors
    /// What is wrong, in words: a splat that is too small or too large there.
    pub fn page(&self, page: Page) -> Result<Page, String> {
        let Placed { world_from_file, color, alpha } = &self.placed;
        let ball = |ball: ErrorBall| ErrorBall {
            center: (world_from_file.matrix3 * ball.center.as_dvec3()).as_vec3(),
            radius: (self.stretch * f64::from(ball.radius)) as f32,
            spread: (self.stretch * f64::from(ball.spread)) as f32,
        };
        let count = page.splats.len();
        let mut splats = page.splats;
        if *world_from_file != DAffine3::IDENTITY {
            splats = splats.transformed(world_from_file);
        }
        splats.colors.tint(*color, *alpha);
        // Pages of one file have their colors alike.
        splats.colors = match (self.color, splats.colors) {
            (Some(color), _) => Colors::Uniform(color),
            (None, Colors::Uniform(color)) => Colors::Each(vec![color; count]),
            (None, each) => each,
        };
        if let Some(i) = (0..count).find(|i| splats.defect(*i).is_some()) {
            return Err(format!(
                "splat {i} can't be drawn where the object is placed: it is too small or too large"
            ));
        }
        let balls = page.balls.into_iter().map(ball).collect();
        let own = page.own.into_iter().map(|(own, weight)| (ball(own), weight)).collect();
        Ok(Page { splats, balls, own, ..page })
    }
}

/// No length becomes longer than by this under a matrix.
fn stretch(matrix: &DMat3) -> f64 {
    let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let longest = columns.iter().map(|column| column.abs().max_element()).fold(0.0, f64::max);
    // So that squares neither overflow nor vanish.
    let unit = DMat3::from_cols_array(&matrix.to_cols_array().map(|part| part / longest));
    let ([.., most], _) = eigen(&(unit.transpose() * unit));
    longest * most.sqrt() * (1.0 + ROOM)
}

fn header_in_scene(header: &Header, placed: &Placed, stretch: f64) -> Header {
    let Placed { world_from_file: map, color, alpha } = placed;
    let [least, most] = header.bounds;
    let corners = (0..8).map(|corner| {
        let from = |axis: usize| if corner >> axis & 1 == 0 { least[axis] } else { most[axis] };
        Bounds::of_ball(map.transform_point3(DVec3::new(from(0), from(1), from(2))), 0.0)
    });
    let bounds = corners.reduce(Bounds::union).map_or(header.bounds, |bounds| [bounds.min, bounds.max]);
    // What is opaque, or has one color, gets one; else alphas differ.
    let one = match (header.color, color) {
        (Some([.., own]), Some([red, green, blue])) => Some([*red, *green, *blue, own * alpha]),
        (Some([red, green, blue, own]), None) => Some([red, green, blue, own * alpha]),
        (None, Some([red, green, blue])) if !header.transparent => Some([*red, *green, *blue, *alpha]),
        (None, _) if *alpha == 0.0 => Some([0.0; 4]),
        (None, _) => None,
    };
    Header {
        ellipses: header.ellipses || !is_similarity(map),
        transparent: header.transparent || *alpha < 1.0,
        color: one,
        origin: map.transform_point3(header.origin),
        bounds,
        radius: stretch * header.radius,
        root_radius: stretch * header.root_radius,
        up: header.up.and_then(|up| map.transform_vector3(up).try_normalize()),
        ..header.clone()
    }
}

/// `origin`: that of the file, from which balls are counted.
fn entry_in_scene(page: &PageEntry, map: &DAffine3, stretch: f64, origin: DVec3) -> PageEntry {
    let from_origin = page.center.distance(origin);
    let reach = |reach: &Reach| {
        // Centers of balls are rounded once more.
        let rounding = f64::from(f32::EPSILON) * stretch * (from_origin + reach.reach);
        Reach {
            reach: stretch * reach.reach + rounding,
            far: stretch * reach.far + rounding,
            spreads: reach.spreads.map(|spread| stretch * spread),
        }
    };
    PageEntry {
        center: map.transform_point3(page.center),
        radius: stretch * page.radius,
        own: reach(&page.own),
        parent: reach(&page.parent),
        ..page.clone()
    }
}
