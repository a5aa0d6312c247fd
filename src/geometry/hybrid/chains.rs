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
    /// Where it is.
    pub on: On,
}

/// What of a border a place is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum On {
    /// The edge with this number.
    Edge(usize),
    /// The joint with this number.
    Joint(usize),
}

/// Edges end to end. It ends where other than two transition edges meet, or where it began.
struct Chain {
    /// In the order of walking, with how far it is to each and with the edge before it.
    stops: Vec<Stop>,
}

struct Stop {
    joint: usize,
    /// Along the chain.
    at: f64,
    /// The edge that ends here.
    edge: usize,
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
        let mut places = self.ends();
        for chain in &self.chains {
            let intervals = chain.intervals(spacing);
            let inner = (1..).map(f64::from).take_while(|i| *i < intervals);
            places.extend(inner.map(|i| chain.place(chain.length() * (i / intervals), self.border)));
        }
        places
    }

    /// Places on all edges for splats whose radii vary: neighbors along a chain are at most `spacing` times the smaller one of
    /// their radii apart. Radii are looked at each `step`.
    pub(super) fn places_by(&self, spacing: f64, radius: &dyn Fn(DVec3) -> f64, step: f64) -> Vec<Place> {
        let mut places = self.ends();
        for chain in &self.chains {
            let steps = chain.intervals(step);
            let at = |i: f64| chain.length() * (i / steps);
            let radius = |at: f64| radius(chain.place(at, self.border).position);
            // How many radii it is to each step.
            let mut far = vec![0.0];
            for i in (0..).map(f64::from).take_while(|i| *i < steps) {
                far.push(far[far.len() - 1] + (at(i + 1.0) - at(i)) / radius(at(i + 0.5)));
            }
            let all = far[far.len() - 1];
            let mut intervals = (all / spacing).ceil().max(chain.least_intervals());
            let stops = loop {
                let stop = |i: f64| {
                    let after =
                        far.partition_point(|far| *far < all * (i / intervals)).clamp(1, far.len() - 1);
                    let t = (all * (i / intervals) - far[after - 1]) / (far[after] - far[after - 1]);
                    at((after - 1) as f64 + t)
                };
                let mut stops = vec![0.0];
                stops.extend((1..).map(f64::from).take_while(|i| *i < intervals).map(stop));
                stops.push(chain.length());
                let near = |pair: &[f64]| pair[1] - pair[0] <= spacing * radius(pair[0]).min(radius(pair[1]));
                // Where radii vary by a quarter of the distance, seven tenths of the spacing are always near enough.
                if all / intervals < 0.7 * spacing || stops.windows(2).all(near) {
                    break stops;
                }
                intervals = (1.05 * intervals).ceil();
            };
            let inner = &stops[1..stops.len() - 1];
            places.extend(inner.iter().map(|at| chain.place(*at, self.border)));
        }
        places
    }

    /// The places where chains end.
    fn ends(&self) -> Vec<Place> {
        let end = |&(number, face): &(usize, DVec3)| {
            let joint = &self.border.joints[number];
            between((joint, joint), 0.0, face, On::Joint(number))
        };
        self.ends.iter().map(end).collect()
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
        let mut stops = vec![Stop { joint, at: 0.0, edge }];
        let mut at = 0.0;
        let mut next = Some(edge);
        while let Some(edge) = next {
            walked[edge] = true;
            let [a, b] = border.edges[edge].ends;
            let other = if a == joint { b } else { a };
            let [from, to] = [joint, other].map(|joint| border.joints[joint].position);
            at += from.distance(to);
            joint = other;
            stops.push(Stop { joint, at, edge });
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
        (self.length() / spacing).ceil().max(self.least_intervals())
    }

    fn least_intervals(&self) -> f64 {
        let closed = self.stops.first().map(|stop| stop.joint) == self.stops.last().map(|stop| stop.joint);
        if closed { 2.0 } else { 1.0 }
    }

    /// What is so far along the chain.
    fn place(&self, at: f64, border: &Border) -> Place {
        let after = self.stops.partition_point(|stop| stop.at < at).clamp(1, self.stops.len() - 1);
        let (from, to) = (&self.stops[after - 1], &self.stops[after]);
        let [a, b] = [from, to].map(|stop| &border.joints[stop.joint]);
        let t = ((at - from.at) / (to.at - from.at)).clamp(0.0, 1.0);
        between((a, b), t, border.edges[to.edge].face, On::Edge(to.edge))
    }
}

/// At the fraction `t` of the way from one joint to another.
fn between((a, b): (&Joint, &Joint), t: f64, face: DVec3, on: On) -> Place {
    let normal = a.normal.lerp(b.normal, t);
    let normal = if normal.length() > SHORTEST_NORMAL { normal.normalize() } else { face };
    let color = std::array::from_fn(|channel| a.color[channel] + t * (b.color[channel] - a.color[channel]));
    Place { position: a.position.lerp(b.position, t), normal, color, on }
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
