//! Options of `surfel bench` that were given and that a table makes nothing of.

use surfel::scene::LodSteps;

use super::arguments::{Bench, BenchArguments};
use crate::unused::{has_default, say};

/// Tells of them.
pub fn tell(arguments: &BenchArguments) {
    let (table, settings) = (arguments.table, arguments.settings());
    let name = table.name();
    if !table.needs_device() {
        let of_pictures = ["size", "filter", "kernel-eval", "accumulate"];
        let mut unused: Vec<&str> =
            of_pictures.into_iter().filter(|option| !has_default(&settings, option)).collect();
        let compiles = !arguments.counts.isa.is_empty();
        let others = [
            ("lod-steps", settings.lod_steps != LodSteps::Hard),
            ("frames", arguments.frames != BenchArguments::FRAMES),
            ("device", arguments.device.asked.is_some() && !compiles),
            ("validate", arguments.device.validate),
        ];
        unused.extend(others.iter().filter(|(_, is_given)| *is_given).map(|(option, _)| *option));
        say(&unused, &format!("bench {name} draws nothing"));
    }
    if matches!(table, Bench::Floor | Bench::Counts) && !arguments.splats.is_empty() {
        say(&["splats"], &format!("bench {name} takes things as they are"));
    }
    if table == Bench::Slides && !has_default(&settings, "filter") {
        say(&["filter"], "bench slides has each method's own");
    }
    let has_levels = match table {
        Bench::P2 | Bench::Hybrid => true,
        _ => settings.wants_levels(),
    };
    if table.needs_device() && !has_levels && settings.lod_steps != LodSteps::Hard {
        let way = if table == Bench::Growth { "; --lod 1px draws them" } else { "" };
        say(&["lod-steps"], &format!("bench {name} draws no levels of detail{way}"));
    }
}
