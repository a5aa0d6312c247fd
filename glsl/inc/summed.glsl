// What accumulation sums.

layout(constant_id = SPEC_SUMMED) const uint SUMMED = SUMMED_OPAQUE;
