//! A triangle as it is drawn: in view space, with all that a pixel asks of it.
//!
//! The ray of a pixel is inside if it is on the inner side of the three planes through the eye and an edge. Two triangles
//! at an edge have the same plane, bit by bit, with opposite signs: no pixel is in neither of them, and by the rule of
//! Direct3D and Vulkan for what is exactly on an edge (left and top edges belong) none is in both.

use glam::DVec3;

use super::surface::{Attributes, direction};
use super::view::View;

/// How far from a triangle's border pixels are told so: what snapping vertices to a grid of 1/16 pixel can move an edge.
pub(super) const BORDER_REACH_PX: f64 = 1.0 / 16.0;

/// A triangle in view space.
#[derive(Clone, Copy, Debug)]
pub(super) struct DrawnTriangle {
    pub corners: [DVec3; 3],
    /// The attributes of the corners. Normals are unit or zero, toward the side of the triangle that is seen.
    attributes: [Attributes; 3],
    /// The cross product of the edges from the first corner: twice the area.
    plane_normal: DVec3,
    /// It is of a closed surface: in transparent layers its normals stay outward.
    pub outward: bool,
    /// Normals, toward the triangle, of the planes through the eye and the edge opposite to each corner.
    inward: [DVec3; 3],
    /// Tells of each edge whether nothing of the object is drawn beyond it. True until told otherwise.
    pub is_border: [bool; 3],
}

/// A pixel beside or within the border of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Border {
    /// From the pixel's center to the border.
    pub distance_px: f64,
    /// About the triangle's depth there.
    pub z: f64,
}

impl DrawnTriangle {
    /// `None` where the triangle has no area. The normals are those of the counterclockwise side.
    pub fn new(corners: [DVec3; 3], attributes: [Attributes; 3]) -> Option<Self> {
        let [a, b, c] = corners;
        let (ab, ac) = (b - a, c - a);
        let plane_normal = ab.cross(ac);
        let area = plane_normal.length();
        // Of three points on a line rounding leaves so much. Written so that NaN is none.
        let has_area = area > 4.0 * f64::EPSILON * ab.length() * ac.length() && area.is_finite();
        if !has_area {
            return None;
        }
        let faces_away = faces_away(plane_normal, a);
        let side = if faces_away { 1.0 } else { -1.0 };
        let turned = |corner: Attributes| Attributes {
            normal: if faces_away { -1.0 } else { 1.0 } * corner.normal,
            ..corner
        };
        Some(Self {
            corners,
            attributes: attributes.map(turned),
            plane_normal,
            outward: false,
            inward: [b.cross(c), c.cross(a), a.cross(b)].map(|edge| side * edge),
            is_border: [true; 3],
        })
    }

    /// Whether it is seen from its clockwise side.
    pub fn faces_away(&self) -> bool {
        faces_away(self.plane_normal, self.corners[0])
    }

    /// The depth at which the ray meets the triangle, above 0; perhaps before the near plane.
    pub fn depth(&self, ray: DVec3) -> Option<f64> {
        let is_inside = |edge: &DVec3| {
            let inside = edge.dot(ray);
            let is_left_or_top = edge.x > 0.0 || (edge.x == 0.0 && edge.y > 0.0);
            inside > 0.0 || (inside == 0.0 && is_left_or_top)
        };
        let z = self.plane_depth(ray);
        (self.inward.iter().all(is_inside) && z > 0.0 && z.is_finite()).then_some(z)
    }

    fn plane_depth(&self, ray: DVec3) -> f64 {
        self.plane_normal.dot(self.corners[0]) / self.plane_normal.dot(ray)
    }

    /// Interpolated between the corners by area, at the point of the plane that the ray meets at depth `z`. A normal that
    /// vanishes is toward the eye, on either side of the triangle.
    pub fn attributes(&self, ray: DVec3, z: f64) -> Attributes {
        let [a, b, c] = self.corners;
        let (q, area) = (z * ray - a, self.plane_normal.length());
        let share = |cross: DVec3| (cross.dot(self.plane_normal / area) / area).clamp(0.0, 1.0);
        let (of_b, of_c) = (share(q.cross(c - a)), share((b - a).cross(q)));
        let shares = [(1.0 - of_b - of_c).max(0.0), of_b, of_c];
        let sum = |value: fn(&Attributes) -> DVec3| -> DVec3 {
            self.attributes.iter().zip(shares).map(|(corner, share)| share * value(corner)).sum()
        };
        let alpha: f64 = self.attributes.iter().zip(shares).map(|(corner, share)| share * corner.alpha).sum();
        Attributes {
            albedo: sum(|corner| corner.albedo),
            normal: direction(sum(|corner| corner.normal), 1.0),
            alpha: alpha.min(1.0),
        }
    }

    /// The attributes with the normal that a transparent layer sums: outward of what is closed.
    pub fn attributes_in_layer(&self, ray: DVec3, z: f64) -> Attributes {
        let attributes = self.attributes(ray, z);
        let turned = self.outward && self.faces_away();
        Attributes { normal: if turned { -attributes.normal } else { attributes.normal }, ..attributes }
    }

    /// `None` where no border is within [`BORDER_REACH_PX`]. A border reaches as far beyond the end of its edge.
    pub fn border(&self, ray: DVec3, view: &View) -> Option<Border> {
        // Where the edge's plane meets the image plane is a line; positive is inside.
        let inside_px = self.inward.map(|edge| edge.dot(ray) / edge.truncate().length() * view.focal_px);
        // Written so that an edge that points at the eye is not near.
        if !inside_px.iter().all(|inside_px| *inside_px >= -BORDER_REACH_PX) {
            return None;
        }
        let borders = inside_px.iter().zip(self.is_border).filter(|(_, is_border)| *is_border);
        let distance_px = borders.map(|(inside_px, _)| inside_px.abs()).fold(f64::INFINITY, f64::min);
        // Beside the triangle, and for one that is seen from its edge, its plane may be anywhere.
        let depths = self.corners.map(|corner| corner.z);
        let nearest = depths.into_iter().fold(f64::INFINITY, f64::min).max(view.near);
        let farthest = depths.into_iter().fold(0.0, f64::max);
        let z = self.plane_depth(ray).min(farthest).max(nearest);
        (distance_px <= BORDER_REACH_PX && farthest >= view.near).then_some(Border { distance_px, z })
    }
}

/// With a normal of the counterclockwise side and a point of the plane.
fn faces_away(plane_normal: DVec3, corner: DVec3) -> bool {
    plane_normal.dot(corner) > 0.0
}
