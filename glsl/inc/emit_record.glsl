// Emits a point whose set-up is done (inc/point_record.glsl) with the pass's extra varyings.

// The same bits in both passes, as in emit.glsl.
#define VARYING invariant out
#include "inc/varyings.glsl"
#include "inc/point.glsl"
#define RECORDS_ACCESS readonly
#include "inc/point_record.glsl"

PointRecord load_record(uint index)
{
    vec4 a = records0[index];
    vec4 b = records1[index];
    vec4 c = records2[index];
    uvec4 d = records3[index];
    vec2 middle_px = 0.5 * vec2(d.z, d.w & ((1u << MIDDLE_BITS) - 1));
    return PointRecord(a.xyz, a.w, b.xyz, b.w, c.xyz, vec3(c.w, uintBitsToFloat(d.xy)), Square(middle_px, d.w >> MIDDLE_BITS));
}

void emit_record(PointRecord record, vec3 extra)
{
    bool is_drawn = record.square.side_px > 0.0;
    // Depth only has to be inside of the clip volume.
    gl_Position = is_drawn ? vec4(clip_middle(record.square), 0.5, 1.0) : NOWHERE;
    gl_PointSize = is_drawn ? point_size_px(record.square) : 1.0;
    x0_w_extra = vec4(record.x0_w, extra.x);
    per_x_extra = vec4(record.along_x, extra.y);
    per_y_extra = vec4(record.along_y, extra.z);
}
