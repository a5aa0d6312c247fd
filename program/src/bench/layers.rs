//! The cost of transparent layers, on a scene like that of figure 6 of Guennebaud, Barthe, Paulin 2006: 27 transparent balls of
//! splats.

mod balls;

use surfel::{
    Result,
    instruments::Floor,
    renderer::Headless,
    report::bench::{LayersDrawn, LayersReport, Places},
    scene::{LastLayer, Layers, Settings},
};

use super::{
    arguments::Bench,
    contest::{self, Entry},
    context::BenchContext,
};

/// The most layers that are allowed where the device finds out how many there are.
const MOST_LAYERS: u32 = 16;

/// The most that are allowed where there are none.
const MOST_LAYERS_OF_OPAQUE: u32 = 64;

/// The paper's frames a second on its own hardware: with 6 layers, with 3, and with 3 the last of which blends the rest.
const PAPER_FPS: [f64; 3] = [21.0, 45.0, 49.0];

/// A way to draw the balls.
struct Contestant {
    layers: Layers,
    last_layer: LastLayer,
    opaque: bool,
    paper_fps: Option<f64>,
}

/// All ways; the first is what the others are set beside.
fn contestants() -> [Contestant; 6] {
    let [six, three, blended] = PAPER_FPS.map(Some);
    let way = |layers, last_layer, paper_fps| Contestant { layers, last_layer, opaque: false, paper_fps };
    let opaque = |layers| Contestant { opaque: true, ..way(layers, LastLayer::Drop, None) };
    [
        way(Layers::Fixed(6), LastLayer::Drop, six),
        way(Layers::Fixed(3), LastLayer::Drop, three),
        way(Layers::Fixed(3), LastLayer::Blend, blended),
        way(Layers::Auto(MOST_LAYERS), LastLayer::Drop, None),
        opaque(Layers::Fixed(1)),
        opaque(Layers::Auto(MOST_LAYERS_OF_OPAQUE)),
    ]
}

/// Where they are that the notes speak of.
const PLACES: Places = Places { auto: 3, opaque: [4, 5] };

impl Contestant {
    fn name(&self) -> String {
        match self.opaque {
            true => format!("opaque, {}", self.layers),
            false => format!("{}, {}", self.layers, self.last_layer.name()),
        }
    }

    /// Its cells of the table.
    fn drawn(&self) -> LayersDrawn {
        LayersDrawn {
            layers: (!self.opaque).then(|| self.layers.most()),
            auto: !self.opaque && matches!(self.layers, Layers::Auto(_)),
            paper_fps: self.paper_fps,
        }
    }
}

/// Measures them.
pub fn measure(headless: &mut Headless, context: &mut BenchContext<'_>) -> Result<LayersReport> {
    let splats = context.arguments.splats_of(Bench::Layers).unwrap_or(balls::SPLATS);
    let (transparent, input) = balls::scene(splats, balls::ALPHA)?;
    let camera = balls::camera(&transparent, context.settings.size_px);
    headless.renderer.check(&camera, &context.settings)?;
    let transparent = context.prepare(headless, &transparent)?;
    let opaque = context.prepare(headless, &balls::scene(splats, 1.0)?.0)?;
    let floor = Floor::new(headless, &opaque, &camera, &context.settings, false)?;
    let entry = |own: Contestant| Entry {
        name: own.name(),
        scene: if own.opaque { &opaque } else { &transparent },
        settings: Settings { layers: own.layers, last_layer: own.last_layer, ..context.settings.clone() },
        subject: own.drawn(),
    };
    let entries = contestants().into_iter().map(entry).collect();
    let (ways, floor) = contest::measure(headless, context, "layers", &camera, entries, Some(floor))?;
    context.inputs.push(input);
    Ok(LayersReport::of((balls::COUNT, splats), ways, &floor, PLACES))
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn the_notes_speak_of_those_that_they_mean() {
        let contestants = contestants();
        let names: HashSet<String> = contestants.iter().map(Contestant::name).collect();
        assert_eq!(names.len(), contestants.len());
        assert_eq!(contestants[PLACES.auto].name(), "auto:16, drop");
        assert_eq!(PLACES.opaque.map(|i| contestants[i].name()), ["opaque, 1", "opaque, auto:64"]);
    }
}
