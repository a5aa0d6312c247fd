// The last layer of a tile's transparent splats: all that is left behind the surfaces.

layout(constant_id = 20) const bool STACKED = false; // it counts as several surfaces (layer.frag.glsl)
const float MOST_SURFACES = 8.0;                     // as there

// All that is left, for one layer: each splat lit by itself, at its center; weight * alpha * light, weight * alpha; weight.
void sum_rest(Range range, vec2 at_px, Peeled peeled, inout vec4 colors[TILE], inout float weights[TILE])
{
    for (uint base = range.first; base < range.end; base += BATCH) {
        Batch batch = load_batch(base, range.end);
        Look look = load_look(batch);
        vec3 v = to_eye(batch.r0.xy);
        vec3 lit = look.alpha * shaded(look.color, turned(look.normal, v), v);
        [[unroll]] for (uint k = 0; k < BATCH; k++) {
            Column column = column_of(batch, k, at_px);
            vec4 color = vec4(handed(lit, k), handed(look.alpha, k));
            float share = handed(look.share, k);
            [[unroll]] for (int row = 0; row < TILE; row++) {
                vec3 uvw = uvw_of(column, row);
                float depth = column.w0 * uvw.z;
                bool inside = is_inside(uvw) && is_beyond_near(depth) && depth >= peeled.opaque[row]
                    && depth < FORMULA_LESS(FORMULA_PEELED, peeled.depth[row]);
                float weight = weight_of(uvw, share, inside);
                colors[row] += weight * color;
                weights[row] += weight;
            }
        }
    }
}

void compose_rest(vec4 colors[TILE], float weights[TILE], inout Peeled peeled)
{
    [[unroll]] for (int row = 0; row < TILE; row++) {
        bool covered = colors[row].a > 0.0 && weights[row] > 0.0;
        float alpha = min(colors[row].a / weights[row], 1.0);
        if (STACKED) {
            float surfaces = clamp(weights[row] / max(peeled.weight[row], 1.0), 1.0, MOST_SURFACES);
            alpha = 1.0 - pow(1.0 - alpha, FORMULA(FORMULA_STACKED, surfaces));
        }
        vec4 layer = vec4(alpha * (colors[row].rgb / colors[row].a), alpha);
        peeled.light[row] = covered ? under(peeled.light[row], layer) : peeled.light[row];
    }
}
