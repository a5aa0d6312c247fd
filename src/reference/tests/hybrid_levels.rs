//! A mesh in levels of detail, as the oracle chooses what is drawn of it.

use glam::DVec3;

use crate::{
    geometry::{HybridOptions, Multiresolution, multiresolution},
    hard_scenes::builder::Random,
    load::builtin::sphere_mesh,
    reference::{HybridChoice, hybrid_choice},
    scene::{Camera, HybridLevels, Mesh, PolygonCell},
};

fn ball(triangles: u64, samples: u64) -> Multiresolution {
    let options = HybridOptions { samples, seed: 1, sample_edges: true };
    multiresolution(sphere_mesh(triangles), "ball".to_owned(), &options, &()).unwrap()
}

/// The node with each ball.
fn nodes_of_balls(levels: &HybridLevels) -> Vec<Option<usize>> {
    let mut nodes = vec![None; levels.splats.balls.len()];
    for (node, balls) in levels.splats.node_balls.iter().enumerate() {
        nodes[balls.own as usize] = Some(node);
    }
    nodes
}

/// From anywhere and for any size: of the polygons of a cell, its splats, and the nodes above each, one is drawn. Of a splat on an edge, at most one beside polygons.
#[test]
fn one_representation_is_drawn_on_every_path() {
    let Multiresolution { levels, report, .. } = ball(8000, 4000);
    let nodes = nodes_of_balls(&levels);
    let mut random = Random(4);
    let mut seen = [0_usize; 4];
    for _ in 0..40 {
        let direction = DVec3::new(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5).normalize();
        let camera = Camera { eye: (1.1 + 12.0 * random.unit()) * direction, ..Camera::default() };
        let tau_px = 0.3 * 30.0_f64.powf(random.unit());
        let HybridChoice { nodes: of_nodes, leaves, cells } =
            hybrid_choice(&levels, (&camera, [256, 256]), tau_px);
        // Polygons below splats come on top.
        let is_large = |cell: u32| {
            let alone = HybridLevels {
                cells: levels
                    .cells
                    .iter()
                    .map(|cell| PolygonCell { neighbors: Vec::new(), ..cell.clone() })
                    .collect(),
                ..levels.clone()
            };
            hybrid_choice(&alone, (&camera, [256, 256]), tau_px).cells.binary_search(&cell).is_ok()
        };
        let large: Vec<bool> = (0..levels.cells.len() as u32).map(is_large).collect();
        assert!((0..).zip(&large).all(|(cell, large)| !large || cells.binary_search(&cell).is_ok()));
        for leaf in 0..levels.splats.leaves.len() {
            let mut above = 0;
            let mut parent = nodes[levels.splats.leaf_parents[leaf] as usize];
            while let Some(node) = parent {
                above += usize::from(of_nodes.binary_search(&(node as u32)).is_ok());
                parent = nodes[levels.splats.node_balls[node].parent as usize];
            }
            let own = usize::from(leaves.binary_search(&(leaf as u32)).is_ok());
            let of_leaf = levels.cells_of_leaf(leaf);
            let polygons: Vec<bool> = of_leaf.iter().map(|cell| large[*cell as usize]).collect();
            match polygons.as_slice() {
                [polygons] => assert_eq!(own + above + usize::from(*polygons), 1, "leaf {leaf}, {tau_px} px"),
                several => {
                    // The first of them has the nodes.
                    let splats = several.iter().any(|polygons| !polygons);
                    assert_eq!(own + above, usize::from(splats), "leaf {leaf} of {of_leaf:?}, {tau_px} px");
                    seen[3] += usize::from(own > 0 && several.iter().any(|polygons| *polygons));
                }
            }
            seen[0] += own;
            seen[1] += above;
            seen[2] += usize::from(polygons.iter().all(|polygons| *polygons));
        }
    }
    println!("{seen:?}: splats, below nodes, below polygons, on edges to polygons; {report:?}");
    assert!(seen.iter().all(|count| *count > 500), "{seen:?}");
}

/// The ball of a cell holds its triangles and the splats that it is drawn with; those on edges lie on edges of all their cells.
#[test]
fn a_cell_holds_what_is_drawn_for_it() {
    let Multiresolution { mesh, levels, report, .. } = ball(8000, 4000);
    let splats = &levels.splats;
    let inside = |cell: &PolygonCell, point: DVec3, room: f64| {
        let ball = &splats.balls[cell.ball as usize];
        (point - splats.origin).distance(ball.center.as_dvec3()) + room <= f64::from(ball.radius)
    };
    for cell in &levels.cells {
        let corners = cell.triangles.clone().flat_map(|triangle| mesh.corners(triangle as usize).unwrap());
        corners.for_each(|corner| assert!(inside(cell, corner, 0.0)));
    }
    let mut on_edges = 0;
    for leaf in 0..splats.leaves.len() {
        let center = splats.leaves.positions[leaf];
        let of_leaf = levels.cells_of_leaf(leaf);
        on_edges += usize::from(of_leaf.len() > 1);
        for cell in of_leaf.iter().map(|cell| &levels.cells[*cell as usize]) {
            assert!(inside(cell, center, splats.leaves.major_radius(leaf)), "leaf {leaf}");
            assert!(
                splats.leaves.major_radius(leaf) <= 4.0 * f64::from(splats.balls[cell.ball as usize].spread)
            );
            if of_leaf.len() > 1 {
                let sides = cell.triangles.clone().flat_map(|triangle| {
                    let [a, b, c] = mesh.corners(triangle as usize).unwrap();
                    [(a, b), (b, c), (c, a)]
                });
                let from = |(a, b): (DVec3, DVec3)| {
                    let t = ((center - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
                    center.distance(a.lerp(b, t))
                };
                assert!(sides.map(from).fold(f64::INFINITY, f64::min) < 1e-12, "leaf {leaf}");
            }
        }
    }
    assert_eq!((on_edges, levels.leaf_cell_ends.len()), (report.edge_splats, splats.leaves.len()));
    assert!(report.edge_splats > 300 && report.removed > 50, "{report:?}");
}

/// Of one triangle: no node above it, and no border.
#[test]
fn a_mesh_of_one_cell_has_no_splat_on_an_edge() {
    let mesh = Mesh {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        triangles: vec![[0, 1, 2]],
        ..Mesh::default()
    };
    for samples in [1, 2, 30] {
        let options = HybridOptions { samples, seed: 1, sample_edges: true };
        let made = multiresolution(mesh.clone(), String::new(), &options, &()).unwrap();
        assert_eq!((made.levels.cells.len(), made.report.edge_splats), (1, 0));
        assert_eq!(made.levels.splats.leaves.len() as u64, samples);
        let choice = |distance: f64| {
            let camera = Camera { eye: distance * DVec3::Z, ..Camera::default() };
            hybrid_choice(&made.levels, (&camera, [64, 64]), 1.0)
        };
        assert_eq!(choice(2.0).cells, [0]);
        let far = choice(1e4);
        assert_eq!((far.cells.len(), far.leaves.len() + far.nodes.len()), (0, 1));
    }
}
