#include "check.h"

enum { COUNT = 2000 };

/* A ball, and eight nodes of another color that stand for its octants. */
void levels(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer) {
    enum { NODES = 8 };
    static double centers[3 * COUNT];
    static float normals[3 * COUNT], radii[COUNT];
    static uint32_t parents[COUNT];
    engine_ball(COUNT, centers, normals, radii);
    for (int i = 0; i < COUNT; i++) parents[i] = (centers[3 * i] > 0) + 2 * (centers[3 * i + 1] > 0) + 4 * (centers[3 * i + 2] > 0);
    double nodes_at[3 * NODES];
    float s[3 * NODES], t[3 * NODES];
    uint32_t above[NODES];
    SurfelErrorBall balls[NODES];
    for (int i = 0; i < NODES; i++) {
        const float x = i & 1 ? 1 : -1, y = i & 2 ? 1 : -1, z = i & 4 ? 1 : -1, outward = x * y * z;
        /* Across the diagonal of its octant, so that s x t points outward. */
        const float along[] = {x, -y, 0}, across[] = {x * 0.577f, y * 0.577f, z * -1.155f};
        for (int axis = 0; axis < 3; axis++) {
            const float sign = axis == 0 ? x : axis == 1 ? y : z;
            nodes_at[3 * i + axis] = 0.5 * sign;
            balls[i].center[axis] = 0.5f * sign;
            s[3 * i + axis] = 0.6f * along[axis] * (outward > 0 ? -1.0f : 1.0f);
            t[3 * i + axis] = 0.6f * across[axis];
        }
        balls[i].radius = 1.5f, balls[i].spread = 0.5f, above[i] = UINT32_MAX;
    }
    const float blue[] = {0, 0, 1, 1}, red[] = {1, 0, 0, 1};
    const SurfelSplats splats = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof splats, .count = COUNT, .centers = centers,
                                 .normals = normals, .radii = radii, .colors = blue, .colorCount = 1};
    SurfelSplats nodes = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof nodes, .count = NODES, .centers = nodes_at,
                          .tangentsS = s, .tangentsT = t, .colors = red, .colorCount = 1};
    const SurfelLevels given = {.sType = SURFEL_STRUCTURE_TYPE_LEVELS, .size = sizeof given, .splats = &splats, .splatParents = parents,
                                .nodes = &nodes, .nodeParents = above, .balls = balls};
    SurfelScene *scene;
    OK(surfel_scene_create(NULL, &scene));
    parents[7] = NODES;
    IS(INVALID_ARGUMENT, surfel_scene_add_levels(scene, &given), "splat 7: its parent is 8: there are 8 nodes");
    parents[7] = 0;
    above[3] = 3;
    IS(INVALID_ARGUMENT, surfel_scene_add_levels(scene, &given), "node 3: its parent is 3: expected one before it");
    above[3] = 2, balls[3].spread = 0.7f;
    IS(INVALID_ARGUMENT, surfel_scene_add_levels(scene, &given), "node 3: its spread");
    above[3] = UINT32_MAX, balls[3].spread = 0.5f;
    s[0] = s[1] = s[2] = 0;
    IS(INVALID_ARGUMENT, surfel_scene_add_levels(scene, &given), "node 0 can't be drawn");
    s[0] = 0.6f, s[1] = -0.6f;
    SurfelLevels none = given;
    none.balls = NULL;
    IS(INVALID_ARGUMENT, surfel_scene_add_levels(scene, &none), "balls is NULL");
    OK(surfel_scene_add_levels(scene, &given));
    SurfelPreparedScene *prepared;
    engine_begin(engine);
    OK(surfel_upload(renderer, engine->commands, scene, &prepared));
    surfel_scene_destroy(scene);
    SurfelView *view = view_of(renderer);
    SurfelSettings *settings = albedo_by_tiles();
    const SurfelPreparedScene *scenes[] = {prepared};
    SurfelFrame frame = frame_of(scenes, settings);
    /* The spread is seen some 60 pixels large. */
    const char *lods[] = {"1", "400"};
    for (int i = 0; i < 2; i++) {
        if (i) engine_begin(engine);
        OK(surfel_settings_set(settings, "lod", lods[i]));
        TRUE(seen(engine, device, view, &frame) > 20000);
        const float *middle = engine->pixels + 4 * (HEIGHT / 2 * WIDTH + WIDTH / 2 + HEIGHT / 8);
        TRUE(middle[i ? 0 : 2] > 0.9f && middle[i ? 2 : 0] < 0.1f);
    }
    surfel_settings_destroy(settings);
    surfel_view_destroy(view);
    surfel_prepared_scene_destroy(prepared);
}
