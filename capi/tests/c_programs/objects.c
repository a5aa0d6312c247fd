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
