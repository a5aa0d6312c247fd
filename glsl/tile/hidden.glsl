// Leaves out of a tile's list what its visible depth hides, before sums: Guennebaud, Barthe, Paulin, "Deferred Splatting",
// Eurographics 2004, a tile at a time. A splat is hidden where the nearest that its depth gets anywhere in the tile is behind the
// farthest visible depth of the tile's pixels: none of its fragments there would pass the test of sums, so that these are the same to
// the bit. Depth is linear, so that it is nearest in a corner, and there it is found as in the pixels (tile/pixel.glsl): rounding
// keeps the order of what it rounds, so that no pixel's is nearer. A tile with an empty pixel keeps all.

#if defined(HIDDEN)
// The list without what is hidden, in the same order.
Range unhidden(Range range)
{
    float farthest = visible[0];
    [[unroll]] for (int row = 1; row < OWN_ROWS; row++) {
        farthest = min(farthest, visible[row]);
    }
    farthest = least_of_tile(farthest);
    vec2 first_px = top_px - vec2(gl_LocalInvocationID.x, 0.0);
    Range left = Range(range.first, range.first, range.first);
    for (uint base = range.first; base < range.end; base += LANES) {
        Splat splat = load_splat(base, range.end);
        vec2 corner = vec2(greaterThan(splat.w, vec2(0.0))) * vec2(TILE_WIDTH - 1, TILE_HEIGHT - 1);
        corner.y += float(first_row - OWN_ROW);
        float dx = first_px.x + corner.x - splat.x0_px.x;
        float dy = first_px.y - splat.x0_px.y + corner.y;
        float along_x = 1.0 + splat.w.x * dx;
        float nearest = depth_of(splat) * (along_x + splat.w.y * dy);
        bool kept = base + OWN_LANE < range.end && !(nearest < farthest);
        uvec2 votes = votes_of_tile(kept);
        if (kept) {
            entries[left.end + votes.x] = splat.record;
        }
        left.end += votes.y;
        left.clipped += CUTS ? votes_of_tile(kept && base + OWN_LANE < range.clipped).y : votes.y;
    }
    see_entries();
    return left;
}
#else
Range unhidden(Range range)
{
    return range;
}
#endif
