//! Splats that are picked from others or put together.

use super::{Clips, Colors, Shapes, Splats};

impl Splats {
    /// Not one, of disks with a color each.
    pub fn none() -> Self {
        let shapes = Shapes::Disks { normals: Vec::new(), radii: Vec::new() };
        Self::new(Vec::new(), shapes, Colors::Each(Vec::new()))
    }

    /// None of the same kind, with room for so many; where there is one color for all, that stays.
    pub fn with_room(&self, count: usize) -> Self {
        Self {
            positions: Vec::with_capacity(count),
            shapes: match &self.shapes {
                Shapes::Disks { .. } => {
                    Shapes::Disks { normals: Vec::with_capacity(count), radii: Vec::with_capacity(count) }
                }
                Shapes::Ellipses { .. } => {
                    Shapes::Ellipses { s: Vec::with_capacity(count), t: Vec::with_capacity(count) }
                }
            },
            colors: match self.colors {
                Colors::Uniform(color) => Colors::Uniform(color),
                Colors::Each(_) => Colors::Each(Vec::with_capacity(count)),
            },
            clips: Clips::default(),
        }
    }

    /// Adds others of the same kind; where there is one color for all, it stays. Others of another kind are left out.
    pub fn append(&mut self, others: Self) {
        match (&mut self.shapes, others.shapes) {
            (Shapes::Disks { normals, radii }, Shapes::Disks { normals: more, radii: more_radii }) => {
                normals.extend(more);
                radii.extend(more_radii);
            }
            (Shapes::Ellipses { s, t }, Shapes::Ellipses { s: more_s, t: more_t }) => {
                s.extend(more_s);
                t.extend(more_t);
            }
            _ => return,
        }
        self.clips.append(self.positions.len(), others.clips, others.positions.len());
        self.positions.extend(others.positions);
        if let (Colors::Each(colors), Colors::Each(more)) = (&mut self.colors, others.colors) {
            colors.extend(more);
        }
    }

    /// Those of these numbers, in their order.
    #[must_use]
    pub fn picked(&self, which: impl Iterator<Item = usize> + Clone) -> Self {
        fn of<T: Copy>(all: &[T], which: impl Iterator<Item = usize>) -> Vec<T> {
            which.map(|i| all[i]).collect()
        }
        Self {
            positions: of(&self.positions, which.clone()),
            shapes: match &self.shapes {
                Shapes::Disks { normals, radii } => {
                    Shapes::Disks { normals: of(normals, which.clone()), radii: of(radii, which.clone()) }
                }
                Shapes::Ellipses { s, t } => {
                    Shapes::Ellipses { s: of(s, which.clone()), t: of(t, which.clone()) }
                }
            },
            colors: match &self.colors {
                Colors::Uniform(color) => Colors::Uniform(*color),
                Colors::Each(colors) => Colors::Each(of(colors, which.clone())),
            },
            clips: self.clips.picked(which),
        }
    }
}
