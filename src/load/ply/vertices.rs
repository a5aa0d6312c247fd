//! The element `vertex`: positions and what makes them splats.

use std::iter::repeat;

use glam::{DVec3, Vec3};

use super::{
    body::Table,
    clips::FileClips,
    colors::{FileColors, Meaning, White, unknown},
    gaussian,
    layout::Layout,
    schema::Scalar,
};
use crate::scene::ClipCurve;

/// All vertices, an array for each group that the file has.
pub(super) struct Vertices {
    pub positions: Vec<DVec3>,
    /// Beside tangent vectors, a normal gives only the side, and is not kept.
    pub normals: Option<Vec<Vec3>>,
    pub radii: Option<Vec<f32>>,
    /// In an unknown unit.
    pub sizes: Option<Vec<f32>>,
    pub tangents: Option<(Vec<Vec3>, Vec<Vec3>)>,
    pub clips: Option<FileClips>,
    pub colors: Option<FileColors>,
    /// Which of the file's Gaussians are part of a surface.
    pub solid: Option<Vec<bool>>,
}

impl Vertices {
    /// No vertices, but room for `count`, a number that was checked against the file's size.
    pub(super) fn new(layout: &Layout, count: usize) -> Self {
        let has_tangents = layout.tangents.is_some() || layout.gaussian.is_some();
        Self {
            positions: Vec::with_capacity(count),
            normals: (layout.normal.is_some() && !has_tangents).then(|| Vec::with_capacity(count)),
            radii: layout.radius.map(|_| Vec::with_capacity(count)),
            sizes: layout.size.map(|_| Vec::with_capacity(count)),
            tangents: has_tangents.then(|| (Vec::with_capacity(count), Vec::with_capacity(count))),
            clips: layout.clips.map(|_| FileClips::default()),
            colors: colors(layout, count),
            solid: layout.gaussian.map(|_| Vec::with_capacity(count)),
        }
    }

    /// Adds the vertices of a table.
    pub(super) fn extend(&mut self, layout: &Layout, table: &Table) {
        self.positions.extend(table.vectors(layout.position));
        if let (Some(normals), Some(columns)) = (&mut self.normals, layout.normal) {
            normals.extend(table.vectors(columns).map(|normal| normal.as_vec3()));
        }
        for (lengths, column) in [(&mut self.radii, layout.radius), (&mut self.sizes, layout.size)] {
            if let (Some(lengths), Some(column)) = (lengths, column) {
                lengths.extend(table.column(column).iter().map(|&length| length as f32));
            }
        }
        let new = self.positions.len() - self.clips.as_ref().map_or(0, |clips| clips.each.len());
        if let (Some(clips), Some(columns)) = (&mut self.clips, &layout.clips) {
            clips.extend(columns, table, new);
        }
        self.extend_tangents(layout, table);
        if let (Some(solid), Some(gaussian)) = (&mut self.solid, &layout.gaussian) {
            solid.extend(gaussian::are_solid(gaussian, table));
        }
        if let Some(colors) = &mut self.colors {
            extend_colors(colors, layout, table);
        }
    }

    fn extend_tangents(&mut self, layout: &Layout, table: &Table) {
        let Some((all_s, all_t)) = &mut self.tangents else { return };
        let old = all_s.len();
        if let Some(gaussian) = &layout.gaussian {
            for [s, t] in gaussian::tangents(gaussian, table) {
                all_s.push(s);
                all_t.push(t);
            }
        } else if let Some([s, t]) = layout.tangents {
            all_s.extend(table.vectors(s).map(|s| s.as_vec3()));
            all_t.extend(table.vectors(t).map(|t| t.as_vec3()));
        }
        if let Some(columns) = layout.normal {
            let new = all_t.iter_mut().zip(all_s.iter()).enumerate().skip(old);
            for ((i, (t, s)), normal) in new.zip(table.vectors(columns)) {
                // −t spans the same disk and turns the normal s×t around.
                if s.as_dvec3().cross(t.as_dvec3()).dot(normal) < 0.0 {
                    *t = -*t;
                    if let Some(clip) = self.clips.as_mut().and_then(|clips| clips.each.get_mut(i)) {
                        *clip = clip.map(ClipCurve::flipped);
                    }
                }
            }
        }
    }
}

/// No colors, but room for `count`, if the file has some.
fn colors(layout: &Layout, count: usize) -> Option<FileColors> {
    let white = |meaning: Meaning, column: usize| {
        White::new(meaning, layout.types.get(column).copied().unwrap_or(Scalar::Float))
    };
    let meaning = if layout.exact_colors { Meaning::Exact } else { Meaning::Color };
    let rgb = match (layout.rgb, layout.intensity) {
        (Some(columns), _) => Some(columns.map(|column| white(meaning, column))),
        (None, Some(column)) => Some([white(Meaning::Intensity, column); 3]),
        (None, None) => layout.gaussian.and_then(|gaussian| gaussian.color).map(|_| [White::UNIT; 3]),
    };
    if rgb.is_none() && layout.alpha.is_none() {
        return None;
    }
    let [red, green, blue] = rgb.unwrap_or([White::UNIT; 3]);
    let alpha = layout.alpha.map_or(White::UNIT, |column| white(meaning, column));
    Some(FileColors::new([red, green, blue, alpha], count))
}

/// Adds the colors of a table's vertices.
fn extend_colors(colors: &mut FileColors, layout: &Layout, table: &Table) {
    let of_gaussians = layout.gaussian.and_then(|gaussian| gaussian.color);
    let rgb = layout.rgb.or(layout.intensity.map(|column| [column; 3]));
    match (of_gaussians, rgb, layout.alpha) {
        (Some(columns), ..) => colors.extend(gaussian::colors(columns, table), repeat(1.0)),
        (_, Some(rgb), Some(alpha)) => {
            colors.extend(table.vectors(rgb), table.column(alpha).iter().copied());
        }
        (_, Some(rgb), None) => colors.extend(table.vectors(rgb), repeat(1.0)),
        (_, None, Some(alpha)) => colors.extend(unknown(), table.column(alpha).iter().copied()),
        (_, None, None) => {}
    }
}
