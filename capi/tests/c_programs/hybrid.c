/* Levels of detail of triangles. */
#include "check.h"

enum { SIDE = 40, COUNT = SIDE * SIDE };

/* The color of the middle of the left half, and of the right. */
static void draw(Engine *engine, SurfelDevice *device, SurfelView *view, const SurfelFrame *frame, const float *of[2]) {
    draw_alone(engine, device, view, frame);
    for (int half = 0; half < 2; half++) of[half] = engine->pixels + 4 * (HEIGHT / 2 * WIDTH + WIDTH / 2 + (half ? 1 : -1) * HEIGHT / 8);
}

void hybrid(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer) {
    /* A square of two cells, left and right, each with a node. */
    const double corners[] = {-1, -1, 0, 0, -1, 0, 1, -1, 0, -1, 1, 0, 0, 1, 0, 1, 1, 0};
    const uint32_t triangles[] = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
    const float red[] = {1, 0, 0, 1}, green[] = {0, 1, 0, 1}, blue[] = {0, 0, 1, 1}, pale[] = {0, 1, 0, 0.5f};
    static double centers[3 * COUNT];
    static float normals[3 * COUNT], radii[COUNT];
    static uint32_t halves[COUNT], counts[COUNT];
    for (int i = 0; i < COUNT; i++) {
        halves[i] = i / SIDE >= SIDE / 2, counts[i] = 1;
        centers[3 * i] = (i / SIDE + 0.5) * 2 / SIDE - 1, centers[3 * i + 1] = (i % SIDE + 0.5) * 2 / SIDE - 1;
        normals[3 * i + 2] = 1, radii[i] = 0.06f;
    }
    const double nodes_at[] = {-0.5, 0, 0, 0.5, 0, 0};
    const float s[] = {0.7f, 0, 0, 0.7f, 0, 0}, t[] = {0, 1.2f, 0, 0, 1.2f, 0};
    const uint32_t above[] = {UINT32_MAX, UINT32_MAX};
    const SurfelErrorBall balls[] = {{{-0.5f, 0, 0}, 1.5f, 0.5f}, {{0.5f, 0, 0}, 1.5f, 0.5f}};
    SurfelPolygonCell cells[] = {{2, 1, {{-0.5f, 0, 0}, 1.3f, 0.05f}}, {2, 1, {{0.5f, 0, 0}, 1.3f, 0.3f}}};
    uint32_t neighbors[] = {1, 0};
    SurfelMesh mesh = {.sType = SURFEL_STRUCTURE_TYPE_MESH, .size = sizeof mesh, .vertexCount = 6, .positions = corners,
                       .colors = pale, .colorCount = 1, .triangleCount = 4, .triangles = triangles};
    const SurfelSplats splats = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof splats, .count = COUNT, .centers = centers,
                                 .normals = normals, .radii = radii, .colors = blue, .colorCount = 1};
    const SurfelSplats nodes = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof nodes, .count = 2, .centers = nodes_at,
                                .tangentsS = s, .tangentsT = t, .colors = red, .colorCount = 1};
    const SurfelLevels levels = {.sType = SURFEL_STRUCTURE_TYPE_LEVELS, .size = sizeof levels, .splats = &splats,
                                 .splatParents = halves, .nodes = &nodes, .nodeParents = above, .balls = balls};
    SurfelHybridLevels given = {.sType = SURFEL_STRUCTURE_TYPE_HYBRID_LEVELS, .size = sizeof given, .levels = &levels,
                                .splatCellCounts = counts, .splatCellCount = COUNT, .splatCells = halves, .cellCount = 2,
                                .cells = cells, .neighborCount = 2, .neighbors = neighbors};
    SurfelScene *scene;
    OK(surfel_scene_create(NULL, &scene));
    IS(INVALID_ARGUMENT, surfel_scene_add_hybrid_levels(scene, &given), "mesh 0: the scene has 0");
    OK(surfel_scene_add_mesh(scene, &mesh));
    IS(INVALID_ARGUMENT, surfel_scene_add_hybrid_levels(scene, &given), "mesh 0: expected an opaque one");
    surfel_scene_destroy(scene);
    OK(surfel_scene_create(NULL, &scene));
    mesh.colors = green;
    OK(surfel_scene_add_mesh(scene, &mesh));
    cells[1].triangleCount = 1;
    IS(INVALID_ARGUMENT, surfel_scene_add_hybrid_levels(scene, &given), "cells: they have 3 triangles, mesh 0 4");
    cells[1].triangleCount = 2, neighbors[1] = 2;
    IS(INVALID_ARGUMENT, surfel_scene_add_hybrid_levels(scene, &given), "neighbors: 2: there are 2 cells");
    neighbors[1] = 0, cells[1].neighborCount = 2;
    IS(INVALID_ARGUMENT, surfel_scene_add_hybrid_levels(scene, &given), "neighbors: 2 of them: expected the sum of neighborCount");
    cells[1].neighborCount = 1, counts[5] = 0;
    IS(INVALID_ARGUMENT, surfel_scene_add_hybrid_levels(scene, &given), "splatCells: 1600 of them: expected the sum");
    counts[6] = 2;
    IS(INVALID_ARGUMENT, surfel_scene_add_hybrid_levels(scene, &given), "splat 5 is drawn for no cell");
    counts[5] = counts[6] = 1, cells[0].ball.spread = 0.6f;
    IS(INVALID_ARGUMENT, surfel_scene_add_hybrid_levels(scene, &given), "cell 0: its spread is more than that of the node above splat 0");
    cells[0].ball.spread = 0;
    IS(INVALID_ARGUMENT, surfel_scene_add_hybrid_levels(scene, &given), "cell 0: its ball is none");
    cells[0].ball.spread = 0.05f;
    OK(surfel_scene_add_hybrid_levels(scene, &given));
    IS(INVALID_ARGUMENT, surfel_scene_add_hybrid_levels(scene, &given), "mesh 0: it has levels of detail already");
    SurfelPreparedScene *prepared = uploaded(engine, device, renderer, scene);
    SurfelView *view = view_of(renderer);
    SurfelSettings *settings = albedo_by_tiles();
    const SurfelPreparedScene *scenes[] = {prepared};
    const SurfelFrame frame = frame_of(scenes, settings);
    /* The spreads of the cells are seen some 6 and 36 pixels large, those of the nodes 60: triangles, then splats on the left alone, on both sides, nodes. */
    const char *lods[] = {"1", "20", "75", "400"};
    const int expected[4][2] = {{1, 1}, {2, 1}, {2, 2}, {0, 0}};
    for (int i = 0; i < 4; i++) {
        OK(surfel_settings_set(settings, "lod", lods[i]));
        const float *of[2];
        draw(engine, device, view, &frame, of);
        for (int half = 0; half < 2; half++) {
            const int is = of[half][0] > 0.9f ? 0 : of[half][1] > 0.9f ? 1 : of[half][2] > 0.9f ? 2 : -1;
            if (is != expected[i][half]) printf("lod %s, half %d: %g %g %g\n", lods[i], half, of[half][0], of[half][1], of[half][2]);
            TRUE(is == expected[i][half]);
        }
    }
    surfel_settings_destroy(settings);
    surfel_view_destroy(view);
    surfel_prepared_scene_destroy(prepared);
}
