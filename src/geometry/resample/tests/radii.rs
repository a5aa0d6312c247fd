//! Radii of samples.

use super::*;

#[test]
fn radii_are_those_of_the_spacing_and_leave_no_hole() {
    let mesh = sphere(5);
    let count = 20_000;
    let (splats, _) = samples(&mesh, count, 0);
    let (normals, radii) = disks(&splats);
    let spacing = (Areas::of(&mesh, &|_| 1.0).unwrap().total / count as f64).sqrt();
    let mut sorted = radii.to_vec();
    sorted.sort_by(f32::total_cmp);
    let [low, median, high] = [0, sorted.len() / 2, sorted.len() - 1].map(|i| f64::from(sorted[i]) / spacing);
    println!("radius: {low:.3}, {median:.3}, {high:.3} of the spacing (least, median, largest)");
    // 1.5 × 0.98; more even points have their neighbors a little farther away.
    assert!((1.4..1.7).contains(&median) && low > 0.7 && high < 2.5);
    // Points on the sphere, each in the disk of some sample seen along the normal.
    let mut random = SplitMix(9);
    let (mut holes, mut layers, tries) = (0, 0, 2000);
    for _ in 0..tries {
        let direction = loop {
            let p = DVec3::new(random.unit(), random.unit(), random.unit()) * 2.0 - 1.0;
            if (0.1..1.0).contains(&p.length()) {
                break p.normalize();
            }
        };
        let within = (0..splats.len()).filter(|&i| {
            let away = splats.positions[i] - direction;
            let normal = normals[i].as_dvec3();
            away.length() < 0.1 && (away - normal * away.dot(normal)).length() <= f64::from(radii[i])
        });
        let within = within.count();
        holes += usize::from(within == 0);
        layers += within;
    }
    println!("{holes} of {tries} points in no disk; a point is in {:.1}", layers as f64 / tries as f64);
    assert_eq!(holes, 0);
}

#[test]
fn samples_that_are_few_or_alone_get_the_radius_of_their_share() {
    let share = |area: f64, count: f64| 1.5 * 0.977_539 * (area / count).sqrt();
    let area = Areas::of(&one_triangle(), &|_| 1.0).unwrap().total;
    for count in [1, 6] {
        for &radius in disks(&samples(&one_triangle(), count, 0).0).1 {
            assert!((f64::from(radius) / share(area, count as f64) - 1.0).abs() < 1e-5);
        }
    }
    // A second piece far away, with a sample or two of its own: 3 times the share's at most.
    let mut mesh = one_triangle();
    let tiny = [0.0, 0.05, 0.1].map(|x| DVec3::new(1e6 + x, x * x * 50.0, 0.0));
    mesh.positions.extend(tiny);
    mesh.triangles.push([3, 4, 5]);
    let area = Areas::of(&mesh, &|_| 1.0).unwrap().total;
    let alone = |splats: &Splats| splats.positions.iter().position(|p| p.x > 1e5).map(|i| disks(splats).1[i]);
    let alone = (0..100).find_map(|seed| alone(&samples(&mesh, 100, seed).0)).map(f64::from);
    assert!((alone.unwrap() / (3.0 * share(area, 100.0)) - 1.0).abs() < 1e-5, "{alone:?}");
    // Samples that f64 can't tell apart.
    let mut mesh = one_triangle();
    mesh.positions.iter_mut().for_each(|p| *p = *p * 1e-3 + 1e12);
    if let Ok((splats, _)) = resample(&mesh, 1000, 0, &()) {
        assert!(disks(&splats).1.iter().all(|radius| *radius > 0.0 && radius.is_finite()));
    }
}
