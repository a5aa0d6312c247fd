// What the vertex programs of inc/botsch.glsl hand over.

layout(location = 0) flat VARYING vec3 center; // view space
layout(location = 1) flat VARYING vec3 plane;  // n / (n . p)
layout(location = 2) flat VARYING vec3 u_axis; // s / s.s
layout(location = 3) flat VARYING vec3 v_axis; // t / t.t
