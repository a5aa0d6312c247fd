// Surfaces of a tile's transparent splats, from front to back: seen, summed, shaded, and put under the light so far.

const float INFINITELY_NEAR = 2.0; // nearer than any depth, which is 1 at most
const float NOTHING_LEFT = 0.0;    // no depth is below

// What is found of the invocation's pixels so far.
struct Peeled {
    vec4 light[ROWS];   // alpha * linear color, alpha
    float depth[ROWS];  // of the layer before
    float weight[ROWS]; // of the layer before
    float opaque[ROWS]; // the depth of opaque things
};

vec4 under(vec4 light, vec4 layer)
{
    return light + (1.0 - light.a) * layer;
}

vec3 turned(vec3 normal, vec3 v)
{
    return dot(normal, v) < 0.0 ? -normal : normal;
}

// The nearest surface behind the layer before: its depth, shifted by epsilon.
void see(Range range, vec2 at_px, Peeled peeled, inout float visible[ROWS])
{
    Splat own;
    for (uint base = range.first; base < range.end; base += BATCH) {
        uint place = load(base, range, own);
        [[unroll]] for (uint k = 0; k < BATCH; k++) {
            Splat splat = handed(own, place + k);
            Column column = column_of(splat, at_px);
            [[unroll]] for (int row = 0; row < ROWS; row++) {
                vec3 uvw = uvw_of(column, row);
                float depth = column.w0 * uvw.z;
                bool inside = is_inside(uvw) && is_beyond_near(depth)
                    && depth < FORMULA_LESS(FORMULA_PEELED, peeled.depth[row]);
                visible[row] = inside ? max(visible[row], depth * splat.inverse_shift) : visible[row];
            }
        }
    }
}

// What belongs to that surface: weighted color and weight, weighted normal and alpha.
void sum(Range range, vec2 at_px, Peeled peeled, float visible[ROWS], inout vec4 colors[ROWS], inout vec4 normals[ROWS])
{
    Splat own;
    Look own_look;
    for (uint base = range.first; base < range.end; base += BATCH) {
        uint place = load(base, range, own, own_look);
        [[unroll]] for (uint k = 0; k < BATCH; k++) {
            Splat splat = handed(own, place + k);
            Look look = handed(own_look, place + k);
            Column column = column_of(splat, at_px);
            [[unroll]] for (int row = 0; row < ROWS; row++) {
                vec3 uvw = uvw_of(column, row);
                float depth = column.w0 * uvw.z;
                bool inside = is_inside(uvw) && is_beyond_near(depth) && depth >= visible[row]
                    && depth < FORMULA_LESS(FORMULA_PEELED, peeled.depth[row]);
                float weight = weight_of(uvw, look.share, inside);
                colors[row] += weight * vec4(look.color, 1.0);
                normals[row] += weight * vec4(look.normal, look.alpha);
            }
        }
    }
}

// Shades that surface and puts it under the light so far.
void compose(vec2 at_px, float visible[ROWS], vec4 colors[ROWS], vec4 normals[ROWS], inout Peeled peeled)
{
    [[unroll]] for (int row = 0; row < ROWS; row++) {
        float weight = colors[row].w;
        bool covered = weight > 0.0;
        vec3 v = to_eye(at_px + vec2(0.0, float(FIRST_ROW + row)));
        vec3 normal = normal_of_sum(normals[row].xyz);
        vec3 albedo = FORMULA(FORMULA_NORMALIZED_COLOR, colors[row].rgb / weight);
        float alpha = normals[row].w / weight;
        vec3 light = shaded(albedo, turned(normal, v), v);
        peeled.light[row] = covered ? under(peeled.light[row], vec4(alpha * light, alpha)) : peeled.light[row];
        peeled.depth[row] = covered ? visible[row] : NOTHING_LEFT;
        peeled.weight[row] = weight;
    }
}

#if defined(PIXELS)
shared uint left_of_tile;
#endif

// Whether anything may be behind what was peeled off the tile. All of its invocations load records for each other.
bool is_left(Peeled peeled)
{
    bool left = false;
    [[unroll]] for (int row = 0; row < ROWS; row++) {
        left = left || peeled.depth[row] > NOTHING_LEFT;
    }
#if defined(PIXELS)
    barrier(); // it was read
    if (gl_LocalInvocationIndex == 0) {
        left_of_tile = 0;
    }
    barrier();
    if (left) {
        atomicOr(left_of_tile, 1u);
    }
    barrier();
    return left_of_tile != 0;
#else
    return subgroupAny(left);
#endif
}
