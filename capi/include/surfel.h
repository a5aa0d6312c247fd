/* surfel: splats within an engine's own frame. docs/c.md tells how it is used.
 *
 * Structs begin with `sType`, `size` (their sizeof) and `pNext` (NULL); zero is the default of every other member. Later versions append
 * members: what a header does not have yet is zero, and what a library does not know yet must be zero. Objects are opaque; destroying them
 * in any order is sound, each once. Pointers that are not said to be NULL at times must not be. Functions that may be called by several
 * threads at once say so at the object's type; other objects belong to one thread at a time.
 *
 * Written by cbindgen: not to be edited. */

#ifndef SURFEL_H
#define SURFEL_H

#include <stdint.h>
#include <vulkan/vulkan.h>

/**
 * The version of this header: as `VK_MAKE_API_VERSION(0, major, minor, patch)`.
 */
#define SURFEL_VERSION (1 << 12)

/**
 * `synchronization2`: needed.
 */
#define SURFEL_FEATURE_SYNCHRONIZATION2 1

/**
 * `dynamicRendering`: needed.
 */
#define SURFEL_FEATURE_DYNAMIC_RENDERING 2

/**
 * `maintenance4`: needed.
 */
#define SURFEL_FEATURE_MAINTENANCE4 4

/**
 * `shaderTerminateInvocation`: needed.
 */
#define SURFEL_FEATURE_SHADER_TERMINATE_INVOCATION 8

/**
 * `largePoints`; without it every splat above one pixel is a quad.
 */
#define SURFEL_FEATURE_LARGE_POINTS 16

/**
 * `drawIndirectFirstInstance`; without it splats are not drawn by tiles.
 */
#define SURFEL_FEATURE_DRAW_INDIRECT_FIRST_INSTANCE 32

/**
 * `drawIndirectCount`; without it all layers of `layers` `auto` are drawn, the empty ones too.
 */
#define SURFEL_FEATURE_DRAW_INDIRECT_COUNT 64

/**
 * `pipelineStatisticsQuery`; without it `SURFEL_MEASURE_COUNTS` counts nothing.
 */
#define SURFEL_FEATURE_PIPELINE_STATISTICS_QUERY 128

/**
 * `independentBlend`; without it a view is drawn within renderings of one color attachment only.
 */
#define SURFEL_FEATURE_INDEPENDENT_BLEND 256

/**
 * The most formats that are listed.
 */
#define SURFEL_MAX_FORMATS 16

/**
 * Splats, or of a mesh what shows it best: triangles where splats would have to be too large, or too many.
 */
#define SURFEL_REPRESENTATION_AUTO 0

/**
 * Splats.
 */
#define SURFEL_REPRESENTATION_SPLATS 1

/**
 * The triangles of a mesh.
 */
#define SURFEL_REPRESENTATION_MESH 2

/**
 * Triangles of a mesh, and splats in place of the others.
 */
#define SURFEL_REPRESENTATION_HYBRID 3

/**
 * The view decides, cell by cell: triangles where splats would be larger than levels of detail may be.
 */
#define SURFEL_POLYGONS_BY_VIEW 0

/**
 * Triangles stay whose middle is not behind `plane`.
 */
#define SURFEL_POLYGONS_PLANE 1

/**
 * Triangles stay that have an edge longer than `longerThan`.
 */
#define SURFEL_POLYGONS_LONGER_THAN 2

/**
 * One curve for each piece of a sharp edge, which the splats on both sides share.
 */
#define SURFEL_CLIPPING_SHARED 0

/**
 * For each splat a curve of its own.
 */
#define SURFEL_CLIPPING_OWN 1

/**
 * Straight lines.
 */
#define SURFEL_CLIPPING_LINES 2

/**
 * Nothing: splats stick out.
 */
#define SURFEL_CLIPPING_NONE 3

/**
 * Nothing, or what `timed` says: in `measures` of `SurfelFrame`, as those that follow.
 */
#define SURFEL_MEASURE_NOTHING 0

/**
 * The frame's own time, from before its first pass to behind its last.
 */
#define SURFEL_MEASURE_FRAME 1

/**
 * The time of each pass, and from the first to the last with what it costs to time them.
 */
#define SURFEL_MEASURE_TIMES 2

/**
 * Vertices and fragments, or invocations of compute, of each pass, where `pipelineStatisticsQuery` is enabled.
 */
#define SURFEL_MEASURE_COUNTS 3

/**
 * The number of no object.
 */
#define SURFEL_NO_ID 4294967295

/**
 * Nothing is seen there.
 */
#define SURFEL_PICKED_NOTHING 0

/**
 * A splat.
 */
#define SURFEL_PICKED_SPLAT 1

/**
 * A splat that stands for others in levels of detail.
 */
#define SURFEL_PICKED_NODE 2

/**
 * A triangle.
 */
#define SURFEL_PICKED_TRIANGLE 3

/**
 * What a call answers. `surfel_last_error` has the sentence.
 */
enum SurfelResult
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * It is done.
   */
  SURFEL_RESULT_SUCCESS = 0,
  /**
   * A pointer is NULL or not aligned, a count is too large, text is not UTF-8.
   */
  SURFEL_RESULT_INVALID_ARGUMENT = -1,
  /**
   * A struct's `sType` is not the one expected there, or its `pNext` leads to a struct that does not extend it.
   */
  SURFEL_RESULT_UNKNOWN_STRUCT = -2,
  /**
   * A struct is larger than this library knows it, and what it doesn't know is not zero; or a member that is reserved is not zero: the header is newer than the library.
   */
  SURFEL_RESULT_NEWER_STRUCT = -3,
  /**
   * A mistake in the library. The objects of the call may only be destroyed from now on.
   */
  SURFEL_RESULT_PANIC = -4,
  /**
   * The library was built without it.
   */
  SURFEL_RESULT_UNSUPPORTED = -5,
  /**
   * A value is out of its range, or rules another one out.
   */
  SURFEL_RESULT_OPTION = -6,
  /**
   * The content of a file is not what its format demands.
   */
  SURFEL_RESULT_INPUT = -7,
  /**
   * A file can't be read.
   */
  SURFEL_RESULT_FILE = -8,
  /**
   * The device lacks something, by name.
   */
  SURFEL_RESULT_NO_DEVICE = -9,
  /**
   * There is no memory, of the host or the device.
   */
  SURFEL_RESULT_OUT_OF_MEMORY = -10,
  /**
   * The device is lost.
   */
  SURFEL_RESULT_DEVICE_LOST = -11,
  /**
   * Another Vulkan call failed.
   */
  SURFEL_RESULT_VULKAN = -12,
  /**
   * Another error of the library.
   */
  SURFEL_RESULT_INTERNAL = -13,
  /**
   * A frame needs a pipeline that is not there yet, and was not to make one: `surfel_compile_ahead` does.
   */
  SURFEL_RESULT_NOT_READY = -14,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SurfelResult SurfelResult;
#else
typedef int32_t SurfelResult;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What a struct says it is: its `sType`.
 */
enum SurfelStructureType
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /**
   * `SurfelRequirements`.
   */
  SURFEL_STRUCTURE_TYPE_REQUIREMENTS = 1,
  /**
   * `SurfelImport`.
   */
  SURFEL_STRUCTURE_TYPE_IMPORT = 2,
  /**
   * `SurfelRendererInfo`.
   */
  SURFEL_STRUCTURE_TYPE_RENDERER_INFO = 3,
  /**
   * `SurfelSceneInfo`.
   */
  SURFEL_STRUCTURE_TYPE_SCENE_INFO = 4,
  /**
   * `SurfelSplats`.
   */
  SURFEL_STRUCTURE_TYPE_SPLATS = 5,
  /**
   * `SurfelPreparedSceneInfo`.
   */
  SURFEL_STRUCTURE_TYPE_PREPARED_SCENE_INFO = 6,
  /**
   * `SurfelRendering`.
   */
  SURFEL_STRUCTURE_TYPE_RENDERING = 7,
  /**
   * `SurfelDepthImage`.
   */
  SURFEL_STRUCTURE_TYPE_DEPTH_IMAGE = 8,
  /**
   * `SurfelFrame`.
   */
  SURFEL_STRUCTURE_TYPE_FRAME = 9,
  /**
   * `SurfelDynamicSplats`.
   */
  SURFEL_STRUCTURE_TYPE_DYNAMIC_SPLATS = 10,
  /**
   * `SurfelHostImage`.
   */
  SURFEL_STRUCTURE_TYPE_HOST_IMAGE = 11,
  /**
   * `SurfelMemoryRequest`.
   */
  SURFEL_STRUCTURE_TYPE_MEMORY_REQUEST = 12,
  /**
   * `SurfelMemory`.
   */
  SURFEL_STRUCTURE_TYPE_MEMORY = 13,
  /**
   * `SurfelMesh`.
   */
  SURFEL_STRUCTURE_TYPE_MESH = 14,
  /**
   * `SurfelRoom`.
   */
  SURFEL_STRUCTURE_TYPE_ROOM = 15,
  /**
   * `SurfelMemoryReport`.
   */
  SURFEL_STRUCTURE_TYPE_MEMORY_REPORT = 16,
  /**
   * `SurfelPicked`.
   */
  SURFEL_STRUCTURE_TYPE_PICKED = 17,
  /**
   * `SurfelLevels`.
   */
  SURFEL_STRUCTURE_TYPE_LEVELS = 18,
  /**
   * `SurfelHybridLevels`.
   */
  SURFEL_STRUCTURE_TYPE_HYBRID_LEVELS = 19,
  /**
   * `SurfelListener`.
   */
  SURFEL_STRUCTURE_TYPE_LISTENER = 20,
  /**
   * `SurfelLoadOptions`.
   */
  SURFEL_STRUCTURE_TYPE_LOAD_OPTIONS = 21,
  /**
   * `SurfelDescription`.
   */
  SURFEL_STRUCTURE_TYPE_DESCRIPTION = 22,
  /**
   * `SurfelPoints`.
   */
  SURFEL_STRUCTURE_TYPE_POINTS = 23,
  /**
   * `SurfelSharp`.
   */
  SURFEL_STRUCTURE_TYPE_SHARP = 24,
  /**
   * `SurfelSceneContents`.
   */
  SURFEL_STRUCTURE_TYPE_SCENE_CONTENTS = 25,
  /**
   * `SurfelCamera`.
   */
  SURFEL_STRUCTURE_TYPE_CAMERA = 26,
  /**
   * `SurfelHeadlessInfo`.
   */
  SURFEL_STRUCTURE_TYPE_HEADLESS_INFO = 27,
  /**
   * `SurfelHeadlessFrame`.
   */
  SURFEL_STRUCTURE_TYPE_HEADLESS_FRAME = 28,
  /**
   * `SurfelPicture`.
   */
  SURFEL_STRUCTURE_TYPE_PICTURE = 29,
  /**
   * `SurfelMemoryNeeds`.
   */
  SURFEL_STRUCTURE_TYPE_MEMORY_NEEDS = 30,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SurfelStructureType SurfelStructureType;
