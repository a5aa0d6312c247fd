// Where a splat's map is expanded, as it is handed over to fragments. A place is rounded as in the whole picture, of which the image may
// be a part: the difference to its corner is exact, so that a part has the bits of the whole.

vec2 handed_over_px(vec2 from_middle)
{
    return PLACES_FROM_CORNER ? from_middle + (frame.middle_px + CORNER_PX) - CORNER_PX : from_middle;
}

// (x0_px, w there) of a point; of perspective-paper, which is always expanded about the middle of the image, (uw, vw, w) there.
vec3 expansion_of(ImageMap map)
{
    if (RASTERIZER == RASTERIZER_PERSPECTIVE_PAPER) {
        return map.at_x0;
    }
    return vec3(handed_over_px(map.x0_px), map.at_x0.z);
}
