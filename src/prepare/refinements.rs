//! What is drawn more where the children of a node are drawn in its place: by that a host tells how many splats some size leaves, without looking
//! at each of them.

use glam::{DVec3, Vec3};

use crate::scene::{ErrorBall, LeveledObject, Opacity, Shapes, Splats};

/// A node, as one that is drawn, and as one whose children are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refinement {
    /// The node's ball; its spread is infinite where the child is the root.
    pub ball: ErrorBall,
    /// The number of its parent, of a node that is there.
    pub parent: u32,
    /// The node itself: none, where it is not there.
    pub own: Group,
    /// Its children that are the object's own splats.
    pub leaves: Group,
}

/// Splats at a node's place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Group {
    /// How many.
    pub count: u8,
    /// The mean of their unit normals, in 127ths.
    pub normal: [i8; 3],
    /// The mean of their larger half axes.
    pub half_axis: f32,
}

/// Those of an object.
#[derive(Clone, Debug)]
pub struct Refinements {
    /// From where balls are counted, in world space.
    pub origin: DVec3,
    /// The surface is closed, and opaque.
    pub solid: bool,
    /// One a ball.
    pub all: Vec<Refinement>,
}

/// Sums over splats.
#[derive(Clone, Copy, Default)]
struct Sum {
    count: u32,
    normal: Vec3,
    half_axes: f32,
}

impl Sum {
    fn add(&mut self, splats: &Splats, i: usize) {
        self.count += 1;
        self.normal += normal(splats, i);
        self.half_axes += splats.major_radius(i) as f32;
    }

    fn group(&self) -> Group {
        let count = self.count.max(1) as f32;
        let normal = (self.normal / count * 127.0).to_array().map(|x| x.round() as i8);
        Group { count: self.count.min(255) as u8, normal, half_axis: self.half_axes / count }
    }
}

impl Refinements {
    /// Those of an object, of which some may not be there.
    pub fn of(object: &LeveledObject) -> Self {
        let mut leaves = vec![Sum::default(); object.balls.len()];
        for (i, parent) in object.leaf_parents.iter().enumerate() {
            leaves[*parent as usize].add(&object.leaves, i);
        }
        let of = |(ball, leaves): (&ErrorBall, Sum)| Refinement {
            ball: *ball,
            parent: 0,
            own: Group::default(),
            leaves: leaves.group(),
        };
        let mut all: Vec<_> = object.balls.iter().zip(leaves).map(of).collect();
        for (i, node) in object.node_balls.iter().enumerate() {
            let mut own = Sum::default();
            own.add(&object.nodes, i);
            all[node.own as usize] =
                Refinement { parent: node.parent, own: own.group(), ..all[node.own as usize] };
        }
        Self { origin: object.origin, solid: object.closed && object.opacity == Opacity::Opaque, all }
    }
}

fn normal(splats: &Splats, i: usize) -> Vec3 {
    match &splats.shapes {
        Shapes::Disks { normals, .. } => normals[i].normalize_or_zero(),
        Shapes::Ellipses { s, t } => {
            s[i].normalize_or_zero().cross(t[i].normalize_or_zero()).normalize_or_zero()
        }
    }
}