#else
typedef uint32_t SurfelStructureType;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * A host's device. May be used by several threads at once.
 */
typedef struct SurfelDevice SurfelDevice;

/**
 * A device and a queue of our own, which draws pictures to memory and waits for each. One thread at a time may use it.
 */
typedef struct SurfelHeadless SurfelHeadless;

/**
 * A pixel that is looked at.
 */
typedef struct SurfelPick SurfelPick;

/**
 * A scene on the device: uploaded, or written there by the host. Frames of several threads may show it at once.
 */
typedef struct SurfelPreparedScene SurfelPreparedScene;

/**
 * Pipelines, for all views and scenes of a device. May be used by several threads at once.
 */
typedef struct SurfelRenderer SurfelRenderer;

/**
 * Splats and lights in the host's memory, of which `surfel_upload` makes a scene on a device. Needs none itself, so that another thread can
 * make it.
 */
typedef struct SurfelScene SurfelScene;

/**
 * How frames are drawn.
 */
typedef struct SurfelSettings SurfelSettings;

/**
 * One view, which keeps what passes leave for the draws of the frame that was prepared last: that is drawn before the next one is prepared. With several frames in flight a host has one for each. One thread at a time may use it.
 */
typedef struct SurfelView SurfelView;

/**
 * What a device must be created with, and what it has. `surfel_requirements` fills it. No extension of the device is needed.
 */
typedef struct SurfelRequirements {
  /**
   * `SURFEL_STRUCTURE_TYPE_REQUIREMENTS`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelRequirements)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  void *pNext;
  /**
   * The features to enable, of `SURFEL_FEATURE_…`: those that are needed, and of the others those that the device offers.
   * `surfel_enable_features` puts them into Vulkan's structs.
   */
  uint64_t features;
  /**
   * The least version of instance and device, as `VK_API_VERSION_1_3`.
   */
  uint32_t apiVersion;
  /**
   * What the queue must do to which our commands are submitted.
   */
  VkQueueFlags queueFlags;
  /**
   * The first family that does; `UINT32_MAX`: none.
   */
  uint32_t queueFamily;
  /**
   * The largest side of a view, in pixels.
   */
  uint32_t maxImageSide;
  /**
   * Bytes of a buffer that a shader can reach; scenes are cut into pieces of that size.
   */
  uint64_t maxStorageBufferRange;
  /**
   * The largest buffer, in bytes.
   */
  uint64_t maxBufferSize;
  /**
   * How many of `colorFormats` there are.
   */
  uint32_t colorFormatCount;
  /**
   * How many of `depthFormats` there are.
   */
  uint32_t depthFormatCount;
  /**
   * Formats of color images that can be drawn to, of those that were looked for.
   */
  VkFormat colorFormats[SURFEL_MAX_FORMATS];
  /**
   * Formats of depth images that can be tested, written, and read where transparent things are hidden by what the host has drawn.
   */
  VkFormat depthFormats[SURFEL_MAX_FORMATS];
} SurfelRequirements;

/**
 * What is asked of a host's allocator: a struct that the library fills, of which a later one may have more behind.
 */
typedef struct SurfelMemoryRequest {
  /**
   * `SURFEL_STRUCTURE_TYPE_MEMORY_REQUEST`.
   */
  uint32_t sType;
  /**
   * Its size in the library.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * For what, in words; valid during the call.
   */
  const char *name;
  /**
   * How many bytes.
   */
  uint64_t bytes;
  /**
   * Of its offset.
   */
  uint64_t alignment;
  /**
   * A bit for each type of memory that will do, as in `VkMemoryRequirements`.
   */
  uint32_t memoryTypeBits;
  /**
   * For buffers; else for images of optimal tiling, of which `bufferImageGranularity` has to be kept.
   */
  VkBool32 linear;
  /**
   * The host's processor writes there: it must be mapped, and coherent.
   */
  VkBool32 writtenByHost;
  /**
   * The host's processor reads there: it must be mapped, and coherent.
   */
  VkBool32 readByHost;
} SurfelMemoryRequest;

/**
 * A piece of a host's device memory.
 */
typedef struct SurfelAllocation {
  /**
   * The memory object.
   */
  VkDeviceMemory memory;
  /**
   * Where in it, in bytes.
   */
  uint64_t offset;
  /**
   * Where the host's processor sees the first byte, of what it touches; else NULL.
   */
  void *mapped;
  /**
   * Whatever the host knows it by.
   */
  uint64_t token;
} SurfelAllocation;

/**
 * Gives memory and answers `VK_SUCCESS`, or why there is none: `VK_ERROR_OUT_OF_DEVICE_MEMORY` where a budget is used up. Then what needed it
 * fails with `SURFEL_RESULT_OUT_OF_MEMORY`, and is asked for again when a frame needs it next. `allocation` is zero before. Must return.
 */
typedef VkResult (*SurfelAllocate)(void *user, const struct SurfelMemoryRequest *request, struct SurfelAllocation *allocation);

/**
 * Takes a piece back: nothing of the device's uses it any more. Must return.
 */
typedef void (*SurfelFree)(void *user, const struct SurfelAllocation *allocation);

/**
 * A host's allocator. It is asked from whichever thread uses a renderer or a view, by one at a time, and must not call surfel back. What it gives is memory of the
 * device, of a type among those asked for, aligned and as large as asked, used by nobody else until it is given back. It must live until
 * all that was made from the device is destroyed and its last epoch is done.
 */
typedef struct SurfelMemory {
  /**
   * `SURFEL_STRUCTURE_TYPE_MEMORY`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelMemory)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * What both functions are given first; may be NULL.
   */
  void *user;
  /**
   * Gives memory.
   */
  SurfelAllocate allocate;
  /**
   * Takes it back.
   */
  SurfelFree free;
} SurfelMemory;

/**
 * A device that a host lends.
 */
typedef struct SurfelImport {
  /**
   * `SURFEL_STRUCTURE_TYPE_IMPORT`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelImport)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * Of Vulkan 1.3.
   */
  VkInstance instance;
  /**
   * The physical device.
   */
  VkPhysicalDevice physicalDevice;
  /**
   * The device, created with at least what `surfel_requirements` says.
   */
  VkDevice device;
  /**
   * All entry points come from it.
   */
  PFN_vkGetInstanceProcAddr getInstanceProcAddr;
  /**
   * What the host really enabled, of `SURFEL_FEATURE_…`; other bits are refused.
   */
  uint64_t features;
  /**
   * The family of the queue to which the host submits what we record; graphics and compute.
   */
  uint32_t queueFamily;
  /**
   * Whether `VK_EXT_debug_utils` is enabled: then all of our objects have names, and our passes labels.
   */
  VkBool32 debugUtils;
  /**
   * The host's allocator, which all device memory is then taken from; NULL: it is taken from the device, in blocks of 8 to 16 MiB.
   */
  const struct SurfelMemory *memory;
} SurfelImport;

/**
 * A heap of a device's memory.
 */
typedef struct SurfelMemoryHeap {
  /**
   * How large it is, in bytes.
   */
  uint64_t size;
  /**
   * How many bytes of it the process may have before allocations fail or are moved elsewhere, as the driver has it now; of one that does not tell it, `size`.
   */
  uint64_t budget;
  /**
   * How many bytes of it the process has now, all of its libraries together; of a driver that does not tell it, 0.
   */
  uint64_t usage;
  /**
   * It is the device's own.
   */
  VkBool32 isLocal;
  /**
   * 0.
   */
  uint32_t reserved;
} SurfelMemoryHeap;

/**
 * Device memory: what of it is ours, and what the process may have. `surfel_device_memory_report` fills it.
 */
typedef struct SurfelMemoryReport {
  /**
   * `SURFEL_STRUCTURE_TYPE_MEMORY_REPORT`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelMemoryReport)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  void *pNext;
  /**
   * Bytes of our buffers that only the device touches: splats and meshes, and what frames list and sum in buffers.
   */
  uint64_t buffers;
  /**
   * Bytes of images: what frames sum in images.
   */
  uint64_t images;
  /**
   * Bytes that the host writes: scenes on their way, updates, what a frame is told.
   */
  uint64_t upload;
  /**
   * Bytes that the device writes and the host reads.
   */
  uint64_t readback;
  /**
   * Bytes that lie idle in blocks of ours; 0 with a `SurfelMemory`.
   */
  uint64_t idle;
  /**
   * How many heaps the device has, in Vulkan's order.
   */
  uint32_t heapCount;
  /**
   * Budgets and what is used of them are the driver's (`VK_EXT_memory_budget`, which need not be enabled); else a budget is as large as its heap.
   */
  VkBool32 budgetsAreTold;
  /**
   * The heaps.
   */
  struct SurfelMemoryHeap heaps[16];
} SurfelMemoryReport;

/**
 * What a scene is made for.
 */
typedef struct SurfelSceneInfo {
  /**
   * `SURFEL_STRUCTURE_TYPE_SCENE_INFO`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelSceneInfo)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * It gets levels of detail at the upload, for the setting `lod`.
   */
  VkBool32 levels;
  /**
   * Its levels of detail may have a `budget`, for which the host keeps 40 bytes for each node of them.
   */
  VkBool32 budget;
  /**
   * `surfel_update` may change its splats on the device, for which the host keeps what the device has of each; not with `levels`, nor with
   * `splat-format` `packed`.
   */
  VkBool32 updatable;
  /**
   * 0; else it is refused.
   */
  uint32_t reserved;
  /**
   * `surfel_pick_read` is to tell numbers of splats and triangles, for which the host keeps 4 bytes of each.
   */
  VkBool32 numbered;
  /**
   * No frame asks for an `epsilon` of `auto` of objects that have none of their own: nothing is looked for near their splats at the upload.
   */
  VkBool32 withoutAutoEpsilon;
} SurfelSceneInfo;

/**
 * A curve that cuts off a part of a splat: a rational Bézier curve of degree 2 in the splat's own plane, where its rim is u² + v² = 1. What
 * is to the right of the way from its start to its end is cut off.
 */
typedef struct SurfelClipCurve {
  /**
   * Where it starts on the rim, in radians from the first tangent vector toward the second.
   */
  float startRad;
  /**
   * Where it ends.
   */
  float endRad;
  /**
   * The control point in the middle, (u, v); the two others are its ends.
   */
  float middle[2];
  /**
   * The weight of that point, at least 0: 0 is the chord, 1 a parabola.
   */
  float weight;
} SurfelClipCurve;

/**
 * What is cut off a splat.
 */
typedef struct SurfelClip {
  /**
   * How many curves cut it, 0 to 2.
   */
  uint32_t curveCount;
  /**
   * Of two curves only what both cut off is; else what either does.
   */
  VkBool32 both;
  /**
   * The curves.
   */
  struct SurfelClipCurve curves[2];
} SurfelClip;

