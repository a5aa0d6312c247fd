//! Lists of a scene that belong together: each has as many as there are positions.

use super::{Colors, Scene, Shapes, Splats};
use crate::error::{Error, Result};

impl Scene {
    /// Refuses an object or a mesh, by its name, of which a list is shorter or longer than that of its positions.
    pub(crate) fn check_lengths(&self) -> Result<()> {
        let of_splats = self.objects.iter().map(|object| ("object", &object.name, lists(&object.splats)));
        let of_levels = self.leveled.iter().map(|object| ("object", &object.name, lists(&object.leaves)));
        let of_meshes = self.meshes.iter().map(|object| {
            let normals = object.mesh.normals.as_ref().map(Vec::len);
            let colors = of_colors(&object.mesh.colors);
            let lists = [("normals", normals), ("colors", colors), ("colors", None)];
            ("mesh", &object.name, (object.mesh.positions.len(), lists))
        });
        for (kind, name, (positions, lists)) in of_splats.chain(of_levels).chain(of_meshes) {
            for (list, count) in lists {
                if let Some(count) = count.filter(|count| *count != positions) {
                    let problem = format!("{positions} positions, and {count} {list}; expected as many");
                    return Err(Error::option(format!("{kind} '{name}'"), problem));
                }
            }
        }
        Ok(())
    }
}

/// How many positions there are, and how many of what goes with them.
type Lists = (usize, [(&'static str, Option<usize>); 3]);

fn lists(splats: &Splats) -> Lists {
    let [first, second] = match &splats.shapes {
        Shapes::Disks { normals, radii } => [("normals", normals.len()), ("radii", radii.len())],
        Shapes::Ellipses { s, t } => [("first tangents", s.len()), ("second tangents", t.len())],
    };
    let some = |(list, count)| (list, Some(count));
    (splats.positions.len(), [some(first), some(second), ("colors", of_colors(&splats.colors))])
}

fn of_colors(colors: &Colors) -> Option<usize> {
    match colors {
        Colors::Uniform(_) => None,
        Colors::Each(colors) => Some(colors.len()),
    }
}
