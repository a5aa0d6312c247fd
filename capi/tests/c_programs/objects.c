#include <math.h>

#include "check.h"

enum { COUNT = 2000 };

/* An image of the size of the engine's, attached and copied from. */
static Attachment image(Engine *engine, VkFormat format) {
    Attachment made;
    const VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO, .imageType = VK_IMAGE_TYPE_2D, .format = format,
        .extent = {WIDTH, HEIGHT, 1}, .mipLevels = 1, .arrayLayers = 1, .samples = VK_SAMPLE_COUNT_1_BIT,
        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT};
    TRUE(vkCreateImage(engine->device, &info, NULL, &made.image) == VK_SUCCESS);
    VkMemoryRequirements needed;
    vkGetImageMemoryRequirements(engine->device, made.image, &needed);
    uint32_t type = 0;
    while (!(needed.memoryTypeBits >> type & 1)) type++;
    const VkMemoryAllocateInfo memory = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needed.size, .memoryTypeIndex = type};
    TRUE(vkAllocateMemory(engine->device, &memory, NULL, &made.memory) == VK_SUCCESS);
    TRUE(vkBindImageMemory(engine->device, made.image, made.memory, 0) == VK_SUCCESS);
    const VkImageViewCreateInfo view = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO, .image = made.image, .viewType = VK_IMAGE_VIEW_TYPE_2D,
        .format = format, .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
    TRUE(vkCreateImageView(engine->device, &view, NULL, &made.view) == VK_SUCCESS);
    return made;
}

static void begin(Engine *engine, const Attachment colors[3]) {
    VkImageMemoryBarrier2 barriers[4];
    VkRenderingAttachmentInfo attached[4];
    for (int i = 0; i < 4; i++) {
        barriers[i] = (VkImageMemoryBarrier2){
            .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2, .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
            .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT, .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
            .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
            .newLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL, .image = i < 3 ? colors[i].image : engine->depth.image,
            .subresourceRange = {i < 3 ? VK_IMAGE_ASPECT_COLOR_BIT : VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1}};
        attached[i] = (VkRenderingAttachmentInfo){
            .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO, .imageView = i < 3 ? colors[i].view : engine->depth.view,
            .imageLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL, .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    }
    vkCmdPipelineBarrier2(engine->commands, &(VkDependencyInfo){.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                          .imageMemoryBarrierCount = 4, .pImageMemoryBarriers = barriers});
    const VkRenderingInfo info = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_INFO, .renderArea = {{0, 0}, {WIDTH, HEIGHT}}, .layerCount = 1,
        .colorAttachmentCount = 3, .pColorAttachments = attached, .pDepthAttachment = attached + 3};
    vkCmdBeginRendering(engine->commands, &info);
}

/* How many pixels are not of what the engine clears to, of a scene seen from afar. */
static int seen(Engine *engine, SurfelDevice *device, SurfelView *view, SurfelFrame *frame) {
    draw_behind(engine, device, view, frame);
    int count = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) count += memcmp(engine->pixels + 4 * i, engine->pixels, 16) != 0;
    return count;
}