/**
 * Numbers of an object of splats behind those that it is uploaded with, which have nothing yet: `surfel_append` and `surfel_update` put splats there. Of an object that has it,
 * `surfel_remove` takes splats away, its own ones, too. For scenes that are `updatable`.
 */
typedef struct SurfelRoom {
  /**
   * `SURFEL_STRUCTURE_TYPE_ROOM`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelRoom)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * How many numbers, of 40 bytes on the device each, 56 of ellipses; with none, splats are only taken away, and put back.
   */
  uint32_t splats;
  /**
   * `around` is a place in the scene's own space near which they will be; else they will be near the object, or, of none, near the origin. What is farther from it than 2000 times its own
   * smaller half axis is placed less exactly.
   */
  VkBool32 hasAround;
  /**
   * That place.
   */
  double around[3];
  /**
   * How many disks will lie over a place of the surface, where they are fewest; 0: as many as in the object, and of none 2.
   */
  double overlap;
} SurfelRoom;

/**
 * An object of splats, by arrays. Disks have `normals` and `radii`, ellipses have `tangentsS` and `tangentsT`; the other two are NULL.
 */
typedef struct SurfelSplats {
  /**
   * `SURFEL_STRUCTURE_TYPE_SPLATS`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelSplats)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * Shown in messages, as UTF-8; NULL: `splats`.
   */
  const char *name;
  /**
   * How many splats there are.
   */
  uint64_t count;
  /**
   * Centers in the scene's own space: x, y, z of each.
   */
  const double *centers;
  /**
   * Normals of any length, x, y, z of each; the surface is seen from the side to which they point.
   */
  const float *normals;
  /**
   * Radii.
   */
  const float *radii;
  /**
   * First tangent vectors, scaled by the radius along them: x, y, z of each. A point of the splat is center + u s + v t with u² + v² ≤ 1.
   */
  const float *tangentsS;
  /**
   * Second tangent vectors alike; the normal is s × t.
   */
  const float *tangentsT;
  /**
   * Red, green, blue and alpha of each, linear, straight, 0 to 1; NULL: all are the opaque gray of surfaces without colors.
   */
  const float *colors;
  /**
   * How many colors there are: `count`, or 1 for all splats.
   */
  uint64_t colorCount;
  /**
   * How far behind the nearest splat others of it belong to the same surface, in the scene's unit; 0: as the settings say.
   */
  double epsilon;
  /**
   * The splats sample a closed surface, and their normals point outward: those that face away can't be seen.
   */
  VkBool32 closed;
  /**
   * 0; else it is refused.
   */
  uint32_t reserved;
  /**
   * What is cut off each ellipse; NULL: nothing. A disk that has a curve is left out.
   */
  const struct SurfelClip *clips;
  /**
   * As `epsilon`, in mean radii of the object; one of both is 0.
   */
  double epsilonInRadii;
  /**
   * Room for splats that come later; NULL: none comes, and none goes. Not for those that `surfel_update` and `surfel_append` are given.
   */
  const struct SurfelRoom *room;
  /**
   * Its own epsilon is `auto`, whatever the settings say, and `withoutAutoEpsilon` of the scene; the two numbers are 0 then.
   */
  VkBool32 autoEpsilon;
  /**
   * 0; else it is refused.
   */
  uint32_t reservedToo;
} SurfelSplats;

/**
 * What a scene holds. `surfel_scene_contents` fills it.
 */
typedef struct SurfelSceneContents {
  /**
   * `SURFEL_STRUCTURE_TYPE_SCENE_CONTENTS`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelSceneContents)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  void *pNext;
  /**
   * How many objects of splats there are, without those that came with their levels of detail.
   */
  uint64_t objects;
  /**
   * How many of those.
   */
  uint64_t leveled;
  /**
   * How many objects of triangles.
   */
  uint64_t meshes;
  /**
   * How many of these have splats and nodes that take their place.
   */
  uint64_t hybrids;
  /**
   * How many lights.
   */
  uint64_t lights;
  /**
   * How many splats, also those that can't be drawn.
   */
  uint64_t splats;
} SurfelSceneContents;

/**
 * The ball by which a node is chosen, from the levels' `origin`.
 */
typedef struct SurfelErrorBall {
  /**
   * Its middle.
   */
  float center[3];
  /**
   * Its radius: around the node's ellipse, all splats below it, and the balls of its children.
   */
  float radius;
  /**
   * How far what is below spreads: the root of the mean squared distance of the splats' centers from the node's, by area. Above 0, and no less than a child's.
   */
  float spread;
} SurfelErrorBall;

/**
 * An object of splats with levels of detail, by arrays: nodes, each a splat that stands for all below it. For a size of the setting `lod` a node is drawn whose spread is seen at most so large, where its parent's
 * is seen larger, or it has none; and a splat of the object where its parent's is seen larger, or it has none.
 */
typedef struct SurfelLevels {
  /**
   * `SURFEL_STRUCTURE_TYPE_LEVELS`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelLevels)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * The object's own splats, neighbors in space one after the other; without `epsilon`, `room` and clip curves.
   */
  const struct SurfelSplats *splats;
  /**
   * The number of the node above each; `UINT32_MAX`: none is.
   */
  const uint32_t *splatParents;
  /**
   * The nodes, ellipses, each behind its parent. Their name and `closed` mean nothing.
   */
  const struct SurfelSplats *nodes;
  /**
   * The number of the node above each; `UINT32_MAX`: none is.
   */
  const uint32_t *nodeParents;
  /**
   * Of each node.
   */
  const struct SurfelErrorBall *balls;
  /**
   * From where their middles are counted, in the scene's own space.
   */
  double origin[3];
} SurfelLevels;

/**
 * An object of triangles, by arrays, drawn beside splats.
 */
typedef struct SurfelMesh {
  /**
   * `SURFEL_STRUCTURE_TYPE_MESH`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelMesh)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * Shown in messages, as UTF-8; NULL: `mesh`.
   */
  const char *name;
  /**
   * How many vertices there are.
   */
  uint64_t vertexCount;
  /**
   * Their positions in the scene's own space: x, y, z of each.
   */
  const double *positions;
  /**
   * Their normals, of any length, x, y, z of each. NULL, and where one is 0: the mean of the triangles around it.
   */
  const float *normals;
  /**
   * Red, green, blue and alpha of each vertex, linear, straight, 0 to 1; NULL: all are the opaque gray of surfaces without colors.
   */
  const float *colors;
  /**
   * How many colors there are: `vertexCount`, or 1 for all vertices.
   */
  uint64_t colorCount;
  /**
   * How many triangles there are.
   */
  uint64_t triangleCount;
  /**
   * Three numbers of vertices of each, counterclockwise seen from outside. A triangle that can't be drawn is left out.
   */
  const uint32_t *triangles;
  /**
   * The triangles are all of a closed surface: those that face away can't be seen.
   */
  VkBool32 closed;
  /**
   * 0; else it is refused.
   */
  uint32_t reserved;
} SurfelMesh;

/**
 * Triangles that are drawn, or not, together.
 */
typedef struct SurfelPolygonCell {
  /**
   * How many triangles of the mesh it has, behind those of the cell before it.
   */
  uint32_t triangleCount;
  /**
   * How many cells it meets at an edge or a corner. Where one of them is drawn as triangles, its own are drawn, too, below its splats.
   */
  uint32_t neighborCount;
  /**
   * By which it is chosen, from the levels' `origin`, around its triangles and splats, within the balls of the nodes above these. Its spread is above 0, and no more than those nodes'.
   */
  struct SurfelErrorBall ball;
} SurfelPolygonCell;

/**
 * Levels of detail of a mesh in the scene, by arrays: for a size of the setting `lod` a cell of it is drawn as triangles where its spread is seen larger, elsewhere as its splats, or nodes that stand for them.
 * A splat is drawn where its parent's spread is seen larger, or it has none, and that of a cell that it is drawn for is not. Frames without `lod` draw the mesh.
 */
typedef struct SurfelHybridLevels {
  /**
   * `SURFEL_STRUCTURE_TYPE_HYBRID_LEVELS`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelHybridLevels)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * The number of the mesh among those that are in the scene. It is opaque, has no such levels yet, and lies cell by cell.
   */
  uint64_t mesh;
  /**
   * Its splats, opaque, and the nodes above.
   */
  const struct SurfelLevels *levels;
  /**
   * For how many cells each splat is drawn, at least 1: for that in which it lies; of an edge between cells, for these.
   */
  const uint32_t *splatCellCounts;
  /**
   * How many numbers `splatCells` has: the sum of those counts.
   */
  uint64_t splatCellCount;
  /**
   * The numbers of these cells, those of each splat behind those of the splat before it.
   */
  const uint32_t *splatCells;
  /**
   * How many cells there are.
   */
  uint64_t cellCount;
  /**
   * The cells. Together they have all triangles of the mesh, without those that can't be drawn, which are not in the scene.
   */
  const struct SurfelPolygonCell *cells;
  /**
   * How many numbers `neighbors` has: the sum of `neighborCount` of the cells.
   */
  uint64_t neighborCount;
  /**
   * The numbers of the cells that each meets, those of each cell behind those of the cell before it.
   */
  const uint32_t *neighbors;
} SurfelHybridLevels;

/**
 * Is told that `done` of `total` parts of a task are finished; its name is UTF-8, valid during the call. Must return.
 */
typedef void (*SurfelStep)(void *user, const char *task, uint64_t done, uint64_t total);

/**
 * Is told something that is no error, such as elements that were left out: a sentence, valid during the call. Must return.
 */
typedef void (*SurfelNote)(void *user, const char *note);

/**
 * Who listens to a call that may take long, on the thread of that call.
 */
typedef struct SurfelListener {
  /**
   * `SURFEL_STRUCTURE_TYPE_LISTENER`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelListener)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * What both functions are given first; may be NULL.
   */
  void *user;
  /**
   * Is told how far the call is; may be NULL.
   */
  SurfelStep step;
  /**
   * Is told what was noticed; may be NULL.
   */
  SurfelNote note;
} SurfelListener;

/**
 * How files are read. Of each limit 0 is the default: as much as any file of use has.
 */
