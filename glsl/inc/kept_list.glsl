// The list of kept splats (kept.glsl), for whoever sets them up. KEPT_STARTS and KEPT_LIST are bindings of set 1.

layout(set = 1, binding = KEPT_STARTS, std430) readonly buffer KeptStarts { uint kept_starts[]; };
layout(set = 1, binding = KEPT_LIST, std430) readonly buffer KeptList { uint kept_list[]; };

// From a number among the chunk's kept splats to its place in the list and to the splat's own number; false behind the last one.
bool find_kept(inout uint index, out uint place)
{
    uint first = first_word_of_chunk();
    place = kept_starts[first] + index;
    if (place >= kept_starts[first + words_of_chunk()]) {
        return false;
    }
    index = kept_list[place];
    return true;
}
