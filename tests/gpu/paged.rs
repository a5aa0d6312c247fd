//! Pages that come while views draw: at any moment the picture of the whole at some size, ever finer, within fixed memory.

use std::{
    io::{Cursor, Read, Seek, SeekFrom},
    path::Path,
    sync::{
        Arc,
        atomic::{AtomicUsize, Ordering},
    },
};

use glam::{DAffine3, DVec3};
use surfel::{
    levels_file::{LevelsFile, PageView, Pager, Placed, load_together, write_object},
    load::builtin,
    renderer::{Drawn, Headless, PagedScene},
    scene::{Camera, Edges, Epsilon, Lod, Scene},
};

use crate::{
    common::{PICTURE, render_as, shared, with},
    levels::{ball, rms},
};

/// Bytes of a file that count how often they are read: a seek before each page.
struct Counted(Cursor<Arc<[u8]>>, Arc<AtomicUsize>);

impl Read for Counted {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        // In little pieces, as a slow disk gives them.
        let end = into.len().min(1 << 14);
        self.0.read(&mut into[..end])
    }
}

impl Seek for Counted {
    fn seek(&mut self, to: SeekFrom) -> std::io::Result<u64> {
        self.1.fetch_add(1, Ordering::Relaxed);
        self.0.seek(to)
    }
}

/// A file in memory, and how many of its pages were read.
fn opened(bytes: &Arc<[u8]>) -> (LevelsFile<Counted>, Arc<AtomicUsize>) {
    let reads = Arc::new(AtomicUsize::new(0));
    let source = Counted(Cursor::new(Arc::clone(bytes)), Arc::clone(&reads));
    let file = LevelsFile::new(Path::new("a.surfel"), source, bytes.len() as u64).unwrap();
    reads.store(0, Ordering::Relaxed);
    (file, reads)
}

fn file_of(splats: usize) -> Arc<[u8]> {
    let folder = temp_dir::TempDir::new().unwrap();
    let path = folder.path().join("a.surfel");
    write_object(&path, &builtin::relief(splats), None, &()).unwrap();
    std::fs::read(path).unwrap().into()
}

fn camera(distance: f64, x: f64) -> Camera {
    let (eye, target) = (DVec3::new(x, 0.2, distance), DVec3::new(x, 0.2, 0.0));
    Camera { eye, target, near: Some(0.01), ..Camera::default() }
}

/// Whether a pixel differs by more than rounding.
fn is_another(a: &[f32; 4], b: &[f32; 4]) -> bool {
    a.iter().zip(b).any(|(a, b)| (a - b).abs() > 1.0 / 1024.0)
}

/// Takes what there is for some views.
fn update(headless: &Headless, paged: &mut PagedScene, views: &[PageView], wait: bool) -> Vec<Option<Drawn>> {
    paged.update(views, &mut |scene| headless.prepare(scene, &|_, _| {}), wait).unwrap()
}