/* Splats come to an object of none, and go again. */
void rooms(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer) {
    static double centers[3 * COUNT];
    static float normals[3 * COUNT], radii[COUNT];
    engine_ball(COUNT, centers, normals, radii);
    for (int i = 0; i < COUNT; i++) centers[3 * i] += 5e5;
    const float color[] = {0, 0.5f, 1, 1};
    SurfelRoom room = {.sType = SURFEL_STRUCTURE_TYPE_ROOM, .size = sizeof room, .splats = COUNT + 7, .hasAround = VK_TRUE,
                       .around = {5e5, 0, 0}, .overlap = 1.5};
    SurfelSplats splats = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof splats, .centers = centers,
                           .normals = normals, .radii = radii, .colors = color, .colorCount = 1, .room = &room};
    SurfelSceneInfo made = {.sType = SURFEL_STRUCTURE_TYPE_SCENE_INFO, .size = sizeof made};
    SurfelScene *scene;
    SurfelPreparedScene *prepared;
    OK(surfel_scene_create(&made, &scene));
    OK(surfel_scene_add_splats(scene, &splats));
    engine_begin(engine);
    IS(OPTION, surfel_upload(renderer, engine->commands, scene, &prepared), "room of object 0: expected a scene with Scene::updatable");
    surfel_scene_destroy(scene);
    made.updatable = made.numbered = VK_TRUE;
    OK(surfel_scene_create(&made, &scene));
    room.sType = SURFEL_STRUCTURE_TYPE_SPLATS;
    IS(UNKNOWN_STRUCT, surfel_scene_add_splats(scene, &splats), "room: sType 5: expected 15 (Room)");
    room.sType = SURFEL_STRUCTURE_TYPE_ROOM;
    OK(surfel_scene_add_splats(scene, &splats));
    OK(surfel_upload(renderer, engine->commands, scene, &prepared));
    surfel_scene_destroy(scene);
    splats.room = NULL;

    SurfelView *view = view_of(renderer);
    const SurfelPreparedScene *scenes[] = {prepared};
    SurfelFrame frame = {.sType = SURFEL_STRUCTURE_TYPE_FRAME, .size = sizeof frame, .scenes = scenes, .sceneCount = 1,
                         .width = WIDTH, .height = HEIGHT,
                         .viewFromWorld = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -5e5, 0, -4, 1},
                         .clipFromView = {2.0 * HEIGHT / WIDTH, 0, 0, 0, 0, -2, 0, 0, 0, 0, 0, -1, 0, 0, 0.1, 0}};
    TRUE(seen(engine, device, view, &frame) == 0);
    uint32_t left = 0, first = 9;
    OK(surfel_room_of(prepared, 0, &left));
    TRUE(left == COUNT + 7);
    OK(surfel_room_of(prepared, 1, &left));
    TRUE(left == 0);
    engine_begin(engine);
    splats.count = COUNT;
    OK(surfel_append(renderer, engine->commands, prepared, 0, &splats, &first));
    TRUE(first == 0);
    const int whole = seen(engine, device, view, &frame);
    /* What is seen in the middle, and beside the ball: of the scene as it stands, moved and twice as large, and in a left-handed world. */
    const double moved[] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, -5e5, 0, 0, 1};
    const SurfelFrame right_handed = frame;
    for (int round = 0; round < 3; round++) {
        SurfelPicked there = {.sType = SURFEL_STRUCTURE_TYPE_PICKED, .size = sizeof there}, beside = there;
        SurfelPick *picks[2];
        const uint32_t at[] = {WIDTH / 2, 3};
        frame = right_handed;
        if (round == 1) frame.worldFromScene = moved;
        if (round == 2) frame.leftHanded = VK_TRUE, frame.viewFromWorld[14] = 4, frame.clipFromView[11] = 1;
        engine_begin(engine);
        for (int i = 0; i < 2; i++) OK(surfel_pick(device, renderer, engine->commands, &frame, 0, at[i], HEIGHT / 2, picks + i));
        run_without_drawing(engine, device);
        OK(surfel_pick_read(picks[0], prepared, &there));
        OK(surfel_pick_read(picks[1], prepared, &beside));
        for (int i = 0; i < 2; i++) surfel_pick_destroy(picks[i]);
        const double radius = round == 1 ? 2 : 1, toward_eye = round == 2 ? -1 : 1;
        TRUE(there.kind == SURFEL_PICKED_SPLAT && there.object == 0 && there.number < COUNT);
        TRUE(fabs(there.position[0] - 5e5) < 0.05 && fabs(there.position[1]) < 0.05 && fabs(there.position[2] - toward_eye * radius) < 0.05);
        TRUE(toward_eye * there.normal[2] > 0.98 && fabs(there.distance - (4 - radius)) < 0.05 && fabs(there.depth - there.distance) < 0.01);
        TRUE(fabs(there.position[0] - 5e5 - radius * (centers[3 * there.number] - 5e5)) < 0.2 && fabs(centers[3 * there.number + 2] - 1) < 0.1);
        TRUE(beside.kind == SURFEL_PICKED_NOTHING && beside.number == 0 && beside.distance == 0);
    }
    /* A mirror shows on the one side of its picture what is seen on the other without it. */
    double across[2];
    for (int mirrored = 0; mirrored < 2; mirrored++) {
        SurfelPicked there = {.sType = SURFEL_STRUCTURE_TYPE_PICKED, .size = sizeof there};
        SurfelPick *pick;
        frame = right_handed;
        if (mirrored) frame.mirrored = VK_TRUE, frame.viewFromWorld[0] = -1, frame.viewFromWorld[12] = 5e5;
        engine_begin(engine);
        OK(surfel_pick(device, renderer, engine->commands, &frame, 0, WIDTH * 5 / 8, HEIGHT / 2, &pick));
        run_without_drawing(engine, device);
        OK(surfel_pick_read(pick, prepared, &there));
        surfel_pick_destroy(pick);
        TRUE(there.kind == SURFEL_PICKED_SPLAT);
        across[mirrored] = there.position[0] - 5e5;
    }
    TRUE(across[0] > 0.2 && fabs(across[0] + across[1]) < 0.02);
    frame = right_handed;
    SurfelPick *none;
    engine_begin(engine);
    IS(INVALID_ARGUMENT, surfel_pick(device, renderer, engine->commands, &frame, 1, 0, 0, &none), "scene 1: the frame has 1");
    IS(OPTION, surfel_pick(device, renderer, engine->commands, &frame, 0, WIDTH, 0, &none), "expected a pixel of");
    IS(INVALID_ARGUMENT, surfel_pick_read(NULL, prepared, NULL), "pick is NULL");
    TRUE(none == NULL);
    engine_begin(engine);
    splats.count = 8;
    IS(OPTION, surfel_append(renderer, engine->commands, prepared, 0, &splats, &first), "8 splats behind number 2000 of object 0: it has room up to 2007");
    IS(OPTION, surfel_append(renderer, engine->commands, prepared, 1, &splats, &first), "object 1 has no room");
    IS(INVALID_ARGUMENT, surfel_append(renderer, VK_NULL_HANDLE, prepared, 0, &splats, NULL), "commands is NULL");
    splats.count = 7;
    OK(surfel_append(renderer, engine->commands, prepared, 0, &splats, &first));
    TRUE(first == COUNT);
    OK(surfel_room_of(prepared, 0, &left));
    TRUE(left == 0);
    /* The ball of engine.c begins at one pole. */
    OK(surfel_remove(renderer, engine->commands, prepared, 0, COUNT / 2, COUNT / 2 + 7));
    const int half = seen(engine, device, view, &frame);
    engine_begin(engine);
    IS(OPTION, surfel_remove(renderer, engine->commands, prepared, 0, COUNT, 8), "2000..2008 of object 0: expected numbers in order up to 2007");
    IS(INVALID_ARGUMENT, surfel_remove(renderer, engine->commands, prepared, 0, 1, UINT32_MAX), "splats from 1 on");
    OK(surfel_remove(renderer, engine->commands, prepared, 0, 0, COUNT + 7));
    TRUE(seen(engine, device, view, &frame) == 0);
    if (whole < 20000 || half < whole / 4 || half > whole * 3 / 4) {
        printf("%d pixels of a ball, %d of its half\n", whole, half);
        exit(1);
    }
    surfel_view_destroy(view);
    surfel_prepared_scene_destroy(prepared);
}

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

