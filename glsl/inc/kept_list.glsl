// Which splat an invocation sets up: of all in their order; or, KEPT, of the list of kept ones (kept.glsl), of which KEPT_STARTS and
// KEPT_LIST are bindings of set 1. Workgroups have 64 invocations.

#if defined(KEPT)
layout(set = 1, binding = KEPT_STARTS, std430) readonly buffer KeptStarts { uint kept_starts[]; };
layout(set = 1, binding = KEPT_LIST, std430) readonly buffer KeptList { uint kept_list[]; };

// From a number among the chunk's kept splats to its place in the list and to the splat's own number; false behind the last one.
bool find_kept(inout uint index, inout uint place)
{
    uint first = first_word_of_chunk();
    place = kept_starts[first] + index;
    if (place >= kept_starts[first + words_of_chunk()]) {
        return false;
    }
    index = kept_list[place];
    return true;
}
#endif

// Its number in its chunk, and its place among all that are set up; false where there is none.
bool find_splat(out uint index, out uint place)
{
    index = GROUP_NUMBER * 64 + gl_LocalInvocationID.x;
    place = frame.first_record + index;
#if defined(KEPT)
    if (!find_kept(index, place)) {
        return false;
    }
#endif
    return index < frame.splat_count;
}
