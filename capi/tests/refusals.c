/* Each wrong use that can be seen gets its code and a sentence, and leaves all as it was; then frames of what is transparent, and objects
 * that are destroyed in an order of no sense. Arguments: a PLY file of four splats, and one of garbage. */
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <surfel.h>

#include "engine.h"

#define IS(expected, call, words)                                                                        \
    do {                                                                                                 \
        SurfelResult is = (call);                                                                        \
        const char *said = is == SURFEL_RESULT_SUCCESS ? "" : surfel_last_error();                       \
        if (is != SURFEL_RESULT_##expected || !strstr(said, words)) {                                    \
            printf("line %d: %s\nanswers %d, '%s'; expected %s, '%s'\n", __LINE__, #call, (int)is, said, \
                   #expected, words);                                                                    \
            exit(1);                                                                                     \
        }                                                                                                \
    } while (0)
#define OK(call) IS(SUCCESS, call, "")
#define TRUE(what)                                       \
    do {                                                 \
        if (!(what)) {                                   \
            printf("line %d: not %s\n", __LINE__, #what); \
            exit(1);                                     \
        }                                                \
    } while (0)

static void structs(void) {
    SurfelScene *scene = (SurfelScene *)&scene;
    SurfelSceneInfo info = {.sType = SURFEL_STRUCTURE_TYPE_SCENE_INFO, .size = sizeof info};
    IS(INVALID_ARGUMENT, surfel_scene_create(&info, NULL), "surfel_scene_create: scene is NULL");

    info.sType = 4711;
    IS(UNKNOWN_STRUCT, surfel_scene_create(&info, &scene), "info: sType 4711: expected 4 (SceneInfo)");
    TRUE(scene == NULL);
    info.sType = SURFEL_STRUCTURE_TYPE_FRAME;
    IS(UNKNOWN_STRUCT, surfel_scene_create(&info, &scene), "sType 9");
    info.sType = SURFEL_STRUCTURE_TYPE_SCENE_INFO;
    const SurfelRendererInfo other = {.sType = SURFEL_STRUCTURE_TYPE_RENDERER_INFO, .size = sizeof other};
    info.pNext = &other;
    IS(UNKNOWN_STRUCT, surfel_scene_create(&info, &scene), "pNext leads to sType 3");
    info.pNext = NULL;

    /* As a header of tomorrow has it. */
    struct {
        SurfelSceneInfo known;
        uint64_t later;
    } newer = {info, 0};
    newer.known.size = sizeof newer;
    OK(surfel_scene_create(&newer.known, &scene));
    surfel_scene_destroy(scene);
    newer.later = 1;
    IS(NEWER_STRUCT, surfel_scene_create(&newer.known, &scene), "size 32: this library knows 24 bytes");
    TRUE(scene == NULL);
    /* And one of yesterday. */
    info.size = offsetof(SurfelSceneInfo, levels);
    OK(surfel_scene_create(&info, &scene));
    surfel_scene_destroy(scene);
    info.size = 0;
    IS(INVALID_ARGUMENT, surfel_scene_create(&info, &scene), "size 0");
    surfel_scene_destroy(NULL);
}

static void scenes(const char *splats_file, const char *garbage) {
    SurfelScene *scene;
    OK(surfel_scene_create(NULL, &scene));
    double center[3], radius;
    IS(INVALID_ARGUMENT, surfel_scene_ball(scene, center, &radius), "nothing");

    const double centers[] = {0, 0, 0, 1, 0, 0};
    const float vectors[] = {0, 0, 1, 0, 0, 1}, radii[] = {1, 1};
    SurfelSplats splats = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof splats, .count = 2};
    IS(INVALID_ARGUMENT, surfel_scene_add_splats(NULL, &splats), "scene is NULL");
    IS(INVALID_ARGUMENT, surfel_scene_add_splats(scene, NULL), "splats is NULL");
    IS(INVALID_ARGUMENT, surfel_scene_add_splats(scene, &splats), "centers is NULL");
    splats.centers = centers;
    IS(INVALID_ARGUMENT, surfel_scene_add_splats(scene, &splats), "expected normals and radii, or");
    splats.normals = vectors;
    IS(INVALID_ARGUMENT, surfel_scene_add_splats(scene, &splats), "radii is NULL");
    splats.radii = radii;
    splats.tangentsS = vectors;
    IS(INVALID_ARGUMENT, surfel_scene_add_splats(scene, &splats), "expected normals and radii, or");
    splats.tangentsS = NULL;
    splats.colors = vectors;
    IS(INVALID_ARGUMENT, surfel_scene_add_splats(scene, &splats), "colorCount is 0: expected 1 or 2");
    splats.colors = NULL;
    splats.epsilon = -1;
    IS(OPTION, surfel_scene_add_splats(scene, &splats), "epsilon: -1");
    splats.epsilon = 0;
    splats.count = UINT64_MAX / 8;
    IS(INVALID_ARGUMENT, surfel_scene_add_splats(scene, &splats), "don't fit into memory");
    splats.count = (uint64_t)1 << 50;
    IS(OUT_OF_MEMORY, surfel_scene_add_splats(scene, &splats), "centers: no memory");
    splats.count = 2;
    splats.name = "\xff";
    IS(INVALID_ARGUMENT, surfel_scene_add_splats(scene, &splats), "name is not UTF-8");
    splats.name = "two";
    OK(surfel_scene_add_splats(scene, &splats));
    OK(surfel_scene_ball(scene, center, &radius));
    TRUE(center[0] == 0.5 && radius == 1.5);

    IS(FILE, surfel_scene_add_file(scene, "/nowhere/model.ply"), "/nowhere/model.ply: cannot read");
    IS(INPUT, surfel_scene_add_file(scene, garbage), garbage);
    IS(INVALID_ARGUMENT, surfel_scene_add_file(scene, NULL), "path is NULL");
    OK(surfel_scene_add_file(scene, splats_file));
    IS(OPTION, surfel_scene_add_light(scene, "torch"), "light: 'torch'");
    OK(surfel_scene_add_light(scene, "direction=0,0,-1,intensity=0.5"));
    IS(OPTION, surfel_scene_set(scene, "order", "random"), "order: random: expected morton, input");
    IS(OPTION, surfel_scene_set(scene, "colour", "1"), "colour: expected one of order, splat-format");
    OK(surfel_scene_set(scene, "splat-format", "packed"));
    surfel_scene_destroy(scene);

    SurfelSettings *settings;
    OK(surfel_settings_create(&settings));
    IS(OPTION, surfel_settings_set(settings, "shading", "gouraud"), "shading: gouraud: expected");
    IS(OPTION, surfel_settings_set(settings, "layers", "0"), "layers");
    IS(INVALID_ARGUMENT, surfel_settings_set(settings, NULL, ""), "name is NULL");
    surfel_settings_destroy(settings);
}

static void on_time(void *count, const char *name, double secs) {
    TRUE(name[0] != 0 && secs < 10);
    ++*(int *)count;
}

static SurfelDevice *import(Engine *engine, uint64_t features) {
    SurfelImport host = {.sType = SURFEL_STRUCTURE_TYPE_IMPORT, .size = sizeof host, .instance = engine->instance,
                         .physicalDevice = engine->physical, .device = engine->device, .features = features,
                         .queueFamily = engine->family, .debugUtils = VK_TRUE};
    SurfelDevice *device;
    IS(INVALID_ARGUMENT, surfel_device_import(&host, &device), "getInstanceProcAddr is NULL");
    host.getInstanceProcAddr = vkGetInstanceProcAddr;
    host.instance = VK_NULL_HANDLE;
    IS(INVALID_ARGUMENT, surfel_device_import(&host, &device), "instance is NULL");
    host.instance = engine->instance;
    host.features = features & ~(uint64_t)SURFEL_FEATURE_MAINTENANCE4;
    IS(NO_DEVICE, surfel_device_import(&host, &device), "maintenance4 is not enabled");
    host.features = features;
    host.queueFamily = 99;
    IS(NO_DEVICE, surfel_device_import(&host, &device), "");
    TRUE(device == NULL);
    host.queueFamily = engine->family;
    OK(surfel_device_import(&host, &device));
    return device;
}

static SurfelPreparedScene *upload(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer, float alpha) {
    enum { COUNT = 2000 };
    static double centers[3 * COUNT];
    static float normals[3 * COUNT], radii[COUNT];
    engine_ball(COUNT, centers, normals, radii);
    radii[7] = -1;
    const float color[] = {0, 0.5f, 0.8f, alpha};
    const SurfelSplats splats = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof splats, .count = COUNT,
                                 .centers = centers, .normals = normals, .radii = radii, .colors = color,
                                 .colorCount = 1, .closed = VK_TRUE};
    SurfelScene *scene;
    OK(surfel_scene_create(NULL, &scene));
    OK(surfel_scene_add_splats(scene, &splats));
    SurfelPreparedScene *prepared;
    IS(INVALID_ARGUMENT, surfel_upload(renderer, VK_NULL_HANDLE, scene, &prepared), "commands is NULL");
    engine_begin(engine);
    OK(surfel_upload(renderer, engine->commands, scene, &prepared));
    surfel_scene_destroy(scene);
    engine_begin_rendering(engine, 1);
    engine_end_rendering(engine);
    engine_submit(engine);
    uint64_t epoch;
    OK(surfel_device_end_epoch(device, &epoch));
    OK(surfel_device_epoch_done(device, epoch));
    SurfelPreparedSceneInfo info = {.sType = SURFEL_STRUCTURE_TYPE_PREPARED_SCENE_INFO, .size = sizeof info};
    OK(surfel_prepared_scene_info(prepared, &info));
    TRUE(info.splats == COUNT - 1 && info.leftOut == 1 && info.triangles == 0 && info.bytes > 32 * info.splats);
    return prepared;
}

