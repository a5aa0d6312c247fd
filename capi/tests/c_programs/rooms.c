#include <math.h>

#include "check.h"

enum { COUNT = 2000 };

/* Splats come to an object of none, and go again. */
void rooms(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer) {
    static double centers[3 * COUNT];
    static float normals[3 * COUNT], radii[COUNT];
    engine_ball(COUNT, centers, normals, radii);
    for (int i = 0; i < COUNT; i++) centers[3 * i] += 5e5;
    const float color[] = {0, 0.5f, 1, 1};
    SurfelRoom room = {.sType = SURFEL_STRUCTURE_TYPE_ROOM, .size = sizeof room, .splats = COUNT + 7, .hasAround = VK_TRUE,
                       .around = {5e5, 0, 0}, .overlap = 1.5};
    SurfelSplats splats = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof splats, .centers = centers,
                           .normals = normals, .radii = radii, .colors = color, .colorCount = 1, .room = &room};
    SurfelSceneInfo made = {.sType = SURFEL_STRUCTURE_TYPE_SCENE_INFO, .size = sizeof made};
    SurfelScene *scene;
    SurfelPreparedScene *prepared;
    OK(surfel_scene_create(&made, &scene));
    OK(surfel_scene_add_splats(scene, &splats));
    engine_begin(engine);
    IS(OPTION, surfel_upload(renderer, engine->commands, scene, &prepared), "room of object 0: expected a scene with Scene::updatable");
    surfel_scene_destroy(scene);
    made.updatable = made.numbered = VK_TRUE;
    OK(surfel_scene_create(&made, &scene));
    room.sType = SURFEL_STRUCTURE_TYPE_SPLATS;
    IS(UNKNOWN_STRUCT, surfel_scene_add_splats(scene, &splats), "room: sType 5: expected 15 (Room)");
    room.sType = SURFEL_STRUCTURE_TYPE_ROOM;
    OK(surfel_scene_add_splats(scene, &splats));
    OK(surfel_upload(renderer, engine->commands, scene, &prepared));
    surfel_scene_destroy(scene);
    splats.room = NULL;

    SurfelView *view = view_of(renderer);
    const SurfelPreparedScene *scenes[] = {prepared};
    SurfelFrame frame = {.sType = SURFEL_STRUCTURE_TYPE_FRAME, .size = sizeof frame, .scenes = scenes, .sceneCount = 1,
                         .width = WIDTH, .height = HEIGHT,
                         .viewFromWorld = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -5e5, 0, -4, 1},
                         .clipFromView = {2.0 * HEIGHT / WIDTH, 0, 0, 0, 0, -2, 0, 0, 0, 0, 0, -1, 0, 0, 0.1, 0}};
    TRUE(seen(engine, device, view, &frame) == 0);
    uint32_t left = 0, first = 9;
    OK(surfel_room_of(prepared, 0, &left));
    TRUE(left == COUNT + 7);
    OK(surfel_room_of(prepared, 1, &left));
    TRUE(left == 0);
    engine_begin(engine);
    splats.count = COUNT;
    OK(surfel_append(renderer, engine->commands, prepared, 0, &splats, &first));
    TRUE(first == 0);
    const int whole = seen(engine, device, view, &frame);
    /* What is seen in the middle, and beside the ball: of the scene as it stands, moved and twice as large, and in a left-handed world. */
    const double moved[] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, -5e5, 0, 0, 1};
    const SurfelFrame right_handed = frame;
    for (int round = 0; round < 3; round++) {
        SurfelPicked there = {.sType = SURFEL_STRUCTURE_TYPE_PICKED, .size = sizeof there}, beside = there;
        SurfelPick *picks[2];
        const uint32_t at[] = {WIDTH / 2, 3};
        frame = right_handed;
        if (round == 1) frame.worldFromScene = moved;
        if (round == 2) frame.leftHanded = VK_TRUE, frame.viewFromWorld[14] = 4, frame.clipFromView[11] = 1;
        engine_begin(engine);
        for (int i = 0; i < 2; i++) OK(surfel_pick(device, renderer, engine->commands, &frame, 0, at[i], HEIGHT / 2, picks + i));
        run_without_drawing(engine, device);
        OK(surfel_pick_read(picks[0], prepared, &there));
        OK(surfel_pick_read(picks[1], prepared, &beside));
        for (int i = 0; i < 2; i++) surfel_pick_destroy(picks[i]);
        const double radius = round == 1 ? 2 : 1, toward_eye = round == 2 ? -1 : 1;
        TRUE(there.kind == SURFEL_PICKED_SPLAT && there.object == 0 && there.number < COUNT);
        TRUE(fabs(there.position[0] - 5e5) < 0.05 && fabs(there.position[1]) < 0.05 && fabs(there.position[2] - toward_eye * radius) < 0.05);
        TRUE(toward_eye * there.normal[2] > 0.98 && fabs(there.distance - (4 - radius)) < 0.05 && fabs(there.depth - there.distance) < 0.01);
        TRUE(fabs(there.position[0] - 5e5 - radius * (centers[3 * there.number] - 5e5)) < 0.2 && fabs(centers[3 * there.number + 2] - 1) < 0.1);
        TRUE(beside.kind == SURFEL_PICKED_NOTHING && beside.number == 0 && beside.distance == 0);
    }
    /* A mirror shows on the one side of its picture what is seen on the other without it. */
    double across[2];
    for (int mirrored = 0; mirrored < 2; mirrored++) {
        SurfelPicked there = {.sType = SURFEL_STRUCTURE_TYPE_PICKED, .size = sizeof there};
        SurfelPick *pick;
        frame = right_handed;
        if (mirrored) frame.mirrored = VK_TRUE, frame.viewFromWorld[0] = -1, frame.viewFromWorld[12] = 5e5;
        engine_begin(engine);
        OK(surfel_pick(device, renderer, engine->commands, &frame, 0, WIDTH * 5 / 8, HEIGHT / 2, &pick));
        run_without_drawing(engine, device);
        OK(surfel_pick_read(pick, prepared, &there));
        surfel_pick_destroy(pick);
        TRUE(there.kind == SURFEL_PICKED_SPLAT);
        across[mirrored] = there.position[0] - 5e5;
    }
    TRUE(across[0] > 0.2 && fabs(across[0] + across[1]) < 0.02);
    frame = right_handed;
    SurfelPick *none;
    engine_begin(engine);
    IS(INVALID_ARGUMENT, surfel_pick(device, renderer, engine->commands, &frame, 1, 0, 0, &none), "scene 1: the frame has 1");
    IS(OPTION, surfel_pick(device, renderer, engine->commands, &frame, 0, WIDTH, 0, &none), "expected a pixel of");
    IS(INVALID_ARGUMENT, surfel_pick_read(NULL, prepared, NULL), "pick is NULL");
    TRUE(none == NULL);
    engine_begin(engine);
    splats.count = 8;
    IS(OPTION, surfel_append(renderer, engine->commands, prepared, 0, &splats, &first), "8 splats behind number 2000 of object 0: it has room up to 2007");
    IS(OPTION, surfel_append(renderer, engine->commands, prepared, 1, &splats, &first), "object 1 has no room");
    IS(INVALID_ARGUMENT, surfel_append(renderer, VK_NULL_HANDLE, prepared, 0, &splats, NULL), "commands is NULL");
    splats.count = 7;
    OK(surfel_append(renderer, engine->commands, prepared, 0, &splats, &first));
    TRUE(first == COUNT);
    OK(surfel_room_of(prepared, 0, &left));
    TRUE(left == 0);
    /* The ball of engine.c begins at one pole. */
    OK(surfel_remove(renderer, engine->commands, prepared, 0, COUNT / 2, COUNT / 2 + 7));
    const int half = seen(engine, device, view, &frame);
    engine_begin(engine);
    IS(OPTION, surfel_remove(renderer, engine->commands, prepared, 0, COUNT, 8), "2000..2008 of object 0: expected numbers in order up to 2007");
    IS(INVALID_ARGUMENT, surfel_remove(renderer, engine->commands, prepared, 0, 1, UINT32_MAX), "splats from 1 on");
    OK(surfel_remove(renderer, engine->commands, prepared, 0, 0, COUNT + 7));
    TRUE(seen(engine, device, view, &frame) == 0);
    if (whole < 20000 || half < whole / 4 || half > whole * 3 / 4) {
        printf("%d pixels of a ball, %d of its half\n", whole, half);
        exit(1);
    }
    surfel_view_destroy(view);
    surfel_prepared_scene_destroy(prepared);
}
