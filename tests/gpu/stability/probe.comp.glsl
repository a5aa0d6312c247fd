// What the renderer's own formulas give in f32, and the textbook's beside them, for one splat and some places of the
// image. Compiled by the test against the very files of glsl/inc.
//
// naive: the paper's N (x, y, 1) with the middle of the image as origin, and the box from the two roots of
// d x^2 - 2 b x + c = 0, as textbooks solve it.
#version 460
#include "inc/setup.glsl"
#include "inc/quad.glsl"

#define PLACES 16
layout(local_size_x = 1) in;

struct Question {
    vec4 world_p;        // the center in the chunk's view unit, found with world coordinates in f32
    vec4 places[PLACES]; // x, y: pixels from the top left corner of the image
};
struct Answer {
    vec4 state; // 1 if anything of the splat can be seen, 1 if it is regular
    vec4 box;   // lo, hi: pixels from the middle of the image
    vec4 naive_box;
    vec4 world_box;
    vec4 p;     // view unit, after the filter
    vec4 s;
    vec4 t;
    vec4 padding;
    vec4 point[PLACES]; // (u, v) as a point sprite's fragments find them; only for regular splats
    vec4 quad[PLACES];  // as a quad's
    vec4 naive[PLACES];
    vec4 world[PLACES];
};
layout(set = 1, binding = 0, std430) readonly buffer Questions { Question questions[]; };
layout(set = 1, binding = 1, std430) writeonly buffer Answers { Answer answers[]; };

// The passes that set splats up don't read splat_count, so that it can say which question is asked.
#define NUMBER frame.splat_count

vec2 uv_of(vec3 at_x0, vec3 along_x, vec3 along_y, vec2 d)
{
    vec3 uvw = at_x0 + (along_x * d.x + along_y * d.y);
    return uvw.xy / uvw.z;
}

vec4 textbook_box(vec3 p, vec3 s, vec3 t)
{
    float d = s.z * s.z + t.z * t.z - p.z * p.z;
    vec2 center = (s.xy * s.z + t.xy * t.z - p.xy * p.z) / d;
    vec2 half_size = sqrt(center * center - (s.xy * s.xy + t.xy * t.xy - p.xy * p.xy) / d);
    return vec4(center - half_size, center + half_size) * frame.focal_px;
}

void textbook_map(vec3 p, vec3 s, vec3 t, out vec3 constants, out vec3 per_px_x, out vec3 per_px_y)
{
    vec3 n0 = cross(t, p);
    vec3 n1 = cross(p, s);
    vec3 n2 = cross(s, t);
    float scale = frame.near / dot(n2, p);
    constants = scale * vec3(n0.z, n1.z, n2.z);
    per_px_x = scale / frame.focal_px * vec3(n0.x, n1.x, n2.x);
    per_px_y = scale / frame.focal_px * vec3(n0.y, n1.y, n2.y);
}

void main()
{
    Mapping m;
    answers[NUMBER].state = vec4(0.0);
    if (!map_splat(0, m)) {
        return;
    }
    Box box = splat_box(m);
    vec3 world_p = questions[NUMBER].world_p.xyz;
    answers[NUMBER].state = vec4(1.0, m.regular ? 1.0 : 0.0, 0.0, 0.0);
    answers[NUMBER].box = vec4(box.lo, box.hi) * frame.focal_px;
    answers[NUMBER].naive_box = textbook_box(m.p, m.s, m.t);
    answers[NUMBER].world_box = textbook_box(world_p, m.s, m.t);
    answers[NUMBER].p = vec4(m.p, 0.0);
    answers[NUMBER].s = vec4(m.s, 0.0);
    answers[NUMBER].t = vec4(m.t, 0.0);

    Quad quad;
    quad_of(m, 0, quad);
    ImageMap as_quad = quad_map(m, quad);
    ImageMap as_point = as_quad;
    if (m.regular) {
        as_point = regular_map(m);
    }
    vec2 middle_px = frame.middle_px;

    vec3 naive_constants;
    vec3 naive_x;
    vec3 naive_y;
    textbook_map(m.p, m.s, m.t, naive_constants, naive_x, naive_y);
    vec3 world_constants;
    vec3 world_x;
    vec3 world_y;
    textbook_map(world_p, m.s, m.t, world_constants, world_x, world_y);
    for (int i = 0; i < PLACES; i++) {
        vec2 at = questions[NUMBER].places[i].xy - middle_px;
        answers[NUMBER].point[i].xy = uv_of(as_point.at_x0, as_point.along_x, as_point.along_y, at - as_point.x0_px);
        answers[NUMBER].quad[i].xy = uv_of(as_quad.at_x0, as_quad.along_x, as_quad.along_y, at - as_quad.x0_px);
        answers[NUMBER].naive[i].xy = uv_of(naive_constants, naive_x, naive_y, at);
        answers[NUMBER].world[i].xy = uv_of(world_constants, world_x, world_y, at);
    }
}
