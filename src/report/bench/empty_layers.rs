//! The cost of a layer in which nothing is (`--layers auto`): of frames in which the device left layers out, for the one
//! before them was empty.

use serde::Serialize;

use crate::report::{
    FrameSample, Grid, Spread, TimedFrames,
    cells::{interval, median},
};

/// Which layers of a frame the device drew, and what those cost that it left out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EmptyLayers {
    /// Layers for which passes were recorded.
    pub recorded: u32,
    /// Layers that the device drew: those with something in them, and the one that it found empty where some follow.
    pub drawn: u32,
    /// Each kind of pass of a layer, then the layer; empty where none was left out.
    pub passes: Vec<LayerPass>,
}

/// A pass of layers that were left out, beside that of layers with something in them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LayerPass {
    /// The pass without its layer; `layer` for all of them.
    pub name: String,
    /// Milliseconds in a layer that was left out: of each frame their mean.
    pub empty_ms: Option<Spread>,
    /// Milliseconds in a layer with something in it: of each frame their mean.
    pub full_ms: Option<Spread>,
    /// The part of the second that the first is, frame by frame.
    pub share: Option<Spread>,
}

/// The pass of a layer without the layer, and the layer's number from 1 on; `None` for passes of no layer.
fn pass_and_layer(name: &str) -> Option<(&str, u32)> {
    let (pass, number) = match name.strip_prefix("count layer ") {
        Some(number) => ("count", number),
        None => name.split_once(" of layer ")?,
    };
    Some((pass, number.parse().ok()?))
}

/// A kind of pass: where it is in the frame, in layers that were left out and in those with something in them.
struct Kind<'a> {
    name: &'a str,
    empty: Vec<usize>,
    full: Vec<usize>,
}

impl EmptyLayers {
    /// The empty layers of a contestant in layers; `None` for one without, or where nothing was counted.
    pub fn of(timed: &TimedFrames) -> Option<Self> {
        let of_layer = |(i, name)| pass_and_layer(name).map(|(pass, layer)| (i, pass, layer));
        let of_layers: Vec<(usize, &str, u32)> =
            timed.passes.iter().map(String::as_str).enumerate().filter_map(of_layer).collect();
        let recorded = of_layers.iter().map(|(.., layer)| *layer).max()?;
        // Every layer is composed, by a triangle unless it is left out.
        let composed = of_layers.iter().filter(|(_, pass, _)| *pass == "compose");
        let is_drawn = |(i, ..): &(usize, &str, u32)| Some((*timed.counts.get(*i)?)?[0] > 0);
        let drawn: Vec<bool> = composed.map(is_drawn).collect::<Option<_>>()?;
        let drawn = drawn.into_iter().filter(|drawn| *drawn).count() as u32;
        let mut report = Self { recorded, drawn, passes: Vec::new() };
        let Some(full) = report.with_something() else { return Some(report) };
        let mut kinds: Vec<Kind<'_>> = Vec::new();
        for (i, name, layer) in of_layers {
            let known = kinds.iter().position(|kind| kind.name == name);
            let known = known.unwrap_or_else(|| {
                kinds.push(Kind { name, empty: Vec::new(), full: Vec::new() });
                kinds.len() - 1
            });
            match layer {
                layer if layer > drawn => kinds[known].empty.push(i),
                layer if layer <= full => kinds[known].full.push(i),
                _ => {}
            }
        }
        kinds.retain(|kind| !kind.empty.is_empty() && !kind.full.is_empty());
        let frames = timed.rounds.concat();
        let alone = kinds.iter().map(|kind| pass(kind.name, &frames, std::slice::from_ref(kind)));
        report.passes = alone.chain([pass("layer", &frames, &kinds)]).collect();
        Some(report)
    }

    /// How many layers have something in them; `None` where all were drawn: the view may have more, or the device can't
    /// leave any out.
    pub fn with_something(&self) -> Option<u32> {
        (self.drawn < self.recorded).then(|| self.drawn.saturating_sub(1))
    }

    /// How many layers there are, in words.
    pub(super) fn sentence(&self) -> String {
        let Self { recorded, drawn, .. } = self;
        match self.with_something() {
            Some(layers) => format!(
                "the view has {layers} layer(s): of {recorded} allowed the device draws {drawn}, the last of which is empty"
            ),
            None => format!(
                "all of {recorded} allowed layers are drawn: the view has as many or more, or the device can't leave any out"
            ),
        }
    }

