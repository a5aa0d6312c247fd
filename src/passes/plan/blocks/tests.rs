use glam::DVec3;

use super::{walk::Closer, *};
use crate::{
    arena::Arena,
    math::{random::SplitMix, size},
    prepare::Rebase,
    scene::Camera,
};

const SIZE_PX: [u32; 2] = [200, 150];

/// Splats of a block: centers within a ball, normals within a cone. f64 in local space.
struct Disk {
    center: DVec3,
    normal: DVec3,
}

fn random(random: &mut SplitMix) -> impl FnMut(f64, f64) -> f64 + '_ {
    move |lo, hi| lo + (hi - lo) * random.unit()
}

fn direction(between: &mut impl FnMut(f64, f64) -> f64) -> DVec3 {
    loop {
        let v = DVec3::new(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0));
        if (0.1..1.0).contains(&v.length()) {
            return v.normalize();
        }
    }
}

/// One block alone.
pub(super) fn look_at_one(
    number: u32,
    block: &Block,
    look: &BlockCullView<'_>,
) -> Option<PotentiallyVisibleRun> {
    let arena = Arena::new();
    let (mut runs, blocks) = (arena.growing(), std::slice::from_ref(block));
    let of_detail: Vec<_> = block.levels.iter().map(|levels| levels.bounds).collect();
    let place = Place { first: number, each: 1, end: number + 1, of_detail: &of_detail, blocks };
    look_at(&mut runs, place, &Quad::of(blocks), (look, &look.eye()));
    runs.pop()
}

