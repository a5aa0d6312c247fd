use super::*;
use crate::math::random::SplitMix;

/// As `unpackHalf2x16` has them.
fn halves(word: u32) -> [f64; 2] {
    [word & 0xffff, word >> 16].map(|half| {
        let (exponent, fraction) = (half >> 10 & 31, half & 1023);
        let size = match exponent {
            0 => f64::from(fraction) * 2_f64.powi(-24),
            _ => f64::from(1024 + fraction) * 2_f64.powi(exponent as i32 - 25),
        };
        if half >> 15 == 1 { -size } else { size }
    })
}

#[test]
fn halves_hold_what_they_bound() {
    let mut random = SplitMix(3);
    let mut between = |lo: f64, hi: f64| lo + (hi - lo) * random.unit();
    let (mut known, mut slack) = (0, 0_f64);
    for round in 0..20_000 {
        let size = 10_f64.powf(between(-6.0, 5.0));
        let vector = |between: &mut dyn FnMut(f64, f64) -> f64| {
            DVec3::new(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0))
        };
        let spread_rad = between(0.0, 1.7);
        let block = Block {
            count: 256,
            center: size * vector(&mut between),
            radius: size * between(0.0, 1.0).powi(8),
            axis: if round % 5 == 0 { DVec3::NEG_Y } else { vector(&mut between).normalize() },
            spread_rad,
            ..Block::EMPTY
        };
        let [[x, y], [z, radius], [u, v], [w, sine]] = words_of(&block).map(halves);
        if sine >= 1.0 {
            // Halves tell sines apart from 1 up to there.
            let is_wide = spread_rad > 1.53;
            assert!(is_wide || block.center.length() + block.radius + 100.0 > MOST, "{round}");
            continue;
        }
        known += 1;
        let (center, axis) = (DVec3::new(x, y, z), DVec3::new(u, v, w));
        assert!(center.distance(block.center) + block.radius <= radius, "{round}: {block:?}");
        assert!(axis.length() <= 1.0 && axis.length() > 0.998, "{round}: {axis}");
        let most = spread_rad + axis.angle_between(block.axis) + ANGLE_RESERVE_RAD;
        assert!(most.sin() <= sine, "{round}: {spread_rad} {sine}");
        slack = slack.max(sine.asin() - spread_rad);
    }
    println!("{known} known, {slack} rad more at most");
    assert!(known > 10_000);
    // Of what lies on a bound, nothing is rounded beyond it.
    let words =
        words_of(&Block { center: DVec3::new(1.0, -0.5, 0.0), radius: 0.25, axis: DVec3::Z, ..Block::EMPTY });
    assert_eq!(
        words[..2].iter().flat_map(|word| halves(*word)).take(3).collect::<Vec<_>>(),
        [1.0, -0.5, 0.0]
    );
    assert_eq!(halves(words[3])[0], 1.0);
}

#[test]
fn what_halves_have_no_room_for_is_not_known() {
    let plain = Block { count: 9, radius: 1.0, ..Block::EMPTY };
    for block in [
        Block { center: DVec3::new(1e9, 0.0, 0.0), ..plain.clone() },
        Block { center: DVec3::new(f64::NAN, 0.0, 0.0), ..plain.clone() },
        Block { radius: 7e4, ..plain.clone() },
        Block { spread_rad: std::f64::consts::PI, ..plain.clone() },
    ] {
        assert_eq!(halves(words_of(&block)[3])[1], 2.0, "{block:?}");
    }
    assert!(halves(words_of(&plain)[3])[1] < 0.01);
}
