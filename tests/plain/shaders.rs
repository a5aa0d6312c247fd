//! The shader build: its product, its error messages, and its check of the structs that host and shaders share.

use std::{
    fs, io,
    path::Path,
    process::{Command, Stdio},
};

use crate::shader_build::{HostStruct, build, files_and_folders};
use surfel::shaders;

const COMPUTE: &str =
    "#version 460\n#extension GL_GOOGLE_include_directive : require\nlayout(local_size_x = 64) in;\n";

/// A folder of shaders with these files.
fn folder(files: &[(&str, &str)]) -> temp_dir::TempDir {
    let folder = temp_dir::TempDir::new().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    folder
}

/// What the build says about a folder with these files, which must fail.
fn errors(files: &[(&str, &str)], host_structs: &[HostStruct]) -> String {
    let folder = folder(files);
    let errors =
        build(folder.path(), host_structs, &[]).expect_err("the build accepts a faulty shader").join("\n");
    errors.replace(&folder.path().display().to_string(), "glsl")
}

#[test]
fn every_shader_of_the_crate_is_valid_for_vulkan_1_3() {
    assert!(!shaders::ALL.is_empty());
    assert!(shaders::ALL.is_sorted_by(|a, b| a.name < b.name));
    let in_folder = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("glsl")).unwrap();
    let glsl_files =
        in_folder.filter(|e| e.as_ref().unwrap().path().extension().is_some_and(|x| x == "glsl"));
    // A file gives one shader, or one for each of its permutations.
    assert!(shaders::ALL.len() > glsl_files.count());
    let folder = folder(&[]);
    for shader in shaders::ALL {
        let bytes: Vec<u8> = shader.spirv().iter().flat_map(|word| word.to_le_bytes()).collect();
        let path = folder.path().join(shader.name);
        fs::write(&path, bytes).unwrap();
        match Command::new("spirv-val").args(["--target-env", "vulkan1.3"]).arg(&path).output() {
            Ok(output) => {
                let said = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
                assert!(output.status.success(), "{}: {said}", shader.name);
            }
            Err(e) if e.kind() == io::ErrorKind::NotFound && std::env::var_os("CI").is_none() => {
                eprintln!("NOT CHECKED: spirv-val is not installed (package spirv-tools)");
                return;
            }
            Err(e) => panic!("spirv-val does not run: {e}"),
        }
    }
}

#[test]
fn an_error_names_file_and_line_and_every_faulty_shader_is_named() {
    let broken = format!("{COMPUTE}void main() {{ x = 1; }}\n");
    let said = errors(&[("a.comp.glsl", &broken), ("b.comp.glsl", &broken)], &[]);
    assert!(said.contains("glsl/a.comp.glsl:4: error: 'x' : undeclared identifier"), "{said}");
    assert!(said.contains("glsl/b.comp.glsl:4: error: 'x' : undeclared identifier"), "{said}");
    assert!(said.find("a.comp") < said.find("b.comp"), "{said}");
}

#[test]
fn of_permutations_that_fail_the_first_speaks() {
    let text = |condition: &str| {
        format!(
            "{COMPUTE}// Permutations: a b c\nvoid main() {{\n#if {condition}\n#error wrong\n#endif\n}}\n"
        )
    };
    for condition in ["1", "defined(B) || defined(C)", "defined(C)"] {
        let said = errors(&[("a.comp.glsl", &text(condition))], &[]);
        assert_eq!(said.matches("'#error'").count(), 1, "{condition}: {said}");
    }
}

#[test]
fn an_error_in_an_include_names_the_include() {
    let including = format!("{COMPUTE}#include \"inc/maths.glsl\"\nvoid main() {{}}\n");
    let said = errors(&[("a.comp.glsl", &including), ("inc/maths.glsl", "\nfloat f() { return y; }\n")], &[]);
    assert!(said.contains("glsl/inc/maths.glsl:2: error: 'y' : undeclared identifier"), "{said}");
}

#[test]
fn an_include_that_is_missing_outside_or_circular_is_an_error() {
    let including = |name: &str| format!("{COMPUTE}#include \"{name}\"\nvoid main() {{}}\n");
    let said = errors(&[("a.comp.glsl", &including("inc/none.glsl"))], &[]);
    assert!(
        said.contains("glsl/a.comp.glsl:4: error:") && said.contains("inc/none.glsl: cannot read"),
        "{said}"
    );
    let said = errors(&[("a.comp.glsl", &including("../none.glsl"))], &[]);
    assert!(said.contains("glsl/a.comp.glsl:4: error:") && said.contains("without `..`"), "{said}");
    let said = errors(
        &[("a.comp.glsl", &including("inc/a.glsl")), ("inc/a.glsl", "#include \"inc/a.glsl\"\n")],
        &[],
    );
    assert!(said.contains("glsl/inc/a.glsl:1: error:") && said.contains("a circle?"), "{said}");
}

