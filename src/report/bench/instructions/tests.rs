use super::*;

#[test]
fn csv_has_as_many_fields_in_every_line() {
    let row = |isa| InstructionRow {
        names: PipelineNames { filter: "a, \"b\"".to_owned(), ..PipelineNames::default() },
        counts: PassCounts {
            pass: "accumulate".to_owned(),
            vertex: Some(Counts { arb: Some(58), scalar: 200, ..Counts::default() }),
            fragment: Some(Counts { arb: Some(3), ..Counts::default() }),
            compute: None,
        },
        published: Some([58, 3]),
        isa,
    };
    let isa = IsaRow {
        device: "NAVI21".to_owned(),
        executable: "Vertex Shader".to_owned(),
        subgroup: 64,
        statistics: vec![("Instructions".to_owned(), 300.0)],
    };
    let report = InstructionReport { rows: vec![row(vec![]), row(vec![isa])], notes: vec![] };
    let csv = report.csv();
    let fields = |line: &str| line.replace("\"a, \"\"b\"\"\"", "x").split(',').count();
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines.len(), 3);
    assert!(lines.iter().all(|line| fields(line) == 9 + 3 * 11 + 2 + 3 + 1), "{csv}");
    assert!(lines[1].contains(",58,,200,"), "{csv}");
    assert!(lines[2].ends_with("58,3,NAVI21,Vertex Shader,64,300"), "{csv}");
    assert!(report.grid().to_string().contains("58/3"));
}
