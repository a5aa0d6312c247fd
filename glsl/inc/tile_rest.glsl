// The last layer of a tile's transparent splats: all that is left behind the surfaces.

layout(constant_id = 20) const bool STACKED = false; // it counts as several surfaces (layer.frag.glsl)
const float MOST_SURFACES = 8.0;                     // as there

// All that is left, for one layer: each splat lit by itself, at its center; weight * alpha * light, weight * alpha; weight.
void sum_rest(Range range, vec2 at_px, Peeled peeled, inout vec4 colors[ROWS], inout float weights[ROWS])
{
    Splat own;
    Look own_look;
    for (uint base = range.first; base < range.end; base += BATCH) {
        uint place = load(base, range, own);
        if (place == 0) {
            own_look = load_look(own);
            vec3 v = to_eye(own.x0_px);
            own_look.color = own_look.alpha * shaded(own_look.color, turned(own_look.normal, v), v);
            hand_on(own_look);
        }
        [[unroll]] for (uint k = 0; k < BATCH; k++) {
            Splat splat = handed(own, place + k);
            Look look = handed(own_look, place + k);
            Column column = column_of(splat, at_px);
            [[unroll]] for (int row = 0; row < ROWS; row++) {
                vec3 uvw = uvw_of(column, row);
                float depth = column.w0 * uvw.z;
                bool inside = is_inside(uvw) && is_beyond_near(depth) && depth >= peeled.opaque[row]
                    && depth < FORMULA_LESS(FORMULA_PEELED, peeled.depth[row]);
                float weight = weight_of(uvw, look.share, inside);
                colors[row] += weight * vec4(look.color, look.alpha);
                weights[row] += weight;
            }
        }
    }
}

void compose_rest(vec4 colors[ROWS], float weights[ROWS], inout Peeled peeled)
{
    [[unroll]] for (int row = 0; row < ROWS; row++) {
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
