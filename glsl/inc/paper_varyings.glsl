// What the paper's vertex programs hand over: the three columns of N, with a fourth row for the depth.

layout(location = 0) flat VARYING vec4 per_x;
layout(location = 1) flat VARYING vec4 per_y;
layout(location = 2) flat VARYING vec4 at_corner; // pixel (0, 0)
