//! Scan lines, and what floats before a surface.

use super::*;

/// A wavy square of 40 scan lines, whose points are so many times nearer to each other than the lines; and other places on it, but for its rims.
fn lines(ratio: f64) -> [Vec<Sample>; 2] {
    let mut random = SplitMix(5);
    let at = |x: f64, y: f64| -> Sample {
        let ([sin_x, cos_x], [sin_y, cos_y]) =
            ([(6.0 * x).sin(), (6.0 * x).cos()], [(5.0 * y).sin(), (5.0 * y).cos()]);
        let normal = DVec3::new(-0.3 * cos_x * cos_y, 0.25 * sin_x * sin_y, 1.0).normalize();
        (DVec3::new(x, y, 0.05 * sin_x * cos_y), normal)
    };
    let step = 1.0 / 40.0;
    let count = (ratio / step) as u32;
    let on_line = |line: u32| {
        let mut jitter = SplitMix(u64::from(line));
        let x = (f64::from(line) + 0.5) * step;
        (0..count)
            .map(move |i| at(x, (f64::from(i) + 0.3 * (jitter.unit() - 0.5)) * step / ratio))
            .collect::<Vec<_>>()
    };
    let inside = (0..10_000).map(|_| at(0.05 + 0.9 * random.unit(), 0.05 + 0.9 * random.unit())).collect();
    [(0..40).flat_map(on_line).collect(), inside]
}

#[test]
fn lines_far_apart_have_the_normals_of_their_surface_and_join_up_to_42_times() {
    for (ratio, joins) in [(20.0, true), (26.0, true), (40.0, true), (60.0, false)] {
        let [samples, inside] = lines(ratio);
        let (splats, report) = of(&samples);
        assert_eq!(splats.len(), samples.len(), "{ratio}: {report}");
        let (angles, flipped) = errors(&splats, &samples);
        let mean = angles.iter().sum::<f64>() / angles.len() as f64;
        let p99 = angles[angles.len() * 99 / 100];
        assert!(mean < 0.5 && p99 < 2.0 && flipped == 0, "{ratio}: {mean}°, {p99}°, {flipped} flipped");
        let holes = holes(&splats, &inside, 1.0);
        assert!(if joins { holes == 0 } else { holes > 5000 }, "{ratio}: {holes} holes");
    }
}

#[test]
fn what_floats_before_a_surface_is_left_out_and_none_of_the_surface() {
    let mut s = Surfaces(SplitMix(3));
    let samples = s.many(10_000, Surfaces::sphere);
    let mut floats = |least: f64, most: f64| -> Vec<DVec3> {
        (0..100).map(|_| s.sphere().0 * (1.0 + least + (most - least) * s.0.unit())).collect()
    };
    // Points are 0.035 apart.
    for (least, most, kept) in [(0.1, 0.3, 25), (-0.3, -0.1, 25)] {
        let floats = floats(least, most);
        let all = samples.iter().map(|sample| sample.0).chain(floats.iter().copied());
        let (splats, report) = splats_from_points(points(all), &());
        let left = splats.positions.iter().filter(|place| floats.contains(place)).count();
        assert_eq!(splats.len() - left, 10_000, "{report}");
        assert!(left <= kept, "{left} of 100: {report}");
        assert_eq!(report.isolated, 100 - left);
    }
}
