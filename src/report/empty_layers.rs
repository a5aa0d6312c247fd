//! What a layer costs in which nothing is (`--layers auto`): of frames in which the device left layers out, for the one
//! before them was empty.

use serde::Serialize;

use super::{FrameSample, Measured, Spread};

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

impl EmptyLayers {
    /// Of a contestant in layers; `None` for one without, or where nothing was counted.
    pub fn of(measured: &Measured<'_>) -> Option<Self> {
        let of_layers: Vec<(usize, &str, u32)> = measured
            .passes
            .iter()
            .enumerate()
            .filter_map(|(i, name)| pass_and_layer(name).map(|(pass, layer)| (i, pass, layer)))
            .collect();
        let recorded = of_layers.iter().map(|(.., layer)| *layer).max()?;
        // Every layer is composed, by a triangle unless it is left out.
        let is_drawn = |(i, ..): &&(usize, &str, u32)| {
            measured.counts.get(*i).copied().flatten().map(|[vertices, _]| vertices > 0)
        };
        let composed = of_layers.iter().filter(|(_, pass, _)| *pass == "compose");
        let drawn: Vec<bool> = composed.map(|layer| is_drawn(&layer)).collect::<Option<_>>()?;
        let drawn = drawn.into_iter().filter(|drawn| *drawn).count() as u32;
        let mut report = Self { recorded, drawn, passes: Vec::new() };
        let Some(full) = report.with_something() else { return Some(report) };
        let mut names: Vec<&str> = Vec::new();
        for (_, pass, _) in &of_layers {
            if !names.contains(pass) {
                names.push(pass);
            }
        }
        let places = |pass: &str, layers: std::ops::RangeInclusive<u32>| -> Vec<usize> {
            of_layers
                .iter()
                .filter(|(_, own, layer)| *own == pass && layers.contains(layer))
                .map(|(i, ..)| *i)
                .collect()
        };
        let kinds: Vec<Kind> = names
            .into_iter()
            .map(|name| Kind {
                name: name.to_owned(),
                empty: places(name, drawn + 1..=recorded),
                full: places(name, 1..=full),
            })
            .filter(|kind| !kind.empty.is_empty() && !kind.full.is_empty())
            .collect();
        let frames = measured.rounds.concat();
        report.passes =
            kinds.iter().map(|kind| pass(&kind.name, &frames, std::slice::from_ref(kind))).collect();
        report.passes.push(pass("layer", &frames, &kinds));
        Some(report)
    }

    /// How many layers have something in them; `None` where all were drawn: the view may have more, or the device can't
    /// leave any out.
    pub fn with_something(&self) -> Option<u32> {
        (self.drawn < self.recorded).then(|| self.drawn.saturating_sub(1))
    }
}

/// A kind of pass: where it is in the frame.
struct Kind {
    name: String,
    empty: Vec<usize>,
    full: Vec<usize>,
}

/// The figures of some kinds together.
fn pass(name: &str, frames: &[FrameSample], kinds: &[Kind]) -> LayerPass {
    // Not every layer has each kind: the last is not counted. So the kinds' means are added.
    let ms = |frame: &FrameSample, places: fn(&Kind) -> &[usize]| -> Option<f64> {
        kinds.iter().map(|kind| mean(frame, places(kind))).sum()
    };
    let empty = |frame: &FrameSample| ms(frame, |kind| &kind.empty);
    let full = |frame: &FrameSample| ms(frame, |kind| &kind.full);
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
    use super::{
        super::contest::tests::{measured, rounds},
        *,
    };

    /// A frame of four layers whose first has something, and so much of the passes' time.
    fn passes() -> (Vec<String>, Vec<f64>) {
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
        (names, ms)
    }

    fn counts(names: &[String], drawn: u32) -> Vec<Option<[u64; 2]>> {
        let of = |name: &String| match pass_and_layer(name) {
            Some(("count", _)) => None,
            Some((_, layer)) if layer > drawn => Some([0, 0]),
            _ => Some([3, 9]),
        };
        names.iter().map(of).collect()
    }

    #[test]
    fn layers_left_out_are_set_beside_those_with_something() {
        let (names, ms) = passes();
        let (rounds, counts) = (rounds(&ms), counts(&names, 2));
        let empty = EmptyLayers::of(&measured("auto", &names, &rounds, &counts)).unwrap();
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
        let (names, ms) = passes();
        let rounds = rounds(&ms);
        let all = counts(&names, 4);
        let full = EmptyLayers::of(&measured("4", &names, &rounds, &all)).unwrap();
        assert_eq!((full.drawn, full.with_something(), full.passes.len()), (4, None, 0));
        // Not counted; no layers.
        assert_eq!(EmptyLayers::of(&measured("4", &names, &rounds, &vec![None; names.len()])), None);
        assert_eq!(EmptyLayers::of(&measured("x", &["finalize".to_owned()], &[], &[None])), None);
    }
}