static void frames(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer) {
    SurfelPreparedScene *ball = upload(engine, device, renderer, 0.4f);
    const VkFormat color = VK_FORMAT_R32G32B32A32_SFLOAT;
    SurfelRendering rendering = {.sType = SURFEL_STRUCTURE_TYPE_RENDERING, .size = sizeof rendering,
                                 .depthFormat = VK_FORMAT_D32_SFLOAT};
    SurfelView *view;
    IS(OPTION, surfel_view_create(renderer, &rendering, &view), "color: 0: the rendering has no such attachment");
    rendering.colorFormatCount = 1;
    IS(INVALID_ARGUMENT, surfel_view_create(renderer, &rendering, &view), "colorFormats is NULL");
    rendering.colorFormats = &color;
    OK(surfel_view_create(renderer, &rendering, &view));
    engine_begin(engine);
    IS(OPTION, surfel_view_draw(view, engine->commands), "no frame is prepared");

    const SurfelPreparedScene *scenes[] = {NULL};
    double place[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1};
    SurfelFrame frame = {.sType = SURFEL_STRUCTURE_TYPE_FRAME, .size = sizeof frame, .sceneCount = 1, .timed = VK_TRUE};
    IS(INVALID_ARGUMENT, surfel_view_prepare(view, engine->commands, &frame), "scenes is NULL");
    frame.scenes = scenes;
    IS(INVALID_ARGUMENT, surfel_view_prepare(view, engine->commands, &frame), "a scene is NULL");
    scenes[0] = ball;
    frame.worldFromScene = place;
    IS(OPTION, surfel_view_prepare(view, engine->commands, &frame), "scene 0: placement");
    place[10] = 1;
    IS(OPTION, surfel_view_prepare(view, engine->commands, &frame), "camera");
    const double view_from_world[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -4, 1};
    const double clip_from_view[] = {2.0 * HEIGHT / WIDTH, 0, 0, 0, 0, -2, 0, 0, 0, 0, 0, -1, 0, 0, 0.1, 0};
    memcpy(frame.viewFromWorld, view_from_world, sizeof view_from_world);
    memcpy(frame.clipFromView, clip_from_view, sizeof clip_from_view);
    IS(OPTION, surfel_view_prepare(view, engine->commands, &frame), "--size: 0x0");
    frame.width = WIDTH;
    frame.height = HEIGHT;
    IS(OPTION, surfel_view_prepare(view, engine->commands, &frame), "hides: something is transparent");
    SurfelDepthImage hides = {
        .sType = SURFEL_STRUCTURE_TYPE_DEPTH_IMAGE, .size = sizeof hides, .image = engine->depth.image,
        .beforeStages = VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
        .beforeAccess = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
        .afterStages = VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
        .afterAccess = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
        .beforeLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL, .afterLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL,
        .format = VK_FORMAT_D32_SFLOAT, .width = WIDTH, .height = HEIGHT};
    frame.hides = &hides;
    IS(INVALID_ARGUMENT, surfel_view_prepare(view, engine->commands, &frame), "hides: image or view is NULL");
    hides.view = engine->depth.view;

    /* The left half of a board is before the ball, the right half within it. */
    engine_begin_rendering(engine, 1);
    engine_board(engine, (VkRect2D){{0, 0}, {WIDTH / 2, HEIGHT}}, 0.1f / 2);
    engine_board(engine, (VkRect2D){{WIDTH / 2, 0}, {WIDTH / 2, HEIGHT}}, 0.1f / 4);
    engine_end_rendering(engine);
    IS(INVALID_ARGUMENT, surfel_view_prepare(view, VK_NULL_HANDLE, &frame), "commands is NULL");
    OK(surfel_view_prepare(view, engine->commands, &frame));
    engine_begin_rendering(engine, 0);
    OK(surfel_view_draw(view, engine->commands));
    engine_end_rendering(engine);
    engine_submit(engine);
    /* An order of no sense: all that is left lives as long as it has to. */
    surfel_renderer_destroy(renderer);
    surfel_prepared_scene_destroy(ball);
    uint64_t epoch, bytes = 0, used, held;
    OK(surfel_device_end_epoch(device, &epoch));
    OK(surfel_device_epoch_done(device, epoch));
    OK(surfel_device_memory(device, &used, &held));
    OK(surfel_view_bytes(view, &bytes));
    TRUE(bytes > WIDTH * HEIGHT * 8 && used >= bytes && held >= used);
    int passes = 0;
    OK(surfel_view_times(view, on_time, &passes));
    IS(INVALID_ARGUMENT, surfel_view_times(view, NULL, &passes), "each is NULL");
    TRUE(passes > 3);
    surfel_device_destroy(device);
    surfel_view_destroy(view);
    const float *left = engine->pixels + 4 * (HEIGHT / 2 * WIDTH + WIDTH / 2 - 20), *right = left + 4 * 40;
    const float board[] = {0.9f, 0.4f, 0.05f, 1};
    TRUE(memcmp(left, board, sizeof board) == 0);
    TRUE(right[0] < 0.7f && right[0] > 0.3f && right[2] > 0.1f);
}

