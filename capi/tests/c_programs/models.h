/* Programs that have no device of their own. */
#ifndef MODELS_H
#define MODELS_H

#include "check.h"

static inline SurfelScene *empty(void) {
    SurfelScene *scene;
    OK(surfel_scene_create(NULL, &scene));
    return scene;
}

static inline SurfelSceneContents contents_of(const SurfelScene *scene) {
    SurfelSceneContents contents = {.sType = SURFEL_STRUCTURE_TYPE_SCENE_CONTENTS, .size = sizeof contents};
    OK(surfel_scene_contents(scene, &contents));
    return contents;
}

/* Files read, written and made. `saved`: where a file may be. */
void models(const char *saved);
/* A scene file that names such a file, from another folder, and one whose camera looks at an object by name from where its picture is filled. */
void scene_files(const char *scene_file, const char *fitted);

#endif
