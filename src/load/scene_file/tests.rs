mod faults;

use std::{f64::consts::FRAC_PI_2, fs, path::PathBuf};

use glam::{DAffine3, DVec3};

use super::*;
use crate::{
    math::srgb::linear_from_srgb,
    scene::{CameraParts, Epsilon, Light, LightKind, PictureHeight, Settings, Shading},
};

/// A folder with a model beside and below the scene file, and one outside.
struct Place(temp_dir::TempDir);

impl Place {
    fn new() -> Self {
        let folder = temp_dir::TempDir::new().unwrap();
        for below in ["scene/models", "other"] {
            fs::create_dir_all(folder.path().join(below)).unwrap();
        }
        for model in ["scene/a.ply", "scene/models/b.obj", "other/c.ply"] {
            fs::write(folder.path().join(model), "").unwrap();
        }
        Self(folder)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().canonicalize().unwrap().join(name)
    }

    fn read(&self, text: impl AsRef<[u8]>) -> std::result::Result<SceneFile, String> {
        let path = self.path("scene/scene.toml");
        fs::write(&path, text).unwrap();
        load_scene_file(&path, &LoadOptions::default()).map_err(|error| {
            assert_eq!(error.exit_code(), 1);
            let said = error.to_string();
            assert!(!said.contains('\n'), "one line: {said}");
            said.replace(&format!("{}/", self.path("scene").display()), "")
        })
    }
}

fn read(text: &str) -> std::result::Result<SceneFile, String> {
    Place::new().read(text)
}

/// The keys of the one object of a scene, which is built in unless they say otherwise.
fn object(keys: &str) -> std::result::Result<ObjectDescription, String> {
    let source =
        if keys.contains("file") || keys.contains("builtin") { "" } else { "builtin = \"sphere\"\n" };
    read(&format!("[[object]]\n{source}{keys}\n")).map(|mut file| file.objects.remove(0))
}

