/* Each wrong use that can be seen gets its code and a sentence, and leaves all as it was; then frames, and objects that are destroyed in an
 * order of no sense. Arguments: a PLY file of four splats, and one of garbage. */
#include <stddef.h>

#include "check.h"

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
    IS(NEWER_STRUCT, surfel_scene_create(&newer.known, &scene), "size 48: this library knows 40 bytes");
    TRUE(scene == NULL);
    /* And one of yesterday. */
    info.size = offsetof(SurfelSceneInfo, levels);
    OK(surfel_scene_create(&info, &scene));
    surfel_scene_destroy(scene);
    info.size = sizeof info;
    info.reserved = 7;
    IS(NEWER_STRUCT, surfel_scene_create(&info, &scene), "info: reserved is 7: this library knows 0");
    info.reserved = 0;
    info.size = 0;
    IS(INVALID_ARGUMENT, surfel_scene_create(&info, &scene), "size 0");
    surfel_scene_destroy(NULL);
}

/* Nothing is read or written where no such thing can be. */
static void pointers(void) {
    uint64_t room[8] = {0};
    char *const odd = (char *)room + 1;
    SurfelScene *scene;
    IS(INVALID_ARGUMENT, surfel_scene_create(NULL, (void *)odd), "scene is not aligned");
    IS(INVALID_ARGUMENT, surfel_scene_create((void *)odd, &scene), "info is not aligned");
    OK(surfel_scene_create(NULL, &scene));
    double center[3], radius;
    IS(INVALID_ARGUMENT, surfel_scene_ball((void *)odd, center, &radius), "scene is not aligned");
    IS(INVALID_ARGUMENT, surfel_scene_ball(scene, (void *)odd, &radius), "center is not aligned");
    IS(INVALID_ARGUMENT, surfel_scene_ball(scene, center, (void *)odd), "radius is not aligned");
    IS(INVALID_ARGUMENT, surfel_scene_set((void *)odd, "order", "input"), "scene is not aligned");
    IS(INVALID_ARGUMENT, surfel_device_end_epoch((void *)odd, room), "device is not aligned");
    surfel_scene_destroy(scene);
    /* A size that was never set: what would have to be zero behind the struct's end is not the caller's. */
    const SurfelSceneInfo info = {.sType = SURFEL_STRUCTURE_TYPE_SCENE_INFO, .size = UINT32_MAX - 7};
    IS(INVALID_ARGUMENT, surfel_scene_create(&info, &scene), "info: size 4294967288: expected its sizeof");
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
    splats.reserved = 1;
    IS(NEWER_STRUCT, surfel_scene_add_splats(scene, &splats), "splats: reserved is 1");
    splats.reserved = 0;
    OK(surfel_scene_add_splats(scene, &splats));
    OK(surfel_scene_ball(scene, center, &radius));
    TRUE(center[0] == 0.5 && radius == 1.5);

    IS(FILE, surfel_scene_add_file(scene, "/nowhere/model.ply"), "/nowhere/model.ply: cannot read");
    IS(INPUT, surfel_scene_add_file(scene, garbage), garbage);
    IS(INVALID_ARGUMENT, surfel_scene_add_file(scene, NULL), "path is NULL");
    OK(surfel_scene_add_file(scene, splats_file));
    IS(OPTION, surfel_scene_add_light(scene, "torch"), "light: 'torch'");
    for (int i = 0; i < 16; i++) OK(surfel_scene_add_light(scene, "direction=0,0,-1,intensity=0.5"));
    IS(OPTION, surfel_scene_add_light(scene, "eye"), "light: the scene has 16 already");
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
    host.features = features | (uint64_t)1 << 40;
    IS(INVALID_ARGUMENT, surfel_device_import(&host, &device), "features: 0x10000000000 is of none");
    host.features = features;
    host.queueFamily = 99;
    IS(NO_DEVICE, surfel_device_import(&host, &device), "");
    TRUE(device == NULL);
    host.queueFamily = engine->family;
    memory(engine, host);
    OK(surfel_device_import(&host, &device));
    return device;
}

/* By the host's own timeline: values rise, and what has no epoch is nothing. */
static void timeline(const SurfelDevice *device) {
    IS(INVALID_ARGUMENT, surfel_device_end_epoch_at(NULL, 1), "device is NULL");
    OK(surfel_device_end_epoch_at(device, 40));
    IS(OPTION, surfel_device_end_epoch_at(device, 40), "epoch: 40: expected more than 40");
    OK(surfel_device_timeline_at(device, 39));
    OK(surfel_device_timeline_at(device, 1000));
    OK(surfel_device_end_epoch_at(device, 41));
    OK(surfel_device_timeline_at(device, 41));
}

int main(int argc, char **argv) {
    if (argc != 3) return 1;
    TRUE(surfel_version() == SURFEL_VERSION);
    TRUE(surfel_last_error()[0] == 0);
    structs();
    pointers();
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
    IS(INVALID_ARGUMENT, surfel_enable_features((uint64_t)1 << 40, &engine->core, &engine->vulkan12, &engine->vulkan13), "features");
    OK(surfel_enable_features(needs.features, &engine->core, &engine->vulkan12, &engine->vulkan13));
    TRUE(engine->vulkan13.maintenance4 == VK_TRUE && engine->vulkan13.dynamicRendering == VK_TRUE);
    engine_open(engine, needs.queueFamily);
    SurfelDevice *other = import(engine, needs.features);
    SurfelRenderer *others;
    OK(surfel_renderer_create(other, NULL, &others));
    SurfelPreparedScene *foreign = upload(engine, other, others, 1);
    /* Twice: the engine's device is as it was. */
    for (int i = 0; i < 2; i++) {
        SurfelDevice *device = import(engine, needs.features);
        SurfelRenderer *renderer;
        IS(INVALID_ARGUMENT, surfel_renderer_create(NULL, NULL, &renderer), "device is NULL");
        OK(surfel_renderer_create(device, NULL, &renderer));
        timeline(device);
        shapes(engine, device, renderer);
        dynamic(engine, device, renderer);
        steady(engine, device, renderer);
        objects(engine, device, renderer);
        rooms(engine, device, renderer);
        levels(engine, device, renderer);
        hybrid(engine, device, renderer);
        defects(engine, device, renderer);
        lights(engine, device, renderer);
        names(engine, device, renderer);
        frames(engine, device, renderer, foreign, i == 0);
    }
    surfel_device_destroy(other);
    surfel_renderer_destroy(others);
    surfel_prepared_scene_destroy(foreign);
    const uint32_t messages = engine->messages;
    engine_free(engine);
    TRUE(messages == 0);
    return 0;
}
