//! The rule on shaders that were counted by hand: the count stands beside each line. They were written before any shader of
//! the renderer was counted.

use super::{Counts, count};

const VERTEX: &str = "layout(location = 0) in vec4 a; layout(location = 1) in vec4 b; layout(location = 2) in vec4 c;\n\
    layout(location = 0) out vec4 o; layout(location = 1) out vec4 p;\n";
const FRAGMENT: &str = "layout(location = 0) in vec4 a; layout(location = 1) in vec4 b; layout(location = 2) in vec4 c;\n\
    layout(location = 0) out vec4 o;\nlayout(set = 0, binding = 0) uniform sampler2D t;\n";

fn spirv(kind: shaderc::ShaderKind, text: &str) -> Vec<u32> {
    let compiler = shaderc::Compiler::new().unwrap();
    let mut options = shaderc::CompileOptions::new().unwrap();
    options.set_target_env(shaderc::TargetEnv::Vulkan, shaderc::EnvVersion::Vulkan1_3 as u32);
    options.set_target_spirv(shaderc::SpirvVersion::V1_6);
    options.set_optimization_level(shaderc::OptimizationLevel::Performance);
    let text = format!("#version 460\n{text}");
    compiler.compile_into_spirv(&text, kind, "fixture", "main", Some(&options)).unwrap().as_binary().to_vec()
}

fn vertex(body: &str) -> Counts {
    let text = format!("{VERTEX}void main() {{ p = vec4(0.0); {body} }}");
    count(&spirv(shaderc::ShaderKind::Vertex, &text), &[]).unwrap()
}

fn fragment(body: &str) -> Counts {
    let text = format!("{FRAGMENT}void main() {{ {body} }}");
    count(&spirv(shaderc::ShaderKind::Fragment, &text), &[]).unwrap()
}

/// The ARB instructions in words: `DP3 MAD*2`.
fn words(counts: &Counts) -> String {
    let word = |(name, count): (&&str, &u32)| match count {
        1 => (*name).to_owned(),
        count => format!("{name}*{count}"),
    };
    counts.mnemonics.iter().map(word).collect::<Vec<_>>().join(" ")
}

