//! Splats in levels of detail, each of which decides alone whether it is drawn (Pajarola, Sainz, Guidotti 2003, section 5.1):
//! `geometry::hierarchy` makes them, and says why of a node and what is below it exactly one is drawn.

use glam::{DVec3, Vec3};

use super::{Opacity, Splats};

/// From which size on the screen a node's own follows, and never less than a child's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorBall {
    /// The middle of the ball, from the hierarchy's origin.
    pub center: Vec3,
    /// Of the ball around the node's ellipse, all disks below and the children's balls.
    pub radius: f32,
    /// How far what is below spreads: the root of the mean squared distance of the disks' centers from the node's, by area, times 1 where all has one normal
    /// and one color, up to 2 where these differ; or a quarter of the node's longer half axis, or what a child has, if that is more. Above those of the
    /// children, and above 0.
    pub spread: f32,
}

impl ErrorBall {
    /// Of a splat of the input: of size 0 wherever it is seen from.
    pub const LEAF: Self = Self { center: Vec3::ZERO, radius: 0.0, spread: 0.0 };

    /// Of the root's parent: larger than any screen.
    pub const ABOVE_ROOT: Self = Self { center: Vec3::ZERO, radius: 0.0, spread: f32::INFINITY };
}

/// An object in levels of detail, or as much of it as some view needs. What a frame may draw of it is drawn if and only if its own size on
/// the screen is at most τ, and its parent's above τ. No splat has a defect.
#[derive(Clone, Debug)]
pub struct LeveledObject {
    /// Shown in messages: the file's name.
    pub name: String,
    /// As [`super::Object::closed`].
    pub closed: bool,
    /// Of the whole object.
    pub opacity: Opacity,
    /// The sum of weights that the whole object's own splats leave on its surface, in the mean; above 0.
    pub overlap: f64,
    /// From where balls are counted, in world space.
    pub origin: DVec3,
    /// The radius of the root's ball.
    pub radius: f64,
    /// The balls of parents, and of nodes.
    pub balls: Vec<ErrorBall>,
    /// The object's own splats, neighbors in space one after the other.
    pub leaves: Splats,
    /// The number of each one's parent's ball.
    pub leaf_parents: Vec<u32>,
    /// One over each one's overlap, where it is known from all of the object's splats.
    pub inverse_overlaps: Option<Vec<f32>>,
    /// Splats that stand for others, alike.
    pub nodes: Splats,
    /// The numbers of each one's own ball and its parent's.
    pub node_balls: Vec<NodeBalls>,
    /// What each node weighs: the area of the disks below over its own.
    pub weights: Vec<f32>,
}

/// The numbers of a node's balls in [`LeveledObject::balls`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NodeBalls {
    /// Its own.
    pub own: u32,
    /// Its parent's.
    pub parent: u32,
}
