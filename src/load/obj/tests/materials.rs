use std::fs;

use temp_dir::TempDir;

use super::*;

const MATERIALS: &str = "# two\nnewmtl red \nKd 1 0 0\nd 0.5\nnewmtl dark blue\n Kd 0 0 0.2\nmap_Kd sky.png\n\
    newmtl none\nKs 1 1 1\nnewmtl short\nKd 1 1\nnewmtl spectral\nKd spectral file.rfl\nnewmtl gray\nKd 0.2\n";

/// A model in the folder `in` of a folder with material files in it and beside it.
fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    let inside = folder.path().join("in");
    fs::create_dir_all(inside.join("below")).unwrap();
    fs::write(inside.join("a b.mtl"), MATERIALS).unwrap();
    fs::write(inside.join("below/c.mtl"), MATERIALS).unwrap();
    fs::write(folder.path().join("out.mtl"), MATERIALS).unwrap();
    folder
}

fn load_in(folder: &TempDir, text: &str, allow_outside: bool) -> (Vec<[f32; 4]>, Vec<[u32; 3]>, Vec<String>) {
    let options = LoadOptions { allow_outside, ..LoadOptions::default() };
    let loaded = load_with(&folder.path().join("in/a.obj"), text.as_bytes(), &options).unwrap();
    let Model::Mesh(mesh) = loaded.model else { panic!("no mesh") };
    let colors = (0..mesh.positions.len()).map(|i| mesh.colors.get(i).unwrap()).collect();
    (colors, mesh.triangles, loaded.notes.iter().map(ToString::to_string).collect())
}

const RED: [f32; 4] = [1.0, 0.0, 0.0, 1.0];

fn gray() -> [f32; 4] {
    Colors::unknown().get(0).unwrap()
}

#[test]
fn faces_have_their_materials_colors_and_share_vertices_of_one_color() {
    let text = format!(
        "mtllib a b.mtl\n{SQUARE}f 1 2 3\nusemtl red\nf 1 2 3\nusemtl dark blue\nf 1 3 4\nusemtl red\nf 1 3 4\n\
         usemtl none\nf 1 2 4\n"
    );
    let (colors, triangles, notes) = load_in(&folder(), &text, false);
    let blue = [0.0, 0.0, linear_from_srgb(0.2), 1.0];
    let [a, b] = [gray(), RED];
    assert_eq!(colors, [a, a, a, b, b, b, blue, blue, blue, b, a]);
    assert_eq!(triangles, [[0, 1, 2], [3, 4, 5], [6, 7, 8], [3, 5, 9], [0, 1, 10]]);
    assert_eq!(
        notes,
        [
            "1 textures of materials ignored",
            "1 transparencies of materials ignored",
            "2 colors of materials that are not red, green and blue ignored",
        ]
    );
}

#[test]
fn a_row_may_name_several_files_and_one_number_is_gray() {
    let text = format!("mtllib none.mtl below/c.mtl below/../below/c.mtl\n{SQUARE}usemtl gray\nf 1 2 3\n");
    let (colors, _, notes) = load_in(&folder(), &text, false);
    let gray = linear_from_srgb(0.2);
    assert_eq!(colors, [[gray, gray, gray, 1.0]; 3]);
    assert_eq!(notes[1], "1 material files that can't be read ignored");
}

#[test]
fn no_file_outside_of_the_folder_is_opened() {
    let folder = folder();
    let inside = folder.path().join("in");
    let absolute = folder.path().join("out.mtl").display().to_string();
    #[cfg(unix)]
    std::os::unix::fs::symlink(folder.path().join("out.mtl"), inside.join("link.mtl")).unwrap();
    let absolute_inside = inside.join("a b.mtl").display().to_string();
    let names = ["../out.mtl", "below/../../out.mtl", &absolute, &absolute_inside, "../no.mtl"];
    for name in names.into_iter().chain(cfg!(unix).then_some("link.mtl")) {
        let text = format!("mtllib {name}\n{SQUARE}v 0 0 9\nusemtl red\nf 1 2 3\n");
        let (colors, _, notes) = load_in(&folder, &text, false);
        assert_eq!(colors, [gray(); 3], "{name}");
        assert_eq!(notes[1], "1 uses of materials that no file describes ignored", "{name}");
        assert!(
            notes[2].ends_with(" material files outside of the model's folder ignored"),
            "{name}: {notes:?}"
        );
        if name != "../no.mtl" {
            let (colors, _, notes) = load_in(&folder, &text, true);
            assert_eq!((colors, notes.len()), (vec![RED; 3], 3), "{name}: {notes:?}");
        }
    }
}

#[test]
fn own_colors_of_vertices_win_and_materials_that_nobody_tells_are_noted() {
    let text = "mtllib a b.mtl\nv 0 0 0 0 0 1\nv 1 0 0 0 0 1\nv 0 1 0 0 0 1\nusemtl red\nf 1 2 3\nusemtl other\nf 1 2 3\n";
    let (colors, _, notes) = load_in(&folder(), text, false);
    assert_eq!(colors, [[0.0, 0.0, 1.0, 1.0]; 3]);
    assert_eq!(
        notes[..2],
        [
            "1 uses of materials that no file describes ignored",
            "1 faces' materials, whose vertices have colors, ignored",
        ]
    );
}

#[test]
fn many_and_long_material_files_are_not_all_read() {
    let folder = folder();
    fs::write(folder.path().join("in/long.mtl"), b"#\n".repeat((8 << 20) + 1)).unwrap();
    fs::create_dir(folder.path().join("in/folder.mtl")).unwrap();
    let rows = "mtllib none.mtl\n".repeat(100);
    let text = format!("mtllib long.mtl\nmtllib folder.mtl\nmtllib \n{rows}{SQUARE}f 1 2 3 4\n");
    let (_, _, notes) = load_in(&folder, &text, false);
    assert_eq!(notes, ["103 material files that can't be read ignored"]);
}
