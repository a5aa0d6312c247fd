#include "engine.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* An engine of an example has no other way to go on. */
#define MUST(call)                                                    \
    do {                                                              \
        VkResult must = (call);                                       \
        if (must != VK_SUCCESS) {                                     \
            fprintf(stderr, "%s: VkResult %d\n", #call, (int)must);   \
            exit(2);                                                  \
        }                                                             \
    } while (0)

static VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                 VkDebugUtilsMessageTypeFlagsEXT type,
                                                 const VkDebugUtilsMessengerCallbackDataEXT *data, void *engine) {
    (void)severity, (void)type;
    ((Engine *)engine)->messages++;
    fprintf(stderr, "%s\n", data->pMessage);
    return VK_FALSE;
}

Engine *engine_new(void) {
    Engine *engine = calloc(1, sizeof *engine);
    if (!engine) abort();
    engine->vulkan12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    engine->vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    /* What the engine itself needs. */
    engine->vulkan13.dynamicRendering = engine->vulkan13.synchronization2 = VK_TRUE;

    const char *layers[] = {"VK_LAYER_KHRONOS_validation"};
    const char *extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    const VkValidationFeatureEnableEXT enables[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    const VkValidationFeaturesEXT validation = {
        .sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
        .enabledValidationFeatureCount = 1,
        .pEnabledValidationFeatures = enables,
    };
    const VkDebugUtilsMessengerCreateInfoEXT messenger = {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .pNext = &validation,
        .messageSeverity =
            VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
        .pfnUserCallback = on_message,
        .pUserData = engine,
    };
    const VkApplicationInfo app = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = VK_API_VERSION_1_3};
    const VkInstanceCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
        .pNext = &messenger,
        .pApplicationInfo = &app,
        .enabledLayerCount = 1,
        .ppEnabledLayerNames = layers,
        .enabledExtensionCount = 2,
        .ppEnabledExtensionNames = extensions,
    };
    MUST(vkCreateInstance(&info, NULL, &engine->instance));
    PFN_vkCreateDebugUtilsMessengerEXT create = (PFN_vkCreateDebugUtilsMessengerEXT)vkGetInstanceProcAddr(
        engine->instance, "vkCreateDebugUtilsMessengerEXT");
    VkDebugUtilsMessengerCreateInfoEXT later = messenger;
    later.pNext = NULL;
    MUST(create(engine->instance, &later, NULL, &engine->messenger));
    uint32_t one = 1;
    VkResult found = vkEnumeratePhysicalDevices(engine->instance, &one, &engine->physical);
    if (one == 0 || found < VK_SUCCESS) MUST(VK_ERROR_INITIALIZATION_FAILED);
    return engine;
}

static VkDeviceMemory memory(Engine *engine, VkMemoryRequirements needed, VkMemoryPropertyFlags wanted) {
    VkPhysicalDeviceMemoryProperties types;
    vkGetPhysicalDeviceMemoryProperties(engine->physical, &types);
    uint32_t type = 0;
    while (type < types.memoryTypeCount && (!(needed.memoryTypeBits >> type & 1) ||
                                            (types.memoryTypes[type].propertyFlags & wanted) != wanted))
        type++;
    const VkMemoryAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needed.size, .memoryTypeIndex = type};
    VkDeviceMemory allocated;
    MUST(vkAllocateMemory(engine->device, &info, NULL, &allocated));
    return allocated;
}

static Attachment attachment(Engine *engine, VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect) {
    Attachment made;
    const VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = format,
        .extent = {WIDTH, HEIGHT, 1},
        .mipLevels = 1,
        .arrayLayers = 1,
        .samples = VK_SAMPLE_COUNT_1_BIT,
        .usage = usage,
    };
    MUST(vkCreateImage(engine->device, &info, NULL, &made.image));
    VkMemoryRequirements needed;
    vkGetImageMemoryRequirements(engine->device, made.image, &needed);
    made.memory = memory(engine, needed, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    MUST(vkBindImageMemory(engine->device, made.image, made.memory, 0));
    const VkImageViewCreateInfo view = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = made.image,
        .viewType = VK_IMAGE_VIEW_TYPE_2D,
        .format = format,
        .subresourceRange = {aspect, 0, 1, 0, 1},
    };
    MUST(vkCreateImageView(engine->device, &view, NULL, &made.view));
    return made;
}

