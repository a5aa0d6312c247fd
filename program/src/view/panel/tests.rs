//! What is in the panel has room in it, whatever that is.

use egui::{Pos2, RawInput, Rect, epaint::Shape};
use surfel::scene::Encoding;

use super::*;
use crate::view::edits::Edits;

const WINDOW: Vec2 = Vec2::new(1024.0, 2000.0);

fn state(text: &str) -> State {
    State {
        settings: Settings::default(),
        encoding: Encoding::default(),
        edits: Edits { things: vec![(true, 1.0)], splat_scale: 1.0 },
        things: vec![(text.to_owned(), String::new())],
        thing: 0,
        facts: vec![("device", text.to_owned())],
        drawn_edges: Some("hard"),
        compared: None,
    }
}

/// Texts of a frame with where they are, and the width of the panel.
fn run(context: &Context, state: &State, history: &History) -> (Vec<(String, Rect)>, f32) {
    let input = RawInput { screen_rect: Some(Rect::from_min_size(Pos2::ZERO, WINDOW)), ..Default::default() };
    let mut width = 0.0;
    let output = context.run(input, |context| {
        show(context, state, history, &mut Vec::new());
        width = WINDOW.x - context.available_rect().width();
    });
    let texts = output.shapes.into_iter().filter_map(|clipped| match clipped.shape {
        Shape::Text(text) => {
            Some((text.galley.text().to_owned(), Rect::from_min_size(text.pos, text.galley.size())))
        }
        _ => None,
    });
    (texts.collect(), width)
}

#[test]
fn the_panel_is_as_wide_whatever_it_says() {
    let context = Context::default();
    let mut history = History::default();
    let (_, first) = run(&context, &state("a"), &history);
    let long = "a device, or a file, with a name that is far too long for it ".repeat(3);
    for ms in [0.001, 1.0, 123.456, 98_765.432] {
        history.push_passes([(long.as_str(), ms), ("b", 1e-3 * ms)].into_iter());
        history.frames.push_back(1e3 * ms as f32);
        for text in [long.as_str(), "a"] {
            for _ in 0..2 {
                let (texts, width) = run(&context, &state(text), &history);
                assert_eq!(width, first, "{text}, {ms}");
                let frame = texts.iter().find(|(text, _)| text.starts_with("frame ")).unwrap();
                assert!(frame.1.height() < 20.0 && frame.1.right() <= WINDOW.x, "{frame:?}");
            }
        }
    }
}

#[test]
fn times_are_beside_the_names_of_passes_at_once() {
    let (context, mut history) = (Context::default(), History::default());
    run(&context, &state("a"), &history);
    history.push_passes([("zz", 0.001), ("the rather long name of a pass", 0.002)].into_iter());
    let (texts, _) = run(&context, &state("a"), &history);
    for (name, time) in [("zz", "1.000 ms"), ("the rather", "2.000 ms")] {
        let at = |start: &str| texts.iter().find(|(text, _)| text.starts_with(start)).unwrap().1;
        assert!(at(name).right() <= at(time).left(), "{texts:?}");
        assert!((at(name).top() - at(time).top()).abs() < 2.0);
    }
}
