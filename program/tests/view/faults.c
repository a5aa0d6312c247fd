/* A Vulkan layer in which calls fail: the file `SURFEL_FAULTS`, once it is there, has words in threes, the name of a function, which of its
 * calls it is, counted from 1 from then on, and the VkResult that this call answers. A device that was lost once stays so. Calls of the function that `SURFEL_COUNTED` names are told. One thread submits and
 * presents, so nothing is locked.
 * Calls of a device that can't present, which draws ahead of the window's, do not fail. `SURFEL_ASIDE` has such a device submit late (`slow`), or make a call that is not valid and does nothing (`wrong`). */
#define VK_NO_PROTOTYPES
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <threads.h>
#include <vulkan/vulkan.h>

#include <vulkan/vk_layer.h>

/* Handles of what can be called have their table first, which a device shares with its queues and an instance with its devices' descriptions. */
#define TABLE(handle) (*(void **)(handle))
#define MOST 16

typedef struct {
    void *table;
    PFN_vkGetInstanceProcAddr next;
    VkInstance raw;
    /* Asked for later, the loader would answer with the first layer's, which may be this one's. */
    PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR surface_facts;
} Instance;

typedef struct {
    void *table;
    PFN_vkGetDeviceProcAddr next;
    VkDevice raw;
    VkQueue queue;
    bool presents;
    bool lost;
    int swapchains;
} Device;

static Instance instances[MOST];
static Device devices[MOST];

static Instance *instance_of(const void *handle) {
    for (int i = 0; i < MOST; i++)
        if (instances[i].table == TABLE(handle)) return &instances[i];
    abort();
}

static Device *device_of(const void *handle) {
    for (int i = 0; i < MOST; i++)
        if (devices[i].table == TABLE(handle)) return &devices[i];
    abort();
}

/* What this call answers in the place of its own: VK_SUCCESS where it does not fail. */
static VkResult fault(const char *function, unsigned *calls) {
    char name[64];
    unsigned call;
    int answer;
    const char *counted = getenv("SURFEL_COUNTED");
    if (counted && strcmp(counted, function) == 0) fprintf(stderr, "called: %s\n", function);
    const char *path = getenv("SURFEL_FAULTS");
    FILE *faults = path ? fopen(path, "r") : NULL;
    if (!faults) return VK_SUCCESS;
    ++*calls;
    VkResult found = VK_SUCCESS;
    while (!found && fscanf(faults, " %63s %u %d", name, &call, &answer) == 3)
        if (call == *calls && strcmp(name, function) == 0) found = (VkResult)answer;
    fclose(faults);
    if (found) fprintf(stderr, "fault: %s %u %d\n", function, *calls, found);
    return found;
}

static VkResult fault_of(Device *device, const char *function, unsigned *calls) {
    if (!device->presents) return VK_SUCCESS;
    VkResult answer = device->lost ? VK_ERROR_DEVICE_LOST : fault(function, calls);
    if (answer == VK_ERROR_DEVICE_LOST) device->lost = true;
    return answer;
}

#define FAULT(device) \
    static unsigned calls; \
    VkResult answer = fault_of(device, __func__, &calls)
#define NEXT(device, function) ((PFN_##function)(device)->next((device)->raw, #function))

static void submit_aside(Device *device) {
    const char *how = getenv("SURFEL_ASIDE");
    if (!how) return;
    fprintf(stderr, "aside: %s\n", how);
    if (strcmp(how, "slow") == 0) thrd_sleep(&(struct timespec){.tv_sec = 4}, NULL);
    /* Of no fence at all. */
    if (strcmp(how, "wrong") == 0) NEXT(device, vkResetFences)(device->raw, 0, NULL);
}

static VKAPI_ATTR VkResult VKAPI_CALL vkQueueSubmit2(VkQueue queue, uint32_t count, const VkSubmitInfo2 *infos, VkFence fence) {
    Device *device = device_of(queue);
    FAULT(device);
    if (!device->presents) submit_aside(device);
    device->queue = queue;
    return answer ? answer : NEXT(device, vkQueueSubmit2)(queue, count, infos, fence);
}

static VKAPI_ATTR VkResult VKAPI_CALL vkWaitSemaphores(VkDevice raw, const VkSemaphoreWaitInfo *info, uint64_t timeout) {
    Device *device = device_of(raw);
    FAULT(device);
    return answer ? answer : NEXT(device, vkWaitSemaphores)(raw, info, timeout);
}

