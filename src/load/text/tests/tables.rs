//! What tables for readers have: marks of thousands, sums below, units above.

use super::*;

#[test]
fn marks_of_thousands_are_no_columns() {
    for text in [
        "x,y,z\n\"1,234.5\",\"2\",\"3\"\n\"4\",\"12,345.25\",\"3\"\n",
        "x;y;z\n1 234,5;2;3\n4;12 345,25;3\n",
        "1,234.5 2 3\n4 12,345.25 3\n",
        "1'234.5;2;3\n4;12'345.25;3\n",
    ] {
        let (found, _) = points(text);
        assert_eq!(
            found.positions,
            [DVec3::new(1234.5, 2.0, 3.0), DVec3::new(4.0, 12_345.25, 3.0)],
            "{text}"
        );
    }
}

#[test]
fn words_below_the_rows_are_told_and_words_among_them_refused() {
    for last in ["Total 2 points", "Total 2 points\n\nend of file"] {
        let (found, loaded) = points(&format!("1 2 3\n4 5 6\n{last}\n\n"));
        assert_eq!(found.positions.len(), 2);
        let count = last.lines().filter(|line| !line.is_empty()).count();
        let lines = if count == 1 { "line" } else { "lines" };
        assert_eq!(
            notes(&loaded),
            [format!("{count} {lines} of words ('Total 2 points') below the rows ignored")]
        );
    }
    assert_eq!(points("x,y,z\n1,2,3\nTotal: 1\n").0.positions.len(), 1);
    refuses("1 2 3\nTotal 2\n4 5 6\n", "line 2: 'Total' in column 1; expected a number");
    let many = format!("1 2 3\n{}", "a word\n".repeat(9));
    refuses(&many, "line 2: 'a' in column 1; expected a number");
    // Blocks of a large file know it, too.
    let rows = "1 2 3\n".repeat(400_000);
    assert_eq!(points(&format!("{rows}Total 5\n")).0.positions.len(), 400_000);
    refuses(&format!("{rows}Total 5\n{rows}"), "line 400001: 'Total' in column 1; expected a number");
}

#[test]
fn units_in_a_header_are_told() {
    for (header, unit) in [
        ("x [mm],y [mm],z [mm]", Some(0.001)),
        ("X(m),Y(m),Z(m)", Some(1.0)),
        ("x [mm],y [mm],z [m]", None),
        ("x,y,z", None),
    ] {
        assert_eq!(points(&format!("{header}\n1,2,3\n")).1.metres_per_unit, unit, "{header}");
    }
    let (_, loaded) = points("x [ft] y [ft] z [ft]\n1 2 3\n");
    assert_eq!((loaded.format.as_str(), loaded.metres_per_unit), ("rows of x y z", Some(0.3048)));
}
