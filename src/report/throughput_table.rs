//! Throughput for people: what each method reaches, and where its time goes.

use super::{
    FrameTimes, Spread,
    contest::interval_cell,
    grid::{Grid, NONE, bracketed, cell, count_cell},
    throughput::{MethodThroughput, ThroughputRow},
};

/// Frames and splats a second and the ratios, beside the paper's.
pub fn throughput_grid(title: &str, rows: &[ThroughputRow]) -> Grid {
    let mut grid = Grid::new(
        title,
        &[
            "splats",
            "method",
            "fps",
            "(paper)",
            "M splats/s",
            "(paper)",
            "frame ms",
            "95% of the median",
            "x first",
            "(paper)",
            "x floor",
            "record ms",
            "MB",
        ],
    );
    for row in rows {
        let mega = 1e-6 * (row.splat_bytes + row.transient_bytes) as f64;
        let first_paper = row.methods.first().and_then(|method| method.paper);
        for (method, beside) in row.methods.iter().zip(&row.beside_first) {
            let ms = method.frames.frame_ms;
            let paper_ratio = first_paper.zip(method.paper).map(|(first, own)| first.fps / own.fps);
            grid.row([
                row.splats.to_string(),
                method.name.clone(),
                cell(method.fps, 2),
                bracketed(method.paper.map(|paper| paper.fps), 1),
                cell(method.million_splats_per_sec, 2),
                bracketed(method.paper.map(|paper| paper.million_splats_per_sec), 1),
                cell(ms.map(|ms| ms.median), 2),
                interval_cell(ms.as_ref(), 2),
                cell(beside.map(|spread| spread.median), 3),
                bracketed(paper_ratio, 2),
                cell(method.over_floor.last().copied().flatten().map(|spread| spread.median), 2),
                cell(method.frames.record_ms.map(|ms| ms.median), 3),
                format!("{mega:.1}"),
            ]);
        }
    }
    grid.notes.push(
        "medians; in brackets the paper's; ratios are medians of the rounds' own, each of the least of its frames: x first \
         beside the first method, x floor beside that one's points and formats with nothing computed"
            .to_owned(),
    );
    grid
}

/// Every pass of every method: where the time goes. The floor's passes follow each number of splats.
pub fn passes_grid(title: &str, rows: &[ThroughputRow]) -> Grid {
    let head = [
        "splats",
        "method",
        "pass",
        "ms",
        "min",
        "max",
        "x floor",
        "vertices",
        "fragments",
        "VP/FP",
        "(paper)",
    ];
    let mut grid = Grid::new(title, &head);
    for row in rows {
        for method in &row.methods {
            let own = |pass: &str| [instructions_cell(method, pass), paper_instructions(method, pass)];
            rows_of(
                &mut grid,
                [&row.splats.to_string(), &method.name],
                &method.frames,
                &method.over_floor,
                &own,
            );
        }
        let none = |_: &str| [NONE.to_owned(), String::new()];
        rows_of(&mut grid, [&row.splats.to_string(), "floor"], &row.floor, &[], &none);
    }
    grid.notes.push("VP/FP: instructions of the pass's programs, counted as the paper does".to_owned());
    grid
}

/// What the paper has for a method's passes: vertex and fragment program of visibility, then of accumulation.
const PAPER_INSTRUCTIONS: [[&str; 2]; 2] = [["46/3", "58/3"], ["34/9", "35/13"]];

/// The paper's instructions where it has the method.
fn paper_instructions(method: &MethodThroughput, pass: &str) -> String {
    let column = ["visibility", "accumulate"].iter().position(|name| *name == pass);
    method.paper_method.zip(column).map_or_else(String::new, |(method, column)| {
        format!("({})", PAPER_INSTRUCTIONS[method as usize][column])
    })
}

/// The instructions of a pass, as `46/3`.
#[cfg(feature = "counts")]
pub(super) fn instructions_cell(method: &MethodThroughput, pass: &str) -> String {
    let counts = method.instructions.iter().find(|counts| counts.pass == pass);
    counts.map_or_else(|| NONE.to_owned(), |counts| counts.vertex_and_fragment())
}

/// Nothing is counted.
#[cfg(not(feature = "counts"))]
pub(super) fn instructions_cell(_: &MethodThroughput, _: &str) -> String {
    NONE.to_owned()
}

fn rows_of(
    grid: &mut Grid,
    [splats, name]: [&str; 2],
    frames: &FrameTimes,
    over_floor: &[Option<Spread>],
    instructions: &dyn Fn(&str) -> [String; 2],
) {
    for (i, pass) in frames.passes.iter().enumerate() {
        let over = over_floor.get(i).copied().flatten();
        let [own, paper] = instructions(&pass.name);
        grid.row([
            splats.to_owned(),
            name.to_owned(),
            pass.name.clone(),
            cell(pass.ms.map(|ms| ms.median), 2),
            cell(pass.ms.map(|ms| ms.min), 2),
            cell(pass.ms.map(|ms| ms.max), 2),
            cell(over.map(|spread| spread.median), 2),
            count_cell(pass.vertices),
            count_cell(pass.fragments),
            own,
            paper,
        ]);
    }
}

#[cfg(test)]
mod tests {
    use super::{super::throughput::tests::row, *};

    #[test]
    fn every_pass_of_every_method_has_a_row() {
        let rows = [row()];
        assert_eq!(passes_grid("t", &rows).rows.len(), 12);
        let grid = throughput_grid("t", &rows);
        assert!(grid.rows.iter().all(|row| row.len() == grid.head.len()));
        assert_eq!(grid.rows[2][..4], ["154000", "raycast", grid.rows[2][2].as_str(), "(33.0)"]);
        // What the paper does not have is not beside another's.
        assert_eq!(grid.rows[1][3], "");
        let passes = passes_grid("t", &rows);
        let paper: Vec<&str> = passes.rows.iter().map(|row| row[10].as_str()).collect();
        assert_eq!(paper[..9], ["(46/3)", "(58/3)", "", "", "", "", "(34/9)", "(35/13)", ""]);
    }
}