int main(int argc, char **argv) {
    if (argc != 3) return 1;
    TRUE(surfel_version() == SURFEL_VERSION);
    TRUE(surfel_last_error()[0] == 0);
    structs();
    scenes(argv[1], argv[2]);
    Engine *engine = engine_new();
    SurfelRequirements needs = {.sType = SURFEL_STRUCTURE_TYPE_REQUIREMENTS, .size = sizeof needs};
    IS(INVALID_ARGUMENT, surfel_requirements(engine->instance, VK_NULL_HANDLE, vkGetInstanceProcAddr, &needs),
       "physicalDevice is NULL");
    IS(INVALID_ARGUMENT, surfel_requirements(engine->instance, engine->physical, vkGetInstanceProcAddr, NULL),
       "requirements is NULL");
    /* Of a header of yesterday: nothing is written behind its end. */
    needs.size = offsetof(SurfelRequirements, queueFamily);
    needs.queueFamily = 77;
    OK(surfel_requirements(engine->instance, engine->physical, vkGetInstanceProcAddr, &needs));
    TRUE(needs.features != 0 && needs.apiVersion == VK_API_VERSION_1_3 && needs.queueFamily == 77);
    needs.size = sizeof needs;
    OK(surfel_requirements(engine->instance, engine->physical, vkGetInstanceProcAddr, &needs));
    TRUE(needs.queueFamily != 77 && needs.colorFormatCount > 0 && needs.depthFormatCount > 0);
    IS(INVALID_ARGUMENT, surfel_enable_features(needs.features, NULL, &engine->vulkan12, &engine->vulkan13), "core");
    OK(surfel_enable_features(needs.features, &engine->core, &engine->vulkan12, &engine->vulkan13));
    TRUE(engine->vulkan13.maintenance4 == VK_TRUE && engine->vulkan13.dynamicRendering == VK_TRUE);
    engine_open(engine, needs.queueFamily);
    /* Twice: the engine's device is as it was. */
    for (int i = 0; i < 2; i++) {
        SurfelDevice *device = import(engine, needs.features);
        SurfelRenderer *renderer;
        IS(INVALID_ARGUMENT, surfel_renderer_create(NULL, NULL, &renderer), "device is NULL");
        OK(surfel_renderer_create(device, NULL, &renderer));
        frames(engine, device, renderer);
    }
    const uint32_t messages = engine->messages;
    engine_free(engine);
    TRUE(messages == 0);
    return 0;
}