    /// The table: the cost of a layer in which nothing is.
    pub(super) fn grid(&self) -> Grid {
        Grid::of("layers: what an empty one costs", &self.passes)
            .column("pass", |pass| pass.name.clone())
            .column("empty ms", |pass| median(pass.empty_ms, 4))
            .column("95% of the median", |pass| interval(pass.empty_ms, 4))
            .column("full ms", |pass| median(pass.full_ms, 3))
            .column("95% of the median", |pass| interval(pass.full_ms, 3))
            .column("empty / full", |pass| median(pass.share, 5))
            .note(format!(
                "of a frame's layers their mean: empty are the {} that the device leaves out, full the {} with something in them",
                self.recorded - self.drawn,
                self.with_something().unwrap_or(self.drawn)
            ))
            .grid()
    }
}

/// The figures of some kinds together.
fn pass(name: &str, frames: &[FrameSample], kinds: &[Kind<'_>]) -> LayerPass {
    // Not every layer has each kind: the last is not counted. So the kinds' means are added.
    let empty =
        |frame: &FrameSample| -> Option<f64> { kinds.iter().map(|kind| mean(frame, &kind.empty)).sum() };
    let full =
        |frame: &FrameSample| -> Option<f64> { kinds.iter().map(|kind| mean(frame, &kind.full)).sum() };
    let share = |frame: &FrameSample| Some(empty(frame)? / full(frame).filter(|full| *full > 0.0)?);
    LayerPass {
        name: name.to_owned(),
        empty_ms: Spread::of(frames.iter().filter_map(empty)),
        full_ms: Spread::of(frames.iter().filter_map(full)),
        share: Spread::of(frames.iter().filter_map(share)),
    }
}

fn mean(frame: &FrameSample, places: &[usize]) -> Option<f64> {
    let sum: Option<f64> = places.iter().map(|i| frame.passes_ms.get(*i).copied().flatten()).sum();
    sum.filter(|_| !places.is_empty()).map(|sum| sum / places.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::timed::tests;

    /// A frame of four layers whose first has something; as many as said were drawn.
    fn timed(drawn: u32) -> TimedFrames {
        let mut names = vec!["arguments of layers".to_owned()];
        let mut ms = vec![0.5];
        for (layer, cost) in (1..=4).zip([4.0, 2.0, 0.2, 0.1]) {
            for pass in ["visibility", "compose"] {
                names.push(format!("{pass} of layer {layer}"));
                ms.push(cost);
            }
            if layer < 4 {
                names.push(format!("count layer {layer}"));
                ms.push(0.25 * cost);
            }
        }
        names.push("finalize".to_owned());
        ms.push(1.0);
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let count = |name: &&str| match pass_and_layer(name) {
            Some(("count", _)) => None,
            Some((_, layer)) if layer > drawn => Some([0, 0]),
            _ => Some([3, 9]),
        };
        tests::timed(&names, &ms, &names.iter().map(count).collect::<Vec<_>>(), 0)
    }

    #[test]
    fn layers_left_out_are_set_beside_those_with_something() {
        let empty = EmptyLayers::of(&timed(2)).unwrap();
        assert_eq!((empty.recorded, empty.drawn, empty.with_something()), (4, 2, Some(1)));
        let kinds: Vec<&str> = empty.passes.iter().map(|pass| pass.name.as_str()).collect();
        assert_eq!(kinds, ["visibility", "compose", "count", "layer"]);
        let near = |spread: Option<Spread>, expected: f64| (spread.unwrap().median - expected).abs() < 1e-12;
        // Layers 3 and 4 beside layer 1; the machine takes from once to six times as long.
        assert!(near(empty.passes[0].empty_ms, 3.5 * 0.15) && near(empty.passes[0].full_ms, 3.5 * 4.0));
        assert!(near(empty.passes[0].share, 0.15 / 4.0));
        // Only layer 3 is counted.
        assert!(near(empty.passes[2].empty_ms, 3.5 * 0.05));
        assert!(near(empty.passes[3].share, (0.15 + 0.15 + 0.05) / 9.0));
    }

    #[test]
    fn without_a_layer_left_out_there_is_no_cost_of_one() {
        let full = EmptyLayers::of(&timed(4)).unwrap();
        assert_eq!((full.drawn, full.with_something(), full.passes.len()), (4, None, 0));
        // Not counted; no layers.
        assert_eq!(EmptyLayers::of(&TimedFrames { counts: vec![None; 13], ..timed(4) }), None);
        assert_eq!(EmptyLayers::of(&tests::timed(&["finalize"], &[1.0], &[None], 0)), None);
    }
}
