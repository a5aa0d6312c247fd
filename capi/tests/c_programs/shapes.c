#include <math.h>

#include "check.h"

enum { COUNT = 2000, CORNERS = 3 };

/* What a scene is made of, in a right-handed world or, mirrored, in a left-handed one. */
typedef struct Shapes {
    double centers[3 * COUNT], corners[3 * CORNERS];
    float normals[3 * COUNT], radii[COUNT];
    uint32_t triangle[3];
} Shapes;

static void make(Shapes *shapes, int left_handed) {
    engine_ball(COUNT, shapes->centers, shapes->normals, shapes->radii);
    const double corners[] = {-1.6, -0.9, 0.3, 1.6, -0.9, 0.5, 0.2, 1.4, -0.4};
    memcpy(shapes->corners, corners, sizeof corners);
    for (int i = 0; i < COUNT; i++) shapes->centers[3 * i] += 0.25;
    for (uint32_t i = 0; i < 3; i++) shapes->triangle[i] = left_handed ? 2 - i : i;
    if (!left_handed) return;
    for (int i = 0; i < COUNT; i++) shapes->centers[3 * i + 2] *= -1, shapes->normals[3 * i + 2] *= -1;
    for (int i = 0; i < CORNERS; i++) shapes->corners[3 * i + 2] *= -1;
}

static const float of_mesh[] = {0.1f, 0.8f, 0.2f, 1}, blue[] = {0.1f, 0.2f, 0.8f, 1};

/* The tangent vectors of the same disks. */
static void tangents(const Shapes *shapes, float *s, float *t) {
    for (int i = 0; i < COUNT; i++) {
        const float *n = shapes->normals + 3 * i;
        const int along = fabsf(n[2]) < 0.9f;
        const float a[] = {along ? -n[1] : 0, along ? n[0] : -n[2], along ? 0 : n[1]};
        const float length = sqrtf(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
        for (int k = 0; k < 3; k++) s[3 * i + k] = a[k] / length * shapes->radii[i];
        for (int k = 0; k < 3; k++) {
            const int u = (k + 1) % 3, v = (k + 2) % 3;
            t[3 * i + k] = n[u] * s[3 * i + v] - n[v] * s[3 * i + u];
        }
    }
}

/* `clips`: NULL, or one for each splat, which is an ellipse then. */
static SurfelPreparedScene *prepared(Engine *engine, SurfelRenderer *renderer, const Shapes *shapes, const double *transform, const SurfelClip *clips) {
    static float s[3 * COUNT], t[3 * COUNT];
    tangents(shapes, s, t);
    const SurfelSplats splats = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof splats, .count = COUNT,
                                 .centers = shapes->centers, .normals = clips ? NULL : shapes->normals,
                                 .radii = clips ? NULL : shapes->radii, .tangentsS = clips ? s : NULL,
                                 .tangentsT = clips ? t : NULL, .colors = blue, .colorCount = 1, .clips = clips, .epsilonInRadii = 2, .closed = !clips};
    const SurfelMesh mesh = {.sType = SURFEL_STRUCTURE_TYPE_MESH, .size = sizeof mesh, .vertexCount = CORNERS,
                             .positions = shapes->corners, .colors = of_mesh, .colorCount = 1, .triangleCount = 1,
                             .triangles = shapes->triangle};
    SurfelScene *scene;
    OK(surfel_scene_create(NULL, &scene));
    OK(surfel_scene_add_splats(scene, &splats));
    OK(surfel_scene_add_mesh(scene, &mesh));
    if (transform) OK(surfel_scene_transform(scene, transform));
    SurfelPreparedScene *made;
    engine_begin(engine);
    OK(surfel_upload(renderer, engine->commands, scene, &made));
    surfel_scene_destroy(scene);
    engine_begin_rendering(engine, 1);
    engine_end_rendering(engine);
    engine_submit(engine);
    SurfelPreparedSceneInfo info = {.sType = SURFEL_STRUCTURE_TYPE_PREPARED_SCENE_INFO, .size = sizeof info};
    OK(surfel_prepared_scene_info(made, &info));
    TRUE(info.triangles == 1 && info.objects == 2 && !info.transparent && info.leftOut == 0);
    return made;
}

/* How many pixels have the color of the splats, and that of the mesh. */
static void count(const Engine *engine, int *of_splats, int *of_triangle) {
    *of_splats = *of_triangle = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const float *pixel = engine->pixels + 4 * i;
        *of_triangle += pixel[1] > 0.75f;
        *of_splats += pixel[2] > 0.75f;
    }
}

static void refusals(void) {
    static Shapes shapes;
    make(&shapes, 0);
    SurfelScene *scene;
    OK(surfel_scene_create(NULL, &scene));
    SurfelMesh mesh = {.sType = SURFEL_STRUCTURE_TYPE_MESH, .size = sizeof mesh, .vertexCount = CORNERS, .triangleCount = 1};
    IS(INVALID_ARGUMENT, surfel_scene_add_mesh(scene, &mesh), "positions is NULL");
    mesh.positions = shapes.corners;
    IS(INVALID_ARGUMENT, surfel_scene_add_mesh(scene, &mesh), "triangles is NULL");
    mesh.triangles = shapes.triangle;
    mesh.vertexCount = 2;
    IS(INVALID_ARGUMENT, surfel_scene_add_mesh(scene, &mesh), "triangle 0 is [0, 1, 2]: there are 2 vertices");
    mesh.vertexCount = CORNERS;
    mesh.colors = of_mesh;
    IS(INVALID_ARGUMENT, surfel_scene_add_mesh(scene, &mesh), "colorCount is 0: expected 1 or 3");
    mesh.colors = NULL;
    mesh.reserved = 1;
    IS(NEWER_STRUCT, surfel_scene_add_mesh(scene, &mesh), "mesh: reserved is 1");
    double flat[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
    IS(OPTION, surfel_scene_transform(scene, flat), "worldFromObject: expected an affine map that can be undone");
    flat[10] = flat[3] = 1;
    IS(OPTION, surfel_scene_transform(scene, flat), "worldFromObject");
    IS(INVALID_ARGUMENT, surfel_scene_transform(scene, NULL), "worldFromObject is NULL");
    static const SurfelClip clips[COUNT] = {{.curveCount = 3}};
    SurfelSplats splats = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof splats, .count = COUNT,
                           .centers = shapes.centers, .normals = shapes.normals, .radii = shapes.radii, .clips = clips};
    IS(INVALID_ARGUMENT, surfel_scene_add_splats(scene, &splats), "clips: curveCount is 3");
    splats.clips = NULL;
    splats.epsilon = splats.epsilonInRadii = 1;
    IS(OPTION, surfel_scene_add_splats(scene, &splats), "epsilon: 1, and 1 radii: expected one of both");
    surfel_scene_destroy(scene);
}

