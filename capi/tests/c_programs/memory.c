#include "check.h"

/* An allocator of the host's: each piece a memory object of its own; it counts them, and refuses all after some. */
typedef struct Allocator {
    Engine *engine;
    VkPhysicalDeviceMemoryProperties types;
    unsigned asked, live, left;
    /* A sum of all that was asked for, in its order. */
    uint64_t sum, bytes;
} Allocator;

/* Of two lists in one order the sums are the same; of others hardly ever. */
static void add(uint64_t *sum, const SurfelMemoryRequest *request) {
    const uint64_t words[] = {request->bytes, request->alignment, request->memoryTypeBits, request->linear, request->writtenByHost, request->readByHost};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) *sum = *sum * 1099511628211u + words[i];
    for (const char *c = request->name; *c; c++) *sum = *sum * 1099511628211u + (unsigned char)*c;
}

static VkResult allocate(void *user, const SurfelMemoryRequest *request, SurfelAllocation *allocation) {
    Allocator *own = user;
    TRUE(request->sType == SURFEL_STRUCTURE_TYPE_MEMORY_REQUEST && request->size == sizeof *request);
    TRUE(request->name[0] != 0 && request->bytes > 0 && !(request->writtenByHost && request->readByHost));
    own->asked++;
    add(&own->sum, request);
    own->bytes += request->bytes;
    if (own->left == 0) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    own->left--;
    const int is_mapped = request->writtenByHost || request->readByHost;
    const VkMemoryPropertyFlags wanted = is_mapped ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT : 0;
    uint32_t type = 0;
    while (!(request->memoryTypeBits >> type & 1) || (own->types.memoryTypes[type].propertyFlags & wanted) != wanted) type++;
    const VkMemoryAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = request->bytes, .memoryTypeIndex = type};
    TRUE(vkAllocateMemory(own->engine->device, &info, NULL, &allocation->memory) == VK_SUCCESS);
    if (is_mapped) {
        TRUE(vkMapMemory(own->engine->device, allocation->memory, 0, VK_WHOLE_SIZE, 0, &allocation->mapped) == VK_SUCCESS);
    }
    allocation->token = 7;
    own->live++;
    return VK_SUCCESS;
}

static void release(void *user, const SurfelAllocation *allocation) {
    Allocator *own = user;
    TRUE(allocation->token == 7 && allocation->offset == 0);
    own->live--;
    vkFreeMemory(own->engine->device, allocation->memory, NULL);
}

/* Ends an epoch of which nothing was submitted: what is left of the host's memory. */
static unsigned left_after(SurfelDevice *device, const Allocator *own) {
    uint64_t epoch;
    OK(surfel_device_end_epoch(device, &epoch));
    OK(surfel_device_epoch_done(device, epoch));
    return own->live;
}

typedef struct Told {
    unsigned pieces;
    uint64_t sum, bytes;
} Told;

static void tell(void *user, const SurfelMemoryRequest *request) {
    Told *told = user;
    TRUE(request->sType == SURFEL_STRUCTURE_TYPE_MEMORY_REQUEST && request->size == sizeof *request);
    add(&told->sum, request);
    told->pieces++;
    told->bytes += request->bytes;
}

