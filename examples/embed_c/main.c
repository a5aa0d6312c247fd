/* Splats within an engine in C: its own device, things, depth and submission; each hides the other where it is nearer.
 *
 *     cargo build --release -p surfel-c
 *     cc -o embed_c examples/embed_c/main.c examples/embed_c/engine.c -Icapi/include -Ltarget/release -lsurfel_c -lvulkan -lm
 *     LD_LIBRARY_PATH=target/release ./embed_c out.pfm [MODEL]
 *
 * All that concerns splats is between the two lines below; `engine.c` is what an engine has anyway. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <surfel.h>

#include "engine.h"

#define TRY(call)                                            \
    if ((call) != SURFEL_RESULT_SUCCESS) {                   \
        fprintf(stderr, "%s\n", surfel_last_error());        \
        return 1;                                            \
    }

enum { SPLATS = 20000 };
static double centers[3 * SPLATS];
static float normals[3 * SPLATS], radii[SPLATS];

int main(int argc, char **argv) {
    engine_ball(SPLATS, centers, normals, radii);
    Engine *engine = engine_new();
    const VkFormat color = VK_FORMAT_R32G32B32A32_SFLOAT;
    const float near = 0.1f;
    const double focal = 1 / tan(0.4);

    /* ---- Splats: once. */
    SurfelRequirements needs = {.sType = SURFEL_STRUCTURE_TYPE_REQUIREMENTS, .size = sizeof needs};
    TRY(surfel_requirements(engine->instance, engine->physical, vkGetInstanceProcAddr, &needs));
    TRY(surfel_enable_features(needs.features, &engine->core, &engine->vulkan12, &engine->vulkan13));
    engine_open(engine, needs.queueFamily);
    const SurfelImport host = {
        .sType = SURFEL_STRUCTURE_TYPE_IMPORT, .size = sizeof host, .instance = engine->instance,
        .physicalDevice = engine->physical, .device = engine->device, .getInstanceProcAddr = vkGetInstanceProcAddr,
        .features = needs.features, .queueFamily = needs.queueFamily, .debugUtils = VK_TRUE};
    SurfelDevice *device;
    TRY(surfel_device_import(&host, &device));
    SurfelRenderer *renderer;
    TRY(surfel_renderer_create(device, NULL, &renderer));
    const SurfelRendering rendering = {.sType = SURFEL_STRUCTURE_TYPE_RENDERING, .size = sizeof rendering,
        .colorFormats = &color, .colorFormatCount = 1, .depthFormat = VK_FORMAT_D32_SFLOAT};
    SurfelView *view;
    TRY(surfel_view_create(renderer, &rendering, &view));
    SurfelScene *scene;
    TRY(surfel_scene_create(NULL, &scene));
    const SurfelSplats ball = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof ball, .count = SPLATS,
        .centers = centers, .normals = normals, .radii = radii, .closed = VK_TRUE};
    TRY(argc > 2 ? surfel_scene_add_file(scene, argv[2]) : surfel_scene_add_splats(scene, &ball));
    double at[3], radius;
    TRY(surfel_scene_ball(scene, at, &radius));
    engine_begin(engine);
    SurfelPreparedScene *prepared;
    TRY(surfel_upload(renderer, engine->commands, scene, &prepared));
    surfel_scene_destroy(scene);
    /* Each frame: a large one, and a small one beside it. */
    const SurfelPreparedScene *scenes[] = {prepared, prepared};
    const double l = 1 / radius, s = 0.6 / radius;
    const double places[] = {l, 0, 0, 0, 0, l, 0, 0, 0, 0, l, 0, -0.6 - l * at[0], -l * at[1], -l * at[2], 1,
        s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, 1.1 - s * at[0], -s * at[1], -s * at[2], 1};
    const SurfelFrame frame = {.sType = SURFEL_STRUCTURE_TYPE_FRAME, .size = sizeof frame, .scenes = scenes,
        .worldFromScene = places, .sceneCount = 2, .width = WIDTH, .height = HEIGHT,
        .viewFromWorld = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -4.5, 1},
        .clipFromView = {focal * HEIGHT / WIDTH, 0, 0, 0, 0, -focal, 0, 0, 0, 0, 0, -1, 0, 0, near, 0}};
    TRY(surfel_view_prepare(view, engine->commands, &frame));
    engine_begin_rendering(engine, 1);
    engine_board(engine, (VkRect2D){{80, 200}, {480, 120}}, near / 3.8f);
    TRY(surfel_view_draw(view, engine->commands));
    engine_end_rendering(engine);
    engine_submit(engine);
    uint64_t epoch;
    TRY(surfel_device_end_epoch(device, &epoch));
    TRY(surfel_device_epoch_done(device, epoch));
    surfel_view_destroy(view);
    surfel_prepared_scene_destroy(prepared);
    surfel_renderer_destroy(renderer);
    surfel_device_destroy(device);
    /* ---- */

    engine_save(engine, argc > 1 ? argv[1] : "embed_c.pfm");
    const uint32_t messages = engine->messages;
    engine_free(engine);
    if (messages) fprintf(stderr, "the validation layer has spoken %u times\n", messages);
    return messages ? 1 : 0;
}
