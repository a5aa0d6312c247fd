//! Planes that cut the scene, by key: one that faces the eye, or a box.

use glam::DVec3;
use surfel::scene::{Bounds, ClipBox, ClipPlanes, OptionValue as _, Settings};

use super::{capture::rounded, keys::Cutting, viewer::Viewer};

/// What a key moves a plane by, in radii of the scene.
const STEP: f64 = 0.05;
/// The least half side of a box, in radii of the scene.
const LEAST_HALF: f64 = 1e-3;
/// How far a box is around all, in radii of the scene: a side that lay in a flat side of it would cut at random. Steps inward don't meet it either.
const AROUND: f64 = 0.01;

impl Viewer {
    /// Cuts, or cuts no more.
    pub fn cut(&mut self, how: Cutting) {
        let (Some(document), Some(navigation)) = (&self.document, &self.navigation) else { return };
        let radius = document.ball.radius;
        let cut = match how {
            Cutting::Plane => plane(&self.settings, navigation.pivot(), navigation.forward()),
            Cutting::Box => around(
                &self.settings,
                document.bounds().unwrap_or(Bounds::of_ball(document.ball.center, radius)),
                AROUND * radius,
            ),
            Cutting::More => moved(&self.settings, STEP * radius, LEAST_HALF * radius),
            Cutting::Less => moved(&self.settings, -STEP * radius, LEAST_HALF * radius),
        };
        let words = words(&cut);
        let shown = rounded(&words, self.decimals());
        let told = match (words.is_empty(), how) {
            (true, _) => "nothing is cut".to_owned(),
            (false, Cutting::Plane) => format!("{shown}: = cuts deeper, - less deep"),
            (false, Cutting::Box) => format!("{shown}: around all; = cuts deeper, - less deep"),
            (false, _) => shown,
        };
        self.ui.tell(&told);
        self.set(cut);
    }
}

/// What is cut, as options of the command line.
pub fn words(settings: &Settings) -> String {
    let planes = settings.clip_planes.0.iter().map(|plane| {
        let [a, b, c, d] = plane;
        format!("--clip-plane {a},{b},{c},{d}")
    });
    let of_box = settings.clip_box.0.map(|_| format!("--clip-box {}", settings.clip_box.word()));
    planes.chain(of_box).collect::<Vec<_>>().join(" ")
}

/// A plane through a point, of which what is farther along an axis is left; none where there is one.
fn plane(settings: &Settings, point: DVec3, axis: DVec3) -> Settings {
    let clip_planes = match settings.clip_planes.0.is_empty() {
        // Without zeros that are negative, which would be told so.
        true => ClipPlanes([[axis.x, axis.y, axis.z, axis.dot(point)].map(|part| part + 0.0)].into()),
        false => ClipPlanes::default(),
    };
    Settings { clip_planes, clip_box: ClipBox(None), ..settings.clone() }
}

/// A box around bounds, so far away; none where there is one.
fn around(settings: &Settings, bounds: Bounds, by: f64) -> Settings {
    let corners = [bounds.min - by, bounds.max + by].map(|corner| corner.to_array());
    let clip_box = ClipBox(settings.clip_box.0.is_none().then_some(corners));
    Settings { clip_box, clip_planes: ClipPlanes::default(), ..settings.clone() }
}

/// All planes moved inward by a length.
fn moved(settings: &Settings, by: f64, least_half: f64) -> Settings {
    let plane = |[a, b, c, d]: [f64; 4]| [a, b, c, d + by * DVec3::new(a, b, c).length()];
    let clip_planes = ClipPlanes(settings.clip_planes.0.iter().copied().map(plane).collect());
    let smaller = |[min, max]: [[f64; 3]; 2]| {
        let sides = [0, 1, 2].map(|i| {
            let (middle, half) = (0.5 * (min[i] + max[i]), 0.5 * (max[i] - min[i]));
            let half = (half - by).max(half.min(least_half));
            [middle - half, middle + half]
        });
        [0, 1].map(|end| sides.map(|side| side[end]))
    };
    Settings { clip_planes, clip_box: ClipBox(settings.clip_box.0.map(smaller)), ..settings.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_and_a_box_take_turns_and_move_inward_and_back() {
        let none = Settings::default();
        let cut = plane(&none, DVec3::new(0.0, 0.0, 2.0), DVec3::Z);
        assert_eq!(words(&cut), "--clip-plane 0,0,1,2");
        assert_eq!(words(&plane(&none, -DVec3::X, DVec3::Y)), "--clip-plane 0,1,0,0");
        assert_eq!(*cut.clip_planes.0, [[0.0, 0.0, 1.0, 2.0]]);
        assert_eq!(*moved(&cut, 0.5, 0.1).clip_planes.0, [[0.0, 0.0, 1.0, 2.5]]);
        assert_eq!(plane(&cut, DVec3::ZERO, DVec3::Z), none);
        let bounds = Bounds::of_ball(DVec3::X, 2.0);
        assert_eq!(around(&none, bounds, 0.5).clip_box.0, Some([[-1.5, -2.5, -2.5], [3.5, 2.5, 2.5]]));
        let whole = around(&cut, bounds, 0.0);
        assert!(whole.clip_planes.0.is_empty());
        assert_eq!(whole.clip_box.0, Some([[-1.0, -2.0, -2.0], [3.0, 2.0, 2.0]]));
        let less = moved(&whole, 0.5, 0.1);
        assert_eq!(less.clip_box.0, Some([[-0.5, -1.5, -1.5], [2.5, 1.5, 1.5]]));
        assert_eq!(moved(&less, -0.5, 0.1), whole);
        assert_eq!(moved(&whole, 9.0, 0.5).clip_box.0, Some([[0.5, -0.5, -0.5], [1.5, 0.5, 0.5]]));
        assert_eq!(around(&whole, bounds, 0.0), none);
    }
}
