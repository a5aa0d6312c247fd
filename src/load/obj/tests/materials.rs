use std::fs;

use temp_dir::TempDir;

use super::*;
use crate::load::{
    mutate::Dice,
    obj::materials::{Material, Materials},
};

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
            "1 texture of materials ignored",
            "1 transparency of materials ignored",
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
    assert_eq!(notes[1], "1 material file that can't be read ignored");
    // The file that has two names is read once.
    assert_eq!(notes[2], "2 colors of materials that are not red, green and blue ignored");
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
        assert_eq!(notes[1], "1 use of materials that no file describes ignored", "{name}");
        assert!(
            notes[2].ends_with(" outside of the model's folder (--allow-outside reads them) ignored"),
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
            "1 use of materials that no file describes ignored",
            "1 face's material, whose vertices have colors, ignored",
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

/// The materials of a file and its strange colors; `None` where it is refused.
fn materials(bytes: &[u8]) -> Option<Materials> {
    let input = Input {
        path: Path::new("a.mtl"),
        folder: None,
        bytes,
        options: &LoadOptions::default(),
        progress: &(),
    };
    let mut materials = Materials::default();
    materials.read_bytes(&input).ok().map(|()| materials)
}

#[test]
fn one_faulty_row_spoils_no_other_one() {
    let text = "Kd 1 1 1\nnewmtl\nKd 1 0 0\nnewmtl a\nKd 1 0 0\nKd 1 1\nKd\nKd 1 x 1\nKd 1 1 nan\nKd 1 1 1 1\n\
        Kd 1\u{a0}1 1 1\nKa 1 1\nKs x\nNs\nillum -\nd\nd -halo 1\nTr x\nmap_Kd\nmap_Ka\nbump\n\
        newmtl b\nKd 1e300 -1 0\nmap_Kd x\nTr 0.5\nnewmtl c\nd 0.9\nnewmtl d\nd 1\nTr 0\nnewmtl\nKd 0 1 0\n";
    let found = materials(text.as_bytes()).unwrap();
    let red = Some([1.0, 0.0, 0.0, 1.0]);
    let material = |color, has_texture, is_transparent| Some(Material { color, has_texture, is_transparent });
    assert_eq!(found.get("a").cloned(), material(red, false, false));
    assert_eq!(found.get("b").cloned(), material(red, true, true));
    assert_eq!(found.get("c").cloned(), material(None, false, true));
    assert_eq!(found.get("d").cloned(), material(None, false, false));
    assert_eq!((found.get(""), found.strange_colors), (None, 6));
}

#[test]
fn all_materials_of_many_blocks_are_read() {
    let text: String = (0..20_000).map(|i| format!("newmtl {i}\nKd {} 0 0\n", i % 2)).collect();
    let found = materials(text.as_bytes()).unwrap();
    for i in 0..20_000 {
        let color = Some([(i % 2) as f32, 0.0, 0.0, 1.0]);
        assert_eq!(found.get(&i.to_string()).map(|material| material.color), Some(color), "{i}");
    }
}

#[test]
fn only_what_is_no_text_is_refused_whatever_the_bytes() {
    let words = ["newmtl", "Kd", "map_Kd", "d", "Tr", "nan", "1e999", "-1", "\\\n", "#", "\u{a0}", "\r"];
    let mut dice = Dice::new(0x371);
    for _ in 0..20_000 {
        let mut bytes = MATERIALS.as_bytes().to_vec();
        for _ in 0..=dice.below(4) {
            dice.mutate(&mut bytes, &words);
        }
        let is_text = str::from_utf8(&bytes).is_ok();
        assert!(materials(&bytes).is_some() || !is_text, "{}", bytes.escape_ascii());
    }
}
