//! The header of a PCD file: what its points have and how it is written.

use glam::DVec3;

use crate::{
    error::Result,
    load::{
        Input,
        lines::{Line, Lines, shown},
    },
};

/// How the numbers of a field are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Signed,
    Unsigned,
    Float,
}

/// One field of a point.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub name: String,
    pub kind: Kind,
    /// Bytes of a number: 1, 2, 4 or 8.
    pub size: usize,
    /// How many numbers it has.
    pub count: usize,
    /// Bytes of a point before it.
    pub offset: usize,
    /// Numbers of a point before it.
    pub index: usize,
}

/// How points are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    Binary,
    Compressed,
}

/// All of the header.
#[derive(Clone, Debug)]
pub(super) struct Header {
    pub fields: Vec<Field>,
    /// How many there are.
    pub points: usize,
    pub encoding: Encoding,
    /// Where the scanner was; `None` at the origin, which is what is written where it is not known.
    pub viewpoint: Option<DVec3>,
    /// Bytes of a point.
    pub record_bytes: usize,
    /// Numbers of a point.
    pub record_numbers: usize,
    /// The first byte behind the header.
    pub end: usize,
}

/// More fields than this no writer makes, and each is looked for by its name.
const MOST_FIELDS: usize = 1024;

/// Reads the header, up to the line `DATA`.
pub(super) fn read(input: &Input<'_>) -> Result<Header> {
    let mut lines = Lines::new(input, Some(b'#'));
    let mut fields: Vec<Field> = Vec::new();
    let (mut sizes, mut kinds, mut counts) = (Vec::new(), Vec::new(), Vec::new());
    let (mut area, mut points, mut viewpoint) = ([None, None], None, None);
    loop {
        let line = lines.expect("a header that ends with DATA")?;
        if lines.at() > input.options.limits.header_bytes {
            return Err(lines
                .fault(line, format!("a header of more than {} bytes", input.options.limits.header_bytes)));
        }
        let mut words = line.words();
        let keyword = words.next().unwrap_or_default();
        let whole = |words: &mut dyn Iterator<Item = _>| {
            lines.number::<u64>(line, &mut &mut *words, "a whole number")
        };
        match keyword {
            b"VERSION" => {}
            b"FIELDS" | b"COLUMNS" => fields = words.map(named).collect(),
            b"SIZE" => {
                sizes = words
                    .map(|word| lines.number(line, &mut [word].into_iter(), "a size"))
                    .collect::<Result<_>>()?
            }
            b"TYPE" => kinds = words.map(|word| kind(&lines, line, word)).collect::<Result<_>>()?,
            b"COUNT" => {
                counts = words
                    .map(|word| lines.number(line, &mut [word].into_iter(), "a count"))
                    .collect::<Result<_>>()?
            }
            b"WIDTH" => area[0] = Some(whole(&mut words)?),
            b"HEIGHT" => area[1] = Some(whole(&mut words)?),
            b"POINTS" => points = Some(whole(&mut words)?),
            b"VIEWPOINT" => {
                let mut next = || lines.number(line, &mut words, "a coordinate of the viewpoint");
                let place = DVec3::new(next()?, next()?, next()?);
                viewpoint = (place.is_finite() && place != DVec3::ZERO).then_some(place);
            }
            b"DATA" => {
                let encoding = match words.next() {
                    Some(b"ascii") => Encoding::Ascii,
                    Some(b"binary") => Encoding::Binary,
                    Some(b"binary_compressed") => Encoding::Compressed,
                    other => {
                        let found = shown(other.unwrap_or_default());
                        return Err(lines.fault(
                            line,
                            format!("DATA '{found}'; expected ascii, binary or binary_compressed"),
                        ));
                    }
                };
                let points = number_of_points(area, points).map_err(|problem| lines.fault(line, problem))?;
                let (record_bytes, record_numbers) = complete(&mut fields, &sizes, &kinds, &counts)
                    .map_err(|problem| lines.fault(line, problem))?;
                let end = lines.at().min(input.bytes.len());
                return Ok(Header { fields, points, encoding, viewpoint, record_bytes, record_numbers, end });
            }
            other => {
                return Err(lines.fault(line, format!("'{}'; expected a word of a PCD header", shown(other))));
            }
        }
        if fields.len() > MOST_FIELDS {
            return Err(lines.fault(line, format!("{} fields; expected at most {MOST_FIELDS}", fields.len())));
        }
    }
}

fn named(word: &[u8]) -> Field {
    let name = shown(word);
    Field { name, kind: Kind::Float, size: 4, count: 1, offset: 0, index: 0 }
}

fn kind(lines: &Lines<'_>, line: Line<'_>, word: &[u8]) -> Result<Kind> {
    match word {
        b"I" => Ok(Kind::Signed),
        b"U" => Ok(Kind::Unsigned),
        b"F" => Ok(Kind::Float),
        _ => Err(lines.fault(line, format!("TYPE '{}'; expected I, U or F", shown(word)))),
    }
}

/// From `WIDTH` and `HEIGHT` and `POINTS`, of which either may be missing.
fn number_of_points(area: [Option<u64>; 2], points: Option<u64>) -> Result<usize, String> {
    let of_area = match area {
        [Some(width), height] => width.checked_mul(height.unwrap_or(1)),
        [None, _] => points,
    };
    match (of_area, points) {
        (Some(area), points) if points.is_none_or(|points| points == area) => {
            usize::try_from(area).map_err(|e| e.to_string())
        }
        (None, None) if area[0].is_none() => Err("neither POINTS nor WIDTH before it".to_owned()),
        (_, points) => {
            let [width, height] = area.map(|side| side.unwrap_or(1));
            Err(format!(
                "WIDTH {width}, HEIGHT {height} and POINTS {points:?}; expected the product",
                points = points.unwrap_or(0)
            ))
        }
    }
}

/// Gives the fields their sizes, and the bytes and numbers of a point.
fn complete(
    fields: &mut [Field],
    sizes: &[usize],
    kinds: &[Kind],
    counts: &[usize],
) -> Result<(usize, usize), String> {
    let all = fields.len();
    for (found, what, may_be_missing) in
        [(sizes.len(), "SIZE", false), (kinds.len(), "TYPE", false), (counts.len(), "COUNT", true)]
    {
        if found != all && !(found == 0 && may_be_missing) {
            return Err(format!("{all} FIELDS and {found} of {what}; expected as many"));
        }
    }
    let (mut bytes, mut numbers) = (0_usize, 0_usize);
    for (i, field) in fields.iter_mut().enumerate() {
        field.size = sizes.get(i).copied().unwrap_or(4);
        field.kind = kinds.get(i).copied().unwrap_or(Kind::Float);
        field.count = counts.get(i).copied().unwrap_or(1);
        (field.offset, field.index) = (bytes, numbers);
        let allowed: &[usize] = if field.kind == Kind::Float { &[4, 8] } else { &[1, 2, 4, 8] };
        if !allowed.contains(&field.size) {
            return Err(format!(
                "field '{}' of SIZE {}; expected one of {allowed:?}",
                field.name, field.size
            ));
        }
        let more = field.size.checked_mul(field.count);
        let sum = more.and_then(|more| bytes.checked_add(more)).zip(numbers.checked_add(field.count));
        (bytes, numbers) = sum.ok_or_else(|| format!("field '{}' of COUNT {}", field.name, field.count))?;
    }
    Ok((bytes, numbers))
}
