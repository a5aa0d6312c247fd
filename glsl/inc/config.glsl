// Numbers that shaders and host share. build.rs makes a constant of `surfel::shaders::config` of each; what stands behind a number
// becomes its documentation.

// Specialization constants.
#define SPEC_ELLIPSES 0       // Constant: splats carry tangent vectors; else a normal and a radius.
#define SPEC_CULL_BACKFACES 1 // Constant: splats that face away are not drawn; else their normals are turned to the eye.
#define SPEC_FILTER 2         // Constant: one of `FILTER_*`.
#define SPEC_KERNEL 3         // Constant: one of `KERNEL_*`.
#define SPEC_KERNEL_A 4       // Constant: log2(e) / (2 sigma^2) of a Gaussian, log2(e) a of psi_e.
#define SPEC_KERNEL_N 5       // Constant: n of psi_e.
#define SPEC_SHADING 6        // Constant: one of `SHADING_*`.
#define SPEC_RASTERIZER 7     // Constant: one of `RASTERIZER_*`.
#define SPEC_WEIGHT_BY_AREA 8 // Constant: splats that a filter enlarged weigh their old area over the new one; else 1.
#define SPEC_COVERAGE_R2 10   // Constant: the largest u^2 + v^2 that covers; below 1 where the kernel ends earlier.
#define SPEC_FROM_CORNER 11   // Constant: places may be counted from the image's corner (`inc/places.glsl`).
#define SPEC_TRANSITION 12    // Constant: one of `TRANSITION_*`.
#define SPEC_OUTWARD 13       // Constant: transparent and closed; normals stay outward in layers.
#define SPEC_IN_LAYERS 14     // Constant: transparent; drawn in layers.
#define SPEC_PACKED 15        // Constant: disks in 16 bytes, their colors in 4 (`inc/packed.glsl`).
#define SPEC_OWN_EPSILON 39    // Constant: splats have a share of epsilon of their own (`inc/splat.glsl`).
#define SPEC_FINE 9           // Constant: positions have a second part (`inc/splat.glsl`).
#define SPEC_SPARSE 73         // Constant: places of a chunk may have no splat: their radius is below 0.
#define SPEC_HALF_SUMS 38     // Constant: splats are summed in 16 bits.
#define SPEC_LIGHTS 21        // Constant: how many lights of its own the scene has.
#define SPEC_LIMIT_SPLATS 27  // Constant: splats of each invocation of the limit of kernels.
#define SPEC_HALF_FLOATS 28   // Constant: what is left in images has 16 bits.
#define SPEC_PERTURBED_FORMULA 31 // Constant: the formula that is made wrong, for tests of the tests.
#define SPEC_WITH_DEPTH 32    // Constant: depth is summed, too.
#define SPEC_SOME_LARGE 40    // Constant: splats are listed as large: points and triangles leave them out, quads are they.
#define SPEC_SUMMED 41        // Constant: one of `SUMMED_*`.
#define SPEC_TEXTURED 42      // Constant: the kernel is read from a texture.
#define SPEC_PEELED 43        // Constant: only what is behind the layer before.
#define SPEC_SPLATS 44        // Constant: there are sums of splats.
#define SPEC_POLYGONS 45      // Constant: there are sums of polygons.
#define SPEC_LAYERED 46       // Constant: there are transparent layers.
#define SPEC_SHADED 47        // Constant: what is opaque is shaded already.
#define SPEC_CUT_OFF 48       // Constant: the kernel's texture is 0 outside of the disk.
#define SPEC_ATOMICS 49       // Constant: each invocation adds atomically.
#define SPEC_LARGE_LIST 50    // Constant: a list is that of large splats.
#define SPEC_FILTERED 51      // Constant: the paper's own visibility is filtered.
#define SPEC_POINT_CAP 52     // Constant: the device's largest point, pixels.
#define SPEC_POINT_STEP 53    // Constant: the step of its point sizes, pixels.
#define SPEC_SAMPLES 54       // Constant: samples of each pixel.
#define SPEC_FILTER_PX 56     // Constant: h of the low-pass filter, pixels.
#define SPEC_LEVELS 58        // Constant: one of `LEVELS_*`: what splats of a chunk are to levels of detail.
#define SPEC_BLENDED 60       // Constant: levels of detail blend into each other (`inc/levels.glsl`).
#define SPEC_ORTHOGRAPHIC 57  // Constant: rays are parallel (`inc/projection.glsl`).
#define SPEC_CLIPS 61         // Constant: clip curves cut parts off some splats (`inc/clip.glsl`).
#define SPEC_PARTED 63        // Constant: each tile has two lists: of splats, and of those that something cuts; sum of `PARTED_*` (`tile/constants.glsl`).
#define SPEC_CUTS 74          // Constant: tiles are drawn in which something cuts splats (`tile/splat.glsl`).
#define SPEC_COVERS_LESS 70    // Constant: what covers less than half of a pixel, and only that (`host_over.frag.glsl`).
#define SPEC_ENCODED 71        // Constant: colors are encoded as sRGB.
#define SPEC_TWO_SIDED 59     // Constant: splats that face away are drawn, and belong to surfaces of their own (`tile/pixel.glsl`).
#define SPEC_PLANES 62         // Constant: how many planes cut what is seen (`inc/planes.glsl`).
#define SPEC_TINTED 65         // Constant: colors of chunks are multiplied by something (`inc/tints.glsl`).
#define SPEC_OUTLINES 64       // Constant: rims of splats are black (`inc/outline.glsl`).
#define SPEC_SHARP 72         // Constant: curves cut off some splats of the object, in this chunk or in others.
#define SPEC_REACHES 66         // Constant: some splats lie at a border, and reach further than their rims (`inc/reach.glsl`).
#define SPEC_COVERAGE_EDGES 55 // Constant: a pixel is covered in part where a surface ends (`inc/edges.glsl`).