/// Whatever is seen of a block's disks is in its rows, and a block that is left out has nothing to see: at random places, sizes and
/// views, near and far, by the rims of the disks themselves.
#[test]
fn what_is_seen_of_a_block_is_in_its_rows() {
    let mut source = SplitMix(3);
    let mut between = random(&mut source);
    let (mut left_out, mut far_out, mut cut_out, mut facing, mut narrow, mut tightest) =
        (0, 0, 0, 0, 0, 0.0_f64);
    for round in 0..4000 {
        let (size, radius) = (0.5 * between(0.0, 1.0).powi(4), 0.3 * between(0.0, 1.0).powi(6));
        let (axis, spread) = (direction(&mut between), between(0.0, 1.0).powi(2));
        let middle = 2.0 * direction(&mut between) * between(0.0, 1.0);
        let disks: Vec<Disk> = (0..40)
            .map(|_| Disk {
                center: middle + size * between(0.0, 1.0) * direction(&mut between),
                normal: (axis + spread * between(0.0, 1.0) * direction(&mut between)).normalize(),
            })
            .collect();
        // Far away, where f32 has but some digits of places.
        let origin = if round % 5 == 4 {
            10_f64.powf(between(2.0, 7.0)) * direction(&mut between)
        } else {
            DVec3::ZERO
        };
        let cuts = round % 3 == 0;
        let plane_beside = direction(&mut between).extend(between(-2.0, 2.0));
        let block = Block {
            count: 40,
            center: middle - origin,
            radius: disks.iter().map(|d| d.center.distance(middle)).fold(0.0, f64::max),
            axis,
            spread_rad: disks.iter().map(|d| d.normal.angle_between(axis)).fold(0.0, f64::max),
            spread_sin_cos: [0.0; 2],
            largest_radius: radius,
            levels: None,
        };
        let block = Block { spread_sin_cos: block.spread_rad.sin_cos().into(), ..block };
        let eye = DVec3::new(between(-0.5, 0.5), between(-0.5, 0.5), 3.0);
        let parallel = round % 4 > 1;
        let orthographic_height = parallel.then(|| between(0.5, 3.0));
        let camera = Camera { eye, fov_y_rad: 0.7, orthographic_height, ..Camera::default() };
        let view = Rebase { origin, scale: 1.0 }.view_from_local(&camera);
        let focal_px = camera.focal_px(SIZE_PX[1]);
        let plane = |z: f64| if parallel { 1.0 } else { z };
        let ray_to = |point: DVec3| if parallel { camera.forward() } else { point - camera.eye };
        let focal_of_view = if parallel { focal_px / view.view_from_world_scale } else { focal_px };
        let bound = SizeBound {
            nearest_z: -1.0,
            largest_radius: radius * view.view_from_local_scale,
            near: camera.near() * view.view_from_world_scale,
            focal_px: focal_of_view,
            is_orthographic: parallel,
            size_px: SIZE_PX.map(f64::from),
            middle_px: camera.middle_px(SIZE_PX),
            sides: size::sides(SIZE_PX.map(f64::from), camera.middle_px(SIZE_PX), focal_of_view),
            filter_px: std::f64::consts::SQRT_2,
            reach_px: 0.0,
        };
        let look = BlockCullView {
            view: &view,
            bound: &bound,
            culls: round % 2 == 0,
            levels: None,
            planes: if cuts { &[plane_beside] } else { &[] },
            by_origin: view.origin_from_eye.length() + (origin.length() + 3.0) * view.view_from_local_scale,
            half_image: size::half_image(&bound),
        };
        let seen = look_at_one(0, &block, &look);
        for disk in &disks {
            let faces_away = disk.normal.dot(ray_to(disk.center)) > 0.0;
            if look.culls && faces_away {
                assert!(seen.as_ref().is_none_or(|seen| !seen.all_seen), "{round}");
                continue;
            }
            // An ellipse, of which these are no axes.
            let long = radius * disk.normal.any_orthonormal_vector();
            let short = between(0.0, 1.0) * disk.normal.cross(long);
            let (sin, cos) = between(0.0, 6.3).sin_cos();
            let (s, t) = (cos * long - sin * short, sin * long + cos * short);
            let rim = (0..24).map(|i| f64::from(i).to_radians() * 15.0);
            let image = rim.clone().map(|a| disk.center + s * a.cos() + t * a.sin()).map(|point| {
                let p = camera.view_from_world().point(point);
                (p.z, [0, 1].map(|i| focal_px * p[i] / plane(p.z)))
            });
            let image: Vec<_> = image.collect();
            let half = SIZE_PX.map(|side| 0.5 * f64::from(side));
            let in_view = |x: &[f64; 2]| x[0].abs() <= half[0] && x[1].abs() <= half[1];
            if !cuts && image.iter().all(|(z, x)| *z > camera.near() && in_view(x)) {
                let most_px = seen.as_ref().unwrap_or_else(|| panic!("{round}: left out")).box_px - 3.0;
                for axis in 0..2 {
                    let along = || image.iter().map(|(_, x)| x[axis]);
                    let span_px = along().fold(f64::MIN, f64::max) - along().fold(f64::MAX, f64::min);
                    assert!(span_px <= most_px, "{round}: {span_px} px of {most_px}");
                    tightest = if span_px > 20.0 && origin == DVec3::ZERO {
                        (span_px / most_px).max(tightest)
                    } else {
                        tightest
                    };
                }
            }
            for point in rim.map(|a| disk.center + s * a.cos() + t * a.sin()).chain([disk.center]) {
                let p = camera.view_from_world().point(point);
                let px = [0, 1].map(|i| 0.5 * f64::from(SIZE_PX[i]) + focal_px * p[i] / plane(p.z));
                let inside = (0..2).all(|i| (0.0..f64::from(SIZE_PX[i])).contains(&px[i]));
                let is_cut = cuts && plane_beside.dot((p * view.view_from_world_scale).extend(1.0)) < 0.0;
                if p.z < camera.near() || !inside || is_cut {
                    continue;
                }
                let row = px[1] as u32 / BAND_ROW;
                let seen = seen.as_ref().unwrap_or_else(|| panic!("{round}: a seen block was left out"));
                assert!(seen.rows.contains(&row), "{round}: row {row} of {:?}", seen.rows);
            }
        }
        left_out += usize::from(seen.is_none());
        far_out += usize::from(seen.is_none() && origin.length() > 1e5);
        cut_out += usize::from(seen.is_none() && cuts);
        facing += usize::from(look.culls && seen.as_ref().is_some_and(|seen| seen.all_seen));
        narrow += usize::from(seen.is_some_and(|seen| seen.rows.len() < 10));
    }
    println!(
        "left out {left_out}, of these far away {far_out} and where a plane cuts {cut_out}, facing the eye {facing}, in less than 10 rows {narrow}"
    );
    assert!(tightest > 0.5, "{tightest}: the bound of boxes could be less");
    assert!(far_out > 50 && cut_out > 500, "{far_out} {cut_out}");
    assert!(left_out > 500 && facing > 100 && narrow > 500, "{left_out} {facing} {narrow}");
}

