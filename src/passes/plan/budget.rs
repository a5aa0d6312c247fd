//! The size τ of levels of detail for which a frame draws no more splats than it may, and nearly as many.
//!
//! A node is drawn from its own size on up to its parent's, and a splat of the object below its parent's: so how many are drawn for a size is a sum over those that are larger.
//! The largest are the first to have their children drawn: what is drawn for a budget leaves the least error that any choice by size leaves, and is
//! drawn for each larger one, or what is below it. Sizes are all that a device needs to choose the same, and change with the camera as distances do.
//!
//! Nodes count where they are in the view and face the eye, as a device finds it. Splats of the object count by the mean normal and the mean radius of
//! those that share a parent: for to look at each would take as long as to draw it. Of those at a silhouette a part faces the eye: normals whose mean is m differ from it along a ray by
//! √((1 − |m|²) / 2), if they do as much in each direction, and as many of them face the eye as of a uniform distribution that wide. What that leaves of doubt [`SHARE`] keeps free.

use std::borrow::Cow;

use glam::{DVec3, DVec4};

use crate::{
    arena::{Arena, ArenaVec},
    inline_vec::InlineVec,
    passes::plan::planes::if_they_cut,
    prepare::{Chunk, Group, Placed, Refinements},
    scene::{Budget, Camera, ErrorBall, Filter, LeveledObject, Lod, MOST_PLANES, Settings, ViewFromWorld},
};

/// The part of a budget that is given out. Of 74 pairs of a view and a budget 98.6 to 99.8% was filled (`benches/README.md`).
const SHARE: f64 = 0.992;

/// Parts of a splat that are counted: of as many as a group may have there is room in 16 bits.
const PARTS: i16 = 64;

/// What a device finds in f32 of a size may be less than this file's f64 by so much of it.
const RESERVE: f64 = 1e-5;

/// The settings with the size for their budget in the place of [`Settings::lod`], where they have one and something has levels of detail.
pub(crate) fn within_budget<'s>(
    arena: &Arena,
    scenes: &[Placed<'_>],
    camera: &Camera,
    settings: &'s Settings,
) -> Cow<'s, Settings> {
    let Budget::Splats(most) = settings.budget else { return Cow::Borrowed(settings) };
    if scenes.iter().all(|placed| placed.scene.refinements.is_empty()) {
        return Cow::Borrowed(settings);
    }
    let without = |chunk: &&Chunk| chunk.levels.is_none();
    let others = scenes.iter().flat_map(|placed| placed.scene.chunks.iter().filter(without));
    let others: u64 = others.map(|chunk| u64::from(chunk.count)).sum();
    let most = (SHARE * f64::from(most)) as i64 - others as i64;
    let asked_px = settings.tau_px();
    let mut counted = Counted { arena, nodes: arena.growing() };
    let cut = &*if_they_cut(scenes, settings);
    for Placed { scene, at, .. } in scenes {
        let planes = cut.clip().into_iter().map(|plane| at.plane(plane)).collect();
        counted.add(&scene.refinements, (&at.camera(camera), planes), cut);
    }
    let tau_px = counted.tau_px(most).max(asked_px);
    Cow::Owned(Settings { lod: Lod::Px(tau_px), ..settings.clone() })
}

/// How many splats a frame draws of objects for a size, as a budget counts them.
pub fn count_drawn(objects: &[LeveledObject], camera: &Camera, settings: &Settings, tau_px: f64) -> u64 {
    let refinements: Vec<Refinements> = objects.iter().map(Refinements::of).collect();
    let arena = Arena::new();
    let mut counted = Counted { arena: &arena, nodes: arena.growing() };
    counted.add(&refinements, (camera, settings.clip()), settings);
    counted.count(tau_px).max(0) as u64
}

/// What is drawn more below a size on the screen. By one thread, in a frame's memory: a pool of threads takes some from the heap.
struct Counted<'m> {
    arena: &'m Arena,
    /// The size in pixels, and how many [`PARTS`] of splats are more.
    nodes: ArenaVec<'m, (f32, i16)>,
}

