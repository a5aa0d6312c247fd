//! What is seen in one pixel, and where: all that covers it, one after the other.

use super::band::Drawn;
use super::drawn_clip::Clipped;
use super::kernel::limit_r2;
use super::splat::DrawnSplat;
use super::triangle::DrawnTriangle;
use super::view::View;
use super::{Frame, frame, splat};
use crate::error::Result;
use crate::scene::{Camera, Scene, Settings};

/// A scene of which pixels are picked.
pub struct Picker<'a>(Frame<'a>);

/// Something that covers a pixel, or that rounding may let cover it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The depth where the pixel's ray meets it, world units from the camera's eye along its axis.
    pub z: f64,
    /// The same moved away from the eye by ε: the smallest one is seen.
    pub z_shifted: f64,
    /// The number of its object and its own in there, where it is a splat; `None` of a triangle.
    pub splat: Option<[usize; 2]>,
    /// Rounding does not decide whether it covers the pixel.
    pub certain: bool,
}

impl<'a> Picker<'a> {
    /// What a scene looks like.
    ///
    /// # Errors
    /// As [`super::render`].
    pub fn new(scene: &Scene, camera: &Camera, settings: &'a Settings) -> Result<Self> {
        settings.validate()?;
        camera.validate()?;
        settings.check_camera(camera)?;
        settings.check_scene(scene)?;
        let view = View::of(scene, camera, settings.size_px).cut_by(scene, settings);
        let (splats, _) = splat::prepare(scene, &view, settings);
        Ok(Self(frame(scene, view, settings, splats)))
    }

    /// All that covers a pixel, or may.
    pub fn at(&self, [column, row]: [u32; 2]) -> Vec<Candidate> {
        let frame = &self.0;
        let is_there = |i: usize, drawn: &Drawn<DrawnSplat>| {
            let search = &drawn.boxes[i];
            search.columns.contains(&column) && search.clipped(&(row..row + 1)).next().is_some()
        };
        let of_splats = |drawn: &Drawn<DrawnSplat>| -> Vec<Candidate> {
            let splats = drawn.things.iter().enumerate().filter(|(i, _)| is_there(*i, drawn));
            splats.filter_map(|(_, splat)| self.of_splat(splat, [column, row])).collect()
        };
        let of_triangles = |drawn: &Drawn<DrawnTriangle>, epsilon: f64| -> Vec<Candidate> {
            drawn.things.iter().filter_map(|it| self.of_triangle(it, epsilon, [column, row])).collect()
        };
        let mut all = of_splats(&frame.splats);
        all.extend(of_splats(&frame.transparent_splats));
        all.extend(of_triangles(&frame.triangles, 0.0));
        all.extend(of_triangles(&frame.transparent_triangles, frame.polygon_epsilon));
        for candidate in &mut all {
            candidate.z -= frame.view.moved_back;
            candidate.z_shifted -= frame.view.moved_back;
        }
        all
    }

    fn of_splat(&self, splat: &DrawnSplat, [column, row]: [u32; 2]) -> Option<Candidate> {
        let (view, kernel) = (&self.0.view, self.0.settings.kernel);
        let ray = view.ray(column, row);
        let [x_px, y_px] = view.offset_px(column, row);
        let rim = splat.rim(ray, x_px.hypot(y_px), limit_r2(kernel), view);
        let fragment = splat.fragment(ray, view, kernel);
        let z = fragment.map(|fragment| fragment.z).or(rim.map(|rim| rim.z))?;
        let certain = fragment.is_some() && rim.is_none();
        Some(Candidate { z, z_shifted: z * splat.shift, splat: Some(splat.source), certain })
    }

    fn of_triangle(
        &self,
        triangle: &DrawnTriangle,
        epsilon: f64,
        [column, row]: [u32; 2],
    ) -> Option<Candidate> {
        let view = &self.0.view;
        let ray = view.ray(column, row);
        let z = triangle.depth(ray).filter(|z| *z >= view.near && view.cuts(ray, *z) != Clipped::Removed);
        // Beside an edge that two triangles share, either may be taken.
        let near_edge = triangle.border(ray, view);
        let at = z.or(near_edge.map(|border| border.z))?;
        let certain = z.is_some_and(|z| view.cuts(ray, z) == Clipped::Kept) && near_edge.is_none();
        Some(Candidate { z: at, z_shifted: at + epsilon, splat: None, certain })
    }
}