/* What scene and view are told to need is what they ask for. */
static void needs_are_met(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer, Allocator *own) {
    const double centers[] = {-1, 0, 0, 1, 0, 0};
    const float normals[] = {0, 0, 1, 0, 0, 1}, radii[] = {1, 1}, colors[] = {1, 0, 0, 1, 0, 1, 0, 1};
    const SurfelSplats splats = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof splats, .count = 2, .centers = centers,
                                 .normals = normals, .radii = radii, .colors = colors, .colorCount = 2};
    SurfelScene *scene;
    OK(surfel_scene_create(NULL, &scene));
    OK(surfel_scene_add_splats(scene, &splats));
    SurfelMemoryNeeds needs = {.sType = SURFEL_STRUCTURE_TYPE_MEMORY_NEEDS, .size = sizeof needs};
    Told told = {0};
    SurfelPreparedScene *measured, *prepared;
    IS(INVALID_ARGUMENT, surfel_scene_needs(NULL, scene, 1, tell, &told, &needs, NULL), "renderer is NULL");
    IS(INVALID_ARGUMENT, surfel_scene_needs(renderer, NULL, 1, tell, &told, &needs, &measured), "scene is NULL");
    TRUE(measured == NULL);
    OK(surfel_scene_needs(renderer, scene, 1, NULL, NULL, NULL, NULL));
    OK(surfel_scene_needs(renderer, scene, 1, tell, &told, &needs, &measured));
    TRUE(told.pieces == 3 && needs.all.pieces == 3 && needs.ofDevice.pieces == 2 && needs.writtenByHost.pieces == 1);
    TRUE(needs.all.bytes >= told.bytes && needs.ofDevice.bytes >= 2 * 32 + 2 * 8 && needs.ofDevice.memoryTypeBits != 0);
    TRUE(own->asked == 0);
    OK(surfel_scene_needs(renderer, scene, 4096, NULL, NULL, &needs, NULL));
    TRUE(needs.all.alignment == 4096 && needs.all.bytes > 2 * 4096 && needs.all.bytes < 3 * 4096);

    const VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    const SurfelRendering rendering = {.sType = SURFEL_STRUCTURE_TYPE_RENDERING, .size = sizeof rendering, .colorFormats = &format,
                                       .colorFormatCount = 1, .depthFormat = VK_FORMAT_D32_SFLOAT};
    const SurfelPreparedScene *scenes[] = {measured};
    const SurfelFrame frame = frame_of(scenes, NULL);
    Told of_view = {0};
    OK(surfel_view_needs(renderer, &rendering, &frame, 1, tell, &of_view, &needs));
    TRUE(of_view.pieces == needs.all.pieces && of_view.pieces > 4 && needs.all.bytes >= of_view.bytes);
    IS(INVALID_ARGUMENT, surfel_view_needs(renderer, NULL, &frame, 1, tell, &of_view, &needs), "rendering is NULL");
    needs.size = 8;
    IS(INVALID_ARGUMENT, surfel_view_needs(renderer, &rendering, &frame, 1, NULL, NULL, &needs), "needs: size 8");
    TRUE(own->asked == 0);

    SurfelView *view = view_of(renderer);
    engine_begin(engine);
    IS(OPTION, surfel_view_prepare(view, engine->commands, &frame), "is on no device: it was measured alone");
    OK(surfel_upload(renderer, engine->commands, scene, &prepared));
    TRUE(own->asked == told.pieces && own->bytes == told.bytes && own->sum == told.sum);
    own->sum = own->bytes = own->asked = 0;
    scenes[0] = prepared;
    OK(surfel_view_prepare(view, engine->commands, &frame));
    TRUE(own->asked == of_view.pieces && own->bytes == of_view.bytes && own->sum == of_view.sum);
    engine_begin(engine);
    surfel_view_destroy(view);
    surfel_prepared_scene_destroy(prepared);
    surfel_prepared_scene_destroy(measured);
    surfel_scene_destroy(scene);
    uint64_t epoch;
    OK(surfel_device_end_epoch(device, &epoch));
    OK(surfel_device_epoch_done(device, epoch));
}

