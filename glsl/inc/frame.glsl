// What every splat pass is told of the frame, as push constants. The host's mirror is `FrameConstants` in
// src/passes/pipeline/constants.rs; the build compares the offsets.
//
// Local space: the world, moved by the chunk's f64 origin and scaled by a power of two so that most splats are within
// about 1. View space: eye at the origin, x right, y down, z forward, in a unit of which the eye's distance is about 1
// (another power of two for each chunk; near / z and pixels don't depend on it). Image plane: z = 1.

struct FrameConstants {
    vec4 view_from_local_x; // row of the rotation, then the translation, view unit
    vec4 view_from_local_y;
    vec4 view_from_local_z;
    vec2 size_px;
    float focal_px;         // image-plane unit in pixels
    float near;             // depth of the near plane, view unit
    float filter_radius;    // h = sqrt(2) pixels, image-plane unit
    float epsilon_radii;    // epsilon as a multiple of the splat's larger radius ...
    float epsilon_length;   // ... plus a length, view unit; one of the two is 0
    float point_cap_px;     // the largest point of the device
    float point_step_px;    // the step of point sizes
    uint splat_count;       // of this chunk
    uint chunk_color;       // twice the chunk's number in the frame's part; plus 1 where all its splats have color 0
    float view_from_local_scale; // what local lengths are multiplied by: a power of two
    float origin_from_eye[6]; // local origin seen from the eye, local axes, view unit: x, y, z in f32; what f32 left of each
    uint first_record;      // the number of the chunk's first splat among all of the frame's part (list.glsl: that are looked at)
    uint blocks_overlap;    // listed blocks of this chunk (list.glsl); in the upper half, 65535 over its overlap (edges.glsl)
};

layout(push_constant, std430) uniform Frame { FrameConstants frame; };

#define CHUNK (frame.chunk_color >> 1)
#define LISTED_BLOCKS (frame.blocks_overlap & 0xffff)
#define INVERSE_OVERLAP (float(frame.blocks_overlap >> 16) / 65535.0)
#define UNIFORM_COLOR ((frame.chunk_color & 1) != 0)
