/* What objects of a scene on the device are called, also where there is less room than a name takes. */
#include <string.h>

#include "check.h"

void names(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer) {
    const double center[3] = {0};
    const float normal[3] = {0, 0, 1}, radius[1] = {0.1f};
    SurfelSplats splats = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof splats, .count = 1, .centers = center,
                           .normals = normal, .radii = radius, .name = "first"};
    SurfelScene *scene;
    OK(surfel_scene_create(NULL, &scene));
    OK(surfel_scene_add_splats(scene, &splats));
    splats.name = "second";
    OK(surfel_scene_add_splats(scene, &splats));
    SurfelPreparedScene *prepared = uploaded(engine, device, renderer, scene);
    uint64_t length = 77;
    char name[8];
    OK(surfel_prepared_scene_object_name(prepared, 1, NULL, 0, &length));
    TRUE(length == 6);
    OK(surfel_prepared_scene_object_name(prepared, 0, name, sizeof name, &length));
    TRUE(length == 5 && strcmp(name, "first") == 0);
    memset(name, 'x', sizeof name);
    OK(surfel_prepared_scene_object_name(prepared, 1, name, 4, &length));
    TRUE(length == 6 && memcmp(name, "sec\0xxxx", sizeof name) == 0);
    IS(INVALID_ARGUMENT, surfel_prepared_scene_object_name(prepared, 2, name, 4, &length), "object 2: the scene has 2");
    IS(INVALID_ARGUMENT, surfel_prepared_scene_object_name(prepared, 0, NULL, 4, &length), "name is NULL");
    IS(INVALID_ARGUMENT, surfel_prepared_scene_object_name(prepared, 0, name, 4, NULL), "length is NULL");
    surfel_prepared_scene_destroy(prepared);
}
