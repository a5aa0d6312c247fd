// The lists of tiles: numbers of records. Columns read them as texels (tile/lanes_column.glsl); HIDDEN: tile/hidden.glsl shortens
// them, so that they are written, too.

#if defined(HIDDEN)
layout(set = 0, binding = BIND_ENTRIES, std430) coherent buffer Entries { uint entries[]; };
#elif defined(COLUMN)
layout(set = 0, binding = BIND_ENTRY_TEXELS) uniform utextureBuffer entries;
#else
layout(set = 0, binding = BIND_ENTRIES, std430) readonly buffer Entries { uint entries[]; };
#endif

uint entry(uint number)
{
#if defined(COLUMN) && !defined(HIDDEN)
    return texelFetch(entries, int(number)).x;
#else
    return entries[number];
#endif
}