static VKAPI_ATTR VkResult VKAPI_CALL vkGetSemaphoreCounterValue(VkDevice raw, VkSemaphore semaphore, uint64_t *value) {
    Device *device = device_of(raw);
    FAULT(device);
    return answer ? answer : NEXT(device, vkGetSemaphoreCounterValue)(raw, semaphore, value);
}

/* These two tell of the loss when nothing runs any more. */
static VKAPI_ATTR VkResult VKAPI_CALL vkQueueWaitIdle(VkQueue queue) {
    Device *device = device_of(queue);
    FAULT(device);
    VkResult own = NEXT(device, vkQueueWaitIdle)(queue);
    return own ? own : answer;
}

static VKAPI_ATTR VkResult VKAPI_CALL vkDeviceWaitIdle(VkDevice raw) {
    Device *device = device_of(raw);
    FAULT(device);
    /* Validation layers of 1.3.239 crash here where an image was acquired that nothing was drawn to. */
    if (answer && device->queue) NEXT(device, vkQueueWaitIdle)(device->queue);
    return answer ? answer : NEXT(device, vkDeviceWaitIdle)(raw);
}

/* What fails acquires nothing; what is suboptimal does. */
static VKAPI_ATTR VkResult VKAPI_CALL vkAcquireNextImageKHR(VkDevice raw, VkSwapchainKHR swapchain, uint64_t timeout, VkSemaphore semaphore, VkFence fence,
                                                    uint32_t *index) {
    Device *device = device_of(raw);
    FAULT(device);
    if (answer && answer != VK_SUBOPTIMAL_KHR) return answer;
    VkResult own = NEXT(device, vkAcquireNextImageKHR)(raw, swapchain, timeout, semaphore, fence, index);
    return own ? own : answer;
}

/* Where the surface is at fault, semaphores are waited for all the same, and the image is given back. */
static VKAPI_ATTR VkResult VKAPI_CALL vkQueuePresentKHR(VkQueue queue, const VkPresentInfoKHR *info) {
    Device *device = device_of(queue);
    FAULT(device);
    if (answer == VK_ERROR_DEVICE_LOST) return answer;
    VkResult own = NEXT(device, vkQueuePresentKHR)(queue, info);
    return own ? own : answer;
}

/* As systems do that have one swapchain a window: a second one is refused that the first does not make way for. */
static VKAPI_ATTR VkResult VKAPI_CALL vkCreateSwapchainKHR(VkDevice raw, const VkSwapchainCreateInfoKHR *info, const VkAllocationCallbacks *allocator,
                                                   VkSwapchainKHR *made) {
    Device *device = device_of(raw);
    FAULT(device);
    if (answer) return answer;
    for (int i = 0; i < MOST; i++) {
        bool makes_way = &devices[i] == device && info->oldSwapchain;
        if (devices[i].swapchains && !makes_way) {
            fprintf(stderr, "fault: the window has another swapchain\n");
            return VK_ERROR_NATIVE_WINDOW_IN_USE_KHR;
        }
    }
    VkResult own = NEXT(device, vkCreateSwapchainKHR)(raw, info, allocator, made);
    if (!own) device->swapchains++;
    return own;
}

static VKAPI_ATTR void VKAPI_CALL vkDestroySwapchainKHR(VkDevice raw, VkSwapchainKHR swapchain, const VkAllocationCallbacks *allocator) {
    Device *device = device_of(raw);
    device->swapchains--;
    NEXT(device, vkDestroySwapchainKHR)(raw, swapchain, allocator);
}

static VKAPI_ATTR VkResult VKAPI_CALL vkGetPhysicalDeviceSurfaceCapabilitiesKHR(VkPhysicalDevice raw, VkSurfaceKHR surface, VkSurfaceCapabilitiesKHR *facts) {
    static unsigned calls;
    VkResult answer = fault(__func__, &calls);
    if (answer) return answer;
    return instance_of(raw)->surface_facts(raw, surface, facts);
}

