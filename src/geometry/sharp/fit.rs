//! A conic for a piece of a ridge (Ivo et al. 2012, section 4): between its ends, with the middle control point and its weight found by least
//! squares of the distances at even lengths of arc (their equation 12 sums the distances themselves).
//!
//! The paper minimizes over three numbers. For a weight given and places on the curve given, the best middle control point is a mean; the
//! places follow from it, so some rounds of both are done for each weight of a search over one number. Where the corners of the polyline lie
//! on a circle it is that circle's arc.

use glam::DVec3;

use super::conic::Conic;

/// A polyline's corners are off a circle by no more of the arc's height: a circle in a mesh of 7 digits.
const ROUND: f64 = 1e-3;

/// A polyline is no farther off its chord, in lengths of it: a line.
const STRAIGHT: f64 = 1e-6;

/// Half of the angle by which a piece may turn at the most, 75°: beyond it a weight is too near 0 for a circle.
const MOST_HALF_ANGLE_RAD: f64 = 1.309;

/// How many places are compared.
const SAMPLES: usize = 16;

/// The steps in which the length of a curve is summed.
const STEPS: usize = 32;

/// Rounds of places and middle control points.
const ROUNDS: usize = 8;

/// A curve and how far it is off.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fitted {
    pub conic: Conic,
    /// The largest distance at even lengths of arc.
    pub most: f64,
}

/// Fits a polyline of two corners at least; `None` where its ends are one place or it turns by too much.
pub(super) fn fit(points: &[DVec3]) -> Option<Fitted> {
    let (&start, &end) = (points.first()?, points.last()?);
    let chord = end.distance(start);
    if !(chord > 0.0 && chord.is_finite()) {
        return None;
    }
    let samples = even_places(points)?;
    let line = Conic::line(start, end);
    let off_chord = |p: &DVec3| (*p - start).cross(end - start).length() / chord;
    if points.iter().all(|p| off_chord(p) <= STRAIGHT * chord) {
        return Some(measured(line, &samples));
    }
    if let Some(arc) = circle(points) {
        return Some(measured(arc, &samples));
    }
    let general = general(start, end, &samples);
    let height = general.height();
    // An arc's height over its chord is half the tangent of a quarter of its angle.
    (height < 0.5 * (0.5 * MOST_HALF_ANGLE_RAD).tan() * chord).then(|| measured(general, &samples))
}

/// The arc of a circle on which all corners lie.
fn circle(points: &[DVec3]) -> Option<Conic> {
    let (&start, &end) = (points.first()?, points.last()?);
    let farther = |a: &&DVec3, b: &&DVec3| {
        let off = |p: &DVec3| (*p - start).cross(end - start).length();
        off(a).total_cmp(&off(b))
    };
    let top = points.iter().max_by(farther)?;
    let arc = Conic::arc(start, *top, end, MOST_HALF_ANGLE_RAD)?;
    let (half, height) = (0.5 * (end - start).length(), arc.height());
    // From the chord's middle: the center is radius − height below it.
    let radius = (half * half + height * height) / (2.0 * height);
    let middle = 0.5 * (start + end);
    let outward = (arc.middle - middle).normalize();
    let center = middle + outward * (height - radius);
    let normal = outward.cross(end - start).normalize();
    let is_on = |p: &DVec3| {
        let away = *p - center;
        away.dot(normal).hypot(away.length() - radius) <= ROUND * height
    };
    points.iter().all(is_on).then_some(arc)
}

/// Places of the polyline at even lengths, without its ends.
fn even_places(points: &[DVec3]) -> Option<Vec<DVec3>> {
    let length: f64 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let mut samples = Vec::with_capacity(SAMPLES);
    let mut before = 0.0;
    for pair in points.windows(2) {
        let own = pair[0].distance(pair[1]);
        while samples.len() < SAMPLES {
            let at = length * (samples.len() + 1) as f64 / (SAMPLES + 1) as f64 - before;
            if at > own {
                break;
            }
            samples.push(if own > 0.0 { pair[0].lerp(pair[1], at / own) } else { pair[0] });
        }
        before += own;
    }
    (samples.len() == SAMPLES).then_some(samples)
}

/// The parameters at even lengths of arc, by a table of it.
fn even_parameters(conic: &Conic) -> [f64; SAMPLES] {
    let mut lengths = [0.0; STEPS + 1];
    let mut last = conic.start;
    for i in 1..=STEPS {
        let next = conic.point(i as f64 / STEPS as f64);
        lengths[i] = lengths[i - 1] + next.distance(last);
        last = next;
    }
    std::array::from_fn(|sample| {
        let at = lengths[STEPS] * (sample + 1) as f64 / (SAMPLES + 1) as f64;
        let step = lengths.partition_point(|length| *length < at).clamp(1, STEPS);
        let own = lengths[step] - lengths[step - 1];
        let within = if own > 0.0 { (at - lengths[step - 1]) / own } else { 0.5 };
        ((step - 1) as f64 + within) / STEPS as f64
    })
}