typedef struct SurfelLoadOptions {
  /**
   * `SURFEL_STRUCTURE_TYPE_LOAD_OPTIONS`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelLoadOptions)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * What the columns of rows of numbers are, by the words of `surfel render --columns`: `x,y,z,-,r,g,b`; NULL: as the file tells it.
   */
  const char *columns;
  /**
   * Who is told how far it is, and what was noticed; NULL: nobody.
   */
  const struct SurfelListener *listener;
  /**
   * Files that a file names may lie outside of its folder.
   */
  VkBool32 allowOutside;
  /**
   * 0; else it is refused.
   */
  uint32_t reserved;
  /**
   * Points or vertices at most.
   */
  uint64_t mostPoints;
  /**
   * Triangles at most.
   */
  uint64_t mostFaces;
  /**
   * Bytes of a line of text at most.
   */
  uint64_t mostLineBytes;
  /**
   * Bytes of a header of text at most.
   */
  uint64_t mostHeaderBytes;
  /**
   * Corners of a polygon at most.
   */
  uint64_t mostListItems;
  /**
   * Bytes of standard input, of which no size is known beforehand.
   */
  uint64_t mostPipedBytes;
  /**
   * Bytes to which the compressed points of any LAZ or PCD file may expand, however small it is.
   */
  uint64_t expandedBytes;
  /**
   * The same of files that are compressed as a whole.
   */
  uint64_t unpackedBytes;
  /**
   * Bytes to which each byte of a larger compressed file may expand beyond these.
   */
  uint64_t expansion;
  /**
   * The same of the records of LAZ files.
   */
  uint64_t lazExpansion;
} SurfelLoadOptions;

/**
 * What becomes of a model: how it is placed, colored, and as what it is drawn; as an object of a scene file is described.
 */
typedef struct SurfelDescription {
  /**
   * `SURFEL_STRUCTURE_TYPE_DESCRIPTION`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelDescription)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * Its name, as UTF-8; NULL: that of its file, mesh or points.
   */
  const char *name;
  /**
   * A matrix of four columns, from its own coordinates to the scene's: affine, and one that can be undone. NULL: it stays where it is.
   */
  const double *worldFromObject;
  /**
   * So many new splats, spread over the surface of a mesh, or over the part of it that is drawn as splats, up to `UINT32_MAX`; 0: one at each
   * vertex, or as many as that is.
   */
  uint64_t samples;
  /**
   * Which: the same seed gives the same splats.
   */
  uint64_t seed;
  /**
   * As what it is drawn: `SURFEL_REPRESENTATION_*`.
   */
  uint32_t representation;
  /**
   * Of `SURFEL_REPRESENTATION_HYBRID`, which triangles stay: `SURFEL_POLYGONS_*`.
   */
  uint32_t polygons;
  /**
   * The plane's normal, of any length, and d: triangles stay whose middle x has normal · x ≥ d, in the model's own coordinates.
   */
  double plane[4];
  /**
   * A length in the model's own unit.
   */
  double longerThan;
  /**
   * No splats are centered on the edges where triangles and splats meet.
   */
  VkBool32 withoutSampledEdges;
  /**
   * `color` is there.
   */
  VkBool32 hasColor;
  /**
   * Replaces its own colors: linear red, green and blue, 0 to 1.
   */
  float color[3];
  /**
   * Multiplies its own alpha, 0 to 1; 0 is 1.
   */
  float alpha;
  /**
   * The ε of its splats, as in `SurfelSplats`.
   */
  double epsilon;
  /**
   * The same in mean radii.
   */
  double epsilonInRadii;
  /**
   * The same as `auto`.
   */
  VkBool32 autoEpsilon;
  /**
   * 0; else it is refused.
   */
  uint32_t reserved;
} SurfelDescription;

/**
 * A camera by its eye and what it looks at, for `surfel_headless_render`: a host with a frame of its own has matrices (`SurfelFrame`).
 */
typedef struct SurfelCamera {
  /**
   * `SURFEL_STRUCTURE_TYPE_CAMERA`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelCamera)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * The eye, x, y, z.
   */
  double eye[3];
  /**
   * The point in the middle of the picture, another one than the eye.
   */
  double target[3];
  /**
   * The direction that is up in the picture; all 0: +y.
   */
  double up[3];
  /**
   * The vertical field of view in radians; 0: 45 degrees.
   */
  double fovYRad;
  /**
   * The height of the whole picture in the world's unit: rays are parallel, and the field of view means nothing. 0: they meet in the eye.
   */
  double orthographicHeight;
  /**
   * The depth of the near plane, in front of which nothing is drawn; 0: a millionth of the distance from eye to target, or the eye where rays are parallel.
   */
  double near;
  /**
   * Of a picture in pieces, the size of the whole in pixels, of which this is the camera; 0: what is drawn is the whole.
   */
  uint32_t wholeWidth;
  /**
   * Its height.
   */
  uint32_t wholeHeight;
  /**
   * Where the corner of the piece lies in the whole, in pixels.
   */
  double cornerPx[2];
} SurfelCamera;

/**
 * Points on surfaces, by arrays, as scanners see them: normals and radii that they don't have are found from the points nearby.
 */
typedef struct SurfelPoints {
  /**
   * `SURFEL_STRUCTURE_TYPE_POINTS`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelPoints)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * Shown in messages, as UTF-8; NULL: `points`.
   */
  const char *name;
  /**
   * How many there are.
   */
  uint64_t count;
  /**
   * Where: x, y, z of each.
   */
  const double *positions;
  /**
   * Their normals, of any length, x, y, z of each; NULL: there are none.
   */
  const float *normals;
  /**
   * Their radii; NULL: there are none.
   */
  const float *radii;
  /**
   * Red, green, blue and alpha of each, linear, straight, 0 to 1; NULL: all are the opaque gray of surfaces without colors.
   */
  const float *colors;
  /**
   * How many colors there are: `count`, or 1 for all points.
   */
  uint64_t colorCount;
  /**
   * From where all of them were seen, x, y, z, which normals turn toward; NULL: it is not known.
   */
  const double *viewpoint;
} SurfelPoints;

/**
 * How a mesh becomes splats that are cut at its sharp edges.
 */
typedef struct SurfelSharp {
  /**
   * `SURFEL_STRUCTURE_TYPE_SHARP`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelSharp)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * So many splats at most, where the mesh can be simplified so far; 0: one for each triangle, or as few as `maxError` allows.
   */
  uint64_t splats;
  /**
   * The largest error of a simplification, in the mesh's unit; 0: any.
   */
  double maxError;
  /**
   * The least angle between the normals of two triangles at a sharp edge, in radians; 0: 30 degrees.
   */
  double creaseRad;
  /**
   * What cuts splats at sharp edges: `SURFEL_CLIPPING_*`.
   */
  uint32_t clipping;
  /**
   * 0; else it is refused.
   */
  uint32_t reserved;
  /**
   * Who is told how far it is; NULL: nobody.
   */
  const struct SurfelListener *listener;
} SurfelSharp;

/**
 * What is known of disks that a host writes on the device, by a compute shader or by copies. All of it may be wrong by being too large, at
 * the cost of speed, but not by being too small: what lies outside of the bounds may not be drawn.
 *
 * Disk i has 32 bytes in the buffer of shapes: x y z radius, then nx ny nz 2.0, all float: its center from `origin` in the scene's unit, a
 * unit normal. It has 8 bytes in the buffer of colors: linear red, green, blue and alpha as 16-bit fractions of 65535.
 */
typedef struct SurfelDynamicSplats {
  /**
   * `SURFEL_STRUCTURE_TYPE_DYNAMIC_SPLATS`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelDynamicSplats)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * How many there are room for, at most 4 million and what a storage buffer of the device holds at 32 bytes each.
   */
  uint32_t capacity;
  /**
   * How many are drawn, the first ones.
   */
  uint32_t count;
  /**
   * Where positions are counted from.
   */
  double origin[3];
  /**
   * The smallest coordinates of centers, from the origin.
   */
  double least[3];
  /**
   * The largest ones.
   */
  double most[3];
  /**
   * The largest radius.
   */
  double largestRadius;
  /**
   * How many disks lie over a place of the surface, where they are fewest: it tells how much of a pixel a silhouette covers. 0 is 1. Where
   * fewer lie than that, a surface inside of its silhouette shows what is behind it.
   */
  double overlap;
  /**
   * They belong to a closed surface and their normals point outward: those that face away are not drawn.
   */
  VkBool32 closed;
  /**
   * Some may be transparent: they are drawn in layers.
   */
  VkBool32 transparent;
} SurfelDynamicSplats;

/**
 * How a renderer is made.
 */
typedef struct SurfelRendererInfo {
  /**
   * `SURFEL_STRUCTURE_TYPE_RENDERER_INFO`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelRendererInfo)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * The folder in which pipelines are kept from run to run, as UTF-8; NULL: they are not.
   */
  const char *cacheFolder;
} SurfelRendererInfo;

/**
 * What a scene on the device is. `surfel_prepared_scene_info` fills it.
 */
typedef struct SurfelPreparedSceneInfo {
  /**
   * `SURFEL_STRUCTURE_TYPE_PREPARED_SCENE_INFO`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelPreparedSceneInfo)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  void *pNext;
  /**
   * How many splats it has.
   */
  uint64_t splats;
  /**
   * How many triangles it has.
   */
  uint64_t triangles;
  /**
   * Bytes of device memory.
   */
  uint64_t bytes;
  /**
   * Splats that could not be drawn and are not in it.
   */
  uint64_t leftOut;
  /**
   * How many objects it has, for `surfel_update`: of splats, of those that came with their levels of detail, then of triangles.
   */
  uint64_t objects;
  /**
   * Something of it is transparent: frames that show it need `hides` where the rendering has a depth.
   */
  VkBool32 transparent;
  /**
   * 0.
   */
  uint32_t reserved;
  /**
   * Of those left out, each counted once, by the first of these that it has: a coordinate of the center is NaN or infinite.
   */
  uint64_t leftOutCenters;
  /**
   * The normal is zero, NaN or infinite.
   */
  uint64_t leftOutNormals;
  /**
   * The radius is zero, negative, NaN or infinite.
   */
  uint64_t leftOutRadii;
  /**
   * The tangent vectors are zero, collinear, NaN or infinite.
   */
  uint64_t leftOutTangents;
  /**
   * A component of the color is NaN or infinite.
   */
  uint64_t leftOutColors;
  /**
   * A value of a clip curve is NaN or infinite, its weight is negative, or the splat is a disk.
   */
  uint64_t leftOutClips;
} SurfelPreparedSceneInfo;

/**
 * What the host's rendering is, within which a view is drawn: as in `VkPipelineRenderingCreateInfo`.
 */
