//! Longitude and latitude in degrees become lengths: degrees beside metres of height are no shape.

use glam::{DVec2, DVec3};

use super::Loaded;
use crate::{notes::Deed, scene::Points};

/// The half axes of the ellipsoid WGS 84, in metres.
const EQUATORIAL: f64 = 6_378_137.0;
const POLAR: f64 = 6_356_752.314_245;

/// Where degrees are, told by the middle of what is finite; `None` where nothing is, or where it is no place on earth.
pub(super) struct Place {
    middle: DVec2,
    /// Metres of a degree east and north.
    metres: DVec2,
}

impl Place {
    pub fn of(points: &Points) -> Option<Self> {
        let finite =
            || points.positions.iter().map(|place| place.truncate()).filter(|place| place.is_finite());
        let (least, most) = (finite().reduce(DVec2::min)?, finite().reduce(DVec2::max)?);
        let middle = 0.5 * (least + most);
        let is_on_earth = least.y >= -90.0 && most.y <= 90.0 && least.x >= -360.0 && most.x <= 360.0;
        is_on_earth.then(|| Self { middle, metres: metres_of_degree(middle.y.to_radians()) })
    }

    /// Puts longitude, latitude and a height in metres in a plane that touches the earth in the middle: east, north and that height. Directions
    /// and lengths are right in the middle, and a degree from it those along a parallel by some percent wrong.
    pub fn flatten(&self, points: &mut Points) {
        for place in &mut points.positions {
            let flat = (place.truncate() - self.middle) * self.metres;
            *place = flat.extend(place.z);
        }
    }

    /// Tells what [`Place::flatten`] did.
    pub fn tell(&self, loaded: &mut Loaded, count: u64) {
        let [east, north] = self.middle.to_array().map(|degrees| (degrees * 1e6).round() / 1e6);
        let what = format!("longitudes and latitudes, by metres east and north of {east},{north},");
        loaded.note(Deed::Replaced, count, what);
        loaded.metres_per_unit = Some(1.0);
        loaded.up = Some(DVec3::Z);
    }
}

/// Of the ellipsoid's curvatures along a parallel and a meridian.
fn metres_of_degree(latitude_rad: f64) -> DVec2 {
    let (sin, cos) = latitude_rad.sin_cos();
    let (a, b) = (EQUATORIAL * EQUATORIAL, POLAR * POLAR);
    let root = (a * cos * cos + b * sin * sin).sqrt();
    let [prime_vertical, meridian] = [a / root, a * b / (root * root * root)];
    DVec2::new(prime_vertical * cos, meridian) * 1.0_f64.to_radians()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_degree_has_its_length() {
        // Known lengths of a degree of longitude and of latitude.
        for (latitude, expected) in [
            (0.0_f64, [111_319.491, 110_574.276]),
            (45.0, [78_846.835, 111_131.778]),
            (60.0, [55_799.980, 111_412.273]),
        ] {
            let found = metres_of_degree(latitude.to_radians());
            assert!(found.distance(expected.into()) < 0.3, "{latitude}: {found}");
        }
    }

    #[test]
    fn what_is_no_place_on_earth_stays() {
        let at = |positions: Vec<DVec3>| Points { positions, ..Points::default() };
        assert!(Place::of(&at(vec![DVec3::new(11.0, 95.0, 0.0)])).is_none());
        assert!(Place::of(&at(vec![DVec3::NAN])).is_none() && Place::of(&at(Vec::new())).is_none());
        let mut points = at(vec![DVec3::new(10.0, 45.0, 7.0), DVec3::NAN, DVec3::new(11.0, 45.5, 9.0)]);
        let place = Place::of(&points).unwrap();
        place.flatten(&mut points);
        let way = points.positions[2] - points.positions[0];
        assert!((way.x / 78_504.0 - 1.0).abs() < 1e-3 && (way.y / 55_570.0 - 1.0).abs() < 1e-3, "{way}");
        assert_eq!((way.z, points.positions[0].z), (2.0, 7.0));
        assert!(points.positions[1].is_nan());
    }
}