impl Counted<'_> {
    /// Adds those that a camera sees of objects that planes cut, both in the objects' space.
    fn add(&mut self, objects: &[Refinements], (camera, planes): (&Camera, Planes), settings: &Settings) {
        let blended_size = settings.blended_size() as f32;
        for object in objects {
            let view = View::new(object, (camera, planes), settings);
            let sizes_px = self.arena.list(object.all.iter().map(|node| view.size_px(&node.ball)));
            self.nodes.reserve(2 * object.all.len());
            for (node, size_px) in object.all.iter().zip(sizes_px) {
                let [own, leaves] = [&node.own, &node.leaves].map(|group| view.seen(&node.ball, group));
                if own > 0 {
                    self.nodes.push((sizes_px[node.parent as usize], own));
                }
                // Where nodes blend, one is drawn while the next are.
                let blends = blended_size > 1.0;
                let of_leaves = if blends { leaves } else { leaves - own };
                if of_leaves != 0 {
                    self.nodes.push((*size_px, of_leaves));
                }
                if blends && own > 0 {
                    self.nodes.push((size_px / blended_size, -own));
                }
            }
        }
    }

    /// How many splats are drawn for a size.
    fn count(&self, tau_px: f64) -> i64 {
        let drawn = self.nodes.iter().filter(|(size_px, _)| f64::from(*size_px) > tau_px);
        drawn.map(|(_, more)| i64::from(*more)).sum::<i64>() / i64::from(PARTS)
    }

    /// The least size for which no more than so many splats are drawn; more than all where even the roots are more.
    fn tau_px(mut self, most: i64) -> f64 {
        // From the largest on; a part of them after the other, as few as needed are sorted.
        let mut left = i64::from(PARTS) * most;
        let mut nodes = self.nodes.as_mut_slice();
        while nodes.len() > 1 {
            let middle = nodes.len() / 2;
            nodes.select_nth_unstable_by(middle, |a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            let (larger, smaller) = nodes.split_at_mut(middle);
            let more: i64 = larger.iter().map(|(_, more)| i64::from(*more)).sum();
            if more <= left {
                left -= more;
                nodes = smaller;
            } else {
                nodes = larger;
            }
        }
        match nodes {
            // Everything may be drawn but this one's children, or all.
            [(size_px, more)] if i64::from(*more) > left => f64::from(*size_px) * (1.0 + RESERVE),
            _ => 0.0,
        }
    }
}

/// Planes that cut an object, in its space.
type Planes = InlineVec<DVec4, MOST_PLANES>;

/// A camera, as an object is seen.
struct View {
    view: ViewFromWorld,
    forward: DVec3,
    focal_px: f64,
    near: f64,
    is_orthographic: bool,
    culls: bool,
    planes: Planes,
    filter_px: f64,
    /// Of the picture from where the axis meets it: left and top, right and bottom.
    edges_px: [[f64; 2]; 2],
    origin: DVec3,
}

impl View {
    fn new(object: &Refinements, (camera, planes): (&Camera, Planes), settings: &Settings) -> Self {
        let middle_px = camera.middle_px(settings.size_px);
        let edges_px = [0, 1].map(|i| [-middle_px[i], f64::from(settings.size_px[i]) - middle_px[i]]);
        Self {
            view: camera.view_from_world(),
            forward: camera.forward(),
            focal_px: camera.focal_px(settings.size_px[1]),
            near: camera.near(),
            is_orthographic: camera.is_orthographic(),
            culls: settings.culls(object.solid),
            planes,
            filter_px: if settings.filter == Filter::None {
                0.0
            } else {
                settings.samples.filter_radius_px()
            },
            edges_px,
            origin: object.origin,
        }
    }

    fn place(&self, ball: &ErrorBall) -> DVec3 {
        self.origin + ball.center.as_dvec3()
    }

    /// As a device finds it (`glsl/inc/levels.glsl`).
    fn size_px(&self, ball: &ErrorBall) -> f32 {
        let spread_px = self.focal_px * f64::from(ball.spread);
        if self.is_orthographic || ball.spread.is_infinite() {
            return spread_px as f32;
        }
        let distance = self.place(ball).distance(self.view.eye) - f64::from(ball.radius);
        (spread_px / distance.max(self.near)) as f32
    }

    /// How many [`PARTS`] of a group a device would draw.
    fn seen(&self, ball: &ErrorBall, group: &Group) -> i16 {
        let count = PARTS * i16::from(group.count);
        if count == 0 || ball.spread.is_infinite() {
            return count;
        }
        let place = self.place(ball);
        let facing = if self.culls { self.facing(place, group) } else { 1.0 };
        let is_seen = || {
            let p = self.view.point(place);
            self.is_inside(p, group.half_axis) && !self.is_cut_off(place, p.z, group.half_axis)
        };
        if facing > 0.0 && is_seen() { (f64::from(count) * facing).round() as i16 } else { 0 }
    }

