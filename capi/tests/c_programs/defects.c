/* Splats that can't be drawn, told by what is wrong with them. */
#include <math.h>

#include "check.h"

void defects(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer) {
    enum { DISKS = 13, ELLIPSES = 12 };
    double centers[3 * DISKS] = {0};
    float normals[3 * DISKS] = {0}, radii[DISKS], colors[4 * DISKS], s[3 * ELLIPSES] = {0}, t[3 * ELLIPSES] = {0};
    for (int i = 0; i < DISKS; i++) {
        normals[3 * i + 2] = 1, radii[i] = 0.1f;
        for (int part = 0; part < 4; part++) colors[4 * i + part] = 1;
    }
    SurfelClip clips[ELLIPSES] = {{0}};
    for (int i = 0; i < ELLIPSES; i++) s[3 * i] = t[3 * i + 1] = 0.1f;
    /* One center, two normals, three radii; of ellipses four pairs of tangents, and six curves; five colors. */
    centers[0] = NAN;
    normals[5] = 0, normals[8] = INFINITY;
    radii[3] = 0, radii[4] = -1, radii[5] = NAN;
    for (int i = 6; i < 11; i++) colors[4 * i + 1] = NAN;
    for (int i = 0; i < 4; i++) t[3 * i + 1] = 0;
    for (int i = 4; i < 10; i++) clips[i].curveCount = 1, clips[i].curves[0].weight = -1;
    const SurfelSplats disks = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof disks, .count = DISKS, .centers = centers,
                                .normals = normals, .radii = radii, .colors = colors, .colorCount = DISKS};
    const double origin[3 * ELLIPSES] = {0};
    const SurfelSplats ellipses = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof ellipses, .count = ELLIPSES,
                                   .centers = origin, .tangentsS = s, .tangentsT = t, .clips = clips};
    SurfelScene *scene;
    OK(surfel_scene_create(NULL, &scene));
    OK(surfel_scene_add_splats(scene, &disks));
    OK(surfel_scene_add_splats(scene, &ellipses));
    SurfelPreparedScene *prepared = uploaded(engine, device, renderer, scene);
    SurfelPreparedSceneInfo info = {.sType = SURFEL_STRUCTURE_TYPE_PREPARED_SCENE_INFO, .size = sizeof info};
    OK(surfel_prepared_scene_info(prepared, &info));
    TRUE(info.splats == 4 && info.leftOut == 21);
    TRUE(info.leftOutCenters == 1 && info.leftOutNormals == 2 && info.leftOutRadii == 3);
    TRUE(info.leftOutTangents == 4 && info.leftOutColors == 5 && info.leftOutClips == 6);
    /* Of an older header nothing is written behind what that has. */
    SurfelPreparedSceneInfo older = {.sType = SURFEL_STRUCTURE_TYPE_PREPARED_SCENE_INFO, .size = 64, .leftOutCenters = 77};
    OK(surfel_prepared_scene_info(prepared, &older));
    TRUE(older.leftOut == 21 && older.leftOutCenters == 77);
    surfel_prepared_scene_destroy(prepared);
}
