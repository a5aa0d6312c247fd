// Leaves out of a tile's list what its visible depth hides, before sums: Guennebaud, Barthe, Paulin, "Deferred Splatting",
// Eurographics 2004, a tile at a time. A splat is hidden where the nearest that its depth gets anywhere in the tile is behind the
// farthest visible depth of the tile's pixels: none of its fragments there would pass the test of sums, so that these are the same to
// the bit. Depth is linear, so that it is nearest in a corner, and there it is found as in the pixels (tile_column.glsl): rounding
// keeps the order of what it rounds, so that no pixel's is nearer. A tile with an empty pixel keeps all.

#if defined(PIXELS)
#define INVOCATIONS (TILE_WIDTH * TILE_HEIGHT)
shared uint farthest_bits;
shared uint vote_words[INVOCATIONS / 32];
#else
#define INVOCATIONS TILE_WIDTH
#endif

float farthest_of_tile(float visible[ROWS])
{
    float farthest = visible[0];
    [[unroll]] for (int row = 1; row < ROWS; row++) {
        farthest = min(farthest, visible[row]);
    }
#if defined(PIXELS)
    if (gl_LocalInvocationIndex == 0) {
        farthest_bits = floatBitsToUint(farthest);
    }
    barrier();
    atomicMin(farthest_bits, floatBitsToUint(farthest)); // never negative, so that bits compare as depths do
    barrier();
    return uintBitsToFloat(farthest_bits);
#else
    float own = farthest;
    [[unroll]] for (uint k = 0; k < INVOCATIONS; k++) {
        farthest = min(farthest, handed(own, k));
    }
    return farthest;
#endif
}

// How many of the tile's invocations vote for: those before this one, and all.
uvec2 votes(bool own)
{
#if defined(PIXELS)
    uint word = gl_LocalInvocationIndex / 32;
    uint bit = 1u << (gl_LocalInvocationIndex % 32);
    barrier(); // those before were read
    vote_words[word] = 0;
    barrier();
    atomicOr(vote_words[word], own ? bit : 0);
    barrier();
    uint first = bitCount(vote_words[0]);
    uint before = bitCount(vote_words[word] & (bit - 1));
    return uvec2(word > 0 ? first + before : before, first + bitCount(vote_words[1]));
#else
    uint ballot = subgroupBallot(own).x;
    return uvec2(bitCount(ballot & ((1u << gl_SubgroupInvocationID) - 1)), bitCount(ballot));
#endif
}

// The list without what is hidden, in the same order. `at_px`: of the invocation's column.
Range unhidden(Range range, vec2 at_px, float visible[ROWS])
{
    float farthest = farthest_of_tile(visible);
    vec2 first_px = at_px - vec2(gl_LocalInvocationID.x, 0.0);
    Range left = Range(range.first, range.first);
    for (uint base = range.first; base < range.end; base += INVOCATIONS) {
        uint entry = base + OWN_ENTRY;
        Splat splat = load_splat(base, range.end);
        vec2 corner = vec2(greaterThan(splat.w, vec2(0.0))) * vec2(TILE_WIDTH - 1, TILE_HEIGHT - 1);
        corner.y += float(rows_above);
        float dx = first_px.x + corner.x - splat.x0_px.x;
        float dy = first_px.y - splat.x0_px.y + corner.y;
        float along_x = 1.0 + splat.w.x * dx;
        float nearest = splat.w0 * (along_x + splat.w.y * dy);
        bool kept = entry < range.end && !(nearest < farthest);
        uvec2 count = votes(kept);
        if (kept) {
            entries[left.end + count.x] = splat.record;
        }
        left.end += count.y;
    }
    // What the others wrote is read from here on.
#if defined(PIXELS)
    memoryBarrierBuffer();
    barrier();
#else
    subgroupMemoryBarrierBuffer();
    subgroupBarrier();
#endif
    return left;
}
