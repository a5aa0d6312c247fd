//! What the viewer changes of a scene before it goes to the device: what is seen, how transparent, how large splats are.

use surfel::{
    Result,
    levels_file::LevelsFile,
    notes::counted,
    scene::{HybridLevels, Object, Opacity, Scene, Settings, Shapes, Splats},
};

/// Changes of a scene. Things are objects, then meshes, then those in levels of detail, then files that are read in pages.
#[derive(Clone, Debug, PartialEq)]
pub struct Edits {
    /// For each thing whether it is seen, and its alpha over that of the file.
    pub things: Vec<(bool, f32)>,
    /// Sizes of splats over those of the file.
    pub splat_scale: f32,
}

impl Edits {
    /// None of a scene, and of files beside it.
    pub fn none(scene: &Scene, files: &[LevelsFile]) -> Self {
        let things = things_before_files(scene) + files.len();
        Self { things: vec![(true, 1.0); things], splat_scale: 1.0 }
    }

    /// Whether they leave the scene as it is.
    pub fn are_none(&self) -> bool {
        self.splat_scale == 1.0 && self.things.iter().all(|thing| *thing == (true, 1.0))
    }

    /// Refuses settings that are not for what these changes make transparent.
    ///
    /// # Errors
    /// As [`Settings::check_eye_dome`].
    pub fn check(&self, scene: &Scene, files: &[LevelsFile], settings: &Settings) -> Result<()> {
        let seen = things(scene, files).into_iter().zip(&self.things).filter(|(_, (seen, _))| *seen);
        let mut transparent = seen.filter(|(_, (_, alpha))| *alpha < 1.0);
        transparent.try_for_each(|((name, _), _)| settings.check_eye_dome(&name, "transparent"))
    }

    /// The scene with these changes. An object in levels of detail that is changed is drawn as its own splats, and a mesh that gets another alpha as its
    /// polygons; larger splats leave meshes their levels.
    pub fn of(&self, scene: &Scene) -> Scene {
        let thing = |number: usize| self.things.get(number).copied().unwrap_or((true, 1.0));
        let mut edited = Scene {
            lights: scene.lights.clone(),
            storage: scene.storage,
            without_auto_epsilon: scene.without_auto_epsilon,
            levels: scene.levels,
            budget: scene.budget,
            numbered: scene.numbered,
            ..Scene::default()
        };
        for (number, object) in scene.objects.iter().enumerate() {
            if let (true, alpha) = thing(number) {
                let splats = self.splats(&object.splats, alpha);
                let (name, closed) = (object.name.clone(), object.closed);
                edited.objects.push(Object { name, splats, closed });
                edited.epsilons.push(scene.own_epsilon(number));
            }
        }
        let before = scene.objects.len();
        for (number, object) in scene.meshes.iter().enumerate() {
            if let (true, alpha) = thing(before + number) {
                let mut object = object.clone();
                object.mesh.colors.tint(None, alpha);
                let levels = scene.hybrids.iter().filter(|levels| levels.mesh == number && alpha == 1.0);
                edited.hybrids.extend(levels.map(|levels| self.hybrid(levels, edited.meshes.len())));
                edited.meshes.push(object);
            }
        }
        let before = before + scene.meshes.len();
        for (number, object) in scene.leveled.iter().enumerate() {
            match thing(before + number) {
                (false, _) => {}
                (true, 1.0) if self.splat_scale == 1.0 => edited.leveled.push(object.clone()),
                (true, alpha) => {
                    let splats = self.splats(&object.leaves, alpha);
                    let (name, closed) = (object.name.clone(), object.closed);
                    edited.objects.push(Object { name, splats, closed });
                    edited.epsilons.push(None);
                }
            }
        }
        edited
    }

    /// The levels of a mesh, which is this one of the scene now.
    fn hybrid(&self, levels: &HybridLevels, mesh: usize) -> HybridLevels {
        let mut levels = HybridLevels { mesh, ..levels.clone() };
        scale(&mut levels.splats.leaves, self.splat_scale);
        scale(&mut levels.splats.nodes, self.splat_scale);
        // Areas grow, and so does what they sum to.
        levels.splats.overlap *= f64::from(self.splat_scale).powi(2);
        levels
    }

    /// Splats with an alpha over their own, and the size of now.
    pub fn splats(&self, splats: &Splats, alpha: f32) -> Splats {
        let mut splats = splats.clone();
        scale(&mut splats, self.splat_scale);
        if alpha != 1.0 {
            splats.colors.tint(None, alpha);
        }
        splats
    }
}

