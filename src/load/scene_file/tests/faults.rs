//! What is refused, and in which words.

use super::*;

#[test]
fn a_file_that_is_no_scene_file() {
    let cases: [(&[u8], &str); 8] = [
        (b"", "line 1: no [[object]]; expected at least one"),
        (b"object = []\n", "line 1: no [[object]]; expected at least one"),
        (b"a\xff", "line 1: not UTF-8; expected a scene file, which is text"),
        (b"\n\n[[object]\n", "line 3: not TOML: "),
        (b"[[object]]\nalpha = 1\nalpha = 1\n", "line 3: not TOML: duplicate key"),
        (b"[[object]]\nalpha = = 1\n", "line 2: not TOML: "),
        (b"\x89PNG\r\n", "line 1: not UTF-8"),
        (b"ply\nformat ascii 1.0\n", "line 1: not TOML: "),
    ];
    let place = Place::new();
    for (text, expected) in cases {
        let error = place.read(text).unwrap_err();
        assert!(error.starts_with(&format!("scene.toml: {expected}")), "{error}");
    }
    for (levels, expected) in
        [(MOST_NESTED, "unknown key 'a'"), (MOST_NESTED + 1, "nested too deeply; expected at most 80 levels")]
    {
        let error = place.read(format!("a = {}{}\n", "[".repeat(levels), "]".repeat(levels))).unwrap_err();
        assert!(error.starts_with(&format!("scene.toml: line 1: {expected}")), "{error}");
    }
    // So deep that a parser that calls itself, or a table that drops itself, would run out of stack.
    for [open, middle, close] in [["[", "", "]"], ["{a=", "1", "}"], ["{a.a=", "1", "}"]] {
        let deep = format!("object = {}{middle}{}", open.repeat(40_000), close.repeat(40_000));
        assert!(place.read(deep).unwrap_err().starts_with("scene.toml: line 1: nested too deeply"), "{open}");
    }
    let dotted = format!("a{}", ".a".repeat(100_000));
    for deep in [format!("{dotted} = 1\n"), format!("[{dotted}]\n"), format!("[[{dotted}]]\n")] {
        let error = place.read(deep).unwrap_err();
        assert!(error.starts_with("scene.toml: line 1: ") && error.len() < 200, "{error}");
    }
    let large = vec![b'#'; 1 + MOST_SCENE_FILE_BYTES as usize];
    assert_eq!(
        place.read(large).unwrap_err(),
        "scene.toml: 262145 bytes; expected a scene file, at most 262144"
    );
    let folder = load_scene_file(&place.path("scene"), &LoadOptions::default()).unwrap_err().to_string();
    assert!(folder.ends_with("scene: not a file; expected a scene file"), "{folder}");
    let none = load_scene_file(&place.path("none.toml"), &LoadOptions::default()).unwrap_err().to_string();
    assert!(none.contains("none.toml: cannot read: No such file"), "{none}");
}

#[test]
fn no_more_objects_and_lights_than_there_may_be() {
    let many = |count: usize| "[[object]]\nbuiltin=\"sphere\"\n".repeat(count);
    assert_eq!(read(&many(MOST_OBJECTS)).unwrap().objects.len(), MOST_OBJECTS);
    let expected = "scene.toml: line 2049, object 1025: one too many; expected at most 1024";
    assert_eq!(read(&many(MOST_OBJECTS + 1)).unwrap_err(), expected);
    let lights = "[[light]]\nkind=\"eye\"\n".repeat(17);
    let expected = "scene.toml: line 33, light 17: one too many; expected at most 16";
    assert_eq!(read(&format!("{lights}{}", many(1))).unwrap_err(), expected);
}

#[test]
fn unknown_keys_are_told_with_the_nearest_known_one() {
    let sphere = "[[object]]\nbuiltin = \"sphere\"\n";
    let cases = [
        (format!("{sphere}[[lights]]\n"), "line 3: unknown key 'lights'; expected 'light'"),
        (format!("{sphere}Color = [1, 1, 1]\n"), "line 3, object 1: unknown key 'Color'; expected 'color'"),
        (format!("{sphere}{sphere}aplha = 1\n"), "line 5, object 2: unknown key 'aplha'; expected 'alpha'"),
        // The first of them, in the order of the text.
        (
            format!("{sphere}rotate = 1\nalpa = 1\n"),
            "line 3, object 1: unknown key 'rotate'; expected 'rotate_deg'",
        ),
        (format!("[camera]\nfov = 1\n{sphere}"), "line 2, camera: unknown key 'fov'; expected 'fov_deg'"),
        (
            format!("[[light]]\nintensty = 1\n{sphere}"),
            "line 2, light 1: unknown key 'intensty'; expected 'intensity'",
        ),
        (
            format!("{sphere}representation=\"hybrid\"\npolygons={{ big = 1 }}\n"),
            "line 4, object 1, polygons: unknown key 'big'; expected 'plane' or 'longer_than'",
        ),
        (
            format!("{sphere}\"a\\u001b\\n{}\" = 1\n", "b".repeat(99)),
            &format!("line 3, object 1: unknown key 'a {}…'; expected 'file'", "b".repeat(38)),
        ),
    ];
    for (text, expected) in cases {
        let error = read(&text).unwrap_err();
        assert!(error.starts_with(&format!("scene.toml: {expected}")), "{error}");
    }
}