#[test]
fn each_line_has_the_count_that_was_made_by_hand() {
    // What it is, the ARB instructions, the scalar operations.
    let lines = [
        ("o = a;", "", 0),                        // a move
        ("o = a.wzyx;", "", 0),                   // a swizzle
        ("o = vec4(a.x, b.y, 1.0, 0.0);", "", 0), // write masks
        ("o = -a;", "", 0),                       // an operand is negated for nothing
        ("o = a + b;", "ADD", 4),
        ("o = a - b;", "SUB", 4),
        ("o = a * b;", "MUL", 4),
        ("o = a * b.x;", "MUL", 4),
        ("o = a * b + c;", "MAD", 8),
        ("o = c - a * b;", "MAD", 8),
        ("o = a * 2.0 + 1.0;", "MAD", 8),
        // Used twice. SPIRV-Tools before 2025 multiply twice unless the product is precise, later ones never.
        ("precise vec4 m = a * b; o = m + c; p = m;", "ADD MUL", 8),
        ("o = vec4(dot(a.xyz, b.xyz));", "DP3", 5),
        ("o = vec4(dot(a, b));", "DP4", 7),
        ("o = vec4(dot(a.xy, b.xy));", "DP3", 3),
        ("o = vec4(a.x * b.x + a.y * b.y + a.z * b.z);", "DP3", 5), // spelled out
        ("o = vec4(a.z * b.x + a.y * b.y + b.z * a.w + a.x * b.w);", "DP4", 7), // in any order
        ("o = vec4(a.x * b.x + a.y * c.y + a.z * b.z);", "MAD*2 MUL", 5), // of three registers
        ("o = vec4(cross(a.xyz, b.xyz), 0.0);", "XPD", 9),
        ("o = vec4(a.yzx * b.zxy - a.zxy * b.yzx, 0.0);", "XPD", 9), // spelled out
        ("o = vec4(a.zxy * b.yzx - a.yzx * b.zxy, 0.0);", "XPD", 9), // b x a
        ("o = vec4(a.yzx * b.zxy - a.zxy * c.yzx, 0.0);", "MAD MUL", 9), // not a product of two vectors
        ("o = vec4(1.0 / a.x);", "RCP", 1),
        ("o = vec4(a.x / b.x);", "MUL RCP", 1),
        ("o = a / b.x;", "MUL RCP", 4),
        ("o = a / b.x; p = c / b.x;", "MUL*2 RCP", 8), // the reciprocal is there already
        ("o = a / vec4(b.xy, 1.0, 1.0);", "MUL RCP*2", 4),
        ("o = a / 3.0;", "MUL", 4), // 1/3 is a constant
        ("o = a / b.x + c;", "MAD RCP", 8),
        ("o = vec4(sqrt(a.x));", "RCP RSQ", 1),
        ("o = vec4(inversesqrt(a.x));", "RSQ", 1),
        ("o = a / sqrt(b.x);", "MUL RSQ", 5),
        ("float r = sqrt(b.x); o = a / r; p = vec4(r);", "MUL RCP RSQ", 5),
        ("o = vec4(normalize(a.xyz), 0.0);", "DP3 MUL RSQ", 9),
        ("o = vec4(length(a.xyz));", "DP3 RCP RSQ", 6),
        ("o = vec4(length(a.xyz - b.xyz));", "DP3 RCP RSQ SUB", 9),
        ("o = abs(a);", "ABS", 4),
        ("o = min(a, b);", "MIN", 4),
        ("o = clamp(a, b, c);", "MAX MIN", 8),
        ("o = floor(a);", "FLR", 4),
        ("o = ceil(a);", "FLR", 4), // -floor(-a)
        ("o = fract(a);", "FRC", 4),
        ("o = vec4(exp2(a.x), log2(a.y), 0.0, 0.0);", "EX2 LG2", 2),
        ("o = vec4(pow(a.x, b.x));", "POW", 1),
        ("o = vec4(sin(a.xy), 0.0, 0.0);", "SIN*2", 2), // a scalar instruction
        ("o = mod(a, 2.0);", "FLR MAD MUL", 4),
        ("o = mod(a, b.x);", "FLR MAD MUL RCP", 4),
        ("o = a.x < b.x ? a : b;", "CMP SLT", 5),
        ("o = vec4(a.x >= b.x ? 1.0 : 0.0);", "CMP SGE", 2),
        ("o = vec4(float(int(floor(a.x)) + 1));", "ADD FLR", 4), // integers are floats there
        ("o = vec4(float(int(a.x)));", "FLR", 2),
        ("o = vec4(a.x < b.x && a.y < b.y ? 1.0 : 0.0);", "CMP*2 SLT*2", 4),
    ];
    let mut wrong = Vec::new();
    for (line, arb, scalar) in lines {
        let counts = vertex(line);
        if words(&counts) != arb || counts.scalar != scalar {
            wrong.push(format!("{line} {} {}, by hand {arb} {scalar}", words(&counts), counts.scalar));
        }
        assert_eq!(counts.arb, Some(counts.mnemonics.values().sum()), "{line}");
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn fragments_saturate_for_nothing_and_fetch_in_one() {
    let lines = [
        ("o = clamp(a + b, 0.0, 1.0);", "ADD", 12),
        ("o = clamp(a, 0.0, 2.0);", "MAX MIN", 8),
        ("o = mix(a, b, c);", "LRP", 12),
        ("o = texture(t, a.xy);", "TEX", 0),
        ("o = textureProj(t, a.xyw);", "TXP", 0),
        ("o = texture(t, a.xy) + texture(t, b.xy);", "ADD TEX*2", 4),
        ("o = texture(t, a.xy) + texture(t, a.xy);", "ADD TEX", 4), // the same twice
    ];
    for (line, arb, scalar) in lines {
        let counts = fragment(line);
        assert_eq!((words(&counts).as_str(), counts.scalar), (arb, scalar), "{line}");
    }
}

#[test]
fn what_the_paper_does_not_count_is_listed() {
    let counts = fragment("float w = texture(t, a.xy).r; if (w <= 0.0) discard; o = vec4(b.xyz, w);");
    assert_eq!(words(&counts), "TEX");
    let listed = counts.listed;
    assert_eq!((listed.kills, listed.alpha_tests, listed.moves, listed.stores), (1, 1, 1, 1));

    let attributes = "layout(set = 0, binding = 0, std430) readonly buffer V { vec4 v[]; };\n\
        layout(location = 0) out vec4 o;\n\
        void main() { o = v[2 * gl_VertexIndex] + v[2 * gl_VertexIndex + 1]; }";
    let counts = count(&spirv(shaderc::ShaderKind::Vertex, attributes), &[]).unwrap();
    assert_eq!(words(&counts), "ADD");
    assert_eq!((counts.listed.loads, counts.listed.addresses), (2, 2), "2 i and 2 i + 1");

    let texels = "#extension GL_EXT_samplerless_texture_functions : require\n\
        layout(set = 0, binding = 0) uniform textureBuffer t;\n\
        layout(set = 0, binding = 1) uniform texture2D image;\n\
        layout(location = 0) out vec4 o;\n\
        void main() { o = texelFetch(t, gl_VertexIndex) + texelFetch(image, ivec2(0), 0); }";
    let counts = count(&spirv(shaderc::ShaderKind::Vertex, texels), &[]).unwrap();
    assert_eq!(counts.listed.loads, 1, "images are no buffers");
}

#[test]
fn what_is_stored_behind_a_pointer_into_a_block_counts() {
    let counts = vertex("o = a; gl_Position = a * b; gl_PointSize = a.x + b.x;");
    assert_eq!(words(&counts), "ADD MUL");
}

#[test]
fn operations_on_bits_are_counted_and_listed() {
    let counts = vertex("o = vec4(uintBitsToFloat(floatBitsToUint(a.xyz) & 0xfffff000u), 0.0);");
    assert_eq!((words(&counts).as_str(), counts.listed.bit_operations), ("BIT", 1));
}

#[test]
fn a_branch_that_constants_decide_is_not_counted() {
    let text = format!(
        "{VERTEX}layout(constant_id = 3) const uint KIND = 0; layout(constant_id = 4) const float HALF = 0.5;\n\
        vec4 chosen() {{ switch (KIND) {{ case 1: return a / b.x; case 2: return vec4(dot(a, b)); }} return a * b; }}\n\
        void main() {{ vec4 v = chosen(); if (KIND == 2 && HALF > 0.25) {{ v += c; }} o = v; p = vec4(0.0); }}"
    );
    let spirv = spirv(shaderc::ShaderKind::Vertex, &text);
    let arb = |constants: &[(u32, u32)]| words(&count(&spirv, constants).unwrap());
    assert_eq!(arb(&[]), "MUL");
    assert_eq!(arb(&[(3, 1)]), "MUL RCP");
    assert_eq!(arb(&[(3, 2)]), "ADD DP4");
    assert_eq!(arb(&[(3, 2), (4, 0.25_f32.to_bits())]), "DP4");
}

#[test]
fn a_branch_that_is_left_counts_on_both_sides_and_selects() {
    let counts = vertex("vec4 v; if (a.x < 0.0) { v = a / b.x; } else { v = a * b + c; } o = v;");
    assert_eq!(words(&counts), "CMP MAD MUL RCP SLT");
    assert_eq!((counts.arb, counts.arb_longest_path), (Some(5), Some(4)), "SLT, RCP, MUL, CMP");
}

#[test]
fn what_no_output_depends_on_is_not_counted() {
    let counts =
        vertex("vec4 v = a / b; vec3 w = cross(a.xyz, b.xyz); if (w.x > 0.0) { v = c; } o = vec4(w.x);");
    assert_eq!(words(&counts), "XPD");
}

#[test]
fn a_loop_counts_once_and_is_listed() {
    let counts = vertex("vec4 v = a; for (int i = 0; i < int(b.x); i++) { v = v * c; } o = v;");
    assert_eq!(counts.listed.loops, 1);
    assert_eq!(counts.mnemonics.get("MUL"), Some(&1));
}

#[test]
fn one_more_fetch_a_fragment_is_one_more_instruction() {
    let before = fragment("o = texture(t, a.xy) * b;");
    let after = fragment("o = texture(t, a.xy) * b + texture(t, c.xy);");
    assert_eq!((before.arb, after.arb), (Some(2), Some(3)), "TEX MUL; TEX TEX MAD");
}

/// A struct of a buffer is copied to one that is laid out otherwise; in registers both are the same.
#[test]
fn copies_of_structs_cost_nothing() {
    let text = "struct S { vec3 a; float b; }; layout(set = 0, binding = 0, std140) uniform U { S of[4]; };\n\
        layout(location = 0) flat in int i; layout(location = 0) out vec4 o;\n\
        vec4 product(S s) { return vec4(s.a * s.b, 1.0); } void main() { o = product(of[i]); }";
    let module = spirv(shaderc::ShaderKind::Fragment, text);
    assert_eq!(count(&module, &[]).unwrap().scalar, 3);
}

#[test]
fn compute_shaders_have_no_paper_comparable_count() {
    let text = "layout(local_size_x = 1) in; layout(set = 0, binding = 0, std430) buffer B { float x; };\n\
        void main() { x = 2.0 * x + 1.0; }";
    let counts = count(&spirv(shaderc::ShaderKind::Compute, text), &[]).unwrap();
    assert_eq!((counts.arb, counts.scalar), (None, 2));
}

#[test]
fn what_can_not_be_counted_is_refused() {
    assert!(count(&[1, 2, 3], &[]).is_err());
    let determinant = "layout(location = 0) in mat4 m; layout(location = 0) out vec4 o;\n\
        void main() { o = vec4(determinant(m)); }";
    let refused = count(&spirv(shaderc::ShaderKind::Vertex, determinant), &[]).unwrap_err();
    assert_eq!(refused, "Determinant: not in the table of instructions");
}