void engine_open(Engine *engine, uint32_t family) {
    engine->family = family;
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, .queueFamilyIndex = family,
        .queueCount = 1, .pQueuePriorities = &priority};
    engine->vulkan12.pNext = &engine->vulkan13;
    const VkDeviceCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
        .pNext = &engine->vulkan12,
        .queueCreateInfoCount = 1,
        .pQueueCreateInfos = &queue,
        .pEnabledFeatures = &engine->core,
    };
    MUST(vkCreateDevice(engine->physical, &info, NULL, &engine->device));
    vkGetDeviceQueue(engine->device, family, 0, &engine->queue);
    const VkCommandPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, .queueFamilyIndex = family};
    MUST(vkCreateCommandPool(engine->device, &pool, NULL, &engine->pool));
    const VkCommandBufferAllocateInfo commands = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, .commandPool = engine->pool, .commandBufferCount = 1};
    MUST(vkAllocateCommandBuffers(engine->device, &commands, &engine->commands));
    MUST(vkCreateFence(engine->device, &(VkFenceCreateInfo){.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO}, NULL,
                       &engine->fence));
    engine->color = attachment(engine, VK_FORMAT_R32G32B32A32_SFLOAT,
                               VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                               VK_IMAGE_ASPECT_COLOR_BIT);
    engine->depth = attachment(engine, VK_FORMAT_D32_SFLOAT,
                               VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                               VK_IMAGE_ASPECT_DEPTH_BIT);
    const VkBufferCreateInfo buffer = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = WIDTH * HEIGHT * 4 * sizeof(float), .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    MUST(vkCreateBuffer(engine->device, &buffer, NULL, &engine->readback));
    VkMemoryRequirements needed;
    vkGetBufferMemoryRequirements(engine->device, engine->readback, &needed);
    engine->readback_memory = memory(
        engine, needed, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    MUST(vkBindBufferMemory(engine->device, engine->readback, engine->readback_memory, 0));
    void *mapped;
    MUST(vkMapMemory(engine->device, engine->readback_memory, 0, VK_WHOLE_SIZE, 0, &mapped));
    engine->pixels = mapped;
}

void engine_begin(Engine *engine) {
    MUST(vkResetCommandPool(engine->device, engine->pool, 0));
    const VkCommandBufferBeginInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
    };
    MUST(vkBeginCommandBuffer(engine->commands, &info));
}

static void barrier(Engine *engine, VkImageLayout from, VkImageLayout to) {
    VkImageMemoryBarrier2 barriers[2];
    for (int i = 0; i < 2; i++)
        barriers[i] = (VkImageMemoryBarrier2){
            .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
            .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
            .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
            .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
            .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
            .oldLayout = from,
            .newLayout = to,
            .image = i ? engine->depth.image : engine->color.image,
            .subresourceRange = {i ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1},
        };
    /* Of the depth nothing is read back. */
    const VkDependencyInfo info = {
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .imageMemoryBarrierCount = to == VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL ? 1 : 2,
        .pImageMemoryBarriers = barriers,
    };
    vkCmdPipelineBarrier2(engine->commands, &info);
}

void engine_begin_rendering(Engine *engine, int clears) {
    barrier(engine, clears ? VK_IMAGE_LAYOUT_UNDEFINED : VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL,
            VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL);
    const VkRenderingAttachmentInfo color = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
        .imageView = engine->color.view,
        .imageLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL,
        .loadOp = clears ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD,
        .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
        .clearValue.color.float32 = {0.2f, 0.2f, 0.2f, 1},
    };
    VkRenderingAttachmentInfo depth = color;
    depth.imageView = engine->depth.view;
    depth.clearValue = (VkClearValue){.depthStencil = {0, 0}};
    const VkRenderingInfo info = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
        .renderArea = {{0, 0}, {WIDTH, HEIGHT}},
        .layerCount = 1,
        .colorAttachmentCount = 1,
        .pColorAttachments = &color,
        .pDepthAttachment = &depth,
    };
    vkCmdBeginRendering(engine->commands, &info);
}