/// What is left out with others would be left out by itself; what is known of a run holds for each of its blocks; and there is a bound of looks, so that runs are few however many
/// blocks there are.
#[test]
fn runs_leave_out_no_more_than_their_blocks() {
    use crate::{
        passes::plan::{draws::draws, range::DepthRange},
        prepare::{Placed, prepare_without_device},
        scene::{Colors, Object, Scene, Settings, Shapes, Splats},
        vk::Limits,
    };
    let ball = |count: u32| {
        let normals: Vec<_> = (0..count)
            .map(|i| {
                let z: f64 = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(count);
                let (sin, cos) = (2.399_963 * f64::from(i)).sin_cos();
                let around = (1.0 - z * z).sqrt();
                DVec3::new(around * cos, around * sin, z)
            })
            .collect();
        let shapes = Shapes::Disks {
            normals: normals.iter().map(|normal| normal.as_vec3()).collect(),
            radii: vec![0.004; count as usize],
        };
        let splats = Splats::new(normals, shapes, Colors::Uniform([1.0; 4]));
        let objects = vec![Object { name: "ball".to_owned(), splats, closed: true }];
        prepare_without_device(&Limits::plain(), &Scene { objects, ..Scene::default() }).unwrap()
    };
    let settings = Settings { size_px: SIZE_PX, ..Settings::default() };
    let (mut as_wholes, mut left_to_device) = (0, 0);
    // Few blocks, as many as can be looked at closely, and more.
    for count in [5000, 60_000, 900_000] {
        let prepared = ball(count);
        let (mut most_runs, mut wanted, mut listed) = (0, 0, [0; 2]);
        for eye in [[0.0, 0.0, 6.0], [1.0, 0.3, 1.2], [-3.0, 1.0, 0.2], [0.0; 3]].map(DVec3::from) {
            for orthographic_height in [None, Some(1.2)] {
                let target = DVec3::new(0.0, 0.1, 0.0);
                let camera = Camera { eye, target, orthographic_height, ..Camera::default() };
                let range = DepthRange::of(&[Placed::at_home(&prepared)], &camera);
                let camera = range.begin(&camera);
                let (limits, arena) = (Limits::plain(), Arena::new());
                for draw in draws(&arena, Placed::at_home(&prepared), (&camera, range), &settings, &limits) {
                    let arena = Arena::new();
                    let (chunk, look) = (draw.chunk, draw.look());
                    for closely in [false, true] {
                        let mut runs = draw.potentially_visible_runs(&arena);
                        if closely {
                            let all_rows = arena.list(0..SIZE_PX[1].div_ceil(BAND_ROW));
                            runs = draw.closer_runs(&arena, runs, Closer::Cut(all_rows));
                        }
                        most_runs = most_runs.max(runs.len());
                        let of_runs: u32 = runs.iter().map(|run| run.count).sum();
                        assert!(of_runs <= chunk.count && runs.is_sorted_by_key(|run| run.first));
                        for (number, block) in (0..).zip(&chunk.blocks) {
                            let run =
                                runs.iter().find(|run| (run.first..run.first + run.blocks).contains(&number));
                            let own = look_at_one(number, block, &look);
                            wanted += usize::from(own.is_some() && closely);
                            listed[usize::from(closely)] += usize::from(run.is_some());
                            let Some(own) = own else {
                                left_to_device += usize::from(run.is_some());
                                continue;
                            };
                            let run = run.unwrap_or_else(|| panic!("{eye}: block {number} is left out"));
                            assert!(own.all_seen || !run.all_seen, "{count}, {eye}: {own:?} of {run:?}");
                            let within = run.rows.start <= own.rows.start && own.rows.end <= run.rows.end;
                            assert!(within && own.box_px <= run.box_px, "{count}, {eye}: {own:?} of {run:?}");
                            as_wholes += usize::from(run.blocks > 1);
                        }
                    }
                }
            }
        }
        println!("{count}: {most_runs} runs at most; {wanted} blocks may be seen, {listed:?} are listed");
        let share = listed.map(|listed| listed as f64 / wanted as f64);
        // Roughly twice as many, of what is near and half outside; closely a fifth more.
        assert!(most_runs <= 4000 && share[0] <= 2.5 && share[1] <= 1.2, "{count}: {share:?}");
    }
    assert!(as_wholes > 300 && left_to_device > 100, "{as_wholes} {left_to_device}");
}