/// Lines of a text and what is said of it; `↵` stands for the end of a line.
fn table(cases: &str) -> impl Iterator<Item = (String, &str)> {
    let cases = cases.lines().skip(1).map(|line| line.split_once(" => ").unwrap());
    cases.map(|(text, said)| (text.replace('↵', "\n"), said))
}

#[test]
fn cameras_and_lights_that_cannot_be() {
    let cases = r#"
camera = 1 => line 1, camera: 1: expected a table
[camera]↵eye = [0, 1] => line 2, camera, eye: [0, 1]: expected three numbers
[camera]↵eye = [0, 1, nan] => line 2, camera, eye: [0, 1, nan]: expected three numbers
[camera]↵up = "w" => line 2, camera, up: "w": expected three numbers, "auto", "x", "y", "z"
[camera]↵target = [1, 2] => line 2, camera, target: [1, 2]: expected three numbers, or the name of an object
[camera]↵view = "rigth" => line 2, camera, view: "rigth": expected 'right'
[camera]↵view = "top"↵eye = [0, 0, 1] => line 1, camera: both eye and view; expected one of them
[camera]↵view = "top"↵azimuth_deg = 1 => line 1, camera: both view and azimuth_deg or elevation_deg; expected one of them
[camera]↵elevation_deg = 91 => line 2, camera, elevation_deg: 91: expected degrees, -90 to 90
[camera]↵zoom = 0 => line 2, camera, zoom: 0: expected a number, 1e-6 to 1e6
[camera]↵fov_deg = 180 => line 2, camera, fov_deg: 180: expected degrees above 1e-10 and below 180
[camera]↵fov_deg = 0 => line 2, camera, fov_deg: 0: expected degrees
[camera]↵orthographic = 0 => line 2, camera, orthographic: 0: expected a height above 0, or "fit"
[camera]↵orthographic = "all" => line 2, camera, orthographic: "all": expected a height above 0, or "fit"
[camera]↵orthographic = 1↵fov_deg = 9 => line 1, camera: both fov_deg and orthographic; expected one of them
[camera]↵near = 0 => line 2, camera, near: 0: expected a number above 0
[camera]↵near = 1e400 => line 2, camera, near: 1e400: expected a number above 0
[camera]↵eye = [1, 2, 3]↵target = [1, 2, 3.0] => line 1, camera: eye and target are the same; expected two different points
light = 1 => line 1, light: 1: expected tables, each headed [[light]]
[light]↵kind = "eye" => line 1, light: a table: expected tables, each headed [[light]]
light = [1] => line 1, light 1: 1: expected a table
[[light]] => line 1, light 1: no kind; expected 'eye' or 'directional'
[[light]]↵kind = "sun" => line 2, light 1, kind: "sun": expected 'eye' or 'directional'
[[light]]↵kind = "direct" => line 2, light 1, kind: "direct": expected 'directional'
[[light]]↵kind = "directional" => line 1, light 1: no direction; expected in which direction the light travels
[[light]]↵kind = "directional"↵direction = [0, 0.0, 0] => line 3, light 1, direction: [0, 0.0, 0]: expected in which direction the light travels, three numbers
[[light]]↵kind = "eye"↵direction = [0, 0, 1] => line 3, light 1, direction: has no meaning for a light at the eye; expected kind = "directional"
[[light]]↵kind = "eye"↵color = [0, 0, 2] => line 3, light 1, color: [0, 0, 2]: expected three numbers from 0 to 1 (sRGB)
[[light]]↵kind = "eye"↵intensity = -1 => line 3, light 1, intensity: -1: expected a number, at least 0
[[light]]↵kind = "eye"↵intensity = 1e39 => line 3, light 1, intensity: 1e39: expected a number"#;
    for (text, expected) in table(cases) {
        let error = read(&format!("{text}\n[[object]]\nbuiltin = \"sphere\"\n")).unwrap_err();
        assert!(error.starts_with(&format!("scene.toml: {expected}")), "{error}");
    }
}

