/* Models without a device: read, made, looked at, saved. */
#include <math.h>

#include "models.h"

typedef struct Heard {
    unsigned steps, notes;
    char note[200];
} Heard;

static void step(void *user, const char *task, uint64_t done, uint64_t total) {
    TRUE(task[0] != 0 && done <= total);
    ((Heard *)user)->steps++;
}

static void note(void *user, const char *text) {
    Heard *heard = user;
    heard->notes++;
    snprintf(heard->note, sizeof heard->note, "%s", text);
}

static SurfelSplats splats_of(const SurfelScene *scene, uint64_t object) {
    SurfelSplats splats = {.sType = SURFEL_STRUCTURE_TYPE_SPLATS, .size = sizeof splats};
    OK(surfel_scene_object_splats(scene, object, &splats));
    return splats;
}

/* Rows of numbers in memory, whose columns only the host knows. */
static void read_from_memory(void) {
    static const char rows[] = "9 0 0 0 0 0 1 0.5\n9 1 0 0 0 0 1 0.25\n9 0 2 0 0 0 1 0.125\n";
    const uint8_t *bytes = (const uint8_t *)rows;
    const uint64_t count = sizeof rows - 1;
    Heard heard = {0};
    const SurfelListener listener = {.sType = SURFEL_STRUCTURE_TYPE_LISTENER, .size = sizeof listener, .user = &heard, .step = step, .note = note};
    SurfelLoadOptions options = {.sType = SURFEL_STRUCTURE_TYPE_LOAD_OPTIONS, .size = sizeof options, .columns = "-,x,y,z,nx,ny,nz,radius", .listener = &listener};
    const double turned[16] = {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1};
    SurfelDescription description = {.sType = SURFEL_STRUCTURE_TYPE_DESCRIPTION, .size = sizeof description, .name = "three",
                                     .worldFromObject = turned, .hasColor = VK_TRUE, .color = {0.25f, 0.5f, 1}, .epsilonInRadii = 2};
    SurfelScene *scene = empty();
    OK(surfel_scene_add_file_of_memory(scene, "rows.xyz", bytes, count, &options, &description));
    TRUE(heard.steps > 0);
    const SurfelSplats splats = splats_of(scene, 0);
    TRUE(splats.count == 3 && splats.colorCount == 1 && splats.colors[1] == 0.5f && splats.colors[3] == 1);
    TRUE(splats.centers[3] == 5 && splats.centers[4] == 8 && splats.centers[5] == 7);
    TRUE(splats.radii[1] == 0.5f && splats.tangentsS == NULL && splats.normals[2] == 1 && !splats.closed);
    double least[3], most[3], center[3], radius;
    OK(surfel_scene_bounds(scene, least, most));
    TRUE(least[0] == 0.75 && most[0] == 6 && least[1] == 5 && most[1] == 8.5);
    OK(surfel_scene_ball_named(scene, "three", center, &radius));
    TRUE(radius > 0);
    IS(INVALID_ARGUMENT, surfel_scene_ball_named(scene, "four", center, &radius), "nothing that can be drawn is called 'four'");
    char name[8];
    uint64_t length;
    OK(surfel_scene_object_name(scene, 0, name, sizeof name, &length));
    TRUE(length == 5 && strcmp(name, "three") == 0);
    IS(INVALID_ARGUMENT, surfel_scene_object_name(scene, 1, name, sizeof name, &length), "object 1: the scene has 1 of splats");

    /* Limits, and what is none. */
    options.mostLineBytes = 4;
    IS(INPUT, surfel_scene_add_file_of_memory(scene, "rows.xyz", bytes, count, &options, NULL), "rows.xyz");
    options.mostLineBytes = 0;
    options.columns = "x,y";
    IS(OPTION, surfel_scene_add_file_of_memory(scene, "rows.xyz", bytes, count, &options, NULL), "columns");
    options.columns = NULL;
    options.reserved = 1;
    IS(NEWER_STRUCT, surfel_scene_add_file_of_memory(scene, "rows.xyz", bytes, count, &options, NULL), "options: reserved is 1");
    IS(INVALID_ARGUMENT, surfel_scene_add_file_of_memory(scene, "rows.xyz", NULL, count, NULL, NULL), "bytes is NULL");
    IS(INVALID_ARGUMENT, surfel_scene_add_file_of_memory(scene, NULL, bytes, count, NULL, NULL), "name is NULL");
    IS(INPUT, surfel_scene_add_file_of_memory(scene, "nothing.ply", bytes, 0, NULL, NULL), "nothing.ply");
    description.representation = SURFEL_REPRESENTATION_MESH;
    options.reserved = 0;
    options.columns = "-,x,y,z,nx,ny,nz,radius";
    IS(INPUT, surfel_scene_add_file_of_memory(scene, "rows.xyz", bytes, count, &options, &description), "expected a mesh, to draw its triangles");
    description.representation = 9;
    IS(INVALID_ARGUMENT, surfel_scene_add_file_of_memory(scene, "rows.xyz", bytes, count, &options, &description), "representation is 9");
    description.representation = 0;
    description.alpha = 2;
    IS(OPTION, surfel_scene_add_file_of_memory(scene, "rows.xyz", bytes, count, &options, &description), "alpha: 2");
    description.alpha = 0;
    description.color[1] = -1;
    IS(OPTION, surfel_scene_add_file_of_memory(scene, "rows.xyz", bytes, count, &options, &description), "color");
    const double flat[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
    description.color[1] = 0;
    description.worldFromObject = flat;
    IS(OPTION, surfel_scene_add_file_of_memory(scene, "rows.xyz", bytes, count, &options, &description), "worldFromObject");
    TRUE(contents_of(scene).objects == 1 && contents_of(scene).splats == 3);
    surfel_scene_destroy(scene);
}

/* A cube of 8 vertices. */
static const double CORNERS[] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1, -1, -1, 1, 1, -1, 1, -1, 1, 1, 1, 1, 1};
static const uint32_t SIDES[] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
static const SurfelMesh CUBE = {.sType = SURFEL_STRUCTURE_TYPE_MESH, .size = sizeof CUBE, .name = "cube", .vertexCount = 8, .positions = CORNERS,
                                .triangleCount = 12, .triangles = SIDES};

