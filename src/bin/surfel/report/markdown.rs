//! Tables out of Markdown.

use surfel::report::Grid;

/// Every table of a text, without a title.
pub fn tables(text: &str) -> Vec<Grid> {
    let mut grids: Vec<Grid> = Vec::new();
    let mut within = false;
    for line in text.lines() {
        let Some(cells) = cells(line) else {
            within = false;
            continue;
        };
        match grids.last_mut().filter(|_| within) {
            None => grids.push(Grid { head: cells, ..Grid::default() }),
            // The line under the head.
            Some(_) if cells.iter().all(|cell| cell.contains("---")) => {}
            Some(grid) => grid.rows.push(cells),
        }
        within = true;
    }
    grids
}

fn cells(line: &str) -> Option<Vec<String>> {
    let inner = line.trim().strip_prefix('|')?.strip_suffix('|')?;
    Some(inner.split('|').map(|cell| cell.trim().to_owned()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_told_apart_and_from_text() {
        let text = "a | b\n\n| r | n |\n|---|---:|\n| 1 | - |\n| 2 | x |\n\n| s |\n|---|\ntext\n| t |\n";
        let grids = tables(text);
        let heads: Vec<_> = grids.iter().map(|grid| grid.head.join(",")).collect();
        assert_eq!(heads, ["r,n", "s", "t"]);
        assert_eq!(grids[0].csv(), "r,n\n1,-\n2,x\n");
    }
}
