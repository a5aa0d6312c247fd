//! Where a vertex may go, and what that costs.

use glam::DVec3;

use super::{
    around::Around,
    choice::{Candidate, NewPiece, Target},
    collapse::State,
    colored::Fan,
    fit::fit,
    ridges::Kind,
};

impl State<'_> {
    /// The best that a vertex may hope for: what is feasible is asked of few.
    pub fn cheapest(&self, from: u32, around: &Around, most_error: f64) -> Option<Candidate> {
        let most = most_error * most_error;
        let piece = match self.ridges.kinds[from as usize] {
            Kind::Corner => return None,
            Kind::Smooth => None,
            Kind::Ridge { chain, place } => {
                let (vertices, links) = (&self.ridges.chains[chain as usize], &self.links[chain as usize]);
                let (last, next) = (links.last[place as usize], links.next[place as usize]);
                let ends = [vertices[last as usize], vertices[next as usize]];
                let own = &self.quadrics[from as usize];
                if ends.into_iter().all(|to| own.mean_square(self.place(to)) > most) {
                    return None;
                }
                let points: Vec<DVec3> =
                    vertices[last as usize..=next as usize].iter().map(|i| self.place(*i)).collect();
                Some(Box::new(NewPiece { ends, fitted: fit(&points)? }))
            }
        };
        let mut best: Option<Target> = None;
        self.each_target(from, piece.as_deref(), around, most_error, &mut |target| {
            if best.as_ref().is_none_or(|best| target.comes_before(best)) {
                best = Some(target);
            }
        });
        best.map(|best| Candidate { from, best, piece })
    }

    /// Where a vertex may go, the best first.
    pub fn targets(&self, candidate: &Candidate, around: &Around, most_error: f64) -> Vec<Target> {
        let mut targets = Vec::new();
        self.each_target(candidate.from, candidate.piece.as_deref(), around, most_error, &mut |target| {
            targets.push(target);
        });
        targets.sort_unstable_by(|a, b| a.rank.total_cmp(&b.rank).then(a.to.cmp(&b.to)));
        targets
    }

    /// All neighbors to which a vertex may go within a bound on what is off.
    fn each_target(
        &self,
        from: u32,
        piece: Option<&NewPiece>,
        around: &Around,
        most_error: f64,
        then: &mut dyn FnMut(Target),
    ) {
        let own = &self.quadrics[from as usize];
        let curve = piece.map_or(0.0, |piece| piece.fitted.most * piece.fitted.most);
        let colored = self.colored.as_ref().map(|colored| (colored, self.fan(from, piece, around)));
        let mut give = |to: u32| {
            let price = own.mean_square(self.place(to)) + curve;
            if price > most_error * most_error {
                return;
            }
            let mut rank = price + 1e-6 * self.place(from).distance_squared(self.place(to));
            if let Some((colored, fan)) = &colored {
                let Some(colors) = colored.price(self.positions, fan, to, most_error) else { return };
                rank += colors;
            }
            then(Target { rank, price, to });
        };
        match piece {
            Some(piece) => piece.ends.into_iter().for_each(give),
            None => {
                // On no ridge, so at no border: each neighbor comes next after it in one of its triangles.
                for triangle in around.of_vertex(from) {
                    let [a, b, c] = self.triangles[*triangle as usize];
                    give(if a == from {
                        b
                    } else if b == from {
                        c
                    } else {
                        a
                    });
                }
            }
        }
    }

    /// The triangles around a vertex; `piece`: of the ridge within which it lies.
    pub fn fan(&self, vertex: u32, piece: Option<&NewPiece>, around: &Around) -> Fan {
        Fan::of(vertex, around.of_vertex(vertex), &self.triangles, piece.map(|piece| piece.ends))
    }
}