typedef struct SurfelRendering {
  /**
   * `SURFEL_STRUCTURE_TYPE_RENDERING`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelRendering)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * The formats of its color attachments. The first is drawn to, then come those of `ids` and `motion`; the others are left as they are. For
   * more than one the device needs `SURFEL_FEATURE_INDEPENDENT_BLEND`. None: depth alone is drawn, of what is opaque.
   */
  const VkFormat *colorFormats;
  /**
   * How many there are.
   */
  uint32_t colorFormatCount;
  /**
   * The format of its depth attachment; 0 (`VK_FORMAT_UNDEFINED`): there is none, and all of the view is drawn.
   */
  VkFormat depthFormat;
  /**
   * The format of its stencil attachment, which is left as it is; 0: there is none.
   */
  VkFormat stencilFormat;
  /**
   * Samples of a pixel; 0 is `VK_SAMPLE_COUNT_1_BIT`. All samples of one get the same.
   */
  uint32_t samples;
  /**
   * How depths are compared: `VK_COMPARE_OP_LESS` or, where depth is reversed, `VK_COMPARE_OP_GREATER`, which 0 is, too.
   */
  VkCompareOp compare;
  /**
   * Colors are encoded as sRGB before they are blended: for hosts that keep encoded colors in `UNORM` formats. sRGB formats encode by
   * themselves, and float formats keep linear light.
   */
  VkBool32 encodes;
  /**
   * The second color attachment, `VK_FORMAT_R32_UINT` or `VK_FORMAT_R16_UINT`, gets the number (`SurfelFrame.ids`) of what is seen, wherever
   * depth is written; `SURFEL_NO_ID` where a cut leaves it open. Transparent layers leave it as it is.
   */
  VkBool32 ids;
  /**
   * The second color attachment, or the third with `ids`, `VK_FORMAT_R16G16_SFLOAT` or `VK_FORMAT_R32G32_SFLOAT`, gets motion alike: where the
   * point that is seen is in the picture less where it was in the frame before, in pixels, x to the right and y down; 0 of what was behind
   * the eye. By the cameras as they are given: what they are jittered by is in it.
   */
  VkBool32 motion;
} SurfelRendering;

/**
 * The depth of what a host has drawn so far.
 */
typedef struct SurfelDepthImage {
  /**
   * `SURFEL_STRUCTURE_TYPE_DEPTH_IMAGE`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelDepthImage)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * One sample a pixel, one mip level; usage `VK_IMAGE_USAGE_SAMPLED_BIT`.
   */
  VkImage image;
  /**
   * A view of its depth alone, of one layer.
   */
  VkImageView view;
  /**
   * What was done with it just before; its writes are waited for.
   */
  VkPipelineStageFlags2 beforeStages;
  /**
   * As `beforeStages`.
   */
  VkAccessFlags2 beforeAccess;
  /**
   * What will be done with it just after.
   */
  VkPipelineStageFlags2 afterStages;
  /**
   * As `afterStages`.
   */
  VkAccessFlags2 afterAccess;
  /**
   * The layout in which it is.
   */
  VkImageLayout beforeLayout;
  /**
   * The layout in which it is left.
   */
  VkImageLayout afterLayout;
  /**
   * Its format.
   */
  VkFormat format;
  /**
   * Its width in pixels.
   */
  uint32_t width;
  /**
   * Its height in pixels.
   */
  uint32_t height;
  /**
   * The layer that `view` shows: of an image that has one for each eye, say. All else of the image is left as it is.
   */
  uint32_t layer;
} SurfelDepthImage;

/**
 * What a view shows in a frame, and from where. Matrices are columns of four numbers, 16 in all.
 */
typedef struct SurfelFrame {
  /**
   * `SURFEL_STRUCTURE_TYPE_FRAME`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelFrame)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * What is shown; it may differ from frame to frame, nothing is uploaded by that. One scene may be in it several times.
   */
  const struct SurfelPreparedScene *const *scenes;
  /**
   * A matrix for each scene, one behind the other, from its own space to the world: rotation, scale alike in all directions,
   * translation. NULL: all stand where their own coordinates say.
   */
  const double *worldFromScene;
  /**
   * How; NULL: by the defaults.
   */
  const struct SurfelSettings *settings;
  /**
   * What the host has drawn hides transparent things pixel by pixel between each other: its depth. Needed where anything is transparent
   * and the rendering has a depth. What is opaque is tested by the host's own test when it is drawn.
   */
  const struct SurfelDepthImage *hides;
  /**
   * From world to the host's view space, whatever its axes and its unit: a motion, and one scale of all directions.
   */
  double viewFromWorld[16];
  /**
   * From view to clip space as Vulkan has it; perspective or orthographic, off-center, jittered, depth reversed or not, finite or
   * infinite. Pixels are square.
   */
  double clipFromView[16];
  /**
   * How many scenes there are.
   */
  uint32_t sceneCount;
  /**
   * The viewport has a negative height, so that clip space's y points up in the picture.
   */
  VkBool32 flipsY;
  /**
   * The view's size in pixels.
   */
  uint32_t width;
  /**
   * The view's size in pixels.
   */
  uint32_t height;
  /**
   * Where its left side lies in the host's images, in pixels.
   */
  int32_t x;
  /**
   * Where its top lies.
   */
  int32_t y;
  /**
   * Each pass is timed, for `surfel_view_times`.
   */
  VkBool32 timed;
  /**
   * A frame that needs a pipeline which is not there yet is refused, `SURFEL_RESULT_NOT_READY`, in place of a wait for it; as after any
   * refusal the view has then no frame to draw. `surfel_compile_ahead` makes them.
   */
  VkBool32 refusesMissing;
  /**
   * A matrix for each scene, as in `worldFromScene`, of where it stood in the frame before, for motion. NULL: all stood where they stand.
   */
  const double *worldFromSceneBefore;
  /**
   * A number for each scene, for whoever wants to know what is seen in a pixel. NULL: 0.
   */
  const uint32_t *ids;
  /**
   * Four numbers for each scene, 0 to 1, which its linear red, green and blue and its alpha are multiplied by. An alpha below 1 is for scenes
   * of which all is transparent already. NULL: 1.
   */
  const float *tints;
  /**
   * `viewFromWorld` of the frame before, for motion; all 0: both matrices are what they are now, as `flipsY` and the size are in any case.
   */
  double viewFromWorldBefore[16];
  /**
   * `clipFromView` of the frame before.
   */
  double clipFromViewBefore[16];
  /**
   * All matrices are of a left-handed world, as of Direct3D, Unity or Unreal, in which what the scenes hold is seen mirrored by (1, 1, -1):
   * what comes from there is mirrored once more before, by `surfel_scene_transform`.
   */
  VkBool32 leftHanded;
  /**
   * 0; else it is refused.
   */
  uint32_t reserved;
  /**
   * Not 0: a pipeline that is missing is made as long as no more than so many were made in all (`surfel_pipelines_made`); beyond, the frame is
   * refused, `SURFEL_RESULT_NOT_READY`. A host that asks again and again goes on between.
   */
  uint64_t mostPipelines;
  /**
   * What is measured, for `surfel_view_measured`: `SURFEL_MEASURE_*`; 0: the time of each pass where `timed` says so, else nothing.
   */
  uint32_t measures;
  /**
   * What the matrices show is a mirror's picture, as of a planar reflection: its view is turned over by the mirror's plane, or its projection along x. Refused
   * where it is not said and is, or is said and is not.
   */
  VkBool32 mirrored;
} SurfelFrame;

/**
 * An image of the host's that a view is drawn onto, or one layer of it: with the samples that its rendering has, one mip level.
 */
typedef struct SurfelHostImage {
  /**
   * `SURFEL_STRUCTURE_TYPE_HOST_IMAGE`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelHostImage)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * The image.
   */
  VkImage image;
  /**
   * A view of all of it, or of the layer.
   */
  VkImageView view;
  /**
   * What was done with it just before; that is waited for.
   */
  VkPipelineStageFlags2 beforeStages;
  /**
   * As `beforeStages`.
   */
  VkAccessFlags2 beforeAccess;
  /**
   * What will be done with it just after.
   */
  VkPipelineStageFlags2 afterStages;
  /**
   * As `afterStages`.
   */
  VkAccessFlags2 afterAccess;
  /**
   * The layout in which it is; `VK_IMAGE_LAYOUT_UNDEFINED`: nothing is in it, and it is cleared, color to 0, depth to what is farthest.
   */
  VkImageLayout beforeLayout;
  /**
   * The layout in which it is left.
   */
  VkImageLayout afterLayout;
  /**
   * Its format, which is the rendering's: another one is refused. 0 is not looked at.
   */
  VkFormat format;
  /**
   * What it was created for: without `VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT` or `VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT` it is refused.
   * 0 is not looked at.
   */
  VkImageUsageFlags usage;
  /**
   * Its width in pixels: what does not hold the view's area is refused. Where width and height are 0 they are not looked at.
   */
  uint32_t width;
  /**
   * Its height in pixels.
   */
  uint32_t height;
  /**
   * `familyBefore` and `familyAfter` count. 0: the image is shared, or the family of the queue has it, and keeps it.
   */
  VkBool32 changesFamily;
  /**
   * The family of queues that has it before: it is acquired from there, in `beforeLayout`. That family's queue has released it to
   * `VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL` or `…_DEPTH_STENCIL_ATTACHMENT_OPTIMAL`, and a semaphore orders both. `VK_QUEUE_FAMILY_IGNORED`: ours has it already.
   */
  uint32_t familyBefore;
  /**
   * The family that it is released to, from that layout to `afterLayout`, which acquires it then.
   * `VK_QUEUE_FAMILY_IGNORED`: it stays with ours.
   */
  uint32_t familyAfter;
  /**
   * The layer that `view` shows: of an image that has one for each eye, say. All else of the image is left as it is.
   */
  uint32_t layer;
} SurfelHostImage;

/**
 * Is told of a piece, as a host's allocator will be asked for it; valid during the call. Must return.
 */
typedef void (*SurfelMemoryPiece)(void *user, const struct SurfelMemoryRequest *piece);

/**
 * A block of memory with room for some pieces, one behind the other.
 */
typedef struct SurfelMemoryBlock {
  /**
   * How many bytes.
   */
  uint64_t bytes;
  /**
   * Of its first byte.
   */
  uint64_t alignment;
  /**
   * A bit for each type of memory that will do for all of them, as in `VkMemoryRequirements`.
   */
  uint32_t memoryTypeBits;
  /**
   * How many pieces.
   */
  uint32_t pieces;
} SurfelMemoryBlock;

/**
 * What memory will be asked for, told before. `surfel_scene_needs` and `surfel_view_needs` fill it.
 */
typedef struct SurfelMemoryNeeds {
  /**
   * `SURFEL_STRUCTURE_TYPE_MEMORY_NEEDS`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelMemoryNeeds)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  void *pNext;
  /**
   * All of it in one block.
   */
  struct SurfelMemoryBlock all;
  /**
   * What only the device touches.
   */
  struct SurfelMemoryBlock ofDevice;
  /**
   * What the host's processor writes: it must be mapped, and coherent. Of scenes what is copied from, which goes once that has run.
   */
  struct SurfelMemoryBlock writtenByHost;
} SurfelMemoryNeeds;

/**
 * Is told of a pass: its name, valid during the call, and its seconds, below 0 where they were not measured. Must return.
 */
typedef void (*SurfelPassTime)(void *user, const char *name, double secs);

/**
 * What a pass cost.
 */
typedef struct SurfelPassFigures {
  /**
   * Its name, as UTF-8, valid during the call.
   */
  const char *name;
  /**
   * Its seconds; below 0 where they were not measured.
   */
  double secs;
  /**
   * Invocations of its vertex stage; `UINT64_MAX` where they were not counted, or it doesn't draw.
   */
  uint64_t vertices;
  /**
   * Those of its fragment stage alike.
   */
  uint64_t fragments;
  /**
   * Those of its compute stage; `UINT64_MAX` where they were not counted, or it doesn't dispatch.
   */
  uint64_t invocations;
} SurfelPassFigures;

