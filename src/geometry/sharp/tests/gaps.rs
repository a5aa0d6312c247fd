//! How far the outlines of the splats on both sides of a ridge are apart.

use glam::{DVec2, DVec3};

use crate::{
    geometry::sharp::{
        Clipping,
        clips::{ClippedEllipse, clipped_ellipses},
        collapse::{Goal, State},
        edges::Sound,
        model, normals_of,
        ridges::Ridges,
    },
    hard_scenes::parts::bored_block,
    load::real::real_mesh,
    scene::{ClipCurve, Mesh},
};

/// Mean and largest distance of both outlines where they are nearest to the ridge's curve, in lengths of the chords; and how far they are from
/// its projections into their planes.
struct Gaps {
    mean: f64,
    most: f64,
    off_projection: f64,
    places: usize,
}

fn gaps(mesh: &Mesh, count: usize, clipping: Clipping) -> Gaps {
    let Sound { mesh, edges, .. } = Sound::of(mesh).unwrap();
    let normals = normals_of(&mesh);
    let ridges = Ridges::of(&mesh, &edges, &normals, 30_f64.to_radians());
    let mut state = State::new(&mesh.positions, mesh.triangles.clone(), &normals, &ridges, None);
    state.collapse(Goal { triangles: count, most_error: f64::INFINITY }, &());
    let pieces = state.pieces();
    let model = model(&state, &pieces);
    let mut gaps = Gaps { mean: 0.0, most: 0.0, off_projection: 0.0, places: 0 };
    for piece in &pieces {
        let [a, b] = piece.ends;
        let Some(sides) = model.edges.beyond(a, b).zip(model.edges.beyond(b, a)) else { continue };
        let both = [sides.0, sides.1].map(|triangle| clipped_ellipses(&model, triangle, clipping));
        let [first, second] = &both;
        let ([first], [second]) = (first.as_slice(), second.as_slice()) else { continue };
        let length = piece.fitted.conic.start.distance(piece.fitted.conic.end);
        for i in 1..16 {
            let place = piece.fitted.conic.point(f64::from(i) / 16.0);
            let outlines = [first, second].map(|one| nearest(one, place));
            let [Some((p, p_off)), Some((q, q_off))] = outlines else { continue };
            let gap = p.distance(q) / length;
            gaps.mean += gap;
            gaps.most = gaps.most.max(gap);
            gaps.off_projection = gaps.off_projection.max(p_off.max(q_off) / length);
            gaps.places += 1;
        }
    }
    gaps.mean /= gaps.places as f64;
    gaps
}

/// The place of a splat's clip curves that is nearest to a place in space, and how far it is from that one's projection.
fn nearest(one: &ClippedEllipse, place: DVec3) -> Option<(DVec3, f64)> {
    let away = place - one.center;
    let uv = DVec2::new(away.dot(one.s) / one.s.length_squared(), away.dot(one.t) / one.t.length_squared());
    let lift = |uv: DVec2| one.center + uv.x * one.s + uv.y * one.t;
    let places = one.clip.curves().into_iter().flatten().flat_map(|curve| (0..=2000).map(|i| at(curve, i)));
    let distance = |at: DVec2| lift(at).distance(lift(uv));
    let best = places.min_by(|a, b| distance(*a).total_cmp(&distance(*b)))?;
    Some((lift(best), distance(best)))
}

fn at(curve: &ClipCurve, i: u32) -> DVec2 {
    let t = f64::from(i) / 2000.0;
    let [start, end] = [curve.start_rad, curve.end_rad].map(|rad| DVec2::from_angle(rad.into()));
    if curve.weight == 0.0 {
        return start.lerp(end, t);
    }
    let shares = [(1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t) * f64::from(curve.weight), t * t];
    let sum = shares[0] * start + shares[1] * curve.middle.as_dvec2() + shares[2] * end;
    sum / shares.iter().sum::<f64>()
}

fn table(name: &str, mesh: &Mesh, count: usize) -> [Gaps; 3] {
    let ways = [Clipping::Shared, Clipping::Own, Clipping::Lines];
    let all = ways.map(|clipping| gaps(mesh, count, clipping));
    println!("{name}, {count} triangles; outlines of both sides, in chords of their pieces:");
    for (way, gaps) in ways.into_iter().zip(&all) {
        let Gaps { mean, most, off_projection, places } = gaps;
        println!(
            "  {way:?}: apart {mean:.2e} on average, {most:.2e} at most; off the one curve by up to {off_projection:.2e} ({places} places)"
        );
    }
    all
}

/// What is left between outlines of shared curves is how far the curve is from the planes; own ones are as far apart, and somewhere else.
#[test]
fn shared_curves_are_projections_of_one_and_own_ones_are_not() {
    let check = |name: &str, mesh: &Mesh, count: usize, times: f64| {
        let [shared, own, lines] = table(name, mesh, count);
        // Steps of the comparison itself, and f32.
        assert!(shared.off_projection < 1e-3 && own.off_projection > times * shared.off_projection);
        assert!(lines.off_projection > own.off_projection && shared.mean < 1.1 * own.mean);
    };
    check("bored block", &bored_block(96, 6), 600, 5.0);
    if let Some(mesh) = real_mesh("fandisk.obj") {
        check("fandisk", &mesh, 2500, 1.2);
    }
}
