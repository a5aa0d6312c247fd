// Surfaces of a tile's transparent splats, from front to back: seen, summed, shaded, and put under the light so far.

const float INFINITELY_NEAR = 2.0; // nearer than any depth, which is 1 at most
const float NOTHING_LEFT = 0.0;    // no depth is below

// A column of pixels: what is found of it so far.
struct Peeled {
    vec4 light[TILE];   // alpha * linear color, alpha
    float depth[TILE];  // of the layer before
    float weight[TILE]; // of the layer before
    float opaque[TILE]; // the depth of opaque things
};

vec4 under(vec4 light, vec4 layer)
{
    return light + (1.0 - light.a) * layer;
}

vec3 to_eye(vec2 at_px)
{
    return -normalize(vec3(FORMULA(FORMULA_EYE_DIRECTION, at_px / push.focal_px), 1.0));
}

vec3 turned(vec3 normal, vec3 v)
{
    return dot(normal, v) < 0.0 ? -normal : normal;
}

// The nearest surface behind the layer before: its depth, shifted by epsilon.
void see(Range range, vec2 at_px, Peeled peeled, inout float visible[TILE])
{
    for (uint base = range.first; base < range.end; base += BATCH) {
        Batch batch = load_batch(base, range.end);
        [[unroll]] for (uint k = 0; k < BATCH; k++) {
            Column column = column_of(batch, k, at_px);
            float inverse_shift = handed(batch.r0.w, k);
            [[unroll]] for (int row = 0; row < TILE; row++) {
                vec3 uvw = uvw_of(column, row);
                float depth = column.w0 * uvw.z;
                bool inside = is_inside(uvw) && is_beyond_near(depth)
                    && depth < FORMULA_LESS(FORMULA_PEELED, peeled.depth[row]);
                visible[row] = inside ? max(visible[row], depth * inverse_shift) : visible[row];
            }
        }
    }
}

// What belongs to that surface: weighted color and weight, weighted normal and alpha.
void sum(Range range, vec2 at_px, Peeled peeled, float visible[TILE], inout vec4 colors[TILE], inout vec4 normals[TILE])
{
    for (uint base = range.first; base < range.end; base += BATCH) {
        Batch batch = load_batch(base, range.end);
        Look look = load_look(batch);
        [[unroll]] for (uint k = 0; k < BATCH; k++) {
            Column column = column_of(batch, k, at_px);
            vec4 color = vec4(handed(look.color, k), 1.0);
            vec4 normal = vec4(handed(look.normal, k), handed(look.alpha, k));
            float share = handed(look.share, k);
            [[unroll]] for (int row = 0; row < TILE; row++) {
                vec3 uvw = uvw_of(column, row);
                float depth = column.w0 * uvw.z;
                bool inside = is_inside(uvw) && is_beyond_near(depth) && depth >= visible[row]
                    && depth < FORMULA_LESS(FORMULA_PEELED, peeled.depth[row]);
                float weight = weight_of(uvw, share, inside);
                colors[row] += weight * color;
                normals[row] += weight * normal;
            }
        }
    }
}

// Shades that surface and puts it under the light so far.
void compose(vec2 at_px, float visible[TILE], vec4 colors[TILE], vec4 normals[TILE], inout Peeled peeled)
{
    [[unroll]] for (int row = 0; row < TILE; row++) {
        float weight = colors[row].w;
        bool covered = weight > 0.0;
        vec3 v = to_eye(at_px + vec2(0.0, float(row)));
        float length2 = dot(normals[row].xyz, normals[row].xyz);
        vec3 normal = length2 > 0.0 ? normals[row].xyz * inversesqrt(length2) : vec3(0.0, 0.0, -1.0);
        vec3 albedo = FORMULA(FORMULA_NORMALIZED_COLOR, colors[row].rgb / weight);
        float alpha = normals[row].w / weight;
        vec3 light = shaded(albedo, turned(normal, v), v);
        peeled.light[row] = covered ? under(peeled.light[row], vec4(alpha * light, alpha)) : peeled.light[row];
        peeled.depth[row] = covered ? visible[row] : NOTHING_LEFT;
        peeled.weight[row] = weight;
    }
}

// Whether anything may be behind what was peeled off the tile. All of its invocations load records for each other.
bool is_left(Peeled peeled)
{
    bool left = false;
    [[unroll]] for (int row = 0; row < TILE; row++) {
        left = left || peeled.depth[row] > NOTHING_LEFT;
    }
#if defined(DIRECT)
    return left;
#else
    return subgroupAny(left);
#endif
}
