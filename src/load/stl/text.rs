//! STL as text: facets, each a loop of corners.

use crate::{
    error::Result,
    load::{
        Input,
        lines::{Line, Lines, shown},
    },
};

/// The corners of all triangles, three each.
pub(super) fn corners(input: &Input<'_>) -> Result<Vec<[f32; 3]>> {
    let mut lines = Lines::new(input, None);
    let (mut corners, mut polygon) = (Vec::new(), Vec::new());
    let mut is_closed = false;
    while let Some(line) = lines.next()? {
        let mut words = line.words();
        let keyword = words.next().unwrap_or_default().to_ascii_lowercase();
        match keyword.as_slice() {
            b"vertex" => {
                let mut next = || lines.number(line, &mut words, "a coordinate");
                polygon.push([next()?, next()?, next()?]);
                let most = input.options.limits.list_items;
                if polygon.len() > most {
                    return Err(lines.fault(line, format!("a facet of more than {most} corners")));
                }
            }
            b"endloop" | b"endfacet" => end(&lines, line, &mut polygon, &mut corners, &keyword)?,
            b"solid" | b"facet" | b"outer" if polygon.is_empty() => {}
            b"endsolid" if polygon.is_empty() => is_closed = true,
            b"solid" | b"facet" | b"outer" | b"endsolid" => {
                let problem = format!("'{}' within a loop; expected endloop", shown(&keyword));
                return Err(lines.fault(line, problem));
            }
            // Colors, as some writers have them.
            b"color" => {}
            _ => {
                let problem =
                    format!("'{}'; expected a word of STL, such as facet or vertex", shown(&keyword));
                return Err(lines.fault(line, problem));
            }
        }
        if corners.len() as u64 > input.options.limits.points {
            return Err(lines.fault(line, format!("more than {} corners", input.options.limits.points)));
        }
    }
    match is_closed {
        true => Ok(corners),
        false => Err(input.fault(input.line(input.bytes.len()), "the file ends; expected endsolid")),
    }
}

/// Makes a fan of a loop.
fn end(
    lines: &Lines<'_>,
    line: Line<'_>,
    polygon: &mut Vec<[f32; 3]>,
    corners: &mut Vec<[f32; 3]>,
    keyword: &[u8],
) -> Result<()> {
    if let [first, others @ ..] = polygon.as_slice() {
        if others.len() < 2 {
            let problem = format!("a loop of {} corners; expected 3", polygon.len());
            return Err(lines.fault(line, problem));
        }
        corners.extend(others.windows(2).flat_map(|pair| [&[*first], pair].concat()));
    } else if keyword == b"endloop" {
        return Err(lines.fault(line, "a loop of 0 corners; expected 3"));
    }
    polygon.clear();
    Ok(())
}