/// Splats so many times as large, about their centers.
fn scale(splats: &mut Splats, by: f32) {
    match &mut splats.shapes {
        Shapes::Disks { radii, .. } => radii.iter_mut().for_each(|radius| *radius *= by),
        Shapes::Ellipses { s, t } => s.iter_mut().chain(t).for_each(|tangent| *tangent *= by),
    }
}

/// Some splats of each object, as much larger as they are fewer, so many in all; and all polygons.
pub fn part_of(scene: &Scene, splats: usize) -> Scene {
    let (mut part, one_of) = some_of(scene, splats);
    for object in &mut part.objects {
        scale(&mut object.splats, one_of.sqrt() as f32);
    }
    part
}

/// The same as large as they are, and that they are one of so many.
pub fn some_of(scene: &Scene, splats: usize) -> (Scene, f64) {
    let all = scene.splat_count().max(splats);
    let objects = scene.objects.iter().map(|object| {
        let places = (0..object.splats.len()).map(|place| place * all / splats);
        let splats = object.splats.picked(places.take_while(|place| *place < object.splats.len()));
        Object { name: object.name.clone(), splats, closed: object.closed }
    });
    let some = Scene {
        objects: objects.collect(),
        meshes: scene.meshes.clone(),
        lights: scene.lights.clone(),
        epsilons: scene.epsilons.clone(),
        without_auto_epsilon: true,
        leveled: scene.leveled.clone(),
        ..Scene::default()
    };
    (some, all as f64 / splats as f64)
}

/// How many things are before the files beside a scene.
pub fn things_before_files(scene: &Scene) -> usize {
    scene.objects.len() + scene.meshes.len() + scene.leveled.len()
}