// What cuts splats, for SPEC_PARTED.
#define PARTED_CURVES 1 // Clip curves.
#define PARTED_PLANES 2 // Planes that cut the frame.

// Values of SPEC_SUMMED.
#define SUMMED_OPAQUE 0 // Opaque splats.
#define SUMMED_BESIDE 1 // Opaque splats that polygons lie beside.
#define SUMMED_LAYER 2  // A transparent layer.
#define SUMMED_REST 3   // All that is left for the last transparent layer, lit.

// Sets of the passes over splats and polygons.
#define SET_SPLATS 0 // Set: what is drawn.
#define SET_LIST 1   // Set: lists of splats.
#define SET_READ 2   // Set: what fragments read.

// Bindings of set 0 of splats and polygons.
#define BIND_SPLATS_SHAPES 0 // Binding: shapes of splats, or vertices.
#define BIND_SPLATS_COLORS 1 // Binding: their colors.
#define BIND_SPLATS_LEVELS 2 // Binding: what decides about their levels of detail.
#define BIND_SPLATS_CLIPS 3  // Binding: their clip curves.
#define BIND_SPLATS_INDICES 2 // Binding: of triangles, the numbers of their corners.
#define BIND_SPLATS_CELLS 3   // Binding: of triangles, their cells.

// Bindings of the set of lists.
#define BIND_LIST_BITS 0      // Binding: a bit a splat.
#define BIND_LIST_STARTS 1    // Binding: how many come before each word of bits, then in all.
#define BIND_LIST_ITEMS 2     // Binding: the list.
#define BIND_LIST_ARGUMENTS 3 // Binding: arguments of what is drawn or dispatched for the list.
#define BIND_LIST_BLOCKS 4    // Binding: the blocks in which visible splats are looked for.
#define BIND_LIST_UNHIDDEN_BITS 1 // Binding: where hidden ones are looked for, a bit for each that is not.
#define BIND_LIST_CELLS 2     // Binding: there, the hierarchy of the visible depth.
#define BIND_LIST_PLANES 5    // Binding: the planes that cut what is seen.
#define BIND_LIST_POINTS 0    // Binding: precomputed points of the floor.

