/* An engine in small: its own instance, device, images and things, with nothing of surfel. */
#ifndef ENGINE_H
#define ENGINE_H

#include <vulkan/vulkan.h>

#define WIDTH 640
#define HEIGHT 480

/* An image, its memory and its view. */
typedef struct Attachment {
    VkImage image;
    VkDeviceMemory memory;
    VkImageView view;
} Attachment;

typedef struct Engine {
    VkInstance instance;
    VkPhysicalDevice physical;
    VkDevice device;
    /* Where all is recorded. */
    VkCommandBuffer commands;
    /* Linear light, in VK_FORMAT_R32G32B32A32_SFLOAT. */
    Attachment color;
    /* VK_FORMAT_D32_SFLOAT, reversed: 0 is infinitely far. */
    Attachment depth;
    /* What the device is created with, by engine_open; others may add to it. */
    VkPhysicalDeviceFeatures core;
    VkPhysicalDeviceVulkan12Features vulkan12;
    VkPhysicalDeviceVulkan13Features vulkan13;
    uint32_t family;
    /* How often the validation layer has spoken. */
    uint32_t messages;
    VkDebugUtilsMessengerEXT messenger;
    VkQueue queue;
    VkCommandPool pool;
    VkFence fence;
    VkBuffer readback;
    VkDeviceMemory readback_memory;
    const float *pixels;
} Engine;

/* An instance under validation (core and synchronization), and the first physical device. */
Engine *engine_new(void);
/* The device, with a queue of this family. */
void engine_open(Engine *engine, uint32_t family);
void engine_begin(Engine *engine);
/* Begins to draw over nothing, or over what there is. */
void engine_begin_rendering(Engine *engine, int clears);
/* Draws a board that faces the camera: an orange rectangle at a depth. */
void engine_board(Engine *engine, VkRect2D where, float depth);
void engine_end_rendering(Engine *engine);
/* Submits, waits, and has the picture in `pixels`: red, green, blue and alpha of each, the top row first. */
void engine_submit(Engine *engine);
/* A file of three floats a pixel (PFM). */
void engine_save(const Engine *engine, const char *path);
void engine_free(Engine *engine);

/* Points of a ball of radius 1, spread evenly; they are its normals, too. */
void engine_ball(uint64_t count, double *centers, float *normals, float *radii);

#endif