void objects(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer) {
    static double centers[3 * COUNT];
    static float normals[3 * COUNT], radii[COUNT];
    engine_ball(COUNT, centers, normals, radii);
    float color[] = {0.5f, 0.5f, 0.5f, 1};
    SurfelSplats splats = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof splats, .count = COUNT,
                           .centers = centers, .normals = normals, .radii = radii, .colors = color,
                           .colorCount = 1, .closed = VK_TRUE};
    const SurfelSceneInfo made = {.sType = SURFEL_STRUCTURE_TYPE_SCENE_INFO, .size = sizeof made, .updatable = VK_TRUE};
    SurfelScene *scene;
    OK(surfel_scene_create(&made, &scene));
    OK(surfel_scene_add_splats(scene, &splats));
    SurfelPreparedScene *ball;
    engine_begin(engine);
    OK(surfel_upload(renderer, engine->commands, scene, &ball));
    surfel_scene_destroy(scene);
    IS(OPTION, surfel_update(renderer, engine->commands, ball, 1, 0, &splats), "object 1: the scene has 1");
    IS(OPTION, surfel_update(renderer, engine->commands, ball, 0, 1, &splats), "has 1999 of the 2000");
    IS(INVALID_ARGUMENT, surfel_update(renderer, VK_NULL_HANDLE, ball, 0, 0, &splats), "commands is NULL");
    color[0] = 1;
    OK(surfel_update(renderer, engine->commands, ball, 0, 0, &splats));

    const Attachment own = engine->color;
    const VkFormat formats[] = {VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R32_UINT, VK_FORMAT_R32G32_SFLOAT};
    const Attachment colors[] = {own, image(engine, formats[1]), image(engine, formats[2])};
    SurfelRendering rendering = {.sType = SURFEL_STRUCTURE_TYPE_RENDERING, .size = sizeof rendering,
                                 .colorFormats = formats, .colorFormatCount = 1, .depthFormat = VK_FORMAT_D32_SFLOAT,
                                 .ids = VK_TRUE, .motion = VK_TRUE};
    SurfelView *view;
    IS(OPTION, surfel_view_create(renderer, &rendering, &view), "ids: color attachment 1 is UNDEFINED");
    rendering.colorFormatCount = 2;
    IS(OPTION, surfel_view_create(renderer, &rendering, &view), "motion: color attachment 2 is UNDEFINED");
    rendering.colorFormatCount = 3;
    OK(surfel_view_create(renderer, &rendering, &view));

    const SurfelPreparedScene *scenes[] = {ball, ball};
    const double stands[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1};
    double stood[32];
    memcpy(stood, stands, sizeof stands);
    stood[28] -= 0.5;
    const uint32_t ids[] = {7, 4000000000u};
    float tints[] = {1, 1, 1, 1, 0.5f, 1, 1, 0.5f};
    SurfelFrame frame = {.sType = SURFEL_STRUCTURE_TYPE_FRAME, .size = sizeof frame, .scenes = scenes,
                         .worldFromScene = stands, .worldFromSceneBefore = stood, .ids = ids, .tints = tints,
                         .sceneCount = 2, .width = WIDTH, .height = HEIGHT,
                         .viewFromWorld = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -4, 1},
                         .clipFromView = {2.0 * HEIGHT / WIDTH, 0, 0, 0, 0, -2, 0, 0, 0, 0, 0, -1, 0, 0, 0.1, 0}};
    IS(OPTION, surfel_view_prepare(view, engine->commands, &frame), "tint: of scene 1");
    tints[7] = 1;
    frame.clipFromViewBefore[0] = 1;
    IS(OPTION, surfel_view_prepare(view, engine->commands, &frame), "camera_before");
    frame.clipFromViewBefore[0] = 0;
    SurfelSettings *settings;
    OK(surfel_settings_create(&settings));
    OK(surfel_settings_set(settings, "shading", "albedo"));
    frame.settings = settings;
    /* Of the picture, the numbers and the motion one is read in each of three frames. In the third the camera has moved, and no ball. */
    for (int read = 0; read < 3; read++) {
        if (read) engine_begin(engine);
        if (read == 2) {
            frame.worldFromSceneBefore = NULL;
            memcpy(frame.viewFromWorldBefore, frame.viewFromWorld, sizeof frame.viewFromWorld);
            memcpy(frame.clipFromViewBefore, frame.clipFromView, sizeof frame.clipFromView);
            frame.viewFromWorldBefore[12] -= 0.25;
        }
        OK(surfel_view_prepare(view, engine->commands, &frame));
        begin(engine, colors);
        OK(surfel_view_draw(view, engine->commands));
        engine_end_rendering(engine);
        engine->color = colors[read];
        engine_submit(engine);
        engine->color = own;
        uint64_t epoch;
        OK(surfel_device_end_epoch(device, &epoch));
        OK(surfel_device_epoch_done(device, epoch));
        const int row = HEIGHT / 2 * WIDTH, left = row + WIDTH / 2 - HEIGHT / 3, right = row + WIDTH / 2 + HEIGHT / 3;
        const float *pixels = engine->pixels;
        const uint32_t *numbers = (const uint32_t *)(const void *)engine->pixels;
        if (read == 0) TRUE(fabsf(pixels[4 * left] - 1) < 0.01f && fabsf(pixels[4 * right] - 0.5f) < 0.01f);
        if (read == 1) TRUE(numbers[left] == ids[0] && numbers[right] == ids[1] && numbers[row] == 0);
        if (read == 2) {
            /* At the front of a ball, three from the eye. */
            const float expected = 0.25f * HEIGHT / 3;
            TRUE(fabsf(pixels[2 * left] - expected) < 0.05f * expected && fabsf(pixels[2 * left + 1]) < 0.01f);
            TRUE(fabsf(pixels[2 * right] - expected) < 0.05f * expected && pixels[2 * row] == 0);
        }
    }
    surfel_settings_destroy(settings);
    surfel_view_destroy(view);
    surfel_prepared_scene_destroy(ball);
    for (int i = 1; i < 3; i++) {
        vkDestroyImageView(engine->device, colors[i].view, NULL);
        vkDestroyImage(engine->device, colors[i].image, NULL);
        vkFreeMemory(engine->device, colors[i].memory, NULL);
    }
}
