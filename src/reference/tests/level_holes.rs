//! Where the splats cover a pixel and the nodes that stand for them do not.

use glam::DVec3;

use super::levels::view;
use super::settings;
use crate::{
    geometry::hierarchy::{Hierarchy, Projection, Selection, tests::models::models},
    reference::{render_view, tangents::tangents, view::View},
    scene::{Backfaces, Colors, Object, Scene, Settings, Shapes, Splats},
};

const SIDE_PX: u32 = 96;

/// Views of each model, and the sizes that are asked for in each.
const VIEWS: u64 = 4;
const TAUS_PX: [f64; 2] = [5.0, 20.0];

/// What a pixel is covered by, or not, to be spoken of: hit within the disk's rim but for rounding.
const INSIDE: f64 = 1.0 - 1e-9;

struct Model {
    splats: Splats,
    hierarchy: Hierarchy,
}

impl Model {
    /// The selection as splats.
    fn drawn(&self, selection: &Selection) -> Splats {
        let leaves = selection.leaves.iter().map(|&leaf| self.hierarchy.order[leaf as usize] as usize);
        let of_leaves = leaves.map(|i| (self.splats.positions[i], tangents(&self.splats.shapes, i)));
        let nodes = selection.nodes.iter().map(|&node| node as usize);
        let of_nodes =
            nodes.map(|i| (self.hierarchy.nodes.positions[i], tangents(&self.hierarchy.nodes.shapes, i)));
        let (positions, axes): (_, Vec<_>) = of_leaves.chain(of_nodes).unzip();
        let (s, t) = axes.into_iter().map(|(s, t)| (s.as_vec3(), t.as_vec3())).unzip();
        Splats::new(positions, Shapes::Ellipses { s, t }, Colors::unknown())
    }

    /// For each splat by its place along the tree, the normal of the drawn node that stands for it.
    fn plane_normals(&self, selection: &Selection) -> Vec<Option<DVec3>> {
        let mut normals = vec![None; self.hierarchy.order.len()];
        for &node in &selection.nodes {
            let (s, t) = tangents(&self.hierarchy.nodes.shapes, node as usize);
            let splats = &self.hierarchy.tree[node as usize].splats;
            normals[splats.start as usize..splats.end as usize].fill(Some(s.cross(t).normalize()));
        }
        normals
    }

    /// The splats that a ray from the eye meets inside of their rims and in front of the near plane, by their place along the tree.
    fn hit(&self, view: &View, ray: DVec3) -> impl Iterator<Item = usize> {
        (0..self.hierarchy.order.len()).filter(move |&place| {
            let i = self.hierarchy.order[place] as usize;
            let center = view.from_world.point(self.splats.positions[i]);
            let (s, t) = tangents(&self.splats.shapes, i);
            let (s, t) = (view.from_world.rotation * s, view.from_world.rotation * t);
            let normal = s.cross(t);
            let met = ray * (normal.dot(center) / normal.dot(ray));
            let q = met - center;
            let (u, v) = (q.cross(t).dot(normal), s.cross(q).dot(normal));
            met.z > view.near && u * u + v * v <= INSIDE * normal.length_squared().powi(2)
        })
    }
}

fn coverage(mut splats: Splats, view: View, settings: &Settings) -> Vec<bool> {
    splats.colors = Colors::unknown(); // the weight is that of what is opaque
    let object = Object { name: "levels".into(), splats, closed: false };
    let scene = Scene { objects: vec![object], ..Scene::default() };
    let picture = render_view(&scene, view, settings, true, &|_, _| {}).unwrap();
    picture.pixels.iter().map(|pixel| pixel.weight > 0.0).collect()
}

#[test]
fn no_surface_seen_at_up_to_45_degrees_has_a_hole() {
    let settings = Settings { backfaces: Backfaces::Flip, ..settings(SIDE_PX) };
    // The oracle draws the scan for minutes.
    for (name, splats) in models().into_iter().filter(|(name, _)| *name != "igea.ply") {
        let model = Model { hierarchy: Hierarchy::build(&splats, &()).unwrap(), splats };
        let (mut covered, mut lost, mut nodes) = (0, 0, 0);
        for seed in 0..VIEWS {
            let (camera, _) = view(&model.splats, seed);
            let view = View::pinhole(&camera, settings.size_px);
            let full = coverage(model.splats.clone(), view, &settings);
            for tau_px in TAUS_PX {
                let projection = Projection::of_camera(&camera, SIDE_PX, &model.hierarchy);
                let selection = model.hierarchy.select(&projection, tau_px);
                let coarse = coverage(model.drawn(&selection), view, &settings);
                let normals = model.plane_normals(&selection);
                nodes += selection.nodes.len();
                covered += full.iter().filter(|&&covers| covers).count();
                let holes = (0..SIDE_PX * SIDE_PX).filter(|&i| full[i as usize] && !coarse[i as usize]);
                for pixel in holes {
                    lost += 1;
                    let ray = view.ray(pixel % SIDE_PX, pixel / SIDE_PX);
                    for place in model.hit(&view, ray) {
                        let normal = normals[place].expect("a splat that is drawn covers the pixel");
                        let cos = (view.from_world.rotation * normal).dot(ray).abs() / ray.length();
                        assert!(
                            cos < std::f64::consts::FRAC_1_SQRT_2,
                            "{name}: view {seed}, {tau_px} px: pixel {pixel} is a hole seen at {:.1}°",
                            cos.acos().to_degrees()
                        );
                    }
                }
            }
        }
        println!("{name}: {lost} of {covered} pixels are covered by splats and not by their {nodes} nodes");
    }
}