// Bindings of the set of the depth's hierarchy.
#define BIND_CELLS_DEPTH 0 // Binding: the visible depth.
#define BIND_CELLS 1       // Binding: its hierarchy.

// Bindings of the set that fragments of splats and polygons read.
#define BIND_READ_DEPTH 0         // Binding: the visible depth where depth is summed; where layers are peeled, that of the layer before.
#define BIND_READ_KERNEL 1        // Binding: the kernel as a texture.
#define BIND_READ_POLYGON_DEPTH 2 // Binding: the depth of polygons, or of splats where those are nearer.
#define BIND_READ_LIGHTS 3        // Binding: the scene's own lights.
#define BIND_READ_PLANES 4        // Binding: the planes that cut what is seen.
#define BIND_READ_TINTS 5         // Binding: what colors of chunks are multiplied by.

// Bindings of the set of sums.
#define BIND_SUMS_COLORS 0          // Binding: colors of splats.
#define BIND_SUMS_NORMALS 1         // Binding: normals of splats; of the last layer, weights.
#define BIND_SUMS_POLYGON_COLORS 2  // Binding: colors of polygons.
#define BIND_SUMS_POLYGON_NORMALS 3 // Binding: normals of polygons.
#define BIND_SUMS_SPLATS_BEFORE 2   // Binding: instead of these, colors of splats of the layer before.
#define BIND_SUMS_POLYGONS_BEFORE 3 // Binding: those of its polygons.
#define BIND_SUMS_LAYERS 4          // Binding: composed transparent layers.
#define BIND_SUMS_LIGHTS 5          // Binding: the scene's own lights.
#define BIND_SUMS_DEPTH 4           // Binding: for the export, the visible depth.

// Values of SPEC_LEVELS.
#define LEVELS_NONE 0   // All are drawn.
#define LEVELS_LEAVES 1 // Splats of the object, below a node each.
#define LEVELS_NODES 2  // Nodes, which stand for what is below them.
#define LEVELS_OF_CELLS 3 // Splats that polygons take the place of where their cells are large.
#define LEVEL_WORDS 8   // Words of what a camera makes of a chunk's levels.
#define CELL_WORDS 8    // Words of what a device has of a mesh's cell.

// Values of SPEC_FILTER.
#define FILTER_NONE 0         // No filter.
#define FILTER_ADJUST 1       // Tangent adjustment of the principal axes.
#define FILTER_ADJUST_PAPER 2 // Tangent adjustment as published (Guennebaud et al. 2006, equations 8 to 10).
#define FILTER_MAX 3          // The larger one of kernel and low-pass filter (Botsch et al. 2005).
#define FILTER_EWA 4          // Full EWA: an affine map, convolved with the low-pass filter.

// Values of SPEC_KERNEL.
#define KERNEL_GAUSSIAN 0 // exp(-r^2 / (2 sigma^2)).
#define KERNEL_PSI_E 1    // Pajarola et al. 2003, section 5.2.

// Values of SPEC_SHADING.
#define SHADING_PHONG 0   // Diffuse and specular light.
#define SHADING_LAMBERT 1 // Diffuse light.
#define SHADING_NORMALS 2 // Normals as colors.
#define SHADING_ALBEDO 3  // Unlit.

// Values of SPEC_TRANSITION.
#define TRANSITION_COLOR 0      // Splats and polygons blend as shaded colors.
#define TRANSITION_ATTRIBUTES 1 // They blend as attributes, before shading.
#define TRANSITION_NONE 2       // Polygons hide splats of the same surface.

// Values of SPEC_RASTERIZER.
#define RASTERIZER_PERSPECTIVE 0         // Perspective-correct, expanded about the projected center.
#define RASTERIZER_PERSPECTIVE_PAPER 1   // The same in the paper's form, about the image's middle.
#define RASTERIZER_RAYCAST 2             // Ray casting (Botsch et al. 2005).
#define RASTERIZER_RAYCAST_APPROXIMATE 3 // Ray casting with its approximate point size.
#define RASTERIZER_AFFINE_CENTER 4       // An affine map, exact at the center.
#define RASTERIZER_AFFINE_CONTOUR 5      // An affine map, exact at the contour.
#define RASTERIZER_TRIANGLE 6            // Triangles in the splat's plane (Pajarola et al. 2003, section 5.2).

