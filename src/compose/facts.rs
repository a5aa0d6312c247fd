//! What a model's file holds, for reports.

use glam::DVec3;

use crate::{
    load::{Loaded, Model},
    report::ModelReport,
    scene::Colors,
};

/// The facts of a file that was read, before anything was done with its model.
pub(super) fn of(loaded: &Loaded) -> ModelReport {
    let own_colors = |colors: &Colors| matches!(colors, Colors::Each(_));
    let (positions, triangles, normals, colors, sizes) = match &loaded.model {
        Model::Splats { splats, .. } => (&splats.positions, None, true, &splats.colors, true),
        Model::Mesh(mesh) => {
            (&mesh.positions, Some(mesh.triangles.len()), mesh.normals.is_some(), &mesh.colors, false)
        }
        Model::Points(points) => {
            let (normals, sizes) = (points.normals.is_some(), points.radii.is_some());
            (&points.positions, None, normals, &points.colors, sizes)
        }
    };
    ModelReport {
        format: loaded.format.clone(),
        holds: loaded.model.contents(),
        points: positions.len(),
        triangles,
        bounds: bounds(positions),
        metres_per_unit: loaded.metres_per_unit,
        up: loaded.up.map(|up| up.to_array()),
        normals,
        colors: own_colors(colors),
        sizes,
    }
}

/// The box around all places that are finite.
fn bounds(positions: &[DVec3]) -> Option<[[f64; 3]; 2]> {
    let finite = positions.iter().filter(|position| position.is_finite());
    let both = finite.map(|position| [*position; 2]);
    let ends = both.reduce(|[least, most], [a, b]| [least.min(a), most.max(b)])?;
    Some(ends.map(|end| end.to_array()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_of_what_is_finite() {
        let infinite = DVec3::new(f64::INFINITY, 0.0, 0.0);
        let places = [DVec3::new(1.0, -2.0, 3.0), infinite, DVec3::new(-1.0, 0.0, f64::NAN), DVec3::ONE];
        assert_eq!(bounds(&places), Some([[1.0, -2.0, 1.0], [1.0, 1.0, 3.0]]));
        assert_eq!(bounds(&[infinite]), None);
    }
}