static void made_of_meshes(void) {
    SurfelDescription description = {.sType = SURFEL_STRUCTURE_TYPE_DESCRIPTION, .size = sizeof description, .samples = 500, .seed = 3};
    SurfelScene *scene = empty();
    Heard heard = {0};
    const SurfelListener listener = {.sType = SURFEL_STRUCTURE_TYPE_LISTENER, .size = sizeof listener, .user = &heard, .step = step};
    OK(surfel_scene_add_mesh_as(scene, &CUBE, &description, &listener));
    TRUE(heard.steps > 0 && heard.notes == 0);
    SurfelSplats splats = splats_of(scene, 0);
    TRUE(splats.count == 500 && splats.closed);
    for (uint64_t i = 0; i < splats.count; i++) {
        const double *at = splats.centers + 3 * i;
        double most = 0;
        for (int axis = 0; axis < 3; axis++) most = at[axis] > most ? at[axis] : -at[axis] > most ? -at[axis] : most;
        TRUE(most > 0.9999 && most < 1.0001);
    }
    /* What shows a cube best are its triangles. */
    OK(surfel_scene_add_mesh_as(scene, &CUBE, NULL, NULL));
    SurfelSceneContents contents = contents_of(scene);
    TRUE(contents.objects == 1 && contents.meshes == 1 && contents.hybrids == 0);
    /* Triangles on one side, splats on the other; then both, as the view decides. */
    description.representation = SURFEL_REPRESENTATION_HYBRID;
    description.polygons = SURFEL_POLYGONS_PLANE;
    description.plane[0] = 1;
    OK(surfel_scene_add_mesh_as(scene, &CUBE, &description, NULL));
    contents = contents_of(scene);
    TRUE(contents.objects == 2 && contents.meshes == 2 && contents.hybrids == 0);
    description.polygons = SURFEL_POLYGONS_BY_VIEW;
    OK(surfel_scene_add_mesh_as(scene, &CUBE, &description, NULL));
    contents = contents_of(scene);
    TRUE(contents.objects == 2 && contents.meshes == 3 && contents.hybrids == 1);
    description.polygons = SURFEL_POLYGONS_LONGER_THAN;
    description.longerThan = -1;
    IS(OPTION, surfel_scene_add_mesh_as(scene, &CUBE, &description, NULL), "longerThan");
    description.polygons = 7;
    IS(INVALID_ARGUMENT, surfel_scene_add_mesh_as(scene, &CUBE, &description, NULL), "polygons is 7");
    description = (SurfelDescription){.sType = SURFEL_STRUCTURE_TYPE_DESCRIPTION, .size = sizeof description, .samples = (uint64_t)1 << 33};
    IS(OPTION, surfel_scene_add_mesh_as(scene, &CUBE, &description, NULL), "samples");
    IS(INVALID_ARGUMENT, surfel_scene_add_mesh_as(scene, NULL, NULL, NULL), "mesh is NULL");
    IS(INVALID_ARGUMENT, surfel_scene_add_mesh_as(NULL, &CUBE, NULL, NULL), "scene is NULL");
    surfel_scene_destroy(scene);
}

