//! Layers for people: what each number of them costs, and what one costs in which nothing is.

use super::{
    EmptyLayers, LayersReport, NONE,
    contest::{interval_cell, is_equal},
    grid::{Grid, bracketed, cell},
};

/// The tables of layers.
pub fn layers_grids(report: &LayersReport) -> Vec<Grid> {
    let empty = report.empty.as_ref().filter(|empty| !empty.passes.is_empty());
    [Some(contestants(report)), empty.map(empty_layers)].into_iter().flatten().collect()
}

fn contestants(report: &LayersReport) -> Grid {
    let title = format!("layers, {} balls of {} splats", report.balls, report.splats_per_ball);
    let head = [
        "method",
        "layers",
        "frame ms",
        "95% of the median",
        "fps",
        "(paper)",
        "fps x first",
        "95% of the median",
        "(paper)",
        "x floor",
        "MB",
        "record ms",
    ];
    let mut grid = Grid::new(title, &head);
    for contestant in &report.contestants {
        let own = &contestant.contestant;
        let [ms, interval] = own.ms_cells();
        let [floor, mega, record] = own.last_cells();
        let speed = own.beside_first.and_then(|ratio| ratio.inverse());
        grid.row([
            own.name.clone(),
            contestant.layers.map_or_else(|| NONE.to_owned(), |layers| layers.to_string()),
            ms,
            interval,
            cell(own.fps, 2),
            bracketed(contestant.paper_fps, 0),
            cell(speed.map(|speed| speed.median), 2),
            interval_cell(speed.as_ref(), 2),
            bracketed(report.paper_speed(contestant), 2),
            floor,
            mega,
            record,
        ]);
    }
    grid.notes = notes(report);
    grid
}

fn notes(report: &LayersReport) -> Vec<String> {
    let mut notes = vec![
        "medians; in brackets the paper's (figure 6, on its own hardware and scene); fps x first: how many times as fast, of \
         each round; MB: a frame's own images and buffers"
            .to_owned(),
    ];
    notes.extend(report.empty.as_ref().map(|empty| match empty.with_something() {
        Some(layers) => format!(
            "the view has {layers} layer(s): of {} allowed the device draws {}, the last of which is empty",
            empty.recorded, empty.drawn
        ),
        None => format!(
            "all of {} allowed layers are drawn: the view has as many or more, or the device can't leave any out",
            empty.recorded
        ),
    }));
    notes.extend(report.memory(false).map(|[(few, least), (many, most)]| {
        let grows = match most == least {
            true => "memory does not grow with their number".to_owned(),
            false => format!("{:+.1}%", 100.0 * (most as f64 / least.max(1) as f64 - 1.0)),
        };
        format!(
            "a frame of {few} layers has {least} bytes of images and buffers, one of {many} {most}: {grows}"
        )
    }));
    notes.extend(report.memory(true).map(|[_, (most, bytes)]| {
        format!("one of auto:{most} has {bytes}: the arguments of its draws and a count a layer come on top")
    }));
    let opaque = &report.opaque;
    let passes = if opaque.same_passes { "the same passes" } else { "OTHER PASSES" };
    let ratio = opaque.ratio.map_or_else(|| NONE.to_owned(), |ratio| format!("{:.3}", ratio.median));
    let verdict = match is_equal(opaque.ratio.as_ref()) {
        Some(true) => "equal within noise",
        Some(false) => "not equal within noise",
        None => "too uncertain to tell",
    };
    notes.push(format!(
        "layers that an opaque scene could have: {passes} as with one, {ratio} times its frame (95% of the median: {}): \
         {verdict}",
        interval_cell(opaque.ratio.as_ref(), 3)
    ));
    notes
}

fn empty_layers(empty: &EmptyLayers) -> Grid {
    let head = ["pass", "empty ms", "95% of the median", "full ms", "95% of the median", "empty / full"];
    let mut grid = Grid::new("layers: what an empty one costs", &head);
    for pass in &empty.passes {
        grid.row([
            pass.name.clone(),
            cell(pass.empty_ms.map(|ms| ms.median), 4),
            interval_cell(pass.empty_ms.as_ref(), 4),
            cell(pass.full_ms.map(|ms| ms.median), 3),
            interval_cell(pass.full_ms.as_ref(), 3),
            cell(pass.share.map(|share| share.median), 5),
        ]);
    }
    grid.notes.push(format!(
        "of a frame's layers their mean: empty are the {} that the device leaves out, full the {} with something in them",
        empty.recorded - empty.drawn,
        empty.with_something().unwrap_or(empty.drawn)
    ));
    grid
}

#[cfg(test)]
mod tests {
    use super::{super::layers::tests::report, *};

    #[test]
    fn every_contestant_has_a_row_and_what_follows_is_said() {
        let grids = layers_grids(&report(false));
        assert_eq!(grids.len(), 2);
        for grid in &grids {
            assert!(grid.rows.iter().all(|row| row.len() == grid.head.len()), "{grid}");
        }
        let [table, empty] = [&grids[0], &grids[1]];
        assert_eq!(table.rows[1][..2], ["3, drop", "3"]);
        assert_eq!(table.rows[1][5..9], ["(45)", "3.71", "3.71 to 3.71", "(2.14)"]);
        assert_eq!((table.rows[3][1].as_str(), table.rows[3][8].as_str()), ("-", ""));
        assert_eq!(
            empty.rows.iter().map(|row| row[0].as_str()).collect::<Vec<_>>(),
            ["accumulate", "compose", "layer"]
        );
        let notes = table.notes.join("\n");
        for text in [
            "the view has 1 layer(s): of 4 allowed the device draws 2",
            "of 3 layers has 1000000 bytes of images and buffers, one of 6 1000000: memory does not grow",
            "one of auto:4 has 1000008",
            "the same passes as with one, 1.000 times its frame (95% of the median: 1.000 to 1.000): equal within noise",
        ] {
            assert!(notes.contains(text), "'{text}' is not in\n{notes}");
        }
        let changed = layers_grids(&report(true))[0].notes.join("\n");
        assert!(changed.contains("OTHER PASSES") && changed.contains("not equal within noise"), "{changed}");
    }
}