/// A camera that comes nearer, turns and goes back, and does not wait for pages; at each step what is drawn of what is there is what a file gives for that size.
#[test]
fn a_camera_that_moves_sees_the_whole_at_every_moment() {
    let mut headless = shared();
    let bytes = file_of(400_000);
    let (file, _) = opened(&bytes);
    let (all, pages) = (file.pages().iter().map(|page| page.device_bytes()).sum::<u64>(), file.pages().len());
    // Half of that is for the finest step: about three fifths of all are needed from afar.
    let most_bytes = 5 * all / 4;
    let mut paged = PagedScene::new(Pager::start([file]).unwrap(), most_bytes).unwrap();
    // Hard edges: whether some chunk has splats for the graphics pipeline, which decides whether tiles cover pixels in part, differs between the two scenes.
    let mut hard = with(&ball(1, 1.0), |settings| {
        (settings.epsilon, settings.edges) = (Epsilon::Radii(1.0), Edges::Hard);
    });
    let (mut sizes, mut kept) = (Vec::new(), 0);
    let way = (0..24).map(|step| match step {
        0..10 => (4.0 - 0.3 * f64::from(step), 0.0),
        10..14 => (1.3, 0.15 * f64::from(step - 9)),
        _ => (1.3 + 0.3 * f64::from(step - 13), 0.6),
    });
    for (step, (distance, x)) in way.enumerate() {
        hard.camera = camera(distance, x);
        let view = PageView::new(&hard.camera, hard.settings.size_px, 0.5);
        // The first has to have something; later ones take what there is, and the last ones all of it.
        let mut drawn = update(&headless, &mut paged, &[view], step == 0)[0];
        while step > 20 && !drawn.is_some_and(|drawn| drawn.is_finest) {
            drawn = update(&headless, &mut paged, &[view], true)[0];
        }
        assert!(paged.bytes() <= most_bytes, "step {step}: {} of {most_bytes}", paged.bytes());
        let Some(Drawn { tau_px, is_finest }) = drawn else { continue };
        sizes.push(tau_px);
        kept = kept.max(paged.pages());
        hard.settings.lod = Lod::Px(tau_px);
        let found = headless.render(paged.scene(), &hard.camera, &hard.settings, PICTURE).unwrap();
        let view = PageView::new(&hard.camera, hard.settings.size_px, tau_px);
        let (mut file, _) = opened(&bytes);
        let object = file.load(Some(&view), u64::MAX, &()).unwrap().object;
        hard.scene = Scene { leveled: vec![object], ..Scene::default() };
        let truth = render_as(&mut headless, &hard, PICTURE);
        let error = rms(&truth, &found);
        let others = truth.linear.iter().zip(&found.linear).filter(|(a, b)| is_another(a, b)).count();
        println!(
            "step {step}: {tau_px} px, finest {is_finest}, {} pages, {} bytes: {error:.1e}, {others} others",
            paged.pages(),
            paged.bytes()
        );
        // The same splats in other chunks, see `in_parts.rs`: a pixel at a rim more or less, of which there are 1e-4 at most.
        assert!(others <= 6 && error < 3e-3, "step {step}: {others}, {error}");
        assert!(truth.linear.iter().filter(|pixel| pixel[3] > 0.5).count() > 5000, "step {step}");
    }
    // From coarse to fine.
    println!("{sizes:?}, {kept} pages at most of {pages}");
    assert!(sizes.len() > 12 && sizes[0] >= 4.0 && sizes.last() <= Some(&1.0), "{sizes:?}");
}

/// What one view has is there for another; what is there is not read again; in memory for one of them both are drawn coarser.
#[test]
fn views_share_pages_and_memory() {
    let headless = shared();
    let bytes = file_of(200_000);
    let (file, reads) = opened(&bytes);
    let pages = file.pages().len();
    let size_px = [256, 256];
    let views = [0.0, 0.05].map(|x| PageView::new(&camera(3.0, x), size_px, 0.5));
    let mut paged = PagedScene::new(Pager::start([file]).unwrap(), 1 << 30).unwrap();
    let settle = |paged: &mut PagedScene, views: &[PageView]| {
        let mut drawn = update(&headless, paged, views, true);
        for _ in 0..1000 {
            if drawn.iter().all(|drawn| drawn.is_some_and(|drawn| drawn.is_finest)) {
                break;
            }
            drawn = update(&headless, paged, views, true);
        }
        drawn
    };
    let one = settle(&mut paged, &views[..1]);
    let of_one = reads.load(Ordering::Relaxed);
    let both = settle(&mut paged, &views);
    let of_both = reads.load(Ordering::Relaxed);
    println!("{of_one} pages read of {pages} for one view, {of_both} for both: {one:?} {both:?}");
    assert!(of_one > 3 && of_both - of_one < of_one / 4 && of_both <= pages);
    assert_eq!(both, vec![Some(Drawn { tau_px: 0.5, is_finest: true }); 2]);
    let (file, _) = opened(&bytes);
    let far = PageView::new(&camera(1.2, 0.6), size_px, 0.0);
    let most_bytes = 6 << 20;
    let mut small = PagedScene::new(Pager::start([file]).unwrap(), most_bytes).unwrap();
    let drawn = settle(&mut small, &[views[0], far]);
    assert!(
        drawn.iter().all(|drawn| drawn.is_some_and(|drawn| drawn.is_finest && drawn.tau_px >= 1.0)),
        "{drawn:?}"
    );
    assert!(small.bytes() <= most_bytes, "{}", small.bytes());
}