// Workgroups.
#define MOST_GROUPS_IN_ROW 32768 // Workgroups along a row of a dispatch: a device need not take more than 65535 in one dimension.

// Specialization constants of tiles.
#define SPEC_MAY_BE_LARGE 16    // Constant: some splats are left to the graphics pipeline.
#define SPEC_SHIFTED_FOR_ALL 18 // Constant: beside polygons, all splats pass that the polygons' own test lets pass.
#define SPEC_PART_LENGTH 19     // Constant: entries of a tile that one dispatch takes; tiles with more are overflow tiles.
#define SPEC_STACKED 20         // Constant: the last layer counts as several surfaces.
#define SPEC_KEEPS_DEPTH 23     // Constant: someone reads the visible depth.
#define SPEC_PLACE_BITS 24      // Constant: bits of a tile's column or row in a tile rect.
#define SPEC_TILE_HEIGHT 25     // Constant: pixels of a tile's columns, `MOST_TILE_HEIGHT` or half as many.
#define SPEC_IN_SLOTS 26        // Constant: images hold overflow tiles alone, side by side.
#define SPEC_WITH_POLYGONS 29   // Constant: polygons lie beside the splats.
#define SPEC_DEPTH_PRELOADED 30 // Constant: visibility begins from a depth.
#define SPEC_SEES 33            // Constant: visibility is found.
#define SPEC_SUMS 34            // Constant: what is visible is summed.
#define SPEC_SEVERAL 35         // Constant: layers take several dispatches, which go on from each other.
#define SPEC_LISTED 36            // Constant: only the splats of a list are projected.
#define SPEC_TEXELS 37          // Constant: tile rects are read as texels.

// Bindings of the set of tiles.
#define BIND_RECORDS 0         // Binding: the first quarter of projected splats, and the other three behind it.
#define BIND_RECTS 4           // Binding: their tile rects.
#define BIND_COUNTS 5          // Binding: of each segment, how many of its splats fall into each bin.
#define BIND_STARTS 6          // Binding: where the list of each bin starts.
#define BIND_ENTRIES 7         // Binding: the lists.
#define BIND_NON_EMPTY_TILES 8 // Binding: the tiles that have splats.
#define BIND_ARGUMENTS 9       // Binding: arguments of dispatches and draws.
#define BIND_OVERFLOW_TILES 10 // Binding: the tiles with more splats than one dispatch takes.
#define BIND_COLORS 11         // Binding: where sums of colors, layers, or what tiles show are stored.
#define BIND_NORMALS 12        // Binding: where sums of normals are stored; of layers, depth and weight of the last one.
#define BIND_VISIBLE_DEPTH 13  // Binding: the depth that tiles find; of layers, what ended.
#define BIND_DEPTH_BEFORE 14   // Binding: a depth that is there before.
#define BIND_POLYGON_DEPTH 15  // Binding: the depth of polygons.
#define BIND_LIGHTS 16         // Binding: the scene's own lights.
#define BIND_COLORS_BEFORE 17  // Binding: `BIND_COLORS` as it was before.
#define BIND_NORMALS_BEFORE 18 // Binding: `BIND_NORMALS` as it was before.
#define BIND_RUNS 19           // Binding: runs of tiles with splats.
#define BIND_VISIBLE_STARTS 20    // Binding: how many splats are visible before each word of their bits.
#define BIND_VISIBLE_LIST 21      // Binding: the list of visible splats.
#define BIND_VISIBLE_BLOCKS 22    // Binding: the blocks in which they are looked for.
#define BIND_RECORD_TEXELS 23  // Binding: the quarters of projected splats, as texels.
#define BIND_ENTRY_TEXELS 27   // Binding: the lists, as texels.
#define BIND_RECT_TEXELS 28    // Binding: tile rects, as texels.
#define BIND_LAYER_STATE 29    // Binding: what is known of overflow tiles' layers between dispatches.
#define BIND_TINTS 29          // Binding: where records are made, what colors of chunks are multiplied by.
#define BIND_VISIBLE_BEFORE 30 // Binding: `BIND_VISIBLE_DEPTH` as it was before.
#define BIND_CLIPS 31          // Binding: the clip curves of projected splats.
#define BIND_CLIP_TEXELS 32    // Binding: the same, as texels.
#define BIND_PLANES 33         // Binding: the planes that cut what is seen.