void shapes(Engine *engine, SurfelDevice *device, SurfelRenderer *renderer) {
    refusals();
    static Shapes right, left;
    make(&right, 0);
    make(&left, 1);
    const double mirror[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1};
    static SurfelClip clips[COUNT];
    /* Half of each disk. */
    for (int i = 0; i < COUNT; i++) {
        clips[i].curveCount = 1;
        clips[i].curves[0].endRad = 3.14159265f;
    }
    SurfelPreparedScene *of_right = prepared(engine, renderer, &right, NULL, NULL);
    SurfelPreparedScene *of_left = prepared(engine, renderer, &left, mirror, NULL);
    SurfelPreparedScene *cut = prepared(engine, renderer, &right, NULL, clips);
    const VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    const SurfelRendering rendering = {.sType = SURFEL_STRUCTURE_TYPE_RENDERING, .size = sizeof rendering,
                                       .colorFormats = &format, .colorFormatCount = 1,
                                       .depthFormat = VK_FORMAT_D32_SFLOAT};
    SurfelView *view;
    OK(surfel_view_create(renderer, &rendering, &view));
    SurfelSettings *settings;
    OK(surfel_settings_create(&settings));
    OK(surfel_settings_set(settings, "shading", "albedo"));
    const SurfelPreparedScene *scenes[] = {of_right};
    double place[] = {0.8, 0.6, 0, 0, -0.6, 0.8, 0, 0, 0, 0, 1, 0, 0.1, 0.2, 0.4, 1};
    SurfelFrame frame = {.sType = SURFEL_STRUCTURE_TYPE_FRAME, .size = sizeof frame, .scenes = scenes,
                         .worldFromScene = place, .settings = settings, .sceneCount = 1, .width = WIDTH, .height = HEIGHT,
                         .viewFromWorld = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -4, 1},
                         .clipFromView = {2.0 * HEIGHT / WIDTH, 0, 0, 0, 0, -2, 0, 0, 0, 0, 0, -1, 0, 0, 0.1, 0}};
    /* Pipelines one after the other: asked again and again, the frame is there in the end. */
    uint64_t made = 0, before, asked = 0;
    OK(surfel_pipelines_made(renderer, &before));
    for (SurfelResult result = SURFEL_RESULT_NOT_READY; result == SURFEL_RESULT_NOT_READY; asked++) {
        engine_begin(engine);
        OK(surfel_pipelines_made(renderer, &made));
        TRUE(made == before + asked);
        frame.mostPipelines = made + 1;
        result = surfel_view_prepare(view, engine->commands, &frame);
        TRUE(result == SURFEL_RESULT_SUCCESS || result == SURFEL_RESULT_NOT_READY);
    }
    TRUE(asked > 1);
    frame.mostPipelines = 0;
    draw_alone(engine, device, view, &frame);
    int of_splats, of_triangle;
    count(engine, &of_splats, &of_triangle);
    TRUE(of_splats > 5000 && of_triangle > 5000);
    const size_t bytes = sizeof(float) * 4 * WIDTH * HEIGHT;
    float *expected = malloc(bytes);
    TRUE(expected);
    memcpy(expected, engine->pixels, bytes);

    /* The same in a left-handed world, whose z points the other way: the view is a mirror's, and of the place what z takes part in. */
    scenes[0] = of_left;
    frame.viewFromWorld[10] = -1;
    place[14] = -place[14];
    engine_begin(engine);
    IS(OPTION, surfel_view_prepare(view, engine->commands, &frame), "camera: the picture is a mirror's");
    frame.leftHanded = VK_TRUE;
    draw_alone(engine, device, view, &frame);
    /* But for roundings, as a normal that is turned over is made a unit vector anew. */
    int apart = 0;
    for (int i = 0; i < 4 * WIDTH * HEIGHT; i++) apart += fabsf(expected[i] - engine->pixels[i]) > 1e-3f;
    if (apart > 10) printf("%d values differ\n", apart);
    TRUE(apart <= 10);

    /* What is cut off is not there. */
    frame.leftHanded = VK_FALSE;
    frame.viewFromWorld[10] = 1;
    place[14] = -place[14];
    scenes[0] = cut;
    draw_alone(engine, device, view, &frame);
    int of_cut, beside;
    count(engine, &of_cut, &beside);
    TRUE(of_cut > 1000 && of_cut < of_splats && beside > of_triangle);
    free(expected);
    surfel_settings_destroy(settings);
    surfel_view_destroy(view);
    surfel_prepared_scene_destroy(cut);
    surfel_prepared_scene_destroy(of_left);
    surfel_prepared_scene_destroy(of_right);
}
