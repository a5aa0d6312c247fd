//! The sweep as tables: printed, held to bounds, and written into `README.md` beside this file and `src/selftest/stability_tables.json`.

use std::{env, fs, path::Path};

use surfel::report::Grid;

use super::{
    measure::{Errors, Measured, Prepared},
    pictures::Fragments,
    sweep::{self, BEHIND, Case, DEPTHS, OFFSETS, Place, RADII, TILTS_DEG},
};
use crate::common::shared;

/// Which naive formulas stand beside ours.
#[derive(Clone, Copy)]
enum Naive {
    /// On the renderer's own view-space numbers.
    Formulas,
    /// The same, only for radius / distance 1e-2 and 1e-1, where they are at their best.
    AtTheirBest,
    /// On world coordinates in f32, for the same splats.
    WorldAtTheirBest,
}

/// The worst of the cases in one row.
#[derive(Default)]
struct Row {
    label: String,
    splats: usize,
    places: usize,
    ours: Errors,
    naive: Errors,
    fragments: Fragments,
}

struct Table {
    axis: &'static str,
    rows: Vec<Row>,
}

/// The margin by which glsl/inc/box.glsl enlarges every box, `BOX_MARGIN_PX`.
const BOX_MARGIN_PX: f64 = 1.0 / 256.0;

/// Every splat of the grid with two pairs of offset and near plane.
const ROUNDS: usize = 2;

#[test]
fn f32_against_f64_over_the_whole_sweep() {
    let mut headless = shared();
    let cases = sweep::all(ROUNDS);
    let prepared = Prepared::new(&headless, &cases);
    let mut measured = prepared.measure(&headless, &cases, None);
    prepared.count_fragments(&mut headless, &cases, &mut measured);
    let tables = tables(&cases, &measured);
    let grids: Vec<Grid> = tables.iter().map(Table::grid).collect();
    for grid in &grids {
        println!("{grid}");
    }
    keep(&grids);

    for table in &tables {
        for row in &table.rows {
            let name = format!("{} {}", table.axis, row.label);
            assert!(row.fragments.inside > 1000 && row.places > 100, "{name}: too little is seen");
            assert_eq!((row.fragments.missed, row.fragments.surplus), (0, 0), "{name}");
            // A box may be as much too small as it is enlarged later.
            assert!(row.ours.small_px <= BOX_MARGIN_PX, "{name}: {:?}", row.ours);
            assert!(row.ours.uv_share <= 1.0, "{name}: {:?}", row.ours);
        }
    }
    for (case, measured) in cases.iter().zip(&measured) {
        // What is cut by the near plane may have a larger box than needed, nothing else.
        if measured.regular {
            assert!(measured.ours.large_px <= BOX_MARGIN_PX, "{:?}: {:?}", case.hard.camera, measured.ours);
        }
    }
    the_naive_formulas_are_worse(&tables);
}

/// What the text of README.md says of them.
fn the_naive_formulas_are_worse(tables: &[Table]) {
    // At 1e-6 the splat itself is smaller than the margin, in the view that shows the loss.
    for row in &tables[0].rows[1..4] {
        let naive = row.naive;
        assert!(naive.small_px > 4.0 * BOX_MARGIN_PX, "{}: {naive:?}", row.label);
    }
    let far = &tables[2].rows[3];
    assert!(far.naive.uv > 1.0, "{}: {:?}", far.label, far.naive);
}

/// The tables are worth something only if they show what is wrong.
#[test]
fn a_formula_that_is_wrong_by_a_hundredth_is_seen() {
    let headless = shared();
    let cases: Vec<Case> = sweep::all(1).into_iter().step_by(3).collect();
    let prepared = Prepared::new(&headless, &cases);
    for wrong in [
        "BOX_CENTER",
        "BOX_HALF_SIZE",
        "NEAR_BOX",
        "INVERSE_MAPPING_U",
        "INVERSE_MAPPING_W",
        "VIEW_TRANSFORM",
        "TANGENT_FRAME",
    ] {
        let measured = prepared.measure(&headless, &cases, Some(wrong));
        let ours = measured.iter().map(|measured| measured.ours).fold(Errors::default(), Errors::max);
        println!("{wrong}: {ours:?}");
        assert!(ours.small_px > BOX_MARGIN_PX || ours.uv_share > 1.0, "{wrong}: {ours:?}");
    }
}