#[test]
fn faults_are_told_and_nothing_waits_for_ever() {
    let headless = shared();
    let bytes = file_of(30_000);
    let (file, _) = opened(&bytes);
    let view = PageView::new(&camera(3.0, 0.0), [64, 64], 0.0);
    // Too little even for the coarsest.
    let mut none = PagedScene::new(Pager::start([file]).unwrap(), 50).unwrap();
    let error = none.update(&[view], &mut |scene| headless.prepare(scene, &|_, _| {}), true).unwrap_err();
    assert!(error.to_string().contains("memory: 50 bytes; expected more"), "{error}");
    // A page that is damaged, of splats, which the view needs; and a view of nothing.
    let (file, _) = opened(&bytes);
    let page = file.pages().iter().position(|page| !page.nodes).unwrap();
    let mut damaged = bytes.to_vec();
    damaged[file.pages()[page].at as usize] ^= 1;
    let (file, _) = opened(&damaged.into());
    let mut paged = PagedScene::new(Pager::start([file]).unwrap(), 1 << 30).unwrap();
    let away = Camera { target: DVec3::new(0.0, 0.0, 9.0), ..camera(3.0, 0.0) };
    let nothing = PageView::new(&away, [64, 64], 0.0);
    assert_eq!(update(&headless, &mut paged, &[nothing], true)[0].map(|drawn| drawn.is_finest), Some(true));
    let mut error = None;
    for _ in 0..100 {
        match paged.update(&[view], &mut |scene| headless.prepare(scene, &|_, _| {}), true) {
            Ok(_) => {}
            Err(problem) => {
                error = Some(problem.to_string());
                break;
            }
        }
    }
    let expected = format!("a.surfel: page {page}: its checksum is wrong: the file is damaged");
    assert_eq!(error.as_deref(), Some(expected.as_str()));
    // Dropped while it reads.
    let (file, _) = opened(&bytes);
    let pager = Pager::start([file]).unwrap();
    pager.want(&(0..pager.pages().len()).collect::<Vec<_>>());
    drop(pager);
}

/// What is wrong with a page is told once; then nothing is expected any more, nothing waits, and the view is drawn coarser.
#[test]
fn a_page_at_fault_is_told_once_and_nothing_waits_for_it() {
    let headless = shared();
    let whole = file_of(100_000);
    let mut bytes = whole.to_vec();
    // The finest pages lie behind the nodes.
    let at = bytes.len() * 3 / 4;
    bytes[at] ^= 0x55;
    let (file, _) = opened(&bytes.into());
    let mut paged = PagedScene::new(Pager::start([file]).unwrap(), 1 << 30).unwrap();
    let view = [PageView::new(&camera(3.0, 0.0), [256, 256], 0.0)];
    let mut take = || paged.update(&view, &mut |scene| headless.prepare(scene, &|_, _| {}), true);
    let (mut faults, mut drawn) = (Vec::new(), None);
    for _ in 0..1000 {
        match take() {
            Ok(of_views) => drawn = of_views[0],
            Err(error) => faults.push(error.to_string()),
        }
    }
    assert!(faults.len() == 1 && faults[0].starts_with("a.surfel: page "), "{faults:?}");
    assert!(drawn.is_some_and(|drawn| !drawn.is_finest && drawn.tau_px > 0.0), "{drawn:?}");
    assert!(!paged.is_coming() && !paged.has_arrived());
}

/// Takes all that comes for a view, within so many bytes; the sizes on the way.
fn settle(headless: &Headless, paged: &mut PagedScene, view: PageView, most_bytes: u64) -> Vec<f64> {
    let mut sizes = Vec::new();
    for _ in 0..1000 {
        let Some(drawn) = update(headless, paged, &[view], true)[0] else { continue };
        assert!(paged.bytes() <= most_bytes, "{} of {most_bytes}", paged.bytes());
        sizes.push(drawn.tau_px);
        if drawn.is_finest || !paged.is_coming() {
            break;
        }
    }
    sizes
}

