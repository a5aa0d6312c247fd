//! What the last frames have cost, and each of their passes.

use std::collections::VecDeque;

use super::picture::Cost;

/// Frames in the history.
const MOST_FRAMES: usize = 120;

/// Milliseconds, the latest last.
pub type Times = VecDeque<f32>;

/// What the last frames have cost.
#[derive(Default)]
pub struct History {
    /// Of a frame.
    pub frames: Times,
    passes: Vec<Pass>,
    timed: u64,
}

/// What a pass has cost in the frames that had it.
struct Pass {
    name: String,
    times: Times,
    /// The frame that had it last.
    last: u64,
}

impl History {
    /// One frame more.
    pub fn push(&mut self, cost: &Cost) {
        push(&mut self.frames, cost.secs);
        let passes = cost.profile.passes.iter().filter_map(|pass| Some((pass.name.as_str(), pass.secs?)));
        self.push_passes(passes);
    }

    /// The same of passes by their names, in seconds; of none, nothing changes.
    pub fn push_passes<'p>(&mut self, passes: impl Iterator<Item = (&'p str, f64)>) {
        let mut passes = passes.peekable();
        if passes.peek().is_none() {
            return;
        }
        self.timed += 1;
        let mut before = std::mem::take(&mut self.passes);
        for (name, secs) in passes {
            let known = before.iter().position(|pass| pass.name == name).map(|place| before.remove(place));
            let mut pass =
                known.unwrap_or_else(|| Pass { name: name.to_owned(), times: Times::new(), last: 0 });
            push(&mut pass.times, secs);
            pass.last = self.timed;
            self.passes.push(pass);
        }
        // Pictures that move and those at rest take turns.
        before.retain(|pass| pass.last + MOST_FRAMES as u64 > self.timed);
        self.passes.append(&mut before);
    }

    /// The passes of the last frame whose passes were timed, in its order.
    pub fn passes(&self) -> impl Iterator<Item = (&str, &Times)> {
        let now = self.passes.iter().filter(|pass| pass.last == self.timed);
        now.map(|pass| (pass.name.as_str(), &pass.times))
    }
}

fn push(times: &mut Times, secs: f64) {
    times.push_back(1e3 * secs as f32);
    while times.len() > MOST_FRAMES {
        times.pop_front();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(history: &History) -> Vec<(&str, Vec<f32>)> {
        history.passes().map(|(name, times)| (name, times.iter().copied().collect())).collect()
    }

    #[test]
    fn each_pass_of_the_last_frame_has_its_times_in_those_before() {
        let mut history = History::default();
        history.push_passes([("a", 0.001), ("b", 0.002)].into_iter());
        history.push_passes([("c", 0.003), ("a", 0.004)].into_iter());
        assert_eq!(shown(&history), [("c", vec![3.0]), ("a", vec![1.0, 4.0])]);
        // Frames whose passes are not timed change nothing.
        history.push_passes([].into_iter());
        history.push_passes([("b", 0.005)].into_iter());
        assert_eq!(shown(&history), [("b", vec![2.0, 5.0])]);
        for _ in 0..MOST_FRAMES {
            history.push_passes([("d", 0.001)].into_iter());
        }
        assert_eq!((history.passes.len(), shown(&history)[0].1.len()), (1, MOST_FRAMES));
    }
}