fn tables(cases: &[Case], measured: &[Measured]) -> Vec<Table> {
    let all: Vec<(&Case, &Measured)> = cases.iter().zip(measured).collect();
    let ahead = |case: &Case| matches!(case.place, Place::Ahead(_));
    let table = |axis, values: &[f64], naive, is: &dyn Fn(&Case, f64) -> bool| Table {
        axis,
        rows: values
            .iter()
            .map(|value| {
                let of_row = all.iter().filter(|(case, _)| is(case, *value));
                Row::of(format!("{value:e}"), of_row.copied(), naive)
            })
            .collect(),
    };
    let mut tables = vec![
        table("radius / distance", &RADII, Naive::Formulas, &|case, value| case.place == Place::Ahead(value)),
        table("tilt, degrees", &TILTS_DEG, Naive::AtTheirBest, &|case, value| {
            ahead(case) && case.tilt_deg == value
        }),
        table("offset / distance", &OFFSETS, Naive::WorldAtTheirBest, &|case, value| {
            ahead(case) && case.offset == value
        }),
        table("depth / near", &DEPTHS, Naive::AtTheirBest, &|case, value| ahead(case) && case.depth == value),
        table("center's depth / radius", &BEHIND, Naive::Formulas, &|case, value| {
            case.place == Place::Behind(value)
        }),
    ];
    for row in &mut tables[1].rows {
        row.label = row.label.parse::<f64>().unwrap_or_default().to_string();
    }
    tables
}

impl Row {
    fn of<'a>(label: String, cases: impl Iterator<Item = (&'a Case, &'a Measured)>, naive: Naive) -> Self {
        let mut row = Self { label, ..Self::default() };
        for (case, measured) in cases {
            row.splats += 1;
            row.places += measured.places;
            row.ours = row.ours.max(measured.ours);
            let at_their_best = matches!(case.place, Place::Ahead(radius) if (1e-2..=1e-1).contains(&radius));
            row.naive = match naive {
                Naive::Formulas => row.naive.max(measured.naive),
                Naive::AtTheirBest if at_their_best => row.naive.max(measured.naive),
                Naive::WorldAtTheirBest if at_their_best => row.naive.max(measured.world),
                _ => row.naive,
            };
            row.fragments.inside += measured.fragments.inside;
            row.fragments.missed += measured.fragments.missed;
            row.fragments.surplus += measured.fragments.surplus;
        }
        row
    }
}

impl Table {
    fn grid(&self) -> Grid {
        Grid::of(format!("By {}", self.axis), &self.rows)
            .column(self.axis, |row| row.label.clone())
            .column("splats", |row| row.splats)
            .column("box too small, px", |row| figure(row.ours.small_px))
            .column("naive", |row| figure(row.naive.small_px))
            .column("box too large, px", |row| figure(row.ours.large_px))
            .column("naive", |row| figure(row.naive.large_px))
            .column("(u, v)", |row| figure(row.ours.uv))
            .column("naive", |row| figure(row.naive.uv))
            .column("of allowed", |row| format!("{:.2}", row.ours.uv_share))
            .column("pixels", |row| row.fragments.inside)
            .column("missed", |row| row.fragments.missed)
            .column("surplus", |row| row.fragments.surplus)
            .grid()
    }
}

/// Two digits; `-` where there is no number at all.
fn figure(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        value if value.is_infinite() => "-".to_owned(),
        value => format!("{value:.1e}"),
    }
}

/// Holds the committed tables to these: the same tables and rows. The figures depend on the device.
/// `SURFEL_UPDATE_TABLES=1` writes them anew: for people, and as `surfel report` shows them.
fn keep(grids: &[Grid]) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = root.join("tests/gpu/stability/README.md");
    let json = root.join("src/selftest/stability_tables.json");
    if env::var_os("SURFEL_UPDATE_TABLES").is_some_and(|value| value == "1") {
        let (begin, end) = ("<!-- tables: begin -->\n", "<!-- tables: end -->\n");
        let committed = fs::read_to_string(&page).unwrap().replace("\r\n", "\n");
        let (before, rest) =
            committed.split_once(begin).expect("README.md has the mark of the tables' begin");
        let (_, after) = rest.split_once(end).expect("README.md has the mark of the tables' end");
        let text = grids.iter().map(Grid::markdown).collect::<Vec<_>>().join("\n");
        fs::write(&page, format!("{before}{begin}{text}{end}{after}")).unwrap();
        fs::write(&json, serde_json::to_string(grids).unwrap() + "\n").unwrap();
        return;
    }
    let committed: Vec<Grid> = serde_json::from_str(&fs::read_to_string(&json).unwrap()).unwrap();
    let firsts = |grid: &Grid| {
        let rows = grid.rows.iter().map(|row| row[0].clone());
        (grid.title.clone(), grid.head.clone(), rows.collect::<Vec<_>>())
    };
    let [then, now] = [&committed[..], grids].map(|grids| grids.iter().map(firsts).collect::<Vec<_>>());
    assert_eq!(then, now, "{}: SURFEL_UPDATE_TABLES=1 writes it anew", json.display());
}