/* Splats that are cut at the twelve edges of a cube, saved and read again. */
static void sharp(const char *file) {
    SurfelScene *scene = empty();
    SurfelSharp options = {.sType = SURFEL_STRUCTURE_TYPE_SHARP, .size = sizeof options, .clipping = SURFEL_CLIPPING_LINES};
    OK(surfel_scene_add_sharp_mesh(scene, &CUBE, NULL));
    OK(surfel_scene_add_sharp_mesh(scene, &CUBE, &options));
    options.clipping = SURFEL_CLIPPING_NONE;
    OK(surfel_scene_add_sharp_mesh(scene, &CUBE, &options));
    options.clipping = 4;
    IS(INVALID_ARGUMENT, surfel_scene_add_sharp_mesh(scene, &CUBE, &options), "clipping is 4");
    options.clipping = 0;
    options.maxError = -1;
    IS(OPTION, surfel_scene_add_sharp_mesh(scene, &CUBE, &options), "max-error");
    options.maxError = 0;
    options.creaseRad = -1;
    IS(INVALID_ARGUMENT, surfel_scene_add_sharp_mesh(scene, &CUBE, &options), "creaseRad is -1");
    SurfelClip clips[100];
    const SurfelSplats splats = splats_of(scene, 0);
    TRUE(splats.count == 12 && splats.tangentsS != NULL && splats.normals == NULL && splats.closed);
    OK(surfel_scene_object_clips(scene, 0, 0, splats.count, clips));
    unsigned curves = 0;
    for (uint64_t i = 0; i < splats.count; i++) {
        curves += clips[i].curveCount;
        for (uint32_t j = 0; j < clips[i].curveCount; j++) TRUE(clips[i].curves[j].startRad != clips[i].curves[j].endRad);
    }
    TRUE(curves >= 24);
    SurfelClip none = {.curveCount = 77};
    OK(surfel_scene_object_clips(scene, 2, 0, 1, &none));
    TRUE(none.curveCount == 0);
    IS(INVALID_ARGUMENT, surfel_scene_object_clips(scene, 0, 1, splats.count, clips), "12 splats from 1 on: the object has 12");
    IS(INVALID_ARGUMENT, surfel_scene_object_clips(scene, 0, 0, 1, NULL), "clips is NULL");
    IS(INVALID_ARGUMENT, surfel_scene_object_clips(scene, 3, 0, 1, clips), "object 3: the scene has 3 of splats");

    const double up[3] = {0, 0, 1};
    OK(surfel_scene_save_splats(scene, 0, file, up, NULL));
    IS(FILE, surfel_scene_save_splats(scene, 0, "/nowhere/a.ply", NULL, NULL), "/nowhere/a.ply");
    IS(INVALID_ARGUMENT, surfel_scene_save_splats(scene, 9, file, NULL, NULL), "object 9");
    SurfelScene *again = empty();
    OK(surfel_scene_add_file_as(again, file, NULL, NULL));
    const SurfelSplats same = splats_of(again, 0);
    SurfelClip others[100];
    OK(surfel_scene_object_clips(again, 0, 0, same.count, others));
    TRUE(same.count == splats.count && same.closed && memcmp(clips, others, splats.count * sizeof *clips) == 0);
    TRUE(memcmp(same.tangentsS, splats.tangentsS, splats.count * 12) == 0);
    /* Centers are `float` in the file where that moves none by a thousandth of its splat. */
    for (uint64_t i = 0; i < 3 * splats.count; i++) TRUE(same.centers[i] == (double)(float)splats.centers[i]);
    /* What is told is what can be given. */
    SurfelSplats given = same;
    given.clips = others;
    OK(surfel_scene_add_splats(scene, &given));
    TRUE(contents_of(scene).objects == 4 && contents_of(scene).splats == 48);
    surfel_scene_destroy(again);
    surfel_scene_destroy(scene);
}

