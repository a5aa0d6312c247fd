//! Transition edges hang together in chains, along which places are spread evenly.
//!
//! A mesh may be finer than its splats. Places on every edge with both of its ends would then be far too many; along a
//! whole chain they are as far apart as wanted, whatever the edges' lengths.

use glam::DVec3;

use super::border::{Border, Joint};
use crate::geometry::resample::SHORTEST_NORMAL;

/// A place on a transition edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub position: DVec3,
    /// Unit; zero only if the face that should stand in for it has none.
    pub normal: DVec3,
    pub color: [f64; 4],
}

/// Edges end to end. It ends where other than two transition edges meet, or where it began.
struct Chain {
    /// In the order of walking, with how far it is to each and with the normal of the edge's face before it.
    stops: Vec<Stop>,
}

struct Stop {
    joint: usize,
    /// Along the chain.
    at: f64,
    /// The normal of the face of the edge that ends here.
    face: DVec3,
}

/// All transition edges as chains.
pub(super) struct Chains<'a> {
    border: &'a Border,
    chains: Vec<Chain>,
    /// Joints where chains end, and the first one of each loop that passes no other; with a face normal.
    ends: Vec<(usize, DVec3)>,
}

impl<'a> Chains<'a> {
    pub(super) fn of(border: &'a Border) -> Self {
        let incident = Incident::of(border);
        let joints = 0..incident.starts.len() - 1;
        let mut walked = vec![false; border.edges.len()];
        let mut chains = Vec::new();
        let mut ends = Vec::new();
        // From all places where chains must end first: what is left then are loops.
        for loops in [false, true] {
            for joint in joints.clone() {
                let edges = incident.edges_of(joint);
                if (edges.len() == 2) != loops {
                    continue;
                }
                let before = chains.len();
                for &edge in edges {
                    if !walked[edge] {
                        chains.push(Chain::walk(joint, edge, border, &incident, &mut walked));
                    }
                }
                if !loops || chains.len() > before {
                    ends.push((joint, border.edges[edges[0]].face));
                }
            }
        }
        Self { border, chains, ends }
    }

    /// The length of all edges, in world units.
    pub(super) fn length(&self) -> f64 {
        self.chains.iter().map(Chain::length).sum()
    }

    /// How many [`Chains::places`] there are, if they can be counted.
    pub(super) fn count(&self, spacing: f64) -> f64 {
        let inner = self.chains.iter().map(|chain| chain.intervals(spacing) - 1.0).sum::<f64>();
        self.ends.len() as f64 + inner
    }

    /// Places on all edges, evenly along each chain and at most `spacing` apart. The chains' ends are among them, each
    /// once.
    pub(super) fn places(&self, spacing: f64) -> Vec<Place> {
        let mut places = Vec::new();
        for &(joint, face) in &self.ends {
            let joint = &self.border.joints[joint];
            places.push(between(joint, joint, 0.0, face));
        }
        for chain in &self.chains {
            let intervals = chain.intervals(spacing);
            let mut stops = chain.stops.windows(2).peekable();
            let mut i = 1.0;
            while i < intervals {
                let at = chain.length() * (i / intervals);
                while stops.peek().is_some_and(|pair| pair[1].at < at) {
                    stops.next();
                }
                let Some([from, to]) = stops.peek() else { break };
                let [a, b] = [from, to].map(|stop| &self.border.joints[stop.joint]);
                let t = ((at - from.at) / (to.at - from.at)).clamp(0.0, 1.0);
                places.push(between(a, b, t, to.face));
                i += 1.0;
            }
        }
        places
    }
}

impl Chain {
    fn walk(
        mut joint: usize,
        edge: usize,
        border: &Border,
        incident: &Incident,
        walked: &mut [bool],
    ) -> Self {
        let mut stops = vec![Stop { joint, at: 0.0, face: border.edges[edge].face }];
        let mut at = 0.0;
        let mut next = Some(edge);
        while let Some(edge) = next {
            walked[edge] = true;
            let [a, b] = border.edges[edge].ends;
            let other = if a == joint { b } else { a };
            let [from, to] = [joint, other].map(|joint| border.joints[joint].position);
            at += from.distance(to);
            joint = other;
            stops.push(Stop { joint, at, face: border.edges[edge].face });
            let onward = incident.edges_of(joint);
            next = onward.iter().copied().find(|&edge| onward.len() == 2 && !walked[edge]);
        }
        Self { stops }
    }

    fn length(&self) -> f64 {
        self.stops.last().map_or(0.0, |stop| stop.at)
    }

    /// Into how many equal parts the chain is cut. Where it ends where it began it is two at least, so that the ends of
    /// each are two places.
    fn intervals(&self, spacing: f64) -> f64 {
        let closed = self.stops.first().map(|stop| stop.joint) == self.stops.last().map(|stop| stop.joint);
        (self.length() / spacing).ceil().max(if closed { 2.0 } else { 1.0 })
    }
}

/// At the fraction `t` of the way from one joint to another.
fn between(a: &Joint, b: &Joint, t: f64, face: DVec3) -> Place {
    let normal = a.normal.lerp(b.normal, t);
    let normal = if normal.length() > SHORTEST_NORMAL { normal.normalize() } else { face };
    let color = std::array::from_fn(|channel| a.color[channel] + t * (b.color[channel] - a.color[channel]));
    Place { position: a.position.lerp(b.position, t), normal, color }
}

/// The edges of each joint.
struct Incident {
    /// Where those of each joint begin in `edges`, and the end.
    starts: Vec<usize>,
    edges: Vec<usize>,
}

impl Incident {
    fn of(border: &Border) -> Self {
        let mut starts = vec![0; border.joints.len() + 1];
        let ends = || border.edges.iter().flat_map(|edge| edge.ends);
        ends().for_each(|joint| starts[joint + 1] += 1);
        for joint in 0..border.joints.len() {
            starts[joint + 1] += starts[joint];
        }
        let mut free = starts.clone();
        let mut edges = vec![0; 2 * border.edges.len()];
        for (end, joint) in ends().enumerate() {
            edges[free[joint]] = end / 2;
            free[joint] += 1;
        }
        Self { starts, edges }
    }

    fn edges_of(&self, joint: usize) -> &[usize] {
        &self.edges[self.starts[joint]..self.starts[joint + 1]]
    }
}