    /// Which part of a group faces the eye.
    fn facing(&self, place: DVec3, group: &Group) -> f64 {
        let ray = if self.is_orthographic { self.forward } else { place - self.view.eye };
        // In 127ths.
        let mean = DVec3::from(group.normal.map(f64::from));
        let toward = -ray.dot(mean);
        let is_facing = f64::from(u8::from(toward >= 0.0));
        if group.count == 1 {
            return is_facing;
        }
        // A uniform distribution is as wide to each side as this.
        let square = (127.0_f64.powi(2) - mean.length_squared()).max(0.0);
        let half = (1.5 * square * ray.length_squared()).sqrt();
        if toward.abs() < half { 0.5 + 0.5 * toward / half } else { is_facing }
    }

    /// As a device finds it of splats (`glsl/mark_visible.comp.glsl`): beyond a plane by so much that nothing of it is left.
    fn is_cut_off(&self, place: DVec3, z: f64, half_axis: f32) -> bool {
        let reach = 2.0 * f64::from(half_axis);
        let in_front = self.is_orthographic || reach <= 0.25 * z;
        let px = if self.is_orthographic { self.focal_px } else { self.focal_px / z };
        let beyond = |plane: &DVec4| (plane.truncate().dot(place) + plane.w) * px < -2.0 * reach * px - 16.0;
        in_front && self.planes.iter().any(beyond)
    }

    /// As a device finds it of splats (`glsl/mark_visible.comp.glsl`).
    fn is_inside(&self, p: DVec3, half_axis: f32) -> bool {
        let reach = 2.0 * f64::from(half_axis);
        let near = if self.is_orthographic { 0.0 } else { self.near };
        if p.z + reach < near {
            return false;
        }
        if !self.is_orthographic && reach > 0.25 * p.z {
            return true;
        }
        [(p.x, self.edges_px[0]), (p.y, self.edges_px[1])].into_iter().all(|(side, edges_px)| {
            let (c, away) = match self.is_orthographic {
                true => (side, reach),
                false => (side / p.z, reach / p.z * (1.0 + (side / p.z).abs())),
            };
            let (c_px, away_px) = (c * self.focal_px, away * self.focal_px + 2.0 * self.filter_px);
            c_px >= edges_px[0] - away_px && c_px <= edges_px[1] + away_px
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{load::builtin, prepare::prepare_without_device, scene::Scene, vk::Limits};

    /// On a way toward a model in steps of 0.25% a budget is kept and filled, and what is drawn changes little: by the size of the step before about as many
    /// would be drawn. Sizes themselves leap where few nodes have one. They are the smaller the more may be drawn.
    #[test]
    fn what_is_drawn_changes_as_little_as_the_camera_and_sizes_fall_as_budgets_grow() {
        let scene =
            Scene { objects: vec![builtin::relief(60_000)], levels: true, budget: true, ..Scene::default() };
        let prepared = prepare_without_device(&Limits::plain(), &scene).unwrap();
        let ball = scene.ball().unwrap();
        let size_px = [512; 2];
        let mut camera = Camera::fit(&ball, size_px, Camera::DEFAULT_FOV_Y_RAD);
        let budgets = [1_000, 4_000, 16_000];
        let mut last_px = [0.0; 3];
        let mut most_change: f64 = 0.0;
        for round in 0..100 {
            let mut sizes_px = [0.0; 3];
            for (i, most) in budgets.into_iter().enumerate() {
                let settings = Settings { size_px, budget: Budget::Splats(most), ..Settings::default() };
                let arena = Arena::new();
                let mut counted = Counted { arena: &arena, nodes: arena.growing() };
                counted.add(&prepared.refinements, (&camera, settings.clip()), &settings);
                sizes_px[i] =
                    within_budget(&arena, &[Placed::at_home(&prepared)], &camera, &settings).tau_px();
                let drawn = counted.count(sizes_px[i]) as f64 / f64::from(most);
                // Near to it there are not so many.
                assert!(drawn <= 1.0 && (drawn >= 0.98 || sizes_px[i] == 0.0), "{drawn} of {most}");
                if round > 0 {
                    most_change =
                        most_change.max((counted.count(last_px[i]) as f64 / f64::from(most) - drawn).abs());
                }
            }
            assert!(sizes_px[0] > sizes_px[1] && sizes_px[1] > sizes_px[2], "{sizes_px:?}");
            last_px = sizes_px;
            camera.eye = ball.center + 0.9975 * (camera.eye - ball.center);
        }
        println!("{most_change} of a budget changes in a step at most");
        assert!(most_change < 0.05, "{most_change}");
        let settings = Settings { budget: Budget::Splats(10_000_000), ..Settings::default() };
        let within = within_budget(&Arena::new(), &[Placed::at_home(&prepared)], &camera, &settings).tau_px();
        assert_eq!(within, 0.0);
    }
}