#[test]
fn objects_that_cannot_be() {
    let cases = r#"
alpha = 1.5 => line 3, object 1, alpha: 1.5: expected a number from 0 to 1
alpha = -0.1 => line 3, object 1, alpha: -0.1: expected a number from 0 to 1
alpha = nan => line 3, object 1, alpha: nan: expected a number from 0 to 1
alpha = true => line 3, object 1, alpha: true: expected a number from 0 to 1
color = [0, 0, 256] => line 3, object 1, color: [0, 0, 256]: expected three numbers from 0 to 1
color = "red" => line 3, object 1, color: "red": expected three numbers from 0 to 1
name = "" => line 3, object 1, name: "": expected 1 to 100 letters on one line
name = "a\nb" => line 3, object 1, name: "a\nb": expected 1 to 100 letters
name = 1 => line 3, object 1, name: 1: expected a name
scale = 0 => line 3, object 1, scale: 0: expected a number or three numbers, none of them 0
scale = [1, 0, 1] => line 3, object 1, scale: [1, 0, 1]: expected a number or three
scale = inf => line 3, object 1, scale: inf: expected a number
scale = [1, 1] => line 3, object 1, scale: [1, 1]: expected a number or three numbers
translate = 1 => line 3, object 1, translate: 1: expected three numbers
rotate_deg = [1, 2, nan] => line 3, object 1, rotate_deg: [1, 2, nan]: expected three numbers
matrix = 1 => line 3, object 1, matrix: 1: expected three rows of four numbers, or four rows of three
matrix = [1, 2, 3] => line 3, object 1, matrix: 1: expected four numbers, as three rows have
matrix = [[1,0,0],[0,1,0],↵[0,0,1]] => line 3, object 1, matrix: [1,0,0]: expected four numbers, as three rows have
matrix = [[1,0,0,0],[0,1,0,0],[0,0,0,0]] => line 3, object 1, matrix: it flattens the object; expected a matrix that can be inverted
matrix = [[1,0,0],[0,1,0],[0,0,1],[0,0,0]]↵scale = 1 => line 4, object 1, scale: has no meaning beside matrix; expected one or the other
splats = 0 => line 3, object 1, splats: 0: expected a whole number, 1 to 4294967295
splats = 1.5 => line 3, object 1, splats: 1.5: expected a whole number
splats = -1 => line 3, object 1, splats: -1: expected a whole number
splats = 99999999999999999999 => line 3, object 1, splats: 99999999999999999999: expected a whole
resample = 9 => line 3, object 1, resample: has no meaning for a built-in model; expected splats
triangles = 9 => line 3, object 1, triangles: has no meaning for a model drawn as splats; expected representation = "mesh" or "hybrid"
representation = "points" => line 3, object 1, representation: "points": expected 'auto', 'splats', 'mesh' or
representation = "Mesh" => line 3, object 1, representation: "Mesh": expected 'mesh'
polygons.longer_than = 1 => line 3, object 1, polygons: has no meaning without representation = "hybrid"
sample_edges = true => line 3, object 1, sample_edges: has no meaning without representation = "hybrid"
representation = "hybrid"↵polygons.longer_than = 1↵sample_edges = 1 => line 5, object 1, sample_edges: 1: expected true or false
representation = "mesh"↵splats = 9 => line 4, object 1, splats: has no meaning for a model drawn as triangles
representation = "hybrid"↵sample_edges = true => line 4, object 1, sample_edges: has no meaning for a hybrid without polygons, of which the view decides
representation = "hybrid"↵epsilon = 1 => line 4, object 1, epsilon: has no meaning for a hybrid without polygons, of which the view decides
representation = "hybrid"↵polygons = {} => line 4, object 1, polygons: expected plane or longer_than, and not both
representation = "hybrid"↵polygons = { plane = [0, 0, 0, 1] } => line 4, object 1, polygons, plane: [0, 0, 0, 1]: expected nx, ny, nz and d, the normal not zero
representation = "hybrid"↵polygons = { longer_than = -1 } => line 4, object 1, polygons, longer_than: -1: expected a length, at least 0
builtin = "spehre" => line 2, object 1, builtin: "spehre": expected 'sphere'
builtin = "relief"↵representation = "mesh" => line 3, object 1, representation: "mesh": expected 'splats': this built-in model has no triangles
name = "a file" => line 1, object 1: neither file nor builtin; expected one of them
file = "a.ply"↵builtin = "sphere" => line 2, object 1, file: beside builtin; expected one or the other
file = 1 => line 2, object 1, file: 1: expected the name of a file of a model
file = "a.ply"↵splats = 9 => line 3, object 1, splats: has no meaning for a file; expected resample, which spreads splats over a mesh
file = "a.ply"↵triangles = 9 => line 3, object 1, triangles: has no meaning for a file
file = "a.ply"↵seed = 9 => line 3, object 1, seed: has no meaning without resample
file = "a.ply"↵resample = 9↵seed = -9 => line 4, object 1, seed: -9: expected a whole number
file = "a.ply"↵resample = 4294967296 => line 3, object 1, resample: 4294967296: expected a whole number, 1 to 4294967295
file = "a.ply"↵representation = "mesh"↵resample = 9 => line 4, object 1, resample: has no meaning for a model drawn as triangles"#;
    for (keys, expected) in table(cases) {
        let error = object(&keys).unwrap_err();
        assert!(error.starts_with(&format!("scene.toml: {expected}")), "{error}");
    }
    assert!(read("object = 1").unwrap_err().contains("object: 1: expected tables, each headed [[object]]"));
}

