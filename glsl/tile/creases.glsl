// Both sides of a ridge in one pixel, CREASES: each is summed and shaded by itself, for the mean of their normals would be that of neither, and
// shine; and each has the part of the pixel that its curves leave. Where sums are left to others (tile_accumulate.comp.glsl), the side that has more
// has next to all of the pixel (`priority`).
//
// Here is what has at least half of the pixel, beyond the ridge what has less. Where both have more than half, or less, as of curves that do not meet,
// and where three sides meet, those of one sum are told apart by their priority.

const bool CREASES = CLIPS && PEELS && !OF_LAYERS;

vec4 colors_beyond[ROWS];  // as `colors` and `normals`
vec4 normals_beyond[ROWS];
vec2 most_kept[ROWS];      // the largest part that is left, here and beyond

void begin_creases(int row)
{
    colors_beyond[row] = vec4(0.0);
    normals_beyond[row] = vec4(0.0);
    most_kept[row] = vec2(0.0);
}

// Planes that cut all that is seen have nothing on their other side.
bool is_beyond(Kept kept)
{
    return kept.toward < BY_PLANE && kept.part < 0.5;
}

void note_kept(bool beyond, float part, int row)
{
    most_kept[row] = max(most_kept[row], beyond ? vec2(0.0, part) : vec2(part, 0.0));
}

// What is seen beyond the ridge, of what is seen.
float share_beyond(int row)
{
    vec2 most = most_kept[row];
    return most.y > 0.0 ? FORMULA(FORMULA_CREASE, most.y / (most.x + most.y)) : 0.0;
}
