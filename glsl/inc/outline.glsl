// --outlines splats: the rim of each splat is black, and weighs so much more that it shows where others cover it. What is behind the surface that is
// seen has none there.

layout(constant_id = SPEC_OUTLINES) const bool OUTLINES = false;

bool is_outline(float r2)
{
    return OUTLINES && r2 > OUTLINE_FROM * COVERAGE_R2;
}