#[test]
fn everything_that_can_be_said() {
    let place = Place::new();
    let file = place
        .read(
            "# A scene.\n[camera]\neye = [0, 1.5, 4]\ntarget = [0, 0, 0]\nup = [0, 0, 1]\nfov_deg = 60\nnear = 1e-3\n\
             [[light]]\nkind = \"eye\"\n[[light]]\nkind = \"directional\"\ndirection = [0, -1, 0]\ncolor = [1, 0.5, 0]\n\
             intensity = 2\n\
             [[object]]\nfile = \"a.ply\"\nname = \"glass\"\ncolor = [0.5, 1, 0]\nalpha = 0.25\n\
             [[object]]\nfile = \"./models/../models/b.obj\"\nresample = 1_000\nseed = 7\n\
             [[object]]\nbuiltin = \"relief\"\nsplats = 5000\n\
             [[object]]\nbuiltin = \"sphere\"\nrepresentation = \"mesh\"\ntriangles = 80\n\
             [[object]]\nfile = \"models/b.obj\"\nrepresentation = \"hybrid\"\nresample = 9\n\
             polygons = { plane = [0, 0, 2, -1] }\nsample_edges = false\n\
             [[object]]\nbuiltin = \"sphere\"\nrepresentation = \"hybrid\"\npolygons.longer_than = 0.5\n",
        )
        .unwrap();
    let camera = CameraParts {
        eye: Some(DVec3::new(0.0, 1.5, 4.0)),
        target: Some(DVec3::ZERO),
        up: Some(DVec3::Z),
        fov_y_rad: Some(60_f64.to_radians()),
        near: Some(1e-3),
        ..CameraParts::default()
    };
    assert_eq!(file.camera, Some(camera));
    let parts =
        |text: &str| read(&format!("[camera]\n{text}\n[[object]]\nbuiltin = \"sphere\"\n")).unwrap().camera;
    let parallel = |height| Some(CameraParts { orthographic: Some(height), ..CameraParts::default() });
    assert_eq!(parts("orthographic = 2.5"), parallel(PictureHeight::World(2.5)));
    assert_eq!(parts("orthographic = \"fit\""), parallel(PictureHeight::Fit));
    let none = CameraParts::default();
    let angles = CameraParts { azimuth_rad: Some(FRAC_PI_2), elevation_rad: Some(0.0), ..none };
    assert_eq!(parts("view = \"right\""), Some(angles));
    assert_eq!(parts("azimuth_deg = 90\nelevation_deg = 0"), Some(angles));
    assert_eq!(parts("zoom = 2"), Some(CameraParts { zoom: Some(2.0), ..none }));
    assert_eq!(parts("up = \"-z\""), Some(CameraParts { up: Some(DVec3::NEG_Z), ..none }));
    assert_eq!(parts("up = \"auto\""), Some(none));
    let looks = read("[camera]\ntarget = \"left ball\"\n[[object]]\nbuiltin = \"sphere\"\n").unwrap();
    assert_eq!((looks.camera, looks.camera_target.as_deref()), (Some(none), Some("left ball")));
    let orange = [2.0, 2.0 * linear_from_srgb(0.5), 0.0];
    let directional = Light { kind: LightKind::Directional(DVec3::NEG_Y), color: orange };
    assert_eq!(file.lights, [Light::DEFAULT, directional]);

    let plain = ObjectDescription::of_file(place.path("scene/a.ply"));
    let samples = |count, seed| Some(Samples { count, seed });
    let b = ObjectDescription::of_file(place.path("scene/models/b.obj"));
    let plane = Polygons::Plane { normal: 2.0 * DVec3::Z, d: -1.0 };
    let hybrid = |polygons, sample_edges| Representation::Hybrid { polygons: Some(polygons), sample_edges };
    let sphere = ObjectDescription::of_built_in(BuiltIn::Sphere);
    let built_in = |model, splats, triangles| Source::BuiltIn { model, splats, triangles };
    let expected = [
        ObjectDescription {
            name: Some("glass".to_owned()),
            color: Some([linear_from_srgb(0.5), 1.0, 0.0]),
            alpha: 0.25,
            ..plain
        },
        ObjectDescription { samples: samples(1000, 7), ..b.clone() },
        ObjectDescription { source: built_in(BuiltIn::Relief, 5000, 20_480), ..sphere.clone() },
        ObjectDescription {
            source: built_in(BuiltIn::Sphere, 20_000, 80),
            representation: Representation::Mesh,
            ..sphere.clone()
        },
        ObjectDescription { representation: hybrid(plane, false), samples: samples(9, 0), ..b },
        ObjectDescription { representation: hybrid(Polygons::LongerThan(0.5), true), ..sphere },
    ];
    assert_eq!(file.objects, expected);
    assert_eq!(file.path, place.path("scene/scene.toml"));
}

#[test]
fn what_is_said_of_the_picture_replaces_settings_key_by_key() {
    let sphere = "[[object]]\nbuiltin = \"sphere\"\n";
    let settings = |keys: &str| {
        let file = read(&format!("{keys}{sphere}")).unwrap();
        file.picture.over(Settings { epsilon: Epsilon::Radii(3.0), ..Settings::default() })
    };
    assert_eq!(settings("").epsilon, Epsilon::Radii(3.0));
    assert_eq!(settings("epsilon = \"auto\"\n").epsilon, Epsilon::Auto);
    assert_eq!(settings("epsilon = 1\n").epsilon, Epsilon::Length(1.0));
    let all = settings("epsilon = \"0.5r\"\nbackground = [0, 0.5, 1]\nshading = \"albedo\"\n");
    assert_eq!(
        (all.epsilon, all.background, all.shading),
        (Epsilon::Radii(0.5), Some([0.0, 0.5, 1.0]), Shading::Albedo)
    );
    assert_eq!(settings("background = \"none\"\n").background, None);
    let own = read(&format!("{sphere}epsilon = 0.25\n{sphere}")).unwrap();
    let own: Vec<_> = own.objects.iter().map(|object| object.epsilon).collect();
    assert_eq!(own, [Some(Epsilon::Length(0.25)), None]);
}