/// Several files, one of them turned and mirrored, within one memory and beside a scene that is there as a whole: the picture of what files give for its size. What is hidden goes
/// and comes again, and another scene takes the place of the one beside.
#[test]
fn files_share_a_picture_and_memory_with_all_of_a_scene() {
    let mut headless = shared();
    let bytes = file_of(100_000);
    let mirrored = DAffine3::from_translation(DVec3::new(0.9, 0.3, -0.8))
        * DAffine3::from_rotation_y(1.0)
        * DAffine3::from_scale(DVec3::new(-0.8, 0.8, 0.8));
    let files = || {
        let placed = Placed { world_from_file: mirrored, color: Some([0.1, 0.5, 0.9]), alpha: 1.0 };
        [opened(&bytes).0, opened(&bytes).0.placed_as("there".to_owned(), &placed).unwrap()]
    };
    let all: u64 = files().iter().flat_map(|file| file.pages()).map(|page| page.device_bytes()).sum();
    let beside = |x: f64| {
        let mut hard = with(&ball(3000, 0.0), |settings| {
            (settings.epsilon, settings.edges) = (Epsilon::Radii(1.0), Edges::Hard);
            settings.lod = Lod::Px(0.5);
        });
        hard.camera = camera(4.0, 0.0);
        let splats = &mut hard.scene.objects[0].splats;
        splats.positions.iter_mut().for_each(|position| *position += DVec3::new(x, 1.2, 0.5));
        hard
    };
    let view = PageView::new(&camera(4.0, 0.0), beside(0.0).settings.size_px, 0.5);
    let mut paged = PagedScene::new(Pager::start(files()).unwrap(), 2 * all).unwrap();
    assert_eq!(paged.scene().objects, ["a.surfel", "there"]);
    let mut pages = Vec::new();
    let steps = [([true, true], -1.0), ([false, true], -1.0), ([true, true], -1.0), ([true, false], -0.6)];
    for (is_seen, x) in steps {
        let mut hard = beside(x);
        paged.set_beside(headless.prepare(&hard.scene, &|_, _| {}).unwrap()).unwrap();
        assert_eq!(paged.scene().objects[1..], ["a.surfel", "there"]);
        paged.show(&is_seen);
        let sizes = settle(&headless, &mut paged, view, 2 * all);
        assert_eq!(sizes.last(), Some(&0.5), "{sizes:?}");
        let found = headless.render(paged.scene(), &hard.camera, &hard.settings, PICTURE).unwrap();
        let seen = files().into_iter().zip(is_seen).filter(|(_, is_seen)| *is_seen).map(|(file, _)| file);
        let read = load_together(&mut seen.collect::<Vec<_>>(), &view, u64::MAX, &()).unwrap();
        hard.scene.leveled = read.into_iter().map(|chosen| chosen.object).collect();
        let expected = render_as(&mut headless, &hard, PICTURE);
        let others = expected.linear.iter().zip(&found.linear).filter(|(a, b)| is_another(a, b)).count();
        let covered = expected.linear.iter().filter(|pixel| pixel[3] > 0.5).count();
        println!("{is_seen:?}: {others} others of {covered}, {} pages", paged.pages());
        // As above.
        assert!(others <= 8 && covered > 3000, "{is_seen:?}: {others} of {covered}");
        pages.push(paged.pages());
    }
    assert!(pages[1] < pages[0] && pages[2] == pages[0] && pages[3] < pages[0], "{pages:?}");
    // In less memory both are coarser, alike.
    let most_bytes = all / 4;
    let mut small = PagedScene::new(Pager::start(files()).unwrap(), most_bytes).unwrap();
    let coarse = settle(&headless, &mut small, view, most_bytes);
    assert!(coarse.last() > Some(&0.5), "{coarse:?}");
}
