#include "check.h"

static void on_time(void *count, const char *name, double secs) {
    TRUE(name[0] != 0 && secs < 10);
    ++*(int *)count;
}

SurfelPreparedScene *upload(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer, float alpha) {
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
    prepared = uploaded(engine, device, renderer, scene);
    SurfelPreparedSceneInfo info = {.sType = SURFEL_STRUCTURE_TYPE_PREPARED_SCENE_INFO, .size = sizeof info};
    OK(surfel_prepared_scene_info(prepared, &info));
    TRUE(info.splats == COUNT - 1 && info.leftOut == 1 && info.triangles == 0 && info.bytes > 32 * info.splats);
    return prepared;
}

void frames(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer, const SurfelPreparedScene *foreign,
            int in_order) {
    SurfelPreparedScene *ball = upload(engine, device, renderer, 0.4f);
    const VkFormat color = VK_FORMAT_R32G32B32A32_SFLOAT;
    SurfelRendering rendering = {.sType = SURFEL_STRUCTURE_TYPE_RENDERING, .size = sizeof rendering,
                                 .depthFormat = VK_FORMAT_D32_SFLOAT};
    SurfelView *view;
    rendering.depthFormat = VK_FORMAT_UNDEFINED;
    IS(OPTION, surfel_view_create(renderer, &rendering, &view), "color_formats: there is neither color nor depth");
    rendering.depthFormat = VK_FORMAT_D32_SFLOAT;
    OK(surfel_view_create(renderer, &rendering, &view));
    surfel_view_destroy(view);
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
    IS(OPTION, surfel_view_prepare(view, engine->commands, &frame), "size_px: 0x0");
    frame.width = WIDTH;
    frame.height = HEIGHT;
    IS(OPTION, surfel_view_prepare(view, engine->commands, &frame), "camera");
    const double view_from_world[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -4, 1};
    const double clip_from_view[] = {2.0 * HEIGHT / WIDTH, 0, 0, 0, 0, -2, 0, 0, 0, 0, 0, -1, 0, 0, 0.1, 0};
    memcpy(frame.viewFromWorld, view_from_world, sizeof view_from_world);
    memcpy(frame.clipFromView, clip_from_view, sizeof clip_from_view);
    scenes[0] = foreign;
    IS(OPTION, surfel_view_prepare(view, engine->commands, &frame), "scene: was prepared for another device");
    scenes[0] = ball;
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
    const float *left = engine->pixels + 4 * (HEIGHT / 2 * WIDTH + WIDTH / 2 - 20), *right = left + 4 * 40;
    const float board[] = {0.9f, 0.4f, 0.05f, 1};
    TRUE(memcmp(left, board, sizeof board) == 0);
    TRUE(right[0] < 0.7f && right[0] > 0.3f && right[2] > 0.1f);
    uint64_t epoch, bytes = 0, used, held;
    OK(surfel_device_end_epoch(device, &epoch));
    OK(surfel_device_epoch_done(device, epoch));
    OK(surfel_device_memory(device, &used, &held));
    OK(surfel_view_bytes(view, &bytes));
    TRUE(bytes > WIDTH * HEIGHT * 8 && used > bytes && held >= used);
    int passes = 0;
    OK(surfel_view_times(view, on_time, &passes));
    IS(INVALID_ARGUMENT, surfel_view_times(view, NULL, &passes), "each is NULL");
    TRUE(passes > 3);
    surfel_renderer_destroy(renderer);
    if (in_order) {
        surfel_view_destroy(view);
        surfel_prepared_scene_destroy(ball);
        OK(surfel_device_end_epoch(device, &epoch));
        OK(surfel_device_epoch_done(device, epoch));
        OK(surfel_device_memory(device, &used, &held));
        TRUE(used == 0);
        surfel_device_destroy(device);
    } else {
        /* What is left lives as long as it has to. */
        surfel_device_destroy(device);
        engine_begin(engine);
        engine_begin_rendering(engine, 1);
        OK(surfel_view_draw(view, engine->commands));
        engine_end_rendering(engine);
        surfel_prepared_scene_destroy(ball);
        engine_submit(engine);
        surfel_view_destroy(view);
    }
}

