#include "check.h"

/* What the library takes from the heap: the linker puts these in the place of what its static form calls. */
void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
int __real_posix_memalign(void **at, size_t alignment, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
int __wrap_posix_memalign(void **at, size_t alignment, size_t size);

static unsigned long taken;

void *__wrap_malloc(size_t size) {
    taken++;
    return __real_malloc(size);
}
void *__wrap_calloc(size_t count, size_t size) {
    taken++;
    return __real_calloc(count, size);
}
void *__wrap_realloc(void *old, size_t size) {
    taken++;
    return __real_realloc(old, size);
}
int __wrap_posix_memalign(void **at, size_t alignment, size_t size) {
    taken++;
    return __real_posix_memalign(at, alignment, size);
}

static SurfelHostImage image(const Attachment *given, VkPipelineStageFlags2 stages, VkAccessFlags2 access) {
    return (SurfelHostImage){.sType = SURFEL_STRUCTURE_TYPE_HOST_IMAGE, .size = sizeof(SurfelHostImage),
                             .image = given->image, .view = given->view, .width = WIDTH, .height = HEIGHT, .beforeStages = stages,
                             .beforeAccess = access, .afterStages = stages, .afterAccess = access,
                             .beforeLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL,
                             .afterLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL};
}

enum { COUNT = 2000, PART = 600 };

/* A scene whose splats change, as `splats` is. */
static SurfelPreparedScene *upload_updatable(Engine *engine, SurfelRenderer *renderer, const SurfelSplats *splats) {
    const SurfelSceneInfo made = {.sType = SURFEL_STRUCTURE_TYPE_SCENE_INFO, .size = sizeof made, .updatable = VK_TRUE};
    SurfelScene *scene;
    OK(surfel_scene_create(&made, &scene));
    OK(surfel_scene_add_splats(scene, splats));
    SurfelPreparedScene *prepared;
    engine_begin(engine);
    OK(surfel_upload(renderer, engine->commands, scene, &prepared));
    surfel_scene_destroy(scene);
    engine_begin_rendering(engine, 1);
    engine_end_rendering(engine);
    engine_submit(engine);
    return prepared;
}

/* What passes cost together, and how many there are. */
typedef struct Cost {
    unsigned passes, dispatches, draws;
    double secs;
    uint64_t invocations, vertices;
} Cost;

static void on_pass(void *user, const SurfelPassFigures *figures) {
    Cost *cost = user;
    TRUE(figures->name[0] != 0 && strlen(figures->name) < 100);
    cost->passes++;
    if (figures->secs >= 0) cost->secs += figures->secs;
    if (figures->invocations != UINT64_MAX) cost->dispatches++, cost->invocations += figures->invocations;
    if (figures->vertices != UINT64_MAX) cost->draws++, cost->vertices += figures->vertices;
}

/* Measures a frame that nobody sees. */
static Cost measure(Engine *engine, SurfelDevice *device, SurfelView *view, SurfelFrame frame, uint32_t measures, double *span) {
    frame.measures = measures;
    engine_begin(engine);
    OK(surfel_view_prepare(view, engine->commands, &frame));
    run_without_drawing(engine, device);
    Cost cost = {0};
    OK(surfel_view_measured(view, on_pass, &cost, span));
    return cost;
}

void steady(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer) {
    enum { FRAMES = 20, SETTLED = 12, OF_TWO_CALLS = 6 };
    SurfelPreparedScene *ball = upload(engine, device, renderer, 1);
    static double centers[3 * COUNT];
    static float normals[3 * COUNT], radii[COUNT], colors_each[4 * COUNT], tangents[2][3 * COUNT];
    engine_ball(COUNT, centers, normals, radii);
    for (int i = 0; i < COUNT; i++) {
        colors_each[4 * i + i % 3] = colors_each[4 * i + 3] = 1;
        tangents[0][3 * i] = tangents[1][3 * i + 1] = 0.1f;
    }
    SurfelSplats disks = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof disks, .count = COUNT,
                          .centers = centers, .normals = normals, .radii = radii, .colors = colors_each,
                          .colorCount = COUNT, .closed = VK_TRUE};
    SurfelSplats ellipses = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof ellipses, .count = COUNT,
                             .centers = centers, .tangentsS = tangents[0], .tangentsT = tangents[1]};
    SurfelPreparedScene *changes = upload_updatable(engine, renderer, &disks);
    SurfelPreparedScene *of_ellipses = upload_updatable(engine, renderer, &ellipses);
    disks.count = disks.colorCount = ellipses.count = PART;
    SurfelSplats uniform = disks;
    uniform.colorCount = 1;
    SurfelDynamicSplats written = {.sType = SURFEL_STRUCTURE_TYPE_DYNAMIC_SPLATS, .size = sizeof written,
                                   .capacity = COUNT, .count = COUNT, .least = {-1, -1, -1}, .most = {1, 1, 1},
                                   .largestRadius = 0.1};
    SurfelPreparedScene *of_host;
    OK(surfel_dynamic_create(renderer, &written, &of_host));
    const VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    const SurfelRendering rendering = {.sType = SURFEL_STRUCTURE_TYPE_RENDERING, .size = sizeof rendering,
                                       .colorFormats = &format, .colorFormatCount = 1,
                                       .depthFormat = VK_FORMAT_D32_SFLOAT};
    SurfelView *view;
    OK(surfel_view_create(renderer, &rendering, &view));
    SurfelSettings *settings;
    OK(surfel_settings_create(&settings));
    OK(surfel_settings_set(settings, "clip-plane", "1,0.5,0.3,-0.6"));
    const SurfelPreparedScene *scenes[] = {ball, changes};
    const double places[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.5, 0.5, 0, 1};
    const SurfelFrame frame = {.sType = SURFEL_STRUCTURE_TYPE_FRAME, .size = sizeof frame, .scenes = scenes,
                               .worldFromScene = places, .settings = settings, .sceneCount = 2,
                               .width = WIDTH, .height = HEIGHT, .refusesMissing = VK_TRUE, .timed = VK_TRUE,
                               .viewFromWorld = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -4, 1},
                               .clipFromView = {2.0 * HEIGHT / WIDTH, 0, 0, 0, 0, -2, 0, 0, 0, 0, 0, -1, 0, 0, 0.1, 0}};
    const SurfelHostImage color = image(&engine->color, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                        VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
    const SurfelHostImage depth = image(&engine->depth, VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                                        VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT);
    const SurfelHostImage *colors[] = {&color}, *none[] = {NULL};
    const size_t bytes = sizeof(float) * 4 * WIDTH * HEIGHT;
    float *by_two_calls = malloc(bytes);
    TRUE(by_two_calls);
    /* What is missing is refused until it is made, and not waited for. */
    engine_begin(engine);
    IS(NOT_READY, surfel_view_prepare(view, engine->commands, &frame), "compile_ahead has not made");
    uint64_t made = 0;
    OK(surfel_compile_ahead(renderer, &rendering, &frame, &made));
    TRUE(made > 0);
    OK(surfel_compile_ahead(renderer, &rendering, &frame, &made));
    TRUE(made == 0);
    OK(surfel_compile_ahead(renderer, &rendering, &frame, NULL));
    IS(INVALID_ARGUMENT, surfel_compile_ahead(NULL, &rendering, &frame, &made), "renderer is NULL");
    /* One call suffices, from afar to among the splats. */
    SurfelFrame on_the_way = frame;
    for (double distance = 1000; distance > 0.01; distance *= 0.8) {
        on_the_way.viewFromWorld[14] = -distance;
        engine_begin(engine);
        OK(surfel_view_prepare(view, engine->commands, &on_the_way));
    }
    for (int number = 0; number < FRAMES; number++) {
        engine_begin(engine);
        engine_begin_rendering(engine, 1);
        engine_board(engine, (VkRect2D){{0, 0}, {WIDTH / 2, HEIGHT}}, 0.1f / 4);
        engine_end_rendering(engine);
        const unsigned long before = taken;
        /* Splats that change, of one color and of many, of one kind and the other; and as many as there are room for of the host's own. */
        OK(surfel_update(renderer, engine->commands, changes, 0, 0, &uniform));
        OK(surfel_update(renderer, engine->commands, changes, 0, 0, &disks));
        OK(surfel_update(renderer, engine->commands, of_ellipses, 0, 7, &ellipses));
        written.count = COUNT - 300 * (number % 4);
        OK(surfel_dynamic_set(of_host, &written));
        if (number < OF_TWO_CALLS) {
            OK(surfel_view_prepare(view, engine->commands, &frame));
            engine_begin_rendering(engine, 0);
            OK(surfel_view_draw(view, engine->commands));
            engine_end_rendering(engine);
        } else {
            OK(surfel_view_record(view, engine->commands, &frame, colors, 1, &depth));
        }
        const unsigned long by_frame = taken - before;
        engine_submit(engine);
        const unsigned long before_reading = taken;
        Cost cost = {0};
        double span = 0;
        OK(surfel_view_measured(view, on_pass, &cost, &span));
        TRUE(cost.passes > 3 && cost.secs > 0 && span > 0 && cost.dispatches == 0);
        const unsigned long took = by_frame + (taken - before_reading);
        if (number >= SETTLED && took != 0) {
            printf("frame %d takes %lu pieces from the heap\n", number, took);
            exit(1);
        }
        uint64_t epoch;
        OK(surfel_device_end_epoch(device, &epoch));
        OK(surfel_device_epoch_done(device, epoch));
        if (number < OF_TWO_CALLS) memcpy(by_two_calls, engine->pixels, bytes);
        else TRUE(memcmp(by_two_calls, engine->pixels, bytes) == 0);
    }
    TRUE(taken > 100);
    double span = 0;
    Cost cost = measure(engine, device, view, frame, SURFEL_MEASURE_COUNTS, &span);
    TRUE(cost.passes > 3 && cost.dispatches > 2 && cost.invocations > COUNT && cost.secs == 0 && span < 0);
    cost = measure(engine, device, view, frame, SURFEL_MEASURE_FRAME, &span);
    TRUE(cost.passes > 3 && cost.dispatches == 0 && cost.secs == 0 && span > 0);
    cost = measure(engine, device, view, frame, SURFEL_MEASURE_TIMES, NULL);
    TRUE(cost.secs > 0);
    IS(INVALID_ARGUMENT, surfel_view_measured(view, NULL, &cost, &span), "each is NULL");
    SurfelFrame other = frame;
    other.measures = 4;
    IS(INVALID_ARGUMENT, surfel_view_prepare(view, engine->commands, &other), "measures is 4");
    other.measures = 0, other.reserved = 1;
    IS(NEWER_STRUCT, surfel_view_prepare(view, engine->commands, &other), "reserved is 1");
    IS(OPTION, surfel_view_record(view, engine->commands, &frame, none, 1, &depth), "colors: expected an image for each format");
    IS(OPTION, surfel_view_record(view, engine->commands, &frame, colors, 1, NULL), "depth: the view's rendering has one");
    IS(INVALID_ARGUMENT, surfel_view_record(view, engine->commands, &frame, colors, 9, &depth), "colorCount is 9: expected at most 8");
    IS(INVALID_ARGUMENT, surfel_view_record(view, VK_NULL_HANDLE, &frame, colors, 1, &depth), "commands is NULL");
    SurfelHostImage wrong = color;
    colors[0] = &wrong;
    wrong.format = VK_FORMAT_R8G8B8A8_UNORM;
    IS(OPTION, surfel_view_record(view, engine->commands, &frame, colors, 1, &depth), "colors[0].format: R8G8B8A8_UNORM: expected R32G32B32A32_SFLOAT");
    wrong.format = format;
    wrong.usage = VK_IMAGE_USAGE_SAMPLED_BIT;
    IS(OPTION, surfel_view_record(view, engine->commands, &frame, colors, 1, &depth), "colors[0].usage: SAMPLED");
    wrong.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    wrong.width = WIDTH - 1;
    IS(OPTION, surfel_view_record(view, engine->commands, &frame, colors, 1, &depth), "colors[0].extent: 639x480: expected 640x480 pixels from 0,0 on");
    wrong.sType = SURFEL_STRUCTURE_TYPE_FRAME;
    IS(UNKNOWN_STRUCT, surfel_view_record(view, engine->commands, &frame, colors, 1, &depth), "sType 9: expected 11 (HostImage)");
    wrong = color;
    wrong.view = VK_NULL_HANDLE;
    IS(INVALID_ARGUMENT, surfel_view_record(view, engine->commands, &frame, colors, 1, &depth), "a color: image or view is NULL");
    free(by_two_calls);
    surfel_settings_destroy(settings);
    surfel_view_destroy(view);
    surfel_prepared_scene_destroy(of_host);
    surfel_prepared_scene_destroy(of_ellipses);
    surfel_prepared_scene_destroy(changes);
    surfel_prepared_scene_destroy(ball);
}
