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