/// Blocks of which all splats were taken out, and those that have none yet, are in no run; others are as before.
#[test]
fn blocks_of_nothing_are_not_looked_at() {
    use crate::{
        passes::plan::{draws::draws, range::DepthRange},
        prepare::{Placed, prepare_without_device},
        scene::{Colors, Object, Room, Scene, Settings, Shapes, Splats},
        vk::Limits,
    };
    let wall = |count: u32| {
        let positions: Vec<_> = (0..count).map(|i| DVec3::new(1e-4 * f64::from(i), 0.0, 0.0)).collect();
        let shapes =
            Shapes::Disks { normals: vec![glam::Vec3::Z; count as usize], radii: vec![0.01; count as usize] };
        Splats::new(positions, shapes, Colors::Uniform([1.0; 4]))
    };
    let objects = vec![Object { name: "wall".to_owned(), splats: wall(4096), closed: false }];
    let rooms = vec![Some(Room { splats: 1024, ..Room::default() })];
    let scene = Scene { objects, updatable: true, rooms, ..Scene::default() };
    let mut seen = prepare_without_device(&Limits::plain(), &scene).unwrap();
    let listed = |seen: &crate::prepare::PreparedScene| {
        let arena = Arena::new();
        let camera =
            Camera { eye: DVec3::new(0.2, 0.0, 3.0), target: DVec3::new(0.2, 0.0, 0.0), ..Camera::default() };
        let settings = Settings { size_px: SIZE_PX, ..Settings::default() };
        let limits = Limits::plain();
        let how = (&camera, DepthRange::default());
        let all = draws(&arena, Placed::at_home(seen), how, &settings, &limits);
        let of = |draw: crate::passes::plan::draws::Draw<'_>| {
            let every: Vec<u32> = (0..1000).collect();
            let runs = draw.closer_runs(&arena, draw.potentially_visible_runs(&arena), Closer::Cut(&every));
            runs.iter().map(|run| [run.blocks, run.count]).collect::<Vec<_>>()
        };
        all.map(of).collect::<Vec<_>>()
    };
    let sum = |runs: &[[u32; 2]]| runs.iter().fold([0; 2], |[b, c], [blocks, count]| [b + blocks, c + count]);
    assert_eq!(listed(&seen).iter().map(|runs| sum(runs)).collect::<Vec<_>>(), [[16, 4096], [0, 0]]);
    // Four blocks below one of the next level, and one elsewhere.
    for numbers in [1024..2048, 3072..3328] {
        seen.remove(None, 0, numbers).unwrap().apply(None);
    }
    let [own, room] = &listed(&seen)[..] else { panic!("two chunks") };
    assert_eq!((sum(own)[1], sum(room)), (4096 - 1280, [0, 0]));
    println!("{own:?}");
    assert!(sum(own)[0] == 11, "no block that has nothing: {own:?}");
    let splats = wall(300);
    seen.append(None, 0, &splats).unwrap().0.apply(None);
    assert_eq!(sum(&listed(&seen)[1]), [2, 300]);
}
