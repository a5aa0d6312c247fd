//! An object of a scene file.

use glam::DVec3;

use super::{
    description::{ObjectDescription, Polygons, Representation, Samples, Source},
    document::Table,
    light, picture, source, transform,
};
use crate::error::Result;

pub(super) const KEYS: &[&str] = &[
    "file",
    "builtin",
    "splats",
    "triangles",
    "name",
    "representation",
    "polygons",
    "sample_edges",
    "resample",
    "seed",
    "translate",
    "rotate_deg",
    "scale",
    "matrix",
    "color",
    "alpha",
    "epsilon",
];

/// The most letters of a name: it is a part of messages.
const MOST_LETTERS: usize = 100;

pub(super) fn read(table: &Table<'_>, outside: bool) -> Result<ObjectDescription> {
    let source = source::read(table, outside)?;
    let representation = representation(table)?;
    let samples = samples(table)?;
    check_together(table, &source, representation)?;
    let alpha = match table.get("alpha") {
        None => 1.0,
        Some(value) => value.number("a number from 0 to 1", |number| (0.0..=1.0).contains(&number))? as f32,
    };
    Ok(ObjectDescription {
        source,
        name: name(table)?,
        representation,
        samples,
        world_from_object: transform::read(table)?,
        color: table.get("color").map(|value| light::color(&value)).transpose()?,
        alpha,
        epsilon: table.get("epsilon").map(|value| picture::epsilon(&value)).transpose()?,
    })
}

/// Refuses what has no meaning together.
fn check_together(table: &Table<'_>, source: &Source, representation: Representation) -> Result<()> {
    if let Source::BuiltIn { model, .. } = source {
        if let (Some(value), false) = (table.get("representation"), model.has_triangles())
            && !matches!(representation, Representation::Splats | Representation::Auto)
        {
            return Err(value.expected("'splats': this built-in model has no triangles"));
        }
        table.refuse("resample", "for a built-in model; expected splats")?;
    }
    match representation {
        Representation::Splats | Representation::Auto => {
            let why = match source {
                Source::BuiltIn { model, .. } if model.has_triangles() => {
                    "for a model drawn as splats; expected representation = \"mesh\" or \"hybrid\""
                }
                _ => "for a model drawn as splats",
            };
            table.refuse("triangles", why)
        }
        Representation::Mesh => {
            let why = "for a model drawn as triangles";
            table.refuse("splats", why)?;
            table.refuse("resample", why)?;
            table.refuse("epsilon", why)
        }
        Representation::Hybrid { polygons: None, .. } => {
            let why = "for a hybrid without polygons, of which the view decides";
            table.refuse("sample_edges", why)?;
            table.refuse("epsilon", why)
        }
        Representation::Hybrid { polygons: Some(_), .. } => Ok(()),
    }
}

fn name(table: &Table<'_>) -> Result<Option<String>> {
    let Some(value) = table.get("name") else { return Ok(None) };
    let name = value.text("a name")?;
    let fits = !name.trim().is_empty()
        && name.chars().count() <= MOST_LETTERS
        && !name.chars().any(char::is_control);
    match fits {
        true => Ok(Some(name.to_owned())),
        false => Err(value.expected(&format!("1 to {MOST_LETTERS} letters on one line"))),
    }
}

fn representation(table: &Table<'_>) -> Result<Representation> {
    #[derive(Clone, Copy, PartialEq)]
    enum Name {
        Auto,
        Splats,
        Mesh,
        Hybrid,
    }
    let names =
        [("auto", Name::Auto), ("splats", Name::Splats), ("mesh", Name::Mesh), ("hybrid", Name::Hybrid)];
    let name = table.get("representation").map(|value| value.one_of(&names)).transpose()?;
    let name = name.unwrap_or(Name::Auto);
    if name != Name::Hybrid {
        let why = "without representation = \"hybrid\"";
        table.refuse("polygons", why)?;
        table.refuse("sample_edges", why)?;
    }
    Ok(match name {
        Name::Auto => Representation::Auto,
        Name::Splats => Representation::Splats,
        Name::Mesh => Representation::Mesh,
        Name::Hybrid => Representation::Hybrid {
            polygons: polygons(table)?,
            sample_edges: table.get("sample_edges").map_or(Ok(true), |value| value.yes_or_no())?,
        },
    })
}

/// Which triangles stay polygons, where the file says it.
fn polygons(table: &Table<'_>) -> Result<Option<Polygons>> {
    let Some(polygons) = table.table("polygons", &["plane", "longer_than"])? else {
        return Ok(None);
    };
    match (polygons.get("plane"), polygons.get("longer_than")) {
        (Some(plane), None) => {
            let what = "nx, ny, nz and d, the normal not zero";
            let [x, y, z, d] = plane.numbers(what, |_| true)?;
            let normal = DVec3::new(x, y, z);
            match normal.try_normalize() {
                Some(_) => Ok(Some(Polygons::Plane { normal, d })),
                None => Err(plane.expected(what)),
            }
        }
        (None, Some(length)) => {
            let length = length.number("a length, at least 0", |length| length >= 0.0)?;
            Ok(Some(Polygons::LongerThan(length)))
        }
        _ => Err(polygons.fault("expected plane or longer_than, and not both")),
    }
}

fn samples(table: &Table<'_>) -> Result<Option<Samples>> {
    let Some(count) = table.get("resample") else {
        table.refuse("seed", "without resample")?;
        return Ok(None);
    };
    let seed = table.get("seed").map(|value| value.whole(0, i64::MAX as u64)).transpose()?;
    Ok(Some(Samples { count: count.whole(1, u64::from(u32::MAX))?, seed: seed.unwrap_or(0) }))
}
