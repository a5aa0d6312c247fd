/* What a call must answer, and what must be. */
#ifndef CHECK_H
#define CHECK_H

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

/* Submits what is recorded, with nothing drawn after it, and waits; the epoch is done then. */
static inline void run_without_drawing(Engine *engine, SurfelDevice *device) {
    engine_begin_rendering(engine, 1);
    engine_end_rendering(engine);
    engine_submit(engine);
    uint64_t epoch;
    OK(surfel_device_end_epoch(device, &epoch));
    OK(surfel_device_epoch_done(device, epoch));
}

/* Brings a scene to the device, and destroys it; the copies have run then. */
static inline SurfelPreparedScene *uploaded(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer, SurfelScene *scene) {
    SurfelPreparedScene *prepared;
    engine_begin(engine);
    OK(surfel_upload(renderer, engine->commands, scene, &prepared));
    surfel_scene_destroy(scene);
    run_without_drawing(engine, device);
    return prepared;
}

/* Draws a frame behind what is recorded, submits, and waits; the epoch is done then. */
static inline void draw_behind(Engine *engine, SurfelDevice *device, SurfelView *view, const SurfelFrame *frame) {
    OK(surfel_view_prepare(view, engine->commands, frame));
    engine_begin_rendering(engine, 1);
    OK(surfel_view_draw(view, engine->commands));
    engine_end_rendering(engine);
    engine_submit(engine);
    uint64_t epoch;
    OK(surfel_device_end_epoch(device, &epoch));
    OK(surfel_device_epoch_done(device, epoch));
}

/* The same; how many pixels are not as the first one is, which nothing covers. */
static inline int seen(Engine *engine, SurfelDevice *device, SurfelView *view, SurfelFrame *frame) {
    draw_behind(engine, device, view, frame);
    int count = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) count += memcmp(engine->pixels + 4 * i, engine->pixels, 16) != 0;
    return count;
}

/* Draws a frame alone, submits, and waits. */
static inline void draw_alone(Engine *engine, SurfelDevice *device, SurfelView *view, const SurfelFrame *frame) {
    engine_begin(engine);
    draw_behind(engine, device, view, frame);
}

/* A view onto the engine's picture and depth. */
static inline SurfelView *view_of(SurfelRenderer *renderer) {
    const VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    const SurfelRendering rendering = {.sType = SURFEL_STRUCTURE_TYPE_RENDERING, .size = sizeof rendering,
                                       .colorFormats = &format, .colorFormatCount = 1, .depthFormat = VK_FORMAT_D32_SFLOAT};
    SurfelView *view;
    OK(surfel_view_create(renderer, &rendering, &view));
    return view;
}

/* Colors as they are, by tiles. */
static inline SurfelSettings *albedo_by_tiles(void) {
    SurfelSettings *settings;
    OK(surfel_settings_create(&settings));
    OK(surfel_settings_set(settings, "shading", "albedo"));
    OK(surfel_settings_set(settings, "rasterizer", "compute"));
    return settings;
}

/* A frame of one scene, from 4 in front of its middle. */
static inline SurfelFrame frame_of(const SurfelPreparedScene *const *scene, const SurfelSettings *settings) {
    const SurfelFrame frame = {.sType = SURFEL_STRUCTURE_TYPE_FRAME, .size = sizeof frame, .scenes = scene, .sceneCount = 1,
                               .settings = settings, .width = WIDTH, .height = HEIGHT,
                               .viewFromWorld = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -4, 1},
                               .clipFromView = {2.0 * HEIGHT / WIDTH, 0, 0, 0, 0, -2, 0, 0, 0, 0, 0, -1, 0, 0, 0.1, 0}};
    return frame;
}

/* A ball of 2000 splats, one of which can't be drawn. */
SurfelPreparedScene *upload(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer, float alpha);
/* Frames of what is transparent, refused and drawn; then what is given is destroyed, in order, or else in an order of no sense. `foreign` is
 * of another device. */
void frames(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer, const SurfelPreparedScene *foreign,
            int in_order);
/* Splats that are copied to the device: a ball of which the second frame shows one half. */
void dynamic(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer);
/* Frames alike, which take nothing from the heap; by two calls, and by one. */
void steady(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer);
/* Splats that change, tints, and whose a pixel is and how it has moved: of two balls, one of which moves, and then of the camera. */
void objects(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer);
/* Splats that are added and taken out. */
void rooms(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer);
/* Levels of detail of the host's own. */
void levels(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer);
/* Splats that can't be drawn. */
void defects(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer);
/* Lights that change. */
void lights(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer);
/* What objects are called. */
void names(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer);
/* Levels of detail of triangles. */
void hybrid(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer);
/* Triangles, clip curves, a left-handed world, and pipelines one after the other. */
void shapes(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer);
/* All memory is the host's, and what it refuses is an error after which the next frame works. */
void memory(Engine *engine, SurfelImport host);

#endif
