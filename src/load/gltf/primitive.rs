//! The corners of a glTF primitive: lists, strips and fans of triangles, and points.

use super::{
    accessor::Elements,
    buffers::Buffers,
    document::{Attributes, Document, Primitive},
};
use crate::{error::Result, load::Input};

/// What the corners of a primitive make.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Mode {
    Points,
    /// Any of the three kinds.
    Lines,
    Triangles,
    Strip,
    Fan,
}

impl Mode {
    pub fn of(input: &Input<'_>, primitive: &Primitive) -> Result<Self> {
        match primitive.mode.unwrap_or(4) {
            0 => Ok(Self::Points),
            1..=3 => Ok(Self::Lines),
            4 => Ok(Self::Triangles),
            5 => Ok(Self::Strip),
            6 => Ok(Self::Fan),
            mode => Err(input.fault("", format!("a primitive of mode {mode}; expected 0 to 6"))),
        }
    }
}

/// What a primitive's vertices have, each as many as there are positions.
pub(super) struct Vertices<'a> {
    pub positions: Elements<'a>,
    pub normals: Option<Elements<'a>>,
    pub colors: Option<Elements<'a>>,
}

/// `None` without positions.
pub(super) fn vertices<'a>(
    input: &Input<'_>,
    document: &Document<'_>,
    buffers: &mut Buffers<'a>,
    primitive: &Primitive,
) -> Result<Option<Vertices<'a>>> {
    let mut elements = |i: Option<u32>, widths: &[usize], what: &str| {
        i.map(|i| Elements::new(input, document, buffers, i, widths, what)).transpose()
    };
    let Attributes { position, normal, color } = primitive.attributes;
    let Some(positions) = elements(position, &[3], "positions")? else { return Ok(None) };
    let vertices = Vertices {
        positions,
        normals: elements(normal, &[3], "normals")?,
        colors: elements(color, &[3, 4], "colors")?,
    };
    for (other, what) in [(&vertices.normals, "normals"), (&vertices.colors, "colors")] {
        if let Some(other) = other.as_ref().filter(|other| other.count != vertices.positions.count) {
            let (count, others) = (vertices.positions.count, other.count);
            let problem = format!("a primitive of {count} positions and {others} {what}; expected as many");
            return Err(input.fault("", problem));
        }
    }
    Ok(Some(vertices))
}

/// The vertices in the order in which they are corners, each below `count`.
pub(super) fn corners(
    input: &Input<'_>,
    document: &Document<'_>,
    buffers: &mut Buffers<'_>,
    primitive: &Primitive,
    count: usize,
) -> Result<Vec<u32>> {
    let Some(i) = primitive.indices else {
        return Ok((0..count as u32).collect());
    };
    let elements = Elements::new(input, document, buffers, i, &[1], "indices")?;
    let fault = |problem: String| input.fault(format!("accessor {i}"), problem);
    if !elements.is_unsigned() {
        return Err(fault("numbers of another kind than indices have".to_owned()));
    }
    let index = |k: usize| -> Result<u32> {
        let [index, ..] = elements.get(k);
        match index < count as f64 {
            true => Ok(index as u32),
            false => Err(fault(format!("vertex {index}, but the primitive has {count}, from 0"))),
        }
    };
    (0..elements.count).map(index).collect()
}

/// The triangles of corners, all with the same side to the front, and how many corners are left over.
pub(super) fn triangles(mode: Mode, corners: &[u32]) -> (Vec<[u32; 3]>, u64) {
    let three = |window: &[u32]| <[u32; 3]>::try_from(window).ok();
    match mode {
        Mode::Points | Mode::Lines => (Vec::new(), 0),
        Mode::Triangles => {
            let triples = corners.chunks_exact(3);
            let rest = triples.remainder().len() as u64;
            (triples.filter_map(three).collect(), rest)
        }
        Mode::Strip => {
            let turned = |(i, [a, b, c]): (usize, [u32; 3])| if i % 2 == 0 { [a, b, c] } else { [b, a, c] };
            (corners.windows(3).filter_map(three).enumerate().map(turned).collect(), 0)
        }
        Mode::Fan => match corners {
            [first, others @ ..] => {
                let pair = |pair: &[u32]| Some([*first, *pair.first()?, *pair.get(1)?]);
                (others.windows(2).filter_map(pair).collect(), 0)
            }
            [] => (Vec::new(), 0),
        },
    }
}

/// What primitives have in common that have the same vertices.
pub(super) type Shared = ([Option<u32>; 3], Option<u32>);

/// Tells which primitives have the same vertices.
pub(super) fn shared(primitive: &Primitive) -> Shared {
    let Attributes { position, normal, color } = primitive.attributes;
    ([position, normal, color], primitive.material)
}

/// The color of a material.
pub(super) struct BaseColor {
    /// Linear.
    pub color: [f64; 4],
    pub is_opaque: bool,
}

/// White without a material.
pub(super) fn base_color(
    input: &Input<'_>,
    document: &Document<'_>,
    primitive: &Primitive,
) -> Result<BaseColor> {
    let Some(i) = primitive.material else { return Ok(BaseColor { color: [1.0; 4], is_opaque: true }) };
    let Some(material) = document.materials.get(i as usize) else {
        let problem = format!("not there; the file has {}", document.materials.len());
        return Err(input.fault(format!("material {i}"), problem));
    };
    let factor = material.pbr_metallic_roughness.as_ref().and_then(|pbr| pbr.base_color_factor);
    let is_opaque = material.alpha_mode.as_deref().unwrap_or("OPAQUE") == "OPAQUE";
    Ok(BaseColor { color: factor.unwrap_or([1.0; 4]), is_opaque })
}
