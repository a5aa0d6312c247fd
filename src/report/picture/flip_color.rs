//! The colors of ꟻLIP: linear light, the opponent space that the eye blurs, and the space in which differences are seen.

use std::sync::LazyLock;

/// XYZ of linear red, green and blue with Rec. 709 primaries and the white D65.
const XYZ_FROM_RGB: [[f64; 3]; 3] = [
    [10_135_552.0 / 24_577_794.0, 8_788_810.0 / 24_577_794.0, 4_435_075.0 / 24_577_794.0],
    [2_613_072.0 / 12_288_897.0, 8_788_810.0 / 12_288_897.0, 887_015.0 / 12_288_897.0],
    [1_425_312.0 / 73_733_382.0, 8_788_810.0 / 73_733_382.0, 70_074_185.0 / 73_733_382.0],
];

/// What differences of color are raised to, so that large ones do not drown small ones.
const EXPONENT: f64 = 0.7;

/// Differences up to this share of the largest are spread over [`MOST_SEEN`] of the range.
const KNEE: f64 = 0.4;
const MOST_SEEN: f64 = 0.95;

static RGB_FROM_XYZ: LazyLock<glam::DMat3> = LazyLock::new(|| xyz_from_rgb().inverse());

/// The largest difference between two colors of a screen, green and blue, raised to [`EXPONENT`].
static LARGEST: LazyLock<f64> = LazyLock::new(|| distance([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]).powf(EXPONENT));

fn xyz_from_rgb() -> glam::DMat3 {
    glam::DMat3::from_cols_array_2d(&XYZ_FROM_RGB).transpose()
}

/// Relative to white.
fn xyz(rgb: [f64; 3]) -> [f64; 3] {
    let to = xyz_from_rgb();
    (to * glam::DVec3::from(rgb) / (to * glam::DVec3::ONE)).to_array()
}

/// Linear red, green, blue as Y, Cx and Cz: CIE L\*a\*b\* without its root.
pub fn opponent(rgb: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = xyz(rgb);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Back to linear red, green, blue.
pub fn from_opponent([luminance, cx, cz]: [f64; 3]) -> [f64; 3] {
    let y = (luminance + 16.0) / 116.0;
    let white = xyz_from_rgb() * glam::DVec3::ONE;
    (*RGB_FROM_XYZ * (white * glam::DVec3::new(cx / 500.0 + y, y, y - cz / 200.0))).to_array()
}

/// CIE L\*a\*b\*, its chroma scaled by lightness: dark colors are less colorful (Hunt).
fn adjusted_lab(rgb: [f64; 3]) -> [f64; 3] {
    const DELTA: f64 = 6.0 / 29.0;
    let root = |t: f64| {
        if t > DELTA.powi(3) { t.cbrt() } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 }
    };
    let [x, y, z] = xyz(rgb).map(root);
    let lightness = 116.0 * y - 16.0;
    [lightness, 0.01 * lightness * 500.0 * (x - y), 0.01 * lightness * 200.0 * (y - z)]
}

/// HyAB: lightness along a street, chroma as the crow flies.
fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [a, b] = [a, b].map(adjusted_lab);
    (a[0] - b[0]).abs() + (a[1] - b[1]).hypot(a[2] - b[2])
}

/// How much of a difference between two linear colors is seen, 0–1.
pub fn color_distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let (seen, largest) = (distance(a, b).powf(EXPONENT), *LARGEST);
    let knee = KNEE * largest;
    if seen < knee {
        MOST_SEEN / knee * seen
    } else {
        (MOST_SEEN + (seen - knee) / (largest - knee) * (1.0 - MOST_SEEN)).min(1.0)
    }
}