/// The names of a scene's things, and of files beside it, in the order of [`Edits`], with what they are in a word or two.
pub fn things(scene: &Scene, files: &[LevelsFile]) -> Vec<(String, String)> {
    let transparent = |opacity| if opacity == Opacity::Opaque { "" } else { ", transparent" };
    let objects = scene.objects.iter().map(|object| {
        let (count, opacity) = (object.splats.len(), object.splats.colors.opacity());
        (object.name.clone(), format!("{}{}", counted(count as u64, "splats"), transparent(opacity)))
    });
    let meshes = scene.meshes.iter().map(|object| {
        let (count, opacity) = (object.mesh.triangles.len(), object.mesh.colors.opacity());
        (object.name.clone(), format!("{}{}", counted(count as u64, "triangles"), transparent(opacity)))
    });
    let leveled = scene.leveled.iter().map(|object| {
        let count = object.leaves.len();
        (object.name.clone(), format!("{count} splats in levels{}", transparent(object.opacity)))
    });
    let paged = files
        .iter()
        .map(|file| (file.name().to_owned(), format!("{} splats in pages", file.header().splats)));
    let mut all: Vec<(String, String)> = objects.chain(meshes).chain(leveled).chain(paged).collect();
    let mut named = std::collections::HashMap::<String, (usize, usize)>::new();
    all.iter().for_each(|(name, _)| named.entry(name.clone()).or_default().0 += 1);
    for (name, _) in &mut all {
        if let Some((count @ 2.., before)) = named.get_mut(name.as_str()) {
            *before += 1;
            *name = format!("{name}, {before} of {count}");
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3};
    use surfel::{
        geometry::{HybridOptions, multiresolution},
        load::builtin::sphere_mesh,
        scene::{Colors, Epsilon, MeshObject, Shading},
    };

    use super::*;

    fn object(name: &str, radius: f32) -> Object {
        let shapes = Shapes::Disks { normals: vec![Vec3::Z; 2], radii: vec![radius; 2] };
        let splats = Splats::new(vec![DVec3::ZERO, DVec3::X], shapes, Colors::Uniform([1.0; 4]));
        Object { name: name.to_owned(), splats, closed: false }
    }

    #[test]
    fn meshes_keep_their_levels_unless_they_turn_transparent() {
        let mut scene = Scene::default();
        let options = HybridOptions { samples: 2000, seed: 0, sample_edges: true };
        for name in ["a", "b"] {
            let made = multiresolution(sphere_mesh(500), name.to_owned(), &options, &()).unwrap();
            scene.hybrids.push(HybridLevels { mesh: scene.meshes.len(), ..made.levels });
            scene.meshes.push(MeshObject { name: name.to_owned(), mesh: made.mesh, closed: made.closed });
        }
        let mut edits = Edits::none(&scene, &[]);
        assert_eq!(edits.things.len(), 2);
        edits.things[0].0 = false;
        edits.splat_scale = 2.0;
        let edited = edits.of(&scene);
        assert_eq!((edited.meshes.len(), edited.hybrids.len(), edited.meshes[0].name.as_str()), (1, 1, "b"));
        let (new, old) = (&edited.hybrids[0], &scene.hybrids[1]);
        assert_eq!((new.mesh, &new.cells), (0, &old.cells));
        assert_eq!(new.splats.leaves.major_radius(5), 2.0 * old.splats.leaves.major_radius(5));
        assert_eq!(new.splats.nodes.major_radius(0), 2.0 * old.splats.nodes.major_radius(0));
        assert_eq!(new.splats.overlap, 4.0 * old.splats.overlap);
        let edited = Edits { things: vec![(true, 0.5), (true, 1.0)], splat_scale: 1.0 }.of(&scene);
        assert_eq!(edited.hybrids.iter().map(|levels| levels.mesh).collect::<Vec<_>>(), [1]);
    }

    #[test]
    fn what_is_made_transparent_has_no_eye_dome_lighting() {
        let scene = Scene { objects: vec![object("a", 1.0), object("b", 2.0)], ..Scene::default() };
        let edl = Settings { shading: Shading::EyeDome, ..Settings::default() };
        let with = |things: [(bool, f32); 2]| Edits { things: things.into(), splat_scale: 1.0 };
        for (things, settings, is_drawn) in [
            ([(true, 1.0), (true, 1.0)], &edl, true),
            ([(true, 1.0), (true, 0.9)], &edl, false),
            ([(true, 1.0), (false, 0.9)], &edl, true),
            ([(true, 1.0), (true, 0.9)], &Settings::default(), true),
        ] {
            assert_eq!(with(things).check(&scene, &[], settings).is_ok(), is_drawn, "{things:?}");
        }
    }

    #[test]
    fn a_part_has_as_many_splats_as_are_asked_for_and_covers_as_much() {
        let scene = Scene { objects: (0..7).map(|_| object("a", 1.0)).collect(), ..Scene::default() };
        let (some, one_of) = some_of(&scene, 10);
        assert_eq!((some.splat_count(), one_of), (14, 1.4));
        let shapes = Shapes::Disks { normals: vec![Vec3::Z; 1000], radii: vec![1.0; 1000] };
        let centers = (0..1000).map(|x| DVec3::X * f64::from(x)).collect();
        let splats = Splats::new(centers, shapes, Colors::Uniform([1.0; 4]));
        let scene = Scene { objects: vec![Object { splats, ..object("b", 1.0) }], ..Scene::default() };
        let (some, part) = (some_of(&scene, 600).0, part_of(&scene, 600));
        let [some, part] = [some, part].map(|scene| scene.objects.into_iter().next().unwrap().splats);
        assert_eq!((some.len(), some.major_radius(7)), (600, 1.0));
        let area = part.len() as f64 * part.major_radius(0).powi(2);
        assert!((area - 1000.0).abs() < 1.0, "{area}");
        // All of a scene that has no more.
        let (all, one_of) = some_of(&scene, 1000);
        assert_eq!((all.splat_count(), one_of), (1000, 1.0));
    }

    #[test]
    fn things_of_one_name_are_numbered() {
        let objects = ["a", "b", "a", "a"].map(|name| object(name, 1.0)).into();
        let names: Vec<_> =
            things(&Scene { objects, ..Scene::default() }, &[]).into_iter().map(|(name, _)| name).collect();
        assert_eq!(names, ["a, 1 of 3", "b", "a, 2 of 3", "a, 3 of 3"]);
    }

    #[test]
    fn what_is_hidden_goes_and_the_rest_keeps_its_own() {
        let scene = Scene {
            objects: vec![object("a", 1.0), object("b", 2.0)],
            epsilons: vec![None, Some(Epsilon::Length(3.0))],
            ..Scene::default()
        };
        let mut edits = Edits::none(&scene, &[]);
        assert!(edits.are_none() && edits.of(&scene).objects.len() == 2);
        edits.things = vec![(false, 1.0), (true, 0.5)];
        edits.splat_scale = 1.5;
        let edited = edits.of(&scene);
        assert_eq!((edited.objects.len(), edited.objects[0].name.as_str()), (1, "b"));
        assert_eq!(edited.own_epsilon(0), Some(Epsilon::Length(3.0)));
        assert_eq!(edited.objects[0].splats.color(0), [1.0, 1.0, 1.0, 0.5]);
        assert_eq!(edited.objects[0].splats.major_radius(0), 3.0);
        assert_eq!(things(&scene, &[])[1], ("b".to_owned(), "2 splats".to_owned()));
    }
}