void dynamic(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer) {
    enum { COUNT = 2000 };
    static double centers[3 * COUNT];
    static float normals[3 * COUNT], radii[COUNT], shapes[8 * COUNT];
    static uint16_t colors[4 * COUNT];
    engine_ball(COUNT, centers, normals, radii);
    for (int i = 0; i < COUNT; i++) {
        const float *n = normals + 3 * i, shape[] = {n[0], n[1], n[2], radii[i], n[0], n[1], n[2], 2};
        const uint16_t color[] = {0, 30000, 50000, 65535};
        memcpy(shapes + 8 * i, shape, sizeof shape);
        memcpy(colors + 4 * i, color, sizeof color);
    }
    SurfelDynamicSplats splats = {.sType = SURFEL_STRUCTURE_TYPE_DYNAMIC_SPLATS, .size = sizeof splats,
                                  .capacity = COUNT, .count = COUNT + 1, .least = {-1, -1, -1}, .most = {1, 1, 1},
                                  .largestRadius = 0.1, .overlap = 5, .closed = VK_TRUE, .origin = {5e5, -3e5, 7}};
    SurfelPreparedScene *ball, *uploaded = upload(engine, device, renderer, 1);
    IS(OPTION, surfel_dynamic_create(renderer, &splats, &ball), "2001 of them: there is room for 2000");
    IS(OPTION, surfel_dynamic_set(uploaded, &splats), "the scene was uploaded");
    splats.count = COUNT;
    OK(surfel_dynamic_create(renderer, &splats, &ball));
    VkBuffer of_shapes, of_colors;
    IS(INVALID_ARGUMENT, surfel_dynamic_buffers(uploaded, &of_shapes, &of_colors), "it was uploaded");
    OK(surfel_dynamic_buffers(ball, &of_shapes, &of_colors));
    surfel_prepared_scene_destroy(uploaded);
    const VkFormat color = VK_FORMAT_R32G32B32A32_SFLOAT;
    const SurfelRendering rendering = {.sType = SURFEL_STRUCTURE_TYPE_RENDERING, .size = sizeof rendering,
                                       .colorFormats = &color, .colorFormatCount = 1,
                                       .depthFormat = VK_FORMAT_D32_SFLOAT};
    SurfelView *view;
    OK(surfel_view_create(renderer, &rendering, &view));
    const SurfelPreparedScene *scenes[] = {ball};
    const SurfelFrame frame = {.sType = SURFEL_STRUCTURE_TYPE_FRAME, .size = sizeof frame, .scenes = scenes,
                               .sceneCount = 1, .width = WIDTH, .height = HEIGHT,
                               .viewFromWorld = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -5e5, 3e5, -11, 1},
                               .clipFromView = {2.0 * HEIGHT / WIDTH, 0, 0, 0, 0, -2, 0, 0, 0, 0, 0, -1, 0, 0, 0.1, 0}};
    for (int halves = 2; halves > 0; halves--) {
        engine_begin(engine);
        if (halves == 2) {
            vkCmdUpdateBuffer(engine->commands, of_shapes, 0, sizeof shapes, shapes);
            vkCmdUpdateBuffer(engine->commands, of_colors, 0, sizeof colors, colors);
            const VkMemoryBarrier2 barrier = {
                .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, .srcStageMask = VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_COPY_BIT,
                .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                .dstStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT,
                .dstAccessMask = VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
            vkCmdPipelineBarrier2(engine->commands, &(VkDependencyInfo){.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                  .memoryBarrierCount = 1, .pMemoryBarriers = &barrier});
        } else {
            /* The upper half: the points run from above. */
            splats.count = COUNT / 2;
            OK(surfel_dynamic_set(ball, &splats));
        }
        draw_behind(engine, device, view, &frame);
        const float *above = engine->pixels + 4 * ((HEIGHT / 2 - 60) * WIDTH + WIDTH / 2), *below = above + 4 * 120 * WIDTH;
        TRUE(above[0] < 0.1f && above[2] > 0.3f);
        TRUE(halves == 2 ? below[0] < 0.1f && below[2] > 0.3f : below[0] == 0.2f);
    }
    const SurfelDynamicSplats known = splats;
    splats.closed = VK_FALSE;
    IS(OPTION, surfel_dynamic_set(ball, &splats), "another capacity, closed or transparent");
    splats = known, splats.transparent = VK_TRUE;
    IS(OPTION, surfel_dynamic_set(ball, &splats), "another capacity, closed or transparent");
    splats = known, splats.capacity--;
    IS(OPTION, surfel_dynamic_set(ball, &splats), "another capacity, closed or transparent");
    splats = known, splats.least[1] = 2;
    IS(OPTION, surfel_dynamic_set(ball, &splats), "the smaller coordinates first");
    splats = known, splats.overlap = 0.5;
    IS(OPTION, surfel_dynamic_set(ball, &splats), "an overlap of 1 or more");
    splats = known, splats.largestRadius = 0;
    IS(OPTION, surfel_dynamic_set(ball, &splats), "a radius above 0");
    surfel_prepared_scene_destroy(ball);
    surfel_view_destroy(view);
}