static void points(void) {
    enum { SIDE = 20, COUNT = SIDE * SIDE };
    static double at[COUNT][3];
    for (int i = 0; i < COUNT; i++) at[i][0] = i % SIDE, at[i][1] = i / SIDE;
    const double viewpoint[3] = {0, 0, -10};
    SurfelPoints points = {.sType = SURFEL_STRUCTURE_TYPE_POINTS, .size = sizeof points, .count = COUNT, .positions = at[0], .viewpoint = viewpoint};
    SurfelScene *scene = empty();
    OK(surfel_scene_add_points(scene, &points, NULL, NULL));
    const SurfelSplats splats = splats_of(scene, 0);
    TRUE(splats.count == COUNT && splats.radii[COUNT / 2] > 0.7f && splats.radii[COUNT / 2] < 3);
    /* All look at whoever has seen them. */
    for (int i = 0; i < COUNT; i++) TRUE(splats.normals[3 * i + 2] < -0.999f);
    SurfelDescription mesh = {.sType = SURFEL_STRUCTURE_TYPE_DESCRIPTION, .size = sizeof mesh, .representation = SURFEL_REPRESENTATION_MESH};
    IS(INPUT, surfel_scene_add_points(scene, &points, &mesh, NULL), "points: the file holds points; expected a mesh");
    points.colors = (const float *)at;
    points.colorCount = 7;
    IS(INVALID_ARGUMENT, surfel_scene_add_points(scene, &points, NULL, NULL), "colorCount is 7");
    points.positions = NULL;
    IS(INVALID_ARGUMENT, surfel_scene_add_points(scene, &points, NULL, NULL), "positions is NULL");
    surfel_scene_destroy(scene);
}

static void words(void) {
    SurfelSettings *settings;
    OK(surfel_settings_create(&settings));
    char value[16];
    uint64_t length;
    OK(surfel_settings_set(settings, "shading", "lambert"));
    OK(surfel_settings_get(settings, "shading", value, sizeof value, &length));
    TRUE(length == 7 && strcmp(value, "lambert") == 0);
    OK(surfel_settings_get(settings, "shading", value, 4, &length));
    TRUE(length == 7 && strcmp(value, "lam") == 0);
    IS(OPTION, surfel_settings_get(settings, "colour", value, 4, &length), "colour: expected one of");
    IS(INVALID_ARGUMENT, surfel_settings_get(NULL, "shading", value, 4, &length), "settings is NULL");
    IS(INVALID_ARGUMENT, surfel_settings_get(settings, "shading", NULL, 4, &length), "value is NULL");
    IS(INVALID_ARGUMENT, surfel_settings_get(settings, "shading", value, 4, NULL), "length is NULL");
    OK(surfel_settings_get(settings, "shading", NULL, 0, &length));
    TRUE(length == 7);
    /* The one that is asked for. */
    OK(surfel_settings_get(settings, "rasterizer", value, sizeof value, &length));
    TRUE(strcmp(value, "auto") == 0);
    surfel_settings_destroy(settings);

    const float center[3] = {1, 2, 3}, normal[3] = {0.36f, 0.48f, 0.8f}, color[4] = {0, 0.5f, 1, 0.25f};
    const float expected[] = {1, 2, 3, 0.5f, 0.36f, 0.48f, 0.8f, 2};
    float shape[8];
    uint16_t packed[4];
    OK(surfel_dynamic_shape(center, 0.5f, normal, shape));
    TRUE(memcmp(shape, expected, sizeof shape) == 0);
    OK(surfel_dynamic_color(color, packed));
    for (int i = 0; i < 4; i++) TRUE(fabsf(packed[i] - 65535 * color[i]) <= 0.5f);
    IS(INVALID_ARGUMENT, surfel_dynamic_color(color, NULL), "packed is NULL");
    IS(INVALID_ARGUMENT, surfel_dynamic_shape(NULL, 1, normal, shape), "center is NULL");
}

void models(const char *saved) {
    read_from_memory();
    made_of_meshes();
    sharp(saved);
    points();
    words();
}
