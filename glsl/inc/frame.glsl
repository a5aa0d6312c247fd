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
    vec2 middle_px;         // where the view's axis meets the image: its middle, unless the camera is off-center
    float focal_px;         // image-plane unit in pixels
    float near;             // depth of the near plane, view unit; ORTHOGRAPHIC: where w is 0 (projection.glsl)
    float filter_radius;    // h = sqrt(2) pixels, image-plane unit
    float epsilon_radii;    // epsilon as a multiple of the splat's larger radius ...
    float epsilon_length;   // ... plus a length, view unit; one of the two is 0
    uint size_less_1_px;    // the image's: width - 1, and height - 1 in the upper half
    uint corner_px;         // the image's, in the whole picture: whole pixels to the right, and down in the upper half
    uint splat_count;       // of this chunk
    uint chunk_color;       // twice the chunk's number in the frame's part; plus 1 where all its splats have color 0
    float view_from_local_scale; // what local lengths are multiplied by: a power of two
    float origin_from_eye[6]; // local origin seen from the eye, local axes, view unit: x, y, z in f32; what f32 left of each
    uint first_record;      // the number of the chunk's first splat among all of the frame's part (list.glsl: that are looked at)
    uint blocks_overlap;    // listed blocks of this chunk (list.glsl); upper half: what inverse overlaps are multiplied by (edges.glsl)
};

layout(push_constant, std430) uniform Frame { FrameConstants frame; };

#define SIZE_PX (vec2(frame.size_less_1_px & 0xffffu, frame.size_less_1_px >> 16) + 1.0)

// The image's corner in the whole picture of which it is a part; (0, 0) of a whole one.
#define CORNER_PX vec2(frame.corner_px & 0xffffu, frame.corner_px >> 16)

// What z is multiplied by in clip space: 0, unless the camera is off-center.
vec2 clip_from_axis()
{
    return 2.0 * frame.middle_px / SIZE_PX - 1.0;
}

#ifndef CHUNK
#define CHUNK (frame.chunk_color >> 1)
#endif
#define LISTED_BLOCKS (frame.blocks_overlap & 0xffff)
#define UNIFORM_COLOR ((frame.chunk_color & 1) != 0)

// One over an overlap, in steps of 2^-14.
float inverse_overlap(uint in_upper_half)
{
    return float(in_upper_half >> 16) / 16384.0;
}
