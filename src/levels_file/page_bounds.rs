//! What bounds a page, and whether it is sound.

use glam::DVec3;

use super::{
    header::LARGEST,
    page::{Form, Page},
    table::{PageEntry, Reach},
};
use crate::scene::ErrorBall;

/// By which part of themselves bounds in the table are larger than what they bound.
const ROOM: f64 = 1e-9;

impl Page {
    /// Its entry of the table, but for its place in the file.
    pub(super) fn entry(&self, form: &Form, center: DVec3, wide: bool, bytes: &[u8]) -> PageEntry {
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

    /// # Errors
    /// What is wrong, in words.
    pub(super) fn check(&self, entry: &PageEntry, form: &Form) -> Result<(), String> {
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
            let Some((own, weight)) = self.own.get(i) else {
                if self.inverse_overlaps[i] > 0.0 {
                    continue;
                }
                return Err(format!("{kind} {i} has an overlap without end"));
            };
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
