//! What the columns of rows without a header are, told by their numbers.
//!
//! Columns of words are not read. Nor are, before three others, a first column that counts the rows, from any number and one by one, and
//! one or two of whole numbers where the three behind them have fractions: numbers of points, of rows and of columns of a scan. The rest is as the table of
//! [`layout`](super::layout) says by its number.

use super::columns::Column;

/// Fewer rows may look like something by accident.
const FEWEST: usize = 10;

/// The columns of rows of this many words, of each of which the number is known, if it is one.
pub(super) fn columns(width: usize, rows: &[Vec<Option<f64>>]) -> Vec<Column> {
    let is_word = |i: usize| rows.len() > 1 && rows.iter().all(|row| matches!(row.get(i), Some(None)));
    let numbers: Vec<usize> = (0..width).filter(|i| !is_word(*i)).collect();
    let row = |row: &Vec<Option<f64>>| numbers.iter().map(|i| row.get(*i).copied().flatten()).collect();
    let mut known: Vec<Vec<f64>> = rows.iter().filter_map(row).collect();
    let ids = ids(&known, numbers.len());
    known.iter_mut().for_each(|row| drop(row.drain(..ids)));
    let read = by_width(numbers.len() - ids, &known);
    let mut columns = vec![Column::Other; width];
    for (at, column) in numbers.iter().skip(ids).zip(read) {
        if let Some(to) = columns.get_mut(*at) {
            *to = column;
        }
    }
    columns
}

/// How many of the first columns are numbers of something.
fn ids(rows: &[Vec<f64>], width: usize) -> usize {
    if width < 4 || rows.len() < FEWEST {
        return 0;
    }
    if counts_rows(rows) {
        return 1;
    }
    let is_whole = |row: &Vec<f64>, i: usize| row.get(i).is_some_and(|number| number.fract() == 0.0);
    let all_whole = |i: usize| rows.iter().all(|row| is_whole(row, i));
    let has_fractions = |i: usize| 2 * rows.iter().filter(|row| !is_whole(row, i)).count() > rows.len();
    let are_ids = |count: &usize| {
        *count + 3 <= width && (0..*count).all(all_whole) && (*count..*count + 3).all(has_fractions)
    };
    [1, 2].into_iter().find(are_ids).unwrap_or(0)
}

/// Whether the first numbers count the rows: one by one in all that are together at the start, and upward in those from all over the file,
/// which start again.
fn counts_rows(rows: &[Vec<f64>]) -> bool {
    let firsts: Vec<f64> = rows.iter().filter_map(|row| row.first().copied()).collect();
    let one_by_one = |pair: &&[f64]| matches!(pair, [a, b] if a.fract() == 0.0 && b - a == 1.0);
    let together = firsts.windows(2).take_while(one_by_one).count() + 1;
    let others = firsts.get(together..).unwrap_or_default();
    together >= FEWEST && others.is_sorted() && others.iter().all(|number| number.fract() == 0.0)
}

fn by_width(width: usize, rows: &[Vec<f64>]) -> Vec<Column> {
    use Column::{Color, Intensity, Normal, Other, Position};
    let position = [0, 1, 2].map(Position);
    let (color, normal) = ([0, 1, 2].map(Color), [0, 1, 2].map(Normal));
    let is_normal = |from: usize| is_normal(rows.iter().filter_map(|row| row.get(from..from + 3)));
    let is_unit = |from: usize| are_unit(rows.iter().filter_map(|row| row.get(from..from + 3)));
    let pair = |from: usize| if is_normal(from) { [normal, color] } else { [color, normal] }.concat();
    match width {
        0..=2 => vec![Other; width],
        4 => [&position[..], &[Intensity]].concat(),
        6 if is_normal(3) => [position, normal].concat(),
        6 => [position, color].concat(),
        7 if is_unit(3) => [&position[..], &normal, &[Other]].concat(),
        7 if is_opaque(rows) || has_label(rows) => [&position[..], &color, &[Other]].concat(),
        8 if has_label(rows) => [&position[..], &color, &[Other; 2]].concat(),
        7 => [&position[..], &[Intensity], &color].concat(),
        9 => [&position[..], &pair(3)].concat(),
        10 => [&position[..], &[Intensity], &pair(4)].concat(),
        _ => [&position[..], &vec![Other; width - 3]].concat(),
    }
}

/// Whether the last of 7 numbers is the same alpha in all rows, and the three before it are not white behind an intensity.
fn is_opaque(rows: &[Vec<f64>]) -> bool {
    let column = |i: usize| rows.iter().filter_map(move |row| row.get(i).copied());
    let is_same = |i: usize| column(i).zip(column(i).skip(1)).all(|(a, b)| a == b);
    let is_color = || (3..6).all(|i| column(i).all(|value| (0.0..=255.0).contains(&value)));
    let is_alpha =
        rows.first().and_then(|row| row.get(6)).is_some_and(|alpha| *alpha == 255.0 || *alpha == 1.0);
    let is_white = (4..7).all(|i| is_same(i) && column(i).next() == column(6).next());
    rows.len() >= FEWEST && is_alpha && is_same(6) && is_color() && !is_white
}

/// Whether the three numbers behind the position are bytes of color, and the next one of few values, as the label of a class; of an intensity and a
/// color the last is of about as many values as those before it.
fn has_label(rows: &[Vec<f64>]) -> bool {
    let column = |i: usize| rows.iter().filter_map(move |row| row.get(i).copied());
    let values = |i: usize| {
        let mut values: Vec<i64> = column(i).map(|value| value as i64).collect();
        values.sort_unstable();
        values.dedup();
        values.len()
    };
    let are_whole =
        |mut range: std::ops::Range<usize>| range.all(|i| column(i).all(|value| value.fract() == 0.0));
    let are_bytes = || (3..6).all(|i| column(i).all(|value| (0.0..=255.0).contains(&value)));
    rows.len() >= FEWEST && are_whole(3..7) && are_bytes() && (3..6).all(|i| values(i) >= 4 * values(6))
}

/// Whether triples are normals: some are below zero, or all but those that are zero have length 1.
fn is_normal<'a>(mut triples: impl Iterator<Item = &'a [f64]> + Clone) -> bool {
    triples.clone().any(|triple| triple.iter().any(|&v| v < 0.0)) || are_unit(&mut triples)
}

/// Whether all triples but those that are zero have length 1, and there are some.
fn are_unit<'a>(triples: impl Iterator<Item = &'a [f64]>) -> bool {
    let squares =
        triples.map(|triple| triple.iter().map(|v| v * v).sum::<f64>()).filter(|square| *square > 0.0);
    let mut squares = squares.peekable();
    squares.peek().is_some() && squares.all(|square| (square - 1.0).abs() < 0.01)
}
