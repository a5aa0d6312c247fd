//! Two methods that are compared: what they are called, and which of them is where.

use egui::Align2;
use surfel::scene::{OptionTable as _, Settings};

use super::keys::Comparing;

/// What both pictures take from the window, whatever the other method was kept with.
const SHARED: [&str; 4] = ["size", "samples", "lod", "background"];

/// What two methods are called: their rasterizers, and all else in which they differ.
pub fn names(methods: [&Settings; 2]) -> [String; 2] {
    let differs = |setting: &&surfel::scene::Setting<Settings>| {
        let [one, other] = methods.map(|method| (setting.get)(method));
        setting.name == "rasterizer" || one != other && !SHARED.contains(&setting.name)
    };
    methods.map(|method| {
        let words = Settings::OPTIONS.iter().filter(differs).map(|setting| {
            let value = (setting.get)(method);
            if setting.name == "rasterizer" { value } else { format!("{} {value}", setting.name) }
        });
        words.collect::<Vec<_>>().join(", ")
    })
}

/// What is said of the pictures, and at which edge of the window.
pub fn labels(how: Comparing, [first, other]: &[String; 2]) -> Vec<(Align2, String)> {
    match how {
        Comparing::Split => {
            vec![(Align2::LEFT_TOP, format!("left: {first}")), (Align2::RIGHT_TOP, format!("right: {other}"))]
        }
        Comparing::Flicker => vec![(Align2::CENTER_TOP, format!("the other one: {other}"))],
        Comparing::Difference => vec![(Align2::CENTER_TOP, format!("{first}\nminus {other}"))],
        Comparing::Keep => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use surfel::scene::{Filter, Lod, Rasterizer};

    use super::*;

    #[test]
    fn methods_are_called_by_what_differs() {
        let one = Settings { rasterizer: Rasterizer::Compute, ..Settings::default() };
        let other = Settings {
            filter: Filter::None,
            rasterizer: Rasterizer::Raycast,
            lod: Lod::Px(3.0),
            size_px: [7; 2],
            ..one.clone()
        };
        let adjust = Settings::default().filter;
        let of_filter = |filter: &str| format!("filter {filter}");
        let word = Settings::OPTIONS.iter().find(|setting| setting.name == "filter").unwrap();
        assert_ne!(adjust, Filter::None);
        let called = names([&one, &other]);
        assert_eq!(called[0], format!("compute, {}", of_filter(&(word.get)(&one))));
        assert_eq!(called[1], "raycast, filter none");
        assert_eq!(names([&one, &one]), ["compute", "compute"]);
        let told = |how| labels(how, &["a".to_owned(), "b".to_owned()]).into_iter().map(|(_, text)| text);
        assert_eq!(told(Comparing::Split).collect::<Vec<_>>(), ["left: a", "right: b"]);
        assert_eq!(told(Comparing::Flicker).collect::<Vec<_>>(), ["the other one: b"]);
        assert_eq!(told(Comparing::Difference).collect::<Vec<_>>(), ["a\nminus b"]);
    }
}