/// Whatever stands there: it is read or refused, and never a panic.
#[test]
fn mutilated_scene_files_are_refused_or_read() {
    let text = include_str!("../../../../examples/spheres.toml");
    let place = Place::new();
    assert_eq!(place.read(text).unwrap().objects.len(), 27);
    // A short one, which is read 20 000 times in seconds.
    let text = "epsilon = \"1r\"\nbackground = [1, 0.5, 0]\n[camera]\neye = [0, 1.5, 4]\nup = \"z\"\n[[light]]\n\
        kind = \"eye\"\n[[object]]\nfile = \"a.ply\"\ncolor = [0.5, 1, 0]\nalpha = 0.25\n[[object]]\n\
        builtin = \"sphere\"\nrepresentation = \"mesh\"\ntriangles = 80\n";
    assert_eq!(place.read(text).unwrap().objects.len(), 2);
    let (path, options) = (place.path("scene/scene.toml"), LoadOptions::default());
    let try_one = |text: &str| {
        if let Err(error) = parse(&path, text, &options) {
            let said = error.to_string();
            assert!(error.exit_code() == 1 && !said.contains('\n'), "{said}");
        }
    };
    (0..text.len()).for_each(|end| try_one(&text[..end]));
    let mut random = crate::math::random::SplitMix(5);
    for _ in 0..20_000 {
        let mut bytes = text.as_bytes().to_vec();
        for _ in 0..1 + random.bits() % 3 {
            let at = random.bits() as usize % bytes.len();
            match random.bits() % 3 {
                0 => bytes.truncate(at.max(1)),
                1 => bytes[at] = b"[]{}=\"'\n.,#-19eE\0\xff"[random.bits() as usize % 18],
                _ => drop(bytes.drain(at..(at + 9).min(bytes.len()))),
            }
            if bytes.is_empty() {
                bytes.push(b'\n');
            }
        }
        if let Ok(text) = str::from_utf8(&bytes) {
            try_one(text);
        }
    }
}

#[test]
fn what_is_no_epsilon_background_or_shading() {
    let sphere = "[[object]]\nbuiltin = \"sphere\"\n";
    let epsilon = "expected \"auto\", multiples of a splat's radius, such as \"1r\", or a length, at least 0";
    for value in ["\"-1r\"", "\"0.1\"", "\"big\"", "-0.5", "[1]", "inf"] {
        let shown = if value == "[1]" { "[1]" } else { value };
        let error = read(&format!("epsilon = {value}\n{sphere}")).unwrap_err();
        assert_eq!(error, format!("scene.toml: line 1, epsilon: {shown}: {epsilon}"));
        let error = read(&format!("{sphere}epsilon = {value}\n")).unwrap_err();
        assert_eq!(error, format!("scene.toml: line 3, object 1, epsilon: {shown}: {epsilon}"));
    }
    for value in ["\"white\"", "[1, 1]", "[1, 1, 1.5]", "1"] {
        let error = read(&format!("background = {value}\n{sphere}")).unwrap_err();
        let expected = "expected red, green and blue from 0 to 1, or \"none\"";
        assert_eq!(error, format!("scene.toml: line 1, background: {value}: {expected}"));
    }
    let error = read(&format!("shading = \"albdo\"\n{sphere}")).unwrap_err();
    assert!(error.starts_with("scene.toml: line 1, shading: \"albdo\": expected 'albedo'"), "{error}");
    let error = read(&format!("{sphere}representation = \"mesh\"\nepsilon = 1\n")).unwrap_err();
    assert!(
        error.contains("line 4, object 1, epsilon: has no meaning for a model drawn as triangles"),
        "{error}"
    );
}