static VKAPI_ATTR VkResult VKAPI_CALL vkCreateInstance(const VkInstanceCreateInfo *info, const VkAllocationCallbacks *allocator, VkInstance *made) {
    VkLayerInstanceCreateInfo *link = (VkLayerInstanceCreateInfo *)info->pNext;
    while (link->sType != VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO || link->function != VK_LAYER_LINK_INFO)
        link = (VkLayerInstanceCreateInfo *)link->pNext;
    PFN_vkGetInstanceProcAddr next = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    VkResult own = ((PFN_vkCreateInstance)next(NULL, "vkCreateInstance"))(info, allocator, made);
    if (own) return own;
    for (int i = 0; i < MOST; i++) {
        if (instances[i].table) continue;
        PFN_vkVoidFunction surface_facts = next(*made, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
        instances[i] = (Instance){TABLE(*made), next, *made, (PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR)surface_facts};
        return VK_SUCCESS;
    }
    abort();
}

static VKAPI_ATTR void VKAPI_CALL vkDestroyInstance(VkInstance raw, const VkAllocationCallbacks *allocator) {
    Instance *instance = instance_of(raw);
    PFN_vkDestroyInstance own = (PFN_vkDestroyInstance)instance->next(raw, "vkDestroyInstance");
    instance->table = NULL;
    own(raw, allocator);
}

static VKAPI_ATTR VkResult VKAPI_CALL vkCreateDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo *info, const VkAllocationCallbacks *allocator,
                                                    VkDevice *made) {
    VkLayerDeviceCreateInfo *link = (VkLayerDeviceCreateInfo *)info->pNext;
    while (link->sType != VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO || link->function != VK_LAYER_LINK_INFO)
        link = (VkLayerDeviceCreateInfo *)link->pNext;
    PFN_vkGetDeviceProcAddr next = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    Instance *instance = instance_of(physical);
    VkResult own = ((PFN_vkCreateDevice)instance->next(instance->raw, "vkCreateDevice"))(physical, info, allocator, made);
    if (own) return own;
    bool presents = false;
    for (uint32_t i = 0; i < info->enabledExtensionCount; i++)
        presents |= strcmp(info->ppEnabledExtensionNames[i], VK_KHR_SWAPCHAIN_EXTENSION_NAME) == 0;
    for (int i = 0; i < MOST; i++) {
        if (devices[i].table) continue;
        devices[i] = (Device){.table = TABLE(*made), .next = next, .raw = *made, .presents = presents};
        return VK_SUCCESS;
    }
    abort();
}

static VKAPI_ATTR void VKAPI_CALL vkDestroyDevice(VkDevice raw, const VkAllocationCallbacks *allocator) {
    Device *device = device_of(raw);
    PFN_vkDestroyDevice own = NEXT(device, vkDestroyDevice);
    device->table = NULL;
    own(raw, allocator);
}

#define OWN(function) \
    if (strcmp(name, #function) == 0) return (PFN_vkVoidFunction)function

static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetDeviceProcAddr(VkDevice raw, const char *name) {
    OWN(vkGetDeviceProcAddr);
    OWN(vkDestroyDevice);
    OWN(vkQueueSubmit2);
    OWN(vkWaitSemaphores);
    OWN(vkGetSemaphoreCounterValue);
    OWN(vkQueueWaitIdle);
    OWN(vkDeviceWaitIdle);
    OWN(vkAcquireNextImageKHR);
    OWN(vkQueuePresentKHR);
    OWN(vkCreateSwapchainKHR);
    OWN(vkDestroySwapchainKHR);
    return device_of(raw)->next(raw, name);
}

static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance raw, const char *name) {
    OWN(vkGetInstanceProcAddr);
    OWN(vkCreateInstance);
    OWN(vkDestroyInstance);
    OWN(vkCreateDevice);
    OWN(vkGetDeviceProcAddr);
    OWN(vkGetPhysicalDeviceSurfaceCapabilitiesKHR);
    return raw ? instance_of(raw)->next(raw, name) : NULL;
}

VKAPI_ATTR VkResult VKAPI_CALL vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface *interface) {
    interface->loaderLayerInterfaceVersion = 2;
    interface->pfnGetInstanceProcAddr = vkGetInstanceProcAddr;
    interface->pfnGetDeviceProcAddr = vkGetDeviceProcAddr;
    interface->pfnGetPhysicalDeviceProcAddr = NULL;
    return VK_SUCCESS;
}