void engine_board(Engine *engine, VkRect2D where, float depth) {
    const VkClearAttachment both[] = {
        {VK_IMAGE_ASPECT_COLOR_BIT, 0, {.color.float32 = {0.9f, 0.4f, 0.05f, 1}}},
        {VK_IMAGE_ASPECT_DEPTH_BIT, 0, {.depthStencil = {depth, 0}}},
    };
    const VkClearRect rect = {where, 0, 1};
    vkCmdClearAttachments(engine->commands, 2, both, 1, &rect);
}

void engine_end_rendering(Engine *engine) { vkCmdEndRendering(engine->commands); }

void engine_submit(Engine *engine) {
    barrier(engine, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const VkBufferImageCopy copy = {
        .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
        .imageExtent = {WIDTH, HEIGHT, 1},
    };
    vkCmdCopyImageToBuffer(engine->commands, engine->color.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           engine->readback, 1, &copy);
    const VkMemoryBarrier2 to_host = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
        .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
        .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT,
    };
    const VkDependencyInfo info = {
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &to_host};
    vkCmdPipelineBarrier2(engine->commands, &info);
    MUST(vkEndCommandBuffer(engine->commands));
    const VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &engine->commands};
    MUST(vkQueueSubmit(engine->queue, 1, &submit, engine->fence));
    MUST(vkWaitForFences(engine->device, 1, &engine->fence, VK_TRUE, UINT64_MAX));
    MUST(vkResetFences(engine->device, 1, &engine->fence));
}

void engine_save(const Engine *engine, const char *path) {
    FILE *file = fopen(path, "wb");
    if (!file) {
        perror(path);
        exit(1);
    }
    fprintf(file, "PF\n%d %d\n-1.0\n", WIDTH, HEIGHT);
    for (int y = HEIGHT - 1; y >= 0; y--)
        for (int x = 0; x < WIDTH; x++) fwrite(engine->pixels + 4 * (y * WIDTH + x), sizeof(float), 3, file);
    if (fclose(file)) {
        perror(path);
        exit(1);
    }
}

void engine_free(Engine *engine) {
    if (engine->device) {
        MUST(vkDeviceWaitIdle(engine->device));
        vkDestroyBuffer(engine->device, engine->readback, NULL);
        vkFreeMemory(engine->device, engine->readback_memory, NULL);
        const Attachment both[] = {engine->color, engine->depth};
        for (int i = 0; i < 2; i++) {
            vkDestroyImageView(engine->device, both[i].view, NULL);
            vkDestroyImage(engine->device, both[i].image, NULL);
            vkFreeMemory(engine->device, both[i].memory, NULL);
        }
        vkDestroyFence(engine->device, engine->fence, NULL);
        vkDestroyCommandPool(engine->device, engine->pool, NULL);
        vkDestroyDevice(engine->device, NULL);
    }
    PFN_vkDestroyDebugUtilsMessengerEXT destroy = (PFN_vkDestroyDebugUtilsMessengerEXT)vkGetInstanceProcAddr(
        engine->instance, "vkDestroyDebugUtilsMessengerEXT");
    destroy(engine->instance, engine->messenger, NULL);
    vkDestroyInstance(engine->instance, NULL);
    free(engine);
}

void engine_ball(uint64_t count, double *centers, float *normals, float *radii) {
    for (uint64_t i = 0; i < count; i++) {
        /* A spiral from pole to pole, by the golden angle. */
        double z = 1 - (2 * (double)i + 1) / (double)count, turn = 2.399963229728653 * (double)i;
        double at[] = {sqrt(1 - z * z) * cos(turn), z, sqrt(1 - z * z) * sin(turn)};
        for (int axis = 0; axis < 3; axis++) {
            centers[3 * i + axis] = at[axis];
            normals[3 * i + axis] = (float)at[axis];
        }
        radii[i] = (float)(3 / sqrt((double)count));
    }
}