#[test]
fn tables_may_be_written_in_a_line_each_and_little_is_enough() {
    let file =
        read("object = [\n  { builtin = \"sphere\" },\n  { builtin = \"checkerboard\" },\n]\n").unwrap();
    assert_eq!((file.camera, file.lights.len()), (None, 0));
    let described = [BuiltIn::Sphere, BuiltIn::Checkerboard].map(ObjectDescription::of_built_in);
    assert_eq!(file.objects, described);
}

#[test]
fn transforms_scale_then_turn_about_x_y_z_then_move() {
    let map = |keys| object(keys).unwrap().world_from_object;
    assert_eq!(map(""), DAffine3::IDENTITY);
    assert_eq!(map("scale = 2"), DAffine3::from_scale(DVec3::splat(2.0)));
    let turned = map("translate = [10, 20, 30]\nrotate_deg = [90, 0, 90]\nscale = [2, 3, -4]");
    // x: scaled, not turned by x, turned to y by z. y: to z. z: to −y, then to x; mirrored before.
    for (from, to) in [
        (DVec3::X, DVec3::new(10.0, 22.0, 30.0)),
        (DVec3::Y, DVec3::new(10.0, 20.0, 33.0)),
        (DVec3::Z, DVec3::new(6.0, 20.0, 30.0)),
    ] {
        let found = turned.transform_point3(from);
        assert!(found.distance(to) < 1e-14, "{from}: {found}");
    }
    let about_y = map("rotate_deg = [0, 90, 0]").transform_point3(DVec3::Z);
    assert!(about_y.distance(DVec3::X) < 1e-15 && FRAC_PI_2 == 90_f64.to_radians());
    let rows = map("matrix = [[1, 2, 3, 4], [0, 1, 5, 6], [0, 0, 1, 7]]");
    assert_eq!(rows, map("matrix = [[1, 0, 0], [2, 1, 0], [3, 5, 1], [4, 6, 7]]"));
    assert_eq!(rows.transform_point3(DVec3::ONE), DVec3::new(10.0, 12.0, 8.0));
}

#[test]
fn files_outside_the_scenes_folder_are_not_opened() {
    let place = Place::new();
    let refused = |file: &str| place.read(format!("[[object]]\nfile = '{file}'\n")).unwrap_err();
    let inside = "expected a file within the scene file's folder, links followed, or --allow-outside";
    for outside in ["../other/c.ply", "models/../../other/c.ply", ".."] {
        let expected = format!("scene.toml: line 2, object 1, file: '{outside}': {inside}");
        assert_eq!(refused(outside), expected);
    }
    let absolute = place.path("scene/a.ply").display().to_string();
    assert!(
        refused(&absolute)
            .ends_with(": expected a path relative to the scene file's folder, or --allow-outside")
    );
    // Where the user allows it, all of them are.
    let allowed = LoadOptions { allow_outside: true, ..LoadOptions::default() };
    let with = |file: &str| {
        let text = format!("[[object]]\nfile = '{file}'\n");
        let read = parse(&place.path("scene/scene.toml"), &text, &allowed);
        read.map(|file| file.objects[0].source.clone()).map_err(|e| e.to_string())
    };
    assert_eq!(with("../other/c.ply"), Ok(Source::File(place.path("other/c.ply"))));
    assert_eq!(with(&absolute), Ok(Source::File(place.path("scene/a.ply"))));
    assert!(with("../none.ply").unwrap_err().contains("cannot read: No such file"));
    assert!(refused("none.ply").contains("object 1, file: none.ply: cannot read: No such file"));
    assert!(place.read("[[object]]\nfile = \"a\\u0000b\"\n").unwrap_err().contains("file: "));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("../other/c.ply", place.path("scene/link.ply")).unwrap();
        std::os::unix::fs::symlink("../other", place.path("scene/folder")).unwrap();
        std::os::unix::fs::symlink("models/b.obj", place.path("scene/fine.obj")).unwrap();
        for link in ["link.ply", "folder/c.ply"] {
            assert!(refused(link).ends_with(inside), "{link}");
        }
        let file = place.read("[[object]]\nfile = \"fine.obj\"\n").unwrap();
        assert_eq!(file.objects[0].source, Source::File(place.path("scene/models/b.obj")));
    }
}