/**
 * Is told of a pass, by figures that are valid during the call. Must return.
 */
typedef void (*SurfelPassMeasured)(void *user, const struct SurfelPassFigures *figures);

/**
 * What is seen in a pixel of one scene. `surfel_pick_read` fills it.
 */
typedef struct SurfelPicked {
  /**
   * `SURFEL_STRUCTURE_TYPE_PICKED`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelPicked)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  void *pNext;
  /**
   * `SURFEL_PICKED_*`; of nothing, all that follows is 0.
   */
  uint32_t kind;
  /**
   * The number of the splat or triangle in its object; `UINT32_MAX` where the scene was not made `numbered`, or nobody knows it.
   */
  uint32_t number;
  /**
   * The number of its object.
   */
  uint64_t object;
  /**
   * Where the ray through the pixel's center meets it, in the world.
   */
  double position[3];
  /**
   * Its unit normal there, toward the eye.
   */
  double normal[3];
  /**
   * How far that is from the eye.
   */
  double distance;
  /**
   * Its depth along the view's axis.
   */
  double depth;
} SurfelPicked;

/**
 * How a device of our own is opened.
 */
typedef struct SurfelHeadlessInfo {
  /**
   * `SURFEL_STRUCTURE_TYPE_HEADLESS_INFO`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelHeadlessInfo)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * The device: its index, or a part of its name; NULL: the best one.
   */
  const char *device;
  /**
   * The folder in which pipelines are kept from run to run, as UTF-8; NULL: they are not.
   */
  const char *cacheFolder;
  /**
   * The validation layer watches (`surfel_headless_messages`).
   */
  VkBool32 validates;
  /**
   * 0; else it is refused.
   */
  uint32_t reserved;
} SurfelHeadlessInfo;

/**
 * A frame of such a device.
 */
typedef struct SurfelHeadlessFrame {
  /**
   * `SURFEL_STRUCTURE_TYPE_HEADLESS_FRAME`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelHeadlessFrame)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  const void *pNext;
  /**
   * What is shown, of `surfel_headless_prepare`.
   */
  const struct SurfelPreparedScene *scene;
  /**
   * From where.
   */
  const struct SurfelCamera *camera;
  /**
   * How; NULL: by the defaults. `background` is that of the picture; several `samples` of a pixel are taken one after the other.
   */
  const struct SurfelSettings *settings;
  /**
   * The picture's size in pixels.
   */
  uint32_t width;
  /**
   * Its height.
   */
  uint32_t height;
  /**
   * Its pixels are linear 32-bit floats in place of 8-bit sRGB.
   */
  VkBool32 linear;
  /**
   * There is no picture: what is wanted is only drawn, or its surface.
   */
  VkBool32 withoutPicture;
  /**
   * The surface is wanted, too: weights, albedo, normals and depth.
   */
  VkBool32 surface;
  /**
   * What is measured, for `surfel_headless_measured`: `SURFEL_MEASURE_*`.
   */
  uint32_t measures;
} SurfelHeadlessFrame;

/**
 * A picture that was drawn: row by row, the top one first. `surfel_headless_render` fills it; the arrays stay as they are until the next call of it with the same object, or that is destroyed. NULL is what was not wanted.
 */
typedef struct SurfelPicture {
  /**
   * `SURFEL_STRUCTURE_TYPE_PICTURE`.
   */
  uint32_t sType;
  /**
   * `sizeof(SurfelPicture)`.
   */
  uint32_t size;
  /**
   * NULL.
   */
  void *pNext;
  /**
   * Its size in pixels.
   */
  uint32_t width;
  /**
   * Its height.
   */
  uint32_t height;
  /**
   * Red, green, blue (sRGB) and alpha (linear, straight) of each pixel, for `surfel_save_png`.
   */
  const uint8_t *srgb;
  /**
   * The same as linear floats, for `surfel_save_exr`.
   */
  const float *linear;
  /**
   * The sum of weights of each pixel.
   */
  const float *weight;
  /**
   * Linear red, green and blue of each pixel before shading; the fourth is 1 where it is covered.
   */
  const float *albedo;
  /**
   * The unit normal in view space (x right, y down, z forward); the fourth is 1 where it is covered.
   */
  const float *normal;
  /**
   * The depth along the view's axis, infinite where there is nothing.
   */
  const float *depth;
  /**
   * Seconds from the submission to the end of the wait for it.
   */
  double wallSecs;
  /**
   * Seconds in which it was recorded.
   */
  double recordSecs;
} SurfelPicture;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * The version of the library that runs, as `SURFEL_VERSION` is that of the header that was compiled with. Before 1.0 both must have the
 * same minor number, then the same major number.
 */
uint32_t surfel_version(void);

/**
 * Why the last call of this thread that failed did, in a sentence that begins with the function's name; empty where none has. Valid until
 * the next call of this thread that fails.
 */
const char *surfel_last_error(void);

/**
 * Tells what a device of `physicalDevice` must be created with. `instance` must be of Vulkan 1.3. Where the device lacks something,
 * `requirements` is filled all the same, the answer is `SURFEL_RESULT_NO_DEVICE`, and `surfel_last_error` names what is missing.
 */
SurfelResult surfel_requirements(VkInstance instance,
                                 VkPhysicalDevice physicalDevice,
                                 PFN_vkGetInstanceProcAddr getInstanceProcAddr,
                                 struct SurfelRequirements *requirements);

/**
 * Enables features (`SURFEL_FEATURE_…`) in the structs that a device is created with: sets those, leaves all others as they are.
 */
SurfelResult surfel_enable_features(uint64_t features,
                                    VkPhysicalDeviceFeatures *core,
                                    VkPhysicalDeviceVulkan12Features *vulkan12,
                                    VkPhysicalDeviceVulkan13Features *vulkan13);

/**
 * Takes a host's device; what it lacks is named, and the answer then is `SURFEL_RESULT_NO_DEVICE`. All handles must belong together and
 * stay alive until every object made from this device is destroyed; before the last one is, all submissions of commands that were
 * recorded by them must have finished. Then the host's device is as it was.
 */
SurfelResult surfel_device_import(const struct SurfelImport *host, struct SurfelDevice **device);

/**
 * Ends the epoch in which commands were recorded: to be called at each submission that contains our commands; where several threads submit,
 * both are one step. `epoch` gets its number; what is destroyed from now on waits for the next one.
 */
SurfelResult surfel_device_end_epoch(const struct SurfelDevice *device, uint64_t *epoch);

/**
 * Frees all that was destroyed up to the end of an epoch. The device must have finished every submission up to the one at which
 * `surfel_device_end_epoch` gave `epoch`.
 */
SurfelResult surfel_device_epoch_done(const struct SurfelDevice *device, uint64_t epoch);

/**
 * As `surfel_device_end_epoch`, by the value that the host's own timeline semaphore has once the device has finished the submission. Values rise from call to call, by
 * whichever steps; one that does not is refused, and the epoch goes on.
 */
SurfelResult surfel_device_end_epoch_at(const struct SurfelDevice *device,
                                        uint64_t value);

/**
 * As `surfel_device_epoch_done`, for all epochs that were ended by this value or one below (`surfel_device_end_epoch_at`): with what `vkGetSemaphoreCounterValue` tells of the host's timeline
 * semaphore.
 */
SurfelResult surfel_device_timeline_at(const struct SurfelDevice *device,
                                       uint64_t value);

/**
 * Tells how much device memory our objects have: bytes in use, and bytes that are taken from the device for it.
 */
SurfelResult surfel_device_memory(const struct SurfelDevice *device, uint64_t *used, uint64_t *held);

/**
 * Tells what device memory is for, and how much the process may have. It takes nothing from the heap.
 */
SurfelResult surfel_device_memory_report(const struct SurfelDevice *device, struct SurfelMemoryReport *report);

/**
 * Lets go of a device; NULL is nothing. What was made from it may be destroyed later, and all must be before the host's own device is.
 */
void surfel_device_destroy(struct SurfelDevice *device);

/**
 * Makes a scene of nothing. `info` may be NULL.
 */
SurfelResult surfel_scene_create(const struct SurfelSceneInfo *info, struct SurfelScene **scene);

/**
 * Says how splats are kept on a device, by words: `order` is `morton` or `input`, `splat-format` is `exact` or `packed`.
 */
SurfelResult surfel_scene_set(struct SurfelScene *scene, const char *name, const char *value);

/**
 * Adds a light, by words: `eye`, or `direction=x,y,z` in which it travels; and `color=r,g,b` (sRGB, 0 to 1) and `intensity=i` where they
 * are not 1; with commas between; at most 16. A scene without lights has a white one at the eye.
 */
SurfelResult surfel_scene_add_light(struct SurfelScene *scene, const char *light);

/**
 * Adds an object of splats; its arrays are copied.
 */
SurfelResult surfel_scene_add_splats(struct SurfelScene *scene, const struct SurfelSplats *splats);

/**
 * Moves all that is in a scene so far, but its lights and lengths of ε, by a matrix of four columns: turns, scales, mirrors or shears it, each splat and
 * triangle for itself. So what comes from a left-handed world, and is to be seen there, is mirrored once (`leftHanded` in `SurfelFrame`). Not
 * for what a file has levels of detail of.
 */
SurfelResult surfel_scene_transform(struct SurfelScene *scene,
                                    const double *worldFromObject);

/**
 * Destroys a scene in the host's memory; NULL is nothing. What was made of it on a device stays.
 */
void surfel_scene_destroy(struct SurfelScene *scene);

/**
 * Tells what a scene holds.
 */
SurfelResult surfel_scene_contents(const struct SurfelScene *scene, struct SurfelSceneContents *contents);

/**
 * Tells the box around all splats and triangles that can be drawn: `least` and `most` get three coordinates each.
 */
SurfelResult surfel_scene_bounds(const struct SurfelScene *scene, double *least, double *most);

/**
 * Tells a ball around all that is in a scene, for a camera: `center` gets three coordinates.
 */
SurfelResult surfel_scene_ball(const struct SurfelScene *scene, double *center, double *radius);

/**
 * The same around the objects of this name, of splats and of triangles.
 */
SurfelResult surfel_scene_ball_named(const struct SurfelScene *scene, const char *name, double *center, double *radius);

/**
 * Tells the name of an object of splats, as `surfel_prepared_scene_object_name` does.
 */
SurfelResult surfel_scene_object_name(const struct SurfelScene *scene, uint64_t object, char *name, uint64_t capacity, uint64_t *length);

/**
 * Tells the splats of an object: `splats` gets their count, their arrays, and whether they are `closed`; as they would be given to `surfel_scene_add_splats`, but for
 * name, ε, room and clip curves. The arrays are the scene's, and stay as they are until it is changed or destroyed; colors that are all the same are one.
 */