fn measured(conic: Conic, samples: &[DVec3]) -> Fitted {
    let distances =
        even_parameters(&conic).into_iter().zip(samples).map(|(t, p)| conic.point(t).distance(*p));
    Fitted { conic, most: distances.fold(0.0, f64::max) }
}

/// The best weight by golden sections of its logarithm, from the initial parabola on (section 4.1: P2 = 2 I − M).
fn general(start: DVec3, end: DVec3, samples: &[DVec3]) -> Conic {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let half_way = samples[SAMPLES / 2];
    let mut conic = Conic { start, middle: 2.0 * half_way - 0.5 * (start + end), end, weight: 1.0 };
    // Each goes on from where the last one was: weights come closer to each other.
    let mut error = |log: f64| {
        conic.weight = log.exp();
        improve(&mut conic, samples)
    };
    let (mut low, mut high) = (-1.6, 1.6);
    let mut inner = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let mut errors = inner.map(&mut error);
    for _ in 0..12 {
        if errors[0] <= errors[1] {
            high = inner[1];
            inner = [high - GOLDEN * (high - low), inner[0]];
            errors = [error(inner[0]), errors[0]];
        } else {
            low = inner[0];
            inner = [inner[1], low + GOLDEN * (high - low)];
            errors = [errors[1], error(inner[1])];
        }
    }
    error(0.5 * (low + high));
    conic
}

/// Brings the middle control point nearer to the best one for the weight; the sum of squared distances then.
fn improve(conic: &mut Conic, samples: &[DVec3]) -> f64 {
    let (start, end, weight) = (conic.start, conic.end, conic.weight);
    for _ in 0..ROUNDS {
        let (mut sum, mut norm) = (DVec3::ZERO, 0.0);
        for (t, sample) in even_parameters(conic).into_iter().zip(samples) {
            let shares = [(1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t) * weight, t * t];
            let all = shares[0] + shares[1] + shares[2];
            let own = shares[1] / all;
            sum += own * (*sample - (shares[0] * start + shares[2] * end) / all);
            norm += own * own;
        }
        conic.middle = sum / norm;
    }
    let off = even_parameters(conic).into_iter().zip(samples);
    off.map(|(t, p)| conic.point(t).distance_squared(*p)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polyline(count: usize, of: impl Fn(f64) -> DVec3) -> Vec<DVec3> {
        (0..=count).map(|i| of(i as f64 / count as f64)).collect()
    }

    #[test]
    fn circles_are_exact_and_lines_are_lines() {
        let circle =
            |angle: f64, count| polyline(count, |x| DVec3::new((x * angle).cos(), 5.0, (x * angle).sin()));
        for count in [2, 3, 50] {
            for angle in [0.01, 1.0, 2.5] {
                let fitted = fit(&circle(angle, count)).unwrap();
                assert!((fitted.conic.weight - (angle / 2.0).cos()).abs() < 1e-9, "{angle} {count}");
                assert!((fitted.conic.point(0.37) - 5.0 * DVec3::Y).length() - 1.0 < 1e-9);
            }
        }
        assert!(fit(&circle(2.8, 20)).is_none() && fit(&circle(std::f64::consts::TAU, 20)).is_none());
        let line = fit(&polyline(9, |x| x * x * DVec3::new(1.0, 2.0, 3.0))).unwrap();
        assert!(line.conic.height() < 1e-12 && line.most < 1e-12);
        assert!(fit(&[DVec3::ONE, DVec3::ONE]).is_none() && fit(&[DVec3::ONE]).is_none());
    }

    /// Parts of an ellipse, a parabola and a hyperbola, which such curves are; and a wave, which none is.
    #[test]
    fn conics_are_found_again_and_others_are_met_on_average() {
        for weight in [0.4, 0.8, 1.0, 1.7] {
            let conic = Conic {
                start: DVec3::ZERO,
                middle: DVec3::new(0.8, 1.0, 0.3),
                end: DVec3::new(2.0, 0.0, -0.2),
                weight,
            };
            let fitted = fit(&polyline(200, |t| conic.point(t))).unwrap();
            assert!(fitted.most < 2e-3, "{weight}: {fitted:?}");
            assert!((fitted.conic.weight / weight).ln().abs() < 0.1, "{weight}: {fitted:?}");
        }
        let wave = fit(&polyline(200, |t| DVec3::new(t, 0.05 * (t * 12.0).sin(), 0.0))).unwrap();
        assert!((0.01..0.1).contains(&wave.most), "{wave:?}");
    }
}