// Sizes of tiles and of the work on them.
#define TILE_WIDTH 8          // Pixels along a row of a tile.
#define MOST_TILE_HEIGHT 8    // Pixels of a tile's columns at most; where splats are small, half as many.
#define BAND_ROW 8            // Pixels of the rows that bands have, each a row of tiles or two.
#define TILE_BATCH 8          // Splats of one step of a shader's loops.
#define SEGMENT_BLOCK 32      // Records that are dealt out to a segment at a time.
#define BIN_GROUP_SIZE 8      // Invocations of a workgroup of which each walks over a segment.
#define TOTAL_GROUP_SIZE 64   // Those of one that adds up what was counted.
#define HALF_COUNT_BITS 16     // Of a word that counts both lists of a tile, those of each.
#define PROJECT_GROUP_SIZE 64 // Invocations of a workgroup that projects splats.
#define RECT_SIDE_BITS 16     // Bits of a tile rect along a side of the image: the first tile's place, then how many tiles more.
#define MOST_PLACE_BITS 13    // Of these, bits of a place at most; the rest marks small rects and their corners.
#define RECT_CHUNK 4294959104 // From this rect on they stand for no tiles but for a chunk each; the last one, all ones, for nothing.
#define MOST_TILES_SHIFT 14    // Where splats are projected: from this bit on of what tells a chunk's number, how many tiles a splat touches at most.
#define SLOTS_IN_ROW 256      // Tiles in a row of an image that holds overflow tiles alone.
#define STATE_VECTORS 4       // Vectors of four floats that are kept of a pixel of an overflow tile's layers;
#define EDGE_STATE_VECTORS 3  // and so many more where edges cover pixels in part.
#define WHOLE_TILES 2147483647 // The part of a dispatch that does whole tiles and leaves the overflow tiles out.

// Steps of a layer of overflow tiles.
#define STEP_SEE 0  // Visibility.
#define STEP_SUM 1  // Accumulation, and composition behind the last part.
#define STEP_REST 2 // All that is left.

// Where the arguments are, in words.
#define ARGUMENTS_TILES 0    // VkDispatchIndirectCommand: tiles with splats, where lists are parted with none that is clipped; overflow tiles end at once.
#define ARGUMENTS_OVERFLOW 4 // VkDispatchIndirectCommand: overflow tiles.
#define ARGUMENTS_QUADS 8    // VkDrawIndirectCommand: a quad for each run of tiles with splats.
#define ARGUMENTS_CLIPPED 12 // VkDispatchIndirectCommand: where lists are parted, tiles with clipped splats.
#define ARGUMENTS_CHUNKS 16  // VkDrawIndirectCommand a chunk: a quad for each splat that is drawn by the graphics pipeline.