SurfelResult surfel_scene_object_splats(const struct SurfelScene *scene,
                                        uint64_t object,
                                        struct SurfelSplats *splats);

/**
 * Copies what is cut off the splats of an object, from number `first` on, to `count` places.
 */
SurfelResult surfel_scene_object_clips(const struct SurfelScene *scene,
                                       uint64_t object,
                                       uint64_t first,
                                       uint64_t count,
                                       struct SurfelClip *clips);

/**
 * Adds an object of splats with its levels of detail; its arrays are copied. For numbers of objects it is behind all objects of splats alone, and before those of triangles.
 */
SurfelResult surfel_scene_add_levels(struct SurfelScene *scene,
                                     const struct SurfelLevels *levels);

/**
 * Adds an object of triangles; its arrays are copied. For `surfel_update` it is behind all objects of splats.
 */
SurfelResult surfel_scene_add_mesh(struct SurfelScene *scene, const struct SurfelMesh *mesh);

/**
 * Gives a mesh of the scene levels of detail; its arrays are copied.
 */
SurfelResult surfel_scene_add_hybrid_levels(struct SurfelScene *scene, const struct SurfelHybridLevels *levels);

/**
 * Adds what a file holds, as `surfel render` shows it: splats, a mesh or points of any format that the library was built with, or all
 * objects and lights of a scene file (`.toml`). `path` is UTF-8; on Unix any bytes that are a path. Files that a file names are opened in
 * its folder or below.
 */
SurfelResult surfel_scene_add_file(struct SurfelScene *scene, const char *path);

/**
 * The same, read as `options` say and drawn as `description` says; both may be NULL. A scene file describes its objects itself:
 * `description` is NULL then.
 */
SurfelResult surfel_scene_add_file_as(struct SurfelScene *scene,
                                      const char *path,
                                      const struct SurfelLoadOptions *options,
                                      const struct SurfelDescription *description);

/**
 * The same of a file of `count` bytes that is in memory, such as a part of an archive. `name` is its name in messages, and its ending tells the format where
 * the content leaves that open. No other file is opened, and it is no scene file.
 */
SurfelResult surfel_scene_add_file_of_memory(struct SurfelScene *scene,
                                             const char *name,
                                             const uint8_t *bytes,
                                             uint64_t count,
                                             const struct SurfelLoadOptions *options,
                                             const struct SurfelDescription *description);

/**
 * Tells the camera of a scene file for a picture of this size, of which what the file leaves open comes from `scene`, into which it was added; and sets of `settings`, which may be NULL, what the file says of the
 * picture. `options` may be NULL.
 */
SurfelResult surfel_scene_file_camera(const struct SurfelScene *scene,
                                      const char *path,
                                      const struct SurfelLoadOptions *options,
                                      uint32_t width,
                                      uint32_t height,
                                      struct SurfelCamera *camera,
                                      struct SurfelSettings *settings);

/**
 * Adds what `description` makes of a mesh: splats at its vertices or spread over it, its triangles, or both. NULL: what shows it best. Arrays are copied. `listener` may be NULL.
 */
SurfelResult surfel_scene_add_mesh_as(struct SurfelScene *scene,
                                      const struct SurfelMesh *mesh,
                                      const struct SurfelDescription *description,
                                      const struct SurfelListener *listener);

/**
 * Adds the splats of points, which close the surface that they lie on. Of `description`, which may be NULL, name, place, color, alpha and ε count; points have no triangles. Arrays are copied. `listener` may be NULL.
 */
SurfelResult surfel_scene_add_points(struct SurfelScene *scene,
                                     const struct SurfelPoints *points,
                                     const struct SurfelDescription *description,
                                     const struct SurfelListener *listener);

/**
 * Adds a mesh as splats that are cut at its sharp edges, one for each triangle or fewer. The mesh must be a surface: each edge of one triangle or two, which pass it in opposite
 * directions. `options` may be NULL. Arrays are copied.
 */
SurfelResult surfel_scene_add_sharp_mesh(struct SurfelScene *scene,
                                         const struct SurfelMesh *mesh,
                                         const struct SurfelSharp *options);

/**
 * Writes the splats of an object as a PLY file, with clip curves and whether they are `closed`, from which `surfel_scene_add_file` reads the same ones; those that can't be drawn, too. `up`, three numbers, is the direction
 * that is up, which the file then tells; NULL: it does not. `path` as in `surfel_scene_add_file`; `listener` may be NULL.
 */
SurfelResult surfel_scene_save_splats(const struct SurfelScene *scene,
                                      uint64_t object,
                                      const char *path,
                                      const double *up,
                                      const struct SurfelListener *listener);

/**
 * Writes a PNG of 8 bits a channel: sRGB bytes row by row from the top left, with red, green and blue where `channels` is 3, and straight alpha where it is 4.
 */
SurfelResult surfel_save_png(const char *path,
                             uint32_t width,
                             uint32_t height,
                             uint32_t channels,
                             const uint8_t *pixels);

/**
 * Writes an OpenEXR file of 32-bit floats, without loss: all channels of a pixel together, row by row from the top left. `channels` leads to their names, such as `R`, `G`, `B`, `A` or `Z`.
 */
SurfelResult surfel_save_exr(const char *path,
                             uint32_t width,
                             uint32_t height,
                             const char *const *channels,
                             uint32_t channelCount,
                             const float *values);

/**
 * Gives a scene on the device other lights, each by words as `surfel_scene_add_light` has them, at most 16; none: a white one at the eye.
 * Frames show them that are prepared later; where it had none before, or has none now, they may need other pipelines. `scene` may be one of
 * `surfel_dynamic_create`. Nothing else may use it meanwhile.
 */
SurfelResult surfel_prepared_scene_set_lights(struct SurfelPreparedScene *scene, const char *const *lights, uint32_t count);

/**
 * Tells the name of an object of a scene on the device, by its number as `surfel_pick_read` tells it and `surfel_update` takes it: the file's, or the one that it was given. `length` is how many bytes the name has. Of
 * these, and a closing zero, at most `capacity` are written to `name`, the last one a zero; `name` may be NULL where `capacity` is 0.
 */
SurfelResult surfel_prepared_scene_object_name(const struct SurfelPreparedScene *scene,
                                               uint64_t object,
                                               char *name,
                                               uint64_t capacity,
                                               uint64_t *length);

/**
 * Makes a scene of splats that the host writes on the device: each time before a frame reads them, with a barrier to
 * `VK_ACCESS_2_SHADER_STORAGE_READ_BIT` of the compute and vertex stages. Nothing is in its buffers yet.
 */
SurfelResult surfel_dynamic_create(const struct SurfelRenderer *renderer,
                                   const struct SurfelDynamicSplats *splats,
                                   struct SurfelPreparedScene **scene);

/**
 * Says anew what is known of such splats, for frames that are recorded from now on: as many as there is room for, anywhere. `capacity`, `closed` and `transparent`
 * stay as they were. No other thread may use the scene meanwhile.
 */
SurfelResult surfel_dynamic_set(struct SurfelPreparedScene *scene,
                                const struct SurfelDynamicSplats *splats);

/**
 * Tells the shape of a disk as it lies in the buffer of shapes: `shape` gets 8 numbers. `center` is counted from `origin`, `normal` is a unit vector.
 */
SurfelResult surfel_dynamic_shape(const float *center,
                                  float radius,
                                  const float *normal,
                                  float *shape);

/**
 * Tells a linear color with its alpha as it lies in the buffer of colors: `packed` gets 4 numbers.
 */
SurfelResult surfel_dynamic_color(const float *rgba, uint16_t *packed);

/**
 * Tells the buffers of such splats: usage `VK_BUFFER_USAGE_STORAGE_BUFFER_BIT` and `VK_BUFFER_USAGE_TRANSFER_DST_BIT`. They are the scene's.
 */
SurfelResult surfel_dynamic_buffers(const struct SurfelPreparedScene *scene,
                                    VkBuffer *shapes,
                                    VkBuffer *colors);

/**
 * Makes a renderer. `info` may be NULL.
 */
SurfelResult surfel_renderer_create(const struct SurfelDevice *device,
                                    const struct SurfelRendererInfo *info,
                                    struct SurfelRenderer **renderer);

/**
 * Destroys a renderer; NULL is nothing. Its views go on.
 */
void surfel_renderer_destroy(struct SurfelRenderer *renderer);

/**
 * Records the upload of a scene, which frames recorded later may show; `scene` may be destroyed at once. `commands` must be recording,
 * outside of rendering, and be submitted to the device's queue before frames that show the scene, in any epoch; the scene on the device is destroyed after they have run, or if they never run. Where this fails, they hold
 * copies to what is gone, and must not be submitted. Splats that can't be drawn are left out and counted.
 */
SurfelResult surfel_upload(const struct SurfelRenderer *renderer,
                           VkCommandBuffer commands,
                           const struct SurfelScene *scene,
                           struct SurfelPreparedScene **prepared);

/**
 * Records a change of splats of a scene that was made `updatable`: of its object with this number, those from number `first` on become `splats`, of
 * which name, `closed` and `epsilon` mean nothing: of the object's own kind (disks or ellipses; opaque where the object is). How much the
 * surface overlaps itself, and how near another one is, is not measured again. Frames recorded from now on show it. `commands` must be recording,
 * outside of rendering, and be submitted before `surfel_device_end_epoch` is called; arrays are copied at once, into memory that the renderer keeps, and nothing waits. Where this fails, nothing is recorded. No other thread may use the scene
 * meanwhile.
 */
SurfelResult surfel_update(const struct SurfelRenderer *renderer,
                           VkCommandBuffer commands,
                           struct SurfelPreparedScene *scene,
                           uint64_t object,
                           uint32_t first,
                           const struct SurfelSplats *splats);

/**
 * Tells what a scene on the device is.
 */
SurfelResult surfel_prepared_scene_info(const struct SurfelPreparedScene *scene, struct SurfelPreparedSceneInfo *info);

/**
 * Destroys a scene on the device; NULL is nothing. Its memory is freed when the epoch that is recorded now is done.
 */
void surfel_prepared_scene_destroy(struct SurfelPreparedScene *scene);

/**
 * Records that splats are added to an object which has `room`, behind the last one there; `first` is the number of the first then, the others follow. By them `surfel_update` changes
 * and `surfel_remove` removes them: numbers of others stay. `first` may be NULL. All else is as of `surfel_update`; an object without enough room behind its last splat is refused.
 */
SurfelResult surfel_append(const struct SurfelRenderer *renderer,
                           VkCommandBuffer commands,
                           struct SurfelPreparedScene *scene,
                           uint64_t object,
                           const struct SurfelSplats *splats,
                           uint32_t *first);

/**
 * Records that `count` splats from number `first` on are taken out of an object which has `room`; numbers that have none are left alone. All else is as of `surfel_update`.
 */
