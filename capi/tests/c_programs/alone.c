/* A program without a device of its own: models, and pictures of ours. Arguments: a PLY file to write, a scene file that names it, a PNG file, an
 * EXR file and one of raw bytes to write. */
#include "models.h"

enum { SIDE = 96, PIXELS = SIDE * SIDE };

static void count(void *user, const SurfelPassFigures *figures) {
    TRUE(figures->name[0] != 0 && figures->secs >= 0);
    ++*(unsigned *)user;
}

static void pictures(const char *png, const char *exr, const char *raw) {
    SurfelHeadless *headless;
    SurfelHeadlessInfo info = {.sType = SURFEL_STRUCTURE_TYPE_HEADLESS_INFO, .size = sizeof info, .device = "no such device"};
    IS(OPTION, surfel_headless_create(&info, &headless), "device: 'no such device' is none of");
    TRUE(headless == NULL);
    info.device = NULL;
    info.validates = VK_TRUE;
    OK(surfel_headless_create(&info, &headless));
    char name[256];
    uint64_t length, messages, used, held;
    OK(surfel_headless_device_name(headless, name, sizeof name, &length));
    TRUE(length > 0 && strlen(name) == length);

    /* Four splats, seen from the front. */
    const double centers[] = {-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0};
    const float normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, radii[] = {0.9f, 0.9f, 0.9f, 0.9f};
    const float colors[] = {1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 1, 1, 0, 1};
    const SurfelSplats splats = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof splats, .count = 4, .centers = centers,
                                 .normals = normals, .radii = radii, .colors = colors, .colorCount = 4};
    SurfelScene *scene;
    OK(surfel_scene_create(NULL, &scene));
    OK(surfel_scene_add_splats(scene, &splats));
    double center[3], radius;
    OK(surfel_scene_ball(scene, center, &radius));
    SurfelPreparedScene *prepared;
    OK(surfel_headless_prepare(headless, scene, NULL, &prepared));
    surfel_scene_destroy(scene);

    SurfelCamera camera = {.sType = SURFEL_STRUCTURE_TYPE_CAMERA, .size = sizeof camera};
    OK(surfel_camera_fit(center, radius, SIDE, SIDE, 0, &camera));
    TRUE(camera.eye[2] > radius && camera.up[1] == 1 && camera.fovYRad > 0.78 && camera.fovYRad < 0.79);
    IS(OPTION, surfel_camera_fit(center, radius, SIDE, SIDE, 4, &camera), "fov");
    SurfelSettings *settings;
    OK(surfel_settings_create(&settings));
    OK(surfel_settings_set(settings, "shading", "albedo"));
    SurfelHeadlessFrame frame = {.sType = SURFEL_STRUCTURE_TYPE_HEADLESS_FRAME, .size = sizeof frame, .scene = prepared, .camera = &camera,
                                 .settings = settings, .width = SIDE, .height = SIDE};
    SurfelPicture picture = {.sType = SURFEL_STRUCTURE_TYPE_PICTURE, .size = sizeof picture};
    OK(surfel_headless_render(headless, &frame, &picture));
    TRUE(picture.width == SIDE && picture.height == SIDE && picture.srgb && !picture.linear && !picture.depth);
    TRUE(picture.wallSecs > 0 && picture.recordSecs > 0);
    unsigned passes = 0;
    double span;
    OK(surfel_headless_measured(headless, count, &passes, &span));
    TRUE(passes == 0 && span < 0);
    FILE *file = fopen(raw, "wb");
    TRUE(file && fwrite(picture.srgb, 4, PIXELS, file) == PIXELS && fclose(file) == 0);
    OK(surfel_save_png(png, SIDE, SIDE, 4, picture.srgb));
    IS(OPTION, surfel_save_png(png, SIDE, SIDE, 2, picture.srgb), "2 channels, expected 3 or 4");
    IS(OPTION, surfel_save_png(png, 0, SIDE, 4, picture.srgb), "0x96 pixels");
    IS(INVALID_ARGUMENT, surfel_save_png(png, SIDE, SIDE, 4, NULL), "pixels is NULL");

    frame.linear = frame.surface = VK_TRUE;
    frame.measures = SURFEL_MEASURE_TIMES;
    OK(surfel_headless_render(headless, &frame, &picture));
    TRUE(!picture.srgb && picture.linear && picture.weight && picture.albedo && picture.normal && picture.depth);
    const float *red = picture.albedo + 4 * (SIDE * (SIDE / 4 * 3) + SIDE / 4);
    TRUE(red[0] == 1 && red[1] == 0 && red[3] == 1);
    TRUE(picture.depth[0] > 1e30f && picture.normal[4 * (SIDE * (SIDE / 4) + SIDE / 4) + 2] == -1);
    OK(surfel_headless_measured(headless, count, &passes, &span));
    TRUE(passes > 1 && span > 0);
    const char *rgba[] = {"R", "G", "B", "A"}, *twice[] = {"R", "R", "B", "A"};
    OK(surfel_save_exr(exr, SIDE, SIDE, rgba, 4, picture.linear));
    IS(OPTION, surfel_save_exr(exr, SIDE, SIDE, twice, 4, picture.linear), "'R' can't be the name of a channel");

    /* What can't be drawn, after which the next picture works. */
    frame.width = 0;
    IS(OPTION, surfel_headless_render(headless, &frame, &picture), "size");
    frame.width = SIDE;
    frame.measures = 9;
    IS(INVALID_ARGUMENT, surfel_headless_render(headless, &frame, &picture), "measures is 9");
    frame.measures = 0;
    const SurfelCamera nowhere = {.sType = SURFEL_STRUCTURE_TYPE_CAMERA, .size = sizeof nowhere};
    frame.camera = &nowhere;
    IS(OPTION, surfel_headless_render(headless, &frame, &picture), "camera: eye and target must be two different points");
    frame.camera = NULL;
    IS(INVALID_ARGUMENT, surfel_headless_render(headless, &frame, &picture), "camera is NULL");
    frame.camera = &camera;
    frame.withoutPicture = VK_TRUE;
    OK(surfel_headless_render(headless, &frame, &picture));
    TRUE(!picture.linear && picture.depth);

    SurfelDevice *device;
    OK(surfel_headless_device(headless, &device));
    /* A picture that needs less has less once what was there is given back. */
    uint64_t left;
    frame.width = frame.height = 8;
    OK(surfel_headless_render(headless, &frame, &picture));
    OK(surfel_device_memory(device, &used, &held));
    OK(surfel_headless_forget(headless));
    OK(surfel_headless_render(headless, &frame, &picture));
    OK(surfel_device_memory(device, &left, &held));
    TRUE(left < used && left > 0);
    OK(surfel_headless_messages(headless, &messages));
    TRUE(messages == 0);
    /* A scene of another device is refused. */
    SurfelHeadless *other;
    OK(surfel_headless_create(NULL, &other));
    IS(OPTION, surfel_headless_render(other, &frame, &picture), "another device");
    surfel_headless_destroy(other);
    surfel_settings_destroy(settings);
    surfel_headless_destroy(headless);
    surfel_prepared_scene_destroy(prepared);
    surfel_device_destroy(device);
}

int main(int argc, char **argv) {
    if (argc != 7) return 1;
    models(argv[1]);
    scene_files(argv[2], argv[3]);
    pictures(argv[4], argv[5], argv[6]);
    return 0;
}