#[test]
fn a_line_of_permutations_gives_a_shader_for_each_choice() {
    let text = format!(
        "{COMPUTE}// Permutations: a b | _ c\n// Permutations: d\nvoid main() {{\n#if defined(D)\n#error d\n#endif\n}}\n"
    );
    assert!(errors(&[("x.comp.glsl", &text)], &[]).contains("'#error' : d"));
    let text = text.replace("#error d", "");
    let folder = folder(&[("x.comp.glsl", &text)]);
    let rust = build(folder.path(), &[], &[]).unwrap().rust;
    let names: Vec<_> = rust.lines().filter_map(|line| line.strip_prefix("/// The shader ")).collect();
    assert_eq!(names, ["`x_a.comp`.", "`x_a_c.comp`.", "`x_b.comp`.", "`x_b_c.comp`.", "`x_d.comp`."]);
}

#[test]
fn shared_numbers_become_constants_and_what_is_none_is_an_error() {
    let shader = format!("{COMPUTE}#include \"inc/config.glsl\"\nvoid main() {{}}\n");
    let with = |config: &str| [("a.comp.glsl", shader.clone()), ("inc/config.glsl", config.to_owned())];
    let files = with("#define SIDE 8 // Pixels.\n#define RADIUS 1.5 // Pixels, too.\n");
    let folder = folder(&files.each_ref().map(|(name, text)| (*name, text.as_str())));
    let rust = build(folder.path(), &[], &[]).unwrap().rust;
    assert!(rust.contains("/// Pixels.\n    pub const SIDE: u32 = 8;"), "{rust}");
    assert!(rust.contains("pub const RADIUS: f32 = 1.5;"), "{rust}");
    for wrong in ["#define SIDE 8\n", "#define SIDE EIGHT // Pixels.\n"] {
        let files = with(wrong);
        let said = errors(&files.each_ref().map(|(name, text)| (*name, text.as_str())), &[]);
        assert!(said.contains("inc/config.glsl:1: error: expected"), "{said}");
    }
}

#[test]
fn a_warning_is_an_error() {
    // To enable what the compiler does not know is the warning that needs the least text; `require` is an error.
    let warned = format!("{COMPUTE}#extension GL_unheard_of : enable\nvoid main() {{}}\n");
    let said = errors(&[("a.comp.glsl", &warned)], &[]);
    assert!(said.contains("glsl/a.comp.glsl:4: error:") && said.contains("GL_unheard_of"), "{said}");
}

#[test]
fn a_file_that_is_named_unlike_a_shader_is_an_error() {
    for name in ["a.glsl", "A.comp.glsl", "a.geom.glsl", "notes.txt"] {
        let said = errors(&[(name, "void main() {}")], &[]);
        assert!(said.contains(&format!("glsl/{name}: error: a shader is named")), "{said}");
    }
}

#[test]
fn every_file_is_watched() {
    let folder = folder(&[("a.comp.glsl", ""), ("inc/b.glsl", "")]);
    let found = files_and_folders(folder.path()).unwrap();
    for name in ["", "a.comp.glsl", "inc", "inc/b.glsl"] {
        assert!(found.contains(&folder.path().join(name)), "{name}");
    }
}

/// A block of each layout; the offsets below are worked out by hand from the rules of GLSL 4.60, section 7.6.2.2.
const LAYOUTS: &str = "
struct Inner { vec3 direction; float length; };
layout(set = 0, binding = 0, std140) uniform Uniforms {
    mat4 projection;   // 0
    vec3 eye;          // 64
    float near;        // 76
    float weights[3];  // 80, stride 16 in std140
    vec2 size;         // 128
    Inner inner;       // 144: structs are aligned to 16
} uniforms;            // ends at 160
layout(push_constant, std430) uniform Push {
    float weights[3];  // 0, stride 4 in std430
    vec2 size;         // 16
    mat3 basis;        // 32, columns 16 apart; ends at 76, the last column without its padding
} push;
struct Item { vec3 center; float radius; vec2 extent; }; // 24 bytes, 32 with padding
layout(set = 0, binding = 1, std430) buffer Items { Item items[]; };
void main() {
    Item local = items[0];
    local.radius += uniforms.near + push.size.x;
    items[0] = local;
}
";

