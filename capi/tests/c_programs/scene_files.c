/* Scene files without a device: what they hold, and what they say of the picture. */
#include "models.h"

/* A scene file, which describes its objects itself; a file outside of its folder is opened only if that is allowed. */
void scene_files(const char *scene_file, const char *fitted) {
    SurfelScene *scene = empty();
    SurfelLoadOptions options = {.sType = SURFEL_STRUCTURE_TYPE_LOAD_OPTIONS, .size = sizeof options};
    const SurfelDescription description = {.sType = SURFEL_STRUCTURE_TYPE_DESCRIPTION, .size = sizeof description};
    IS(INPUT, surfel_scene_add_file_as(scene, scene_file, &options, NULL), "outside");
    IS(INPUT, surfel_scene_add_file(scene, scene_file), "outside");
    options.allowOutside = VK_TRUE;
    IS(INVALID_ARGUMENT, surfel_scene_add_file_as(scene, scene_file, &options, &description), "description: expected NULL");
    TRUE(contents_of(scene).objects == 0);
    OK(surfel_scene_add_file_as(scene, scene_file, &options, NULL));
    TRUE(contents_of(scene).objects == 1 && contents_of(scene).splats == 12);
    /* What it says of camera and picture, and what it leaves open. */
    SurfelCamera camera = {.sType = SURFEL_STRUCTURE_TYPE_CAMERA, .size = sizeof camera};
    SurfelSettings *settings;
    OK(surfel_settings_create(&settings));
    IS(INPUT, surfel_scene_file_camera(scene, scene_file, NULL, 64, 48, &camera, settings), "outside");
    OK(surfel_scene_file_camera(scene, scene_file, &options, 64, 48, &camera, NULL));
    TRUE(camera.eye[2] == 9 && camera.target[2] == 0 && camera.up[1] == 1 && camera.fovYRad > 1.04 && camera.fovYRad < 1.05);
    char shading[16];
    uint64_t length;
    OK(surfel_settings_get(settings, "shading", shading, sizeof shading, &length));
    TRUE(strcmp(shading, "phong") == 0);
    OK(surfel_scene_file_camera(scene, scene_file, &options, 64, 48, &camera, settings));
    OK(surfel_settings_get(settings, "shading", shading, sizeof shading, &length));
    TRUE(strcmp(shading, "lambert") == 0);
    SurfelScene *nothing = empty();
    IS(INVALID_ARGUMENT, surfel_scene_file_camera(nothing, scene_file, &options, 64, 48, &camera, NULL), "there is nothing in the scene");
    surfel_scene_destroy(nothing);
    /* Of an object beside another one, and for a picture of its size. */
    const double center[3] = {100, 0, 0};
    const float normal[3] = {0, 0, 1}, radius = 1;
    const SurfelSplats beside = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof beside, .count = 1, .centers = center,
                                 .normals = normal, .radii = &radius};
    OK(surfel_scene_add_splats(scene, &beside));
    IS(INPUT, surfel_scene_file_camera(scene, fitted, &options, 64, 48, &camera, NULL), "no object is called 'box'");
    OK(surfel_scene_add_file_as(scene, fitted, &options, NULL));
    OK(surfel_scene_file_camera(scene, fitted, &options, 64, 48, &camera, NULL));
    const double wide = camera.eye[2];
    TRUE(camera.target[0] > -1 && camera.target[0] < 1 && wide > 1 && wide < 20);
    OK(surfel_scene_file_camera(scene, fitted, &options, 48, 64, &camera, NULL));
    TRUE(camera.eye[2] > 1.2 * wide);
    surfel_settings_destroy(settings);
    surfel_scene_destroy(scene);
}
