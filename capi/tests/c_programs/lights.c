/* Lights of a scene on the device, from frame to frame. */
#include "check.h"

/* The blue of the middle of a ball. */
static float middle(Engine *engine, SurfelDevice *device, SurfelView *view, const SurfelFrame *frame) {
    draw_alone(engine, device, view, frame);
    return engine->pixels[4 * (HEIGHT / 2 * WIDTH + WIDTH / 2) + 2];
}

void lights(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer) {
    SurfelPreparedScene *ball = upload(engine, device, renderer, 1);
    SurfelView *view = view_of(renderer);
    SurfelSettings *settings;
    OK(surfel_settings_create(&settings));
    OK(surfel_settings_set(settings, "shading", "lambert"));
    const SurfelPreparedScene *scenes[] = {ball};
    const SurfelFrame frame = frame_of(scenes, settings);
    /* What is not shone on has a tenth of its color. */
    const float at_eye = middle(engine, device, view, &frame);
    TRUE(at_eye > 0.5f);
    const char *half[] = {"direction=0,0,-1,intensity=0.25", "direction=0,0,-2,intensity=0.25"}, *black[] = {"eye,intensity=0"};
    OK(surfel_prepared_scene_set_lights(ball, half, 2));
    const float by_two = middle(engine, device, view, &frame);
    TRUE(by_two > 0.54f * at_eye && by_two < 0.56f * at_eye);
    OK(surfel_prepared_scene_set_lights(ball, black, 1));
    const float dark = middle(engine, device, view, &frame);
    TRUE(dark > 0.09f * at_eye && dark < 0.11f * at_eye);

    /* What is refused changes nothing. */
    const char *wrong[] = {"eye", "moon"}, *none[] = {NULL};
    IS(OPTION, surfel_prepared_scene_set_lights(ball, wrong, 2), "'moon': expected eye or direction");
    IS(OPTION, surfel_prepared_scene_set_lights(ball, wrong, 17), "17 of them: expected at most 16");
    IS(INVALID_ARGUMENT, surfel_prepared_scene_set_lights(ball, NULL, 1), "lights is NULL");
    IS(INVALID_ARGUMENT, surfel_prepared_scene_set_lights(ball, none, 1), "a light is NULL");
    IS(INVALID_ARGUMENT, surfel_prepared_scene_set_lights(NULL, NULL, 0), "scene is NULL");
    TRUE(middle(engine, device, view, &frame) == dark);
    OK(surfel_prepared_scene_set_lights(ball, NULL, 0));
    TRUE(middle(engine, device, view, &frame) == at_eye);
    surfel_settings_destroy(settings);
    surfel_view_destroy(view);
    surfel_prepared_scene_destroy(ball);
}