SurfelResult surfel_remove(const struct SurfelRenderer *renderer,
                           VkCommandBuffer commands,
                           struct SurfelPreparedScene *scene,
                           uint64_t object,
                           uint32_t first,
                           uint32_t count);

/**
 * Tells how many splats `surfel_append` has room for yet, behind the last one that an object has there; 0 of one without room.
 */
SurfelResult surfel_room_of(const struct SurfelPreparedScene *scene, uint64_t object, uint32_t *splats);

/**
 * Makes settings: each has its default.
 */
SurfelResult surfel_settings_create(struct SurfelSettings **settings);

/**
 * Sets one to a value, both by the words of `surfel render --help` without the dashes, such as `shading` and `lambert`. `size` and
 * `background` have no effect: the frame's size and the host's picture take their place.
 */
SurfelResult surfel_settings_set(struct SurfelSettings *settings, const char *name, const char *value);

/**
 * Tells the value of one, by the words that would set it: how many bytes they have in `length`, and of these, and a closing zero, at most `capacity` in `value`, the last one a zero; `value` may be NULL where
 * `capacity` is 0.
 */
SurfelResult surfel_settings_get(const struct SurfelSettings *settings,
                                 const char *name,
                                 char *value,
                                 uint64_t capacity,
                                 uint64_t *length);

/**
 * Destroys settings; NULL is nothing.
 */
void surfel_settings_destroy(struct SurfelSettings *settings);

/**
 * Makes a view to be drawn within such a rendering. Its pipelines are made here.
 */
SurfelResult surfel_view_create(const struct SurfelRenderer *renderer, const struct SurfelRendering *rendering, struct SurfelView **view);

/**
 * Records the passes of a frame: all but its draws. `commands` must be recording, outside of rendering, without an active query, and be
 * submitted to the device's queue, after those of the frame prepared before in this view, whose draws are recorded before: what the host writes for a frame is kept apart until
 * its epoch is done. View and scenes must not be destroyed before the submission, and the images of `hides` not before it has finished.
 */
SurfelResult surfel_view_prepare(struct SurfelView *view,
                                 VkCommandBuffer commands,
                                 const struct SurfelFrame *frame);

/**
 * Records the draws of the frame that was prepared: up to three triangles. `commands` are those of `surfel_view_prepare`, or others that
 * are submitted after them to the same queue; they are inside of a rendering as the view was made for, which covers the view's area.
 * Clobbers viewport and scissor, and of the graphics bind point the pipeline, all sets and push constants.
 */
SurfelResult surfel_view_draw(const struct SurfelView *view, VkCommandBuffer commands);

/**
 * Records all of a frame: `surfel_view_prepare`, then a rendering onto these images with `surfel_view_draw` in it, and barriers around it.
 * `colors` leads to as many pointers as the rendering that the view was made for has formats, each to an image, NULL where a format is 0.
 * `depth`: NULL where the rendering has none. The images hold the view's area, and must not be destroyed before the commands have run.
 */
SurfelResult surfel_view_record(struct SurfelView *view,
                                VkCommandBuffer commands,
                                const struct SurfelFrame *frame,
                                const struct SurfelHostImage *const *colors,
                                uint32_t colorCount,
                                const struct SurfelHostImage *depth);

/**
 * Tells how many bytes of device memory a view holds.
 */
SurfelResult surfel_view_bytes(const struct SurfelView *view, uint64_t *bytes);

/**
 * Destroys a view; NULL is nothing. Its memory is freed when the epoch that is recorded now is done.
 */
void surfel_view_destroy(struct SurfelView *view);

/**
 * Tells what memory `surfel_upload` of a scene will ask for; takes none of the device's, but as long as the upload on the host. `granularity` is Vulkan's `bufferImageGranularity` where buffers and images
 * lie in one block; else 1. `each` is told of the pieces in the order in which they will be asked for; it, `user` and `needs` may be NULL. `measured`, which may be NULL, gets the scene as it would be uploaded, but on no
 * device: for frames that `surfel_view_needs` is asked of; others refuse it. It is destroyed as any other.
 */
SurfelResult surfel_scene_needs(const struct SurfelRenderer *renderer,
                                const struct SurfelScene *scene,
                                uint64_t granularity,
                                SurfelMemoryPiece each,
                                void *user,
                                struct SurfelMemoryNeeds *needs,
                                struct SurfelPreparedScene **measured);

/**
 * Tells what memory the first `surfel_view_prepare` of a new view will ask for, for a frame like this, of scenes that are on the device or of `surfel_scene_needs`; of the first frame of a renderer with what that has of its
 * own. Takes none of the device's, and makes no pipeline. Frames of the view that need no more of any piece ask for nothing; how much one needs follows from which splats may be seen, and so from its camera. The other arguments are those of `surfel_scene_needs`.
 */
SurfelResult surfel_view_needs(const struct SurfelRenderer *renderer,
                               const struct SurfelRendering *rendering,
                               const struct SurfelFrame *frame,
                               uint64_t granularity,
                               SurfelMemoryPiece each,
                               void *user,
                               struct SurfelMemoryNeeds *needs);

/**
 * Tells how long each pass took of the frame that was prepared last, in their order, once it has finished; nothing if it was not `timed`.
 */
SurfelResult surfel_view_times(const struct SurfelView *view, SurfelPassTime each, void *user);

/**
 * Tells what each pass cost of the frame that was prepared last, in their order, once it has finished, as `measures` in `SurfelFrame` asked for; and the frame's own seconds in `spanSecs`, which may be NULL, below 0 where
 * they were not measured. Takes nothing from the heap.
 */
SurfelResult surfel_view_measured(const struct SurfelView *view,
                                  SurfelPassMeasured each,
                                  void *user,
                                  double *spanSecs);

/**
 * Tells how many pipelines a renderer has made so far: a frame during which that stays the same has made none.
 */
SurfelResult surfel_pipelines_made(const struct SurfelRenderer *renderer, uint64_t *made);

/**
 * Makes all pipelines that frames like this need within such a rendering, wherever their cameras are: `surfel_view_prepare` makes none for
 * them then. Nothing is recorded. `made` gets how many were missing; it may be NULL. It may take long: while the host loads, or on a thread
 * of its own, while others draw with what is there. A frame is like this that shows scenes of the same kinds (opaque or transparent, disks
 * or ellipses, closed or not, packed or not, with clip curves, levels of detail, polygons or lights, all of this or none), no more objects and splats of
 * each, tinted or not as here; by the same settings, but for a budget, clip planes that are other ones, and a picture of this size or a
 * smaller one; with a camera of the same projection, perspective or parallel, anywhere: from far off, where a splat is less than a pixel, to
 * among splats that are larger than the picture; and with `hides` as here.
 */
SurfelResult surfel_compile_ahead(const struct SurfelRenderer *renderer,
                                  const struct SurfelRendering *rendering,
                                  const struct SurfelFrame *frame,
                                  uint64_t *made);

/**
 * Records a look at one pixel of a frame, from its top left corner, of its scene with this number: of several scenes a host looks at each, and takes the nearest. `commands` must be recording, outside of rendering, and be
 * submitted to the device's queue. Once they have run, `surfel_pick_read` tells what is there. What the host draws, and what hides, is not looked at. Clip planes of the settings are for scenes that stand where they are (`worldFromScene` is NULL, or without motion).
 * Takes memory of the device, for the pick alone.
 */
SurfelResult surfel_pick(const struct SurfelDevice *device,
                         const struct SurfelRenderer *renderer,
                         VkCommandBuffer commands,
                         const struct SurfelFrame *frame,
                         uint32_t scene,
                         uint32_t x,
                         uint32_t y,
                         struct SurfelPick **pick);

/**
 * Tells what a look at a pixel has found, once its commands have run. `scene` is the one that was looked at, which must not have changed since.
 */
SurfelResult surfel_pick_read(const struct SurfelPick *pick,
                              const struct SurfelPreparedScene *scene,
                              struct SurfelPicked *picked);

/**
 * Destroys what a look at a pixel has; NULL is nothing. It is freed when the epoch that is recorded now is done.
 */
void surfel_pick_destroy(struct SurfelPick *pick);

/**
 * Fills a camera that shows all of a ball (`surfel_scene_ball`) in a picture of this size, looking along -z with +y up. `fovYRad` is its vertical field of view; 0: 45 degrees.
 */
SurfelResult surfel_camera_fit(const double *center,
                               double radius,
                               uint32_t width,
                               uint32_t height,
                               double fovYRad,
                               struct SurfelCamera *camera);

/**
 * Opens a device of our own: the loader of Vulkan is looked for by name. `info` may be NULL. Where no device will do, or there is no loader, the answer is `SURFEL_RESULT_NO_DEVICE`; of a name that none has, `SURFEL_RESULT_OPTION`.
 */
SurfelResult surfel_headless_create(const struct SurfelHeadlessInfo *info,
                                    struct SurfelHeadless **headless);

/**
 * Tells the name of the device, as `surfel_prepared_scene_object_name` does.
 */
SurfelResult surfel_headless_device_name(const struct SurfelHeadless *headless, char *name, uint64_t capacity, uint64_t *length);

/**
 * Gives the device, for `surfel_device_memory` and `surfel_device_memory_report`: its epochs are ended, and told to be done, by `surfel_headless_render` and `surfel_headless_prepare` alone. To be destroyed as any other.
 */
SurfelResult surfel_headless_device(const struct SurfelHeadless *headless,
                                    struct SurfelDevice **device);

/**
 * Tells how many messages the validation layer has given so far, of a device that it watches.
 */
SurfelResult surfel_headless_messages(const struct SurfelHeadless *headless, uint64_t *count);

/**
 * Brings a scene to the device, and waits for that; `scene` may be destroyed at once. `listener` may be NULL.
 */
SurfelResult surfel_headless_prepare(const struct SurfelHeadless *headless,
                                     const struct SurfelScene *scene,
                                     const struct SurfelListener *listener,
                                     struct SurfelPreparedScene **prepared);

/**
 * Draws a picture, and waits for it. Where this fails, `picture` is as it was, and what it led to before is gone.
 */
SurfelResult surfel_headless_render(struct SurfelHeadless *headless,
                                    const struct SurfelHeadlessFrame *frame,
                                    struct SurfelPicture *picture);

/**
 * Tells what each pass cost of the picture that was drawn last, as `surfel_view_measured` does.
 */
SurfelResult surfel_headless_measured(const struct SurfelHeadless *headless, SurfelPassMeasured each, void *user, double *spanSecs);

/**
 * Gives back the memory that pictures are drawn in, of a program that draws none for a while.
 */
SurfelResult surfel_headless_forget(struct SurfelHeadless *headless);

/**
 * Destroys a device of our own; NULL is nothing. Scenes that were brought there may be destroyed later.
 */
void surfel_headless_destroy(struct SurfelHeadless *headless);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* SURFEL_H */