// Other sizes.
#define CLIP_VECTORS 6          // Vectors of four floats of the clip curves of a splat: three for each of two curves.
#define CLIP_RECORD_VECTORS 10  // Vectors of a projected splat's curves: those, and four that tell which tiles they cut.
#define KERNEL_TEXTURE_SIDE 257 // Texels along a side of the kernel's texture; no power of two, so that its image has no more of them (one_shape.rs).
#define BLOCK_SPLATS 256        // Splats of a chunk that have bounds of their own; the last block may have fewer.
#define LIST_GROUP_SIZE 64      // Invocations of a workgroup, one a word of bits, that marks or lists splats.
#define FLOOR_GROUP_SIZE 256    // Invocations of a workgroup that precomputes points of the floor.
#define LIMIT_GROUP_SIZE 256    // Invocations of a workgroup that does next to nothing.
#define KERNELS_GROUP_SIZE 64   // Invocations of a workgroup that evaluates kernels alone.
#define ALL_VISIBLE 1073741824 // Beside a block's number: none of its splats faces away or is outside of the view.
#define ALL_OF_LEVEL 536870912 // Beside that: all of them are of the level of detail that is drawn.
#define ALL_IN_VIEW 268435456  // Beside that: none of them is outside of the view.
#define HAS_BOUNDS 134217728   // Beside that: bounds that a device has may tell which way all of them face. A block's number is less.
#define DEPTH_CELLS_SIDE 8      // Pixels along a side of a cell of the depth's hierarchy, and cells along a side of a block of cells.

// What is known of a clip curve.
#define CURVE_IS 1   // There is one.
#define CURVE_LEFT 2 // Its middle control point is to the left of the way from the start to the end.
#define CURVE_BOTH 4 // Of the second one: only what both remove is cut off.
#define CURVE_TOWARD 8 // In the image it keeps what is toward one of four directions, 0 to 3 times this (`inc/clip_image.glsl`).

// Limits of numbers.
#define MOST_PLANES 6               // Planes that cut what is seen.
#define MOST_LIGHTS 16              // Lights of a scene.
#define HALF_FLOAT_MAX 65504.0      // The largest finite 16-bit float.
#define HALF_FLOAT_FITS 60000.0     // Sums above it are scaled to it, so that their rounding cannot end beyond the largest.
#define OUTLINE_FROM 0.8            // Where outlines of splats begin, in r^2 of the largest that covers.
#define OUTLINE_WEIGHT 32.0         // The weight of outlines over what it is without.
#define LEAST_HALF_FLOAT 5.9604645e-8 // 2^-24, the smallest 16-bit float above 0; kernels end there.
#define LEAST_SHIFT 1.0e-6            // Of its depth: a splat is shifted by as much at least, where it is shifted at all.
#define MOST_EDGE_SURFACES 6        // Opaque surfaces behind each other that a pixel shows at their edges, at most.
#define SURE_BEHIND 2.0             // Over the ratio of what two surfaces fall by: what ends as the one before it does is behind that (`tile/ended.glsl`).
#define EDGE_LENGTHENING 4.0        // Of a slanted splat's epsilon where edges are covered in part (`inc/mapping.glsl`).
#define SHARP_LENGTHENING 16.0      // The same of a surface with sharp edges.
#define SHARP_SUM 1.35              // Of a sharp surface, whose sums vary: what weights over the overlap are multiplied by (`inc/edges.glsl`).
#define SHARP_FACING 0.3            // All of it from twice this cosine between the normal and the ray on, from this one on more and more,
#define SHARP_REACH 0.5             // or where no outline is within so much of the splat's radius and the filter's (`tile_project.comp.glsl`),
#define SHARP_MINOR 0.3             // and the image is wider than so much of the filter's radius; all of it from the filter's radius on.
#define WHOLE_EDGE_SUM 0.79         // From this sum over the overlap on a pixel is covered, unless the surface ends there.
#define WHOLE_FLAT_SUM 0.6          // The same where the sum hardly falls, so that nothing ends there.
#define MOST_POLYGON_SAMPLES 4      // Samples of a pixel at which polygons are drawn, where they cover pixels in part.
#define WHOLE_SEAM_SUM 0.4          // From this sum on, splats hide the polygons of the same surface: at a seam half of a surface's are there.
#define EYE_DOME_STRENGTH 0.7         // How much darker eye-dome lighting makes a slope of 1 all around, as an exponent.
#define MOST_STACKED_SURFACES 8.0   // Surfaces that the last layer counts as, at most: a rim before it would count it as a thousand.