void memory(Engine *engine, SurfelImport host) {
    enum { ALL = 1000000 };
    Allocator own = {.engine = engine, .left = ALL};
    vkGetPhysicalDeviceMemoryProperties(engine->physical, &own.types);
    SurfelMemory of_host = {.sType = SURFEL_STRUCTURE_TYPE_MEMORY, .size = sizeof of_host, .user = &own, .allocate = allocate};
    host.memory = &of_host;
    SurfelDevice *device;
    IS(INVALID_ARGUMENT, surfel_device_import(&host, &device), "memory: free is NULL");
    of_host = (SurfelMemory){.sType = SURFEL_STRUCTURE_TYPE_MEMORY, .size = sizeof of_host, .user = &own, .free = release};
    IS(INVALID_ARGUMENT, surfel_device_import(&host, &device), "memory: allocate is NULL");
    of_host.allocate = allocate;
    OK(surfel_device_import(&host, &device));
    SurfelRenderer *renderer;
    OK(surfel_renderer_create(device, NULL, &renderer));
    needs_are_met(engine, device, renderer, &own);
    SurfelPreparedScene *ball = upload(engine, device, renderer, 1);
    TRUE(own.asked > 1 && own.live > 1);
    SurfelMemoryReport report = {.sType = SURFEL_STRUCTURE_TYPE_MEMORY_REPORT, .size = sizeof report};
    uint64_t used, held;
    OK(surfel_device_memory_report(device, &report));
    OK(surfel_device_memory(device, &used, &held));
    TRUE(report.buffers >= 1999 * 32 && report.idle == 0);
    TRUE(report.buffers + report.images + report.upload + report.readback == used && used == held);
    TRUE(report.heapCount == own.types.memoryHeapCount);
    for (uint32_t i = 0; i < report.heapCount; i++) {
        const SurfelMemoryHeap *heap = report.heaps + i;
        TRUE(heap->size == own.types.memoryHeaps[i].size && heap->budget > 0 && heap->budget <= heap->size);
        TRUE(heap->isLocal == (own.types.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT));
        TRUE(report.budgetsAreTold || (heap->usage == 0 && heap->budget == heap->size));
    }
    report.size = 8;
    IS(INVALID_ARGUMENT, surfel_device_memory_report(device, &report), "size 8");
    IS(INVALID_ARGUMENT, surfel_device_memory_report(NULL, &report), "device is NULL");
    const VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    const SurfelRendering rendering = {.sType = SURFEL_STRUCTURE_TYPE_RENDERING, .size = sizeof rendering,
                                       .colorFormats = &format, .colorFormatCount = 1,
                                       .depthFormat = VK_FORMAT_D32_SFLOAT};
    const SurfelPreparedScene *scenes[] = {ball};
    const SurfelFrame frame = {.sType = SURFEL_STRUCTURE_TYPE_FRAME, .size = sizeof frame, .scenes = scenes, .sceneCount = 1,
                               .width = WIDTH, .height = HEIGHT,
                               .viewFromWorld = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -4, 1},
                               .clipFromView = {2.0 * HEIGHT / WIDTH, 0, 0, 0, 0, -2, 0, 0, 0, 0, 0, -1, 0, 0, 0.1, 0}};
    /* Each request of a new view's frame is refused in turn, and the next frame works. */
    unsigned refused = 0;
    for (;; refused++) {
        SurfelView *view;
        OK(surfel_view_create(renderer, &rendering, &view));
        engine_begin(engine);
        own.left = refused;
        const SurfelResult result = surfel_view_prepare(view, engine->commands, &frame);
        own.left = ALL;
        if (result != SURFEL_RESULT_SUCCESS) {
            TRUE(result == SURFEL_RESULT_OUT_OF_MEMORY && strstr(surfel_last_error(), "the host's allocator answered"));
            engine_begin(engine);
            left_after(device, &own);
            OK(surfel_view_prepare(view, engine->commands, &frame));
        }
        engine_begin(engine);
        surfel_view_destroy(view);
        left_after(device, &own);
        if (result == SURFEL_RESULT_SUCCESS) break;
    }
    TRUE(refused > 2);
    surfel_prepared_scene_destroy(ball);
    surfel_renderer_destroy(renderer);
    TRUE(left_after(device, &own) == 0);
    surfel_device_destroy(device);
}
