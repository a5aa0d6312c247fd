//! As many scenes as are asked for, as tables: printed, held to the bounds, and written into `README.md` beside this file.

use std::{env, fs, path::Path, str::FromStr, time::Instant};

use surfel::report::Grid;

use super::{
    draw::draw,
    errors::Errors,
    rows::{self, Row},
};
use crate::common::shared;

/// So many scenes of a row with something beyond its bound are printed.
const MOST_WORDS: usize = 12;

/// A line of a table.
struct Line {
    label: &'static str,
    scenes: usize,
    errors: Errors,
}

/// An environment variable as a number.
pub(super) fn asked<T: FromStr>(name: &str, usual: T) -> T {
    env::var(name).ok().map_or(usual, |value| value.parse().ok().expect(name))
}

fn page() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/gpu/extremes/README.md")
}

/// `SURFEL_SCENES`: of each row (200). `SURFEL_FIRST`: the number of the first (0). `SURFEL_ROWS`: only rows with this in their name.
/// `SURFEL_UPDATE_TABLES=1` writes the tables anew. A scene alone is printed.
#[test]
#[ignore = "minutes: as many scenes as SURFEL_SCENES says, by every method"]
fn every_row_by_every_method() {
    let mut headless = shared();
    let (scenes, first) = (asked("SURFEL_SCENES", 200_u64), asked("SURFEL_FIRST", 0_u64));
    let only = env::var("SURFEL_ROWS").unwrap_or_default();
    let begun = Instant::now();
    let (mut by_row, mut by_method) = (Vec::new(), Vec::<Line>::new());
    for row in rows::all().iter().filter(|row| row.name.contains(&only)) {
        let mut line = Line { label: row.name, scenes: 0, errors: Errors::default() };
        let mut words = 0;
        for number in first..first + scenes {
            line.scenes += 1;
            let case = row.case(number, false);
            if scenes == 1 {
                println!(
                    "{:?}\n{:?}\n{:#?}",
                    case.hard.camera, case.hard.settings, case.hard.scene.objects[0]
                );
            }
            let drawn = draw(&mut headless, row, &case, |methods| methods);
            for drawn in &drawn {
                line.errors = line.errors.and(drawn.errors);
                of_method(&mut by_method, drawn.name(), drawn.errors);
                if scenes == 1 && !drawn.beyond.is_empty() {
                    println!("    {}: {}", drawn.name(), drawn.beyond);
                }
            }
            let beyond: Vec<_> = drawn.iter().filter(|drawn| !drawn.beyond.is_empty()).collect();
            if let Some(first) = beyond.first()
                && words < MOST_WORDS
            {
                let (count, of) = (beyond.len(), drawn.len());
                println!("    {number}: {count} of {of} methods, {}: {}", first.name(), first.beyond);
                words += 1;
            }
        }
        let (errors, secs) = (&line.errors, begun.elapsed().as_secs_f64());
        println!("{secs:6.1} s {}: {} of {} pictures", row.name, errors.beyond, errors.pictures);
        by_row.push(line);
    }
    let grids = [grid("By row", "row", &by_row), grid("By method", "method", &by_method)];
    for grid in &grids {
        println!("{}", grid.markdown());
    }
    if env::var_os("SURFEL_UPDATE_TABLES").is_some_and(|value| value == "1") {
        write(&grids);
    }
    let beyond: usize = by_row.iter().map(|line| line.errors.beyond).sum();
    assert_eq!(beyond, 0, "pictures with something beyond its bound");
}

fn of_method(lines: &mut Vec<Line>, label: &'static str, errors: Errors) {
    let index = lines.iter().position(|line| line.label == label).unwrap_or_else(|| {
        lines.push(Line { label, scenes: 0, errors: Errors::default() });
        lines.len() - 1
    });
    let line = &mut lines[index];
    line.scenes += 1;
    line.errors = line.errors.and(errors);
}

fn grid(title: &str, axis: &str, lines: &[Line]) -> Grid {
    Grid::of(title, lines)
        .column(axis, |line| line.label)
        .column("scenes", |line| line.scenes)
        .column("pictures", |line| line.errors.pictures)
        .column("beyond", |line| line.errors.beyond)
        .column("pixels", |line| line.errors.compared)
        .column("undecided", |line| line.errors.exempt)
        .column("missed", |line| line.errors.missed)
        .column("surplus", |line| line.errors.surplus)
        .column("weight", |line| figure(line.errors.weight))
        .column("albedo", |line| figure(line.errors.albedo))
        .column("normal, degrees", |line| figure(line.errors.normal_deg))
        .column("depth", |line| figure(line.errors.depth))
        .grid()
}

/// Two digits.
fn figure(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:.1e}") }
}

fn write(grids: &[Grid]) {
    let (begin, end) = ("<!-- tables: begin -->\n", "<!-- tables: end -->\n");
    let committed = fs::read_to_string(page()).unwrap().replace("\r\n", "\n");
    let (before, rest) = committed.split_once(begin).expect("README.md has the mark of the tables' begin");
    let (_, after) = rest.split_once(end).expect("README.md has the mark of the tables' end");
    let text = grids.iter().map(Grid::markdown).collect::<Vec<_>>().join("\n");
    fs::write(page(), format!("{before}{begin}{text}{end}{after}")).unwrap();
}

/// What people read is of these rows, and nothing in it is beyond its bound.
#[test]
fn the_committed_tables_have_every_row_within_its_bounds() {
    let page = fs::read_to_string(page()).unwrap();
    let is_good = |line: &str| line.split('|').nth(4).is_some_and(|beyond| beyond.trim() == "0");
    let is_there =
        |row: &Row| page.lines().any(|line| line.starts_with(&format!("| {} |", row.name)) && is_good(line));
    let missing: Vec<_> = rows::all().iter().filter(|row| !is_there(row)).map(|row| row.name).collect();
    assert!(missing.is_empty(), "SURFEL_UPDATE_TABLES=1 writes them anew: {missing:?}");
}