#[test]
fn offsets_and_sizes_are_those_of_the_glsl_rules() {
    let folder = folder(&[("a.comp.glsl", &format!("{COMPUTE}{LAYOUTS}"))]);
    let host_structs = [("Uniforms", "m::U"), ("Push", "m::P"), ("Item", "m::I"), ("Inner", "m::Inner")];
    let rust = build(folder.path(), &host_structs, &[]).unwrap().rust;
    let expected = [
        "offset_of!(m::U, projection) == 0,",
        "offset_of!(m::U, eye) == 64,",
        "offset_of!(m::U, near) == 76,",
        "offset_of!(m::U, weights) == 80,",
        "offset_of!(m::U, size) == 128,",
        "offset_of!(m::U, inner) == 144,",
        "size_of::<m::U>() >= 160 && ::core::mem::size_of::<m::U>() <= 160,",
        "offset_of!(m::P, weights) == 0,",
        "offset_of!(m::P, size) == 16,",
        "offset_of!(m::P, basis) == 32,",
        "size_of::<m::P>() >= 76 && ::core::mem::size_of::<m::P>() <= 80,",
        "offset_of!(m::I, center) == 0,",
        "offset_of!(m::I, radius) == 12,",
        "offset_of!(m::I, extent) == 16,",
        "size_of::<m::I>() == 32,",
        "offset_of!(m::Inner, direction) == 0,",
        "offset_of!(m::Inner, length) == 12,",
        "size_of::<m::Inner>() >= 16 && ::core::mem::size_of::<m::Inner>() <= 16,",
    ];
    for text in expected {
        assert!(rust.contains(text), "`{text}` is not in\n{rust}");
    }
    assert_eq!(rust.matches("assert!").count(), expected.len(), "{rust}");
}

#[test]
fn two_shaders_that_disagree_about_a_struct_are_an_error() {
    let shader = |members: &str| {
        format!("{COMPUTE}layout(push_constant) uniform Push {{ {members} }} push;\nvoid main() {{}}\n")
    };
    let files = [("a.comp.glsl", shader("float x; float y;")), ("b.comp.glsl", shader("float y; float x;"))];
    let files = files.each_ref().map(|(name, text)| (*name, text.as_str()));
    let said = errors(&files, &[("Push", "m::P")]);
    assert!(said.contains("struct `Push` differs between a.comp and b.comp"), "{said}");
    // A struct that the host does not share may differ.
    assert!(build(folder(&files).path(), &[], &[]).is_ok());
}

#[test]
fn a_shared_struct_that_no_shader_has_is_an_error() {
    let said = errors(&[("a.comp.glsl", &format!("{COMPUTE}void main() {{}}\n"))], &[("Push", "m::P")]);
    assert!(said.contains("no shader has a struct `Push`"), "{said}");
}

#[test]
fn a_host_struct_that_differs_does_not_compile_and_the_member_is_named() {
    let shader = format!(
        "{COMPUTE}layout(push_constant) uniform Push {{ vec2 size; float near; }} push;\nvoid main() {{}}\n"
    );
    let folder = folder(&[("a.comp.glsl", &shader)]);
    let generated = build(folder.path(), &[("Push", "crate::Push")], &[]).unwrap().rust;
    // Only the checks are of interest here.
    let generated = &generated[generated.find("const _").unwrap()..];
    let compile = |members: &str| {
        let rust = format!(
            "pub struct Shader {{ pub name: &'static str, pub spirv: &'static [u32] }}\n\
             #[repr(C)] pub struct Push {{ {members} }}\n{generated}"
        );
        let path = folder.path().join("generated.rs");
        fs::write(&path, rust).unwrap();
        let output = Command::new(std::env::var_os("RUSTC").unwrap_or("rustc".into()))
            .args(["--edition=2024", "--crate-type=lib", "--emit=metadata", "--out-dir"])
            .args([folder.path(), path.as_path()])
            .stdin(Stdio::null())
            .output()
            .unwrap();
        (output.status.success(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let (compiles, said) = compile("pub size: [f32; 2], pub near: f32");
    assert!(compiles, "{said}");
    for (members, message) in [
        ("pub near: f32, pub size: [f32; 2]", "Push.near is at byte 8 in a.comp"),
        ("pub size: [f32; 2]", "no field `near`"),
        ("pub size: [f32; 2], pub near: f32, pub more: [f32; 2]", "Push has 12 bytes in a.comp"),
    ] {
        let (compiles, said) = compile(members);
        assert!(!compiles && said.contains(message), "{members}: {said}");
    }
}

/// The constants that a shader's pipelines may specialize (SPIR-V 1.6: opcode 71, decoration 1).
fn specialization_ids(spirv: &[u32]) -> Vec<u32> {
    let mut ids = Vec::new();
    let mut rest = &spirv[5..];
    while let Some(first) = rest.first() {
        let (instruction, next) = rest.split_at((first >> 16) as usize);
        if let [first, _, 1, id] = instruction
            && first & 0xffff == 71
        {
            ids.push(*id);
        }
        rest = next;
    }
    ids
}

#[test]
fn shaders_can_be_falsified_only_where_that_is_asked_for() {
    const LEVER: u32 = 31;
    let ids: Vec<_> = shaders::ALL.iter().map(|shader| specialization_ids(shader.spirv())).collect();
    assert!(ids.iter().any(|ids| !ids.is_empty()), "the search finds nothing");
    let falsifiable = ids.iter().filter(|ids| ids.contains(&LEVER)).count();
    assert_eq!(falsifiable > 5, cfg!(feature = "test-formulas"), "{falsifiable}");
    assert!(falsifiable == 0 || cfg!(feature = "test-formulas"), "{falsifiable}");
}
